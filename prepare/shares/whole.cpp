// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/shares/whole.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "prepare/shares/take_out.hpp"

namespace ridgecraft::prepare {
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

/// Puts a share's faces into the whole, again and again.
class Placer {
 public:
  Placer(const SymmetricShare& share, const mesh::LooseFaces& model)
      : share_(share),
        model_(model),
        own_(share.faces.points.size(), PointRules::none),
        image_(share.faces.points.size(), PointRules::none) {}

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
        own_[v] = PointRules::none;
      }
    }
    std::vector<std::uint32_t> ranks;
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t v : share_.faces.faces[f]) {
        if (own_[v] == PointRules::none) {
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
      add(faces[i], {own_[a], own_[b], own_[c]}, origin.face, origin.face, mirrors);
    }
    if (!share_.symmetric()) {
      return;
    }
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t v : corners[f]) {
        image_[v] = PointRules::none;
      }
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const SymmetricShare::Origin& origin = origins[number[i]];
      const auto& [a, b, c] = corners[faces[i]];
      if (share_.points.copies[a] > 1) {  // else a sheet in the plane
        add(faces[i], {image(a), image(b), image(c)}, origin.image, origin.face, !mirrors);
      }
    }
  }

  std::uint32_t image(std::uint32_t v) {
    if (image_[v] == PointRules::none) {
      image_[v] = share_.points.plane[v] == PointRules::none
                      ? add_point(share_.points.planes[0].image(result_.points[own_[v]]))
                      : own_[v];
    }
    return image_[v];
  }

  /// `from`: the face of the model that it lies on; `like`: the one whose material it has if it is on none.
  void add(std::uint32_t f, std::array<std::uint32_t, 3> face, std::uint32_t from, std::uint32_t like,
           bool turned) {
    if (turned) {
      std::swap(face[1], face[2]);
    }
    const bool moved = share_.faces.polygon[f] == mesh::Soup::none;
    result_.faces.push_back(face);
    result_.polygon.push_back(moved || from == PointRules::none ? mesh::Soup::none : model_.polygon[from]);
    if (!model_.material.empty()) {
      result_.material.push_back(model_.material[from == PointRules::none ? like : from]);
    }
    if (!model_.object.empty()) {
      result_.object.push_back(model_.object[from == PointRules::none ? like : from]);
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
