// SPDX-License-Identifier: GPL-3.0-or-later
// Promise 7: the folds of each piece, each once, in an order in which paper can be folded.
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

#include "verify/checks/checks.hpp"
#include "verify/file/settings_form.hpp"
#include "verify/file/tolerance.hpp"
#include "verify/relations/plates.hpp"

namespace ridgecraft::verify {
namespace {

class OrderCheck {
 public:
  OrderCheck(const Case& given, Findings& findings)
      : file_(given.file),
        relations_(given.relations),
        findings_(findings),
        plates_(find_plates(file_, relations_, still_fold_deg)),
        creases_(find_creases(file_, relations_, plates_)),
        step_of_(file_.edges.size(), none) {}

  void run() {
    for (Index piece = 0; piece < file_.pieces.size(); ++piece) {
      sound_ = true;
      check_steps(piece);
      check_all_there(piece);
      check_whole_creases(piece);
      if (sound_ && file_.is_ours()) {
        check_way(piece);
      }
    }
  }

 private:
  using Steps = std::vector<std::vector<Index>>;

  [[nodiscard]] const Steps& steps(Index piece) const { return (*file_.fold_order)[piece]; }

  void add(Index piece, Index edge, const std::string& words) {
    sound_ = false;
    findings_.add(Promise::fold_order, {{"piece", piece}, {"edge", edge}},
                  [&] { return fmt::format("the fold order of {} {}", piece_name(file_, piece), words); });
  }

  [[nodiscard]] Index piece_of(Index edge) const {
    return file_.face_piece[file_.faces.face(relations_.sides_of(edge).front())];
  }

  void check_steps(Index piece) {
    for (std::size_t step = 0; step < steps(piece).size(); ++step) {
      for (const Index edge : steps(piece)[step]) {
        if (file_.edges[edge].assignment == Assignment::cut) {
          add(piece, edge, fmt::format("names edge {}, which is no fold", edge));
        } else if (piece_of(edge) != piece) {
          add(piece, edge, fmt::format("names edge {} of {}", edge, piece_name(file_, piece_of(edge))));
        } else if (step_of_[edge] != none) {
          add(piece, edge, fmt::format("names edge {} twice", edge));
        } else if (file_.is_ours() && file_.edges[edge].assignment == Assignment::flat) {
          add(piece, edge, fmt::format("names edge {}, which stays flat", edge));
        }
        step_of_[edge] = static_cast<Index>(step);
      }
    }
  }

  void check_all_there(Index piece) {
    for (const Crease& crease : creases_[piece]) {
      for (const Index edge : crease.edges) {
        if (step_of_[edge] == none) {
          add(piece, edge, fmt::format("lacks the fold at edge {}", edge));
        }
      }
    }
  }

  /// Folds between the same two stiff plates can only be made together.
  void check_whole_creases(Index piece) {
    for (const Crease& crease : creases_[piece]) {
      for (const Index edge : crease.edges) {
        const Index first = step_of_[crease.edges.front()];
        if (first != none && step_of_[edge] != none && step_of_[edge] != first) {
          add(piece, edge,
              fmt::format("folds edges {} and {} one after the other, which are one crease",
                          crease.edges.front(), edge));
        }
      }
    }
  }

  /// This program folds a piece all at a time or crease by crease. Plates that close a circle have creases
  /// that move together.
  void check_way(Index piece) {
    std::set<Index> plates;
    std::map<Index, Index> crease_of_step;  // the first edge of one
    for (const Crease& crease : creases_[piece]) {
      plates.insert({crease.first, crease.second});
    }
    if (steps(piece).size() < 2 || plates.size() != creases_[piece].size() + 1) {
      return;
    }
    for (const Crease& crease : creases_[piece]) {
      const Index edge = crease.edges.front();
      if (!crease_of_step.emplace(step_of_[edge], edge).second) {
        add(piece, edge, "folds several creases in one of many steps");
        return;
      }
    }
    // Edges that were to be kept may be in the way of the split that this takes.
    const Settings& settings = file_.settings;
    if (is_true(settings, "fold_linear") && settings.find("keep") == nullptr &&
        settings.find("from") == nullptr) {
      add(piece, creases_[piece].front().edges.front(),
          fmt::format("has {} steps, where the settings ask for all creases together", steps(piece).size()));
    }
  }

  const File& file_;
  const Relations& relations_;
  Findings& findings_;
  Plates plates_;
  std::vector<std::vector<Crease>> creases_;  ///< of each piece
  std::vector<Index> step_of_;                ///< per edge: the last step that names it
  bool sound_ = true;                         ///< so far, of the piece that is looked at
};

}  // namespace

void check_fold_order(const Case& given, Findings& findings) {
  if (given.file.fold_order) {
    OrderCheck(given, findings).run();
  }
}

}  // namespace ridgecraft::verify
