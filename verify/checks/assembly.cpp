// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 8: the order of assembly names each piece once, each join where both its pieces stand, and goes on
// from what stands.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"

namespace ridgecraft::verify {
namespace {

class AssemblyCheck {
 public:
  AssemblyCheck(const Case& given, Findings& findings)
      : file_(given.file),
        relations_(given.relations),
        findings_(findings),
        step_of_(file_.pieces.size(), none) {}

  void run() {
    number_pieces();
    if (sound_) {
      check_joins_of_steps();
      check_footing();
    }
  }

 private:
  [[nodiscard]] const std::vector<AssemblyStep>& steps() const { return *file_.assembly; }

  void add(std::size_t step, const std::string& words) {
    sound_ = false;
    findings_.add(Promise::statements, {{"step", step}},
                  [&] { return fmt::format("step {} of the assembly {}", step, words); });
  }

  void number_pieces() {
    for (std::size_t s = 0; s < steps().size(); ++s) {
      for (const Index piece : steps()[s].pieces) {
        if (step_of_[piece] != none) {
          add(s, fmt::format("has {}, which stands already", piece_name(file_, piece)));
        }
        step_of_[piece] = static_cast<Index>(s);
      }
    }
    for (Index piece = 0; piece < step_of_.size(); ++piece) {
      if (step_of_[piece] == none) {
        sound_ = false;
        findings_.add(Promise::statements, {{"piece", piece}}, [&] {
          return fmt::format("no step of the assembly has {}", piece_name(file_, piece));
        });
      }
    }
  }

  [[nodiscard]] Index piece_at(Index edge) const {
    return file_.face_piece[file_.faces.face(relations_.sides_of(edge).front())];
  }

  void check_joins_of_steps() {
    std::vector<std::vector<std::int64_t>> wanted(steps().size());
    for (const Join& join : file_.joins) {
      wanted[std::max(step_of_[piece_at(join.edges[0])], step_of_[piece_at(join.edges[1])])].push_back(
          join.number);
    }
    for (std::size_t s = 0; s < wanted.size(); ++s) {
      std::sort(wanted[s].begin(), wanted[s].end());
      wanted[s].erase(std::unique(wanted[s].begin(), wanted[s].end()), wanted[s].end());
      // Joins of one number are one seam, which another program may glue in two steps.
      if (file_.is_ours() ? wanted[s] != steps()[s].joins
                          : !std::includes(wanted[s].begin(), wanted[s].end(), steps()[s].joins.begin(),
                                           steps()[s].joins.end())) {
        add(s, "has other joins than those by which its pieces are glued to what stands");
      }
    }
  }

  /// A piece that isn't glued to anything that stands begins a body, and nothing of it may stand by then.
  void check_footing() {
    DisjointSets bodies(file_.pieces.size());
    std::vector<bool> has_footing(file_.pieces.size(), false);
    for (const Join& join : file_.joins) {
      const Index a = piece_at(join.edges[0]);
      const Index b = piece_at(join.edges[1]);
      bodies.join(a, b);
      if (step_of_[a] != step_of_[b]) {
        has_footing[step_of_[a] > step_of_[b] ? a : b] = true;
      }
    }
    std::vector<Index> begun(file_.pieces.size(), none);
    for (std::size_t s = 0; s < steps().size(); ++s) {
      for (const Index piece : steps()[s].pieces) {
        const Index first = begun[bodies.find(piece)];
        if (first != none && !has_footing[piece]) {
          add(s, fmt::format("has {}, which isn't glued to anything that stands", piece_name(file_, piece)));
        }
        begun[bodies.find(piece)] = first == none ? static_cast<Index>(s) : first;
      }
    }
  }

  const File& file_;
  const Relations& relations_;
  Findings& findings_;
  std::vector<Index> step_of_;  ///< of each piece
  bool sound_ = true;
};

}  // namespace

void check_assembly(const Case& given, Findings& findings) {
  if (given.file.assembly) {
    AssemblyCheck(given, findings).run();
  }
}

}  // namespace ridgecraft::verify
