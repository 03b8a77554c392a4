// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/gltf/json_object.hpp"

#include <cmath>

#include <fmt/format.h>

namespace ridgecraft::mesh {
namespace {

using Json = nlohmann::json;

/// JSON has one kind of number: 3.0 is as whole as 3.
std::optional<std::uint64_t> whole_number(const Json& value) {
  // Beyond this not every whole number is a double.
  constexpr double largest = 9007199254740992.0;
  if (value.is_number_unsigned()) {
    return value.get<std::uint64_t>();
  }
  const double number = value.is_number_float() ? value.get<double>() : -1.0;
  if (number < 0.0 || number > largest || number != std::floor(number)) {
    return std::nullopt;
  }
  return static_cast<std::uint64_t>(number);
}

}  // namespace

const Json* GltfObject::find(const char* key) const {
  const auto found = json_->find(key);
  return found == json_->end() ? nullptr : &*found;
}

const Json* GltfObject::list(const char* key) const {
  const Json* const value = find(key);
  if (value != nullptr && !value->is_array()) {
    refuse_value(key, "list");
  }
  return value;
}

std::string GltfObject::inside(const char* key) const {
  return place_.empty() ? std::string(key) : place_ + "." + key;
}

void GltfObject::refuse(std::string_view reason, ErrorKind kind) const {
  if (place_.empty()) {
    source_->refuse(kind, fmt::format("can't be read as glTF: {}", reason));
  }
  throw Error(kind, fmt::format("{}, {}: {}", source_->file, place_, reason), source_->file);
}

void GltfObject::refuse_value(const char* key, std::string_view wanted) const {
  refuse(fmt::format("\"{}\" is no {}", key, wanted));
}

std::optional<std::uint64_t> GltfObject::whole(const char* key) const {
  const Json* const value = find(key);
  if (value == nullptr) {
    return std::nullopt;
  }
  const auto number = whole_number(*value);
  if (!number) {
    refuse_value(key, "whole number");
  }
  return number;
}

std::uint64_t GltfObject::needed_whole(const char* key) const {
  const auto number = whole(key);
  if (!number) {
    refuse(fmt::format("\"{}\" is missing", key));
  }
  return *number;
}

std::optional<double> GltfObject::number(const char* key) const {
  const Json* const value = find(key);
  if (value == nullptr) {
    return std::nullopt;
  }
  if (!value->is_number()) {
    refuse_value(key, "number");
  }
  return value->get<double>();
}

bool GltfObject::truth(const char* key) const {
  const Json* const value = find(key);
  if (value != nullptr && !value->is_boolean()) {
    refuse_value(key, "truth value");
  }
  return value != nullptr && value->get<bool>();
}

std::string GltfObject::text(const char* key) const {
  const Json* const value = find(key);
  if (value == nullptr) {
    return {};
  }
  if (!value->is_string()) {
    refuse_value(key, "text");
  }
  return value->get<std::string>();
}

std::optional<std::vector<double>> GltfObject::numbers(const char* key) const {
  const Json* const values = list(key);
  if (values == nullptr) {
    return std::nullopt;
  }
  std::vector<double> numbers;
  numbers.reserve(values->size());
  for (const Json& value : *values) {
    if (!value.is_number()) {
      refuse_value(key, "list of numbers");
    }
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

std::optional<std::vector<double>> GltfObject::numbers(const char* key, std::size_t count) const {
  auto values = numbers(key);
  if (values && values->size() != count) {
    refuse(fmt::format("\"{}\" has {} numbers instead of {}", key, values->size(), count));
  }
  return values;
}

std::vector<std::uint64_t> GltfObject::wholes(const char* key) const {
  std::vector<std::uint64_t> numbers;
  if (const Json* const values = list(key)) {
    numbers.reserve(values->size());
    for (const Json& value : *values) {
      const auto number = whole_number(value);
      if (!number) {
        refuse_value(key, "list of whole numbers");
      }
      numbers.push_back(*number);
    }
  }
  return numbers;
}

std::vector<std::string> GltfObject::texts(const char* key) const {
  std::vector<std::string> texts;
  if (const Json* const values = list(key)) {
    for (const Json& value : *values) {
      if (!value.is_string()) {
        refuse_value(key, "list of texts");
      }
      texts.push_back(value.get<std::string>());
    }
  }
  return texts;
}

std::optional<GltfObject> GltfObject::object(const char* key) const {
  const Json* const value = find(key);
  if (value == nullptr) {
    return std::nullopt;
  }
  if (!value->is_object()) {
    refuse_value(key, "object");
  }
  return GltfObject(*source_, *value, inside(key));
}

std::size_t GltfObject::size(const char* key) const {
  const Json* const values = list(key);
  return values == nullptr ? 0 : values->size();
}

GltfObject GltfObject::element(const char* key, std::uint64_t i) const {
  const std::size_t count = size(key);
  if (i >= count) {
    refuse(count == 0 ? fmt::format("\"{}\" has no element {}: it is empty", key, i)
                      : fmt::format("\"{}\" has no element {}, only 0 to {}", key, i, count - 1));
  }
  const Json& value = (*find(key))[static_cast<std::size_t>(i)];
  std::string place = fmt::format("{}[{}]", inside(key), i);
  if (!value.is_object()) {
    throw Error(ErrorKind::unreadable_input, fmt::format("{}, {}: it is no object", source_->file, place),
                source_->file);
  }
  return {*source_, value, std::move(place)};
}

std::optional<GltfObject> GltfObject::extension(const char* name) const {
  const auto extensions = object("extensions");
  return extensions ? extensions->object(name) : std::nullopt;
}

}  // namespace ridgecraft::mesh
