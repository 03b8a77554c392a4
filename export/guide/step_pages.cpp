// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/step_pages.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "export/guide/guide_model.hpp"
#include "export/guide/words.hpp"
#include "export/page/lines.hpp"
#include "export/style/stroke_font.hpp"
#include "export/view/scene.hpp"
#include "export/view/view.hpp"

namespace ridgecraft::export_ {
namespace {

/// How many steps a page has, and how large their words are, mm.
struct StepGrid {
  std::size_t most_steps;  ///< of a model that is laid out so
  std::size_t columns;
  std::size_t rows;
  double number_height;
  double words_height;
  double net_width;       ///< of the small picture of the net
  double column_width;    ///< for names beside the picture
  std::size_t most_rows;  ///< of sentences
};
constexpr std::array<StepGrid, 3> grids{{{36, 2, 3, 5.0, 2.1, 21.0, 9.0, 7},
                                         {120, 3, 4, 4.0, 1.8, 15.0, 7.0, 6},
                                         {static_cast<std::size_t>(-1), 4, 5, 3.2, 1.6, 10.0, 5.5, 5}}};
constexpr double cell_gap = 7.0;
constexpr double row_step_fraction = 1.65;  ///< of the words' height
constexpr double name_fraction = 1.1;       ///< height of names beside the picture, of the words'

constexpr std::size_t side_pixels = 96;
constexpr std::size_t name_pixels = 200;
/// The side of the step before is kept as long as it shows this share of what the best side does.
constexpr double good_enough = 0.6;
/// What is seen from below counts less: models aren't held so.
constexpr double below_fraction = 0.6;
/// An addition that is smaller than this share of what stands is shown with its surroundings only ...
constexpr double small_fraction = 0.3;
/// ... so many times as wide as itself.
constexpr double surroundings = 3.2;
/// Beyond this many faces in all pictures of steps, each shows only what is added and what that is glued to.
constexpr std::size_t most_faces_drawn = 100'000;

/// A piece of which less than this share is seen doesn't show what is glued to it.
constexpr double sliver_fraction = 0.02;
/// Lines end on faces where these have so much room round them.
constexpr double least_room_mm = 1.0;

/// What is added behind all else is drawn in dashes, mm.
constexpr double dash_mm = 1.0;
constexpr double dash_gap_mm = 0.7;

constexpr std::size_t most_nets = 3;  ///< of a step that are shown
constexpr double net_gap = 2.0;       ///< between them and the step's picture
/// A step's picture stands below its net, not beside it, where it is so many times as large there.
constexpr double much_larger = 1.2;

/// What a step's picture shows, and from where.
struct StepScene {
  Scene scene;
  Camera camera;
  std::string_view turned;  ///< how it is seen, where that isn't as on the first page, or was another way in
                            ///< the step before
};

class StepPages {
 public:
  explicit StepPages(const GuideModel& guide) : guide_(guide), steps_(guide.assembly->steps) {
    grid_ = *std::find_if(grids.begin(), grids.end(),
                          [&](const StepGrid& grid) { return steps_.size() <= grid.most_steps; });
    // A row more a page, rather than a page of one row.
    const std::size_t last = steps_.size() % (grid_.columns * grid_.rows);
    if (steps_.size() > last && last > 0 && last <= grid_.columns) {
      const auto pages_of = [&](std::size_t rows) {
        return (steps_.size() + grid_.columns * rows - 1) / (grid_.columns * rows);
      };
      grid_.rows += pages_of(grid_.rows + 1) < pages_of(grid_.rows) ? 1U : 0U;
    }
    share_rows();
    only_near_ = steps_.size() * guide.surface().face_count() > most_faces_drawn;
  }

  std::vector<Group> make(const Context& context) {
    only_near_ = only_near_ || context.out_of_time();
    const std::vector<StepScene> scenes = choose_sides(context);
    std::vector<Group> cells(steps_.size());
    do_in_parallel(cells.size(), context, [&](std::size_t i, const Context& own) {
      own.check();
      StepScene step = scenes[i];
      if (!only_near_ && own.out_of_time()) {
        step.scene = scene_with(guide_.scene, *guide_.nets, near_pieces(i));
      }
      cells[i] = cell(i, step, own);
    });
    std::vector<Group> pages(rows_of_page_.size());
    for (Group& page : pages) {
      page.id = "steps";
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      Group& page = pages[place_of_step(i).page];
      const auto append = [](auto& to, auto& from) {
        to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
      };
      for (Figure& figure : cells[i].figures) {
        figure.texts_before += page.texts.size();
      }
      append(page.figures, cells[i].figures);
      append(page.areas, cells[i].areas);
      append(page.lines, cells[i].lines);
      append(page.texts, cells[i].texts);
    }
    return pages;
  }

 private:
  /// All pages have as many rows, but for one, and rows are as high as that leaves: no page is half empty.
  void share_rows() {
    const std::size_t rows = (steps_.size() + grid_.columns - 1) / grid_.columns;
    const std::size_t pages = (rows + grid_.rows - 1) / grid_.rows;
    for (std::size_t page = 0; page < pages; ++page) {
      rows_of_page_.push_back(rows / pages + (page < rows % pages ? 1 : 0));
    }
  }

  struct Place {
    std::size_t page, row, column;
  };
  [[nodiscard]] Place place_of_step(std::size_t index) const {
    Place place{0, index / grid_.columns, index % grid_.columns};
    for (; place.row >= rows_of_page_[place.page]; ++place.page) {
      place.row -= rows_of_page_[place.page];
    }
    return place;
  }

  [[nodiscard]] Box2 box_of_step(std::size_t index) const {
    const Box2 room = guide_.sheet.room();
    const Place place = place_of_step(index);
    const auto columns = static_cast<double>(grid_.columns);
    // One row alone would be of towers.
    const auto rows = static_cast<double>(std::max<std::size_t>(rows_of_page_[place.page], 2));
    const Vec2 size{(room.size().x - (columns - 1.0) * cell_gap) / columns,
                    (room.size().y - (rows - 1.0) * cell_gap) / rows};
    const auto column = static_cast<double>(place.column);
    const auto row = static_cast<double>(place.row);
    const Vec2 corner{room.low.x + column * (size.x + cell_gap), room.high.y - row * (size.y + cell_gap)};
    return {{corner.x, corner.y - size.y}, {corner.x + size.x, corner.y}};
  }

  [[nodiscard]] bool is_new(std::size_t index, PieceId piece) const {
    const std::vector<PieceId>& pieces = steps_[index].pieces;
    return std::binary_search(pieces.begin(), pieces.end(), piece);
  }

  /// What a step adds, and what that is glued to.
  [[nodiscard]] IdVector<PieceId, bool> near_pieces(std::size_t index) const {
    IdVector<PieceId, bool> shown(guide_.nets->pieces.size(), false);
    for (const PieceId piece : glued_before(guide_.surface(), *guide_.nets, steps_[index])) {
      shown[piece] = true;
    }
    for (const PieceId piece : steps_[index].pieces) {
      shown[piece] = true;
    }
    return shown;
  }

  [[nodiscard]] std::vector<StepScene> choose_sides(const Context& context) const {
    std::vector<StepScene> scenes;
    IdVector<PieceId, bool> standing(guide_.nets->pieces.size(), false);
    std::size_t side = 0;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      context.check();
      for (const PieceId piece : steps_[i].pieces) {
        standing[piece] = true;
      }
      StepScene step{scene_with(guide_.scene, *guide_.nets, only_near_ ? near_pieces(i) : standing), {}, {}};
      const std::size_t before = std::exchange(side, best_side(i, step.scene, side));
      // Who looks up one step wants to know which side it shows.
      if (side != before || side != 0) {
        step.turned = guide_sides()[side].words;
      }
      step.camera = look_from(guide_.shown, guide_sides()[side].azimuth, guide_sides()[side].elevation);
      scenes.push_back(std::move(step));
    }
    return scenes;
  }

  /// The side that shows most of the pieces that are added.
  [[nodiscard]] std::size_t best_side(std::size_t index, const Scene& scene, std::size_t before) const {
    std::vector<double> shows;
    for (const Viewpoint& side : guide_sides()) {
      const CoarseView view =
          look_coarsely(scene, look_from(guide_.shown, side.azimuth, side.elevation), side_pixels);
      const std::vector<double> areas = seen_areas(view, guide_.nets->pieces.size(),
                                                   [&](FaceId face) { return guide_.piece_of_face[face]; });
      double sum = 0.0;
      for (const PieceId piece : steps_[index].pieces) {
        // All of several pieces are to be seen: two halves are worth more than one whole.
        sum += std::sqrt(areas[piece.value()]);
      }
      shows.push_back(side.elevation < 0.0 ? below_fraction * sum : sum);
    }
    const auto best = static_cast<std::size_t>(std::max_element(shows.begin(), shows.end()) - shows.begin());
    return shows[before] >= good_enough * shows[best] ? before : best;
  }

  [[nodiscard]] Group cell(std::size_t index, const StepScene& step, const Context& context) const {
    Group group;
    const Box2 box = box_of_step(index);
    const double top = add_head(index, box, step.turned, group);
    const CoarseView coarse = look_coarsely(step.scene, step.camera, name_pixels);
    const std::vector<PieceId> behind = pieces_behind(index, coarse);
    const double bottom = add_sentences(index, box, step, behind, group);
    const Box2 picture{{box.low.x, bottom}, {box.high.x, top}};
    const double net_ends = add_net(index, picture, group);
    add_step_picture({index, step, coarse, largest_beside_net(index, step, picture, net_ends), behind}, group,
                     context);
    return group;
  }

  /// Room for the step's picture: beside the small one of the net, or below it where it is much larger there.
  [[nodiscard]] Box2 largest_beside_net(std::size_t index, const StepScene& step, const Box2& picture,
                                        double net_ends) const {
    Box2 beside = picture;
    beside.high.x -= grid_.net_width + net_gap;
    Box2 below = picture;
    below.high.y = std::min(picture.high.y, net_ends - net_gap);
    const auto scale = [&](const Box2& box) { return place_in(index, step, frame_in(index, box)).fit.scale; };
    return below.size().y > 0.0 && scale(below) > much_larger * scale(beside) ? below : beside;
  }

  /// Of what is added and glued to in this step, the pieces that nothing is seen of, or but a sliver.
  [[nodiscard]] std::vector<PieceId> pieces_behind(std::size_t index, const CoarseView& coarse) const {
    const std::vector<double> areas = seen_areas(coarse, guide_.nets->pieces.size(),
                                                 [&](FaceId face) { return guide_.piece_of_face[face]; });
    std::vector<PieceId> behind = glued_before(guide_.surface(), *guide_.nets, steps_[index]);
    behind.insert(behind.end(), steps_[index].pieces.begin(), steps_[index].pieces.end());
    std::sort(behind.begin(), behind.end());
    double added = 0.0;
    for (const PieceId piece : steps_[index].pieces) {
      added += areas[piece.value()];
    }
    std::erase_if(behind, [&](PieceId piece) {
      return areas[piece.value()] > (is_new(index, piece) ? 0.0 : sliver_fraction * added);
    });
    return behind;
  }

  /// Where the longest seam that is glued in this step at a piece is seen, or would be.
  [[nodiscard]] Vec2 longest_seam_at(std::size_t index, PieceId piece, const Camera& camera) const {
    const mesh::Surface& surface = guide_.surface();
    double longest = -1.0;
    Vec2 middle;
    for (const JoinId join : steps_[index].joins) {
      const EdgeId edge = guide_.nets->joins[join].edge;
      const auto [c, d] = surface.sides(edge);
      const bool there =
          guide_.nets->piece[mesh::face_of(c)] == piece || guide_.nets->piece[mesh::face_of(d)] == piece;
      if (there && surface.length(edge) > longest) {
        longest = surface.length(edge);
        middle = 0.5 * (camera(surface.point(surface.vertex(c))) +
                        camera(surface.point(surface.vertex(mesh::next(c)))));
      }
    }
    return middle;
  }

  /// The number, the names and how the model is turned; returns where they end.
  double add_head(std::size_t index, const Box2& box, std::string_view turned, Group& group) const {
    const double number_height = grid_.number_height;
    const double name_height = 0.62 * number_height;
    group.lines.push_back(guide_rule({box.low.x, box.high.y}, box.high));
    const std::string number = std::to_string(index + 1);
    const Vec2 base{box.low.x, box.high.y - number_height - 2.2};
    group.texts.push_back(words_from(number, base, number_height, Weight::heading));
    const double left = base.x + text_width(number, number_height) + 0.8 * number_height;
    const double end = box.high.x - grid_.net_width;
    const std::string title = shortened(step_title(*guide_.nets, steps_[index]), end - left, name_height);
    group.texts.push_back(words_from(title, {left, base.y}, name_height, Weight::heading));
    const double after = left + text_width(title, name_height) + number_height;
    if (!turned.empty() && after + text_width(turned, grid_.words_height) < end) {
      group.texts.push_back(in_grey(words_from(turned, {after, base.y}, grid_.words_height)));
    }
    return base.y - 2.0;
  }

  /// At the foot of the cell; returns where they begin.
  double add_sentences(std::size_t index, const Box2& box, const StepScene& step,
                       const std::vector<PieceId>& behind, Group& group) const {
    const double height = grid_.words_height;
    std::vector<std::string> rows;
    std::vector<std::string> sentences =
        step_sentences(*guide_.model, *guide_.nets, *guide_.assembly, index, guide_.bodies);
    for (const MirrorPair& pair : mirror_pairs(*guide_.nets, steps_[index])) {
      if (std::string words = words_of_sides(guide_.surface(), *guide_.nets, pair, step.camera);
          !words.empty()) {
        sentences.insert(sentences.begin(), std::move(words));
      }
    }
    for (const bool added : {true, false}) {
      std::vector<std::string> names;
      for (const PieceId piece : behind) {
        if (is_new(index, piece) == added) {
          names.push_back(guide_.nets->pieces[piece].name);
        }
      }
      if (!names.empty()) {
        sentences.push_back(listed(names, "and") + (names.size() == 1 ? " is" : " are") +
                            " behind what is seen here" + (added ? ", in broken lines." : "."));
      }
    }
    for (const std::string& sentence : sentences) {
      const auto own = wrapped(sentence, box.size().x, height);
      rows.insert(rows.end(), own.begin(), own.end());
    }
    if (rows.size() > grid_.most_rows) {
      rows.resize(grid_.most_rows);
      const bool ended = rows[rows.size() - 2].ends_with('.');
      rows.back() = ended ? "And all other equal numbers." : "and all other equal numbers.";
    }
    double y = box.low.y + row_step_fraction * height * static_cast<double>(rows.size());
    const double top = y + 2.5;
    for (const std::string& row : rows) {
      y -= row_step_fraction * height;
      group.texts.push_back(words_from(row, {box.low.x, y + 0.4 * height}, height));
    }
    return top;
  }

  /// Those of a step whose nets are shown: one of those that are equal, both of mirror images.
  [[nodiscard]] std::vector<PieceId> nets_to_show(std::size_t index) const {
    std::vector<PieceId> shown;
    std::set<std::pair<std::size_t, bool>> kinds;
    for (const PieceId piece : steps_[index].pieces) {
      bool fresh = true;
      for (std::size_t kind = 0; kind < guide_.nets->equal.size(); ++kind) {
        for (const unfold::EqualPiece& equal : guide_.nets->equal[kind]) {
          fresh = fresh && (equal.piece != piece || kinds.insert({kind, equal.mirrored}).second);
        }
      }
      if (fresh && shown.size() < most_nets) {
        shown.push_back(piece);
      }
    }
    return shown;
  }

  /// Returns where it ends, its words included.
  double add_net(std::size_t index, const Box2& picture, Group& group) const {
    const std::vector<PieceId> shown = nets_to_show(index);
    const double caption = 0.8 * grid_.words_height;
    // The net begins as high as the step's number.
    const double top = picture.high.y + grid_.number_height + 1.0;
    const double gap = 1.5;
    const double name_row = shown.size() > 1 ? caption + gap : 0.0;
    const auto count = static_cast<double>(shown.size());
    const double height =
        std::min(1.2 * grid_.net_width, shown.size() == 1
                                            ? 0.5 * picture.size().y
                                            : (top - picture.low.y - caption - gap) / count - name_row - gap);
    const double left = picture.high.x - grid_.net_width;
    double below = top;  // of what stands there already
    for (std::size_t i = 0; i < shown.size(); ++i) {
      below -= i > 0 ? gap : 0.0;
      const Box2 frame{{left, below - height}, {picture.high.x, below}};
      const Box2 net = add_net_picture(guide_, shown[i], frame, group);
      group.figures.push_back({net, "The net of " + guide_.nets->pieces[shown[i]].name, group.texts.size()});
      below = net.low.y;
      if (shown.size() > 1) {
        below -= name_row;
        group.texts.push_back(in_grey(
            words_to(guide_.nets->pieces[shown[i]].name, {picture.high.x, below + 0.3 * gap}, caption)));
      }
    }
    std::vector<std::size_t> sheets;
    for (const PieceId other : steps_[index].pieces) {
      sheets.push_back(guide_.pages->placements[other].page.value() + 1);
    }
    std::sort(sheets.begin(), sheets.end());
    sheets.erase(std::unique(sheets.begin(), sheets.end()), sheets.end());
    std::string words = sheets.size() > 1 ? "sheets " : "sheet ";
    for (std::size_t i = 0; i < sheets.size(); ++i) {
      words += (i == 0 ? "" : ", ") + std::to_string(sheets[i]);
    }
    words = shortened(words, grid_.net_width, caption);
    const double base = below - caption - 1.2;
    group.texts.push_back(in_grey(words_to(words, {picture.high.x, base}, caption)));
    return base;
  }

  /// Between the names.
  [[nodiscard]] Box2 frame_in(std::size_t index, const Box2& box) const {
    const double column = column_beside(index);
    return {{box.low.x + column, box.low.y}, {box.high.x - column, box.high.y}};
  }

  /// What of the scene is drawn, if not all, and how.
  struct Placed {
    std::optional<Box2> part;
    Fit fit;
  };
  [[nodiscard]] Placed place_in(std::size_t index, const StepScene& step, const Box2& frame) const {
    const Box2 all = seen_box(step.scene, step.camera);
    const std::optional<Box2> part = surroundings_of_new(index, step, all, frame);
    return {part, fit_into(part ? *part : all, frame)};
  }

  /// The picture of a step.
  struct StepPicture {
    std::size_t index;
    const StepScene& step;
    const CoarseView& coarse;
    Box2 box;                            ///< for picture and names
    const std::vector<PieceId>& behind;  ///< pieces that nothing is seen of
    Box2 frame = {};                     ///< between the names
    Fit fit = {};
    std::optional<Box2> crop = {};  ///< nothing is drawn beyond it
  };

  void add_step_picture(StepPicture picture, Group& group, const Context& context) const {
    picture.frame = frame_in(picture.index, picture.box);
    const auto [part, fit] = place_in(picture.index, picture.step, picture.frame);
    picture.fit = fit;
    group.figures.push_back({picture.frame,
                             picture_words(guide_.surface(), *guide_.nets, steps_[picture.index]),
                             group.texts.size()});
    if (part) {
      const Box2 crop{fit(part->low), fit(part->high)};
      picture.crop = crop;
      Line edge{
          Layer::mark, {crop.low, {crop.high.x, crop.low.y}, crop.high, {crop.low.x, crop.high.y}}, true};
      edge.pen = guide_rule({}, {}).pen;
      group.lines.push_back(std::move(edge));
    }
    add_picture(
        {picture.step.scene, *guide_.nets, picture.step.camera, fit, picture.crop},
        [&](PieceId piece) -> const PieceLook& {
          return is_new(picture.index, piece) ? guide_.looks[piece] : guide_.pale;
        },
        group, context);
    add_hidden(picture, group, context);
    add_names(picture, group);
  }

  /// Of what is added, those that nothing is seen of, alone.
  [[nodiscard]] Scene hidden_alone(const StepPicture& picture) const {
    IdVector<PieceId, bool> hidden(guide_.nets->pieces.size(), false);
    for (const PieceId piece : picture.behind) {
      hidden[piece] = is_new(picture.index, piece);
    }
    return scene_with(picture.step.scene, *guide_.nets, hidden);
  }

  /// Their borders, over what lies before them.
  void add_hidden(const StepPicture& picture, Group& group, const Context& context) const {
    const Fit& fit = picture.fit;
    if (std::ranges::none_of(picture.behind, [&](PieceId piece) { return is_new(picture.index, piece); })) {
      return;
    }
    const View view = look_at(hidden_alone(picture), picture.step.camera, dash_gap_mm / fit.scale, context);
    for (const VisibleLine& line : view.lines) {
      if (!line.outline && guide_.nets->use[line.edge] == unfold::EdgeUse::fold) {
        continue;
      }
      std::optional<Segment2> seen = Segment2{fit(line.a), fit(line.b)};
      if (picture.crop) {
        seen = clipped(*seen, *picture.crop);
      }
      if (seen) {
        add_dashes(*seen, guide_.looks[steps_[picture.index].pieces.front()].outline, group);
      }
    }
  }

  static void add_dashes(const Segment2& line, const Pen& pen, Group& group) {
    const Vec2 whole = line.b - line.a;
    const double size = length(whole);
    const double count = std::max(1.0, std::round((size + dash_gap_mm) / (dash_mm + dash_gap_mm)));
    const double dash = (size - (count - 1.0) * dash_gap_mm) / count;
    for (double i = 0.0; i < count && dash > 0.0; i += 1.0) {
      const double from = i * (dash + dash_gap_mm) / size;
      Line drawn{Layer::picture, {line.a + from * whole, line.a + (from + dash / size) * whole}};
      drawn.pen = pen;
      group.lines.push_back(std::move(drawn));
    }
  }

  /// As wide as the names are that may stand beside the picture, and their lines.
  [[nodiscard]] double column_beside(std::size_t index) const {
    constexpr double line = 4.0;
    double width = 0.0;
    const auto widen = [&](PieceId piece, std::string_view around) {
      width = std::max(width, text_width(guide_.nets->pieces[piece].name + std::string(around),
                                         name_fraction * grid_.words_height));
    };
    for (const PieceId piece : steps_[index].pieces) {
      widen(piece, "");
    }
    for (const PieceId piece : glued_before(guide_.surface(), *guide_.nets, steps_[index])) {
      widen(piece, "()");
    }
    return std::min(width + line, grid_.column_width);
  }

  /// What is drawn of the scene where what is added is small in it: a box of the frame's shape.
  [[nodiscard]] std::optional<Box2> surroundings_of_new(std::size_t index, const StepScene& step,
                                                        const Box2& all, const Box2& frame) const {
    IdVector<PieceId, bool> added(guide_.nets->pieces.size(), false);
    for (const PieceId piece : steps_[index].pieces) {
      added[piece] = true;
    }
    const Box2 own = seen_box(scene_with(step.scene, *guide_.nets, added), step.camera);
    const double extent = std::max(own.size().x, own.size().y);
    if (own.empty() || extent >= small_fraction * std::max(all.size().x, all.size().y)) {
      return std::nullopt;
    }
    const Vec2 shape = frame.size() / std::max(frame.size().x, frame.size().y);
    const Vec2 size{std::max(surroundings * extent * shape.x, 1.2 * own.size().x),
                    std::max(surroundings * extent * shape.y, 1.2 * own.size().y)};
    // Not much of it is beyond what stands.
    const auto moved = [&](double at, double half, double low, double high) {
      const double beyond = 0.15 * extent;
      const double least = low - beyond + half;
      const double most = high + beyond - half;
      return least < most ? std::clamp(at, least, most) : 0.5 * (low + high);
    };
    const Vec2 own_middle = 0.5 * (own.low + own.high);
    const Vec2 middle{moved(own_middle.x, 0.5 * size.x, all.low.x, all.high.x),
                      moved(own_middle.y, 0.5 * size.y, all.low.y, all.high.y)};
    return Box2{middle - 0.5 * size, middle + 0.5 * size};
  }

  /// Those of what is added beside the picture, those of what it is glued to on their pieces, or beside it in
  /// brackets.
  void add_names(const StepPicture& picture, Group& group) const {
    const AssemblyStep& step = steps_[picture.index];
    const Fit& fit = picture.fit;
    const std::vector<Anchor> anchors =
        find_anchors(picture.coarse, guide_.piece_of_face, guide_.nets->pieces.size());
    const auto is_in_picture = [&, &crop = picture.crop](Vec2 p) {
      return !crop || (p.x > crop->low.x && p.x < crop->high.x && p.y > crop->low.y && p.y < crop->high.y);
    };
    const std::vector<Anchor> on_faces = find_anchors_on_faces(
        picture.coarse, picture.step.scene, guide_.piece_of_face, guide_.nets->pieces.size());
    std::optional<std::vector<Anchor>> alone;  // found when first needed
    std::vector<Callout> callouts;
    for (const PieceId piece : step.pieces) {
      const Anchor seen =
          anchor_to_point_at(on_faces[piece.value()], anchors[piece.value()], least_room_mm / fit.scale);
      if (!seen.seen && !alone) {
        alone = find_anchors(look_coarsely(hidden_alone(picture), picture.step.camera, name_pixels),
                             guide_.piece_of_face, guide_.nets->pieces.size());
      }
      const Anchor anchor = seen.seen ? seen : (*alone)[piece.value()];
      if (anchor.seen && is_in_picture(fit(anchor.at))) {
        callouts.push_back({guide_.nets->pieces[piece].name, fit(anchor.at)});
      }
    }
    const double height = 0.9 * grid_.words_height;
    for (const PieceId piece : glued_before(guide_.surface(), *guide_.nets, step)) {
      const Anchor& anchor = anchors[piece.value()];
      const std::string& name = guide_.nets->pieces[piece].name;
      const double needed = 0.5 * (height + text_width(name, height));
      const bool is_behind = std::ranges::binary_search(picture.behind, piece);
      const Vec2 at = fit(is_behind ? longest_seam_at(picture.index, piece, picture.step.camera) : anchor.at);
      if (!is_in_picture(at) || (!is_behind && !anchor.seen)) {
        continue;
      }
      if (!is_behind && fit.scale * anchor.room > needed) {
        group.texts.push_back(
            in_grey(words_from(name, at - 0.5 * Vec2{text_width(name, height), height}, height)));
      } else {
        callouts.push_back({"(" + name + ")", at});
      }
    }
    CalloutColumns columns{picture.box, picture.frame.low.x - 1.5, picture.frame.high.x + 1.5,
                           name_fraction * grid_.words_height};
    columns.box.high.y -= 1.0;
    add_callouts(callouts, columns, group);
  }

  const GuideModel& guide_;
  const std::vector<AssemblyStep>& steps_;
  StepGrid grid_{};
  std::vector<std::size_t> rows_of_page_;
  bool only_near_ = false;
};

}  // namespace

std::vector<Group> step_pages(const GuideModel& guide, const Context& context) {
  return StepPages(guide).make(context);
}

}  // namespace ridgecraft::export_
