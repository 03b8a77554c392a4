// SPDX-License-Identifier: GPL-3.0-or-later
// OFF with the variants of Geomview's description: [ST][C][N]OFF, and with counts right behind the keyword
// (ModelNet). One point or face a line; what follows a point's coordinates (normals, texture coordinates) is
// skipped, but for its colour.
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/text.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/source.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

/// Lines between two questions whether to stop.
constexpr std::size_t off_lines_per_check = 1U << 14U;
/// The shortest line of a point is "0 0 0" and a line end, that of a face "0" and a line end; the last has no
/// end.
constexpr std::int64_t point_line_size = 6;
constexpr std::int64_t face_line_size = 2;

class OffReader {
 public:
  explicit OffReader(const Source& source)
      : source_(source), text_(without_trailing_zeros(source.bytes, soup_.remarks)) {
    soup_.format = FileFormat::off;
  }

  Soup read() {
    read_keyword();
    read_counts();
    soup_.points.reserve(static_cast<std::size_t>(points_));
    soup_.first_corner.reserve(static_cast<std::size_t>(faces_) + 1);
    for (std::int64_t i = 0; i < points_; ++i) {
      start_line("points", i, points_);
      read_point(i);
    }
    for (std::int64_t i = 0; i < faces_; ++i) {
      start_line("faces", i, faces_);
      read_face();
    }
    paint_.finish(soup_, {});
    soup_.remarks.add(RepairKind::feature_ignored, numbered_colours_ > 0 ? 1 : 0,
                      "colours by their numbers in a table: write them as red, green and blue");
    if (colour_of_point_.size() == soup_.points.size()) {
      colour_corners(soup_, colour_of_point_);
    }
    text_.skip_space('#');
    if (!text_.done()) {
      soup_.remarks.add(RepairKind::trailing_data_ignored, text_.rest().size(),
                        fmt::format("from line {}", source_.line(text_.place())));
    }
    return std::move(soup_);
  }

 private:
  void read_keyword();
  void read_counts();
  void read_point(std::int64_t number);
  void read_face();
  [[nodiscard]] std::optional<Colour> read_colour();
  std::int64_t read_count(std::string_view what);
  /// To the next line that holds something; refuses a file that ends before.
  void start_line(std::string_view what, std::int64_t done, std::int64_t wanted) {
    text_.skip_space('#');
    if (text_.done()) {
      source_.refuse(ErrorKind::unreadable_input,
                     fmt::format("is cut off: its header says {} {}, {} are there", wanted, what, done));
    }
    if (++lines_ % off_lines_per_check == 0) {
      source_.context.check();
    }
  }
  [[noreturn]] void refuse_word(std::string_view expected) {
    source_.refuse_line(ErrorKind::unreadable_input, text_.place(),
                        text_.line_is_over() ? fmt::format("{} is missing", expected)
                                             : fmt::format("{} is no number{}", in_quotes(text_.peek_word()),
                                                           comma_hint(text_.peek_word())));
  }

  const Source& source_;
  Soup soup_;
  TextScanner text_;
  std::int64_t points_ = 0;
  std::int64_t faces_ = 0;
  std::size_t lines_ = 0;
  bool points_have_colours_ = false;
  bool points_have_normals_ = false;
  std::vector<std::uint32_t> colour_of_point_;
  std::size_t numbered_colours_ = 0;  ///< that are places in a table elsewhere
  FacePaint paint_;
};

void OffReader::read_keyword() {
  text_.skip_space('#');
  const std::string_view word = off_keyword(text_.peek_word());
  if (word.empty()) {
    return;  // the keyword may be left out
  }
  if (word.find('4') != word.npos || word.find('n') != word.npos) {
    source_.refuse(ErrorKind::unreadable_input,
                   fmt::format("is a {} file: only points of three dimensions are read", word));
  }
  points_have_colours_ = word.find('C') != word.npos;
  points_have_normals_ = word.find('N') != word.npos;
  for (std::size_t i = 0; i < word.size(); ++i) {
    text_.advance();
  }
  text_.skip_blanks();
  if (text_.peek_word() == "BINARY") {
    source_.refuse(ErrorKind::unreadable_input,
                   "is a binary OFF file, which isn't supported; save it as text");
  }
}

std::int64_t OffReader::read_count(std::string_view what) {
  std::int64_t count = 0;
  text_.skip_space('#');
  if (!text_.integer(count) || !text_.at_word_end() || count < 0) {
    source_.refuse_line(ErrorKind::unreadable_input, text_.place(),
                        text_.done() ? fmt::format("the number of {} is missing", what)
                                     : fmt::format("the number of {} is expected, not {}", what,
                                                   in_quotes(text_.peek_word())));
  }
  return count;
}

void OffReader::read_counts() {
  points_ = read_count("points");
  faces_ = read_count("faces");
  text_.next_line();  // the number of edges, which nobody needs
  const auto room = static_cast<std::int64_t>(text_.rest().size()) + 1;
  if (points_ > room / point_line_size || faces_ > (room - points_ * point_line_size) / face_line_size) {
    source_.refuse(
        ErrorKind::unreadable_input,
        fmt::format("is cut off: its header says {} points and {} faces, more than the {} bytes that "
                    "follow can hold",
                    points_, faces_, room - 1));
  }
}

void OffReader::read_point(std::int64_t number) {
  double xyz[3];
  bool finite = true;
  for (double& coordinate : xyz) {
    if (text_.line_is_over() || !text_.number(coordinate)) {
      refuse_word("a coordinate");
    }
    finite = finite && std::isfinite(coordinate);
  }
  if (!finite) {
    source_.refuse_line(ErrorKind::unusable_mesh, text_.place(),
                        fmt::format("a coordinate of point {} is not finite", number));
  }
  soup_.points.push_back({xyz[0], xyz[1], xyz[2]});
  if (points_have_colours_) {
    double ignored = 0.0;
    for (int i = 0; points_have_normals_ && i < 3 && !text_.line_is_over() && text_.number(ignored); ++i) {
    }
    // A point without one stops all: which points have one wouldn't be known.
    if (const auto colour = read_colour()) {
      colour_of_point_.push_back(packed_colour(*colour));
    }
  }
  text_.next_line();
}

void OffReader::read_face() {
  std::int64_t corners = 0;
  if (!text_.integer(corners) || !text_.at_word_end()) {
    refuse_word("the number of corners");
  }
  if (corners < 0) {
    source_.refuse_line(ErrorKind::unreadable_input, text_.place(),
                        "a face has a negative number of corners");
  }
  const char* const start = text_.place();
  bool goes_on = false;  // over the end of a line
  for (std::int64_t i = 0; i < corners; ++i) {
    std::int64_t point = 0;
    goes_on = goes_on || text_.line_is_over();
    text_.skip_space('#');
    if (text_.done()) {
      source_.refuse_line(ErrorKind::unreadable_input, start, "a corner is missing");
    }
    if (!text_.integer(point) || !text_.at_word_end()) {
      refuse_word("a corner");
    }
    if (point < 0 || point >= points_) {
      source_.refuse_line(
          ErrorKind::unreadable_input, text_.place(),
          fmt::format("a face names point {}, but points are numbered 0 to {}", point, points_ - 1));
    }
    soup_.corner_point.push_back(static_cast<std::uint32_t>(point));
  }
  if (goes_on && !text_.line_is_over()) {  // the count of the next face was taken for a corner
    source_.refuse_line(ErrorKind::unreadable_input, start, "a corner is missing");
  }
  check_corner_count(source_, soup_);
  soup_.first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_point.size()));
  if (const auto colour = read_colour()) {
    paint_.add(soup_, colour, Soup::none);
  }
  text_.next_line();
}

/// Three or four numbers after a face or a point are its colour: bytes where all are integers, else shares
/// of 1. A single number is an index into a table that the file doesn't have.
std::optional<Colour> OffReader::read_colour() {
  Colour colour{};
  bool bytes = true;
  for (double& channel : colour) {
    if (text_.line_is_over()) {
      numbered_colours_ += &channel == &colour[1] ? 1U : 0U;
      return std::nullopt;
    }
    const std::string_view word = text_.peek_word();
    if (!text_.number(channel)) {
      return std::nullopt;
    }
    bytes = bytes && word.find_first_of(".eEnN") == word.npos;
  }
  if (bytes) {
    for (double& channel : colour) {
      channel /= 255.0;
    }
  }
  return colour;
}

}  // namespace

Soup read_off(const Source& source) {
  return OffReader(source).read();
}

}  // namespace ridgecraft::mesh
