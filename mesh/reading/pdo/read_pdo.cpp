// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/pdo/read_pdo.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <zlib.h>

#include "base/text.hpp"
#include "mesh/reading/pdo/document.hpp"
#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {
namespace {

// Pictures of PDO files are bare pixels; everything else here takes PNG.

/// The bytes of more pixels than this (three each) are refused: 4,700 by 4,700.
inline constexpr std::uint64_t largest_pdo_picture = std::uint64_t{64} << 20U;

/// Either a PNG file or what is wrong, as "is damaged".
struct PdoPng {
  std::string bytes;
  std::string fault;
};

constexpr std::uint64_t picture_channels = 3;
/// No deflate stream unpacks to more than this many times its size.
constexpr std::uint64_t largest_picture_expansion = 1032;

std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24U & 0xffU), static_cast<char>(value >> 16U & 0xffU),
          static_cast<char>(value >> 8U & 0xffU), static_cast<char>(value & 0xffU)};
}

void add_chunk(std::string& png, std::string_view kind, std::string_view content) {
  png += big_endian(static_cast<std::uint32_t>(content.size()));
  const std::size_t from = png.size();
  png += kind;
  png += content;
  png += big_endian(static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(png.data() + from), png.size() - from)));
}

/// Rows as PNG has them: a zero byte (nothing predicted) in front of each. Empty where the packed bytes are
/// damaged or don't hold just these pixels.
std::string unpacked_rows(const PdoPicture& picture) {
  const std::uint64_t row = picture.width * picture_channels;
  std::string rows((row + 1) * picture.height, '\0');
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) {
    throw std::bad_alloc();
  }
  // zlib takes no const, by an old habit.
  // NOLINTNEXTLINE: see above
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(picture.packed.data()));
  stream.avail_in = static_cast<uInt>(picture.packed.size());
  int state = Z_OK;
  bool whole = true;
  for (std::uint32_t y = 0; whole && y < picture.height; ++y) {
    stream.next_out = reinterpret_cast<Bytef*>(rows.data() + y * (row + 1) + 1);
    stream.avail_out = static_cast<uInt>(row);
    state = state == Z_OK ? inflate(&stream, Z_NO_FLUSH) : Z_DATA_ERROR;
    whole = (state == Z_OK || state == Z_STREAM_END) && stream.avail_out == 0;
  }
  if (whole && state == Z_OK) {
    // The stream's end has no pixels, but a checksum.
    Bytef more = 0;
    stream.next_out = &more;
    stream.avail_out = 1;
    state = inflate(&stream, Z_FINISH);
    whole = state == Z_STREAM_END && stream.avail_out == 1;
  }
  inflateEnd(&stream);
  return whole ? rows : std::string();
}

std::string packed_again(const std::string& rows) {
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
                static_cast<uLong>(rows.size()), Z_BEST_SPEED) != Z_OK) {
    throw std::bad_alloc();
  }
  packed.resize(size);
  return packed;
}

PdoPng png_of(const PdoPicture& picture) {
  const std::uint64_t pixels = std::uint64_t{picture.width} * picture.height;
  if (pixels == 0) {
    return {{}, "is empty"};
  }
  // Rows are counted with the byte in front of them, too.
  if (pixels > largest_pdo_picture / picture_channels ||
      picture.height > largest_pdo_picture / picture_channels) {
    return {{}, fmt::format("is too large: {} x {} pixels", picture.width, picture.height)};
  }
  const std::string rows =
      pixels * picture_channels <= largest_picture_expansion * (picture.packed.size() + 1)
          ? unpacked_rows(picture)
          : std::string();
  if (rows.empty()) {
    return {{}, fmt::format("is damaged, or has other than {} x {} pixels", picture.width, picture.height)};
  }
  std::string png = "\x89PNG\r\n\x1a\n";
  // Eight bits a channel, red, green and blue.
  add_chunk(png, "IHDR",
            big_endian(picture.width) + big_endian(picture.height) + std::string("\x08\x02\0\0\0", 5));
  add_chunk(png, "IDAT", packed_again(rows));
  add_chunk(png, "IEND", {});
  return {png, {}};
}

// PDO, the files of Pepakura Designer: the model, in the unit that its nets make millimetres of.

/// Pixels of all pictures together, in bytes.
constexpr std::uint64_t most_pixel_bytes = std::uint64_t{256} << 20U;

class PdoReader {
 public:
  explicit PdoReader(const Source& source) : source_(source), document_(read_pdo_document(source)) {}

  Soup read();

 private:
  using PictureKey = std::tuple<std::uint32_t, std::uint32_t, std::string_view>;

  void add_material(const PdoMaterial& material);
  [[nodiscard]] std::shared_ptr<const std::string> picture(const PdoPicture& picture,
                                                           const std::string& name);
  void add_object(const PdoObject& object);
  [[nodiscard]] std::uint32_t texture_point(Vec2 place);

  const Source& source_;
  PdoDocument document_;
  Soup soup_;
  std::map<PictureKey, std::shared_ptr<const std::string>> pictures_;
  std::uint64_t pixel_bytes_ = 0;
  std::size_t unknown_materials_ = 0;
  std::size_t bad_textures_ = 0;
};

/// Materials often hold the same picture again: it is unpacked once.
std::shared_ptr<const std::string> PdoReader::picture(const PdoPicture& picture, const std::string& name) {
  const auto [found, fresh] = pictures_.try_emplace({picture.width, picture.height, picture.packed});
  if (fresh) {
    pixel_bytes_ += std::uint64_t{3} * picture.width * picture.height;
    PdoPng png = pixel_bytes_ <= most_pixel_bytes ? png_of(picture)
                                                  : PdoPng{{}, "is too large together with those before it"};
    if (png.fault.empty()) {
      found->second = std::make_shared<const std::string>(std::move(png.bytes));
    } else {
      soup_.remarks.add(RepairKind::texture_missing, 1,
                        fmt::format("the picture of material {} {}", in_quotes(name), png.fault));
    }
    source_.context.check();
  }
  return found->second;
}

void PdoReader::add_material(const PdoMaterial& material) {
  Material out;
  out.name = material.name;
  out.colour = in_range(material.colour);
  soup_.remarks.add(RepairKind::material_value_corrected, *out.colour == material.colour ? 0 : 1);
  if (material.picture) {
    out.picture = picture(*material.picture, material.name);
  }
  soup_.materials.push_back(std::move(out));
}

std::uint32_t PdoReader::texture_point(Vec2 place) {
  if (!(std::abs(place.x) <= largest_texture_coordinate && std::abs(place.y) <= largest_texture_coordinate)) {
    ++bad_textures_;
    return Soup::none;
  }
  // The file counts down from the picture's upper edge.
  soup_.texture_points.push_back({place.x, 1.0 - place.y});
  return static_cast<std::uint32_t>(soup_.texture_points.size() - 1);
}

void PdoReader::add_object(const PdoObject& object) {
  soup_.objects.emplace_back(static_cast<std::uint32_t>(soup_.polygon_count()), object.name);
  const auto first = static_cast<std::uint32_t>(soup_.points.size());
  soup_.points.insert(soup_.points.end(), object.points.begin(), object.points.end());
  for (const PdoFace& face : object.faces) {
    const bool known = face.material < soup_.materials.size();
    unknown_materials_ += known || face.material == Soup::none ? 0U : 1U;
    soup_.polygon_material.push_back(known ? face.material : Soup::none);
    const bool painted = known && soup_.materials[face.material].picture;
    for (const PdoCorner& corner : object.corners_of(face)) {
      soup_.corner_point.push_back(first + corner.point);
      soup_.corner_texture.push_back(painted ? texture_point(corner.texture) : Soup::none);
    }
    soup_.first_corner.push_back(static_cast<std::uint32_t>(soup_.corner_point.size()));
  }
}

Soup PdoReader::read() {
  for (const PdoMaterial& material : document_.materials) {
    add_material(material);
  }
  const auto shown = shown_objects(document_);
  for (const PdoObject* const object : shown) {
    add_object(*object);
    check_corner_count(source_, soup_);
  }
  if (soup_.texture_points.empty()) {
    soup_.corner_texture.clear();
  }
  const std::size_t hidden = document_.objects.size() - shown.size();
  soup_.remarks.add(RepairKind::element_ignored, hidden,
                    hidden > 0 ? "objects that the file hides" : std::string());
  soup_.remarks.add(RepairKind::material_unknown, unknown_materials_);
  soup_.remarks.add(RepairKind::texture_point_dropped, bad_textures_);
  soup_.remarks.add(RepairKind::missing_end, document_.ends_well ? 0 : 1);
  soup_.format = FileFormat::pdo;
  if (std::isfinite(document_.mm_per_unit) && document_.mm_per_unit > 0.0) {
    soup_.frame.mm_per_unit = document_.mm_per_unit;
  }
  return std::move(soup_);
}

/// Ends of one fold in two faces lie within this share of its length: far more than floats lose, far less
/// than pieces keep apart.
constexpr double same_place = 1e-3;

/// A side of a face: where the nets lay it, from the point of the smaller number to the other.
struct NetSide {
  std::array<std::uint32_t, 2> points;
  std::int32_t piece;
  std::array<Vec2, 2> flat;
};

std::vector<NetSide> sides_of(const PdoObject& object) {
  std::vector<NetSide> sides;
  sides.reserve(object.corners.size());
  for (const PdoFace& face : object.faces) {
    const auto corners = object.corners_of(face);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const PdoCorner* from = &corners[k];
      const PdoCorner* to = &corners[k + 1 < corners.size() ? k + 1 : 0];
      if (from->point == to->point) {
        continue;
      }
      if (from->point > to->point) {
        std::swap(from, to);
      }
      sides.push_back({{from->point, to->point}, face.piece, {from->flat, to->flat}});
    }
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const NetSide& a, const NetSide& b) { return a.points < b.points; });
  return sides;
}

bool are_folded(const NetSide& a, const NetSide& b) {
  const double near = same_place * length(a.flat[1] - a.flat[0]);
  return a.piece == b.piece && length(b.flat[0] - a.flat[0]) <= near && length(b.flat[1] - a.flat[1]) <= near;
}

/// Sides of one edge, at least two of them in a piece.
void add_edge(std::span<const NetSide> sides, const PdoObject& object, FileSeams& seams) {
  bool fold = false;
  std::size_t in_pieces = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    in_pieces += sides[i].piece >= 0 ? 1U : 0U;
    // Of an edge with many faces neighbours in the file are looked at.
    fold = fold || (i > 0 && sides[i].piece >= 0 && are_folded(sides[i - 1], sides[i]));
  }
  if (in_pieces >= 2) {
    (fold ? seams.keep : seams.cut)
        .push_back({object.points[sides[0].points[0]], object.points[sides[0].points[1]]});
  }
}

}  // namespace

Soup read_pdo(const Source& source) {
  return PdoReader(source).read();
}

bool may_have_seams(std::string_view bytes) {
  return is_pdo(bytes);
}

FileSeams read_seams(std::string_view bytes, std::string_view file_name, const Context& context) {
  const Source source{bytes, printable(file_name), {}, context};
  const PdoDocument document = read_pdo_document(source);
  FileSeams seams;
  for (const PdoObject* const object : shown_objects(document)) {
    std::vector<bool> used(object->points.size(), false);
    for (const PdoCorner& corner : object->corners) {
      used[corner.point] = true;
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (used[i]) {
        seams.points.push_back(object->points[i]);
      }
    }
    const std::vector<NetSide> sides = sides_of(*object);
    for (std::size_t from = 0; from < sides.size();) {
      std::size_t to = from + 1;
      while (to < sides.size() && sides[to].points == sides[from].points) {
        ++to;
      }
      add_edge(std::span(sides).subspan(from, to - from), *object, seams);
      from = to;
    }
    context.check();
  }
  if (!document.has_nets || (seams.cut.empty() && seams.keep.empty())) {
    source.refuse(ErrorKind::unreadable_input, "holds no nets: unfold the model in Pepakura Designer first");
  }
  return seams;
}

}  // namespace ridgecraft::mesh
