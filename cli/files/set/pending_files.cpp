// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/set/pending_files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.hpp"
#include "cli/files/set/file_set.hpp"

namespace ridgecraft::cli {
namespace {

namespace fs = std::filesystem;

/// For the lock of another folder in which a killed run has left files, while folders are locked already.
constexpr std::chrono::milliseconds short_wait{1000};

/// A folder may vanish between its opening and the first file in it, when another run had made it and has
/// nothing to put there after all. That won't happen often in a row.
constexpr int most_vanished_folders = 20;

[[noreturn]] void refuse(const fs::path& target, int error, const std::string& more = {}) {
  throw Error(ErrorKind::cant_write,
              "can't write " + target.lexically_normal().string() + ": " + std::strerror(error) + more);
}

[[noreturn]] void refuse(const Failure& failure) {
  std::vector<fs::path> stay = failure.before.kept;
  stay.insert(stay.end(), failure.before.failed.begin(), failure.before.failed.end());
  refuse(failure.target, failure.error,
         stay.empty() ? "" : "; " + names_and(stay, "is", "are") + " new already and couldn't be put back");
}

/// The path by which the folder is found from the other one, if there is any. Above both a folder may be
/// closed to the user: then the paths by which they were opened tell.
std::optional<fs::path> path_between(const Folder& from, const Folder& to) {
  std::error_code error;
  for (const fs::path& path :
       {fs::relative(to.path(), from.path(), error), to.path().lexically_relative(from.path())}) {
    const auto found = path.empty() ? std::nullopt : from.open_beside(path);
    if (found && found->key() == to.key()) {
      return path;
    }
  }
  return std::nullopt;
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

}  // namespace

void PendingFiles::add(const fs::path& target, std::string_view bytes) {
  const std::lock_guard guard(mutex_);
  require_open();
  write_part(place_for(target), target, bytes);
}

void PendingFiles::require_open() const {
  if (closed_) {
    throw Error(ErrorKind::interrupted, "interrupted; nothing was written");
  }
}

void PendingFiles::create_folder(const fs::path& folder) {
  fs::path so_far;
  for (const fs::path& name : folder) {
    so_far /= name;
    std::error_code error;
    if (name.empty() || fs::is_directory(so_far, error)) {
      continue;
    }
    if (setup_.before_step) {
      setup_.before_step("mkdir");
    }
    if (::mkdir(so_far.c_str(), 0777) == 0) {
      folders_.push_back(so_far);
      if (auto around = Folder::open(folder_of(so_far), setup_.before_step)) {
        around->sync();  // or a power failure takes the folder, with files in it that the disk has
      }
      continue;
    }
    const int reason = errno;
    const fs::file_type there = fs::symlink_status(so_far, error).type();
    if (reason == ENOENT || (reason == EEXIST && there == fs::file_type::not_found)) {
      return;  // another run has just removed it, or the folder around it; place_for tries again
    }
    if (reason != EEXIST || !fs::is_directory(so_far, error)) {
      throw Error(ErrorKind::cant_write,
                  "can't create the folder " + so_far.string() + ": " + std::strerror(reason));
    }
  }
}

PendingFiles::Place* PendingFiles::known_place(const Folder& folder) {
  const auto place = std::find_if(places_.begin(), places_.end(),
                                  [&](const Place& p) { return p.folder->key() == folder.key(); });
  return place == places_.end() ? nullptr : &*place;
}

PendingFiles::Place& PendingFiles::place_for(const fs::path& target) {
  for (int tries = 1;; ++tries) {
    create_folder(target.parent_path());
    std::optional<Folder> folder = Folder::open(folder_of(target), setup_.before_step);
    int error = errno;
    if (folder) {
      if (Place* const place = known_place(*folder)) {
        return *place;
      }
      error = open_place(std::move(*folder));
      if (error == 0) {
        return places_.back();
      }
    }
    if (error != ENOENT || tries == most_vanished_folders) {
      refuse(target, error);
    }
  }
}

/// Makes the run known in the folder. What others have left goes now, since it may be what fills the disk.
int PendingFiles::open_place(Folder folder) {
  auto opened = std::make_unique<Folder>(std::move(folder));
  const FolderLock held = lock(*opened);
  auto file = JournalFile::create(*opened);
  if (!file) {
    return errno;
  }
  places_.push_back({std::move(opened), std::move(*file), {}, {}});
  clear_left_behind(places_.back(), held, {places_.back().folder->key()});
  return 0;
}

void PendingFiles::write_part(Place& place, const fs::path& target, std::string_view bytes) {
  Replacement replacement;
  replacement.target = target.filename().string();
  Descriptor part;
  do {
    replacement.number = place.next_number++;
    part = place.folder->create(part_name(place.file.id(), replacement.number), 0666);
  } while (!part.is_open() && errno == EEXIST);
  if (!part.is_open()) {
    refuse(target, errno);
  }
  const std::string name = part_name(place.file.id(), replacement.number);
  const int write_error = place.folder->append_durably(part, bytes);
  const int close_error = part.close();
  const auto state = place.folder->state(name);
  if (write_error != 0 || close_error != 0 || !state) {
    place.folder->remove(name);
    refuse(target, write_error != 0 ? write_error : close_error != 0 ? close_error : ENOENT);
  }
  replacement.after = *state;
  place.journal.replacements.push_back(std::move(replacement));
}

FolderLock PendingFiles::lock(Folder& folder) const {
  auto held = FolderLock::take(folder, {setup_.longest_wait, &cancelled_});
  if (!held) {
    throw Error(ErrorKind::cant_write, "can't write into the folder " + folder.path().string() +
                                           ": another run has been putting files there for " +
                                           std::to_string(setup_.longest_wait.count() / 1000) + " s");
  }
  return std::move(*held);
}

/// In an order that all runs share, so that no two wait for each other.
std::vector<FolderLock> PendingFiles::lock_all() {
  std::vector<Place*> places;
  std::vector<Folder::Key> keys;
  for (Place& place : places_) {
    places.push_back(&place);
    keys.push_back(place.folder->key());
  }
  std::sort(places.begin(), places.end(),
            [](const Place* a, const Place* b) { return a->folder->key() < b->folder->key(); });
  std::vector<FolderLock> locks;
  locks.reserve(places.size());
  for (Place* const place : places) {
    locks.push_back(lock(*place->folder));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    clear_left_behind(*places[i], locks[i], keys);
  }
  return locks;
}

void PendingFiles::clear_left_behind(Place& place, const FolderLock& lock,
                                     const std::vector<Folder::Key>& locked) const {
  LeftBehind found = cli::clear_left_behind(*place.folder, place.file, locked, {short_wait, &cancelled_});
  if (lock.was_left_behind() && place.folder->is_file_of(std::string(lock_name), place.file.owner())) {
    found.runs = std::max<std::size_t>(found.runs, 1);
    ++found.files;
  }
  place.left_behind += found;
}

void PendingFiles::note_removals(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    const std::optional<Folder> folder = Folder::open(folder_of(file), {});
    Place* const place = folder ? known_place(*folder) : nullptr;
    RIDGECRAFT_ASSERT(place != nullptr);
    const std::string name = file.filename().string();
    if (const auto state = place != nullptr ? place->folder->state(name) : std::nullopt) {
      place->journal.removals.push_back({name, *state});
    }
  }
}

/// What is known under the locks only.
void PendingFiles::complete_journals() {
  for (Place& place : places_) {
    for (Replacement& replacement : place.journal.replacements) {
      replacement.before = place.folder->state(replacement.target);
    }
    for (const Place& other : places_) {
      if (&other == &place) {
        continue;
      }
      const auto path = path_between(*place.folder, *other.folder);
      if (!path) {
        // A later run that doesn't find one folder from the other would clear up half of the set.
        throw Error(ErrorKind::cant_write, "can't write into both " + place.folder->path().string() +
                                               " and " + other.folder->path().string() +
                                               ": no path leads from one to the other");
      }
      place.journal.siblings.push_back({path->string(), other.file.id()});
    }
  }
}

std::vector<FolderShare> PendingFiles::shares() {
  std::vector<FolderShare> set;
  for (Place& place : places_) {
    set.push_back({place.folder.get(), &place.file, &place.journal});
  }
  return set;
}

void PendingFiles::note_left_behind() {
  for (Place& place : places_) {
    const LeftBehind found = std::exchange(place.left_behind, {});
    if (std::string note = sentence(found, place.folder->path()); !note.empty()) {
      notes_.push_back(std::move(note));
    }
  }
}

std::vector<std::string> PendingFiles::take_notes() {
  const std::lock_guard guard(mutex_);
  note_left_behind();
  return std::exchange(notes_, {});
}

std::vector<std::string> PendingFiles::commit(const LastLook& look) {
  const std::lock_guard guard(mutex_);
  require_open();
  std::list<Place> done;  // the folders outlive their locks
  const std::vector<FolderLock> locks = lock_all();
  note_left_behind();
  if (look) {
    note_removals(look());
  }
  complete_journals();
  const std::vector<FolderShare> set = shares();
  if (const auto failure = cli::exchange(set)) {
    if (!failure->before.failed.empty()) {
      done.swap(places_);  // the hidden files stay: the next run into the folder tries again
    }
    refuse(*failure);
  }
  committed_ = true;
  std::vector<std::string> notes = std::exchange(notes_, {});
  for (std::string& note : remove_leftovers(set)) {
    notes.push_back(std::move(note));
  }
  remove_hidden(set);
  done.swap(places_);
  folders_.clear();
  return notes;
}

bool PendingFiles::discard() noexcept {
  cancelled_ = true;
  const std::lock_guard guard(mutex_);
  closed_ = true;
  note_left_behind();
  remove_hidden(shares());
  places_.clear();
  for (auto folder = folders_.rbegin(); folder != folders_.rend(); ++folder) {
    ::rmdir(folder->c_str());  // stays where somebody else has put something into it
  }
  folders_.clear();
  return committed_;
}

}  // namespace ridgecraft::cli
