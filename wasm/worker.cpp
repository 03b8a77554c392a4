// SPDX-License-Identifier: GPL-3.0-or-later
// The program as a browser's worker calls it: one project at a time, whose paper is kept for all that is
// written of it. Files lie in the module's own file system; what is to be done comes as words of the command
// line, so that the page has every option that the program has.
// What it says are messages: codes with values (base/message.hpp).
#include <cstddef>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <emscripten.h>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/message.hpp"
#include "cli/arguments/parse.hpp"
#include "cli/files/targets.hpp"
#include "cli/files/value.hpp"
#include "cli/jobs/make_job.hpp"
#include "cli/jobs/stages.hpp"
#include "cli/report/figures.hpp"
#include "cli/report/messages.hpp"
#include "cli/report/summary.hpp"
#include "export/export.hpp"
#include "session/session.hpp"

// Hands what happens on to whoever made the module: Module.report(kind, text, share).
EM_JS(void, ridgecraft_tell, (const char* kind, const char* text, double share), {
  if (Module["report"]) {
    Module["report"](UTF8ToString(kind), UTF8ToString(text), share);
  }
});

namespace ridgecraft::cli {
namespace {

/// What the last call gave: a text or the bytes of a file.
std::string answer;

struct Project {
  MakeJob job;
  MakeResult result;                       ///< with what was done by hand
  std::optional<session::Project> edited;  ///< from the first edit on
};
std::optional<Project> project;

/// The files that were asked for last.
struct Files {
  Target target;
  Sheets sheets;
};
std::optional<Files> files;

void report_note(const Message& note) {
  ridgecraft_tell("note", json_line(value_of(note)).c_str(), 0.0);
}

/// Does the work; its error becomes the answer, with the program's exit code as the result.
template <class Work>
int guarded(const Work& work) {
  const auto fail = [](ExitCode code, const Message& message) {
    answer = json_line(value_of(message));
    return static_cast<int>(code);
  };
  answer.clear();
  try {
    work();
    return 0;
  } catch (const Error& error) {
    return fail(exit_code(error.kind()), error.message());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::unusable_mesh, Message("memory_in_browser"));
  } catch (const std::exception& error) {
    return fail(ExitCode::internal, Message("internal", {{"text", error.what()}}));
  }
}

Context context_of(const MakeJob& job) {
  Context context;
  context.seed = job.common.seed;
  context.progress = [](std::string_view stage, double share) {
    ridgecraft_tell("progress", std::string(stage).c_str(), share);
  };
  return context;
}

/// What there is; throws where there is nothing yet.
Project& present() {
  if (!project) {
    throw Error(ErrorKind::usage, "there is no paper yet");
  }
  return *project;
}

void make(const std::vector<std::string>& words) {
  Job parsed = parse_arguments(words);
  if (!std::holds_alternative<MakeJob>(parsed)) {
    throw Error(ErrorKind::usage, "a page makes paper of a model and nothing else");
  }
  // Whatever there was goes first: both might not fit into the memory.
  files.reset();
  project.reset();
  MakeJob job = std::get<MakeJob>(std::move(parsed));
  job.common.threads = 1;
  const Context context = context_of(job);
  for (const auto& warning :
       {narrow_margin_warning(*job.options.paper), assumed_unit_warning(job.size_asked, job.options.size)}) {
    if (warning) {
      report_note(*warning);
    }
  }
  MakeResult result = about(job.model, [&] {
    return make_pages(job, context, [&](const job::Remark& remark) {
      if (const auto refusal = too_many_pages(remark, job.most_pages)) {
        throw Error(ErrorKind::usage, *refusal);
      }
      report_note(message(remark));
    });
  });
  for (const Message& line : repair_lines(result.made.prepared.model.repairs, result.made.skin.united > 0)) {
    report_note(line);
  }
  answer = summary(job, result).json();
  project.emplace(Project{std::move(job), std::move(result), std::nullopt});
}

/// What is to be written under this name: "whale.svg" means as many files as there are pages.
Target target_of(const MakeJob& job, const std::string& name) {
  constexpr std::string_view guide_ending = "-guide.pdf";
  if (name.ends_with(guide_ending)) {
    return guide_beside(target_of(job, name.substr(0, name.size() - guide_ending.size()) + ".pdf"));
  }
  return (job.print_and_cut ? plan_print_and_cut({name}, name, job.preset)
                            : plan_targets({name}, name, job.preset))
      .front();
}

session::Project& by_hand(Project& of) {
  if (!of.edited) {
    of.edited = session::open(of.result.made);
  }
  return *of.edited;
}

/// Takes over what came of an edit, and answers with the summary.
void take(Project& into, session::Project changed, nlohmann::json result) {
  files.reset();
  into.result.made = changed.now;
  into.edited = std::move(changed);
  result["summary"] = nlohmann::json::parse(summary(into.job, into.result).json());
  result["undo"] = into.edited->can_undo();
  result["pinned"] = nlohmann::json::array();
  for (const FaceId face : into.edited->state().pinned) {
    result["pinned"].push_back(face.value());
  }
  answer = result.dump();
}

nlohmann::json refusal_json(const session::Refusal& refusal) {
  nlohmann::json faces = nlohmann::json::array();
  for (const FaceId f : refusal.faces) {
    faces.push_back(f.value());
  }
  return {{"refused",
           {{"edit", refusal.edit},
            {"why", nlohmann::json::parse(json_line(value_of(refusal.why)))},
            {"faces", std::move(faces)}}}};
}

/// Edits of one step, or an error: what is in the text comes from our own page.
std::vector<session::Edit> one_step(const std::string& line) {
  std::vector<std::vector<session::Edit>> steps = session::steps_of(line);
  if (steps.size() != 1) {
    throw Error(ErrorKind::usage, "one step at a time");
  }
  return std::move(steps.front());
}

void apply(const std::string& line) {
  Project& now = present();
  session::Answer done = session::apply(by_hand(now), one_step(line), context_of(now.job));
  if (const auto* const refusal = std::get_if<session::Refusal>(&done)) {
    answer = refusal_json(*refusal).dump();
  } else {
    take(now, std::get<session::Project>(std::move(done)), nlohmann::json::object());
  }
}

void preview(const std::string& line, double reach_mm) {
  Project& now = present();
  const std::vector<session::Edit> edits = one_step(line);
  const Context context = context_of(now.job);
  nlohmann::json result = nlohmann::json::object();
  if (const auto refusal = session::why_not(by_hand(now), edits, context)) {
    result = refusal_json(*refusal);
    const auto* const place = edits.size() == 1 ? std::get_if<session::Place>(&edits.front()) : nullptr;
    if (const auto nearby =
            place ? session::nearby_place(by_hand(now), *place, context, reach_mm) : std::nullopt) {
      result["instead"] = {nearby->at.x, nearby->at.y};
    }
  }
  answer = result.dump();
}

void undo(std::size_t steps) {
  Project& now = present();
  take(now, session::undo(by_hand(now), context_of(now.job), steps), nlohmann::json::object());
}

void repeat(const std::string& lines) {
  Project& now = present();
  session::Repeated repeated =
      session::repeat(*by_hand(now).start, session::steps_of(lines), context_of(now.job));
  take(now, std::move(repeated.project), {{"left_out", repeated.left_out}});
}

/// The names of all files that this name stands for; none of a guide that isn't wanted. It is drawn here, for
/// it takes longer than all else that follows from an edit.
void plan(const std::string& name) {
  const MakeJob& job = present().job;
  job::Result& made = present().result.made;
  Target target = target_of(job, name);
  if (target.shows == Shows::guide && wants_guide(job) && made.guide.pages.empty()) {
    made.guide = job::guide_of(made, context_of(job));
  }
  if (target.format == Format::pdf) {
    export_::check_pdf_size(job.options.paper->size);
  }
  nlohmann::json names = nlohmann::json::array();
  if (target.shows != Shows::guide || !made.guide.pages.empty()) {
    files.emplace(Files{target, sheets_for({&target, 1}, made, job)});
    for (const auto& file : files_of(target, page_count(target, files->sheets))) {
      names.push_back(file.filename().string());
    }
  }
  answer = names.dump();
}

/// Of the files that were planned last, which hold all pages, only these, from 1.
void only(const std::string& numbers) {
  std::vector<export_::Drawing>& drawings = files.value().sheets.drawings;
  std::vector<export_::Drawing> wanted;
  for (const std::size_t number : nlohmann::json::parse(numbers).get<std::vector<std::size_t>>()) {
    wanted.push_back(drawings.at(number - 1));
  }
  drawings = std::move(wanted);
}

}  // namespace
}  // namespace ridgecraft::cli

using namespace ridgecraft;

extern "C" {

/// Makes paper; `words` is a JSON list of the words of a command line. 0 and the summary's JSON as the
/// answer, or the program's exit code and a message's JSON.
EMSCRIPTEN_KEEPALIVE int ridgecraft_make(const char* words) {
  return cli::guarded([&] { cli::make(nlohmann::json::parse(words).get<std::vector<std::string>>()); });
}

/// Does the edits of one step (session/edit.hpp): the new summary as "summary" of the answer, or as "refused"
/// why not, and the faces to look at. Results as above.
EMSCRIPTEN_KEEPALIVE int ridgecraft_apply(const char* line) {
  return cli::guarded([&] { cli::apply(line); });
}

/// Whether that would be refused; nothing changes. Where one piece can't be laid there, "instead" is where it
/// can be laid, within so many mm.
EMSCRIPTEN_KEEPALIVE int ridgecraft_preview(const char* line, double reach_mm) {
  return cli::guarded([&] { cli::preview(line, reach_mm); });
}

/// Takes so many steps back, or none; an answer as of a step that was done.
EMSCRIPTEN_KEEPALIVE int ridgecraft_undo(int steps) {
  return cli::guarded([&] { cli::undo(static_cast<std::size_t>(steps)); });
}

/// Does such steps, one a line, from the start on; "left_out" lists those that can't be done.
EMSCRIPTEN_KEEPALIVE int ridgecraft_repeat(const char* lines) {
  return cli::guarded([&] { cli::repeat(lines); });
}

/// A JSON list of the names of files that `name`, after -o, stands for: "whale.pdf", "whale-guide.pdf",
/// "whale.svg". Results as above.
EMSCRIPTEN_KEEPALIVE int ridgecraft_plan(const char* name) {
  return cli::guarded([&] { cli::plan(name); });
}

/// Leaves only these pages in a file that holds all: a JSON list of numbers, from 1.
EMSCRIPTEN_KEEPALIVE int ridgecraft_only(const char* numbers) {
  return cli::guarded([&] { cli::only(numbers); });
}

/// The bytes of the i-th of these files.
EMSCRIPTEN_KEEPALIVE int ridgecraft_write(int i) {
  return cli::guarded([&] {
    const cli::Files& files = cli::files.value();
    cli::answer =
        cli::file_bytes(files.target, static_cast<std::size_t>(i), files.sheets, cli::project.value().job);
  });
}

/// What the page shows besides the nets (docs/design/viewer.md).
EMSCRIPTEN_KEEPALIVE int ridgecraft_sheets() {
  return cli::guarded(
      [&] { cli::answer = export_::write_sheets(cli::project.value().result.made.drawings); });
}

EMSCRIPTEN_KEEPALIVE const char* ridgecraft_answer() {
  return cli::answer.data();
}
EMSCRIPTEN_KEEPALIVE std::size_t ridgecraft_answer_size() {
  return cli::answer.size();
}
}
