// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/set/file_set.hpp"

#include <cerrno>
#include <cstring>
#include <set>
#include <string>

#include "base/sentence.hpp"

namespace ridgecraft::cli {
namespace {

std::string part_of(const FolderShare& share, const Replacement& replacement) {
  return part_name(share.file->id(), replacement.number);
}

std::string old_of(const FolderShare& share, const Replacement& replacement) {
  return old_name(share.file->id(), replacement.number);
}

bool is_in_place(const FolderShare& share, const Replacement& replacement) {
  return !share.folder->state(part_of(share, replacement)) &&
         share.folder->state(replacement.target) == replacement.after;
}

bool is_waiting(const FolderShare& share, const Replacement& replacement) {
  return share.folder->state(part_of(share, replacement)) == replacement.after &&
         share.folder->state(replacement.target) == replacement.before;
}

/// About the first file that the folder gets.
Failure failure_of(const FolderShare& share, int error) {
  const auto& replacements = share.journal->replacements;
  return {share.folder->path() / (replacements.empty() ? "" : replacements.front().target), error};
}

std::optional<Failure> write_journals(std::span<const FolderShare> set) {
  for (const FolderShare& share : set) {
    if (const int error = share.file->write(*share.journal); error != 0) {
      return failure_of(share, error);
    }
    share.folder->sync();
  }
  return std::nullopt;
}

void keep_old_files(const FolderShare& share) {
  for (const Replacement& replacement : share.journal->replacements) {
    if (replacement.before) {
      // Where the file system knows no second names, the old file can't come back.
      [[maybe_unused]] const int ignored = share.folder->link(replacement.target, old_of(share, replacement));
    }
  }
}

std::optional<Failure> decide(std::span<const FolderShare> set, Decision decision) {
  std::optional<Failure> failure;
  for (const FolderShare& share : set) {
    share.journal->decision = decision;
    if (const int error = share.file->decide(decision); error != 0 && !failure) {
      failure = failure_of(share, error);
    }
  }
  return failure;
}

void put_back(const FolderShare& share, const Replacement& replacement, PutBack& result) {
  if (!is_in_place(share, replacement)) {
    return;
  }
  const std::filesystem::path target = share.folder->path() / replacement.target;
  const std::string old = old_of(share, replacement);
  const bool has_old = share.folder->state(old).has_value();
  if (replacement.before && !has_old) {
    result.kept.push_back(target);
    return;
  }
  const int error =
      has_old ? share.folder->rename(old, replacement.target) : share.folder->remove(replacement.target);
  if (error == 0) {
    ++result.restored;
  } else {
    result.failed.push_back(target);
  }
}

}  // namespace

std::string names_and(const std::vector<std::filesystem::path>& files, const char* one, const char* more) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files) {
    names.push_back(file.lexically_normal().string());
  }
  return listed(names, "and") + " " + (files.size() == 1 ? one : more);
}

std::optional<Failure> exchange(std::span<const FolderShare> set) {
  if (auto failure = write_journals(set)) {
    return failure;
  }
  for (const FolderShare& share : set) {
    keep_old_files(share);
  }
  if (auto failure = decide(set, Decision::forward)) {
    decide(set, Decision::back);
    return failure;
  }
  return put_in_place(set);
}

std::vector<std::filesystem::path> changed_since(std::span<const FolderShare> set) {
  std::vector<std::filesystem::path> changed;
  for (const FolderShare& share : set) {
    for (const Replacement& replacement : share.journal->replacements) {
      if (!is_in_place(share, replacement) && !is_waiting(share, replacement)) {
        changed.push_back(share.folder->path() / replacement.target);
      }
    }
  }
  return changed;
}

bool is_incomplete(std::span<const FolderShare> set) {
  for (const FolderShare& share : set) {
    for (const Replacement& replacement : share.journal->replacements) {
      if (share.folder->state(part_of(share, replacement))) {
        return true;
      }
    }
  }
  return false;
}

bool is_in_place(std::span<const FolderShare> set) {
  for (const FolderShare& share : set) {
    for (const Replacement& replacement : share.journal->replacements) {
      if (!is_in_place(share, replacement)) {
        return false;
      }
    }
    for (const Removal& removal : share.journal->removals) {
      if (share.folder->state(removal.target) == removal.before) {
        return false;
      }
    }
  }
  return true;
}

std::optional<Failure> put_in_place(std::span<const FolderShare> set) {
  for (const FolderShare& share : set) {
    for (const Replacement& replacement : share.journal->replacements) {
      const int error = share.folder->rename(part_of(share, replacement), replacement.target);
      if (error != 0 && !is_in_place(share, replacement)) {
        decide(set, Decision::back);
        return Failure{share.folder->path() / replacement.target, error, put_back(set)};
      }
    }
  }
  return std::nullopt;
}

PutBack put_back(std::span<const FolderShare> set) {
  PutBack result;
  for (const FolderShare& share : set) {
    for (const Replacement& replacement : share.journal->replacements) {
      put_back(share, replacement, result);
    }
    share.folder->sync();
  }
  return result;
}

std::vector<std::string> remove_leftovers(std::span<const FolderShare> set) {
  std::vector<std::string> notes;
  for (const FolderShare& share : set) {
    for (const Removal& removal : share.journal->removals) {
      if (share.folder->state(removal.target) != removal.before) {
        continue;
      }
      if (const int error = share.folder->remove(removal.target); error != 0) {
        notes.push_back((share.folder->path() / removal.target).string() +
                        " is of an earlier run and can't be removed: " + std::strerror(error));
      }
    }
    share.folder->sync();
  }
  return notes;
}

std::size_t remove_hidden(std::span<const FolderShare> set) {
  std::size_t removed = 0;
  for (const FolderShare& share : set) {
    // By their names, too: a folder needn't let itself be listed.
    std::set<std::string> names;
    for (const Replacement& replacement : share.journal->replacements) {
      names.insert({part_of(share, replacement), old_of(share, replacement)});
    }
    names.merge(hidden_files(*share.folder, share.file->id()));
    for (const std::string& name : names) {
      if (share.folder->remove(name) == 0) {
        ++removed;
      }
    }
  }
  for (const FolderShare& share : set) {
    share.file->remove();
    ++removed;
  }
  return removed;
}

}  // namespace ridgecraft::cli
