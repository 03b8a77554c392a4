// SPDX-License-Identifier: GPL-3.0-or-later
// The stage as a whole: patches in parallel, then one set of pieces.
#include "unfold/unfold.hpp"

#include <algorithm>
#include <map>

#include "base/convex_hull.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"
#include "base/rectangle.hpp"
#include "unfold/folded_flat.hpp"
#include "unfold/folding/fold_order.hpp"
#include "unfold/net/joins.hpp"
#include "unfold/net/tolerance.hpp"
#include "unfold/panel_parts.hpp"
#include "unfold/patch/check.hpp"
#include "unfold/patch/layout.hpp"
#include "unfold/pieces/better_trees.hpp"
#include "unfold/pieces/closing.hpp"
#include "unfold/pieces/fitting_panels.hpp"
#include "unfold/pieces/kept_edges.hpp"
#include "unfold/pieces/linear_split.hpp"
#include "unfold/pieces/part_merging.hpp"
#include "unfold/pieces/patch_nets.hpp"
#include "unfold/pieces/tab_split.hpp"
#include "unfold/tabs/place/fit.hpp"
#include "unfold/tabs/place/place_tabs.hpp"

namespace ridgecraft::unfold {
namespace {

/// Flat models of more faces aren't searched for fewer pieces: in their layers everything overlaps, so each
/// search would take all the time it may, some twenty seconds for 800 polygons, and nobody builds the result.
constexpr std::size_t most_flat_faces = 300;

/// One connected patch of one part.
struct Task {
  PartId part;                             ///< of its first face
  PieceReason reason = PieceReason::part;  ///< why it isn't one with others of its part
  std::vector<FaceId> faces;
};

/// What is settled before anything is unfolded.
struct Plan {
  prepare::Panels panels;         ///< those that are larger than the sheet divided
  EdgeWishes wishes;              ///< those that can come true
  IdVector<FaceId, PartId> part;  ///< what is to be kept together lies in one
  std::vector<std::string> notes;
};

/// The whole surface as a forest. Face i of the patch is face i of the surface.
struct Forest {
  Patch patch;
  Folds folds;
  std::vector<PieceReason> cause;  ///< per face: why the piece in which unfolding left it is one
  std::vector<std::string> notes;
};

/// What splitting for tabs came to.
struct SplitForTabs {
  std::size_t pieces = 0;  ///< more than before
  bool in_time = true;     ///< all that was to be tried was
};

/// A piece before it has its place in the order of all.
struct Draft {
  std::vector<std::uint32_t> faces;
  PartId part;  ///< most of its area belongs to
  double area = 0.0;
  PieceReason reason = PieceReason::part;
};

std::vector<Task> make_tasks(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part,
                             const Plan& plan) {
  std::uint32_t parts = 0;
  for (const PartId p : plan.part) {
    parts = std::max(parts, p.value() + 1);
  }
  IdVector<PartId, std::vector<FaceId>> faces(parts);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces[plan.part[f]].push_back(f);
  }
  std::vector<Task> tasks;
  for (const PartId p : ids<PartId>(parts)) {
    const bool one_without_wishes = !plan.wishes.empty() && connected(surface, faces[p]).size() == 1;
    const PieceReason beside_first = one_without_wishes ? PieceReason::request : PieceReason::component;
    PieceReason reason = PieceReason::part;
    for (auto& patch : connected(surface, faces[p], plan.wishes.items())) {
      tasks.push_back({part[patch.front()], reason, std::move(patch)});
      reason = beside_first;
    }
  }
  return tasks;
}

/// Faces that no sheet holds can't be cut from any.
void refuse_large_faces(const mesh::Surface& surface, const Options& options) {
  if (!options.sheet) {
    return;
  }
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    const Triangle t = flat_shape(surface.point(a), surface.point(b), surface.point(c));
    if (!angle_to_fit(convex_hull({t.begin(), t.end()}), *options.sheet)) {
      throw Error(ErrorKind::no_nets,
                  "face " + std::to_string(f.value()) + " is larger than the printable area of the paper");
    }
  }
}

Room room_of(const Options& options) {
  return {options.sheet, options.tabs.wanted ? options.tabs.height_mm : 0.0, options.pieces.max_panels};
}

Plan make_plan(const mesh::Surface& surface, const prepare::Panels& panels,
               const IdVector<FaceId, PartId>& part, const Options& options, const Context& context) {
  Plan plan;
  plan.panels = fitting_panels(surface, panels, room_of(options), context, plan.notes);
  plan.part = part;
  if (options.wishes.empty()) {
    return plan;
  }
  const Vec3 size = surface.bounds().size();
  const double tolerance = net_tolerance(std::max({size.x, size.y, size.z}));
  KeptEdges kept = settle_wishes(surface, plan.panels, options.wishes, room_of(options), tolerance, context);
  plan.wishes = std::move(kept.wishes);
  plan.part = parts_of_whole_panels(surface, kept.groups, part);
  return plan;
}

/// Each patch of each part by itself.
Forest unfold_parts(const mesh::Surface& surface, const Plan& plan, const std::vector<Task>& tasks,
                    const Options& options, const Context& context) {
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(f);
  }
  Forest forest{make_patch(surface, plan.panels, faces, plan.wishes.items()),
                Folds(3 * faces.size(), 0),
                std::vector<PieceReason>(faces.size(), PieceReason::part),
                {}};
  const Room room = room_of(options);
  std::vector<PatchNets> nets(tasks.size());
  do_in_parallel(
      tasks.size(), context,
      [&](std::size_t i, const Context& own) {
        Random seed(context.seed ^ (0x9e3779b97f4a7c15ULL * (i + 1)));
        const Patch patch = make_patch(surface, plan.panels, tasks[i].faces, plan.wishes.items());
        nets[i] =
            unfold_patch(patch, room, options.panel_cuts, net_tolerance(patch.extent), seed.next(), own);
        // Tasks have faces of their own, so they write to places of their own.
        const Layout layout = lay_out(patch, nets[i].folds);
        for (std::uint32_t f = 0; f < patch.size(); ++f) {
          const std::uint32_t face = tasks[i].faces[f].value();
          const PieceReason reason = nets[i].reason[layout.piece[f]];
          forest.cause[face] = reason == PieceReason::part ? tasks[i].reason : reason;
          for (std::uint32_t k = 0; k < 3; ++k) {
            forest.folds[3 * face + k] = nets[i].folds[3 * f + k];
          }
        }
      },
      [&](std::size_t done) {
        context.report("unfold", 0.7 * static_cast<double>(done) / static_cast<double>(tasks.size()));
      });
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    for (const std::string& note : nets[t].notes) {
      forest.notes.push_back("part " + std::to_string(tasks[t].part.value()) + ": " + note);
    }
  }
  return forest;
}

/// The cause that most of these faces have, those of pieces that stood for a part left out; `otherwise` where
/// there is none.
PieceReason most_frequent_cause(const Forest& forest, const std::vector<std::uint32_t>& faces,
                                PieceReason otherwise) {
  std::map<PieceReason, std::size_t> count;
  for (const std::uint32_t f : faces) {
    if (forest.cause[f] != PieceReason::part) {
      ++count[forest.cause[f]];
    }
  }
  const auto most = std::max_element(count.begin(), count.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == count.end() ? otherwise : most->first;
}

/// The largest piece of each part stands for it; why is any other one there?
void find_reasons(const Forest& forest, const IdVector<FaceId, PartId>& part, std::vector<Draft>& drafts) {
  std::map<PartId, std::vector<std::uint32_t>> faces_of;
  for (const FaceId f : ids<FaceId>(part.size())) {
    faces_of[part[f]].push_back(f.value());
  }
  std::map<PartId, PieceReason> usual;
  for (const auto& [p, faces] : faces_of) {
    usual[p] = most_frequent_cause(forest, faces, PieceReason::page);
  }
  for (std::size_t i = 1; i < drafts.size(); ++i) {
    if (drafts[i].part == drafts[i - 1].part) {
      drafts[i].reason = most_frequent_cause(forest, drafts[i].faces, usual[drafts[i].part]);
    }
  }
}

/// Pieces by part, large ones first.
std::vector<Draft> order_pieces(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part,
                                const Layout& layout) {
  std::vector<Draft> drafts;
  for (const auto& faces : layout.faces) {
    Draft& draft = drafts.emplace_back();
    draft.faces = faces;
    std::sort(draft.faces.begin(), draft.faces.end());
    std::map<PartId, double> area;
    for (const std::uint32_t f : draft.faces) {
      area[part[FaceId(f)]] += surface.area(FaceId(f));
      draft.area += surface.area(FaceId(f));
    }
    draft.part = std::max_element(area.begin(), area.end(), [](const auto& a, const auto& b) {
                   return a.second < b.second;
                 })->first;
  }
  std::stable_sort(drafts.begin(), drafts.end(), [](const Draft& a, const Draft& b) {
    return a.part != b.part ? a.part < b.part : a.area > b.area;
  });
  return drafts;
}

/// The forest with other folds as nets: nothing but tabs and joins is missing.
Nets assemble(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part, const Forest& forest,
              const Folds& folds) {
  Nets nets;
  nets.use = IdVector<EdgeId, EdgeUse>(surface.edge_count(), EdgeUse::cut);
  nets.piece = IdVector<FaceId, PieceId>(surface.face_count());
  nets.flat = IdVector<FaceId, std::array<Vec2, 3>>(surface.face_count());
  nets.notes = forest.notes;
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (surface.is_border(e)) {
      nets.use[e] = EdgeUse::border;
    }
  }
  const Layout layout = lay_out(forest.patch, folds);
  std::vector<Draft> drafts = order_pieces(surface, part, layout);
  find_reasons(forest, part, drafts);
  for (const Draft& draft : drafts) {
    Piece piece;
    piece.name = piece_name(nets.pieces.size());
    piece.reason = draft.reason;
    const PieceId id(nets.pieces.size());
    for (const std::uint32_t f : draft.faces) {
      const FaceId face(f);
      piece.faces.push_back(face);
      piece.parts.push_back(part[face]);
      nets.piece[face] = id;
      nets.flat[face] = layout.flat[f];
      for (unsigned k = 0; k < 3; ++k) {
        if (folds[3 * f + k] != 0) {
          nets.use[surface.edge(mesh::corner(face, k))] = EdgeUse::fold;
        }
      }
    }
    std::sort(piece.parts.begin(), piece.parts.end());
    piece.parts.erase(std::unique(piece.parts.begin(), piece.parts.end()), piece.parts.end());
    nets.pieces.push_back(std::move(piece));
  }
  return nets;
}

void note_broken_wishes(const EdgeWishes& wishes, Nets& nets) {
  std::size_t broken = 0;
  for (const EdgeId e : ids<EdgeId>(wishes.size())) {
    broken += wishes[e] == EdgeWish::keep && nets.use[e] == EdgeUse::cut ? 1U : 0U;
  }
  if (broken > 0) {
    nets.notes.push_back(std::to_string(broken) + (broken == 1 ? " edge that was" : " edges that were") +
                         " to be kept are cut: as folds they would close a loop, overlap or fit no page");
  }
}

void note_all_tabs(const mesh::Surface& surface, const TabOptions& options, const SplitForTabs& split,
                   Nets& nets) {
  const auto count = [](auto number, const char* one, const char* more) {
    return std::to_string(number) + (number == 1 ? one : more);
  };
  const auto narrow =
      std::count_if(nets.joins.begin(), nets.joins.end(), [](const Join& join) { return join.too_narrow; });
  const auto crowded =
      static_cast<std::ptrdiff_t>(nets.joins.size() - tabs_usable(surface, nets, options)) - narrow;
  std::string note =
      split.pieces == 0 ? "no piece had to be" : count(split.pieces, " piece was", " pieces were");
  note += " split off for tabs";
  if (narrow > 0) {
    note += "; " +
            count(narrow, " edge is too short, or the faces behind it",
                  " edges are too short, or the faces behind them") +
            " too narrow, for a tab that holds";
  }
  if (crowded > 0) {
    note += "; " + count(crowded, " edge has", " edges have") +
            (split.in_time ? " no room for a tab even so" : " no room for a tab yet");
  }
  if (!split.in_time) {
    note += "; the time given was up before all ways to split were tried";
  }
  nets.notes.push_back(std::move(note));
}

/// What searches for fewer pieces and better trees get: no time where the model is flat. That is noted.
Context for_searches(const mesh::Surface& surface, const Context& context, std::vector<std::string>& notes) {
  Context searching = context;
  if (!is_folded_flat(surface)) {
    return searching;
  }
  std::string note = "the model is flat: its faces lie on each other in one plane";
  if (surface.face_count() > most_flat_faces) {
    searching.deadline = Deadline::in(0.0);
    note += ", so no time is spent on fewer pieces";
  }
  notes.push_back(std::move(note));
  return searching;
}

/// The promise of the header, checked on what is about to be returned.
void insist_on_no_overlap(const Nets& nets) {
  std::vector<Triangle> triangles;
  for (const Piece& piece : nets.pieces) {
    triangles.clear();
    for (const FaceId f : piece.faces) {
      triangles.push_back(nets.flat[f]);
    }
    if (!find_overlaps(triangles, overlap_tolerance_mm).empty()) {
      throw Error(ErrorKind::internal, "the net of piece " + piece.name + " overlaps itself");
    }
  }
}

/// The pieces that were split off others, but for the largest of each, are there for this reason. Their
/// number.
std::size_t blame(PieceReason reason, const Folds& split, Forest& forest) {
  const Layout before = lay_out(forest.patch, forest.folds);
  const Layout after = lay_out(forest.patch, split);
  std::vector<std::uint32_t> largest(before.faces.size(), nothing);
  for (std::uint32_t piece = 0; piece < after.faces.size(); ++piece) {
    std::uint32_t& other = largest[before.piece[after.faces[piece].front()]];
    if (other == nothing ||
        area_of(forest.patch, after.faces[piece]) > area_of(forest.patch, after.faces[other])) {
      other = piece;
    }
  }
  for (std::uint32_t f = 0; f < forest.patch.size(); ++f) {
    if (largest[before.piece[f]] != after.piece[f]) {
      forest.cause[f] = reason;
    }
  }
  return after.faces.size() - before.faces.size();
}

/// Pieces are split until every edge that is wide enough has a usable tab.
SplitForTabs give_all_tabs(const mesh::Surface& surface, const prepare::Panels& panels,
                           const IdVector<FaceId, PartId>& part, const Plan& plan, const Options& options,
                           Forest& forest, const Context& context) {
  if (context.out_of_time()) {
    return {0, false};
  }
  const NetsOf nets_of = [&](const Folds& folds) {
    Nets nets = assemble(surface, part, forest, folds);
    close_flat_cuts(surface, panels, plan.wishes, nets);
    replace_tabs(surface, panels, options, nets, context);
    return nets;
  };
  TabSplit split = split_for_tabs(surface, panels, forest.patch, forest.folds, room_of(options), options.tabs,
                                  nets_of, net_tolerance(forest.patch.extent), context.seed, context);
  const std::size_t pieces = blame(PieceReason::tabs, split.folds, forest);
  forest.folds = std::move(split.folds);
  return {pieces, !context.out_of_time()};
}

/// Pieces are split until each folds up with all creases together. That is noted.
void make_fold_together(const Options& options, Forest& forest, const Context& context) {
  const LinearSplit split = split_to_fold_together(forest.patch, forest.folds, room_of(options),
                                                   net_tolerance(forest.patch.extent), context.seed, context);
  const std::size_t pieces = blame(PieceReason::folding, split.folds, forest);
  forest.folds = split.folds;
  forest.notes.push_back((pieces == 0   ? std::string("no piece had to be")
                          : pieces == 1 ? std::string("1 piece was")
                                        : std::to_string(pieces) + " pieces were") +
                         " split off so that all fold up with all creases together");
}

/// What --fold-linear asks for and the finished nets don't have.
void note_not_linear(Nets& nets) {
  const auto others = std::count_if(nets.pieces.begin(), nets.pieces.end(), [](const Piece& piece) {
    return piece.folding.way != FoldWay::together;
  });
  if (others > 0) {
    nets.notes.push_back(std::to_string(others) + (others == 1 ? " piece doesn't" : " pieces don't") +
                         " fold up with all creases together all the same: edges that were to be kept are in "
                         "the way of splitting further");
  }
}

}  // namespace

Nets unfold(const mesh::Surface& surface, const prepare::Panels& panels, const IdVector<FaceId, PartId>& part,
            const Options& options, const Context& context) {
  context.check();
  context.report("unfold", 0.0);
  refuse_large_faces(surface, options);
  Plan plan = make_plan(surface, panels, part, options, context);
  const Context searching = for_searches(surface, context, plan.notes);
  Forest forest = unfold_parts(surface, plan, make_tasks(surface, part, plan), options, searching);
  forest.notes.insert(forest.notes.begin(), plan.notes.begin(), plan.notes.end());
  if (options.pieces.merge) {
    forest.folds =
        merge_parts(forest.patch, part.items(), forest.folds, room_of(options), options.pieces.weights,
                    net_tolerance(forest.patch.extent), context.seed, searching);
  }
  forest.folds =
      better_trees(surface, plan.panels, forest.patch, forest.folds, options, room_of(options), searching);
  if (options.tabs.wanted && context.out_of_time()) {
    forest.notes.emplace_back("the time given was up before all nets with more tabs were tried");
  }
  SplitForTabs split;
  if (options.tabs.wanted && options.tabs.split_pieces) {
    split = give_all_tabs(surface, panels, part, plan, options, forest, context);
  }
  if (options.pieces.fold_linear) {
    make_fold_together(options, forest, context);
  }
  Nets nets = assemble(surface, part, forest, forest.folds);
  close_flat_cuts(surface, panels, plan.wishes, nets);
  note_broken_wishes(options.wishes, nets);
  count_holes(surface, nets);
  insist_on_no_overlap(nets);
  do_in_parallel(nets.pieces.size(), context, [&](std::size_t i, const Context& own) {
    nets.pieces[PieceId(i)].folding = find_fold_order(surface, nets, PieceId(i), own);
  });
  if (options.pieces.fold_linear) {
    note_not_linear(nets);
  }
  replace_tabs(surface, panels, options, nets, context);
  if (options.tabs.wanted && options.tabs.split_pieces) {
    note_all_tabs(surface, options.tabs, split, nets);
  }
  return nets;
}

void replace_tabs(const mesh::Surface& surface, const prepare::Panels& panels, const Options& options,
                  Nets& nets, const Context& context) {
  nets.tabs = {};
  number_joins(surface, nets);
  if (options.tabs.wanted) {
    place_tabs(surface, panels, options.tabs, nets, context);
    if (options.sheet) {
      fit_tabs_to_sheet(surface, panels, options.tabs, *options.sheet, nets, context);
    }
  }
}

}  // namespace ridgecraft::unfold
