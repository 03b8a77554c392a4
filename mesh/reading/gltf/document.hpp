// SPDX-License-Identifier: GPL-3.0-or-later
// A glTF file taken apart: its JSON, and the bytes that it points to, within the file and beside it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/reading/gltf/json_object.hpp"

namespace ridgecraft::mesh {

/// The two parts of a GLB file; a text file is JSON alone.
struct GltfContainer {
  std::string_view json;
  std::optional<std::string_view> binary;
  std::size_t trailing = 0;  ///< bytes after the end that the file itself tells
};

/// Throws Error(unreadable_input) for what is cut off or of version 1.
[[nodiscard]] GltfContainer open_glb(const Source& source);

/// Part of a buffer.
struct GltfView {
  std::string_view bytes;
  std::optional<std::size_t> stride;  ///< bytes from one element to the next, where the file tells it
};

class GltfDocument {
 public:
  /// Parses the JSON, and refuses other versions than 2 and what an extension is needed for that isn't known.
  /// The source and the bytes must outlive it.
  GltfDocument(const Source& source, const GltfContainer& container);

  [[nodiscard]] const Source& source() const { return source_; }
  [[nodiscard]] const GltfObject& root() const { return *root_; }
  /// Element i of one of the lists that the file consists of; `user` names it and is refused where there is
  /// none.
  [[nodiscard]] GltfObject element(const char* list, std::uint64_t i, const GltfObject& user) const;

  /// Bytes of a buffer view; the buffer is opened when the first of its views is wanted.
  [[nodiscard]] GltfView view(std::uint64_t i, const GltfObject& user);

  /// Bytes of the file, and of the buffers beside it that were opened.
  [[nodiscard]] std::uint64_t held() const { return held_; }
  /// Hashes of the buffers beside the file that were opened.
  [[nodiscard]] const std::string& beside_digest() const { return beside_digest_; }

 private:
  void check_version() const;
  void check_extensions() const;
  [[nodiscard]] std::string_view buffer(std::uint64_t i, const GltfObject& user);
  [[nodiscard]] std::string_view open_buffer(const GltfObject& buffer);

  const Source& source_;
  std::optional<std::string_view> binary_;
  std::unique_ptr<const nlohmann::json> json_;
  std::optional<GltfObject> root_;
  std::map<std::uint64_t, std::string_view> opened_;  ///< by number of the buffer
  std::deque<std::string> decoded_;                   ///< from text within the file
  std::map<std::string, std::string> files_;          ///< bytes of files beside it, by path
  std::uint64_t held_;
  std::string beside_digest_;
};

}  // namespace ridgecraft::mesh
