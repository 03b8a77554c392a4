// SPDX-License-Identifier: GPL-3.0-or-later
// What a surface looks like: the colours and pictures that its maker gave it, apart from every change that is
// made to its faces later.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/boxes.hpp"
#include "base/context.hpp"
#include "base/vector.hpp"
#include "mesh/look/picture.hpp"
#include "mesh/model/model.hpp"

namespace ridgecraft::mesh {

/// One colour everywhere, or a picture laid on a face.
struct Paint {
  Rgb colour{255, 255, 255};
  std::shared_ptr<const Picture> picture;  ///< null for none
  /// What becomes of each value of each channel of the picture; null where they stay.
  std::shared_ptr<const std::array<Rgb, 256>> tint;
};

/// A face of the surface as it was read.
struct LookFace {
  std::array<Vec3, 3> corners;
  Vec3 normal;                   ///< unit; faces without area aren't kept
  std::uint32_t paint = 0;       ///< index into Look::paints()
  std::array<Vec2, 3> places{};  ///< of the corners in the picture
  /// Of the corners, where they have colours of their own and there is no picture.
  std::optional<std::array<Rgb, 3>> colours;
};

/// A place on the surface as it was read.
struct LookPlace {
  std::uint32_t face = 0;
  std::array<double, 3> weights{};  ///< of the face's corners; their sum is 1
};

/// Colours of a triangle that lies on one face; they live no longer than the Look.
class TriangleColours {
 public:
  /// At a place, by the weights of the triangle's corners, whose sum is 1.
  [[nodiscard]] Rgb at(const std::array<double, 3>& weights) const {
    if (picture_ == nullptr) {
      return mixed(weights);
    }
    return tinted(picture_->at(place(weights), level_));
  }
  /// At places spread evenly from one to another, both among them unless it is one: those of at(), but for a
  /// thousandth of a pixel.
  void along(const std::array<double, 3>& from, const std::array<double, 3>& to,
             std::span<Rgb> colours) const;

 private:
  friend class Look;
  [[nodiscard]] Rgb mixed(const std::array<double, 3>& weights) const;
  [[nodiscard]] Rgb tinted(Rgb colour) const {
    for (std::size_t k = 0; k < 3 && tint_ != nullptr; ++k) {
      colour[k] = (*tint_)[colour[k]][k];
    }
    return colour;
  }
  [[nodiscard]] Vec2 place(const std::array<double, 3>& weights) const {
    return weights[0] * places_[0] + weights[1] * places_[1] + weights[2] * places_[2];
  }

  const Picture* picture_ = nullptr;
  const std::array<Rgb, 256>* tint_ = nullptr;
  unsigned level_ = 0;
  std::array<Vec2, 3> places_{};   ///< of the corners in the picture
  std::array<Vec3, 3> colours_{};  ///< of the corners, without a picture; each channel from 0 to 255
};

/// All faces with what is on them.
struct LookParts {
  std::vector<LookFace> faces;
  std::vector<Paint> paints;
};

/// Finds colours by place.
class Look {
 public:
  /// Of a surface whose points have become factor * p + shift since. O(n log n + pixels under faces).
  explicit Look(LookParts parts, double factor = 1.0, Vec3 shift = {});

  [[nodiscard]] const std::vector<LookFace>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<Paint>& paints() const { return paints_; }
  /// The nearest place on a face whose outside looks to the same side as `normal` (their angle is below a
  /// right one, or what comes nearest to that); of two that are equally near, that on the face which is
  /// turned most the same way. `hint`: a face that may be near; any number. O(log n) where faces lie
  /// sensibly.
  [[nodiscard]] LookPlace nearest(Vec3 p, Vec3 normal, std::uint32_t hint = 0) const;
  /// Faces of which one is nearest() to each point within `radius` of p, if it looks to the same side as
  /// `normal`. Empty where no face does, and where there are more than `most`. O(log n + those).
  [[nodiscard]] std::vector<std::uint32_t> faces_near(Vec3 p, Vec3 normal, double radius,
                                                      std::size_t most) const;
  /// What nearest() of a point that `faces`, not empty, were found for is. O(1) a face.
  [[nodiscard]] LookPlace nearest_among(const std::vector<std::uint32_t>& faces, Vec3 p, Vec3 normal,
                                        std::uint32_t hint = 0) const;
  /// The face that a triangle lies on all over, so that nearest() of each of its points is on it. Nothing
  /// where it lies on none, or on several. O(log n).
  [[nodiscard]] std::optional<std::uint32_t> face_under(const std::array<Vec3, 3>& triangle,
                                                        Vec3 normal) const;
  /// Calls visit(face) for faces whose boxes meet this one.
  template <class Visit>
  void near_box(const Box3& box, Visit visit) const {
    tree_.search([&](std::uint32_t node) { return meet(tree_.box(node), box); },
                 [&](std::uint32_t place) { visit(tree_.order()[place]); });
  }

  /// The colour of a face, if it is one colour all over: without a picture, or where all pixels under it are
  /// alike.
  [[nodiscard]] const std::optional<Rgb>& flat_colour(std::uint32_t face) const { return flat_[face]; }
  /// `dot`: the distance between two dots of a printer, in the unit of the surface; 0 for the finest picture.
  [[nodiscard]] Rgb colour_at(const LookPlace& place, double dot) const;
  /// The same for many places of one triangle that lies on a face.
  [[nodiscard]] TriangleColours colours_of(std::uint32_t face, const std::array<Vec3, 3>& triangle,
                                           double dot) const;

 private:
  /// The best place so far for a point.
  struct Best {
    double cost = INFINITY;
    LookPlace place;
  };
  void try_face(Best& best, std::uint32_t f, Vec3 p, Vec3 normal, bool any_side) const;
  [[nodiscard]] std::optional<Rgb> find_flat_colour(const LookFace& face) const;
  /// Of the face's picture, for dots of this size.
  [[nodiscard]] unsigned level_of(std::uint32_t face, double dot) const;
  std::vector<LookFace> faces_;
  std::vector<Paint> paints_;
  BoxTree<Box3> tree_;
  std::vector<std::optional<Rgb>> flat_;
  std::vector<double> pixel_size_;  ///< per face: side of a pixel of its picture on the surface
  double tie_ = 0.0;                ///< squared lengths that differ by less are equal
};

/// Nothing where the model has no colours: its faces are all white, or all of one grey, which programs write
/// where no colour was chosen. Pictures that can't be unpacked are named in `faults`, and faces that bear
/// them have the material's colour. O(n + pixels). Throws Error(interrupted).
[[nodiscard]] std::optional<LookParts> look_of(const Model& model, const Context& context,
                                               std::vector<std::string>& faults);

}  // namespace ridgecraft::mesh
