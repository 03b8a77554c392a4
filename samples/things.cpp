// SPDX-License-Identifier: GPL-3.0-or-later
// Things with an axis: turned profiles, and what grows from their sides.
#include <cmath>
#include <numbers>

#include "samples/samples.hpp"

namespace ridgecraft::samples {
namespace {

using std::numbers::pi;

void paint_row(Shape& shape, const Grid& grid, std::size_t row, Index material) {
  for (std::size_t k = 0; k < grid.columns; ++k) {
    shape.set_material(grid.face(row, k), material);
  }
}

}  // namespace

Shape rocket() {
  Shape shape;
  const Index white = shape.material("white", {0.94, 0.94, 0.95});
  const Index red = shape.material("red", {0.84, 0.16, 0.14});
  const Index grey = shape.material("grey", {0.4, 0.42, 0.46});
  const Index glass = shape.material("glass", {0.35, 0.65, 0.85});
  constexpr int sides = 12;
  const std::vector<Vec2> profile = {{0, 6},   {15, 0},  {12.5, 9},   {18, 15}, {23, 40},
                                     {24, 64}, {21, 90}, {13.5, 113}, {0, 136}};
  const Grid hull = revolve(shape, profile, sides, white, pi / sides);
  for (const std::size_t row : {0U, 1U}) {
    paint_row(shape, hull, row, grey);
  }
  for (const std::size_t row : {2U, 7U}) {
    paint_row(shape, hull, row, red);
  }
  for (std::size_t k = 0; k < sides; k += 3) {
    // The fin ends in an upright edge: right and left corners of the raised face are one.
    const Index side = hull.face(3, k);
    const Vec3 middle = shape.centre(side);
    const Vec3 out = normalized(Vec3{middle.x, middle.y, 0});
    const Vec3 low = 46.0 * out + Vec3{0, 0, -6};
    const Vec3 high = 44.0 * out + Vec3{0, 0, 16};
    shape.raise(side, {low, high, high, low}, red);
  }
  for (const std::size_t k : {1U, 7U}) {
    const Index side = hull.face(5, k);
    shape.raise(side, patch(shape.ring(side), {0.25, 0.14}, {0.72, 0.86}), white);
    shape.set_material(side, glass);
  }
  shape.finish();
  return shape;
}

Shape mug() {
  Shape shape;
  const Index glaze = shape.material("glaze", {0.2, 0.45, 0.55});
  const Index inside = shape.material("inside", {0.95, 0.94, 0.9});
  const Index band = shape.material("band", {0.95, 0.75, 0.3});
  constexpr int sides = 12;
  const Grid body = revolve(shape,
                            {{0, 0},
                             {30, 0},
                             {34, 8},
                             {35, 20},
                             {35, 34},
                             {35, 52},
                             {35, 66},
                             {36, 82},
                             {30, 82},
                             {27, 10},
                             {0, 10}},
                            sides, glaze, pi / sides);
  paint_row(shape, body, 4, band);
  for (const std::size_t row : {8U, 9U}) {
    paint_row(shape, body, row, inside);
  }
  const std::size_t k = sides - 1;  // looks along +x: see start and direction of the rings
  const Index upper = body.face(5, k);
  const Index lower = body.face(3, k);
  shape.raise(upper, patch(shape.ring(upper), {0.15, 0.22}, {0.85, 0.78}), glaze);
  shape.raise(lower, patch(shape.ring(lower), {0.15, 0.22}, {0.85, 0.78}), glaze);
  const Ring start = shape.ring(upper);
  std::vector<Ring> handle;
  for (const double degrees : {70.0, 35.0, 0.0, -35.0, -70.0}) {
    const double angle = degrees * pi / 180.0;
    // An ear of the mug: an ellipse for its inner side and a larger one outside.
    const auto at = [angle](double across, double upright, double y) {
      return Vec3{41.0 + across * std::cos(angle), y, 43.0 + upright * std::sin(angle)};
    };
    handle.push_back(
        {at(15, 14, start[0].y), at(24, 24, start[1].y), at(24, 24, start[2].y), at(15, 14, start[3].y)});
  }
  shape.bridge(upper, lower, handle, glaze);
  shape.finish();
  return shape;
}

Shape vase() {
  Shape shape;
  const std::vector<Vec3> colours = {{0.13, 0.3, 0.42}, {0.16, 0.42, 0.52}, {0.24, 0.55, 0.6},
                                     {0.4, 0.68, 0.66}, {0.62, 0.8, 0.72},  {0.82, 0.9, 0.8},
                                     {0.93, 0.95, 0.88}};
  std::vector<Index> shades;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    shades.push_back(shape.material("shade_" + std::to_string(i + 1), colours[i]));
  }
  // Outside up to the rim, inside down again; every ring is turned by half a side against the one before.
  const std::vector<Vec2> profile = {{0, 0},    {20, 0},   {31, 20},  {36, 42}, {31, 64}, {21, 84},
                                     {16, 100}, {24, 118}, {16, 118}, {9, 98},  {0, 80}};
  constexpr int sides = 8;
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double turns = i < 2 ? 0.0 : i < 8 ? static_cast<double>(i - 1) : 6.0;
    rings.push_back(reversed(circle(profile[i].x, profile[i].y, sides, turns * pi / sides)));
  }
  const Grid grid = loft(shape, rings, true, shades[0]);
  for (std::size_t row = 0; row + 1 < rings.size(); ++row) {
    paint_row(shape, grid, row, row < 7 ? shades[row] : row == 7 ? shades[6] : shades[0]);
  }
  shape.finish();
  return shape;
}

Shape chess_rook() {
  Shape shape;
  const Index wood = shape.material("wood", {0.83, 0.66, 0.44});
  const Index felt = shape.material("felt", {0.2, 0.42, 0.27});
  constexpr int sides = 12;
  const Grid body = revolve(shape,
                            {{0, 0},
                             {32, 0},
                             {32, 10},
                             {25, 18},
                             {18.5, 30},
                             {16.5, 64},
                             {24, 74},
                             {24, 86},
                             {16, 86},
                             {16, 76},
                             {0, 76}},
                            sides, wood, pi / sides);
  paint_row(shape, body, 0, felt);
  for (std::size_t k = 0; k < sides; k += 2) {
    const Index rim = body.face(7, k);
    shape.raise(rim, shifted(shape.ring(rim), {0, 0, 11}), wood);
  }
  shape.finish();
  return shape;
}

Shape torus() {
  Shape shape;
  const Index bright = shape.material("bright", {0.95, 0.78, 0.3});
  const Index dark = shape.material("dark", {0.85, 0.5, 0.2});
  constexpr int round = 16, tube = 8;
  std::vector<Vec2> profile;
  for (int i = 0; i <= tube; ++i) {
    const double angle = 2.0 * pi * (i % tube + 0.5) / tube;
    profile.push_back({50.0 + 22.0 * std::cos(angle), 22.0 * std::sin(angle)});
  }
  const Grid grid = revolve(shape, profile, round, bright, pi / round);
  for (std::size_t row = 0; row < tube; ++row) {
    for (std::size_t k = row % 2; k < round; k += 2) {
      shape.set_material(grid.face(row, k), dark);
    }
  }
  shape.finish();
  return shape;
}

Shape heart() {
  Shape shape;
  const Index red = shape.material("red", {0.86, 0.14, 0.22});
  const Index rose = shape.material("rose", {0.93, 0.3, 0.38});
  // The right half of the outline from the tip below to the notch above, then the same inside, and a ridge.
  const Ring outline = {{0, 0, -50}, {16, 0, -33}, {32, 0, -15}, {44, 0, 4}, {47, 0, 20},
                        {41, 0, 34}, {29, 0, 41},  {15, 0, 39},  {0, 0, 26}};
  const Ring middle = {{0, -13, -36}, {12, -15, -22},  {23, -16, -8}, {30, -17, 6}, {32, -17, 17},
                       {28, -16, 25}, {20.5, -15, 29}, {12, -14, 27}, {0, -14, 14}};
  // The ridge runs out from the middle and back again.
  const Vec3 from{0, -22, -8}, across{10, -24, 5}, to{19, -24, 12};
  const Ring ridge = {from, from, across, to, to, to, to, across, from};
  const Grid front = loft(shape, {ridge, middle, outline}, false, red);
  for (std::size_t k = 0; k < front.columns; ++k) {
    shape.set_material(front.face(0, k), rose);
  }
  Shape back = shape;
  back.transform([](Vec3 p) { return Vec3{-p.x, -p.y, p.z}; });
  shape.mirror_x();
  back.mirror_x();
  shape.add(back);
  shape.finish();
  return shape;
}

// A house and a lighthouse: flat walls, roofs, and windows that are set into them.

namespace {

/// A part of a wall in another colour, in the same plane.
void set_window(Shape& shape, Index wall, Vec2 low, Vec2 high, Index glass) {
  const Index own = shape.faces()[wall].material;
  shape.raise(wall, patch(shape.ring(wall), low, high), own);
  shape.set_material(wall, glass);
}

}  // namespace

Shape house() {
  Shape shape;
  const Index wall = shape.material("wall", {0.95, 0.9, 0.78});
  const Index roof = shape.material("roof", {0.72, 0.25, 0.18});
  const Index brick = shape.material("brick", {0.55, 0.3, 0.25});
  const Index door = shape.material("door", {0.3, 0.45, 0.35});
  const Index glass = shape.material("glass", {0.62, 0.8, 0.9});
  // The gable, from the front up over the ridge to the back, eaves included; slices of it make the house.
  const Ring gable = {{0, -32, 0}, {0, -32, 46}, {0, -40, 43}, {0, 0, 82},
                      {0, 40, 43}, {0, 32, 46},  {0, 32, 0}};
  std::vector<Ring> slices;
  for (const double x : {-50.0, -30.0, -10.0, 10.0, 30.0, 50.0}) {
    slices.push_back(shifted(gable, {x, 0, 0}));
  }
  const Grid grid = loft(shape, slices, true, wall);
  constexpr std::size_t front = 0, front_eave = 1, front_roof = 2, back_roof = 3, back_eave = 4, rear = 5;
  for (std::size_t slice = 0; slice < 5; ++slice) {
    for (const std::size_t side : {front_eave, front_roof, back_roof, back_eave}) {
      shape.set_material(grid.face(slice, side), roof);
    }
    if (slice == 2) {
      // Column 0 of a wall: u runs to the right, v up.
      set_window(shape, grid.face(slice, front), {0.15, 0.04}, {0.85, 0.72}, door);
    } else {
      set_window(shape, grid.face(slice, front), {0.2, 0.35}, {0.8, 0.75}, glass);
    }
    if (slice % 2 == 1) {
      set_window(shape, grid.face(slice, rear), {0.2, 0.3}, {0.8, 0.65}, glass);
    }
  }
  // Both ends in two: the wall, which has a window, and the gable with the eaves.
  for (const bool at_right : {false, true}) {
    const Ring outline = at_right ? reversed(slices.back()) : slices.front();
    const Index end = shape.face({outline[6], outline[0], outline[1], outline[5]}, wall);
    shape.face({outline[1], outline[2], outline[3], outline[4], outline[5]}, wall);
    set_window(shape, end, {0.3, 0.32}, {0.7, 0.78}, glass);
  }
  // The chimney stands on the front roof and ends level.
  const Index base = grid.face(3, front_roof);
  Ring chimney = patch(shape.ring(base), {0.15, 0.55}, {0.75, 0.85});
  shape.raise(base, chimney, roof);
  for (Vec3& p : chimney) {
    p.z = 94;
  }
  shape.raise(base, chimney, brick);
  shape.set_material(base, brick);
  // A dormer in the other half of the roof: its front stands upright.
  const Index dormer = grid.face(1, front_roof);
  Ring frame = patch(shape.ring(dormer), {0.1, 0.22}, {0.9, 0.68});
  shape.raise(dormer, frame, roof);
  frame[3] = {frame[3].x, frame[0].y, frame[3].z};
  frame[2] = {frame[2].x, frame[1].y, frame[2].z};
  shape.raise(dormer, frame, wall);
  set_window(shape, dormer, {0.18, 0.18}, {0.82, 0.82}, glass);
  shape.finish();
  return shape;
}

Shape lighthouse() {
  Shape shape;
  const Index rock = shape.material("rock", {0.45, 0.45, 0.42});
  const Index white = shape.material("white", {0.97, 0.96, 0.93});
  const Index red = shape.material("red", {0.82, 0.17, 0.15});
  const Index lamp = shape.material("lamp", {1.0, 0.86, 0.35});
  const Index dark = shape.material("dark", {0.25, 0.28, 0.33});
  constexpr int sides = 8;
  const Grid tower = revolve(shape,
                             {{0, 0},
                              {40, 0},
                              {36, 10},
                              {25, 16},
                              {21.5, 38},
                              {19, 60},
                              {16.5, 82},
                              {14.5, 102},
                              {22, 106},
                              {22, 112},
                              {12, 112},
                              {12, 128},
                              {16, 130},
                              {0, 150}},
                             sides, white, std::numbers::pi / sides);
  const std::vector<Index> rows = {rock, rock, rock, red,  white, red, white,
                                   dark, dark, dark, lamp, dark,  red};
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t k = 0; k < sides; ++k) {
      shape.set_material(tower.face(row, k), rows[row]);
    }
  }
  // Faces of a revolved row: u runs up, v to the left. The door looks to the front.
  const auto facing = [&](std::size_t row, double x, double y) {
    Index best = tower.face(row, 0);
    for (std::size_t k = 1; k < sides; ++k) {
      const Index face = tower.face(row, k);
      const auto turned = [&](Index f) { return x * shape.normal(f).x + y * shape.normal(f).y; };
      best = turned(face) > turned(best) ? face : best;
    }
    return best;
  };
  set_window(shape, facing(3, 0, -1), {0.05, 0.22}, {0.75, 0.78}, dark);
  set_window(shape, facing(5, 0, -1), {0.3, 0.25}, {0.75, 0.75}, dark);
  set_window(shape, facing(4, 1, 0), {0.3, 0.25}, {0.75, 0.75}, dark);
  set_window(shape, facing(6, -1, 0), {0.3, 0.25}, {0.75, 0.75}, dark);
  shape.finish();
  return shape;
}

}  // namespace ridgecraft::samples
