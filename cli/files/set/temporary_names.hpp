// SPDX-License-Identifier: GPL-3.0-or-later
// Names of hidden files that stand beside results while a run writes them. Nobody else makes such names.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ridgecraft::cli {

/// What a run calls itself in one folder: 8 hexadecimal digits of the kernel that it runs under, then 24
/// random ones. Process ids don't do: two containers that write into one folder may both be process 1.
using RunId = std::string;

/// Stands for the kernel in the id of a run whose end can't be seen: its file system knows no locks.
inline constexpr std::string_view unknown_kernel = "00000000";

/// The first 8 digits of an id here: another one on each machine and after each start of it, the same one in
/// all its containers. unknown_kernel where the system doesn't tell.
[[nodiscard]] const std::string& this_kernel();

/// Another id at each call; `kernel` as above. Throws Error(internal) where the system has no random numbers.
[[nodiscard]] RunId new_run_id(std::string_view kernel);

/// Digits of the kernel in an id.
[[nodiscard]] std::string_view kernel_of(const RunId& id);

/// Held while the files of a folder are exchanged (folder_lock.hpp).
inline constexpr std::string_view lock_name = ".ridgecraft.lock";

// Short, so that they fit wherever the target's name does.

/// The new content of a file, before it gets its name.
[[nodiscard]] std::string part_name(const RunId& id, unsigned number);
/// A second name for what the new file replaces, until all files are in place.
[[nodiscard]] std::string old_name(const RunId& id, unsigned number);
/// What the run is about to do with them (set_journal.hpp).
[[nodiscard]] std::string journal_name(const RunId& id);

/// The id in a name that one of the three functions above made, or nothing for any other name.
[[nodiscard]] std::optional<RunId> run_of(std::string_view name);

}  // namespace ridgecraft::cli
