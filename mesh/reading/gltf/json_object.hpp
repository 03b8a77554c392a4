// SPDX-License-Identifier: GPL-3.0-or-later
// An object of a glTF file, asked for values of the type that the standard gives them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "mesh/reading/source.hpp"

namespace ridgecraft::mesh {

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
  [[nodiscard]] const nlohmann::json* list(const char* key) const;
  [[nodiscard]] std::string inside(const char* key) const;
  [[noreturn]] void refuse_value(const char* key, std::string_view wanted) const;

  const Source* source_;
  const nlohmann::json* json_;
  std::string place_;  ///< empty for the whole file
};

}  // namespace ridgecraft::mesh
