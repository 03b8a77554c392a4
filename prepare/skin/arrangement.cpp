// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/skin/arrangement.hpp"

#include <algorithm>
#include <map>

#include <CGAL/Constrained_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "base/boxes.hpp"
#include "base/disjoint_sets.hpp"
#include "base/no_index.hpp"
#include "base/order.hpp"
#include "prepare/skin/contacts.hpp"
#include "prepare/skin/exact.hpp"
#include "prepare/skin/windings.hpp"

namespace ridgecraft::prepare {
namespace {

/// Of a point in space.
struct Number {
  std::uint32_t value = no_index;
};
/// Plane triangulation of what lies in one plane; vertices know the number of their point in space.
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<Number, Exact>;
using Faces = CGAL::Constrained_triangulation_face_base_2<Exact>;
using Flat = CGAL::Constrained_triangulation_2<Exact, CGAL::Triangulation_data_structure_2<Vertices, Faces>,
                                               CGAL::Exact_intersections_tag>;

class Arranger {
 public:
  Arranger(const BodySoup& soup, const Context& context)
      : soup_{soup, {}, {}}, exact_(soup.points), context_(context) {}

  std::optional<Arrangement> run(std::size_t most_pairs) {
    const std::vector<std::uint32_t> place = first_at_place(soup_.soup.points);
    for (const Corners& t : soup_.soup.triangles) {
      soup_.corners.push_back({place[t[0]], place[t[1]], place[t[2]]});
    }
    result_.points = soup_.soup.points;
    result_.new_points = soup_.soup.points.size();
    if (!find_pairs(most_pairs)) {
      return std::nullopt;
    }
    meet_all();
    divide_all();
    find_patches();
    find_windings(soup_, exact_, largest_, result_, context_);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_solid(std::uint32_t t) const { return soup_.is_solid(t); }

  bool find_pairs(std::size_t most_pairs) {
    const Contacts contacts(soup_.soup.points);
    std::vector<Box3> boxes;
    for (std::uint32_t t = 0; t < soup_.corners.size(); ++t) {
      if (contacts.has_area(soup_.corners[t])) {
        soup_.whole.push_back(t);
        boxes.push_back(box_of(soup_.soup.points, soup_.corners[t]));
      }
    }
    std::size_t asked = 0;
    bool too_many = false;
    NearBoxes(boxes).for_pairs([&](std::uint32_t i, std::uint32_t j) {
      if (++asked % pairs_per_check == 0) {
        context_.check();
      }
      const std::uint32_t s = soup_.whole[std::min(i, j)];
      const std::uint32_t t = soup_.whole[std::max(i, j)];
      if (too_many || (!is_solid(s) && !is_solid(t)) || !contacts.meet(soup_.corners[s], soup_.corners[t])) {
        return;
      }
      too_many = pairs_.size() >= most_pairs;
      pairs_.push_back({s, t});
    });
    std::sort(pairs_.begin(), pairs_.end());
    return !too_many;
  }

  [[nodiscard]] Exact::Triangle_3 triangle(std::uint32_t t) {
    return {exact_[soup_.corners[t][0]], exact_[soup_.corners[t][1]], exact_[soup_.corners[t][2]]};
  }
  std::uint32_t number_of(const Exact::Point_3& p) {
    const auto [at, fresh] = number_.try_emplace(p, static_cast<std::uint32_t>(result_.points.size()));
    if (fresh) {
      CGAL::exact(p);  // numbers that wait to be computed would hang on each other in long chains
      result_.points.push_back(rounded(p));
      exact_.add(p);
    }
    return at->second;
  }

  /// What lies in a triangle besides its sides.
  struct Marks {
    std::vector<std::uint32_t> points;
    std::vector<std::array<std::uint32_t, 2>> lines;
  };

  void meet_all() {
    // Corners first, so that what is found at one of them is that corner.
    for (const auto& [s, t] : pairs_) {
      for (const std::uint32_t f : {s, t}) {
        for (const std::uint32_t p : soup_.corners[f]) {
          number_.try_emplace(exact_[p], p);
        }
      }
    }
    marks_.resize(soup_.corners.size());
    planes_.reset(soup_.corners.size());
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (i % pairs_per_check == 0) {
        context_.check();
      }
      meet(pairs_[i][0], pairs_[i][1]);
    }
  }

  void meet(std::uint32_t s, std::uint32_t t) {
    const auto common = CGAL::intersection(triangle(s), triangle(t));
    if (!common) {
      return;
    }
    std::vector<std::uint32_t> outline;
    if (const auto* p = boost::get<Exact::Point_3>(&*common)) {
      outline = {number_of(*p)};
    } else if (const auto* segment = boost::get<Exact::Segment_3>(&*common)) {
      outline = {number_of(segment->source()), number_of(segment->target())};
    } else if (const auto* part = boost::get<Exact::Triangle_3>(&*common)) {
      outline = {number_of(part->vertex(0)), number_of(part->vertex(1)), number_of(part->vertex(2))};
    } else if (const auto* polygon = boost::get<std::vector<Exact::Point_3>>(&*common)) {
      for (const Exact::Point_3& q : *polygon) {
        outline.push_back(number_of(q));
      }
    }
    const auto mark = [&](std::uint32_t f) {
      if (outline.size() == 1) {
        marks_[f].points.push_back(outline[0]);
      }
      for (std::size_t k = 0; outline.size() > 1 && k < (outline.size() == 2 ? 1 : outline.size()); ++k) {
        marks_[f].lines.push_back({outline[k], outline[(k + 1) % outline.size()]});
      }
    };
    if (is_solid(t)) {
      mark(s);
    }
    if (is_solid(s)) {
      mark(t);
    }
    if (outline.size() > 2 && is_solid(s) && is_solid(t)) {
      planes_.join(s, t);
    }
  }

  /// Triangles that lie on each other are divided together; those that nothing meets stay whole.
  void divide_all() {
    std::vector<std::vector<std::uint32_t>> together(soup_.corners.size());
    for (const std::uint32_t t : soup_.whole) {
      together[planes_.find(t)].push_back(t);
    }
    std::size_t done = 0;
    for (const std::vector<std::uint32_t>& group : together) {
      if (group.empty()) {
        continue;
      }
      if (++done % 64 == 0) {
        context_.check();
      }
      if (group.size() == 1 && marks_[group[0]].points.empty() && marks_[group[0]].lines.empty()) {
        add_facet(soup_.corners[group[0]], {{group[0], true}});
      } else {
        divide(group);
      }
    }
  }

  void add_facet(const Corners& corners, const std::vector<Source>& sources) {
    const auto first = static_cast<std::uint32_t>(result_.sources.size());
    result_.sources.insert(result_.sources.end(), sources.begin(), sources.end());
    result_.facets.push_back({corners, no_index, first, static_cast<std::uint32_t>(result_.sources.size())});
  }

  /// Sides of some triangles and lines in them, each once.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> lines_of(
      const std::vector<std::uint32_t>& group) const {
    std::vector<std::array<std::uint32_t, 2>> lines;
    for (const std::uint32_t t : group) {
      for (std::size_t k = 0; k < 3; ++k) {
        lines.push_back({soup_.corners[t][k], soup_.corners[t][(k + 1) % 3]});
      }
      lines.insert(lines.end(), marks_[t].lines.begin(), marks_[t].lines.end());
    }
    for (auto& [a, b] : lines) {
      if (a > b) {
        std::swap(a, b);
      }
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    return lines;
  }

  void divide(const std::vector<std::uint32_t>& group) {
    const Exact::Plane_3 plane = triangle(group[0]).supporting_plane();
    const View view = exact_view(plane);
    Flat flat;
    const auto put = [&](std::uint32_t number) {
      const Exact::Point_3& p = exact_[number];
      const auto vertex = flat.insert(Exact::Point_2(view.first(p), view.second(p)));
      vertex->info().value = number;
      return vertex;
    };
    const std::vector<std::array<std::uint32_t, 2>> lines = lines_of(group);
    // All known points first, so that lines through them are divided there.
    std::map<std::uint32_t, Flat::Vertex_handle> known;
    for (const auto& line : lines) {
      for (const std::uint32_t p : line) {
        if (!known.contains(p)) {
          known[p] = put(p);
        }
      }
    }
    for (const std::uint32_t t : group) {
      for (const std::uint32_t p : marks_[t].points) {
        if (!known.contains(p)) {
          known[p] = put(p);
        }
      }
    }
    for (const auto& [a, b] : lines) {
      if (a != b) {
        flat.insert_constraint(known[a], known[b]);
      }
    }
    number_crossings(flat, plane, view);
    const std::vector<Outline> outlines =
        group.size() == 1 ? std::vector<Outline>() : outlines_of(group, view);
    std::vector<std::pair<Corners, Flat::Face_handle>> facets;
    for (const Flat::Face_handle f : flat.finite_face_handles()) {
      Corners corners{f->vertex(0)->info().value, f->vertex(1)->info().value, f->vertex(2)->info().value};
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      facets.emplace_back(corners, f);
    }
    std::sort(facets.begin(), facets.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [corners, f] : facets) {
      const std::vector<Source> sources =
          group.size() == 1 ? std::vector<Source>{{group[0], true}} : sources_of(f, outlines);
      if (!sources.empty()) {
        add_facet(corners, sources);
        divided_.resize(result_.facets.size(), 0);
        divided_.back() = 1;
      }
    }
  }

  /// Gives numbers to the points where lines cross, in the order of the points: that of a triangulation's
  /// vertices and faces depends on the machine.
  void number_crossings(const Flat& flat, const Exact::Plane_3& plane, View view) {
    std::vector<Flat::Vertex_handle> crossings;
    for (const Flat::Vertex_handle v : flat.finite_vertex_handles()) {
      if (v->info().value == no_index) {
        crossings.push_back(v);
      }
    }
    std::sort(crossings.begin(), crossings.end(),
              [](Flat::Vertex_handle a, Flat::Vertex_handle b) { return a->point() < b->point(); });
    for (const Flat::Vertex_handle v : crossings) {
      v->info().value = number_of(lifted(v->point(), plane, view));
    }
  }

  [[nodiscard]] static View exact_view(const Exact::Plane_3& plane) {
    return view_along({nearest(plane.a()), nearest(plane.b()), nearest(plane.c())});
  }
  [[nodiscard]] static Exact::Point_3 lifted(const Exact::Point_2& p, const Exact::Plane_3& plane,
                                             View view) {
    const int i = view.behind ? (view.axis + 2) % 3 : (view.axis + 1) % 3;
    const int j = view.behind ? (view.axis + 1) % 3 : (view.axis + 2) % 3;
    const std::array<Exact::FT, 3> factor{plane.a(), plane.b(), plane.c()};
    std::array<Exact::FT, 3> at;
    const auto index = [](int k) { return static_cast<std::size_t>(k); };
    at[index(i)] = p.x();
    at[index(j)] = p.y();
    at[index(view.axis)] =
        -(factor[index(i)] * p.x() + factor[index(j)] * p.y() + plane.d()) / factor[index(view.axis)];
    return {at[0], at[1], at[2]};
  }

  /// A triangle of a group in its plane.
  struct Outline {
    std::uint32_t triangle;
    std::array<Exact::Point_2, 3> corners;
    CGAL::Orientation turn;
    Box2 box;  ///< a little too large
  };
  std::vector<Outline> outlines_of(const std::vector<std::uint32_t>& group, View view) {
    std::vector<Outline> outlines;
    for (const std::uint32_t t : group) {
      Outline outline{t, {}, CGAL::COLLINEAR, {}};
      for (std::size_t k = 0; k < 3; ++k) {
        const Exact::Point_3& p = exact_[soup_.corners[t][k]];
        outline.corners[k] = {view.first(p), view.second(p)};
        outline.box.add(roughly(outline.corners[k]));
      }
      const double margin = 1e-9 * length(outline.box.high - outline.box.low);
      outline.box.low = outline.box.low - Vec2{margin, margin};
      outline.box.high = outline.box.high + Vec2{margin, margin};
      outline.turn = CGAL::orientation(outline.corners[0], outline.corners[1], outline.corners[2]);
      outlines.push_back(outline);
    }
    return outlines;
  }
  /// Enough for boxes that are a little too large.
  static Vec2 roughly(const Exact::Point_2& p) { return {CGAL::to_double(p.x()), CGAL::to_double(p.y())}; }

  /// The triangles of a group that a face of its triangulation lies in.
  static std::vector<Source> sources_of(Flat::Face_handle f, const std::vector<Outline>& outlines) {
    const Exact::Point_2 middle =
        CGAL::centroid(f->vertex(0)->point(), f->vertex(1)->point(), f->vertex(2)->point());
    const Vec2 rough = roughly(middle);
    std::vector<Source> sources;
    for (const Outline& o : outlines) {
      if (rough.x < o.box.low.x || rough.x > o.box.high.x || rough.y < o.box.low.y ||
          rough.y > o.box.high.y) {
        continue;
      }
      const auto left_of = [&](std::size_t k) {
        return CGAL::orientation(o.corners[k], o.corners[(k + 1) % 3], middle) == o.turn;
      };
      if (left_of(0) && left_of(1) && left_of(2)) {
        sources.push_back({o.triangle, o.turn == CGAL::LEFT_TURN});
      }
    }
    return sources;
  }

  // Patches.

  struct Side {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t facet;
    bool solid;
  };

  /// Whose facet: bodies with the side that they face, ascending.
  [[nodiscard]] std::vector<std::pair<std::uint32_t, bool>> owners(const Facet& facet) const {
    std::vector<std::pair<std::uint32_t, bool>> all;
    for (std::uint32_t i = facet.first_source; i < facet.last_source; ++i) {
      const Source& s = result_.sources[i];
      all.emplace_back(soup_.soup.body[s.triangle], s.same_side);
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  void find_patches() {
    DisjointSets sets = joined_facets();
    std::vector<std::uint32_t> number(result_.facets.size(), no_index);
    for (std::uint32_t f = 0; f < result_.facets.size(); ++f) {
      const std::uint32_t root = sets.find(f);
      if (number[root] == no_index) {
        number[root] = static_cast<std::uint32_t>(result_.patches.size());
        result_.patches.emplace_back();
        largest_.push_back(f);
      }
      result_.facets[f].patch = number[root];
      if (rough_area(f) > rough_area(largest_[number[root]])) {
        largest_[number[root]] = f;
      }
    }
  }

  [[nodiscard]] DisjointSets joined_facets() const {
    std::vector<Side> sides;
    for (std::uint32_t f = 0; f < result_.facets.size(); ++f) {
      const Facet& facet = result_.facets[f];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t p = facet.corners[k];
        const std::uint32_t q = facet.corners[(k + 1) % 3];
        sides.push_back(
            {std::min(p, q), std::max(p, q), f, is_solid(result_.sources[facet.first_source].triangle)});
      }
    }
    const std::vector<Side> ordered = in_edge_order(std::span<const Side>(sides));
    DisjointSets sets(result_.facets.size());
    for (std::size_t i = 0; i < ordered.size();) {
      std::size_t j = i + 1;
      while (j < ordered.size() && ordered[j].low == ordered[i].low && ordered[j].high == ordered[i].high) {
        ++j;
      }
      // Sheets divide no solids, so solids needn't have an edge where a sheet ends in them: pieces of a
      // sheet's triangle are patches of their own.
      std::vector<std::uint32_t> here;
      for (std::size_t k = i; k < j; ++k) {
        if (ordered[k].solid == ordered[i].solid || ordered[k].solid) {
          here.push_back(ordered[k].facet);
        }
      }
      std::erase_if(here, [&](std::uint32_t f) {
        return !is_solid(result_.sources[result_.facets[f].first_source].triangle) &&
               (f < divided_.size() && divided_[f] != 0);
      });
      if (here.size() == 2 && runs_on(here[0], here[1], ordered[i].low, ordered[i].high)) {
        sets.join(here[0], here[1]);
      }
      i = j;
    }
    return sets;
  }

  [[nodiscard]] double rough_area(std::uint32_t f) const {
    const Corners& c = result_.facets[f].corners;
    const Vec3 a = result_.points[c[0]];
    return length(cross(result_.points[c[1]] - a, result_.points[c[2]] - a));
  }

  /// Two facets at an edge that nothing else meets: are they of the same bodies, facing alike?
  [[nodiscard]] bool runs_on(std::uint32_t f, std::uint32_t g, std::uint32_t low, std::uint32_t high) const {
    const auto forward = [&](std::uint32_t h) {
      const Corners& c = result_.facets[h].corners;
      return (c[0] == low && c[1] == high) || (c[1] == low && c[2] == high) || (c[2] == low && c[0] == high);
    };
    return forward(f) != forward(g) && owners(result_.facets[f]) == owners(result_.facets[g]);
  }

  PlacedSoup soup_;
  ExactPoints exact_;  ///< of all points
  const Context& context_;
  std::vector<std::array<std::uint32_t, 2>> pairs_;
  std::map<Exact::Point_3, std::uint32_t> number_;  ///< of points where triangles meet, and their corners
  std::vector<Marks> marks_;
  DisjointSets planes_;
  std::vector<std::uint32_t> largest_;  ///< facet of each patch
  std::vector<std::uint8_t> divided_;   ///< facets that are no whole triangle
  Arrangement result_;
};

}  // namespace

std::optional<Arrangement> arrange(const BodySoup& soup, std::size_t most_pairs, const Context& context) {
  return Arranger(soup, context).run(most_pairs);
}

}  // namespace ridgecraft::prepare
