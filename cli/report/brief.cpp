// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report/brief.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "cli/report/figures.hpp"
#include "cli/report/net_figures.hpp"
#include "export/sheet/rolled.hpp"
#include "export/view/camera.hpp"
#include "job/remark.hpp"
#include "prepare/prepare.hpp"
#include "prepare/prepared/prepared.hpp"

namespace ridgecraft::cli {
namespace {

/// A surface that moved less has moved by rounding in the file, mm.
constexpr double seen_mm = 0.005;

/// ": at 150 mm too many folds would be too short" or another reason, where nobody asked for the size that
/// it has.
std::string why_size(const job::Result& made) {
  switch (made.prepared.size_reason) {
    case prepare::SizeReason::folds:
      return ": at 150 mm too many folds would be too short";
    case prepare::SizeReason::shape:
      return ": at 150 mm simplification would change its shape";
    case prepare::SizeReason::pages:
      return fmt::format(": at 150 mm it would take more than {:g} pages", made.used.size.most_pages);
    case prepare::SizeReason::none:
      break;
  }
  return {};
}

using Clauses = std::vector<std::string>;

std::string joined(const Clauses& clauses, const std::string& if_none) {
  return clauses.empty() ? if_none : fmt::format("{}", fmt::join(clauses, "; "));
}

std::string paper_line(const MakeJob& job, const job::Result& made, const GlueFigures& glue) {
  const std::size_t lists = made.drawn.list_pages;
  const std::size_t rolled =
      export_::count_rolled_folds(made.prepared, made.nets, made.options.style.hidden_fold_angle);
  return fmt::format("{} on {}{}, {}: {} to cut, {} to fold{}, {} to glue",
                     counted(made.nets.pieces.size(), "piece"), counted(made.pages.count, "page"),
                     lists == 0 ? "" : fmt::format(" and {} with lists of numbers", lists), job.paper_name,
                     metres(made.drawn.cut_mm), metres(made.drawn.fold_mm),
                     rolled == 0 ? "" : fmt::format(" and {} to roll", counted(rolled, "line")),
                     metres(glue.all_mm));
}

std::string counted_bodies(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " body" : " bodies");
}

/// Whether a model that is too fine was left as it is because edges are named, or marked in its file.
bool is_kept_for_edges(const MakeJob& job, const job::Result& made) {
  return prepare::is_too_fine(made.prepared) &&
         job.options.simplify.mode == prepare::Simplification::automatic &&
         made.used.simplify.mode == prepare::Simplification::keep;
}

/// "12 edges cut and 3 folded as asked"; empty where none were named. Pages by materials or objects cut
/// edges, too, that nobody has named: nothing is told then.
std::string edges_as_asked(const job::Result& made) {
  if ((!made.options.edges.cut && !made.options.edges.keep) || made.options.page_by != job::PageBy::any) {
    return {};
  }
  std::size_t cut = 0;
  std::size_t folded = 0;
  for (const EdgeId e : ids<EdgeId>(made.constraints.size())) {
    cut += made.constraints[e] == unfold::EdgeConstraint::cut && made.nets.use[e] == unfold::EdgeUse::cut
               ? 1U
               : 0U;
    folded += made.constraints[e] == unfold::EdgeConstraint::keep && made.nets.use[e] == unfold::EdgeUse::fold
                  ? 1U
                  : 0U;
  }
  if (cut > 0 && folded > 0) {
    return fmt::format("{} cut and {} folded as asked", counted(cut, "edge"), folded);
  }
  return cut > 0      ? counted(cut, "edge") + " cut as asked"
         : folded > 0 ? counted(folded, "edge") + " folded as asked"
                      : std::string();
}

std::string model_line(const MakeJob& job, const job::Result& made) {
  const prepare::SimplifyReport& report = made.prepared.simplified;
  Clauses clauses;
  if (is_kept_for_edges(job, made)) {
    clauses.emplace_back("not simplified, as edges of it are named, or marked in its file");
  }
  if (std::string edges = edges_as_asked(made); !edges.empty()) {
    clauses.push_back(std::move(edges));
  }
  const prepare::SkinReport& skin = made.skin;
  if (made.cleanup.thin_walls.walls > 0) {
    clauses.push_back(thin_walls_text(made.cleanup.thin_walls));
  }
  if (made.cleanup.left_out.count() > 0) {
    clauses.push_back(details_text(made.cleanup.left_out) + " left out (--keep-bodies keeps them)");
  }
  if (skin.united > 0) {
    clauses.push_back(counted_bodies(skin.united) + " made one skin where they meet" +
                      (skin.faces_hidden > 0
                           ? fmt::format(", {} dropped", counted(skin.faces_hidden, "hidden face"))
                           : std::string()) +
                      " (--keep-bodies leaves them apart)");
  }
  if (skin.unseen > 0) {
    clauses.push_back(counted_bodies(skin.unseen) + " that can't be seen left out");
  }
  if (const std::size_t glued = made.drawn.bodies.size() - export_::bodies_apart(made.drawn.bodies);
      glued > 0) {
    clauses.push_back(counted_bodies(glued) + (glued == 1 ? " is" : " are") +
                      " glued onto others, within the dashed lines there");
  }
  if (report.faces_after < report.faces_before && report.deviation_mm >= seen_mm) {
    clauses.push_back(fmt::format("simplified from {} to {} triangles, moved by at most {:.2f} mm",
                                  report.faces_before, report.faces_after, report.deviation_mm));
  }
  const prepare::SimplifyOptions& asked = made.used.simplify;
  if (asked.mode == prepare::Simplification::count && report.faces_after > asked.faces) {
    clauses.push_back(
        fmt::format("{} triangles rather than {}, as its shape needs them", report.faces_after, asked.faces));
  }
  if (report.features_removed > 0) {
    clauses.push_back(counted(report.features_removed, "small feature") + " of flat walls left out");
  }
  if (made.options.selection.any()) {
    clauses.emplace_back("a part of it, by its names");
  }
  if (made.options.style.ink == export_::Ink::lines && has_colours(made.prepared.model)) {
    clauses.emplace_back("its colours aren't printed");
  }
  return joined(clauses, "as it is in the file");
}

/// Seams that are shorter together hold by those beside them.
constexpr double least_reported_mm = 5.0;
/// Of a model with so much of its seams without a tab, and this share of them, nobody likes to glue so many
/// strips.
constexpr double many_without_tab_mm = 100.0;
constexpr double many_without_tab = 0.03;

void add_glue(const GlueFigures& glue, Clauses& clauses) {
  if (glue.without_tab_mm >= least_reported_mm) {
    clauses.push_back(
        fmt::format("{} of seams have no tab: glue a strip of paper behind", metres(glue.without_tab_mm)));
  }
  if (glue.weak_mm >= least_reported_mm) {
    clauses.push_back(fmt::format("{} of seams have tabs too small to hold well", metres(glue.weak_mm)));
  }
}

/// Where numbers stand that have no room at their edges. Files for machines have no lists, some of them no
/// numbers either.
std::string numbers_without_room(const MakeJob& job, const MakeResult& result) {
  const std::size_t lost = result.made.drawn.labels_listed.size();
  if (lost == 0) {
    return {};
  }
  const std::string begin =
      counted(lost, "number") + " had no room at " + (lost == 1 ? "its edge and " : "their edges and ");
  const bool has_pages = result.shows.empty() || std::ranges::any_of(result.shows, [](Shows shows) {
                           return shows == Shows::sheets || shows == Shows::print || shows == Shows::page;
                         });
  if (has_pages) {
    return begin + (lost == 1 ? "stands in a list" : "stand in lists");
  }
  const bool writes = job.preset.paths.engraves || job.preset.pdf;
  return writes && !job.preset.simulates
             ? begin + (lost == 1 ? "isn't" : "aren't") + " in the machine's files: -o NAME.pdf shows where"
             : "";
}

std::string hard_line(const MakeJob& job, const MakeResult& result, const GlueFigures& glue) {
  const job::Result& made = result.made;
  Clauses clauses;
  for (const Message& note : made.nets.notes) {
    if (note.code == "instead" || note.code == "not_glued") {
      clauses.push_back(english(note));
    }
  }
  if (const auto why = job::verdict(made.prepared, made.remedies)) {
    clauses.push_back(english(*why));
  }
  if (std::string why =
          where_it_differs(made.prepared.simplified.deviation_mm, made.prepared.model.surface.bounds());
      !why.empty()) {
    clauses.push_back(std::move(why));
  }
  if (made.slivers > 0) {
    clauses.push_back(fmt::format("{} narrower than {:g} mm, on {}: fold {} as a single crease",
                                  counted(made.slivers, "face"), job::sliver_mm,
                                  pieces_text(made.nets, pieces_with_slivers(made)),
                                  made.slivers == 1 ? "it" : "each"));
  }
  add_glue(glue, clauses);
  const std::vector<PieceId> bent = pieces_with_care(made.nets);
  if (!bent.empty()) {
    clauses.push_back(pieces_text(made.nets, bent) +
                      (bent.size() == 1 ? " has to be bent to be folded" : " have to be bent to be folded"));
  }
  if (!made.off_grain.empty()) {
    clauses.push_back(fmt::format("folds of {} run across the grain, as {} the sheet no other way",
                                  pieces_text(made.nets, made.off_grain),
                                  made.off_grain.size() == 1 ? "it fits" : "they fit"));
  }
  if (std::string lost = numbers_without_room(job, result); !lost.empty()) {
    clauses.push_back(std::move(lost));
  }
  if (made.nets.broken_constraints > 0) {
    clauses.push_back(counted(made.nets.broken_constraints, "edge") + " that " +
                      (made.nets.broken_constraints == 1 ? "was" : "were") + " to be kept " +
                      (made.nets.broken_constraints == 1 ? "is" : "are") + " cut all the same");
  }
  if (made.skin.left_crossing > 0) {
    clauses.push_back(counted_bodies(made.skin.left_crossing) + " run into each other");
  }
  if (const std::size_t apart = export_::bodies_apart(made.drawn.bodies); apart > 1) {
    clauses.push_back(fmt::format("the model has {} separate bodies{}", apart,
                                  made.guide.pages.empty() ? "" : ": the guide shows where each belongs"));
  }
  return joined(clauses, "nothing in particular");
}

/// What is done with the first file that is a machine's.
std::string for_the_machine(const std::string& name, const export_::Preset& preset) {
  if (preset.simulates) {
    return "load " + name + " into the simulator";
  }
  std::string text = fmt::format("give {} to the {} at 100 %", name, preset.pdf ? "shop" : "machine");
  if (preset.paths.kerf_mm > 0.0) {
    text += fmt::format(" (it allows for {:g} mm of kerf: --kerf)", preset.paths.kerf_mm);
  }
  return preset.svg ? text + "; 'ridgecraft formats --presets' says what its colours mean" : text;
}

/// Whether more pieces with more tabs are worth a word.
bool lacks_tabs(const job::Result& made, const GlueFigures& glue) {
  return !made.options.tabs.split_pieces && !made.nets.tabs.empty() &&
         glue.without_tab_mm >= std::max(many_without_tab_mm, many_without_tab * glue.all_mm);
}

std::string next_line(const MakeJob& job, const MakeResult& result, const GlueFigures& glue) {
  const job::Result& made = result.made;
  Clauses clauses;
  std::vector<std::string> guides;
  bool cut = false;
  for (std::size_t i = 0; i < result.files.size(); ++i) {
    const std::string name = std::filesystem::path(result.files[i]).filename().string();
    const Shows shows = result.shows[i];
    if (clauses.empty() && suffix_of(name) == ".pdf" && (shows == Shows::sheets || shows == Shows::print)) {
      clauses.push_back("print " + name + " at 100 %");
    }
    if (!cut && shows == Shows::cut && job.preset.is_machine()) {
      clauses.push_back(for_the_machine(name, job.preset));
      cut = true;
    }
    if ((shows == Shows::guide && !made.guide.pages.empty()) || shows == Shows::page) {
      guides.push_back(name);
    }
  }
  if (!guides.empty()) {
    clauses.push_back("build it by " + listed(guides, "or"));
  }
  if (lacks_tabs(made, glue)) {
    clauses.emplace_back("--all-tabs gives more of the seams tabs, with more pieces");
  } else if (made.share_saving_a_page && made.slivers == 0) {
    clauses.push_back(fmt::format("--size {:.0f}mm may save a page", size_saving_a_page(made)));
  }
  if (made.ground) {
    clauses.push_back("--without '" + *made.ground + "' leaves the ground out");
  }
  clauses.emplace_back("-v shows all figures");
  return joined(clauses, {});
}

}  // namespace

std::vector<PieceId> pieces_with_slivers(const job::Result& made) {
  const prepare::Prepared& prepared = made.prepared;
  std::set<PieceId> found;
  for (const PanelId p : ids<PanelId>(prepared.panels.count())) {
    if (prepare::is_sliver(prepared.model.surface, prepared.panels, p)) {
      for (const FaceId f : prepared.panels.faces[p]) {
        found.insert(made.nets.piece[f]);
      }
    }
  }
  return {found.begin(), found.end()};
}

std::string thin_walls_text(const prepare::ThinWallReport& sheets) {
  if (sheets.thickness_mm < 0.05) {
    return sheets.walls == 1 ? "two skins in one place became one"
                             : "skins that lay in one place twice became one";
  }
  return fmt::format("{} of up to {:.1f} mm became {}",
                     sheets.walls == 1 ? "a thin wall" : fmt::format("{} thin walls", sheets.walls),
                     sheets.thickness_mm, sheets.walls == 1 ? "a sheet" : "sheets");
}

std::string details_text(const prepare::Details& details) {
  Clauses clauses;
  if (details.small > 0) {
    clauses.push_back(details.small == 1 ? "1 small body" : fmt::format("{} small bodies", details.small));
  }
  if (details.flat > 0) {
    clauses.push_back(details.flat == 1 ? "1 flat body that lies on another"
                                        : fmt::format("{} flat bodies that lie on others", details.flat));
  }
  if (details.low > 0) {
    clauses.push_back(
        details.low == 1
            ? "1 body that stands out too little to be folded"
            : fmt::format("{} bodies that stand out of others by less than can be folded", details.low));
  }
  if (details.loose > 0) {
    clauses.push_back(details.loose == 1
                          ? "1 body that nothing held any more"
                          : fmt::format("{} bodies that nothing held any more", details.loose));
  }
  return listed(clauses, "and");
}

std::string size_words(const job::Result& made, const std::string& asked) {
  return made.prepared.size_reason == prepare::SizeReason::none
             ? asked
             : fmt::format("--size {:.0f}mm{}", made.used.size.largest_extent_mm, why_size(made));
}

double size_saving_a_page(const job::Result& made) {
  return std::floor(made.share_saving_a_page.value_or(1.0) *
                    made.prepared.model.surface.bounds().largest_extent());
}

std::string where_it_differs(double moved_mm, const Box3& bounds) {
  const std::string where =
      fmt::format("where it was simplified it differs from the file by up to {:.1f} mm, ", moved_mm);
  const std::string advice = ": with more --faces it stays nearer";
  switch (prepare::seen_move(moved_mm, bounds)) {
    case prepare::SeenMove::of_size:
      return where + fmt::format("{:.0f} % of its size", 100.0 * moved_mm / bounds.largest_extent()) + advice;
    case prepare::SeenMove::of_thickness: {
      const Vec3 size = bounds.size();
      return where + fmt::format("and it is {:.0f} mm thick", std::min({size.x, size.y, size.z})) + advice;
    }
    case prepare::SeenMove::none:
      break;
  }
  return {};
}

void add_brief(Summary& summary, const MakeJob& job, const MakeResult& result) {
  const job::Result& made = result.made;
  const GlueFigures glue = glue_figures(made.prepared.model.surface, made.nets, job.options.tabs);
  const Vec3 size = export_::standing_size(made.prepared.model.surface, export_::stance_of(made.up));
  summary.say(Line::brief, "size",
              fmt::format("{:.0f} mm wide, {:.0f} deep, {:.0f} high ({}{})", size.x, size.y, size.z,
                          size_words(made, job.size_asked.words), scale_text(made.prepared)));
  summary.say(Line::brief, "paper", paper_line(job, made, glue));
  summary.say(Line::brief, "model", model_line(job, made));
  summary.say(Line::brief, "hard", hard_line(job, result, glue));
  summary.say(Line::brief, "next", next_line(job, result, glue));
}

}  // namespace ridgecraft::cli
