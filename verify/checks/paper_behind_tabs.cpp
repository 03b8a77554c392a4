// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 5: no tab hangs on a strip or a point of paper. From places along its base one must get far enough
// straight into the piece, over folds, before a cut is reached.
#include <cmath>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

/// Places that are looked at on each edge, and sides that one look may cross.
constexpr int places = 15;
constexpr int most_crossed = 200;
/// A place where two faces meet belongs to both: corners that a ray passes within so many mm are crossed.
constexpr double corner_mm = 1e-6;

/// Where a ray leaves the face that it entered over a side.
struct Exit {
  double at = HUGE_VAL;  ///< mm from the start of the ray
  Index side = none;
};

class PaperCheck {
 public:
  explicit PaperCheck(const Case& given) : file_(given.file), relations_(given.relations) {}

  /// Share of a tab's base with too little paper behind it.
  [[nodiscard]] double thin_share(const Tab& tab) const {
    double thin = 0.0;
    double all = 0.0;
    for (const Index e : tab.edges) {
      const Index side = relations_.sides_of(e).front();
      const double side_length = length(point(file_.faces.head(side)) - point(file_.faces.tail(side)));
      int few = 0;
      for (int i = 0; i < places; ++i) {
        few += paper(side, (static_cast<double>(i) + 0.5) / places) < least_paper_mm ? 1 : 0;
      }
      thin += side_length * static_cast<double>(few) / places;
      all += side_length;
    }
    return all > 0.0 ? thin / all : 0.0;
  }

 private:
  [[nodiscard]] Vec2 point(Index vertex) const { return file_.points[vertex]; }

  [[nodiscard]] Exit exit_of(Index entered, Vec2 start, Vec2 inward, double from) const {
    Exit exit;
    const Index face = file_.faces.face(entered);
    for (Index s = file_.faces.first(face); s < file_.faces.first(face) + file_.faces.size(face); ++s) {
      const Vec2 a = point(file_.faces.tail(s)) - start;
      const Vec2 b = point(file_.faces.head(s)) - start;
      // Beside the ray: to its right where a side that leads out begins, to its left where it ends.
      const double begins = cross(inward, a);
      const double ends = cross(inward, b);
      if (s == entered || begins > corner_mm || ends < -corner_mm || ends - begins <= 0.0) {
        continue;
      }
      const double at = (dot(a, inward) * ends - dot(b, inward) * begins) / (ends - begins);
      if (at >= from - corner_mm && at < exit.at) {
        exit = {at, s};
      }
    }
    return exit;
  }

  /// Paper straight behind a place on a side, mm, as far as it is of interest.
  [[nodiscard]] double paper(Index side, double share) const {
    const Vec2 from = point(file_.faces.tail(side));
    const Vec2 along = point(file_.faces.head(side)) - from;
    const double size = length(along);
    if (!(size > 0.0)) {
      return 0.0;
    }
    const Vec2 start = from + share * along;
    const Vec2 inward = perpendicular(along) / size;
    Index entered = side;
    double at = 0.0;
    for (int crossed = 0; crossed < most_crossed; ++crossed) {
      const Exit exit = exit_of(entered, start, inward, at);
      at = exit.at;
      if (exit.side == none || at >= least_paper_mm || relations_.fold_twin[exit.side] == none) {
        break;
      }
      entered = relations_.fold_twin[exit.side];
    }
    return at;
  }

  const File& file_;
  const Relations& relations_;
};

}  // namespace

void check_paper_behind_tabs(const Case& given, Findings& findings) {
  const PaperCheck check(given);
  for (Index t = 0; t < given.file.tabs.size(); ++t) {
    given.context.check();
    const Tab& tab = given.file.tabs[t];
    if (check.thin_share(tab) > 0.5 + 1.0 / places) {
      findings.add(Promise::joins, {{"tab", t}, {"edge", tab.edge}}, [&] {
        return fmt::format("{} hangs on less than 2 mm of paper", tab_name(given.file, t));
      });
    }
  }
}

}  // namespace ridgecraft::verify
