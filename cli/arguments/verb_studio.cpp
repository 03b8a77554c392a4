// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft studio
#include <algorithm>
#include <utility>

#include "base/option_values.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {
namespace {

constexpr const char* no_browser_word = "--no-browser";

/// The words without the model's, which stands among them.
Arguments without_model(Arguments words, const std::string& model) {
  words.erase(std::find(words.begin(), words.end(), model));
  std::erase(words, "--");
  return words;
}

/// What the main job makes of the words tells whether they are right.
StudioJob checked(const Arguments& words) {
  StudioJob studio;
  if (words.empty()) {
    return studio;
  }
  const Job parsed = build_paper(&words, nullptr);
  const auto* const job = std::get_if<PaperJob>(&parsed);
  if (job == nullptr) {
    refuse("ridgecraft studio takes a model and options about its paper: ridgecraft studio --help");
  }
  if (!job->outputs.empty() || job->edges.any() || !job->tab_file.empty()) {
    refuse("the studio saves and reads files itself: leave out -o, --cuts, --keep, --from and --tab-file");
  }
  if (job->model == "-") {
    refuse("the studio takes a model's file, not standard input");
  }
  studio.model = job->model;
  studio.words = without_model(words, job->model);
  return studio;
}

}  // namespace

Job build_studio(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft studio",
            "opens a page in the browser that makes paper of a model, with controls for all wishes");
  verb.usage("ridgecraft studio [MODEL] [options of the main job]");
  verb.example("ridgecraft studio", "An empty page: drop a model on it.");
  verb.example("ridgecraft studio whale.obj --size 20cm", "With this model, 20 cm long to begin with.");
  std::string model;
  bool no_browser = false;
  verb.option(
      "Input", "MODEL", model, "MODEL",
      "What the page begins with; the options of ridgecraft MODEL may follow. All work is done in the "
      "browser, which sends nothing anywhere.");
  verb.flag("Common", no_browser_word, no_browser, "Only write the page, and print where it lies.");
  const auto asks_for_help = [](const Arguments& words) {
    return std::find(words.begin(), words.end(), "--help") != words.end() ||
           std::find(words.begin(), words.end(), "-h") != words.end();
  };
  if (arguments == nullptr || asks_for_help(*arguments)) {
    return verb.finish(arguments, manual, [] { return StudioJob{}; });
  }
  Arguments words = *arguments;
  no_browser = std::erase(words, no_browser_word) > 0;
  StudioJob job = checked(words);
  job.no_browser = no_browser;
  return job;
}

}  // namespace ridgecraft::cli
