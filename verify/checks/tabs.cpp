// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 5, tabs: each grows from an edge of the joins that name it, outwards, and its base lies on that
// edge.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/polygon.hpp"

namespace ridgecraft::verify {
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
    const auto piece = [this](Index e) {
      return file_.face_piece[file_.faces.face(relations_.sides_of(e).front())];
    };
    if (std::any_of(tab_.edges.begin(), tab_.edges.end(),
                    [&](Index e) { return piece(e) != piece(tab_.edge); })) {
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

}  // namespace

void check_tabs(const Case& given, Findings& findings) {
  findings.figures().tabs = given.file.tabs.size();
  const std::vector<std::vector<Index>> joins = joins_of_tabs(given.file);
  for (Index tab = 0; tab < given.file.tabs.size(); ++tab) {
    given.context.check();
    TabCheck(given, tab, joins[tab], findings).run();
  }
}

}  // namespace ridgecraft::verify
