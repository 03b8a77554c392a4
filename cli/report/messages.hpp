// SPDX-License-Identifier: GPL-3.0-or-later
// What the terminal shows besides a summary, and the exit codes: documented in docs/reference/exit-codes.md
// and `ridgecraft --help`, and never changed.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "cli/arguments/options.hpp"
#include "export/sheet/paper.hpp"
#include "job/remark.hpp"
#include "prepare/prepared/options.hpp"

namespace ridgecraft::cli {

enum class ExitCode : int {
  ok = 0,
  internal = 1,
  usage = 2,
  unreadable_input = 3,
  unusable_mesh = 4,
  no_nets = 5,
  faults_found = 6,  ///< `verify` found faults
  cant_write = 7,
  untold = 8,       ///< all was done and written, but standard output didn't take the summary
  unbuildable = 9,  ///< --strict: nobody could build it at this size
  interrupted = 130,
};

[[nodiscard]] ExitCode exit_code(ErrorKind kind);

class Progress {
 public:
  /// Silent unless `wanted` and standard error is a terminal.
  explicit Progress(bool wanted);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { clear(); }

  /// share 0 .. 1 of a stage.
  void show(std::string_view stage, double share);
  /// Wipes the line, so that other output begins at its start.
  void clear();

 private:
  bool visible_;
  bool drawn_ = false;
  std::mutex mutex_;
  std::string stage_;
  std::chrono::steady_clock::time_point last_{};
};

/// "this takes about 1200 pages; --size 14mm would take about 10". Expected pages have two digits, counted
/// ones all.
[[nodiscard]] Message message(const job::Remark& remark);

/// What a model that is expected to take more pages than these, for its size or its bodies, is refused with;
/// nothing for others.
[[nodiscard]] std::optional<Message> too_many_pages(const job::Remark& remark, std::uint64_t most_pages);

/// Where a size without a unit makes a tiny model: whoever wrote it may have meant centimetres.
[[nodiscard]] std::optional<Message> assumed_unit_warning(const SizeRequest& asked,
                                                          const prepare::SizeOptions& size);

/// Where the margin is narrower than most printers need.
[[nodiscard]] std::optional<Message> narrow_margin_warning(const export_::Paper& paper);

}  // namespace ridgecraft::cli
