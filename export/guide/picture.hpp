// SPDX-License-Identifier: GPL-3.0-or-later
// A view of the model as a picture on a page: where it is, the colours of pieces, the model's own colours.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/context.hpp"
#include "base/vector.hpp"
#include "export/sheet/drawing.hpp"
#include "export/view/camera.hpp"
#include "export/view/scene.hpp"
#include "export/view/view.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// From the scene, as the eye has it, to the page.
struct Fit {
  double scale = 1.0;
  Vec2 shift;
  [[nodiscard]] Vec2 operator()(Vec2 p) const { return scale * p + shift; }
};

/// Twelve hues; pieces that are glued to each other have different ones while there are fewer than twelve of
/// them, and each hue is used about as often as the others. O(joins + 12 pieces).
[[nodiscard]] IdVector<PieceId, Color> piece_hues(const mesh::Surface& surface, const unfold::Nets& nets);

/// The light on a face with this normal: it comes over the left shoulder of whoever looks.
class FaceLight {
 public:
  /// `depth` is how much darker the darkest face is, 0 to 1.
  FaceLight(Vec3 normal, const Camera& camera, double depth);

  /// What is left of a hue.
  [[nodiscard]] Color on(Color hue) const;

 private:
  double fraction_;  ///< of the hue that is left
  double lighter_;   ///< how much of it becomes white
};

/// A hue in the light on one face.
[[nodiscard]] Color shaded(Color hue, Vec3 normal, const Camera& camera, double depth);

/// Between two colours, all of b at share 1.
[[nodiscard]] Color mixed(Color a, Color b, double fraction);

/// How the faces and edges of a piece are drawn.
struct PieceLook {
  Color face;
  Color inside;  ///< the side without print
  double shade = 0.4;
  Pen outline;
  Pen seam;
  Pen fold;
  int rank = 0;  ///< of two pieces at an edge the one of higher rank draws it, over those of lower rank
};
/// In its hue, with dark lines.
[[nodiscard]] PieceLook coloured_look(Color hue);
/// Nearly white, with grey lines.
[[nodiscard]] PieceLook pale_look();
using LookOf = std::function<const PieceLook&(PieceId)>;

/// All faces, flat regions of a piece as one, folds from `hidden_fold_angle` on and seams as lines. The model
/// must outlive it. O(faces log faces).
[[nodiscard]] Scene scene_of(const prepare::Prepared& model, const unfold::Nets& nets,
                             double hidden_fold_angle);
/// The same with some of the pieces only.
[[nodiscard]] Scene scene_with(const Scene& whole, const unfold::Nets& nets,
                               const IdVector<PieceId, bool>& shown);

/// The largest that has room, in the middle of the frame.
[[nodiscard]] Fit fit_into(const Box2& seen, const Box2& frame);

/// The middle of what is seen in the middle of the frame.
[[nodiscard]] Fit fit_at_scale(const Box2& seen, double scale, const Box2& frame);

/// What is seen, from where, and where on the page. Not copied: scene and nets must outlive it.
struct Picture {
  const Scene& scene;
  const unfold::Nets& nets;
  Camera camera;
  Fit fit;
  std::optional<Box2> frame = {};  ///< nothing is drawn beyond it
};

/// Adds what is seen to the group. Throws Error(interrupted).
void add_picture(const Picture& picture, const LookOf& look, Group& group, const Context& context);

/// The same in the model's own colours, without frame and borders of pieces; model.look must be there: areas
/// where faces have one colour each, and below them one picture, of dots, of all faces that have pictures on
/// them, so that nothing hidden is in the drawing. O(areas x faces of their region + dots x log n). Throws
/// Error(interrupted).
void add_coloured_picture(const prepare::Prepared& model, const Picture& picture, Group& group,
                          const Context& context);

}  // namespace ridgecraft::export_
