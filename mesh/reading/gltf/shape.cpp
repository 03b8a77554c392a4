// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/gltf/shape.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/encodings.hpp"

namespace ridgecraft::mesh {
namespace {

enum class Component : std::uint16_t { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };

struct Shape {
  std::string_view name;
  std::size_t components;
};
constexpr std::array shapes{Shape{"SCALAR", 1}, Shape{"VEC2", 2}, Shape{"VEC3", 3}, Shape{"VEC4", 4},
                            Shape{"MAT2", 4},   Shape{"MAT3", 9}, Shape{"MAT4", 16}};

std::size_t size_of(Component type) {
  switch (type) {
    case Component::int8:
    case Component::uint8:
      return 1;
    case Component::int16:
    case Component::uint16:
      return 2;
    default:
      return 4;
  }
}

std::uint32_t bits_at(const char* at, std::size_t size) {
  return static_cast<std::uint32_t>(little_endian({at, size}));
}

double value_at(const char* at, Component type, bool normalized) {
  const std::uint32_t bits = bits_at(at, size_of(type));
  switch (type) {
    case Component::int8: {
      const double value = static_cast<std::int8_t>(bits);
      return normalized ? std::max(value / 127.0, -1.0) : value;
    }
    case Component::uint8:
      return normalized ? bits / 255.0 : bits;
    case Component::int16: {
      const double value = static_cast<std::int16_t>(bits);
      return normalized ? std::max(value / 32767.0, -1.0) : value;
    }
    case Component::uint16:
      return normalized ? bits / 65535.0 : bits;
    case Component::uint32:
      return bits;
    case Component::float32:
      break;
  }
  return double{std::bit_cast<float>(bits)};
}

Component component_type(const GltfObject& accessor) {
  const std::uint64_t type = accessor.needed_whole("componentType");
  if ((type < 5120 || type > 5123) && type != 5125 && type != 5126) {
    accessor.refuse(fmt::format("\"componentType\" {} isn't known", type));
  }
  return static_cast<Component>(type);
}

/// Elements of one type that stand in a view at equal distances.
struct Row {
  const char* first = nullptr;
  std::size_t stride = 0;
};

Row row_in(const GltfView& view, std::uint64_t offset, std::uint64_t count, std::size_t element,
           const GltfObject& user) {
  const std::uint64_t stride = view.stride.value_or(element);
  if (stride < element) {
    user.refuse(fmt::format("its elements of {} bytes overlap: they are {} bytes apart", element, stride));
  }
  const std::uint64_t size = view.bytes.size();
  if (offset > size || element > size - offset || (count - 1) > (size - offset - element) / stride) {
    user.refuse(
        fmt::format("its {} elements don't fit into its buffer view, which has {} bytes", count, size));
  }
  return {view.bytes.data() + offset, static_cast<std::size_t>(stride)};
}

/// What an accessor says of itself.
struct Header {
  Component type;
  std::size_t components;
  std::uint64_t count;
  bool normalized;

  [[nodiscard]] std::size_t element_size() const { return components * size_of(type); }
};

Header read_header(const GltfObject& accessor) {
  const std::string name = accessor.text("type");
  const auto shape =
      std::find_if(shapes.begin(), shapes.end(), [&](const Shape& s) { return s.name == name; });
  if (shape == shapes.end()) {
    accessor.refuse(name.empty() ? "\"type\" is missing" : "\"type\" isn't known");
  }
  const std::uint64_t count = accessor.needed_whole("count");
  if (count == 0) {
    accessor.refuse("\"count\" is 0");
  }
  return {component_type(accessor), shape->components, count, accessor.truth("normalized")};
}

/// Calls use(element, place of its bytes) for each element that the accessor has of its own, and then for
/// those that its sparse part puts in their place.
template <class Use>
void for_elements(GltfDocument& document, const GltfObject& accessor, const Header& header, const Use& use) {
  const auto sparse = accessor.object("sparse");
  if (const auto view = accessor.whole("bufferView")) {
    const Row row = row_in(document.view(*view, accessor), accessor.whole_or("byteOffset", 0), header.count,
                           header.element_size(), accessor);
    for (std::uint64_t i = 0; i < header.count; ++i) {
      use(i, row.first + i * row.stride);
    }
  } else if (!sparse) {
    accessor.refuse("nothing says where its values are (no \"bufferView\")");
  }
  if (!sparse) {
    return;
  }
  const std::uint64_t count = sparse->needed_whole("count");
  const auto indices = sparse->object("indices");
  const auto values = sparse->object("values");
  if (!indices || !values || count == 0) {
    sparse->refuse("\"count\", \"indices\" or \"values\" is missing");
  }
  const Component type = component_type(*indices);
  if (type != Component::uint8 && type != Component::uint16 && type != Component::uint32) {
    indices->refuse("\"componentType\" isn't one of whole numbers from 0");
  }
  const Row places = row_in(document.view(indices->needed_whole("bufferView"), *indices),
                            indices->whole_or("byteOffset", 0), count, size_of(type), *indices);
  const Row row = row_in(document.view(values->needed_whole("bufferView"), *values),
                         values->whole_or("byteOffset", 0), count, header.element_size(), *values);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint32_t place = bits_at(places.first + i * places.stride, size_of(type));
    if (place >= header.count) {
      indices->refuse(fmt::format("it names element {} of {}", place, header.count));
    }
    use(place, row.first + i * row.stride);
  }
}

/// Four by four numbers, column after column.
Affine affine_of_matrix(const GltfObject& node, const std::vector<double>& m) {
  // Written by programs that count in floats.
  constexpr double rounding = 1e-4;
  if (std::abs(m[3]) > rounding || std::abs(m[7]) > rounding || std::abs(m[11]) > rounding ||
      std::abs(m[15] - 1.0) > rounding) {
    node.refuse("\"matrix\" doesn't keep straight things straight: its last row isn't 0 0 0 1");
  }
  return {{Vec3{m[0], m[4], m[8]}, Vec3{m[1], m[5], m[9]}, Vec3{m[2], m[6], m[10]}}, {m[12], m[13], m[14]}};
}

/// The turn of a quaternion x, y, z, w of any length but 0.
Affine turn_of(const GltfObject& node, const std::vector<double>& q) {
  const double norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (!(norm > 0.0) || !std::isfinite(norm)) {
    node.refuse("\"rotation\" is no turn: its length is 0 or not finite");
  }
  const double s = 2.0 / norm;
  const auto [x, y, z, w] = std::array{q[0], q[1], q[2], q[3]};
  return {{Vec3{1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)},
           Vec3{s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)},
           Vec3{s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)}},
          {}};
}

Affine place_in_parent(const GltfObject& node) {
  if (const auto matrix = node.numbers("matrix", 16)) {
    return affine_of_matrix(node, *matrix);
  }
  Affine place;
  if (const auto q = node.numbers("rotation", 4)) {
    place = turn_of(node, *q);
  }
  if (const auto scale = node.numbers("scale", 3)) {
    for (Vec3& row : place.rows) {
      row = {row.x * (*scale)[0], row.y * (*scale)[1], row.z * (*scale)[2]};
    }
  }
  if (const auto shift = node.numbers("translation", 3)) {
    place.shift = {(*shift)[0], (*shift)[1], (*shift)[2]};
  }
  return place;
}

/// Nodes that no other one names as its child.
std::vector<std::uint64_t> all_roots(const GltfDocument& document) {
  const std::size_t count = document.root().size("nodes");
  std::vector<bool> is_child(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::uint64_t child : document.root().element("nodes", i).wholes("children")) {
      if (child < count) {
        is_child[child] = true;
      }
    }
  }
  std::vector<std::uint64_t> roots;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_child[i]) {
      roots.push_back(i);
    }
  }
  if (roots.empty() && count > 0) {
    document.root().refuse("each of its nodes is in another one");
  }
  return roots;
}

std::vector<std::uint64_t> roots_of(const GltfDocument& document) {
  const GltfObject& root = document.root();
  if (const auto scene = root.whole("scene")) {
    return document.element("scenes", *scene, root).wholes("nodes");
  }
  return root.size("scenes") > 0 ? root.element("scenes", 0).wholes("nodes") : all_roots(document);
}

constexpr std::array<std::size_t, 1> three{3};
constexpr std::array<std::size_t, 1> four{4};
constexpr std::array<std::size_t, 1> sixteen{16};

Vec3 vector_of(std::span<const double> numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

bool is_finite(Vec3 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void pull(std::vector<Vec3>& points, GltfAccessors& accessors, const GltfObject& primitive,
          const std::vector<double>& weights) {
  const std::size_t targets = primitive.size("targets");
  for (std::size_t t = 0; t < targets && t < weights.size(); ++t) {
    const GltfObject target = primitive.element("targets", t);
    const auto moved = target.whole("POSITION");
    if (weights[t] == 0.0 || !moved) {
      continue;
    }
    const GltfValues& moves = accessors.values(*moved, target, three);
    if (moves.count() != points.size()) {
      target.refuse(fmt::format("it moves {} points, but there are {}", moves.count(), points.size()));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] += weights[t] * vector_of(moves[i]);
    }
  }
}

/// Each point goes where its joints take it, by their weights; one that no joint holds goes to the first.
void bend(std::vector<Vec3>& points, GltfAccessors& accessors, const GltfObject& attributes,
          const GltfSkin& skin) {
  std::vector<Vec3> bent(points.size());
  std::vector<double> sums(points.size(), 0.0);
  constexpr int most_sets = 16;
  for (int set = 0; set < most_sets; ++set) {
    const auto joints = attributes.whole(fmt::format("JOINTS_{}", set).c_str());
    const auto weights = attributes.whole(fmt::format("WEIGHTS_{}", set).c_str());
    if (!joints || !weights) {
      break;
    }
    const GltfValues& who = accessors.values(*joints, attributes, four);
    const GltfValues& how = accessors.values(*weights, attributes, four);
    if (who.count() != points.size() || how.count() != points.size()) {
      attributes.refuse(fmt::format("JOINTS_{0} or WEIGHTS_{0} has not one element for each point", set));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        const double weight = how[i][k];
        const double joint = who[i][k];
        if (weight == 0.0) {
          continue;
        }
        if (!(joint >= 0.0) || joint >= static_cast<double>(skin.joints.size())) {
          attributes.refuse(
              fmt::format("a point hangs on joint {}, but there are {}", joint, skin.joints.size()));
        }
        bent[i] += weight * skin.joints[static_cast<std::size_t>(joint)](points[i]);
        sums[i] += weight;
      }
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = sums[i] > 0.0         ? bent[i] / sums[i]
                : skin.joints.empty() ? points[i]
                                      : skin.joints[0](points[i]);
  }
}

}  // namespace

const GltfValues& GltfAccessors::values(std::uint64_t i, const GltfObject& user,
                                        std::span<const std::size_t> components) {
  const GltfObject accessor = document_.element("accessors", i, user);
  const auto [found, fresh] = read_.try_emplace(i);
  GltfValues& values = found->second;
  if (fresh) {
    const Header header = read_header(accessor);
    document_.unpack_view_of(accessor);
    // Each byte is part of one value at most, unless accessors overlap; sparse ones may leave out as many.
    constexpr std::uint64_t spare = 1'000'000;
    values_read_ += std::min(header.count, 2 * document_.held() + 2 * spare) * header.components;
    if (values_read_ > document_.held() + spare) {
      accessor.refuse("it has more values than the file could hold");
    }
    values.components = header.components;
    values.numbers.assign(header.count * header.components, 0.0);
    for_elements(document_, accessor, header, [&](std::uint64_t at, const char* bytes) {
      for (std::size_t k = 0; k < header.components; ++k) {
        values.numbers[at * header.components + k] =
            value_at(bytes + k * size_of(header.type), header.type, header.normalized);
      }
    });
    document_.source().context.check();
  }
  if (std::find(components.begin(), components.end(), values.components) == components.end()) {
    accessor.refuse(fmt::format("its elements have {} numbers, but {} needs {}", values.components,
                                user.place(), components.back()));
  }
  return values;
}

std::vector<std::uint32_t> GltfAccessors::indices(std::uint64_t i, const GltfObject& user,
                                                  std::size_t limit) const {
  const GltfObject accessor = document_.element("accessors", i, user);
  const Header header = read_header(accessor);
  if (header.components != 1 || (header.type != Component::uint8 && header.type != Component::uint16 &&
                                 header.type != Component::uint32)) {
    accessor.refuse("it holds no whole numbers from 0, as numbers of points are");
  }
  document_.unpack_view_of(accessor);
  const auto unpacked = indices_.find(i);
  std::vector<std::uint32_t> indices;
  if (unpacked != indices_.end()) {
    indices = unpacked->second;
  } else {
    if (header.count > document_.held()) {
      accessor.refuse("it has more values than the file could hold");
    }
    indices.assign(header.count, 0);
    for_elements(document_, accessor, header, [&](std::uint64_t at, const char* bytes) {
      indices[at] = bits_at(bytes, size_of(header.type));
    });
  }
  const auto beyond =
      std::find_if(indices.begin(), indices.end(), [&](std::uint32_t p) { return p >= limit; });
  if (beyond != indices.end()) {
    user.refuse(fmt::format("it names point {}, but its points are numbered 0 to {}", *beyond, limit - 1));
  }
  return indices;
}

std::vector<Affine> copies_of(GltfAccessors& accessors, const GltfObject& instancing) {
  std::vector<Affine> copies;
  const auto attributes = instancing.object("attributes");
  if (!attributes) {
    return copies;
  }
  const auto values = [&](const char* name, std::span<const std::size_t> components) -> const GltfValues* {
    const auto accessor = attributes->whole(name);
    return accessor ? &accessors.values(*accessor, *attributes, components) : nullptr;
  };
  const GltfValues* const shifts = values("TRANSLATION", three);
  const GltfValues* const turns = values("ROTATION", four);
  const GltfValues* const scales = values("SCALE", three);
  const GltfValues* const any = shifts != nullptr ? shifts : turns != nullptr ? turns : scales;
  for (const GltfValues* const each : {shifts, turns, scales}) {
    if (each != nullptr && each->count() != any->count()) {
      attributes->refuse(fmt::format("it has {} copies and {}", any->count(), each->count()));
    }
  }
  for (std::size_t i = 0; any != nullptr && i < any->count(); ++i) {
    Affine copy;
    if (turns != nullptr) {
      copy = turn_of(*attributes, {(*turns)[i].begin(), (*turns)[i].end()});
    }
    if (scales != nullptr) {
      const auto by = (*scales)[i];
      for (Vec3& row : copy.rows) {
        row = {row.x * by[0], row.y * by[1], row.z * by[2]};
      }
    }
    if (shifts != nullptr) {
      copy.shift = vector_of((*shifts)[i]);
    }
    copies.push_back(copy);
  }
  return copies;
}

GltfScene read_scene(const GltfDocument& document) {
  GltfScene scene;
  scene.places.resize(document.root().size("nodes"));
  struct Open {
    std::uint64_t node;
    Affine parent;
  };
  std::vector<Open> open;
  const auto push = [&](const std::vector<std::uint64_t>& nodes, const Affine& parent) {
    std::for_each(nodes.rbegin(), nodes.rend(), [&](std::uint64_t node) { open.push_back({node, parent}); });
  };
  push(roots_of(document), {});
  while (!open.empty()) {
    const auto [number, parent] = open.back();
    open.pop_back();
    const GltfObject node = document.element("nodes", number, document.root());
    if (scene.places[number]) {
      node.refuse("it is in two other nodes, or in itself");
    }
    const Affine place = parent * place_in_parent(node);
    scene.places[number] = place;
    if (const auto mesh = node.whole("mesh")) {
      scene.instances.push_back({number, *mesh, place, node.whole("skin")});
    }
    push(node.wholes("children"), place);
    document.source().context.check();
  }
  return scene;
}

std::vector<double> resting_weights(const GltfObject& node, const GltfObject& mesh) {
  auto weights = node.numbers("weights");
  if (!weights) {
    weights = mesh.numbers("weights");
  }
  return weights.value_or(std::vector<double>());
}

GltfSkin read_skin(GltfDocument& document, GltfAccessors& accessors, const GltfScene& scene,
                   std::uint64_t skin, const GltfObject& user) {
  const GltfObject object = document.element("skins", skin, user);
  const std::vector<std::uint64_t> joints = object.wholes("joints");
  const auto inverse = object.whole("inverseBindMatrices");
  const GltfValues* const binds = inverse ? &accessors.values(*inverse, object, sixteen) : nullptr;
  if (binds != nullptr && binds->count() < joints.size()) {
    object.refuse(fmt::format("it has {} joints, but {} matrices for them", joints.size(), binds->count()));
  }
  GltfSkin out;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    (void)document.element("nodes", joints[j], object);
    Affine place = scene.places[joints[j]].value_or(Affine{});
    if (binds != nullptr) {
      const auto m = (*binds)[j];
      place = place * Affine{{Vec3{m[0], m[4], m[8]}, Vec3{m[1], m[5], m[9]}, Vec3{m[2], m[6], m[10]}},
                             {m[12], m[13], m[14]}};
    }
    out.joints.push_back(place);
  }
  return out;
}

std::vector<Vec3> points_in_scene(GltfAccessors& accessors, const GltfObject& primitive,
                                  const std::vector<double>& weights, const Affine& place,
                                  const GltfSkin* skin) {
  const auto attributes = primitive.object("attributes");
  if (!attributes) {
    primitive.refuse("\"attributes\" is missing");
  }
  const GltfValues& positions = accessors.values(attributes->needed_whole("POSITION"), *attributes, three);
  std::vector<Vec3> points;
  points.reserve(positions.count());
  for (std::size_t i = 0; i < positions.count(); ++i) {
    points.push_back(vector_of(positions[i]));
  }
  pull(points, accessors, primitive, weights);
  if (skin != nullptr && attributes->has("JOINTS_0")) {
    bend(points, accessors, *attributes, *skin);
  } else if (place != Affine{}) {
    for (Vec3& p : points) {
      p = place(p);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) {
      primitive.refuse(fmt::format("a coordinate of point {} is not finite", i), ErrorKind::unusable_mesh);
    }
  }
  return points;
}

}  // namespace ridgecraft::mesh
