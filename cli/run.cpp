// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/run.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <unistd.h>

#include "cli/formats.hpp"
#include "cli/interruption.hpp"
#include "cli/options.hpp"
#include "cli/pending_files.hpp"
#include "cli/pipeline.hpp"
#include "cli/progress.hpp"
#include "cli/solid_jobs.hpp"
#include "cli/summary.hpp"
#include "mesh/read_soup.hpp"

namespace ridgecraft::cli {
namespace {

/// Colour only on a terminal, and never against the user's word (no-color.org).
bool coloured() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && (no_color == nullptr || *no_color == '\0') && term != nullptr &&
         std::string_view(term) != "dumb";
}

void complain(const std::string& sentence) {
  std::fprintf(stderr, coloured() ? "\033[1;31mridgecraft:\033[0m %s\n" : "ridgecraft: %s\n",
               sentence.c_str());
}

void remark(const std::string& line) {
  std::fprintf(stderr, coloured() ? "\033[33mnote:\033[0m %s\n" : "note: %s\n", line.c_str());
}

void print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Error(ErrorKind::cant_write, "can't write to standard output");
  }
}

/// What a running job needs around it, for each of its verbs.
class Session {
 public:
  explicit Session(const CommonOptions& options)
      : interruption_(pending_), progress_(!options.quiet && !options.json), options_(options) {
    context_.threads = options.threads;
    context_.seed = options.seed;
    context_.stop = interruption_.token();
    context_.progress = [this](std::string_view stage, double share) { progress_.show(stage, share); };
    if (options.time_limit_s) {
      context_.deadline =
          std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                 std::chrono::duration<double>(*options.time_limit_s));
    }
  }
  [[nodiscard]] const Context& context() const { return context_; }
  [[nodiscard]] PendingFiles& pending() { return pending_; }

  void report(const mesh::RepairReport& repairs) {
    progress_.clear();
    if (!options_.quiet && !options_.json) {
      for (const std::string& line : repair_lines(repairs)) {
        remark(line);
      }
    }
  }
  /// The result as the user wants it.
  template <class Text, class JsonText>
  void finish(const Text& text, const JsonText& json) {
    progress_.clear();
    if (options_.json) {
      print(json());
    } else if (!options_.quiet) {
      print(text());
    }
  }

 private:
  PendingFiles pending_;
  Interruption interruption_;
  Progress progress_;
  CommonOptions options_;
  Context context_;
};

ExitCode do_job(const PrintJob& job) {
  print(job.text);
  return ExitCode::ok;
}

ExitCode do_job(const PaperJob& job) {
  Session session(job.common);
  const PaperResult result = make_paper(job, session.context(), session.pending());
  session.report(result.prepared.model.repairs);
  session.finish([&] { return summary(job, result); }, [&] { return summary_json(job, result); });
  return ExitCode::ok;
}

ExitCode do_job(const SegmentJob& job) {
  Session session(job.common);
  const SegmentResult result = make_parts(job, session.context(), session.pending());
  session.report(result.model.repairs);
  session.finish([&] { return summary(job, result); }, [&] { return summary_json(job, result); });
  return ExitCode::ok;
}

ExitCode do_job(const UnfoldJob& job) {
  Session session(job.common);
  const UnfoldResult result = make_nets(job, session.context(), session.pending());
  session.report(result.prepared.model.repairs);
  session.finish([&] { return summary(job, result); }, [&] { return summary_json(job, result); });
  return ExitCode::ok;
}

/// The verbs of solid/ differ in what they make only.
template <class SolidJob>
ExitCode do_solid(const SolidJob& job, SolidResult (*make)(const SolidJob&, const Context&, PendingFiles&)) {
  Session session(job.common);
  const SolidResult result = make(job, session.context(), session.pending());
  session.report(result.model.repairs);
  session.finish([&] { return summary(job.model, result); }, [&] { return summary_json(job.model, result); });
  return ExitCode::ok;
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
  const mesh::Model model = mesh::read(job.model, {.collapse_flat_faces = false}, session.context());
  const mesh::Panels panels = mesh::find_panels(model.surface);
  session.finish([&] { return summary(job, model, panels); },
                 [&] { return summary_json(job, model, panels); });
  return ExitCode::ok;
}

ExitCode do_job(const VerifyJob& job) {
  Session session(job.common);
  const std::string bytes = mesh::read_file(job.file);
  const verify::Report report = verify::verify(bytes, {}, session.context());
  session.finish([&] { return summary(job, report); }, [&] { return verify::to_json(report) + "\n"; });
  return report.sound() ? ExitCode::ok : ExitCode::faults_found;
}

ExitCode do_job(const FormatsJob& job) {
  Session session(job.common);
  session.finish([] { return formats_text(); }, [] { return formats_json(); });
  return ExitCode::ok;
}

}  // namespace

ExitCode run(const std::vector<std::string>& arguments) noexcept {
  // A closed pipe and a file grown too large are errors of writing like any other, no reasons to vanish.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return std::visit([](const auto& job) { return do_job(job); }, parse_arguments(arguments));
  } catch (const Error& error) {
    complain(error.what());
    return exit_code(error.kind());
  } catch (const std::bad_alloc&) {
    complain("the model needs more memory than there is");
    return ExitCode::unusable_mesh;
  } catch (const std::exception& error) {
    complain(std::string("internal error: ") + error.what());
    return ExitCode::internal;
  } catch (...) {
    complain("internal error");
    return ExitCode::internal;
  }
}

}  // namespace ridgecraft::cli
