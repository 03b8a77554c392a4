// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/pdo/document.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/encodings.hpp"
#include "base/text.hpp"
#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {
namespace {

// Walks through the bytes of a PDO file: numbers, counts and strings, each held against what is left.

/// How a file writes its strings.
struct PdoStrings {
  bool wide = false;            ///< two bytes a character (UTF-16), else one
  std::size_t length_size = 1;  ///< bytes that one unit of a string's length stands for
  std::uint32_t shift = 0;      ///< was added to each character
};

class PdoCursor {
 public:
  explicit PdoCursor(const Source& source) : source_(source) {}

  PdoStrings strings;

  /// Bytes read so far.
  [[nodiscard]] std::size_t at() const { return at_; }

  /// What messages call the place from here on, such as "object 2".
  void enter(std::string place) { place_ = std::move(place); }

  [[nodiscard]] std::uint8_t byte();
  [[nodiscard]] std::uint32_t whole();
  /// The same with a sign.
  [[nodiscard]] std::int32_t number();
  [[nodiscard]] double real();        ///< of eight bytes
  [[nodiscard]] double short_real();  ///< of four bytes
  void skip(std::size_t size) { (void)bytes(size); }
  [[nodiscard]] std::string_view bytes(std::size_t size);
  /// A number of things that take so many bytes each, or more: refused where they can't be there.
  [[nodiscard]] std::size_t count(std::size_t least_size, std::string_view things);
  void skip_string() { (void)raw_string(); }
  /// Printable UTF-8; empty for what can't be told without a table of a country's letters.
  [[nodiscard]] std::string string();

  [[noreturn]] void refuse(std::string_view reason, ErrorKind kind = ErrorKind::unreadable_input) const;

 private:
  [[nodiscard]] std::string_view raw_string();

  const Source& source_;
  std::size_t at_ = 0;
  std::string place_ = "its header";
};

/// Two characters of UTF-16 that stand for one letter beyond the first 65,536 make it; halves alone stay what
/// they are, and aren't printable afterwards.
std::string utf8_of(const std::u16string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::uint32_t letter = text[i];
    if (letter >= 0xd800U && letter < 0xdc00U && i + 1 < text.size() && text[i + 1] >= 0xdc00U &&
        text[i + 1] < 0xe000U) {
      letter = 0x10000U + ((letter - 0xd800U) << 10U) + (text[++i] - 0xdc00U);
    }
    append_utf8(out, letter);
  }
  return out;
}

/// Up to the end mark, which may be shifted like the characters or not.
std::string unshifted(std::string_view raw, std::uint32_t shift) {
  std::string text(raw.substr(0, raw.find_last_not_of('\0') + 1));
  for (char& c : text) {
    c = static_cast<char>(static_cast<unsigned char>(c) - shift);
  }
  return text.substr(0, text.find('\0'));
}

std::string unshifted_wide(std::string_view raw, std::uint32_t shift) {
  std::u16string text;
  for (std::size_t i = 0; i + 1 < raw.size(); i += 2) {
    const std::uint32_t stored = static_cast<unsigned char>(raw[i]) |
                                 static_cast<std::uint32_t>(static_cast<unsigned char>(raw[i + 1])) << 8U;
    const auto letter = static_cast<char16_t>(stored - shift);
    if (stored == 0 || letter == 0) {
      break;
    }
    text += letter;
  }
  return utf8_of(text);
}

void PdoCursor::refuse(std::string_view reason, ErrorKind kind) const {
  source_.refuse_byte(kind, source_.bytes.data() + at_, fmt::format("{}: {}", place_, reason));
}

std::string_view PdoCursor::bytes(std::size_t size) {
  if (size > source_.bytes.size() - at_) {
    source_.refuse(ErrorKind::unreadable_input,
                   fmt::format("is cut off or damaged: it ends after {} bytes, within {}",
                               source_.bytes.size(), place_));
  }
  const std::string_view found = source_.bytes.substr(at_, size);
  at_ += size;
  return found;
}

std::uint8_t PdoCursor::byte() {
  return static_cast<std::uint8_t>(bytes(1).front());
}

std::uint32_t PdoCursor::whole() {
  return static_cast<std::uint32_t>(little_endian(bytes(4)));
}

std::int32_t PdoCursor::number() {
  return static_cast<std::int32_t>(whole());
}

double PdoCursor::real() {
  return std::bit_cast<double>(little_endian(bytes(8)));
}

double PdoCursor::short_real() {
  return static_cast<double>(std::bit_cast<float>(whole()));
}

std::size_t PdoCursor::count(std::size_t least_size, std::string_view things) {
  const std::uint32_t told = whole();
  if (told > (source_.bytes.size() - at_) / least_size) {
    refuse(fmt::format("it says {} {}, more than the {} bytes that follow can hold", told, things,
                       source_.bytes.size() - at_));
  }
  return told;
}

std::string_view PdoCursor::raw_string() {
  return bytes(count(strings.length_size, "letters") * strings.length_size);
}

std::string PdoCursor::string() {
  const std::string_view raw = raw_string();
  std::string text = strings.wide ? unshifted_wide(raw, strings.shift) : unshifted(raw, strings.shift);
  return printable(text) == text ? text : std::string();
}

constexpr std::string_view pdo_start_mark = "version 3\n";
/// The number that stands at the end, 0x270f.
constexpr std::string_view pdo_end_mark("\x0f\x27\0\0", 4);

constexpr std::uint32_t designer2 = 4;
constexpr std::uint32_t designer4 = 6;

// Bytes that things take at least.
constexpr std::size_t pdo_object_size = 17;
constexpr std::size_t pdo_point_size = 24;
constexpr std::size_t pdo_face_size = 44;
constexpr std::size_t pdo_corner_size = 85;
constexpr std::size_t pdo_edge_size = 22;
constexpr std::size_t pdo_material_size = 85;
/// Of a corner: what the nets say of its tab and of the colours of its lines.
constexpr std::size_t pdo_tab_size = 49;
/// Of a face: the turn that lays it flat.
constexpr std::size_t pdo_turn_size = 32;
/// Of a material: four of the five colours, each of four floats.
constexpr std::size_t pdo_other_colours_size = 64;

class DocumentReader {
 public:
  explicit DocumentReader(const Source& source) : source_(source), cursor_(source) {}

  /// `length_size`: bytes that a unit of the length of wide strings stands for.
  PdoDocument read(std::size_t length_size);
  [[nodiscard]] bool wide() const { return cursor_.strings.wide; }
  /// How far it came.
  [[nodiscard]] std::size_t at() const { return cursor_.at(); }

 private:
  void read_header(std::size_t length_size);
  [[nodiscard]] PdoObject read_object(std::size_t number);
  void read_points(PdoObject& object);
  void read_face(PdoObject& object);
  [[nodiscard]] PdoMaterial read_material();

  const Source& source_;
  PdoCursor cursor_;
};

void DocumentReader::read_header(std::size_t length_size) {
  cursor_.skip(pdo_start_mark.size());
  const std::uint32_t version = cursor_.whole();
  if (version < designer2 || version > designer4) {
    source_.refuse(
        ErrorKind::unreadable_input,
        fmt::format("is a Pepakura file of version 3.{}, and only 3.4 to 3.6 are read (Designer 2 to "
                    "5): export it from Pepakura Designer as OBJ",
                    version));
  }
  cursor_.strings.wide = cursor_.whole() != 0;
  cursor_.strings.length_size = cursor_.strings.wide ? length_size : 1;
  cursor_.skip(4);  // a number of the program
  if (version > designer2) {
    cursor_.skip_string();  // the program's name
    cursor_.strings.shift = cursor_.whole();
  }
  cursor_.skip_string();  // language
  cursor_.skip_string();  // letters
  cursor_.skip(4);        // whether pictures of locked files may be exchanged
  bool locked = false;
  if (version == designer4) {
    locked = cursor_.byte() == 1;
    cursor_.skip(1);  // whether the author's words are shown
  }
  cursor_.skip_string();  // checksum
  if (version == designer4) {
    cursor_.skip(8 * cursor_.count(8, "numbers"));
  } else if (version > designer2) {
    cursor_.skip(1);
    locked = cursor_.byte() == 1;
  }
  if (locked) {
    source_.refuse(
        ErrorKind::unreadable_input,
        "is locked by its author with a password: save it without one in Pepakura Designer, or ask "
        "its author");
  }
  cursor_.skip(4 * 8);  // its largest extent and its origin
}

void DocumentReader::read_points(PdoObject& object) {
  const std::size_t count = cursor_.count(pdo_point_size, "points");
  object.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = cursor_.real();
    const double y = cursor_.real();
    const double z = cursor_.real();
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
      cursor_.refuse(fmt::format("a coordinate of point {} is not finite", i), ErrorKind::unusable_mesh);
    }
    object.points.push_back({x, y, z});
  }
}

void DocumentReader::read_face(PdoObject& object) {
  PdoFace face;
  face.material = cursor_.whole();
  face.piece = cursor_.number();
  cursor_.skip(pdo_turn_size);
  face.first_corner = static_cast<std::uint32_t>(object.corners.size());
  face.corner_count = static_cast<std::uint32_t>(cursor_.count(pdo_corner_size, "corners"));
  for (std::uint32_t k = 0; k < face.corner_count; ++k) {
    PdoCorner corner;
    corner.point = cursor_.whole();
    if (corner.point >= object.points.size()) {
      cursor_.refuse(fmt::format("face {} names point {}, but there are {}", object.faces.size(),
                                 corner.point, object.points.size()));
    }
    corner.flat.x = cursor_.real();
    corner.flat.y = cursor_.real();
    corner.texture.x = cursor_.real();
    corner.texture.y = cursor_.real();
    cursor_.skip(pdo_tab_size);
    object.corners.push_back(corner);
  }
  object.faces.push_back(face);
}

PdoObject DocumentReader::read_object(std::size_t number) {
  cursor_.enter(fmt::format("object {}", number));
  PdoObject object;
  object.name = cursor_.string();
  object.visible = cursor_.byte() != 0;
  read_points(object);
  const std::size_t faces = cursor_.count(pdo_face_size, "faces");
  object.faces.reserve(faces);
  for (std::size_t i = 0; i < faces; ++i) {
    read_face(object);
    if (i % 65536 == 65535) {
      source_.context.check();
    }
  }
  cursor_.skip(pdo_edge_size * cursor_.count(pdo_edge_size, "edges"));
  return object;
}

PdoMaterial DocumentReader::read_material() {
  PdoMaterial material;
  material.name = cursor_.string();
  cursor_.skip(pdo_other_colours_size);
  cursor_.skip(4);  // how much it covers
  for (double& channel : material.colour) {
    channel = cursor_.short_real();
  }
  if (cursor_.byte() == 1) {
    PdoPicture picture;
    picture.width = cursor_.whole();
    picture.height = cursor_.whole();
    picture.packed = cursor_.bytes(cursor_.count(1, "bytes of a picture"));
    material.picture = picture;
  }
  return material;
}

PdoDocument DocumentReader::read(std::size_t length_size) {
  PdoDocument document;
  read_header(length_size);
  const std::size_t objects = cursor_.count(pdo_object_size, "objects");
  for (std::size_t i = 0; i < objects; ++i) {
    document.objects.push_back(read_object(i));
  }
  cursor_.enter("its materials");
  const std::size_t materials = cursor_.count(pdo_material_size, "materials");
  for (std::size_t i = 0; i < materials; ++i) {
    cursor_.enter(fmt::format("material {}", i));
    document.materials.push_back(read_material());
  }
  cursor_.enter("its nets");
  document.has_nets = cursor_.byte() == 1;
  if (document.has_nets) {
    document.mm_per_unit = cursor_.real();
  }
  document.ends_well = source_.bytes.ends_with(pdo_end_mark);
  return document;
}

}  // namespace

bool is_pdo(std::string_view bytes) {
  return bytes.starts_with(pdo_start_mark);
}

PdoDocument read_pdo_document(const Source& source) {
  // The description leaves open whether the length of a string of two bytes a character counts characters or
  // bytes. Files fit one of the two only; of those that fit neither, that counts which goes further.
  DocumentReader characters(source);
  try {
    return characters.read(2);
  } catch (const Error& error) {
    if (!characters.wide() || error.kind() == ErrorKind::interrupted) {
      throw;
    }
    DocumentReader bytes(source);
    try {
      return bytes.read(1);
    } catch (const Error& other) {
      if (other.kind() == ErrorKind::interrupted || bytes.at() > characters.at()) {
        throw;
      }
    }
    throw;
  }
}

std::vector<const PdoObject*> shown_objects(const PdoDocument& document) {
  std::vector<const PdoObject*> shown;
  for (const bool all : {false, true}) {
    for (const PdoObject& object : document.objects) {
      if (all || object.visible) {
        shown.push_back(&object);
      }
    }
    if (!shown.empty()) {
      break;
    }
  }
  return shown;
}

}  // namespace ridgecraft::mesh
