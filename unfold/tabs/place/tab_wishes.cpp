// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/place/tab_wishes.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"

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

class WishMaker {
 public:
  WishMaker(const mesh::Surface& surface, const Nets& nets) : surface_(surface), nets_(nets) {}

  std::vector<TabWish> make(const TabOptions& options, const TabChoice& choice) {
    for (const Join& join : nets_.joins) {
      TabWish wish;
      wish.second = choice.sides == TabSides::both;
      wish.options = options_for(options, choice, surface_.length(join.edge));
      wishes_.push_back(wish);
    }
    if (choice.sides == TabSides::one_side) {
      keep_to_one_side();
    } else if (choice.sides == TabSides::alternate) {
      alternate();
    }
    heed(choice.edges);
    heed(choice.at);
    return std::move(wishes_);
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
        wishes_[j.value()].side = side_of(nets_.joins[j], more[seam] >= 0.0 ? seam.first : seam.second);
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
      wishes_[j.value()].side = seam.first == seam.second ? static_cast<std::uint8_t>(turn ? 1 : 0)
                                                          : side_of(join, turn ? seam.second : seam.first);
      turn = !turn;
    }
  }

  /// Of what is asked for one number the last counts.
  void heed(const std::vector<EdgeTab>& asked) {
    std::map<std::uint32_t, const EdgeTab*> last;
    for (const EdgeTab& edge : asked) {
      last[edge.number] = &edge;
    }
    std::set<std::uint32_t> met;
    for (const JoinId j : ids<JoinId>(nets_.joins.size())) {
      const Join& join = nets_.joins[j];
      if (const auto found = last.find(join.number); found != last.end()) {
        heed(*found->second, join, wishes_[j.value()]);
        met.insert(join.number);
      }
    }
    for (const EdgeTab& edge : asked) {
      if (!met.contains(edge.number)) {
        throw Error(ErrorKind::unreadable_input,
                    fmt::format("{}: no edge that is glued has the number {}", edge.where, edge.number));
      }
    }
  }

  void heed(const std::vector<TabAt>& asked) {
    std::map<EdgeId, const TabAt*> last;
    for (const TabAt& at : asked) {
      last[at.edge] = &at;
    }
    for (const JoinId j : ids<JoinId>(nets_.joins.size())) {
      if (const auto found = last.find(nets_.joins[j].edge); found != last.end()) {
        TabWish& wish = wishes_[j.value()];
        wish.wanted = found->second->wanted;
        wish.side = found->second->side;
        wish.no_other_side = false;
      }
    }
  }

  void heed(const EdgeTab& asked, const Join& join, TabWish& wish) const {
    wish.wanted = asked.wanted;
    wish.second = wish.second || asked.both;
    if (!asked.piece.empty()) {
      const std::string& first = nets_.pieces[piece_at(join, 0)].name;
      const std::string& second = nets_.pieces[piece_at(join, 1)].name;
      if (asked.piece != first && asked.piece != second) {
        throw Error(ErrorKind::unreadable_input,
                    fmt::format("{}: edge {} is one of {}, not of {}", asked.where, asked.number,
                                first == second ? first : first + " and " + second, asked.piece));
      }
      wish.side = static_cast<std::uint8_t>(asked.piece == first ? 0 : 1);
      wish.no_other_side = first != second;
    }
    wish.options.height_mm = asked.height_mm.value_or(wish.options.height_mm);
    set_angle(asked.angle.value_or(wish.options.angle), wish.options);
  }

  const mesh::Surface& surface_;
  const Nets& nets_;
  std::vector<TabWish> wishes_;
};

}  // namespace

TabOptions options_for(const TabOptions& options, const TabChoice& choice, double length_mm) {
  TabOptions own = options;
  own.height_mm = value_for(choice.heights_mm, length_mm, options.height_mm);
  set_angle(value_for(choice.angles, length_mm, options.angle), own);
  return own;
}

TabOptions with_greatest_height(TabOptions options, std::span<const TabWish> wishes) {
  for (const TabWish& wish : wishes) {
    options.height_mm = std::max(options.height_mm, wish.options.height_mm);
  }
  return options;
}

std::vector<TabWish> tab_wishes(const mesh::Surface& surface, const Nets& nets, const TabOptions& options,
                                const TabChoice& choice) {
  return WishMaker(surface, nets).make(options, choice);
}

}  // namespace ridgecraft::unfold
