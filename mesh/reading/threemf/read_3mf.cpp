// SPDX-License-Identifier: GPL-3.0-or-later
// 3MF (3MF Consortium, core 1.3, with the extensions for materials and production): what is to be built, each
// object where it stands. Unit told by the file, z up by the standard.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/source.hpp"
#include "mesh/reading/threemf/model_part.hpp"
#include "mesh/reading/threemf/slicer_project.hpp"

namespace ridgecraft::mesh {
namespace {

/// Objects in objects in objects: more than anybody nests.
constexpr std::size_t deepest_components = 100;
/// Corners of painted faces that are divided: some 256 MB.
constexpr std::size_t most_painted_corners = std::size_t{1} << 26U;

/// The name of a part of an object that has the name `around`, on the same plate.
std::string name_within(const std::string& around, const std::string& name) {
  const std::size_t plate = around.starts_with("plate") ? around.find('/') : std::string::npos;
  return (plate == std::string::npos ? std::string() : around.substr(0, plate + 1)) + name;
}

class ThreemfReader {
 public:
  explicit ThreemfReader(const Source& source)
      : source_(source), package_(source), project_(read_slicer_project(package_)) {}

  Soup read();

 private:
  /// An object on its way into the soup.
  struct Open {
    std::string part;
    std::uint32_t object;
    Affine place;
    std::size_t depth;
    std::string name;                         ///< of the object around it
    const SlicerObject* slicer = nullptr;     ///< what a slicer says of the object in the build ...
    const SlicerPart* slicer_part = nullptr;  ///< ... and of the part of it that this is
  };
  /// What one element of a group makes of a face.
  struct Resolved {
    const ThreemfGroup* group;
    std::uint32_t number;  ///< of the group
    std::uint32_t index;
  };

  /// Triangles of an object that belong together.
  struct Run {
    std::uint32_t begin;
    std::uint32_t end;
    const SlicerPart* part;   ///< null where no slicer names one
    std::uint32_t filament;   ///< 0 where no slicer says
    std::uint32_t first = 0;  ///< where the object's points begin in the soup
    bool mirrored = false;
  };
  [[nodiscard]] static std::vector<Run> runs_of(const Open& open, const ThreemfObject& object);

  [[nodiscard]] const ThreemfPart& part(const std::string& name);
  void add_item(const ThreemfUse& item, std::vector<Open>& open);
  void add_component(const ThreemfUse& use, const Open& around, std::vector<Open>& open) const;
  void add_object(const Open& open, const ThreemfPart& part, const ThreemfObject& object);
  void add_run(const Open& open, const ThreemfPart& part, const ThreemfObject& object, const Run& run);
  void add_painted_run(const ThreemfObject& object, const Run& run);
  void add_polygon(const std::vector<std::uint32_t>& points, bool mirrored);
  void paint_filament(std::uint32_t filament);
  void finish_filaments();
  void tell_left_out();
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
  SlicerProject project_;
  std::map<std::uint32_t, std::uint32_t> items_of_object_;  ///< so far, of those in the build
  std::set<std::uint32_t> filaments_;                       ///< that triangles have
  std::array<std::size_t, 4> left_out_{};                   ///< by SlicerRole
  std::size_t not_printed_ = 0;
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
  for (const ThreemfUse& item : part(root).build) {
    add_item(item, open);
  }
  std::reverse(open.begin(), open.end());
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
    if (!object->second.name.empty() && next.slicer == nullptr) {
      next.name = object->second.name;
    }
    add_object(next, in, object->second);
    const std::vector<ThreemfUse>& components = object->second.components;
    for (auto use = components.rbegin(); use != components.rend(); ++use) {
      add_component(*use, next, open);
    }
    if (uses % 256 == 0) {
      source_.context.check();
    }
  }
  finish_filaments();
  soup_.remarks.add(RepairKind::texture_point_dropped, bad_textures_);
  tell_left_out();
  soup_.format = FileFormat::threemf;
  soup_.frame = {part(root).mm_per_unit, Axis::z};
  return std::move(soup_);
}

void ThreemfReader::add_item(const ThreemfUse& item, std::vector<Open>& open) {
  const std::uint32_t instance = items_of_object_[item.object]++;
  if (!item.printable) {
    ++not_printed_;
    return;
  }
  const std::string& root = package_.root();
  Open next{item.part.empty() ? root : item.part, item.object, item.place, 1, {}};
  const auto slicer = project_.objects.find(item.object);
  if (slicer != project_.objects.end()) {
    next.slicer = &slicer->second;
    next.name = slicer->second.name;
  }
  const auto plate = project_.plates.find({item.object, instance});
  if (plate != project_.plates.end()) {
    next.name = fmt::format("plate{}/{}", plate->second, next.name);
  }
  open.push_back(std::move(next));
}

void ThreemfReader::add_component(const ThreemfUse& use, const Open& around, std::vector<Open>& open) const {
  Open next{use.part.empty() ? around.part : use.part,
            use.object,
            around.place * use.place,
            around.depth + 1,
            around.name,
            around.slicer,
            around.slicer_part};
  if (around.slicer != nullptr && around.slicer_part == nullptr) {
    const auto part = around.slicer->parts.find(use.object);
    if (part != around.slicer->parts.end()) {
      next.slicer_part = &part->second;
      if (around.slicer->parts.size() > 1 && !part->second.name.empty()) {
        next.name = name_within(around.name, part->second.name);
      }
    }
  }
  open.push_back(std::move(next));
}

void ThreemfReader::tell_left_out() {
  std::vector<std::string> words;
  std::size_t sum = not_printed_;
  for (const SlicerRole role : {SlicerRole::negative, SlicerRole::modifier, SlicerRole::support}) {
    const std::size_t count = left_out_[static_cast<std::size_t>(role)];
    sum += count;
    if (count > 0) {
      words.push_back(counted_role(role, count));
    }
  }
  if (not_printed_ > 0) {
    words.push_back(fmt::format("{} not to be printed", not_printed_));
  }
  soup_.remarks.add(RepairKind::object_left_out, sum, listed(words, "and"));
  if (soup_.polygon_count() == 0 && sum > 0) {
    source_.refuse(ErrorKind::unusable_mesh,
                   fmt::format("has nothing to build: all it holds is {}", listed(words, "and")));
  }
}

void ThreemfReader::add_object(const Open& open, const ThreemfPart& part, const ThreemfObject& object) {
  if (object.triangles.empty()) {
    return;
  }
  if (open.slicer_part == nullptr && (object.type == "support" || object.type == "solidsupport")) {
    ++left_out_[static_cast<std::size_t>(SlicerRole::support)];
    return;
  }
  check_repetitions(source_, package_.unpacked(), soup_.points.size() + object.points.size(),
                    soup_.corner_point.size() + 3 * object.triangles.size());
  const auto first = static_cast<std::uint32_t>(soup_.points.size());
  std::vector<Run> runs = runs_of(open, object);
  for (Run& run : runs) {
    run.first = first;
    run.mirrored = open.place.mirrors();
    const SlicerRole role = run.part == nullptr ? SlicerRole::model : run.part->role;
    if (role != SlicerRole::model) {
      ++left_out_[static_cast<std::size_t>(role)];
    }
  }
  std::erase_if(runs,
                [](const Run& run) { return run.part != nullptr && run.part->role != SlicerRole::model; });
  if (runs.empty()) {
    return;
  }
  for (const Vec3 p : object.points) {
    const Vec3 at = open.place == Affine{} ? p : open.place(p);
    if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z)) {
      source_.refuse(ErrorKind::unusable_mesh,
                     fmt::format("places object {} where a coordinate is not finite", open.object));
    }
    soup_.points.push_back(at);
  }
  for (const Run& run : runs) {
    const bool has_name = runs.size() > 1 && run.part != nullptr && !run.part->name.empty();
    soup_.objects.emplace_back(static_cast<std::uint32_t>(soup_.polygon_count()),
                               has_name ? name_within(open.name, run.part->name) : open.name);
    if (object.painted.empty()) {
      add_run(open, part, object, run);
    } else {
      add_painted_run(object, run);
    }
  }
}

/// One mesh may hold several volumes, one after the other.
std::vector<ThreemfReader::Run> ThreemfReader::runs_of(const Open& open, const ThreemfObject& object) {
  const auto count = static_cast<std::uint32_t>(object.triangles.size());
  const auto filament = [&](const SlicerPart* part) {
    return open.slicer == nullptr                   ? 0
           : part == nullptr || part->filament == 0 ? open.slicer->filament
                                                    : part->filament;
  };
  std::vector<Run> runs;
  std::uint32_t begin = 0;
  const auto add = [&](std::uint32_t end, const SlicerPart* part) {
    if (begin < end) {
      runs.push_back({begin, end, part, filament(part)});
      begin = end;
    }
  };
  if (open.slicer != nullptr && open.depth == 1) {
    for (const SlicerVolume& volume : open.slicer->volumes) {
      add(std::min(volume.first, count), nullptr);
      add(volume.last < count ? volume.last + 1 : count, &volume.part);
    }
  }
  add(count, open.slicer_part);
  return runs;
}

void ThreemfReader::add_run(const Open& open, const ThreemfPart& part, const ThreemfObject& object,
                            const Run& run) {
  for (std::uint32_t i = run.begin; i < run.end; ++i) {
    const auto& points = object.triangles[i].points;
    paint(open, part, object, object.triangles[i],
          {run.first + points[0], run.first + points[1], run.first + points[2]});
    if (soup_.polygon_material.size() < soup_.polygon_count()) {
      paint_filament(run.filament);
    }
  }
}

/// Painted triangles are divided, and what lies next to them gets the middles of its sides as corners.
void ThreemfReader::add_painted_run(const ThreemfObject& object, const Run& run) {
  PaintDivider divider(soup_.points);
  std::vector<PaintedPiece> pieces;
  auto painted = std::lower_bound(object.painted.begin(), object.painted.end(), run.begin,
                                  [](const auto& entry, std::uint32_t i) { return entry.first < i; });
  for (std::uint32_t i = run.begin; i < run.end; ++i) {
    const auto& points = object.triangles[i].points;
    const std::array corners{run.first + points[0], run.first + points[1], run.first + points[2]};
    if (painted != object.painted.end() && painted->first == i) {
      const std::vector<PaintedPiece> divided = divider.divide(corners, painted->second);
      pieces.insert(pieces.end(), divided.begin(), divided.end());
      ++painted;
    } else {
      pieces.push_back({corners, 0});
    }
    if (i % 4096 == 0) {
      source_.context.check();
    }
  }
  for (const PaintedPiece& piece : pieces) {
    add_polygon(divider.outline(piece.corners), run.mirrored);
    paint_filament(piece.filament == 0 ? run.filament : piece.filament);
    // Each triangle beside a side has all its middles: a small file may ask for very many.
    if (soup_.corner_point.size() > most_painted_corners) {
      source_.refuse(
          ErrorKind::unreadable_input,
          fmt::format("is too large: its painted faces have more than {} corners", most_painted_corners));
    }
    source_.context.check();
  }
}

void ThreemfReader::add_polygon(const std::vector<std::uint32_t>& points, bool mirrored) {
  soup_.corner_point.insert(soup_.corner_point.end(), points.begin(), points.end());
  if (mirrored) {
    std::reverse(soup_.corner_point.end() - static_cast<std::ptrdiff_t>(points.size()),
                 soup_.corner_point.end());
  }
  soup_.first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_point.size()));
}

/// Of the last polygon; 0 for none.
void ThreemfReader::paint_filament(std::uint32_t filament) {
  if (filament == 0) {
    return;
  }
  filaments_.insert(filament);
  materials_.paint(soup_, material_number({}, Soup::none, filament), std::nullopt, [&](std::uint32_t) {
    Material out;
    out.name = fmt::format("filament {}", filament);
    if (filament <= project_.filaments.size()) {
      out.colour = colour_of(project_.filaments[filament - 1]);
    }
    return out;
  });
}

/// One filament alone is what lay in the printer: no colour that anybody chose for the model.
void ThreemfReader::finish_filaments() {
  if (filaments_.size() == 1 && soup_.materials.size() == 1) {
    soup_.materials.clear();
    soup_.polygon_material.clear();
  } else if (!filaments_.empty() && *filaments_.rbegin() > project_.filaments.size()) {
    soup_.remarks.add(RepairKind::material_unknown, 1,
                      fmt::format("the file has no colour for filament {}", *filaments_.rbegin()));
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
