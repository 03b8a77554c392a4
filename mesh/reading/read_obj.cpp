// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront OBJ: points, polygons, texture coordinates and materials (Wavefront's "Advanced Visualizer"
// manual, appendix B1). Lines mark edges; curves, points and the like are counted and ignored. Materials are
// read by obj_materials.hpp. ZBrush's colours of points (#MRGB).
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/obj_materials.hpp"
#include "mesh/reading/source.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

/// Lines between two questions whether to stop.
constexpr std::size_t lines_per_check = 1U << 14U;
/// A text that ends within a line is cut off where so many points are used by nothing: programs end their
/// files with a line's end and use their points, and who writes by hand may forget both, but not so often.
constexpr std::size_t lost_points = 3;

class ObjReader {
 public:
  explicit ObjReader(const Source& source)
      : source_(source), text_(without_trailing_zeros(source.bytes, soup_.remarks), true) {}

  Soup read();

 private:
  void read_line();
  void read_comment();
  bool read_element(std::string_view keyword);
  void read_point(const char* line);
  void read_texture_point();
  void read_face(const char* line);
  void read_corner(const char* line);
  void read_lines();
  void finish_lines();
  void add_texture_corner(std::int64_t number);
  void read_usemtl();
  std::string read_name();
  void finish();
  void require_whole_text();
  void finish_materials();
  [[noreturn]] void refuse(const char* line, std::string_view reason) {
    source_.refuse_line(ErrorKind::unreadable_input, line, reason);
  }

  const Source& source_;
  Soup soup_;
  TextScanner text_;

  /// The highest number of a point that a face named before it came, and where.
  std::int64_t highest_point_ = 0;
  const char* highest_point_line_ = nullptr;

  std::vector<std::uint32_t> colour_of_point_;  ///< as Soup::corner_colour; points after the last have none
  std::vector<std::uint32_t> painted_;          ///< the same from comments
  std::vector<bool> bad_texture_point_;

  std::vector<std::string_view> libraries_;
  std::map<std::string_view, std::uint32_t> material_number_;
  /// From this polygon on this material.
  std::vector<std::pair<std::size_t, std::uint32_t>> material_from_;
  /// From this polygon on this object, this group.
  std::vector<std::pair<std::uint32_t, std::string>> objects_, groups_;
  std::vector<std::string_view> material_names_;  ///< of soup_.materials, as the file has them

  struct Line {
    std::array<std::int64_t, 2> points;  ///< counted from 1
    const char* place;
  };
  std::vector<Line> lines_;

  Tally ignored_;
  Tally unknown_;
};

Soup ObjReader::read() {
  // Guesses that real files seldom miss by much; a wrong one costs a copy or some memory that is never
  // touched.
  soup_.points.reserve(source_.bytes.size() / 64);
  soup_.corner_point.reserve(source_.bytes.size() / 24);
  for (std::size_t lines = 1; !text_.done(); ++lines) {
    read_line();
    if (lines % lines_per_check == 0) {
      source_.context.check();
    }
  }
  finish();
  return std::move(soup_);
}

void ObjReader::read_line() {
  if (text_.line_is_over()) {
    read_comment();
    return;
  }
  const char* const line = text_.place();
  const std::string_view keyword = text_.word();
  if (keyword == "v") {
    read_point(line);
  } else if (keyword == "f" || keyword == "fo") {
    read_face(line);
  } else if (keyword == "vt") {
    read_texture_point();
  } else if (!read_element(keyword)) {
    unknown_.add(line);
  }
  text_.next_line();
}

/// ZBrush writes colours of points, in their order, as #MRGB and eight hexadecimal digits each: a mask, red,
/// green, blue.
void ObjReader::read_comment() {
  constexpr std::string_view mark = "#MRGB ";
  constexpr std::size_t digits = 8;
  if (text_.rest().starts_with(mark)) {
    const TextScanner start = text_;
    std::string_view codes = text_.rest_of_line();
    codes.remove_prefix(std::min(mark.size(), codes.size()));
    text_ = start;
    for (; codes.size() >= digits; codes.remove_prefix(digits)) {
      std::uint32_t value = 0;
      const auto [end, error] = std::from_chars(codes.data(), codes.data() + digits, value, 16);
      if (error != std::errc() || end != codes.data() + digits) {
        break;
      }
      painted_.push_back(value & 0xffffffU);
    }
  }
  text_.skip_comment();
}

/// The rest of a line, and of those that a backslash continues it on.
std::string ObjReader::read_name() {
  std::string name(text_.rest_of_line());
  while (name.ends_with('\\') && !text_.done()) {
    name.pop_back();
    text_.next_line();
    name += text_.rest_of_line();
  }
  return name;
}

/// What is neither point nor face. False for words that aren't part of the format.
bool ObjReader::read_element(std::string_view keyword) {
  static constexpr std::string_view silent[] = {
      "vn",       "vp",         "s",         "mg",     "lod", "usemap", "maplib", "bevel", "c_interp",
      "d_interp", "shadow_obj", "trace_obj", "cstype", "deg", "bmat",   "step",   "parm",  "trim",
      "hole",     "scrv",       "sp",        "end",    "con", "ctech",  "stech"};
  static constexpr std::string_view counted[] = {"p",   "curv", "curv2", "surf", "call", "csh",
                                                 "bzp", "bsp",  "cdc",   "cdp",  "res"};
  if (keyword == "usemtl") {
    read_usemtl();
  } else if (keyword == "o" || keyword == "g") {
    (keyword == "o" ? objects_ : groups_)
        .emplace_back(static_cast<std::uint32_t>(soup_.polygon_count()), printable(read_name()));
  } else if (keyword == "l") {
    read_lines();
  } else if (keyword == "mtllib") {
    libraries_.push_back(text_.rest_of_line());
  } else if (std::find(std::begin(counted), std::end(counted), keyword) != std::end(counted)) {
    ignored_.add(keyword.data());
  } else {
    return std::find(std::begin(silent), std::end(silent), keyword) != std::end(silent);
  }
  return true;
}

void ObjReader::read_point(const char* line) {
  double xyz[3];
  for (double& coordinate : xyz) {
    if (text_.line_is_over()) {
      refuse(line, fmt::format("point {} has fewer than three coordinates", soup_.points.size() + 1));
    }
    if (!text_.number(coordinate)) {
      const std::string_view word = text_.peek_word();
      refuse(line, fmt::format("{} is no number{}", in_quotes(word), comma_hint(word)));
    }
  }
  const Vec3 point{xyz[0], xyz[1], xyz[2]};
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
    source_.refuse_line(ErrorKind::unusable_mesh, line,
                        fmt::format("a coordinate of point {} is not finite", soup_.points.size() + 1));
  }
  soup_.points.push_back(point);  // a weight or a colour may follow
  Colour colour{};
  if (std::all_of(colour.begin(), colour.end(),
                  [&](double& channel) { return !text_.line_is_over() && text_.number(channel); })) {
    colour_of_point_.resize(soup_.points.size() - 1, Soup::none);
    // Shares of 1 by custom; a few programs write bytes.
    const bool bytes = *std::max_element(colour.begin(), colour.end()) > 1.0;
    std::for_each(colour.begin(), colour.end(), [&](double& channel) { channel /= bytes ? 255.0 : 1.0; });
    colour_of_point_.push_back(packed_colour(colour));
  }
}

/// One, two or three coordinates; what can't be read makes the point bad, never the file.
void ObjReader::read_texture_point() {
  double uv[2] = {0.0, 0.0};
  bool good = !text_.line_is_over();
  for (double& coordinate : uv) {
    good = good && (text_.line_is_over() || text_.number(coordinate));
    good = good && std::abs(coordinate) <= largest_texture_coordinate;  // false for what is no number, too
  }
  soup_.texture_points.push_back(good ? Vec2{uv[0], uv[1]} : Vec2{});
  bad_texture_point_.push_back(!good);
}

void ObjReader::read_face(const char* line) {
  std::ptrdiff_t slashes = 0;  // of the first corner
  std::size_t corners = 0;
  bool whole = true;
  while (!text_.line_is_over()) {
    const char* const corner = text_.place();
    read_corner(line);
    const std::ptrdiff_t own = std::count(corner, text_.place(), '/');
    slashes = corners == 0 ? own : slashes;
    whole = own >= slashes && text_.place()[-1] != '/';
    ++corners;
  }
  if (text_.done() && (corners < 3 || !whole)) {
    refuse(line, "the file ends within a face, so it is cut off");
  }
  check_corner_count(source_, soup_);
  soup_.first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_point.size()));
}

/// A corner is POINT, POINT/TEXTURE, POINT//NORMAL or POINT/TEXTURE/NORMAL.
void ObjReader::read_corner(const char* line) {
  const TextScanner start = text_;
  std::int64_t point = 0;
  std::int64_t texture = 0;
  std::int64_t normal = 0;
  bool has_texture = false;
  bool good = text_.integer(point);
  if (good && text_.peek() == '/') {
    text_.advance();
    if (text_.peek() != '/' && !text_.at_word_end()) {
      has_texture = good = text_.integer(texture);
    }
    if (good && text_.peek() == '/') {
      text_.advance();
      good = text_.at_word_end() || text_.integer(normal);
    }
  }
  if (!good || !text_.at_word_end()) {
    refuse(line, fmt::format("{} is no corner of a face", in_quotes(start.peek_word())));
  }
  const auto count = static_cast<std::int64_t>(soup_.points.size());
  if (point == 0 || point < -count) {
    refuse(line, point == 0 ? "a face names point 0, but points are numbered from 1"
                            : fmt::format("a face names point {}, but only {} points come before it",
                                          in_quotes(start.peek_word()), count));
  }
  if (point > std::int64_t{Soup::none}) {
    refuse(line, fmt::format("a face names point {}, more than any file has", in_quotes(start.peek_word())));
  }
  if (point < 0) {
    point += count + 1;
  } else if (point > count && point > highest_point_) {
    highest_point_ = point;
    highest_point_line_ = line;
  }
  soup_.corner_point.push_back(static_cast<std::uint32_t>(point - 1));
  if (has_texture) {
    add_texture_corner(texture);
  } else if (!soup_.corner_texture.empty()) {
    soup_.corner_texture.push_back(Soup::none);
  }
}

/// Numbers that refer to nothing are kept as Soup::none - 1 until all texture points are known.
void ObjReader::add_texture_corner(std::int64_t number) {
  constexpr std::int64_t nowhere = Soup::none - 1;
  if (number < 0) {
    number += static_cast<std::int64_t>(soup_.texture_points.size()) + 1;
  }
  if (number <= 0 || number > nowhere) {
    number = nowhere + 1;
  }
  soup_.corner_texture.resize(soup_.corner_point.size() - 1, Soup::none);
  soup_.corner_texture.push_back(static_cast<std::uint32_t>(number - 1));
}

/// POINT or POINT/TEXTURE, at least two of them. Lines are no part of the surface, so bad ones are left out.
void ObjReader::read_lines() {
  const char* const place = text_.place();
  const auto count = static_cast<std::int64_t>(soup_.points.size());
  std::optional<std::int64_t> before;
  while (!text_.line_is_over()) {
    std::int64_t point = 0;
    if (!text_.integer(point)) {
      ignored_.add(place);
      return;
    }
    point += point < 0 ? count + 1 : 0;
    if (before) {
      lines_.push_back({{*before, point}, place});
    }
    before = point;
    while (!text_.at_word_end()) {
      text_.advance();
    }
  }
}

void ObjReader::finish_lines() {
  const auto count = static_cast<std::int64_t>(soup_.points.size());
  for (const Line& line : lines_) {
    const auto [a, b] = line.points;
    if (a >= 1 && b >= 1 && a <= count && b <= count && a != b) {
      soup_.lines.push_back({static_cast<std::uint32_t>(a - 1), static_cast<std::uint32_t>(b - 1)});
    } else {
      ignored_.add(line.place);
    }
  }
}

void ObjReader::read_usemtl() {
  const std::string_view name = text_.rest_of_line();
  std::uint32_t number = Soup::none;
  if (!name.empty()) {
    const auto [found, fresh] =
        material_number_.try_emplace(name, static_cast<std::uint32_t>(material_number_.size()));
    number = found->second;
  }
  material_from_.emplace_back(soup_.polygon_count(), number);
}

/// Most of a text that is cut off is points that its faces are lacking to. Nothing is known where elements
/// were ignored, which may use points, or where a remark of the program that wrote it comes last.
void ObjReader::require_whole_text() {
  if (soup_.polygon_count() == 0 || is_line_end(source_.bytes.back()) || ignored_.count > 0) {
    return;
  }
  const auto last_line = std::find_if(source_.bytes.rbegin(), source_.bytes.rend(), is_line_end).base();
  if (last_line != source_.bytes.end() && *last_line == '#') {
    return;
  }
  std::vector<bool> used(soup_.points.size(), false);
  for (const std::uint32_t p : soup_.corner_point) {
    used[p] = true;
  }
  for (const auto& line : soup_.lines) {
    used[line[0]] = used[line[1]] = true;
  }
  const auto unused = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  if (unused >= lost_points) {
    source_.refuse(
        ErrorKind::unreadable_input,
        fmt::format("ends within a line, and {} of its {} points are used by no face: it is cut off", unused,
                    used.size()));
  }
}

void ObjReader::finish() {
  if (highest_point_ > static_cast<std::int64_t>(soup_.points.size())) {
    refuse(highest_point_line_, fmt::format("a face names point {}, but the file has only {} points",
                                            highest_point_, soup_.points.size()));
  }
  if (soup_.points.empty() && soup_.polygon_count() == 0 && unknown_.count > 0) {
    refuse(unknown_.first, "this is no OBJ file, nor another known mesh format");
  }
  finish_lines();
  require_whole_text();
  ignored_.report(RepairKind::element_ignored, source_, soup_.remarks);
  unknown_.report(RepairKind::element_ignored, source_, soup_.remarks);
  complete_textures(soup_, bad_texture_point_);
  finish_materials();
  if (colour_of_point_.empty()) {
    colour_of_point_ = std::move(painted_);
  }
  if (!colour_of_point_.empty()) {
    colour_of_point_.resize(soup_.points.size(), Soup::none);
    colour_corners(soup_, colour_of_point_);
  }
  soup_.objects = std::move(objects_.empty() ? groups_ : objects_);
}

/// Keeps the materials that polygons have, in the order of their first use.
void ObjReader::finish_materials() {
  std::vector<std::string_view> names(material_number_.size());
  for (const auto& [name, number] : material_number_) {
    names[number] = name;
  }
  std::vector<std::uint32_t> kept(names.size(), Soup::none);
  material_from_.emplace_back(soup_.polygon_count(), Soup::none);
  for (std::size_t i = 0; i + 1 < material_from_.size(); ++i) {
    const auto [first, number] = material_from_[i];
    const std::size_t last = material_from_[i + 1].first;
    if (number == Soup::none || first == last) {
      continue;
    }
    if (kept[number] == Soup::none) {
      kept[number] = static_cast<std::uint32_t>(soup_.materials.size());
      soup_.materials.push_back({printable(names[number]), std::nullopt, {}});
      material_names_.push_back(names[number]);
    }
    soup_.polygon_material.resize(soup_.polygon_count(), Soup::none);
    std::fill(soup_.polygon_material.begin() + static_cast<std::ptrdiff_t>(first),
              soup_.polygon_material.begin() + static_cast<std::ptrdiff_t>(last), kept[number]);
  }
  read_material_files(source_, libraries_, material_names_, soup_);
}

}  // namespace

Soup read_obj(const Source& source) {
  return ObjReader(source).read();
}

}  // namespace ridgecraft::mesh
