// SPDX-License-Identifier: GPL-3.0-or-later
// The head of a fox, point by point: one half, looking along -y, and its mirror image.
#include "samples/models.hpp"

namespace ridgecraft::samples {

Shape fox_head() {
  Shape shape;
  const Index orange = shape.material("orange", {0.89, 0.42, 0.13});
  const Index dark = shape.material("dark_orange", {0.72, 0.3, 0.09});
  const Index white = shape.material("white", {0.97, 0.95, 0.92});
  const Index black = shape.material("black", {0.12, 0.1, 0.1});
  const Vec3 nose{0, -52, -1}, nose_under{0, -48, -8}, nose_side{6, -46, -2}, nose_top{0, -45, 5};
  const Vec3 chin{0, -34, -14}, mouth{11, -27, -10}, muzzle{9, -23, 7}, bridge{0, -23, 12};
  const Vec3 throat{0, -10, -25}, jaw{17, -8, -21}, tuft{31, -3, -17}, cheek{43, 3, -3};
  const Vec3 eye_in{9, -19, 14}, eye_out{24, -9, 19}, brow{0, -15, 28}, temple{34, 3, 15};
  const Vec3 top{0, -3, 38}, ear_in{6, -3, 38}, ear_out{34, 4, 26}, ear_back{18, 14, 35}, ear_tip{30, 4, 66};
  const Vec3 crown{0, 15, 36}, nape{0, 29, 10}, back{25, 21, 9}, back_low{0, 20, -22}, jaw_back{19, 12, -20};

  shape.face({nose, nose_side, nose_top}, black);
  shape.face({nose, nose_under, nose_side}, black);
  shape.face({nose_top, nose_side, muzzle, bridge}, orange);
  shape.face({nose_side, mouth, muzzle}, white);
  shape.face({nose_side, nose_under, chin, mouth}, white);
  shape.face({chin, throat, jaw, mouth}, white);
  shape.face({mouth, jaw, tuft}, white);
  shape.face({muzzle, mouth, tuft}, white);
  shape.face({muzzle, tuft, cheek}, white);
  shape.face({muzzle, cheek, eye_out}, orange);
  shape.face({muzzle, eye_out, eye_in}, black);
  shape.face({bridge, muzzle, eye_in}, orange);
  shape.face({bridge, eye_in, brow}, orange);
  shape.face({eye_in, eye_out, brow}, orange);
  shape.face({brow, eye_out, ear_in}, orange);
  shape.face({brow, ear_in, top}, orange);
  shape.face({eye_out, ear_out, ear_in}, orange);
  shape.face({eye_out, temple, ear_out}, orange);
  shape.face({eye_out, cheek, temple}, orange);

  const Index inner_ear = shape.face({ear_in, ear_out, ear_tip}, dark);
  const Ring outline = shape.ring(inner_ear);
  shape.raise(inner_ear, scaled(outline, mean(outline), 0.52, {0, 2.5, -3}), orange);
  shape.set_material(inner_ear, white);
  shape.face({ear_out, ear_back, ear_tip}, dark);
  shape.face({ear_back, ear_in, ear_tip}, dark);

  shape.face({top, ear_in, ear_back, crown}, orange);
  shape.face({crown, ear_back, back, nape}, orange);
  shape.face({ear_back, ear_out, temple, back}, orange);
  shape.face({temple, cheek, back}, orange);
  shape.face({cheek, jaw_back, back}, orange);
  shape.face({cheek, tuft, jaw_back}, white);
  shape.face({tuft, jaw, jaw_back}, white);
  shape.face({back, jaw_back, back_low, nape}, orange);
  shape.face({jaw, throat, back_low, jaw_back}, white);
  shape.mirror_x();
  shape.finish();
  return shape;
}

}  // namespace ridgecraft::samples
