// SPDX-License-Identifier: GPL-3.0-or-later
// A 3MF file as a package of parts (Open Packaging Conventions), and the XML in them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pugixml.hpp>

#include "base/vector.hpp"
#include "mesh/reading/source.hpp"
#include "mesh/reading/zip_archive.hpp"

namespace ridgecraft::mesh {

/// The part of an XML name after its prefix: "color" of "m:color".
[[nodiscard]] std::string_view local_name(std::string_view name);

/// The attribute of this name, with or without a prefix; empty where there is none.
[[nodiscard]] std::string_view attribute(pugi::xml_node node, std::string_view name);

/// A part's name as messages and lists have it: without the slash at its start.
[[nodiscard]] std::string part_name(std::string_view name);

/// "#RRGGBB" or "#RRGGBBAA".
[[nodiscard]] std::optional<ColourBytes> colour_bytes(std::string_view text);

class ThreemfPackage {
 public:
  explicit ThreemfPackage(const Source& source);

  /// The part that the package begins with.
  [[nodiscard]] const std::string& root() const { return root_; }
  /// The XML of a part. Refuses what is no XML, and what would take more memory than is reasonable.
  [[nodiscard]] pugi::xml_document xml(const std::string& part);
  /// The XML of a part that a program added for itself; nothing where there is none, or it is damaged.
  [[nodiscard]] std::optional<pugi::xml_document> side_xml(const std::string& part);
  /// The same of its bytes, where it is no XML.
  [[nodiscard]] std::optional<std::string> side_bytes(const std::string& part);
  [[nodiscard]] bool has(const std::string& part) const { return archive_.has(part); }
  /// The bytes of a part that is no XML.
  [[nodiscard]] std::string bytes(const std::string& part);
  [[nodiscard]] std::uint64_t unpacked() const { return archive_.unpacked(); }

 private:
  [[nodiscard]] std::string find_root();

  const Source& source_;
  ZipArchive archive_;
  std::string root_;
};

// One XML part of a 3MF file: objects, colours, what is to be built.

/// More objects, uses of objects, groups, textures and named materials than this are refused, in one part as
/// in all that is built: few packed bytes can name many.
inline constexpr std::size_t most_threemf_things = 1'000'000;

/// Names a colour, a material or a place in a picture: element `index` of the group with this number.
struct ThreemfPaint {
  std::uint32_t group = Soup::none;
  std::uint32_t index = 0;
};

struct ThreemfTriangle {
  std::array<std::uint32_t, 3> points;
  /// The paint of its corners; the first group is none where it has the object's.
  std::uint32_t group = Soup::none;
  std::array<std::uint32_t, 3> index{Soup::none, Soup::none, Soup::none};
};

/// An object within another, or in the build.
struct ThreemfUse {
  std::string part;  ///< the part that it is in; empty for this one
  std::uint32_t object = 0;
  Affine place;
  bool printable = true;  ///< slicers: whether an item of the build is to be made
};

struct ThreemfObject {
  std::string name;  ///< printable
  std::string type;  ///< "model", "support" and so on
  std::vector<Vec3> points;
  std::vector<ThreemfTriangle> triangles;
  /// What slicers' brushes painted onto triangles, by their numbers, ascending.
  std::vector<std::pair<std::uint32_t, std::string>> painted;
  std::vector<ThreemfUse> components;
  ThreemfPaint paint;  ///< of the triangles that have none
};

/// What paint can be. Exactly one of the lists is filled.
struct ThreemfGroup {
  struct Base {
    std::string name;  ///< printable
    std::optional<ColourBytes> colour;
  };
  std::vector<Base> bases;
  std::vector<std::optional<ColourBytes>> colours;
  std::vector<Vec2> places;   ///< in the picture `texture`
  std::uint32_t texture = 0;  ///< number of a texture
  std::vector<ThreemfPaint>
      mixed;  ///< stands for another paint: the largest share of a mixture, the topmost layer

  [[nodiscard]] std::size_t size() const {
    return bases.size() + colours.size() + places.size() + mixed.size();
  }
};

struct ThreemfPart {
  double mm_per_unit = 1.0;
  std::map<std::uint32_t, ThreemfObject> objects;
  std::map<std::uint32_t, ThreemfGroup> groups;
  std::map<std::uint32_t, std::string> textures;  ///< the part with the picture
  std::vector<ThreemfUse> build;
};

/// Reads a part; the name is used in messages. Indices of points are in range, coordinates finite. Colours
/// that can't be read are remarked on.
[[nodiscard]] ThreemfPart read_part(const Source& source, ThreemfPackage& package, const std::string& name,
                                    RepairReport& remarks);

}  // namespace ridgecraft::mesh
