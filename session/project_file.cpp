// SPDX-License-Identifier: GPL-3.0-or-later
#include "session/project_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "base/context.hpp"
#include "base/encodings.hpp"
#include "base/error.hpp"
#include "base/option_table.hpp"
#include "base/text.hpp"
#include "export/export.hpp"
#include "mesh/reading/text_scanner.hpp"
#include "mesh/reading/zip_archive.hpp"
#include "session/edit.hpp"

namespace ridgecraft::session {
namespace {

constexpr std::string_view contents_name = "ridgecraft.json";
constexpr std::string_view nets_name = "nets.fold";
constexpr std::string_view model_folder = "model/";
constexpr std::string_view page_start = R"(<script type="text/plain" id="project">)";
constexpr std::string_view page_nets = R"(<script type="text/plain" id="fold">)";
constexpr std::string_view page_end = "</script>";
/// What a project says of itself has some kilobytes; edits have some ten bytes each.
constexpr std::uint64_t largest_contents = std::uint64_t{1} << 26U;
constexpr std::uint64_t largest_file = std::uint64_t{1} << 31U;
constexpr int newest_version = 1;

// The archive (PKWARE's APPNOTE.TXT, 4.3), dated 1 January 1980.

class ZipText {
 public:
  void add(const std::string& name, std::string_view bytes, bool packed) {
    const std::string deflated = packed ? deflate_raw(bytes) : std::string();
    const std::string_view stored = packed ? std::string_view(deflated) : bytes;
    const auto checksum = static_cast<std::uint32_t>(
        ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
    std::string common;
    // Version 2.0, names in UTF-8, how it is packed, the first day of its calendar, sum and sizes.
    for (const auto& [size, value] : std::array<std::pair<int, std::size_t>, 10>{{{2, 20},
                                                                                  {2, 0x800},
                                                                                  {2, packed ? 8U : 0U},
                                                                                  {2, 0},
                                                                                  {2, 0x21},
                                                                                  {4, checksum},
                                                                                  {4, stored.size()},
                                                                                  {4, bytes.size()},
                                                                                  {2, name.size()},
                                                                                  {2, 0}}}) {
      put(common, size, value);
    }
    directory_ += "PK\x01\x02";
    put(directory_, 2, 20);
    directory_ += common;
    put(directory_, 4, 0);
    put(directory_, 4, 0);
    put(directory_, 2, 0);
    put(directory_, 4, text_.size());
    directory_ += name;
    text_.append("PK\x03\x04").append(common).append(name).append(stored);
    ++count_;
  }

  std::string finish() {
    const std::size_t at = text_.size();
    text_.append(directory_).append("PK\x05\x06");
    put(text_, 4, 0);
    put(text_, 2, count_);
    put(text_, 2, count_);
    put(text_, 4, directory_.size());
    put(text_, 4, at);
    put(text_, 2, 0);
    return std::move(text_);
  }

 private:
  static void put(std::string& into, int size, std::size_t value) {
    for (int i = 0; i < size; ++i) {
      into += static_cast<char>(value >> (8U * static_cast<unsigned>(i)) & 0xffU);
    }
  }

  static std::string deflate_raw(std::string_view bytes) {
    z_stream stream{};
    const int begun = deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL,
                                   Z_DEFAULT_STRATEGY);
    if (begun == Z_MEM_ERROR) {
      throw std::bad_alloc();
    }
    RIDGECRAFT_ASSERT(begun == Z_OK);
    std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    const int state = ::deflate(&stream, Z_FINISH);
    RIDGECRAFT_ASSERT(state == Z_STREAM_END);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
  }

  std::string text_;
  std::string directory_;
  std::size_t count_ = 0;
};

// The page.

/// What a page has behind this tag; none where it hasn't. Nothing that comes from a model holds such a tag:
/// it is packed or escaped.
std::optional<std::string_view> packed_in_page(std::string_view page, std::string_view tag) {
  const std::size_t at = page.find(tag);
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  page.remove_prefix(at + tag.size());
  return page.substr(0, page.find(page_end));
}

/// What a page has packed as web/packed.js reads it; none where it is damaged, or larger than any file.
std::optional<std::string> unpacked(std::string_view letters) {
  std::optional<std::string> packed = mesh::from_base64(letters);
  z_stream stream{};
  if (!packed || inflateInit(&stream) != Z_OK) {
    return std::nullopt;
  }
  stream.next_in = reinterpret_cast<Bytef*>(packed->data());
  stream.avail_in = static_cast<uInt>(packed->size());
  std::array<char, std::size_t{1} << 15U> part{};
  std::string bytes;
  int state = Z_OK;
  while (state == Z_OK && bytes.size() <= largest_file) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    state = ::inflate(&stream, Z_NO_FLUSH);
    bytes.append(part.data(), part.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return state == Z_STREAM_END ? std::optional(std::move(bytes)) : std::nullopt;
}

// What stands in the archive.

bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() <= 255 && name != "." && name != ".." && name == printable(name) &&
         name.find_first_of("/\\:") == std::string::npos;
}

/// As archives tell names apart.
std::string in_small_letters(std::string name) {
  for (char& c : name) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return name;
}

class ProjectReader {
 public:
  ProjectReader(std::string file, std::string_view bytes)
      : file_(std::move(file)), source_{bytes, file_, {}, context_}, archive_(source_) {}

  ProjectFile read() {
    if (!archive_.has(contents_name)) {
      refuse("is a ZIP archive, but no project of this program");
    }
    const auto contents =
        nlohmann::json::parse(archive_.read(contents_name, largest_contents), nullptr, false);
    if (!contents.is_object()) {
      refuse_damaged(contents_name);
    }
    const auto version = contents.find("version");
    if (version == contents.end() || !version->is_number_integer() || *version < 1) {
      refuse_damaged(fmt::format("{} has no version", contents_name));
    }
    if (*version > newest_version) {
      refuse("is a project of a newer version of this program");
    }
    ProjectFile project;
    project.model = text(contents, "model");
    project.edits = text(contents, "edits");
    project.digest = text(contents, export_::mark_key);
    project.words = texts(contents, "words");
    for (const std::string& word : project.words) {
      check_word(word);
    }
    for (const std::string& name : texts(contents, "files")) {
      if (!is_plain_name(name)) {
        refuse_damaged("a name in it leads elsewhere");
      }
      if (!names_.insert(in_small_letters(name)).second) {
        refuse_damaged("two files in it have one name");
      }
      project.files[name] = archive_.read(std::string(model_folder) + name, largest_file);
      if (archive_.unpacked() > largest_file) {
        refuse("is too large");
      }
    }
    if (!project.files.contains(project.model)) {
      refuse_damaged("it has no model");
    }
    check_edits(project.edits);
    if (archive_.has(nets_name)) {
      project.nets = archive_.read(nets_name, largest_file);
    }
    return project;
  }

 private:
  [[noreturn]] void refuse(std::string_view why) const { source_.refuse(ErrorKind::unreadable_input, why); }
  [[noreturn]] void refuse_damaged(std::string_view what) const {
    refuse(fmt::format("is a damaged project: {}", what));
  }

  [[nodiscard]] std::string text(const nlohmann::json& contents, std::string_view key) const {
    const auto found = contents.find(key);
    if (found == contents.end() || !found->is_string()) {
      refuse_damaged(fmt::format("{} has no {}", contents_name, key));
    }
    return found->get<std::string>();
  }

  [[nodiscard]] std::vector<std::string> texts(const nlohmann::json& contents, std::string_view key) const {
    const auto found = contents.find(key);
    if (found == contents.end() || !found->is_array() ||
        !std::all_of(found->begin(), found->end(), [](const auto& item) { return item.is_string(); })) {
      refuse_damaged(fmt::format("{} has no list of {}", contents_name, key));
    }
    return found->get<std::vector<std::string>>();
  }

  void check_word(std::string_view word) const {
    const std::string_view option = word.substr(0, word.find('='));
    const bool known = std::any_of(option_table().begin(), option_table().end(), [&](const Option& row) {
      return option == "--" + std::string(row.name) && !is_of_run(row.name);
    });
    if (!known) {
      refuse_damaged("it asks for " + in_quotes(word));
    }
  }

  void check_edits(const std::string& edits) const {
    try {
      static_cast<void>(steps_of(edits));
    } catch (const Error& error) {
      refuse_damaged(error.what());
    }
  }

  Context context_;
  std::string file_;
  mesh::Source source_;
  mesh::ZipArchive archive_;
  std::set<std::string> names_;  ///< of files that were read
};

}  // namespace

std::optional<std::string> why_no_project(const ProjectFile& project) {
  std::set<std::string> names;
  std::uint64_t size = project.nets.size();
  for (const auto& [name, bytes] : project.files) {
    size += bytes.size();
    if (!is_plain_name(name)) {
      return fmt::format("a project can't hold a file that is called '{}': rename it", printable(name));
    }
    if (!names.insert(in_small_letters(name)).second) {
      return fmt::format("a project can't hold two files that are called '{}': rename one of them", name);
    }
  }
  return size > largest_file
             ? std::optional<std::string>("a project can't hold more than 2 GB, and its files have more")
             : std::nullopt;
}

std::string write_project(const ProjectFile& project) {
  RIDGECRAFT_ASSERT(project.files.contains(project.model));
  std::vector<std::string> names;
  for (const auto& [name, bytes] : project.files) {
    names.push_back(name);
  }
  nlohmann::ordered_json contents{{"version", newest_version},
                                  {std::string(export_::mark_key), project.digest},
                                  {"model", project.model},
                                  {"words", project.words},
                                  {"files", names},
                                  {"edits", project.edits}};
  ZipText zip;
  // Stored and first, so that its beginning tells what the file is.
  zip.add(std::string(contents_name),
          contents.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n", false);
  for (const auto& [name, bytes] : project.files) {
    zip.add(std::string(model_folder) + name, bytes, true);
  }
  if (!project.nets.empty()) {
    zip.add(std::string(nets_name), project.nets, true);
  }
  return zip.finish();
}

bool holds_project(std::string_view bytes) {
  constexpr std::size_t header = 30;
  return mesh::is_zip(bytes) ? bytes.size() > header && bytes.substr(header).starts_with(contents_name)
                             : packed_in_page(bytes, page_start).has_value();
}

bool is_of_run(std::string_view option) {
  constexpr std::array<std::string_view, 10> of_run{"output",  "no-guide",  "no-page", "overwrite",
                                                    "strict",  "json",      "quiet",   "verbose",
                                                    "threads", "time-limit"};
  return std::find(of_run.begin(), of_run.end(), option) != of_run.end();
}

ProjectFile read_project(const std::string& file, std::string_view bytes) {
  if (const auto packed = mesh::is_zip(bytes) ? std::nullopt : packed_in_page(bytes, page_start)) {
    const std::optional<std::string> archive = mesh::from_base64(*packed);
    if (!archive) {
      throw Error(ErrorKind::unreadable_input, file + " holds a project that is damaged", file);
    }
    ProjectFile project = ProjectReader(file, *archive).read();
    if (const auto nets = packed_in_page(bytes, page_nets)) {
      std::optional<std::string> fold = unpacked(*nets);
      if (!fold) {
        throw Error(ErrorKind::unreadable_input, file + " holds nets that are damaged", file);
      }
      project.nets = *std::move(fold);
    }
    return project;
  }
  return ProjectReader(file, bytes).read();
}

std::string page_with_project(std::string page, std::string_view project) {
  const std::size_t at = page.rfind("</body>");
  RIDGECRAFT_ASSERT(at != std::string::npos);
  page.insert(at, std::string(page_start) + base64(project) + std::string(page_end) + "\n");
  return page;
}

}  // namespace ridgecraft::session
