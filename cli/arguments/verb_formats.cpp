// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft formats
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {

Job build_formats(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft formats",
            "lists the formats that are read and written, and the presets for machines");
  verb.usage("ridgecraft formats [--presets] [--json]");
  verb.example("ridgecraft formats", "The list.");
  verb.example("ridgecraft formats --presets", "What each machine's files are like.");
  FormatsJob job;
  verb.flag("Output", "--presets", job.presets,
            "The table of presets alone: what each machine's files are like.");
  job::AskedOptions asked;
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    job.common = common_of(asked);
    return job;
  });
}

}  // namespace ridgecraft::cli
