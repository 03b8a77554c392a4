// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/set/journal_file.hpp"

#include <array>
#include <cerrno>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace ridgecraft::cli {
namespace {

/// Hidden files stand from the first byte written until the last file is renamed: seconds, minutes where a
/// network is slow.
constexpr std::int64_t surely_dead_ns = std::int64_t{3600} * 1'000'000'000;

/// Random names don't meet; what makes a try fail is a file system that does odd things.
constexpr int most_tries = 16;

enum class Locked { yes, by_another, impossible };

Locked lock(const Descriptor& file) {
  while (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EINTR) {
      return errno == EWOULDBLOCK ? Locked::by_another : Locked::impossible;
    }
  }
  return Locked::yes;
}

}  // namespace

JournalFile::JournalFile(Folder& folder, Descriptor file, RunId id)
    : folder_(&folder), file_(std::move(file)), id_(std::move(id)) {
  struct stat status {};
  if (::fstat(file_.number(), &status) == 0) {
    owner_ = status.st_uid;
  }
  if (const auto state = folder.state(journal_name(id_))) {
    changed_ns_ = state->changed_ns;
  }
}

std::optional<JournalFile> JournalFile::create(Folder& folder) {
  std::string_view kernel = this_kernel();
  for (int i = 0; i < most_tries; ++i) {
    RunId id = new_run_id(kernel);
    const std::string name = journal_name(id);
    Descriptor file = folder.create(name, 0600);
    if (!file.is_open()) {
      if (errno == EEXIST) {
        continue;
      }
      return std::nullopt;
    }
    const Locked locked = lock(file);
    if (locked == Locked::impossible && kernel != unknown_kernel) {
      folder.remove(name);
      kernel = unknown_kernel;
      continue;
    }
    // Where the folder can't be locked, somebody may have been quicker, and taken it for a dead run's.
    if (locked != Locked::by_another && folder.is_named(name, file)) {
      return JournalFile(folder, std::move(file), std::move(id));
    }
  }
  errno = EEXIST;
  return std::nullopt;
}

JournalFile::Found JournalFile::find(Folder& folder, const RunId& id, const JournalFile& own) {
  const std::string name = journal_name(id);
  if (id == own.id_) {
    return {};
  }
  Descriptor file = folder.open_file(name, O_RDWR);
  if (!file.is_open()) {
    return {errno == ENOENT ? Fate::unknown : Fate::alive, std::nullopt};
  }
  if (!folder.is_file_of(name, own.owner_)) {
    return {};
  }
  const Locked locked = lock(file);
  if (locked == Locked::by_another) {
    return {};
  }
  JournalFile journal(folder, std::move(file), id);
  const bool lock_tells =
      locked == Locked::yes && kernel_of(id) == this_kernel() && this_kernel() != unknown_kernel;
  if (!lock_tells && !journal.has_rested(own)) {
    return {};
  }
  if (!folder.is_named(name, journal.file_)) {
    return {Fate::unknown, std::nullopt};
  }
  return {Fate::dead, std::move(journal)};
}

bool JournalFile::has_rested(const JournalFile& own) const {
  return own.changed_ns_ - changed_ns_ >= surely_dead_ns;
}

int JournalFile::write(const SetJournal& journal) {
  return folder_->append_durably(file_, listing(journal));
}

int JournalFile::decide(Decision decision) {
  return folder_->append_durably(file_, decision_line(decision));
}

std::optional<SetJournal> JournalFile::read() const {
  std::string text;
  std::array<char, 4096> bytes{};
  for (;;) {
    const ssize_t length =
        ::pread(file_.number(), bytes.data(), bytes.size(), static_cast<off_t>(text.size()));
    if (length < 0) {
      return std::nullopt;
    }
    if (length == 0) {
      return parse_journal(text);
    }
    text.append(bytes.data(), static_cast<std::size_t>(length));
  }
}

void JournalFile::remove() {
  folder_->remove(journal_name(id_));
}

std::set<std::string> hidden_files(const Folder& folder, const RunId& id) {
  std::set<std::string> files;
  for (std::string& name : folder.names()) {
    if (run_of(name) == id && name != journal_name(id)) {
      files.insert(std::move(name));
    }
  }
  return files;
}

}  // namespace ridgecraft::cli
