// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 5: tabs, the slits that they are put through, and the paper that they hang on.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/geometry.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/geometry.hpp"

namespace ridgecraft::verify {

// Promise 5, tabs: each grows from an edge of the joins that name it, outwards, and its base lies on that
// edge.

namespace {

/// Per tab the joins that name it.
std::vector<std::vector<Index>> joins_of_tabs(const File& file) {
  std::vector<std::vector<Index>> result(file.tabs.size());
  for (Index j = 0; j < file.joins.size(); ++j) {
    if (file.joins[j].tab != none) {
      result[file.joins[j].tab].push_back(j);
    }
  }
  return result;
}

std::vector<std::int64_t> sorted_once(std::vector<std::int64_t> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

/// An edge along the base of its tab: where it begins and ends, measured in mm from the base's first corner.
struct Span {
  double begin = 0.0, end = 0.0;
};

class TabCheck {
 public:
  TabCheck(const Case& given, Index tab, const std::vector<Index>& joins, Findings& findings)
      : file_(given.file),
        relations_(given.relations),
        given_(given),
        number_(tab),
        tab_(given.file.tabs[tab]),
        joins_(joins),
        findings_(findings) {}

  void run() {
    check_shape();
    if (tab_.additional) {
      check_additional();
    } else {
      check_joins_known();
      check_edges();
    }
    const Index piece = piece_of_edge(file_, relations_, tab_.edge);
    if (std::any_of(tab_.edges.begin(), tab_.edges.end(),
                    [&](Index e) { return piece_of_edge(file_, relations_, e) != piece; })) {
      add("grows from edges of several pieces");
    } else {
      check_base();
    }
  }

 private:
  void add(std::string_view what) {
    findings_.add(Promise::joins, {{"tab", number_}, {"edge", tab_.edge}},
                  [&] { return fmt::format("{} {}", tab_name(file_, number_), what); });
  }

  void check_shape() {
    if (!(doubled_area(tab_.polygon) > 0.0)) {
      add("is not counterclockwise, or has no area");
    } else if (!is_convex(tab_.polygon) && !is_simple(tab_.polygon, given_.context)) {
      add("crosses or touches itself");
    }
  }

  void check_joins_known() {
    std::vector<std::int64_t> named;
    for (const Index j : joins_) {
      named.push_back(file_.joins[j].number);
      const auto& edges = file_.joins[j].edges;
      if (!grows_from(edges[0]) && !grows_from(edges[1])) {
        ++findings_.figures().bad_joins;
        findings_.add(Promise::joins, {{"join", j}, {"tab", number_}}, [&] {
          return fmt::format("{} names {}, which grows from none of its edges", join_name(file_, j),
                             tab_name(file_, number_));
        });
      }
    }
    if (sorted_once(named) != sorted_once(tab_.numbers)) {
      add(joins_.empty() ? "is named by no join"
                         : "states other numbers than those of the joins that name it");
    }
  }

  /// A second tab of one join, on the side that its first one isn't on unless both have slits; or at a
  /// border, and of no join.
  void check_additional() {
    if (!joins_.empty()) {
      add("is named by a join, but stands among the additional ones");
      return;
    }
    const auto& all = file_.joins;
    const auto has_edge = [this](const Join& join) {
      return join.edges[0] == tab_.edge || join.edges[1] == tab_.edge;
    };
    const auto join = std::find_if(all.begin(), all.end(), has_edge);
    if (tab_.edges.size() != 1 || file_.edges[tab_.edge].assignment != Assignment::cut) {
      add("is an additional one and grows from more than one edge, or from a fold");
    } else if (tab_.foot && join != all.end()) {
      add("is one of a foot and grows from an edge that is glued to another one");
    } else if (join == all.end()) {
      if (!tab_.numbers.empty()) {
        add("states a number, but nothing is glued to its edge");
      }
    } else if (tab_.numbers != std::vector<std::int64_t>{join->number}) {
      add("states other numbers than that of its edge");
    } else if (join->tab == none ||
               (file_.tabs[join->tab].edge == tab_.edge && !(tab_.slit && file_.tabs[join->tab].slit))) {
      add("is the second one of a join that has no tab on its other side");
    }
  }

  [[nodiscard]] bool grows_from(Index edge) const {
    return std::find(tab_.edges.begin(), tab_.edges.end(), edge) != tab_.edges.end();
  }

  void check_edges() {
    std::vector<Index> joined;
    for (const Index j : joins_) {
      joined.insert(joined.end(), file_.joins[j].edges.begin(), file_.joins[j].edges.end());
    }
    std::sort(joined.begin(), joined.end());
    for (const Index e : tab_.edges) {
      if (file_.edges[e].assignment != Assignment::cut) {
        add(fmt::format("grows from edge {}, which is a fold", e));
      } else if (!std::binary_search(joined.begin(), joined.end(), e)) {
        add(fmt::format("grows from edge {}, but no join of that edge names it", e));
      }
    }
  }

  /// The edge as the tab sees it: against the direction of its face.
  [[nodiscard]] std::pair<Vec2, Vec2> ends(Index edge) const {
    const Index side = relations_.sides_of(edge).front();
    return {file_.points[file_.faces.head(side)], file_.points[file_.faces.tail(side)]};
  }

  void check_base() {
    const Vec2 base = tab_.polygon[1] - tab_.polygon[0];
    const double size = length(base);
    if (!(size > 0.0)) {
      add("has no base: its first two corners are one point");
      return;
    }
    const bool seam = tab_.edges.size() > 1;
    const double tolerance = seam ? seam_tolerance_mm : tab_base_tolerance_mm;
    std::vector<Span> spans;
    bool on_line = true;
    bool against_face = true;
    for (const Index e : tab_.edges) {
      const auto [begin, end] = ends(e);
      on_line = on_line &&
                (seam ? line_distance(tab_.polygon[0], base, begin, end)
                      : line_distance(begin, end - begin, tab_.polygon[0], tab_.polygon[1])) <= tolerance;
      spans.push_back({dot(begin - tab_.polygon[0], base) / size, dot(end - tab_.polygon[0], base) / size});
      against_face = against_face && spans.back().end > spans.back().begin;
    }
    std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.begin < b.begin; });
    const auto gap = [tolerance](const Span& a, const Span& b) {
      return std::abs(b.begin - a.end) > tolerance;
    };
    if (!on_line) {
      add("has a base that doesn't lie on its edge");
    } else if (!against_face) {
      add("has a base that runs with the face instead of against it");
    } else if (spans.front().begin > tolerance || size - spans.back().end > tolerance) {
      add("has a base that goes beyond the ends of its edge");
    } else if (std::adjacent_find(spans.begin(), spans.end(), gap) != spans.end()) {
      add("grows from edges that don't follow on each other");
    }
  }

  /// The greater distance of p and q from the line through `origin` along `direction`.
  static double line_distance(Vec2 origin, Vec2 direction, Vec2 p, Vec2 q) {
    const double size = length(direction);
    if (!(size > 0.0)) {
      return std::max(length(p - origin), length(q - origin));
    }
    return std::max(std::abs(cross(direction, p - origin)), std::abs(cross(direction, q - origin))) / size;
  }

  const File& file_;
  const Relations& relations_;
  const Case& given_;
  Index number_;
  const Tab& tab_;
  const std::vector<Index>& joins_;
  Findings& findings_;
};

// Promise 5, slits: each lies where its tab comes when it is laid on the face beyond its edge, lets the neck
// through and holds the head, and keeps away from all cuts and folds of its piece and from other slits.

struct SlitLine {
  Vec2 a, b;
};

double apart(const SlitLine& s, const SlitLine& t) {
  const Vec2 along = s.b - s.a;
  const Vec2 other = t.b - t.a;
  const bool crosses = cross(along, t.a - s.a) * cross(along, t.b - s.a) < 0.0 &&
                       cross(other, s.a - t.a) * cross(other, s.b - t.a) < 0.0;
  return crosses ? 0.0 : segment_distance(s.a, s.b, t.a, t.b);
}

class SlitCheck {
 public:
  SlitCheck(const Case& given, Findings& findings)
      : file_(given.file), relations_(given.relations), context_(given.context), findings_(findings) {}

  void run() {
    for (Index tab = 0; tab < file_.tabs.size(); ++tab) {
      if (!file_.tabs[tab].slit) {
        continue;
      }
      if (const Index side = target_of_slit(file_, relations_, tab); side != none) {
        slits_[file_.face_piece[file_.faces.face(side)]].push_back(tab);
      } else {
        add(tab, "has a slit, but no join tells where that is");
      }
    }
    if (slits_.empty()) {
      return;
    }
    gather_lines();
    for (const auto& [piece, tabs] : slits_) {
      for (const Index tab : tabs) {
        context_.check();
        check_place(tab, piece);
        check_tab(tab);
      }
    }
  }

 private:
  void add(Index tab, std::string_view what) {
    findings_.add(Promise::joins, {{"tab", tab}, {"edge", file_.tabs[tab].edge}},
                  [&] { return fmt::format("{} {}", tab_name(file_, tab), what); });
  }
  [[nodiscard]] SlitLine slit(Index tab) const {
    return {(*file_.tabs[tab].slit)[0], (*file_.tabs[tab].slit)[1]};
  }

  /// Cuts and folds of the pieces that have slits.
  void gather_lines() {
    for (Index e = 0; e < file_.edges.size(); ++e) {
      const Edge& edge = file_.edges[e];
      const auto sides = relations_.sides_of(e);
      if (sides.empty() ||
          (edge.assignment != Assignment::cut && std::abs(edge.angle_deg) < flat_region_fold_deg)) {
        continue;
      }
      const Index piece = file_.face_piece[file_.faces.face(sides.front())];
      if (slits_.contains(piece)) {
        lines_[piece].push_back({file_.points[edge.ends[0]], file_.points[edge.ends[1]]});
      }
    }
    for (Index face = 0; face < file_.faces.faces(); ++face) {
      if (slits_.contains(file_.face_piece[face])) {
        faces_[file_.face_piece[face]].push_back(face);
      }
    }
  }

  void check_place(Index tab, Index piece) {
    const SlitLine own = slit(tab);
    const Vec2 middle = 0.5 * (own.a + own.b);
    if (std::ranges::none_of(faces_[piece],
                             [&](Index face) { return inside(std::array{file_.polygon(face)}, middle); })) {
      add(tab, "has a slit outside its piece");
      return;
    }
    if (std::ranges::any_of(lines_[piece],
                            [&](const SlitLine& line) { return apart(own, line) < least_beside_slit_mm; })) {
      add(tab, fmt::format("has a slit less than {} mm from a cut or a fold", least_beside_slit_mm));
    }
    if (std::ranges::any_of(slits_[piece], [&](Index other) {
          return other != tab && apart(own, slit(other)) < least_between_slits_mm;
        })) {
      add(tab, fmt::format("has a slit less than {} mm from another one", least_between_slits_mm));
    }
  }

  /// The tab as it is folded over its edge, against the slit: along the edge and away from it.
  void check_tab(Index tab) {
    const std::vector<Vec2>& polygon = file_.tabs[tab].polygon;
    const Index side = target_of_slit(file_, relations_, tab);
    if (polygon.size() < 8) {
      add(tab, "has a slit, but no neck and no head");
      return;
    }
    const Index own_side = relations_.sides_of(file_.tabs[tab].edge).front();
    // Both run from the same end of the edge.
    const SlitLine own{file_.points[file_.faces.head(own_side)], file_.points[file_.faces.tail(own_side)]};
    const SlitLine other{file_.points[file_.faces.tail(side)], file_.points[file_.faces.head(side)]};
    const auto in = [](const SlitLine& edge, Vec2 p) {
      const Vec2 along = (edge.b - edge.a) / length(edge.b - edge.a);
      return Vec2{dot(p - edge.a, along), cross(along, p - edge.a)};
    };
    const Vec2 from = in(other, slit(tab).a);
    const Vec2 to = in(other, slit(tab).b);
    double neck_low = HUGE_VAL;
    double neck_high = -HUGE_VAL;
    double head_low = HUGE_VAL;
    double head_high = -HUGE_VAL;
    for (const Vec2 corner : polygon) {
      const Vec2 p = in(own, corner);
      const bool neck = p.y < from.y;
      (neck ? neck_low : head_low) = std::min(neck ? neck_low : head_low, p.x);
      (neck ? neck_high : head_high) = std::max(neck ? neck_high : head_high, p.x);
    }
    const double low = std::min(from.x, to.x);
    const double high = std::max(from.x, to.x);
    if (std::abs(from.y - to.y) > slit_place_mm || from.y < least_beside_slit_mm) {
      add(tab, "has a slit that isn't along its edge");
    } else if (!(low < neck_low && neck_high < high)) {
      add(tab, "has a neck that its slit doesn't let through");
    } else if (!(head_low < low && high < head_high)) {
      add(tab, "has a head that its slit doesn't hold");
    }
  }

  const File& file_;
  const Relations& relations_;
  const Context& context_;
  Findings& findings_;
  std::map<Index, std::vector<Index>> slits_;  ///< per piece in which they lie
  std::map<Index, std::vector<SlitLine>> lines_;
  std::map<Index, std::vector<Index>> faces_;
};

// Promise 5: no tab hangs on a strip or a point of paper. From places along its base one must get far enough
// straight into the piece, over folds, before a cut is reached.

/// Places that are looked at on each edge, and sides that one look may cross.
constexpr int places = 15;
constexpr int most_crossed = 200;
/// A place where two faces meet belongs to both: corners that a ray passes within so many mm are crossed.
constexpr double corner_mm = 1e-6;

/// Where a ray leaves the face that it entered over a side.
struct Exit {
  double at = HUGE_VAL;  ///< mm from the start of the ray
  Index side = none;
};

class PaperCheck {
 public:
  explicit PaperCheck(const Case& given) : file_(given.file), relations_(given.relations) {}

  /// Share of a tab's base with too little paper behind it.
  [[nodiscard]] double thin_fraction(const Tab& tab) const {
    double thin = 0.0;
    double all = 0.0;
    for (const Index e : tab.edges) {
      const Index side = relations_.sides_of(e).front();
      const double side_length = length(point(file_.faces.head(side)) - point(file_.faces.tail(side)));
      int few = 0;
      for (int i = 0; i < places; ++i) {
        few += paper(side, (static_cast<double>(i) + 0.5) / places) < least_paper_mm ? 1 : 0;
      }
      thin += side_length * static_cast<double>(few) / places;
      all += side_length;
    }
    return all > 0.0 ? thin / all : 0.0;
  }

 private:
  [[nodiscard]] Vec2 point(Index vertex) const { return file_.points[vertex]; }

  [[nodiscard]] Exit exit_of(Index entered, Vec2 start, Vec2 inward, double from) const {
    Exit exit;
    const Index face = file_.faces.face(entered);
    for (Index s = file_.faces.first(face); s < file_.faces.first(face) + file_.faces.size(face); ++s) {
      const Vec2 a = point(file_.faces.tail(s)) - start;
      const Vec2 b = point(file_.faces.head(s)) - start;
      // Beside the ray: to its right where a side that leads out begins, to its left where it ends.
      const double begins = cross(inward, a);
      const double ends = cross(inward, b);
      if (s == entered || begins > corner_mm || ends < -corner_mm || ends - begins <= 0.0) {
        continue;
      }
      const double at = (dot(a, inward) * ends - dot(b, inward) * begins) / (ends - begins);
      if (at >= from - corner_mm && at < exit.at) {
        exit = {at, s};
      }
    }
    return exit;
  }

  /// Paper straight behind a place on a side, mm, as far as it is of interest.
  [[nodiscard]] double paper(Index side, double fraction) const {
    const Vec2 from = point(file_.faces.tail(side));
    const Vec2 along = point(file_.faces.head(side)) - from;
    const double size = length(along);
    if (!(size > 0.0)) {
      return 0.0;
    }
    const Vec2 start = from + fraction * along;
    const Vec2 inward = perpendicular(along) / size;
    Index entered = side;
    double at = 0.0;
    for (int crossed = 0; crossed < most_crossed; ++crossed) {
      const Exit exit = exit_of(entered, start, inward, at);
      at = exit.at;
      if (exit.side == none || at >= least_paper_mm || relations_.fold_twin[exit.side] == none) {
        break;
      }
      entered = relations_.fold_twin[exit.side];
    }
    return at;
  }

  const File& file_;
  const Relations& relations_;
};

}  // namespace

void check_tabs(const Case& given, Findings& findings) {
  findings.figures().tabs = given.file.tabs.size();
  const std::vector<std::vector<Index>> joins = joins_of_tabs(given.file);
  for (Index tab = 0; tab < given.file.tabs.size(); ++tab) {
    given.context.check();
    TabCheck(given, tab, joins[tab], findings).run();
  }
}

void check_slits(const Case& given, Findings& findings) {
  SlitCheck(given, findings).run();
}

void check_paper_behind_tabs(const Case& given, Findings& findings) {
  const PaperCheck check(given);
  for (Index t = 0; t < given.file.tabs.size(); ++t) {
    given.context.check();
    const Tab& tab = given.file.tabs[t];
    if (check.thin_fraction(tab) > 0.5 + 1.0 / places) {
      findings.add(Promise::joins, {{"tab", t}, {"edge", tab.edge}}, [&] {
        return fmt::format("{} hangs on less than 2 mm of paper", tab_name(given.file, t));
      });
    }
  }
}

}  // namespace ridgecraft::verify
