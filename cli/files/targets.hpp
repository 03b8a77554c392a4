// SPDX-License-Identifier: GPL-3.0-or-later
// Where results go: from what the user wrote after -o to the names of files, and whether they may be
// replaced.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "cli/files/formats.hpp"

namespace ridgecraft::cli {

/// What somebody finds in a file.
enum class Shows {
  sheets,  ///< nets, as they are printed or as programs read them
  cut,     ///< what a machine does
  print,   ///< what is printed on sheets that a machine cuts afterwards
  guide,   ///< how the model is built, on pages that have no nets
  page,    ///< all of it, in a browser
};

/// One format of one result. Formats with a file per page (SVG, PNG) number the files when there are several
/// pages.
struct Target {
  Format format;
  std::filesystem::path folder;  ///< lexically normal
  std::string stem;
  std::string ending;  ///< ".pdf" or as the user wrote it, ".PDF"
  Shows shows = Shows::sheets;

  friend bool operator==(const Target&, const Target&) = default;
};

/// Refuses - after an option that names a result ("--labels"): Error(usage).
void require_no_dash(const std::string& option, const std::string& output);

/// What -o asks for; without any, all default formats in the current folder (PDF, SVG, FOLD and, unless
/// `page` says otherwise, HTML; or those of the preset, whose name the files bear). Folders that are asked
/// for and don't exist are created when files are written. Throws Error(usage) for a suffix that is no format
/// and for HTML that `page` excludes, Error(cant_write) for a folder that can't be written to.
[[nodiscard]] std::vector<Target> plan_targets(const std::vector<std::string>& outputs,
                                               const std::string& model_name,
                                               const export_::Preset& preset = {}, bool page = true);

/// For sheets that are printed and cut: what -o asks for of machine files as NAME-PRESET-cut, in the same
/// folders NAME-PRESET-print.pdf. Files that -o names keep their names.
[[nodiscard]] std::vector<Target> plan_print_and_cut(const std::vector<std::string>& outputs,
                                                     const std::string& model_name,
                                                     const export_::Preset& preset);

/// The guide beside a PDF of nets: NAME-guide.pdf.
[[nodiscard]] Target guide_beside(const Target& pdf);
/// Adds one for each PDF, but where its name would be longer than file systems allow. Throws Error(usage)
/// where another result has that name.
void add_guides(std::vector<Target>& targets);

/// The same for all names of one place in the file system: the folder without links, dots and the like. A
/// link as last name stays, since a file that is written replaces it.
[[nodiscard]] std::filesystem::path place_of(const std::filesystem::path& file);

/// Whether several pages also come as one file of all, under the name that a single page would have: SVG of
/// sheets, for Inkscape. Machines cut one sheet at a time, and several beside each other are larger than
/// their beds.
[[nodiscard]] bool has_file_of_all(const Target& target);

/// The files of a target: one, or for SVG and PNG one per page, and after them that of all pages.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const Target& target, std::size_t pages);

/// The models (digests) of those of these files that exist and that this program made.
[[nodiscard]] std::set<std::string> digests_of(const std::vector<std::filesystem::path>& files);

/// Files of one set, as many as the model asks for: "whale.svg", "whale-1.svg", "whale-2.svg", ...
struct NumberedFiles {
  std::filesystem::path folder;
  std::string stem;    ///< "whale"
  std::string ending;  ///< ".svg"
};

/// Files of such names that this program made of one of these models (digests), and that this run doesn't
/// write again.
[[nodiscard]] std::vector<std::filesystem::path> leftovers_of(const NumberedFiles& names,
                                                              const std::set<std::filesystem::path>& written,
                                                              const std::set<std::string>& digests);

/// Whether a file of ours says that it was made by other options than these; not where it says nothing of
/// them.
[[nodiscard]] bool tells_other_settings(const std::filesystem::path& file, const export_::Settings& settings);

/// Throws Error(cant_write) unless the file doesn't exist, or this program made it for the same model, or
/// `overwrite` is set and it is a regular file. A link is as the file that it leads to; one that leads to
/// none needs `overwrite`.
void require_replaceable(const std::filesystem::path& file, const std::string& digest, bool overwrite);

/// A file that a job reads besides the model, and the option that names it.
struct InputFile {
  std::string option;
  std::filesystem::path file;
};

/// Throws Error(cant_write) where a result would replace one of these files, marked as ours or not: it may
/// hold somebody's work by now. `overwrite` allows it. Files without a name are passed over.
void require_no_input(const std::filesystem::path& output, const std::vector<InputFile>& inputs,
                      bool overwrite);

/// True where the file exists and holds just these bytes.
[[nodiscard]] bool holds(const std::filesystem::path& file, const std::string& bytes);

/// Throws Error(cant_write) unless the file's folder exists (or can be created) and can be written to.
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace ridgecraft::cli
