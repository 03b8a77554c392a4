// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/page_document.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <catch2/catch.hpp>
#include <zlib.h>

namespace ridgecraft::test {
namespace {

std::string from_base64(const std::string& letters) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t held = 0;
  unsigned bits = 0;
  for (const char letter : letters.substr(0, letters.find('='))) {
    const std::size_t six = alphabet.find(letter);
    REQUIRE(six != std::string_view::npos);
    held = held << 6U | static_cast<std::uint32_t>(six);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<char>(held >> bits & 0xffU));
    }
  }
  return bytes;
}

/// The text that these letters hold (docs/design/viewer.md).
std::string unpacked(const std::string& letters) {
  std::string packed = from_base64(letters);
  z_stream stream{};
  REQUIRE(inflateInit(&stream) == Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  std::string text;
  std::array<char, 4096> some{};
  int told = Z_OK;
  while (told == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(some.data());
    stream.avail_out = some.size();
    told = inflate(&stream, Z_NO_FLUSH);
    text.append(some.data(), some.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  REQUIRE(told == Z_STREAM_END);
  return text;
}

}  // namespace

std::string page_document(const std::string& html, const std::string& id) {
  const std::string begin = "<script type=\"text/plain\" id=\"" + id + "\">";
  const std::size_t at = html.find(begin);
  REQUIRE(at != std::string::npos);
  const std::size_t from = at + begin.size();
  return unpacked(html.substr(from, html.find("</script>", from) - from));
}

}  // namespace ridgecraft::test
