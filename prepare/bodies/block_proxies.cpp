// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/bodies/block_proxies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/model/surface.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/bodies/fit_prism.hpp"
#include "prepare/symmetry/twins.hpp"

namespace ridgecraft::prepare {
namespace {

/// Bodies that are longer than this share of the model are what it is made of.
constexpr double short_body = 0.34;
/// Bodies with no more faces are plain: a box has 12.
constexpr std::size_t plain_faces = 20;
/// Of the directions of a body's faces those are tried that have most area, ...
constexpr std::size_t most_directions = 6;
/// (of the first so many, by their largest faces: a round body has as many as faces), ...
constexpr std::size_t most_looked_at = 60;
/// ... and faces have one direction where the cosine between them is larger.
constexpr double one_direction = 0.999;
/// Sides of a block are shorter than a short edge only where they can't be longer; a tab needs this share.
constexpr double tab_fraction = 0.75;
/// A side of a block looks where a face of the body looks where the cosine is larger.
constexpr double same_way = 0.7;
/// Where blocks would have more of its area, over-detailed bodies are what a model is made of.
constexpr double most_of_model = 0.4;
/// A body covers this share of what a prism around it would cover, seen along it: a frame with a sill does,
/// ...
constexpr double same_outline = 0.65;
/// ... and this one, seen from each side: a barrel does, but no bone, cone or ball (pi/4).
constexpr double same_silhouette = 0.83;
/// Places where the distance is measured are this share of the largest move apart.
constexpr double spacing = 0.2;

using Faces = std::vector<std::array<std::uint32_t, 3>>;

struct Edges {
  std::size_t brief = 0;
  double length = 0.0;
  double brief_length = 0.0;
};

Edges folded_edges(const mesh::Surface& surface, const ProxyLimits& limits) {
  Edges edges;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (surface.sides(e)[1].valid() && std::abs(surface.fold_angle(e)) < limits.hidden_fold_angle) {
      continue;
    }
    const double length = surface.length(e);
    edges.length += length;
    if (length < limits.short_edge) {
      ++edges.brief;
      edges.brief_length += length;
    }
  }
  return edges;
}

/// Of the body's faces, those with most area first; opposite ones are one.
std::vector<Vec3> directions_of(const mesh::Surface& body) {
  struct Direction {
    Vec3 normal;
    double area = 0.0;
  };
  std::vector<FaceId> by_area;
  for (const FaceId f : ids<FaceId>(body.face_count())) {
    by_area.push_back(f);
  }
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](FaceId f, FaceId g) { return body.area(f) > body.area(g); });
  std::vector<Direction> all;
  for (const FaceId f : by_area) {
    const Vec3 normal = body.normal(f);
    const auto same = std::find_if(all.begin(), all.end(), [&](const Direction& d) {
      return std::abs(dot(d.normal, normal)) > one_direction;
    });
    if (same != all.end()) {
      same->area += body.area(f);
    } else if (normal != Vec3{} && all.size() < most_looked_at) {
      all.push_back({normal, body.area(f)});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Direction& a, const Direction& b) { return a.area > b.area; });
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < all.size() && i < most_directions; ++i) {
    result.push_back(all[i].normal);
  }
  return result;
}

/// The corners of the base, then those of the top.
std::vector<Vec3> points_of(const Prism& prism) {
  std::vector<Vec3> points = prism.base;
  for (const Vec3 p : prism.base) {
    points.push_back(p + prism.along);
  }
  return points;
}

Faces faces_of(const Prism& prism) {
  const auto sides = static_cast<std::uint32_t>(prism.base.size());
  Faces faces;
  for (std::uint32_t i = 1; i + 1 < sides; ++i) {
    faces.push_back({0, i + 1, i});
    faces.push_back({sides, sides + i, sides + i + 1});
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    faces.push_back({i, j, sides + j});
    faces.push_back({i, sides + j, sides + i});
  }
  return faces;
}

mesh::Surface surface_of(const Prism& prism) {
  const Faces faces = faces_of(prism);
  std::vector<std::array<VertexId, 3>> corners;
  corners.reserve(faces.size());
  for (const auto& [a, b, c] : faces) {
    corners.push_back({VertexId(a), VertexId(b), VertexId(c)});
  }
  return mesh::Surface(points_of(prism), std::move(corners));
}

/// Seen along the block, and from each of its sides, where the body's own outline counts, not the plain one
/// around it.
bool looks_like_it(const mesh::Surface& body, const Prism& block) {
  const Vec3 along = normalized(block.along);
  const std::array<Vec3, 1> directions{along};
  const std::optional<Prism> tight = fit_prism(body.points(), directions, PrismRules{0.0, 0.0, SIZE_MAX});
  if (!tight) {
    return false;
  }
  const mesh::Surface whole = surface_of(*tight);
  if (silhouette_fraction(body, whole, along) < same_outline) {
    return false;
  }
  for (std::size_t i = 0; i < block.base.size(); ++i) {
    const Vec3 side = block.base[(i + 1) % block.base.size()] - block.base[i];
    if (silhouette_fraction(body, whole, normalized(cross(side, along))) < same_silhouette) {
      return false;
    }
  }
  return true;
}

struct Block {
  Prism prism;
  double moved = 0.0;
};

class Blocks {
 public:
  Blocks(const mesh::Model& model, const ProxyLimits& limits, const Context& context)
      : surface_(model.surface), limits_(limits), context_(context), bodies_(components(surface_)) {}

  [[nodiscard]] const std::vector<FaceId>& faces(std::size_t body) const { return bodies_[body]; }

  /// The block in the place of each body; none where it stays, and none at all where they would have most of
  /// the model's area.
  [[nodiscard]] std::vector<std::optional<Block>> blocks() const {
    std::vector<std::optional<Block>> result;
    double area = 0.0;
    double of_blocks = 0.0;
    for (std::size_t body = 0; body < bodies_.size(); ++body) {
      result.push_back(block(body));
      for (const FaceId f : bodies_[body]) {
        area += surface_.area(f);
        of_blocks += result.back() ? surface_.area(f) : 0.0;
      }
    }
    if (of_blocks > most_of_model * area) {
      result.assign(result.size(), std::nullopt);
    }
    return result;
  }

  /// The face of a body that most of what looks in a direction is like; of all where nothing looks there.
  [[nodiscard]] FaceId looks_like(std::size_t body, Vec3 normal, const mesh::LooseFaces& loose) const {
    struct Alike {
      double area = 0.0;
      FaceId first;
    };
    using Look = std::pair<std::uint32_t, std::uint32_t>;
    std::map<Look, Alike> there;
    std::map<Look, Alike> all;
    for (const FaceId f : bodies_[body]) {
      const std::size_t i = f.value();
      const Look look{loose.material.empty() ? 0U : loose.material[i],
                      loose.object.empty() ? 0U : loose.object[i]};
      for (std::map<Look, Alike>* sums : {&there, &all}) {
        if (sums == &all || dot(surface_.normal(f), normal) > same_way) {
          Alike& alike = sums->try_emplace(look, Alike{0.0, f}).first->second;
          alike.area += surface_.area(f);
        }
      }
    }
    const std::map<Look, Alike>& sums = there.empty() ? all : there;
    return std::max_element(sums.begin(), sums.end(),
                            [](const auto& a, const auto& b) { return a.second.area < b.second.area; })
        ->second.first;
  }

 private:
  [[nodiscard]] std::optional<Block> block(std::size_t body) const {
    context_.check();
    if (bodies_[body].size() <= plain_faces) {
      return std::nullopt;
    }
    const mesh::Surface alone = mesh::faces_alone(surface_, bodies_[body]);
    if (alone.bounds().largest_extent() > short_body * surface_.bounds().largest_extent()) {
      return std::nullopt;
    }
    const Edges before = folded_edges(alone, limits_);
    if (before.brief_length < limits_.over_detailed * before.length) {
      return std::nullopt;
    }
    const std::vector<Vec3> directions = directions_of(alone);
    std::optional<Prism> prism =
        fit_prism(alone.points(), directions, {tab_fraction * limits_.short_edge, limits_.shallow});
    if (!prism) {
      return std::nullopt;
    }
    const mesh::Surface plain = surface_of(*prism);
    if (2 * folded_edges(plain, limits_).brief > before.brief) {
      return std::nullopt;
    }
    if (!looks_like_it(alone, *prism)) {
      return std::nullopt;
    }
    const double apart = spacing * limits_.largest_move;
    const double moved = mesh::greatest_distance(
        mesh::SurfaceTree(alone, apart), mesh::SurfaceTree(plain, apart), limits_.largest_move, context_);
    if (moved > limits_.largest_move) {
      return std::nullopt;
    }
    return Block{std::move(*prism), moved};
  }

  const mesh::Surface& surface_;
  ProxyLimits limits_;
  const Context& context_;
  std::vector<std::vector<FaceId>> bodies_;
};

}  // namespace

BlockProxies make_block_proxies(mesh::Model& model, const ProxyLimits& limits, const Context& context) {
  BlockProxies result;
  const Blocks bodies(model, limits, context);
  const std::vector<std::optional<Block>> blocks = bodies.blocks();
  for (const std::optional<Block>& block : blocks) {
    if (block) {
      ++result.count;
      result.moved_mm = std::max(result.moved_mm, block->moved);
    }
  }
  if (result.count == 0) {
    return result;
  }
  const mesh::LooseFaces loose = mesh::take_apart(model);
  mesh::LooseFaces changed;
  changed.points = loose.points;
  for (std::size_t body = 0; body < blocks.size(); ++body) {
    if (!blocks[body]) {
      for (const FaceId f : bodies.faces(body)) {
        changed.add(loose, f.value(), loose.faces[f.value()]);
      }
      continue;
    }
    const auto first = static_cast<std::uint32_t>(changed.points.size());
    const std::vector<Vec3> points = points_of(blocks[body]->prism);
    changed.points.insert(changed.points.end(), points.begin(), points.end());
    for (const auto& [a, b, c] : faces_of(blocks[body]->prism)) {
      const Vec3 normal = normalized(cross(points[b] - points[a], points[c] - points[a]));
      changed.add(loose, bodies.looks_like(body, normal, loose).value(), {first + a, first + b, first + c});
      changed.polygon.back() = mesh::Soup::none;
    }
  }
  mesh::put_together(model, std::move(changed));
  return result;
}

}  // namespace ridgecraft::prepare
