// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft info
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {

Job build_info(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft info", "tells what a model file holds, and what had to be repaired");
  verb.usage("ridgecraft info MODEL [--json]");
  verb.example("ridgecraft info gem.stl", "Faces, components, borders, size, repairs.");
  InfoJob job;
  job::AskedOptions asked;
  add_model(verb, job.model);
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.model, "name the model to look at", "ridgecraft info");
    job.common = common_of(asked);
    return job;
  });
}

}  // namespace ridgecraft::cli
