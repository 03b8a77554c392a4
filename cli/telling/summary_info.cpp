// SPDX-License-Identifier: GPL-3.0-or-later
// What ridgecraft info tells.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/sentence.hpp"
#include "cli/files/model_input.hpp"
#include "cli/telling/summary.hpp"
#include "prepare/selection/selection.hpp"

namespace ridgecraft::cli {

namespace {

/// "metres, y points up: 1000 x 500 x 300 mm"
std::string told_frame(const mesh::FileFrame& frame, Vec3 size) {
  if (!frame.mm_per_unit) {
    return {};
  }
  const Vec3 mm = *frame.mm_per_unit * size;
  return fmt::format("{}{}: {:g} x {:g} x {:g} mm", mesh::unit_names(*frame.mm_per_unit),
                     frame.up ? fmt::format(", {} points up", mesh::axis_name(*frame.up)) : "", mm.x, mm.y,
                     mm.z);
}

/// "body, wheel.L and 12 more: --only and --without take them"
std::string names_text(const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  if (names.empty()) {
    return {};
  }
  std::vector<std::string> told(names.begin(),
                                names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size())));
  if (names.size() > most) {
    told.push_back(std::to_string(names.size() - most) + " more");
  }
  return listed(told, "and") + ": --only and --without take them";
}

}  // namespace

Summary summary(const InfoJob& job, const mesh::Model& model, const prepare::Panels& panels) {
  const mesh::Surface& surface = model.surface;
  std::size_t border = 0;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    border += surface.is_border(e) ? 1U : 0U;
  }
  const Vec3 size = model.file_scale * surface.bounds().size();
  Summary summary(shown_name(job.model) + ": " + counted(model.polygon_count, "polygon"));
  summary.add("model", model.name);
  summary.add("polygons", model.polygon_count);
  summary.add("faces", surface.face_count(), Line::nets, "surface",
              fmt::format("{}, {} vertices, {}, {}", counted(surface.face_count(), "triangle"),
                          surface.vertex_count(), counted(panels.count(), "panel"),
                          counted(surface.component_count(), "component")));
  summary.add("vertices", surface.vertex_count());
  summary.add("panels", panels.count());
  summary.add("components", surface.component_count());
  summary.add("border_edges", border, Line::nets, "border",
              border == 0 ? "none: the surface is closed" : counted(border, "edge"));
  summary.add("size", Value::List{size.x, size.y, size.z}, Line::nets, "size",
              fmt::format("{:g} x {:g} x {:g} in the file's unit", size.x, size.y, size.z));
  const mesh::FileFrame& frame = model.frame;
  summary.add("file_unit_mm", Value(frame.mm_per_unit), Line::nets, "unit", told_frame(frame, size), "mm");
  summary.add("file_up", frame.up ? Value(mesh::axis_name(*frame.up)) : Value());
  const std::vector<std::string> names = prepare::names_of(model);
  summary.add("names", list_of(names), Line::nets, "names", names_text(names));
  summary.add("materials", model.materials.size());
  summary.add("textured", !model.texture.empty());
  summary.add_repairs(model.repairs);
  for (const std::string& line : repair_lines(model.repairs)) {
    summary.say(Line::notes, "repair", line);
  }
  return summary;
}

}  // namespace ridgecraft::cli
