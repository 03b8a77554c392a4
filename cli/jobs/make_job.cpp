// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/make_job.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "cli/files/input_files.hpp"
#include "cli/files/targets.hpp"
#include "cli/jobs/project_job.hpp"
#include "cli/jobs/stages.hpp"
#include "export/sheet/drawing.hpp"
#include "mesh/reading/files.hpp"
#include "session/session.hpp"

namespace ridgecraft::cli {
namespace {

void calibrate(std::vector<export_::Drawing>& pages, const MakeJob& job) {
  if (job.calibration) {
    std::ranges::transform(pages, pages.begin(), [&](export_::Drawing& page) {
      return export_::calibrated(std::move(page), *job.calibration);
    });
  }
}

/// Lists of numbers at the end have pages of their own, which no machine needs.
std::vector<export_::Drawing> machine_pages(const job::Result& made, const MakeJob& job) {
  std::vector<export_::Drawing> pages(made.drawings.begin(),
                                      made.drawings.begin() + static_cast<std::ptrdiff_t>(made.pages.count));
  if (job.kerf_test) {
    export_::add_kerf_test(pages, made.pages.paper);
  }
  // Kerfs are measured on what comes out of the machine, like everything else.
  calibrate(pages, job);
  if (job.print_and_cut) {
    for (export_::Drawing& page : pages) {
      page.groups.push_back(export_::registration_marks(page.size));
    }
  }
  return pages;
}

std::string svg_of(const Sheets& sheets, std::size_t page, const MakeJob& job) {
  const job::Result& made = sheets.made;
  if (!job.preset.is_machine()) {
    return page == sheets.drawings.size() ? export_::write_svg_of_all(sheets.drawings, sheets.mark)
                                          : export_::write_svg(sheets.drawings[page], sheets.mark);
  }
  return job.preset.simulates
             ? export_::write_simulator_svg(made.prepared, made.nets, made.pages, PageId(page), made.mark)
             : export_::write_machine_svg(sheets.for_machine[page], sheets.mark, job.preset);
}

std::string pdf_of(const Target& target, const Sheets& sheets, const MakeJob& job) {
  if (target.shows == Shows::guide) {
    return export_::write_guide_pdf(sheets.made.guide.pages, sheets.made.mark);
  }
  if (target.shows == Shows::cut) {
    return export_::write_packaging_pdf(sheets.for_machine, sheets.mark, job.preset, job.spots);
  }
  if (target.shows != Shows::print) {
    return export_::write_pdf(sheets.drawings, sheets.mark);
  }
  std::vector<export_::Drawing> pages;
  std::ranges::transform(sheets.drawings, std::back_inserter(pages), export_::printed_page);
  return export_::write_pdf(pages, sheets.mark);
}

namespace fs = std::filesystem;

std::string printed(const fs::path& file) {
  return file.lexically_normal().string();
}

/// So many files are made before they are written, where several threads make them.
constexpr std::size_t files_at_once = 16;

/// Writes all targets' files under their temporary names, in one order for any number of threads.
void add_targets(const std::vector<Target>& targets, const std::vector<std::vector<fs::path>>& of_targets,
                 const Sheets& sheets, const MakeJob& job, const Context& context, PendingFiles& pending,
                 MakeResult& result) {
  struct File {
    std::size_t target;
    std::size_t number;  ///< among those of its target
  };
  std::vector<File> files;
  for (std::size_t target = 0; target < targets.size(); ++target) {
    for (std::size_t number = 0; number < of_targets[target].size(); ++number) {
      files.push_back({target, number});
    }
  }
  const std::size_t at_once = context.threads > 1 ? files_at_once : 1;
  for (std::size_t first = 0; first < files.size(); first += at_once) {
    std::vector<std::string> bytes(std::min(at_once, files.size() - first));
    do_in_parallel(bytes.size(), context, [&](std::size_t i, const Context& own) {
      own.check();
      const File& file = files[first + i];
      bytes[i] = file_bytes(targets[file.target], file.number, sheets, job);
    });
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const File& file = files[first + i];
      const fs::path& path = of_targets[file.target][file.number];
      pending.add(path, bytes[i]);
      result.files.push_back(printed(path));
      result.shows.push_back(targets[file.target].shows);
    }
  }
}

std::set<fs::path> all_of(const std::vector<std::vector<fs::path>>& of_targets) {
  std::set<fs::path> files;
  for (const std::vector<fs::path>& of_target : of_targets) {
    files.insert(of_target.begin(), of_target.end());
  }
  return files;
}

/// Pages, and the guide and the page for browsers that nobody wants, of an earlier set of these names that
/// this run doesn't write again: of this model, and of one that another file of the set, which is replaced
/// now, was made from.
std::vector<fs::path> find_leftovers(const std::vector<Target>& targets,
                                     const std::vector<std::vector<fs::path>>& of_targets,
                                     const std::string& digest, bool page) {
  const std::set<fs::path> written = all_of(of_targets);
  std::set<std::string> digests = digests_of({written.begin(), written.end()});
  digests.insert(digest);
  std::vector<fs::path> found;
  std::set<fs::path> pages;
  for (const Target& target : targets) {
    if (!page && target.shows == Shows::sheets) {
      pages.insert(target.folder / (target.stem + std::string(suffix(Format::html))));
    }
    if (one_file_per_page(target.format)) {
      const std::vector<fs::path> leftovers =
          leftovers_of({target.folder, target.stem, target.ending}, written, digests);
      found.insert(found.end(), leftovers.begin(), leftovers.end());
    } else if (target.format == Format::pdf && target.shows != Shows::guide) {
      // A guide to other nets than those that stand beside it now.
      const fs::path guide = files_of(guide_beside(target), 1).front();
      const std::set<std::string> its = digests_of({guide});
      if (!written.contains(guide) && !its.empty() && digests.contains(*its.begin())) {
        found.push_back(guide);
      }
    }
  }
  for (const fs::path& file : pages) {
    const std::set<std::string> its = digests_of({file});
    if (!its.empty() && digests.contains(*its.begin())) {
      found.push_back(file);
    }
  }
  return found;
}

/// What other runs left of this model under the names of this one's results, in formats that this one didn't
/// write, and by other options: whoever prints the new pages shouldn't cut by the old ones.
std::optional<std::string> note_of_others(const std::vector<Target>& targets,
                                          const std::vector<std::vector<fs::path>>& of_targets,
                                          const export_::Mark& mark) {
  const std::set<fs::path> written = all_of(of_targets);
  std::set<fs::path> others;
  for (const Target& target : targets) {
    for (const Format format : {Format::pdf, Format::svg, Format::fold, Format::html}) {
      if (target.shows == Shows::sheets) {
        const std::vector<fs::path> found =
            leftovers_of({target.folder, target.stem, std::string(suffix(format))}, written, {mark.digest});
        others.insert(found.begin(), found.end());
      }
    }
  }
  std::erase_if(others, [&](const fs::path& file) { return !tells_other_settings(file, mark.settings); });
  if (others.empty()) {
    return std::nullopt;
  }
  std::vector<std::string> names;
  std::ranges::transform(others, std::back_inserter(names), printed);
  return listed(names, "and") + (names.size() == 1 ? " is of an earlier run with other options"
                                                   : " are of an earlier run with other options");
}

/// What is read beside the model, so that no result replaces it.
std::vector<InputFile> inputs_of(const MakeJob& job) {
  std::vector<InputFile> inputs = input_files(job.edges);
  inputs.push_back({"--tab-file", job.tab_file});
  return inputs;
}

void require_all_replaceable(const MakeJob& job, const std::vector<std::vector<fs::path>>& of_targets,
                             const std::string& digest) {
  for (const std::vector<fs::path>& of_target : of_targets) {
    for (const fs::path& file : of_target) {
      require_no_input(file, inputs_of(job), job.overwrite);
      require_replaceable(file, digest, job.overwrite);
    }
  }
}

bool has_guide(const std::vector<Target>& targets) {
  return std::any_of(targets.begin(), targets.end(),
                     [](const Target& target) { return target.shows == Shows::guide; });
}

/// What is known of the outputs is checked before the long work.
std::vector<Target> checked_targets(const MakeJob& job) {
  std::vector<Target> targets =
      job.print_and_cut ? plan_print_and_cut(job.outputs, results_name(job.model), job.preset)
                        : plan_targets(job.outputs, results_name(job.model), job.preset, job.page);
  if (std::any_of(targets.begin(), targets.end(), [](const Target& t) { return t.format == Format::pdf; })) {
    export_::check_pdf_size(job.options.paper->size);
  }
  if (wants_guide(job)) {
    add_guides(targets);
  }
  for (const Target& target : targets) {
    require_no_input(files_of(target, 1).front(), inputs_of(job), job.overwrite);
  }
  return targets;
}

/// A factor of numbers whose unit nobody knows: what comes out tells whether they are millimetres.
void require_sensible_scale(const SizeRequest& asked, const job::Options& options, const mesh::Model& model) {
  constexpr double smallest_mm = 20.0;
  constexpr double largest_mm = 5000.0;
  if (!asked.scale || model.frame.mm_per_unit) {
    return;
  }
  const double mm = model.surface.bounds().largest_extent() * model.file_scale * *options.size.mm_per_unit;
  if (mm < smallest_mm || mm > largest_mm) {
    throw Error(ErrorKind::usage,
                Message("odd_scale", {{"asked", asked.words}, {"mm", fmt::format("{:.3g}", mm)}}));
  }
}

/// The model with its edges named, and all that follows from it.
template <class Job>
job::Result make(const Job& job, job::Options options, const EdgeFiles& edge_files, mesh::Model model,
                 const Context& context, const job::Listener& listener) {
  options.edges = requests_of(edge_files, model);
  if (job.size_asked.scale && model.frame.mm_per_unit) {
    options.size.mm_per_unit = *job.size_asked.scale * *model.frame.mm_per_unit;
  }
  require_sensible_scale(job.size_asked, options, model);
  try {
    return job::run(std::move(model), options, context, listener);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::out_of_time) {
      throw;
    }
    throw Error(ErrorKind::out_of_time, "--time-limit passed while " + shown_name(job.model) +
                                            " was simplified; nothing was written");
  }
}

template <class Job>
mesh::Model read_for(const Job& job, job::StageClock& clock, const Context& context) {
  return clock("read", context, [&] {
    return in_time(context, shown_name(job.model) + " was read", [&](const Context& strict) {
      return read_model(job.model, {.keep_points = job.edges.any()}, strict);
    });
  });
}

/// What a job reads besides the model.
struct FilesBeside {
  EdgeFiles edges;
  std::vector<unfold::EdgeTab> edge_tabs;
  std::string tab_file_digest;
};

FilesBeside read_beside(const MakeJob& job) {
  const std::string tab_file = job.tab_file.empty() ? std::string() : mesh::read_file(job.tab_file);
  return {read_edge_files(job.edges), read_tab_file(job.tab_file, tab_file), digest(tab_file)};
}

/// Does again what was done by hand; a note where some of it can't be.
void repeat_edits(const MakeJob& job, const Context& context, MakeResult& result) {
  if (job.edits.empty()) {
    return;
  }
  session::Repeated repeated = session::repeat(std::move(result.made), session::steps_of(job.edits), context);
  result.made = std::move(repeated.project.now);
  if (const std::size_t count = repeated.left_out.size(); count > 0) {
    result.file_notes.push_back(counted(count, "change") + " by hand can't be made on these nets and " +
                                (count == 1 ? "is" : "are") + " left out");
  }
}

job::Options options_with(const FilesBeside& beside, const MakeJob& job, bool guide) {
  job::Options options = job.options;
  options.guide = guide;
  if (!beside.edge_tabs.empty()) {
    options.tab_choice.edges = beside.edge_tabs;
    options.tab_file_digest = beside.tab_file_digest;
  }
  return options;
}

}  // namespace

Sheets sheets_for(std::span<const Target> targets, const job::Result& made, const MakeJob& job) {
  Sheets sheets{made, made.drawings, made.mark, {}};
  sheets.mark.preset = job.preset.name;
  calibrate(sheets.drawings, job);
  if (job.calibration) {
    sheets.mark.settings["calibrate"] = fmt::format("[{},{}]", job.calibration->x, job.calibration->y);
  }
  if (std::any_of(targets.begin(), targets.end(),
                  [](const Target& target) { return target.shows == Shows::cut; })) {
    sheets.for_machine = machine_pages(made, job);
  }
  return sheets;
}

std::size_t page_count(const Target& target, const Sheets& sheets) {
  return target.shows == Shows::cut ? sheets.for_machine.size() : sheets.drawings.size();
}

std::string file_bytes(const Target& target, std::size_t i, const Sheets& sheets, const MakeJob& job) {
  switch (target.format) {
    case Format::pdf:
      return pdf_of(target, sheets, job);
    case Format::svg:
      return svg_of(sheets, i, job);
    case Format::png:
      return export_::write_png(sheets.drawings[i], sheets.mark);
    case Format::dxf:
      return export_::write_dxf(sheets.for_machine[i], sheets.mark, job.preset.dxf_kind, job.preset.paths);
    case Format::lbrn:
      return export_::write_lbrn(sheets.for_machine[i], sheets.mark, job.preset.paths);
    case Format::eps:
      return export_::write_eps(sheets.for_machine[i], sheets.mark, job.preset);
    case Format::plt:
      return export_::write_plt(sheets.for_machine[i], sheets.mark, job.preset.paths);
    case Format::fold:
      return sheets.made.fold;
    case Format::html:
      return with_project(export_::write_html(sheets.made.fold, sheets.made.drawings, sheets.made.mark), job,
                          sheets.made);
    case Format::project:
      return project_bytes(job, sheets.made);
  }
  RIDGECRAFT_ASSERT(false);
  return {};
}

bool wants_guide(const MakeJob& job) {
  return job.options.guide && !job.preset.is_machine();
}

MakeResult make_files(const MakeJob& job, const Context& context, PendingFiles& pending,
                      const job::Listener& listener) {
  const std::vector<Target> targets = checked_targets(job);
  const FilesBeside beside = read_beside(job);
  MakeResult result;
  job::StageClock clock;
  mesh::Model model = read_for(job, clock, context);
  const std::string digest = model.digest;
  // How many pages there will be isn't known yet.
  for (const Target& target : targets) {
    if (!one_file_per_page(target.format) || has_file_of_all(target)) {
      require_replaceable(files_of(target, 1).front(), digest, job.overwrite);
    }
  }
  result.made = make(job, options_with(beside, job, has_guide(targets)), beside.edges, std::move(model),
                     context, listener);
  repeat_edits(job, context, result);
  clock.add(result.made.seconds);
  clock("write", context, [&] {
    const Sheets sheets = sheets_for(targets, result.made, job);
    std::vector<std::vector<fs::path>> files;
    for (const Target& target : targets) {
      files.push_back(files_of(target, page_count(target, sheets)));
    }
    require_all_replaceable(job, files, digest);
    add_targets(targets, files, sheets, job, context, pending, result);
    context.check();
    std::vector<std::string> notes = pending.commit([&] {
      // Another run may have put files there since.
      require_all_replaceable(job, files, digest);
      return find_leftovers(targets, files, digest, job.page);
    });
    result.file_notes.insert(result.file_notes.end(), notes.begin(), notes.end());
    if (auto note = note_of_others(targets, files, sheets.mark)) {
      result.file_notes.push_back(std::move(*note));
    }
    return true;
  });
  result.seconds = clock.seconds();
  return result;
}

MakeResult make_pages(const MakeJob& job, const Context& context, const job::Listener& listener) {
  const FilesBeside beside = read_beside(job);
  MakeResult result;
  job::StageClock clock;
  mesh::Model model = read_for(job, clock, context);
  result.made =
      make(job, options_with(beside, job, false), beside.edges, std::move(model), context, listener);
  clock.add(result.made.seconds);
  result.seconds = clock.seconds();
  return result;
}

MakeResult make_nets(const UnfoldJob& job, const Context& context, PendingFiles& pending) {
  if (!job.output.empty()) {
    require_no_dash("-o", job.output);
    if (suffix_of(job.output) != ".fold") {
      throw Error(ErrorKind::usage, "-o " + job.output + ": nets without pages are written as .fold");
    }
    require_writable_folder(fs::path(job.output).has_parent_path() ? fs::path(job.output).parent_path()
                                                                   : ".");
    require_no_input(job.output, input_files(job.edges), job.overwrite);
  }
  const EdgeFiles edge_files = read_edge_files(job.edges);
  MakeResult result;
  job::StageClock clock;
  mesh::Model model = read_for(job, clock, context);
  if (!job.output.empty()) {
    require_replaceable(job.output, model.digest, job.overwrite);
  }
  result.made = make(job, job.options, edge_files, std::move(model), context, {});
  clock.add(result.made.seconds);
  if (!job.output.empty()) {
    clock("write", context, [&] {
      pending.add(job.output, result.made.fold);
      result.files.push_back(job.output);
      result.shows.push_back(Shows::sheets);
      context.check();
      result.file_notes = pending.commit([&]() -> std::vector<fs::path> {
        require_replaceable(job.output, result.made.prepared.model.digest, job.overwrite);
        return {};
      });
      return true;
    });
  }
  result.seconds = clock.seconds();
  return result;
}

}  // namespace ridgecraft::cli
