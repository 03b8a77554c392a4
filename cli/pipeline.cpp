// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/pipeline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/edge_options.hpp"
#include "cli/targets.hpp"
#include "mesh/error.hpp"
#include "mesh/narrow_faces.hpp"
#include "unfold/objective.hpp"
#include "unfold/panel_parts.hpp"

namespace ridgecraft::cli {
namespace {

namespace fs = std::filesystem;

/// A face of this size fits every sheet; for jobs without pages.
constexpr mesh::Page boundless{1e9, 1e9};
/// Trials for tabs where they are what was asked for: 1 to 2 s for 500 faces.
constexpr double patient_trials_per_face = 60.0;

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump();
}
std::string number(double value) {
  return fmt::format("{}", value);
}

void add_size_settings(const SizeArguments& size, paper::Settings& settings) {
  if (size.size.mm_per_unit) {
    settings["mm_per_unit"] = number(*size.size.mm_per_unit);
  } else {
    settings["size_mm"] = number(size.size.largest_extent_mm);
  }
  settings["faces"] = size.simplify.mode == mesh::Simplification::automatic ? quoted("auto")
                      : size.simplify.mode == mesh::Simplification::keep
                          ? quoted("keep")
                          : std::to_string(size.simplify.faces);
}

paper::Settings settings_of(const PaperJob& job) {
  paper::Settings settings;
  add_size_settings(job.size, settings);
  settings["seed"] = std::to_string(job.common.seed);
  settings["concavity"] = number(job.concavity);
  settings["paper_mm"] = fmt::format("[{},{}]", job.paper.size.x, job.paper.size.y);
  settings["margin_mm"] = number(job.paper.margin);
  settings["gap_mm"] = number(job.paper.gap);
  settings["tabs"] = job.tabs.wanted ? "true" : "false";
  settings["tab_height_mm"] = number(job.tabs.height_mm);
  settings["tab_angle_deg"] = fmt::format("{:.10g}", job.tabs.angle * 180.0 / std::numbers::pi);
  settings["pieces"] = quoted(job.pieces_asked);
  settings["max_faces"] = std::to_string(job.pieces.max_panels);
  unfold::Weights weights = job.pieces.weights;
  for (const std::string_view term : unfold::term_names()) {
    settings["weigh_" + std::string(term)] = number(*unfold::weight_named(weights, term));
  }
  settings["hide_folds_deg"] = fmt::format("{:.10g}", job.style.hidden_fold_angle * 180.0 / std::numbers::pi);
  return settings;
}

paper::Settings settings_of(const UnfoldJob& job) {
  paper::Settings settings;
  add_size_settings(job.size, settings);
  settings["seed"] = std::to_string(job.common.seed);
  settings["concavity"] = number(job.concavity);
  settings["whole"] = job.whole ? "true" : "false";
  return settings;
}

IdVector<FaceId, PartId> one_part_per_component(const mesh::Surface& surface) {
  IdVector<FaceId, PartId> part(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    part[f] = PartId(surface.component(f).value());
  }
  return part;
}

/// Faces of one panel count as one polygon, so that parts end at the panels' borders. Where the time for it
/// is too short, each component is one part, and a note says so.
IdVector<FaceId, PartId> parts_for_paper(const mesh::Prepared& prepared, double concavity,
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

/// Where a user may want to stop, and where a maker's evening ends.
constexpr double many_pages = 100.0;
constexpr double few_pages = 10.0;

/// Pages that as much paper takes: pieces fill about half of them.
double pages_of(double paper, Vec2 page) {
  constexpr double filled = 0.6;
  return paper / (filled * page.x * page.y);
}

double area_of(const mesh::Surface& surface, const std::vector<FaceId>& faces) {
  double area = 0.0;
  for (const FaceId f : faces) {
    area += surface.area(f);
  }
  return area;
}

/// Pages that the surface will need; a flat region that is larger than half of one takes it whole.
double expected_pages(const mesh::Prepared& prepared, Vec2 page) {
  double alone = 0.0;
  double paper = 0.0;
  for (const auto& faces : prepared.panels.faces) {
    const double area = area_of(prepared.model.surface, faces);
    (area > 0.5 * page.x * page.y ? alone : paper) += area > 0.5 * page.x * page.y ? 1.0 : area;
  }
  return alone + pages_of(paper, page);
}

std::string many_pages_warning(const mesh::Surface& surface, Vec2 page, double pages,
                               std::string_view about) {
  const auto two_digits = [](double value) {
    const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(value)) - 1.0));
    return std::round(value / unit) * unit;
  };
  const Vec3 size = surface.bounds().size();
  const double largest = std::max({size.x, size.y, size.z});
  // A smaller model has no flat regions that fill pages.
  double paper = 0.0;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    paper += surface.area(f);
  }
  const double small = std::max(pages, pages_of(paper, page));
  return fmt::format("this takes {}{:.0f} pages; --size {:.0f}mm would take about {:.0f}", about,
                     about.empty() ? pages : two_digits(pages),
                     two_digits(largest * std::sqrt(few_pages / small)), few_pages);
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
                    (report.faults.empty() ? "no figures" : report.faults.front().message) + ")");
  }
  return *report.figures;
}

void require_all_replaceable(const std::vector<Target>& targets, std::size_t pages, const std::string& digest,
                             bool overwrite) {
  for (const Target& target : targets) {
    for (const fs::path& file : files_of(target, pages)) {
      require_replaceable(file, digest, overwrite);
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
  const std::string stem = fs::path(job.model).stem().string();
  const std::vector<Target> targets = plan_targets(job.outputs, stem);
  if (std::any_of(targets.begin(), targets.end(), [](const Target& t) { return t.format == Format::pdf; })) {
    paper::check_pdf_size(job.paper.size);
  }
  PaperResult result;
  StageClock& clock = result.clock;
  mesh::Model model = clock("read", context, [&] {
    return in_time(run, job.model + " was read", [&](const Context& strict) {
      return mesh::read(job.model, {.keep_points = job.edges.any()}, strict);
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
  heed_lines(job.edges, model, size, notes);
  result.prepared = clock("prepare", context, [&] {
    return in_time(run, job.model + " was simplified", [&](const Context& strict) {
      const mesh::Page page{area.x, area.y, job.tabs.wanted ? job.tabs.height_mm : 0.0};
      return mesh::prepare(std::move(model), size.size, size.simplify, page, strict);
    });
  });
  const mesh::Surface& surface = result.prepared.model.surface;
  result.slivers = mesh::count_narrow_faces(surface, result.prepared.panels, sliver_mm);
  const double expected = expected_pages(result.prepared, area);
  if (expected >= many_pages) {
    remark(many_pages_warning(surface, area, expected, "about "));
  }
  const unfold::EdgeWishes wishes = clock(
      "prepare", context, [&] { return wishes_of(job.edges, job.model, result.prepared, context, notes); });
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
    remark(many_pages_warning(surface, area, count, ""));
  }
  const auto drawings = clock("draw", context, [&] {
    return paper::draw(result.prepared, result.nets, result.pages, job.style, &result.drawn);
  });
  const std::string fold = clock("write", context, [&] {
    return paper::write_fold(result.prepared, part, result.nets, &result.pages, mark, settings_of(job));
  });
  result.figures = clock("verify", context, [&] { return checked_figures(fold, job.model, context); });

  clock("write", context, [&] {
    require_all_replaceable(targets, drawings.size(), mark.digest, job.overwrite);
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
  }
  const Context& context = run.patient;
  UnfoldResult result;
  StageClock& clock = result.clock;
  mesh::Model model = clock("read", context, [&] {
    return in_time(run, job.model + " was read", [&](const Context& strict) {
      return mesh::read(job.model, {.keep_points = job.edges.any()}, strict);
    });
  });
  const paper::Mark mark{program_and_version(), model.name, model.digest};
  if (!job.output.empty()) {
    require_replaceable(job.output, mark.digest, job.overwrite);
  }
  std::vector<std::string> notes;
  SizeArguments size = job.size;
  heed_lines(job.edges, model, size, notes);
  result.prepared = clock("prepare", context, [&] {
    return in_time(run, job.model + " was simplified", [&](const Context& strict) {
      return mesh::prepare(std::move(model), size.size, size.simplify, boundless, strict);
    });
  });
  const mesh::Surface& surface = result.prepared.model.surface;
  const unfold::EdgeWishes wishes = clock(
      "prepare", context, [&] { return wishes_of(job.edges, job.model, result.prepared, context, notes); });
  const auto part = clock("segment", context, [&] {
    return job.whole ? one_part_per_component(surface)
                     : parts_for_paper(result.prepared, job.concavity, run, notes);
  });
  result.parts = count_parts(part);
  result.nets = clock("unfold", context, [&] {
    unfold::Options options;
    options.tabs.wanted = job.tabs;
    options.tabs.trials_per_face = patient_trials_per_face;
    options.wishes = wishes;
    options.panel_cuts = job.whole ? unfold::PanelCuts::before_pieces : unfold::PanelCuts::only_if_too_large;
    return unfold::unfold(surface, result.prepared.panels, part, options, context);
  });
  result.nets.notes.insert(result.nets.notes.begin(), notes.begin(), notes.end());
  const std::string fold = clock("write", context, [&] {
    return paper::write_fold(result.prepared, part, result.nets, nullptr, mark, settings_of(job));
  });
  result.figures = clock("verify", context, [&] { return checked_figures(fold, job.model, context); });
  if (!job.output.empty()) {
    pending.add(job.output, fold);
    context.check();
    pending.commit();
    result.files.push_back(job.output);
  }
  return result;
}

}  // namespace ridgecraft::cli
