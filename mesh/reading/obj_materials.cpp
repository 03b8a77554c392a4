// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/obj_materials.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

namespace fs = std::filesystem;

/// How a picture lies on faces.
struct PicturePlace {
  Vec2 scale{1.0, 1.0};    ///< coordinates times this ...
  Vec2 shift;              ///< ... plus this
  bool clamps = false;     ///< beyond its rim there is the colour of the rim
  bool recolours = false;  ///< -mm: its colours are changed

  [[nodiscard]] bool moves() const { return scale != Vec2{1.0, 1.0} || shift != Vec2{}; }
  [[nodiscard]] Vec2 operator()(Vec2 p) const { return {scale.x * p.x + shift.x, scale.y * p.y + shift.y}; }
};

/// What one material file says of one name.
struct Definition {
  std::optional<Colour> colour;
  bool colour_corrected = false;
  bool transparent = false;
  std::string texture;  ///< as the file names it
  PicturePlace place;
  fs::path folder;  ///< of the file
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

/// One to three numbers; those that are missing stay as they are.
void read_pair(TextScanner& line, Vec2& pair) {
  std::array<double, 3> values{pair.x, pair.y, 0.0};
  for (double& value : values) {
    if (line.line_is_over() || !line.number(value)) {
      break;
    }
  }
  if (std::abs(values[0]) <= largest_texture_coordinate &&
      std::abs(values[1]) <= largest_texture_coordinate) {
    pair = {values[0], values[1]};
  }
}

/// The file name after the options of map_Kd, which have a fixed number of arguments, but for those that take
/// one to three numbers.
std::string_view read_map_options(TextScanner& line, PicturePlace& place) {
  while (!line.line_is_over() && line.peek() == '-') {
    const TextScanner before = line;
    const std::string_view option = line.word();
    if (option == "-o") {
      read_pair(line, place.shift);
    } else if (option == "-s") {
      read_pair(line, place.scale);
    } else if (option == "-t") {
      Vec2 ignored;
      read_pair(line, ignored);
    } else if (option == "-mm") {
      Vec2 base_and_gain{0.0, 1.0};
      read_pair(line, base_and_gain);
      place.recolours = base_and_gain != Vec2{0.0, 1.0};
    } else if (option == "-clamp") {
      place.clamps = equal_ignoring_case(line.word(), "on");
    } else if (option == "-blendu" || option == "-blendv" || option == "-cc" || option == "-texres" ||
               option == "-imfchan" || option == "-boost" || option == "-bm" || option == "-type") {
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
      material->place = {};
      material->texture = read_map_options(text, material->place);
    } else if (material != nullptr && equal_ignoring_case(keyword, "map_d")) {
      material->transparent = true;
    } else if (material != nullptr &&
               (equal_ignoring_case(keyword, "d") || equal_ignoring_case(keyword, "tr"))) {
      double value = 0.0;
      const bool opacity = keyword.size() == 1;
      material->transparent =
          material->transparent || (text.number(value) && (opacity ? value < 1.0 : value > 0.0));
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
  /// How the material's picture lies on faces.
  PicturePlace apply(std::string_view name, Material& material);
  /// What was seen and can't be shown.
  void tell_ignored() const;
  /// Those that define something.
  [[nodiscard]] std::vector<std::string> opened() const;

 private:
  bool read(const fs::path& file);

  const Source& source_;
  RepairReport& remarks_;
  Definitions definitions_;
  std::map<fs::path, bool> read_files_;  ///< whether they are of use
  PictureFinder pictures_;
  bool any_missing_ = false;
  std::size_t transparent_ = 0;
  std::size_t recoloured_ = 0;
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

PicturePlace MaterialFiles::apply(std::string_view name, Material& material) {
  const auto found = definitions_.find(name);
  if (found == definitions_.end()) {
    if (!any_missing_) {
      remarks_.add(RepairKind::material_unknown, 1, in_quotes(name));
    }
    return {};
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
  transparent_ += found->second.transparent ? 1U : 0U;
  recoloured_ += material.picture && found->second.place.recolours ? 1U : 0U;
  return material.picture ? found->second.place : PicturePlace{};
}

std::vector<std::string> MaterialFiles::opened() const {
  std::vector<std::string> files;
  for (const auto& [file, useful] : read_files_) {
    if (useful) {
      files.push_back(file.string());
    }
  }
  return files;
}

void MaterialFiles::tell_ignored() const {
  std::vector<std::string> words;
  if (transparent_ > 0) {
    words.push_back(fmt::format("transparency of {}", counted(transparent_, "material")));
  }
  if (recoloured_ > 0) {
    words.push_back(fmt::format("-mm of {}", counted(recoloured_, "picture")));
  }
  remarks_.add(RepairKind::feature_ignored, words.size(), listed(words, "and"));
}

/// Faces with these materials get coordinates of their own, where their picture is moved or ends at its rim.
void place_pictures(const std::vector<PicturePlace>& places, Soup& soup) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made;
  for (std::size_t i = 0; i < soup.polygon_count() && !soup.corner_texture.empty(); ++i) {
    const std::uint32_t material = soup.polygon_material.empty() ? Soup::none : soup.polygon_material[i];
    if (material >= places.size() || !(places[material].moves() || places[material].clamps)) {
      continue;
    }
    const PicturePlace& place = places[material];
    for (std::uint32_t c = soup.first_corner[i]; c < soup.first_corner[i + 1]; ++c) {
      std::uint32_t& texture = soup.corner_texture[c];
      if (texture == Soup::none) {
        continue;
      }
      const auto [found, fresh] =
          made.try_emplace({material, texture}, static_cast<std::uint32_t>(soup.texture_points.size()));
      if (fresh) {
        Vec2 at = place(soup.texture_points[texture]);
        if (place.clamps) {
          at = {std::clamp(at.x, 0.0, 1.0), std::clamp(at.y, 0.0, 1.0)};
        }
        soup.texture_points.push_back(at);
      }
      texture = found->second;
    }
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
  std::vector<PicturePlace> places;
  for (std::size_t i = 0; i < names.size(); ++i) {
    places.push_back(files.apply(names[i], soup.materials[i]));
  }
  files.tell_ignored();
  soup.files_beside = files.opened();
  place_pictures(places, soup);
}

}  // namespace ridgecraft::mesh
