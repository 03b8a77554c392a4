// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/gltf/accessor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>

#include <fmt/format.h>

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
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    bits |= std::uint32_t{static_cast<unsigned char>(at[i])} << (8 * i);
  }
  return bits;
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

}  // namespace

const GltfValues& GltfAccessors::values(std::uint64_t i, const GltfObject& user,
                                        std::span<const std::size_t> components) {
  const GltfObject accessor = document_.element("accessors", i, user);
  const auto [found, fresh] = read_.try_emplace(i);
  GltfValues& values = found->second;
  if (fresh) {
    const Header header = read_header(accessor);
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
  if (header.count > document_.held()) {
    accessor.refuse("it has more values than the file could hold");
  }
  std::vector<std::uint32_t> indices(header.count, 0);
  for_elements(document_, accessor, header, [&](std::uint64_t at, const char* bytes) {
    indices[at] = bits_at(bytes, size_of(header.type));
  });
  const auto beyond =
      std::find_if(indices.begin(), indices.end(), [&](std::uint32_t p) { return p >= limit; });
  if (beyond != indices.end()) {
    user.refuse(fmt::format("it names point {}, but its points are numbered 0 to {}", *beyond, limit - 1));
  }
  return indices;
}

}  // namespace ridgecraft::mesh
