// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/net/equal_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/geometry.hpp"

namespace ridgecraft::unfold {
namespace {

/// Flatter folds aren't compared, radians: where the triangles of a flat region differ they come and go.
constexpr double flat_fold = 0.5 * std::numbers::pi / 180.0;
/// Folds of equal pieces differ by no more, radians.
constexpr double equal_folds = 0.2 * std::numbers::pi / 180.0;
/// More ways to lay a piece on another aren't tried.
constexpr std::size_t most_tries = 400;

enum class LineKind : std::size_t { outline, fold, tab };

struct DrawnLine {
  Vec2 from, to;
  double fold = 0.0;  ///< angle, radians, where it is a fold
};

/// All lines of a piece by their kinds.
struct Lines {
  std::array<std::vector<DrawnLine>, 3> of;
  double length = 0.0;  ///< of the outline

  [[nodiscard]] std::vector<DrawnLine>& operator[](LineKind kind) {
    return of[static_cast<std::size_t>(kind)];
  }
  [[nodiscard]] const std::vector<DrawnLine>& operator[](LineKind kind) const {
    return of[static_cast<std::size_t>(kind)];
  }
  [[nodiscard]] std::array<std::size_t, 3> counts() const {
    return {of[0].size(), of[1].size(), of[2].size()};
  }
};

std::vector<Lines> lines_of(const mesh::Surface& surface, const Nets& nets) {
  std::vector<Lines> result(nets.pieces.size());
  for (const FaceId f : ids<FaceId>(nets.piece.size())) {
    if (!nets.piece[f].valid() || nets.piece[f].value() >= result.size()) {
      continue;  // of nets of a few pieces, as searches make them
    }
    Lines& lines = result[nets.piece[f].value()];
    for (unsigned k = 0; k < 3; ++k) {
      const CornerId side = mesh::corner(f, k);
      const EdgeId e = surface.edge(side);
      const Vec2 from = nets.flat[f][k];
      const Vec2 to = nets.flat[f][(k + 1) % 3];
      if (nets.use[e] != EdgeUse::fold) {
        lines[LineKind::outline].push_back({from, to});
        lines.length += length(to - from);
      } else if (side < surface.twin(side) && std::abs(surface.fold_angle(e)) >= flat_fold) {
        lines[LineKind::fold].push_back({from, to, surface.fold_angle(e)});
      }
    }
  }
  for (const Tab& tab : nets.tabs) {
    const PieceId own = nets.piece[mesh::face_of(tab.side)];
    Lines& lines = result[own.value()];
    for (std::size_t i = 0; i < tab.polygon.size(); ++i) {
      lines[LineKind::tab].push_back({tab.polygon[i], tab.polygon[(i + 1) % tab.polygon.size()]});
    }
    if (tab.slit) {
      const PieceId target = nets.piece[mesh::face_of(surface.twin(tab.side))];
      result[target.value()][LineKind::tab].push_back({(*tab.slit)[0], (*tab.slit)[1]});
    }
  }
  for (Lines& lines : result) {
    for (std::vector<DrawnLine>& some : lines.of) {
      std::sort(some.begin(), some.end(),
                [](const DrawnLine& a, const DrawnLine& b) { return a.from.x + a.to.x < b.from.x + b.to.x; });
    }
  }
  return result;
}

/// Turns over where it has to, then moves.
struct Laying {
  bool mirrored = false;
  Rigid motion;

  [[nodiscard]] Vec2 operator()(Vec2 p) const { return motion(mirrored ? Vec2{-p.x, p.y} : p); }
};

/// Takes one directed line to another: their middles, and their directions as nearly as they go.
Laying laying(DrawnLine from, const DrawnLine& to, bool mirrored) {
  Laying result{mirrored, {}};
  if (mirrored) {
    from = {{-from.to.x, from.to.y}, {-from.from.x, from.from.y}};
  }
  const Vec2 a = from.to - from.from;
  const Vec2 b = to.to - to.from;
  const double lengths = length(a) * length(b);
  result.motion.cosine = dot(a, b) / lengths;
  result.motion.sine = cross(a, b) / lengths;
  result.motion.shift = 0.5 * (to.from + to.to) - result.motion.turn(0.5 * (from.from + from.to));
  return result;
}

bool lie_together(Vec2 p, Vec2 q) {
  return length(p - q) <= equal_pieces_mm;
}

/// Whether each line lies on one of the other's, both ways round. The lines are ascending by their middles.
bool all_lie_on(const std::vector<DrawnLine>& lines, const std::vector<DrawnLine>& others,
                const Laying& laid) {
  return std::all_of(lines.begin(), lines.end(), [&](const DrawnLine& line) {
    const Vec2 from = laid(line.from);
    const Vec2 to = laid(line.to);
    const double middle = from.x + to.x;
    const auto first =
        std::lower_bound(others.begin(), others.end(), middle - 2.0 * equal_pieces_mm,
                         [](const DrawnLine& other, double x) { return other.from.x + other.to.x < x; });
    for (auto at = first; at != others.end() && at->from.x + at->to.x <= middle + 2.0 * equal_pieces_mm;
         ++at) {
      if (std::abs(at->fold - line.fold) <= equal_folds &&
          ((lie_together(from, at->from) && lie_together(to, at->to)) ||
           (lie_together(from, at->to) && lie_together(to, at->from)))) {
        return true;
      }
    }
    return false;
  });
}

bool lies_on(const Lines& piece, const Lines& other, const Laying& laid) {
  for (std::size_t kind = 0; kind < piece.of.size(); ++kind) {
    if (!all_lie_on(piece.of[kind], other.of[kind], laid)) {
      return false;
    }
  }
  return true;
}

/// How one piece lies on another, as it is or mirrored; nothing where it doesn't.
std::optional<Laying> laid_on(const Lines& piece, const Lines& other) {
  const std::vector<DrawnLine>& outline = piece[LineKind::outline];
  if (piece.counts() != other.counts() || outline.empty() ||
      std::abs(piece.length - other.length) > equal_pieces_mm * static_cast<double>(outline.size())) {
    return std::nullopt;
  }
  const auto size = [](const DrawnLine& line) { return length(line.to - line.from); };
  const DrawnLine& longest = *std::max_element(
      outline.begin(), outline.end(), [&](const auto& a, const auto& b) { return size(a) < size(b); });
  for (const bool mirrored : {false, true}) {
    std::size_t tries = 0;
    for (const DrawnLine& line : other[LineKind::outline]) {
      if (std::abs(size(line) - size(longest)) > 2.0 * equal_pieces_mm || ++tries > most_tries) {
        continue;
      }
      const Laying laid = laying(longest, line, mirrored);
      if (lies_on(piece, other, laid)) {
        return laid;
      }
    }
  }
  return std::nullopt;
}

/// A piece's lines without its tabs.
Lines without_tabs(const Lines& all) {
  Lines lines = all;
  lines[LineKind::tab].clear();
  return lines;
}

using Kind = std::vector<EqualPiece>;

/// All pieces by kinds, by their first ones: `lines[i]` are those of piece i. Kinds of one piece, too.
std::vector<Kind> kinds_of(const std::vector<Lines>& lines) {
  struct Known {
    std::size_t kind, first;
  };
  std::vector<Kind> kinds;
  std::map<std::array<std::size_t, 3>, std::vector<Known>> by_counts;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::vector<Known>& alike = by_counts[lines[i].counts()];
    const bool is_known = std::any_of(alike.begin(), alike.end(), [&](const Known& known) {
      const std::optional<Laying> laid = laid_on(lines[known.first], lines[i]);
      if (laid) {
        kinds[known.kind].push_back({PieceId(i), laid->mirrored, false, laid->motion});
      }
      return laid.has_value();
    });
    if (!is_known) {
      alike.push_back({kinds.size(), i});
      kinds.push_back({{PieceId(i)}});
    }
  }
  return kinds;
}

/// Says of each piece of a kind whether it is equal to the first with all of its tabs, and if so, how it
/// lies.
void compare_tabs(const std::vector<Lines>& lines, Kind& kind) {
  const Lines& first = lines[kind.front().piece.value()];
  for (std::size_t i = 1; i < kind.size(); ++i) {
    const std::optional<Laying> laid = laid_on(first, lines[kind[i].piece.value()]);
    kind[i].other_tabs = !laid;
    if (laid) {
      kind[i].mirrored = laid->mirrored;
      kind[i].motion = laid->motion;
    }
  }
}

}  // namespace

std::vector<std::vector<EqualPiece>> find_equal_pieces(const mesh::Surface& surface, const Nets& nets) {
  const std::vector<Lines> lines = lines_of(surface, nets);
  std::vector<Lines> bare;
  std::transform(lines.begin(), lines.end(), std::back_inserter(bare), without_tabs);
  std::vector<Kind> kinds = kinds_of(bare);
  std::erase_if(kinds, [](const Kind& kind) { return kind.size() < 2; });
  for (Kind& kind : kinds) {
    compare_tabs(lines, kind);
  }
  return kinds;
}

}  // namespace ridgecraft::unfold
