// SPDX-License-Identifier: GPL-3.0-or-later
// A journal on the disk: it tells whether its run still lives, and what it was about to do.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include <sys/types.h>

#include "cli/files/set/folder.hpp"
#include "cli/files/set/set_journal.hpp"
#include "cli/files/set/temporary_names.hpp"

namespace ridgecraft::cli {

/// A hidden file that its run keeps locked (flock) as long as it lives: the system takes the lock back when
/// the process ends, however it ends. Stands in the folder as long as other hidden files of that id do.
class JournalFile {
 public:
  /// A new one under an id that nobody has. The folder's lock must be held, so that nobody sees the file
  /// before it is locked itself. Nothing where no file can be made; errno tells why. The folder must outlive
  /// it.
  [[nodiscard]] static std::optional<JournalFile> create(Folder& folder);

  /// What became of the run of another journal.
  enum class Fate {
    alive,    ///< or perhaps so, or another user's: hands off
    dead,     ///< the journal is in our hands, and locked
    unknown,  ///< there is no journal of that id (any more)
  };
  struct Found;
  /// Looks into the journal of another run. Locks tell of the life of a run only under the same kernel: of
  /// others (and where there are no locks) it counts as dead after an hour of rest, measured from the making
  /// of `own`. Only journals of the same user as `own` are touched.
  [[nodiscard]] static Found find(Folder& folder, const RunId& id, const JournalFile& own);

  /// True for the journal of a dead run that nobody has written for an hour before `own` was made.
  [[nodiscard]] bool has_rested(const JournalFile& own) const;

  [[nodiscard]] const RunId& id() const { return id_; }
  /// As the file system tells it, which may call root somebody else.
  [[nodiscard]] uid_t owner() const { return owner_; }

  /// Each waits until the disk has it. 0, or the system's error number.
  [[nodiscard]] int write(const SetJournal& journal);
  [[nodiscard]] int decide(Decision decision);
  /// What stands in it: parse_journal.
  [[nodiscard]] std::optional<SetJournal> read() const;
  /// The last file of the id that goes.
  void remove();

 private:
  JournalFile(Folder& folder, Descriptor file, RunId id);

  Folder* folder_;
  Descriptor file_;
  RunId id_;
  uid_t owner_ = 0;
  std::int64_t changed_ns_ = 0;  ///< when it was opened
};

struct JournalFile::Found {
  Fate fate = Fate::alive;
  std::optional<JournalFile> journal;  ///< of a dead run
};

/// The hidden files of an id that stand in the folder, but its journal.
[[nodiscard]] std::set<std::string> hidden_files(const Folder& folder, const RunId& id);

}  // namespace ridgecraft::cli
