// SPDX-License-Identifier: GPL-3.0-or-later
// What a run is about to do with the files of one folder, as text that outlives it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/files/set/folder.hpp"
#include "cli/files/set/temporary_names.hpp"

namespace ridgecraft::cli {

/// A new file that gets its name.
struct Replacement {
  unsigned number = 0;              ///< in part_name and old_name
  std::string target;               ///< its name in the folder
  std::optional<FileState> before;  ///< of what it replaces, if anything
  FileState after;                  ///< of the new file

  friend bool operator==(const Replacement&, const Replacement&) = default;
};

/// A file of an earlier run that goes.
struct Removal {
  std::string target;
  FileState before;

  friend bool operator==(const Removal&, const Removal&) = default;
};

/// Another folder that gets files of the same set, and under which id.
struct Sibling {
  std::string path;  ///< from the folder of this journal, since containers may see both elsewhere
  RunId id;

  friend bool operator==(const Sibling&, const Sibling&) = default;
};

/// What becomes of a set whose run was killed.
enum class Decision {
  none,     ///< no file has its name yet: the new files go
  forward,  ///< all new files are complete, in all folders: those that haven't their names get them
  back,     ///< one of them couldn't get its name: those that have it make room for what was there before
};

/// Of one set and one folder.
struct SetJournal {
  std::vector<Sibling> siblings;
  std::vector<Replacement> replacements;
  std::vector<Removal> removals;
  Decision decision = Decision::none;

  friend bool operator==(const SetJournal&, const SetJournal&) = default;
};

/// All but the decision, one line each:
///
///     ridgecraft journal 1
///     sibling ../b 5f0c2a…
///     replace 0 - 1834 1699876543210123456 house.pdf
///     replace 1 2044 1699871234567890123 2051 1699876543210234567 house.svg
///     remove 2010 1699871234567890456 house-2.svg
///     end
///
/// A replacement has its number, bytes and time of the old file (`-` for none) and of the new one. Names are
/// percent-encoded but for letters, digits and `.`, `_`, `-`, `/`.
[[nodiscard]] std::string listing(const SetJournal& journal);

/// The line that follows later: `forward` or `back`.
[[nodiscard]] std::string decision_line(Decision decision);

/// Reads both. A text that was cut off before its end has decided nothing. Nothing for a text that isn't of
/// this form (a later version's, perhaps), or whose names would lead out of the folder.
[[nodiscard]] std::optional<SetJournal> parse_journal(std::string_view text);

}  // namespace ridgecraft::cli
