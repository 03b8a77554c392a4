// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/gltf/draco.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#ifdef RIDGECRAFT_HAS_DRACO
#include <draco/compression/decode.h>
#endif

namespace ridgecraft::mesh {
namespace {

#ifdef RIDGECRAFT_HAS_DRACO
/// Points that one primitive may have, packed or not.
constexpr std::uint32_t most_draco_points = 50'000'000;

GltfValues values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute, bool normalized) {
  GltfValues values;
  values.components = static_cast<std::size_t>(attribute.num_components());
  values.numbers.reserve(values.components * mesh.num_points());
  std::array<double, 4> value{};
  double largest = 1.0;
  if (normalized) {
    const auto type = attribute.data_type();
    largest = type == draco::DT_UINT8    ? 255.0
              : type == draco::DT_INT8   ? 127.0
              : type == draco::DT_UINT16 ? 65535.0
              : type == draco::DT_INT16  ? 32767.0
                                         : 1.0;
  }
  for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
    if (!attribute.ConvertValue<double>(attribute.mapped_index(p), value.data())) {
      value.fill(0.0);
    }
    for (std::size_t k = 0; k < values.components; ++k) {
      values.numbers.push_back(value[k] / largest);
    }
  }
  return values;
}
#endif

}  // namespace

#ifdef RIDGECRAFT_HAS_DRACO
void unpack_draco(GltfDocument& document, GltfAccessors& accessors, const GltfObject& primitive,
                  const GltfObject& extension) {
  const std::string_view packed = document.view(extension.needed_whole("bufferView"), extension).bytes;
  const auto attributes = primitive.object("attributes");
  const auto ids = extension.object("attributes");
  if (!attributes || !ids) {
    extension.refuse("\"attributes\" is missing");
  }
  draco::DecoderBuffer buffer;
  buffer.Init(packed.data(), packed.size());
  draco::Decoder decoder;
  const auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok() || decoded.value() == nullptr || decoded.value()->num_points() > most_draco_points) {
    extension.refuse("its Draco data is damaged, or too large");
  }
  const draco::Mesh& mesh = *decoded.value();
  for (const char* const name : {"POSITION", "TEXCOORD_0", "TEXCOORD_1", "TEXCOORD_2", "TEXCOORD_3",
                                 "COLOR_0", "JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1"}) {
    const auto id = ids->whole(name);
    const auto accessor = attributes->whole(name);
    if (!id || !accessor) {
      continue;
    }
    const draco::PointAttribute* const attribute =
        mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(*id));
    if (attribute == nullptr || attribute->num_components() < 1 || attribute->num_components() > 4) {
      extension.refuse(fmt::format("its Draco data has no {}", name));
    }
    const GltfObject header = document.element("accessors", *accessor, *attributes);
    accessors.put(*accessor, values_of(mesh, *attribute, header.truth("normalized")));
  }
  std::vector<std::uint32_t> corners;
  corners.reserve(std::size_t{3} * mesh.num_faces());
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& p : mesh.face(f)) {
      corners.push_back(p.value());
    }
  }
  document.add_unpacked(std::uint64_t{sizeof(std::uint32_t)} *
                        (corners.size() + 3 * std::uint64_t{mesh.num_points()}));
  if (const auto indices = primitive.whole("indices")) {
    accessors.put_indices(*indices, std::move(corners));
  }
}
#else
void unpack_draco(GltfDocument& /*document*/, GltfAccessors& /*accessors*/, const GltfObject& primitive,
                  const GltfObject& /*extension*/) {
  primitive.refuse("it is compressed with Draco, which isn't read here: export it again without compression");
}
#endif

}  // namespace ridgecraft::mesh
