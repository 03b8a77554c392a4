// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/gltf/paint.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/printable.hpp"
#include "mesh/reading/check_picture.hpp"
#include "mesh/reading/find_inside.hpp"
#include "mesh/reading/gltf/data_uri.hpp"
#include "mesh/reading/read_file.hpp"

namespace ridgecraft::mesh {
namespace {

std::uint8_t screen_channel(double light) {
  const double in_range = std::isnan(light) ? 1.0 : std::clamp(light, 0.0, 1.0);
  const double shown =
      in_range <= 0.0031308 ? 12.92 * in_range : 1.055 * elementary::pow(in_range, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * shown));
}

}  // namespace

ColourBytes screen_colour(const Colour& light) {
  return {screen_channel(light[0]), screen_channel(light[1]), screen_channel(light[2])};
}

const GltfMaterial& GltfPaint::material(std::uint64_t i, const GltfObject& user) {
  const auto found = read_.find(i);
  return found != read_.end() ? found->second
                              : read_.emplace(i, read(document_.element("materials", i, user))).first->second;
}

GltfMaterial GltfPaint::read(const GltfObject& material) {
  GltfMaterial out;
  out.name = printable(material.text("name"));
  // The older way to tell colours, where it is used, is what was meant.
  const auto older = material.extension("KHR_materials_pbrSpecularGlossiness");
  const auto looks = older ? older : material.object("pbrMetallicRoughness");
  if (!looks) {
    return out;
  }
  if (const auto colour = looks->numbers(older ? "diffuseFactor" : "baseColorFactor", 4)) {
    out.light = Colour{(*colour)[0], (*colour)[1], (*colour)[2]};
  }
  if (const auto map = looks->object(older ? "diffuseTexture" : "baseColorTexture")) {
    out.map = read_map(*map);
  }
  return out;
}

std::optional<GltfPicture> GltfPaint::read_map(const GltfObject& map) {
  GltfPicture picture;
  picture.coordinates = map.whole_or("texCoord", 0);
  if (const auto transform = map.extension("KHR_texture_transform")) {
    picture.coordinates = transform->whole_or("texCoord", picture.coordinates);
    const auto scale = transform->numbers("scale", 2).value_or(std::vector{1.0, 1.0});
    const auto shift = transform->numbers("offset", 2).value_or(std::vector{0.0, 0.0});
    const double turn = transform->number("rotation").value_or(0.0);
    picture.row_u = {elementary::cos(turn) * scale[0], elementary::sin(turn) * scale[1]};
    picture.row_v = {-elementary::sin(turn) * scale[0], elementary::cos(turn) * scale[1]};
    picture.shift = {shift[0], shift[1]};
  }
  const GltfObject texture = document_.element("textures", map.needed_whole("index"), map);
  const auto image = texture.whole("source");
  if (!image) {
    remarks_.add(RepairKind::texture_missing, 1,
                 fmt::format("{} has no PNG or JPEG picture", texture.place()));
    return std::nullopt;
  }
  load(*image, texture, picture);
  return picture.picture ? std::optional(picture) : std::nullopt;
}

/// Each picture is looked at once, and remarked on once.
void GltfPaint::load(std::uint64_t number, const GltfObject& texture, GltfPicture& into) {
  const auto [entry, fresh] = loaded_.try_emplace(number);
  Loaded& loaded = entry->second;
  if (fresh) {
    const GltfObject image = document_.element("images", number, texture);
    const std::string uri = image.text("uri");
    std::string why;
    std::string bytes;
    std::string file;
    if (is_data_uri(uri)) {
      bytes = data_of_uri(uri).value_or(std::string());
    } else if (!uri.empty()) {
      const FoundInside found = find_inside(document_.source().folder, uri);
      why = found.why;
      if (!found.file.empty()) {
        file = found.file.lexically_relative(document_.source().folder).string();
        try {
          bytes = read_file(found.file);
        } catch (const Error&) {
          why = "can't be read";
        }
      }
    } else {
      const std::string_view within = document_.view(image.needed_whole("bufferView"), image).bytes;
      // Pictures that overlap could be more than any memory holds.
      bytes = looked_at_ + within.size() > 2 * document_.held() ? std::string() : std::string(within);
    }
    looked_at_ += bytes.size();
    if (why.empty()) {
      why = picture_fault(bytes);
    }
    if (!why.empty()) {
      const std::string name = uri.empty() || is_data_uri(uri) ? image.place() : in_quotes(uri);
      remarks_.add(RepairKind::texture_missing, 1, fmt::format("{} {}", name, why));
    } else {
      loaded.file = file;
      loaded.bytes = std::make_shared<const std::string>(std::move(bytes));
    }
    document_.source().context.check();
  }
  into.texture_file = loaded.file;
  into.picture = loaded.bytes;
}

}  // namespace ridgecraft::mesh
