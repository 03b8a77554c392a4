// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/imported/read_stream.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/printable.hpp"
#include "mesh/reading/check_picture.hpp"
#include "mesh/reading/find_picture.hpp"
#include "mesh/reading/foreign_content.hpp"
#include "mesh/reading/imported/stream.hpp"
#include "mesh/reading/instances.hpp"

namespace ridgecraft::mesh {
namespace {

/// Longer reasons than this don't help.
constexpr std::size_t longest_reason = 160;

class StreamReader {
 public:
  StreamReader(std::string_view stream, FileFormat format, const Source& source)
      : left_(stream), source_(source), pictures_(source, soup_.remarks) {
    soup_.format = format;
  }

  Soup read() {
    expect(imported::start);
    const std::uint32_t kind = index();
    if (kind == imported::kind_refusal) {
      refuse_as_told();
    }
    require(kind == imported::kind_soup);
    read_frame();
    const std::uint32_t moves = index();
    soup_.remarks.add(RepairKind::motion_ignored, moves > 0 ? 1 : 0);
    read_materials();
    read_points();
    read_objects();
    read_polygons();
    expect(imported::end);
    require(left_.empty());
    return std::move(soup_);
  }

 private:
  void require(bool condition) const {
    if (!condition) {
      source_.refuse(ErrorKind::unreadable_input,
                     fmt::format("can't be read: what reads {} files broke off", format_name(soup_.format)));
    }
  }

  [[noreturn]] void refuse_as_told() {
    std::string reason = printable(text());
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    while (reason.ends_with('.') || reason.ends_with(' ')) {
      reason.pop_back();
    }
    if (reason.size() > longest_reason) {
      reason = printable(reason.substr(0, longest_reason)) + " ...";
    }
    source_.refuse(ErrorKind::unreadable_input,
                   fmt::format("can't be read as {}{}{}; {}", format_name(soup_.format),
                               reason.empty() ? "" : ": ", reason, way_by_blender()));
  }

  template <class T>
  T take() {
    require(left_.size() >= sizeof(T));
    T value;
    std::memcpy(&value, left_.data(), sizeof(T));
    left_.remove_prefix(sizeof(T));
    return value;
  }
  std::uint32_t index() { return take<std::uint32_t>(); }
  double number() { return take<double>(); }
  /// How many follow, of so many bytes each at least: never more than the stream can hold.
  std::uint32_t count(std::size_t bytes) {
    const std::uint32_t value = index();
    require(value <= left_.size() / bytes);
    return value;
  }
  std::string_view text() {
    const std::uint32_t size = count(1);
    const std::string_view result = left_.substr(0, size);
    left_.remove_prefix(size);
    return result;
  }
  void expect(std::string_view words) {
    require(left_.starts_with(words));
    left_.remove_prefix(words.size());
  }

  void read_frame() {
    const double unit = number();
    if (std::isfinite(unit) && unit > 0.0) {
      soup_.frame.mm_per_unit = unit;
    }
    const std::uint32_t up = index();
    require(up <= imported::axis_untold);
    if (up != imported::axis_untold) {
      soup_.frame.up = static_cast<Axis>(up);
    }
  }

  void read_materials() {
    const std::uint32_t materials = count(2 * sizeof(std::uint32_t));
    for (std::uint32_t i = 0; i < materials; ++i) {
      Material material;
      material.name = printable(text());
      const bool has_colour = index() != 0;
      Colour colour{};
      bool good = true;
      for (double& channel : colour) {
        channel = number();
        good = good && channel >= 0.0 && channel <= 1.0;
        channel = std::isnan(channel) ? 1.0 : std::clamp(channel, 0.0, 1.0);
      }
      if (has_colour) {
        soup_.remarks.add(RepairKind::material_value_corrected, good ? 0 : 1);
        material.colour = colour;
      }
      read_picture(material);
      soup_.materials.push_back(std::move(material));
    }
  }

  void read_picture(Material& material) {
    const std::uint32_t kind = index();
    require(kind <= imported::picture_file);
    const std::string_view told = text();
    if (kind == imported::picture_file && !source_.folder.empty()) {
      PictureFinder::Found found = pictures_.find(source_.folder, told);
      material.texture_file = std::move(found.file);
      material.picture = std::move(found.bytes);
    } else if (kind == imported::picture_file) {
      material.texture_file = printable(told);
    } else if (kind == imported::picture_bytes) {
      const std::string fault = picture_fault(told);
      if (fault.empty()) {
        material.picture = std::make_shared<const std::string>(told);
      }
      soup_.remarks.add(RepairKind::texture_missing, fault.empty() ? 0 : 1,
                        fmt::format("the picture of material {} {}", in_quotes(material.name), fault));
    }
  }

  void read_points() {
    const std::uint32_t points = count(3 * sizeof(double));
    soup_.points.reserve(points);
    for (std::uint32_t i = 0; i < points; ++i) {
      const double x = number();
      const double y = number();
      const double z = number();
      if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
        source_.refuse(ErrorKind::unusable_mesh, fmt::format("a coordinate of point {} is not finite", i));
      }
      soup_.points.push_back({x, y, z});
    }
    const std::uint32_t places = count(2 * sizeof(double));
    soup_.texture_points.reserve(places);
    good_place_.reserve(places);
    for (std::uint32_t i = 0; i < places; ++i) {
      const Vec2 place{number(), number()};
      // False for what is no number, too.
      good_place_.push_back(std::abs(place.x) <= largest_texture_coordinate &&
                            std::abs(place.y) <= largest_texture_coordinate);
      soup_.texture_points.push_back(good_place_.back() ? place : Vec2{});
    }
  }

  void read_objects() {
    const std::uint32_t objects = count(2 * sizeof(std::uint32_t));
    for (std::uint32_t i = 0; i < objects; ++i) {
      const std::uint32_t first = index();
      require(soup_.objects.empty() || soup_.objects.back().first <= first);
      soup_.objects.emplace_back(first, printable(text()));
    }
  }

  void read_polygons() {
    const std::uint32_t polygons = count(sizeof(std::uint32_t));
    std::uint64_t corners = 0;
    soup_.first_corner.reserve(std::size_t{polygons} + 1);
    for (std::uint32_t i = 0; i < polygons; ++i) {
      corners += index();
      require(corners <= left_.size());
      soup_.first_corner.push_back(static_cast<std::uint32_t>(corners));
    }
    require(soup_.objects.empty() || soup_.objects.back().first <= polygons);
    require(count(2 * sizeof(std::uint32_t)) == corners);
    check_repetitions(source_, source_.bytes.size(), soup_.points.size(), corners);
    soup_.corner_point = indices(corners, soup_.points.size(), false);
    soup_.corner_texture = indices(corners, soup_.texture_points.size(), true);
    soup_.polygon_material = indices(polygons, soup_.materials.size(), true);
    drop_bad_places();
    check_corner_count(source_, soup_);
    finish_triangles(soup_);
  }

  std::vector<std::uint32_t> indices(std::uint64_t how_many, std::size_t below, bool may_be_none) {
    require(how_many <= left_.size() / sizeof(std::uint32_t));
    std::vector<std::uint32_t> result;
    result.reserve(how_many);
    for (std::uint64_t i = 0; i < how_many; ++i) {
      result.push_back(index());
      require(result.back() < below || (may_be_none && result.back() == imported::no_index));
    }
    const bool all_none =
        std::all_of(result.begin(), result.end(), [](std::uint32_t i) { return i == imported::no_index; });
    return may_be_none && all_none ? std::vector<std::uint32_t>() : result;
  }

  /// A polygon has places in the picture at all of its corners or at none.
  void drop_bad_places() {
    std::vector<std::uint32_t>& texture = soup_.corner_texture;
    std::size_t spoilt = 0;
    for (std::size_t i = 0; !texture.empty() && i < soup_.polygon_count(); ++i) {
      const auto first = texture.begin() + soup_.first_corner[i];
      const auto last = texture.begin() + soup_.first_corner[i + 1];
      const bool bad =
          std::any_of(first, last, [&](std::uint32_t t) { return t != Soup::none && !good_place_[t]; });
      if (bad || std::find(first, last, Soup::none) != last) {
        std::fill(first, last, Soup::none);
      }
      spoilt += bad ? 1U : 0U;
    }
    soup_.remarks.add(RepairKind::texture_point_dropped, spoilt);
  }

  std::string_view left_;
  const Source& source_;
  Soup soup_;
  PictureFinder pictures_;
  std::vector<bool> good_place_;
};

}  // namespace

Soup read_stream(std::string_view stream, FileFormat format, const Source& source) {
  return StreamReader(stream, format, source).read();
}

}  // namespace ridgecraft::mesh
