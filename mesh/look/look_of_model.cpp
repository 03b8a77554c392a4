// SPDX-License-Identifier: GPL-3.0-or-later
// From a model with its materials to what it looks like.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "mesh/look/look.hpp"

namespace ridgecraft::mesh {
namespace {

constexpr Rgb white_paper{255, 255, 255};

Rgb bytes_of(const Colour& colour) {
  Rgb bytes{};
  for (std::size_t k = 0; k < 3; ++k) {
    bytes[k] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(colour[k], 0.0, 1.0)));
  }
  return bytes;
}

Rgb unpacked(std::uint32_t packed) {
  return {static_cast<std::uint8_t>(packed >> 16U & 0xffU), static_cast<std::uint8_t>(packed >> 8U & 0xffU),
          static_cast<std::uint8_t>(packed & 0xffU)};
}

/// IEC 61966-2-1.
double light_of(double shown) {
  return shown <= 0.04045 ? shown / 12.92 : elementary::pow((shown + 0.055) / 1.055, 2.4);
}
double shown_of(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * elementary::pow(light, 1.0 / 2.4) - 0.055;
}

std::shared_ptr<const std::array<Rgb, 256>> tint_of(const Colour& colour) {
  if (bytes_of(colour) == white_paper) {
    return nullptr;
  }
  auto table = std::make_shared<std::array<Rgb, 256>>();
  for (std::size_t value = 0; value < 256; ++value) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double shown = shown_of(light_of(static_cast<double>(value) / 255.0) * light_of(colour[k]));
      (*table)[value][k] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(shown, 0.0, 1.0)));
    }
  }
  return table;
}

/// Materials as paints, then white for faces without one. Materials may share a picture: it is unpacked once.
std::vector<Paint> paints_of(const Model& model, const Context& context, std::vector<std::string>& faults) {
  std::vector<Paint> paints;
  std::map<const std::string*, std::shared_ptr<const Picture>> unpacked_pictures;
  for (const Material& material : model.materials) {
    context.check();
    Paint paint;
    if (material.colour) {
      paint.colour = bytes_of(*material.colour);
    }
    if (material.picture) {
      const auto [found, fresh] = unpacked_pictures.try_emplace(material.picture.get());
      if (fresh) {
        if (auto picture = unpack_picture(*material.picture)) {
          found->second = std::make_shared<const Picture>(std::move(*picture));
        } else {
          faults.push_back(fmt::format(
              "the picture of material \"{}\" is damaged or too large, so it isn't printed", material.name));
        }
      }
      paint.picture = found->second;
      if (paint.picture && material.tints_picture && material.colour) {
        paint.tint = tint_of(*material.colour);
      }
    }
    paints.push_back(std::move(paint));
  }
  paints.emplace_back();
  return paints;
}

/// The colour at a place on a polygon's rim: repair puts points onto sides, too.
std::optional<Rgb> colour_on_rim(const CornerColours& colours, std::uint32_t polygon, Vec3 p) {
  const std::uint32_t first = colours.first_corner[polygon];
  const std::uint32_t last = colours.first_corner[polygon + 1];
  double nearest = INFINITY;
  std::optional<Rgb> found;
  for (std::uint32_t i = first; i < last; ++i) {
    const std::uint32_t next = i + 1 == last ? first : i + 1;
    if (colours.colour[i] == Soup::none || colours.colour[next] == Soup::none) {
      return std::nullopt;
    }
    const Vec3 a = colours.point[i];
    const Vec3 side = colours.point[next] - a;
    const double squared = dot(side, side);
    const double t = squared > 0.0 ? std::clamp(dot(p - a, side) / squared, 0.0, 1.0) : 0.0;
    const Vec3 away = p - (a + t * side);
    if (const double distance = dot(away, away); distance < nearest) {
      nearest = distance;
      const Rgb from = unpacked(colours.colour[i]);
      const Rgb to = unpacked(colours.colour[next]);
      found.emplace();
      for (std::size_t k = 0; k < 3; ++k) {
        (*found)[k] = static_cast<std::uint8_t>(std::lround(from[k] + t * (to[k] - from[k])));
      }
    }
  }
  return found;
}

std::optional<std::array<Rgb, 3>> corner_colours(const Model& model, FaceId f,
                                                 const std::array<Vec3, 3>& corners) {
  const std::uint32_t polygon = model.polygon[f];
  if (!model.corner_colours || polygon == Soup::none) {
    return std::nullopt;
  }
  std::array<Rgb, 3> colours{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto colour = colour_on_rim(*model.corner_colours, polygon, corners[k]);
    if (!colour) {
      return std::nullopt;
    }
    colours[k] = *colour;
  }
  return colours;
}

/// Nobody chose white or one grey.
bool is_plain(const std::vector<LookFace>& faces, const std::vector<Paint>& paints) {
  std::set<Rgb> colours;
  for (const LookFace& face : faces) {
    if (paints[face.paint].picture) {
      return false;
    }
    if (face.colours) {
      colours.insert(face.colours->begin(), face.colours->end());
    } else {
      colours.insert(paints[face.paint].colour);
    }
    if (colours.size() > 1) {
      return false;
    }
  }
  return colours.empty() ||
         ((*colours.begin())[0] == (*colours.begin())[1] && (*colours.begin())[1] == (*colours.begin())[2]);
}

}  // namespace

std::optional<LookParts> look_of(const Model& model, const Context& context,
                                 std::vector<std::string>& faults) {
  if (model.material.empty() && !model.corner_colours) {
    return std::nullopt;
  }
  std::vector<Paint> paints = paints_of(model, context, faults);
  const auto none = static_cast<std::uint32_t>(paints.size() - 1);
  std::vector<LookFace> faces;
  faces.reserve(model.surface.face_count());
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    if (model.surface.normal(f) == Vec3{}) {
      continue;
    }
    LookFace face;
    const auto vertices = model.surface.vertices(f);
    for (std::size_t k = 0; k < 3; ++k) {
      face.corners[k] = model.surface.point(vertices[k]);
    }
    face.normal = model.surface.normal(f);
    const std::uint32_t material = model.material.empty() ? Soup::none : model.material[f];
    face.paint = material == Soup::none ? none : material;
    if (paints[face.paint].picture) {
      const bool placed = !model.texture.empty() && model.texture[f] != std::array<Vec2, 3>{};
      if (placed) {
        face.places = model.texture[f];
      } else {
        face.paint = none;  // the file doesn't say which part of the picture
      }
    } else {
      face.colours = corner_colours(model, f, face.corners);
    }
    faces.push_back(face);
  }
  if (is_plain(faces, paints)) {
    return std::nullopt;
  }
  return LookParts{std::move(faces), std::move(paints)};
}

}  // namespace ridgecraft::mesh
