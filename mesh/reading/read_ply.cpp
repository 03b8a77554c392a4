// SPDX-License-Identifier: GPL-3.0-or-later
// PLY: points, faces and triangle strips, their texture coordinates and colours, and marked edges; everything
// else is skipped by its declared type.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "base/text.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/ply_elements.hpp"
#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {
namespace {

/// Elements between two questions whether to stop.
constexpr std::int64_t elements_per_check = 1 << 14;

/// Colour channels are bytes or shares of 1.
double channel(double value, PlyType type) {
  return is_integer(type) ? value / 255.0 : value;
}

class PlyReader {
 public:
  explicit PlyReader(const Source& source)
      : source_(source), header_(read_ply_header(source)), values_(source, header_.encoding, body()) {}

  Soup read();

 private:
  std::string_view body();
  void check_elements();
  void read_points(const PlyElement& element);
  void read_point(const PlyElement& element, const PlyRoles& roles);
  void read_faces(const PlyElement& element);
  void read_face(const PlyElement& element, const PlyRoles& roles);
  void read_indices(const PlyProperty& property);
  void read_texture_list(const PlyProperty& property);
  void read_strips(const PlyElement& element);
  void add_strip(const std::vector<std::int64_t>& strip);
  void read_edges(const PlyElement& element);
  void skip_element(const PlyElement& element);
  void texture_by_point();
  void finish();
  [[nodiscard]] std::uint32_t point_index(std::int64_t index);
  [[nodiscard]] std::uint32_t picture_number(double value) const;
  void add_face_texture();
  void begin(const PlyElement& element, std::int64_t i) {
    values_.begin_row(element, i);
    if (i % elements_per_check == 0) {
      source_.context.check();
    }
  }
  void close_polygon() {
    check_corner_count(source_, soup_);
    soup_.first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_point.size()));
  }

  const Source& source_;
  Soup soup_;
  PlyHeader header_;
  PlyValues values_;
  std::int64_t point_count_ = 0;
  std::vector<Vec2> texture_of_point_;
  std::vector<std::uint32_t> colour_of_point_;  ///< as Soup::corner_colour
  std::vector<double> texture_list_;            ///< of the current face
  FacePaint paint_;
  std::size_t bad_textures_ = 0;
};

std::string_view PlyReader::body() {
  return header_.encoding == PlyEncoding::ascii ? without_trailing_zeros(header_.body, soup_.remarks)
                                                : header_.body;
}

Soup PlyReader::read() {
  soup_.format = header_.encoding == PlyEncoding::ascii ? FileFormat::ply_ascii : FileFormat::ply_binary;
  check_elements();
  for (const PlyElement& element : header_.elements) {
    if (values_.too_few_for(element)) {
      source_.refuse(
          ErrorKind::unreadable_input,
          fmt::format("is cut off: its header says {} elements {}, more than the {} bytes that follow "
                      "can hold",
                      element.count, in_quotes(element.name), values_.rest().size()));
    }
    if (element.name == "vertex") {
      read_points(element);
    } else if (element.name == "face") {
      read_faces(element);
    } else if (element.properties.empty()) {
      continue;  // it takes no bytes, however high the count
    } else if (element.name == "tristrips") {
      read_strips(element);
    } else if (element.name == "edge") {
      read_edges(element);
    } else {
      skip_element(element);
      soup_.remarks.add(RepairKind::feature_ignored, element.count > 0 ? 1 : 0,
                        fmt::format("elements {}", in_quotes(element.name)));
    }
  }
  finish();
  return std::move(soup_);
}

void PlyReader::check_elements() {
  bool has_points = false;
  for (const PlyElement& element : header_.elements) {
    if (element.name != "vertex") {
      continue;
    }
    if (has_points) {
      source_.refuse(ErrorKind::unreadable_input, "has two elements \"vertex\" in its header");
    }
    has_points = true;
    point_count_ = element.count;
    const PlyRoles roles = ply_roles(element, PlyKind::vertex);
    if (!has(roles, PlyRole::x) || !has(roles, PlyRole::y) || !has(roles, PlyRole::z)) {
      source_.refuse(ErrorKind::unreadable_input, "can't be read: its points have no properties x, y and z");
    }
  }
}

void PlyReader::read_points(const PlyElement& element) {
  const PlyRoles roles = ply_roles(element, PlyKind::vertex);
  soup_.points.reserve(static_cast<std::size_t>(element.count));
  for (std::int64_t i = 0; i < element.count; ++i) {
    begin(element, i);
    read_point(element, roles);
  }
}

void PlyReader::read_point(const PlyElement& element, const PlyRoles& roles) {
  double value[8] = {};
  bool textured = false;
  unsigned channels = 0;
  for (std::size_t k = 0; k < roles.size(); ++k) {
    const PlyProperty& property = element.properties[k];
    if (roles[k] == PlyRole::skipped) {
      values_.skip(property);
      continue;
    }
    const std::size_t slot = static_cast<std::size_t>(roles[k]) - static_cast<std::size_t>(PlyRole::x);
    value[slot] = values_.number(property.type);
    if (roles[k] >= PlyRole::red) {
      value[slot] = channel(value[slot], property.type);
      ++channels;
    }
    textured = textured || roles[k] == PlyRole::u;
    if (slot < 3 && !std::isfinite(value[slot])) {
      values_.refuse(ErrorKind::unusable_mesh, "a coordinate is not finite");
    }
  }
  soup_.points.push_back({value[0], value[1], value[2]});
  if (textured) {
    texture_of_point_.push_back({value[3], value[4]});
  }
  if (channels == 3) {
    colour_of_point_.push_back(packed_colour({value[5], value[6], value[7]}));
  }
}

void PlyReader::read_faces(const PlyElement& element) {
  const PlyRoles roles = ply_roles(element, PlyKind::face);
  if (!has(roles, PlyRole::indices) && element.count > 0) {
    source_.refuse(ErrorKind::unreadable_input, "can't be read: its faces have no list vertex_indices");
  }
  const std::size_t slot =
      static_cast<std::size_t>(std::find(roles.begin(), roles.end(), PlyRole::indices) - roles.begin());
  if (slot < roles.size() && !is_integer(element.properties[slot].type)) {
    source_.refuse(ErrorKind::unreadable_input, "can't be read: the points of its faces aren't integers");
  }
  soup_.first_corner.reserve(soup_.first_corner.size() + static_cast<std::size_t>(element.count));
  soup_.corner_point.reserve(soup_.corner_point.size() + 3 * static_cast<std::size_t>(element.count));
  for (std::int64_t i = 0; i < element.count; ++i) {
    begin(element, i);
    read_face(element, roles);
  }
}

void PlyReader::read_face(const PlyElement& element, const PlyRoles& roles) {
  Colour colour{};
  unsigned channels = 0;
  std::uint32_t picture = header_.pictures.empty() ? Soup::none : 0;
  texture_list_.clear();
  for (std::size_t k = 0; k < roles.size(); ++k) {
    const PlyProperty& property = element.properties[k];
    switch (roles[k]) {
      case PlyRole::indices:
        read_indices(property);
        break;
      case PlyRole::texture_list:
        read_texture_list(property);
        break;
      case PlyRole::texture_number:
        picture = picture_number(values_.number(property.type));
        break;
      case PlyRole::red:
      case PlyRole::green:
      case PlyRole::blue:
        colour[static_cast<std::size_t>(roles[k]) - static_cast<std::size_t>(PlyRole::red)] =
            channel(values_.number(property.type), property.type);
        ++channels;
        break;
      default:
        values_.skip(property);
    }
  }
  close_polygon();
  add_face_texture();
  paint_.add(soup_, channels == 3 ? std::optional<Colour>(colour) : std::nullopt, picture);
}

void PlyReader::read_indices(const PlyProperty& property) {
  const std::int64_t length = values_.list_length(property);
  for (std::int64_t i = 0; i < length; ++i) {
    soup_.corner_point.push_back(point_index(values_.integer(property.type)));
  }
}

std::uint32_t PlyReader::point_index(std::int64_t index) {
  if (index < 0 || index >= point_count_) {
    values_.refuse(ErrorKind::unreadable_input,
                   point_count_ == 0 ? fmt::format("it names point {}, but the file has none", index)
                                     : fmt::format("it names point {}, but points are numbered 0 to {}",
                                                   index, point_count_ - 1));
  }
  return static_cast<std::uint32_t>(index);
}

std::uint32_t PlyReader::picture_number(double value) const {
  return value >= 0.0 && value < static_cast<double>(header_.pictures.size())
             ? static_cast<std::uint32_t>(value)
             : Soup::none;
}

void PlyReader::read_texture_list(const PlyProperty& property) {
  const std::int64_t length = values_.list_length(property);
  for (std::int64_t i = 0; i < length; ++i) {
    texture_list_.push_back(values_.number(property.type));
  }
}

/// Texture coordinates of the last polygon's corners, if it has some for each.
void PlyReader::add_face_texture() {
  if (texture_list_.empty() || header_.pictures.empty()) {
    return;
  }
  const std::size_t corners = soup_.corner_point.size() - soup_.first_corner[soup_.polygon_count() - 1];
  const bool good = texture_list_.size() == 2 * corners &&
                    std::all_of(texture_list_.begin(), texture_list_.end(),
                                [](double c) { return std::abs(c) <= largest_texture_coordinate; });
  bad_textures_ += good ? 0U : 1U;
  if (!good) {
    return;
  }
  soup_.corner_texture.resize(soup_.corner_point.size() - corners, Soup::none);
  for (std::size_t i = 0; i < corners; ++i) {
    soup_.corner_texture.push_back(static_cast<std::uint32_t>(soup_.texture_points.size()));
    soup_.texture_points.push_back({texture_list_[2 * i], texture_list_[2 * i + 1]});
  }
}

void PlyReader::read_strips(const PlyElement& element) {
  const PlyRoles roles = ply_roles(element, PlyKind::face);
  std::vector<std::int64_t> strip;
  for (std::int64_t i = 0; i < element.count; ++i) {
    begin(element, i);
    for (std::size_t k = 0; k < roles.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (roles[k] != PlyRole::indices || !is_integer(property.type)) {
        values_.skip(property);
        continue;
      }
      strip.clear();
      const std::int64_t length = values_.list_length(property);
      for (std::int64_t j = 0; j < length; ++j) {
        strip.push_back(values_.integer(property.type));
      }
      add_strip(strip);
    }
  }
}

/// -1 ends a strip within a list; every other triangle of a strip is turned; triangles that name a point
/// twice only join strips and are left out.
void PlyReader::add_strip(const std::vector<std::int64_t>& strip) {
  std::size_t start = 0;
  for (std::size_t i = 0; i < strip.size(); ++i) {
    if (strip[i] == -1) {
      start = i + 1;
      continue;
    }
    const std::uint32_t c = point_index(strip[i]);
    if (i < start + 2) {
      continue;
    }
    std::uint32_t a = point_index(strip[i - 2]);
    std::uint32_t b = point_index(strip[i - 1]);
    if (a == b || b == c || c == a) {
      continue;
    }
    if ((i - start) % 2 == 1) {
      std::swap(a, b);
    }
    soup_.corner_point.insert(soup_.corner_point.end(), {a, b, c});
    close_polygon();
  }
}

/// Edges that the file names by two points: those that no face has in Blender's export, any in others. They
/// are no part of the surface, so bad ones are left out.
void PlyReader::read_edges(const PlyElement& element) {
  const PlyRoles roles = ply_roles(element, PlyKind::edge);
  if (!has(roles, PlyRole::first_end) || !has(roles, PlyRole::second_end)) {
    skip_element(element);
    return;
  }
  std::size_t bad = 0;
  for (std::int64_t i = 0; i < element.count; ++i) {
    begin(element, i);
    std::array<std::int64_t, 2> ends{};
    for (std::size_t k = 0; k < roles.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (roles[k] == PlyRole::skipped) {
        values_.skip(property);
      } else {
        ends[roles[k] == PlyRole::first_end ? 0 : 1] = values_.integer(property.type);
      }
    }
    const auto [a, b] = ends;
    if (a >= 0 && b >= 0 && a < point_count_ && b < point_count_ && a != b) {
      soup_.lines.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
    } else {
      ++bad;
    }
  }
  soup_.remarks.add(RepairKind::element_ignored, bad);
}

void PlyReader::skip_element(const PlyElement& element) {
  for (std::int64_t i = 0; i < element.count; ++i) {
    begin(element, i);
    for (const PlyProperty& property : element.properties) {
      values_.skip(property);
    }
  }
}

/// Texture coordinates that points have are those of the corners, where faces have none of their own.
void PlyReader::texture_by_point() {
  if (texture_of_point_.empty() || !soup_.corner_texture.empty()) {
    return;
  }
  for (std::size_t i = 0; i < soup_.polygon_count(); ++i) {
    const auto polygon = soup_.polygon(i);
    const bool good = std::all_of(polygon.begin(), polygon.end(), [&](std::uint32_t p) {
      const Vec2 at = texture_of_point_[p];
      return std::abs(at.x) <= largest_texture_coordinate && std::abs(at.y) <= largest_texture_coordinate;
    });
    bad_textures_ += good ? 0U : 1U;
    for (const std::uint32_t p : polygon) {
      soup_.corner_texture.push_back(good ? p : Soup::none);
    }
  }
  soup_.texture_points = std::move(texture_of_point_);
  for (Vec2& at : soup_.texture_points) {
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) {
      at = {};
    }
  }
}

void PlyReader::finish() {
  texture_by_point();
  colour_corners(soup_, colour_of_point_);
  soup_.remarks.add(RepairKind::texture_point_dropped, bad_textures_);
  std::vector<PictureFinder::Found> pictures;
  if (!source_.folder.empty()) {
    PictureFinder finder(source_, soup_.remarks);
    for (const std::string_view name : header_.pictures) {
      pictures.push_back(finder.find(source_.folder, name));
    }
  }
  paint_.finish(soup_, pictures);
  const std::string_view rest = values_.rest();
  if (rest.find_first_not_of(" \t\r\n") != rest.npos) {
    soup_.remarks.add(RepairKind::trailing_data_ignored, rest.size());
  }
}

}  // namespace

Soup read_ply(const Source& source) {
  return PlyReader(source).read();
}

}  // namespace ridgecraft::mesh
