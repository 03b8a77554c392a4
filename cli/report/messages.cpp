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

std::string text_of(const job::ManyPages& many) {
  return fmt::format("this takes {}{:.0f} pages; --size {:.0f}mm would take about {:.0f}",
                     many.counted ? "" : "about ", many.counted ? many.pages : two_digits(many.pages),
                     two_digits(many.size_for_fewer), many.fewer_pages);
}

std::string text_of(const job::ManyBodies& many) {
  return fmt::format("this takes about {:.0f} pages or more, for {} separate bodies", two_digits(many.pages),
                     many.bodies);
}

std::string text_of(const job::ShortFolds& folds) {
  return fmt::format(
      "half of the folds are shorter than {:.1f} mm, too short for fingers; --size {:.0f}mm makes half of "
      "them {:g} mm and longer",
      folds.median_mm, std::ceil(folds.size_for_easy), folds.easy_mm);
}

std::optional<std::string> refusal_of(const job::ManyPages& many, std::uint64_t most_pages) {
  if (many.counted || many.pages <= static_cast<double>(most_pages)) {
    return std::nullopt;
  }
  return fmt::format(
      "at {} the model takes about {:.0f} pages, and more than {} aren't made unasked: --size {:.0f}mm takes "
      "about {:.0f}, --most-pages {:.0f} goes on",
      handy_size(many.size_mm), two_digits(many.pages), most_pages, two_digits(many.size_for_fewer),
      many.fewer_pages, two_digits(most_pages_factor * many.pages));
}

std::optional<std::string> refusal_of(const job::ManyBodies& many, std::uint64_t most_pages) {
  if (many.pages <= static_cast<double>(most_pages)) {
    return std::nullopt;
  }
  return fmt::format(
      "the model has {} separate bodies, which take about {:.0f} pages at any size, and more than {} aren't "
      "made unasked: --only NAME takes some of them, ridgecraft unfold makes their nets without pages, "
      "--most-pages {:.0f} goes on",
      many.bodies, two_digits(many.pages), most_pages, two_digits(most_pages_factor * many.pages));
}

std::optional<std::string> refusal_of(const job::ShortFolds& /*folds*/, std::uint64_t /*most_pages*/) {
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

std::string sentence(const job::Remark& remark) {
  return std::visit([](const auto& told) { return text_of(told); }, remark);
}

std::optional<std::string> too_many_pages(const job::Remark& remark, std::uint64_t most_pages) {
  return std::visit([&](const auto& told) { return refusal_of(told, most_pages); }, remark);
}

std::optional<std::string> assumed_unit_warning(const AskedSize& asked, const prepare::SizeOptions& size) {
  const double mm = size.largest_extent_mm;
  if (!asked.unit_assumed || mm >= tiny_mm) {
    return std::nullopt;
  }
  return fmt::format("{} has no unit, so it means {:g} mm; --size {:g}cm makes a model ten times as large",
                     asked.words, mm, mm);
}

std::optional<std::string> narrow_margin_warning(const export_::Paper& paper) {
  if (paper.margin >= printer_margin_mm) {
    return std::nullopt;
  }
  return fmt::format(
      "most printers don't reach the outer {:g} mm of a sheet: a margin of {:g} mm is for cutting machines",
      printer_margin_mm, paper.margin);
}

}  // namespace ridgecraft::cli
