// SPDX-License-Identifier: GPL-3.0-or-later
// PDO, the files of Pepakura Designer: the model, in the unit that its nets make millimetres of.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "mesh/reading/pdo/document.hpp"
#include "mesh/reading/pdo/picture.hpp"
#include "mesh/reading/readers.hpp"

namespace ridgecraft::mesh {
namespace {

/// Pixels of all pictures together, in bytes.
constexpr std::uint64_t most_pixel_bytes = std::uint64_t{256} << 20U;

class PdoReader {
 public:
  explicit PdoReader(const Source& source) : source_(source), document_(read_pdo_document(source)) {}

  Soup read();

 private:
  using PictureKey = std::tuple<std::uint32_t, std::uint32_t, std::string_view>;

  void add_material(const PdoMaterial& material);
  [[nodiscard]] std::shared_ptr<const std::string> picture(const PdoPicture& picture,
                                                           const std::string& name);
  void add_object(const PdoObject& object);
  [[nodiscard]] std::uint32_t texture_point(Vec2 place);

  const Source& source_;
  PdoDocument document_;
  Soup soup_;
  std::map<PictureKey, std::shared_ptr<const std::string>> pictures_;
  std::uint64_t pixel_bytes_ = 0;
  std::size_t unknown_materials_ = 0;
  std::size_t bad_textures_ = 0;
};

/// Materials often hold the same picture again: it is unpacked once.
std::shared_ptr<const std::string> PdoReader::picture(const PdoPicture& picture, const std::string& name) {
  const auto [found, fresh] = pictures_.try_emplace({picture.width, picture.height, picture.packed});
  if (fresh) {
    pixel_bytes_ += std::uint64_t{3} * picture.width * picture.height;
    PdoPng png = pixel_bytes_ <= most_pixel_bytes ? png_of(picture)
                                                  : PdoPng{{}, "is too large together with those before it"};
    if (png.fault.empty()) {
      found->second = std::make_shared<const std::string>(std::move(png.bytes));
    } else {
      soup_.remarks.add(RepairKind::texture_missing, 1,
                        fmt::format("the picture of material {} {}", in_quotes(name), png.fault));
    }
    source_.context.check();
  }
  return found->second;
}

void PdoReader::add_material(const PdoMaterial& material) {
  Material out;
  out.name = material.name;
  Colour colour = material.colour;
  bool good = true;
  for (double& channel : colour) {
    good = good && channel >= 0.0 && channel <= 1.0;
    channel = std::isnan(channel) ? 1.0 : std::clamp(channel, 0.0, 1.0);
  }
  soup_.remarks.add(RepairKind::material_value_corrected, good ? 0 : 1);
  out.colour = colour;
  if (material.picture) {
    out.picture = picture(*material.picture, material.name);
  }
  soup_.materials.push_back(std::move(out));
}

std::uint32_t PdoReader::texture_point(Vec2 place) {
  if (!(std::abs(place.x) <= largest_texture_coordinate && std::abs(place.y) <= largest_texture_coordinate)) {
    ++bad_textures_;
    return Soup::none;
  }
  // The file counts down from the picture's upper edge.
  soup_.texture_points.push_back({place.x, 1.0 - place.y});
  return static_cast<std::uint32_t>(soup_.texture_points.size() - 1);
}

void PdoReader::add_object(const PdoObject& object) {
  soup_.objects.emplace_back(static_cast<std::uint32_t>(soup_.polygon_count()), object.name);
  const auto first = static_cast<std::uint32_t>(soup_.points.size());
  soup_.points.insert(soup_.points.end(), object.points.begin(), object.points.end());
  for (const PdoFace& face : object.faces) {
    const bool known = face.material < soup_.materials.size();
    unknown_materials_ += known || face.material == Soup::none ? 0U : 1U;
    soup_.polygon_material.push_back(known ? face.material : Soup::none);
    const bool painted = known && soup_.materials[face.material].picture;
    for (const PdoCorner& corner : object.corners_of(face)) {
      soup_.corner_point.push_back(first + corner.point);
      soup_.corner_texture.push_back(painted ? texture_point(corner.texture) : Soup::none);
    }
    soup_.first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_point.size()));
  }
}

Soup PdoReader::read() {
  for (const PdoMaterial& material : document_.materials) {
    add_material(material);
  }
  const auto shown = shown_objects(document_);
  for (const PdoObject* const object : shown) {
    add_object(*object);
    check_corner_count(source_, soup_);
  }
  if (soup_.texture_points.empty()) {
    soup_.corner_texture.clear();
  }
  if (std::all_of(soup_.objects.begin(), soup_.objects.end(),
                  [](const auto& o) { return o.second.empty(); })) {
    soup_.objects.clear();
  }
  const std::size_t hidden = document_.objects.size() - shown.size();
  soup_.remarks.add(RepairKind::element_ignored, hidden,
                    hidden > 0 ? "objects that the file hides" : std::string());
  soup_.remarks.add(RepairKind::material_unknown, unknown_materials_);
  soup_.remarks.add(RepairKind::texture_point_dropped, bad_textures_);
  soup_.remarks.add(RepairKind::missing_end, document_.ends_well ? 0 : 1);
  soup_.format = FileFormat::pdo;
  if (std::isfinite(document_.mm_per_unit) && document_.mm_per_unit > 0.0) {
    soup_.frame.mm_per_unit = document_.mm_per_unit;
  }
  return std::move(soup_);
}

}  // namespace

Soup read_pdo(const Source& source) {
  return PdoReader(source).read();
}

}  // namespace ridgecraft::mesh
