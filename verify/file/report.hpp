// SPDX-License-Identifier: GPL-3.0-or-later
// What a check is given besides the file, and what it gives: the promises, the figures and the faults.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/vector.hpp"

namespace ridgecraft::verify {

/// The promises of docs/reference/formats.md; form is promise 0. Those up to 6 are the contract's.
enum class Promise {
  form = 0,
  lengths = 1,
  no_overlap = 2,
  coverage = 3,
  page_bounds = 4,
  joins = 5,
  refolds = 6,
  fold_order = 7,
  statements = 8,
  model = 9,
  printed = 10
};
inline constexpr std::size_t promise_count = 11;

/// One promise broken at one place.
struct Fault {
  Promise promise = Promise::form;
  std::string message;
  /// What is concerned: name of the index ("face", "edge", "piece", ...) and its value.
  std::vector<std::pair<std::string, long long>> indices;
};

/// The figures of the contract. For a file that isn't in the right form they have no value.
struct Figures {
  std::size_t faces = 0, pieces = 0, pages = 0;
  std::size_t overlaps = 0, tab_overlaps = 0;
  double max_length_error_mm = 0.0, max_penetration_mm = 0.0;
  std::size_t missing_faces = 0, double_faces = 0, outside_page = 0;
  std::size_t bad_joins = 0, joins = 0, joins_without_tab = 0;
  double max_fold_error_deg = 0.0, max_refold_error_mm = 0.0;
  double cut_mm = 0.0, fold_mm = 0.0;
  double unlined_fold_mm = 0.0;  ///< of fold_mm, what is too flat for a line on the pages
  std::size_t tabs = 0;
  std::size_t narrow_pieces = 0;  ///< narrower than a knife cuts, and not alone
  std::size_t thin_necks = 0;     ///< pieces that hang together by less than a knife leaves
};

/// Of the way in which the pieces are folded; there with Options::folding.
struct FoldingFigures {
  std::vector<std::string> with_care;  ///< names of pieces that run through themselves on the way
  std::size_t not_tried = 0;           ///< pieces with circles of faces, or with too many steps
};

/// Of the comparison with the model.
struct ModelFigures {
  double deviation_mm = 0.0;         ///< greatest distance found between the two surfaces, both ways
  std::optional<double> allowed_mm;  ///< nothing where the settings allow any
  double mm_per_unit = 0.0;          ///< of the model's unit
  std::optional<bool> same_file;     ///< by the hash of its bytes, where both are known
};

/// Of what is printed.
struct PrintedFigures {
  std::size_t pages = 0;            ///< looked at
  std::size_t pages_not_given = 0;  ///< pages of the nets that none of the files has
  std::size_t faulty = 0;           ///< faults of promise 10, those not listed included
  double max_error_mm = 0.0;  ///< how far the end of a line is from its place, as far as it counts as there
};

/// All that a check found out.
struct Report {
  std::optional<Figures> figures;
  std::optional<FoldingFigures> folding;
  std::optional<ModelFigures> model;
  std::optional<PrintedFigures> printed;
  std::vector<Fault> faults;
  std::size_t faults_not_listed[promise_count] = {};  ///< per promise, beyond Options::max_faults

  [[nodiscard]] bool sound() const { return faults.empty(); }
};

/// How much a check does and lists.
struct Options {
  std::size_t max_faults = 1000;  ///< listed per promise; the figures count all
  bool folding = false;           ///< move every piece through its fold order: takes as long as all the rest
};

/// The surface that the nets are said to be of, in its own unit.
struct ModelSurface {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< indices into points
  double units_per_point_unit = 1.0;                ///< a point times this is in the unit of the model's file
  std::string digest;                               ///< hash of the file's bytes, or empty
};

}  // namespace ridgecraft::verify
