// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/guide/step_words.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/sentence.hpp"
#include "export/page/neighbours.hpp"

namespace ridgecraft::paper {
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

/// Whether a piece belongs to an earlier step.
bool stands_before(const Assembly& assembly, std::size_t index, PieceId piece) {
  return std::any_of(assembly.steps.begin(), assembly.steps.begin() + static_cast<std::ptrdiff_t>(index),
                     [&](const AssemblyStep& before) { return is_in(before, piece); });
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

/// What is glued onto what stands already, or the other way round, within an outline: "Glue A onto B, within
/// the dashed line. C is glued onto A, within the dashed line."
void add_glue_spots(const unfold::Nets& nets, const Assembly& assembly, std::size_t index,
                    std::span<const Body> bodies, std::vector<std::string>& sentences) {
  std::map<PieceId, std::vector<std::string>> onto;
  std::map<PieceId, std::vector<std::string>> below;
  for (const Body& body : bodies) {
    for (const auto& [piece, other] : body.glued_onto) {
      if (is_in(assembly.steps[index], piece) && stands_before(assembly, index, other)) {
        onto[other].push_back(nets.pieces[piece].name);
      } else if (is_in(assembly.steps[index], other) && stands_before(assembly, index, piece)) {
        below[other].push_back(nets.pieces[piece].name);
      }
    }
  }
  for (const auto& [other, names] : onto) {
    sentences.push_back("Glue " + listed(names, "and") + " onto " + nets.pieces[other].name +
                        ", within the dashed line.");
  }
  for (const auto& [other, names] : below) {
    sentences.push_back(listed(names, "and") + (names.size() > 1 ? " are" : " is") + " glued onto " +
                        nets.pieces[other].name + ", within the dashed line.");
  }
}

/// Where the step's bodies belong that nothing holds yet: "A and H belong beside B, J beside E: no number
/// joins them."
void add_places_of_bodies(const unfold::Nets& nets, const Assembly& assembly, std::size_t index,
                          std::span<const Body> bodies, std::vector<std::string>& sentences) {
  std::map<PieceId, std::vector<std::string>> beside;
  std::size_t count = 0;
  for (const PieceId piece : assembly.steps[index].pieces) {
    for (const Body& body : bodies) {
      if (body.glued_onto.empty() && body.beside.valid() && stands_before(assembly, index, body.beside) &&
          std::binary_search(body.pieces.begin(), body.pieces.end(), piece)) {
        beside[body.beside].push_back(nets.pieces[piece].name);
        ++count;
      }
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

std::vector<std::string> step_sentences(const mesh::Surface& surface, const unfold::Nets& nets,
                                        const Assembly& assembly, std::size_t index,
                                        std::span<const Body> bodies) {
  const AssemblyStep& step = assembly.steps[index];
  std::vector<std::string> sentences;
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
  add_glue_spots(nets, assembly, index, bodies, sentences);
  if (step.starts) {
    add_places_of_bodies(nets, assembly, index, bodies, sentences);
  }
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

}  // namespace ridgecraft::paper
