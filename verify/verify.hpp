// SPDX-License-Identifier: GPL-3.0-or-later
// A .fold file becomes figures and faults. Shares no algorithm with unfold/ or export/: a mistake there must
// not be made again here. Read this header first; docs/formats.md has the contract.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/context.hpp"

namespace ridgecraft::verify {

/// The contract's promises; form is promise 0.
enum class Promise {
  form = 0,
  lengths = 1,
  no_overlap = 2,
  coverage = 3,
  page_bounds = 4,
  joins = 5,
  refolds = 6
};

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
  std::size_t tabs = 0;
};

struct Report {
  std::optional<Figures> figures;
  std::vector<Fault> faults;
  std::size_t faults_not_listed[7] = {};  ///< per promise, beyond Options::max_faults

  [[nodiscard]] bool sound() const { return faults.empty(); }
};

struct Options {
  std::size_t max_faults = 1000;  ///< listed per promise; the figures count all
};

/// Checks the bytes of a .fold file against all six promises. Never throws for what the bytes hold: whatever
/// isn't in the right form is one fault of Promise::form. Throws Error(interrupted). O(n log n) plus the
/// pairs that come near each other.
[[nodiscard]] Report verify(std::string_view bytes, const Options& options, const Context& context);

/// One JSON object with the keys of the contract's section 5. A fault has its indices by name ("face": 3),
/// several of one kind as a list ("faces": [3, 8]). "faults_not_listed" is there only when the list stopped
/// early.
[[nodiscard]] std::string to_json(const Report& report);

}  // namespace ridgecraft::verify
