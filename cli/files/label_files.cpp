// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/label_files.hpp"

#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/sentence.hpp"
#include "mesh/reading/read_file.hpp"
#include "segment/surface/segmentation.hpp"

namespace ridgecraft::cli {

std::string label_text(const Labels& labels) {
  std::string text;
  text.reserve(4 * labels.size());
  for (const std::uint32_t label : labels) {
    text += label == segment::no_part ? "-1" : std::to_string(label);
    text += '\n';
  }
  return text;
}

Labels read_labels(const std::string& file, std::size_t polygons) {
  const std::string bytes = mesh::read_file(file);
  constexpr std::string_view space = " \t\r\n";
  Labels labels;
  std::string_view rest = bytes;
  for (std::size_t begin = rest.find_first_not_of(space); begin != std::string_view::npos;
       begin = rest.find_first_not_of(space)) {
    rest.remove_prefix(begin);
    const std::string_view word = rest.substr(0, rest.find_first_of(space));
    long long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < -1 || value >= segment::no_part) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("{}: label {} is no part number (0, 1, 2 ... or -1)", file, labels.size() + 1),
                  file);
    }
    labels.push_back(value < 0 ? segment::no_part : static_cast<std::uint32_t>(value));
    if (labels.size() > polygons) {
      break;
    }
    rest.remove_prefix(word.size());
  }
  if (labels.size() != polygons) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("{} has {}, but the model has {}", file,
                            labels.size() > polygons ? fmt::format("more than {}", counted(polygons, "label"))
                                                     : counted(labels.size(), "label"),
                            counted(polygons, "polygon")),
                file);
  }
  return labels;
}

}  // namespace ridgecraft::cli
