// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report/net_figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "export/sheet/pieces.hpp"
#include "unfold/tabs/place/place_tabs.hpp"

namespace ridgecraft::cli {
namespace {

/// Why these pieces are pieces of their own.
Message message_of(unfold::PieceReason reason, std::size_t pieces, std::size_t max_faces) {
  std::vector<MessageValue> values{{"n", pieces}};
  if (reason == unfold::PieceReason::faces) {
    values.emplace_back("most", max_faces);
    values.push_back(option_value("option", "max-faces", ""));
  } else if (reason == unfold::PieceReason::folding) {
    values.push_back(option_value("option", "fold-linear", ""));
  }
  return Message(unfold::message_code(reason), std::move(values));
}

/// "3 too short, 1 no room": why joins have no tab.
std::string without_tab_text(const unfold::Nets& nets) {
  std::map<unfold::NoTab, std::size_t> reasons;
  for (const unfold::Join& join : nets.joins) {
    if (!join.tab.valid()) {
      ++reasons[join.no_tab];
    }
  }
  std::string text;
  for (const auto& [reason, count] : reasons) {
    const std::string number = reasons.size() == 1 ? "" : fmt::format("{}: ", count);
    text += fmt::format("{}{}{}", text.empty() ? "" : "; ", number,
                        english(Message("no_tab_" + std::string(unfold::name(reason)))));
  }
  return text;
}

double height_of(const unfold::Tab& tab) {
  const Vec2 base = tab.polygon[1] - tab.polygon[0];
  double highest = 0.0;
  for (const Vec2 p : tab.polygon) {
    highest = std::max(highest, std::abs(cross(base, p - tab.polygon[0])) / length(base));
  }
  return highest;
}

/// Where another height than the default was asked for: how many tabs are lower.
std::string lower_tabs_text(const unfold::Nets& nets, double asked_mm) {
  if (asked_mm == unfold::TabOptions().height_mm) {
    return {};
  }
  std::size_t lower = 0;
  double lowest = asked_mm;
  for (const unfold::Tab& tab : nets.tabs) {
    const double height = height_of(tab);
    lower += height < 0.99 * asked_mm ? 1U : 0U;
    lowest = std::min(lowest, height);
  }
  return lower == 0 ? ""
                    : fmt::format(
                          "; {} lower than {:g} mm, down to {:.1f} mm, as their edges and the faces "
                          "behind them allow",
                          lower == nets.tabs.size() ? "all" : std::to_string(lower), asked_mm, lowest);
}

template <class Holds>
std::size_t count_joins(const unfold::Nets& nets, Holds holds) {
  return static_cast<std::size_t>(std::count_if(nets.joins.begin(), nets.joins.end(), holds));
}

Value numbers_value(const std::vector<export_::DrawReport::Number>& numbers) {
  Value list(Value::List{});
  for (const auto& [piece, number] : numbers) {
    list.add(Value::Object{{"piece", piece}, {"number", number}});
  }
  return list;
}

/// ": A 1, 2; B 7 and 3 more"
std::string numbers_text(std::vector<export_::DrawReport::Number> lost) {
  constexpr std::size_t most = 10;
  std::sort(lost.begin(), lost.end());
  std::string text;
  for (std::size_t i = 0; i < std::min(most, lost.size()); ++i) {
    const bool same_piece = i > 0 && lost[i].piece == lost[i - 1].piece;
    text += same_piece ? ", " : (i == 0 ? ": " : "; ") + lost[i].piece + " ";
    text += std::to_string(lost[i].number);
  }
  return text + (lost.size() > most ? fmt::format(" and {} more", lost.size() - most) : "");
}

/// The pieces that a body is glued onto, each once, ascending.
std::vector<PieceId> below(const export_::Body& body) {
  std::vector<PieceId> pieces;
  for (const auto& [piece, other] : body.glued_onto) {
    pieces.push_back(other);
  }
  std::ranges::sort(pieces);
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  return pieces;
}

/// "3 that no tab joins: 1 A to C; 2 D on B; 3 E at B"
std::string bodies_text(const unfold::Nets& nets, const std::vector<export_::Body>& bodies) {
  constexpr std::size_t most = 8;
  if (bodies.empty()) {
    return {};
  }
  std::string text = fmt::format("{} that no tab joins: ", bodies.size());
  for (std::size_t i = 0; i < std::min(most, bodies.size()); ++i) {
    text += fmt::format("{}{} {}", i == 0 ? "" : "; ", i + 1, piece_names(nets, bodies[i].pieces));
    if (!bodies[i].glued_onto.empty()) {
      text += " on " + piece_names(nets, below(bodies[i]));
    } else if (bodies[i].beside.valid() && i > 0) {
      text += " at " + nets.pieces[bodies[i].beside].name;
    }
  }
  return text + (bodies.size() > most ? fmt::format("; {} more", bodies.size() - most) : "");
}

}  // namespace

std::vector<PieceId> pieces_with_care(const unfold::Nets& nets) {
  std::vector<PieceId> found;
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    if (nets.pieces[p].folding.way == unfold::FoldWay::with_care) {
      found.push_back(p);
    }
  }
  return found;
}

std::string piece_names(const unfold::Nets& nets, const std::vector<PieceId>& pieces) {
  constexpr std::size_t most = 6;  // before the rest is only counted
  const auto name = [&](PieceId p) { return nets.pieces[p].name; };
  const bool in_a_row = pieces.back().value() - pieces.front().value() + 1 == pieces.size();
  if (in_a_row && pieces.size() > 2) {
    return name(pieces.front()) + " to " + name(pieces.back());
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(pieces.size(), most); ++i) {
    text += (i == 0 ? "" : ", ") + name(pieces[i]);
  }
  return pieces.size() <= most ? text : text + " and " + std::to_string(pieces.size() - most) + " more";
}

std::string pieces_text(const unfold::Nets& nets, const std::vector<PieceId>& pieces) {
  if (pieces.size() == 2) {
    return "pieces " + nets.pieces[pieces[0]].name + " and " + nets.pieces[pieces[1]].name;
  }
  return (pieces.size() == 1 ? "piece " : "pieces ") + piece_names(nets, pieces);
}

std::string reasons_text(const unfold::Nets& nets) {
  std::map<std::string, std::size_t> reasons;
  for (const unfold::Piece& piece : nets.pieces) {
    if (piece.reason != unfold::PieceReason::part) {
      ++reasons[std::string(unfold::name(piece.reason))];
    }
  }
  std::string text;
  for (const auto& [reason, count] : reasons) {
    text += fmt::format("{}{} because of {}", text.empty() ? " (" : ", ", count, reason);
  }
  return text.empty() ? text : text + ")";
}

void add_extra_pieces(Summary& summary, const unfold::Nets& nets, std::size_t max_faces) {
  std::map<unfold::PieceReason, std::vector<PieceId>> extra;
  Value list(Value::List{});
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    const unfold::Piece& piece = nets.pieces[p];
    if (piece.reason != unfold::PieceReason::part) {
      extra[piece.reason].push_back(p);
      list.add(Value::Object{{"name", piece.name},
                             {"reason", unfold::name(piece.reason)},
                             {"why", value_of(message_of(piece.reason, 1, max_faces))}});
    }
  }
  summary.add("extra_pieces", std::move(list));
  for (const auto& [reason, pieces] : extra) {
    summary.say(Line::pieces, pieces.size() == 1 ? "piece" : "pieces",
                piece_names(nets, pieces) + ": " + english(message_of(reason, pieces.size(), max_faces)));
  }
}

void add_equal_pieces(Summary& summary, const unfold::Nets& nets,
                      const std::vector<export_::PieceKind>& kinds) {
  constexpr std::size_t most_kinds = 8;
  constexpr std::size_t most_names = 8;
  Value list(Value::List{});
  std::string text;
  const auto names = [&](const std::vector<PieceId>& pieces) {
    Value all(Value::List{});
    for (const PieceId piece : pieces) {
      all.add(nets.pieces[piece].name);
    }
    return all;
  };
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const export_::PieceKind& kind = kinds[i];
    list.add(Value::Object{{"count", kind.count()},
                           {"of", kind.name.empty() ? Value() : Value(kind.name)},
                           {"pieces", names(kind.pieces)},
                           {"mirrored", names(kind.mirrored)},
                           {"tabs_differ", kind.tabs_differ}});
    if (i < most_kinds) {
      text += (i == 0 ? "" : "; ") + export_::kind_words(nets, kind, most_names);
    }
  }
  if (kinds.size() > most_kinds) {
    text += "; " + counted(kinds.size() - most_kinds, "more kind");
  }
  summary.add("equal_pieces", std::move(list), Line::equal, "equal", std::move(text));
}

TabFigures tab_figures(const mesh::Surface& surface, const unfold::Nets& nets,
                       const unfold::TabOptions& options) {
  const auto all = ids<TabId>(nets.tabs.size());
  const auto additional = static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [&](TabId t) { return unfold::is_additional(nets, t); }));
  return {nets.tabs.size() - additional,
          additional,
          unfold::tabs_usable(surface, nets, options),
          count_joins(nets, [](const unfold::Join& join) { return !join.tab.valid(); }),
          count_joins(nets, [](const unfold::Join& join) { return join.too_narrow; }),
          count_joins(nets, [&](const unfold::Join& join) {
            return join.tab.valid() && nets.tabs[join.tab].slit.has_value();
          })};
}

GlueFigures glue_figures(const mesh::Surface& surface, const unfold::Nets& nets,
                         const unfold::TabOptions& options) {
  GlueFigures glue;
  for (const unfold::Join& join : nets.joins) {
    const double mm = surface.length(join.edge);
    glue.all_mm += mm;
    if (!join.tab.valid()) {
      glue.without_tab_mm += mm;
    } else if (!unfold::is_usable(surface, nets, join.tab, options)) {
      glue.weak_mm += mm;
    }
  }
  return glue;
}

std::string tabs_text(const TabFigures& figures, const unfold::Nets& nets,
                      const unfold::TabOptions& options) {
  return fmt::format(
      "{} for {}{}{}{}{}{}", figures.tabs, counted(nets.joins.size(), "join"),
      figures.additional == 0 ? ""
      : figures.slots > 0     ? fmt::format(" and {} more (on long edges and at borders)", figures.additional)
                              : fmt::format(" and {} more (second ones and at borders)", figures.additional),
      figures.slots > 0 ? fmt::format(", {} of them put into slits, the others glued", figures.slots) : "",
      figures.usable < figures.tabs
          ? fmt::format(", {} of them usable (the others are smaller than holds well)", figures.usable)
          : "",
      lower_tabs_text(nets, options.height_mm),
      figures.without > 0 ? fmt::format("; {} without ({})", figures.without, without_tab_text(nets)) : "");
}

Value index_value(const mesh::Surface& surface, const unfold::Nets& nets, const export_::Pages& pages,
                  const export_::DrawReport& drawn) {
  const auto neighbours = export_::find_neighbours(surface, nets);
  Value list(Value::List{});
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    Value joins(Value::List{});
    for (const export_::Neighbour& neighbour : neighbours[p]) {
      joins.add(Value::Object{{"piece", nets.pieces[neighbour.piece].name},
                              {"numbers", Value::List(neighbour.numbers.begin(), neighbour.numbers.end())}});
    }
    list.add(Value::Object{{"piece", nets.pieces[p].name},
                           {"page", pages.placements[p].page.value() + 1},
                           {"object", p.value() < drawn.objects.size() ? drawn.objects[p] : std::string()},
                           {"joins", std::move(joins)}});
  }
  return list;
}

void add_numbers(Summary& summary, const export_::DrawReport& drawn) {
  const std::size_t listed = drawn.labels_listed.size();
  const std::size_t lost = drawn.labels_left_out.size();
  std::vector<std::string> facts;
  if (drawn.labels_outside > 0) {
    facts.push_back(fmt::format("{} next to their piece", drawn.labels_outside));
  }
  if (listed > 0) {
    facts.push_back(fmt::format("{} in lists{}", listed, numbers_text(drawn.labels_listed)));
  }
  if (lost > 0) {
    facts.push_back(fmt::format("{} left out: this paper is too small for lists{}", lost,
                                numbers_text(drawn.labels_left_out)));
  }
  if (drawn.names_left_out > 0) {
    facts.push_back(counted(drawn.names_left_out, "name") + " without a place");
  }
  summary.add("labels_left_out", lost, Line::numbers, "numbers", fmt::format("{}", fmt::join(facts, "; ")));
  summary.add("labels_listed", listed);
  summary.add("numbers_in_lists", numbers_value(drawn.labels_listed));
  summary.add("list_pages", drawn.list_pages);
  summary.add("labels_outside", drawn.labels_outside);
  summary.add("names_left_out", drawn.names_left_out);
}

void add_folding(Summary& summary, const unfold::Nets& nets) {
  const std::vector<PieceId> pieces = pieces_with_care(nets);
  Value list(Value::List{});
  for (const PieceId p : pieces) {
    list.add(nets.pieces[p].name);
  }
  std::string sentence;
  for (const PieceId p : pieces) {
    const auto& faces = nets.pieces[p].folding.in_the_way;
    sentence +=
        (sentence.empty() ? "" : "; ") + nets.pieces[p].name +
        (faces ? fmt::format(" (faces {} and {} of the FOLD file)", (*faces)[0].value(), (*faces)[1].value())
               : std::string());
  }
  summary.add("pieces_to_fold_with_care", std::move(list), Line::folding, "folding",
              pieces.empty() ? ""
                             : "no order was found in which no face is in another's way, so some have to be "
                               "bent aside a little: " +
                                   sentence);
}

bool has_colours(const mesh::Model& model) {
  return std::any_of(model.materials.begin(), model.materials.end(), [](const mesh::Material& m) {
    return m.has_picture() || (m.colour && *m.colour != mesh::Colour{1.0, 1.0, 1.0});
  });
}

void say_colours(Summary& summary, const job::Result& made) {
  if (made.prepared.look) {
    summary.say(Line::colours, "colours",
                "of the model are printed; --ink pale saves ink, --ink lines leaves them out");
  } else if (made.options.style.ink == export_::Ink::lines && has_colours(made.prepared.model)) {
    summary.say(Line::colours, "colours", "of the model aren't printed: pages show lines only");
  }
}

void say_lost_edges(Summary& summary, const job::Result& made) {
  if (!made.prepared.lost_edges.empty()) {
    summary.say(Line::lost_edges, "small edges",
                "that its folds don't show are printed as thin grey lines; --details none leaves them out");
  }
}

void add_bodies(Summary& summary, const unfold::Nets& nets, const std::vector<export_::Body>& bodies) {
  Value list(Value::List{});
  for (const export_::Body& body : bodies) {
    Value pieces(Value::List{});
    for (const PieceId piece : body.pieces) {
      pieces.add(nets.pieces[piece].name);
    }
    Value item(Value::Object{{"pieces", std::move(pieces)}});
    if (body.beside.valid()) {
      item.set("beside", nets.pieces[body.beside].name);
      item.set("distance_mm", rounded(body.distance_mm));
    }
    if (!body.glued_onto.empty()) {
      Value onto(Value::List{});
      for (const PieceId piece : below(body)) {
        onto.add(nets.pieces[piece].name);
      }
      item.set("glued_onto", std::move(onto));
    }
    list.add(std::move(item));
  }
  summary.add("bodies", std::move(list), Line::bodies, "bodies", bodies_text(nets, bodies));
}

}  // namespace ridgecraft::cli
