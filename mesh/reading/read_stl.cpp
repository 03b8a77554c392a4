// SPDX-License-Identifier: GPL-3.0-or-later
// STL, ASCII and binary: facets with corners of their own. Normals are ignored, since the order of the
// corners says where the outside is. Attribute bytes of binary files are colours where they can be: as VisCAM
// and SolidView write them, or as Materialise Magics does.
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "base/encodings.hpp"
#include "base/text.hpp"
#include "mesh/reading/source.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

/// Facets between two questions whether to stop.
constexpr std::uint32_t facets_per_check = 1U << 14U;

float read_float(const char* at) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(little_endian({at, 4})));
}

bool finite(Vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void close_polygon(Soup& soup) {
  soup.first_corner.push_back(static_cast<std::uint32_t>(soup.corner_point.size()));
}

void add_corner(Soup& soup, Vec3 point) {
  soup.corner_point.push_back(static_cast<std::uint32_t>(soup.points.size()));
  soup.points.push_back(point);
}

/// How many facets to read: the header's count where the size of the file agrees, else what the size says.
std::uint64_t facets_to_read(const Source& source, RepairReport& remarks) {
  const std::uint64_t size = source.bytes.size();
  const std::uint64_t count = stl_facet_count(source.bytes);
  const std::uint64_t room = (size - stl_header_size) / stl_facet_size;
  if (count > room) {
    source.refuse(ErrorKind::unreadable_input,
                  fmt::format("is cut off or no STL file: its header says {} facets, its {} bytes hold {}",
                              count, size, room));
  }
  const std::uint64_t surplus = size - stl_file_size(count);
  if (surplus > 0 && surplus % stl_facet_size == 0) {
    remarks.add(RepairKind::count_corrected, 1, fmt::format("{} facets, not {}", room, count));
    return room;
  }
  if (count == 0 && surplus > 0) {
    source.refuse(ErrorKind::unreadable_input,
                  fmt::format("is no STL file: its header says 0 facets and {} bytes follow", surplus));
  }
  remarks.add(RepairKind::trailing_data_ignored, surplus);
  return count;
}

/// Reads one or more solids of facets.
class AsciiReader {
 public:
  explicit AsciiReader(const Source& source)
      : source_(source), text_(without_trailing_zeros(source.bytes, soup_.remarks)) {
    soup_.format = FileFormat::stl_ascii;
    // A facet takes 130 bytes or more; memory that isn't needed is never touched.
    soup_.points.reserve(source.bytes.size() / 44);
    soup_.corner_point.reserve(source.bytes.size() / 44);
  }

  Soup read() {
    while (read_solid()) {
    }
    return std::move(soup_);
  }

 private:
  bool read_solid();
  /// The blanks of this line before the place.
  [[nodiscard]] std::string_view blanks_before(const char* place) const {
    const char* first = place;
    while (first != source_.bytes.data() && is_blank(first[-1])) {
      --first;
    }
    return text_between(first, place);
  }
  /// Whether another facet has begun with nothing but its indentation.
  [[nodiscard]] bool ends_in_indentation() const {
    const std::string_view text = source_.bytes;
    const std::string_view last = blanks_before(text.data() + text.size());
    return !last.empty() && last.size() < text.size() && is_line_end(text[text.size() - last.size() - 1]) &&
           indentation_.starts_with(last);
  }
  void read_facet(const char* start);
  void read_vertex();
  [[nodiscard]] std::string_view next_word() {
    text_.skip_space('\0');
    return text_.word();
  }
  void expect(std::string_view keyword) {
    const std::string_view word = next_word();
    if (!equal_ignoring_case(word, keyword)) {
      refuse(word, fmt::format("{} is expected", keyword));
    }
  }
  [[noreturn]] void refuse(std::string_view word, std::string_view reason) {
    if (word.empty()) {
      source_.refuse(ErrorKind::unreadable_input,
                     fmt::format("is cut off: it ends within facet {}", soup_.polygon_count() + 1));
    }
    source_.refuse_line(ErrorKind::unreadable_input, word.data(),
                        fmt::format("{}, not {}", reason, in_quotes(word)));
  }

  const Source& source_;
  Soup soup_;
  TextScanner text_;
  std::string_view indentation_;  ///< of the last facet's first line
};

/// False at the end of the file.
bool AsciiReader::read_solid() {
  std::string_view word = next_word();
  if (word.empty()) {
    return false;
  }
  if (!equal_ignoring_case(word, "solid")) {
    soup_.remarks.add(RepairKind::trailing_data_ignored, word.size() + text_.rest().size(),
                      fmt::format("from line {}", source_.line(word.data())));
    return false;
  }
  (void)text_.rest_of_line();
  while (true) {
    word = next_word();
    if (equal_ignoring_case(word, "facet")) {
      indentation_ = blanks_before(word.data());
      read_facet(word.data());
    } else if (equal_ignoring_case(word, "color")) {
      (void)text_.rest_of_line();
      soup_.remarks.add(RepairKind::feature_ignored,
                        soup_.remarks.count(RepairKind::feature_ignored) == 0 ? 1 : 0,
                        "colours of text: binary STL, OBJ or 3MF keep them");
    } else if (equal_ignoring_case(word, "endsolid")) {
      (void)text_.rest_of_line();
      return true;
    } else if (word.empty() || equal_ignoring_case(word, "solid")) {
      if (word.empty() && ends_in_indentation()) {
        source_.refuse(
            ErrorKind::unreadable_input,
            fmt::format("is cut off: it ends within the line after facet {}", soup_.polygon_count()));
      }
      soup_.remarks.add(RepairKind::missing_end, 1, "endsolid");
      if (word.empty()) {
        return false;
      }
      (void)text_.rest_of_line();
    } else {
      refuse(word, "facet or endsolid is expected");
    }
  }
}

void AsciiReader::read_facet(const char* start) {
  std::string_view word = next_word();
  if (equal_ignoring_case(word, "normal")) {
    for (int i = 0; i < 3; ++i) {
      word = next_word();
      if (equal_ignoring_case(word, "outer")) {
        refuse(word, "a number is expected");
      }
    }
    word = next_word();
  }
  if (!equal_ignoring_case(word, "outer")) {
    refuse(word, "outer loop is expected");
  }
  expect("loop");
  for (word = next_word(); equal_ignoring_case(word, "vertex"); word = next_word()) {
    read_vertex();
  }
  if (!equal_ignoring_case(word, "endloop")) {
    refuse(word, "vertex or endloop is expected");
  }
  expect("endfacet");
  const std::size_t corners = soup_.corner_point.size() - soup_.first_corner.back();
  if (corners < 3) {
    source_.refuse_line(
        ErrorKind::unreadable_input, start,
        fmt::format("facet {} has {} corners instead of 3", soup_.polygon_count() + 1, corners));
  }
  close_polygon(soup_);
  if (soup_.polygon_count() % facets_per_check == 0) {
    check_corner_count(source_, soup_);
    source_.context.check();
  }
}

void AsciiReader::read_vertex() {
  double xyz[3];
  for (double& coordinate : xyz) {
    text_.skip_space('\0');
    if (!text_.number(coordinate)) {
      const std::string_view word = text_.peek_word();
      refuse(word, fmt::format("a number is expected{}", comma_hint(word)));
    }
    if (!std::isfinite(coordinate)) {
      source_.refuse_line(ErrorKind::unusable_mesh, text_.place(),
                          fmt::format("a coordinate of facet {} is not finite", soup_.polygon_count() + 1));
    }
  }
  add_corner(soup_, {xyz[0], xyz[1], xyz[2]});
}

/// Facets' colours: five bits a channel, and one that says whose colour it is.
class AttributeColours {
 public:
  /// Magics says in the header what facets without a colour have, and writes red into the lowest bits; others
  /// write blue there, and set the highest bit where there is a colour.
  explicit AttributeColours(std::string_view header) {
    constexpr std::string_view mark = "COLOR=";
    const std::size_t at = header.substr(0, stl_header_size).find(mark);
    is_magics_ = at != header.npos && at + mark.size() + 3 <= stl_header_size;
    for (std::size_t k = 0; is_magics_ && k < 3; ++k) {
      whole_[k] = static_cast<std::uint8_t>(header[at + mark.size() + k]);
    }
  }

  void add(std::uint16_t attribute) {
    attributes_.push_back(attribute);
    const bool marked = (attribute & own_bit) != 0;
    any_ = any_ || marked;
    // Numbers that some programs leave there are no colours.
    is_other_ = is_other_ || (!marked && attribute != 0);
  }

  void paint(Soup& soup) const {
    if (attributes_.empty() || (!is_magics_ && (!any_ || is_other_))) {
      return;
    }
    std::map<std::optional<ColourBytes>, std::uint32_t> number;
    for (const std::uint16_t attribute : attributes_) {
      const std::optional<ColourBytes> colour = colour_of_facet(attribute);
      const auto [found, fresh] = number.try_emplace(colour, static_cast<std::uint32_t>(number.size()));
      if (fresh) {
        soup.materials.push_back({fmt::format("paint {}", number.size()),
                                  colour ? std::optional(colour_of(*colour)) : std::nullopt,
                                  {}});
      }
      soup.polygon_material.push_back(found->second);
    }
  }

 private:
  static constexpr std::uint16_t own_bit = 0x8000;

  [[nodiscard]] std::optional<ColourBytes> colour_of_facet(std::uint16_t attribute) const {
    const bool marked = (attribute & own_bit) != 0;
    if (marked == is_magics_) {
      return is_magics_ ? std::optional(whole_) : std::nullopt;
    }
    ColourBytes colour{};
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned channel = attribute >> (5U * (is_magics_ ? k : 2 - k)) & 31U;
      colour[k] = static_cast<std::uint8_t>(channel << 3U | channel >> 2U);
    }
    return colour;
  }

  bool is_magics_ = false;
  bool any_ = false;
  bool is_other_ = false;
  ColourBytes whole_{};
  std::vector<std::uint16_t> attributes_;
};

}  // namespace

std::uint32_t stl_facet_count(std::string_view bytes) {
  constexpr std::size_t count_at = 80;
  return static_cast<std::uint32_t>(little_endian(bytes.substr(count_at, 4)));
}

Soup read_stl_ascii(const Source& source) {
  return AsciiReader(source).read();
}

Soup read_stl_binary(const Source& source) {
  Soup soup;
  soup.format = FileFormat::stl_binary;
  const std::uint64_t facets = facets_to_read(source, soup.remarks);
  soup.points.reserve(3 * facets);
  soup.corner_point.reserve(3 * facets);
  soup.first_corner.reserve(facets + 1);
  AttributeColours colours(source.bytes);
  const char* facet = source.bytes.data() + stl_header_size;
  for (std::uint64_t i = 0; i < facets; ++i, facet += stl_facet_size) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const char* const at = facet + 12 + 12 * corner;
      const Vec3 point{double{read_float(at)}, double{read_float(at + 4)}, double{read_float(at + 8)}};
      if (!finite(point)) {
        source.refuse_byte(ErrorKind::unusable_mesh, at,
                           fmt::format("a coordinate of facet {} is not finite", i + 1));
      }
      add_corner(soup, point);
    }
    close_polygon(soup);
    colours.add(static_cast<std::uint16_t>(little_endian({facet + 48, 2})));
    if (i % facets_per_check == 0) {
      source.context.check();
    }
  }
  colours.paint(soup);
  return soup;
}

}  // namespace ridgecraft::mesh
