// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as what ridgecraft-import says of a file.
#include "fuzz_reader.hpp"
#include "mesh/reading/imported/read_imported.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ridgecraft;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const Context context;
  try {
    const mesh::Soup soup =
        mesh::read_stream(bytes, mesh::FileFormat::fbx, {bytes, "model.fbx", {}, context});
    if (soup.polygon_count() > 0) {
      test::check_soup(soup, size);
    }
  } catch (const Error& error) {
    const std::string sentence = error.what();
    test::require(sentence.starts_with("model.fbx") && sentence.size() < 500 &&
                  printable(sentence) == sentence);
  }
  return 0;
}
