// SPDX-License-Identifier: GPL-3.0-or-later
// A glTF file taken apart: its JSON, and the bytes that it points to, in the file and in files next to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

// An object of a glTF file, asked for values of the type that the standard gives them.

/// Each question refuses the file where the key is there with a value of another type; the sentence names the
/// place and the key: "box.gltf, accessors[3]: \"count\" is no whole number". The JSON must outlive it.
class GltfObject {
 public:
  GltfObject(const Source& source, const nlohmann::json& json, std::string place)
      : source_(&source), json_(&json), place_(std::move(place)) {}

  [[nodiscard]] bool has(const char* key) const { return json_->contains(key); }
  [[nodiscard]] std::optional<std::uint64_t> whole(const char* key) const;
  [[nodiscard]] std::uint64_t whole_or(const char* key, std::uint64_t otherwise) const {
    return whole(key).value_or(otherwise);
  }
  /// Refuses where the key is missing.
  [[nodiscard]] std::uint64_t needed_whole(const char* key) const;
  [[nodiscard]] std::optional<double> number(const char* key) const;
  [[nodiscard]] bool truth(const char* key) const;
  /// Empty where it is missing.
  [[nodiscard]] std::string text(const char* key) const;
  /// Refuses a list of another length; nothing where it is missing.
  [[nodiscard]] std::optional<std::vector<double>> numbers(const char* key, std::size_t count) const;
  [[nodiscard]] std::optional<std::vector<double>> numbers(const char* key) const;
  /// Empty where it is missing.
  [[nodiscard]] std::vector<std::uint64_t> wholes(const char* key) const;
  [[nodiscard]] std::vector<std::string> texts(const char* key) const;
  [[nodiscard]] std::optional<GltfObject> object(const char* key) const;
  /// Elements of a list; 0 where it is missing.
  [[nodiscard]] std::size_t size(const char* key) const;
  /// Object i of a list. Refuses a number beyond its end.
  [[nodiscard]] GltfObject element(const char* key, std::uint64_t i) const;
  /// The value that extension has here; nothing where it has none.
  [[nodiscard]] std::optional<GltfObject> extension(const char* name) const;

  /// "accessors[3]"
  [[nodiscard]] const std::string& place() const { return place_; }
  /// Throws with "FILE, PLACE: REASON".
  [[noreturn]] void refuse(std::string_view reason, ErrorKind kind = ErrorKind::unreadable_input) const;

 private:
  [[nodiscard]] const nlohmann::json* find(const char* key) const;
  /// Refuses a value that isn't of this type.
  [[nodiscard]] const nlohmann::json* find(const char* key, bool (nlohmann::json::*is_right)() const noexcept,
                                           std::string_view type) const;
  [[nodiscard]] const nlohmann::json* list(const char* key) const;
  [[nodiscard]] std::string inside(const char* key) const;
  [[noreturn]] void refuse_value(const char* key, std::string_view wanted) const;

  const Source* source_;
  const nlohmann::json* json_;
  std::string place_;  ///< empty for the whole file
};

// Bytes that are written into an address: data:[TYPE][;base64],TEXT (RFC 2397).

[[nodiscard]] bool is_data_uri(std::string_view uri);

/// Nothing where the bytes can't be read.
[[nodiscard]] std::optional<std::string> data_of_uri(std::string_view uri);

/// The two parts of a GLB file; a text file is JSON alone.
struct GltfContainer {
  std::string_view json;
  std::optional<std::string_view> binary;
  std::size_t trailing = 0;  ///< bytes after the end that the file itself states
};

/// Throws Error(unreadable_input) for what is cut off or of version 1.
[[nodiscard]] GltfContainer open_glb(const Source& source);

/// Part of a buffer.
struct GltfView {
  std::string_view bytes;
  std::optional<std::size_t> stride;  ///< bytes from one element to the next, where the file states it
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

  /// Bytes of the file, of the buffers next to it that were opened, and of what was unpacked.
  [[nodiscard]] std::uint64_t held() const { return held_; }
  void add_unpacked(std::uint64_t bytes) { held_ += bytes; }
  /// Unpacks the view that an accessor has its values in, where it is compressed: it counts as held then.
  void unpack_view_of(const GltfObject& accessor);
  /// Hashes of the buffers next to the file that were opened.
  [[nodiscard]] const std::string& beside_digest() const { return beside_digest_; }
  /// As Soup::files_beside, without pictures.
  [[nodiscard]] std::vector<std::string> files_beside() const;

 private:
  void check_version() const;
  void check_extensions() const;
  [[nodiscard]] std::string_view bytes_in_buffer(const GltfObject& part);
  [[nodiscard]] std::string_view buffer(std::uint64_t i, const GltfObject& user);
  [[nodiscard]] std::string_view open_buffer(const GltfObject& buffer);

  const Source& source_;
  std::optional<std::string_view> binary_;
  std::unique_ptr<const nlohmann::json> json_;
  std::optional<GltfObject> root_;
  std::map<std::uint64_t, std::string_view> opened_;  ///< by number of the buffer
  std::deque<std::string> decoded_;                   ///< from text within the file
  std::map<std::uint64_t, std::string> unpacked_;     ///< compressed views, by number
  std::uint64_t unpacked_bytes_ = 0;
  std::map<std::string, std::string> files_;  ///< bytes of files next to it, by path
  std::uint64_t held_;
  std::string beside_digest_;
};

}  // namespace ridgecraft::mesh
