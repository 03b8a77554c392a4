// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report/messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>
#include <unistd.h>

#include "base/elementary.hpp"

namespace ridgecraft::cli {
namespace {

bool capable_terminal() {
  const char* term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

/// What nearly every printer reaches, mm from the sheet's edge.
constexpr double printer_margin_mm = 3.0;
/// Hardly anybody folds smaller models, mm.
constexpr double tiny_mm = 30.0;

/// Estimates may be so much too small.
constexpr double most_pages_factor = 1.5;

std::string handy_size(double mm) {
  constexpr double metre = 1000.0;
  return mm >= metre ? fmt::format("{:.3g} m", mm / metre) : fmt::format("{:.0f} mm", mm);
}

double two_digits(double value) {
  const double unit = elementary::pow(10.0, std::max(0.0, std::floor(elementary::log10(value)) - 1.0));
  return std::round(value / unit) * unit;
}

std::string whole(double value) {
  return fmt::format("{:.0f}", value);
}

MessageValue proposed_size(double mm) {
  return option_value("try", "size", whole(mm) + "mm");
}

MessageValue more_pages(std::string_view gap, double pages) {
  return option_value(gap, "most-pages", whole(two_digits(most_pages_factor * pages)));
}

Message message_of(const job::ManyPages& many) {
  return Message(many.counted ? "many_pages_counted" : "many_pages",
                 {{"pages", whole(many.counted ? many.pages : two_digits(many.pages))},
                  proposed_size(two_digits(many.size_for_fewer)),
                  {"fewer", whole(many.fewer_pages)}});
}

Message message_of(const job::ManyBodies& many) {
  return Message("many_bodies", {{"pages", whole(two_digits(many.pages))}, {"bodies", many.bodies}});
}

Message message_of(const job::ShortFolds& folds) {
  return Message("short_folds", {{"mm", fmt::format("{:.1f}", folds.median_mm)},
                                 proposed_size(std::ceil(folds.size_for_easy)),
                                 {"easy", fmt::format("{:g}", folds.easy_mm)}});
}

std::optional<Message> refusal_of(const job::ManyPages& many, std::uint64_t most_pages) {
  if (many.counted || many.pages <= static_cast<double>(most_pages)) {
    return std::nullopt;
  }
  return Message("too_many_pages", {{"size", handy_size(many.size_mm)},
                                    {"pages", whole(two_digits(many.pages))},
                                    {"most", most_pages},
                                    proposed_size(two_digits(many.size_for_fewer)),
                                    {"fewer", whole(many.fewer_pages)},
                                    more_pages("go_on", many.pages)});
}

std::optional<Message> refusal_of(const job::ManyBodies& many, std::uint64_t most_pages) {
  if (many.pages <= static_cast<double>(most_pages)) {
    return std::nullopt;
  }
  return Message("too_many_bodies", {{"bodies", many.bodies},
                                     {"pages", whole(two_digits(many.pages))},
                                     {"most", most_pages},
                                     more_pages("try", many.pages)});
}

std::optional<Message> refusal_of(const job::ShortFolds& /*folds*/, std::uint64_t /*most_pages*/) {
  return std::nullopt;
}

}  // namespace

ExitCode exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::internal:
      return ExitCode::internal;
    case ErrorKind::usage:
      return ExitCode::usage;
    case ErrorKind::unreadable_input:
      return ExitCode::unreadable_input;
    case ErrorKind::unusable_mesh:
      return ExitCode::unusable_mesh;
    case ErrorKind::no_nets:
      return ExitCode::no_nets;
    case ErrorKind::unbuildable:
      return ExitCode::unbuildable;
    case ErrorKind::cant_write:
      return ExitCode::cant_write;
    case ErrorKind::interrupted:
    case ErrorKind::out_of_time:
      return ExitCode::interrupted;
  }
  return ExitCode::internal;
}

Progress::Progress(bool wanted) : visible_(wanted && capable_terminal()) {}

void Progress::show(std::string_view stage, double share) {
  if (!visible_) {
    return;
  }
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (stage == stage_ && now - last_ < std::chrono::milliseconds(50)) {
    return;
  }
  stage_ = stage;
  last_ = now;
  constexpr int width = 30;
  const int filled = static_cast<int>(width * std::clamp(share, 0.0, 1.0));
  std::string bar(static_cast<std::size_t>(filled), '#');
  bar.resize(width, '.');
  std::fprintf(stderr, "\r\033[K%-14s [%s] %3d %%", stage_.c_str(), bar.c_str(),
               static_cast<int>(100.0 * std::clamp(share, 0.0, 1.0)));
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  const std::lock_guard lock(mutex_);
  if (drawn_) {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    drawn_ = false;
  }
}

Message message(const job::Remark& remark) {
  return std::visit([](const auto& figures) { return message_of(figures); }, remark);
}

std::optional<Message> too_many_pages(const job::Remark& remark, std::uint64_t most_pages) {
  return std::visit([&](const auto& figures) { return refusal_of(figures, most_pages); }, remark);
}

std::optional<Message> assumed_unit_warning(const SizeRequest& asked, const prepare::SizeOptions& size) {
  const double mm = size.largest_extent_mm;
  if (!asked.unit_assumed || mm >= tiny_mm) {
    return std::nullopt;
  }
  const std::string number = fmt::format("{:g}", mm);
  return Message("assumed_unit",
                 {{"asked", asked.words}, {"mm", number}, option_value("try", "size", number + "cm")});
}

std::optional<Message> narrow_margin_warning(const export_::Paper& paper) {
  if (paper.margin >= printer_margin_mm) {
    return std::nullopt;
  }
  return Message("narrow_margin", {{"reach", fmt::format("{:g}", printer_margin_mm)},
                                   {"mm", fmt::format("{:g}", paper.margin)}});
}

}  // namespace ridgecraft::cli
