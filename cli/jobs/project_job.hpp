// SPDX-License-Identifier: GPL-3.0-or-later
// Projects: what the main job was given, in one file; and such a file as a job again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/arguments/options.hpp"
#include "job/job.hpp"
#include "session/project_file.hpp"

namespace ridgecraft::cli {

/// The bytes of a project: the job's files are read again. Throws Error(usage) where the model came through
/// standard input, and Error(unreadable_input).
[[nodiscard]] std::string project_bytes(const MakeJob& job, const job::Result& made);

/// A page with the project that it was made from, where the model has a file, and one that a page can hold.
[[nodiscard]] std::string with_project(std::string page, const MakeJob& job, const job::Result& made);

/// The files of a project in a folder of its own, for as long as this value lives.
class UnpackedProject {
 public:
  /// Throws Error(cant_write).
  explicit UnpackedProject(session::ProjectFile project);

  /// The job that these words of a command line ask for, whose MODEL is the project; what they ask for goes
  /// before what the project does. Throws Error(usage).
  [[nodiscard]] MakeJob job(const MakeJob& asked, const std::vector<std::string>& words) const;

 private:
  /// Goes with whoever has it, also where the constructor above throws.
  struct Folder {
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path path;
  };

  Folder folder_;
  session::ProjectFile project_;
};

/// The project that a job names as its model; none where it is a model.
[[nodiscard]] std::optional<session::ProjectFile> project_of(const MakeJob& job);

}  // namespace ridgecraft::cli
