// SPDX-License-Identifier: GPL-3.0-or-later
// Things: turned profiles, and what grows from their sides; convex solids cut out of a block by planes, as a
// gem is cut; a star, and a box.
#include <algorithm>
#include <array>
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
  constexpr int round = 12, tube = 6;
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

namespace {

/// Keeps what is behind the plane: the points p with dot(normal, p) <= distance.
struct Plane {
  Vec3 normal;
  double distance;
};

/// A convex solid as the polygons of its sides.
using Sides = std::vector<Ring>;

Sides block(double half) {
  const Ring bottom =
      reversed({{-half, -half, -half}, {half, -half, -half}, {half, half, -half}, {-half, half, -half}});
  Sides sides;
  const Ring top = reversed(shifted(bottom, {0, 0, 2 * half}));
  sides.push_back(bottom);
  sides.push_back(top);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    sides.push_back(
        {bottom[next], bottom[k], bottom[k] + Vec3{0, 0, 2 * half}, bottom[next] + Vec3{0, 0, 2 * half}});
  }
  return sides;
}

/// Sorts corners of a new side counterclockwise about its normal, equal ones once.
Ring around(std::vector<Vec3> corners, Vec3 normal) {
  const Vec3 middle = mean(corners);
  const Vec3 right = normalized(cross(std::abs(normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, normal));
  const Vec3 up = cross(normal, right);
  const auto angle = [&](Vec3 p) { return std::atan2(dot(p - middle, up), dot(p - middle, right)); };
  std::sort(corners.begin(), corners.end(), [&](Vec3 a, Vec3 b) { return angle(a) < angle(b); });
  const auto equal = [](Vec3 a, Vec3 b) { return length(a - b) < 1e-9; };
  corners.erase(std::unique(corners.begin(), corners.end(), equal), corners.end());
  while (corners.size() > 1 && equal(corners.front(), corners.back())) {
    corners.pop_back();
  }
  return corners;
}

Sides cut(const Sides& sides, const Plane& plane) {
  constexpr double on_plane = 1e-9;
  Sides result;
  std::vector<Vec3> fresh;
  for (const Ring& side : sides) {
    Ring kept;
    for (std::size_t k = 0; k < side.size(); ++k) {
      const Vec3 a = side[k];
      const Vec3 b = side[(k + 1) % side.size()];
      const double above = dot(plane.normal, a) - plane.distance;
      const double next = dot(plane.normal, b) - plane.distance;
      if (above <= on_plane) {
        kept.push_back(a);
      }
      if (std::abs(above) <= on_plane) {
        fresh.push_back(a);
      } else if ((above < -on_plane && next > on_plane) || (above > on_plane && next < -on_plane)) {
        const Vec3 p = a + (above / (above - next)) * (b - a);
        kept.push_back(p);
        fresh.push_back(p);
      }
    }
    if (kept.size() >= 3) {
      result.push_back(kept);
    }
  }
  if (const Ring ring = around(fresh, plane.normal);
      ring.size() >= 3 && result.size() < sides.size() + fresh.size()) {
    const bool is_new = std::any_of(sides.begin(), sides.end(), [&](const Ring& side) {
      return std::any_of(side.begin(), side.end(),
                         [&](Vec3 p) { return dot(plane.normal, p) > plane.distance + on_plane; });
    });
    if (is_new) {
      result.push_back(ring);
    }
  }
  return result;
}

/// As many planes as `count`, equally spread around the z axis. Each goes through two points of the upright
/// half plane in its own direction, given as (distance from the axis, height), the lower one first.
void cut_around(Sides& sides, int count, double start, Vec2 low, Vec2 high) {
  const Vec2 outward = perpendicular(low - high) / length(low - high);
  for (int k = 0; k < count; ++k) {
    const double angle = start + 2.0 * pi * k / count;
    const Vec3 normal{outward.x * std::cos(angle), outward.x * std::sin(angle), outward.y};
    sides = cut(sides, {normal, dot(outward, low)});
  }
}

}  // namespace

Shape gem() {
  Shape shape;
  const Index stone = shape.material("stone", {0.45, 0.75, 0.85});
  Sides sides = block(100.0);
  // A brilliant: 16 sides of the girdle, 8 main facets above and below at every second corner of it, the
  // halves between mains and girdle, and the stars between mains and table. All are laid through the points
  // where they meet.
  constexpr double girdle = 50, belt = 4, table = 29, crown = 18, depth = 42, meet_above = 41,
                   meet_below = 17;
  const double corner = girdle / std::cos(pi / 16.0);
  const double main_side = std::cos(pi / 8.0);
  const double half_side = std::cos(pi / 16.0);
  const double height_above = belt + crown * (corner - meet_above * main_side) / (corner - table);
  const double height_below = -belt - depth * (corner - meet_below * main_side) / corner;
  cut_around(sides, 16, pi / 16.0, {girdle, -belt}, {girdle, belt});
  sides = cut(sides, {{0, 0, 1}, belt + crown});
  cut_around(sides, 8, 0.0, {corner, belt}, {table, belt + crown});
  cut_around(sides, 8, pi / 8.0, {meet_above, height_above}, {table * main_side, belt + crown});
  cut_around(sides, 16, pi / 16.0, {girdle, belt}, {meet_above * half_side, height_above});
  cut_around(sides, 8, 0.0, {0, -belt - depth}, {corner, -belt});
  cut_around(sides, 16, pi / 16.0, {meet_below * half_side, height_below}, {girdle, -belt});
  for (const Ring& side : sides) {
    shape.face(side, stone);
  }
  shape.finish();
  return shape;
}

Shape star() {
  Shape shape;
  const Index warm = shape.material("warm", {0.98, 0.82, 0.35});
  const Index bright = shape.material("bright", {0.99, 0.93, 0.68});
  // The rhombicuboctahedron: planes of a cube, of its edges and of its corners; a spike on each of its 26
  // sides.
  const double reach = 1.0 + std::sqrt(2.0);
  Sides sides = block(4.0);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int planes = std::abs(x) + std::abs(y) + std::abs(z);
        if (planes > 0) {
          const Vec3 normal = normalized(Vec3{1.0 * x, 1.0 * y, 1.0 * z});
          sides = cut(sides, {normal, planes == 3 ? (3.0 + std::sqrt(2.0)) / std::sqrt(3.0) : reach});
        }
      }
    }
  }
  for (const Ring& side : sides) {
    const Index face = shape.face(scaled(side, {}, 9.0), warm);
    const bool triangle = side.size() == 3;
    shape.raise_to_point(face, shape.centre(face) + (triangle ? 30.0 : 40.0) * shape.normal(face),
                         triangle ? bright : warm);
  }
  shape.finish();
  return shape;
}

// A mailing box as it is cut from one sheet: half open, with its lid, tuck and dust flaps. A surface with a
// border.

namespace {

/// A flap along the edge from a to b, seen from outside with a on the left.
struct Flap {
  Vec3 a, b;
  Vec3 out;            ///< its direction
  double depth = 0.0;  ///< its length
  double taper = 0.0;  ///< by how much its free end is narrower on both sides
  double bevel = 0.0;  ///< by how much its free corners are cut off
};

void add(Shape& shape, const Flap& flap, Index material) {
  const Vec3 along = normalized(flap.b - flap.a);
  const Vec3 way_a = flap.depth * flap.out + flap.taper * along;
  const Vec3 way_b = flap.depth * flap.out - flap.taper * along;
  const double fraction = 1.0 - flap.bevel / flap.depth;
  shape.face({flap.a, flap.b, flap.b + fraction * way_b, flap.b + way_b - flap.bevel * along,
              flap.a + way_a + flap.bevel * along, flap.a + fraction * way_a},
             material);
}

/// A window frame: the panel keeps its border, and what was inside goes.
void frame(Shape& shape, Index panel, const Box2& window, Index material, Index inside) {
  shape.raise(panel, patch(shape.ring(panel), window.low, window.high), material);
  shape.set_material(panel, inside);
}

}  // namespace

Shape packaging_box() {
  Shape shape;
  const Index card = shape.material("card", {0.78, 0.62, 0.43});
  const Index flaps = shape.material("flaps", {0.86, 0.72, 0.54});
  const Index label = shape.material("label", {0.96, 0.95, 0.92});
  constexpr double w = 60, d = 40, h = 42;  // half width, half depth, height
  const Vec3 a{-w, -d, 0}, b{w, -d, 0}, c{w, d, 0}, e{-w, d, 0};
  const Vec3 up{0, 0, h};
  shape.face({a, e, c, b}, card);
  const Index front = shape.face({a, b, b + up, a + up}, card);
  const Index right = shape.face({b, c, c + up, b + up}, card);
  shape.face({c, e, e + up, c + up}, card);
  const Index left = shape.face({e, a, a + up, e + up}, card);
  frame(shape, front, {{0.2, 0.25}, {0.8, 0.75}}, card, label);
  frame(shape, right, {{0.3, 0.3}, {0.7, 0.7}}, card, label);
  frame(shape, left, {{0.3, 0.3}, {0.7, 0.7}}, card, label);

  const auto leaning = [](Vec3 outward, double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return std::cos(angle) * outward + Vec3{0, 0, std::sin(angle)};
  };
  // Dust flaps lean outwards, left and right, and in front.
  add(shape, {b + up, c + up, leaning({1, 0, 0}, 35), 34, 5, 9}, flaps);
  add(shape, {e + up, a + up, leaning({-1, 0, 0}, 35), 34, 5, 9}, flaps);
  add(shape, {a + up, b + up, leaning({0, -1, 0}, 60), 18, 8, 7}, flaps);
  // The lid stands open behind, the sides of the lid and its tuck are bent towards the box.
  const Vec3 lid_out = leaning({0, 1, 0}, 62);
  const Vec3 lid_a = c + up, lid_b = e + up;
  const Vec3 far_a = lid_a + 2 * d * lid_out, far_b = lid_b + 2 * d * lid_out;
  const Index lid = shape.face({lid_a, lid_b, far_b, far_a}, card);
  frame(shape, lid, {{0.15, 0.2}, {0.85, 0.8}}, card, label);
  const Vec3 inward = normalized(cross({1, 0, 0}, lid_out));  // what the box sees of its lid
  add(shape, {far_a, far_b, normalized(lid_out + 1.2 * inward), 26, 6, 10}, flaps);
  add(shape, {far_b, lid_b, normalized(Vec3{-1, 0, 0} + 1.2 * inward), 22, 8, 8}, flaps);
  add(shape, {lid_a, far_a, normalized(Vec3{1, 0, 0} + 1.2 * inward), 22, 8, 8}, flaps);
  shape.finish();
  return shape;
}

std::span<const Sample> all() {
  static constexpr std::array samples = {Sample{"whale.obj", whale},
                                         Sample{"fish.obj", fish},
                                         Sample{"dinosaur.obj", dinosaur},
                                         Sample{"fox_head.obj", fox_head},
                                         Sample{"penguin.obj", penguin},
                                         Sample{"house.obj", house},
                                         Sample{"lighthouse.obj", lighthouse},
                                         Sample{"rocket.obj", rocket},
                                         Sample{"mug.obj", mug},
                                         Sample{"vase.ply", vase},
                                         Sample{"chess_rook.obj", chess_rook},
                                         Sample{"torus.off", torus},
                                         Sample{"heart.obj", heart},
                                         Sample{"gem.stl", gem},
                                         Sample{"star.obj", star},
                                         Sample{"packaging_box.obj", packaging_box, false}};
  return samples;
}

}  // namespace ridgecraft::samples
