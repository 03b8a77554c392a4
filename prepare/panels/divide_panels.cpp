// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/panels/divide_panels.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "base/geometry.hpp"
#include "base/no_index.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/panels/page_cuts.hpp"
#include "prepare/panels/remesh_panels.hpp"

namespace ridgecraft::prepare {
namespace {

/// More paper than anyone has.
constexpr std::size_t most_faces = 1'000'000;
/// A vertex this close to a line lies on it, mm: no scissors cut truer, and no needle is left beside it.
constexpr double on_line_mm = 0.02;
/// Kept free even where tabs have no room: what vertices near the lines may add to a cell.
constexpr double least_strip_mm = 2.0 * on_line_mm;

/// The faces of panels that are cut, and of their neighbours, with sides that can be divided.
class PanelCutter {
 public:
  PanelCutter(const mesh::Model& model, const Panels& panels, const PanelRoom& room, const Context& context)
      : context_(context), given_(room), loose_(mesh::take_apart(model)) {
    label_.reserve(panels.panel.size());
    for (const PanelId p : panels.panel) {
      label_.push_back(p.value());
    }
    for (const auto& faces : panels.faces) {
      std::vector<std::uint32_t>& own = members_.emplace_back();
      for (const FaceId f : faces) {
        own.push_back(f.value());
      }
    }
    const double strip = std::max(room.tab_mm, least_strip_mm);
    const Vec2 with_tabs{room.sheet.width - 2.0 * strip, room.sheet.height - 2.0 * strip};
    const double least = std::min(with_tabs.x, with_tabs.y);
    room_ = least > room.tab_mm
                ? with_tabs
                : Vec2{room.sheet.width - 2.0 * least_strip_mm, room.sheet.height - 2.0 * least_strip_mm};
  }

  std::size_t run() {
    std::vector<std::uint32_t> large;
    double paper = 0.0;
    for (std::uint32_t label = 0; label < members_.size(); ++label) {
      if (label % 1024 == 0) {
        context_.check();
      }
      const FlatShape shape = shape_of(label, false);
      if (!fits_page(shape.points(), {given_.sheet.width, given_.sheet.height})) {
        large.push_back(label);
        paper += shape.area();
      }
    }
    // Two faces for each cell at the least.
    refuse_more_than(2.0 * paper / (room_.x * room_.y));
    for (const std::uint32_t label : large) {
      for (const std::uint32_t f : members_[label]) {
        know_sides(f);
      }
    }
    for (const std::uint32_t f : beside(large)) {
      know_sides(f);
    }
    for (const std::uint32_t label : large) {
      lift_backs(label);
    }
    for (const std::uint32_t label : large) {
      divide(label);
    }
    return large.size();
  }

  void give_back(mesh::Model& model, Panels& panels) {
    mesh::put_together(model, std::move(loose_));
    panels = panels_by_label(label_);
    // A line has vertices where it crossed sides of faces: two cells that meet there need none of them.
    remesh_panels(model, panels, context_);
  }

 private:
  using Ends = std::array<std::uint32_t, 2>;

  static void refuse_more_than(double faces) {
    if (faces > static_cast<double>(most_faces)) {
      throw Error(ErrorKind::no_nets, Message("too_large_for_paper"));
    }
  }

  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32U) | std::max(a, b);
  }

  void know_sides(std::uint32_t f) {
    const auto& v = loose_.faces[f];
    for (std::size_t k = 0; k < 3; ++k) {
      Ends& faces = sides_.try_emplace(key(v[k], v[(k + 1) % 3]), Ends{no_index, no_index}).first->second;
      if (faces[0] != f && faces[1] != f) {
        faces[faces[0] == no_index ? 0 : 1] = f;
      }
    }
  }

  /// Faces that share a side with these panels and belong to others.
  [[nodiscard]] std::vector<std::uint32_t> beside(const std::vector<std::uint32_t>& large) const {
    std::vector<std::uint32_t> found;
    if (large.empty()) {
      return found;
    }
    for (std::uint32_t f = 0; f < loose_.faces.size(); ++f) {
      if (std::binary_search(large.begin(), large.end(), label_[f])) {
        continue;
      }
      const auto& v = loose_.faces[f];
      for (std::size_t k = 0; k < 3; ++k) {
        if (sides_.contains(key(v[k], v[(k + 1) % 3]))) {
          found.push_back(f);
          break;
        }
      }
    }
    return found;
  }

  [[nodiscard]] Vec3 place(std::uint32_t v) const { return loose_.points[v]; }

  [[nodiscard]] PlaneFrame frame_of(std::uint32_t label) const {
    Vec3 doubled;
    for (const std::uint32_t f : members_[label]) {
      const auto& [a, b, c] = loose_.faces[f];
      doubled += cross(place(b) - place(a), place(c) - place(a));
    }
    const Vec3 normal = normalized(doubled);
    return {place(loose_.faces[members_[label][0]][0]), normal == Vec3{} ? Vec3{0, 0, 1} : normal};
  }

  [[nodiscard]] FlatShape shape_of(std::uint32_t label, bool with_links) const {
    const PlaneFrame frame = frame_of(label);
    FlatShape shape;
    for (const std::uint32_t f : members_[label]) {
      std::vector<Vec2>& tile = shape.tiles.emplace_back();
      for (const std::uint32_t v : loose_.faces[f]) {
        tile.push_back(frame.flat(place(v)));
      }
    }
    if (with_links) {
      for_each_side(label, [&](std::uint32_t i, std::uint32_t j, std::uint32_t a, std::uint32_t b) {
        if (j != no_index && i < j) {
          shape.links.push_back({i, j, frame.flat(place(a)), frame.flat(place(b))});
        }
      });
    }
    return shape;
  }

  [[nodiscard]] std::vector<std::array<Vec2, 2>> outline_of(std::uint32_t label) const {
    const PlaneFrame frame = frame_of(label);
    std::vector<std::array<Vec2, 2>> sides;
    for_each_side(label, [&](std::uint32_t, std::uint32_t j, std::uint32_t a, std::uint32_t b) {
      if (j == no_index) {
        sides.push_back({frame.flat(place(a)), frame.flat(place(b))});
      }
    });
    return sides;
  }

  /// Calls use(i, j, a, b) for the side from a to b of the panel's face i; j is the panel's face beyond it.
  template <class Use>
  void for_each_side(std::uint32_t label, Use use) const {
    const std::vector<std::uint32_t>& faces = members_[label];
    std::unordered_map<std::uint32_t, std::uint32_t> number;
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      number[faces[i]] = i;
    }
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      const auto& v = loose_.faces[faces[i]];
      for (std::size_t k = 0; k < 3; ++k) {
        const Ends& two = sides_.at(key(v[k], v[(k + 1) % 3]));
        const std::uint32_t other = two[0] == faces[i] ? two[1] : two[0];
        const bool inside = other != no_index && label_[other] == label;
        use(i, inside ? number.at(other) : no_index, v[k], v[(k + 1) % 3]);
      }
    }
  }

  /// Two faces back to back, which are all of their component, have one apex beyond each side: divided there,
  /// both would get a side from the new vertex to it. So the one behind gets a vertex in its middle.
  void lift_backs(std::uint32_t label) {
    const auto sorted = [](std::array<std::uint32_t, 3> v) {
      std::sort(v.begin(), v.end());
      return v;
    };
    const std::vector<std::uint32_t> faces = members_[label];
    for (const std::uint32_t f : faces) {
      const auto& v = loose_.faces[f];
      const Ends& two = sides_.at(key(v[0], v[1]));
      const std::uint32_t back = two[0] == f ? two[1] : two[0];
      if (back != no_index && sorted(loose_.faces[back]) == sorted(v)) {
        divide_at_middle(back);
      }
    }
  }

  /// New vertex in the middle of a face, which becomes three.
  void divide_at_middle(std::uint32_t f) {
    const std::array<std::uint32_t, 3> v = loose_.faces[f];
    const auto m = static_cast<std::uint32_t>(loose_.points.size());
    loose_.points.push_back((place(v[0]) + place(v[1]) + place(v[2])) / 3.0);
    for (const std::size_t k : {1U, 2U}) {
      const std::size_t l = (k + 1) % 3;
      const std::uint32_t g = add_part(f, {v[k], v[l], m});
      Ends& side = sides_.at(key(v[k], v[l]));
      std::replace(side.begin(), side.end(), f, g);
      know_sides(g);
    }
    loose_.faces[f] = {v[0], v[1], m};
    know_sides(f);
  }

  /// Another face of f's panel, with what f carries.
  std::uint32_t add_part(std::uint32_t f, const std::array<std::uint32_t, 3>& corners) {
    const auto g = static_cast<std::uint32_t>(loose_.faces.size());
    loose_.faces.push_back(corners);
    loose_.polygon.push_back(std::uint32_t{loose_.polygon[f]});
    if (!loose_.material.empty()) {
      loose_.material.push_back(std::uint32_t{loose_.material[f]});
    }
    if (!loose_.object.empty()) {
      loose_.object.push_back(std::uint32_t{loose_.object[f]});
    }
    label_.push_back(std::uint32_t{label_[f]});
    members_[label_[f]].push_back(g);
    return g;
  }

  void divide(std::uint32_t label) {
    std::vector<std::uint32_t> todo{label};
    bool whole = true;  // what no page holds is cut even where it is larger than the room by next to nothing
    while (!todo.empty()) {
      context_.check();
      const std::uint32_t next = todo.back();
      todo.pop_back();
      const FlatShape shape = shape_of(next, true);
      // The room and what vertices near the lines may have added.
      const Vec2 allowed{room_.x + least_strip_mm, room_.y + least_strip_mm};
      if (whole || !fits_page(shape.points(), allowed)) {
        const Cuts cuts = plan_cuts(shape, outline_of(next), room_, context_);
        const std::vector<std::uint32_t> cells = cut(next, cuts);
        if (cells.size() > 1) {
          todo.insert(todo.end(), cells.begin(), cells.end());
        }
      }
      whole = false;
      refuse_more_than(static_cast<double>(loose_.faces.size()));
    }
  }

  /// Divides the panel's faces along the lines; the cells, of which the first keeps the panel's label.
  std::vector<std::uint32_t> cut(std::uint32_t label, const Cuts& cuts) {
    const PlaneFrame frame = frame_of(label);
    for (const double at : cuts.at) {
      context_.check();
      const auto beyond = [&](std::uint32_t v) { return dot(frame.flat(place(v)), cuts.across) - at; };
      for (std::size_t i = 0; i < members_[label].size(); ++i) {
        const std::uint32_t f = members_[label][i];
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t a = std::min(loose_.faces[f][k], loose_.faces[f][(k + 1) % 3]);
          const std::uint32_t b = std::max(loose_.faces[f][k], loose_.faces[f][(k + 1) % 3]);
          const double from = beyond(a);
          const double to = beyond(b);
          if (std::min(from, to) < -on_line_mm && std::max(from, to) > on_line_mm) {
            divide_side(a, b, from / (from - to));
            k = static_cast<std::size_t>(-1);  // the face has another side now
          }
        }
      }
    }
    return label_cells(label, frame, cuts);
  }

  /// New vertex between a and b; each face there becomes two.
  void divide_side(std::uint32_t a, std::uint32_t b, double share) {
    const auto m = static_cast<std::uint32_t>(loose_.points.size());
    loose_.points.push_back(place(a) + share * (place(b) - place(a)));
    const auto found = sides_.find(key(a, b));
    const Ends faces = found->second;
    sides_.erase(found);
    for (const std::uint32_t f : faces) {
      if (f != no_index) {
        divide_face(f, a, b, m);
      }
    }
  }

  void divide_face(std::uint32_t f, std::uint32_t a, std::uint32_t b, std::uint32_t m) {
    const std::array<std::uint32_t, 3> v = loose_.faces[f];
    std::size_t k = 0;
    while (key(v[k], v[(k + 1) % 3]) != key(a, b)) {
      ++k;
    }
    const std::size_t l = (k + 1) % 3;
    const std::size_t n = (k + 2) % 3;
    loose_.faces[f] = {v[k], m, v[n]};
    const std::uint32_t g = add_part(f, {m, v[l], v[n]});
    if (const auto side = sides_.find(key(v[l], v[n])); side != sides_.end()) {
      std::replace(side->second.begin(), side->second.end(), f, g);
    }
    know_sides(f);
    know_sides(g);
  }

  std::vector<std::uint32_t> label_cells(std::uint32_t label, const PlaneFrame& frame, const Cuts& cuts) {
    const std::vector<std::uint32_t> faces = members_[label];
    std::vector<std::size_t> strip;
    for (const std::uint32_t f : faces) {
      const auto& [a, b, c] = loose_.faces[f];
      const Vec2 middle = (frame.flat(place(a)) + frame.flat(place(b)) + frame.flat(place(c))) / 3.0;
      strip.push_back(static_cast<std::size_t>(
          std::lower_bound(cuts.at.begin(), cuts.at.end(), dot(middle, cuts.across)) - cuts.at.begin()));
    }
    DisjointSets sets(faces.size());
    for_each_side(label, [&](std::uint32_t i, std::uint32_t j, std::uint32_t, std::uint32_t) {
      if (j != no_index && strip[i] == strip[j]) {
        sets.join(i, j);
      }
    });
    std::vector<std::uint32_t> cells;
    std::vector<std::uint32_t> cell(faces.size(), no_index);
    members_[label].clear();
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      const std::uint32_t root = sets.find(i);
      if (root == i) {
        cell[i] = cells.empty() ? label : static_cast<std::uint32_t>(members_.size());
        if (!cells.empty()) {
          members_.emplace_back();
        }
        cells.push_back(cell[i]);
      }
      label_[faces[i]] = cell[root];
      members_[cell[root]].push_back(faces[i]);
    }
    return cells;
  }

  const Context& context_;
  PanelRoom given_;
  Vec2 room_;  ///< of a cell
  mesh::LooseFaces loose_;
  std::vector<std::uint32_t> label_;                 ///< of each face: its panel or cell
  std::vector<std::vector<std::uint32_t>> members_;  ///< faces of each label
  std::unordered_map<std::uint64_t, Ends> sides_;    ///< faces at each side; looked up only
};

}  // namespace

std::size_t divide_panels(mesh::Model& model, Panels& panels, const PanelRoom& room, const Context& context) {
  PanelCutter cutter(model, panels, room, context);
  const std::size_t divided = cutter.run();
  if (divided > 0) {
    cutter.give_back(model, panels);
  }
  return divided;
}

}  // namespace ridgecraft::prepare
