// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/hues.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "export/page/neighbours.hpp"

namespace ridgecraft::paper {
namespace {

/// Light enough for dark lines and words, and told apart by those who see red and green alike by their
/// lightness. Neighbours in the list are far apart.
constexpr std::array<Color, 12> hues{{{0x7f, 0xb5, 0xde},
                                      {0xf2, 0xb3, 0x5c},
                                      {0x8f, 0xc9, 0x7c},
                                      {0xe9, 0x8a, 0x7c},
                                      {0xb7, 0x9b, 0xd8},
                                      {0xf3, 0xdc, 0x73},
                                      {0x63, 0xc1, 0xb5},
                                      {0xea, 0xa0, 0xc6},
                                      {0xc6, 0xa9, 0x82},
                                      {0x8b, 0x9c, 0xe0},
                                      {0xc3, 0xd4, 0x68},
                                      {0xa9, 0xb9, 0xbf}}};

std::uint8_t channel(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

}  // namespace

IdVector<PieceId, Color> piece_hues(const mesh::Surface& surface, const unfold::Nets& nets) {
  const auto neighbours = find_neighbours(surface, nets);
  IdVector<PieceId, std::size_t> hue(nets.pieces.size(), hues.size());
  std::array<std::size_t, hues.size()> used{};
  IdVector<PieceId, Color> colors(nets.pieces.size());
  for (const PieceId piece : ids<PieceId>(nets.pieces.size())) {
    std::array<bool, hues.size()> beside{};
    for (const Neighbour& neighbour : neighbours[piece]) {
      if (hue[neighbour.piece] < hues.size()) {
        beside[hue[neighbour.piece]] = true;
      }
    }
    std::size_t best = 0;
    for (std::size_t h = 1; h < hues.size(); ++h) {
      if (std::pair(beside[h], used[h]) < std::pair(beside[best], used[best])) {
        best = h;
      }
    }
    hue[piece] = best;
    ++used[best];
    colors[piece] = hues[best];
  }
  return colors;
}

FaceLight::FaceLight(Vec3 normal, const Camera& camera, double depth) {
  const Vec3 light = normalized(0.75 * camera.toward + 0.6 * camera.up - 0.45 * camera.right);
  const double lit = std::max(0.0, dot(normal, light));
  share_ = 1.0 - depth + depth * lit;
  // The brightest faces are a little lighter than the hue.
  lighter_ = 0.35 * depth * lit * lit;
}

Color FaceLight::on(Color hue) const {
  const Color lighter = mixed(hue, {0xff, 0xff, 0xff}, lighter_);
  return {channel(share_ * lighter.red), channel(share_ * lighter.green), channel(share_ * lighter.blue)};
}

Color shaded(Color hue, Vec3 normal, const Camera& camera, double depth) {
  return FaceLight(normal, camera, depth).on(hue);
}

Color mixed(Color a, Color b, double share) {
  const auto mix = [share](std::uint8_t x, std::uint8_t y) { return channel((1.0 - share) * x + share * y); };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

}  // namespace ridgecraft::paper
