// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/job.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/context.hpp"
#include "base/error.hpp"
#include "base/vector.hpp"
#include "export/paint/lost_edges.hpp"
#include "export/sheet/pages.hpp"
#include "export/view/camera.hpp"
#include "job/edge_requests.hpp"
#include "job/from_nets.hpp"
#include "job/next_best.hpp"
#include "job/options.hpp"
#include "job/page_layout.hpp"
#include "job/remark.hpp"
#include "job/remedies.hpp"
#include "job/settings.hpp"
#include "job/unfold_options.hpp"
#include "mesh/look/relief.hpp"
#include "mesh/look/shade.hpp"
#include "mesh/model/model.hpp"
#include "prepare/clean_bodies.hpp"
#include "prepare/prepare.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/prepared.hpp"
#include "prepare/skin/skin.hpp"
#include "unfold/net/keep_numbers.hpp"
#include "unfold/tabs_of_nets.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::job {
namespace {

// Sizes as people give them who know how the model stands: its height, width or depth.

const char* code_without(ExtentKind kind) {
  switch (kind) {
    case ExtentKind::width:
      return "no_width";
    case ExtentKind::depth:
      return "no_depth";
    case ExtentKind::height:
      break;
  }
  return "no_height";
}

/// The model's largest extent as a multiple of this one; the model stands on its foot with this axis upwards
/// (export/view/camera.hpp). Throws Error(usage) where it has no such extent. O(faces).
double largest_share(const mesh::Model& model, ExtentKind kind, mesh::Axis up) {
  const export_::Stance stance = export_::stance_of(up);
  const Vec3 direction = kind == ExtentKind::height  ? stance.up
                         : kind == ExtentKind::depth ? stance.front
                                                     : cross(stance.up, stance.front);
  const Box3& box = model.surface.bounds();
  const double extent = std::abs(dot(direction, box.size()));
  if (!(extent > 0.0)) {
    throw Error(ErrorKind::usage, Message(code_without(kind)));
  }
  return box.largest_extent() / extent;
}

// The bodies of a model as a maker can build them: some left out, some plain, united where they meet.

struct OneSkin {
  mesh::Model model;
  prepare::CleanupReport cleanup;
  prepare::SkinReport skin;

  /// Whether anything was done to the model's bodies.
  [[nodiscard]] bool changed() const;
};

/// Whether bodies meet along so many lines that their skin is finer than what it is made of: the inside of a
/// machine. Nothing makes that coarse enough to be folded, and its bodies can be.
bool is_tangle(std::size_t faces_of_skin, std::size_t faces_of_bodies) {
  constexpr std::size_t most_faces = 8000;
  constexpr std::size_t finer = 2;
  return faces_of_skin > most_faces && faces_of_skin > finer * faces_of_bodies;
}

bool OneSkin::changed() const {
  return skin.united > 0 || skin.unseen > 0 || cleanup.left_out.count() > 0 || cleanup.thin_walls.walls > 0;
}

/// What is too small is judged at the size that is given. Throws Error(interrupted), Error(out_of_time).
OneSkin one_skin(mesh::Model model, const prepare::SizeOptions& size,
                 const prepare::SimplifyOptions& simplify, const Context& context) {
  OneSkin result;
  result.model = std::move(model);
  result.cleanup = prepare::clean_bodies(result.model, size, simplify, context);
  mesh::Model apart = result.model;
  result.skin = prepare::unite_bodies(result.model, context);
  if (result.skin.united > 0 && is_tangle(result.model.surface.face_count(), apart.surface.face_count())) {
    const std::size_t tangled = result.skin.united + result.skin.left_crossing;
    result.model = std::move(apart);
    result.skin = {};
    result.skin.left_crossing = tangled;
  }
  if (result.skin.united > 0) {
    result.cleanup.left_out += prepare::leave_out_details(result.model, size, simplify, context);
  }
  return result;
}

prepare::PanelRoom panel_room(const Options& options) {
  const Vec2 area = room_for_pieces(options);
  return {{area.x, area.y}, options.paper && options.tabs.wanted ? options.tabs.height_mm : 0.0};
}

void note_stiff_board(const prepare::Prepared& prepared, const Options& options, double least_radius_mm,
                      std::vector<Message>& notes) {
  if (const std::size_t n = prepared.rolls.too_tight; n > 0) {
    notes.push_back(
        Message("board_too_stiff", {{"n", n},
                                    {"thickness", fmt::format("{:g}", options.board.thickness_mm)},
                                    {"radius", fmt::format("{:.0f}", least_radius_mm)}}));
  }
}

void note_divided_panels(const prepare::Prepared& prepared, std::vector<Message>& notes) {
  if (const std::size_t n = prepared.divided_panels; n > 0) {
    notes.push_back(Message("large_regions_cut", {{"n", n}}));
  }
}

/// What is prepared: the model, or the faces that it had been simplified to for nets made before.
struct Faces {
  mesh::Model model;
  prepare::SizeOptions size;
  prepare::SimplifyOptions simplify;
};

Faces faces_to_unfold(mesh::Model model, const EdgeRequests& edges, const UsedOptions& used,
                      std::vector<Message>& notes, const Context& context) {
  const bool as_before =
      edges.from && !edges.cut && !edges.keep && used.simplify.mode != prepare::Simplification::keep;
  auto before = as_before ? model_of_nets(*edges.from, model, context) : std::nullopt;
  if (!before || before->simplify.mode != used.simplify.mode ||
      before->simplify.faces != used.simplify.faces ||
      before->simplify.budget.hours != used.simplify.budget.hours) {
    return {std::move(model), used.size, used.simplify};
  }
  notes.push_back(Message("simplified_as_before", {{"file", edges.from->name}}));
  Faces faces{std::move(before->model), used.size, used.simplify};
  faces.simplify.mode = prepare::Simplification::keep;
  if (!faces.size.mm_per_unit) {
    // The size is that of the model, not of what simplification left of it.
    faces.size.mm_per_unit =
        used.size.largest_extent_mm / (model.surface.bounds().largest_extent() * model.file_scale);
  }
  return faces;
}

/// What the model looks like as it was read, for pages in colour. Pictures that can't be unpacked are
/// remarked on.
std::optional<mesh::LookParts> look_for(const Options& options, mesh::Model& model, const Context& context) {
  if (!options.paper || options.style.ink == export_::Ink::lines) {
    return std::nullopt;
  }
  std::vector<std::string> faults;
  std::optional<mesh::LookParts> look = mesh::look_of(model, context, faults);
  if (options.style.details == export_::Details::shade) {
    look = look ? std::move(look) : mesh::white_look(model.surface);
    mesh::add_shade(*look, context);
  }
  model.repairs.add(mesh::RepairKind::texture_missing, faults.size(),
                    faults.empty() ? std::string() : faults.front());
  return look;
}

bool has_pictures(const mesh::Model& model) {
  return model.corner_colours != nullptr ||
         std::any_of(model.materials.begin(), model.materials.end(),
                     [](const mesh::Material& material) { return material.has_picture(); });
}

/// The sharp edges of the model as it was read, for pages that have those which paper has no fold for.
std::optional<mesh::ReliefParts> relief_for(const Options& options, const mesh::Model& model) {
  const bool shown_by_pictures = options.style.details == export_::Details::automatic &&
                                 options.style.ink != export_::Ink::lines && has_pictures(model);
  const bool wanted = options.style.details == export_::Details::lines ||
                      options.style.details == export_::Details::automatic;
  return !options.paper || !wanted || shown_by_pictures ? std::nullopt : mesh::relief_of(model.surface);
}

/// Models of more faces aren't judged once more at another size, and no other result takes the place of one
/// that fails its check: it would take too long, and too much memory.
constexpr std::size_t most_judged_faces = 200000;
/// Of larger ones nothing is tried that would be less work: each try takes as long as all of preparation.
constexpr std::size_t most_remedied_faces = 20000;
/// Of the time that is left.
constexpr double judging_share = 0.5;

bool are_equal(const mesh::Surface& a, const mesh::Surface& b) {
  return std::ranges::equal(a.points(), b.points()) && a.face_count() == b.face_count() &&
         std::ranges::all_of(ids<FaceId>(a.face_count()),
                             [&](FaceId f) { return a.vertices(f) == b.vertices(f); });
}

/// Lengths on paper that were measured at another size.
void rescale(prepare::CleanupReport& cleanup, double factor) {
  cleanup.thin_walls.thickness_mm *= factor;
}

/// The clock of a job that goes on.
StageClock clock_of(const Result& made) {
  StageClock clock;
  clock.add(made.seconds);
  return clock;
}

/// All that was done by hand, and that the pages are those of the program again.
std::string with_new_pages(const std::string& edits) {
  return edits.empty() ? edits : edits + "\n" + std::string(laid_out_anew);
}

/// All that follows from nets that have changed. `pages`: where they lie already.
Result with_new_nets(Result made, StageClock clock, const Context& context,
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

/// One run from a model to its result: each phase takes up what the one before has left.
class Run {
 public:
  Run(const Options& options, const Context& context, const Listener& listener)
      : options_(options), context_(context), listener_(listener), area_(room_for_pieces(options)) {
    made_.options = options;
    made_.used = {options.bodies, options.size, options.simplify};
    made_.used.simplify.hidden_fold_angle = options.style.hidden_fold_angle;
    prepare::RollRules& rolls = made_.used.simplify.rolls;
    rolls.least_radius_mm = std::max(prepare::least_paper_radius_mm,
                                     prepare::least_radius_to_thickness * options.board.thickness_mm);
    if (options.pieces.mode == unfold::PieceMode::few && rolls.which == prepare::Rolled::automatic) {
      // Each strip that has to stay whole may cost a piece.
      rolls.which = prepare::Rolled::never;
    }
    made_.seed = context.seed;
  }

  Result run(mesh::Model model) {
    mesh::Model united = unite(selected(std::move(model)));
    prepare(std::move(united));
    settle_size();
    describe();
    look_for_remedies();
    require_buildable();
    remark_beforehand();
    unfold();
    if (options_.paper) {
      fill_pages();
    }
    finish(made_, clock_, context_);
    made_.seconds = clock_.seconds();
    return std::move(made_);
  }

 private:
  template <class Work>
  void in_stage(std::string_view stage, const Work& work) {
    clock_(stage, context_, [&] {
      work();
      return true;
    });
  }
  template <class Remark>
  void remark(const std::optional<Remark>& found) {
    if (listener_ && found) {
      listener_(*found);
    }
  }
  /// Once: the estimates of later phases are better, but not news.
  void remark_pages(const std::optional<ManyPages>& found) {
    if (!pages_remarked_) {
      remark(found);
      pages_remarked_ = found.has_value();
    }
  }

  /// What is taken of the model, and what named edges and nets made before ask of the stages.
  mesh::Model selected(mesh::Model whole) {
    mesh::Model model = prepare::select(std::move(whole), options_.selection);
    UsedOptions& used = made_.used;
    made_.ground = prepare::ground_name(model);
    made_.up = options_.up.value_or(export_::up_axis_of(model));
    if (options_.extent) {
      used.size.adapts = false;
      used.size.largest_extent_mm =
          options_.extent->mm * largest_share(model, options_.extent->kind, made_.up);
    }
    apply_edge_requests(options_.edges, model, used.simplify, notes_);
    use_size_of_nets(options_.edges, model, used.size);
    used.bodies = bodies_for(options_.edges, options_.bodies);
    used.simplify.skins = skins_for(options_.edges, options_.simplify.skins);
    used.simplify.part_attached =
        parts_standing_for(options_.edges, options_.bodies == prepare::Bodies::unite &&
                                               used.simplify.mode != prepare::Simplification::keep);
    if (model.surface.face_count() <= most_remedied_faces && !options_.edges.cut && !options_.edges.keep) {
      asked_ = model;
    }
    look_ = clock_("prepare", context_, [&] { return look_for(options_, model, context_); });
    relief_ = clock_("prepare", context_, [&] { return relief_for(options_, model); });
    return model;
  }

  /// Bodies become one where that is wanted.
  mesh::Model unite(mesh::Model model) {
    if (made_.used.bodies != prepare::Bodies::unite) {
      return model;
    }
    if (made_.used.size.adapts && model.surface.face_count() <= most_judged_faces) {
      as_read_ = model;  // its skin may be another one at another size
    }
    OneSkin skin = clock_("prepare", context_, [&] {
      return one_skin(std::move(model), made_.used.size, made_.used.simplify, until_deadline(context_));
    });
    take_over(skin);
    if (as_read_) {
      united_ = skin.model.surface;
    }
    return std::move(skin.model);
  }

  /// What was done to the bodies; where that is nothing, they are kept.
  void take_over(const OneSkin& skin) {
    made_.cleanup = skin.cleanup;
    made_.skin = skin.skin;
    made_.used.bodies = skin.changed() ? prepare::Bodies::unite : prepare::Bodies::keep;
  }

  void prepare(mesh::Model model) {
    if (options_.paper) {
      remark_pages(many_pages(model, made_.used.size, area_));
    }
    made_.prepared = clock_("prepare", context_, [&] {
      Faces faces = faces_to_unfold(std::move(model), options_.edges, made_.used, notes_, context_);
      return prepare::prepare(std::move(faces.model), faces.size, faces.simplify, panel_room(options_),
                              until_deadline(context_));
    });
  }

  /// The size that preparation has chosen is the one that is used.
  void settle_size() {
    if (made_.prepared.size_reason == prepare::SizeReason::none) {
      return;
    }
    prepare::SizeOptions& size = made_.used.size;
    const double judged_at_mm = size.largest_extent_mm;
    if (as_read_) {
      in_stage("prepare", [&] { judge_at_its_size(); });
    } else if (made_.used.bodies == prepare::Bodies::unite) {
      size.judged_at_mm = judged_at_mm;
    }
    size.largest_extent_mm = std::round(made_.prepared.model.surface.bounds().largest_extent());
    if (size.judged_at_mm) {
      rescale(made_.cleanup, size.largest_extent_mm / judged_at_mm);
    }
  }

  /// A model at the size that suits it: what is too small for paper was judged at the usual size before that
  /// was known, and is judged at this one once more. Kept where the model is as good for it; then the same
  /// size, when it is requested, gives the same. Not where the time is too short for it.
  void judge_at_its_size() {
    prepare::SizeOptions size = made_.used.size;
    size.adapts = false;
    size.largest_extent_mm = std::round(made_.prepared.model.surface.bounds().largest_extent());
    const Context in_time = until_deadline(context_, judging_share);
    try {
      OneSkin skin = one_skin(std::move(*as_read_), size, made_.used.simplify, in_time);
      if (are_equal(skin.model.surface, united_)) {
        take_over(skin);
        return;
      }
      prepare::Prepared prepared = prepare::prepare_as_asked(std::move(skin.model), size, made_.used.simplify,
                                                             panel_room(options_), in_time);
      if (is_as_good(prepared) && prepare::expected_pages(prepared, area_) <= size.most_pages) {
        prepared.size_reason = made_.prepared.size_reason;
        made_.prepared = std::move(prepared);
        take_over(skin);
        return;
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::out_of_time) {
        throw;
      }
    }
    if (made_.used.bodies == prepare::Bodies::unite) {
      made_.used.size.judged_at_mm = made_.used.size.largest_extent_mm;
    }
  }

  /// Whether another preparation of the same size asks no more of its builder.
  [[nodiscard]] bool is_as_good(const prepare::Prepared& other) const {
    return prepare::excess(other, made_.used.simplify) <=
               prepare::excess(made_.prepared, made_.used.simplify) &&
           other.model.surface.component_count() <= made_.prepared.model.surface.component_count();
  }

  /// What is known of the prepared model.
  void describe() {
    prepare::Prepared& prepared = made_.prepared;
    if (look_) {
      prepared.look = std::make_shared<const mesh::Look>(std::move(*look_), prepared.from_model.factor,
                                                         prepared.from_model.shift);
    }
    if (relief_) {
      in_stage("prepare", [&] { draw_lost_edges(); });
    }
    made_.cleanup.left_out.loose += prepared.loose;
    // Bodies that were parted are no longer those of the file, as if they had been united.
    UsedOptions& used = made_.used;
    const bool parted_before = options_.edges.from && used.simplify.part_attached;
    used.simplify.part_attached = prepared.attached > 0 || parted_before;
    used.bodies = used.simplify.part_attached ? prepare::Bodies::unite : used.bodies;
    made_.searched_with = settings_of(options_, used, made_.seed);
    made_.slivers = prepare::count_slivers(prepared.model.surface, prepared.panels);
  }

  /// As far as anything may have moved: by simplification, and by what was left out as too small.
  void draw_lost_edges() {
    prepare::Prepared& prepared = made_.prepared;
    const mesh::Relief relief(std::move(*relief_), prepared.from_model.factor, prepared.from_model.shift);
    const double reach = std::max(prepared.simplified.deviation_mm, made_.used.simplify.tiny_edge_mm);
    prepared.lost_edges =
        export_::find_lost_edges(prepared, relief, reach, options_.style.hidden_fold_angle, context_);
  }

  /// Not for edges that are named: other faces don't have them.
  void look_for_remedies() {
    if (!asked_ || options_.edges.from || !needs_remedies(made_.prepared, made_.used)) {
      return;
    }
    in_stage("prepare", [&] {
      const Context in_time = until_deadline(context_, judging_share);
      made_.remedies =
          find_remedies(*asked_, made_.prepared, made_.used, [&](mesh::Model model, const UsedOptions& used) {
            OneSkin skin;
            skin.model = std::move(model);
            if (options_.bodies == prepare::Bodies::unite) {
              skin = one_skin(std::move(skin.model), used.size, used.simplify, in_time);
            }
            return prepare::prepare_as_asked(std::move(skin.model), used.size, used.simplify,
                                             panel_room(options_), in_time);
          });
    });
    asked_.reset();
  }

  void require_buildable() const {
    if (options_.strict && !prepare::can_be_folded(made_.prepared)) {
      throw Error(ErrorKind::unbuildable, *verdict(made_.prepared, made_.remedies));
    }
  }

  void remark_beforehand() {
    if (options_.paper) {
      const mesh::Surface& surface = made_.prepared.model.surface;
      remark(many_bodies(surface));
      remark(short_folds(made_.prepared, options_.style.hidden_fold_angle));
      remark_pages(many_pages(surface, area_, prepare::expected_pages(made_.prepared, area_), false));
    }
  }

  /// Parts, nets, their tabs, and the order in which they are put together.
  void unfold() {
    const mesh::Surface& surface = made_.prepared.model.surface;
    made_.constraints = clock_("prepare", context_, [&] {
      return constraints_of(options_.edges, made_.prepared, context_, notes_);
    });
    if (options_.paper) {
      note_divided_panels(made_.prepared, notes_);
      note_stiff_board(made_.prepared, options_, made_.used.simplify.rolls.least_radius_mm, notes_);
      part_by_labels(page_labels(made_.prepared.model, options_.page_by), made_.prepared, made_.constraints);
    }
    Parts parts = clock_("segment", context_, [&] { return find_parts(made_.prepared, options_, context_); });
    made_.part = std::move(parts.of_face);
    made_.parts_given_up = parts.given_up;
    made_.part_count = count_parts(made_.part);
    made_.nets = clock_("unfold", context_, [&] {
      return unfold::unfold(surface, made_.prepared.panels, made_.part,
                            unfold_options(options_, made_.prepared, made_.constraints), context_);
    });
    if (options_.tabs.wanted && options_.tab_choice.any()) {
      give_new_tabs(made_, clock_, context_);
    }
    made_.nets.notes.insert(made_.nets.notes.begin(), notes_.begin(), notes_.end());
    made_.early_notes = std::move(notes_);
    made_.assembly = clock_("unfold", context_, [&] { return assembly_of(made_); });
  }

  void fill_pages() {
    lay_out_pages(made_, clock_, context_);
    remark_pages(
        many_pages(made_.prepared.model.surface, area_, static_cast<double>(made_.pages.count), true));
    draw_pages(made_, clock_, context_);
  }

  const Options& options_;
  const Context& context_;
  const Listener& listener_;
  Vec2 area_;  ///< of a page that pieces may fill, mm
  Result made_;
  StageClock clock_;
  std::vector<Message> notes_;
  std::optional<mesh::LookParts> look_;
  std::optional<mesh::ReliefParts> relief_;
  std::optional<mesh::Model> as_read_;  ///< where it may have to be judged at another size
  std::optional<mesh::Model> asked_;    ///< where other options may have to be tried
  mesh::Surface united_;                ///< what it became at the usual size, then
  bool pages_remarked_ = false;
};

}  // namespace

Result run(mesh::Model model, const Options& options, const Context& context, const Listener& listener) {
  if (model.surface.face_count() > most_judged_faces) {
    return Run(options, context, listener).run(std::move(model));
  }
  return next_best(options, context, [&](const Options& changed, const Context& of_attempt) {
    return Run(changed, of_attempt, listener).run(model);
  });
}

export_::Guide guide_of(const Result& made, const Context& context) {
  return drawn_guide(made, context);
}

Result with_tabs(Result made, const unfold::TabOptions& tabs, const Context& context) {
  const bool were_split = made.options.tabs.split_pieces;
  made.options.tabs = tabs;
  made.options.tabs.split_pieces = were_split;
  made.edits = with_new_pages(made.edits);
  StageClock clock = clock_of(made);
  // Numbers may be those of nets that were edited.
  const IdVector<JoinId, unfold::Join> before = made.nets.joins;
  give_new_tabs(made, clock, context);
  unfold::keep_numbers(made.prepared.model.surface, before, made.nets);
  return with_new_nets(std::move(made), std::move(clock), context);
}

unfold::Nets tabbed(const Result& made, unfold::Nets nets, const unfold::TabChoice& choice,
                    const Context& context) {
  const unfold::Options options = unfold_options(made.options, made.prepared, {});
  unfold::replace_tabs({made.prepared.model.surface, made.prepared.panels, options, choice}, nets, context);
  nets.notes = made.early_notes;
  return nets;
}

Result with_nets(Result made, unfold::Nets nets, std::optional<export_::Pages> pages, std::string edits,
                 const Context& context) {
  made.nets = std::move(nets);
  made.edits = std::move(edits);
  StageClock clock = clock_of(made);
  made.assembly = clock("unfold", context, [&] { return assembly_of(made); });
  return with_new_nets(std::move(made), std::move(clock), context, std::move(pages));
}

Result with_pages(Result made, const export_::Paper& paper, const export_::Style& style,
                  const Context& context) {
  made.options.paper = paper;
  made.options.style = style;
  made.edits = with_new_pages(made.edits);
  StageClock clock = clock_of(made);
  return with_new_nets(std::move(made), std::move(clock), context);
}

}  // namespace ridgecraft::job
