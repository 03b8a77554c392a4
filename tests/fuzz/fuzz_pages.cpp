// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes to the readers of printed pages: an SVG file, or the content of a PDF page. The file around that
// content is qpdf's to read.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "verify/file/file.hpp"
#include "verify/pages/printed.hpp"
#include "verify/pages/readers.hpp"

namespace {

using namespace ridgecraft;

void require(bool condition) {
  if (!condition) {
    std::abort();
  }
}

void check_svg(std::string_view bytes) {
  const verify::PrintedFile file = verify::read_svg("x.svg", bytes);
  require(file.pages.size() == (file.defect.empty() ? 1U : 0U));
  for (const verify::PrintedPage& page : file.pages) {
    require(page.size.x > 0.0 && page.size.y > 0.0);
    for (const verify::PrintedLine& line : page.lines) {
      require(line.points.size() >= 2 && line.layer != verify::PrintedLayer::other);
    }
  }
}

void check_content(std::string_view bytes) {
  const verify::ContentEvents events{.path =
                                         [](const verify::InkPath& path, const verify::InkState&) {
                                           require(path.stroked || path.filled);
                                           for (const auto& line : path.lines) {
                                             require(line.size() >= 2);
                                           }
                                         },
                                     .object = [](std::string_view, const verify::InkState&) {},
                                     .hides_lines = [](std::string_view name) { return name == "a"; },
                                     .text = [](const verify::InkText&, const verify::InkState&) {},
                                     .other = [] {}};
  try {
    verify::read_content(bytes, {}, events);
  } catch (const verify::NotInForm& reason) {
    require(!reason.message.empty());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  // A file that begins like XML is one; content never does.
  bytes.starts_with('<') ? check_svg(bytes) : check_content(bytes);
  return 0;
}
