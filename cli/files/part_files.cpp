// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/part_files.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/no_index.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "cli/files/value.hpp"
#include "export/export.hpp"
#include "mesh/reading/files.hpp"
#include "segment/surface/segmentation.hpp"

namespace ridgecraft::cli {
namespace {

/// Hue, saturation and value, each in [0, 1].
mesh::ByteColour from_hsv(double hue, double saturation, double value) {
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue * 6.0, 6.0);
    const double share = value - value * saturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255.0 * share));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

}  // namespace

mesh::FaceColours part_colours(const segment::Segmentation& segmentation) {
  // Hues in golden-ratio steps: any few consecutive numbers lie far apart on the wheel.
  constexpr double golden = 0.6180339887498949;
  mesh::FaceColours colours(segmentation.part.size());
  for (const FaceId f : ids<FaceId>(segmentation.part.size())) {
    const std::uint32_t number = segmentation.part[f].value();
    const double hue = std::fmod(0.08 + golden * number, 1.0);
    colours[f] = from_hsv(hue, number % 3 == 1 ? 0.45 : 0.7, number % 2 == 1 ? 0.8 : 0.95);
  }
  return colours;
}

std::string with_comment(std::string mesh_file, const std::string& comment) {
  // PLY wants the format in its second line; an OFF comment may stand anywhere after the keyword.
  const bool ply = mesh_file.starts_with("ply\n");
  std::size_t at = mesh_file.find('\n') + 1;
  if (ply) {
    at = mesh_file.find('\n', at) + 1;
  }
  mesh_file.insert(at, (ply ? "comment " : "# ") + comment + "\n");
  return mesh_file;
}

std::string label_text(const Labels& labels) {
  std::string text;
  text.reserve(4 * labels.size());
  for (const std::uint32_t label : labels) {
    text += label == no_index ? "-1" : std::to_string(label);
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
    if (error != std::errc() || end != word.data() + word.size() || value < -1 || value >= no_index) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("{}: label {} is no part number (0, 1, 2 ... or -1)", file, labels.size() + 1),
                  file);
    }
    labels.push_back(value < 0 ? no_index : static_cast<std::uint32_t>(value));
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

std::string hierarchy_text(const mesh::Model& model, const segment::Hierarchy& hierarchy) {
  Value concavity(Value::List{});
  for (std::size_t i = 0; i < hierarchy.leaves; ++i) {
    concavity.add(hierarchy.nodes[i].concavity);
  }
  Value joinings(Value::List{});
  for (std::size_t i = 0; i < hierarchy.joinings.size(); ++i) {
    const segment::Joining& joining = hierarchy.joinings[i];
    joinings.add(Value::Object{{"node", hierarchy.leaves + i},
                               {"of", Value::List{joining.first, joining.second}},
                               {"concavity", joining.concavity}});
  }
  Value leaves(Value::List{});
  for (const std::uint32_t label : segment::polygon_labels(model, hierarchy.parts(hierarchy.leaves))) {
    leaves.add(label == no_index ? Value(-1) : Value(label));
  }
  Value text;
  text.set("by", program_and_version());
  text.set("model", model.name);
  text.set(std::string(export_::mark_key), model.digest);
  text.set("leaves", hierarchy.leaves);
  text.set("leaf_concavity", std::move(concavity));
  text.set("joinings", std::move(joinings));
  text.set("leaf_of_polygon", std::move(leaves));
  return json_line(text) + "\n";
}

}  // namespace ridgecraft::cli
