// SPDX-License-Identifier: GPL-3.0-or-later
// Options as they were typed on the command line, or given to Python, and what they mean by their rows
// (base/option_table.hpp). All names are those of rows.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/message.hpp"
#include "base/option_table.hpp"
#include "export/export.hpp"
#include "job/options.hpp"

namespace ridgecraft::job {

/// How messages call an option: "--tab-height" or "tab_height".
enum class Naming { command_line, keywords };

/// Options as they were typed, which become job::Options when all are there.
class AskedOptions {
 public:
  explicit AskedOptions(Naming naming = Naming::command_line) : naming_(naming) {}

  /// What was typed, by the kind of the option.
  struct Typed {
    std::string text;
    std::vector<std::string> texts;  ///< of lists
    bool flag = false;
    bool off = false;  ///< a flag that was given as false
  };
  /// To be filled in. The reference stays valid.
  Typed& typed(std::string_view name) { return typed_[std::string(name)]; }

  [[nodiscard]] bool given(std::string_view name) const;
  [[nodiscard]] bool flag(std::string_view name) const;
  /// As typed, or the usual value of the row.
  [[nodiscard]] std::string text(std::string_view name) const;
  [[nodiscard]] const std::vector<std::string>& texts(std::string_view name) const;

  /// These throw Error(usage) where the text is none such, or out of the row's range.
  [[nodiscard]] double number(std::string_view name) const;  ///< lengths in mm, angles in radians
  [[nodiscard]] std::uint64_t whole(std::string_view name) const;
  [[nodiscard]] std::size_t choice(std::string_view name) const;  ///< index into the row's choices
  template <class Enum>
  [[nodiscard]] Enum choice_as(std::string_view name) const {
    return static_cast<Enum>(choice(name));
  }

  /// "--tab-height" or "tab_height"
  [[nodiscard]] std::string called(std::string_view name) const;

  /// Options that are given are those that they stand for (Option::same_as). Throws Error(usage) where these
  /// have another value already.
  void replace_aliases();

  /// Throws Error(usage) for options that exclude each other, or lack another one (option_rules()).
  void check_rules() const;

 private:
  [[nodiscard]] const Typed& as_typed(std::string_view name) const;
  [[nodiscard]] bool holds(std::string_view condition) const;
  [[nodiscard]] MessageValue named(std::string_view gap, std::string_view condition) const;

  std::map<std::string, Typed, std::less<>> typed_;
  Naming naming_;
};

/// The number that a text means to an option of kind length (mm), angle (radians) or number. Throws
/// Error(usage).
[[nodiscard]] double number_of(const Option& row, const std::string& called, const std::string& text);

// Where the values of options stand in job::Options: what is read into them, and noted of them in nets.

/// `usual`, with what was asked; without pages where `usual` has no paper. Files that options name aren't
/// read. Throws Error(usage).
[[nodiscard]] Options options_of(AskedOptions asked, Options usual);

/// Adds the settings of options whose value stands in one place; those of others are settings_of()'s.
void note_fields(Options& options, export_::Settings& settings);

}  // namespace ridgecraft::job
