// SPDX-License-Identifier: GPL-3.0-or-later
// How files for machines are wanted: --preset, and what goes before it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/arguments/options.hpp"
#include "cli/arguments/verb.hpp"

namespace ridgecraft::cli {

/// The values as typed.
struct MachineTexts {
  std::string preset, dxf, kerf, score, bridges, bed, engrave, svg_px, thickness, hinge;
  std::vector<std::string> colours, spots;
  bool kerf_test = false;
  bool print_and_cut = false;
  bool hairline = false;

  void add_to(Verb& verb);
  /// Throws Error(usage).
  void check_into(PaperJob& job) const;
  /// Numbers on the back need files that have one. Throws Error(usage).
  void require_back(const PaperJob& job) const;
  /// The sheet and margin where none were asked for by --paper and --margin: those of the machine. `paper`
  /// has these already. Room for the beam, and none for furniture. Throws Error(usage).
  void fit_paper(const PaperJob& job, bool paper_given, bool margin_given, paper::Paper& paper) const;

 private:
  /// The option that only machines heed and that was given; "" where none was.
  [[nodiscard]] std::string first_given() const;
  void set_colours(paper::Preset& made) const;
  void set_spots(PaperJob& job) const;
  void set_board(PaperJob& job, paper::Preset& made) const;
  void set_print_and_cut(PaperJob& job, paper::Preset& made) const;
};

}  // namespace ridgecraft::cli
