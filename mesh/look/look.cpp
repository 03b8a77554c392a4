// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/look/look.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/elementary.hpp"

namespace ridgecraft::mesh {
namespace {

/// Pixels whose channels differ by no more are one colour: what JPEG makes of one.
constexpr int same_channel = 4;
/// Along each side of a face so many places are compared at most.
constexpr int most_compared = 48;
/// Lengths on the surface that count as equal, share of its extent: far below what a printer shows.
constexpr double equal_share = 2e-4;

/// A place on a face in its own plane: no other is nearer. Share of what counts as equal.
constexpr double no_distance = 1e-9;

Box3 box_of(const LookFace& face) {
  Box3 box;
  for (const Vec3 p : face.corners) {
    box.add(p);
  }
  return box;
}

Vec3 mixed(const std::array<Vec3, 3>& corners, const std::array<double, 3>& weights) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

/// Of the triangle's point that is nearest to p (Ericson: Real-time collision detection, 2005,
/// section 5.1.5).
std::array<double, 3> nearest_weights(const std::array<Vec3, 3>& corners, Vec3 p) {
  const auto& [a, b, c] = corners;
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const double d1 = dot(ab, p - a);
  const double d2 = dot(ac, p - a);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return {1.0, 0.0, 0.0};
  }
  const double d3 = dot(ab, p - b);
  const double d4 = dot(ac, p - b);
  if (d3 >= 0.0 && d4 <= d3) {
    return {0.0, 1.0, 0.0};
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 / (d1 - d3);
    return {1.0 - t, t, 0.0};
  }
  const double d5 = dot(ab, p - c);
  const double d6 = dot(ac, p - c);
  if (d6 >= 0.0 && d5 <= d6) {
    return {0.0, 0.0, 1.0};
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 / (d2 - d6);
    return {1.0 - t, 0.0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - t, t};
  }
  const double sum = va + vb + vc;
  return sum > 0.0 ? std::array<double, 3>{va / sum, vb / sum, vc / sum}
                   : std::array<double, 3>{1.0, 0.0, 0.0};
}

bool alike(const Rgb& a, const Rgb& b) {
  return std::abs(a[0] - b[0]) <= same_channel && std::abs(a[1] - b[1]) <= same_channel &&
         std::abs(a[2] - b[2]) <= same_channel;
}

Vec3 channels_of(const Rgb& colour) {
  return {static_cast<double>(colour[0]), static_cast<double>(colour[1]), static_cast<double>(colour[2])};
}

Vec2 place_in_picture(const LookFace& face, const std::array<double, 3>& weights) {
  return weights[0] * face.places[0] + weights[1] * face.places[1] + weights[2] * face.places[2];
}

Rgb colour_in_picture(const Paint& paint, Vec2 uv, unsigned level) {
  Rgb colour = paint.picture->at(uv, level);
  if (paint.tint) {
    for (std::size_t k = 0; k < 3; ++k) {
      colour[k] = (*paint.tint)[colour[k]][k];
    }
  }
  return colour;
}

double pixel_size(const LookFace& face, const Paint& paint) {
  if (!paint.picture) {
    return 0.0;
  }
  const double pixels = std::abs(cross(face.places[1] - face.places[0], face.places[2] - face.places[0])) *
                        paint.picture->width() * paint.picture->height();
  const double area = length(cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]));
  return pixels > 0.0 ? std::sqrt(area / pixels) : 0.0;
}

std::vector<LookFace> moved(std::vector<LookFace> faces, double factor, Vec3 shift) {
  for (LookFace& face : faces) {
    for (Vec3& p : face.corners) {
      p = factor * p + shift;
    }
  }
  return faces;
}

// From a model with its materials to what it looks like.

constexpr Rgb white_paper{255, 255, 255};

Rgb bytes_of(const Colour& colour) {
  Rgb bytes{};
  for (std::size_t k = 0; k < 3; ++k) {
    bytes[k] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(colour[k], 0.0, 1.0)));
  }
  return bytes;
}

Rgb unpacked(std::uint32_t packed) {
  return {static_cast<std::uint8_t>(packed >> 16U & 0xffU), static_cast<std::uint8_t>(packed >> 8U & 0xffU),
          static_cast<std::uint8_t>(packed & 0xffU)};
}

/// IEC 61966-2-1.
double light_of(double shown) {
  return shown <= 0.04045 ? shown / 12.92 : elementary::pow((shown + 0.055) / 1.055, 2.4);
}
double shown_of(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * elementary::pow(light, 1.0 / 2.4) - 0.055;
}

std::shared_ptr<const std::array<Rgb, 256>> tint_of(const Colour& colour) {
  if (bytes_of(colour) == white_paper) {
    return nullptr;
  }
  auto table = std::make_shared<std::array<Rgb, 256>>();
  for (std::size_t value = 0; value < 256; ++value) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double shown = shown_of(light_of(static_cast<double>(value) / 255.0) * light_of(colour[k]));
      (*table)[value][k] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(shown, 0.0, 1.0)));
    }
  }
  return table;
}

/// Pictures of a model have so many pixels in all, 600 MB with their coarser copies: more than a hundred
/// pages show. What there are more is dropped from the largest ones.
constexpr std::uint64_t most_pixels_in_all = 150'000'000;

std::uint64_t pixels_of(const Picture& picture) {
  return std::uint64_t{picture.width()} * picture.height();
}

void keep_budget(std::vector<std::shared_ptr<Picture>>& pictures) {
  std::uint64_t sum = 0;
  for (const auto& picture : pictures) {
    sum += pixels_of(*picture);
  }
  while (sum > most_pixels_in_all) {
    Picture& largest = **std::max_element(pictures.begin(), pictures.end(), [](const auto& a, const auto& b) {
      return pixels_of(*a) < pixels_of(*b);
    });
    sum -= pixels_of(largest);
    if (!largest.coarsen()) {
      return;
    }
    sum += pixels_of(largest);
  }
}

/// Materials as paints, then white for faces without one. Materials may share a picture: it is unpacked once.
std::vector<Paint> paints_of(const Model& model, const Context& context, std::vector<std::string>& faults) {
  std::vector<Paint> paints;
  std::map<const std::string*, std::shared_ptr<const Picture>> unpacked_pictures;
  std::vector<std::shared_ptr<Picture>> pictures;
  for (const Material& material : model.materials) {
    context.check();
    Paint paint;
    if (material.colour) {
      paint.colour = bytes_of(*material.colour);
    }
    if (material.picture) {
      const auto [found, fresh] = unpacked_pictures.try_emplace(material.picture.get());
      if (fresh) {
        if (auto picture = unpack_picture(*material.picture)) {
          pictures.push_back(std::make_shared<Picture>(std::move(*picture)));
          found->second = pictures.back();
          keep_budget(pictures);
        } else {
          faults.push_back(fmt::format(
              "the picture of material \"{}\" is damaged or too large, so it isn't printed", material.name));
        }
      }
      paint.picture = found->second;
      if (paint.picture && material.tints_picture && material.colour) {
        paint.tint = tint_of(*material.colour);
      }
    }
    paints.push_back(std::move(paint));
  }
  paints.emplace_back();
  return paints;
}

/// The colour at a place on a polygon's rim: repair puts points onto sides, too.
std::optional<Rgb> colour_on_rim(const CornerColours& colours, std::uint32_t polygon, Vec3 p) {
  const std::uint32_t first = colours.first_corner[polygon];
  const std::uint32_t last = colours.first_corner[polygon + 1];
  double nearest = INFINITY;
  std::optional<Rgb> found;
  for (std::uint32_t i = first; i < last; ++i) {
    const std::uint32_t next = i + 1 == last ? first : i + 1;
    if (colours.colour[i] == Soup::none || colours.colour[next] == Soup::none) {
      return std::nullopt;
    }
    const Vec3 a = colours.point[i];
    const Vec3 side = colours.point[next] - a;
    const double squared = dot(side, side);
    const double t = squared > 0.0 ? std::clamp(dot(p - a, side) / squared, 0.0, 1.0) : 0.0;
    const Vec3 away = p - (a + t * side);
    if (const double distance = dot(away, away); distance < nearest) {
      nearest = distance;
      const Rgb from = unpacked(colours.colour[i]);
      const Rgb to = unpacked(colours.colour[next]);
      found.emplace();
      for (std::size_t k = 0; k < 3; ++k) {
        (*found)[k] = static_cast<std::uint8_t>(std::lround(from[k] + t * (to[k] - from[k])));
      }
    }
  }
  return found;
}

std::optional<std::array<Rgb, 3>> corner_colours(const Model& model, FaceId f,
                                                 const std::array<Vec3, 3>& corners) {
  const std::uint32_t polygon = model.polygon[f];
  if (!model.corner_colours || polygon == Soup::none) {
    return std::nullopt;
  }
  std::array<Rgb, 3> colours{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto colour = colour_on_rim(*model.corner_colours, polygon, corners[k]);
    if (!colour) {
      return std::nullopt;
    }
    colours[k] = *colour;
  }
  return colours;
}

/// Nobody chose white or one grey.
bool is_plain(const std::vector<LookFace>& faces, const std::vector<Paint>& paints) {
  std::set<Rgb> colours;
  for (const LookFace& face : faces) {
    if (paints[face.paint].picture) {
      return false;
    }
    if (face.colours) {
      colours.insert(face.colours->begin(), face.colours->end());
    } else {
      colours.insert(paints[face.paint].colour);
    }
    if (colours.size() > 1) {
      return false;
    }
  }
  return colours.empty() ||
         ((*colours.begin())[0] == (*colours.begin())[1] && (*colours.begin())[1] == (*colours.begin())[2]);
}

}  // namespace

Look::Look(LookParts parts, double factor, Vec3 shift)
    : faces_(moved(std::move(parts.faces), factor, shift)),
      paints_(std::move(parts.paints)),
      tree_(
          faces_.size(), [&](std::uint32_t f) { return box_of(faces_[f]); },
          [&](std::uint32_t f) {
            const auto& [a, b, c] = faces_[f].corners;
            return (a + b + c) / 3.0;
          }) {
  Box3 bounds;
  for (const LookFace& face : faces_) {
    flat_.push_back(find_flat_colour(face));
    pixel_size_.push_back(pixel_size(face, paints_[face.paint]));
    std::for_each(face.corners.begin(), face.corners.end(), [&](Vec3 p) { bounds.add(p); });
  }
  tie_ = elementary::pow(equal_share * bounds.largest_extent(), 2.0);
}

void Look::try_face(Best& best, std::uint32_t f, Vec3 p, Vec3 normal, bool any_side) const {
  const LookFace& face = faces_[f];
  const double same = dot(face.normal, normal);
  if (!any_side && !(same > 0.0)) {
    return;
  }
  const std::array<double, 3> weights = nearest_weights(face.corners, p);
  const Vec3 away = p - mixed(face.corners, weights);
  const double cost = dot(away, away) + tie_ * (1.0 - same);
  if (cost < best.cost || (cost == best.cost && f < best.place.face)) {
    best = {cost, {f, weights}};
  }
}

std::vector<std::uint32_t> Look::faces_near(Vec3 p, Vec3 normal, double radius, std::size_t most) const {
  const auto looks_the_same_way = [&](std::uint32_t f) { return dot(faces_[f].normal, normal) > 0.0; };
  const Best middle = tree_.nearest_first(
      p, Best{},
      [](const Best& found, std::uint32_t /*node*/, double distance) { return distance <= found.cost; },
      [&](Best& found, std::uint32_t place) { try_face(found, tree_.order()[place], p, normal, false); });
  std::vector<std::uint32_t> faces;
  if (!std::isfinite(middle.cost)) {
    return faces;
  }
  // Of a point at the rim the face that is nearest to p costs no more than this, so that its own nearest one
  // lies no farther off.
  const double from_rim = std::sqrt(std::pow(std::sqrt(middle.cost) + radius, 2.0) + tie_);
  const double farthest = std::pow(from_rim + radius, 2.0) * (1.0 + 1e-9);
  bool are_few = true;
  tree_.search(
      [&](std::uint32_t node) { return are_few && squared_distance(p, tree_.box(node)) <= farthest; },
      [&](std::uint32_t place) {
        const std::uint32_t f = tree_.order()[place];
        if (!are_few || !looks_the_same_way(f)) {
          return;
        }
        const Vec3 away = p - mixed(faces_[f].corners, nearest_weights(faces_[f].corners, p));
        if (dot(away, away) <= farthest) {
          are_few = faces.size() < most;
          faces.push_back(f);
        }
      });
  return are_few ? faces : std::vector<std::uint32_t>();
}

LookPlace Look::nearest_among(const std::vector<std::uint32_t>& faces, Vec3 p, Vec3 normal,
                              std::uint32_t hint) const {
  Best best;
  if (hint < faces_.size()) {
    try_face(best, hint, p, normal, false);
    if (best.cost < no_distance * tie_) {
      return best.place;
    }
  }
  for (const std::uint32_t f : faces) {
    try_face(best, f, p, normal, false);
  }
  return best.place;
}

LookPlace Look::nearest(Vec3 p, Vec3 normal, std::uint32_t hint) const {
  for (const bool any_side : {false, true}) {
    Best best;
    if (hint < faces_.size()) {
      try_face(best, hint, p, normal, any_side);
      if (best.cost < no_distance * tie_) {
        return best.place;
      }
    }
    best = tree_.nearest_first(
        p, best,
        [](const Best& found, std::uint32_t /*node*/, double distance) { return distance <= found.cost; },
        [&](Best& found, std::uint32_t place) {
          try_face(found, tree_.order()[place], p, normal, any_side);
        });
    if (std::isfinite(best.cost)) {
      return best.place;
    }
  }
  return {};
}

std::optional<std::uint32_t> Look::face_under(const std::array<Vec3, 3>& triangle, Vec3 normal) const {
  const std::uint32_t face = nearest((triangle[0] + triangle[1] + triangle[2]) / 3.0, normal).face;
  // How far a point is from a face has its greatest value over a triangle at one of the corners.
  const bool holds_all = std::ranges::all_of(triangle, [&](Vec3 p) {
    Best best;
    try_face(best, face, p, normal, false);
    return best.cost < no_distance * tie_;
  });
  return holds_all ? std::optional(face) : std::nullopt;
}

std::optional<Rgb> Look::find_flat_colour(const LookFace& face) const {
  const Paint& paint = paints_[face.paint];
  if (!paint.picture) {
    if (!face.colours) {
      return paint.colour;
    }
    const auto& [a, b, c] = *face.colours;
    return alike(a, b) && alike(b, c) && alike(a, c) ? std::optional(a) : std::nullopt;
  }
  double pixels = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 side = face.places[(k + 1) % 3] - face.places[k];
    pixels = std::max(
        {pixels, std::abs(side.x) * paint.picture->width(), std::abs(side.y) * paint.picture->height()});
  }
  const int steps = static_cast<int>(std::min(std::ceil(pixels), double{most_compared}));
  const Rgb middle = colour_in_picture(paint, place_in_picture(face, {1.0 / 3, 1.0 / 3, 1.0 / 3}), 0);
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const double u = static_cast<double>(i) / steps;
      const double v = static_cast<double>(j) / steps;
      if (!alike(middle, colour_in_picture(paint, place_in_picture(face, {1.0 - u - v, u, v}), 0))) {
        return std::nullopt;
      }
    }
  }
  return middle;
}

Rgb Look::colour_at(const LookPlace& place, double dot) const {
  if (flat_[place.face]) {
    return *flat_[place.face];
  }
  const LookFace& face = faces_[place.face];
  const Paint& paint = paints_[face.paint];
  if (paint.picture) {
    return colour_in_picture(paint, place_in_picture(face, place.weights), level_of(place.face, dot));
  }
  Rgb colour{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [a, b, c] = *face.colours;
    colour[k] = static_cast<std::uint8_t>(std::clamp(
        std::lround(place.weights[0] * a[k] + place.weights[1] * b[k] + place.weights[2] * c[k]), 0L, 255L));
  }
  return colour;
}

unsigned Look::level_of(std::uint32_t face, double dot) const {
  const double size = pixel_size_[face];
  return size > 0.0 ? paints_[faces_[face].paint].picture->level_for(dot / size) : 0;
}

TriangleColours Look::colours_of(std::uint32_t face, const std::array<Vec3, 3>& triangle, double dot) const {
  const LookFace& on = faces_[face];
  const Paint& paint = paints_[on.paint];
  TriangleColours colours;
  if (paint.picture && !flat_[face]) {
    colours.picture_ = paint.picture.get();
    colours.tint_ = paint.tint.get();
    colours.level_ = level_of(face, dot);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<double, 3> weights = nearest_weights(on.corners, triangle[k]);
    if (colours.picture_ != nullptr) {
      colours.places_[k] = place_in_picture(on, weights);
    } else if (flat_[face]) {
      colours.colours_[k] = channels_of(*flat_[face]);
    } else {
      colours.colours_[k] =
          mixed({channels_of((*on.colours)[0]), channels_of((*on.colours)[1]), channels_of((*on.colours)[2])},
                weights);
    }
  }
  return colours;
}

void TriangleColours::along(const std::array<double, 3>& from, const std::array<double, 3>& to,
                            std::span<Rgb> colours) const {
  if (picture_ == nullptr) {
    const double steps = colours.size() > 1 ? static_cast<double>(colours.size() - 1) : 1.0;
    for (std::size_t i = 0; i < colours.size(); ++i) {
      const double share = static_cast<double>(i) / steps;
      std::array<double, 3> weights{};
      for (std::size_t k = 0; k < 3; ++k) {
        weights[k] = from[k] + share * (to[k] - from[k]);
      }
      colours[i] = mixed(weights);
    }
    return;
  }
  picture_->along(place(from), place(to), level_, colours);
  for (Rgb& colour : colours) {
    colour = tinted(colour);
  }
}

Rgb TriangleColours::mixed(const std::array<double, 3>& weights) const {
  const Vec3 channels = weights[0] * colours_[0] + weights[1] * colours_[1] + weights[2] * colours_[2];
  const auto byte = [](double channel) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(channel), 0L, 255L));
  };
  return {byte(channels.x), byte(channels.y), byte(channels.z)};
}

std::optional<LookParts> look_of(const Model& model, const Context& context,
                                 std::vector<std::string>& faults) {
  if (model.material.empty() && !model.corner_colours) {
    return std::nullopt;
  }
  std::vector<Paint> paints = paints_of(model, context, faults);
  const auto none = static_cast<std::uint32_t>(paints.size() - 1);
  std::vector<LookFace> faces;
  faces.reserve(model.surface.face_count());
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    if (model.surface.normal(f) == Vec3{}) {
      continue;
    }
    LookFace face;
    const auto vertices = model.surface.vertices(f);
    for (std::size_t k = 0; k < 3; ++k) {
      face.corners[k] = model.surface.point(vertices[k]);
    }
    face.normal = model.surface.normal(f);
    const std::uint32_t material = model.material.empty() ? Soup::none : model.material[f];
    face.paint = material == Soup::none ? none : material;
    if (paints[face.paint].picture) {
      const bool placed = !model.texture.empty() && model.texture[f] != std::array<Vec2, 3>{};
      if (placed) {
        face.places = model.texture[f];
      } else {
        face.paint = none;  // the file doesn't say which part of the picture
      }
    } else {
      face.colours = corner_colours(model, f, face.corners);
    }
    faces.push_back(face);
  }
  if (is_plain(faces, paints)) {
    return std::nullopt;
  }
  return LookParts{std::move(faces), std::move(paints)};
}

}  // namespace ridgecraft::mesh
