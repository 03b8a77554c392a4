// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft info
#include "cli/arguments/option_values.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {

Job build_info(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft info", "tells what a model file holds, and what had to be repaired");
  verb.usage("ridgecraft info MODEL [--json]");
  verb.example("ridgecraft info gem.stl", "Faces, components, borders, size, repairs.");
  InfoJob job;
  CommonTexts common;
  add_model(verb, job.model);
  common.add_to(verb);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to look at", "ridgecraft info");
    job.common = common.checked();
    return job;
  });
}

}  // namespace ridgecraft::cli
