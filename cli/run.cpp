// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/run.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <variant>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/text.hpp"
#include "cli/arguments/options.hpp"
#include "cli/arguments/parse.hpp"
#include "cli/files/formats.hpp"
#include "cli/files/input_files.hpp"
#include "cli/files/pending_files.hpp"
#include "cli/files/value.hpp"
#include "cli/interruption.hpp"
#include "cli/jobs/batch_job.hpp"
#include "cli/jobs/make_job.hpp"
#include "cli/jobs/project_job.hpp"
#include "cli/jobs/solid_jobs.hpp"
#include "cli/jobs/stages.hpp"
#include "cli/jobs/studio_job.hpp"
#include "cli/report/messages.hpp"
#include "cli/report/summary.hpp"
#include "job/edge_requests.hpp"
#include "mesh/reading/files.hpp"

namespace ridgecraft::cli {
namespace {

/// Colour only on a terminal, and never against the user's word (no-color.org).
bool coloured() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && (no_color == nullptr || *no_color == '\0') && term != nullptr &&
         std::string_view(term) != "dumb";
}

// Names of files and words out of files stand in what is told: a terminal must not take them for commands.

void complain(const std::string& sentence) {
  std::fprintf(stderr, coloured() ? "\033[1;31mridgecraft:\033[0m %s\n" : "ridgecraft: %s\n",
               printable(sentence).c_str());
}

void remark(const std::string& line) {
  std::fprintf(stderr, coloured() ? "\033[33mnote:\033[0m %s\n" : "note: %s\n", printable(line).c_str());
}

std::string printable_lines(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    result += printable(text.substr(0, end));
    text.remove_prefix(end);
    if (!text.empty()) {
      result += '\n';
      text.remove_prefix(1);
    }
  }
  return result;
}

/// 0, or the number of the error that kept standard output from taking all of the text.
int print(const std::string& text) {
  errno = 0;
  const bool printed =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  return printed ? 0 : errno != 0 ? errno : EIO;
}

std::string why_unprinted(int error) {
  return error == EBADF || error == EPIPE ? "standard output is closed"
                                          : std::string("standard output failed: ") + std::strerror(error);
}

/// Prints what is the whole result of a job. Whoever closes a pipe (`| head`) has read enough.
void print_result(const std::string& text) {
  if (const int error = print(text); error != 0 && error != EPIPE) {
    throw Error(ErrorKind::cant_write, "can't print the result: " + why_unprinted(error));
  }
}

/// A file that is opened must not get the number of a standard stream that was closed: what is printed would
/// end up in it. The stand-ins refuse what the streams are for.
void fill_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
      [[maybe_unused]] const int stand_in = ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
  }
}

/// Whether -q keeps a job from printing: not where the text is all that it makes.
enum class Quiet { no, yes };

/// What a running job needs around it, for each of its verbs.
class Session {
 public:
  explicit Session(const CommonOptions& options)
      : interruption_(options.json), progress_(!options.quiet && !options.json), options_(options) {
    Context& context = context_;
    context.threads = options.threads;
    context.seed = options.seed;
    context.stop = interruption_.stopped();
    context.progress = [this](std::string_view stage, double share) { progress_.show(stage, share); };
    if (options.time_limit_s) {
      context.deadline = Deadline::in(*options.time_limit_s);
      context.grace_s = finishing_share * *options.time_limit_s;
    }
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] const Context& context() const { return context_; }
  [[nodiscard]] PendingFiles& pending() { return pending_; }

  void report(const mesh::RepairReport& repairs, bool united = false) {
    progress_.clear();
    if (!options_.quiet && !options_.json) {
      for (const Message& line : repair_lines(repairs, united)) {
        remark(english(line));
      }
    }
  }
  /// A remark while the job goes on.
  void warn(const std::string& line) {
    progress_.clear();
    if (!options_.quiet) {
      remark(line);
    }
  }
  void warn(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      warn(line);
    }
  }
  /// Prints the summary of a job that wrote these files, as the user wants it. The job's exit code.
  [[nodiscard]] ExitCode finish(const std::vector<std::string>& files, const Summary& summary) {
    return finish(files, summary, files.empty() ? Quiet::no : Quiet::yes);
  }
  /// The same; `quiet` tells what -q does, where that doesn't follow from the files.
  [[nodiscard]] ExitCode finish(const std::vector<std::string>& files, const Summary& summary, Quiet quiet) {
    return finish(
        files, quiet, [&] { return summary.text(options_.verbose ? Detail::all : Detail::brief); },
        [&] { return summary.json(); });
  }
  /// Prints what a job made that wrote these files, as the user wants it. The job's exit code.
  template <class Text, class JsonText>
  [[nodiscard]] ExitCode finish(const std::vector<std::string>& files, Quiet quiet, const Text& text,
                                const JsonText& json) {
    progress_.clear();
    interruption_.work_is_done(!files.empty());
    int error = 0;
    if (options_.json || !options_.quiet || quiet == Quiet::no) {
      const std::string words = options_.json ? json() : printable_lines(text());
      if (files.empty()) {
        print_result(words);
      } else {
        error = print(words);
      }
    }
    if (error != 0) {
      complain("the files were written, but the summary couldn't be printed: " + why_unprinted(error));
      return ExitCode::untold;
    }
    return ExitCode::ok;
  }

 private:
  Interruption interruption_;
  PendingFiles pending_;  ///< goes first: signals are still held off while it removes files
  Progress progress_;
  CommonOptions options_;
  Context context_;
};

ExitCode do_job(const PrintJob& job) {
  print_result(job.text);
  return ExitCode::ok;
}

/// Said before anything is read: what the options alone make questionable.
void warn_of(const SizeRequest& asked, const job::Options& options, Session& session) {
  // A machine reaches the edges of its sheet, as its preset knows.
  if (options.paper && options.paper->furniture) {
    if (const auto warning = narrow_margin_warning(*options.paper)) {
      session.warn(english(*warning));
    }
  }
  if (const auto warning = assumed_unit_warning(asked, options.size)) {
    session.warn(english(*warning));
  }
}

ExitCode do_job(const MakeJob& job) {
  Session session(job.common);
  warn_of(job.size_asked, job.options, session);
  const MakeResult result = about(job.input(), [&] {
    return make_files(job, session.context(), session.pending(), [&](const job::Remark& remark) {
      if (const auto refusal = too_many_pages(remark, job.most_pages)) {
        throw Error(ErrorKind::usage, Message("of_model", {{"model", shown_name(job.input())},
                                                           {"what", std::vector{*refusal}}}));
      }
      session.warn(english(message(remark)));
    });
  });
  session.warn(result.file_notes);
  session.report(result.made.prepared.model.repairs, result.made.skin.united > 0);
  return session.finish(result.files, summary(job, result));
}

ExitCode do_job(const SegmentJob& job) {
  Session session(job.common);
  const SegmentResult result =
      about(job.model, [&] { return make_parts(job, session.context(), session.pending()); });
  session.warn(result.file_notes);
  session.report(result.model.repairs);
  return session.finish(result.files, summary(job, result));
}

ExitCode do_job(const UnfoldJob& job) {
  Session session(job.common);
  warn_of(job.size_asked, job.options, session);
  const MakeResult result =
      about(job.model, [&] { return make_nets(job, session.context(), session.pending()); });
  session.warn(result.file_notes);
  session.report(result.made.prepared.model.repairs, result.made.skin.united > 0);
  return session.finish(result.files, summary(job, result));
}

/// The verbs of solid/ differ in what they make only.
template <class SolidJob>
ExitCode do_solid(const SolidJob& job, SolidResult (*make)(const SolidJob&, const Context&, PendingFiles&)) {
  Session session(job.common);
  const SolidResult result = about(job.model, [&] {
    return in_time(session.context(), "bodies were made",
                   [&](const Context& strict) { return make(job, strict, session.pending()); });
  });
  session.warn(result.file_notes);
  session.report(result.model.repairs);
  return session.finish(result.files, summary(shown_name(job.model), result));
}

ExitCode do_job(const HullsJob& job) {
  return do_solid(job, make_hulls);
}
ExitCode do_job(const CageJob& job) {
  return do_solid(job, make_cage);
}
ExitCode do_job(const ShellJob& job) {
  return do_solid(job, make_shell);
}
ExitCode do_job(const DeformJob& job) {
  return do_solid(job, make_deformed);
}

ExitCode do_job(const InfoJob& job) {
  Session session(job.common);
  const mesh::Model model = about(job.model, [&] {
    return in_time(session.context(), shown_name(job.model) + " was read",
                   [&](const Context& strict) { return read_model(job.model, {}, strict); });
  });
  const prepare::Panels panels = prepare::find_panels(model.surface);
  return session.finish({}, summary(job, model, panels));
}

/// A FOLD file is JSON, and that begins with a bracket, after blanks and perhaps a byte order mark. What
/// doesn't was never a file of nets; one that was cut off or damaged is, and has faults. So has JSON of any
/// other form, "null" as well as "[]".
void require_json(const std::string& file, std::string_view bytes) {
  if (bytes.empty()) {
    throw Error(ErrorKind::unreadable_input, file + " is empty", file);
  }
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  bytes.remove_prefix(bytes.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || (bytes[first] != '{' && bytes[first] != '[' && !is_json(bytes))) {
    throw Error(ErrorKind::unreadable_input,
                file + " is in no format that can be checked: nets are FOLD files, which are JSON", file);
  }
}

/// What is cut by machines, or out of board, has other lines than the nets.
void require_comparable(const verify::PrintedFile& file) {
  if (!file.preset.empty()) {
    throw Error(
        ErrorKind::unreadable_input,
        fmt::format("{} was made with --preset {}: files for machines can't be held against nets, pages "
                    "to print can (PDF and SVG of a run without --preset)",
                    file.name, file.preset),
        file.name);
  }
  if (file.thickness_mm > 0.0) {
    throw Error(
        ErrorKind::unreadable_input,
        fmt::format("{} was made with --thickness {:g}mm: pages for board can't be held against nets, "
                    "which are those of the surface; pages of a run without --thickness can",
                    file.name, file.thickness_mm),
        file.name);
  }
}

std::vector<verify::PrintedFile> read_pages(const std::vector<std::string>& files, const Context& context) {
  std::vector<verify::PrintedFile> pages;
  for (const std::string& file : files) {
    context.check();
    const std::string bytes = mesh::read_file(file);
    if (!verify::is_pdf(bytes) && !verify::is_svg(bytes)) {
      throw Error(ErrorKind::unreadable_input,
                  file + " is in no format of pages that can be checked: PDF and SVG can");
    }
    pages.push_back(verify::is_pdf(bytes) ? verify::read_pdf(file, bytes) : verify::read_svg(file, bytes));
    require_comparable(pages.back());
  }
  return pages;
}

/// The model as plain arrays, which is all that the check wants to know of it.
verify::ModelSurface surface_of(const mesh::Model& model) {
  verify::ModelSurface surface;
  surface.points.assign(model.surface.points().begin(), model.surface.points().end());
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    const auto [a, b, c] = model.surface.vertices(f);
    surface.faces.push_back({a.value(), b.value(), c.value()});
  }
  surface.units_per_point_unit = model.file_scale;
  surface.digest = model.digest;
  return surface;
}

ExitCode do_job(const VerifyJob& job) {
  Session session(job.common);
  const std::string bytes = mesh::read_file(job.file);
  require_json(job.file, bytes);
  const verify::Report report =
      in_time(session.context(), job.file + " was checked", [&](const Context& strict) {
        const std::vector<verify::PrintedFile> pages = read_pages(job.pages, strict);
        verify::Against against{nullptr, pages};
        std::optional<verify::ModelSurface> surface;
        if (!job.model.empty()) {
          surface = surface_of(about(job.model, [&] {
            return prepare::select(read_model(job.model, {}, strict), job::selection_of(bytes));
          }));
          against.model = &*surface;
        }
        return verify::verify(bytes, {.folding = true}, strict, against);
      });
  // Scripts ask for the exit code alone.
  const ExitCode told = session.finish({}, summary(job.file, report), Quiet::yes);
  return report.sound() ? told : ExitCode::faults_found;
}

/// The page's path is the result: whoever has no desktop opens it elsewhere.
ExitCode do_job(const StudioJob& job) {
  const std::filesystem::path page = write_private_page(studio_page(mesh::read_file(find_studio()), job));
  print_result(page.string() + "\n");
  if (!job.no_browser && !open_in_browser(page)) {
    remark("no browser could be started (xdg-open): open this file in one");
  }
  return ExitCode::ok;
}

/// It has no Session: processes of its own are interrupted with it.
ExitCode do_job(const BatchJob& job) {
  Progress progress(!job.common.quiet && !job.common.json);
  const BatchResult result = run_batch(job, [&](double share) { progress.show("batch", share); });
  progress.clear();
  if (result.signal != 0) {
    throw Error(ErrorKind::interrupted, "interrupted; --resume goes on with " + result.report);
  }
  const Summary told = summary(job, result);
  if (job.common.json) {
    print_result(told.json());
  } else if (!job.common.quiet) {
    print_result(printable_lines(told.text(Detail::all)));
  }
  return ExitCode::ok;
}

ExitCode do_job(const FormatsJob& job) {
  Session session(job.common);
  return session.finish(
      {}, Quiet::no, [&] { return formats_text(job.presets); }, [] { return formats_json(); });
}

/// Tells of a failure: a sentence for people, and one object for machines where they listen.
ExitCode fail(ExitCode code, const Message& message, bool json) {
  complain(english(message));
  if (json) {
    const std::string text = error_json(code, message);
    // Standard output may be what failed: then its silence has to do.
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
  }
  return code;
}

/// True where the words of a command line ask for JSON: options end at "--".
bool asks_for_json(const std::vector<std::string>& words) {
  const auto word =
      std::ranges::find_if(words, [](const std::string& w) { return w == "--json" || w == "--"; });
  return word != words.end() && *word == "--json";
}

ExitCode do_guarded(const std::vector<std::string>& arguments, bool json) {
  try {
    Job job = parse_arguments(arguments);
    std::optional<UnpackedProject> unpacked;
    if (auto* const make = std::get_if<MakeJob>(&job)) {
      if (std::optional<session::ProjectFile> project = project_of(*make)) {
        unpacked.emplace(*std::move(project));
        *make = unpacked->job(*make, arguments);
      }
    }
    return std::visit([](const auto& one) { return do_job(one); }, job);
  } catch (const Error& error) {
    return fail(exit_code(error.kind()), error.message(), json);
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::unusable_mesh, Message("memory", {{"model", "the model"}}), json);
  } catch (const std::exception& error) {
    return fail(ExitCode::internal, Message("internal", {{"text", error.what()}}), json);
  } catch (...) {
    return fail(ExitCode::internal, Message("internal", {{"text", "no reason is known"}}), json);
  }
}

}  // namespace

ExitCode run(const std::vector<std::string>& arguments) noexcept {
  // A closed pipe and a file grown too large are errors of writing like any other, no reasons to vanish.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  fill_closed_streams();
  // Wrong arguments are told as JSON, too, so this can't wait until they are parsed.
  return do_guarded(arguments, asks_for_json(arguments));
}

}  // namespace ridgecraft::cli
