// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/guide.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/context.hpp"
#include "base/text.hpp"
#include "export/guide/cover.hpp"
#include "export/guide/guide_model.hpp"
#include "export/guide/picture.hpp"
#include "export/guide/step_pages.hpp"
#include "export/guide/words.hpp"
#include "export/style/stroke_font.hpp"
#include "export/view/scene.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr double page_heading_mm = 3.4;
constexpr double name_height_mm = 2.2;
constexpr double caption_height_mm = 2.0;
constexpr double caption_gap_mm = 3.0;  ///< between a picture and the words below it
constexpr double gap_mm = 6.0;          ///< between pictures
constexpr double note_height_mm = 8.0;  ///< for what no side shows, below all of them
constexpr std::size_t most_columns = 4;
constexpr std::size_t anchor_pixels = 220;
/// A piece is shown by a side where at least so much of it is seen as its best side shows: less of a floor
/// looks like the bumper in front of it.
constexpr double least_shown = 1.0 / 3.0;
/// Where less of it is seen than this share of what another picture shows, only that one names it.
constexpr double least_named = 0.1;
/// More sides are drawn where there is room for them: if pictures stay as large, but for this share.
constexpr double least_scale = 0.95;
/// Lines end on faces where these have so much room round them.
constexpr double least_face_mm = 1.0;
/// Two sides look alike where no larger share of what one of them shows isn't in the other.
constexpr double most_unlike = 0.01;
constexpr std::size_t sides_above = 4;
constexpr std::size_t most_sides = 6;

struct SideView {
  Camera camera;
  Box2 seen;                    ///< of the whole model, in its unit
  std::vector<Anchor> anchors;  ///< of each piece, on faces
  std::vector<Anchor> inside;   ///< of each piece, farthest from other pieces
  std::vector<double> area;     ///< of each piece
  std::size_t columns = 0;      ///< of pixels
  std::vector<PieceId> pixels;  ///< what is seen in each, row by row from below; none where nothing is
};

SideView look_at_pieces(const GuideModel& guide, const Viewpoint& side) {
  SideView view;
  view.camera = look_from(guide.shown, side.azimuth, side.elevation);
  view.seen = seen_box(guide.scene, view.camera);
  const CoarseView coarse = look_coarsely(guide.scene, view.camera, anchor_pixels);
  const std::size_t count = guide.nets->pieces.size();
  view.anchors = find_anchors_on_faces(coarse, guide.scene, guide.piece_of_face, count);
  view.inside = find_anchors(coarse, guide.piece_of_face, count);
  view.area = seen_areas(coarse, count, [&](FaceId face) { return guide.piece_of_face[face]; });
  view.columns = coarse.columns;
  std::ranges::transform(coarse.face, std::back_inserter(view.pixels), [&](FaceId face) {
    return face.valid() ? PieceId(guide.piece_of_face[face]) : PieceId{};
  });
  return view;
}

/// The share of what is seen of a that b doesn't show at the same place or on a pixel beside it.
double unlike_fraction(const SideView& a, const SideView& b) {
  const auto piece_at = [](const SideView& view, std::size_t x, std::size_t y) {
    const std::size_t i = y * view.columns + x;
    return x < view.columns && i < view.pixels.size() ? view.pixels[i] : PieceId{};
  };
  std::size_t seen = 0;
  std::size_t unlike = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if (!a.pixels[i].valid()) {
      continue;
    }
    ++seen;
    bool found = false;
    for (std::size_t k = 0; k < 9 && !found; ++k) {
      // Left of and below the first pixel numbers wrap round to ones that no picture has.
      found = piece_at(b, i % a.columns + k % 3 - 1, i / a.columns + k / 3 - 1) == a.pixels[i];
    }
    unlike += found ? 0U : 1U;
  }
  return static_cast<double>(unlike) / static_cast<double>(std::max<std::size_t>(seen, 1));
}

/// Whether a reader sees the same pieces at the same places.
bool look_alike(const SideView& a, const SideView& b) {
  return std::max(unlike_fraction(a, b), unlike_fraction(b, a)) <= most_unlike;
}

/// Which sides are drawn: four from above, but for those that look like an earlier one, and from below those
/// two that show most pieces that none of these shows.
std::vector<std::size_t> sides_to_draw(const std::vector<SideView>& views, std::size_t pieces) {
  std::vector<double> most_seen(pieces, 0.0);
  for (const SideView& view : views) {
    for (std::size_t p = 0; p < pieces; ++p) {
      most_seen[p] = std::max(most_seen[p], view.area[p]);
    }
  }
  const auto shows = [&](std::size_t side, std::size_t p) {
    return views[side].anchors[p].seen && views[side].area[p] >= least_shown * most_seen[p];
  };
  std::vector<std::size_t> drawn;
  for (std::size_t side = 0; side < sides_above; ++side) {
    if (std::ranges::none_of(drawn, [&](std::size_t d) { return look_alike(views[d], views[side]); })) {
      drawn.push_back(side);
    }
  }
  std::vector<bool> shown(pieces, false);
  const auto mark = [&](std::size_t side) {
    for (std::size_t p = 0; p < pieces; ++p) {
      shown[p] = shown[p] || shows(side, p);
    }
  };
  for (const std::size_t side : drawn) {
    mark(side);
  }
  while (drawn.size() < most_sides) {
    std::size_t best = 0;
    std::size_t most = 0;
    for (std::size_t side = sides_above; side < views.size(); ++side) {
      std::size_t fresh = 0;
      for (std::size_t p = 0; p < pieces; ++p) {
        fresh += !shown[p] && shows(side, p) ? std::size_t{1} : std::size_t{0};
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

/// From below, too, and from there two sides that face each other.
std::vector<std::size_t> with_more_sides(std::vector<std::size_t> drawn) {
  if (drawn.back() < sides_above) {
    drawn.push_back(sides_above);
  }
  if (drawn.size() < most_sides) {
    drawn.push_back(sides_above + (drawn.back() - sides_above + 2) % 4);
  }
  return drawn;
}

/// How the pictures share the page. All are of one size: they show one model.
struct Arrangement {
  std::size_t columns = 1;
  Vec2 cell;           ///< of one picture with its names and the words below
  double scale = 0.0;  ///< of the model's unit
};

/// With names `names` wide on both sides, as large as so many columns allow.
Arrangement arranged(std::size_t columns, const std::vector<Vec2>& sizes, Vec2 room, double names) {
  const std::size_t rows = (sizes.size() + columns - 1) / columns;
  const auto fraction = [](double length, std::size_t count) {
    return (length - (static_cast<double>(count) - 1.0) * gap_mm) / static_cast<double>(count);
  };
  Arrangement result{columns, {fraction(room.x, columns), fraction(room.y, rows)}, INFINITY};
  const Vec2 frame = result.cell - Vec2{2.0 * names, caption_height_mm + caption_gap_mm};
  for (const Vec2 size : sizes) {
    result.scale =
        std::min({result.scale, frame.x / std::max(size.x, 1e-9), frame.y / std::max(size.y, 1e-9)});
  }
  return result;
}

/// The one with the largest pictures.
Arrangement best_arrangement(const std::vector<Vec2>& sizes, Vec2 room, double names) {
  Arrangement best;
  for (std::size_t columns = 1; columns <= most_columns; ++columns) {
    if (const Arrangement next = arranged(columns, sizes, room, names); next.scale > best.scale) {
      best = next;
    }
  }
  return best;
}

class Overview {
 public:
  Overview(const GuideModel& guide, const Context& context) : guide_(guide), context_(context) {
    group_.id = "overview";
    room_ = guide.sheet.room();
    group_.texts.push_back(words_from("Where each piece goes", {room_.low.x, room_.high.y - page_heading_mm},
                                      page_heading_mm, Weight::heading));
    room_.high.y -= page_heading_mm + gap_mm;
    room_.low.y += note_height_mm;
    for (const Viewpoint& side : guide_sides()) {
      context.check();
      views_.push_back(look_at_pieces(guide, side));
    }
    pieces_ = guide.nets->pieces.size();
    named_.assign(pieces_, false);
    drawn_ = sides_to_draw(views_, pieces_);
    for (const unfold::Piece& piece : guide.nets->pieces) {
      names_ = std::max(names_, text_width(piece.name, name_height_mm));
    }
    names_ += 5.0;  // the lines between words and picture
    arrangement_ = arrangement_of(drawn_);
    if (std::vector<std::size_t> more = with_more_sides(drawn_); more.size() > drawn_.size()) {
      const Arrangement other = arrangement_of(more);
      if (other.scale >= least_scale * arrangement_.scale) {
        arrangement_ = other;
        drawn_ = std::move(more);
      }
    }
    for (const std::size_t side : drawn_) {
      widest_ = std::max(widest_, views_[side].seen.size().x);
    }
  }

  Group draw() {
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      context_.check();
      add_side(i);
    }
    add_note();
    return std::move(group_);
  }

 private:
  [[nodiscard]] Arrangement arrangement_of(const std::vector<std::size_t>& sides) const {
    std::vector<Vec2> sizes;
    for (const std::size_t side : sides) {
      sizes.push_back(views_[side].seen.size());
    }
    return best_arrangement(sizes, room_.size(), names_);
  }

  /// The sheet's part for the picture that comes at this place.
  [[nodiscard]] Box2 cell_of(std::size_t i) const {
    const Vec2 cell = arrangement_.cell;
    const auto column = static_cast<double>(i % arrangement_.columns);
    const auto row = static_cast<double>(i / arrangement_.columns);
    const Vec2 low{room_.low.x + column * (cell.x + gap_mm),
                   room_.high.y - (row + 1.0) * cell.y - row * gap_mm};
    return {low, low + cell};
  }

  /// The side that is drawn where most of a piece is seen.
  [[nodiscard]] std::size_t best_side(std::size_t piece) const {
    return *std::max_element(drawn_.begin(), drawn_.end(), [&](std::size_t a, std::size_t b) {
      return views_[a].area[piece] < views_[b].area[piece];
    });
  }

  /// Pieces that a side names: those that it shows best, then others if there is room beside those and enough
  /// of them is seen.
  [[nodiscard]] std::vector<std::size_t> pieces_to_name(std::size_t side) const {
    // Nobody can see at what a line points that ends on less.
    constexpr double least_room = 0.6;  // mm
    const SideView& view = views_[side];
    std::vector<std::size_t> order;
    for (std::size_t p = 0; p < pieces_; ++p) {
      const std::size_t best = best_side(p);
      const bool enough = arrangement_.scale * view.inside[p].room >= least_room &&
                          view.area[p] >= least_named * views_[best].area[p];
      if (view.anchors[p].seen && (best == side || enough)) {
        order.push_back(p);
      }
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(best_side(a) != side, -view.area[a]) < std::pair(best_side(b) != side, -view.area[b]);
    });
    return order;
  }

  void add_side(std::size_t i) {
    const SideView& view = views_[drawn_[i]];
    const Box2 cell = cell_of(i);
    const Box2 frame{cell.low + Vec2{0.0, caption_height_mm + caption_gap_mm}, cell.high};
    const Fit fit = fit_at_scale(view.seen, arrangement_.scale, frame);
    const std::string caption = caption_of(drawn_[i]);
    group_.figures.push_back(
        {frame, "The finished model " + caption + ", and which piece is where", group_.texts.size()});
    add_picture(
        {guide_.scene, *guide_.nets, view.camera, fit},
        [&](PieceId piece) -> const PieceLook& { return guide_.looks[piece]; }, group_, context_);
    // Names stand beside the widest picture, however much more room there is.
    const double middle = 0.5 * (cell.low.x + cell.high.x);
    const double half = 0.5 * arrangement_.scale * widest_;
    CalloutColumns columns;
    columns.box = {{middle - half - names_, frame.low.y}, {middle + half + names_, frame.high.y}};
    columns.left_edge = middle - half - 3.0;
    columns.right_edge = middle + half + 3.0;
    columns.height = name_height_mm;
    const std::vector<std::size_t> order = pieces_to_name(drawn_[i]);
    std::vector<Callout> callouts;
    for (const std::size_t p : order) {
      const Anchor anchor =
          anchor_to_point_at(view.anchors[p], view.inside[p], least_face_mm / arrangement_.scale);
      callouts.push_back({guide_.nets->pieces[PieceId(p)].name, fit(anchor.at)});
    }
    const std::size_t texts_before = group_.texts.size();
    const std::size_t placed = add_callouts(callouts, columns, group_);
    for (std::size_t k = 0; k < placed; ++k) {
      named_[order[k]] = true;
    }
    // Right below the picture, and below the lowest name beside it.
    double foot = fit(view.seen.low).y;
    for (std::size_t k = texts_before; k < group_.texts.size(); ++k) {
      foot = std::min(foot, group_.texts[k].centre.y - 0.5 * name_height_mm);
    }
    group_.texts.push_back(
        in_grey(words_from(caption,
                           {middle - 0.5 * text_width(caption, caption_height_mm),
                            std::max(cell.low.y, foot - caption_gap_mm - caption_height_mm)},
                           caption_height_mm)));
  }

  /// Tells also which sides aren't drawn because they look like this one.
  [[nodiscard]] std::string caption_of(std::size_t side) const {
    std::vector<std::string> words{std::string(guide_sides()[side].words)};
    for (std::size_t other = side + 1; side < sides_above && other < sides_above; ++other) {
      if (std::ranges::find(drawn_, other) == drawn_.end() && look_alike(views_[side], views_[other])) {
        words.emplace_back(guide_sides()[other].words);
      }
    }
    return words.size() == sides_above ? words.front() + ", and from all other sides" : listed(words, "and");
  }

  void add_note() {
    std::vector<std::string> hidden;
    for (std::size_t s = 0; s < guide_.assembly->steps.size(); ++s) {
      for (const PieceId piece : guide_.assembly->steps[s].pieces) {
        if (!named_[piece.value()]) {
          hidden.push_back(fmt::format("{} (step {})", guide_.nets->pieces[piece].name, s + 1));
        }
      }
    }
    if (!hidden.empty()) {
      const std::string words = "Without a name here: " + listed(hidden, "and");
      group_.texts.push_back(words_from(shortened(words, room_.size().x, caption_height_mm),
                                        {room_.low.x, room_.low.y - note_height_mm + 1.0},
                                        caption_height_mm));
    }
  }

  const GuideModel& guide_;
  const Context& context_;
  Group group_;
  Box2 room_;
  std::vector<SideView> views_;
  std::size_t pieces_ = 0;
  std::vector<bool> named_;         ///< pieces that have a name on this page
  std::vector<std::size_t> drawn_;  ///< sides
  double names_ = 0.0;              ///< room for a name and its line, mm
  double widest_ = 0.0;             ///< of the pictures, in the model's unit
  Arrangement arrangement_;
};

/// The model from four sides, and from two below where pieces are hardly seen otherwise or there is room,
/// each piece in its hue and named where it is seen best at least. In as many columns as make it largest.
/// Throws Error(interrupted). O(8 coarse views + 4 to 6 views).
Group overview(const GuideModel& guide, const Context& context) {
  return Overview(guide, context).draw();
}

}  // namespace

Guide draw_guide(const GuideSource& source, const Style& style, const Context& context) {
  const prepare::Prepared& model = source.model;
  const unfold::Nets& nets = source.nets;
  GuideModel guide;
  guide.model = &model;
  guide.nets = &nets;
  guide.pages = &source.pages;
  guide.assembly = &source.assembly;
  guide.bodies = source.bodies;
  guide.sheets = source.sheets;
  guide.hidden_fold_angle = style.hidden_fold_angle;
  guide.title = printable_utf8(model.model.name);
  guide.sheet = guide_sheet(source.pages.paper);
  guide.stance = source.stance;
  guide.effort = effort_of(model, nets, style.hidden_fold_angle);
  guide.scene = scene_of(model, nets, style.hidden_fold_angle);
  guide.in_colour = model.look != nullptr && style.ink != Ink::lines;
  guide.pale = pale_look();
  guide.contents = piece_contents(model.model.surface, nets);
  for (const Color hue : piece_hues(model.model.surface, nets)) {
    guide.looks.push_back(coloured_look(hue));
  }
  for (const PieceId piece : nets.piece) {
    guide.piece_of_face.push_back(piece.value());
  }
  guide.shown = turned_to_cover(guide);
  std::vector<Group> groups{cover(guide, context)};
  groups.push_back(overview(guide, context));
  for (Group& page : step_pages(guide, context)) {
    groups.push_back(std::move(page));
  }
  Guide result;
  result.steps = source.assembly.steps.size();
  result.effort = guide.effort;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    Drawing& page = result.pages.emplace_back();
    page.size = guide.sheet.size;
    page.title = guide.title;
    page.page = static_cast<int>(i + 1);
    page.page_count = static_cast<int>(groups.size());
    page.groups.push_back(std::move(groups[i]));
    page.groups.push_back(guide_foot(guide.sheet, guide.title, i + 1, groups.size()));
  }
  return result;
}

}  // namespace ridgecraft::export_
