// SPDX-License-Identifier: GPL-3.0-or-later
// What ridgecraft MODEL and ridgecraft unfold tell of their work.
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "cli/files/input_files.hpp"
#include "cli/report/brief.hpp"
#include "cli/report/figures.hpp"
#include "cli/report/net_figures.hpp"
#include "cli/report/summary.hpp"
#include "export/sheet/rolled.hpp"
#include "job/remark.hpp"
#include "prepare/prepare.hpp"
#include "unfold/net/chains.hpp"

namespace ridgecraft::cli {
namespace {

/// A surface that moved by more than this share of the largest extent has lost some of its shape.
constexpr double far_moved = 0.04;

void add_size(Summary& summary, const job::Result& made, const std::string& asked) {
  const Vec3 size = made.prepared.model.surface.bounds().size();
  const mesh::FileFrame& frame = made.prepared.model.frame;
  summary.add("file_unit_mm", Value(frame.mm_per_unit), "mm");
  summary.add("file_up", frame.up ? Value(mesh::axis_name(*frame.up)) : Value());
  summary.add("size_mm", Value::List{rounded(size.x), rounded(size.y), rounded(size.z)}, Line::size, "size",
              asked.empty() ? ""
                            : fmt::format("{:.1f} x {:.1f} x {:.1f} mm ({}{})", size.x, size.y, size.z,
                                          size_words(made, asked), scale_text(made.prepared)),
              "mm");
}

std::string bodies_text(std::size_t count) {
  return count == 1 ? "1 body" : fmt::format("{} bodies", count);
}

/// "103 bodies into 2; 31 % of their area was hidden, with 1240 whole faces"; nothing where none were united.
void add_skin(Summary& summary, const job::Result& made) {
  const prepare::SkinReport& skin = made.skin;
  summary.add("united", Value::Object{{"bodies_before", skin.united},
                                      {"bodies_after", skin.united_into},
                                      {"faces_hidden", skin.faces_hidden},
                                      {"hidden_share", rounded(skin.hidden_fraction)},
                                      {"openings_closed", skin.rims_closed},
                                      {"gaps_closed", skin.gaps_closed},
                                      {"unseen", skin.unseen},
                                      {"left_crossing", skin.left_crossing},
                                      {"standing", made.prepared.attached}});
  const prepare::Details& details = made.cleanup.left_out;
  summary.add(
      "left_out",
      Value::Object{
          {"small", details.small}, {"flat", details.flat}, {"low", details.low}, {"loose", details.loose}});
  const prepare::ThinWallReport& sheets = made.cleanup.thin_walls;
  summary.add("thin_walls",
              Value::Object{{"count", sheets.walls}, {"thickness_mm", rounded(sheets.thickness_mm)}});
  if (sheets.walls > 0) {
    summary.say(Line::skin, "thin walls",
                thin_walls_text(sheets) + " (--skins both leaves inside and outside)");
  }
  if (details.count() > 0) {
    summary.say(Line::skin, "left out", details_text(details) + " (--keep-bodies leaves them in)");
  }
  if (skin.united > 0) {
    summary.say(
        Line::skin, "united",
        fmt::format(
            "{} into {}{}; {:.0f} % of their area was hidden, with {} (--keep-bodies leaves them)",
            bodies_text(skin.united), skin.united_into,
            skin.rims_closed == 0 ? "" : fmt::format(", {} closed", counted(skin.rims_closed, "opening")),
            100.0 * skin.hidden_fraction, counted(skin.faces_hidden, "whole face")));
  }
  if (skin.unseen > 0) {
    summary.say(Line::skin, "unseen",
                bodies_text(skin.unseen) + " left out (--keep-bodies leaves " +
                    (skin.unseen == 1 ? "it" : "them") + " in)");
  }
  if (const std::size_t standing = made.prepared.attached; standing > 0) {
    summary.say(Line::skin, "standing",
                standing == 1
                    ? "1 body stands on a flat face of another one and is glued onto it"
                    : bodies_text(standing) + " stand on flat faces of others and are glued onto these");
  }
  if (skin.left_crossing > 0) {
    summary.say(
        Line::skin, "not united",
        bodies_text(skin.left_crossing) +
            " that touch or run into each other stay as they are: no sound skin of them was found, or only "
            "one that is far too fine");
  }
}

Value simplified_value(const prepare::SimplifyReport& report) {
  return Value::Object{
      {"faces_before", report.faces_before},          {"faces_after", report.faces_after},
      {"deviation_mm", rounded(report.deviation_mm)}, {"evened_mm", rounded(report.asymmetry_mm)},
      {"features_removed", report.features_removed},  {"rulings_removed", report.rulings_removed}};
}

void say_simplified(Summary& summary, const job::Result& made) {
  const prepare::SimplifyReport& report = made.prepared.simplified;
  if (report.faces_after < report.faces_before && report.deviation_mm > 0.0) {
    summary.say(Line::simplified, "simplified",
                fmt::format("from {} to {} triangles, the surface moved by at most {:.2f} mm",
                            report.faces_before, report.faces_after, report.deviation_mm));
    const double largest = made.prepared.model.surface.bounds().largest_extent();
    if (report.deviation_mm > far_moved * largest) {
      summary.say(
          Line::simplified, "coarse",
          fmt::format(
              "that is {:.0f} % of the size: parts that stand out may be gone; more --faces keep them",
              100.0 * report.deviation_mm / largest));
    }
  }
  // Less is rounding in the file.
  constexpr double seen_mm = 0.005;
  if (report.asymmetry_mm >= seen_mm) {
    summary.say(
        Line::simplified, "symmetric",
        fmt::format("both sides are equal now; they differed by up to {:.2f} mm", report.asymmetry_mm));
  }
  if (report.rulings_removed > 0) {
    summary.say(Line::simplified, "wider",
                counted(report.rulings_removed, "fold") + " between narrow faces side by side left out");
  }
  if (report.features_removed > 0) {
    summary.say(Line::simplified, "left out",
                counted(report.features_removed, "small feature") + " of flat walls");
  }
  if (const auto why = job::verdict(made.prepared, made.remedies)) {
    summary.say(Line::simplified, "too fine", english(*why));
  }
}

void add_page_saving(Summary& summary, const job::Result& made) {
  if (!made.share_saving_a_page) {
    summary.add("size_saving_a_page_mm", {}, "mm");
    return;
  }
  const double share = *made.share_saving_a_page;
  const double size = size_saving_a_page(made);
  summary.add("size_saving_a_page_mm", size, Line::hint, "hint",
              fmt::format("at {:.0f} % of this size such pieces would take a page less: --size {:.0f}mm",
                          100.0 * share, size),
              "mm");
}

void add_slivers(Summary& summary, const job::Result& made) {
  summary.add(
      "slivers", made.slivers, Line::slivers, "slivers",
      made.slivers == 0
          ? ""
          : fmt::format("{} narrower than {:g} mm, too narrow to cut or fold, on {}; another --size or "
                        "--faces may leave fewer",
                        counted(made.slivers, "face"), job::sliver_mm,
                        pieces_text(made.nets, pieces_with_slivers(made))));
}

/// With the option where a limit that the user set is the cause.
std::vector<Message> notes_of(const job::Result& made) {
  std::vector<Message> notes;
  if (made.parts_given_up) {
    notes.emplace_back("no_time_for_parts");
  }
  notes.insert(notes.end(), made.nets.notes.begin(), made.nets.notes.end());
  if (made.thickened.clamped > 0) {
    notes.push_back(Message("too_thick_for_edges", {{"n", made.thickened.clamped}}));
  }
  if (made.thickened.kept > 0) {
    notes.push_back(Message("cut_as_of_paper", {{"n", made.thickened.kept}}));
  }
  return notes;
}

void add_guide(Summary& summary, const job::Result& made) {
  const export_::Guide& guide = made.guide;
  if (guide.pages.empty()) {
    summary.add("guide", {});
    return;
  }
  const export_::Effort& effort = guide.effort;
  summary.add("guide",
              Value::Object{{"steps", guide.steps},
                            {"pages", guide.pages.size()},
                            {"minutes", std::round(effort.minutes)},
                            {"difficulty", effort.difficulty},
                            {"smallest_tab_mm", rounded(effort.smallest_tab_mm)}},
              Line::guide, "guide",
              fmt::format("{} on {}; {} of work, {}", counted(guide.steps, "step"),
                          counted(guide.pages.size(), "page"), export_::duration_words(effort.minutes),
                          export_::difficulty_words(effort.difficulty)));
}

/// "pages 1 and 2: stone; page 3: wood", with --page-by.
void add_page_names(Summary& summary, const export_::Pages& pages) {
  Value names(Value::List{});
  std::vector<std::string> words;
  for (std::size_t i = 0; i < pages.names.size();) {
    std::size_t end = i;
    while (end < pages.names.size() && pages.names[end] == pages.names[i]) {
      names.add(pages.names[end]);
      ++end;
    }
    words.push_back(end == i + 1 ? fmt::format("page {}: {}", i + 1, pages.names[i])
                                 : fmt::format("pages {} to {}: {}", i + 1, end, pages.names[i]));
    i = end;
  }
  summary.add("page_names", std::move(names), Line::nets, "sorted",
              fmt::format("{}", fmt::join(words, "; ")));
}

/// Where pieces of separate bodies are glued to each other.
void add_glue_outlines(Summary& summary, const job::Result& made) {
  Value spots(Value::List{});
  for (const export_::GlueOutline& outline : made.drawn.glue_outlines) {
    spots.add(Value::Object{{"piece", made.nets.pieces[outline.piece].name},
                            {"other", made.nets.pieces[outline.other].name}});
  }
  summary.add("glue_outlines", std::move(spots));
}

std::string lines_text(const export_::DrawReport& drawn) {
  return fmt::format("{} to cut, {} to fold", metres(drawn.cut_mm), metres(drawn.fold_mm));
}

}  // namespace

Summary summary(const MakeJob& job, const MakeResult& result) {
  const job::Result& made = result.made;
  const mesh::Model& model = made.prepared.model;
  const unfold::Nets& nets = made.nets;
  const TabFigures tabs = tab_figures(model.surface, nets, job.options.tabs);
  Summary summary(fmt::format(
      "{}: {}, {} on paper, {}", shown_name(job.input()), counted(model.polygon_count, "polygon"),
      counted(made.prepared.panels.count(), "flat face"), bodies_text(model.surface.component_count())));
  summary.add("model", model.name);
  summary.add("faces", model.surface.face_count());
  summary.add("parts", made.part_count);
  summary.add("pieces", nets.pieces.size());
  summary.add("pages", made.pages.count, Line::nets, "nets",
              fmt::format("{}, {}{} on {}, {}", counted(made.part_count, "part"),
                          counted(nets.pieces.size(), "piece"), reasons_text(nets),
                          counted(made.pages.count, "page"), job.paper_name));
  add_page_names(summary, made.pages);
  summary.add("ground", made.ground ? Value(*made.ground) : Value());
  add_page_saving(summary, made);
  add_extra_pieces(summary, nets, job.options.pieces.max_panels);
  add_equal_pieces(summary, nets, made.drawn.kinds);
  add_size(summary, made, job.size_asked.words);
  summary.add("tabs", tabs.tabs, Line::tabs, "tabs", tabs_text(tabs, nets, job.options.tabs));
  summary.add("additional_tabs", tabs.additional);
  if (job.options.tab_choice.sides == unfold::TabSides::slots) {
    summary.add("joins_in_slits", tabs.slots);
  }
  summary.add("tabs_usable", tabs.usable);
  summary.add("joins_too_narrow", tabs.too_narrow);
  summary.add("joins", nets.joins.size());
  summary.add("seams", unfold::chains_of(model.surface, nets).size());
  summary.add("joins_without_tab", tabs.without);
  const GlueFigures glue = glue_figures(model.surface, nets, job.options.tabs);
  summary.add("glue_mm", rounded(glue.all_mm), "mm");
  summary.add("without_tab_mm", rounded(glue.without_tab_mm), "mm");
  summary.add("weak_tab_mm", rounded(glue.weak_mm), "mm");
  summary.add("cut_mm", rounded(made.drawn.cut_mm), Line::lines, "lines", lines_text(made.drawn), "mm");
  summary.add("fold_mm", rounded(made.drawn.fold_mm), "mm");
  summary.add("rolled_folds",
              export_::count_rolled_folds(made.prepared, nets, made.options.style.hidden_fold_angle));
  summary.add("index", index_value(model.surface, nets, made.pages, made.drawn));
  add_numbers(summary, made.drawn);
  add_slivers(summary, made);
  add_folding(summary, nets);
  add_bodies(summary, nets, made.drawn.bodies);
  add_glue_outlines(summary, made);
  add_guide(summary, made);
  summary.add("paper", job.paper_name);
  summary.add("buildable", prepare::can_be_folded(made.prepared));
  summary.add("smallest_size_mm", Value(made.prepared.smallest_size_mm), "mm");
  add_skin(summary, made);
  summary.add("simplified", simplified_value(made.prepared.simplified));
  summary.add("short_share", rounded(made.prepared.work.short_share()));
  say_simplified(summary, made);
  say_colours(summary, made);
  say_lost_edges(summary, made);
  summary.add_seconds(result.seconds);
  summary.add_repairs(model.repairs);
  summary.add_notes(notes_of(made));
  summary.add_files(result.files);
  add_brief(summary, job, result);
  return summary;
}

Summary summary(const UnfoldJob& job, const MakeResult& result) {
  const job::Result& made = result.made;
  const mesh::Model& model = made.prepared.model;
  const unfold::Nets& nets = made.nets;
  Summary summary(fmt::format("{}: {}, {}", shown_name(job.model),
                              counted(model.surface.face_count(), "face"),
                              counted(model.surface.component_count(), "component")));
  summary.add("model", model.name);
  summary.add("faces", model.surface.face_count());
  summary.add("parts", made.part_count);
  summary.add("pieces", nets.pieces.size());
  summary.add("overlaps", made.figures.overlaps, Line::nets, "nets",
              fmt::format("{}, {}{}, {} overlaps", counted(made.part_count, "part"),
                          counted(nets.pieces.size(), "piece"), reasons_text(nets), made.figures.overlaps));
  summary.add("joins", nets.joins.size());
  summary.add("seams", unfold::chains_of(model.surface, nets).size());
  if (job.options.tabs.wanted) {
    const TabFigures tabs = tab_figures(model.surface, nets, job.options.tabs);
    summary.add("tabs", tabs.tabs, Line::tabs, "tabs", tabs_text(tabs, nets, job.options.tabs));
    summary.add("tabs_usable", tabs.usable);
    summary.add("joins_without_tab", tabs.without);
    summary.add("joins_too_narrow", tabs.too_narrow);
  }
  add_size(summary, made, {});
  summary.add("cut_mm", rounded(made.figures.cut_mm), "mm");
  summary.add("fold_mm", rounded(made.figures.fold_mm), "mm");
  Value reasons(Value::List{});
  for (const unfold::Piece& piece : nets.pieces) {
    reasons.add(unfold::name(piece.reason));
  }
  summary.add("reasons", std::move(reasons));
  add_folding(summary, nets);
  say_simplified(summary, made);
  summary.add_seconds(result.seconds);
  summary.add_repairs(model.repairs);
  summary.add_notes(notes_of(made));
  summary.add_files(result.files);
  return summary;
}

}  // namespace ridgecraft::cli
