// SPDX-License-Identifier: GPL-3.0-or-later
// What the verbs hulls, cage, shell and deform tell of their work.
#include <utility>

#include <fmt/format.h>

#include "base/sentence.hpp"
#include "cli/telling/summary.hpp"

namespace ridgecraft::cli {

Summary summary(const std::string& model, const SolidResult& result) {
  std::size_t points = 0;
  std::size_t triangles = 0;
  Value bodies(Value::List{});
  for (const solid::Body& body : result.bodies) {
    points += body.points.size();
    triangles += body.triangles.size();
    bodies.add(Value::Object{{"vertices", body.points.size()},
                             {"faces", body.triangles.size()},
                             {"volume", solid::mass_properties(body).volume}});
  }
  Summary summary(model + ": " + counted(result.model.polygon_count, "polygon"));
  summary.add("model", result.model.name);
  summary.add("faces", result.model.polygon_count);
  summary.add("parts", result.parts, Line::nets, "parts",
              result.parts > 0 ? std::to_string(result.parts) : "");
  summary.add("bodies", std::move(bodies), Line::nets, "result",
              fmt::format("{} {}, {} vertices, {} faces", result.bodies.size(),
                          result.bodies.size() == 1 ? "body" : "bodies", points, triangles));
  summary.add_notes(result.notes);
  summary.add_seconds(result.clock.seconds());
  summary.add_repairs(result.model.repairs);
  summary.add_files(result.files);
  return summary;
}

}  // namespace ridgecraft::cli
