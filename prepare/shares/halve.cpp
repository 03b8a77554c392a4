// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/shares/halve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "mesh/model/surface_distance.hpp"

namespace ridgecraft::prepare {
namespace {

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
  std::optional<SymmetricShare> run() {
    find_sheets();
    number_.assign(surface_.vertex_count(), PointRules::none);
    for (const FaceId f : ids<FaceId>(surface_.face_count())) {
      if (!add(f)) {
        return std::nullopt;
      }
    }
    share_.points.planes = {plane_};
    share_.deviation = mirror_.deviation;
    share_.image = mirror_.maps.face;
    return std::move(share_);
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
    share_.faces.points.push_back(p);
    share_.points.plane.push_back(PointRules::none);
    share_.points.copies.push_back(copies);
    return static_cast<std::uint32_t>(share_.faces.points.size() - 1);
  }

  std::uint32_t vertex(VertexId v) {
    std::uint32_t& own = number_[v.value()];
    if (own == PointRules::none) {
      const bool sheet = sheet_[surface_.component(mesh::face_of(surface_.corners_at(v)[0])).value()];
      own = add_point(side(v) == 0 ? plane_.foot(surface_.point(v)) : surface_.point(v), sheet ? 1 : 2);
    }
    return own;
  }

  /// Where an edge crosses the plane.
  std::uint32_t crossing(CornerId c) {
    std::uint32_t& own = crossings_.try_emplace(surface_.edge(c), PointRules::none).first->second;
    if (own == PointRules::none) {
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
      share_.points.crossings.push_back({point, kept, vertex(image)});
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
    const auto bind = [&](std::uint32_t v) { share_.points.plane[v] = 0; };
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
      return length(share_.faces.points[corners[a]] - share_.faces.points[corners[b]]);
    };
    const std::size_t first = way(0, 2) <= way(1, 3) ? 0 : 1;
    add_face(f, {corners[first], corners[first + 1], corners[first + 2]});
    add_face(f, {corners[first], corners[first + 2], corners[(first + 3) % 4]});
  }

  void add_face(FaceId f, const std::array<std::uint32_t, 3>& face) {
    mesh::LooseFaces& half = share_.faces;
    Vec3 middle_of_image;
    for (const std::uint32_t v : face) {
      middle_of_image += plane_.image(half.points[v]) / 3.0;
    }
    SymmetricShare::Origin origin;
    origin.face = f.value();
    origin.image = image_of(f, middle_of_image).value();
    half.faces.push_back(face);
    half.polygon.push_back(all_.polygon[f.value()]);
    half.material.push_back(static_cast<std::uint32_t>(share_.origins.size()));
    share_.origins.push_back(origin);
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
  SymmetricShare share_;
};

}  // namespace

std::optional<SymmetricShare> halved(const mesh::Surface& model, const mesh::LooseFaces& all,
                                     const Mirror& mirror, double on) {
  return Halver(model, all, mirror, on).run();
}

}  // namespace ridgecraft::prepare
