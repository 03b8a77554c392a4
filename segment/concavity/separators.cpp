// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/separators.hpp"

#include <algorithm>
#include <vector>

#include "segment/concavity/residual_concavity.hpp"

namespace ridgecraft::segment {
namespace {

/// Residual concavities closer than this are equal: rounding of unit lengths.
constexpr double tie_tolerance = 1e-12;
/// The cap is measured along vertex normals, which jump where creases meet: a vertex beside the deepest one
/// with at least this share of its concavity may be the true bottom.
constexpr double near_tie = 0.95;
/// ... if it is deeper by this factor before the cap: one edge down a coarse slope, not noise on a smooth
/// one.
constexpr double clearly_deeper = 1.1;

/// Position 1..i where cutting chain[0..i] leaves least; ties go to the larger concavity.
std::size_t least_residual(std::span<const Vec2> chain, std::span<const double> prefix,
                           std::span<const double> concavity, std::size_t i) {
  std::vector<double> suffix;
  suffix_concavity(chain.first(i + 1), suffix);
  std::size_t best = 1;
  double least = std::max(prefix[1], suffix[1]);
  for (std::size_t k = 2; k <= i; ++k) {
    const double residual = std::max(prefix[k], suffix[k]);
    if (residual < least - tie_tolerance ||
        (residual <= least + tie_tolerance && concavity[k] > concavity[best])) {
      best = k;
      least = residual;
    }
  }
  return best;
}

/// The vertex of largest concavity, or the one beside it where that is nearly as deep and deeper before the
/// cap.
std::size_t deepest(std::span<const double> capped, std::span<const double> uncapped) {
  const auto top = static_cast<std::size_t>(std::max_element(capped.begin(), capped.end()) - capped.begin());
  std::size_t best = top;
  for (const std::size_t k : {top - 1, top + 1}) {
    if (k < capped.size() && capped[k] >= near_tie * capped[top] &&
        uncapped[k] > clearly_deeper * uncapped[best]) {
      best = k;
    }
  }
  return best;
}

/// Last position with prefix(1..i) below the tolerance, at least 1.
std::size_t last_shallow(std::span<const double> prefix, double tolerance) {
  std::size_t i = 1;
  while (i + 1 < prefix.size() && prefix[i + 1] < tolerance) {
    ++i;
  }
  return i;
}

}  // namespace

Separators find_separators(std::span<const Vec2> chain, std::span<const double> concavity,
                           std::span<const double> uncapped, double tolerance) {
  const std::size_t n = chain.size();
  std::vector<double> prefix;
  std::vector<double> suffix;
  prefix_concavity(chain, prefix);
  suffix_concavity(chain, suffix);
  double least = std::max(prefix[1], suffix[1]);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    least = std::min(least, std::max(prefix[k], suffix[k]));
  }
  Separators s;
  if (least < tolerance) {
    s.first = deepest(concavity, uncapped);
    s.last = s.first;
  } else {
    s.v_shaped = false;
    s.first = least_residual(chain, prefix, concavity, last_shallow(prefix, tolerance));
    // From the other end: everything mirrored.
    std::vector<Vec2> mirrored(chain.rbegin(), chain.rend());
    for (Vec2& p : mirrored) {
      p.x = chain.back().x - p.x;
    }
    const std::vector<double> mirrored_concavity(concavity.rbegin(), concavity.rend());
    std::reverse(suffix.begin(), suffix.end());
    s.last = n - 1 - least_residual(mirrored, suffix, mirrored_concavity, last_shallow(suffix, tolerance));
    if (s.last < s.first) {
      s.first = s.last = (s.first + s.last) / 2;
    }
  }
  s.first = std::clamp(s.first, std::size_t{1}, n - 2);
  s.last = std::clamp(s.last, std::size_t{1}, n - 2);
  return s;
}

}  // namespace ridgecraft::segment
