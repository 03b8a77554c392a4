// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/hierarchy_file.hpp"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/version.hpp"
#include "cli/files/label_files.hpp"
#include "cli/files/value.hpp"
#include "export/export.hpp"
#include "segment/surface/segmentation.hpp"

namespace ridgecraft::cli {

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
    leaves.add(label == segment::no_part ? Value(-1) : Value(label));
  }
  Value text;
  text.set("by", program_and_version());
  text.set("model", model.name);
  text.set(std::string(paper::mark_key), model.digest);
  text.set("leaves", hierarchy.leaves);
  text.set("leaf_concavity", std::move(concavity));
  text.set("joinings", std::move(joinings));
  text.set("leaf_of_polygon", std::move(leaves));
  return json_line(text) + "\n";
}

}  // namespace ridgecraft::cli
