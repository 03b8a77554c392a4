// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/cover.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/sentence.hpp"
#include "export/guide/callouts.hpp"
#include "export/guide/words.hpp"
#include "export/style/stroke_font.hpp"
#include "export/view/coarse_view.hpp"

namespace ridgecraft::paper {
namespace {

constexpr double title_height_mm = 8.0;
constexpr double heading_height_mm = 3.4;
constexpr double text_height_mm = 2.4;
constexpr double text_step_mm = 5.0;
constexpr double facts_height_mm = 68.0;  ///< what stands below the picture
constexpr double tweezers_below_mm = 6.0;

/// Texts from the top down.
class Rows {
 public:
  Rows(Group& group, Vec2 top_left, double width) : group_(group), at_(top_left), width_(width) {}

  void heading(std::string_view words) {
    at_.y -= heading_height_mm;
    group_.texts.push_back(words_from(words, at_, heading_height_mm, Weight::bold));
    at_.y -= text_step_mm;
  }
  /// A grey word and what it is.
  double fact(std::string_view name, std::string_view value) {
    constexpr double name_width = 28.0;
    group_.texts.push_back(in_grey(words_from(name, {at_.x, at_.y - text_height_mm}, text_height_mm)));
    group_.texts.push_back(words_from(shortened(value, width_ - name_width, text_height_mm),
                                      {at_.x + name_width, at_.y - text_height_mm}, text_height_mm));
    at_.y -= text_step_mm;
    return at_.y + text_step_mm - text_height_mm;
  }
  void item(std::string_view mark, std::string_view words) {
    constexpr double mark_width = 5.0;
    constexpr double line_step = 3.9;
    group_.texts.push_back(in_grey(words_from(mark, {at_.x, at_.y - text_height_mm}, text_height_mm)));
    for (const std::string& row : wrapped(words, width_ - mark_width, text_height_mm)) {
      group_.texts.push_back(words_from(row, {at_.x + mark_width, at_.y - text_height_mm}, text_height_mm));
      at_.y -= line_step;
    }
    at_.y -= text_step_mm - line_step;
  }

 private:
  Group& group_;
  Vec2 at_;
  double width_;
};

std::string size_words(const GuideModel& guide) {
  Box3 box;
  const Stance& stance = guide.stance;
  const Vec3 side = cross(stance.up, stance.front);
  for (const Vec3 p : guide.surface().points()) {
    box.add({dot(side, p), dot(stance.front, p), dot(stance.up, p)});
  }
  const Vec3 size = box.size();
  return fmt::format("{:.0f} mm wide, {:.0f} mm deep, {:.0f} mm high", size.x, size.y, size.z);
}

std::string sheet_words(const GuideModel& guide) {
  const Vec2 size = guide.pages->paper.size;
  return fmt::format("{} of {:g} \u00d7 {:g} mm", guide.sheets, std::round(10.0 * size.x) / 10.0,
                     std::round(10.0 * size.y) / 10.0);
}

/// Five squares, as many of them full as it is hard.
void add_difficulty(int difficulty, Vec2 at, Group& group) {
  constexpr double side = 2.4;
  constexpr double step = 3.4;
  for (int i = 0; i < 5; ++i) {
    const Vec2 low = at + Vec2{step * i, 0.0};
    const std::vector<Vec2> square{low, low + Vec2{side, 0.0}, low + Vec2{side, side}, low + Vec2{0.0, side}};
    group.areas.push_back(
        {Layer::picture, square, i < difficulty ? Color{0x44, 0x44, 0x48} : Color{0xe2, 0xe2, 0xe2}});
  }
}

void add_facts(const GuideModel& guide, const Box2& box, Group& group) {
  const Effort& effort = guide.effort;
  Rows rows(group, {box.low.x, box.high.y}, box.size().x);
  rows.heading("The model");
  rows.fact("size", size_words(guide));
  rows.fact("sheets", sheet_words(guide));
  rows.fact("pieces", fmt::format("{}, in {}", guide.nets->pieces.size(),
                                  counted(guide.assembly->steps.size(), "step")));
  rows.fact("to glue",
            fmt::format("{}, {:.1f} m of seam", counted(effort.joins, "edge"), effort.seam_mm / 1000.0));
  rows.fact("to fold", counted(effort.folds, "edge"));
  if (effort.smallest_tab_mm > 0.0) {
    rows.fact("shortest tab", fmt::format("{:.1f} mm along its edge", effort.smallest_tab_mm));
  }
  rows.fact("paper", paper_weight(guide.surface().bounds().largest_extent(), effort.median_join_mm));
  rows.fact("time", duration_words(effort.minutes));
  const std::string words = difficulty_words(effort.difficulty);
  const double y = rows.fact("how hard", words);
  constexpr double name_width = 28.0;
  add_difficulty(effort.difficulty, {box.low.x + name_width + text_width(words, text_height_mm) + 4.0, y},
                 group);
}

void add_advice(const GuideModel& guide, const Box2& box, Group& group) {
  Rows rows(group, {box.low.x, box.high.y}, box.size().x);
  rows.heading("What to do");
  std::string tools =
      "Have at hand: a knife and a mat, or scissors; a ruler; a blunt needle or an empty pen; paper "
      "glue";
  const double smallest = guide.effort.smallest_tab_mm;
  tools += smallest > 0.0 && smallest < tweezers_below_mm ? "; tweezers." : ".";
  rows.item("1", tools);
  rows.item("2", "Print the sheets at 100 % and measure the scale bar.");
  rows.item("3", "Score every fold along the ruler, with the needle or the pen, before you cut.");
  rows.item("4", "Cut out a piece, and fold it: mountain folds away from you, valley folds towards you.");
  const auto& tabs = guide.nets->tabs;
  if (std::ranges::any_of(tabs, [](const unfold::Tab& tab) { return tab.slit.has_value(); })) {
    rows.item(
        "5",
        "Join edges of equal numbers, one after the other, in the order of the steps: put arrows from "
        "outside through the slits beside the other edge, one barb after the other; glue tinted tabs. What "
        "a step says to close is joined before the piece is put on.");
    return;
  }
  rows.item(
      "5",
      "Glue edges of equal numbers together, one after the other, in the order of the steps. What a step "
      "says to close is glued before the piece is put on.");
}

/// The box that a picture with names on both sides has.
struct NamedPicture {
  Box2 picture;
  CalloutColumns columns;
};
NamedPicture named_picture(const Box2& box, double height, double column) {
  NamedPicture result;
  result.picture = {{box.low.x + column, box.low.y}, {box.high.x - column, box.high.y}};
  result.columns = {box, box.low.x + column - 3.0, box.high.x - column + 3.0, height};
  return result;
}

struct SideView {
  Camera camera;
  std::vector<Anchor> anchors;  ///< of each piece
  std::vector<double> area;     ///< of each piece
};

constexpr std::size_t anchor_pixels = 220;

SideView look_at_pieces(const GuideModel& guide, const Viewpoint& side) {
  SideView view;
  view.camera = look_from(guide.stance, side.azimuth, side.elevation);
  const CoarseView coarse = look_coarsely(guide.scene, view.camera, anchor_pixels);
  const std::size_t count = guide.nets->pieces.size();
  view.anchors = find_anchors_on_faces(coarse, guide.scene, guide.piece_of_face, count);
  view.area = seen_areas(coarse, count, [&](FaceId face) { return guide.piece_of_face[face]; });
  return view;
}

/// Which sides are drawn: four from above, and from below those two that show most pieces that none of these
/// shows.
std::vector<std::size_t> sides_to_draw(const std::vector<SideView>& views, std::size_t pieces) {
  std::vector<std::size_t> drawn{0, 1, 2, 3};
  std::vector<bool> seen(pieces, false);
  const auto mark = [&](std::size_t side) {
    for (std::size_t p = 0; p < pieces; ++p) {
      seen[p] = seen[p] || views[side].anchors[p].seen;
    }
  };
  for (const std::size_t side : drawn) {
    mark(side);
  }
  while (drawn.size() < 6) {
    std::size_t best = 0;
    std::size_t most = 0;
    for (std::size_t side = 4; side < views.size(); ++side) {
      std::size_t fresh = 0;
      for (std::size_t p = 0; p < pieces; ++p) {
        fresh += !seen[p] && views[side].anchors[p].seen ? std::size_t{1} : std::size_t{0};
      }
      if (fresh > most) {
        most = fresh;
        best = side;
      }
    }
    if (most == 0) {
      break;
    }
    drawn.push_back(best);
    mark(best);
  }
  return drawn;
}

}  // namespace

Group cover(const GuideModel& guide, const Context& context) {
  Group group;
  group.id = "cover";
  const Box2 room = guide.sheet.room();
  group.texts.push_back(words_from(shortened(guide.title, room.size().x, title_height_mm),
                                   {room.low.x, room.high.y - title_height_mm}, title_height_mm,
                                   Weight::bold));
  const double facts_top = room.low.y + facts_height_mm;
  constexpr double gap = 8.0;
  const Box2 frame{{room.low.x + gap, facts_top + gap},
                   {room.high.x - gap, room.high.y - title_height_mm - gap}};
  const Viewpoint& side = guide_sides().front();
  const Camera camera = look_from(guide.stance, side.azimuth, side.elevation);
  const Fit fit = fit_into(seen_box(guide.scene, camera), frame);
  if (guide.in_colour) {
    add_coloured_picture(*guide.model, guide.scene, *guide.nets, camera, fit, group, context);
  } else {
    add_picture(
        guide.scene, *guide.nets, camera, fit, std::nullopt,
        [&](PieceId piece) -> const PieceLook& { return guide.looks[piece]; }, group);
  }
  group.lines.push_back(guide_rule({room.low.x, facts_top}, {room.high.x, facts_top}));
  const double middle = 0.5 * (room.low.x + room.high.x);
  const double top = facts_top - 5.0;
  add_facts(guide, {room.low, {middle - 0.5 * gap, top}}, group);
  add_advice(guide, {{middle + 0.5 * gap, room.low.y}, {room.high.x, top}}, group);
  return group;
}

Group overview(const GuideModel& guide, const Context& context) {
  constexpr double name_height = 2.2;
  constexpr double caption_height = 2.0;
  constexpr double gap = 6.0;
  Group group;
  group.id = "overview";
  Box2 room = guide.sheet.room();
  group.texts.push_back(words_from("Where each piece goes", {room.low.x, room.high.y - heading_height_mm},
                                   heading_height_mm, Weight::bold));
  room.high.y -= heading_height_mm + gap;
  std::vector<SideView> views;
  for (const Viewpoint& side : guide_sides()) {
    context.check();
    views.push_back(look_at_pieces(guide, side));
  }
  const std::size_t pieces = guide.nets->pieces.size();
  const std::vector<std::size_t> drawn = sides_to_draw(views, pieces);
  double column_width = 0.0;
  for (const unfold::Piece& piece : guide.nets->pieces) {
    column_width = std::max(column_width, text_width(piece.name, name_height));
  }
  column_width += 5.0;  // the lines between words and picture
  std::vector<bool> named(pieces, false);
  const auto rows = static_cast<double>((drawn.size() + 1) / 2);
  // What no side shows is said below.
  const double note_height = 8.0;
  room.low.y += note_height;
  const Vec2 cell{0.5 * (room.size().x - gap), (room.size().y - (rows - 1.0) * gap) / rows};
  // A piece is named where it is seen best; elsewhere, if there is room beside those.
  const auto best_side = [&](std::size_t p) {
    return *std::max_element(drawn.begin(), drawn.end(), [&](std::size_t a, std::size_t b) {
      return views[a].area[p] < views[b].area[p];
    });
  };
  // All of one size, so that nobody takes them for different models.
  double scale = INFINITY;
  const auto place_in = [&](const Box2& box) { return named_picture(box, name_height, column_width); };
  for (const std::size_t side : drawn) {
    const Box2 box{{0.0, caption_height + 2.0}, cell};
    scale = std::min(scale, fit_into(seen_box(guide.scene, views[side].camera), place_in(box).picture).scale);
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    context.check();
    const SideView& view = views[drawn[i]];
    const Vec2 low{room.low.x + static_cast<double>(i % 2) * (cell.x + gap),
                   room.high.y - static_cast<double>(i / 2 + 1) * cell.y - static_cast<double>(i / 2) * gap};
    const Box2 box{low + Vec2{0.0, caption_height + 2.0}, low + cell};
    const NamedPicture place = place_in(box);
    const Fit fit = fit_at_scale(seen_box(guide.scene, view.camera), scale, place.picture);
    add_picture(
        guide.scene, *guide.nets, view.camera, fit, std::nullopt,
        [&](PieceId piece) -> const PieceLook& { return guide.looks[piece]; }, group);
    std::vector<std::size_t> order;
    for (std::size_t p = 0; p < pieces; ++p) {
      // Nobody can see at what a line points that ends on less.
      constexpr double least_room = 0.6;  // mm
      if (view.anchors[p].seen && (best_side(p) == drawn[i] || scale * view.anchors[p].room >= least_room)) {
        order.push_back(p);
      }
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(best_side(a) != drawn[i], -view.area[a]) <
             std::pair(best_side(b) != drawn[i], -view.area[b]);
    });
    std::vector<Callout> callouts;
    for (const std::size_t p : order) {
      callouts.push_back({guide.nets->pieces[PieceId(p)].name, fit(view.anchors[p].at)});
    }
    const std::size_t texts_before = group.texts.size();
    const std::size_t placed = add_callouts(callouts, place.columns, group);
    for (std::size_t k = 0; k < placed; ++k) {
      named[order[k]] = true;
    }
    const std::string_view caption = guide_sides()[drawn[i]].words;
    const double middle = low.x + 0.5 * (cell.x - text_width(caption, caption_height));
    // Right below the picture, and below the lowest name beside it.
    constexpr double caption_gap = 3.0;
    double foot = fit(seen_box(guide.scene, view.camera).low).y;
    for (std::size_t k = texts_before; k < group.texts.size(); ++k) {
      foot = std::min(foot, group.texts[k].centre.y - 0.5 * name_height);
    }
    group.texts.push_back(in_grey(
        words_from(caption, {middle, std::max(low.y, foot - caption_gap - caption_height)}, caption_height)));
  }
  std::vector<std::string> hidden;
  for (std::size_t s = 0; s < guide.assembly->steps.size(); ++s) {
    for (const PieceId piece : guide.assembly->steps[s].pieces) {
      if (!named[piece.value()]) {
        hidden.push_back(fmt::format("{} (step {})", guide.nets->pieces[piece].name, s + 1));
      }
    }
  }
  if (!hidden.empty()) {
    const std::string words = "Without a name here: " + listed(hidden, "and");
    group.texts.push_back(words_from(shortened(words, room.size().x, caption_height),
                                     {room.low.x, room.low.y - note_height + 1.0}, caption_height));
  }
  return group;
}

}  // namespace ridgecraft::paper
