// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft batch
#include <algorithm>
#include <charconv>
#include <map>
#include <string>
#include <thread>

#include "base/option_values.hpp"
#include "base/text.hpp"
#include "cli/arguments/options.hpp"
#include "cli/arguments/parse.hpp"
#include "cli/arguments/shared_options.hpp"
#include "cli/arguments/verb.hpp"
#include "cli/arguments/verbs.hpp"

namespace ridgecraft::cli {
namespace {

/// What a verb's result is written as, where the user doesn't say.
const std::map<std::string, std::string> usual_suffix{
    {"hulls", ".obj"}, {"segment", ".seg"}, {"unfold", ".fold"}, {"paper", ".pdf"}, {"info", ""}};

constexpr std::uint64_t most_jobs = 1024;
constexpr std::uint64_t most_shards = 1000000;
constexpr std::uint64_t megabyte = 1000000;

struct BatchTexts {
  std::string jobs, shard, memory, seconds;
};

/// "3/10"
void read_shard(const std::string& text, BatchJob& job) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) {
    refuse("--shard says which share of the models to do, such as 1/4, not '" + text + "'");
  }
  job.shards = whole_number_or_refuse("--shard", text.substr(slash + 1), 1, most_shards);
  job.shard = whole_number_or_refuse("--shard", text.substr(0, slash), 1, job.shards);
}

/// Refuses now what each model's process would refuse.
void check_words(const BatchJob& job) {
  Arguments words;
  if (job.verb != "paper") {
    words.push_back(job.verb);
  }
  words.emplace_back("model.obj");
  if (!job.suffix.empty()) {
    words.insert(words.end(),
                 {job.verb == "segment" && job.suffix == ".seg" ? "--labels" : "-o", "result" + job.suffix});
  }
  words.insert(words.end(), job.words.begin(), job.words.end());
  for (const std::string& word : job.words) {
    if (word.starts_with("-o") || word.starts_with("--output") || word.starts_with("--labels") ||
        word.starts_with("--time-limit")) {
      refuse("behind -- go options of " + job.verb + " for all models, not " + word);
    }
  }
  static_cast<void>(parse_arguments(words));
}

BatchJob checked(BatchJob job, const BatchTexts& texts) {
  require(job.verb, "say what to do with each model: hulls, segment, unfold, paper or info",
          "ridgecraft batch");
  const auto usual = usual_suffix.find(job.verb);
  if (usual == usual_suffix.end()) {
    refuse("a batch does hulls, segment, unfold, paper or info, not '" + job.verb + "'");
  }
  require(job.input, "name a folder or a list of models, or - for a list on standard input",
          "ridgecraft batch");
  require(job.output, "say with -o into which folder results and report go", "ridgecraft batch");
  if (job.verb == "info" && !job.suffix.empty()) {
    refuse("info writes nothing but the report: leave out --format");
  }
  if (!job.suffix.empty() && !job.suffix.starts_with('.')) {
    job.suffix = "." + job.suffix;
  }
  job.suffix = job.suffix.empty() ? usual->second : job.suffix;
  if (!texts.jobs.empty()) {
    job.jobs = static_cast<unsigned>(whole_number_or_refuse("--jobs", texts.jobs, 1, most_jobs));
  }
  if (!texts.shard.empty()) {
    read_shard(texts.shard, job);
  }
  if (!texts.memory.empty()) {
    job.memory_bytes = megabyte * whole_number_or_refuse("--memory-limit", texts.memory, 1);
  }
  if (!texts.seconds.empty()) {
    constexpr double longest_s = 1e9;
    job.seconds = number_or_refuse("--time-limit", texts.seconds, 1e-3, longest_s);
  }
  check_words(job);
  return job;
}

}  // namespace

Job build_batch(const Arguments* arguments, Manual* manual) {
  Verb verb("ridgecraft batch", "one verb for many models, each in a process of its own, and a report");
  verb.usage(
      "ridgecraft batch hulls|segment|unfold|paper|info LIST|FOLDER|- -o RESULTS [options] [-- OPTIONS]");
  verb.example("ridgecraft batch hulls models -o hulls --time-limit 60 -- --max-hulls 32 --max-vertices 60",
               "All models of a folder; what follows -- goes to ridgecraft hulls.");
  verb.example("ridgecraft batch hulls list.txt -o hulls --shard 3/100 --resume",
               "The third hundredth of a list, going on where an earlier run was ended.");
  BatchJob job;
  job::AskedOptions asked;
  BatchTexts texts;
  job.jobs = std::max(1U, std::thread::hardware_concurrency());
  verb.option("Input", "VERB", job.verb, "VERB", "hulls, segment, unfold, paper (the main job) or info.");
  verb.option(
      "Input", "LIST", job.input, "LIST",
      "A file with a model a line, a folder (with those below it), or - for a list on standard input.");
  verb.option("Output", "-o,--output", job.output, "FOLDER",
              "Results, each under its model's path with a suffix more, and the report.");
  verb.option(
      "Output", "--format", job.suffix, "SUFFIX",
      "What results are written as (obj for hulls, seg for segment, fold for unfold, pdf for paper).");
  verb.option(
      "Output", "--report", job.report, "FILE",
      "One JSON object a line and model (report.jsonl in the folder, report-I-of-N.jsonl of a shard).");
  verb.flag("Output", "--resume", job.resume,
            "Go on with an earlier report: models that have a line for the same bytes, options and version "
            "aren't done again.");
  verb.flag("Output", "--overwrite", job.overwrite, "Begin again where a report is there already.");
  verb.option("Work", "--jobs", texts.jobs, "N", "Processes at a time (one per core).");
  verb.option("Work", "--shard", texts.shard, "I/N",
              "Every Nth model from the Ith on, for one machine of N.");
  verb.option("Work", "--time-limit", texts.seconds, "SECONDS",
              "For each model; one that doesn't stop by itself soon after is ended (no limit).");
  verb.option("Work", "--memory-limit", texts.memory, "MB",
              "Address space of each process: more of it ends with code 4 (no limit).");
  add_options(verb, asked, {"json", "quiet"});
  if (arguments == nullptr) {
    return verb.finish(arguments, manual, [&]() -> Job { return job; });
  }
  const auto split = std::find(arguments->begin(), arguments->end(), "--");
  const Arguments own(arguments->begin(), split);
  job.words.assign(split == arguments->end() ? split : split + 1, arguments->end());
  return verb.finish(&own, manual, [&]() -> Job {
    job.common.json = asked.flag("json");
    job.common.quiet = asked.flag("quiet");
    return checked(job, texts);
  });
}

}  // namespace ridgecraft::cli
