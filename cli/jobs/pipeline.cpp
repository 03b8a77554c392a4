// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/jobs/pipeline.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.hpp"
#include "cli/arguments/edge_options.hpp"
#include "cli/files/targets.hpp"
#include "cli/jobs/early_warnings.hpp"
#include "cli/jobs/settings.hpp"
#include "cli/files/model_input.hpp"
#include "prepare/prepared/narrow_faces.hpp"
#include "unfold/panel_parts.hpp"

namespace ridgecraft::cli {
namespace {

namespace fs = std::filesystem;

/// A face of this size fits every sheet; for jobs without pages.
constexpr prepare::Page boundless{1e9, 1e9};

IdVector<FaceId, PartId> one_part_per_component(const mesh::Surface& surface) {
  IdVector<FaceId, PartId> part(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    part[f] = PartId(surface.component(f).value());
  }
  return part;
}

/// Faces of one panel count as one polygon, so that parts end at the panels' borders. Where the time for it
/// is too short, each component is one part, and a note says so.
IdVector<FaceId, PartId> parts_for_paper(const prepare::Prepared& prepared, double concavity,
                                         const RunContext& run, std::vector<std::string>& notes) {
  const auto found = if_in_time(run, run.segmentation_up, [&](const Context& strict) {
    return segment::segment(prepared.model.surface, {}, {.concavity = concavity}, strict);
  });
  if (!found) {
    notes.emplace_back("--time-limit was too short to find parts: each component is one part");
    return one_part_per_component(prepared.model.surface);
  }
  return unfold::parts_of_whole_panels(prepared.model.surface, prepared.panels, found->part);
}

std::size_t count_parts(const IdVector<FaceId, PartId>& part) {
  std::uint32_t count = 0;
  for (const PartId p : part) {
    count = std::max(count, p.value() + 1);
  }
  return count;
}

/// Nothing that fails its own check leaves the program.
verify::Figures checked_figures(const std::string& fold, const std::string& model, const Context& context) {
  const verify::Report report = verify::verify(fold, {.max_faults = 3}, context);
  if (!report.sound() || !report.figures) {
    throw Error(ErrorKind::internal,
                "the nets made for " + model + " fail their check and weren't written (" +
                    (report.faults.empty() ? "no figures" : report.faults.front().message) + ")",
                model);
  }
  return *report.figures;
}

void require_all_replaceable(const PaperJob& job, const std::vector<Target>& targets, std::size_t pages,
                             const std::string& digest) {
  for (const Target& target : targets) {
    for (const fs::path& file : files_of(target, pages)) {
      require_no_input(file, input_files(job.edges), job.overwrite);
      require_replaceable(file, digest, job.overwrite);
    }
  }
}

std::string printed(const fs::path& file) {
  return file.lexically_normal().string();
}

/// Writes one target's files under their temporary names.
void add_target(const Target& target, const std::vector<paper::Drawing>& drawings, const std::string& fold,
                const paper::Mark& mark, PendingFiles& pending, std::vector<std::string>& written) {
  const std::vector<fs::path> files = files_of(target, drawings.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    switch (target.format) {
      case Format::pdf:
        pending.add(files[i], paper::write_pdf(drawings, mark));
        break;
      case Format::svg:
        pending.add(files[i], paper::write_svg(drawings[i], mark));
        break;
      case Format::png:
        pending.add(files[i], paper::write_png(drawings[i], mark));
        break;
      case Format::fold:
        pending.add(files[i], fold);
        break;
    }
    written.push_back(printed(files[i]));
  }
}

void remove_leftovers(const std::vector<Target>& targets, std::size_t pages, const std::string& digest,
                      PendingFiles& pending) {
  std::set<fs::path> kept;
  for (const Target& target : targets) {
    for (const fs::path& file : files_of(target, pages)) {
      kept.insert(file);
    }
  }
  for (const Target& target : targets) {
    for (const fs::path& leftover : leftovers_of(target, kept, digest)) {
      pending.remove_on_commit(leftover);
    }
  }
}

}  // namespace

double StageClock::total() const {
  double sum = 0.0;
  for (const auto& [name, seconds] : seconds_) {
    sum += seconds;
  }
  return sum;
}

PaperResult make_paper(const PaperJob& job, const RunContext& run, PendingFiles& pending,
                       const std::function<void(const std::string&)>& remark) {
  const Context& context = run.patient;
  const std::string name = shown_name(job.model);
  const std::vector<Target> targets = plan_targets(job.outputs, results_name(job.model));
  if (std::any_of(targets.begin(), targets.end(), [](const Target& t) { return t.format == Format::pdf; })) {
    paper::check_pdf_size(job.paper.size);
  }
  for (const Target& target : targets) {
    require_no_input(files_of(target, 1).front(), input_files(job.edges), job.overwrite);
  }
  const EdgeFiles edge_files = read_edge_files(job.edges);
  if (const auto warning = narrow_margin_warning(job.paper)) {
    remark(*warning);
  }
  if (const auto warning = assumed_unit_warning(job.size)) {
    remark(*warning);
  }
  PaperResult result;
  StageClock& clock = result.clock;
  mesh::Model model = clock("read", context, [&] {
    return in_time(run, name + " was read", [&](const Context& strict) {
      return read_model(job.model, {.keep_points = job.edges.any()}, strict);
    });
  });
  const paper::Mark mark{program_and_version(), model.name, model.digest};
  // How many pages there will be isn't known yet; what is known is checked before the long work.
  for (const Target& target : targets) {
    if (!one_file_per_page(target.format)) {
      require_replaceable(files_of(target, 1).front(), mark.digest, job.overwrite);
    }
  }

  result.polygons = model.polygon_count;
  const Vec2 area = paper::piece_area(job.paper);
  std::vector<std::string> notes;
  SizeArguments size = job.size;
  heed_edges(job.edges, model, size, notes);
  result.prepared = clock("prepare", context, [&] {
    return in_time(run, name + " was simplified", [&](const Context& strict) {
      const prepare::Page page{area.x, area.y, job.tabs.wanted ? job.tabs.height_mm : 0.0};
      return prepare::prepare(std::move(model), size.size, size.simplify, page, strict);
    });
  });
  const mesh::Surface& surface = result.prepared.model.surface;
  result.slivers = prepare::count_narrow_faces(surface, result.prepared.panels, sliver_mm);
  if (const auto warning = too_small_warning(result.prepared)) {
    remark(*warning);
  }
  const double expected = expected_pages(result.prepared, area);
  if (expected >= many_pages) {
    remark(many_pages_warning(surface, area, expected, false));
  }
  const unfold::EdgeWishes wishes =
      clock("prepare", context, [&] { return wishes_of(edge_files, result.prepared, context, notes); });
  if (const std::size_t n = result.prepared.divided_panels; n > 0) {
    notes.push_back(
        fmt::format("{} flat region{} larger than the printable area, so cut", n, n == 1 ? " is" : "s are"));
  }
  const auto part =
      clock("segment", context, [&] { return parts_for_paper(result.prepared, job.concavity, run, notes); });
  result.parts = count_parts(part);
  result.nets = clock("unfold", context, [&] {
    const unfold::Options options{
        .sheet = unfold::Sheet{area.x, area.y}, .tabs = job.tabs, .pieces = job.pieces, .wishes = wishes};
    return unfold::unfold(surface, result.prepared.panels, part, options, context);
  });
  result.nets.notes.insert(result.nets.notes.begin(), notes.begin(), notes.end());
  result.pages = clock("lay out", context, [&] { return paper::layout(result.nets, job.paper, context); });
  if (const auto count = static_cast<double>(result.pages.count);
      count >= many_pages && expected < many_pages) {
    remark(many_pages_warning(surface, area, count, true));
  }
  result.share_saving_a_page = clock(
      "hint", context, [&] { return paper::share_that_saves_a_page(result.nets, result.pages, context); });
  const auto drawings = clock("draw", context, [&] {
    return paper::draw(result.prepared, result.nets, result.pages, job.style, &result.drawn);
  });
  const std::string fold = clock("write", context, [&] {
    return paper::write_fold(result.prepared, part, result.nets, &result.pages, mark,
                             settings_of(job, size, edge_files));
  });
  result.figures = clock("verify", context, [&] { return checked_figures(fold, name, context); });

  clock("write", context, [&] {
    require_all_replaceable(job, targets, drawings.size(), mark.digest);
    for (const Target& target : targets) {
      add_target(target, drawings, fold, mark, pending, result.files);
    }
    remove_leftovers(targets, drawings.size(), mark.digest, pending);
    context.check();
    for (const std::string& note : pending.commit()) {
      remark(note);
    }
    return true;
  });
  return result;
}

UnfoldResult make_nets(const UnfoldJob& job, const RunContext& run, PendingFiles& pending) {
  if (!job.output.empty()) {
    if (suffix_of(job.output) != ".fold") {
      throw Error(ErrorKind::usage, "-o " + job.output + ": nets without pages are written as .fold");
    }
    require_writable_folder(fs::path(job.output).has_parent_path() ? fs::path(job.output).parent_path()
                                                                   : ".");
    require_no_input(job.output, input_files(job.edges), job.overwrite);
  }
  const Context& context = run.patient;
  const std::string name = shown_name(job.model);
  const EdgeFiles edge_files = read_edge_files(job.edges);
  UnfoldResult result;
  StageClock& clock = result.clock;
  mesh::Model model = clock("read", context, [&] {
    return in_time(run, name + " was read", [&](const Context& strict) {
      return read_model(job.model, {.keep_points = job.edges.any()}, strict);
    });
  });
  const paper::Mark mark{program_and_version(), model.name, model.digest};
  if (!job.output.empty()) {
    require_replaceable(job.output, mark.digest, job.overwrite);
  }
  std::vector<std::string> notes;
  if (const auto warning = assumed_unit_warning(job.size)) {
    notes.push_back(*warning);
  }
  SizeArguments size = job.size;
  heed_edges(job.edges, model, size, notes);
  result.prepared = clock("prepare", context, [&] {
    return in_time(run, name + " was simplified", [&](const Context& strict) {
      return prepare::prepare(std::move(model), size.size, size.simplify, boundless, strict);
    });
  });
  const mesh::Surface& surface = result.prepared.model.surface;
  const unfold::EdgeWishes wishes =
      clock("prepare", context, [&] { return wishes_of(edge_files, result.prepared, context, notes); });
  const auto part = clock("segment", context, [&] {
    return job.whole ? one_part_per_component(surface)
                     : parts_for_paper(result.prepared, job.concavity, run, notes);
  });
  result.parts = count_parts(part);
  result.nets = clock("unfold", context, [&] {
    unfold::Options options;
    options.tabs = job.tabs;
    options.wishes = wishes;
    options.panel_cuts = job.whole ? unfold::PanelCuts::before_pieces : unfold::PanelCuts::only_if_too_large;
    return unfold::unfold(surface, result.prepared.panels, part, options, context);
  });
  result.nets.notes.insert(result.nets.notes.begin(), notes.begin(), notes.end());
  const std::string fold = clock("write", context, [&] {
    return paper::write_fold(result.prepared, part, result.nets, nullptr, mark,
                             settings_of(job, size, edge_files));
  });
  result.figures = clock("verify", context, [&] { return checked_figures(fold, name, context); });
  if (!job.output.empty()) {
    pending.add(job.output, fold);
    context.check();
    pending.commit();
    result.files.push_back(job.output);
  }
  return result;
}

}  // namespace ridgecraft::cli
