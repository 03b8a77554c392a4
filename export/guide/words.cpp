// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/text.hpp"
#include "export/sheet/pieces.hpp"
#include "export/sheet/rolled.hpp"
#include "export/style/stroke_font.hpp"

namespace ridgecraft::export_ {
namespace {

Text words_at(std::string_view words, Vec2 left, double height, Weight weight) {
  Text text;
  text.layer = weight == Weight::plain ? Layer::mark : Layer::piece_name;
  text.heading = weight == Weight::title ? 1 : weight == Weight::heading ? 2 : 0;
  text.text = words;
  text.centre = left + Vec2{0.5 * text_width(words, height), 0.5 * height};
  text.height = height;
  return text;
}

}  // namespace

Text words_from(std::string_view words, Vec2 at, double height, Weight weight) {
  return words_at(words, at, height, weight);
}

Text words_to(std::string_view words, Vec2 at, double height, Weight weight) {
  return words_at(words, at - Vec2{text_width(words, height), 0.0}, height, weight);
}

namespace {

constexpr double row_fraction = 1.55;   ///< distance of rows, of the height of the words
constexpr double word_clearance = 1.0;  ///< between words and their line, mm
constexpr Pen leader_pen{0.1, {0x55, 0x55, 0x55}};
constexpr double dot_radius = 0.45;  ///< mm
constexpr int dot_corners = 12;

/// Names of one column.
struct Column {
  std::vector<Callout> callouts;
  bool left = true;
};

bool leaders_cross(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto side = [](Vec2 p, Vec2 q, Vec2 r) { return cross(q - p, r - p); };
  return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

/// Heights of rows, lowest first, each as near to what it wants as its neighbours allow (pools of rows that
/// touch keep the middle of what they want).
std::vector<double> spread(const std::vector<double>& wanted, double step, double low, double high) {
  struct Pool {
    double sum = 0.0;  ///< of what the rows want, each less its place in the pool
    std::size_t count = 0;
    [[nodiscard]] double first() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (const double want : wanted) {
    pools.push_back({want, 1});
    while (pools.size() > 1) {
      Pool& below = pools[pools.size() - 2];
      const Pool& above = pools.back();
      const double shift = step * static_cast<double>(below.count);
      if (below.first() + shift <= above.first()) {
        break;
      }
      below.sum += above.sum - shift * static_cast<double>(above.count);
      below.count += above.count;
      pools.pop_back();
    }
  }
  std::vector<double> heights;
  for (const Pool& pool : pools) {
    for (std::size_t i = 0; i < pool.count; ++i) {
      heights.push_back(pool.first() + step * static_cast<double>(i));
    }
  }
  // Rows beyond the ends are pushed back.
  for (std::size_t i = 0; i < heights.size(); ++i) {
    heights[i] = std::max(heights[i], low + step * static_cast<double>(i));
  }
  for (std::size_t i = heights.size(); i-- > 0;) {
    heights[i] = std::min(heights[i], high - step * static_cast<double>(heights.size() - 1 - i));
  }
  return heights;
}

void add_dot(Vec2 at, Group& group) {
  Area dot{Layer::picture, {}, leader_pen.color};
  for (int k = 0; k < dot_corners; ++k) {
    const double angle = 2.0 * 3.14159265358979323846 * k / dot_corners;
    dot.outline.push_back(at + dot_radius * Vec2{elementary::cos(angle), elementary::sin(angle)});
  }
  group.areas.push_back(std::move(dot));
}

void add_column(Column column, const CalloutColumns& columns, Group& group) {
  std::vector<Callout>& callouts = column.callouts;
  std::stable_sort(callouts.begin(), callouts.end(),
                   [](const Callout& a, const Callout& b) { return a.anchor.y < b.anchor.y; });
  std::vector<double> wanted;
  for (const Callout& callout : callouts) {
    wanted.push_back(callout.anchor.y);
  }
  const double half = 0.5 * columns.height;
  const std::vector<double> heights =
      spread(wanted, row_fraction * columns.height, columns.box.low.y + half, columns.box.high.y - half);
  const double edge = column.left ? columns.left_edge : columns.right_edge;
  const auto end = [&](std::size_t i) {
    return Vec2{edge + (column.left ? word_clearance : -word_clearance), heights[i]};
  };
  // Two lines that cross are shorter when their words change places, so this comes to an end.
  bool changed = true;
  for (std::size_t round = 0; changed && round < callouts.size(); ++round) {
    changed = false;
    for (std::size_t i = 0; i < callouts.size(); ++i) {
      for (std::size_t j = i + 1; j < callouts.size(); ++j) {
        if (leaders_cross(end(i), callouts[i].anchor, end(j), callouts[j].anchor)) {
          std::swap(callouts[i], callouts[j]);
          changed = true;
        }
      }
    }
  }
  for (std::size_t i = 0; i < callouts.size(); ++i) {
    const Vec2 base{edge, heights[i] - half};
    group.texts.push_back(column.left ? words_to(callouts[i].words, base, columns.height, Weight::bold)
                                      : words_from(callouts[i].words, base, columns.height, Weight::bold));
    Line leader{Layer::mark, {end(i), callouts[i].anchor}};
    leader.pen = leader_pen;
    group.lines.push_back(std::move(leader));
    add_dot(callouts[i].anchor, group);
  }
}

}  // namespace

std::size_t add_callouts(const std::vector<Callout>& callouts, const CalloutColumns& columns, Group& group) {
  const double room = columns.box.size().y;
  const auto most =
      static_cast<std::size_t>(std::max(0.0, std::floor(room / (row_fraction * columns.height))));
  Column left{{}, true};
  Column right{{}, false};
  const double middle = 0.5 * (columns.left_edge + columns.right_edge);
  std::size_t placed = 0;
  for (const Callout& callout : callouts) {
    Column& nearer = callout.anchor.x < middle ? left : right;
    Column& other = callout.anchor.x < middle ? right : left;
    if (Column& column = nearer.callouts.size() < most ? nearer : other; column.callouts.size() < most) {
      column.callouts.push_back(callout);
      ++placed;
    }
  }
  add_column(std::move(left), columns, group);
  add_column(std::move(right), columns, group);
  return placed;
}

namespace {

constexpr std::size_t most_names = 4;
/// Edges that are shorter take tweezers, mm.
constexpr double short_edge_mm = 6.0;
/// More hard edges of a step are counted.
constexpr std::size_t most_hard = 8;

std::array<PieceId, 2> pieces_at(const mesh::Surface& surface, const unfold::Nets& nets, JoinId join) {
  const auto [c, d] = surface.sides(nets.joins[join].edge);
  return {nets.piece[mesh::face_of(c)], nets.piece[mesh::face_of(d)]};
}

bool is_in(const AssemblyStep& step, PieceId piece) {
  return std::binary_search(step.pieces.begin(), step.pieces.end(), piece);
}

std::string ranges_of(std::vector<std::uint32_t> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return number_ranges(numbers);
}

/// Numbers of joins by the pieces that they are at.
using NumbersOf = std::map<PieceId, std::vector<std::uint32_t>>;

/// "A: 1-4; to B: 7"
std::string partner_words(const unfold::Nets& nets, const NumbersOf& partners) {
  std::string words;
  for (const auto& [other, numbers] : partners) {
    words += (words.empty() ? "" : "; to ") + nets.pieces[other].name + ": " + ranges_of(numbers);
  }
  return words;
}

void add_gluing(const mesh::Surface& surface, const unfold::Nets& nets, const AssemblyStep& step,
                std::vector<std::string>& sentences) {
  NumbersOf own;
  for (const JoinId join : step.own) {
    own[pieces_at(surface, nets, join)[0]].push_back(nets.joins[join].number);
  }
  std::map<PieceId, NumbersOf> glued;
  for (const JoinId join : step.joins) {
    const auto [a, b] = pieces_at(surface, nets, join);
    const bool first_is_new = is_in(step, a);
    glued[first_is_new ? a : b][first_is_new ? b : a].push_back(nets.joins[join].number);
  }
  const bool several = step.pieces.size() > 1;
  for (const PieceId piece : step.pieces) {
    std::string words;
    if (const auto found = own.find(piece); found != own.end()) {
      words = "Close " + ranges_of(found->second) + ".";
    }
    if (const auto found = glued.find(piece); found != glued.end()) {
      words +=
          (words.empty() ? "" : " ") + std::string("Glue to ") + partner_words(nets, found->second) + ".";
    }
    if (!words.empty()) {
      sentences.push_back(several ? nets.pieces[piece].name + ": " + words : words);
    }
  }
}

/// The last step that adds any of these pieces.
std::size_t last_step(const Assembly& assembly, std::span<const PieceId> pieces) {
  std::size_t last = 0;
  for (std::size_t i = 0; i < assembly.steps.size(); ++i) {
    if (std::ranges::any_of(pieces, [&](PieceId piece) { return is_in(assembly.steps[i], piece); })) {
      last = i;
    }
  }
  return last;
}

/// Bodies that stand on others, as soon as they are whole and what they stand on is there: "Glue A and B onto
/// C, D onto E and F, within the dashed lines."
void add_glue_outlines(const unfold::Nets& nets, const Assembly& assembly, std::size_t index,
                       std::span<const Body> bodies, std::vector<std::string>& sentences) {
  std::map<PieceId, std::vector<std::string>> below;  // what each piece is glued onto
  for (const Body& body : bodies) {
    for (const auto& [piece, other] : body.glued_onto) {
      if (std::max(last_step(assembly, body.pieces), last_step(assembly, {&other, 1})) == index) {
        below[piece].push_back(nets.pieces[other].name);
      }
    }
  }
  std::map<std::vector<std::string>, std::vector<std::string>> above;
  std::size_t lines = 0;
  for (const auto& [piece, others] : below) {
    above[others].push_back(nets.pieces[piece].name);
    lines += others.size();
  }
  std::string words;
  for (const auto& [others, pieces] : above) {
    words += (words.empty() ? "Glue " : ", ") + listed(pieces, "and") + " onto " + listed(others, "and");
  }
  if (!words.empty()) {
    sentences.push_back(words + ", within the dashed line" + (lines == 1 ? "." : "s."));
  }
}

/// The first step that adds any of these pieces.
std::size_t first_step(const Assembly& assembly, std::span<const PieceId> pieces) {
  const auto first = std::ranges::find_if(assembly.steps, [&](const AssemblyStep& step) {
    return std::ranges::any_of(pieces, [&](PieceId piece) { return is_in(step, piece); });
  });
  return static_cast<std::size_t>(first - assembly.steps.begin());
}

/// Whether a body is glued onto another one, or another one onto it.
bool is_glued(std::span<const Body> bodies, const Body& body) {
  return !body.glued_onto.empty() || std::ranges::any_of(bodies, [&](const Body& other) {
    return std::ranges::any_of(
        other.glued_onto, [&](const auto& pair) { return std::ranges::binary_search(body.pieces, pair[1]); });
  });
}

/// Whether the body of a piece belongs beside one of the others.
bool belongs_beside(std::span<const Body> bodies, PieceId piece, std::span<const PieceId> others) {
  return std::ranges::any_of(bodies, [&](const Body& body) {
    return std::ranges::binary_search(body.pieces, piece) &&
           (std::ranges::find(others, body.beside) != others.end());
  });
}

/// Where the step's bodies belong that nothing holds yet: "A and H belong beside B, J beside E: no number
/// joins them."
void add_places_of_bodies(const unfold::Nets& nets, const Assembly& assembly, std::size_t index,
                          std::span<const Body> bodies, std::vector<std::string>& sentences) {
  std::map<PieceId, std::vector<std::string>> beside;
  std::size_t count = 0;
  for (const Body& body : bodies) {
    if (is_glued(bodies, body) || !body.beside.valid()) {
      continue;
    }
    const std::size_t own = first_step(assembly, body.pieces);
    const std::size_t there = first_step(assembly, {&body.beside, 1});
    // What comes first of two that belong beside each other has no place of its own.
    const bool is_told = own == index && there < index;
    if (is_told || (there == index && own < index && !belongs_beside(bodies, body.beside, body.pieces))) {
      const PieceId piece =
          *std::ranges::find_if(body.pieces, [&](PieceId p) { return is_in(assembly.steps[own], p); });
      beside[body.beside].push_back(nets.pieces[piece].name);
      ++count;
    }
  }
  std::string words;
  for (const auto& [other, names] : beside) {
    const char* verb = !words.empty() ? " " : names.size() > 1 ? " belong " : " belongs ";
    words += (words.empty() ? "" : ", ") + listed(names, "and") + verb + "beside " + nets.pieces[other].name;
  }
  if (count > 0) {
    sentences.push_back(words + (count > 1 ? ": no number joins them." : ": no number joins it."));
  }
}

/// Of the step's edges those that take a steady hand: "Hard: 12-14 (below 6 mm), 31 (no tab: glue a strip
/// behind)."
void add_hard_edges(const mesh::Surface& surface, const unfold::Nets& nets, const AssemblyStep& step,
                    std::vector<std::string>& sentences) {
  std::vector<std::uint32_t> without_tab;
  std::vector<std::uint32_t> with_short_tab;
  for (const auto* joins : {&step.own, &step.joins}) {
    for (const JoinId j : *joins) {
      const unfold::Join& join = nets.joins[j];
      if (!join.tab.valid() && join.no_tab != unfold::NoTab::not_wanted) {
        without_tab.push_back(join.number);
      } else if (join.tab.valid() && surface.length(join.edge) < short_edge_mm) {
        with_short_tab.push_back(join.number);
      }
    }
  }
  std::string words;
  const auto add = [&](const std::vector<std::uint32_t>& numbers, const std::string& why) {
    if (!numbers.empty()) {
      words += (words.empty() ? "Hard: " : ", ") +
               (numbers.size() > most_hard ? counted(numbers.size(), "edge") : ranges_of(numbers)) + " (" +
               why + ")";
    }
  };
  add(with_short_tab, fmt::format("below {:g} mm", short_edge_mm));
  add(without_tab, "no tab: glue a strip behind");
  if (!words.empty()) {
    sentences.push_back(words + ".");
  }
}

/// "Roll C round a pen of 12 mm, D round a tube of 30 mm."
void add_rolls(const prepare::Prepared& model, const unfold::Nets& nets, const AssemblyStep& step,
               std::vector<std::string>& sentences) {
  std::vector<std::string> rolls;
  for (const RolledPart& part : rolled_parts(model, nets)) {
    if (is_in(step, part.piece)) {
      std::string words =
          nets.pieces[part.piece].name + " round " + round_words(model.rolls.rolls[part.roll]);
      if (std::find(rolls.begin(), rolls.end(), words) == rolls.end()) {
        rolls.push_back(std::move(words));
      }
    }
  }
  if (!rolls.empty()) {
    sentences.push_back(fmt::format("Roll {}.", fmt::join(rolls, ", ")));
  }
}

/// Of two pieces one is on the left where they are farther apart than this share of the model.
constexpr double least_apart_fraction = 0.03;

}  // namespace

std::string step_title(const unfold::Nets& nets, const AssemblyStep& step) {
  const auto name = [&](std::size_t i) { return nets.pieces[step.pieces[i]].name; };
  const std::size_t count = step.pieces.size();
  if (count > most_names) {
    const bool row = step.pieces.back().value() - step.pieces.front().value() + 1 == count;
    return fmt::format("{} {} {} ({})", name(0), row ? "to" : "...", name(count - 1), count);
  }
  std::string words = name(0);
  for (std::size_t i = 1; i < count; ++i) {
    words += (i + 1 == count ? " and " : ", ") + name(i);
  }
  return words;
}

std::vector<std::string> step_sentences(const prepare::Prepared& model, const unfold::Nets& nets,
                                        const Assembly& assembly, std::size_t index,
                                        std::span<const Body> bodies) {
  const mesh::Surface& surface = model.model.surface;
  const AssemblyStep& step = assembly.steps[index];
  std::vector<std::string> sentences;
  add_rolls(model, nets, step, sentences);
  if (step.own.empty() && step.joins.empty()) {
    const bool folds = std::any_of(step.pieces.begin(), step.pieces.end(),
                                   [&](PieceId piece) { return !nets.pieces[piece].folding.steps.empty(); });
    const bool several = step.pieces.size() > 1;
    if (folds) {
      sentences.emplace_back(several ? "Fold them." : "Fold it.");
    } else {
      sentences.emplace_back(several ? "They stay flat." : "It stays flat.");
    }
  }
  add_gluing(surface, nets, step, sentences);
  add_glue_outlines(nets, assembly, index, bodies, sentences);
  add_places_of_bodies(nets, assembly, index, bodies, sentences);
  add_hard_edges(surface, nets, step, sentences);
  if (step.closes && !step.joins.empty()) {
    sentences.emplace_back("This closes the body: begin at the longest edge.");
  }
  return sentences;
}

std::vector<PieceId> glued_before(const mesh::Surface& surface, const unfold::Nets& nets,
                                  const AssemblyStep& step) {
  std::vector<PieceId> pieces;
  for (const JoinId join : step.joins) {
    for (const PieceId piece : pieces_at(surface, nets, join)) {
      if (!is_in(step, piece)) {
        pieces.push_back(piece);
      }
    }
  }
  std::sort(pieces.begin(), pieces.end());
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  return pieces;
}

std::string picture_words(const mesh::Surface& surface, const unfold::Nets& nets, const AssemblyStep& step) {
  std::vector<std::string> before;
  for (const PieceId piece : glued_before(surface, nets, step)) {
    before.push_back(nets.pieces[piece].name);
  }
  return step_title(nets, step) + (before.empty() ? ", folded" : ", glued to " + listed(before, "and"));
}

std::vector<MirrorPair> mirror_pairs(const unfold::Nets& nets, const AssemblyStep& step) {
  std::vector<MirrorPair> pairs;
  for (const std::vector<unfold::EqualPiece>& kind : nets.equal) {
    if (kind.size() != 2 || kind[0].mirrored == kind[1].mirrored) {
      continue;
    }
    const PieceId a = kind[0].piece;
    const PieceId b = kind[1].piece;
    if (is_in(step, a) || is_in(step, b)) {
      pairs.push_back(is_in(step, a) ? MirrorPair{a, b} : MirrorPair{b, a});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const MirrorPair& p, const MirrorPair& q) { return p.piece < q.piece; });
  return pairs;
}

std::string words_of_sides(const mesh::Surface& surface, const unfold::Nets& nets, const MirrorPair& pair,
                           const Camera& camera) {
  const auto middle = [&](PieceId piece) {
    Box2 box;
    for (const FaceId face : nets.pieces[piece].faces) {
      for (const VertexId v : surface.vertices(face)) {
        box.add(camera(surface.point(v)));
      }
    }
    return 0.5 * (box.low.x + box.high.x);
  };
  const double apart = middle(pair.image) - middle(pair.piece);
  if (std::abs(apart) < least_apart_fraction * surface.bounds().largest_extent()) {
    return {};
  }
  const std::string& name = nets.pieces[pair.piece].name;
  const std::string& other = nets.pieces[pair.image].name;
  return fmt::format("Of the mirror images {} and {}, {} is on the {} here.", std::min(name, other),
                     std::max(name, other), name, apart > 0.0 ? "left" : "right");
}

}  // namespace ridgecraft::export_
