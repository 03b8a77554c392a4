// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/file/json_text.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "verify/file/tolerance.hpp"

namespace ridgecraft::verify {
namespace {

/// Builds the value as the library's own parser does, and looks at depth and keys on the way: reading every
/// file a second time for these would take as long again.
class Builder {
 public:
  bool null() { return leaf(nullptr); }
  bool boolean(bool value) { return leaf(value); }
  bool number_integer(std::int64_t value) { return leaf(value); }
  bool number_unsigned(std::uint64_t value) { return leaf(value); }
  bool number_float(double value, const std::string& /*unused*/) { return leaf(value); }
  bool string(std::string& value) { return leaf(std::move(value)); }
  bool binary(Json::binary_t& value) { return leaf(std::move(value)); }
  bool start_object(std::size_t /*unused*/) { return open(Json::object()); }
  bool key(std::string& key) {
    const auto [member, added] = open_.back()->get_ref<Json::object_t&>().try_emplace(key);
    if (!added) {
      refuse("the file has the key {} twice in one object", quote(key));
    }
    member_ = &member->second;
    return true;
  }
  bool end_object() {
    open_.pop_back();
    return true;
  }
  bool start_array(std::size_t /*unused*/) { return open(Json::array()); }
  bool end_array() { return end_object(); }
  template <class Exception>
  bool parse_error(std::size_t /*unused*/, const std::string& /*unused*/, const Exception& error) {
    throw error;
  }

  [[nodiscard]] Json take() { return std::move(root_); }

 private:
  /// Where the next value goes. Nothing that is open moves: only the last one of a list is.
  Json& add(Json value) {
    if (open_.size() > max_json_depth) {
      refuse("the file is not in the form of the contract: lists are nested deeper than {}", max_json_depth);
    }
    if (open_.empty()) {
      return root_ = std::move(value);
    }
    if (Json& parent = *open_.back(); parent.is_array()) {
      return parent.get_ref<Json::array_t&>().emplace_back(std::move(value));
    }
    return *member_ = std::move(value);
  }
  bool leaf(Json value) {
    add(std::move(value));
    return true;
  }
  bool open(Json value) {
    open_.push_back(&add(std::move(value)));
    return true;
  }

  Json root_;
  std::vector<Json*> open_;  ///< lists and objects, from the outermost on
  Json* member_ = nullptr;   ///< of the object that is open
};

struct Place {
  std::size_t line = 1, column = 1;
};

Place place_of(std::string_view bytes, std::size_t byte) {
  const std::string_view before = bytes.substr(0, byte > 0 ? std::min(byte - 1, bytes.size()) : 0);
  const auto lines = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t last = before.rfind('\n');
  return {lines + 1, last == std::string_view::npos ? before.size() + 1 : before.size() - last};
}

}  // namespace

Json parse_json(std::string_view bytes) {
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    refuse("the file is empty");
  }
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") {
    refuse("the file begins with a byte order mark, which JSON doesn't allow");
  }
  try {
    Builder builder;
    Json::sax_parse(bytes.begin(), bytes.end(), &builder);
    return builder.take();
  } catch (const Json::parse_error& error) {
    const Place place = place_of(bytes, error.byte);
    refuse("the file is not JSON: {} at line {}, column {}",
           error.byte >= bytes.size() ? "it ends too early" : "it can't be read", place.line, place.column);
  } catch (const Json::exception&) {
    refuse("the file is not in the form of the contract: it has a number that is too large");
  }
}

std::string quote(std::string_view text) {
  constexpr std::size_t longest = 48;
  std::string result = "\"";
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7f ? '?' : c;
  }
  if (text.size() > longest) {
    // Not in the middle of a character: its first byte goes with those that follow it.
    while (result.size() > 1 && (static_cast<unsigned char>(result.back()) & 0xC0U) == 0x80U) {
      result.pop_back();
    }
    if (result.size() > 1 && (static_cast<unsigned char>(result.back()) & 0x80U) != 0) {
      result.pop_back();
    }
    result += "...";
  }
  return result + "\"";
}

}  // namespace ridgecraft::verify
