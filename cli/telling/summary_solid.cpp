// SPDX-License-Identifier: GPL-3.0-or-later
// What the verbs hulls, cage, shell and deform tell of their work.
#include <fmt/format.h>

#include "cli/jobs/solid_jobs.hpp"
#include "cli/telling/summary_blocks.hpp"

namespace ridgecraft::cli {

std::string summary(const std::string& model, const SolidResult& result) {
  std::size_t points = 0;
  std::size_t triangles = 0;
  for (const solid::Body& body : result.bodies) {
    points += body.points.size();
    triangles += body.triangles.size();
  }
  std::string text = fmt::format("{}: {}\n", model, counted(result.model.polygon_count, "polygon"));
  if (result.parts > 0) {
    text += fmt::format("  parts       {}\n", result.parts);
  }
  text += fmt::format("  result      {} {}, {} vertices, {} faces\n", result.bodies.size(),
                      result.bodies.size() == 1 ? "body" : "bodies", points, triangles);
  for (const std::string& note : result.notes) {
    text += "  note        " + note + "\n";
  }
  text += fmt::format("  time        {}\n", seconds_text(result.clock));
  return text + written_text(result.files);
}

std::string summary_json(const SolidResult& result) {
  Json json;
  json["model"] = result.model.name;
  json["faces"] = result.model.polygon_count;
  json["parts"] = result.parts;
  json["bodies"] = Json::array();
  for (const solid::Body& body : result.bodies) {
    json["bodies"].push_back({{"vertices", body.points.size()},
                              {"faces", body.triangles.size()},
                              {"volume", solid::mass_properties(body).volume}});
  }
  json["notes"] = result.notes;
  json["seconds"] = result.clock.total();
  json["stages"] = seconds_json(result.clock);
  json["repairs"] = repairs_json(result.model.repairs);
  json["files"] = result.files;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ridgecraft::cli
