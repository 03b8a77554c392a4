// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/tab_requests.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "unfold/tabs/place/slot_tabs.hpp"

namespace ridgecraft::unfold {
namespace {

using Seam = std::pair<PieceId, PieceId>;

/// The value for an edge of this length; `otherwise` where none is asked.
double value_for(const std::vector<FromLength>& steps, double length_mm, double otherwise) {
  for (const FromLength& step : steps) {
    otherwise = length_mm >= step.length_mm ? step.value : otherwise;
  }
  return otherwise;
}

void set_angle(double angle, TabOptions& options) {
  options.angle = angle;
  options.steepest_angle = std::max(options.steepest_angle, angle);
}

/// What is asked for a number, told of a join that has it.
TabAt tab_at(const mesh::Surface& surface, const Nets& nets, const Join& join, const EdgeTab& asked) {
  TabAt at{join.edge, asked.wanted, std::nullopt, false, asked.both, asked.height_mm, asked.angle};
  if (!asked.piece.empty()) {
    const auto name_at = [&](std::size_t side) -> const std::string& {
      return nets.pieces[nets.piece[mesh::face_of(surface.sides(join.edge)[side])]].name;
    };
    const std::string& first = name_at(0);
    const std::string& second = name_at(1);
    if (asked.piece != first && asked.piece != second) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("{}: edge {} is one of {}, not of {}", asked.where, asked.number,
                              first == second ? first : first + " and " + second, asked.piece));
    }
    at.side = static_cast<std::uint8_t>(asked.piece == first ? 0 : 1);
    at.no_other_side = first != second;
  }
  return at;
}

/// The ground that arrows are cut from is a rectangle as high as they are.
void give_ground_for_slots(TabRequest& request) {
  if (request.slot) {
    request.options.height_mm = arrow_measures.height();
    set_angle(0.5 * std::numbers::pi, request.options);
  }
}

class RequestMaker {
 public:
  RequestMaker(const mesh::Surface& surface, const Nets& nets) : surface_(surface), nets_(nets) {}

  std::vector<TabRequest> make(const TabOptions& options, const TabChoice& choice) {
    for (const Join& join : nets_.joins) {
      TabRequest request;
      request.second = choice.sides == TabSides::both;
      request.options = options_for(options, choice, surface_.length(join.edge));
      request.slot = choice.sides == TabSides::slots;
      requests_.push_back(request);
    }
    if (choice.sides == TabSides::one_side) {
      keep_to_one_side();
    } else if (choice.sides == TabSides::alternate) {
      alternate();
    }
    heed(by_edges(surface_, nets_, choice.edges));
    heed(choice.at);
    for (TabRequest& request : requests_) {
      give_ground_for_slots(request);
    }
    return std::move(requests_);
  }

 private:
  [[nodiscard]] PieceId piece_at(const Join& join, std::uint8_t side) const {
    return nets_.piece[mesh::face_of(surface_.sides(join.edge)[side])];
  }
  [[nodiscard]] Seam seam_of(const Join& join) const {
    return std::minmax(piece_at(join, 0), piece_at(join, 1));
  }
  /// The side that a piece has of a join between two of them.
  [[nodiscard]] std::uint8_t side_of(const Join& join, PieceId piece) const {
    return piece_at(join, 0) == piece ? 0 : 1;
  }

  void keep_to_one_side() {
    std::map<Seam, double> more;  // length that the first piece gives minus that of the second
    for (const Join& join : nets_.joins) {
      if (const Seam seam = seam_of(join); join.tab.valid() && seam.first != seam.second) {
        const PieceId giver = nets_.piece[mesh::face_of(nets_.tabs[join.tab].side)];
        more[seam] += (giver == seam.first ? 1.0 : -1.0) * surface_.length(join.edge);
      }
    }
    for (const JoinId j : ids<JoinId>(nets_.joins.size())) {
      if (const Seam seam = seam_of(nets_.joins[j]); seam.first != seam.second) {
        requests_[j.value()].side = side_of(nets_.joins[j], more[seam] >= 0.0 ? seam.first : seam.second);
      }
    }
  }

  /// Joins have numbers in the order in which they follow each other along a seam.
  void alternate() {
    std::map<Seam, bool> second;
    for (const JoinId j : ids<JoinId>(nets_.joins.size())) {
      const Join& join = nets_.joins[j];
      const Seam seam = seam_of(join);
      bool& turn = second[seam];
      requests_[j.value()].side = seam.first == seam.second ? static_cast<std::uint8_t>(turn ? 1 : 0)
                                                            : side_of(join, turn ? seam.second : seam.first);
      turn = !turn;
    }
  }

  void heed(const std::vector<TabAt>& asked) {
    std::map<EdgeId, JoinId> join_at;
    for (const JoinId j : ids<JoinId>(asked.empty() ? 0 : nets_.joins.size())) {
      join_at[nets_.joins[j].edge] = j;
    }
    for (const TabAt& at : asked) {
      if (const auto found = join_at.find(at.edge); found != join_at.end()) {
        heed(at, requests_[found->second.value()]);
      }
    }
  }

  static void heed(const TabAt& asked, TabRequest& request) {
    request.wanted = asked.wanted;
    request.second = request.second || asked.both;
    if (asked.side) {
      request.side = asked.side;
      request.no_other_side = asked.no_other_side;
    }
    request.options.height_mm = asked.height_mm.value_or(request.options.height_mm);
    set_angle(asked.angle.value_or(request.options.angle), request.options);
  }

  const mesh::Surface& surface_;
  const Nets& nets_;
  std::vector<TabRequest> requests_;
};

}  // namespace

TabOptions options_for(const TabOptions& options, const TabChoice& choice, double length_mm) {
  TabOptions own = options;
  own.height_mm = value_for(choice.heights_mm, length_mm, options.height_mm);
  set_angle(value_for(choice.angles, length_mm, options.angle), own);
  return own;
}

TabOptions with_greatest_height(TabOptions options, const TabChoice& choice) {
  for (const FromLength& step : choice.heights_mm) {
    options.height_mm = std::max(options.height_mm, step.value);
  }
  return options;
}

TabOptions with_greatest_height(TabOptions options, std::span<const TabRequest> requests) {
  for (const TabRequest& request : requests) {
    options.height_mm = std::max(options.height_mm, request.options.height_mm);
  }
  return options;
}

std::vector<TabAt> by_edges(const mesh::Surface& surface, const Nets& nets,
                            const std::vector<EdgeTab>& asked) {
  std::map<std::uint32_t, std::vector<const Join*>> joins_of;
  for (const Join& join : nets.joins) {
    joins_of[join.number].push_back(&join);
  }
  std::map<std::uint32_t, std::vector<TabAt>> last;
  for (const EdgeTab& edge : asked) {
    const auto found = joins_of.find(edge.number);
    if (found == joins_of.end()) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("{}: no edge that is glued has the number {}", edge.where, edge.number));
    }
    std::vector<TabAt>& tabs = last[edge.number];
    tabs.clear();
    for (const Join* join : found->second) {
      tabs.push_back(tab_at(surface, nets, *join, edge));
    }
  }
  std::vector<TabAt> at;
  for (const auto& [number, tabs] : last) {
    at.insert(at.end(), tabs.begin(), tabs.end());
  }
  return at;
}

std::vector<TabRequest> tab_requests(const mesh::Surface& surface, const Nets& nets,
                                     const TabOptions& options, const TabChoice& choice) {
  return RequestMaker(surface, nets).make(options, choice);
}

}  // namespace ridgecraft::unfold
