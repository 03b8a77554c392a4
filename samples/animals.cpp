// SPDX-License-Identifier: GPL-3.0-or-later
// Animals that are a body lofted along its spine, one half of it and its mirror image.
#include <cmath>
#include <numbers>

#include "samples/samples.hpp"

namespace ridgecraft::samples {
namespace {

/// A cross-section of a body: half of it, from the belly up to the back.
struct Section {
  double y;  ///< along the body
  double half_width;
  double bottom, top;  ///< heights of belly and back
  double widest;       ///< height of the widest point
};

Ring half_ring(const Section& s) {
  const double low = 0.45 * s.widest + 0.55 * s.bottom;
  const double high = 0.4 * s.widest + 0.6 * s.top;
  return {{0, s.y, s.bottom},
          {0.72 * s.half_width, s.y, low},
          {s.half_width, s.y, s.widest},
          {0.7 * s.half_width, s.y, high},
          {0, s.y, s.top}};
}

struct Rows {
  std::size_t begin, end;
};

void paint(Shape& shape, const Grid& grid, Rows rows, std::size_t column, Index material) {
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    shape.set_material(grid.face(i, column), material);
  }
}

}  // namespace

Shape whale() {
  Shape shape;
  const Index back = shape.material("back", {0.25, 0.52, 0.74});
  const Index belly = shape.material("belly", {0.93, 0.96, 0.97});
  const Index eye = shape.material("eye", {0.08, 0.09, 0.12});
  std::vector<Ring> rings = {Ring(5, {0, -52, 6})};
  for (const Section& s :
       {Section{-48, 14, -9, 18, 4}, Section{-35, 23, -17, 26, 0}, Section{-14, 25, -20, 28, -3},
        Section{6, 21, -16, 23, -1}, Section{22, 13.5, -8, 18, 4}, Section{34, 8, 3, 17, 10}}) {
    rings.push_back(half_ring(s));
  }
  // The tail bends up; its rings lean back.
  rings.push_back({{0, 46, 15}, {3.6, 45, 17}, {5, 43, 20}, {3.6, 41, 23}, {0, 40, 24.5}});
  // The fluke: a wide flat ring, then its trailing edge, where below and above meet.
  rings.push_back({{0, 53, 27}, {14, 54, 31}, {33, 60, 43}, {14, 51, 34.5}, {0, 48, 32}});
  rings.push_back({{0, 57, 34}, {16, 61, 39}, {33, 60, 43}, {16, 61, 39}, {0, 57, 34}});
  const Grid body = loft(shape, rings, false, back);
  paint(shape, body, {0, 6}, 0, belly);
  paint(shape, body, {0, 3}, 1, belly);
  const Index head = body.face(2, 2);
  shape.raise(head, patch(shape.ring(head), {0.07, 0.12}, {0.33, 0.44}), back);
  shape.set_material(head, eye);
  const Index flank = body.face(3, 1);
  shape.raise(flank, patch(shape.ring(flank), {0.04, 0.12}, {0.7, 0.62}), back);
  shape.raise(flank, {{27, -4, -18}, {28, 8, -19}, {32, 9, -14}, {30, -4, -12}}, back);
  shape.raise_to_point(flank, {46, 17, -19}, back);
  shape.mirror_x();
  shape.finish();
  return shape;
}

Shape fish() {
  Shape shape;
  const Index orange = shape.material("orange", {0.95, 0.45, 0.1});
  const Index white = shape.material("white", {0.97, 0.97, 0.95});
  const Index fin = shape.material("fin", {0.8, 0.28, 0.08});
  const Index eye = shape.material("eye", {0.07, 0.07, 0.1});
  struct Slice {
    Section section;
    double dorsal, anal;  ///< heights of the fins on back and belly
  };
  std::vector<Ring> rings = {Ring(7, {0, -50, 0})};
  for (const Slice& s : {Slice{{-42, 7, -9, 9, -1}, 0, 0}, Slice{{-27, 12, -18, 20, 0}, 0, 0},
                         Slice{{-14, 14, -22, 25, 0}, 11, 0}, Slice{{4, 13, -22, 25, 0}, 13, 0},
                         Slice{{17, 9.5, -17, 19, 0}, 10, 11}, Slice{{30, 5.5, -9, 10, 0}, 4, 4},
                         Slice{{38, 3.5, -6, 6, 0}, 0, 0}}) {
    const Ring half = half_ring(s.section);
    const double y = s.section.y;
    const double base = s.dorsal > 0 ? 2.5 : 0.0;
    const double anal_base = s.anal > 0 ? 2.5 : 0.0;
    rings.push_back({{0, y + 0.7 * s.anal, s.section.bottom - s.anal},
                     {anal_base, y, s.section.bottom},
                     half[1],
                     half[2],
                     half[3],
                     {base, y, s.section.top},
                     {0, y + 0.7 * s.dorsal, s.section.top + s.dorsal}});
  }
  // Behind the last ring the tail fin: flat, so that both halves meet in it.
  rings.push_back(
      {{0, 58, -22}, {0, 58, -22}, {0, 52, -10}, {0, 47, 0}, {0, 52, 10}, {0, 58, 22}, {0, 58, 22}});
  const Grid body = loft(shape, rings, false, orange);
  for (std::size_t row = 0; row + 1 < rings.size(); ++row) {
    paint(shape, body, {row, row + 1}, 0, fin);
    paint(shape, body, {row, row + 1}, 5, fin);
    for (std::size_t column = 1; column < 5; ++column) {
      const bool stripe = row == 2 || row == 4 || row == 6;
      shape.set_material(body.face(row, column), row == 7 ? fin : stripe ? white : orange);
    }
  }
  const Index cheek = body.face(1, 3);
  shape.raise(cheek, patch(shape.ring(cheek), {0.3, 0.18}, {0.68, 0.62}), orange);
  shape.set_material(cheek, eye);
  const Index flank = body.face(3, 2);
  shape.raise(flank, patch(shape.ring(flank), {0.1, 0.35}, {0.55, 0.85}), orange);
  shape.raise_to_point(flank, {29, 10, -8}, fin);
  shape.mirror_x();
  shape.finish();
  return shape;
}

Shape dinosaur() {
  Shape shape;
  const Index skin = shape.material("skin", {0.42, 0.66, 0.36});
  const Index back = shape.material("back", {0.25, 0.48, 0.3});
  const Index belly = shape.material("belly", {0.86, 0.85, 0.62});
  const Index eye = shape.material("eye", {0.08, 0.09, 0.08});
  struct Knot {
    double y, z, half_width, half_height;
  };
  const std::vector<Knot> spine = {
      {-60, 69, 0, 0},     {-57, 70, 7.5, 6.5}, {-47, 74, 10.5, 10}, {-36, 72, 9, 10}, {-33, 60, 8, 8.5},
      {-29, 48, 9.5, 9.5}, {-20, 39, 14, 14},   {-4, 35, 19, 19},    {13, 34, 19, 19}, {28, 30, 14, 14.5},
      {42, 24, 9, 9.5},    {56, 19, 6.5, 6.5},  {79, 18, 0, 0}};
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < spine.size(); ++i) {
    const Knot& before = spine[i > 0 ? i - 1 : 0];
    const Knot& after = spine[i + 1 < spine.size() ? i + 1 : i];
    const Vec3 along = normalized(Vec3{0, after.y - before.y, after.z - before.z});
    const Vec3 up{0, -along.z, along.y};
    Ring& ring = rings.emplace_back();
    for (const double degrees : {-90.0, -52.0, 2.0, 50.0, 90.0}) {
      const double angle = degrees * std::numbers::pi / 180.0;
      const double x = degrees == 90.0 || degrees == -90.0 ? 0.0 : spine[i].half_width * std::cos(angle);
      ring.push_back(Vec3{x, spine[i].y, spine[i].z} + spine[i].half_height * std::sin(angle) * up);
    }
  }
  const Grid body = loft(shape, rings, false, skin);
  paint(shape, body, {3, 10}, 0, belly);
  paint(shape, body, {2, 12}, 3, back);
  const Index cheek = body.face(1, 2);
  shape.raise(cheek, patch(shape.ring(cheek), {0.35, 0.2}, {0.9, 0.85}), skin);
  shape.set_material(cheek, eye);
  const auto leg = [&](Index face, double x, double y) {
    shape.raise(face, patch(shape.ring(face), {0.08, 0.1}, {0.92, 0.9}), skin);
    constexpr double half = 5.5;
    const Ring knee = {{x - half, y - half, 11},
                       {x - half, y + half, 11},
                       {x + half, y + half, 11},
                       {x + half, y - half, 11}};
    shape.raise(face, knee, skin);
    shape.raise(face, scaled(knee, mean(knee), 1.25, {0, -1.5, -11}), back);
  };
  leg(body.face(6, 1), 14, -13);
  leg(body.face(8, 1), 14, 21);
  shape.mirror_x();
  shape.finish();
  return shape;
}

Shape penguin() {
  Shape shape;
  const Index coat = shape.material("coat", {0.2, 0.24, 0.32});
  const Index white = shape.material("white", {0.96, 0.96, 0.94});
  const Index orange = shape.material("orange", {0.96, 0.6, 0.15});
  const Index eye = shape.material("eye", {0.07, 0.07, 0.09});
  struct Level {
    double z, half_width, back, front;  ///< how far it reaches from the axis
  };
  // It stands upright: its rings run from the back around the right side to the front.
  std::vector<Ring> rings = {Ring(6, {0, 0, 0})};
  for (const Level& level :
       {Level{0, 22, 18, 19}, Level{12, 27, 22, 26}, Level{36, 28, 23, 29}, Level{58, 23, 19, 22},
        Level{75, 18, 15, 15}, Level{82, 19.5, 17, 17}, Level{91, 20, 17, 18}, Level{106, 14, 12, 13}}) {
    Ring& ring = rings.emplace_back();
    for (const double degrees : {0.0, 50.0, 95.0, 130.0, 157.0, 180.0}) {
      const double angle = degrees * std::numbers::pi / 180.0;
      const double x = degrees == 180.0 ? 0.0 : level.half_width * std::sin(angle);
      ring.push_back({x, (degrees < 90.0 ? level.back : level.front) * std::cos(angle), level.z});
    }
  }
  rings.push_back(Ring(6, {0, 1, 113}));
  rings[6][5] = {0, -34, 79};  // the tip of the beak
  const Grid body = loft(shape, rings, false, coat);
  paint(shape, body, {1, 5}, 4, white);
  paint(shape, body, {1, 5}, 3, white);
  paint(shape, body, {5, 7}, 3, white);
  paint(shape, body, {5, 7}, 4, orange);
  shape.set_material(body.face(6, 2), white);
  const Index cheek = body.face(6, 3);
  shape.raise(cheek, patch(shape.ring(cheek), {0.3, 0.2}, {0.95, 0.75}), white);
  shape.set_material(cheek, eye);
  const Index shoulder = body.face(3, 1);
  shape.raise(shoulder, patch(shape.ring(shoulder), {0.35, 0.35}, {0.92, 0.9}), coat);
  shape.raise(shoulder, {{33, 6, 36}, {34, 5, 45}, {35, -4, 44}, {34, -5, 35}}, coat);
  shape.raise_to_point(shoulder, {45, -2, 17}, coat);
  const Index foot = body.face(1, 3);
  shape.raise(foot, {{21, -34, 0}, {18, -31, 7}, {9, -33, 7}, {7, -37, 0}}, orange);
  shape.set_material(foot, orange);
  shape.mirror_x();
  shape.finish();
  return shape;
}

// The head of a fox, point by point: one half, looking along -y, and its mirror image.

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
