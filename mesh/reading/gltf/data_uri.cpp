// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/gltf/data_uri.hpp"

#include "mesh/reading/encoded_text.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

constexpr std::string_view scheme = "data:";

}  // namespace

bool is_data_uri(std::string_view uri) {
  return equal_ignoring_case(uri.substr(0, scheme.size()), scheme);
}

std::optional<std::string> data_of_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!is_data_uri(uri) || comma == uri.npos) {
    return std::nullopt;
  }
  const std::string_view text = uri.substr(comma + 1);
  if (!uri.substr(0, comma).ends_with(";base64")) {
    return from_percent(text);
  }
  return text.find('%') == text.npos ? from_base64(text) : from_base64(from_percent(text));
}

}  // namespace ridgecraft::mesh
