// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/gltf/meshopt.hpp"

#ifdef RIDGECRAFT_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace ridgecraft::mesh {

#ifdef RIDGECRAFT_HAS_MESHOPTIMIZER
namespace {

/// A byte packs sixteen equal ones at most, and blocks have a byte each.
constexpr std::uint64_t largest_share = 1024;
constexpr std::uint64_t largest_stride = 256;

bool undo_filter(const MeshoptElements& elements, std::string& bytes) {
  if (elements.filter.empty() || elements.filter == "NONE") {
    return true;
  }
  if (elements.mode != "ATTRIBUTES") {
    return false;
  }
  if (elements.filter == "OCTAHEDRAL" && (elements.stride == 4 || elements.stride == 8)) {
    meshopt_decodeFilterOct(bytes.data(), elements.count, elements.stride);
  } else if (elements.filter == "QUATERNION" && elements.stride == 8) {
    meshopt_decodeFilterQuat(bytes.data(), elements.count, elements.stride);
  } else if (elements.filter == "EXPONENTIAL" && elements.stride % 4 == 0) {
    meshopt_decodeFilterExp(bytes.data(), elements.count, elements.stride);
  } else {
    return false;
  }
  return true;
}

}  // namespace

bool reads_meshopt() {
  return true;
}

std::optional<std::string> unpack_meshopt(const MeshoptElements& elements, std::string_view packed) {
  const std::uint64_t count = elements.count;
  const std::uint64_t stride = elements.stride;
  if (stride == 0 || stride > largest_stride || count > largest_share * (packed.size() + 1)) {
    return std::nullopt;
  }
  std::string bytes(count * stride, '\0');
  const auto* const data = reinterpret_cast<const unsigned char*>(packed.data());
  const bool is_index = stride == 4 || stride == 2;
  int failed = 1;
  if (elements.mode == "ATTRIBUTES" && stride % 4 == 0) {
    failed = meshopt_decodeVertexBuffer(bytes.data(), count, stride, data, packed.size());
  } else if (elements.mode == "TRIANGLES" && count % 3 == 0 && is_index) {
    failed = meshopt_decodeIndexBuffer(bytes.data(), count, stride, data, packed.size());
  } else if (elements.mode == "INDICES" && is_index) {
    failed = meshopt_decodeIndexSequence(bytes.data(), count, stride, data, packed.size());
  }
  return failed == 0 && undo_filter(elements, bytes) ? std::optional(std::move(bytes)) : std::nullopt;
}
#else
bool reads_meshopt() {
  return false;
}

std::optional<std::string> unpack_meshopt(const MeshoptElements& /*elements*/, std::string_view /*packed*/) {
  return std::nullopt;
}
#endif

}  // namespace ridgecraft::mesh
