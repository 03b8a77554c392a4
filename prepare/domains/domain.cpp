// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/domains/domain.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "base/elementary.hpp"
#include "base/no_index.hpp"
#include "mesh/repair/loose_faces.hpp"

namespace ridgecraft::prepare {

Vec3 crossing(const MirrorPlane& plane, Vec3 end, Vec3 image_of_end) {
  const double height = plane.height(end);
  const double sum = height + plane.height(image_of_end);
  const double fraction = sum > 0.0 || sum < 0.0 ? height / sum : 0.0;
  return plane.foot(end + fraction * (plane.image(image_of_end) - end));
}

std::vector<std::uint32_t> points_after(std::size_t count, std::span<const Collapse> collapses) {
  std::vector<std::uint32_t> now(count);
  for (std::uint32_t v = 0; v < now.size(); ++v) {
    now[v] = v;
  }
  // A vertex that stayed may be gone later: from the last collapse back, each points to where it ended.
  for (std::size_t i = collapses.size(); i-- > 0;) {
    now[collapses[i].gone] = now[collapses[i].stays];
  }
  return now;
}

std::vector<std::uint32_t> planes_after(const PointRules& points, std::span<const Collapse> collapses) {
  std::vector<std::uint32_t> plane = points.plane;
  for (const Collapse& c : collapses) {
    if (plane[c.gone] != no_index) {
      plane[c.stays] = plane[c.gone];
    }
  }
  return plane;
}

mesh::LooseFaces replay(const mesh::LooseFaces& loose, std::span<const Collapse> collapses) {
  mesh::LooseFaces result;
  result.points = loose.points;
  const std::vector<std::uint32_t> now = points_after(loose.points.size(), collapses);
  std::vector<bool> moved(loose.points.size(), false);
  for (const Collapse& c : collapses) {
    result.points[c.stays] = c.place;
    moved[c.gone] = moved[c.stays] = true;
  }
  for (std::size_t f = 0; f < loose.faces.size(); ++f) {
    const auto& [a, b, c] = loose.faces[f];
    const std::array<std::uint32_t, 3> face{now[a], now[b], now[c]};
    if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) {
      result.add(loose, f, face);
      if (moved[a] || moved[b] || moved[c]) {
        result.polygon.back() = mesh::Soup::none;
      }
    }
  }
  return result;
}

std::size_t FundamentalDomain::face_count() const {
  std::size_t count = 0;
  for (const auto& face : faces.faces) {
    count += points.copies[face[0]];
  }
  return count - 2 * points.crossings.size();
}

FundamentalDomain collapsed(const FundamentalDomain& domain, std::span<const Collapse> collapses) {
  FundamentalDomain result = domain;
  result.points.plane = planes_after(domain.points, collapses);
  result.faces = replay(domain.faces, collapses);
  const std::vector<std::uint32_t> now = points_after(domain.faces.points.size(), collapses);
  std::vector<bool> touched(now.size(), false);
  for (const Collapse& c : collapses) {
    touched[c.gone] = touched[c.stays] = true;
  }
  std::erase_if(result.points.crossings, [&](PointRules::Crossing& c) {
    c.end = now[c.end];
    c.image_of_end = now[c.image_of_end];
    return touched[c.point] || result.points.plane[c.end] != no_index ||
           result.points.plane[c.image_of_end] != no_index;
  });
  for (const PointRules::Crossing& c : result.points.crossings) {
    result.faces.points[c.point] =
        crossing(domain.points.planes[0], result.faces.points[c.end], result.faces.points[c.image_of_end]);
  }
  return result;
}

namespace {

// Points that a cut made are taken out again where the surface is straight across it.

/// A point on the way from one point to another one.
struct Between {
  std::uint32_t point = 0;
  std::uint32_t to = 0;  ///< its neighbour, that may take its place
};

/// A face may lean by this much (0.1 degrees, as within a panel).
const double leaning_cosine = elementary::cos(0.1 * 3.14159265358979323846 / 180.0);
/// Height over longest side below which a face is nothing but rounding.
constexpr double thin_as_rounding = 1e-6;

using Face = std::array<std::uint32_t, 3>;

class Taker {
 public:
  explicit Taker(mesh::LooseFaces& faces) : faces_(faces), around_(faces.points.size()) {
    for (std::uint32_t f = 0; f < faces.faces.size(); ++f) {
      for (const std::uint32_t v : faces.faces[f]) {
        around_[v].push_back(f);
      }
    }
    gone_.assign(faces.faces.size(), false);
  }

  /// Whether it could be done.
  bool merge(std::uint32_t v, std::uint32_t into) {
    std::vector<std::uint32_t> shared;
    std::vector<std::uint32_t> others;
    for (const std::uint32_t f : around_[v]) {
      (has(f, into) ? shared : others).push_back(f);
    }
    if (shared.empty() || common_neighbours(v, into) != shared.size()) {
      return false;
    }
    if (!std::all_of(others.begin(), others.end(),
                     [&](std::uint32_t f) { return keeps_plane(f, v, into); })) {
      return false;
    }
    for (const std::uint32_t f : shared) {
      remove(f);
    }
    for (const std::uint32_t f : others) {
      std::replace(faces_.faces[f].begin(), faces_.faces[f].end(), v, into);
      around_[into].push_back(f);
    }
    around_[v].clear();
    return true;
  }

  void finish() {
    mesh::LooseFaces kept;
    kept.points = faces_.points;
    for (std::size_t f = 0; f < faces_.faces.size(); ++f) {
      if (!gone_[f]) {
        kept.add(faces_, f, faces_.faces[f]);
      }
    }
    faces_ = std::move(kept);
  }

 private:
  [[nodiscard]] bool has(std::uint32_t f, std::uint32_t v) const {
    return std::find(faces_.faces[f].begin(), faces_.faces[f].end(), v) != faces_.faces[f].end();
  }

  [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t v) const {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t f : around_[v]) {
      for (const std::uint32_t w : faces_.faces[f]) {
        if (w != v) {
          result.push_back(w);
        }
      }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  [[nodiscard]] std::size_t common_neighbours(std::uint32_t v, std::uint32_t w) const {
    const std::vector<std::uint32_t> a = neighbours(v);
    const std::vector<std::uint32_t> b = neighbours(w);
    std::vector<std::uint32_t> common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    return common.size();
  }

  struct Shape {
    Vec3 doubled;
    double longest = 0.0;
  };
  [[nodiscard]] Shape shape(const Face& face) const {
    const Vec3 a = faces_.points[face[0]];
    const Vec3 b = faces_.points[face[1]];
    const Vec3 c = faces_.points[face[2]];
    return {cross(b - a, c - a), std::max({length(b - a), length(c - b), length(a - c)})};
  }

  [[nodiscard]] bool keeps_plane(std::uint32_t f, std::uint32_t v, std::uint32_t into) const {
    const auto [before, long_before] = shape(faces_.faces[f]);
    Face face = faces_.faces[f];
    std::replace(face.begin(), face.end(), v, into);
    const auto [after, long_after] = shape(face);
    if (faces_.points[v] == faces_.points[into]) {
      return true;
    }
    return length(after) > thin_as_rounding * long_after * long_after &&
           (length(before) <= thin_as_rounding * long_before * long_before ||
            dot(before, after) >= leaning_cosine * length(before) * length(after));
  }

  void remove(std::uint32_t f) {
    gone_[f] = true;
    for (const std::uint32_t v : faces_.faces[f]) {
      std::erase(around_[v], f);
    }
  }

  mesh::LooseFaces& faces_;
  std::vector<std::vector<std::uint32_t>> around_;  ///< faces at each point
  std::vector<bool> gone_;
};

/// Merges each of the points with its neighbour where that keeps the surface a surface and every face in its
/// plane; the others stay. O(n log n).
void take_out(mesh::LooseFaces& faces, const std::vector<Between>& points) {
  Taker taker(faces);
  std::vector<Between> left = points;
  for (std::size_t before = no_index; left.size() < before;) {
    before = left.size();
    std::erase_if(left, [&](const Between& b) { return taker.merge(b.point, b.to); });
  }
  taker.finish();
}

/// The same faces without the points of the cut that nothing needs. Points that went along to one place
/// become one first.
mesh::LooseFaces without_crossings(const FundamentalDomain& domain, const mesh::LooseFaces& faces) {
  std::vector<PointRules::Crossing> crossings = domain.points.crossings;
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

/// Puts a domain's faces into the whole, again and again.
class Placer {
 public:
  Placer(const FundamentalDomain& domain, const mesh::LooseFaces& model)
      : domain_(domain),
        model_(model),
        own_(domain.faces.points.size(), no_index),
        image_(domain.faces.points.size(), no_index) {}

  /// All faces where they are, and their mirror images.
  void place_all() {
    std::vector<std::uint32_t> faces(domain_.faces.faces.size());
    std::iota(faces.begin(), faces.end(), 0U);
    result_.points = domain_.faces.points;
    std::iota(own_.begin(), own_.end(), 0U);
    place(faces, domain_.faces.material, domain_.origins, false);
  }

  /// A copy of the body that has these faces.
  void place_copy(const FundamentalDomain::Copy& copy, const std::vector<std::uint32_t>& faces) {
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t v : domain_.faces.faces[f]) {
        own_[v] = no_index;
      }
    }
    std::vector<std::uint32_t> ranks;
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t v : domain_.faces.faces[f]) {
        if (own_[v] == no_index) {
          own_[v] = add_point(copy.motion(domain_.faces.points[v]));
        }
      }
      ranks.push_back(domain_.rank[domain_.faces.material[f]]);
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
             const std::vector<FundamentalDomain::Origin>& origins, bool mirrors) {
    const auto& corners = domain_.faces.faces;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const FundamentalDomain::Origin& origin = origins[number[i]];
      const auto& [a, b, c] = corners[faces[i]];
      add(faces[i], {own_[a], own_[b], own_[c]}, origin.face, origin.face, mirrors);
    }
    if (!domain_.symmetric()) {
      return;
    }
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t v : corners[f]) {
        image_[v] = no_index;
      }
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const FundamentalDomain::Origin& origin = origins[number[i]];
      const auto& [a, b, c] = corners[faces[i]];
      if (domain_.points.copies[a] > 1) {  // else a sheet in the plane
        add(faces[i], {image(a), image(b), image(c)}, origin.image, origin.face, !mirrors);
      }
    }
  }

  std::uint32_t image(std::uint32_t v) {
    if (image_[v] == no_index) {
      image_[v] = domain_.points.plane[v] == no_index
                      ? add_point(domain_.points.planes[0].image(result_.points[own_[v]]))
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
    const bool moved = domain_.faces.polygon[f] == mesh::Soup::none;
    result_.faces.push_back(face);
    result_.polygon.push_back(moved || from == no_index ? mesh::Soup::none : model_.polygon[from]);
    if (!model_.material.empty()) {
      result_.material.push_back(model_.material[from == no_index ? like : from]);
    }
    if (!model_.object.empty()) {
      result_.object.push_back(model_.object[from == no_index ? like : from]);
    }
  }

  const FundamentalDomain& domain_;
  const mesh::LooseFaces& model_;
  mesh::LooseFaces result_;
  std::vector<std::uint32_t> own_;    ///< where each point of the domain is in the result now
  std::vector<std::uint32_t> image_;  ///< and its mirror image
};

}  // namespace

mesh::LooseFaces expand(const FundamentalDomain& domain, const mesh::LooseFaces& model) {
  Placer placer(domain, model);
  placer.place_all();
  if (!domain.copies.empty()) {
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t f = 0; f < domain.faces.faces.size(); ++f) {
      const std::uint32_t body = domain.body[domain.faces.material[f]];
      faces.resize(std::max<std::size_t>(faces.size(), body + 1));
      faces[body].push_back(f);
    }
    for (const FundamentalDomain::Copy& copy : domain.copies) {
      if (copy.body < faces.size()) {
        placer.place_copy(copy, faces[copy.body]);
      }
    }
  }
  mesh::LooseFaces result = placer.take();
  if (!domain.points.crossings.empty()) {
    mesh::LooseFaces smaller = without_crossings(domain, result);
    if (mesh::is_surface(smaller)) {
      return smaller;
    }
  }
  return result;
}

namespace {

/// Numbers given in the order in which they are asked for.
class Numbers {
 public:
  explicit Numbers(std::size_t count) : number_(count, no_index) {}

  std::uint32_t operator()(std::uint32_t old) {
    if (number_[old] == no_index) {
      number_[old] = static_cast<std::uint32_t>(old_.size());
      old_.push_back(old);
    }
    return number_[old];
  }
  [[nodiscard]] bool has(std::uint32_t old) const { return number_[old] != no_index; }
  [[nodiscard]] const std::vector<std::uint32_t>& old() const { return old_; }
  /// Ready for another component.
  void forget() {
    for (const std::uint32_t o : old_) {
      number_[o] = no_index;
    }
    old_.clear();
  }

 private:
  std::vector<std::uint32_t> number_;
  std::vector<std::uint32_t> old_;
};

FundamentalDomain domain_of(const FundamentalDomain& whole, const std::vector<std::uint32_t>& faces,
                            Numbers& point, Numbers& origin) {
  FundamentalDomain result;
  result.deviation = whole.deviation;
  for (const std::uint32_t f : faces) {
    std::array<std::uint32_t, 3> corners = whole.faces.faces[f];
    for (std::uint32_t& v : corners) {
      v = point(v);
    }
    result.faces.add(whole.faces, f, corners);
    result.faces.material.back() = origin(whole.faces.material[f]);
  }
  for (const std::uint32_t o : origin.old()) {
    result.origins.push_back(whole.origins[o]);
    result.body.push_back(whole.body[o]);
    result.rank.push_back(whole.rank[o]);
  }
  result.points.planes = whole.points.planes;
  for (const std::uint32_t v : point.old()) {
    result.faces.points.push_back(whole.faces.points[v]);
    result.points.plane.push_back(whole.points.plane[v]);
    result.points.copies.push_back(whole.points.copies[v]);
  }
  return result;
}

}  // namespace

std::vector<FundamentalDomain> divided(const FundamentalDomain& domain) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> faces;
  for (std::uint32_t f = 0; f < domain.faces.faces.size(); ++f) {
    faces[domain.body[domain.faces.material[f]]].push_back(f);
  }
  std::map<std::uint32_t, std::size_t> number;
  std::vector<std::size_t> of_point(domain.faces.points.size(), 0);
  std::vector<std::uint32_t> new_number(domain.faces.points.size(), no_index);
  std::vector<FundamentalDomain> result;
  Numbers point(domain.faces.points.size());
  Numbers origin(domain.origins.size());
  for (const auto& [body, of_body] : faces) {
    number[body] = result.size();
    result.push_back(domain_of(domain, of_body, point, origin));
    for (const std::uint32_t v : point.old()) {
      of_point[v] = result.size() - 1;
      new_number[v] = point(v);
    }
    point.forget();
    origin.forget();
  }
  // Where bodies lie within each other's mirror images, an end's image may be in another body than the edge.
  const auto of_one_body = [&](const PointRules::Crossing& c) {
    const auto here = [&](std::uint32_t v) {
      return new_number[v] != no_index && of_point[v] == of_point[c.point];
    };
    return here(c.point) && here(c.end) && here(c.image_of_end);
  };
  for (const PointRules::Crossing& c : domain.points.crossings) {
    if (of_one_body(c)) {
      result[of_point[c.point]].points.crossings.push_back(
          {new_number[c.point], new_number[c.end], new_number[c.image_of_end]});
    }
  }
  for (const FundamentalDomain::Copy& copy : domain.copies) {
    const auto found = number.find(copy.body);
    if (found != number.end()) {
      result[found->second].copies.push_back(copy);
    }
  }
  return result;
}

FundamentalDomain joined(const std::vector<FundamentalDomain>& domains) {
  FundamentalDomain result;
  for (const FundamentalDomain& domain : domains) {
    const auto first_point = static_cast<std::uint32_t>(result.faces.points.size());
    const auto first_origin = static_cast<std::uint32_t>(result.origins.size());
    for (std::size_t f = 0; f < domain.faces.faces.size(); ++f) {
      const auto& [a, b, c] = domain.faces.faces[f];
      result.faces.add(domain.faces, f, {first_point + a, first_point + b, first_point + c});
      result.faces.material.back() = first_origin + domain.faces.material[f];
    }
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(result.faces.points, domain.faces.points);
    append(result.points.plane, domain.points.plane);
    append(result.points.copies, domain.points.copies);
    append(result.origins, domain.origins);
    append(result.body, domain.body);
    append(result.rank, domain.rank);
    append(result.copies, domain.copies);
    for (const PointRules::Crossing& c : domain.points.crossings) {
      result.points.crossings.push_back(
          {first_point + c.point, first_point + c.end, first_point + c.image_of_end});
    }
    result.points.planes = domain.points.planes;
    result.deviation = domain.deviation;
  }
  return result;
}

}  // namespace ridgecraft::prepare
