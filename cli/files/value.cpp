// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/value.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/error.hpp"

namespace ridgecraft::cli {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Value& value) {
  return std::visit(
      [](const auto& held) {
        using Held = std::decay_t<decltype(held)>;
        Json json;
        if constexpr (std::is_same_v<Held, Value::List>) {
          json = Json::array();
          for (const Value& item : held) {
            json.push_back(json_of(item));
          }
        } else if constexpr (std::is_same_v<Held, Value::Object>) {
          json = Json::object();
          for (const Value::Member& member : held) {
            json[member.key] = json_of(member.value);
          }
        } else if constexpr (!std::is_same_v<Held, std::monostate>) {
          json = held;
        }
        return json;
      },
      value.held());
}

std::string dumped(const Value& value, int indent) {
  return json_of(value).dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Value::Value(Object value) : held_(std::move(value)) {}

void Value::add(Value value) {
  if (std::holds_alternative<std::monostate>(held_)) {
    held_ = List();
  }
  std::get<List>(held_).push_back(std::move(value));
}

void Value::set(std::string key, Value value) {
  if (std::holds_alternative<std::monostate>(held_)) {
    held_ = Object();
  }
  Object& members = std::get<Object>(held_);
  RIDGECRAFT_ASSERT(
      std::none_of(members.begin(), members.end(), [&](const Member& m) { return m.key == key; }));
  members.push_back({std::move(key), std::move(value)});
}

Value list_of(const std::vector<std::string>& texts) {
  return Value::List(texts.begin(), texts.end());
}

Value rounded(double value) {
  return std::round(value * 1000.0) / 1000.0;
}

bool is_json(std::string_view text) {
  return Json::accept(text);
}

std::string json_text(const Value& value) {
  return dumped(value, 2);
}

std::string json_line(const Value& value) {
  return dumped(value, -1);
}

}  // namespace ridgecraft::cli
