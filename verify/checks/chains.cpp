// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 8: chains are rows of joins that can be glued edge by edge, and numbers say which is glued to
// which.
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "verify/checks/checks.hpp"
#include "verify/file/relations.hpp"
#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

class ChainCheck {
 public:
  ChainCheck(const Case& given, Findings& findings)
      : file_(given.file), relations_(given.relations), findings_(findings) {}

  void run() {
    check_numbers();
    if (!file_.chains) {
      return;
    }
    std::vector<std::size_t> chains_of(file_.joins.size(), 0);
    for (std::size_t i = 0; i < file_.chains->size(); ++i) {
      check_chain(i);
      for (const Index join : (*file_.chains)[i].joins) {
        ++chains_of[join];
      }
    }
    for (Index join = 0; join < chains_of.size(); ++join) {
      if (chains_of[join] != 1) {
        findings_.add(Promise::statements, {{"join", join}}, [&] {
          return fmt::format("{} is in {} chains, not in one", join_name(file_, join), chains_of[join]);
        });
      }
    }
  }

 private:
  /// One side of a net for each of a join's two edges, that of its first edge first.
  using Sides = std::array<Index, 2>;

  [[nodiscard]] std::optional<Sides> sides_of(Index join) const {
    Sides sides{};
    for (const std::size_t k : {0U, 1U}) {
      const auto all = relations_.sides_of(file_.joins[join].edges[k]);
      if (all.size() != 1) {
        return std::nullopt;  // promise 5 says what is wrong there
      }
      sides[k] = all.front();
    }
    return sides;
  }

  /// Joins with one number are one row on the outline of a piece: each next to another one.
  void check_numbers() {
    std::map<Index, Index> at_vertex;  // a join at the edge that ends there
    DisjointSets rows(file_.joins.size());
    for (const bool link : {false, true}) {
      for (Index join = 0; join < file_.joins.size(); ++join) {
        for (const Index side : sides_of(join).value_or(Sides{none, none})) {
          if (side == none) {
            continue;
          }
          if (!link) {
            at_vertex[file_.faces.head(side)] = join;
            continue;
          }
          const auto before = at_vertex.find(file_.faces.tail(side));
          if (before != at_vertex.end() && file_.joins[before->second].number == file_.joins[join].number) {
            rows.join(join, before->second);
          }
        }
      }
    }
    std::map<std::int64_t, Index> first;
    for (Index join = 0; join < file_.joins.size(); ++join) {
      const Index other = first.try_emplace(file_.joins[join].number, join).first->second;
      if (other != join && sides_of(join) && sides_of(other) && rows.find(join) != rows.find(other)) {
        findings_.add(Promise::statements, {{"join", other}, {"join", join}}, [&] {
          return fmt::format("{} and {} have the same number and are no row of edges",
                             join_name(file_, other), join_name(file_, join));
        });
      }
    }
  }

  void add(std::size_t chain, std::string_view what) {
    findings_.add(Promise::statements, {{"chain", chain}}, [&] {
      return fmt::format("chain {} (number {}) {}", chain, (*file_.chains)[chain].number, what);
    });
  }

  [[nodiscard]] double length_of(Index side) const {
    return length(file_.points[file_.faces.head(side)] - file_.points[file_.faces.tail(side)]);
  }

  void check_chain(std::size_t number) {
    const Chain& chain = (*file_.chains)[number];
    std::vector<Sides> sides;
    for (const Index join : chain.joins) {
      if (file_.joins[join].number != chain.number) {
        add(number, "has joins of another number");
        return;
      }
      if (const auto own = sides_of(join)) {
        sides.push_back(*own);
      } else {
        return;
      }
    }
    // Which side of its first join is that of the first piece isn't said.
    const bool follows = follow(sides) || (std::swap(sides[0][0], sides[0][1]), follow(sides));
    if (!follows) {
      add(number, "has edges that don't follow each other on both of its pieces");
      return;
    }
    std::array<double, 2> lengths{};
    double tolerance = 0.0;
    for (const Sides& pair : sides) {
      for (const std::size_t k : {0U, 1U}) {
        lengths[k] += length_of(pair[k]);
      }
      tolerance += 2.0 * (length_tolerance_mm + length_tolerance_fraction * length_of(pair[0]));
    }
    if (std::abs(lengths[0] - lengths[1]) > tolerance) {
      add(number, fmt::format("is {:.6f} mm long on the one side and {:.6f} mm on the other", lengths[0],
                              lengths[1]));
    }
  }

  /// Whether each side on the one piece begins where the one before ends, and each on the other piece ends
  /// where the one before begins. Turns the pairs to how this is so, from the first one on.
  [[nodiscard]] bool follow(std::vector<Sides>& sides) const {
    for (std::size_t i = 1; i < sides.size(); ++i) {
      const auto goes_on = [&](const Sides& next) {
        return file_.faces.tail(next[0]) == file_.faces.head(sides[i - 1][0]) &&
               file_.faces.head(next[1]) == file_.faces.tail(sides[i - 1][1]);
      };
      if (!goes_on(sides[i])) {
        std::swap(sides[i][0], sides[i][1]);
        if (!goes_on(sides[i])) {
          return false;
        }
      }
    }
    return true;
  }

  const File& file_;
  const Relations& relations_;
  Findings& findings_;
};

}  // namespace

void check_chains(const Case& given, Findings& findings) {
  ChainCheck(given, findings).run();
}

}  // namespace ridgecraft::verify
