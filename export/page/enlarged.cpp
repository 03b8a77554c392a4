// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/enlarged.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "export/page/glue_spots.hpp"
#include "export/page/number_placer.hpp"
#include "export/page/text_table.hpp"

namespace ridgecraft::paper {
namespace {

/// How much larger, the first that has room for all that is wanted.
constexpr std::array<double, 6> scales{2.0, 2.5, 3.0, 4.0, 6.0, 8.0};
/// What is seen around each edge, mm on the piece: enough to find it there.
constexpr double around_mm = 3.0;
/// A picture shows no less, mm on paper; the second where there is no room for that.
constexpr std::array<double, 2> least_mm{30.0, 19.0};
/// Parts of a piece nearer to each other than their surroundings are one picture, as long as it is no larger,
/// mm on the piece.
constexpr double most_part_mm = 45.0;
constexpr double inset_mm = 1.0;      ///< of texts, from the frame
constexpr double words_gap_mm = 1.0;  ///< between the frame and the words above it
constexpr double most_rows_of_words = 4.0;

/// What has no place on the piece: its numbers and names of what is glued on, by their places in the piece.
struct Lost {
  std::vector<std::size_t> seams, spots;
  Box2 box;  ///< on the page
};

void add(Box2& box, const Box2& other) {
  box.add(other.low);
  box.add(other.high);
}

Box2 grown(Box2 box, double by) {
  return {box.low - Vec2{by, by}, box.high + Vec2{by, by}};
}

bool share_a_place(const Box2& a, const Box2& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/// One for each number and name without a place; then those near each other together.
std::vector<Lost> lost_parts(const PieceDrawing& piece, Vec2 most) {
  std::vector<Lost> parts;
  for (std::size_t i = 0; i < piece.seams.size(); ++i) {
    const Seam& seam = piece.seams[i];
    if (seam.told == NumberAt::list) {
      Box2 box;
      box.add(seam.edge.a);
      box.add(seam.edge.b);
      for (const Vec2 p : seam.tab) {
        box.add(p);
      }
      parts.push_back({{i}, {}, grown(box, around_mm)});
    }
  }
  for (std::size_t i = 0; i < piece.spots.size(); ++i) {
    if (!piece.spots[i].named) {
      Box2 box;
      for (const std::vector<Vec2>& outline : piece.spots[i].outlines) {
        for (const Vec2 p : outline) {
          box.add(p);
        }
      }
      parts.push_back({{}, {i}, grown(box, around_mm)});
    }
  }
  const Vec2 largest{std::min(most_part_mm, most.x / scales[1]), std::min(most_part_mm, most.y / scales[1])};
  for (bool changed = true; std::exchange(changed, false);) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t k = parts.size(); k-- > i + 1;) {
        Box2 both = parts[i].box;
        add(both, parts[k].box);
        if (share_a_place(parts[i].box, parts[k].box) && both.size().x <= largest.x &&
            both.size().y <= largest.y) {
          parts[i].box = both;
          parts[i].seams.insert(parts[i].seams.end(), parts[k].seams.begin(), parts[k].seams.end());
          parts[i].spots.insert(parts[i].spots.end(), parts[k].spots.begin(), parts[k].spots.end());
          parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(k));
          changed = true;
        }
      }
    }
  }
  return parts;
}

bool within(Vec2 p, const Box2& box) {
  return p.x >= box.low.x && p.y >= box.low.y && p.x <= box.high.x && p.y <= box.high.y;
}

/// What of a line lies within the box.
std::optional<Segment2> within(const Segment2& line, const Box2& box) {
  const Vec2 d = line.b - line.a;
  double from = 0.0;
  double to = 1.0;
  const auto cut = [&](double along, double low, double high) {
    if (along == 0.0) {
      return low <= 0.0 && high >= 0.0;
    }
    from = std::max(from, std::min(low / along, high / along));
    to = std::min(to, std::max(low / along, high / along));
    return from < to;
  };
  if (!cut(d.x, box.low.x - line.a.x, box.high.x - line.a.x) ||
      !cut(d.y, box.low.y - line.a.y, box.high.y - line.a.y)) {
    return std::nullopt;
  }
  return Segment2{line.a + from * d, line.a + to * d};
}

/// What of a polygon lies within the box (Sutherland and Hodgman 1974).
std::vector<Vec2> within(std::vector<Vec2> polygon, const Box2& box) {
  // Keeps what lies on the left of a line through `at` along `along`.
  const auto keep = [&](Vec2 at, Vec2 along) {
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 p = polygon[i];
      const Vec2 q = polygon[(i + 1) % polygon.size()];
      const double here = cross(along, p - at);
      const double there = cross(along, q - at);
      if (here >= 0.0) {
        kept.push_back(p);
      }
      if ((here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0)) {
        kept.push_back(p + here / (here - there) * (q - p));
      }
    }
    polygon = std::move(kept);
  };
  keep(box.low, {1.0, 0.0});
  keep(box.high, {0.0, 1.0});
  keep(box.high, {-1.0, 0.0});
  keep(box.low, {0.0, -1.0});
  return polygon;
}

/// One part of a piece at one scale.
class Picture {
 public:
  Picture(const PieceDrawing& piece, const Lost& lost, double scale, double least, Vec2 most)
      : piece_(piece), lost_(lost), scale_(scale) {
    // The window: around what is lost, no less than is asked for and no more than there may be.
    const Vec2 middle = 0.5 * (lost.box.low + lost.box.high);
    const auto half = [&](double wanted, double room) {
      return 0.5 * std::min(std::max(wanted, least / scale), room / scale);
    };
    const Vec2 reach{half(lost.box.size().x, most.x), half(lost.box.size().y, most.y)};
    window_ = {middle - reach, middle + reach};
    part_.name = piece.name;
    add_lines();
    add_seams();
  }

  /// How many of those that are lost find their place.
  std::size_t place(const Style& style) {
    const Vec2 size = scale_ * window_.size();
    const Box2 area{{inset_mm, inset_mm}, size - Vec2{inset_mm, inset_mm}};
    NumberPlacer placer(size, area, style);
    placer.add_lines(part_);
    for (const std::size_t spot : lost_.spots) {
      GlueSpot larger = piece_.spots[spot];
      for (std::vector<Vec2>& outline : larger.outlines) {
        for (Vec2& p : outline) {
          p = on_picture(p);
        }
      }
      part_.spots.push_back(std::move(larger));
    }
    place_spot_names(part_, area, placer.obstacles());
    // What is lost first, then what is seen around it.
    for (std::size_t i = 0; i < part_.seams.size(); ++i) {
      Seam& seam = part_.seams[i];
      Wanted wanted{&part_, &seam, false};
      const bool placed = (!seam.tab.empty() && placer.place_on_tab(part_, seam)) ||
                          placer.place_near(wanted) || placer.place_inside(wanted) ||
                          placer.place_with_leader(wanted, Beside::inside) ||
                          placer.place_with_leader(wanted, Beside::outside);
      seam.told = placed ? NumberAt::enlarged : NumberAt::list;
    }
    placer.name_partners();
    return placed();
  }

  /// How many of those that are lost have their place.
  [[nodiscard]] std::size_t placed() const {
    const auto end = part_.seams.begin() + static_cast<std::ptrdiff_t>(lost_.seams.size());
    return static_cast<std::size_t>(
        std::count_if(part_.seams.begin(), end, [](const Seam& s) { return s.told == NumberAt::enlarged; }) +
        std::count_if(part_.spots.begin(), part_.spots.end(), [](const GlueSpot& s) { return s.named; }));
  }

  /// Tells those that have their place.
  void tell(PieceDrawing& piece) const {
    for (std::size_t i = 0; i < lost_.seams.size(); ++i) {
      piece.seams[lost_.seams[i]].told = part_.seams[i].told;
    }
    for (std::size_t i = 0; i < lost_.spots.size(); ++i) {
      piece.spots[lost_.spots[i]].named = part_.spots[i].named;
    }
  }

  /// With a frame.
  Enlarged framed() && {
    const Vec2 size = scale_ * window_.size();
    Enlarged result;
    result.marks.areas = std::move(part_.group.areas);
    for (Line& line : part_.group.lines) {
      line.like = line.layer == Layer::label || line.layer == Layer::glue ? line.layer : Layer::mark;
      line.layer = Layer::mark;
      result.marks.lines.push_back(std::move(line));
    }
    Line frame{Layer::mark, {{}, {size.x, 0.0}, size, {0.0, size.y}}, true, Fold::none};
    frame.like = Layer::label;
    result.marks.lines.push_back(std::move(frame));
    result.marks.texts = std::move(part_.group.texts);
    for (Text& text : result.marks.texts) {
      text.layer = Layer::mark;
    }
    result.size = size;
    result.words = fmt::format("part of {}, {:g} times as large", piece_.name, scale_);
    return result;
  }

 private:
  [[nodiscard]] Vec2 on_picture(Vec2 p) const { return scale_ * (p - window_.low); }

  void add_lines() {
    for (const Line& line : piece_.group.lines) {
      if (line.layer == Layer::label) {
        continue;  // leaders of numbers on the piece
      }
      Line part = line;
      part.closed = false;
      part.points.clear();
      const auto put = [&] {
        if (part.points.size() > 1) {
          part_.group.lines.push_back(part);
        }
        part.points.clear();
      };
      const std::size_t count = line.points.size() - (line.closed ? 0 : 1);
      for (std::size_t i = 0; i < count; ++i) {
        const auto inside =
            within(Segment2{line.points[i], line.points[(i + 1) % line.points.size()]}, window_);
        if (!inside) {
          put();
          continue;
        }
        const Vec2 from = on_picture(inside->a);
        if (part.points.empty() || length(from - part.points.back()) > 1e-9) {
          put();
          part.points.push_back(from);
        }
        part.points.push_back(on_picture(inside->b));
      }
      put();
    }
    for (const Area& area : piece_.group.areas) {
      std::vector<Vec2> outline = within(area.outline, window_);
      if (outline.size() > 2) {
        std::ranges::transform(outline, outline.begin(), [&](Vec2 p) { return on_picture(p); });
        part_.group.areas.push_back({Layer::mark, std::move(outline)});
      }
    }
  }

  void add_seams() {
    const auto add = [&](const Seam& seam, const Segment2& seen) {
      Seam larger = seam;
      larger.edge = {on_picture(seen.a), on_picture(seen.b)};
      // Leaders begin at tabs: only at those that are seen.
      if (!std::ranges::all_of(larger.tab, [&](Vec2 p) { return within(p, window_); })) {
        larger.tab.clear();
      }
      std::ranges::transform(larger.tab, larger.tab.begin(), [&](Vec2 p) { return on_picture(p); });
      part_.seams.push_back(std::move(larger));
    };
    for (const std::size_t seam : lost_.seams) {
      const Seam& own = piece_.seams[seam];
      add(own, within(own.edge, window_).value_or(own.edge));
    }
    for (std::size_t i = 0; i < piece_.seams.size(); ++i) {
      const auto seen = within(piece_.seams[i].edge, window_);
      if (seen && std::ranges::find(lost_.seams, i) == lost_.seams.end()) {
        add(piece_.seams[i], *seen);
      }
    }
  }

  const PieceDrawing& piece_;
  const Lost& lost_;
  double scale_;
  Box2 window_;
  PieceDrawing part_;
};

/// The picture at the first scale that has room for all that is lost, else at the one that has for most.
std::optional<Picture> best_picture(const PieceDrawing& piece, const Lost& lost, const Style& style,
                                    double least, Vec2 room) {
  const std::size_t wanted = lost.seams.size() + lost.spots.size();
  std::optional<Picture> best;
  std::size_t most_placed = 0;
  for (const double scale : scales) {
    const Vec2 needed = scale * lost.box.size();
    if (best && (needed.x > room.x || needed.y > room.y)) {
      break;
    }
    Picture picture(piece, lost, scale, least, room);
    const std::size_t placed = picture.place(style);
    if (placed > most_placed) {
      best.emplace(std::move(picture));
      most_placed = placed;
    }
    if (placed == wanted) {
      break;
    }
  }
  return best;
}

}  // namespace

std::vector<Enlarged> enlarged_parts(PieceDrawing& piece, const Style& style, Vec2 most,
                                     const Context& context) {
  std::vector<Enlarged> pictures;
  const Vec2 room{most.x, most.y - words_gap_mm - most_rows_of_words * table_row_height};
  if (context.out_of_grace() || room.x < least_mm.back() || room.y < least_mm.back()) {
    return pictures;
  }
  for (const Lost& lost : lost_parts(piece, room)) {
    std::optional<Picture> best = best_picture(piece, lost, style, least_mm.front(), room);
    if (!best) {
      continue;
    }
    std::optional<Picture> smaller = best_picture(piece, lost, style, least_mm.back(), room);
    best->tell(piece);
    const bool tells_as_much = smaller && smaller->placed() == best->placed();
    pictures.push_back(std::move(*best).framed());
    if (tells_as_much) {
      Enlarged other = std::move(*smaller).framed();
      if (other.size.x < pictures.back().size.x || other.size.y < pictures.back().size.y) {
        pictures.back().smaller.push_back(std::move(other));
      }
    }
  }
  return pictures;
}

Enlarged with_words(Enlarged picture) {
  std::vector<std::string> rows;
  append_wrapped(rows, picture.words, picture.size.x);
  const double height = static_cast<double>(rows.size()) * table_row_height;
  PageMarks words{table(rows), {}, {}};
  picture.size.y += words_gap_mm + height;
  picture.marks.add(std::move(words), {0.0, picture.size.y - (table_row_height - table_text_height)});
  return picture;
}

}  // namespace ridgecraft::paper
