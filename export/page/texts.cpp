// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/page/texts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "base/elementary.hpp"
#include "export/page/glue_outlines.hpp"
#include "export/page/numbers.hpp"
#include "export/page/obstacles.hpp"
#include "export/page/roll_marks.hpp"
#include "export/page/seam_marks.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

constexpr std::array<double, 7> heights{5.0, 4.2, 3.5, 2.9, 2.4, 2.0, 1.6};
/// A name inside smaller than this is worse than one beside the piece, if there is room, mm.
constexpr double readable_height = 2.0;
/// Names stand parallel to the page down to this height before they are turned, mm.
constexpr double level_height = 2.9;
/// Directions for names, in this order: parallel to the page, upwards, slanting.
constexpr std::array<double, 6> angles{0.0, 90.0, 45.0, -45.0, 22.5, -22.5};
constexpr double note_height = 1.9;  ///< of the words below a name, mm
constexpr double note_gap = 1.1;     ///< from the line under the name to the words, mm
constexpr double clearance = 0.5;    ///< mm
/// Distances from lines are measured up to this, mm.
constexpr double widest_room = 8.0;
/// How much more room than needed is looked for around a name, mm.
constexpr std::array<double, 13> rooms{0.0, 0.4, 0.8, 1.4, 2.2, 3.2, 4.5, 6.5, 9.0, 13.0, 18.0, 26.0, 38.0};

/// Points of a grid that lie in faces of the piece. Its step follows the piece's size.
std::vector<Vec2> grid_points(const PieceDrawing& piece) {
  Box2 bounds;
  for (const auto& face : piece.faces) {
    for (const Vec2 p : face) {
      bounds.add(p);
    }
  }
  constexpr double points_wanted = 1600.0;
  const double step = std::clamp(std::sqrt(bounds.size().x * bounds.size().y / points_wanted), 0.5, 4.0);
  const auto columns = static_cast<std::size_t>(bounds.size().x / step) + 1;
  const auto rows = static_cast<std::size_t>(bounds.size().y / step) + 1;
  std::vector<bool> covered(columns * rows, false);
  const auto at = [&](std::size_t column, std::size_t row) {
    return bounds.low +
           Vec2{(static_cast<double>(column) + 0.5) * step, (static_cast<double>(row) + 0.5) * step};
  };
  for (const auto& face : piece.faces) {
    Box2 box;
    for (const Vec2 p : face) {
      box.add(p);
    }
    const auto first = [&](double low, double origin) {
      return static_cast<std::size_t>(std::max(0.0, (low - origin) / step - 0.5));
    };
    for (std::size_t row = first(box.low.y, bounds.low.y); row < rows && at(0, row).y <= box.high.y; ++row) {
      for (std::size_t column = first(box.low.x, bounds.low.x);
           column < columns && at(column, 0).x <= box.high.x; ++column) {
        const Vec2 p = at(column, row);
        if (contains(face, p)) {
          covered[row * columns + column] = true;
        }
      }
    }
  }
  std::vector<Vec2> points;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      if (covered[row * columns + column]) {
        points.push_back(at(column, row));
      }
    }
  }
  return points;
}

/// A name of this height with the first of its notes below it, the middle of the name at the origin.
std::vector<Text> label(const PieceDrawing& piece, double height, double degrees, std::size_t notes) {
  const double angle = degrees * std::numbers::pi / 180.0;
  // The line under a name tells which side is up: N and Z, M and W, H and I lie on the table in all turns.
  std::vector<Text> texts{{Layer::piece_name, piece.name, {}, height, angle, true}};
  const Vec2 down{elementary::sin(angle), -elementary::cos(angle)};
  double at = (0.5 + underline_drop) * height + note_gap;
  for (std::size_t i = 0; i < notes; ++i) {
    texts.push_back(
        {Layer::piece_name, piece.notes[i], (at + 0.5 * note_height) * down, note_height, angle, false});
    at += note_height + note_gap;
  }
  return texts;
}

std::vector<Text> moved(std::vector<Text> texts, Vec2 by) {
  for (Text& text : texts) {
    text.centre += by;
  }
  return texts;
}

void put(PieceDrawing& piece, Obstacles& obstacles, const std::vector<Text>& texts) {
  for (const Text& text : texts) {
    obstacles.add(text);
    piece.group.texts.push_back(text);
  }
}

/// A point of the piece and the distance of the nearest line.
struct Site {
  Vec2 at;
  double room;
};

/// The points of the piece, those with most room first: where the first ones have much, the others needn't be
/// looked at.
std::vector<Site> sites_of(const PieceDrawing& piece, const Obstacles& obstacles) {
  std::vector<Site> sites;
  for (const Vec2 p : grid_points(piece)) {
    sites.push_back({p, obstacles.distance_to_lines(p, widest_room)});
  }
  std::ranges::stable_sort(sites, std::ranges::greater{}, &Site::room);
  return sites;
}

/// The site around which the texts have most room. All of them lie on the piece: a note below a name that
/// stands at an edge would have room beyond that edge, too, on another piece's paper or on none.
std::optional<Vec2> roomiest(const PieceDrawing& piece, const std::vector<Site>& sites,
                             const std::vector<Text>& texts, const Obstacles& obstacles) {
  const TurnedBox name = box_of(texts.front());
  const double needed = std::min(name.half_width, 0.5 * texts.front().height) + clearance;
  std::optional<Vec2> best;
  std::size_t room = 0;
  for (const Site& site : sites) {
    if (room == rooms.size() || site.room < std::min(widest_room, needed + rooms[room])) {
      break;
    }
    const std::vector<Text> here = moved(texts, site.at);
    const auto fits = [&] {
      return std::ranges::all_of(
          here, [&](const Text& text) { return obstacles.is_free(text, clearance, rooms[room]); });
    };
    const auto notes_lie_here = [&] {
      return std::all_of(here.begin() + 1, here.end(),
                         [&](const Text& note) { return lies_on(piece, note.centre); });
    };
    if (!fits() || !notes_lie_here()) {
      continue;
    }
    while (room < rooms.size() && fits()) {
      ++room;
      best = site.at;
    }
  }
  return best;
}

/// How a name may stand.
struct NameForm {
  double smallest = 0.0;  ///< height, mm
  std::size_t notes = 0;  ///< so many of the piece's notes stand below it
  std::span<const double> directions = angles;
};

bool place_inside(PieceDrawing& piece, Obstacles& obstacles, const std::vector<Site>& sites,
                  const NameForm& form) {
  // Parallel to the page first, unless that would make the name small.
  for (const bool level : {true, false}) {
    for (const double height : heights) {
      if (height < form.smallest || (level && height < level_height)) {
        break;
      }
      for (const double angle : form.directions) {
        if (level && angle != 0.0) {
          break;
        }
        const std::vector<Text> texts = label(piece, height, angle, form.notes);
        if (const auto centre = roomiest(piece, sites, texts, obstacles)) {
          put(piece, obstacles, moved(texts, *centre));
          return true;
        }
      }
    }
  }
  return false;
}

/// The longest sides of closed outlines, at most `most`.
std::vector<Segment2> longest_edges(const std::vector<std::vector<Vec2>>& outlines, std::size_t most) {
  std::vector<Segment2> edges;
  for (const std::vector<Vec2>& outline : outlines) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      edges.push_back({outline[i], outline[(i + 1) % outline.size()]});
    }
  }
  std::ranges::stable_sort(edges, std::ranges::greater{},
                           [](const Segment2& s) { return length(s.b - s.a); });
  edges.resize(std::min(edges.size(), most));
  return edges;
}

/// Edges from which a line may lead to a name beside the piece: those without a tab first, then the longest
/// lines of the outline, the piece on their left.
std::vector<Segment2> leader_edges(const PieceDrawing& piece) {
  constexpr std::size_t most = 12;
  std::vector<Segment2> edges;
  for (const Seam& seam : piece.seams) {
    if (seam.tab.empty()) {
      edges.push_back(seam.edge);
    }
  }
  std::vector<std::vector<Vec2>> loops;
  for (const Line& line : piece.group.lines) {
    if (line.layer == Layer::cut && line.closed) {
      loops.push_back(line.points);
    }
  }
  const std::vector<Segment2> outline = longest_edges(loops, most);
  edges.insert(edges.end(), outline.begin(), outline.end());
  return edges;
}

Box2 bounds_of(const std::vector<Text>& texts) {
  Box2 bounds;
  for (const Text& text : texts) {
    const Box2 own = box_of(text).grown(clearance).bounds();
    bounds.add(own.low);
    bounds.add(own.high);
  }
  return bounds;
}

/// Texts beside an edge, with a leader to it.
bool place_beside(PieceDrawing& piece, Obstacles& obstacles, const Box2& area, const Segment2& edge,
                  const std::vector<Text>& texts) {
  const Vec2 middle = 0.5 * (edge.a + edge.b);
  const double size = length(edge.b - edge.a);
  if (!(size > 0.0)) {
    return false;
  }
  const Vec2 along = (edge.b - edge.a) / size;
  const Vec2 out = -perpendicular(along);
  const Box2 at_origin = bounds_of(texts);
  const Vec2 to_middle = -0.5 * (at_origin.low + at_origin.high);
  for (double reach = 3.0; reach < 16.0; reach += 1.0) {
    for (const double turn : {0.0, 0.4, -0.4, 0.75, -0.75}) {
      const Vec2 centre = middle + reach * (elementary::cos(turn) * out + elementary::sin(turn) * along);
      const std::vector<Text> here = moved(texts, centre + to_middle);
      const Box2 box = bounds_of(here);
      const Vec2 tip{std::clamp(middle.x, box.low.x, box.high.x),
                     std::clamp(middle.y, box.low.y, box.high.y)};
      const Segment2 leader{middle + off_the_edge_mm * out, tip};
      if (lies_within(box, area) &&
          std::ranges::all_of(here, [&](const Text& text) { return obstacles.is_free(text, clearance); }) &&
          obstacles.is_free(leader, true) && can_lead(leader, out, obstacles)) {
        put(piece, obstacles, here);
        draw_leader(leader, piece, obstacles);
        return true;
      }
    }
  }
  return false;
}

constexpr double spot_name_height = 2.5;  ///< of a name beside its outline, mm

/// Places inside the outlines, those near their middle first.
std::vector<Vec2> places_in(const std::vector<std::vector<Vec2>>& outlines) {
  constexpr int steps = 14;  // of a grid in their box, each way
  const Box2 box = box_of(outlines);
  const Vec2 middle = 0.5 * (box.low + box.high);
  std::vector<Vec2> places;
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= steps; ++k) {
      const Vec2 p = box.low + Vec2{box.size().x * i / steps, box.size().y * k / steps};
      if (inside(outlines, p)) {
        places.push_back(p);
      }
    }
  }
  std::ranges::stable_sort(places, {}, [&](Vec2 p) { return length(p - middle); });
  return places;
}

/// The name of what is glued on, in its outline, or beside it with a leader.
bool place_glue_name(PieceDrawing& piece, const GlueMark& spot, Obstacles& obstacles, const Box2& area) {
  const std::vector<Vec2> places = places_in(spot.outlines);
  // As with names of pieces, the line below tells which side is up.
  Text text{Layer::glue, spot.name, {}, 0.0, 0.0, true};
  for (const double height : {5.0, 3.5, 2.9, 2.4, 2.0, 1.6}) {
    text.height = height;
    for (const Vec2 place : places) {
      text.centre = place;
      if (lies_within(box_of(text).bounds(), area) && obstacles.is_free(text, clearance)) {
        put(piece, obstacles, {text});
        return true;
      }
    }
  }
  text.height = spot_name_height;
  text.centre = {};
  return std::ranges::any_of(longest_edges(spot.outlines, 8), [&](const Segment2& edge) {
    return place_beside(piece, obstacles, area, edge, {text});
  });
}

}  // namespace

bool place_name(PieceDrawing& piece, Obstacles& obstacles, const Box2& area, bool hurried) {
  const std::vector<Site> sites = sites_of(piece, obstacles);
  const std::size_t notes = piece.notes.size();
  if (hurried) {
    const auto level = std::span(angles).first(1);
    return place_inside(piece, obstacles, sites, {0.0, notes, level}) ||
           (notes > 0 && place_inside(piece, obstacles, sites, {0.0, 0, level}));
  }
  if (place_inside(piece, obstacles, sites, {readable_height, notes})) {
    return true;
  }
  // Numbers tell where a piece belongs; a piece without any has nothing but its notes.
  for (std::size_t fewer = notes; fewer-- > 0 && !piece.seams.empty();) {
    if (place_inside(piece, obstacles, sites, {readable_height, fewer})) {
      return true;
    }
  }
  const std::vector<Text> texts = label(piece, 3.0, 0.0, notes);
  for (const Segment2& edge : leader_edges(piece)) {
    if (place_beside(piece, obstacles, area, edge, texts)) {
      return true;
    }
  }
  return place_inside(piece, obstacles, sites, {0.0, notes}) ||
         (notes > 0 && place_inside(piece, obstacles, sites, {0.0, 0}));
}

namespace {

/// The places, best first: each is tried for all numbers that have none yet, before the next one. These come
/// first where numbers are wanted beside the pieces.
constexpr std::array beside_pieces{NumberPlace::beside_piece, NumberPlace::leader_outside};
/// These where names of pieces have no place yet.
constexpr std::array before_names{NumberPlace::at_edge};
constexpr std::array after_names{NumberPlace::further_inside};
constexpr std::array with_leaders{NumberPlace::leader_inside, NumberPlace::leader_outside};

/// Whether the number can be left out (closes_by_itself()).
bool needs_none(const Wanted& wanted) {
  const PieceDrawing& piece = *wanted.piece;
  return std::ranges::all_of(wanted.seams, [&](const Seam* seam) {
    const auto own = static_cast<std::size_t>(seam - piece.seams.data());
    return std::ranges::any_of(piece.rims, [&](const std::vector<std::size_t>& rim) {
      const auto at = std::ranges::find(rim, own);
      return at != rim.end() && closes_by_itself(piece, rim, static_cast<std::size_t>(at - rim.begin()));
    });
  });
}

double length_of(const Seam* seam) {
  return length(seam->edge.b - seam->edge.a);
}

class TextPlacer {
 public:
  TextPlacer(std::vector<PieceDrawing>& pieces, const Paper& paper, const Style& style,
             const Context& context)
      : pieces_(pieces),
        area_(piece_box(paper)),
        style_(style),
        context_(context),
        placer_(paper.size, area_, style) {
    for (const PieceDrawing& piece : pieces) {
      placer_.add_lines(piece);
    }
  }

  void place(DrawReport& report) {
    for (PieceDrawing& piece : pieces_) {
      for (GlueMark& spot : piece.spots) {
        spot.named = place_glue_name(piece, spot, placer_.obstacles(), area_);
      }
    }
    place_on_tabs();
    if (is_outside()) {
      try_places(beside_pieces);
    }
    try_places(before_names);
    place_names(report);
    for (PieceDrawing& piece : pieces_) {
      place_roll_words(piece, placer_.obstacles());
    }
    try_places(after_names);
    std::ranges::stable_partition(wanted_, [](const Wanted& w) { return !needs_none(w); });
    try_places(with_leaders);
    report.labels_outside += is_outside() ? 0 : led_outside_;
    placer_.name_partners();
    note_places();
  }

 private:
  [[nodiscard]] bool is_outside() const {
    return style_.numbers == Numbers::tabs || style_.numbers == Numbers::outside;
  }
  [[nodiscard]] bool in_time() const { return !context_.out_of_grace(); }

  /// Numbers on tabs; which ones are wanted on the pieces, those of short edges first, since these have the
  /// least choice.
  void place_on_tabs() {
    for (PieceDrawing& piece : pieces_) {
      for (const NumberedRow& row : numbered_rows(piece)) {
        Wanted wanted{&piece, row.side, {}};
        for (const std::size_t seam : row.seams) {
          wanted.seams.push_back(&piece.seams[seam]);
        }
        std::ranges::stable_sort(wanted.seams, std::ranges::greater{}, length_of);
        const auto on_tab = [&](const Seam* seam) {
          return !seam->tab.empty() && placer_.place_on_tab(piece, *seam);
        };
        if (style_.numbers != Numbers::outside && std::ranges::any_of(wanted.seams, on_tab)) {
          has_number_.insert({&piece, row.side});
        } else {
          wanted_.push_back(std::move(wanted));
        }
      }
    }
    std::ranges::stable_sort(wanted_, {}, [](const Wanted& w) { return length_of(w.seams.front()); });
  }

  void try_places(std::span<const NumberPlace> places) {
    for (const NumberPlace place : places) {
      const bool quick = place == NumberPlace::at_edge || place == NumberPlace::beside_piece;
      const std::size_t placed = std::erase_if(wanted_, [&](const Wanted& w) {
        const bool found = (quick || in_time()) && placer_.place(w, place);
        if (found) {
          has_number_.insert({w.piece, w.side});
        }
        return found;
      });
      led_outside_ += place == NumberPlace::leader_outside ? placed : 0;
    }
  }

  void place_names(DrawReport& report) {
    for (PieceDrawing& piece : pieces_) {
      if (!place_name(piece, placer_.obstacles(), area_, !in_time())) {
        ++report.names_left_out;
      }
    }
  }

  /// Where a chain has its number once on a side, that is enough.
  void note_places() {
    for (PieceDrawing& piece : pieces_) {
      for (std::size_t side = 0; side < piece.sides.size(); ++side) {
        const bool has_number = has_number_.contains({&piece, side});
        for (const std::size_t seam : piece.sides[side]) {
          piece.seams[seam].at = has_number ? NumberAt::edge : NumberAt::list;
        }
      }
    }
    std::ranges::for_each(pieces_, leave_out_closing);
  }

  std::vector<PieceDrawing>& pieces_;
  Box2 area_;
  const Style& style_;
  const Context& context_;
  NumberPlacer placer_;
  std::vector<Wanted> wanted_;                                        ///< without a place on their piece
  std::set<std::pair<const PieceDrawing*, std::size_t>> has_number_;  ///< sides of pieces that have theirs
  std::size_t led_outside_ = 0;
};

}  // namespace

void place_texts(std::vector<PieceDrawing>& pieces, const Paper& paper, const Style& style,
                 DrawReport& report, const Context& context) {
  TextPlacer(pieces, paper, style, context).place(report);
}

}  // namespace ridgecraft::export_
