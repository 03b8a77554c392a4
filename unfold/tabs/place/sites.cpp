// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/sites.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "base/boxes.hpp"
#include "base/disjoint_sets.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::unfold {
namespace {

constexpr int places = 9;
constexpr int enough_places = (places + 1) / 2;
/// Faces that one look passes, at most: fans of needles have more, and nothing hangs on those.
constexpr int most_faces = 64;

/// How far, at most `far`, one gets from a point of a side straight into its face and over folds.
double reach(const mesh::Surface& surface, const Nets& nets, CornerId side, double share, double far) {
  const auto corner = [&](CornerId c) { return nets.flat[mesh::face_of(c)][c.value() % 3]; };
  const Vec2 from = corner(side);
  const Vec2 along = corner(mesh::next(side)) - from;
  const Vec2 start = from + share * along;
  const Vec2 inward = perpendicular(along) / length(along);
  CornerId entered = side;
  double gone = 0.0;
  for (int passed = 0; passed < most_faces; ++passed) {
    double leaves_at = HUGE_VAL;
    CornerId leaves;
    for (const CornerId c : {mesh::next(entered), mesh::previous(entered)}) {
      const Vec2 a = corner(c);
      const Vec2 d = corner(mesh::next(c)) - a;
      const double steep = cross(d, inward);
      if (steep < 0.0) {  // the ray goes out there
        const double at = cross(d, a - start) / steep;
        if (at < leaves_at) {
          leaves_at = at;
          leaves = c;
        }
      }
    }
    gone = std::max(gone, leaves_at);
    if (gone >= far) {
      return far;
    }
    if (!leaves.valid() || !surface.twin(leaves).valid() || nets.use[surface.edge(leaves)] != EdgeUse::fold) {
      return gone;
    }
    entered = surface.twin(leaves);
  }
  return gone;
}

}  // namespace

bool enough_paper_behind(const mesh::Surface& surface, const Nets& nets, CornerId side) {
  int enough = 0;
  for (int i = 0; i < places; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / places;
    enough += reach(surface, nets, side, share, least_paper_mm) >= least_paper_mm ? 1 : 0;
  }
  return enough >= enough_places;
}

namespace {

/// A base and what it stands on are parallel up to this (cosine of 3 degrees).
constexpr double parallel_cosine = 0.9986;

/// Nobody glues a base with more tabs.
constexpr std::size_t most_sides = 1000;

class Bases {
 public:
  explicit Bases(const mesh::Surface& surface)
      : surface_(surface),
        tree_(
            surface.face_count(), [&](std::uint32_t f) { return surface.bounds(FaceId(f)); },
            [&](std::uint32_t f) { return centre(surface.bounds(FaceId(f))); }) {}

  void add_sides_of(const mesh::Opening& opening, std::vector<BaseSide>& sides) const {
    const std::size_t count = opening.sides.size();
    if (count > most_sides) {
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const CornerId side = opening.sides[i];
      const Vec3 start = at(mesh::next(side));  // of the tab's base
      const Vec3 end = at(side);
      if (!mesh::rises_at(surface_, opening, side) ||
          !lies_on_another(0.5 * (start + end), opening.normal, surface_.component(mesh::face_of(side)))) {
        continue;
      }
      const Vec3 along = normalized(end - start);
      const Vec3 inward = cross(opening.normal, along);
      BaseSide base{side, {}};
      for (std::size_t k = 0; k < count; ++k) {
        // The other way round than the faces beside it run.
        const Vec3 q = at(mesh::next(opening.sides[(i + count - k) % count])) - start;
        base.opening.push_back({dot(q, along), dot(q, inward)});
      }
      sides.push_back(std::move(base));
    }
  }

 private:
  [[nodiscard]] Vec3 at(CornerId c) const { return surface_.point(surface_.vertex(c)); }

  [[nodiscard]] bool lies_on_another(Vec3 p, Vec3 normal, ComponentId own) const {
    Box3 box;
    box.add(p);
    box = grown(box, mesh::touching_mm);
    bool found = false;
    tree_.search([&](std::uint32_t node) { return !found && meet(box, tree_.box(node)); },
                 [&](std::uint32_t at) {
                   const FaceId f(tree_.order()[at]);
                   const auto [a, b, c] = surface_.vertices(f);
                   found = found ||
                           (surface_.component(f) != own &&
                            std::abs(dot(surface_.normal(f), normal)) >= parallel_cosine &&
                            mesh::squared_distance(surface_.point(a), surface_.point(b), surface_.point(c),
                                                   p) <= mesh::touching_mm * mesh::touching_mm);
                 });
    return found;
  }

  const mesh::Surface& surface_;
  BoxTree<Box3> tree_;
};

}  // namespace

std::vector<BaseSide> find_open_bases(const mesh::Surface& surface, const Context& context) {
  std::vector<BaseSide> sides;
  if (surface.component_count() < 2) {
    return sides;
  }
  const std::vector<mesh::Opening> openings = mesh::flat_openings(surface, mesh::touching_mm);
  if (openings.empty()) {
    return sides;
  }
  const Bases bases(surface);
  for (const mesh::Opening& opening : openings) {
    context.check();
    bases.add_sides_of(opening, sides);
  }
  return sides;
}

namespace {

Vec2 flat_corner(const Nets& nets, CornerId c) {
  return nets.flat[mesh::face_of(c)][c.value() % 3];
}

Frame frame_along(Vec2 from, Vec2 to) {
  const Vec2 along = to - from;
  const double size = length(along);
  return {from, size > 0.0 ? along / size : Vec2{1.0, 0.0}};
}

/// Faces of each piece in a grid of their boxes.
struct PieceGrids {
  explicit PieceGrids(const Nets& nets) {
    for (const Piece& piece : nets.pieces) {
      std::vector<Box2> boxes;
      boxes.reserve(piece.faces.size());
      for (const FaceId f : piece.faces) {
        boxes.push_back(ConvexShape(std::span<const Vec2>(nets.flat[f])).box());
      }
      grids.emplace_back(std::move(boxes));
    }
  }
  std::vector<BoxGrid> grids;
};

class SiteFinder {
 public:
  SiteFinder(const mesh::Surface& surface, FlatRegions regions, const Nets& nets, const TabOptions& options)
      : surface_(surface),
        nets_(nets),
        options_(options),
        regions_(std::move(regions)),
        vertices_(net_vertices(surface, nets)),
        grids_(nets) {}

  [[nodiscard]] TabSite find(CornerId side) const {
    const CornerId twin = surface_.twin(side);
    TabSite site = own_side(side);
    site.target_piece = nets_.piece[mesh::face_of(twin)];
    site.target_region = regions_.region[mesh::face_of(twin)];
    site.target = glued_frame(nets_, twin);
    site.area = regions_.area[regions_.region[mesh::face_of(side)]];
    const ConvexShape widest = widest_tab(site.length, options_);
    if (!widest.empty()) {
      if (!site.has_paper) {
        site.obstacles.push_back(no_target(site.length));
      }
      if (options_.inside_target) {
        add_target(site, twin, widest);
      }
      add_faces(site, widest);
    }
    return site;
  }

  /// Of a side that nothing is glued to.
  [[nodiscard]] TabSite find_border(CornerId side) const {
    TabSite site = own_side(side);
    const ConvexShape widest = widest_tab(site.length, options_);
    if (!widest.empty()) {
      if (!site.has_paper) {
        site.obstacles.push_back(no_target(site.length));
      }
      add_faces(site, widest);
    }
    return site;
  }

  /// Of one that stands on another body.
  [[nodiscard]] TabSite find_base(const BaseSide& base) const {
    TabSite site = find_border(base.side);
    const ConvexShape widest = widest_tab(site.length, options_);
    for (std::size_t k = 1; k < base.opening.size() && !widest.empty(); ++k) {
      const ConvexShape edge{base.opening[k], base.opening[(k + 1) % base.opening.size()]};
      if (meet(edge.box(), widest.box()) && !apart(widest, edge, -just_touching_mm)) {
        site.obstacles.push_back({edge, Obstacle::Kind::target_edge});
      }
    }
    return site;
  }

  /// What a site has by itself, whatever its tab is glued behind.
  [[nodiscard]] TabSite own_side(CornerId side) const {
    TabSite site;
    site.side = side;
    site.piece = nets_.piece[mesh::face_of(side)];
    site.own = tab_frame(nets_, side);
    site.length = length(flat_corner(nets_, mesh::next(side)) - flat_corner(nets_, side));
    site.ends = {vertices_[mesh::next(side).value()], vertices_[side.value()]};
    site.has_paper = enough_paper_behind(surface_, nets_, side);
    return site;
  }

 private:
  /// The outline of what lies behind the tab: the flat region at the edge and those that hang on it by folds
  /// so slight that a tab bends with them.
  void add_target(TabSite& site, CornerId twin, const ConvexShape& widest) const {
    struct Behind {
      double bend;  // against the region at the edge, over all folds between
      std::uint32_t region;
    };
    std::vector<Behind> behind{{0.0, site.target_region}};
    std::vector<Obstacle> outline;
    for (std::size_t i = 0; i < behind.size(); ++i) {
      const auto [bend, region] = behind[i];
      for (const CornerId c : regions_.outline[region]) {
        const ConvexShape edge{site.target.in(flat_corner(nets_, c)),
                               site.target.in(flat_corner(nets_, mesh::next(c)))};
        if (c == twin || !meet(edge.box(), widest.box()) || apart(widest, edge, -just_touching_mm)) {
          continue;
        }
        if (i == 0) {
          site.region_outline.push_back({edge, Obstacle::Kind::target_edge});
        }
        const EdgeId e = surface_.edge(c);
        const double beyond = bend + std::abs(surface_.fold_angle(e));
        if (nets_.use[e] != EdgeUse::fold || beyond > most_bend_of_tab) {
          outline.push_back({edge, Obstacle::Kind::target_edge});
          continue;
        }
        const std::uint32_t next = regions_.region[surface_.neighbor(c)];
        if (std::none_of(behind.begin(), behind.end(), [&](const Behind& b) { return b.region == next; })) {
          behind.push_back({beyond, next});
        }
      }
    }
    const bool alone = behind.size() == 1 && regions_.outline[site.target_region].size() == 3;
    if (alone && site.target.in(flat_corner(nets_, mesh::previous(twin))).y < least_target_mm) {
      outline.assign(1, no_target(site.length));
      site.region_outline = outline;
    }
    site.obstacles.insert(site.obstacles.end(), outline.begin(), outline.end());
  }

  void add_faces(TabSite& site, const ConvexShape& widest) const {
    const std::vector<FaceId>& faces = nets_.pieces[site.piece].faces;
    const Box2 box = grown(site.own.out(widest).box(), options_.clearance_mm);
    // Those at the base's corners come first: what they cut off needn't be cut off for others.
    std::vector<Obstacle> others;
    grids_.grids[site.piece.value()].visit(box, [&](std::uint32_t i) {
      const FaceId f = faces[i];
      if (f == mesh::face_of(site.side)) {
        return;
      }
      bool left = false;
      bool right = false;
      for (unsigned k = 0; k < 3; ++k) {
        const std::uint32_t v = vertices_[mesh::corner(f, k).value()];
        left = left || v == site.ends[0];
        right = right || v == site.ends[1];
      }
      Obstacle obstacle{site.own.in(ConvexShape(std::span<const Vec2>(nets_.flat[f]))),
                        kind_sharing(left, right)};
      if (!clear_of(widest, obstacle, options_.clearance_mm)) {
        (left || right ? site.obstacles : others).push_back(obstacle);
      }
    });
    site.obstacles.insert(site.obstacles.end(), others.begin(), others.end());
  }

  const mesh::Surface& surface_;
  const Nets& nets_;
  const TabOptions& options_;
  FlatRegions regions_;
  std::vector<std::uint32_t> vertices_;
  PieceGrids grids_;
};

}  // namespace

ConvexShape Frame::out(const ConvexShape& shape) const {
  ConvexShape result;
  for (const Vec2 p : shape) {
    result.push_back(out(p));
  }
  return result;
}

ConvexShape Frame::in(const ConvexShape& shape) const {
  ConvexShape result;
  for (const Vec2 p : shape) {
    result.push_back(in(p));
  }
  return result;
}

std::vector<Obstacle> target_outline(const TabSite& site) {
  std::vector<Obstacle> target;
  std::copy_if(site.obstacles.begin(), site.obstacles.end(), std::back_inserter(target),
               [](const Obstacle& o) { return o.kind == Obstacle::Kind::target_edge; });
  return target;
}

bool target_allows_usable(const TabSite& site, const TabOptions& options) {
  const ConvexShape largest =
      largest_tab({0.0, site.length, site.length}, site.region_outline, options, TabNeed::usable);
  return !tab_shapes(largest, site.length, options).empty();
}

FlatRegions flat_regions(const mesh::Surface& surface, const prepare::Panels& panels, const Nets& nets) {
  DisjointSets sets(surface.face_count());
  const auto inside = [&](CornerId c) {
    const FaceId g = surface.neighbor(c);
    return g.valid() && nets.use[surface.edge(c)] == EdgeUse::fold &&
           panels.panel[mesh::face_of(c)] == panels.panel[g];
  };
  for (const CornerId c : ids<CornerId>(surface.corner_count())) {
    if (inside(c)) {
      sets.join(mesh::face_of(c).value(), surface.neighbor(c).value());
    }
  }
  FlatRegions result;
  result.region = IdVector<FaceId, std::uint32_t>(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const FaceId first(sets.find(f.value()));
    if (first == f) {
      result.region[f] = static_cast<std::uint32_t>(result.area.size());
      result.area.push_back(0.0);
      result.outline.emplace_back();
    }
    const std::uint32_t region = result.region[f] = result.region[first];
    result.area[region] += surface.area(f);
    for (unsigned k = 0; k < 3; ++k) {
      if (!inside(mesh::corner(f, k))) {
        result.outline[region].push_back(mesh::corner(f, k));
      }
    }
  }
  return result;
}

std::vector<std::uint32_t> net_vertices(const mesh::Surface& surface, const Nets& nets) {
  DisjointSets sets(surface.corner_count());
  for (const CornerId c : ids<CornerId>(surface.corner_count())) {
    if (nets.use[surface.edge(c)] == EdgeUse::fold) {
      sets.join(c.value(), mesh::next(surface.twin(c)).value());
    }
  }
  std::vector<std::uint32_t> result(surface.corner_count());
  for (std::uint32_t i = 0; i < result.size(); ++i) {
    result[i] = sets.find(i);
  }
  return result;
}

Frame tab_frame(const Nets& nets, CornerId side) {
  return frame_along(flat_corner(nets, mesh::next(side)), flat_corner(nets, side));
}

Frame glued_frame(const Nets& nets, CornerId twin) {
  return frame_along(flat_corner(nets, twin), flat_corner(nets, mesh::next(twin)));
}

std::vector<TabSite> find_tab_sites(const mesh::Surface& surface, const prepare::Panels& panels,
                                    const Nets& nets, const TabOptions& options, const Context& context) {
  const SiteFinder finder(surface, flat_regions(surface, panels, nets), nets, options);
  std::vector<TabSite> sites;
  sites.reserve(2 * nets.joins.size());
  for (const Join& join : nets.joins) {
    if (sites.size() % 1024 == 0) {
      context.check();
    }
    for (const CornerId side : surface.sides(join.edge)) {
      sites.push_back(finder.find(side));
    }
  }
  return sites;
}

std::vector<TabSite> find_border_sites(const mesh::Surface& surface, const Nets& nets,
                                       const TabOptions& options, const Context& context) {
  const SiteFinder finder(surface, {}, nets, options);
  std::vector<TabSite> sites;
  for (const EdgeId edge : ids<EdgeId>(surface.edge_count())) {
    if (nets.use[edge] == EdgeUse::border) {
      if (sites.size() % 1024 == 0) {
        context.check();
      }
      sites.push_back(finder.find_border(surface.sides(edge)[0]));
    }
  }
  return sites;
}

std::vector<TabSite> bare_sites(const mesh::Surface& surface, const Nets& nets,
                                const std::vector<CornerId>& sides) {
  const TabOptions any;
  const SiteFinder finder(surface, {}, nets, any);
  std::vector<TabSite> sites;
  sites.reserve(sides.size());
  for (const CornerId side : sides) {
    sites.push_back(finder.own_side(side));
  }
  return sites;
}

std::vector<TabSite> find_base_sites(const mesh::Surface& surface, const Nets& nets,
                                     const std::vector<BaseSide>& bases, const TabOptions& options,
                                     const Context& context) {
  const SiteFinder finder(surface, {}, nets, options);
  std::vector<TabSite> sites;
  for (const BaseSide& base : bases) {
    context.check();
    sites.push_back(finder.find_base(base));
  }
  return sites;
}

}  // namespace ridgecraft::unfold
