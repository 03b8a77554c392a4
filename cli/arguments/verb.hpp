// SPDX-License-Identifier: GPL-3.0-or-later
// The manual as data: --help and the man page are two renderings of one text.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "cli/arguments/options.hpp"
#include "job/asked_options.hpp"

namespace ridgecraft::cli {

struct ManualEntry {
  std::string term;  ///< "--size LENGTH"
  std::string text;  ///< one or two sentences
};

struct ManualSection {
  std::string title;  ///< "Size"
  std::vector<ManualEntry> entries;
};

struct Manual {
  std::string name;     ///< "ridgecraft" or "ridgecraft segment"
  std::string purpose;  ///< one line
  std::vector<std::string> usage;
  std::vector<ManualEntry> examples;  ///< command, what it does
  std::vector<ManualSection> sections;
};

/// What --help prints, at most 100 columns wide.
[[nodiscard]] std::string help_text(const Manual& manual);

/// A man page (section 1) of the program and its verbs.
[[nodiscard]] std::string man_page(const Manual& program, const std::vector<Manual>& verbs,
                                   std::string_view version);

// One verb of the program: its options, the texts around them, and how they are parsed. Hides CLI11, which is
// slow to compile.

using Arguments = std::vector<std::string>;

/// Thrown for a long option that the verb hasn't: another one may have it.
class UnknownOption : public Error {
 public:
  UnknownOption(const std::string& sentence, std::string option)
      : Error(ErrorKind::usage, sentence), option_(std::move(option)) {}
  [[nodiscard]] const std::string& option() const { return option_; }  ///< "--pieces"

 private:
  std::string option_;
};

class Verb {
 public:
  Verb(std::string name, std::string purpose);
  Verb(const Verb&) = delete;
  Verb& operator=(const Verb&) = delete;
  ~Verb();

  Verb& usage(std::string line);
  Verb& example(std::string command, std::string what);
  /// A section behind those of the options.
  Verb& section(ManualSection section);

  /// An option ("-x,--long") or argument ("MODEL"); the value is what was typed, unchecked. Given twice, the
  /// last one counts, so that a script can append what it wants differently. An empty group hides it.
  Verb& option(const std::string& group, const std::string& names, std::string& value,
               const std::string& type, const std::string& text);
  /// An option that may be given several times.
  /// Takes one value each time that it is given.
  Verb& list(const std::string& group, const std::string& names, std::vector<std::string>& values,
             const std::string& type, const std::string& text);
  /// A list that may take several values at a time, as a shell's patterns give them.
  Verb& takes_several(const std::string& name);
  Verb& flag(const std::string& group, const std::string& names, bool& value, const std::string& text);

  /// An option of the table; `group` and `help` go before the row's where they aren't empty.
  Verb& add(const Option& row, job::AskedOptions& asked, const std::string& group = "",
            const std::string& help = "");

  /// With arguments: parses them and returns what `checked` makes of them, or the help if they ask for it.
  /// Without: fills in the manual.
  [[nodiscard]] Job finish(const Arguments* arguments, Manual* manual, const std::function<Job()>& checked);

 private:
  struct Parser;

  bool parse(Arguments arguments);
  void take_positional(const Arguments& words);
  [[nodiscard]] Manual manual() const;
  [[noreturn]] void refuse_unexpected(const std::vector<std::string>& remaining) const;
  [[nodiscard]] std::string instead_of(const std::string& word, const std::string& option) const;
  [[nodiscard]] std::string as_given(const std::string& word) const;
  [[nodiscard]] std::string takes() const;

  Manual manual_;
  Arguments given_;  ///< those that may be options
  std::vector<ManualSection> extra_sections_;
  std::unique_ptr<Parser> parser_;
};

}  // namespace ridgecraft::cli
