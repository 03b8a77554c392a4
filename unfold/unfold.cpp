// SPDX-License-Identifier: GPL-3.0-or-later
// The stage as a whole: patches in parallel, then one set of pieces.
#include "unfold/unfold.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

#include "mesh/error.hpp"
#include "unfold/check.hpp"
#include "unfold/closing.hpp"
#include "unfold/fitting_panels.hpp"
#include "unfold/joins.hpp"
#include "unfold/layout.hpp"
#include "unfold/patch_nets.hpp"
#include "unfold/sheet.hpp"
#include "unfold/tab_fit.hpp"
#include "unfold/tab_pieces.hpp"
#include "unfold/tabs.hpp"
#include "unfold/tolerance.hpp"

namespace ridgecraft::unfold {
namespace {

/// One connected patch of one part.
struct Task {
  PartId part;
  std::uint32_t component = 0;  ///< counted within the part
  std::vector<FaceId> faces;
};

struct Done {
  Layout layout;
  Folds folds;
  Patch patch;
  std::vector<PieceReason> reason;
  std::vector<std::string> notes;
};

/// A piece before it has its place in the order of all.
struct Draft {
  std::size_t task = 0;
  std::uint32_t piece = 0;
  double area = 0.0;
};

std::vector<Task> make_tasks(const mesh::Surface& surface, const IdVector<FaceId, PartId>& part) {
  std::uint32_t parts = 0;
  for (const PartId p : part) {
    parts = std::max(parts, p.value() + 1);
  }
  IdVector<PartId, std::vector<FaceId>> faces(parts);
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces[part[f]].push_back(f);
  }
  std::vector<Task> tasks;
  for (const PartId p : ids<PartId>(parts)) {
    std::uint32_t component = 0;
    for (auto& patch : connected(surface, faces[p])) {
      tasks.push_back({p, component++, std::move(patch)});
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
  return {options.sheet, options.tabs.wanted ? options.tabs.height_mm : 0.0, options.max_panels};
}

Done do_task(const mesh::Surface& surface, const mesh::Panels& panels, const Task& task,
             const Options& options, std::uint64_t seed, const Context& context) {
  Done done;
  done.patch = make_patch(surface, panels, task.faces);
  const Room room = room_of(options);
  // Half of what the finished nets may show, whatever the model's size.
  const double tolerance = std::min(search_tolerance * done.patch.extent, 0.5 * overlap_tolerance_mm);
  PatchNets nets = unfold_patch(done.patch, room, options.panel_cuts, tolerance, seed, context);
  if (options.tabs.wanted) {
    nets.folds =
        improve_tabs(surface, panels, done.patch, nets.folds, room, options.tabs, tolerance, ~seed, context);
  }
  done.folds = std::move(nets.folds);
  done.reason = std::move(nets.reason);
  done.notes = std::move(nets.notes);
  done.layout = lay_out(done.patch, done.folds);
  return done;
}

/// Works on the tasks with as many threads as asked; each result has its own slot and each task its own seed,
/// so the number of threads changes nothing.
std::vector<Done> do_all(const mesh::Surface& surface, const mesh::Panels& panels,
                         const std::vector<Task>& tasks, const Options& options, const Context& context) {
  std::vector<Done> done(tasks.size());
  std::atomic<std::size_t> next{0};
  const std::size_t workers = std::min<std::size_t>(context.threads, std::max<std::size_t>(tasks.size(), 1));
  // Threads that have no task of their own help where a task can use them.
  Context own = context;
  own.threads = static_cast<unsigned>(std::max<std::size_t>(context.threads / std::max<std::size_t>(workers, 1), 1));
  std::size_t finished = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < tasks.size(); i = next++) {
      try {
        Random seed(context.seed ^ (0x9e3779b97f4a7c15ULL * (i + 1)));
        done[i] = do_task(surface, panels, tasks[i], options, seed.next(), own);
      } catch (...) {
        const std::lock_guard lock(mutex);
        failure = failure ? failure : std::current_exception();
        next = tasks.size();
        return;
      }
      const std::lock_guard lock(mutex);
      context.report("unfold", static_cast<double>(++finished) / static_cast<double>(tasks.size()));
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < workers; ++t) {
      try {
        others.emplace_back(work);
      } catch (const std::system_error&) {
        break;  // no more threads to be had: those there are do it all
      }
    }
    work();
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
  return done;
}

/// Pieces by part, large ones first.
std::vector<Draft> order_pieces(const mesh::Surface& surface, const std::vector<Task>& tasks,
                                const std::vector<Done>& done) {
  std::vector<Draft> drafts;
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    for (std::uint32_t p = 0; p < done[t].layout.faces.size(); ++p) {
      Draft& draft = drafts.emplace_back(Draft{t, p, 0.0});
      for (const std::uint32_t f : done[t].layout.faces[p]) {
        draft.area += surface.area(tasks[t].faces[f]);
      }
    }
  }
  std::stable_sort(drafts.begin(), drafts.end(), [&](const Draft& a, const Draft& b) {
    const PartId pa = tasks[a.task].part;
    const PartId pb = tasks[b.task].part;
    return pa != pb ? pa < pb : a.area > b.area;
  });
  return drafts;
}

Nets assemble(const mesh::Surface& surface, const std::vector<Task>& tasks, const std::vector<Done>& done) {
  Nets nets;
  nets.use = IdVector<EdgeId, EdgeUse>(surface.edge_count(), EdgeUse::cut);
  nets.piece = IdVector<FaceId, PieceId>(surface.face_count());
  nets.flat = IdVector<FaceId, std::array<Vec2, 3>>(surface.face_count());
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    if (surface.is_border(e)) {
      nets.use[e] = EdgeUse::border;
    }
  }
  for (const Draft& draft : order_pieces(surface, tasks, done)) {
    const Task& task = tasks[draft.task];
    const Done& from = done[draft.task];
    Piece piece;
    piece.name = piece_name(nets.pieces.size());
    piece.parts = {task.part};
    piece.reason = from.reason[draft.piece];
    if (piece.reason == PieceReason::part && task.component > 0) {
      piece.reason = PieceReason::component;
    }
    const PieceId id(nets.pieces.size());
    for (const std::uint32_t f : from.layout.faces[draft.piece]) {
      const FaceId face = task.faces[f];
      piece.faces.push_back(face);
      nets.piece[face] = id;
      nets.flat[face] = from.layout.flat[f];
      for (unsigned k = 0; k < 3; ++k) {
        if (from.folds[3 * f + k] != 0) {
          nets.use[surface.edge(mesh::corner(face, k))] = EdgeUse::fold;
        }
      }
    }
    std::sort(piece.faces.begin(), piece.faces.end());
    nets.pieces.push_back(std::move(piece));
  }
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    for (const std::string& note : done[t].notes) {
      nets.notes.push_back("part " + std::to_string(tasks[t].part.value()) + ": " + note);
    }
  }
  return nets;
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

}  // namespace

Nets unfold(const mesh::Surface& surface, const mesh::Panels& panels, const IdVector<FaceId, PartId>& part,
            const Options& options, const Context& context) {
  context.check();
  context.report("unfold", 0.0);
  refuse_large_faces(surface, options);
  const std::vector<Task> tasks = make_tasks(surface, part);
  std::vector<std::string> notes;
  const mesh::Panels fitting = fitting_panels(surface, panels, room_of(options), context, notes);
  Nets nets = assemble(surface, tasks, do_all(surface, fitting, tasks, options, context));
  nets.notes.insert(nets.notes.begin(), notes.begin(), notes.end());
  close_flat_cuts(surface, panels, nets);
  count_holes(surface, nets);
  insist_on_no_overlap(nets);
  number_joins(surface, nets);
  if (options.tabs.wanted) {
    place_tabs(surface, panels, options.tabs, nets, context);
    if (options.sheet) {
      drop_tabs_beyond_sheet(*options.sheet, nets);
    }
  }
  return nets;
}

}  // namespace ridgecraft::unfold
