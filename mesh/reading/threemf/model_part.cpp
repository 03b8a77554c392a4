// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/threemf/model_part.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <new>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

/// Some three million triangles; no paper model is near it.
constexpr std::uint64_t largest_xml = std::uint64_t{256} << 20U;
constexpr std::uint64_t largest_picture = std::uint64_t{64} << 20U;
/// The tree of an XML text may take this much, 1 GiB.
constexpr std::uint64_t largest_tree = std::uint64_t{1} << 30U;
/// What pugixml takes for an element or a text, and for an attribute.
constexpr std::uint64_t node_size = 64;
constexpr std::uint64_t attribute_size = 40;

bool is_xml_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// An upper bound of the memory that the tree of an XML text takes.
std::uint64_t tree_size(std::string_view text) {
  std::uint64_t size = 0;
  bool after_tag = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '<') {
      size += i + 1 < text.size() && text[i + 1] == '/' ? 0 : node_size;
    } else if (c == '=') {
      size += attribute_size;
    } else if (after_tag && !is_xml_blank(c)) {
      size += node_size;
    }
    after_tag = c == '>' || (after_tag && is_xml_blank(c));
  }
  return size;
}

struct NamedUnit {
  std::string_view name;
  double mm;
};
constexpr std::array named_units{NamedUnit{"micron", 0.001},    NamedUnit{"millimeter", 1.0},
                                 NamedUnit{"centimeter", 10.0}, NamedUnit{"inch", 25.4},
                                 NamedUnit{"foot", 304.8},      NamedUnit{"meter", 1000.0}};

/// Extensions with which the shape is as the meshes say, by a word of their addresses.
constexpr std::array known_extensions{"/core/", "/material/", "/production/", "/slice/", "/trianglesets/"};

std::optional<std::uint32_t> whole(std::string_view text) {
  std::uint32_t value = 0;
  while (!text.empty() && is_blank(text.front())) {
    text.remove_prefix(1);
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool read = error == std::errc() && value < Soup::none && !text.empty() &&
                    std::all_of(end, text.data() + text.size(), is_blank);
  return read ? std::optional(value) : std::nullopt;
}

/// "beamlattice" of "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02": the last part of an
/// address that begins with a letter.
std::string_view extension_name(std::string_view address) {
  std::string_view rest = address;
  while (!rest.empty()) {
    const std::string_view last = rest.substr(rest.rfind('/') + 1);
    if (!last.empty() && (last.front() < '0' || last.front() > '9')) {
      return last;
    }
    rest.remove_suffix(std::min(rest.size(), last.size() + 1));
  }
  return address;
}

class PartReader {
 public:
  PartReader(const Source& source, const std::string& name, RepairReport& remarks)
      : source_(source), name_(name), remarks_(remarks) {}

  ThreemfPart read(const pugi::xml_document& document);

 private:
  void check_extensions(pugi::xml_node model) const;
  void count_thing();
  void read_resource(pugi::xml_node resource);
  void read_object(pugi::xml_node object);
  void read_points(pugi::xml_node vertices, ThreemfObject& object);
  void read_triangles(pugi::xml_node triangles, ThreemfObject& object);
  void read_triangle(pugi::xml_node triangle, ThreemfObject& object);
  void read_group(pugi::xml_node group, std::string_view kind);
  [[nodiscard]] std::vector<ThreemfPaint> read_layers(pugi::xml_node group, std::string_view kind) const;
  [[nodiscard]] ThreemfUse read_use(pugi::xml_node node);
  [[nodiscard]] Affine read_place(pugi::xml_node node) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view text, pugi::xml_node node) const;
  [[nodiscard]] double number(pugi::xml_attribute a) const;
  [[nodiscard]] std::uint32_t needed(pugi::xml_node node, std::string_view key) const;
  [[nodiscard]] std::optional<std::uint32_t> optional(pugi::xml_node node, std::string_view key) const;
  [[nodiscard]] std::optional<ColourBytes> colour(pugi::xml_node node, std::string_view key);
  [[noreturn]] void refuse(std::string_view reason, ErrorKind kind = ErrorKind::unreadable_input) const {
    throw Error(kind, fmt::format("{}, {}{}: {}", source_.file, shortened(name_), where_, reason),
                source_.file);
  }

  const Source& source_;
  const std::string& name_;
  RepairReport& remarks_;
  ThreemfPart part_;
  std::size_t things_ = 0;
  std::string where_;  ///< ", object 3"
};

ThreemfPart PartReader::read(const pugi::xml_document& document) {
  const pugi::xml_node model = document.document_element();
  if (local_name(model.name()) != "model") {
    refuse("it isn't a 3MF model");
  }
  const std::string_view unit = attribute(model, "unit");
  const auto found = std::find_if(named_units.begin(), named_units.end(), [&](const NamedUnit& u) {
    return unit.empty() ? u.mm == 1.0 : u.name == unit;
  });
  if (found == named_units.end()) {
    refuse(fmt::format("the unit {} isn't known", in_quotes(unit)));
  }
  part_.mm_per_unit = found->mm;
  check_extensions(model);
  for (const pugi::xml_node child : model) {
    const std::string_view kind = local_name(child.name());
    if (kind == "resources") {
      for (const pugi::xml_node resource : child) {
        read_resource(resource);
      }
    } else if (kind == "build") {
      where_ = ", build";
      for (const pugi::xml_node item : child) {
        if (local_name(item.name()) == "item") {
          part_.build.push_back(read_use(item));
        }
      }
    }
    where_.clear();
  }
  return std::move(part_);
}

void PartReader::check_extensions(pugi::xml_node model) const {
  TextScanner words(attribute(model, "requiredextensions"));
  for (words.skip_space('\0'); !words.done(); words.skip_space('\0')) {
    const std::string prefix(words.word());
    const std::string_view address = model.attribute(("xmlns:" + prefix).c_str()).value();
    const std::string_view told = address.empty() ? std::string_view(prefix) : address;
    if (std::none_of(known_extensions.begin(), known_extensions.end(), [&](const char* known) {
          return told.find(known) != told.npos || (address.empty() && (prefix == "p" || prefix == "m"));
        })) {
      source_.refuse(
          ErrorKind::unreadable_input,
          fmt::format("needs the 3MF extension {}, which isn't read: export it again without it, or "
                      "as OBJ or STL",
                      in_quotes(extension_name(told))));
    }
  }
}

void PartReader::read_resource(pugi::xml_node resource) {
  count_thing();
  const std::string_view kind = local_name(resource.name());
  if (kind == "object") {
    read_object(resource);
  } else if (kind == "texture2d") {
    where_ = ", a texture";
    part_.textures.emplace(needed(resource, "id"), part_name(attribute(resource, "path")));
  } else if (kind == "basematerials" || kind == "colorgroup" || kind == "texture2dgroup" ||
             kind == "compositematerials" || kind == "multiproperties") {
    read_group(resource, kind);
  }
}

void PartReader::read_object(pugi::xml_node node) {
  where_ = ", an object";
  const std::uint32_t id = needed(node, "id");
  where_ = fmt::format(", object {}", id);
  ThreemfObject object;
  object.name = printable(attribute(node, "name"));
  object.type = attribute(node, "type");
  if (const auto group = optional(node, "pid")) {
    object.paint = {*group, optional(node, "pindex").value_or(0)};
  }
  for (const pugi::xml_node child : node) {
    const std::string_view kind = local_name(child.name());
    if (kind == "components") {
      for (const pugi::xml_node component : child) {
        if (local_name(component.name()) == "component") {
          object.components.push_back(read_use(component));
        }
      }
    } else if (kind == "mesh") {
      for (const pugi::xml_node list : child) {
        if (local_name(list.name()) == "vertices") {
          read_points(list, object);
        } else if (local_name(list.name()) == "triangles") {
          read_triangles(list, object);
        } else if (list.type() == pugi::node_element && local_name(list.name()) != "trianglesets") {
          remarks_.add(RepairKind::feature_ignored, 1, shortened(local_name(list.name())));
        }
      }
    }
  }
  if (!part_.objects.emplace(id, std::move(object)).second) {
    refuse("there are two of this number");
  }
  source_.context.check();
}

double PartReader::number(pugi::xml_attribute a) const {
  TextScanner text(a.value());
  double value = 0.0;
  const bool read = text.number(value);
  text.skip_blanks();
  if (!read || !text.done()) {
    refuse(fmt::format("{} is no number", in_quotes(a.value())));
  }
  return value;
}

void PartReader::read_points(pugi::xml_node vertices, ThreemfObject& object) {
  for (const pugi::xml_node vertex : vertices) {
    Vec3 point;
    int found = 0;
    for (const pugi::xml_attribute a : vertex.attributes()) {
      const std::string_view key = a.name();
      if (key == "x" || key == "y" || key == "z") {
        (key == "x" ? point.x : key == "y" ? point.y : point.z) = number(a);
        ++found;
      }
    }
    if (found != 3) {
      refuse(fmt::format("point {} hasn't three coordinates", object.points.size()));
    }
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
      refuse(fmt::format("a coordinate of point {} is not finite", object.points.size()),
             ErrorKind::unusable_mesh);
    }
    object.points.push_back(point);
  }
}

void PartReader::read_triangles(pugi::xml_node triangles, ThreemfObject& object) {
  for (const pugi::xml_node triangle : triangles) {
    if (local_name(triangle.name()) == "triangle") {
      read_triangle(triangle, object);
    }
  }
}

void PartReader::read_triangle(pugi::xml_node node, ThreemfObject& object) {
  static constexpr std::array<std::string_view, 7> keys{"v1", "v2", "v3", "p1", "p2", "p3", "pid"};
  std::array<std::uint32_t, keys.size()> values{};
  values.fill(Soup::none);
  for (const pugi::xml_attribute a : node.attributes()) {
    const auto key = std::find(keys.begin(), keys.end(), std::string_view(a.name()));
    if (key == keys.end()) {
      if (const auto brush = local_name(a.name()); brush == "paint_color" || brush == "mmu_segmentation") {
        object.painted.emplace_back(static_cast<std::uint32_t>(object.triangles.size()), a.value());
      }
      continue;
    }
    const auto value = whole(a.value());
    if (!value) {
      refuse(
          fmt::format("{} in triangle {} is no whole number", in_quotes(a.value()), object.triangles.size()));
    }
    values[static_cast<std::size_t>(key - keys.begin())] = *value;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (values[k] == Soup::none) {
      refuse(fmt::format("triangle {} has no \"{}\"", object.triangles.size(), keys[k]));
    }
    if (values[k] >= object.points.size()) {
      refuse(fmt::format("triangle {} names point {}, but there are {}", object.triangles.size(), values[k],
                         object.points.size()));
    }
  }
  object.triangles.push_back(
      {{values[0], values[1], values[2]}, values[6], {values[3], values[4], values[5]}});
}

void PartReader::read_group(pugi::xml_node node, std::string_view kind) {
  where_ = fmt::format(", a {}", kind);
  const std::uint32_t id = needed(node, "id");
  where_ = fmt::format(", {} {}", kind, id);
  ThreemfGroup group;
  if (kind == "texture2dgroup") {
    group.texture = needed(node, "texid");
  } else if (kind == "compositematerials" || kind == "multiproperties") {
    group.mixed = read_layers(node, kind);
  }
  for (const pugi::xml_node child : node) {
    const std::string_view element = local_name(child.name());
    if (kind == "basematerials" && element == "base") {
      count_thing();
      group.bases.push_back({printable(attribute(child, "name")), colour(child, "displaycolor")});
    } else if (kind == "colorgroup" && element == "color") {
      group.colours.push_back(colour(child, "color"));
    } else if (kind == "texture2dgroup" && element == "tex2coord") {
      const auto u = numbers(attribute(child, "u"), child);
      const auto v = numbers(attribute(child, "v"), child);
      if (u.size() != 1 || v.size() != 1) {
        refuse("a place in its picture hasn't one \"u\" and one \"v\"");
      }
      group.places.push_back({u[0], v[0]});
    }
  }
  if (!part_.groups.emplace(id, std::move(group)).second) {
    refuse("there are two of this number");
  }
}

/// Mixtures are their largest share, layers the one on top.
std::vector<ThreemfPaint> PartReader::read_layers(pugi::xml_node group, std::string_view kind) const {
  std::vector<ThreemfPaint> paints;
  if (kind == "compositematerials") {
    const std::uint32_t bases = needed(group, "matid");
    const std::vector<double> indices = numbers(attribute(group, "matindices"), group);
    for (const pugi::xml_node child : group) {
      const std::vector<double> shares = numbers(attribute(child, "values"), child);
      const auto most =
          static_cast<std::size_t>(std::max_element(shares.begin(), shares.end()) - shares.begin());
      if (most >= indices.size() || !(indices[most] >= 0.0 && indices[most] < 1e9)) {
        refuse("its mixtures don't fit its materials");
      }
      paints.push_back({bases, static_cast<std::uint32_t>(indices[most])});
    }
    return paints;
  }
  const std::vector<double> groups = numbers(attribute(group, "pids"), group);
  for (const pugi::xml_node child : group) {
    const std::vector<double> indices = numbers(attribute(child, "pindices"), child);
    const double top = groups.empty() ? -1.0 : groups.back();
    // What a layer doesn't say is its first element.
    const double index =
        indices.size() >= groups.size() && !groups.empty() ? indices[groups.size() - 1] : 0.0;
    if (!(top >= 0.0 && top < 4e9 && index >= 0.0 && index < 4e9)) {
      refuse("its layers aren't named by whole numbers");
    }
    paints.push_back({static_cast<std::uint32_t>(top), static_cast<std::uint32_t>(index)});
  }
  return paints;
}

void PartReader::count_thing() {
  if (++things_ > most_threemf_things) {
    source_.refuse(ErrorKind::unreadable_input,
                   fmt::format("is too large: its part {} has more than {} objects and materials",
                               in_quotes(name_), most_threemf_things));
  }
}

ThreemfUse PartReader::read_use(pugi::xml_node node) {
  count_thing();
  return {part_name(attribute(node, "path")), needed(node, "objectid"), read_place(node),
          attribute(node, "printable") != "0"};
}

/// Twelve numbers: a matrix that stands to the right of points, row after row.
Affine PartReader::read_place(pugi::xml_node node) const {
  const std::string_view text = attribute(node, "transform");
  if (text.empty()) {
    return {};
  }
  const std::vector<double> m = numbers(text, node);
  if (m.size() != 12) {
    refuse(fmt::format("a transform has {} numbers instead of 12", m.size()));
  }
  return {{Vec3{m[0], m[3], m[6]}, Vec3{m[1], m[4], m[7]}, Vec3{m[2], m[5], m[8]}}, {m[9], m[10], m[11]}};
}

std::vector<double> PartReader::numbers(std::string_view text, pugi::xml_node node) const {
  std::vector<double> values;
  TextScanner words(text);
  for (words.skip_space('\0'); !words.done(); words.skip_space('\0')) {
    double value = 0.0;
    if (!words.number(value) || !std::isfinite(value)) {
      refuse(fmt::format("{} in {} is no number", in_quotes(words.peek_word()), shortened(node.name())));
    }
    values.push_back(value);
  }
  return values;
}

std::optional<std::uint32_t> PartReader::optional(pugi::xml_node node, std::string_view key) const {
  const std::string_view text = attribute(node, key);
  if (text.empty()) {
    return std::nullopt;
  }
  const auto value = whole(text);
  if (!value) {
    refuse(fmt::format("\"{}\" is {}, which is no whole number", key, in_quotes(text)));
  }
  return value;
}

std::uint32_t PartReader::needed(pugi::xml_node node, std::string_view key) const {
  const auto value = optional(node, key);
  if (!value) {
    refuse(fmt::format("\"{}\" of {} is missing", key, in_quotes(node.name())));
  }
  return *value;
}

/// White where it can't be read, as for materials of other formats.
std::optional<ColourBytes> PartReader::colour(pugi::xml_node node, std::string_view key) {
  const auto bytes = colour_bytes(attribute(node, key));
  remarks_.add(RepairKind::material_value_corrected, bytes ? 0 : 1);
  return bytes;
}

}  // namespace

std::string_view local_name(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == name.npos ? name : name.substr(colon + 1);
}

std::string_view attribute(pugi::xml_node node, std::string_view name) {
  for (const pugi::xml_attribute a : node.attributes()) {
    if (local_name(a.name()) == name) {
      return a.value();
    }
  }
  return {};
}

std::optional<ColourBytes> colour_bytes(std::string_view text) {
  if ((text.size() != 7 && text.size() != 9) || text.front() != '#') {
    return std::nullopt;
  }
  ColourBytes colour{};
  for (std::size_t k = 0; k < 3; ++k) {
    const char* const first = text.data() + 1 + 2 * k;
    const auto [end, error] = std::from_chars(first, first + 2, colour[k], 16);
    if (error != std::errc() || end != first + 2) {
      return std::nullopt;
    }
  }
  return colour;
}

std::string part_name(std::string_view name) {
  name.remove_prefix(std::min(name.find_first_not_of('/'), name.size()));
  return std::string(name);
}

ThreemfPackage::ThreemfPackage(const Source& source)
    : source_(source), archive_(source), root_(find_root()) {}

std::string ThreemfPackage::find_root() {
  const std::string relations = "_rels/.rels";
  const std::string usual = "3D/3dmodel.model";
  if (archive_.has(relations)) {
    const pugi::xml_document document = xml(relations);
    for (const pugi::xml_node relation : document.document_element()) {
      if (attribute(relation, "Type").ends_with("/3dmodel")) {
        const std::string target = part_name(attribute(relation, "Target"));
        if (archive_.has(target)) {
          return target;
        }
      }
    }
  }
  std::string part = archive_.has(usual) ? usual : archive_.first_ending_with(".model");
  if (part.empty()) {
    source_.refuse(ErrorKind::unreadable_input, "is no mesh but a ZIP archive; unpack it first");
  }
  return part;
}

pugi::xml_document ThreemfPackage::xml(const std::string& part) {
  std::string text = archive_.read(part, largest_xml);
  if (tree_size(text) > largest_tree) {
    source_.refuse(ErrorKind::unreadable_input,
                   fmt::format("is too large: its part {} has too many elements", in_quotes(part)));
  }
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), pugi::parse_minimal | pugi::parse_escapes);
  if (result.status == pugi::status_out_of_memory) {
    throw std::bad_alloc();
  }
  if (!result) {
    source_.refuse(
        ErrorKind::unreadable_input,
        fmt::format("can't be read: at byte {} its part {} is no valid XML", result.offset, in_quotes(part)));
  }
  source_.context.check();
  return document;
}

namespace {

/// What `read` gives, or nothing where that can't be read.
template <class Read>
auto if_readable(const Read& read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::unreadable_input) {
      throw;
    }
    return std::nullopt;
  }
}

}  // namespace

std::optional<pugi::xml_document> ThreemfPackage::side_xml(const std::string& part) {
  return has(part) ? if_readable([&] { return xml(part); }) : std::nullopt;
}

std::optional<std::string> ThreemfPackage::side_bytes(const std::string& part) {
  return has(part) ? if_readable([&] { return bytes(part); }) : std::nullopt;
}

std::string ThreemfPackage::bytes(const std::string& part) {
  return archive_.read(part, largest_picture);
}

ThreemfPart read_part(const Source& source, ThreemfPackage& package, const std::string& name,
                      RepairReport& remarks) {
  return PartReader(source, name, remarks).read(package.xml(name));
}

}  // namespace ridgecraft::mesh
