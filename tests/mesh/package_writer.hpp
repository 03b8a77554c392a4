// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the containers of new formats, independently of the readers: GLB files, ZIP archives, base64.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ridgecraft::test {

/// The four bytes of a number, little-endian; likewise two, and those of a float.
[[nodiscard]] std::string bytes4(std::uint32_t value);
[[nodiscard]] std::string bytes2(std::uint32_t value);
[[nodiscard]] std::string float_bytes(const std::vector<float>& values);

[[nodiscard]] std::string glb(std::string json, std::string binary);
[[nodiscard]] std::string base64(std::string_view bytes);

enum class Packing { stored, deflated };
using ZipFiles = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] std::string zip(const ZipFiles& files, Packing packing = Packing::stored);

/// A 3MF file with this XML as its root part, and more parts.
[[nodiscard]] std::string threemf(const std::string& model, const ZipFiles& more = {},
                                  Packing packing = Packing::stored);

}  // namespace ridgecraft::test
