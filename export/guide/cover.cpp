// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/cover.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "export/guide/words.hpp"
#include "export/style/stroke_font.hpp"
#include "export/view/camera.hpp"
#include "export/view/scene.hpp"
#include "mesh/look/look.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr std::size_t cover_pixels = 96;
/// Another side than the file's front has so many times as much to be seen.
constexpr double clearly_more = 1.1;
/// Faces that are seen from their edge (cosine) show no place.
constexpr double least_cosine = 1e-6;

double difference(const mesh::Rgb& a, const mesh::Rgb& b) {
  int most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    most = std::max(most, std::abs(static_cast<int>(a[k]) - static_cast<int>(b[k])));
  }
  return most;
}

/// How much the colours of neighbouring dots differ, times the length along which they do.
double detail_seen(const GuideModel& guide, const Camera& camera) {
  const CoarseView view = look_coarsely(guide.scene, camera, cover_pixels);
  const mesh::Surface& surface = guide.surface();
  const mesh::Look& look = *guide.model->look;
  std::vector<std::optional<mesh::Rgb>> colours(view.face.size());
  std::uint32_t hint = 0;
  for (std::size_t i = 0; i < view.face.size(); ++i) {
    const FaceId face = view.face[i];
    if (!face.valid()) {
      continue;
    }
    const Vec3 normal = surface.normal(face);
    const double slope = dot(camera.toward, normal);
    if (slope < least_cosine) {
      continue;  // its inside, which is white
    }
    const Vec2 p = view.centre(i);
    const Vec3 before = p.x * camera.right + p.y * camera.up;
    const Vec3 corner = surface.point(surface.vertices(face)[0]);
    const Vec3 place = before + dot(corner - before, normal) / slope * camera.toward;
    const mesh::LookPlace found = look.nearest(place, normal, hint);
    hint = found.face;
    colours[i] = look.colour_at(found, view.pixel);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const bool last_in_row = i % view.columns + 1 == view.columns;
    if (!last_in_row && colours[i] && colours[i + 1]) {
      sum += difference(*colours[i], *colours[i + 1]);
    }
    if (i + view.columns < colours.size() && colours[i] && colours[i + view.columns]) {
      sum += difference(*colours[i], *colours[i + view.columns]);
    }
  }
  return sum * view.pixel;
}

}  // namespace

Stance turned_to_cover(const GuideModel& guide) {
  Stance best = guide.stance;
  if (!guide.in_colour) {
    return best;
  }
  const Viewpoint& cover = guide_sides().front();
  double most = 0.0;
  Stance turned = guide.stance;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double detail = detail_seen(guide, look_from(turned, cover.azimuth, cover.elevation));
    if (quarter == 0) {
      most = clearly_more * detail;
    } else if (detail > most) {
      most = detail;
      best = turned;
    }
    turned.front = cross(turned.up, turned.front);
  }
  return best;
}

namespace {

constexpr double title_height_mm = 8.0;
constexpr double heading_height_mm = 3.4;
constexpr double text_height_mm = 2.4;
constexpr double text_step_mm = 5.0;
constexpr double facts_height_mm = 68.0;        ///< what stands below the picture
constexpr double feet_advice_height_mm = 13.0;  ///< and more where bodies stand on others
constexpr double tweezers_below_mm = 6.0;

/// Texts from the top down.
class Rows {
 public:
  Rows(Group& group, Vec2 top_left, double width) : group_(group), at_(top_left), width_(width) {}

  void heading(std::string_view words) {
    at_.y -= heading_height_mm;
    group_.texts.push_back(words_from(words, at_, heading_height_mm, Weight::heading));
    at_.y -= text_step_mm;
  }
  /// A grey word and what it is.
  double fact(std::string_view name, std::string_view value) {
    constexpr double name_width = 28.0;
    group_.texts.push_back(in_grey(words_from(name, {at_.x, at_.y - text_height_mm}, text_height_mm)));
    const double y = at_.y - text_height_mm;
    for (const std::string& row : wrapped(value, width_ - name_width, text_height_mm)) {
      group_.texts.push_back(words_from(row, {at_.x + name_width, at_.y - text_height_mm}, text_height_mm));
      at_.y -= text_step_mm;
    }
    return y;
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
  const Vec3 size = standing_size(guide.surface(), guide.stance);
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

/// Whether bodies are glued onto others by tabs at their feet.
bool has_feet(const GuideModel& guide) {
  return std::ranges::any_of(guide.nets->tabs, &unfold::Tab::of_base);
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
  const bool has_slits =
      std::ranges::any_of(tabs, [](const unfold::Tab& tab) { return tab.slit.has_value(); });
  rows.item(
      "5",
      has_slits
          ? "Join edges of equal numbers, one after the other, in the order of the steps: put arrows from "
            "outside through the slits beside the other edge, one barb after the other; glue tinted tabs. "
            "What a step says to close is joined before the piece is put on."
          : "Glue edges of equal numbers together, one after the other, in the order of the steps. What a "
            "step says to close is glued before the piece is put on.");
  if (has_feet(guide)) {
    rows.item("6",
              "Tabs without a number at the foot of a piece are folded inwards, and glued within the dashed "
              "outline that bears the name of the piece.");
  }
  if (guide.nets->pieces.size() > 1) {
    rows.item(has_feet(guide) ? "7" : "6",
              "The picture of a step shows the new piece in colour (lighter: its back), and the pieces that "
              "it is glued to in white. "
              "Their names are grey, or stand in brackets beside the picture.");
  }
}

}  // namespace

Group cover(const GuideModel& guide, const Context& context) {
  Group group;
  group.id = "cover";
  const Box2 room = guide.sheet.room();
  group.texts.push_back(words_from(shortened(guide.title, room.size().x, title_height_mm),
                                   {room.low.x, room.high.y - title_height_mm}, title_height_mm,
                                   Weight::title));
  const double facts_top = room.low.y + facts_height_mm + (has_feet(guide) ? feet_advice_height_mm : 0.0);
  constexpr double gap = 8.0;
  const Box2 frame{{room.low.x + gap, facts_top + gap},
                   {room.high.x - gap, room.high.y - title_height_mm - gap}};
  group.figures.push_back({frame, "The finished model", group.texts.size()});
  const Viewpoint& side = guide_sides().front();
  const Camera camera = look_from(guide.shown, side.azimuth, side.elevation);
  const Fit fit = fit_into(seen_box(guide.scene, camera), frame);
  if (guide.in_colour) {
    add_coloured_picture(*guide.model, {guide.scene, *guide.nets, camera, fit}, group, context);
  } else {
    add_picture(
        {guide.scene, *guide.nets, camera, fit},
        [&](PieceId piece) -> const PieceLook& { return guide.looks[piece]; }, group, context);
  }
  group.lines.push_back(guide_rule({room.low.x, facts_top}, {room.high.x, facts_top}));
  const double middle = 0.5 * (room.low.x + room.high.x);
  const double top = facts_top - 5.0;
  add_facts(guide, {room.low, {middle - 0.5 * gap, top}}, group);
  add_advice(guide, {{middle + 0.5 * gap, room.low.y}, {room.high.x, top}}, group);
  return group;
}

}  // namespace ridgecraft::export_
