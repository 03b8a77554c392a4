// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/page_document.hpp"

#include <array>
#include <vector>

#include <catch2/catch.hpp>
#include <zlib.h>

namespace ridgecraft::test {
namespace {

/// The text that these letters hold (docs/design/viewer.md): seven bits each, and those of what a page can't
/// hold in front of seven more.
std::string unpacked(const std::string& letters) {
  std::vector<bool> bits;
  const auto append = [&](unsigned seven) {
    for (unsigned bit = 64; bit > 0; bit /= 2) {
      bits.push_back((seven & bit) != 0);
    }
  };
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const unsigned byte = static_cast<unsigned char>(letters[i]);
    if (byte < 0x80) {
      append(byte);
    } else {
      const unsigned letter = (byte & 0x1fU) << 6U | (static_cast<unsigned char>(letters.at(++i)) & 0x3fU);
      append(std::array{0x00U, 0x0dU, 0x3cU}.at(letter / 0x80 - 2));
      append(letter & 0x7fU);
    }
  }
  std::string packed(bits.size() / 8, '\0');
  for (std::size_t i = 0; i < 8 * packed.size(); ++i) {
    packed[i / 8] = static_cast<char>(packed[i / 8] << 1U | (bits[i] ? 1 : 0));
  }
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
