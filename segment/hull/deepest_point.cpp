// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/hull/deepest_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/context.hpp"
#include "base/random.hpp"

namespace ridgecraft::segment {
namespace {

constexpr std::size_t most_variables = 4;
using Numbers = std::array<double, most_variables>;

/// dot(a, x) <= b
struct Row {
  Numbers a{};
  double b = 0.0;
};

/// By how much a constraint may be broken: rounding of unit numbers after four substitutions.
constexpr double slack = 1e-12;
/// Coefficients below this are none: the constraint doesn't bind the variable.
constexpr double no_coefficient = 1e-13;

double dot_of(const Numbers& a, const Numbers& x, std::size_t d) {
  double sum = 0.0;
  for (std::size_t i = 0; i < d; ++i) {
    sum += a[i] * x[i];
  }
  return sum;
}

/// Removes variable k by way of a row that holds with equality.
Row substituted(const Row& row, const Row& equal, std::size_t k, std::size_t d) {
  Row out;
  const double factor = row.a[k] / equal.a[k];
  for (std::size_t i = 0, j = 0; i < d; ++i) {
    if (i != k) {
      out.a[j++] = row.a[i] - factor * equal.a[i];
    }
  }
  out.b = row.b - factor * equal.b;
  return out;
}

/// Greatest c x with all rows held, for a single variable; none when nothing holds them all.
std::optional<double> maximise_one(std::span<const Row> rows, double c) {
  double low = -INFINITY;
  double high = INFINITY;
  for (const Row& row : rows) {
    if (row.a[0] > no_coefficient) {
      high = std::min(high, row.b / row.a[0]);
    } else if (row.a[0] < -no_coefficient) {
      low = std::max(low, row.b / row.a[0]);
    } else if (row.b < -slack) {
      return std::nullopt;
    }
  }
  if (low > high + slack) {
    return std::nullopt;
  }
  return c > 0.0 ? high : low;
}

/// The rows as they are where `equal` holds with equality, without variable k. Bounds of the other variables
/// come first, two each.
void restrict_to(std::span<const Row> rows, const Row& equal, std::size_t k, std::size_t d,
                 std::vector<Row>& less) {
  less.clear();
  const auto take = [&](std::size_t n) { less.push_back(substituted(rows[n], equal, k, d)); };
  for (std::size_t i = 0; i < d; ++i) {
    if (i != k) {
      take(2 * i);
      take(2 * i + 1);
    }
  }
  take(2 * k);
  take(2 * k + 1);
  for (std::size_t n = 2 * d; n < rows.size(); ++n) {
    take(n);
  }
}

/// The variable whose coefficient is greatest, or none of d where all are too small.
std::size_t greatest_coefficient(const Row& row, std::size_t d) {
  std::size_t k = 0;
  for (std::size_t i = 1; i < d; ++i) {
    k = std::abs(row.a[i]) > std::abs(row.a[k]) ? i : k;
  }
  return std::abs(row.a[k]) < no_coefficient ? d : k;
}

/// Puts the variable k that was substituted back among the d - 1 others.
Numbers with_substituted(const Numbers& others, const Row& equal, std::size_t k, std::size_t d) {
  Numbers x{};
  for (std::size_t i = 0, j = 0; i < d; ++i) {
    if (i != k) {
      x[i] = others[j++];
    }
  }
  double rest = equal.b;
  for (std::size_t i = 0; i < d; ++i) {
    rest -= i != k ? equal.a[i] * x[i] : 0.0;
  }
  x[k] = rest / equal.a[k];
  return x;
}

/// Where dot(c, x) is greatest with all rows held; none when nothing holds them all. The first 2 d rows bound
/// the variables: rows 2 i and 2 i + 1 say x_i <= b and -x_i <= b.
std::optional<Numbers> maximise(std::span<const Row> rows, const Numbers& c, std::size_t d) {
  Numbers x{};
  if (d == 1) {
    const std::optional<double> most = maximise_one(rows, c[0]);
    x[0] = most.value_or(0.0);
    return most ? std::optional(x) : std::nullopt;
  }
  for (std::size_t i = 0; i < d; ++i) {
    x[i] = c[i] > 0.0 ? rows[2 * i].b : -rows[2 * i + 1].b;
  }
  std::vector<Row> less;
  for (std::size_t n = 2 * d; n < rows.size(); ++n) {
    const Row& row = rows[n];
    if (dot_of(row.a, x, d) <= row.b + slack) {
      continue;
    }
    // The optimum with this row lies on it.
    const std::size_t k = greatest_coefficient(row, d);
    if (k == d) {
      return std::nullopt;
    }
    restrict_to(rows.first(n), row, k, d, less);
    const auto others = maximise(less, substituted({c, 0.0}, row, k, d).a, d - 1);
    if (!others) {
      return std::nullopt;
    }
    x = with_substituted(*others, row, k, d);
  }
  return x;
}

}  // namespace

std::optional<DeepestPoint> deepest_point(std::span<const HalfSpace> half_spaces) {
  std::vector<Row> rows;
  rows.reserve(half_spaces.size() + 2 * most_variables);
  for (std::size_t i = 0; i < most_variables; ++i) {
    Row upper;
    Row lower;
    upper.a[i] = 1.0;
    lower.a[i] = -1.0;
    upper.b = 2.0;
    lower.b = i + 1 == most_variables ? 0.0 : 2.0;  // the depth isn't negative
    rows.push_back(upper);
    rows.push_back(lower);
  }
  for (const HalfSpace& h : half_spaces) {
    rows.push_back({{h.normal.x, h.normal.y, h.normal.z, 1.0}, h.offset});
  }
  // Any order gives the same answer up to rounding; a shuffled one is expected to be fast. A fixed shuffle,
  // as good as any, so that the function depends on the half spaces alone and no seed changes a promise.
  Random random(1);
  for (std::size_t i = rows.size(); i > 2 * most_variables + 1; --i) {
    const std::size_t j =
        2 * most_variables + random.below(static_cast<std::uint32_t>(i - 2 * most_variables));
    std::swap(rows[i - 1], rows[j]);
  }
  const auto x = maximise(rows, {0.0, 0.0, 0.0, 1.0}, most_variables);
  if (!x) {
    return std::nullopt;
  }
  return DeepestPoint{{(*x)[0], (*x)[1], (*x)[2]}, (*x)[3]};
}

}  // namespace ridgecraft::segment
