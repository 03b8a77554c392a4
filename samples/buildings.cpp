// SPDX-License-Identifier: GPL-3.0-or-later
// A house and a lighthouse: flat walls, roofs, and windows that are set into them.
#include <numbers>

#include "samples/models.hpp"

namespace ridgecraft::samples {
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
