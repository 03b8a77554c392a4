// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/batch_job.hpp"

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "cli/files/formats.hpp"
#include "cli/files/pending_files.hpp"
#include "cli/files/targets.hpp"
#include "cli/jobs/worker.hpp"
#include "mesh/reading/files.hpp"

namespace ridgecraft::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Which models there are.

bool is_model(const fs::path& file) {
  const std::vector<FormatRow> rows = read_formats();
  return std::any_of(rows.begin(), rows.end(),
                     [&](const FormatRow& row) { return suffix_of(file) == row.suffix; });
}

std::vector<std::string> models_in(const fs::path& folder) {
  std::vector<std::string> models;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (at->is_regular_file(ignored) && is_model(at->path())) {
      models.push_back(at->path().string());
    }
  }
  if (error) {
    throw Error(ErrorKind::unreadable_input, folder.string() + " can't be listed: " + error.message());
  }
  std::sort(models.begin(), models.end());
  return models;
}

std::vector<std::string> models_on(std::istream& list) {
  std::vector<std::string> models;
  for (std::string line; std::getline(list, line);) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) {
      line.pop_back();
    }
    if (!line.empty()) {
      models.push_back(line);
    }
  }
  return models;
}

std::vector<std::string> models_of(const std::string& input) {
  std::vector<std::string> models;
  std::error_code ignored;
  if (input == "-") {
    models = models_on(std::cin);
  } else if (fs::is_directory(input, ignored)) {
    models = models_in(input);
  } else if (is_model(input)) {
    models = {input};
  } else {
    std::ifstream list(input);
    if (!list) {
      throw Error(ErrorKind::unreadable_input,
                  input + " can't be read: it is no list of models and no folder", input);
    }
    models = models_on(list);
  }
  const std::set<std::string> different(models.begin(), models.end());
  if (different.size() < models.size()) {
    throw Error(ErrorKind::unreadable_input, input + " names a model twice", input);
  }
  if (models.empty()) {
    throw Error(ErrorKind::unreadable_input, input + " names no models", input);
  }
  return models;
}

// Where their results go.

/// A path below the output folder that no other model of the list has: the model's own below the input
/// folder, or where that leads elsewhere its name behind a digest of its path.
fs::path place_below(const BatchJob& job, const std::string& model) {
  std::error_code ignored;
  const fs::path path(model);
  const fs::path below =
      fs::is_directory(job.input, ignored) ? path.lexically_relative(job.input) : path.lexically_normal();
  const bool is_inside = below.is_relative() && !below.empty() && *below.begin() != "..";
  return is_inside ? below : fs::path(digest(model) + "-" + path.filename().string());
}

std::string output_of(const BatchJob& job, const std::string& model) {
  return (fs::path(job.output) / (place_below(job, model).string() + job.suffix)).string();
}

fs::path report_of(const BatchJob& job) {
  if (!job.report.empty()) {
    return job.report;
  }
  const std::string name =
      job.shards == 1 ? "report.jsonl" : fmt::format("report-{}-of-{}.jsonl", job.shard, job.shards);
  return fs::path(job.output) / name;
}

std::vector<std::string> words_for(const BatchJob& job, const std::string& model) {
  std::vector<std::string> words;
  if (job.verb != "paper") {
    words.push_back(job.verb);
  }
  words.push_back(model.starts_with('-') ? "./" + model : model);
  if (!job.suffix.empty()) {
    words.insert(words.end(), {job.verb == "segment" && job.suffix == ".seg" ? "--labels" : "-o",
                               output_of(job, model), "--overwrite"});
  }
  words.insert(words.end(), job.words.begin(), job.words.end());
  words.insert(words.end(), {"--json", "--threads", "1"});
  if (job.seconds) {
    words.insert(words.end(), {"--time-limit", fmt::format("{}", *job.seconds)});
  }
  return words;
}

// The report.

/// What a line is about: a run with other options, of another version or of changed bytes is none that
/// counts.
std::string options_digest(const BatchJob& job) {
  std::string all = job.verb + '\n' + job.suffix;
  for (const std::string& word : job.words) {
    all += '\n' + word;
  }
  return digest(all);
}

std::string bytes_digest(const fs::path& file) {
  try {
    return digest(mesh::read_file(file));
  } catch (const Error&) {
    return "";  // its process says why
  }
}

std::string sentence_of(const WorkerEnd& end, const Json& told) {
  if (end.out_of_time) {
    return "--time-limit passed, and the process had to be ended";
  }
  if (end.signal != 0) {
    return fmt::format("the process was ended by signal {} ({})", end.signal, ::strsignal(end.signal));
  }
  if (const auto error = told.find("error"); error != told.end() && error->contains("message")) {
    return (*error)["message"].get<std::string>();
  }
  return end.exit_code == 0 ? "" : std::string(end.err.substr(0, end.err.find('\n')));
}

/// Files with digests, whose names are those below the output folder.
Json outputs_of(const BatchJob& job, const Json& told) {
  Json outputs = Json::array();
  if (const auto files = told.find("files"); files != told.end() && files->is_array()) {
    for (const Json& file : *files) {
      const fs::path path = file.get<std::string>();
      outputs.push_back(
          {{"file", path.lexically_relative(job.output).string()}, {"digest", bytes_digest(path)}});
    }
  }
  return outputs;
}

Json line_of(const BatchJob& job, const std::string& model, const std::string& input, const WorkerEnd& end) {
  Json told = Json::parse(end.out, nullptr, false);
  if (!told.is_object()) {
    told = Json::object();
  }
  constexpr int stopped = 130;
  Json line{
      {"model", model}, {"input", input}, {"options", options_digest(job)}, {"by", program_and_version()}};
  line["exit_code"] = end.out_of_time ? stopped : end.signal != 0 ? 128 + end.signal : end.exit_code;
  line["sentence"] = sentence_of(end, told);
  line["seconds"] = end.seconds;
  line["peak_bytes"] = end.peak_bytes;
  line["outputs"] = outputs_of(job, told);
  for (const char* said_already : {"model", "files", "seconds", "error"}) {
    told.erase(said_already);
  }
  line["figures"] = std::move(told);
  return line;
}

/// One line, whatever bytes a name has.
std::string text_of(const Json& line) {
  return line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// A model that --time-limit or a signal ended: another run may allow it more.
bool was_stopped(int exit_code) {
  return exit_code >= 128;
}

/// Whether a line is of such a run, and all that it wrote is there.
bool line_holds(const BatchJob& job, const Json& line) {
  if (!line.is_object() || !line.contains("model") || !line["model"].is_string() ||
      line.value("options", "") != options_digest(job) || line.value("by", "") != program_and_version() ||
      was_stopped(line.value("exit_code", 1))) {
    return false;
  }
  const Json outputs = line.value("outputs", Json::array());
  return std::all_of(outputs.begin(), outputs.end(), [&](const Json& output) {
    std::error_code ignored;
    return fs::exists(fs::path(job.output) / output.value("file", ""), ignored);
  });
}

/// The lines of an earlier run that still hold, by model. A line that was cut off or changed is none.
std::map<std::string, Json> lines_that_hold(const BatchJob& job, const fs::path& report) {
  std::map<std::string, Json> lines;
  std::ifstream file(report);
  for (std::string text; std::getline(file, text);) {
    Json line = Json::parse(text, nullptr, false);
    try {
      if (line_holds(job, line)) {
        const std::string model = line["model"];
        lines[model] = std::move(line);
      }
    } catch (const Json::exception&) {
      continue;  // a value of another type
    }
  }
  return lines;
}

/// A report that lines are added to as models are done, so that a batch that is killed has them.
class Report {
 public:
  Report(const BatchJob& job, fs::path file) : file_(std::move(file)) {
    std::error_code ignored;
    if (fs::exists(file_, ignored) && !job.resume && !job.overwrite) {
      throw Error(ErrorKind::cant_write,
                  file_.string() + " is there already: --resume goes on with it, --overwrite begins again",
                  file_.string());
    }
    if (job.resume) {
      lines_ = lines_that_hold(job, file_);
    }
    write_whole();
    open();
  }

  [[nodiscard]] const Json* find(const std::string& model) const {
    const auto at = lines_.find(model);
    return at == lines_.end() ? nullptr : &at->second;
  }
  void add(const std::string& model, Json line) {
    const std::string text = text_of(line);
    appended_ << text << std::flush;
    if (!appended_) {
      throw Error(ErrorKind::cant_write, file_.string() + " can't be written", file_.string());
    }
    lines_[model] = std::move(line);
  }
  /// Puts the lines in the order of these models.
  void finish(const std::vector<std::string>& models) {
    order_ = models;
    write_whole();
  }

 private:
  void open() {
    appended_.open(file_, std::ios::app | std::ios::binary);
    if (!appended_) {
      throw Error(ErrorKind::cant_write, file_.string() + " can't be written", file_.string());
    }
  }
  void write_whole() {
    std::string text;
    if (order_.empty()) {
      for (const auto& [model, line] : lines_) {
        text += text_of(line);
      }
    }
    for (const std::string& model : order_) {
      text += text_of(lines_.at(model));
    }
    PendingFiles pending;
    pending.add(file_, text);
    static_cast<void>(pending.commit());
  }

  fs::path file_;
  std::map<std::string, Json> lines_;
  std::vector<std::string> order_;
  std::ofstream appended_;
};

void make_folder_of(const std::string& output) {
  std::error_code error;
  const fs::path folder = fs::path(output).parent_path();
  if (folder.empty()) {
    return;
  }
  fs::create_directories(folder, error);
  if (error) {
    throw Error(ErrorKind::cant_write, folder.string() + " can't be made: " + error.message(),
                folder.string());
  }
}

}  // namespace

BatchResult run_batch(const BatchJob& job, const std::function<void(double)>& progress) {
  std::vector<std::string> models;
  const std::vector<std::string> all = models_of(job.input);
  for (std::size_t i = job.shard - 1; i < all.size(); i += job.shards) {
    models.push_back(all[i]);
  }
  BatchResult result;
  result.models = models.size();
  result.report = report_of(job).string();
  make_folder_of(result.report);
  Report report(job, result.report);

  std::vector<std::string> open;
  std::vector<std::string> inputs;
  for (const std::string& model : models) {
    const Json* line = report.find(model);
    if (line == nullptr || line->value("input", "") != bytes_digest(model)) {
      open.push_back(model);
    }
  }
  inputs.resize(open.size());
  result.done_before = models.size() - open.size();
  std::size_t done = 0;
  result.signal = run_workers(
      open.size(), job.jobs, {job.seconds, job.memory_bytes},
      [&](std::size_t task) {
        inputs[task] = bytes_digest(open[task]);
        if (!job.suffix.empty()) {
          make_folder_of(output_of(job, open[task]));
        }
        return words_for(job, open[task]);
      },
      [&](const WorkerEnd& end) {
        report.add(open[end.task], line_of(job, open[end.task], inputs[end.task], end));
        progress(static_cast<double>(++done) / static_cast<double>(open.size()));
      });
  if (result.signal == 0) {
    report.finish(models);
  }
  for (const std::string& model : models) {
    if (const Json* line = report.find(model)) {
      ++result.codes[line->value("exit_code", 1)];
    }
  }
  return result;
}

}  // namespace ridgecraft::cli
