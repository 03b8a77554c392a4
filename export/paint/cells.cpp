// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/paint/cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "base/boxes.hpp"
#include "base/elementary.hpp"
#include "base/geometry.hpp"
#include "export/page/lines.hpp"

namespace ridgecraft::export_ {
namespace {

/// Ends of lines that are one point on paper, mm.
constexpr double same_point_mm = 0.03;
/// A rim that is narrower isn't worth its ink, mm.
constexpr double narrowest_bleed_mm = 0.05;
/// Where something lies near a part of an edge, its rim is as wide as there is room for every so many mm.
constexpr double strip_mm = 1.0;
/// Outlines that run back beside an edge bound no rim, radians.
constexpr double smallest_gap = 0.02;

double distance(const Segment2& s, Vec2 p) {
  return distance_to_segment(p, s.a, s.b);
}

double distance(const Segment2& s, const Segment2& t) {
  return cross_each_other(s, t)
             ? 0.0
             : std::min({distance(s, t.a), distance(s, t.b), distance(t, s.a), distance(t, s.b)});
}

std::vector<Segment2> outlines_of(const PieceDrawing& piece) {
  std::vector<Segment2> segments;
  for (const Line& line : piece.group.lines) {
    if (line.layer == Layer::cut) {
      for (std::size_t i = 1; i < line.points.size(); ++i) {
        segments.push_back({line.points[i - 1], line.points[i]});
      }
      if (line.closed) {
        segments.push_back({line.points.back(), line.points.front()});
      }
    }
  }
  return segments;
}

/// Between 0 and a full turn, from one direction to another, against the clock.
double turn_between(Vec2 from, Vec2 to) {
  const double angle = elementary::atan2(cross(from, to), dot(from, to));
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

Vec2 turned(Vec2 v, double angle) {
  return {elementary::cos(angle) * v.x - elementary::sin(angle) * v.y,
          elementary::sin(angle) * v.x + elementary::cos(angle) * v.y};
}

class RimMaker {
 public:
  RimMaker(const std::vector<PieceDrawing>& page, std::size_t own) : own_(outlines_of(page[own])) {
    for (std::size_t i = 0; i < page.size(); ++i) {
      const std::vector<Segment2> outlines = i == own ? own_ : outlines_of(page[i]);
      all_.insert(all_.end(), outlines.begin(), outlines.end());
    }
  }

  /// Beyond an edge whose face lies on its left: one strip, or, where something lies near a part of it,
  /// several of different width; none where there is no room.
  [[nodiscard]] std::vector<std::vector<Vec2>> beyond(const Segment2& edge) const {
    const double size = length(edge.b - edge.a);
    if (!(size > 0.0)) {
      return {};
    }
    const std::vector<Segment2> near = outlines_in_front(edge);
    const std::vector<ShortGap> gaps = short_gaps(edge);
    const auto count = reach_of(edge, near) < bleed_mm || !gaps.empty()
                           ? static_cast<std::size_t>(std::ceil(size / strip_mm))
                           : 1;
    const auto at = [&](std::size_t i) {
      return i == count ? edge.b
                        : edge.a + (static_cast<double>(i) / static_cast<double>(count)) * (edge.b - edge.a);
    };
    // How wide it is at the ends of these parts: as on the narrower side.
    std::vector<double> width(count + 1, bleed_mm);
    for (std::size_t i = 0; i < count; ++i) {
      const Segment2 part{at(i), at(i + 1)};
      double reach = reach_of(part, near);
      for (const ShortGap& gap : gaps) {
        // Behind its end a line is in the way as any other.
        if (gap.extent <= std::min(length(part.a - gap.corner), length(part.b - gap.corner))) {
          reach = std::min(reach, 0.5 * distance(part, gap.line));
        }
      }
      width[i] = std::min(width[i], reach);
      width[i + 1] = reach;
    }
    std::vector<std::vector<Vec2>> strips;
    for (std::size_t i = 0; i < count;) {
      const std::size_t first = i++;
      while (gaps.empty() && i < count && width[first] == width[i] && width[i] == width[i + 1]) {
        ++i;
      }
      if (std::max(width[first], width[i]) < narrowest_bleed_mm) {
        continue;
      }
      std::vector<Vec2> strip = strip_beyond(edge, {at(first), at(i)}, width[first], width[i]);
      if (!strip.empty()) {
        strips.push_back(std::move(strip));
      }
    }
    return strips;
  }

 private:
  /// What could bound the edge's rim but for what meets its ends: there rims share the gap.
  [[nodiscard]] std::vector<Segment2> outlines_in_front(const Segment2& edge) const {
    const double far = 2.0 * bleed_mm;
    const Box2 box = box_of(std::array{edge.a, edge.b});
    const Vec2 out = -perpendicular(edge.b - edge.a) / length(edge.b - edge.a);
    std::vector<Segment2> found;
    for (const Segment2& other : all_) {
      if (std::max(other.a.x, other.b.x) < box.low.x - far ||
          std::min(other.a.x, other.b.x) > box.high.x + far ||
          std::max(other.a.y, other.b.y) < box.low.y - far ||
          std::min(other.a.y, other.b.y) > box.high.y + far || distance(other, edge.a) < same_point_mm ||
          distance(other, edge.b) < same_point_mm) {
        continue;
      }
      if (const auto front = in_front(other, edge.a, out)) {
        found.push_back(*front);
      }
    }
    return found;
  }

  /// A line that meets an end of an edge in front of it, and ends beside it.
  struct ShortGap {
    Segment2 line;        ///< from the corner
    Vec2 corner;          ///< the edge's end
    double extent = 0.0;  ///< how far along the edge it goes
  };
  [[nodiscard]] std::vector<ShortGap> short_gaps(const Segment2& edge) const {
    const double size = length(edge.b - edge.a);
    const Vec2 along = (edge.b - edge.a) / size;
    const Vec2 out = -perpendicular(along);
    std::vector<ShortGap> gaps;
    for (const bool at_a : {true, false}) {
      const Vec2 corner = at_a ? edge.a : edge.b;
      const Vec2 way = at_a ? along : -along;
      for (const Segment2& other : own_) {
        if (distance(other, corner) > same_point_mm) {
          continue;
        }
        for (const Vec2 end : {other.a, other.b}) {
          const double extent = dot(end - corner, way);
          if (dot(end - corner, out) > same_point_mm && extent > same_point_mm && extent < size) {
            gaps.push_back({{corner, end}, corner, extent});
          }
        }
      }
    }
    return gaps;
  }

  /// Half the way to the nearest of them.
  [[nodiscard]] static double reach_of(const Segment2& part, const std::vector<Segment2>& in_front) {
    double reach = bleed_mm;
    for (const Segment2& other : in_front) {
      reach = std::min(reach, 0.5 * distance(part, other));
    }
    return reach;
  }

  /// Beyond a part of an edge, so wide at its two ends; where these are the edge's, it goes on round the
  /// corner.
  [[nodiscard]] std::vector<Vec2> strip_beyond(const Segment2& edge, const Segment2& part, double at_a,
                                               double at_b) const {
    const Vec2 along = (edge.b - edge.a) / length(edge.b - edge.a);
    const Vec2 out = -perpendicular(along);
    const Vec2 begin = part.a == edge.a ? edge.a - at_a * along : part.a;
    const Vec2 end = part.b == edge.b ? edge.b + at_b * along : part.b;
    std::vector<Vec2> strip{end, begin, begin + at_a * out, end + at_b * out};
    strip = cut_at_corner(std::move(strip), {edge.a, along, -1.0, at_a, length(part.a - edge.a)});
    return cut_at_corner(std::move(strip), {edge.b, -along, 1.0, at_b, length(part.b - edge.b)});
  }

  static std::optional<Segment2> in_front(Segment2 s, Vec2 at, Vec2 out) {
    double a = dot(s.a - at, out) - same_point_mm;
    double b = dot(s.b - at, out) - same_point_mm;
    if (a <= 0.0 && b <= 0.0) {
      return std::nullopt;
    }
    if (a < 0.0) {
      s.a = s.a + a / (a - b) * (s.b - s.a);
    } else if (b < 0.0) {
      s.b = s.b + b / (b - a) * (s.a - s.b);
    }
    return s;
  }

  /// An end of an edge of the outline, with the rim beyond it.
  struct RimEnd {
    Vec2 corner;
    Vec2 way;      ///< from the corner along the edge
    double sense;  ///< 1 where the rim lies against the clock of it, else -1
    double reach;  ///< width of the rim
    double from;   ///< how far along the edge the rim begins: what ends before shares nothing with it
  };
  /// Two rims that meet at a corner share the gap between their edges.
  [[nodiscard]] std::vector<Vec2> cut_at_corner(std::vector<Vec2> rim, const RimEnd& rim_end) const {
    const auto [corner, way, sense, reach, from] = rim_end;
    double gap = 2.0 * std::numbers::pi;
    bool met = false;
    for (const Segment2& other : own_) {
      if (distance(other, corner) > same_point_mm) {
        continue;
      }
      for (const Vec2 end : {other.a, other.b}) {
        const double extent = dot(end - corner, way);
        const bool ends_before = extent > same_point_mm && extent <= from;
        if (length(end - corner) > same_point_mm && !ends_before) {
          const double turn = sense > 0.0 ? turn_between(way, end - corner) : turn_between(end - corner, way);
          if (turn > smallest_gap && turn < 2.0 * std::numbers::pi - smallest_gap) {
            gap = std::min(gap, turn);
            met = true;
          }
        }
      }
    }
    if (!met) {
      return clipped(rim, corner, -way);
    }
    const Vec2 bisector = turned(way, 0.5 * sense * gap);
    rim = clipped(rim, corner, sense * perpendicular(bisector));
    // Round a tip of the piece it reaches no farther than anywhere else.
    return gap > std::numbers::pi ? clipped(rim, corner + reach * bisector, bisector) : rim;
  }

  std::vector<Segment2> own_;
  std::vector<Segment2> all_;
};

/// The strip of a tab beside its edge, with the face that covers the tab laid beside the edge. Of a tab that
/// goes into a slit it is the neck, which is laid on that face and seen.
Cell strip_on(const unfold::Tab& tab, const Segment2& edge, const mesh::Surface& surface,
              const unfold::Nets& nets, const Placement& placement) {
  const CornerId twin = surface.twin(tab.side);
  const auto& flat = nets.flat[mesh::face_of(twin)];
  const Vec2 there = flat[mesh::next(twin).value() % 3] - flat[twin.value() % 3];
  const Vec2 here = edge.a - edge.b;
  const double squared = dot(there, there);
  Cell strip{CellKind::tab, {}, mesh::face_of(twin), {}, {}};
  if (!(squared > 0.0)) {
    return strip;
  }
  const Turn turn{dot(there, here) / squared, cross(there, here) / squared};
  for (std::size_t k = 0; k < 3; ++k) {
    strip.at[k] = edge.b + turn(flat[k] - flat[twin.value() % 3]);
  }
  for (const Vec2 p : tab.polygon) {
    strip.polygon.push_back(placement(p));
  }
  if (tab.slit) {
    strip.polygon.erase(strip.polygon.begin() + 3, strip.polygon.end() - 1);
    return strip;
  }
  const Vec2 out = -perpendicular(edge.b - edge.a) / length(edge.b - edge.a);
  strip.polygon = clipped(strip.polygon, edge.a + bleed_mm * out, out);
  return strip;
}

/// What the tabs of an edge leave of it.
std::vector<Segment2> bare_of_tabs(const Segment2& edge, const std::vector<const unfold::Tab*>& tabs,
                                   const Placement& placement) {
  // A tab's base runs against the face's side, and may be shorter.
  std::vector<Segment2> bases;
  for (const unfold::Tab* tab : tabs) {
    bases.push_back({placement(tab->polygon[1]), placement(tab->polygon[0])});
  }
  std::ranges::sort(bases, {}, [&](const Segment2& base) { return length(base.a - edge.a); });
  std::vector<Segment2> bare;
  Vec2 from = edge.a;
  bases.push_back({edge.b, edge.b});
  for (const Segment2& base : bases) {
    if (length(base.a - from) > same_point_mm) {
      bare.push_back({from, base.a});
    }
    from = base.b;
  }
  return bare;
}

}  // namespace

std::array<double, 3> weights_at(const std::array<Vec2, 3>& triangle, Vec2 p) {
  const Vec2 u = triangle[1] - triangle[0];
  const Vec2 v = triangle[2] - triangle[0];
  const double area = cross(u, v);
  if (!(std::abs(area) > 0.0)) {
    return {1.0, 0.0, 0.0};
  }
  const Vec2 d = p - triangle[0];
  const double second = cross(d, v) / area;
  const double third = cross(u, d) / area;
  return {1.0 - second - third, second, third};
}

std::array<double, 3> kept_within(std::array<double, 3> weights) {
  if (weights[0] < 0.0 || weights[1] < 0.0 || weights[2] < 0.0) {
    double sum = 0.0;
    for (double& weight : weights) {
      weight = std::max(weight, 0.0);
      sum += weight;
    }
    for (double& weight : weights) {
      weight /= sum;
    }
  }
  return weights;
}

std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, Vec2 at, Vec2 normal) {
  std::vector<Vec2> kept = part_where(polygon, [&](Vec2 p) { return -dot(p - at, normal); });
  return kept.size() < 3 ? std::vector<Vec2>() : kept;
}

std::vector<Cell> cells_of(const PieceOnPage& piece, const std::vector<PieceDrawing>& page, std::size_t own) {
  const mesh::Surface& surface = piece.surface();
  const unfold::Nets& nets = piece.nets;
  std::map<CornerId, std::vector<const unfold::Tab*>> tabs_at;
  for (const TabId id : piece.contents.tabs) {
    tabs_at[nets.tabs[id].side].push_back(&nets.tabs[id]);
  }
  const RimMaker rims(page, own);
  std::vector<Cell> faces;
  std::vector<Cell> rest;
  for (const FaceId f : nets.pieces[piece.piece].faces) {
    Cell face{CellKind::face, {}, f, {}, {}};
    for (unsigned k = 0; k < 3; ++k) {
      face.at[k] = piece.corner(mesh::corner(f, k));
    }
    face.polygon.assign(face.at.begin(), face.at.end());
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId side = mesh::corner(f, k);
      if (nets.use[surface.edge(side)] == unfold::EdgeUse::fold) {
        continue;
      }
      const Segment2 edge{piece.corner(side), piece.corner(mesh::next(side))};
      const auto add_rim = [&](const Segment2& cut) {
        for (std::vector<Vec2>& strip : rims.beyond(cut)) {
          rest.push_back({CellKind::bleed, std::move(strip), f, face.at, {}});
        }
      };
      const auto tabs = tabs_at.find(side);
      if (tabs == tabs_at.end() || !surface.twin(side).valid()) {
        add_rim(edge);  // a tab at a border is covered by nothing: the face's own colours reach onto it
        continue;
      }
      for (const Segment2& bare : bare_of_tabs(edge, tabs->second, piece.placement)) {
        add_rim(bare);
      }
      for (const unfold::Tab* tab : tabs->second) {
        rest.push_back(strip_on(*tab, edge, surface, nets, piece.placement));
      }
    }
    faces.push_back(std::move(face));
  }
  // Strips over rims: a tab's neighbours reach onto it.
  std::stable_sort(rest.begin(), rest.end(), [](const Cell& a, const Cell& b) { return a.kind < b.kind; });
  faces.insert(faces.end(), std::make_move_iterator(rest.begin()), std::make_move_iterator(rest.end()));
  std::erase_if(faces, [](const Cell& cell) { return cell.polygon.empty(); });
  for (Cell& cell : faces) {
    cell.box = box_of(cell.polygon);
  }
  return faces;
}

}  // namespace ridgecraft::export_
