// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/from_nets.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "export/sheet/pages.hpp"
#include "export/view/camera.hpp"
#include "job/page_layout.hpp"
#include "job/settings.hpp"
#include "job/unfold_options.hpp"
#include "mesh/model/model.hpp"
#include "unfold/tabs_of_nets.hpp"

namespace ridgecraft::job {
namespace {

using Glue = std::vector<export_::GlueOutline>;

/// Leaves out those glue outlines that fail their check; how many.
std::size_t leave_out_faulty(const verify::Report& report, const Glue& glue, export_::DrawReport& drawn) {
  std::size_t count = 0;
  for (const verify::Fault& fault : report.faults) {
    for (const auto& [what, index] : fault.indices) {
      if (what == "glue") {
        const export_::GlueOutline& faulty = glue[static_cast<std::size_t>(index)];
        drawn.not_glued.push_back({faulty.piece, faulty.other});
        ++count;
      }
    }
  }
  return count;
}

/// The nets that are cut out.
const unfold::Nets& nets_on_pages(const Result& made) {
  return made.nets_of_board ? *made.nets_of_board : made.nets;
}

void write(Result& made, const export_::Pages* pages, const Glue& glue) {
  const mesh::Model& model = made.prepared.model;
  made.mark = {program_and_version(), model.name, model.digest,
               with_searched(settings_of(made.options, made.used, made.seed), made.searched_with)};
  if (!made.edits.empty()) {
    made.mark.settings["edits"] = json_string(made.edits);
  }
  made.fold = export_::write_fold({made.prepared, made.part, made.nets, made.assembly, pages, glue, made.up},
                                  made.mark);
}

}  // namespace

void give_new_tabs(Result& made, StageClock& clock, const Context& context) {
  clock("tabs", context, [&] {
    const unfold::Options options = unfold_options(made.options, made.prepared, {});
    unfold::replace_tabs(
        {made.prepared.model.surface, made.prepared.panels, options, made.options.tab_choice}, made.nets,
        context);
    return true;
  });
}

export_::Assembly assembly_of(const Result& made) {
  return export_::assembly_order(made.prepared.model.surface, made.nets, export_::stance_of(made.up).up);
}

void lay_out_pages(Result& made, StageClock& clock, const Context& context) {
  made.nets_of_board.reset();
  made.thickened = {};
  if (made.options.board.thickness_mm > 0.0) {
    made.nets_of_board = clock("lay out", context, [&] {
      return export_::thick_nets(made.prepared, made.nets, made.options.board, &made.thickened);
    });
  }
  made.pages = clock("lay out", context,
                     [&] { return laid_out(made.prepared, made.options, nets_on_pages(made), context); });
}

void draw_pages(Result& made, StageClock& clock, const Context& context) {
  made.off_grain = export_::pieces_off_grain(
      export_::fold_directions(made.prepared.model.surface, nets_on_pages(made)), made.pages);
  // By hand pages may be filled as nobody would fill them to save one.
  made.share_saving_a_page.reset();
  if (made.options.page_by == PageBy::any && made.edits.empty()) {
    made.share_saving_a_page = clock("hint", context, [&] {
      return export_::scale_that_saves_a_page(nets_on_pages(made), made.pages, context);
    });
  }
  made.drawings = clock("draw", context, [&] {
    return export_::draw({made.prepared, nets_on_pages(made), made.pages}, made.options.style, &made.drawn,
                         context);
  });
  made.guide = {};
  if (made.options.guide) {
    made.guide = clock("guide", context, [&] { return drawn_guide(made, context); });
  }
}

void finish(Result& made, StageClock& clock, const Context& context) {
  // Files keep the nets of the surface, which are larger or smaller than those of board: they get pages of
  // their own.
  std::optional<export_::Pages> own;
  if (made.nets_of_board) {
    own =
        clock("lay out", context, [&] { return laid_out(made.prepared, made.options, made.nets, context); });
  }
  // Nothing that fails its own check leaves the program; what would be glued where it can't be is left out.
  for (std::size_t left_out = 0;;) {
    const Glue glue =
        own ? export_::find_glue_outlines(made.prepared.model.surface, made.nets, made.drawn.not_glued)
            : made.drawn.glue_outlines;
    clock("write", context, [&] {
      write(made, own ? &*own : made.options.paper ? &made.pages : nullptr, glue);
      return true;
    });
    const verify::Report report =
        clock("verify", context, [&] { return verify::verify(made.fold, {.max_faults = 3}, context); });
    if (report.sound() && report.figures) {
      made.figures = *report.figures;
      if (left_out > 0) {
        made.nets.notes.push_back(Message("not_glued", {{"n", left_out}}));
      }
      return;
    }
    const std::size_t faulty = leave_out_faulty(report, glue, made.drawn);
    if (faulty == 0) {
      throw Error(ErrorKind::internal,
                  Message("failed_check",
                          {{"fault", report.faults.empty() ? "no figures" : report.faults.front().message}}));
    }
    left_out += faulty;
    draw_pages(made, clock, context);
  }
}

export_::Guide drawn_guide(const Result& made, const Context& context) {
  return export_::draw_guide({made.prepared, nets_on_pages(made), made.pages, made.assembly,
                              made.drawings.size(), made.drawn.bodies, export_::stance_of(made.up)},
                             made.options.style, context);
}

}  // namespace ridgecraft::job
