// SPDX-License-Identifier: GPL-3.0-or-later
// 3MF (3MF Consortium, core 1.3, with the extensions for materials and production): what is to be built, each
// object where it stands. Unit told by the file, z up by the standard.
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/source.hpp"
#include "mesh/reading/threemf/model_part.hpp"

namespace ridgecraft::mesh {
namespace {

/// Objects in objects in objects: more than anybody nests.
constexpr std::size_t deepest_components = 100;

class ThreemfReader {
 public:
  explicit ThreemfReader(const Source& source) : source_(source), package_(source) {}

  Soup read();

 private:
  /// An object on its way into the soup.
  struct Open {
    std::string part;
    std::uint32_t object;
    Affine place;
    std::size_t depth;
    std::string name;  ///< of the object around it
  };
  /// What one element of a group makes of a face.
  struct Resolved {
    const ThreemfGroup* group;
    std::uint32_t number;  ///< of the group
    std::uint32_t index;
  };

  [[nodiscard]] const ThreemfPart& part(const std::string& name);
  void add_object(const Open& open, const ThreemfPart& part, const ThreemfObject& object);
  void paint(const Open& open, const ThreemfPart& part, const ThreemfObject& object,
             const ThreemfTriangle& triangle, std::array<std::uint32_t, 3> points);
  [[nodiscard]] Resolved resolve(const std::string& name, const ThreemfPart& part, ThreemfPaint paint) const;
  [[nodiscard]] std::uint32_t material_number(const std::string& part, std::uint32_t group,
                                              std::uint32_t index);
  [[nodiscard]] std::optional<std::uint32_t> first_place(const std::string& name, const ThreemfGroup& group,
                                                         std::uint32_t number);
  [[nodiscard]] std::shared_ptr<const std::string> picture(const std::string& file);

  const Source& source_;
  Soup soup_;
  ThreemfPackage package_;
  std::map<std::string, ThreemfPart> parts_;
  MaterialTable materials_;
  std::map<std::tuple<std::string, std::uint32_t, std::uint32_t>, std::uint32_t> material_numbers_;
  /// Per group of places in a picture: where they begin in the soup.
  std::map<std::pair<std::string, std::uint32_t>, std::uint32_t> places_;
  std::map<std::string, std::shared_ptr<const std::string>> pictures_;
  std::size_t bad_textures_ = 0;
  std::size_t supports_ = 0;
};

const ThreemfPart& ThreemfReader::part(const std::string& name) {
  const auto found = parts_.find(name);
  return found != parts_.end()
             ? found->second
             : parts_.emplace(name, read_part(source_, package_, name, soup_.remarks)).first->second;
}

Soup ThreemfReader::read() {
  const std::string root = package_.root();
  std::vector<Open> open;
  const auto push = [&](const std::vector<ThreemfUse>& uses, const Open& around) {
    for (auto use = uses.rbegin(); use != uses.rend(); ++use) {
      open.push_back({use->part.empty() ? around.part : use->part, use->object, around.place * use->place,
                      around.depth + 1, around.name});
    }
  };
  push(part(root).build, {root, 0, {}, 0, {}});
  for (std::size_t uses = 1; !open.empty(); ++uses) {
    Open next = std::move(open.back());
    open.pop_back();
    const ThreemfPart& in = part(next.part);
    const auto object = in.objects.find(next.object);
    if (object == in.objects.end()) {
      source_.refuse(ErrorKind::unreadable_input,
                     fmt::format("names object {} of its part {}, which isn't there", next.object,
                                 in_quotes(next.part)));
    }
    if (next.depth > deepest_components || uses > most_threemf_things) {
      source_.refuse(ErrorKind::unreadable_input,
                     "has objects that hold each other, or repeats them too often");
    }
    if (!object->second.name.empty()) {
      next.name = object->second.name;
    }
    add_object(next, in, object->second);
    push(object->second.components, next);
    if (uses % 256 == 0) {
      source_.context.check();
    }
  }
  soup_.remarks.add(RepairKind::texture_point_dropped, bad_textures_);
  soup_.remarks.add(RepairKind::element_ignored, supports_,
                    supports_ > 0 ? "support for printing" : std::string());
  soup_.format = FileFormat::threemf;
  soup_.frame = {part(root).mm_per_unit, Axis::z};
  return std::move(soup_);
}

void ThreemfReader::add_object(const Open& open, const ThreemfPart& part, const ThreemfObject& object) {
  if (object.triangles.empty()) {
    return;
  }
  if (object.type == "support" || object.type == "solidsupport") {
    ++supports_;
    return;
  }
  check_repetitions(source_, package_.unpacked(), soup_.points.size() + object.points.size(),
                    soup_.corner_point.size() + 3 * object.triangles.size());
  soup_.objects.emplace_back(static_cast<std::uint32_t>(soup_.polygon_count()), open.name);
  const auto first = static_cast<std::uint32_t>(soup_.points.size());
  for (const Vec3 p : object.points) {
    const Vec3 at = open.place == Affine{} ? p : open.place(p);
    if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z)) {
      source_.refuse(ErrorKind::unusable_mesh,
                     fmt::format("places object {} where a coordinate is not finite", open.object));
    }
    soup_.points.push_back(at);
  }
  for (const ThreemfTriangle& triangle : object.triangles) {
    std::array<std::uint32_t, 3> points{first + triangle.points[0], first + triangle.points[1],
                                        first + triangle.points[2]};
    paint(open, part, object, triangle, points);
  }
}

/// Follows mixtures to what they stand for.
ThreemfReader::Resolved ThreemfReader::resolve(const std::string& name, const ThreemfPart& part,
                                               ThreemfPaint paint) const {
  constexpr int deepest_mixture = 8;
  for (int depth = 0; depth < deepest_mixture; ++depth) {
    const auto group = part.groups.find(paint.group);
    if (group == part.groups.end()) {
      // Groups of extensions that aren't known paint nothing.
      return {nullptr, paint.group, 0};
    }
    if (paint.index >= group->second.size()) {
      source_.refuse(ErrorKind::unreadable_input,
                     fmt::format("names colour or material {} of group {} in its part {}, which has {}",
                                 paint.index, paint.group, in_quotes(name), group->second.size()));
    }
    if (group->second.mixed.empty()) {
      return {&group->second, paint.group, paint.index};
    }
    paint = group->second.mixed[paint.index];
  }
  source_.refuse(ErrorKind::unreadable_input, "has materials that are made of each other");
}

/// Adds the triangle with its colours.
void ThreemfReader::paint(const Open& open, const ThreemfPart& part, const ThreemfObject& object,
                          const ThreemfTriangle& triangle, std::array<std::uint32_t, 3> points) {
  const std::string& name = open.part;
  const bool mirrored = open.place.mirrors();
  const auto turned = [&](std::array<std::uint32_t, 3> corners) {
    return mirrored ? std::array{corners[0], corners[2], corners[1]} : corners;
  };
  std::array<ThreemfPaint, 3> paints{object.paint, object.paint, object.paint};
  if (triangle.index[0] != Soup::none) {
    const std::uint32_t group = triangle.group != Soup::none ? triangle.group : object.paint.group;
    // One index alone is that of all corners.
    for (std::size_t k = 0; k < 3; ++k) {
      paints[k] = {group, triangle.index[k] != Soup::none ? triangle.index[k] : triangle.index[0]};
    }
  }
  if (paints[0].group == Soup::none) {
    add_triangle(soup_, turned(points), std::nullopt);
    return;
  }
  const std::array at{resolve(name, part, paints[0]), resolve(name, part, paints[1]),
                      resolve(name, part, paints[2])};
  const ThreemfGroup* const group = at[0].group;
  if (group == nullptr || at[1].group != group || at[2].group != group) {
    add_triangle(soup_, turned(points), std::nullopt);
    return;
  }
  std::optional<std::array<std::uint32_t, 3>> texture;
  std::optional<ColourBytes> own;
  std::optional<std::array<std::uint32_t, 3>> corner_colours;
  std::uint32_t material = Soup::none;
  if (!group->bases.empty()) {
    material = material_number(name, at[0].number, at[0].index);
  } else if (!group->places.empty()) {
    const auto first = first_place(name, *group, at[0].number);
    if (first) {
      texture = turned({*first + at[0].index, *first + at[1].index, *first + at[2].index});
      material = material_number(name, at[0].number, 0);
    }
  } else {
    std::array<unsigned, 3> sum{};
    bool known = true;
    std::array<std::uint32_t, 3> of_corners{};
    std::size_t number = 0;
    for (const Resolved& corner : at) {
      const auto& colour = group->colours[corner.index];
      known = known && colour.has_value();
      of_corners[number++] = colour ? packed_colour(colour_of(*colour)) : Soup::none;
      for (std::size_t k = 0; colour && k < 3; ++k) {
        sum[k] += (*colour)[k];
      }
    }
    if (known) {
      corner_colours = turned(of_corners);
      // The face's own colour is the mean of its corners', rounded.
      own = ColourBytes{static_cast<std::uint8_t>((2 * sum[0] + 3) / 6),
                        static_cast<std::uint8_t>((2 * sum[1] + 3) / 6),
                        static_cast<std::uint8_t>((2 * sum[2] + 3) / 6)};
    }
  }
  add_triangle(soup_, turned(points), texture);
  if (corner_colours) {
    colour_last_triangle(soup_, *corner_colours);
  }
  materials_.paint(soup_, material, own, [&](std::uint32_t) {
    Material out;
    if (!group->bases.empty()) {
      const ThreemfGroup::Base& base = group->bases[at[0].index];
      out.name = base.name;
      if (base.colour) {
        out.colour = colour_of(*base.colour);
      }
    } else {
      out.picture = picture(part.textures.at(group->texture));
    }
    return out;
  });
}

std::uint32_t ThreemfReader::material_number(const std::string& part, std::uint32_t group,
                                             std::uint32_t index) {
  return material_numbers_
      .try_emplace({part, group, index}, static_cast<std::uint32_t>(material_numbers_.size()))
      .first->second;
}

/// Where the places of a group begin in the soup; nothing where its picture can't be used.
std::optional<std::uint32_t> ThreemfReader::first_place(const std::string& name, const ThreemfGroup& group,
                                                        std::uint32_t number) {
  const auto [found, fresh] = places_.try_emplace({name, number}, Soup::none);
  if (fresh) {
    const ThreemfPart& in = part(name);
    const auto texture = in.textures.find(group.texture);
    if (texture == in.textures.end()) {
      source_.refuse(
          ErrorKind::unreadable_input,
          fmt::format("names texture {} of its part {}, which isn't there", group.texture, in_quotes(name)));
    }
    if (picture(texture->second)) {
      found->second = static_cast<std::uint32_t>(soup_.texture_points.size());
      for (const Vec2 place : group.places) {
        const bool good = std::abs(place.x) <= largest_texture_coordinate &&
                          std::abs(place.y) <= largest_texture_coordinate;
        bad_textures_ += good ? 0U : 1U;
        soup_.texture_points.push_back(good ? place : Vec2{});
      }
    }
  }
  return found->second == Soup::none ? std::nullopt : std::optional(found->second);
}

/// Each picture is looked at once, and remarked on once.
std::shared_ptr<const std::string> ThreemfReader::picture(const std::string& file) {
  const auto [found, fresh] = pictures_.try_emplace(file);
  if (fresh) {
    std::string bytes = package_.has(file) ? package_.bytes(file) : std::string();
    const std::string why = package_.has(file) ? picture_fault(bytes) : "isn't in the file";
    if (why.empty()) {
      found->second = std::make_shared<const std::string>(std::move(bytes));
    } else {
      soup_.remarks.add(RepairKind::texture_missing, 1, fmt::format("{} {}", in_quotes(file), why));
    }
  }
  return found->second;
}

}  // namespace

Soup read_3mf(const Source& source) {
  return ThreemfReader(source).read();
}

}  // namespace ridgecraft::mesh
