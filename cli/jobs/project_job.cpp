// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/project_job.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include <stdlib.h>

#include "base/error.hpp"
#include "base/option_table.hpp"
#include "cli/arguments/parse.hpp"
#include "cli/arguments/verbs.hpp"
#include "cli/files/formats.hpp"
#include "cli/files/model_files.hpp"
#include "mesh/reading/files.hpp"

namespace ridgecraft::cli {
namespace {

namespace fs = std::filesystem;

/// A page is mailed: one with a larger model in it isn't.
constexpr std::size_t largest_in_page = std::size_t{32} << 20U;

/// A project, or why it can't be written.
struct Collected {
  session::ProjectFile project;
  std::optional<std::string> fault;

  void add(const fs::path& file, std::string bytes) {
    const std::string name = file.filename().string();
    const auto [there, is_new] = project.files.emplace(name, std::move(bytes));
    if (!is_new && there->second != mesh::read_file(file)) {
      fault = "a project can't hold two files that are called '" + name + "': rename one of them";
    }
  }
};

Collected project_for(const MakeJob& job, const job::Result& made) {
  Collected collected;
  session::ProjectFile& project = collected.project;
  const fs::path model(job.model);
  project.model = model.filename().string();
  project.words = job.words;
  project.edits = made.edits;
  project.digest = made.mark.digest;
  const std::string bytes = mesh::read_file(model);
  for (const fs::path& file : files_of_model(model)) {
    collected.add(file, mesh::read_file(file));
  }
  for (const std::string& file : {job.edges.cuts, job.edges.keep, job.edges.from, job.tab_file}) {
    if (!file.empty()) {
      collected.add(file, mesh::read_file(file));
    }
  }
  collected.add(model, bytes);
  if (!collected.fault) {
    collected.fault = session::why_no_project(project);
  }
  return collected;
}

/// "--size" of "--size=20cm"
std::string_view option_of(std::string_view word) {
  return word.substr(0, word.find('='));
}

/// The project's words, with files where they lie now.
std::vector<std::string> words_of(const session::ProjectFile& project, const fs::path& folder) {
  std::vector<std::string> words = project.words;
  for (std::string& word : words) {
    if (option_row(option_of(word).substr(2)).kind == OptionKind::file) {
      const std::size_t name = word.find('=') + 1;
      word = word.substr(0, name) + (folder / fs::path(word.substr(name)).filename()).string();
    }
  }
  return words;
}

}  // namespace

std::string project_bytes(const MakeJob& job, const job::Result& made) {
  if (job.model == "-") {
    throw Error(ErrorKind::usage, "a project holds the model's file, and standard input is none");
  }
  Collected collected = project_for(job, made);
  collected.project.nets = made.fold;
  if (collected.fault) {
    throw Error(ErrorKind::usage, *collected.fault);
  }
  return session::write_project(collected.project);
}

std::string with_project(std::string page, const MakeJob& job, const job::Result& made) {
  std::error_code error;
  if (job.model == "-" || fs::file_size(job.model, error) > largest_in_page || error) {
    return page;
  }
  const Collected collected = project_for(job, made);
  return collected.fault
             ? page
             : session::page_with_project(std::move(page), session::write_project(collected.project));
}

UnpackedProject::Folder::Folder() {
  std::string folder = (fs::temp_directory_path() / "ridgecraft-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) {
    throw Error(ErrorKind::cant_write, "can't make a folder for the files of a project");
  }
  path = folder;
}

UnpackedProject::Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

UnpackedProject::UnpackedProject(session::ProjectFile project) : project_(std::move(project)) {
  for (const auto& [name, bytes] : project_.files) {
    std::ofstream out(folder_.path / name, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!out.flush()) {
      throw Error(ErrorKind::cant_write, "can't write " + (folder_.path / name).string());
    }
  }
}

MakeJob UnpackedProject::job(const MakeJob& asked, const std::vector<std::string>& words) const {
  std::vector<std::string> all;
  std::ranges::copy_if(
      words_of(project_, folder_.path), std::back_inserter(all), [&](const std::string& word) {
        return std::ranges::none_of(
            asked.words, [&](const std::string& own) { return option_of(own) == option_of(word); });
      });
  all.insert(all.end(), words.begin(), words.end());
  auto job = std::get<MakeJob>(parse_arguments(all));
  job.model = (folder_.path / project_.model).string();
  job.edits = project_.edits;
  job.project = asked.model;
  return job;
}

std::optional<session::ProjectFile> project_of(const MakeJob& job) {
  constexpr std::array<std::string_view, 3> suffixes{".ridgecraft", ".html", ".htm"};
  if (std::find(suffixes.begin(), suffixes.end(), suffix_of(job.model)) == suffixes.end()) {
    return std::nullopt;
  }
  const std::string bytes = mesh::read_file(job.model);
  return session::holds_project(bytes) ? std::optional(session::read_project(job.model, bytes))
                                       : std::nullopt;
}

}  // namespace ridgecraft::cli
