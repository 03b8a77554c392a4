// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/threemf/slicer_project.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/text.hpp"

namespace ridgecraft::mesh {
namespace {

/// Deeper divisions than any brush makes: 2^-24 of a side is nothing.
constexpr int deepest_division = 24;
/// More filaments than any printer holds.
constexpr std::uint32_t most_filaments = 1024;

/// A number that stands alone; 0 for all else.
std::uint32_t number_of(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

/// The value of <metadata key="KEY" value="..."/> below a node.
std::string_view setting(pugi::xml_node node, std::string_view key) {
  for (const pugi::xml_node child : node.children("metadata")) {
    if (key == child.attribute("key").value()) {
      return child.attribute("value").value();
    }
  }
  return {};
}

/// PrusaSlicer writes "ParameterModifier", Bambu Studio "modifier_part"; Slic3r had modifiers only.
SlicerRole role_of(std::string_view word, std::string_view is_modifier) {
  const auto has = [&](std::string_view part) {
    return std::search(word.begin(), word.end(), part.begin(), part.end(),
                       [](char a, char b) { return (a | 0x20) == b; }) != word.end();
  };
  return has("negative")                         ? SlicerRole::negative
         : has("enforcer") || has("blocker")     ? SlicerRole::support
         : has("modifier") || is_modifier == "1" ? SlicerRole::modifier
                                                 : SlicerRole::model;
}

/// PrusaSlicer, SuperSlicer: an object's one mesh is divided into ranges of triangles.
void read_volumes(pugi::xml_node config, SlicerProject& project) {
  for (const pugi::xml_node object : config.children("object")) {
    SlicerObject& into = project.objects[number_of(object.attribute("id").value())];
    into.name = printable(setting(object, "name"));
    into.filament = std::max(1U, number_of(setting(object, "extruder")));
    for (const pugi::xml_node volume : object.children("volume")) {
      into.volumes.push_back({number_of(volume.attribute("firstid").value()),
                              number_of(volume.attribute("lastid").value()),
                              {printable(setting(volume, "name")),
                               role_of(setting(volume, "volume_type"), setting(volume, "modifier")),
                               number_of(setting(volume, "extruder"))}});
    }
    std::sort(into.volumes.begin(), into.volumes.end(),
              [](const SlicerVolume& a, const SlicerVolume& b) { return a.first < b.first; });
  }
}

/// Bambu Studio, OrcaSlicer: each component is a part.
void read_parts(pugi::xml_node config, SlicerProject& project) {
  for (const pugi::xml_node object : config.children("object")) {
    SlicerObject& into = project.objects[number_of(object.attribute("id").value())];
    into.name = printable(setting(object, "name"));
    into.filament = std::max(1U, number_of(setting(object, "extruder")));
    for (const pugi::xml_node part : object.children("part")) {
      into.parts[number_of(part.attribute("id").value())] = {printable(setting(part, "name")),
                                                             role_of(part.attribute("subtype").value(), {}),
                                                             number_of(setting(part, "extruder"))};
    }
  }
  std::set<std::uint32_t> used;
  for (const pugi::xml_node plate : config.children("plate")) {
    const std::uint32_t number = number_of(setting(plate, "plater_id"));
    for (const pugi::xml_node instance : plate.children("model_instance")) {
      used.insert(number);
      project
          .plates[{number_of(setting(instance, "object_id")), number_of(setting(instance, "instance_id"))}] =
          number;
    }
  }
  if (used.size() < 2) {
    project.plates.clear();
  }
}

/// One colour for each filament; those that can't be read are white.
std::vector<ColourBytes> colours_of(const std::vector<std::string>& texts) {
  std::vector<ColourBytes> colours;
  for (const std::string& text : texts) {
    colours.push_back(colour_bytes(text).value_or(ColourBytes{255, 255, 255}));
  }
  return colours;
}

/// What follows "KEY = " on a line that begins with "; ", divided at semicolons.
std::vector<std::string> listed_setting(std::string_view text, std::string_view key) {
  const std::size_t at = text.find(fmt::format("; {} = ", key));
  if (at == text.npos) {
    return {};
  }
  text.remove_prefix(at + key.size() + 5);
  text = text.substr(0, text.find_first_of("\r\n"));
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (c == ';') {
      words.emplace_back();
    } else if (c != ' ' && c != '"') {
      words.back() += c;
    }
  }
  return words;
}

/// PrusaSlicer's settings: the colour of an extruder counts more than that of its filament.
std::vector<ColourBytes> colours_in_settings(std::string_view text) {
  std::vector<std::string> colours = listed_setting(text, "filament_colour");
  const std::vector<std::string> extruders = listed_setting(text, "extruder_colour");
  colours.resize(std::max(colours.size(), extruders.size()));
  for (std::size_t i = 0; i < extruders.size(); ++i) {
    if (colour_bytes(extruders[i])) {
      colours[i] = extruders[i];
    }
  }
  return colours_of(colours);
}

/// The list of texts behind "filament_colour" in JSON.
std::vector<ColourBytes> colours_in_json(std::string_view text) {
  const std::size_t key = text.find("\"filament_colour\"");
  const std::size_t open = key == text.npos ? key : text.find('[', key);
  if (open == text.npos) {
    return {};
  }
  text = text.substr(open, text.find(']', open) - open);
  std::vector<std::string> colours;
  for (std::size_t at = text.find('"'); at != text.npos; at = text.find('"', at + 1)) {
    const std::size_t end = text.find('"', at + 1);
    colours.emplace_back(text.substr(at + 1, end == text.npos ? end : end - at - 1));
    at = end == text.npos ? text.size() - 1 : end;
  }
  return colours_of(colours);
}

}  // namespace

std::string counted_role(SlicerRole role, std::size_t count) {
  static constexpr std::array<std::string_view, 4> names{"part", "negative part", "modifier", "support"};
  return fmt::format("{} {}{}", count, names[static_cast<std::size_t>(role)], count == 1 ? "" : "s");
}

SlicerProject read_slicer_project(ThreemfPackage& package) {
  SlicerProject project;
  for (const char* name : {"Metadata/Slic3r_PE_model.config", "Metadata/SuperSlicer_model.config",
                           "Metadata/Slic3r_model.config"}) {
    if (const auto config = package.side_xml(name)) {
      read_volumes(config->document_element(), project);
    }
  }
  if (const auto config = package.side_xml("Metadata/model_settings.config")) {
    read_parts(config->document_element(), project);
  }
  for (const char* name :
       {"Metadata/Slic3r_PE.config", "Metadata/SuperSlicer.config", "Metadata/Slic3r.config"}) {
    if (const auto settings = package.side_bytes(name); settings && project.filaments.empty()) {
      project.filaments = colours_in_settings(*settings);
    }
  }
  if (const auto settings = package.side_bytes("Metadata/project_settings.config")) {
    project.filaments = colours_in_json(*settings);
  }
  return project;
}

std::vector<PaintedPiece> PaintDivider::divide(std::array<std::uint32_t, 3> corners, std::string_view code) {
  std::vector<PaintedPiece> pieces;
  code_ = code;
  if (!divide(corners, 0, pieces)) {
    pieces = {{corners, 0}};
  }
  return pieces;
}

std::uint32_t PaintDivider::middle(std::uint32_t a, std::uint32_t b) {
  const auto [found, fresh] =
      middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points_.size()));
  if (fresh) {
    points_.push_back(0.5 * (points_[a] + points_[b]));
  }
  return found->second;
}

/// A digit is the number of sides that are split and, above it, the corner that the split begins at; of a
/// piece that isn't split the filament, or 3 where that follows in digits of its own. Pieces come last first.
bool PaintDivider::divide(std::array<std::uint32_t, 3> corners, int depth,
                          std::vector<PaintedPiece>& pieces) {
  const auto next_digit = [&]() -> std::optional<std::uint32_t> {
    std::uint32_t digit = 0;
    if (code_.empty() || std::from_chars(&code_.back(), &code_.back() + 1, digit, 16).ec != std::errc()) {
      return std::nullopt;
    }
    code_.remove_suffix(1);
    return digit;
  };
  const auto digit = next_digit();
  if (!digit || depth > deepest_division || pieces_ >= most_pieces) {
    return false;
  }
  const std::uint32_t sides = *digit & 3U;
  std::uint32_t value = *digit >> 2U;
  if (sides == 0) {
    for (bool more = value == 3; more;) {
      const auto further = next_digit();
      if (!further || value > most_filaments) {
        return false;
      }
      value += *further;
      more = *further == 15;
    }
    pieces.push_back({corners, value});
    ++pieces_;
    return true;
  }
  const std::uint32_t a = corners[value % 3];
  const std::uint32_t b = corners[(value + 1) % 3];
  const std::uint32_t c = corners[(value + 2) % 3];
  std::vector<std::array<std::uint32_t, 3>> parts;
  if (sides == 1) {
    const std::uint32_t bc = middle(b, c);
    parts = {{a, b, bc}, {bc, c, a}};
  } else {
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t ca = middle(c, a);
    parts = {{a, ab, ca}, {ab, b, ca}, {b, c, ca}};
    if (sides == 3) {
      const std::uint32_t bc = middle(b, c);
      parts = {{a, ab, ca}, {ab, b, bc}, {bc, c, ca}, {ab, bc, ca}};
    }
  }
  return std::all_of(parts.rbegin(), parts.rend(),
                     [&](const auto& part) { return divide(part, depth + 1, pieces); });
}

std::vector<std::uint32_t> PaintDivider::outline(const std::array<std::uint32_t, 3>& corners) const {
  std::vector<std::uint32_t> line;
  for (std::size_t k = 0; k < 3; ++k) {
    add_side(corners[k], corners[(k + 1) % 3], line);
  }
  return line;
}

/// From a to before b.
void PaintDivider::add_side(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& line) const {
  const auto found = middles_.find(std::minmax(a, b));
  if (found == middles_.end()) {
    line.push_back(a);
    return;
  }
  add_side(a, found->second, line);
  add_side(found->second, b, line);
}

}  // namespace ridgecraft::mesh
