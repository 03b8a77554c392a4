// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <memory>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/look/picture.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

// Reads a whole regular file in one go, and nothing that could block or never end.

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view reason) {
  const std::string name = printable(file.string());
  throw Error(ErrorKind::unreadable_input, fmt::format("{} {}", name, reason), name);
}

[[noreturn]] void refuse_errno(const std::filesystem::path& file, int number) {
  switch (number) {
    case ENOENT:
    case ENOTDIR:
      refuse(file, "doesn't exist");
    case EACCES:
    case EPERM:
      refuse(file, "can't be opened: no permission to read it");
    default:
      refuse(file, fmt::format("can't be read: {}", std::generic_category().message(number)));
  }
}

void require_regular(const std::filesystem::path& file, const struct stat& status) {
  if (S_ISDIR(status.st_mode)) {
    refuse(file, "is a folder, not a file");
  }
  if (!S_ISREG(status.st_mode)) {
    refuse(file, "is a pipe or device; only regular files are read");
  }
  if (static_cast<std::uint64_t>(status.st_size) > largest_file_size) {
    refuse(file,
           fmt::format("is too large: {} bytes, at most {} are read", status.st_size, largest_file_size));
  }
}

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// The file of a folder whose name is this but for the case of letters; the first by name where there are
/// several.
std::optional<fs::path> find_in_any_case(const fs::path& wanted) {
  std::optional<fs::path> found;
  std::error_code error;
  const std::string name = wanted.filename().string();
  for (fs::directory_iterator entry(wanted.parent_path(), error), end; !error && entry != end;
       entry.increment(error)) {
    if (equal_ignoring_case(entry->path().filename().string(), name) && is_file(entry->path()) &&
        (!found || entry->path() < *found)) {
      found = entry->path();
    }
  }
  return found;
}

/// "https", "file" and the like before a colon; drives of Windows, too.
bool has_scheme(std::string_view address) {
  const std::size_t colon = address.find(':');
  return colon != address.npos && colon > 0 && address.find_first_of("/\\%?#") > colon;
}

bool leads_out(const fs::path& relative) {
  const fs::path plain = relative.lexically_normal();
  return relative.is_absolute() || plain.empty() || *plain.begin() == "..";
}

using namespace std::string_view_literals;

constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n"sv;

std::size_t big_endian(std::string_view bytes, std::size_t at, std::size_t length) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < length; ++i) {
    value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
  }
  return value;
}

/// Walks over the chunks (length, type, data, checksum) up to IEND.
bool png_is_whole(std::string_view bytes) {
  std::size_t at = png_signature.size();
  bool has_data = false;
  while (bytes.size() - at >= 12) {
    const std::size_t length = big_endian(bytes, at, 4);
    const std::string_view type = bytes.substr(at + 4, 4);
    if (length > bytes.size() - at - 12) {
      return false;
    }
    if (type == "IEND") {
      return has_data;
    }
    has_data = has_data || type == "IDAT";
    at += length + 12;
  }
  return false;
}

/// Walks over the segments up to the start of scan, so that a thumbnail's end mark isn't taken for the
/// picture's.
bool jpeg_is_whole(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 4 <= bytes.size()) {
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (bytes[at] != '\xff') {
      return false;
    }
    if (marker == 0xff || marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8)) {
      at += marker == 0xff ? 1 : 2;  // a fill byte, or a mark without content
      continue;
    }
    at += 2 + big_endian(bytes, at + 2, 2);
    if (marker == 0xda) {
      return bytes.find("\xff\xd9"sv, at) != bytes.npos;
    }
  }
  return false;
}

}  // namespace

std::string read_file(const std::filesystem::path& file) {
  struct stat status {};
  // Asked before opening, since opening a device can have effects; and again after, in case it was replaced.
  if (::stat(file.c_str(), &status) != 0) {
    refuse_errno(file, errno);
  }
  require_regular(file, status);
  const Descriptor opened(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (opened.number() < 0 || ::fstat(opened.number(), &status) != 0) {
    refuse_errno(file, errno);
  }
  require_regular(file, status);
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::read(opened.number(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      refuse_errno(file, errno);
    }
    if (got == 0) {
      break;
    }
    filled += static_cast<std::size_t>(got);
  }
  bytes.resize(filled);
  return bytes;
}

std::optional<fs::path> find_beside(const fs::path& folder, std::string_view name) {
  // Longer names than any file system has, and names with a zero byte, would only confuse it.
  if (name.empty() || name.size() > 4096 || name.find('\0') != name.npos) {
    return std::nullopt;
  }
  std::string slashes(name);
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  for (const fs::path& tried : {folder / name, folder / slashes, folder / fs::path(slashes).filename()}) {
    if (is_file(tried)) {
      return tried;
    }
  }
  for (const fs::path& tried : {folder / slashes, folder / fs::path(slashes).filename()}) {
    if (const auto found = find_in_any_case(tried)) {
      return found;
    }
  }
  return std::nullopt;
}

bool lies_inside(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path home = fs::canonical(folder, error);
  const fs::path real = error ? fs::path() : fs::canonical(file, error);
  return !error && std::mismatch(home.begin(), home.end(), real.begin(), real.end()).first == home.end();
}

FoundInside find_inside(const fs::path& folder, std::string_view address) {
  // Longer names than any file system has, and names with a zero byte, would only confuse it.
  constexpr std::size_t longest = 4096;
  if (has_scheme(address)) {
    return {{}, "lies elsewhere: nothing is fetched, put the file beside the model and name it there"};
  }
  if (folder.empty()) {
    return {{}, "can't be found: nothing lies beside standard input"};
  }
  const std::string resolved = from_percent(address);
  std::string slashes = resolved;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  bool outside = false;
  for (const std::string& name : {std::string(address), resolved, slashes}) {
    if (name.empty() || name.size() > longest || name.find('\0') != name.npos) {
      continue;
    }
    std::error_code error;
    const fs::path file = folder / name;
    if (leads_out(name)) {
      outside = true;
    } else if (fs::is_regular_file(file, error)) {
      if (lies_inside(folder, file)) {
        return {file, {}};
      }
      outside = true;
    }
  }
  return {
      {},
      outside ? "lies outside the model's folder, where nothing is read" : "was not found beside the model"};
}

std::string picture_fault(std::string_view bytes) {
  if (bytes.empty()) {
    return "is empty";
  }
  const std::optional<PictureFormat> format = picture_format(bytes);
  if (!format) {
    return "is no picture";
  }
  if (!format->is_read) {
    return fmt::format("is a {} picture, which isn't read: save it as PNG", format->name);
  }
  const bool whole = format->name == "PNG"    ? png_is_whole(bytes)
                     : format->name == "JPEG" ? jpeg_is_whole(bytes)
                                              : true;
  return whole ? "" : "is cut off or damaged";
}

namespace {

/// The last part of a path of any system.
std::string last_name(std::string_view name) {
  return std::string(name.substr(name.find_last_of("/\\") + 1));
}

constexpr std::array<std::string_view, 5> texture_folder_names{"textures", "texture", "tex", "images",
                                                               "maps"};
constexpr std::array<std::string_view, 8> picture_suffixes{"png", "jpg",  "jpeg", "tga",
                                                           "bmp", "webp", "tif",  "gif"};

/// Folders below this one that are called as such are.
void add_texture_folders(const fs::path& folder, std::vector<fs::path>& found) {
  std::error_code error;
  std::vector<fs::path> here;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code no_folder;
    if (std::any_of(texture_folder_names.begin(), texture_folder_names.end(),
                    [&](std::string_view known) { return equal_ignoring_case(known, name); }) &&
        entry->is_directory(no_folder)) {
      here.push_back(entry->path());
    }
  }
  std::sort(here.begin(), here.end());
  found.insert(found.end(), here.begin(), here.end());
}

}  // namespace

const std::vector<fs::path>& PictureFinder::texture_folders() {
  if (!texture_folders_) {
    texture_folders_.emplace();
    add_texture_folders(source_.folder, *texture_folders_);
    std::error_code error;
    const fs::path home = fs::canonical(source_.folder, error);
    if (!error && equal_ignoring_case(home.filename().string(), "source")) {
      add_texture_folders(source_.folder / "..", *texture_folders_);
    }
  }
  return *texture_folders_;
}

/// Its real place is below the model's folder, or in a folder for pictures.
bool PictureFinder::is_allowed(const fs::path& file) {
  if (lies_inside(source_.folder, file)) {
    return true;
  }
  const auto& folders = texture_folders();
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
    return lies_inside(source_.folder / "..", folder) && lies_inside(folder, file);
  });
}

/// All that exist, the likeliest first.
std::vector<fs::path> PictureFinder::places_of(const fs::path& folder, std::string_view name) {
  std::vector<fs::path> places;
  const auto add = [&](const fs::path& in, std::string_view called) {
    if (auto file = find_beside(in, called)) {
      places.push_back(std::move(*file));
    }
  };
  add(folder, name);
  add(source_.folder, name);
  const std::string last = last_name(name);
  add(source_.folder, last);
  for (const fs::path& in : texture_folders()) {
    add(in, last);
  }
  return places;
}

/// The same picture in other formats.
std::vector<fs::path> PictureFinder::copies_of(std::string_view name) {
  std::vector<fs::path> places;
  const std::string stem = fs::path(last_name(name)).stem().string();
  for (const std::string_view suffix : picture_suffixes) {
    const std::vector<fs::path> found = places_of(source_.folder, fmt::format("{}.{}", stem, suffix));
    places.insert(places.end(), found.begin(), found.end());
  }
  return places;
}

PictureFinder::Found PictureFinder::find(const fs::path& folder, std::string_view name) {
  const auto [entry, fresh] = found_.try_emplace(folder.string() + '\n' + std::string(name));
  if (!fresh) {
    return entry->second;
  }
  Found& kept = entry->second;  // lambdas of older clang capture no parts of a pair
  std::string why;
  const auto try_all = [&](const std::vector<fs::path>& places) {
    for (const fs::path& file : places) {
      std::string fault =
          is_allowed(file) ? load(file, kept) : "lies outside the model's folder, where nothing is read";
      if (fault.empty()) {
        kept.file = file.lexically_relative(source_.folder).string();
        if (kept.file.empty()) {  // one path is absolute, the other isn't
          kept.file = fs::absolute(file).string();
        }
        return true;
      }
      why = why.empty() ? std::move(fault) : why;
    }
    return false;
  };
  if (!try_all(places_of(folder, name)) && !try_all(copies_of(name))) {
    remarks_.add(
        RepairKind::texture_missing, 1,
        fmt::format("{} {}", in_quotes(name), why.empty() ? "was not found: copy it beside the model" : why));
  }
  return entry->second;
}

/// What is wrong with it; nothing where it can be used.
std::string PictureFinder::load(const std::filesystem::path& file, Found& into) const {
  source_.context.check();
  try {
    std::string bytes = read_file(file);
    std::string fault = picture_fault(bytes);
    if (fault.empty()) {
      into.bytes = std::make_shared<const std::string>(std::move(bytes));
    }
    return fault;
  } catch (const Error&) {
    return "can't be read";
  }
}

void FacePaint::add(Soup& soup, std::optional<Colour> colour, std::uint32_t picture) {
  if (!colour && picture == Soup::none) {
    return;
  }
  if (colour) {
    colour = in_range(*colour);
  }
  const auto [found, fresh] =
      number_.try_emplace({colour, picture}, static_cast<std::uint32_t>(number_.size()));
  soup.polygon_material.resize(soup.polygon_count() - 1, Soup::none);
  soup.polygon_material.push_back(found->second);
}

void FacePaint::finish(Soup& soup, const std::vector<PictureFinder::Found>& pictures) const {
  soup.materials.resize(number_.size());
  for (const auto& [key, number] : number_) {
    Material& material = soup.materials[number];
    material.name = fmt::format("paint {}", number + 1);
    material.colour = key.first;
    if (key.second < pictures.size()) {
      material.texture_file = pictures[key.second].file;
      material.picture = pictures[key.second].bytes;
    }
  }
}

}  // namespace ridgecraft::mesh
