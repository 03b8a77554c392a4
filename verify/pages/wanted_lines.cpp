// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/geometry.hpp"
#include "verify/file/relations.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/pages/check_pages.hpp"

namespace ridgecraft::verify {
namespace {

/// Stretches as short as that are rounding, mm.
constexpr double hair_mm = 1e-6;

Box2 box_around(const Segment& s, double reach) {
  return grown(box_of(std::array{s.a, s.b}), reach);
}

std::vector<Box2> boxes_of(const std::vector<Segment>& lines) {
  std::vector<Box2> boxes;
  boxes.reserve(lines.size());
  for (const Segment& line : lines) {
    boxes.push_back(box_around(line, 0.0));
  }
  return boxes;
}

/// A stretch of a segment, as distances from its start.
struct Stretch {
  double from = INFINITY;
  double to = -INFINITY;

  /// The smallest stretch that holds both.
  void unite(const Stretch& other) {
    if (other.from <= other.to) {
      from = std::min(from, other.from);
      to = std::max(to, other.to);
    }
  }
};

/// Where low <= offset + slope u <= high.
Stretch between(double offset, double slope, double low, double high) {
  if (slope == 0.0) {
    return offset >= low && offset <= high ? Stretch{-INFINITY, INFINITY} : Stretch{};
  }
  const double one = (low - offset) / slope;
  const double two = (high - offset) / slope;
  return {std::min(one, two), std::max(one, two)};
}

Stretch both(const Stretch& a, const Stretch& b) {
  return {std::max(a.from, b.from), std::min(a.to, b.to)};
}

/// Where the line from `start` along the unit vector `along` is within the radius of a point.
Stretch near_point(Vec2 start, Vec2 along, Vec2 p, double radius) {
  const double foot = dot(p - start, along);
  const double height = cross(along, p - start);
  const double square = radius * radius - height * height;
  return square >= 0.0 ? Stretch{foot - std::sqrt(square), foot + std::sqrt(square)} : Stretch{};
}

/// Where it is within the radius of a segment. What is that near to a segment is convex, so it is one
/// stretch: that in the band along the segment and those in the discs around its ends, together.
Stretch near_segment(Vec2 start, Vec2 along, const Segment& s, double radius) {
  Stretch result = near_point(start, along, s.a, radius);
  result.unite(near_point(start, along, s.b, radius));
  const double size = s.length();
  if (size > 0.0) {
    const Vec2 way = (s.b - s.a) / size;
    result.unite(both(between(cross(way, start - s.a), cross(way, along), -radius, radius),
                      between(dot(way, start - s.a), dot(way, along), 0.0, size)));
  }
  return result;
}

/// Which kinds a fold of an angle may be drawn as, and whether it has to be drawn at all.
struct Way {
  bool mountain = false, valley = false, none = false;
};

Way look_of(double angle, double tolerance, double hidden_deg) {
  const double size = std::abs(angle);
  const bool may = size >= std::max(hidden_deg, flat_fold_deg) - tolerance;
  // Folded shut, both signs hold.
  const bool shut = size >= 180.0 - tolerance;
  const bool must = size >= std::max(hidden_deg, flat_region_fold_deg) + tolerance;
  return {may && (angle < 0.0 || shut), may && (angle > 0.0 || shut), !must};
}

class Collector {
 public:
  explicit Collector(const Case& given)
      : given_(given),
        file_(given.file),
        hidden_deg_(file_.settings.number("hide_folds_deg").value_or(default_hidden_deg)),
        pages_(file_.pages.size()) {}

  std::vector<WantedPage> collect() {
    find_open_vertices();
    for (Index edge = 0; edge < file_.edges.size(); ++edge) {
      given_.relations.sides_of(edge).size() == 1 ? add_border(edge) : add_fold(edge);
    }
    for (Index tab = 0; tab < file_.tabs.size(); ++tab) {
      add_tab(file_.tabs[tab]);
      if (const Index side = target_of_slit(file_, given_.relations, tab); side != none) {
        const auto& slit = *file_.tabs[tab].slit;
        add_cut(file_.face_piece[file_.faces.face(side)], {slit[0], slit[1]});
      }
    }
    for (const GlueOutline& spot : file_.glue) {
      add_glue(spot);
    }
    return std::move(pages_);
  }

 private:
  [[nodiscard]] Index piece_of(Index edge) const {
    return file_.face_piece[file_.faces.face(given_.relations.sides_of(edge).front())];
  }
  [[nodiscard]] Segment segment(Index edge) const {
    const auto [a, b] = file_.edges[edge].ends;
    return {file_.points[a], file_.points[b]};
  }

  void allow(Index piece, LineKind kind, const Segment& line) {
    const Index page = file_.pieces[piece].page;
    const Vec2 origin = file_.pages[page].low;
    pages_[page].allowed[static_cast<std::size_t>(kind)].push_back({line.a - origin, line.b - origin});
  }
  void want(Index piece, LineKind kind, const Segment& line) {
    const Index page = file_.pieces[piece].page;
    const Vec2 origin = file_.pages[page].low;
    pages_[page].wanted.push_back({{line.a - origin, line.b - origin}, piece, kind});
  }

  void find_open_vertices() {
    open_.assign(file_.points.size(), false);
    tabs_at_.resize(file_.edges.size());
    for (const Edge& edge : file_.edges) {
      if (edge.assignment == Assignment::cut) {
        open_[edge.ends[0]] = open_[edge.ends[1]] = true;
      }
    }
    for (Index tab = 0; tab < file_.tabs.size(); ++tab) {
      for (const Index edge : file_.tabs[tab].edges) {
        tabs_at_[edge].push_back(tab);
      }
    }
  }

  /// The edge less what tabs cover of it; their own sides are added with them.
  void add_border(Index edge) {
    const Segment line = segment(edge);
    const double size = line.length();
    std::vector<std::pair<double, double>> covered;
    for (const Index tab : tabs_at_[edge]) {
      const Vec2 along = size > 0.0 ? (line.b - line.a) / size : Vec2{};
      const double one = dot(file_.tabs[tab].polygon[0] - line.a, along);
      const double two = dot(file_.tabs[tab].polygon[1] - line.a, along);
      covered.emplace_back(std::min(one, two), std::max(one, two));
    }
    std::sort(covered.begin(), covered.end());
    covered.emplace_back(size, size);
    double at = 0.0;
    for (const auto& [from, to] : covered) {
      if (from > at) {
        const double fraction_at = at / size;
        const double fraction_from = std::min(from, size) / size;
        const Vec2 whole = line.b - line.a;
        add_cut(piece_of(edge), {line.a + fraction_at * whole, line.a + fraction_from * whole});
      }
      at = std::max(at, to);
    }
  }

  void add_cut(Index piece, const Segment& line) {
    allow(piece, LineKind::cut, line);
    want(piece, LineKind::cut, line);
  }

  void add_fold(Index edge) {
    const auto [a, b] = file_.edges[edge].ends;
    const Index piece = piece_of(edge);
    const Segment line = segment(edge);
    const double angle = file_.edges[edge].angle_deg;
    // A cut inside a flat region with both ends inside stands in the file as a fold (section 2 of the
    // contract).
    if (std::abs(angle) < flat_region_fold_deg && !open_[a] && !open_[b]) {
      allow(piece, LineKind::cut, line);
    }
    if (!file_.edges[edge].bent) {
      add_look(piece, line, look_of(angle, angle_tolerance_deg, hidden_deg_), LineKind::mountain,
               LineKind::valley);
    }
  }

  void add_look(Index piece, const Segment& line, const Way& look, LineKind mountain, LineKind valley) {
    if (look.mountain) {
      allow(piece, mountain, line);
    }
    if (look.valley) {
      allow(piece, valley, line);
    }
    if (!look.none) {
      want(piece, look.mountain ? mountain : valley, line);
    }
  }

  void add_tab(const Tab& tab) {
    const Index piece = piece_of(tab.edge);
    for (std::size_t i = 1; i < tab.polygon.size(); ++i) {
      add_cut(piece, {tab.polygon[i], tab.polygon[(i + 1) % tab.polygon.size()]});
    }
    const Segment base{tab.polygon[0], tab.polygon[1]};
    const Index side = model_side_of(file_, given_.relations, tab.edge);
    ModelFold fold{0.0, std::numeric_limits<double>::infinity()};
    if (side != none && file_.model.twin[side] != none) {
      fold = model_fold(file_, given_.relations, side);
    }
    Way look = file_.edges[tab.edge].bent ? Way{.none = true}
                                          : look_of(fold.angle_deg, fold.tolerance_deg, hidden_deg_);
    if (look.none) {
      allow(piece, LineKind::tab_flat, base);
    }
    if (look.none || !(look.mountain || look.valley)) {
      want(piece, LineKind::tab_flat, base);
      look.none = true;  // what it may look like besides is only allowed
    }
    add_look(piece, base, look, LineKind::tab_mountain, LineKind::tab_valley);
  }

  void add_glue(const GlueOutline& spot) {
    for (const std::vector<Vec2>& outline : spot.outlines) {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Segment line{outline[i], outline[(i + 1) % outline.size()]};
        allow(spot.piece, LineKind::glue, line);
        want(spot.piece, LineKind::glue, line);
      }
    }
  }

  const Case& given_;
  const File& file_;
  double hidden_deg_;
  std::vector<WantedPage> pages_;
  std::vector<bool> open_;                   ///< per vertex of the nets: a cut ends there
  std::vector<std::vector<Index>> tabs_at_;  ///< per edge
};

}  // namespace

double distance(Vec2 p, const Segment& s) {
  return distance_to_segment(p, s.a, s.b);
}

LineSet::LineSet(std::vector<Segment> lines) : lines_(std::move(lines)), tree_(boxes_of(lines_)) {}

std::optional<Bare> LineSet::bare(const Segment& segment, double tolerance) const {
  const double size = segment.length();
  if (!(size > hair_mm)) {
    return distance_to(segment.a, tolerance) ? std::nullopt : std::optional(Bare{0.0, segment.a});
  }
  const Vec2 along = (segment.b - segment.a) / size;
  std::vector<Stretch> near;
  tree_.for_each_overlapping(box_around(segment, tolerance), [&](std::size_t i) {
    const Stretch stretch = near_segment(segment.a, along, lines_[i], tolerance);
    if (stretch.from <= stretch.to) {
      near.push_back(stretch);
    }
  });
  std::sort(near.begin(), near.end(), [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
  near.push_back({size, size});
  std::optional<Bare> result;
  double at = 0.0;
  for (const Stretch& stretch : near) {
    if (const double gap = std::min(stretch.from, size) - at; gap > hair_mm) {
      if (!result) {
        result = Bare{0.0, segment.a + (at + 0.5 * gap) * along};
      }
      result->length += gap;
    }
    at = std::max(at, stretch.to);
  }
  return result;
}

std::optional<double> LineSet::distance_to(Vec2 p, double reach) const {
  double best = INFINITY;
  tree_.for_each_overlapping(box_around({p, p}, reach),
                             [&](std::size_t i) { best = std::min(best, verify::distance(p, lines_[i])); });
  return best <= reach ? std::optional(best) : std::nullopt;
}

std::vector<WantedPage> wanted_lines(const Case& given) {
  return Collector(given).collect();
}

}  // namespace ridgecraft::verify
