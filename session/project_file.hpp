// SPDX-License-Identifier: GPL-3.0-or-later
// A project as a file: NAME.ridgecraft, a ZIP archive, which a page for browsers (NAME.html) holds, too.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ridgecraft::session {

/// What it takes to make the same paper again, byte for byte.
struct ProjectFile {
  std::string model;                         ///< name of the model's file
  std::map<std::string, std::string> files;  ///< bytes by name: it, its materials and pictures, edges, tabs
  std::vector<std::string> words;            ///< options, as words of a command line
  std::string edits;                         ///< what was done by hand, a step a line (edit.hpp)
  std::string nets;    ///< bytes of the FOLD file that came of it, for other programs; may be empty
  std::string digest;  ///< of the model, as files are marked with it (export/sheet/mark.hpp)
};

/// A sentence that says why a project can't be written, or couldn't be read then: a name of a file, or how
/// large it is. None where it can.
[[nodiscard]] std::optional<std::string> why_no_project(const ProjectFile& project);

/// Whether an option is about a run and its files ("output"), not about the paper: projects have none such.
[[nodiscard]] bool is_of_run(std::string_view option);

/// The bytes of the archive, the same for equal projects, one that can be written. O(n).
[[nodiscard]] std::string write_project(const ProjectFile& project);

/// Whether these bytes are a project, or a page that holds one.
[[nodiscard]] bool holds_project(std::string_view bytes);

/// `file` is what messages call it. Names of files in it are plain: none leads into a folder; its
/// words are options that are known and not of a run: a file of somebody else's may say nothing of where
/// results go. Throws
/// Error(unreadable_input). O(n).
[[nodiscard]] ProjectFile read_project(const std::string& file, std::string_view bytes);

/// The page of a result with the project that it was made from. O(n).
[[nodiscard]] std::string page_with_project(std::string page, std::string_view project);

}  // namespace ridgecraft::session
