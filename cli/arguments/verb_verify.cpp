// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft verify
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {

Job build_verify(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft verify",
            "checks a file of nets: lengths, overlaps, coverage, pages, joins, refolding");
  verb.usage("ridgecraft verify FILE.fold [--model MODEL] [--pages FILE...] [--json]");
  verb.example("ridgecraft verify whale.fold",
               "The figures, and every fault; exit code 6 when there is one.");
  verb.example("ridgecraft verify whale.fold --model whale.obj --pages whale.pdf",
               "Also whether the nets are the model's, and what is printed the nets.");
  VerifyJob job;
  job::AskedOptions asked;
  verb.option(
      "Input", "FILE", job.file, "FILE",
      "A .fold file of ours or of another program in the same form. What isn't JSON can't be checked: exit "
      "code 3.");
  verb.option(
      "Input", "--model", job.model, "MODEL",
      "The model that the nets were made from: do they have its surface, at their scale, as near as the "
      "file's settings promise?");
  verb.list(
      "Input", "--pages", job.pages, "FILE",
      "What is printed, as PDF or SVG, one file or several: does it show the outlines, folds and bases of "
      "tabs of the nets, and no other, in true size?");
  add_common(verb, asked);
  return verb.finish(arguments, manual, [&]() -> Job {
    require(job.file, "name the .fold file to check", "ridgecraft verify");
    job.common = common_of(asked);
    return job;
  });
}

}  // namespace ridgecraft::cli
