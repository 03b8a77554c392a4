// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/simplify/slivers.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/model/model.hpp"
#include "mesh/repair/loose_faces.hpp"
#include "prepare/prepared/panels.hpp"

namespace ridgecraft::prepare {
namespace {

/// A turned edge makes room for others beside it; after so many rounds what is left stays.
constexpr int most_rounds = 8;
/// The two faces that take the place of a sliver and its neighbour may lean against the neighbour by this
/// much: cosine of 15 degrees. More, and a wall would become a valley.
constexpr double leaning = 0.966;
/// Faces on both sides of an edge that lie this near to each other make a crease: cosine of 170 degrees.
constexpr double crease = -0.985;

/// An edge to be turned: the longest side of a sliver.
struct Turn {
  double width = 0.0;  ///< of the sliver
  CornerId side;       ///< as the sliver has it
};

class Turner {
 public:
  Turner(FundamentalDomain& domain, double width_mm) : domain_(domain), width_(width_mm) {
    mesh::put_together(model_, domain.faces);
    panels_ = find_panels(model_.surface);
    crosses_.assign(domain.faces.points.size(), false);
    for (const PointRules::Crossing& c : domain.points.crossings) {
      crosses_[c.point] = true;
    }
  }

  /// Turns all edges that don't touch each other's faces; returns how many of the whole model.
  std::size_t run() {
    std::vector<Turn> turns;
    for (const FaceId f : ids<FaceId>(surface().face_count())) {
      if (const auto turn = turn_of(f)) {
        turns.push_back(*turn);
      }
    }
    std::sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) {
      return std::pair(a.width, a.side) < std::pair(b.width, b.side);
    });
    std::vector<bool> touched(surface().face_count(), false);
    std::size_t count = 0;
    for (const Turn& turn : turns) {
      const std::vector<FaceId> around = around_of(turn.side);
      if (std::none_of(around.begin(), around.end(), [&](FaceId f) { return touched[f.value()]; })) {
        for (const FaceId f : around) {
          touched[f.value()] = true;
        }
        do_turn(turn.side);
        count += domain_.points.copies[point(turn.side)];
      }
    }
    return count;
  }

 private:
  [[nodiscard]] const mesh::Surface& surface() const { return model_.surface; }
  [[nodiscard]] Vec3 at(std::uint32_t v) const { return domain_.faces.points[v]; }
  [[nodiscard]] std::uint32_t point(CornerId c) const {
    return domain_.faces.faces[mesh::face_of(c).value()][c.value() % 3];
  }

  struct Shape {
    Vec3 normal;
    double width = 0.0;
  };
  [[nodiscard]] Shape shape(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Vec3 n = cross(at(b) - at(a), at(c) - at(a));
    const double longest = std::max({length(at(b) - at(a)), length(at(c) - at(b)), length(at(a) - at(c))});
    return {normalized(n), longest > 0.0 ? length(n) / longest : 0.0};
  }
  [[nodiscard]] Shape shape(FaceId f) const {
    const auto& [a, b, c] = domain_.faces.faces[f.value()];
    return shape(a, b, c);
  }

  [[nodiscard]] std::optional<Turn> turn_of(FaceId f) const {
    if (!is_narrow(surface(), panels_, panels_.panel[f], width_)) {
      return std::nullopt;
    }
    CornerId side = mesh::corner(f, 0);
    for (unsigned k = 1; k < 3; ++k) {
      if (side_length(mesh::corner(f, k)) > side_length(side)) {
        side = mesh::corner(f, k);
      }
    }
    return may_turn(side) ? std::optional(Turn{shape(f).width, side}) : std::nullopt;
  }

  [[nodiscard]] double side_length(CornerId c) const {
    return length(at(point(mesh::next(c))) - at(point(c)));
  }

  [[nodiscard]] bool may_turn(CornerId side) const {
    const CornerId twin = surface().twin(side);
    if (!twin.valid()) {
      return false;
    }
    const std::array<std::uint32_t, 4> corner{point(side), point(mesh::next(side)),
                                              point(mesh::previous(side)), point(mesh::previous(twin))};
    const auto& [a, b, apex, beyond] = corner;
    // Crossings go along with the ends of edges across the plane, which must stay.
    if (crosses_[a] || crosses_[b] || crosses_[apex] || apex == beyond ||
        joined(mesh::previous(side), beyond)) {
      return false;
    }
    const FaceId sliver = mesh::face_of(side);
    const FaceId neighbour = mesh::face_of(twin);
    const Shape before = shape(neighbour);
    const std::array<Shape, 2> after{shape(a, beyond, apex), shape(beyond, b, apex)};
    const auto is_sliver_face = [&](FaceId f) {
      return is_narrow(surface(), panels_, panels_.panel[f], width_);
    };
    const int slivers_before = 1 + (is_sliver_face(neighbour) ? 1 : 0);
    const int slivers_after = (after[0].width < width_ ? 1 : 0) + (after[1].width < width_ ? 1 : 0);
    if (slivers_after >= slivers_before || std::min(after[0].width, after[1].width) <= shape(sliver).width) {
      return false;
    }
    if (std::any_of(after.begin(), after.end(),
                    [&](const Shape& s) { return dot(s.normal, before.normal) < leaning; })) {
      return false;
    }
    // The new faces' neighbours, in the order a-beyond, beyond-b, b-apex, apex-a.
    const std::array<CornerId, 4> rim{mesh::next(twin), mesh::previous(twin), mesh::next(side),
                                      mesh::previous(side)};
    constexpr std::array<std::size_t, 4> inside{0, 1, 1, 0};
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const CornerId outer = surface().twin(rim[i]);
      if (outer.valid() && dot(shape(mesh::face_of(outer)).normal, after[inside[i]].normal) < crease) {
        return false;
      }
    }
    return true;
  }

  /// Does an edge lead from the vertex at `start` to a point?
  [[nodiscard]] bool joined(CornerId start, std::uint32_t to) const {
    // All faces at the vertex, in both directions from the one given.
    CornerId c = start;
    do {
      if (point(mesh::next(c)) == to || point(mesh::previous(c)) == to) {
        return true;
      }
      const CornerId twin = surface().twin(c);
      c = twin.valid() ? mesh::next(twin) : CornerId();
    } while (c.valid() && c != start);
    for (c = c.valid() ? CornerId() : start; c.valid();) {
      const CornerId twin = surface().twin(mesh::previous(c));
      c = twin;
      if (c.valid() && (point(mesh::next(c)) == to || point(mesh::previous(c)) == to)) {
        return true;
      }
    }
    return false;
  }

  /// Both faces of a side and all that share an edge with them.
  [[nodiscard]] std::vector<FaceId> around_of(CornerId side) const {
    std::vector<FaceId> around;
    for (const FaceId f : {mesh::face_of(side), surface().neighbor(side)}) {
      around.push_back(f);
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId twin = surface().twin(mesh::corner(f, k));
        if (twin.valid()) {
          around.push_back(mesh::face_of(twin));
        }
      }
    }
    return around;
  }

  /// Both new faces are what the neighbour was: the sliver had no area to speak of.
  void do_turn(CornerId side) {
    const CornerId twin = surface().twin(side);
    const std::uint32_t a = point(side);
    const std::uint32_t b = point(mesh::next(side));
    const std::uint32_t apex = point(mesh::previous(side));
    const std::uint32_t beyond = point(mesh::previous(twin));
    const std::uint32_t sliver = mesh::face_of(side).value();
    const std::uint32_t neighbour = mesh::face_of(twin).value();
    mesh::LooseFaces& faces = domain_.faces;
    faces.faces[sliver] = {a, beyond, apex};
    faces.faces[neighbour] = {beyond, b, apex};
    faces.material[sliver] = faces.material[neighbour];
    faces.polygon[sliver] = faces.polygon[neighbour] = mesh::Soup::none;
    // It bears an edge of its own now, so it can't be taken out again.
    std::erase_if(domain_.points.crossings, [&](const PointRules::Crossing& c) { return c.point == beyond; });
  }

  FundamentalDomain& domain_;
  double width_;
  mesh::Model model_;  ///< the domain as it was before this round
  Panels panels_;
  std::vector<bool> crosses_;  ///< of each point: the cut made it on an edge across the plane
};

}  // namespace

std::size_t remove_slivers(FundamentalDomain& domain, double width_mm) {
  std::size_t count = 0;
  for (int round = 0; round < most_rounds; ++round) {
    const std::size_t now = Turner(domain, width_mm).run();
    count += now;
    if (now == 0) {
      break;
    }
  }
  return count;
}

}  // namespace ridgecraft::prepare
