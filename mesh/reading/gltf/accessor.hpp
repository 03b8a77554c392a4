// SPDX-License-Identifier: GPL-3.0-or-later
// Accessors of glTF: lists of numbers or vectors in the bytes of a file.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "mesh/reading/gltf/document.hpp"

namespace ridgecraft::mesh {

/// Values of one accessor, element after element.
struct GltfValues {
  std::size_t components = 1;  ///< of an element
  std::vector<double> numbers;

  [[nodiscard]] std::size_t count() const { return numbers.size() / components; }
  [[nodiscard]] std::span<const double> operator[](std::size_t i) const {
    return {numbers.data() + i * components, components};
  }
};

/// Reads accessors, each once. Whatever an accessor says is held against the bytes that there are.
class GltfAccessors {
 public:
  explicit GltfAccessors(GltfDocument& document) : document_(document) {}

  /// The values of accessor i, whose elements have so many components (one of two numbers of them). Integers
  /// that the file calls normalized become 0 to 1, or -1 to 1. `user` names the accessor.
  [[nodiscard]] const GltfValues& values(std::uint64_t i, const GltfObject& user,
                                         std::span<const std::size_t> components);
  /// Whole numbers for the corners of faces, each below `limit`.
  [[nodiscard]] std::vector<std::uint32_t> indices(std::uint64_t i, const GltfObject& user,
                                                   std::size_t limit) const;

 private:
  GltfDocument& document_;
  std::map<std::uint64_t, GltfValues> read_;
  std::uint64_t values_read_ = 0;
};

}  // namespace ridgecraft::mesh
