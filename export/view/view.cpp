// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/view/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <boost/polygon/polygon.hpp>

#include "base/boxes.hpp"
#include "base/geometry.hpp"

namespace ridgecraft::export_ {
namespace {

namespace planar = boost::polygon;
using PlanarPoint = planar::point_data<int>;
using PlanarPolygon = planar::polygon_data<int>;
using PlanarSet = planar::polygon_set_data<int>;

/// Areas are cut on a grid of so many cells across the scene.
constexpr double grid_cells = 1e6;
/// Depths that differ by less of the scene's size are equal.
constexpr double same_depth_fraction = 1e-6;
/// What overlaps by less of the scene's size only touches.
constexpr double touch_fraction = 1e-6;
/// More covers than this are cut away one by one, fewer all at once.
constexpr std::size_t few_covers = 32;

/// The part of a convex polygon on the left of the line from a to b.
std::vector<Vec2> left_of(const std::vector<Vec2>& polygon, Vec2 a, Vec2 b) {
  return part_where(polygon, [&](Vec2 p) { return cross(b - a, p - a); });
}

/// Whether a polygon is wider than this: a strip has its length times its width.
bool is_wider(const std::vector<Vec2>& polygon, double width) {
  double perimeter = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    perimeter += length(polygon[(k + 1) % polygon.size()] - polygon[k]);
  }
  return std::abs(doubled_area(polygon)) > width * perimeter;
}

/// The middle of where two triangles overlap; nothing where they do so by less than `touch` across.
std::optional<Vec2> middle_of_overlap(const SeenFace& s, const SeenFace& t, double touch) {
  std::vector<Vec2> overlap(s.corners.begin(), s.corners.end());
  for (std::size_t k = 0; k < 3 && overlap.size() > 2; ++k) {
    overlap = left_of(overlap, t.corners[k], t.corners[(k + 1) % 3]);
  }
  if (overlap.size() < 3) {
    return std::nullopt;
  }
  if (!is_wider(overlap, touch)) {
    return std::nullopt;
  }
  Vec2 middle;
  for (const Vec2 p : overlap) {
    middle += p / static_cast<double>(overlap.size());
  }
  return middle;
}

/// Shares of a line that are hidden, 0 at its beginning and 1 at its end.
struct Hidden {
  double from = 0.0;
  double to = 0.0;
};

double area_of(const SeenFace& face) {
  return 0.5 * std::abs(cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]));
}

class Looker {
 public:
  Looker(const Scene& scene, const Camera& camera, double smallest, const Context& context)
      : scene_(scene),
        camera_(camera),
        smallest_(smallest),
        context_(context),
        faces_(seen_faces(scene, camera)),
        tree_(tree_of(faces_)) {
    const Box2 box = seen_box(scene, camera);
    size_ = std::max({box.size().x, box.size().y, 1e-300});
    origin_ = box.empty() ? Vec2{} : box.low;
  }

  View look() {
    find_what_lies_before();
    add_areas();
    add_lines();
    return std::move(view_);
  }

 private:
  static BoxTree<Box2> tree_of(const std::vector<SeenFace>& faces) {
    return {faces.size(), [&](std::uint32_t i) { return faces[i].box(); },
            [&](std::uint32_t i) {
              return (faces[i].corners[0] + faces[i].corners[1] + faces[i].corners[2]) / 3.0;
            }};
  }

  /// Calls visit(i) for the seen faces whose boxes meet this one.
  template <class Visit>
  void for_faces_near(const Box2& box, Visit visit) const {
    tree_.search([&](std::uint32_t node) { return meet(tree_.box(node), box); },
                 [&](std::uint32_t place) { visit(tree_.order()[place]); });
  }

  void find_what_lies_before() {
    before_.resize(faces_.size());
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      context_.check();
      const Box2 box = faces_[i].box();
      for_faces_near(box, [&](std::uint32_t j) {
        if (j > i && meet(box, faces_[j].box()) &&
            scene_.region[faces_[i].face] != scene_.region[faces_[j].face]) {
          order_pair(i, j);
        }
      });
    }
    // Large ones first: little is left for the others.
    for (std::vector<std::uint32_t>& before : before_) {
      if (before.size() > few_covers) {
        std::stable_sort(before.begin(), before.end(), [&](std::uint32_t a, std::uint32_t b) {
          return area_of(faces_[a]) > area_of(faces_[b]);
        });
      }
    }
  }

  void order_pair(std::uint32_t i, std::uint32_t j) {
    const auto middle = middle_of_overlap(faces_[i], faces_[j], touch_fraction * size_);
    if (!middle) {
      return;
    }
    const double nearer = faces_[i].depth_at(*middle) - faces_[j].depth_at(*middle);
    bool i_before = nearer > 0.0;
    if (std::abs(nearer) < same_depth_fraction * size_) {
      // Sheets that lie on each other: the printed side is seen, or that of the face with the smaller number.
      i_before = faces_[i].inside == faces_[j].inside || faces_[j].inside;
    }
    i_before ? before_[j].push_back(i) : before_[i].push_back(j);
  }

  [[nodiscard]] PlanarPolygon on_grid(std::span<const Vec2> outline) const {
    std::vector<PlanarPoint> corners;
    for (const Vec2 corner : outline) {
      const Vec2 p = grid_cells / size_ * (corner - origin_);
      corners.emplace_back(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)));
    }
    PlanarPolygon polygon;
    polygon.set(corners.begin(), corners.end());
    return polygon;
  }

  void add_areas() {
    std::vector<std::uint32_t> order(faces_.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto region = [&](std::uint32_t i) { return scene_.region[faces_[i].face]; };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return region(a) < region(b); });
    for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
      context_.check();
      std::vector<std::uint32_t> members;
      bool whole = true;
      for (end = first; end < order.size() && region(order[end]) == region(order[first]); ++end) {
        if (is_covered(order[end])) {
          whole = false;
        } else {
          members.push_back(order[end]);
          whole = whole && before_[order[end]].empty();
        }
      }
      if (members.empty()) {
        continue;
      }
      const SeenFace& face = faces_[order[first]];
      if (auto border = whole ? simple_border(members) : std::nullopt) {
        VisibleArea area{region(order[first]), face.face, face.inside, {}};
        keep_outline(std::move(*border), area);
        add_area(std::move(area));
      } else {
        add_area(face, what_is_left(members));
      }
    }
  }

  /// What is left of a face, in convex pieces, when those before it are cut away; nothing at all where these
  /// become more than `most`.
  [[nodiscard]] std::optional<std::vector<std::vector<Vec2>>> pieces_left(std::uint32_t i,
                                                                          std::size_t most) const {
    const SeenFace& face = faces_[i];
    const double touch = touch_fraction * size_;
    std::vector<std::vector<Vec2>> pieces{{face.corners.begin(), face.corners.end()}};
    for (const std::uint32_t j : before_[i]) {
      std::vector<std::vector<Vec2>> left;
      for (std::vector<Vec2>& piece : pieces) {
        if (lies_apart(faces_[j], piece)) {
          left.push_back(std::move(piece));
          continue;
        }
        std::vector<Vec2> rest = std::move(piece);
        for (std::size_t k = 0; k < 3 && rest.size() > 2; ++k) {
          const Vec2 a = faces_[j].corners[k];
          const Vec2 b = faces_[j].corners[(k + 1) % 3];
          std::vector<Vec2> beyond = left_of(rest, b, a);
          if (beyond.size() > 2 && is_wider(beyond, touch)) {
            left.push_back(std::move(beyond));
          }
          rest = left_of(rest, a, b);
        }
      }
      pieces = std::move(left);
      if (pieces.empty()) {
        break;
      }
      if (pieces.size() > most) {
        return std::nullopt;
      }
    }
    return pieces;
  }

  /// Whether a piece is on the other side of one of a face's sides.
  [[nodiscard]] static bool lies_apart(const SeenFace& face, const std::vector<Vec2>& piece) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 a = face.corners[k];
      const Vec2 side = face.corners[(k + 1) % 3] - a;
      if (std::all_of(piece.begin(), piece.end(), [&](Vec2 p) { return cross(side, p - a) <= 0.0; })) {
        return true;
      }
    }
    return false;
  }

  /// Whether nothing of a face is seen, where that is quickly found.
  [[nodiscard]] bool is_covered(std::uint32_t i) const {
    constexpr std::size_t most_pieces = 24;
    const auto pieces = pieces_left(i, most_pieces);
    return pieces && pieces->empty();
  }

  /// The outline of faces of one region, where it is one loop that meets no vertex twice.
  [[nodiscard]] std::optional<std::vector<Vec2>> simple_border(
      const std::vector<std::uint32_t>& members) const {
    const mesh::Surface& surface = *scene_.surface;
    // Ascending, as the faces of `members` are.
    const auto is_member = [&](FaceId face) {
      return std::ranges::binary_search(members, face, {}, [&](std::uint32_t i) { return faces_[i].face; });
    };
    std::map<VertexId, VertexId> next_of;
    for (const std::uint32_t i : members) {
      for (const unsigned k : {0U, 1U, 2U}) {
        const CornerId side = mesh::corner(faces_[i].face, k);
        const FaceId other = surface.neighbor(side);
        if ((!other.valid() || !is_member(other)) &&
            !next_of.emplace(surface.vertex(side), surface.vertex(mesh::next(side))).second) {
          return std::nullopt;
        }
      }
    }
    std::vector<Vec2> border;
    const VertexId first = next_of.begin()->first;
    for (VertexId at = first; border.empty() || at != first; at = next_of.at(at)) {
      border.push_back(camera_(surface.point(at)));
    }
    return border.size() == next_of.size() ? std::optional(std::move(border)) : std::nullopt;
  }

  /// Faces of one region without what lies before them.
  [[nodiscard]] PlanarSet what_is_left(const std::vector<std::uint32_t>& members) const {
    using planar::operators::operator-=;
    std::vector<std::uint32_t> covers;
    for (const std::uint32_t i : members) {
      covers.insert(covers.end(), before_[i].begin(), before_[i].end());
    }
    std::sort(covers.begin(), covers.end());
    covers.erase(std::unique(covers.begin(), covers.end()), covers.end());
    // A face that runs through the region's plane may lie before one of its faces and behind another.
    const bool crossing = std::any_of(covers.begin(), covers.end(), [&](std::uint32_t j) {
      return std::any_of(before_[j].begin(), before_[j].end(), [&](std::uint32_t i) {
        return scene_.region[faces_[i].face] == scene_.region[faces_[members.front()].face];
      });
    });
    if (covers.size() > few_covers) {
      if (auto seen = pieces_of(members)) {
        return *seen;
      }
    }
    const auto without = [&](PlanarSet seen, const std::vector<std::uint32_t>& before) {
      if (!before.empty()) {
        PlanarSet covered;
        for (const std::uint32_t j : before) {
          covered.insert(on_grid(faces_[j].corners));
        }
        seen -= covered;
      }
      return seen;
    };
    PlanarSet seen;
    for (const std::uint32_t i : members) {
      PlanarSet own;
      own.insert(on_grid(faces_[i].corners));
      seen.insert(crossing ? without(own, before_[i]) : own);
    }
    return crossing ? seen : without(seen, covers);
  }

  /// The same piece by piece, which is quicker where many lie before: what they have in common isn't united.
  [[nodiscard]] std::optional<PlanarSet> pieces_of(const std::vector<std::uint32_t>& members) const {
    constexpr std::size_t most_pieces = 2000;
    PlanarSet seen;
    for (const std::uint32_t i : members) {
      context_.check();
      const auto pieces = pieces_left(i, most_pieces);
      if (!pieces) {
        return std::nullopt;
      }
      for (const std::vector<Vec2>& piece : *pieces) {
        seen.insert(on_grid(piece));
      }
    }
    return seen;
  }

  void add_area(const SeenFace& face, const PlanarSet& seen) {
    std::vector<PlanarPolygon> polygons;
    seen.get(polygons);
    VisibleArea area{scene_.region[face.face], face.face, face.inside, {}};
    for (const PlanarPolygon& polygon : polygons) {
      std::vector<Vec2> outline;
      for (const PlanarPoint& p : polygon) {
        outline.push_back(origin_ +
                          size_ / grid_cells * Vec2{static_cast<double>(p.x()), static_cast<double>(p.y())});
      }
      keep_outline(std::move(outline), area);
    }
    add_area(std::move(area));
  }

  void keep_outline(std::vector<Vec2> outline, VisibleArea& area) const {
    if (is_wider(outline, smallest_)) {
      area.outlines.push_back(std::move(outline));
    }
  }

  void add_area(VisibleArea area) {
    if (!area.outlines.empty()) {
      view_.areas.push_back(std::move(area));
    }
  }

  void add_lines() {
    const mesh::Surface& surface = *scene_.surface;
    IdVector<FaceId, std::uint32_t> seen(surface.face_count(), Scene::hidden_region);
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
      seen[faces_[i].face] = i;
    }
    for (const EdgeId edge : ids<EdgeId>(surface.edge_count())) {
      context_.check();
      std::array<std::uint32_t, 2> beside{Scene::hidden_region, Scene::hidden_region};
      std::size_t count = 0;
      for (const CornerId side : surface.sides(edge)) {
        if (side.valid() && seen[mesh::face_of(side)] != Scene::hidden_region) {
          beside[count++] = seen[mesh::face_of(side)];
        }
      }
      if (count == 0) {
        continue;
      }
      const bool outline = count == 1 || faces_[beside[0]].inside != faces_[beside[1]].inside;
      if (outline || scene_.drawn[edge]) {
        add_line(edge, outline);
      }
    }
  }

  void add_line(EdgeId edge, bool outline) {
    const mesh::Surface& surface = *scene_.surface;
    const CornerId side = surface.sides(edge)[0];
    const std::array<VertexId, 2> ends{surface.vertex(side), surface.vertex(mesh::next(side))};
    const std::array<Vec2, 2> at{camera_(surface.point(ends[0])), camera_(surface.point(ends[1]))};
    const std::array<double, 2> depth{camera_.depth(surface.point(ends[0])),
                                      camera_.depth(surface.point(ends[1]))};
    const double size = length(at[1] - at[0]);
    if (!(size >= smallest_)) {
      return;
    }
    Box2 box;
    box.add(at[0]);
    box.add(at[1]);
    std::vector<Hidden> hidden;
    for_faces_near(box, [&](std::uint32_t i) {
      const auto vertices = surface.vertices(faces_[i].face);
      const auto has = [&](VertexId v) {
        return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
      };
      if (has(ends[0]) && has(ends[1])) {
        return;
      }
      const auto stretch = stretch_inside(faces_[i], at[0], at[1]);
      if (!stretch) {
        return;
      }
      const double middle = 0.5 * (stretch->from + stretch->to);
      const double own = depth[0] + middle * (depth[1] - depth[0]);
      if (faces_[i].depth_at(at[0] + middle * (at[1] - at[0])) > own + same_depth_fraction * size_) {
        hidden.push_back(*stretch);
      }
    });
    std::sort(hidden.begin(), hidden.end(), [](const Hidden& a, const Hidden& b) {
      return std::pair(a.from, a.to) < std::pair(b.from, b.to);
    });
    const auto add = [&](double from, double to) {
      if ((to - from) * size >= smallest_) {
        view_.lines.push_back({edge, at[0] + from * (at[1] - at[0]), at[0] + to * (at[1] - at[0]), outline});
      }
    };
    double from = 0.0;
    for (const Hidden& stretch : hidden) {
      add(from, stretch.from);
      from = std::max(from, stretch.to);
    }
    add(from, 1.0);
  }

  /// The stretch of a line that lies inside a face, its border left out; nothing where there is none.
  [[nodiscard]] std::optional<Hidden> stretch_inside(const SeenFace& face, Vec2 a, Vec2 b) const {
    Hidden stretch{0.0, 1.0};
    const double touch = touch_fraction * size_;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 p = face.corners[k];
      const Vec2 side = face.corners[(k + 1) % 3] - p;
      const double room = length(side);
      const double at_a = cross(side, a - p) / room - touch;
      const double at_b = cross(side, b - p) / room - touch;
      if (at_a <= 0.0 && at_b <= 0.0) {
        return std::nullopt;
      }
      if (at_a < 0.0) {
        stretch.from = std::max(stretch.from, at_a / (at_a - at_b));
      } else if (at_b < 0.0) {
        stretch.to = std::min(stretch.to, at_a / (at_a - at_b));
      }
    }
    return stretch.to > stretch.from ? std::optional(stretch) : std::nullopt;
  }

  const Scene& scene_;
  const Camera& camera_;
  double smallest_;
  const Context& context_;
  std::vector<SeenFace> faces_;
  BoxTree<Box2> tree_;
  double size_ = 1.0;
  Vec2 origin_;
  std::vector<std::vector<std::uint32_t>> before_;  ///< of each seen face: those that hide a part of it
  View view_;
};

}  // namespace

View look_at(const Scene& scene, const Camera& camera, double smallest, const Context& context) {
  return Looker(scene, camera, smallest, context).look();
}

}  // namespace ridgecraft::export_
