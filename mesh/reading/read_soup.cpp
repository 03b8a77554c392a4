// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/read_soup.hpp"

#include <new>
#include <string>

#include <fmt/format.h>

#include "base/text.hpp"
#include "mesh/reading/detect_format.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {
namespace {

/// The mark that editors put before UTF-8 text; it means nothing.
constexpr std::string_view utf8_mark = "\xef\xbb\xbf";

Soup read_as(FileFormat format, const Source& source) {
  switch (format) {
    case FileFormat::obj:
      return read_obj(source);
    case FileFormat::stl_ascii:
      return read_stl_ascii(source);
    case FileFormat::stl_binary:
      return read_stl_binary(source);
    case FileFormat::ply_ascii:
    case FileFormat::ply_binary:
      return read_ply(source);
    case FileFormat::gltf:
      return read_gltf(source);
    case FileFormat::glb:
      return read_glb(source);
    case FileFormat::threemf:
      return read_3mf(source);
    case FileFormat::pdo:
      return read_pdo(source);
    case FileFormat::dae:
    case FileFormat::fbx:
    case FileFormat::max3ds:
    case FileFormat::blend:
      return read_imported(format, source);
    case FileFormat::off:
      break;
  }
  return read_off(source);
}

}  // namespace

Soup parse_soup(std::string_view bytes, std::string_view file_name,
                const std::filesystem::path& folder_for_materials, const Context& context,
                const std::filesystem::path& importer) {
  if (bytes.starts_with(utf8_mark)) {
    bytes.remove_prefix(utf8_mark.size());
  }
  const Source source{bytes, printable(file_name), folder_for_materials, context, importer};
  try {
    const FileFormat format = detect_format(source, file_name);
    Soup soup = read_as(format, source);
    complete(soup);
    if (suffix_contradicts(file_name, format)) {
      soup.remarks.add(RepairKind::content_is_other_format, 1,
                       fmt::format("the content is {}", format_name(format)));
    }
    if (soup.polygon_count() == 0) {
      source.refuse(ErrorKind::unusable_mesh,
                    soup.points.empty() ? "has no faces" : "has points but no faces that could be unfolded");
    }
    return soup;
  } catch (const std::bad_alloc&) {
    source.refuse(ErrorKind::unusable_mesh, "needs more memory than this machine has");
  }
}

Soup read_soup(const std::filesystem::path& file, const Context& context,
               const std::filesystem::path& importer) {
  std::string bytes;
  try {
    bytes = read_file(file);
  } catch (const std::bad_alloc&) {
    const std::string name = printable(file.string());
    throw Error(ErrorKind::unusable_mesh, fmt::format("{} needs more memory than this machine has", name),
                name);
  }
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  return parse_soup(bytes, file.string(), folder, context, importer);
}

}  // namespace ridgecraft::mesh
