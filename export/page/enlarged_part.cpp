// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/enlarged_part.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/boxes.hpp"
#include "export/page/clip_to_box.hpp"
#include "export/page/glue_spots.hpp"
#include "export/page/number_placer.hpp"

namespace ridgecraft::paper {
namespace {

constexpr double inset_mm = 1.0;  ///< of texts, from the frame
/// Of an edge that is seen beside what is lost: with less of it nobody looks for its number, mm on paper.
constexpr double least_seen_mm = 2.0;
constexpr double same_point_mm = 1e-9;

}  // namespace

EnlargedPart::EnlargedPart(const PieceDrawing& piece, const Lost& lost, double scale, double least, Vec2 most)
    : piece_(piece), lost_(lost), scale_(scale) {
  const Vec2 middle = 0.5 * (lost.box.low + lost.box.high);
  const auto half = [&](double wanted, double room) {
    return 0.5 * std::min(std::max(wanted, least / scale), room / scale);
  };
  const Vec2 reach{half(lost.box.size().x, most.x), half(lost.box.size().y, most.y)};
  window_ = {middle - reach, middle + reach};
  part_.name = piece.name;
  add_lines();
  add_areas();
  add_seams();
}

std::size_t EnlargedPart::place(const Style& style) {
  const Vec2 size = scale_ * window_.size();
  const Box2 area = grown(Box2{{}, size}, -inset_mm);
  NumberPlacer placer(size, area, style);
  placer.add_lines(part_);
  for (const std::size_t spot : lost_.spots) {
    GlueSpot larger = piece_.spots[spot];
    for (std::vector<Vec2>& outline : larger.outlines) {
      std::ranges::transform(outline, outline.begin(), [&](Vec2 p) { return on_picture(p); });
    }
    part_.spots.push_back(std::move(larger));
  }
  place_spot_names(part_, area, placer.obstacles());
  // What is lost first, then what is seen around it.
  for (Seam& seam : part_.seams) {
    const Wanted wanted{&part_, &seam, false};
    const bool placed = (!seam.tab.empty() && placer.place_on_tab(part_, seam)) ||
                        placer.place_near(wanted) || placer.place_inside(wanted) ||
                        placer.place_with_leader(wanted, Beside::inside) ||
                        placer.place_with_leader(wanted, Beside::outside);
    seam.told = placed ? NumberAt::enlarged : NumberAt::list;
  }
  placer.name_partners();
  return placed();
}

std::size_t EnlargedPart::placed() const {
  const auto end = part_.seams.begin() + static_cast<std::ptrdiff_t>(lost_.seams.size());
  return static_cast<std::size_t>(
      std::count_if(part_.seams.begin(), end, [](const Seam& s) { return s.told == NumberAt::enlarged; }) +
      std::count_if(part_.spots.begin(), part_.spots.end(), [](const GlueSpot& s) { return s.named; }));
}

bool EnlargedPart::tells_as_much_as(const EnlargedPart& other) const {
  for (std::size_t i = 0; i < lost_.seams.size(); ++i) {
    if (other.part_.seams[i].told == NumberAt::enlarged && part_.seams[i].told != NumberAt::enlarged) {
      return false;
    }
  }
  for (std::size_t i = 0; i < lost_.spots.size(); ++i) {
    if (other.part_.spots[i].named && !part_.spots[i].named) {
      return false;
    }
  }
  return true;
}

void EnlargedPart::tell(PieceDrawing& piece) const {
  for (std::size_t i = 0; i < lost_.seams.size(); ++i) {
    piece.seams[lost_.seams[i]].told = part_.seams[i].told;
  }
  for (std::size_t i = 0; i < lost_.spots.size(); ++i) {
    piece.spots[lost_.spots[i]].named = part_.spots[i].named;
  }
}

Enlarged EnlargedPart::framed() && {
  const Vec2 size = scale_ * window_.size();
  Enlarged result;
  result.marks.areas = std::move(part_.group.areas);
  for (Line& line : part_.group.lines) {
    line.like = line.layer == Layer::mark ? line.like : line.layer;
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
  result.shown.window = window_;
  result.whole = std::ranges::all_of(piece_.group.lines, [&](const Line& line) {
    return std::ranges::all_of(line.points, [&](Vec2 p) { return lies_in(p, window_); });
  });
  result.words =
      fmt::format("{}{}, {:g} times as large", result.whole ? "" : "part of ", piece_.name, scale_);
  return result;
}

void EnlargedPart::add_lines() {
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
      const auto seen = clipped(Segment2{line.points[i], line.points[(i + 1) % line.points.size()]}, window_);
      if (!seen) {
        put();
        continue;
      }
      const Vec2 from = on_picture(seen->a);
      if (part.points.empty() || length(from - part.points.back()) > same_point_mm) {
        put();
        part.points.push_back(from);
      }
      part.points.push_back(on_picture(seen->b));
    }
    put();
  }
}

void EnlargedPart::add_areas() {
  for (const Area& area : piece_.group.areas) {
    std::vector<Vec2> outline = clipped(area.outline, window_);
    if (outline.size() > 2) {
      std::ranges::transform(outline, outline.begin(), [&](Vec2 p) { return on_picture(p); });
      part_.group.areas.push_back({Layer::mark, std::move(outline)});
    }
  }
}

void EnlargedPart::add_seams() {
  for (const std::size_t seam : lost_.seams) {
    const Seam& own = piece_.seams[seam];
    add_seam(own, clipped(own.edge, window_).value_or(own.edge));
  }
  for (std::size_t i = 0; i < piece_.seams.size(); ++i) {
    const auto seen = clipped(piece_.seams[i].edge, window_);
    if (seen && scale_ * length(seen->b - seen->a) >= least_seen_mm &&
        std::ranges::find(lost_.seams, i) == lost_.seams.end()) {
      add_seam(piece_.seams[i], *seen);
    }
  }
}

void EnlargedPart::add_seam(const Seam& seam, const Segment2& seen) {
  Seam larger = seam;
  larger.edge = {on_picture(seen.a), on_picture(seen.b)};
  // Leaders begin at tabs: only at those that are seen.
  if (!std::ranges::all_of(larger.tab, [&](Vec2 p) { return lies_in(p, window_); })) {
    larger.tab.clear();
  }
  std::ranges::transform(larger.tab, larger.tab.begin(), [&](Vec2 p) { return on_picture(p); });
  part_.seams.push_back(std::move(larger));
}

}  // namespace ridgecraft::paper
