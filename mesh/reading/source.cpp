// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/source.hpp"

#include <fmt/format.h>

namespace ridgecraft::mesh {

std::size_t Source::line(const char* place) const {
  std::size_t number = 1;
  for (const char* at = bytes.data(); at < place; ++at) {
    // A CR LF pair is one line end, a CR alone is one, too.
    if (*at == '\n' || (*at == '\r' && (at + 1 == place || at[1] != '\n'))) {
      ++number;
    }
  }
  return number;
}

void Source::refuse(ErrorKind kind, std::string_view reason) const {
  throw Error(kind, fmt::format("{} {}", file, reason), file);
}

void Source::refuse_line(ErrorKind kind, const char* place, std::string_view reason) const {
  throw Error(kind, fmt::format("{}, line {}: {}", file, line(place), reason), file);
}

void Source::refuse_byte(ErrorKind kind, const char* place, std::string_view reason) const {
  throw Error(kind, fmt::format("{}, byte {}: {}", file, place - bytes.data(), reason), file);
}

void Tally::report(RepairKind kind, const Source& source, RepairReport& report) const {
  if (count > 0) {
    report.add(kind, count, fmt::format("{}line {}", count > 1 ? "first: " : "", source.line(first)));
  }
}

void check_corner_count(const Source& source, const Soup& soup) {
  if (soup.corner_point.size() > largest_corner_count) {
    source.refuse(ErrorKind::unreadable_input,
                  fmt::format("is too large: its faces have more than {} corners", largest_corner_count));
  }
}

std::string_view without_trailing_zeros(std::string_view text, RepairReport& remarks) {
  const std::size_t length = text.find_last_not_of(std::string_view("\0\x1a", 2)) + 1;
  // One end mark was how DOS closed every text; nobody needs to hear of it.
  if (text.size() - length > 1 || text.ends_with('\0')) {
    remarks.add(RepairKind::trailing_data_ignored, text.size() - length);
  }
  return text.substr(0, length);
}

}  // namespace ridgecraft::mesh
