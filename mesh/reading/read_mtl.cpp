// SPDX-License-Identifier: GPL-3.0-or-later
// Of a material: its name, its diffuse colour (Kd) and its picture (map_Kd).
#include "mesh/reading/read_mtl.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/text.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

namespace fs = std::filesystem;

/// What one material file says of one name.
struct Definition {
  std::optional<Colour> colour;
  bool colour_corrected = false;
  std::string texture;  ///< as the file names it
  fs::path folder;      ///< of the file
};

using Definitions = std::map<std::string, Definition, std::less<>>;

/// Kd r [g b]; a channel that is left out is like the first. What can't be read is white, what is out of
/// range is brought into it.
void read_colour(TextScanner& line, Definition& material) {
  Colour colour{1.0, 1.0, 1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0 && line.line_is_over()) {
      colour[i] = colour[0];
      continue;
    }
    double value = 0.0;
    if (!line.number(value)) {
      material.colour_corrected = true;
      return;
    }
    colour[i] = std::isnan(value) ? 1.0 : std::clamp(value, 0.0, 1.0);
    material.colour_corrected = material.colour_corrected || colour[i] != value;
  }
  material.colour = colour;
}

/// The file name after the options of map_Kd, which have a fixed number of arguments, but for those that take
/// one to three numbers.
std::string_view skip_map_options(TextScanner& line) {
  while (!line.line_is_over() && line.peek() == '-') {
    const TextScanner before = line;
    const std::string_view option = line.word();
    if (option == "-o" || option == "-s" || option == "-t") {
      double ignored = 0.0;
      for (int i = 0; i < 3 && !line.line_is_over() && line.number(ignored); ++i) {
      }
    } else if (option == "-mm") {
      (void)line.word();
      (void)line.word();
    } else if (option == "-blendu" || option == "-blendv" || option == "-cc" || option == "-clamp" ||
               option == "-texres" || option == "-imfchan" || option == "-boost" || option == "-bm" ||
               option == "-type") {
      (void)line.word();
    } else {
      line = before;  // a file name that begins with a dash
      break;
    }
  }
  return line.rest_of_line();
}

/// False where nothing is defined.
bool read_definitions(std::string_view bytes, const fs::path& folder, Definitions& definitions) {
  if (bytes.starts_with("\xef\xbb\xbf")) {
    bytes.remove_prefix(3);
  }
  TextScanner text(bytes);
  Definition* material = nullptr;
  bool any = false;
  for (; !text.done(); text.next_line()) {
    const std::string_view keyword = text.line_is_over() ? std::string_view() : text.word();
    if (equal_ignoring_case(keyword, "newmtl")) {
      const auto [found, fresh] = definitions.try_emplace(std::string(text.rest_of_line()));
      any = true;
      material = fresh ? &found->second : nullptr;  // the first definition of a name counts
      if (fresh) {
        found->second.folder = folder;
      }
    } else if (material != nullptr && equal_ignoring_case(keyword, "kd")) {
      read_colour(text, *material);
    } else if (material != nullptr && equal_ignoring_case(keyword, "map_kd")) {
      material->texture = skip_map_options(text);
    }
  }
  return any;
}

/// Opens the files that an OBJ file names and remarks on those that are of no use.
class MaterialFiles {
 public:
  MaterialFiles(const Source& source, RepairReport& remarks)
      : source_(source), remarks_(remarks), pictures_(source, remarks) {}

  void read_line(std::string_view names);
  void apply(std::string_view name, Material& material);

 private:
  bool read(const fs::path& file);

  const Source& source_;
  RepairReport& remarks_;
  Definitions definitions_;
  std::map<fs::path, bool> read_files_;  ///< whether they are of use
  PictureFinder pictures_;
  bool any_missing_ = false;
};

/// One mtllib line: a name, perhaps with blanks in it, or several names between blanks.
void MaterialFiles::read_line(std::string_view names) {
  if (const auto whole = find_beside(source_.folder, names); whole && read(*whole)) {
    return;
  }
  TextScanner text(names);
  std::size_t missing = 0;
  std::size_t wanted = 0;
  for (std::string_view name = text.word(); !name.empty(); name = text.word()) {
    const auto file = find_beside(source_.folder, name);
    ++wanted;
    missing += file && read(*file) ? 0U : 1U;
  }
  if (missing > 0 || wanted == 0) {
    any_missing_ = true;
    // Of a name with blanks of which no word is a file there is one, not as many as it has words.
    remarks_.add(RepairKind::material_file_missing, missing == wanted ? 1 : missing, in_quotes(names));
  }
}

/// False for a file that defines nothing or can't be opened.
bool MaterialFiles::read(const fs::path& file) {
  source_.context.check();
  const auto [entry, fresh] = read_files_.try_emplace(file.lexically_normal(), false);
  if (!fresh) {
    return entry->second;
  }
  try {
    const std::string bytes = read_file(file);
    entry->second = read_definitions(bytes, file.parent_path(), definitions_);
    return entry->second;
  } catch (const Error&) {
    return false;  // remarked on by the caller, like a file that isn't there
  }
}

void MaterialFiles::apply(std::string_view name, Material& material) {
  const auto found = definitions_.find(name);
  if (found == definitions_.end()) {
    if (!any_missing_) {
      remarks_.add(RepairKind::material_unknown, 1, in_quotes(name));
    }
    return;
  }
  material.colour = found->second.colour;
  if (found->second.colour_corrected) {
    remarks_.add(RepairKind::material_value_corrected, 1, in_quotes(name));
  }
  if (!found->second.texture.empty()) {
    const PictureFinder::Found picture = pictures_.find(found->second.folder, found->second.texture);
    material.texture_file = picture.file;
    material.picture = picture.bytes;
  }
}

}  // namespace

void read_material_files(const Source& source, const std::vector<std::string_view>& libraries,
                         const std::vector<std::string_view>& names, Soup& soup) {
  if (source.folder.empty()) {
    return;
  }
  MaterialFiles files(source, soup.remarks);
  std::set<std::string_view> lines;
  for (const std::string_view library : libraries) {
    if (lines.insert(library).second) {
      files.read_line(library);
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    files.apply(names[i], soup.materials[i]);
  }
}

}  // namespace ridgecraft::mesh
