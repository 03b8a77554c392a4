// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/targets.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

#include <unistd.h>

#include "base/error.hpp"
#include "export/export.hpp"

namespace ridgecraft::cli {
namespace {

namespace fs = std::filesystem;

bool is_folder(const std::string& text) {
  std::error_code error;
  return text.ends_with('/') || fs::is_directory(text, error) || fs::path(text).extension().empty();
}

/// Larger than anything that this program writes.
constexpr std::uintmax_t largest_own_file = std::uintmax_t{1} << 31U;

/// The first bytes of a file; fewer where it is shorter or can't be read.
std::string first_bytes(const fs::path& file, std::uintmax_t count) {
  std::string bytes(static_cast<std::size_t>(count), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

/// Nothing where it can't be read or is none of ours by its size.
std::string bytes_of(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  return error || size > largest_own_file ? std::string() : first_bytes(file, size);
}

std::string mark_digest_of(const fs::path& file) {
  return export_::read_mark_digest(bytes_of(file));
}

/// As XML has it.
std::string with_quotes_escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '"') {
      escaped += "&quot;";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

/// n of "stem-n.svg", 0 for "stem.svg", nothing for another name.
std::optional<std::size_t> number_in(const std::string& name, const NumberedFiles& names) {
  const auto& [folder, stem, ending] = names;
  if (!name.starts_with(stem) || !name.ends_with(ending) || name.size() < stem.size() + ending.size()) {
    return std::nullopt;
  }
  const std::string middle = name.substr(stem.size(), name.size() - stem.size() - ending.size());
  if (middle.empty()) {
    return 0;
  }
  if (middle.size() < 2 || middle.size() > 7 || middle[0] != '-' || middle[1] == '0' ||
      !std::all_of(middle.begin() + 1, middle.end(), [](char c) { return c >= '0' && c <= '9'; })) {
    return std::nullopt;
  }
  return std::stoul(middle.substr(1));
}

Shows shown_in(Format format, const export_::Preset& preset) {
  if (for_machines_alone(format) || (format == Format::svg && preset.is_machine()) ||
      (format == Format::pdf && preset.pdf)) {
    return Shows::cut;
  }
  return format == Format::html ? Shows::page : Shows::sheets;
}

}  // namespace

void require_no_dash(const std::string& option, const std::string& output) {
  if (output == "-") {
    throw Error(ErrorKind::usage, option +
                                      " -: results are written into files only, never to standard output; "
                                      "name one (./- if it is to be called so)");
  }
}

std::vector<Target> plan_targets(const std::vector<std::string>& outputs, const std::string& model_name,
                                 const export_::Preset& preset, bool page) {
  std::vector<Target> targets;
  const std::string stem = preset.is_machine() ? model_name + "-" + std::string(preset.name) : model_name;
  const auto add_folder = [&](const fs::path& folder) {
    for (const Format format : default_formats(preset)) {
      // Release 12 can't tell the unit, so its files' names do.
      const bool tells_unit = format == Format::dxf && preset.dxf_kind != export_::DxfKind::r2000;
      if (page || format != Format::html) {
        targets.push_back({format, folder, stem, (tells_unit ? "-mm" : "") + std::string(suffix(format)),
                           shown_in(format, preset)});
      }
    }
  };
  if (outputs.empty()) {
    add_folder(".");
  }
  std::set<fs::path> named;
  for (const std::string& output : outputs) {
    require_no_dash("-o", output);
    if (output.empty()) {
      throw Error(ErrorKind::usage, "-o needs a folder or a file");
    }
    const fs::path path(output);
    if (!named.insert(place_of(path.has_filename() ? path : path.parent_path())).second) {
      throw Error(ErrorKind::usage, "-o " + output + " names what another -o names: give each once");
    }
    if (is_folder(output)) {
      add_folder(path);
    } else if (const auto format = paper_format(suffix_of(path))) {
      if (!page && *format == Format::html) {
        throw Error(ErrorKind::usage, "-o " + output + " names a page, and --no-page wants none");
      }
      targets.push_back({*format, path.has_parent_path() ? path.parent_path() : fs::path("."),
                         path.stem().string(), path.extension().string(), shown_in(*format, preset)});
    } else {
      throw Error(ErrorKind::usage, "-o " + output + ": '" + path.extension().string() +
                                        "' is no format that can be written; " + paper_suffixes() + " are");
    }
  }
  std::vector<Target> different;
  std::set<fs::path> places;
  for (Target& target : targets) {
    target.folder = (target.folder / "").lexically_normal();
    if (places.insert(place_of(target.folder / (target.stem + target.ending))).second) {
      require_writable_folder(target.folder);
      different.push_back(target);
    }
  }
  return different;
}

std::vector<Target> plan_print_and_cut(const std::vector<std::string>& outputs, const std::string& model_name,
                                       const export_::Preset& preset) {
  std::vector<Target> targets = plan_targets(outputs, model_name, preset);
  const std::string stem = model_name + "-" + std::string(preset.name);
  std::vector<Target> prints;
  for (Target& target : targets) {
    if (target.stem == stem) {
      target.stem += "-cut";
      Target print{Format::pdf, target.folder, stem + "-print", suffix(Format::pdf), Shows::print};
      if (std::ranges::find(prints, print) == prints.end()) {
        prints.push_back(std::move(print));
      }
    } else if (target.format == Format::pdf) {
      target.shows = Shows::print;
    }
  }
  targets.insert(targets.begin(), prints.begin(), prints.end());
  return targets;
}

Target guide_beside(const Target& pdf) {
  Target guide = pdf;
  guide.stem += "-guide";
  guide.shows = Shows::guide;
  return guide;
}

void add_guides(std::vector<Target>& targets) {
  constexpr std::size_t longest_name = 255;  // bytes
  const std::size_t count = targets.size();
  for (std::size_t i = 0; i < count; ++i) {
    Target guide = guide_beside(targets[i]);
    if (guide.format != Format::pdf || guide.stem.size() + guide.ending.size() > longest_name) {
      continue;
    }
    const fs::path place = place_of(guide.folder / (guide.stem + guide.ending));
    for (std::size_t k = 0; k < count; ++k) {
      if (place_of(targets[k].folder / (targets[k].stem + targets[k].ending)) == place) {
        throw Error(ErrorKind::usage, "-o " + place.filename().string() + ": the guide of " +
                                          targets[i].stem + targets[i].ending +
                                          " has that name; --no-guide leaves it out");
      }
    }
    targets.push_back(std::move(guide));
  }
}

fs::path place_of(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code error;
  fs::path place = fs::weakly_canonical(fs::absolute(folder, error), error);
  if (error) {
    place = folder.lexically_normal();
  }
  return place / file.filename();
}

bool has_file_of_all(const Target& target) {
  return target.format == Format::svg && target.shows == Shows::sheets;
}

std::vector<fs::path> files_of(const Target& target, std::size_t pages) {
  if (!one_file_per_page(target.format) || pages == 1) {
    return {target.folder / (target.stem + target.ending)};
  }
  std::vector<fs::path> files;
  for (std::size_t page = 1; page <= pages; ++page) {
    files.push_back(target.folder / (target.stem + "-" + std::to_string(page) + target.ending));
  }
  if (has_file_of_all(target)) {
    files.push_back(target.folder / (target.stem + target.ending));
  }
  return files;
}

std::set<std::string> digests_of(const std::vector<fs::path>& files) {
  std::set<std::string> digests;
  for (const fs::path& file : files) {
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored)) {
      digests.insert(mark_digest_of(file));
    }
  }
  digests.erase("");
  return digests;
}

std::vector<fs::path> leftovers_of(const NumberedFiles& names, const std::set<fs::path>& written,
                                   const std::set<std::string>& digests) {
  std::vector<fs::path> leftovers;
  std::error_code error;
  const fs::path folder = names.folder.empty() ? fs::path(".") : names.folder;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path file = names.folder / entry->path().filename();
    std::error_code ignored;
    if (number_in(file.filename().string(), names) && !written.contains(file) &&
        entry->is_regular_file(ignored) && digests.contains(mark_digest_of(file))) {
      leftovers.push_back(file);
    }
  }
  std::sort(leftovers.begin(), leftovers.end());
  return leftovers;
}

bool tells_other_settings(const fs::path& file, const export_::Settings& settings) {
  const std::string bytes = bytes_of(file);
  const std::string json = export_::settings_json(settings);
  const auto holds = [&](std::string_view text) {
    return bytes.find(text) != std::string::npos ||
           bytes.find(with_quotes_escaped(text)) != std::string::npos;
  };
  return holds("\"concavity\": ") && !holds(json);
}

void require_replaceable(const fs::path& file, const std::string& digest, bool overwrite) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) {
    // A link that leads nowhere is somebody's all the same.
    if (!overwrite && fs::is_symlink(fs::symlink_status(file, error))) {
      throw Error(ErrorKind::cant_write, file.lexically_normal().string() +
                                             " is a link that leads to no file; --overwrite replaces it");
    }
    return;
  }
  if (!fs::is_regular_file(status)) {
    throw Error(ErrorKind::cant_write, file.lexically_normal().string() + " exists and is no regular file");
  }
  if (!overwrite && (digest.empty() || mark_digest_of(file) != digest)) {
    throw Error(ErrorKind::cant_write,
                file.lexically_normal().string() +
                    " exists and wasn't made from this model; --overwrite replaces it");
  }
}

void require_no_input(const fs::path& output, const std::vector<InputFile>& inputs, bool overwrite) {
  if (overwrite) {
    return;
  }
  const fs::path place = place_of(output);
  for (const InputFile& input : inputs) {
    std::error_code error;
    // What is written replaces a link by this name, but also the file that another link leads to.
    if (!input.file.empty() && (place == place_of(input.file) || place == fs::canonical(input.file, error))) {
      throw Error(ErrorKind::cant_write, output.lexically_normal().string() + " is read by " + input.option +
                                             ": name another output with -o, or --overwrite replaces it");
    }
  }
}

bool holds(const fs::path& file, const std::string& bytes) {
  std::error_code error;
  if (fs::file_size(file, error) != bytes.size() || error) {
    return false;
  }
  return first_bytes(file, bytes.size()) == bytes;
}

void require_writable_folder(const fs::path& folder) {
  std::error_code error;
  fs::path existing = folder.empty() ? fs::path(".") : folder;
  while (!fs::exists(existing, error) && existing.has_parent_path() && existing.parent_path() != existing) {
    existing = existing.parent_path();
  }
  if (!fs::exists(existing, error)) {
    existing = ".";
  }
  if (!fs::is_directory(existing, error)) {
    throw Error(ErrorKind::cant_write, existing.string() + " is no folder");
  }
  if (::access(existing.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorKind::cant_write,
                "can't write into the folder " + existing.string() + ": " + std::strerror(errno));
  }
}

}  // namespace ridgecraft::cli
