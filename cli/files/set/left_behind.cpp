// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/set/left_behind.hpp"

#include <algorithm>
#include <list>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/sentence.hpp"
#include "cli/files/set/file_set.hpp"
#include "cli/files/set/temporary_names.hpp"

namespace ridgecraft::cli {
namespace {

/// The set of a dead run, its journals in our hands.
class DeadSet {
 public:
  DeadSet(std::span<const Folder::Key> locked, const JournalFile& own, const Patience& patience)
      : locked_(locked), own_(own), patience_(patience) {}

  /// Takes the journal in this folder, and those in the other folders of the set. False where the set isn't
  /// to be touched now.
  bool take(Folder& folder, JournalFile file) {
    auto journal = file.read();
    if (!journal) {
      return false;
    }
    Share& share = shares_.emplace_back(Share{{}, {}, &folder, std::move(file), std::move(*journal)});
    for (const Sibling& sibling : share.journal.siblings) {
      if (!take_sibling(folder, sibling)) {
        return false;
      }
    }
    return true;
  }

  LeftBehind clear() {
    std::vector<FolderShare> set;
    Decision decision = Decision::none;
    for (Share& share : shares_) {
      set.push_back({share.folder, &share.file, &share.journal});
      decision = std::max(decision, share.journal.decision);
    }
    LeftBehind found;
    found.runs = 1;
    bool settled = true;
    if (decision == Decision::forward) {
      settled = go_forward(set, found);
    } else if (decision == Decision::back) {
      settled = note(put_back(set), found);
    }
    if (!settled) {
      return {};  // the hidden files may be all that is left of what stood there
    }
    found.files = remove_hidden(set);
    return found;
  }

 private:
  struct Share {
    std::unique_ptr<Folder> opened;  ///< what `folder` points to, unless somebody else has opened it
    std::optional<FolderLock> lock;  ///< of that
    Folder* folder;
    JournalFile file;
    SetJournal journal;
  };

  /// False where the hidden files must stay for another try.
  static bool note(PutBack done, LeftBehind& found) {
    found.put_back = done.restored > 0 && done.kept.empty() ? 1 : 0;
    found.kept = std::move(done.kept);
    return done.failed.empty();
  }

  /// The same. Where somebody has changed a file since, none is touched.
  static bool go_forward(std::span<const FolderShare> set, LeftBehind& found) {
    auto changed = changed_since(set);
    if (!changed.empty()) {
      if (is_incomplete(set)) {
        found.changed = std::move(changed);
      }
      return true;
    }
    const bool whole = is_in_place(set);
    if (auto failure = put_in_place(set)) {
      return note(std::move(failure->before), found);
    }
    // A page that can't be removed now is found again by a run of the same model, which tells of it.
    remove_leftovers(set);
    found.completed = whole ? 0 : 1;
    return true;
  }

  /// True also where there is nothing to take. A folder that can't be reached may hold another decision, so
  /// the set waits for it, but not longer than for runs whose end can't be seen.
  bool take_sibling(const Folder& folder, const Sibling& sibling) {
    auto opened = folder.open_beside(sibling.path);
    if (!opened) {
      return shares_.front().file.has_rested(own_);
    }
    auto place = std::make_unique<Folder>(std::move(*opened));
    std::optional<FolderLock> lock;
    if (std::find(locked_.begin(), locked_.end(), place->key()) == locked_.end()) {
      auto taken = FolderLock::take(*place, patience_);
      if (!taken) {
        return false;
      }
      lock.emplace(std::move(*taken));
    }
    JournalFile::Found found = JournalFile::find(*place, sibling.id, own_);
    if (!found.journal) {
      return found.fate == JournalFile::Fate::unknown;
    }
    auto journal = found.journal->read();
    if (!journal) {
      return false;
    }
    Folder* const there = place.get();
    shares_.push_back(
        {std::move(place), std::move(lock), there, std::move(*found.journal), std::move(*journal)});
    return true;
  }

  std::span<const Folder::Key> locked_;
  const JournalFile& own_;
  Patience patience_;
  std::list<Share> shares_;
};

/// The ids of all hidden files in the folder.
std::set<RunId> runs_in(const Folder& folder) {
  std::set<RunId> runs;
  for (const std::string& name : folder.names()) {
    if (const auto run = run_of(name)) {
      runs.insert(*run);
    }
  }
  return runs;
}

/// Without a journal nothing tells what the files were for; the run that made them has ended, since its
/// journal is the last that goes.
LeftBehind remove_orphans(Folder& folder, const RunId& run, uid_t owner) {
  LeftBehind found;
  for (const std::string& name : hidden_files(folder, run)) {
    if (folder.is_file_of(name, owner) && folder.remove(name) == 0) {
      ++found.files;
    }
  }
  found.runs = found.files > 0 ? 1 : 0;
  return found;
}

}  // namespace

LeftBehind& LeftBehind::operator+=(const LeftBehind& other) {
  runs += other.runs;
  files += other.files;
  completed += other.completed;
  put_back += other.put_back;
  kept.insert(kept.end(), other.kept.begin(), other.kept.end());
  changed.insert(changed.end(), other.changed.begin(), other.changed.end());
  return *this;
}

std::string sentence(const LeftBehind& found, const std::filesystem::path& folder) {
  if (found.files == 0) {
    return {};
  }
  std::string text =
      found.runs > 1 ? std::to_string(found.runs) + " runs that were killed" : "a run that was killed";
  const std::string place = folder.lexically_normal().string();
  text += " had left " + counted(found.files, "hidden file") + " in " +
          (place == "." ? "the current folder" : place);
  text += found.files == 1 ? ", removed now" : ", all removed now";
  if (found.completed > 0) {
    text += ", and finished files that weren't all in place: they are now";
  }
  if (found.put_back > 0) {
    text += ", and had replaced some files of a set only: they are as before";
  }
  if (!found.kept.empty()) {
    text += ", and had replaced some files of a set only: " + names_and(found.kept, "is", "are") +
            " new and can't be put back";
  }
  if (!found.changed.empty()) {
    text += ", and hadn't put all files of a set in place, which stays so: " +
            names_and(found.changed, "was", "were") + " changed since";
  }
  return text;
}

LeftBehind clear_left_behind(Folder& folder, const JournalFile& own, std::span<const Folder::Key> locked,
                             const Patience& patience) {
  LeftBehind found;
  for (const RunId& run : runs_in(folder)) {
    JournalFile::Found dead = JournalFile::find(folder, run, own);
    if (dead.fate == JournalFile::Fate::unknown) {
      found += remove_orphans(folder, run, own.owner());
    } else if (dead.fate == JournalFile::Fate::dead) {
      DeadSet set(locked, own, patience);
      if (set.take(folder, std::move(*dead.journal))) {
        found += set.clear();
      }
    }
  }
  return found;
}

}  // namespace ridgecraft::cli
