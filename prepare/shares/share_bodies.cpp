// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/shares/share_bodies.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace ridgecraft::prepare {
namespace {

/// Numbers given in the order in which they are asked for.
class Numbers {
 public:
  explicit Numbers(std::size_t count) : number_(count, PointRules::none) {}

  std::uint32_t operator()(std::uint32_t old) {
    if (number_[old] == PointRules::none) {
      number_[old] = static_cast<std::uint32_t>(old_.size());
      old_.push_back(old);
    }
    return number_[old];
  }
  [[nodiscard]] bool has(std::uint32_t old) const { return number_[old] != PointRules::none; }
  [[nodiscard]] const std::vector<std::uint32_t>& old() const { return old_; }
  /// Ready for another component.
  void forget() {
    for (const std::uint32_t o : old_) {
      number_[o] = PointRules::none;
    }
    old_.clear();
  }

 private:
  std::vector<std::uint32_t> number_;
  std::vector<std::uint32_t> old_;
};

SymmetricShare share_of(const SymmetricShare& whole, const std::vector<std::uint32_t>& faces, Numbers& point,
                        Numbers& origin) {
  SymmetricShare result;
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

std::vector<SymmetricShare> divided(const SymmetricShare& share) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> faces;
  for (std::uint32_t f = 0; f < share.faces.faces.size(); ++f) {
    faces[share.body[share.faces.material[f]]].push_back(f);
  }
  std::map<std::uint32_t, std::size_t> number;
  std::vector<std::size_t> of_point(share.faces.points.size(), 0);
  std::vector<std::uint32_t> new_number(share.faces.points.size(), PointRules::none);
  std::vector<SymmetricShare> result;
  Numbers point(share.faces.points.size());
  Numbers origin(share.origins.size());
  for (const auto& [body, of_body] : faces) {
    number[body] = result.size();
    result.push_back(share_of(share, of_body, point, origin));
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
      return new_number[v] != PointRules::none && of_point[v] == of_point[c.point];
    };
    return here(c.point) && here(c.end) && here(c.image_of_end);
  };
  for (const PointRules::Crossing& c : share.points.crossings) {
    if (of_one_body(c)) {
      result[of_point[c.point]].points.crossings.push_back(
          {new_number[c.point], new_number[c.end], new_number[c.image_of_end]});
    }
  }
  for (const SymmetricShare::Copy& copy : share.copies) {
    const auto found = number.find(copy.body);
    if (found != number.end()) {
      result[found->second].copies.push_back(copy);
    }
  }
  return result;
}

SymmetricShare joined(const std::vector<SymmetricShare>& shares) {
  SymmetricShare result;
  for (const SymmetricShare& share : shares) {
    const auto first_point = static_cast<std::uint32_t>(result.faces.points.size());
    const auto first_origin = static_cast<std::uint32_t>(result.origins.size());
    for (std::size_t f = 0; f < share.faces.faces.size(); ++f) {
      const auto& [a, b, c] = share.faces.faces[f];
      result.faces.add(share.faces, f, {first_point + a, first_point + b, first_point + c});
      result.faces.material.back() = first_origin + share.faces.material[f];
    }
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(result.faces.points, share.faces.points);
    append(result.points.plane, share.points.plane);
    append(result.points.copies, share.points.copies);
    append(result.origins, share.origins);
    append(result.body, share.body);
    append(result.rank, share.rank);
    append(result.copies, share.copies);
    for (const PointRules::Crossing& c : share.points.crossings) {
      result.points.crossings.push_back(
          {first_point + c.point, first_point + c.end, first_point + c.image_of_end});
    }
    result.points.planes = share.points.planes;
    result.deviation = share.deviation;
  }
  return result;
}

}  // namespace ridgecraft::prepare
