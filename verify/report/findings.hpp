// SPDX-License-Identifier: GPL-3.0-or-later
// Where the checks put what they find: figures count everything, the list of faults stops at the limit.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "verify/report/report.hpp"

namespace ridgecraft::verify {

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

}  // namespace ridgecraft::verify
