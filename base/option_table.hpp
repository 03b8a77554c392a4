// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `ridgecraft MODEL`, one row each. The command line with its help and man page, the settings
// in FOLD files and their check, the studio's controls, Python's keyword arguments and
// docs/reference/options.md come from these rows. They are data, and hold no code of the program.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace ridgecraft {

/// One text in English and in German; both empty where there is none.
struct Label {
  std::string_view english = {};
  std::string_view german = {};
};

enum class OptionKind : std::uint8_t {
  flag,
  text,    ///< any words; what it means is checked where it is read
  list,    ///< the same, and the option may be given several times
  file,    ///< the name of a file
  length,  ///< mm, or with a unit
  angle,   ///< degrees
  number,
  whole,   ///< a whole number, or one of the choices
  choice,  ///< one of the choices
};

/// Which jobs write the setting of an option into their nets.
enum class Noted : std::uint8_t {
  always,
  with_pages,
  if_changed,  ///< where it isn't the usual one
};

/// A word that an option takes.
struct OptionChoice {
  std::string_view word;
  Label label = {};             ///< in the studio; none: the word itself
  std::string_view means = {};  ///< of an old word, which isn't listed: the new one
};

/// The control of an option in the studio.
struct StudioControl {
  std::string_view group = {};  ///< "size", "paper", "pieces", "tabs" or "machine"; empty: no control
  Label label = {};
  Label usual = {};  ///< shown where nothing is entered; none: the usual value
  Label help = {};   ///< below it
  bool more = true;  ///< lies behind "More"
};

/// A row of the table: all that is known of one option.
struct Option {
  std::string_view name;         ///< "tab-height"
  std::string_view letter = {};  ///< "o" where the option is also called -o
  std::string_view group = {};   ///< heading in the help
  OptionKind kind = OptionKind::text;
  std::string_view takes = {};  ///< name of the value, where value_name() needs it
  std::string_view usual = {};  ///< default, as it is typed; empty where other things decide
  double low = 0.0;             ///< of numbers, lengths (mm) and angles (degrees), both included
  double high = std::numeric_limits<double>::infinity();
  std::vector<OptionChoice> choices = {};
  std::string_view help;
  std::string_view same_as = {};  ///< of a flag: what it stands for, "tabs=none"
  std::string_view setting = {};  ///< key in ridgecraft:settings; empty: none
  Noted noted = Noted::if_changed;
  /// Of ridgecraft.run() in Python: "tab_height"; empty: none.
  std::string_view keyword = {};
  StudioControl studio = {};
};

/// Two options that exclude each other, or one that needs another.
struct OptionRule {
  std::string_view option;    ///< "all-tabs" where it is given, "numbers=back" where it has this value
  bool needs;                 ///< needs the other one, or else excludes it
  std::string_view other;     ///< written in the same way
  std::string_view why = {};  ///< code of a message; empty: it is plain
};

/// In the order of the help.
[[nodiscard]] const std::vector<Option>& option_table();
[[nodiscard]] const std::vector<OptionRule>& option_rules();

/// The row of this name. Throws std::out_of_range where there is none.
[[nodiscard]] const Option& option_row(std::string_view name);

/// What the help calls the value: "LENGTH", "any|long|short"; empty for flags.
[[nodiscard]] std::string value_name(const Option& option);

}  // namespace ridgecraft
