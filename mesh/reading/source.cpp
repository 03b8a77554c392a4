// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/source.hpp"

#include <algorithm>
#include <cmath>

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

void check_repetitions(const Source& source, std::uint64_t held, std::uint64_t points,
                       std::uint64_t corners) {
  // A strip of n points makes n - 2 triangles: three corners for one byte is the most that a file can hold
  // itself.
  const std::uint64_t most = std::max(3 * largest_repeated_count, 3 * held);
  if (points > most || corners > most) {
    source.refuse(ErrorKind::unusable_mesh,
                  fmt::format("repeats its objects until they have more than {} triangles", most / 3));
  }
  if (corners > largest_corner_count) {
    source.refuse(ErrorKind::unreadable_input,
                  fmt::format("is too large: its faces have more than {} corners", largest_corner_count));
  }
}

void add_triangle(Soup& soup, std::array<std::uint32_t, 3> points,
                  const std::optional<std::array<std::uint32_t, 3>>& texture) {
  if (texture) {
    soup.corner_texture.resize(soup.corner_point.size(), Soup::none);
    soup.corner_texture.insert(soup.corner_texture.end(), texture->begin(), texture->end());
  }
  soup.corner_point.insert(soup.corner_point.end(), points.begin(), points.end());
  soup.first_corner.push_back(static_cast<std::uint32_t>(soup.corner_point.size()));
}

void complete_textures(Soup& soup, const std::vector<bool>& bad) {
  std::vector<std::uint32_t>& texture = soup.corner_texture;
  if (texture.empty()) {
    return;
  }
  texture.resize(soup.corner_point.size(), Soup::none);
  std::size_t spoilt = 0;
  for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
    const auto first = texture.begin() + soup.first_corner[i];
    const auto last = texture.begin() + soup.first_corner[i + 1];
    const bool is_spoilt = std::any_of(first, last, [&](std::uint32_t t) {
      return t != Soup::none && (t >= soup.texture_points.size() || bad[t]);
    });
    if (is_spoilt || std::find(first, last, Soup::none) != last) {
      std::fill(first, last, Soup::none);
    }
    spoilt += is_spoilt ? 1U : 0U;
  }
  soup.remarks.add(RepairKind::texture_point_dropped, spoilt);
  if (std::all_of(texture.begin(), texture.end(), [](std::uint32_t t) { return t == Soup::none; })) {
    texture.clear();
  }
}

void complete(Soup& soup) {
  const auto fill = [](std::vector<std::uint32_t>& numbers, std::size_t count) {
    numbers.resize(numbers.empty() ? 0 : count, Soup::none);
  };
  fill(soup.corner_texture, soup.corner_point.size());
  fill(soup.corner_colour, soup.corner_point.size());
  fill(soup.polygon_material, soup.polygon_count());
  if (std::all_of(soup.objects.begin(), soup.objects.end(),
                  [](const auto& object) { return object.second.empty(); })) {
    soup.objects.clear();
  }
}

Colour in_range(Colour colour) {
  for (double& channel : colour) {
    channel = std::isnan(channel) ? 1.0 : std::clamp(channel, 0.0, 1.0);
  }
  return colour;
}

std::uint32_t packed_colour(const Colour& colour) {
  std::uint32_t packed = 0;
  for (const double channel : in_range(colour)) {
    packed = packed << 8U | static_cast<std::uint32_t>(std::lround(255.0 * channel));
  }
  return packed;
}

void colour_corners(Soup& soup, const std::vector<std::uint32_t>& of_point) {
  if (of_point.empty()) {
    return;
  }
  soup.corner_colour.reserve(soup.corner_point.size());
  for (const std::uint32_t p : soup.corner_point) {
    soup.corner_colour.push_back(of_point[p]);
  }
}

void colour_last_triangle(Soup& soup, const std::array<std::uint32_t, 3>& colours) {
  soup.corner_colour.resize(soup.corner_point.size() - colours.size(), Soup::none);
  soup.corner_colour.insert(soup.corner_colour.end(), colours.begin(), colours.end());
}

void MaterialTable::finish(Material& material, std::optional<ColourBytes> own, std::uint32_t number) {
  if (own) {
    material.colour = colour_of(*own);
  }
  if (material.name.empty()) {
    material.name = fmt::format("paint {}", number + 1);
  }
}

}  // namespace ridgecraft::mesh
