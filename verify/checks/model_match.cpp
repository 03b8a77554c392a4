// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 9: the second frame of the file is the surface of the model at its scale, as far as it wasn't
// simplified.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "base/rays.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/geometry/geometry.hpp"

namespace ridgecraft::verify {
namespace {

/// How often a surface that is open goes around points at its opening, at least: a half, less what other
/// openings take.
constexpr double in_opening = 0.2;

/// A triangle whose shortest side needs so many times fewer steps than its longest is narrow.
constexpr int narrow = 4;

/// From the model to the nets' millimetres: it is scaled and shifted, never turned. A model that lies far off
/// keeps its digits, as its own middle is taken away first.
struct Placing {
  double scale = 1.0;
  Vec3 from;
  Vec3 to;

  [[nodiscard]] Vec3 operator()(Vec3 p) const { return scale * (p - from) + to; }
  [[nodiscard]] Vec3 back(Vec3 p) const { return (p - to) / scale + from; }
};

Vec3 centre_of(const Box3& box) {
  return 0.5 * box.low + 0.5 * box.high;
}

Box3 bounds_of(const std::vector<Triangle3>& triangles) {
  Box3 box;
  for (const Triangle3& t : triangles) {
    std::for_each(t.begin(), t.end(), [&](Vec3 p) { box.add(p); });
  }
  return box;
}

/// Normal as long as the triangle's area.
Vec3 area_vector(const Triangle3& t) {
  return 0.5 * cross(t[1] - t[0], t[2] - t[0]);
}

double area_of(const std::vector<Triangle3>& triangles) {
  double sum = 0.0;
  for (const Triangle3& t : triangles) {
    sum += length(area_vector(t));
  }
  return sum;
}

/// A plane polygon of the file as triangles: cut into convex parts in its own plane.
void add_polygon(const Model& model, Index face, Vec3 normal, const Context& context,
                 std::vector<Triangle3>& triangles) {
  const std::span<const Index> corners = model.faces.vertices(face);
  const Vec3 origin = model.points[corners[0]];
  if (corners.size() == 3 || normal == Vec3{}) {
    for (std::size_t k = 2; k < corners.size(); ++k) {
      triangles.push_back({origin, model.points[corners[k - 1]], model.points[corners[k]]});
    }
    return;
  }
  const Vec3 any = std::abs(normal.x) < 0.5 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 x = normalized(cross(any, normal));
  const Vec3 y = cross(normal, x);
  Polygon flat;
  for (const Index v : corners) {
    const Vec3 p = model.points[v] - origin;
    flat.push_back({dot(p, x), dot(p, y)});
  }
  const auto back = [&](Vec2 p) { return origin + p.x * x + p.y * y; };
  for (const Polygon& part : convex_parts(flat, context)) {
    for (std::size_t k = 2; k < part.size(); ++k) {
      triangles.push_back({back(part[0]), back(part[k - 1]), back(part[k])});
    }
  }
}

std::vector<Triangle3> triangles_of(const Case& given) {
  const Model& model = given.file.model;
  std::vector<Triangle3> triangles;
  for (Index face = 0; face < model.faces.faces(); ++face) {
    add_polygon(model, face, given.relations.normal[face], given.context, triangles);
  }
  return triangles;
}

std::vector<Triangle3> placed(const std::vector<Triangle3>& triangles, const Placing& place) {
  std::vector<Triangle3> result;
  result.reserve(triangles.size());
  for (const Triangle3& t : triangles) {
    result.push_back({place(t[0]), place(t[1]), place(t[2])});
  }
  return result;
}

/// A narrow triangle, its first corner opposite to its shortest side: points in rows from there, as many in
/// each as that side needs. What wide triangles have would be points upon points.
void add_narrow(const Triangle3& t, int rows, int across, std::vector<Vec3>& samples) {
  for (int i = 0; i <= rows; ++i) {
    const double u = static_cast<double>(i) / rows;
    for (int k = 0; k <= across; ++k) {
      const double v = static_cast<double>(k) / across;
      samples.push_back(t[0] + u * ((1.0 - v) * (t[1] - t[0]) + v * (t[2] - t[0])));
    }
  }
}

/// Corners, and points between them about `spacing` apart, but not too many of one triangle.
std::vector<Vec3> samples_of(const std::vector<Triangle3>& triangles, double spacing) {
  std::vector<Vec3> samples;
  for (const Triangle3& t : triangles) {
    const std::array<double, 3> opposite{length(t[2] - t[1]), length(t[0] - t[2]), length(t[1] - t[0])};
    const auto steps_along = [&](double side) {
      return static_cast<int>(std::clamp(std::ceil(side / spacing), 1.0, most_sample_steps));
    };
    const auto shortest =
        static_cast<std::size_t>(std::min_element(opposite.begin(), opposite.end()) - opposite.begin());
    const int steps = steps_along(*std::max_element(opposite.begin(), opposite.end()));
    if (const int across = steps_along(opposite[shortest]); narrow * across <= steps) {
      add_narrow({t[shortest], t[(shortest + 1) % 3], t[(shortest + 2) % 3]}, steps, across, samples);
      continue;
    }
    for (int i = 0; i <= steps; ++i) {
      for (int k = 0; i + k <= steps; ++k) {
        const double u = static_cast<double>(i) / steps;
        const double v = static_cast<double>(k) / steps;
        samples.push_back(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]));
      }
    }
    samples.push_back((t[0] + t[1] + t[2]) / 3.0);
  }
  return samples;
}

/// Whether the surface stands before a point whichever way one looks from it: nobody sees what is there.
/// Looked at in directions that are even over the sphere.
bool is_enclosed(const std::vector<Triangle3>& surface, Vec3 p) {
  constexpr int directions = 64;
  for (int i = 0; i < directions; ++i) {
    const Vec3 direction = even_direction(i, directions);
    if (std::none_of(surface.begin(), surface.end(),
                     [&](const Triangle3& t) { return std::isfinite(meets_at(p, direction, t)); })) {
      return false;
    }
  }
  return true;
}

struct Farthest {
  double distance = 0.0;
  Vec3 at;
};

/// `may_be_off`: whether a point that is off the other surface is none that has to be on it.
template <class MayBeOff>
void look_farther(const std::vector<Vec3>& samples, const SurfaceTree& tree, const Context& context,
                  Farthest& farthest, const MayBeOff& may_be_off) {
  SurfaceTree::Place place;
  for (const Vec3 p : samples) {
    context.check();
    place = tree.nearest(p, std::max(farthest.distance, same_point_mm), place);
    const double distance = length(p - place.point);
    if (distance > farthest.distance && !may_be_off(p)) {
      farthest = {distance, p};
    }
  }
}

class ModelCheck {
 public:
  ModelCheck(const Case& given, const ModelSurface& surface, Findings& findings)
      : given_(given),
        file_(given.file),
        findings_(findings),
        units_per_point_unit_(surface.units_per_point_unit),
        digest_(surface.digest),
        nets_(triangles_of(given)) {
    for (const auto& [a, b, c] : surface.faces) {
      model_.push_back({surface.points[a], surface.points[b], surface.points[c]});
    }
    drop_details(surface);
  }

  void run() {
    ModelFigures& figures = findings_.model();
    if (!digest_.empty() && !file_.digest.empty()) {
      figures.same_file = digest_ == file_.digest;
    }
    const Box3 there = bounds_of(model_);
    if (!(there.largest_extent() > 0.0)) {
      findings_.add(Promise::model, {}, [] { return "the model has no extent to compare the nets with"; });
      return;
    }
    Placing place = first_placing(there);
    Farthest farthest = measure(place);
    if (!without_details_.empty() && farthest.distance > 0.0) {
      // Details that stick out belong to the model's bounds, not to those of the nets.
      const Placing without = first_placing(bounds_of(without_details_));
      if (const Farthest other = measure(without); other.distance < farthest.distance) {
        farthest = other;
        place = without;
      }
    }
    if (simplified() && farthest.distance > 0.0 && !known_scale_) {
      const Placing better = refined(place);
      if (const Farthest other = measure(better); other.distance < farthest.distance) {
        farthest = other;
        place = better;
      }
    }
    figures.deviation_mm = farthest.distance;
    figures.mm_per_unit = place.scale / units_per_point_unit_;
    figures.allowed_mm = allowed();
    tell(farthest, place);
  }

 private:
  /// What the settings say about it; a file without settings is taken at its word.
  [[nodiscard]] bool simplified() const { return allowed() != same_surface_fraction * file_.model.size; }

  [[nodiscard]] std::optional<double> allowed() const {
    const double same = same_surface_fraction * file_.model.size;
    const Setting* const faces = file_.settings.find("faces");
    if (faces == nullptr) {
      return same;
    }
    if (const auto* word = std::get_if<std::string>(faces); word != nullptr) {
      return *word == "auto" ? simplified_fraction * bounds_of(nets_).largest_extent() + same : same;
    }
    const double* const count = std::get_if<double>(faces);
    return count != nullptr && *count < static_cast<double>(model_.size()) ? std::nullopt
                                                                           : std::optional(same);
  }

  /// Did bodies that run into each other become one skin?
  [[nodiscard]] bool united() const { return file_.settings.find("bodies") != nullptr; }

  /// A component of the model, in its unit.
  struct Body {
    Box3 box;
    double area = 0.0;
    Vec3 normal;  ///< sum of those of its faces, as long as their areas
  };

  /// Per face of the model a point of its component, the same for all of them.
  static std::vector<Index> components_of(const ModelSurface& surface) {
    DisjointSets sets(surface.points.size());
    for (const auto& [a, b, c] : surface.faces) {
      sets.join(a, b);
      sets.join(b, c);
    }
    std::vector<Index> component;
    for (const auto& face : surface.faces) {
      component.push_back(sets.find(face[0]));
    }
    return component;
  }

  [[nodiscard]] std::vector<Body> bodies_of(const std::vector<Index>& component, std::size_t points) const {
    std::vector<Body> bodies(points);
    for (std::size_t f = 0; f < component.size(); ++f) {
      Body& body = bodies[component[f]];
      for (const Vec3 p : model_[f]) {
        body.box.add(p);
      }
      body.normal += area_vector(model_[f]);
      body.area += length(area_vector(model_[f]));
    }
    return bodies;
  }

  /// A strip, or a flat sheet; `scale`: mm of the nets per unit.
  static bool is_detail(const Body& body, double scale) {
    const bool is_strip =
        scale * scale * body.area <= 4.0 * detail_mm * (scale * body.box.diagonal() + detail_mm);
    return is_strip || length(body.normal) >= flat_detail_cosine * body.area;
  }

  /// Small bodies and flat ones may be missing where the program unites bodies.
  void drop_details(const ModelSurface& surface) {
    if (!united()) {
      return;
    }
    const std::vector<Index> component = components_of(surface);
    const std::vector<Body> bodies = bodies_of(component, surface.points.size());
    const double extent = bounds_of(model_).largest_extent();
    const double scale = bounds_of(nets_).largest_extent() / extent;
    const auto may_be_missing = [&](const Body& body) {
      return body.box.largest_extent() <= detail_length_fraction * extent && is_detail(body, scale);
    };
    double missing = 0.0;
    std::vector<Triangle3> kept;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
      if (may_be_missing(bodies[component[f]])) {
        missing += length(area_vector(model_[f]));
      } else {
        kept.push_back(model_[f]);
      }
    }
    if (missing <= details_area_fraction * area_of(model_)) {
      without_details_ = std::move(kept);
    }
  }

  Placing first_placing(const Box3& there) {
    const Box3 here = bounds_of(nets_);
    const double by_size = here.largest_extent() / there.largest_extent();
    const std::optional<double> mm_per_unit = file_.settings.number("mm_per_unit");
    known_scale_ = mm_per_unit.has_value();
    const double scale = mm_per_unit ? *mm_per_unit * units_per_point_unit_ : by_size;
    // At a stated scale the model's middle is the origin; else what the sizes say is all that is known.
    const Vec3 middle = mm_per_unit ? Vec3{} : centre_of(here);
    return {scale, centre_of(there), middle};
  }

  [[nodiscard]] Farthest measure(const Placing& place) const {
    const double spacing = sample_fraction * bounds_of(nets_).largest_extent();
    const std::vector<Triangle3> model = placed(model_, place);
    Farthest farthest;
    // Where bodies became one skin, flat openings may have been closed, and what the skin goes around is
    // hidden, or is a body that can't be seen and was left out.
    look_farther(samples_of(nets_, spacing), SurfaceTree(model), given_.context, farthest,
                 [&](Vec3 p) { return united() && std::abs(winding(model, p)) > in_opening; });
    look_farther(samples_of(without_details_.empty() ? model : placed(without_details_, place), spacing),
                 SurfaceTree(nets_), given_.context, farthest, [&](Vec3 p) {
                   return united() && (std::abs(winding(nets_, p)) > in_opening || is_enclosed(nets_, p));
                 });
    return farthest;
  }

  /// A simplified surface is brought to its size again, so its scale isn't quite the model's: the scale and
  /// shift that lay the nets on the model with the least sum of squares, by nearest points (Besl and McKay
  /// 1992, without turns).
  [[nodiscard]] Placing refined(Placing place) const {
    const std::vector<Vec3> samples = samples_of(nets_, fit_fraction * bounds_of(nets_).largest_extent());
    const SurfaceTree model(model_);
    for (int round = 0; round < fit_rounds; ++round) {
      Vec3 mean_here, mean_there;
      std::vector<Vec3> there;
      SurfaceTree::Place nearest;
      for (const Vec3 p : samples) {
        given_.context.check();
        nearest = model.nearest(place.back(p), 0.0, nearest);
        there.push_back(nearest.point);
        mean_here += p / static_cast<double>(samples.size());
        mean_there += there.back() / static_cast<double>(samples.size());
      }
      double both = 0.0;
      double own = 0.0;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        both += dot(samples[i] - mean_here, there[i] - mean_there);
        own += dot(there[i] - mean_there, there[i] - mean_there);
      }
      if (!(own > 0.0 && both > 0.0)) {
        break;
      }
      place.scale = both / own;
      place.from = mean_there;
      place.to = mean_here;
    }
    return place;
  }

  void tell(const Farthest& farthest, const Placing& place) {
    const std::optional<double> limit = allowed();
    if (limit && farthest.distance > *limit) {
      findings_.add(Promise::model, {}, [&] {
        return fmt::format(
            "the nets are not the model's: the two surfaces are {:.4g} mm apart at ({:.2f}, {:.2f}, {:.2f}), "
            "and {:.4g} mm are allowed",
            farthest.distance, farthest.at.x, farthest.at.y, farthest.at.z, *limit);
      });
    } else if (!simplified() && !united()) {
      const double there = place.scale * place.scale * area_of(model_);
      const double here = area_of(nets_);
      if (std::abs(here - there) > area_tolerance_fraction * there) {
        findings_.add(Promise::model, {}, [&] {
          return fmt::format("the nets have {:.6g} mm² of the model, which has {:.6g} mm²", here, there);
        });
      }
    }
  }

  const Case& given_;
  const File& file_;
  Findings& findings_;
  double units_per_point_unit_;
  std::string digest_;
  std::vector<Triangle3> nets_;   ///< the second frame
  std::vector<Triangle3> model_;  ///< in its own unit
  std::vector<Triangle3> without_details_;
  bool known_scale_ = false;
};

}  // namespace

void check_model(const Case& given, const ModelSurface& surface, Findings& findings) {
  ModelCheck(given, surface, findings).run();
}

}  // namespace ridgecraft::verify
