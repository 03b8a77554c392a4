// SPDX-License-Identifier: GPL-3.0-or-later
// One function per promise or part of one (docs/reference/formats.md); each adds its faults and sets its
// figures.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "verify/file/file.hpp"
#include "verify/file/relations.hpp"
#include "verify/file/report.hpp"

namespace ridgecraft::verify {

// Where the checks put what they find: figures count everything, the list of faults stops at the limit.

class Findings {
 public:
  explicit Findings(const Options& options) : limit_(std::max<std::size_t>(options.max_faults, 1)) {
    report_.figures.emplace();
  }

  [[nodiscard]] Figures& figures() { return *report_.figures; }
  // These are there from the first time they are asked for.
  [[nodiscard]] FoldingFigures& folding() { return there(report_.folding); }
  [[nodiscard]] ModelFigures& model() { return there(report_.model); }
  [[nodiscard]] PrintedFigures& printed() { return there(report_.printed); }

  [[nodiscard]] bool has(Promise promise) const { return listed_[static_cast<std::size_t>(promise)] > 0; }

  /// Adds a fault; message() is only asked for when the fault is listed.
  template <typename Message>
  void add(Promise promise, std::initializer_list<std::pair<const char*, std::size_t>> indices,
           const Message& message) {
    const auto row = static_cast<std::size_t>(promise);
    if (listed_[row] == limit_) {
      ++report_.faults_not_listed[row];
      return;
    }
    ++listed_[row];
    Fault& fault = report_.faults.emplace_back();
    fault.promise = promise;
    fault.message = message();
    for (const auto& [name, value] : indices) {
      fault.indices.emplace_back(name, static_cast<long long>(value));
    }
  }

  /// The faults in the order of the promises, and within one in the order in which they were found.
  [[nodiscard]] Report take() {
    std::stable_sort(report_.faults.begin(), report_.faults.end(),
                     [](const Fault& a, const Fault& b) { return a.promise < b.promise; });
    return std::move(report_);
  }

 private:
  template <typename T>
  static T& there(std::optional<T>& value) {
    return value ? *value : value.emplace();
  }

  std::size_t limit_;
  std::size_t listed_[promise_count] = {};
  Report report_;
};

/// Promise 1. O(k²) for a face with k corners: all its diagonals.
void check_lengths(const Case& given, Findings& findings);
/// Promise 2.
void check_overlap(const Case& given, Findings& findings);
/// Promise 3.
void check_coverage(const Case& given, Findings& findings);
/// Promise 4.
void check_bounds(const Case& given, Findings& findings);
/// Promise 5: edges of the nets, and pieces as discs with holes.
void check_patches(const Case& given, Findings& findings);
/// Promise 5: folds, cuts and joins against the model.
void check_joins(const Case& given, Findings& findings);
/// Promise 5: tabs.
void check_tabs(const Case& given, Findings& findings);
/// Promise 5: slits that tabs are put through. O(n log n) for slits of bounded number in a piece.
void check_slits(const Case& given, Findings& findings);
/// Promise 5: paper that tabs hang on.
void check_paper_behind_tabs(const Case& given, Findings& findings);
/// Promise 6.
void check_refold(const Case& given, Findings& findings);
/// Promise 7, where the file has a fold order. O(n log n).
void check_fold_order(const Case& given, Findings& findings);
/// The same in motion, where nothing is wrong with lengths, joins and order.
void check_fold_motion(const Case& given, Findings& findings);
/// Promise 8: what the file says of itself.
void check_statements(const Case& given, Findings& findings);
/// The same: what has one number is one row of edges, and chains are rows on both of their pieces, of equal
/// lengths. O(n log n).
void check_chains(const Case& given, Findings& findings);
/// The same: bends are no creases, those at one flat region bend it one way, and none is tighter than paper
/// can be rolled. O(n α(n)).
void check_bends(const Case& given, Findings& findings);
/// The same: pieces that are said to be equal are. O(n log n) for each.
void check_equal_pieces(const Case& given, Findings& findings);
/// The same: where the file has an order of assembly, it can be followed. O(n log n).
void check_assembly(const Case& given, Findings& findings);
/// The same: where separate bodies are glued to each other. O(n log n) for each body.
void check_glue(const Case& given, Findings& findings);
/// Promise 9.
void check_model(const Case& given, const ModelSurface& surface, Findings& findings);
/// Pieces that no knife cuts out, those left out that meet no other piece.
void count_narrow_pieces(const Case& given, Findings& findings);
/// Pieces that hang together by a thread. O(n log n), and for each corner of the outlines with the square of
/// the sides that come near it.
void count_thin_necks(const Case& given, Findings& findings);
/// What the knife cuts and what is folded.
void measure_cuts(const Case& given, Findings& findings);

// The settings under "ridgecraft:settings": which there are, what their values have to be, and what the nets
// say against them.

/// A hash of bytes as hexadecimal digits.
[[nodiscard]] bool is_hash(std::string_view text);

/// Whether there is such a setting, and it says yes.
[[nodiscard]] bool is_true(const Settings& settings, std::string_view name);

/// What the nets were searched with where the settings have another value now; null where they haven't.
[[nodiscard]] const Setting* searched_with(const Settings& settings, std::string_view name);

/// What is wrong with them, a sentence each: unknown or missing ones, values that no option takes, values
/// that contradict each other.
[[nodiscard]] std::vector<std::string> faults_of_settings(const Settings& settings);

/// What contradicts the nets: sizes of model and paper, heights of tabs, numbers of faces. Only settings
/// without faults are looked at. O(n log n).
[[nodiscard]] std::vector<std::string> contradictions(const Case& given);

}  // namespace ridgecraft::verify
