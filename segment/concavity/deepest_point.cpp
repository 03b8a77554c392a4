// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/deepest_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/context.hpp"

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

/// Greatest dot(c, x) with all rows held. The first 2 d rows bound the variables.
bool maximise(std::span<const Row> rows, const Numbers& c, std::size_t d, Numbers& x) {
  if (d == 1) {
    double low = -INFINITY;
    double high = INFINITY;
    for (const Row& row : rows) {
      if (row.a[0] > no_coefficient) {
        high = std::min(high, row.b / row.a[0]);
      } else if (row.a[0] < -no_coefficient) {
        low = std::max(low, row.b / row.a[0]);
      } else if (row.b < -slack) {
        return false;
      }
    }
    if (low > high + slack) {
      return false;
    }
    x[0] = c[0] > 0.0 ? high : low;
    return true;
  }
  for (std::size_t i = 0; i < d; ++i) {
    // Rows 2 i and 2 i + 1 say x_i <= b and -x_i <= b.
    x[i] = c[i] > 0.0 ? rows[2 * i].b : -rows[2 * i + 1].b;
  }
  std::vector<Row> less;
  for (std::size_t n = 2 * d; n < rows.size(); ++n) {
    const Row& row = rows[n];
    if (dot_of(row.a, x, d) <= row.b + slack) {
      continue;
    }
    std::size_t k = 0;
    for (std::size_t i = 1; i < d; ++i) {
      k = std::abs(row.a[i]) > std::abs(row.a[k]) ? i : k;
    }
    if (std::abs(row.a[k]) < no_coefficient) {
      return false;
    }
    // The optimum lies on this row. Bounds of the other variables come first, as rows 2 i and 2 i + 1.
    less.clear();
    for (std::size_t i = 0; i < d; ++i) {
      if (i != k) {
        less.push_back(substituted(rows[2 * i], row, k, d));
        less.push_back(substituted(rows[2 * i + 1], row, k, d));
      }
    }
    less.push_back(substituted(rows[2 * k], row, k, d));
    less.push_back(substituted(rows[2 * k + 1], row, k, d));
    for (std::size_t m = 2 * d; m < n; ++m) {
      less.push_back(substituted(rows[m], row, k, d));
    }
    const Row reduced_goal = substituted({c, 0.0}, row, k, d);
    Numbers y{};
    if (!maximise(less, reduced_goal.a, d - 1, y)) {
      return false;
    }
    for (std::size_t i = 0, j = 0; i < d; ++i) {
      if (i != k) {
        x[i] = y[j++];
      }
    }
    double rest = row.b;
    for (std::size_t i = 0; i < d; ++i) {
      rest -= i != k ? row.a[i] * x[i] : 0.0;
    }
    x[k] = rest / row.a[k];
  }
  return true;
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
  // Any order is right; a shuffled one is fast.
  Random random(1);
  for (std::size_t i = rows.size(); i > 2 * most_variables + 1; --i) {
    const std::size_t j =
        2 * most_variables + random.below(static_cast<std::uint32_t>(i - 2 * most_variables));
    std::swap(rows[i - 1], rows[j]);
  }
  Numbers x{};
  if (!maximise(rows, {0.0, 0.0, 0.0, 1.0}, most_variables, x)) {
    return std::nullopt;
  }
  return DeepestPoint{{x[0], x[1], x[2]}, x[3]};
}

}  // namespace ridgecraft::segment
