// SPDX-License-Identifier: GPL-3.0-or-later
// What Assimp found in a file, as polygons, written as numbers and texts one after the other
// (mesh/reading/imported/stream.hpp).
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

struct aiScene;

namespace ridgecraft::import {

/// The stream (mesh/reading/imported/stream.hpp) of all meshes of a scene where its nodes stand. `format` is
/// the name of the file's format: formats tell unit and up axis in ways of their own. Throws
/// std::runtime_error for what would become too large.
[[nodiscard]] std::string soup_stream(const aiScene& scene, const std::string& format);

class StreamWriter {
 public:
  void words(std::string_view text) { bytes_ += text; }
  void index(std::uint32_t value) { append(value); }
  void number(double value) { append(value); }
  void text(std::string_view text) {
    index(static_cast<std::uint32_t>(text.size()));
    words(text);
  }
  void indices(const std::vector<std::uint32_t>& values) {
    for (const std::uint32_t value : values) {
      index(value);
    }
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  template <class T>
  void append(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    bytes_.append(bytes, sizeof(T));
  }

  std::string bytes_;
};

}  // namespace ridgecraft::import
