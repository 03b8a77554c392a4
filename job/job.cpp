// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/job.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/encodings.hpp"
#include "base/error.hpp"
#include "base/version.hpp"
#include "export/sheet/pages.hpp"
#include "export/view/camera.hpp"
#include "job/edge_constraints.hpp"
#include "job/extent.hpp"
#include "job/model_of_nets.hpp"
#include "job/one_skin.hpp"
#include "job/page_labels.hpp"
#include "job/page_layout.hpp"
#include "job/parts.hpp"
#include "job/settings.hpp"
#include "job/unfold_options.hpp"
#include "job/verdict.hpp"
#include "prepare/prepare.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/tabs_of_nets.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::job {
namespace {

prepare::PanelRoom panel_room(const Options& options) {
  const Vec2 area = room_for_pieces(options);
  return {{area.x, area.y}, options.paper && options.tabs.wanted ? options.tabs.height_mm : 0.0};
}

void note_divided_panels(const prepare::Prepared& prepared, std::vector<std::string>& notes) {
  if (const std::size_t n = prepared.divided_panels; n > 0) {
    notes.push_back(
        fmt::format("{} flat region{} larger than the printable area, so cut", n, n == 1 ? " is" : "s are"));
  }
}

/// Whether there is anything to tell.
template <class Value>
bool tell(const Listener& listener, const std::optional<Value>& remark) {
  if (listener && remark) {
    listener(*remark);
  }
  return remark.has_value();
}

/// Nothing that fails its own check leaves the program.
verify::Figures checked_figures(const std::string& fold, const Context& context) {
  const verify::Report report = verify::verify(fold, {.max_faults = 3}, context);
  if (!report.sound() || !report.figures) {
    throw Error(ErrorKind::internal,
                "the nets fail their check and weren't written (" +
                    (report.faults.empty() ? "no figures" : report.faults.front().message) + ")");
  }
  return *report.figures;
}

/// The nets that are cut out.
const unfold::Nets& nets_on_pages(const Paper& made) {
  return made.nets_of_board ? *made.nets_of_board : made.nets;
}

export_::Assembly assembly_of(const Paper& made) {
  return export_::assembly_order(made.prepared.model.surface, made.nets, export_::stance_of(made.up).up);
}

void lay_out_pages(Paper& made, StageClock& clock, const Context& context) {
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

void draw_pages(Paper& made, StageClock& clock, const Context& context) {
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
    made.guide = clock("guide", context, [&] { return guide_of(made, context); });
  }
}

/// The FOLD file, and its check.
void finish(Paper& made, StageClock& clock, const Context& context) {
  const mesh::Model& model = made.prepared.model;
  // Files keep the nets of the surface, which are larger or smaller than those of board: they get pages of
  // their own.
  std::optional<export_::Pages> own;
  if (made.nets_of_board) {
    own =
        clock("lay out", context, [&] { return laid_out(made.prepared, made.options, made.nets, context); });
  }
  made.fold = clock("write", context, [&] {
    made.mark = {program_and_version(), model.name, model.digest,
                 with_searched(settings_of(made.options, made.seed), made.searched_with)};
    if (!made.edits.empty()) {
      made.mark.settings["edits"] = json_string(made.edits);
    }
    const export_::Pages* const pages = own ? &*own : made.options.paper ? &made.pages : nullptr;
    return export_::write_fold(
        {made.prepared, made.part, made.nets, made.assembly, pages,
         own ? export_::find_glue_outlines(model.surface, made.nets) : made.drawn.glue_outlines, made.up},
        made.mark);
  });
  made.figures = clock("verify", context, [&] { return checked_figures(made.fold, context); });
}

/// The clock of a job that goes on.
StageClock clock_of(const Paper& made) {
  StageClock clock;
  clock.add(made.seconds);
  return clock;
}

/// What is prepared: the model, or the faces that it had been simplified to for nets made before.
struct Faces {
  mesh::Model model;
  prepare::SizeOptions size;
  prepare::SimplifyOptions simplify;
};

Faces faces_to_unfold(mesh::Model model, const Options& options, std::vector<std::string>& notes,
                      const Context& context) {
  const bool as_before = options.edges.from && !options.edges.cut && !options.edges.keep &&
                         options.simplify.mode != prepare::Simplification::keep;
  auto before = as_before ? model_of_nets(*options.edges.from, model, context) : std::nullopt;
  if (!before || before->simplify.mode != options.simplify.mode ||
      before->simplify.faces != options.simplify.faces) {
    return {std::move(model), options.size, options.simplify};
  }
  notes.push_back("the model is simplified as it was for " + options.edges.from->name);
  Faces faces{std::move(before->model), options.size, options.simplify};
  faces.simplify.mode = prepare::Simplification::keep;
  if (!faces.size.mm_per_unit) {
    // The size is that of the model, not of what simplification left of it.
    faces.size.mm_per_unit =
        options.size.largest_extent_mm / (model.surface.bounds().largest_extent() * model.file_scale);
  }
  return faces;
}

/// What the model looks like as it was read, for pages in colour.
std::optional<mesh::LookParts> look_for(const Options& options, const mesh::Model& model,
                                        const Context& context, std::vector<std::string>& notes) {
  return options.paper && options.style.ink != export_::Ink::lines ? mesh::look_of(model, context, notes)
                                                                   : std::nullopt;
}

/// What was done to the bodies; where that is nothing, they are kept.
void take_over(const OneSkin& skin, Paper& made) {
  made.cleanup = skin.cleanup;
  made.skin = skin.skin;
  made.options.bodies = skin.changed() ? prepare::Bodies::unite : prepare::Bodies::keep;
}

/// Bodies that were parted are no longer those of the file, as if they had been united.
void take_over_attached(Paper& made) {
  const bool as_before = made.options.edges.from && made.options.simplify.part_attached;
  made.options.simplify.part_attached = made.prepared.attached > 0 || as_before;
  if (made.options.simplify.part_attached) {
    made.options.bodies = prepare::Bodies::unite;
  }
}

/// Models of more faces aren't judged once more at another size: it would take too long, and too much memory.
constexpr std::size_t most_judged_faces = 200000;
/// Of the time that is left.
constexpr double judging_share = 0.5;

/// A model at the size that suits it: what is too small for paper was judged at the usual size before that
/// was known, and is judged at this one once more. Kept where the model is as good for it; then whoever asks
/// for this size gets the same. Not where the time is too short for it. `model`: as it was read.
void judge_at_its_size(mesh::Model model, Paper& made, const Context& context) {
  prepare::SizeOptions size = made.options.size;
  size.adapts = false;
  size.largest_extent_mm = std::round(made.prepared.model.surface.bounds().largest_extent());
  const Context in_time = until_deadline(context, judging_share);
  try {
    OneSkin skin = one_skin(std::move(model), size, made.options.simplify, in_time);
    prepare::Prepared prepared = prepare::prepare_as_asked(std::move(skin.model), size, made.options.simplify,
                                                           panel_room(made.options), in_time);
    const Vec2 area = room_for_pieces(made.options);
    if (prepare::is_as_good(prepared, made.prepared) &&
        prepare::expected_pages(prepared, area) <= size.most_pages) {
      prepared.size_reason = made.prepared.size_reason;
      made.prepared = std::move(prepared);
      take_over(skin, made);
      return;
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::out_of_time) {
      throw;
    }
  }
  if (made.options.bodies == prepare::Bodies::unite) {
    made.options.size.judged_at_mm = made.options.size.largest_extent_mm;
  }
}

/// What was done to the bodies before they were united is a part of what was done to the model.
void add_cleanup(const prepare::SimplifyReport& cleanup, double mm_per_unit,
                 prepare::SimplifyReport& report) {
  if (cleanup.faces_before > 0) {
    report.faces_before = cleanup.faces_before;
    report.deviation_mm += mm_per_unit * cleanup.deviation_mm;
    report.asymmetry_mm = std::max(report.asymmetry_mm, mm_per_unit * cleanup.asymmetry_mm);
    report.features_removed += cleanup.features_removed;
    report.rulings_removed += cleanup.rulings_removed;
  }
}

/// Lengths on paper that were told at another size.
void rescale(prepare::CleanupReport& cleanup, double factor) {
  cleanup.proxies.moved_mm *= factor;
  cleanup.thin_walls.thickness_mm *= factor;
}

/// Tabs anew, as the options ask for them.
void give_new_tabs(Paper& made, StageClock& clock, const Context& context) {
  clock("tabs", context, [&] {
    const unfold::Options options = unfold_options(made.options, made.prepared, {});
    unfold::replace_tabs(
        {made.prepared.model.surface, made.prepared.panels, options, made.options.tab_choice}, made.nets,
        context);
    return true;
  });
}

/// All that was done by hand, and that the pages are those of the program again.
std::string with_new_pages(const std::string& edits) {
  return edits.empty() ? edits : edits + "\n" + std::string(laid_out_anew);
}

/// All that follows from nets that have changed. `pages`: where they lie already.
Paper with_new_nets(Paper made, StageClock clock, const Context& context,
                    std::optional<export_::Pages> pages = std::nullopt) {
  // What was painted is painted again only where it changes.
  export_::DrawReport drawn;
  drawn.pictures = std::move(made.drawn.pictures);
  made.drawn = std::move(drawn);
  if (made.options.paper) {
    if (pages) {
      made.pages = std::move(*pages);
    } else {
      lay_out_pages(made, clock, context);
    }
    draw_pages(made, clock, context);
  }
  finish(made, clock, context);
  made.seconds = clock.seconds();
  return made;
}

}  // namespace

Paper paper(mesh::Model model, const Options& options, const Context& context, const Listener& listener) {
  Paper made;
  made.options = options;
  made.options.simplify.hidden_fold_angle = options.style.hidden_fold_angle;
  made.seed = context.seed;
  StageClock clock;
  std::vector<std::string> notes;
  model = prepare::select(std::move(model), options.selection);
  made.ground = prepare::ground_name(model);
  made.up = options.up.value_or(export_::up_axis_of(model));
  if (options.extent) {
    made.options.size.adapts = false;
    made.options.size.largest_extent_mm =
        options.extent->mm * largest_share(model, options.extent->kind, made.up);
  }
  apply_edge_requests(options.edges, model, made.options.simplify, notes);
  use_size_of_nets(options.edges, model, made.options.size);
  made.options.bodies = bodies_for(options.edges, options.bodies);
  made.options.simplify.skins = skins_for(options.edges, options.simplify.skins);
  made.options.simplify.part_attached =
      parts_standing_for(options.edges, options.bodies == prepare::Bodies::unite &&
                                            made.options.simplify.mode != prepare::Simplification::keep);
  const double units = model.file_scale;
  std::optional<mesh::LookParts> look =
      clock("prepare", context, [&] { return look_for(options, model, context, notes); });
  std::optional<mesh::Model> as_read;
  if (made.options.bodies == prepare::Bodies::unite) {
    if (made.options.size.adapts && model.surface.face_count() <= most_judged_faces) {
      as_read = model;  // its skin may be another one at another size
    }
    OneSkin skin = clock("prepare", context, [&] {
      return one_skin(std::move(model), made.options.size, made.options.simplify, until_deadline(context));
    });
    model = std::move(skin.model);
    take_over(skin, made);
  }
  const Vec2 area = room_for_pieces(options);
  bool told_of_pages = options.paper && tell(listener, many_pages(model, made.options.size, area));
  made.prepared = clock("prepare", context, [&] {
    Faces faces = faces_to_unfold(std::move(model), made.options, notes, context);
    return prepare::prepare(std::move(faces.model), faces.size, faces.simplify, panel_room(options),
                            until_deadline(context));
  });
  if (made.prepared.size_reason != prepare::SizeReason::none) {
    const double judged_at_mm = made.options.size.largest_extent_mm;
    if (as_read) {
      clock("prepare", context, [&] {
        judge_at_its_size(std::move(*as_read), made, context);
        return true;
      });
    } else if (made.options.bodies == prepare::Bodies::unite) {
      made.options.size.judged_at_mm = judged_at_mm;
    }
    made.options.size.largest_extent_mm = std::round(made.prepared.model.surface.bounds().largest_extent());
    if (made.options.size.judged_at_mm) {
      rescale(made.cleanup, made.options.size.largest_extent_mm / judged_at_mm);
    }
  }
  if (look) {
    made.prepared.look = std::make_shared<const mesh::Look>(std::move(*look), made.prepared.from_model.factor,
                                                            made.prepared.from_model.shift);
  }
  const mesh::Surface& surface = made.prepared.model.surface;
  take_over_attached(made);
  add_cleanup(made.cleanup.simplified, made.prepared.mm_per_unit * units, made.prepared.simplified);
  made.searched_with = settings_of(made.options, made.seed);
  if (const std::string why =
          verdict(made.prepared, made.options.simplify, larger_size_is_sure(made.cleanup, made.skin));
      options.strict && !why.empty()) {
    throw Error(ErrorKind::unbuildable, why);
  }
  made.slivers = prepare::count_slivers(surface, made.prepared.panels);
  if (options.paper) {
    tell(listener, many_bodies(surface));
    tell(listener, short_folds(made.prepared, options.style.hidden_fold_angle));
    told_of_pages =
        told_of_pages ||
        tell(listener, many_pages(surface, area, prepare::expected_pages(made.prepared, area), false));
  }
  unfold::EdgeConstraints constraints =
      clock("prepare", context, [&] { return constraints_of(options.edges, made.prepared, context, notes); });
  if (options.paper) {
    note_divided_panels(made.prepared, notes);
    part_by_labels(page_labels(made.prepared.model, options.page_by), made.prepared, constraints);
  }
  Parts parts = clock("segment", context, [&] { return find_parts(made.prepared, options, context); });
  made.part = std::move(parts.of_face);
  made.parts_given_up = parts.given_up;
  made.part_count = count_parts(made.part);
  made.constraints = std::move(constraints);
  made.nets = clock("unfold", context, [&] {
    return unfold::unfold(surface, made.prepared.panels, made.part,
                          unfold_options(options, made.prepared, made.constraints), context);
  });
  if (options.tabs.wanted && options.tab_choice.any()) {
    give_new_tabs(made, clock, context);
  }
  made.nets.notes.insert(made.nets.notes.begin(), notes.begin(), notes.end());
  made.early_notes = std::move(notes);
  made.assembly = clock("unfold", context, [&] { return assembly_of(made); });
  if (options.paper) {
    lay_out_pages(made, clock, context);
    if (!told_of_pages) {
      tell(listener, many_pages(surface, area, static_cast<double>(made.pages.count), true));
    }
    draw_pages(made, clock, context);
  }
  finish(made, clock, context);
  made.seconds = clock.seconds();
  return made;
}

export_::Guide guide_of(const Paper& made, const Context& context) {
  return export_::draw_guide({made.prepared, nets_on_pages(made), made.pages, made.assembly,
                              made.drawings.size(), made.drawn.bodies, export_::stance_of(made.up)},
                             made.options.style, context);
}

Paper with_tabs(Paper made, const unfold::TabOptions& tabs, const Context& context) {
  const bool were_split = made.options.tabs.split_pieces;
  made.options.tabs = tabs;
  made.options.tabs.split_pieces = were_split;
  made.edits = with_new_pages(made.edits);
  StageClock clock = clock_of(made);
  give_new_tabs(made, clock, context);
  return with_new_nets(std::move(made), std::move(clock), context);
}

unfold::Nets tabbed(const Paper& made, unfold::Nets nets, const unfold::TabChoice& choice,
                    const Context& context) {
  const unfold::Options options = unfold_options(made.options, made.prepared, {});
  unfold::replace_tabs({made.prepared.model.surface, made.prepared.panels, options, choice}, nets, context);
  nets.notes = made.early_notes;
  return nets;
}

Paper with_nets(Paper made, unfold::Nets nets, std::optional<export_::Pages> pages, std::string edits,
                const Context& context) {
  made.nets = std::move(nets);
  made.edits = std::move(edits);
  StageClock clock = clock_of(made);
  made.assembly = clock("unfold", context, [&] { return assembly_of(made); });
  return with_new_nets(std::move(made), std::move(clock), context, std::move(pages));
}

Paper with_pages(Paper made, const export_::Paper& paper, const export_::Style& style,
                 const Context& context) {
  made.options.paper = paper;
  made.options.style = style;
  made.edits = with_new_pages(made.edits);
  StageClock clock = clock_of(made);
  return with_new_nets(std::move(made), std::move(clock), context);
}

}  // namespace ridgecraft::job
