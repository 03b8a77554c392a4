// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft verify
#include "cli/arguments/option_values.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {

Job build_verify(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft verify",
            "checks a file of nets: lengths, overlaps, coverage, pages, joins, refolding");
  verb.usage("ridgecraft verify FILE.fold [--json]");
  verb.example("ridgecraft verify whale.fold",
               "The figures, and every fault; exit code 6 when there is one.");
  VerifyJob job;
  CommonTexts common;
  verb.option(
      "Input", "FILE", job.file, "FILE",
      "A .fold file of ours or of another program in the same form. What isn't JSON can't be checked: exit "
      "code 3.");
  common.add_to(verb);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.file, "name the .fold file to check", "ridgecraft verify");
    job.common = common.checked();
    return job;
  });
}

}  // namespace ridgecraft::cli
