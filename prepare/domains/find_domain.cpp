// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/domains/find_domain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/context.hpp"
#include "base/no_index.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/model/surface_distance.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/domains/domain.hpp"
#include "prepare/symmetry/mirrors.hpp"
#include "prepare/symmetry/twins.hpp"

namespace ridgecraft::prepare {
namespace {

// A model cut at its mirror plane.

/// So many faces without a partner are searched one by one.
constexpr std::size_t most_alone = 3000;
/// Cosine between a face and the image of another one, below which they don't belong together.
constexpr double alike = 0.7;

/// Cuts a model at a plane and keeps one side of it.
class Halver {
 public:
  Halver(const mesh::Surface& model, const mesh::LooseFaces& all, const Mirror& mirror, double on)
      : surface_(model), all_(all), mirror_(mirror), plane_(mirror.plane) {
    for (const VertexId v : ids<VertexId>(surface_.vertex_count())) {
      const double height = plane_.height(surface_.point(v));
      side_.push_back(std::abs(height) <= on ? 0 : height > 0.0 ? 1 : -1);
    }
    choose_side();
  }

  /// None where a face lies in the plane and is no sheet of its own: it has no sides.
  std::optional<FundamentalDomain> run() {
    find_sheets();
    number_.assign(surface_.vertex_count(), no_index);
    for (const FaceId f : ids<FaceId>(surface_.face_count())) {
      if (!add(f)) {
        return std::nullopt;
      }
    }
    domain_.points.planes = {plane_};
    domain_.deviation = mirror_.deviation;
    domain_.image = mirror_.maps.face;
    return std::move(domain_);
  }

 private:
  [[nodiscard]] int side(VertexId v) const { return side_[v.value()]; }

  /// The side with more faces has more to tell; of equal ones the one that the normal points to.
  void choose_side() {
    std::ptrdiff_t above = 0;
    for (const FaceId f : ids<FaceId>(surface_.face_count())) {
      const auto [a, b, c] = surface_.vertices(f);
      const int low = std::min({side(a), side(b), side(c)});
      const int high = std::max({side(a), side(b), side(c)});
      above += low >= 0 && high > 0 ? 1 : 0;
      above -= high <= 0 && low < 0 ? 1 : 0;
    }
    if (above < 0) {
      for (int& s : side_) {
        s = -s;
      }
    }
  }

  /// Components that lie in the plane are their own images.
  void find_sheets() {
    sheet_.assign(surface_.component_count(), true);
    for (const FaceId f : ids<FaceId>(surface_.face_count())) {
      const auto [above, below] = sides(f);
      if (above || below) {
        sheet_[surface_.component(f).value()] = false;
      }
      if (!mirror_.maps.face[f].valid()) {
        alone_.push_back(f);
      }
    }
  }

  std::uint32_t add_point(Vec3 p, std::uint32_t copies) {
    domain_.faces.points.push_back(p);
    domain_.points.plane.push_back(no_index);
    domain_.points.copies.push_back(copies);
    return static_cast<std::uint32_t>(domain_.faces.points.size() - 1);
  }

  std::uint32_t vertex(VertexId v) {
    std::uint32_t& own = number_[v.value()];
    if (own == no_index) {
      const bool sheet = sheet_[surface_.component(mesh::face_of(surface_.corners_at(v)[0])).value()];
      own = add_point(side(v) == 0 ? plane_.foot(surface_.point(v)) : surface_.point(v), sheet ? 1 : 2);
    }
    return own;
  }

  /// Where an edge crosses the plane.
  std::uint32_t crossing(CornerId c) {
    std::uint32_t& own = crossings_.try_emplace(surface_.edge(c), no_index).first->second;
    if (own == no_index) {
      const Vec3 a = surface_.point(surface_.vertex(c));
      const Vec3 b = surface_.point(surface_.vertex(mesh::next(c)));
      own = add_point(plane_.foot(a + plane_.height(a) / (plane_.height(a) - plane_.height(b)) * (b - a)), 2);
      follow(own, surface_.vertex(c), surface_.vertex(mesh::next(c)));
    }
    return own;
  }

  void follow(std::uint32_t point, VertexId a, VertexId b) {
    const VertexId end = side(a) > 0 ? a : b;
    const VertexId image = mirror_.maps.vertex[side(a) > 0 ? b : a];
    if (image.valid() && side(image) > 0) {
      const std::uint32_t kept = vertex(end);
      domain_.points.crossings.push_back({point, kept, vertex(image)});
    }
  }

  struct Sides {
    bool above = false;
    bool below = false;
  };
  [[nodiscard]] Sides sides(FaceId f) const {
    Sides result;
    for (const VertexId v : surface_.vertices(f)) {
      result.above = result.above || side(v) > 0;
      result.below = result.below || side(v) < 0;
    }
    return result;
  }

  /// Adds what of a face lies on the kept side. Points where it goes on beyond the plane are bound to that.
  bool add(FaceId f) {
    const auto [above, below] = sides(f);
    if (!above) {
      return below || add_to_sheet(f);
    }
    std::vector<std::uint32_t> corners;
    const auto bind = [&](std::uint32_t v) { domain_.points.plane[v] = 0; };
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId c = mesh::corner(f, k);
      const VertexId v = surface_.vertex(c);
      const VertexId w = surface_.vertex(mesh::next(c));
      if (side(v) >= 0) {
        corners.push_back(vertex(v));
        const FaceId beyond = surface_.neighbor(c);
        if (side(v) == 0 && (below || (side(w) == 0 && beyond.valid() && !sides(beyond).above))) {
          bind(corners.back());
          bind(side(w) == 0 ? vertex(w) : corners.back());
        }
      }
      if (side(v) * side(w) < 0) {
        corners.push_back(crossing(c));
        bind(corners.back());
      }
    }
    add_polygon(f, corners);
    return true;
  }

  bool add_to_sheet(FaceId f) {
    if (!sheet_[surface_.component(f).value()]) {
      return false;
    }
    const auto [a, b, c] = surface_.vertices(f);
    add_face(f, {vertex(a), vertex(b), vertex(c)});
    return true;
  }

  /// Three or four corners; the shorter diagonal divides four.
  void add_polygon(FaceId f, const std::vector<std::uint32_t>& corners) {
    if (corners.size() == 3) {
      add_face(f, {corners[0], corners[1], corners[2]});
      return;
    }
    const auto way = [&](std::size_t a, std::size_t b) {
      return length(domain_.faces.points[corners[a]] - domain_.faces.points[corners[b]]);
    };
    const std::size_t first = way(0, 2) <= way(1, 3) ? 0 : 1;
    add_face(f, {corners[first], corners[first + 1], corners[first + 2]});
    add_face(f, {corners[first], corners[first + 2], corners[(first + 3) % 4]});
  }

  void add_face(FaceId f, const std::array<std::uint32_t, 3>& face) {
    mesh::LooseFaces& half = domain_.faces;
    Vec3 middle_of_image;
    for (const std::uint32_t v : face) {
      middle_of_image += plane_.image(half.points[v]) / 3.0;
    }
    FundamentalDomain::Origin origin;
    origin.face = f.value();
    origin.image = image_of(f, middle_of_image).value();
    half.faces.push_back(face);
    half.polygon.push_back(all_.polygon[f.value()]);
    half.material.push_back(static_cast<std::uint32_t>(domain_.origins.size()));
    domain_.origins.push_back(origin);
  }

  /// The face that a face's image lies on: its partner, or of those without one the nearest that looks the
  /// same way.
  [[nodiscard]] FaceId image_of(FaceId f, Vec3 middle) const {
    if (mirror_.maps.face[f].valid() || alone_.size() > most_alone) {
      return mirror_.maps.face[f];
    }
    const Vec3 normal = surface_.normal(f) - 2.0 * dot(surface_.normal(f), plane_.normal) * plane_.normal;
    FaceId best;
    double least = INFINITY;
    for (const FaceId g : alone_) {
      const auto [a, b, c] = surface_.vertices(g);
      const double d =
          mesh::squared_distance(surface_.point(a), surface_.point(b), surface_.point(c), middle);
      if (d < least && dot(normal, surface_.normal(g)) > alike) {
        least = d;
        best = g;
      }
    }
    return best;
  }

  const mesh::Surface& surface_;
  const mesh::LooseFaces& all_;
  const Mirror& mirror_;
  const MirrorPlane& plane_;
  std::vector<int> side_;              ///< of each vertex: 1 on the side that is kept, 0 on the plane
  std::vector<std::uint32_t> number_;  ///< of each vertex in the half
  std::map<EdgeId, std::uint32_t> crossings_;
  std::vector<bool> sheet_;    ///< of each component: it lies in the plane
  std::vector<FaceId> alone_;  ///< faces without a partner
  FundamentalDomain domain_;
};

/// The side of a model that has more faces, corners within `on` of the plane laid into it. `all` is the model
/// taken apart. None where a face lies in the plane and is no sheet of its own, as it has no sides. O(n log
/// n).
std::optional<FundamentalDomain> restricted(const mesh::Surface& model, const mesh::LooseFaces& all,
                                            const Mirror& mirror, double on) {
  return Halver(model, all, mirror, on).run();
}

// Of equal bodies one is simplified, and the others become its copies.

class TwinTaker {
 public:
  TwinTaker(FundamentalDomain& domain, const mesh::Surface& model) : domain_(domain), model_(model) {
    std::vector<std::uint32_t> count(model.component_count(), 0);
    for (const FundamentalDomain::Origin& origin : domain.origins) {
      const std::uint32_t body = model.component(FaceId(origin.face)).value();
      domain.body.push_back(body);
      domain.rank.push_back(count[body]++);
    }
    faces_of_body_.resize(count.size());
    for (std::uint32_t f = 0; f < domain.faces.faces.size(); ++f) {
      faces_of_body_[domain.body[domain.faces.material[f]]].push_back(f);
    }
  }

  void run(const Context& context) {
    const std::vector<std::uint32_t> numbers = whole_bodies();
    if (numbers.size() < 2) {
      return;
    }
    std::vector<std::vector<FaceId>> bodies;
    const std::vector<std::vector<FaceId>> all = components(model_);
    for (const std::uint32_t b : numbers) {
      bodies.push_back(all[b]);
    }
    std::vector<bool> taken_out(model_.component_count(), false);
    std::vector<std::uint32_t> copies(model_.component_count(), 1);
    for (const std::vector<Twin>& group : find_twins(model_, bodies, context)) {
      const std::uint32_t first = numbers[group[0].body];
      for (std::size_t i = 1; i < group.size(); ++i) {
        const std::uint32_t body = numbers[group[i].body];
        domain_.copies.push_back(copy_of(first, group[i], all[body]));
        taken_out[body] = true;
        ++copies[first];
      }
    }
    take_out(taken_out, copies);
  }

 private:
  /// Components that are in the domain with all their faces, uncut.
  [[nodiscard]] std::vector<std::uint32_t> whole_bodies() const {
    std::vector<bool> good(model_.component_count(), false);
    for (const std::uint32_t b : domain_.body) {
      good[b] = true;
    }
    const std::uint32_t usual = domain_.symmetric() ? 2 : 1;
    for (std::size_t f = 0; f < domain_.faces.faces.size(); ++f) {
      for (const std::uint32_t v : domain_.faces.faces[f]) {
        if (domain_.points.plane[v] != no_index || domain_.points.copies[v] != usual) {
          good[domain_.body[domain_.faces.material[f]]] = false;
        }
      }
    }
    std::vector<std::uint32_t> result;
    for (std::uint32_t b = 0; b < good.size(); ++b) {
      if (good[b]) {
        result.push_back(b);
      }
    }
    return result;
  }

  /// `body`: the faces of the twin.
  [[nodiscard]] FundamentalDomain::Copy copy_of(std::uint32_t first, const Twin& twin,
                                                const std::vector<FaceId>& body) const {
    FundamentalDomain::Copy copy;
    copy.body = first;
    copy.motion = twin.motion;
    copy.origins.resize(faces_of_body_[first].size());
    const TwinFaces partner_of(model_, twin, body);
    for (const std::uint32_t f : faces_of_body_[first]) {
      const std::uint32_t number = domain_.faces.material[f];
      const FaceId partner = partner_of(FaceId(domain_.origins[number].face));
      const FaceId image = domain_.symmetric() ? domain_.image[partner] : FaceId();
      copy.origins[domain_.rank[number]] = {partner.value(), image.value()};
    }
    return copy;
  }

  void take_out(const std::vector<bool>& taken_out, const std::vector<std::uint32_t>& copies) {
    mesh::LooseFaces kept;
    kept.points = domain_.faces.points;
    std::vector<bool> counted(kept.points.size(), false);
    for (std::size_t f = 0; f < domain_.faces.faces.size(); ++f) {
      const std::uint32_t body = domain_.body[domain_.faces.material[f]];
      if (taken_out[body]) {
        continue;
      }
      kept.add(domain_.faces, f, domain_.faces.faces[f]);
      for (const std::uint32_t v : domain_.faces.faces[f]) {
        domain_.points.copies[v] *= counted[v] ? 1 : copies[body];
        counted[v] = true;
      }
    }
    domain_.faces = std::move(kept);
  }

  FundamentalDomain& domain_;
  const mesh::Surface& model_;
  std::vector<std::vector<std::uint32_t>> faces_of_body_;  ///< of the domain
};

/// Takes components that are twins of others out of a domain and writes them down as copies; but for such as
/// the mirror plane crosses. `model` is what the domain was made of. O(n log n).
void take_out_twins(FundamentalDomain& domain, const mesh::Surface& model, const Context& context) {
  TwinTaker(domain, model).run(context);
}

/// Corners so near to the plane, as a fraction of the extent, lie on it: cutting beside them would leave
/// slivers.
constexpr double on_plane = 1e-5;
/// Planes that are tried: one may be no use since a face lies in it.
constexpr std::size_t most_planes = 3;

/// All faces, each for itself.
FundamentalDomain all_of(const mesh::LooseFaces& model) {
  FundamentalDomain domain;
  domain.faces = model;
  domain.faces.material.clear();
  domain.faces.object.clear();
  for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
    domain.faces.material.push_back(f);
    domain.origins.push_back({f, no_index});
  }
  domain.points.plane.assign(model.points.size(), no_index);
  domain.points.copies.assign(model.points.size(), 1);
  return domain;
}

/// One side of the model at the best plane that divides it well.
std::optional<FundamentalDomain> half_of(const mesh::Model& model, const mesh::LooseFaces& all,
                                         double largest_deviation) {
  const double extent = model.surface.bounds().largest_extent();
  SymmetryTolerance tolerance;
  tolerance.near = largest_deviation;
  std::optional<FundamentalDomain> result;
  for_mirrors(model.surface, most_planes, tolerance, [&](const Mirror& mirror) {
    // Corners that should lie on the plane may be off it as far as others are off their partners; but a body
    // that is thinner than that has sides all the same.
    for (const double on : {on_plane * extent + 2.0 * mirror.deviation, on_plane * extent}) {
      auto half = restricted(model.surface, all, mirror, on);
      if (half && mesh::is_surface(half->faces) && mesh::is_surface(expand(*half, all))) {
        result = std::move(half);
        return true;
      }
    }
    return false;
  });
  return result;
}

}  // namespace

FundamentalDomain fundamental_domain(const mesh::Model& model, double largest_deviation,
                                     const Context& context) {
  const mesh::LooseFaces all = mesh::take_apart(model);
  std::optional<FundamentalDomain> half = half_of(model, all, largest_deviation);
  context.check();
  FundamentalDomain domain = half ? std::move(*half) : all_of(all);
  take_out_twins(domain, model.surface, context);
  return domain;
}

}  // namespace ridgecraft::prepare
