// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/elementary.hpp"
#include "base/text.hpp"
#include "base/vector.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/gltf/document.hpp"
#include "mesh/reading/gltf/draco.hpp"
#include "mesh/reading/gltf/shape.hpp"
#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {
namespace {

// Materials and pictures of glTF.

/// How a picture lies on faces.
struct GltfPicture {
  std::string texture_file;                    ///< as in Material
  std::shared_ptr<const std::string> picture;  ///< as in Material
  std::uint64_t coordinates = 0;               ///< which set of coordinates of a point (TEXCOORD_n)
  Vec2 row_u{1.0, 0.0};                        ///< KHR_texture_transform, as the file has it: v runs down
  Vec2 row_v{0.0, 1.0};
  Vec2 shift;

  /// Coordinates of the file become those of Soup: v runs up.
  [[nodiscard]] Vec2 place(Vec2 uv) const {
    return {dot(row_u, uv) + shift.x, 1.0 - (dot(row_v, uv) + shift.y)};
  }
};

struct GltfMaterial {
  std::string name;                ///< printable
  std::optional<Colour> light;     ///< base colour by its light; nothing for white
  std::optional<GltfPicture> map;  ///< a picture that can be used
};

/// Reads materials, each once. Pictures that can't be used are remarked on.
class GltfPaint {
 public:
  GltfPaint(GltfDocument& document, RepairReport& remarks) : document_(document), remarks_(remarks) {}

  /// `user` names the material.
  [[nodiscard]] const GltfMaterial& material(std::uint64_t i, const GltfObject& user);
  /// Of the materials that were asked for.
  [[nodiscard]] std::size_t transparent() const { return transparent_; }

 private:
  [[nodiscard]] GltfMaterial read(const GltfObject& material);
  [[nodiscard]] std::optional<GltfPicture> read_map(const GltfObject& map);
  void load(std::uint64_t image, const GltfObject& texture, GltfPicture& into);

  struct Loaded {
    std::string file;
    std::shared_ptr<const std::string> bytes;
  };

  GltfDocument& document_;
  RepairReport& remarks_;
  std::map<std::uint64_t, GltfMaterial> read_;
  std::map<std::uint64_t, Loaded> loaded_;
  std::uint64_t looked_at_ = 0;  ///< bytes of pictures
  std::size_t transparent_ = 0;
};

std::uint8_t screen_channel(double light) {
  const double in_range = std::isnan(light) ? 1.0 : std::clamp(light, 0.0, 1.0);
  const double shown =
      in_range <= 0.0031308 ? 12.92 * in_range : 1.055 * elementary::pow(in_range, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * shown));
}

/// glTF counts colours by their light, files and screens by what eyes see (sRGB, IEC 61966-2-1).
ColourBytes screen_colour(const Colour& light) {
  return {screen_channel(light[0]), screen_channel(light[1]), screen_channel(light[2])};
}

const GltfMaterial& GltfPaint::material(std::uint64_t i, const GltfObject& user) {
  const auto found = read_.find(i);
  return found != read_.end() ? found->second
                              : read_.emplace(i, read(document_.element("materials", i, user))).first->second;
}

GltfMaterial GltfPaint::read(const GltfObject& material) {
  GltfMaterial out;
  out.name = printable(material.text("name"));
  const std::string alpha = material.text("alphaMode");
  transparent_ += alpha == "MASK" || alpha == "BLEND" ? 1U : 0U;
  // The older way to tell colours, where it is used, is what was meant.
  const auto older = material.extension("KHR_materials_pbrSpecularGlossiness");
  const auto looks = older ? older : material.object("pbrMetallicRoughness");
  if (!looks) {
    return out;
  }
  if (const auto colour = looks->numbers(older ? "diffuseFactor" : "baseColorFactor", 4)) {
    out.light = Colour{(*colour)[0], (*colour)[1], (*colour)[2]};
  }
  if (const auto map = looks->object(older ? "diffuseTexture" : "baseColorTexture")) {
    out.map = read_map(*map);
  }
  return out;
}

std::optional<GltfPicture> GltfPaint::read_map(const GltfObject& map) {
  GltfPicture picture;
  picture.coordinates = map.whole_or("texCoord", 0);
  if (const auto transform = map.extension("KHR_texture_transform")) {
    picture.coordinates = transform->whole_or("texCoord", picture.coordinates);
    const auto scale = transform->numbers("scale", 2).value_or(std::vector{1.0, 1.0});
    const auto shift = transform->numbers("offset", 2).value_or(std::vector{0.0, 0.0});
    const double turn = transform->number("rotation").value_or(0.0);
    picture.row_u = {elementary::cos(turn) * scale[0], elementary::sin(turn) * scale[1]};
    picture.row_v = {-elementary::sin(turn) * scale[0], elementary::cos(turn) * scale[1]};
    picture.shift = {shift[0], shift[1]};
  }
  const GltfObject texture = document_.element("textures", map.needed_whole("index"), map);
  std::optional<std::uint64_t> image = texture.whole("source");
  for (const char* const name :
       {"EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"}) {
    if (const auto other = texture.extension(name); other && !image) {
      image = other->whole("source");
    }
  }
  if (!image) {
    remarks_.add(RepairKind::texture_missing, 1, fmt::format("{} names no picture", texture.place()));
    return std::nullopt;
  }
  load(*image, texture, picture);
  return picture.picture ? std::optional(picture) : std::nullopt;
}

/// Each picture is looked at once, and remarked on once.
void GltfPaint::load(std::uint64_t number, const GltfObject& texture, GltfPicture& into) {
  const auto [entry, fresh] = loaded_.try_emplace(number);
  Loaded& loaded = entry->second;
  if (fresh) {
    const GltfObject image = document_.element("images", number, texture);
    const std::string uri = image.text("uri");
    std::string why;
    std::string bytes;
    std::string file;
    if (is_data_uri(uri)) {
      bytes = data_of_uri(uri).value_or(std::string());
    } else if (!uri.empty()) {
      const FoundInside found = find_inside(document_.source().folder, uri);
      why = found.why;
      if (!found.file.empty()) {
        file = found.file.lexically_relative(document_.source().folder).string();
        try {
          bytes = read_file(found.file);
        } catch (const Error&) {
          why = "can't be read";
        }
      }
    } else {
      const std::string_view within = document_.view(image.needed_whole("bufferView"), image).bytes;
      // Pictures that overlap could be more than any memory holds.
      bytes = looked_at_ + within.size() > 2 * document_.held() ? std::string() : std::string(within);
    }
    looked_at_ += bytes.size();
    if (why.empty()) {
      why = picture_fault(bytes);
    }
    if (!why.empty()) {
      const std::string name = uri.empty() || is_data_uri(uri) ? image.place() : in_quotes(uri);
      remarks_.add(RepairKind::texture_missing, 1, fmt::format("{} {}", name, why));
    } else {
      loaded.file = file;
      loaded.bytes = std::make_shared<const std::string>(std::move(bytes));
    }
    document_.source().context.check();
  }
  into.texture_file = loaded.file;
  into.picture = loaded.bytes;
}

// glTF 2.0 (Khronos, ISO/IEC 12113), as text and as GLB: the triangles of its scene where they stand at rest,
// with colours and pictures. Unit metre, y up, by the standard.

/// What the corners of a primitive make.
enum class Mode : std::uint8_t {
  points,
  lines,
  line_loop,
  line_strip,
  triangles,
  triangle_strip,
  triangle_fan
};

constexpr std::array<std::size_t, 1> two{2};
constexpr std::array<std::size_t, 2> three_or_four{3, 4};

/// Calls use(a, b, c) for each triangle of a list of corners; those that name a point twice only join strips.
template <class Use>
void for_triangles(Mode mode, const std::vector<std::uint32_t>& corners, const Use& use) {
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (mode == Mode::triangles || (a != b && b != c && c != a)) {
      use(std::array{a, b, c});
    }
  };
  if (mode == Mode::triangles) {
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      add(corners[i], corners[i + 1], corners[i + 2]);
    }
    return;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    if (mode == Mode::triangle_fan) {
      add(corners[0], corners[i + 1], corners[i + 2]);
    } else {
      // Every other triangle of a strip runs the other way.
      add(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    }
  }
}

class GltfReader {
 public:
  GltfReader(const Source& source, const GltfContainer& container)
      : source_(source),
        document_(source, container),
        accessors_(document_),
        paint_(document_, soup_.remarks) {}

  Soup read();

 private:
  /// Texture coordinates of a primitive: where they begin in the soup, and which of them can't be used.
  struct Coordinates {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };

  void read_instance(const GltfInstance& instance, const GltfScene& scene);
  void read_primitive(const GltfInstance& instance, const GltfObject& primitive,
                      const std::vector<double>& weights);
  void unpack(const GltfObject& primitive);
  [[nodiscard]] std::uint32_t place_points(const GltfInstance& instance, const GltfObject& primitive,
                                           const std::vector<double>& weights);
  [[nodiscard]] std::optional<Coordinates> place_picture(const GltfObject& attributes, std::uint64_t material,
                                                         const GltfPicture& picture);
  void add(std::array<std::uint32_t, 3> corners, std::uint32_t first_point,
           const std::optional<Coordinates>& texture);
  void begin_object(const GltfObject& node, const GltfObject& mesh);
  void finish();

  const Source& source_;
  Soup soup_;
  GltfDocument document_;
  GltfAccessors accessors_;
  GltfPaint paint_;
  MaterialTable materials_;

  std::map<std::uint64_t, GltfSkin> skins_;
  const GltfSkin* skin_ = nullptr;  ///< of the instance
  /// Where the points of an accessor begin in the soup: of the instance, and only where no shape key moves
  /// them.
  std::map<std::uint64_t, std::uint32_t> placed_;
  /// The same for texture coordinates, by accessor and material.
  std::map<std::pair<std::uint64_t, std::uint64_t>, Coordinates> textured_;
  std::vector<bool> bad_texture_point_;
  std::map<std::uint64_t, std::uint64_t> packed_in_;  ///< Draco: the view that an accessor's values came from
  std::size_t bad_textures_ = 0;
  std::size_t other_primitives_ = 0;
  bool moves_ = false;  ///< the file has more than the shape at rest
};

Soup GltfReader::read() {
  const GltfScene scene = read_scene(document_);
  for (const GltfInstance& instance : scene.instances) {
    read_instance(instance, scene);
    source_.context.check();
  }
  finish();
  return std::move(soup_);
}

void GltfReader::read_instance(const GltfInstance& instance, const GltfScene& scene) {
  const GltfObject node = document_.root().element("nodes", instance.node);
  const GltfObject mesh = document_.element("meshes", instance.mesh, node);
  skin_ = nullptr;
  if (instance.skin) {
    const auto found = skins_.find(*instance.skin);
    skin_ =
        found != skins_.end()
            ? &found->second
            : &skins_.emplace(*instance.skin, read_skin(document_, accessors_, scene, *instance.skin, node))
                   .first->second;
    moves_ = true;
  }
  std::vector<Affine> copies{Affine{}};
  if (const auto instancing = node.extension("EXT_mesh_gpu_instancing")) {
    copies = copies_of(accessors_, *instancing);
  }
  begin_object(node, mesh);
  const std::vector<double> weights = resting_weights(node, mesh);
  for (const Affine& copy : copies) {
    placed_.clear();
    GltfInstance placed = instance;
    placed.place = instance.place * copy;
    for (std::size_t i = 0; i < mesh.size("primitives"); ++i) {
      read_primitive(placed, mesh.element("primitives", i), weights);
    }
    source_.context.check();
  }
}

/// Objects are called by their node, or else by their mesh.
void GltfReader::begin_object(const GltfObject& node, const GltfObject& mesh) {
  std::string name = printable(node.text("name"));
  if (name.empty()) {
    name = printable(mesh.text("name"));
  }
  soup_.objects.emplace_back(static_cast<std::uint32_t>(soup_.polygon_count()), std::move(name));
}

/// Unless the file has the same without compression.
void GltfReader::unpack(const GltfObject& primitive) {
  if (const auto draco = primitive.extension("KHR_draco_mesh_compression")) {
    const auto attributes = primitive.object("attributes");
    const auto positions = attributes ? attributes->whole("POSITION") : std::nullopt;
    if (!positions || !document_.element("accessors", *positions, *attributes).has("bufferView")) {
      // Primitives may name the same accessors and have points of their own: what counts is what is packed.
      const std::uint64_t view = draco->needed_whole("bufferView");
      const auto [packed, fresh] = packed_in_.try_emplace(positions.value_or(Soup::none), view);
      if (fresh || packed->second != view) {
        unpack_draco(document_, accessors_, primitive, *draco);
        packed->second = view;
        placed_.clear();
        textured_.clear();
      }
    }
  }
}

void GltfReader::read_primitive(const GltfInstance& instance, const GltfObject& primitive,
                                const std::vector<double>& weights) {
  const std::uint64_t number = primitive.whole_or("mode", 4);
  if (number > static_cast<std::uint64_t>(Mode::triangle_fan)) {
    primitive.refuse(fmt::format("\"mode\" {} isn't known", number));
  }
  const auto mode = static_cast<Mode>(number);
  if (mode < Mode::triangles) {
    ++other_primitives_;
    return;
  }
  unpack(primitive);
  const auto attributes = primitive.object("attributes");
  if (!attributes) {
    primitive.refuse("\"attributes\" is missing");
  }
  moves_ = moves_ || primitive.size("targets") > 0;
  constexpr std::array<std::size_t, 1> three{3};
  const std::size_t count =
      accessors_.values(attributes->needed_whole("POSITION"), *attributes, three).count();
  std::vector<std::uint32_t> corners;
  if (const auto indices = primitive.whole("indices")) {
    corners = accessors_.indices(*indices, primitive, count);
  } else {
    corners.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      corners[i] = static_cast<std::uint32_t>(i);
    }
  }
  if (mode == Mode::triangles && corners.size() % 3 != 0) {
    primitive.refuse(fmt::format("its {} corners are no triangles: three don't divide them", corners.size()));
  }
  const std::uint64_t most = mode == Mode::triangles ? corners.size() : 3 * corners.size();
  check_repetitions(source_, document_.held(), soup_.points.size() + count, soup_.corner_point.size() + most);
  const std::uint32_t first_point = place_points(instance, primitive, weights);

  const auto material_number = primitive.whole("material");
  const GltfMaterial* const material =
      material_number ? &paint_.material(*material_number, primitive) : nullptr;
  const auto texture = material != nullptr && material->map
                           ? place_picture(*attributes, *material_number, *material->map)
                           : std::nullopt;
  const GltfValues* colours = nullptr;
  if (const auto accessor = attributes->whole("COLOR_0")) {
    colours = &accessors_.values(*accessor, *attributes, three_or_four);
    if (colours->count() != count) {
      attributes->refuse(fmt::format("COLOR_0 has {} elements for {} points", colours->count(), count));
    }
  }
  const auto soup_material = [&](std::uint32_t) {
    Material out;
    out.name = material->name;
    if (material->light) {
      out.colour = colour_of(screen_colour(*material->light));
    }
    if (material->map) {
      out.texture_file = material->map->texture_file;
      out.picture = material->map->picture;
      out.tints_picture = true;
    }
    return out;
  };
  const bool mirrored = instance.place.mirrors() && skin_ == nullptr;
  std::size_t triangles = 0;
  for_triangles(mode, corners, [&](std::array<std::uint32_t, 3> triangle) {
    if (mirrored) {
      std::swap(triangle[1], triangle[2]);
    }
    add(triangle, first_point, texture);
    std::optional<ColourBytes> own;
    if (colours != nullptr) {
      // The face's own colour is the mean of its corners', by the material's.
      Colour mean{};
      for (std::size_t k = 0; k < 3; ++k) {
        for (const std::uint32_t corner : triangle) {
          mean[k] += (*colours)[corner][k] / 3.0;
        }
        mean[k] *= material != nullptr && material->light ? (*material->light)[k] : 1.0;
      }
      own = screen_colour(mean);
      std::array<std::uint32_t, 3> of_corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        Colour light{};
        for (std::size_t c = 0; c < 3; ++c) {
          light[c] = (*colours)[triangle[k]][c] *
                     (material != nullptr && material->light ? (*material->light)[c] : 1.0);
        }
        of_corners[k] = packed_colour(colour_of(screen_colour(light)));
      }
      colour_last_triangle(soup_, of_corners);
    }
    materials_.paint(soup_, material_number ? static_cast<std::uint32_t>(*material_number) : Soup::none, own,
                     soup_material);
    if (++triangles % 65536 == 0) {
      source_.context.check();
    }
  });
}

/// Puts the points of a primitive into the soup, unless they are there already, and says where they begin.
std::uint32_t GltfReader::place_points(const GltfInstance& instance, const GltfObject& primitive,
                                       const std::vector<double>& weights) {
  const std::uint64_t accessor = primitive.object("attributes")->needed_whole("POSITION");
  const bool shared = primitive.size("targets") == 0 && skin_ == nullptr;
  if (const auto found = placed_.find(accessor); shared && found != placed_.end()) {
    return found->second;
  }
  const auto first = static_cast<std::uint32_t>(soup_.points.size());
  const std::vector<Vec3> points = points_in_scene(accessors_, primitive, weights, instance.place, skin_);
  soup_.points.insert(soup_.points.end(), points.begin(), points.end());
  if (shared) {
    placed_.emplace(accessor, first);
  }
  return first;
}

std::optional<GltfReader::Coordinates> GltfReader::place_picture(const GltfObject& attributes,
                                                                 std::uint64_t material,
                                                                 const GltfPicture& picture) {
  const auto accessor = attributes.whole(fmt::format("TEXCOORD_{}", picture.coordinates).c_str());
  if (!accessor) {
    return std::nullopt;
  }
  const auto [found, fresh] = textured_.try_emplace({*accessor, material});
  if (fresh) {
    const GltfValues& values = accessors_.values(*accessor, attributes, two);
    check_repetitions(source_, document_.held(), soup_.texture_points.size() + values.count(), 0);
    found->second = {static_cast<std::uint32_t>(soup_.texture_points.size()),
                     static_cast<std::uint32_t>(values.count())};
    for (std::size_t i = 0; i < values.count(); ++i) {
      const Vec2 at = picture.place({values[i][0], values[i][1]});
      const bool good =
          std::abs(at.x) <= largest_texture_coordinate && std::abs(at.y) <= largest_texture_coordinate;
      soup_.texture_points.push_back(good ? at : Vec2{});
      bad_texture_point_.push_back(!good);
    }
  }
  return found->second;
}

void GltfReader::add(std::array<std::uint32_t, 3> corners, std::uint32_t first_point,
                     const std::optional<Coordinates>& texture) {
  std::optional<std::array<std::uint32_t, 3>> at;
  if (texture) {
    const bool good = std::all_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
      return corner < texture->count && !bad_texture_point_[texture->first + corner];
    });
    bad_textures_ += good ? 0U : 1U;
    if (good) {
      at = {texture->first + corners[0], texture->first + corners[1], texture->first + corners[2]};
    }
  }
  add_triangle(soup_, {first_point + corners[0], first_point + corners[1], first_point + corners[2]}, at);
}

void GltfReader::finish() {
  if (soup_.polygon_count() == 0 && other_primitives_ > 0) {
    source_.refuse(ErrorKind::unusable_mesh, "has points or lines, but no faces that could be unfolded");
  }
  soup_.remarks.add(RepairKind::texture_point_dropped, bad_textures_);
  soup_.remarks.add(RepairKind::element_ignored, other_primitives_,
                    other_primitives_ > 0 ? "points or lines" : std::string());
  std::vector<std::string> unused;
  if (const std::size_t transparent = paint_.transparent(); transparent > 0) {
    unused.push_back(fmt::format("transparency of {}", counted(transparent, "material")));
  }
  if (const std::size_t scenes = document_.root().size("scenes"); scenes > 1) {
    unused.push_back(fmt::format("{} that isn't the one to show", counted(scenes - 1, "scene")));
  }
  soup_.remarks.add(RepairKind::feature_ignored, unused.size(), listed(unused, "and"));
  if (moves_ || document_.root().size("animations") > 0) {
    soup_.remarks.add(RepairKind::motion_ignored);
  }
  soup_.beside_digest = document_.beside_digest();
  soup_.files_beside = document_.files_beside();
  soup_.frame = {1000.0, Axis::y};
}

}  // namespace

Soup read_gltf(const Source& source) {
  Soup soup = GltfReader(source, GltfContainer{source.bytes, {}, 0}).read();
  soup.format = FileFormat::gltf;
  return soup;
}

Soup read_glb(const Source& source) {
  const GltfContainer container = open_glb(source);
  Soup soup = GltfReader(source, container).read();
  soup.format = FileFormat::glb;
  soup.remarks.add(RepairKind::trailing_data_ignored, container.trailing);
  return soup;
}

}  // namespace ridgecraft::mesh
