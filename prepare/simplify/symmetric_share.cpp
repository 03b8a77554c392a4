// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/symmetric_share.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "mesh/model/surface_distance.hpp"
#include "prepare/simplify/picture_at.hpp"
#include "prepare/simplify/share_twins.hpp"
#include "prepare/simplify/take_out.hpp"
#include "prepare/symmetry/mirrors.hpp"

namespace ridgecraft::prepare {
namespace {

constexpr std::uint32_t none = PointRules::none;
/// Corners so near to the plane, as a share of the extent, lie on it: cutting beside them would leave
/// splinters.
constexpr double on_plane = 1e-5;
/// Planes that are tried: one may be no use since a face lies in it.
constexpr std::size_t most_planes = 3;
/// So many faces without a partner are searched one by one.
constexpr std::size_t most_alone = 3000;
/// Cosine between a face and the image of another one, below which they don't belong together.
constexpr double alike = 0.7;

/// All faces, each for itself.
SymmetricShare all_of(const mesh::LooseFaces& model) {
  SymmetricShare share;
  share.faces = model;
  share.faces.texture.clear();
  share.faces.material.clear();
  for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
    share.faces.material.push_back(f);
    share.origins.push_back({f, none, model.texture.empty() ? std::array<Vec2, 3>{} : model.texture[f], {}});
  }
  share.points.plane.assign(model.points.size(), none);
  share.points.copies.assign(model.points.size(), 1);
  return share;
}

/// Cuts a model at a plane and keeps one side of it.
class Halver {
 public:
  Halver(const mesh::Model& model, const mesh::LooseFaces& all, const Mirror& mirror, double on)
      : surface_(model.surface), all_(all), mirror_(mirror), plane_(mirror.plane) {
    for (const VertexId v : ids<VertexId>(surface_.vertex_count())) {
      const double height = plane_.height(surface_.point(v));
      side_.push_back(std::abs(height) <= on ? 0 : height > 0.0 ? 1 : -1);
    }
    choose_side();
  }

  /// None where a face lies in the plane and is no sheet of its own: it has no sides. Nor where a texture has
  /// no place for an image.
  std::optional<SymmetricShare> run() {
    find_sheets();
    number_.assign(surface_.vertex_count(), none);
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
    share_.points.plane.push_back(none);
    share_.points.copies.push_back(copies);
    return static_cast<std::uint32_t>(share_.faces.points.size() - 1);
  }

  std::uint32_t vertex(VertexId v) {
    std::uint32_t& own = number_[v.value()];
    if (own == none) {
      const bool sheet = sheet_[surface_.component(mesh::face_of(surface_.corners_at(v)[0])).value()];
      own = add_point(side(v) == 0 ? plane_.foot(surface_.point(v)) : surface_.point(v), sheet ? 1 : 2);
    }
    return own;
  }

  /// Where an edge crosses the plane.
  std::uint32_t crossing(CornerId c) {
    std::uint32_t& own = crossings_.try_emplace(surface_.edge(c), none).first->second;
    if (own == none) {
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
    return add_polygon(f, corners);
  }

  bool add_to_sheet(FaceId f) {
    if (!sheet_[surface_.component(f).value()]) {
      return false;
    }
    const auto [a, b, c] = surface_.vertices(f);
    return add_face(f, {vertex(a), vertex(b), vertex(c)});
  }

  /// Three or four corners; the shorter diagonal divides four.
  bool add_polygon(FaceId f, const std::vector<std::uint32_t>& corners) {
    if (corners.size() == 3) {
      return add_face(f, {corners[0], corners[1], corners[2]});
    }
    const auto way = [&](std::size_t a, std::size_t b) {
      return length(share_.faces.points[corners[a]] - share_.faces.points[corners[b]]);
    };
    const std::size_t first = way(0, 2) <= way(1, 3) ? 0 : 1;
    return add_face(f, {corners[first], corners[first + 1], corners[first + 2]}) &&
           add_face(f, {corners[first], corners[first + 2], corners[(first + 3) % 4]});
  }

  bool add_face(FaceId f, const std::array<std::uint32_t, 3>& face) {
    mesh::LooseFaces& half = share_.faces;
    std::array<Vec3, 3> corners;
    std::array<Vec3, 3> images;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = half.points[face[k]];
      images[k] = plane_.image(corners[k]);
    }
    SymmetricShare::Origin origin;
    origin.face = f.value();
    const FaceId image = image_of(f, (images[0] + images[1] + images[2]) / 3.0);
    origin.image = image.value();
    if (!all_.texture.empty()) {
      if (!image.valid()) {
        return false;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        origin.texture[k] = picture_at(surface_, all_, f, corners[k]);
        origin.image_texture[k] = picture_at(surface_, all_, image, images[k]);
      }
    }
    half.faces.push_back(face);
    half.polygon.push_back(all_.polygon[f.value()]);
    half.material.push_back(static_cast<std::uint32_t>(share_.origins.size()));
    share_.origins.push_back(origin);
    return true;
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

namespace {

/// One side of the model at the best plane that divides it well.
std::optional<SymmetricShare> half_of(const mesh::Model& model, const mesh::LooseFaces& all,
                                      double largest_deviation) {
  const double extent = model.surface.bounds().largest_extent();
  SymmetryTolerance tolerance;
  tolerance.near = largest_deviation;
  for (const Mirror& mirror : find_mirrors(model.surface, most_planes, tolerance)) {
    // Corners that should lie on the plane may be off it as far as others are off their partners; but a body
    // that is thinner than that has sides all the same.
    for (const double on : {on_plane * extent + 2.0 * mirror.deviation, on_plane * extent}) {
      auto half = Halver(model, all, mirror, on).run();
      if (half && mesh::is_surface(half->faces) && mesh::is_surface(whole(*half, all))) {
        return half;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

SymmetricShare symmetric_share(const mesh::Model& model, double largest_deviation, const Context& context) {
  const mesh::LooseFaces all = mesh::take_apart(model);
  std::optional<SymmetricShare> half = half_of(model, all, largest_deviation);
  context.check();
  SymmetricShare share = half ? std::move(*half) : all_of(all);
  share_twins(share, model.surface, all, context);
  return share;
}

std::size_t SymmetricShare::face_count() const {
  std::size_t count = 0;
  for (const auto& face : faces.faces) {
    count += points.copies[face[0]];
  }
  return count - 2 * points.crossings.size();
}

SymmetricShare collapsed(const SymmetricShare& share, std::span<const Collapse> collapses) {
  SymmetricShare result = share;
  result.points.plane = planes_after(share.points, collapses);
  result.faces = replay(share.faces, collapses);
  const std::vector<std::uint32_t> now = points_after(share.faces.points.size(), collapses);
  std::vector<bool> touched(now.size(), false);
  for (const Collapse& c : collapses) {
    touched[c.gone] = touched[c.stays] = true;
  }
  std::erase_if(result.points.crossings, [&](PointRules::Crossing& c) {
    c.end = now[c.end];
    c.image_of_end = now[c.image_of_end];
    return touched[c.point] || result.points.plane[c.end] != none ||
           result.points.plane[c.image_of_end] != none;
  });
  for (const PointRules::Crossing& c : result.points.crossings) {
    result.faces.points[c.point] =
        crossing(share.points.planes[0], result.faces.points[c.end], result.faces.points[c.image_of_end]);
  }
  return result;
}

namespace {

/// The same faces without the points of the cut that nothing needs. Points that went along to one place
/// become one first.
mesh::LooseFaces without_crossings(const SymmetricShare& share, const mesh::LooseFaces& faces) {
  std::vector<PointRules::Crossing> crossings = share.points.crossings;
  std::sort(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) {
    return std::tie(a.end, a.image_of_end, a.point) < std::tie(b.end, b.image_of_end, b.point);
  });
  std::vector<Between> points;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    for (std::size_t k = i + 1; k < crossings.size() && crossings[k].end == crossings[i].end &&
                                crossings[k].image_of_end == crossings[i].image_of_end;
         ++k) {
      points.push_back({crossings[i].point, crossings[k].point});
    }
  }
  for (const PointRules::Crossing& c : crossings) {
    points.push_back({c.point, c.end});
  }
  mesh::LooseFaces result = faces;
  take_out(result, points);
  return result;
}

}  // namespace

namespace {

/// Puts a share's faces into the whole, again and again.
class Placer {
 public:
  Placer(const SymmetricShare& share, const mesh::LooseFaces& model)
      : share_(share),
        model_(model),
        own_(share.faces.points.size(), none),
        image_(share.faces.points.size(), none) {}

  /// All faces where they are, and their mirror images.
  void place_all() {
    std::vector<std::uint32_t> faces(share_.faces.faces.size());
    std::iota(faces.begin(), faces.end(), 0U);
    result_.points = share_.faces.points;
    std::iota(own_.begin(), own_.end(), 0U);
    place(faces, share_.faces.material, share_.origins, false);
  }

  /// A copy of the body that has these faces.
  void place_copy(const SymmetricShare::Copy& copy, const std::vector<std::uint32_t>& faces) {
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t v : share_.faces.faces[f]) {
        own_[v] = none;
      }
    }
    std::vector<std::uint32_t> ranks;
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t v : share_.faces.faces[f]) {
        if (own_[v] == none) {
          own_[v] = add_point(copy.motion(share_.faces.points[v]));
        }
      }
      ranks.push_back(share_.rank[share_.faces.material[f]]);
    }
    place(faces, ranks, copy.origins, copy.motion.mirrors);
  }

  [[nodiscard]] mesh::LooseFaces take() { return std::move(result_); }

 private:
  std::uint32_t add_point(Vec3 p) {
    result_.points.push_back(p);
    return static_cast<std::uint32_t>(result_.points.size() - 1);
  }

  /// Faces with their points where own_ says; `number` of each is that of its origin.
  void place(const std::vector<std::uint32_t>& faces, const std::vector<std::uint32_t>& number,
             const std::vector<SymmetricShare::Origin>& origins, bool mirrors) {
    const auto& corners = share_.faces.faces;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const SymmetricShare::Origin& origin = origins[number[i]];
      const auto& [a, b, c] = corners[faces[i]];
      add(faces[i], {own_[a], own_[b], own_[c]}, origin.face, origin.face, origin.texture, mirrors);
    }
    if (!share_.symmetric()) {
      return;
    }
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t v : corners[f]) {
        image_[v] = none;
      }
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const SymmetricShare::Origin& origin = origins[number[i]];
      const auto& [a, b, c] = corners[faces[i]];
      if (share_.points.copies[a] > 1) {  // else a sheet in the plane
        add(faces[i], {image(a), image(b), image(c)}, origin.image, origin.face, origin.image_texture,
            !mirrors);
      }
    }
  }

  std::uint32_t image(std::uint32_t v) {
    if (image_[v] == none) {
      image_[v] = share_.points.plane[v] == none
                      ? add_point(share_.points.planes[0].image(result_.points[own_[v]]))
                      : own_[v];
    }
    return image_[v];
  }

  /// `from`: the face of the model that it lies on; `like`: the one whose material it has if it is on none.
  void add(std::uint32_t f, std::array<std::uint32_t, 3> face, std::uint32_t from, std::uint32_t like,
           std::array<Vec2, 3> texture, bool turned) {
    if (turned) {
      std::swap(face[1], face[2]);
      std::swap(texture[1], texture[2]);
    }
    const bool moved = share_.faces.polygon[f] == mesh::Soup::none;
    result_.faces.push_back(face);
    result_.polygon.push_back(moved || from == none ? mesh::Soup::none : model_.polygon[from]);
    if (!model_.material.empty()) {
      result_.material.push_back(model_.material[from == none ? like : from]);
    }
    if (!model_.texture.empty()) {
      result_.texture.push_back(texture);
    }
  }

  const SymmetricShare& share_;
  const mesh::LooseFaces& model_;
  mesh::LooseFaces result_;
  std::vector<std::uint32_t> own_;    ///< where each point of the share is in the result now
  std::vector<std::uint32_t> image_;  ///< and its mirror image
};

}  // namespace

mesh::LooseFaces whole(const SymmetricShare& share, const mesh::LooseFaces& model) {
  Placer placer(share, model);
  placer.place_all();
  if (!share.copies.empty()) {
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t f = 0; f < share.faces.faces.size(); ++f) {
      const std::uint32_t body = share.body[share.faces.material[f]];
      faces.resize(std::max<std::size_t>(faces.size(), body + 1));
      faces[body].push_back(f);
    }
    for (const SymmetricShare::Copy& copy : share.copies) {
      if (copy.body < faces.size()) {
        placer.place_copy(copy, faces[copy.body]);
      }
    }
  }
  mesh::LooseFaces result = placer.take();
  if (!share.points.crossings.empty()) {
    mesh::LooseFaces smaller = without_crossings(share, result);
    if (mesh::is_surface(smaller)) {
      return smaller;
    }
  }
  return result;
}

}  // namespace ridgecraft::prepare
