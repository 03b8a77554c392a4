// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/unfold_runs.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

#include "unfold/net/tolerance.hpp"
#include "unfold/pieces/fewest_pieces.hpp"
#include "unfold/search/net_search.hpp"

namespace ridgecraft::bench {
namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

std::vector<FaceId> all_faces(const mesh::Surface& surface) {
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(f);
  }
  return faces;
}

void run(const mesh::Surface& surface, std::span<const FaceId> faces, const Runs& runs, Row& row) {
  prepare::Panels panels;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    panels.panel.push_back(PanelId(f.value()));
  }
  for (int seed = 1; seed <= runs.seeds; ++seed) {
    Context context;
    if (runs.limit > 0.0) {
      context.deadline = Deadline::in(runs.limit);
    }
    const double start = cpu_seconds();
    const unfold::Patch patch = unfold::make_patch(surface, panels, faces);
    unfold::NetSearch options;
    options.tolerance = unfold::search_tolerance * patch.extent;
    options.iterations = unfold::iteration_budget(patch.size());
    options.idle = unfold::idle_iterations(patch.size());
    const unfold::NetFound found =
        unfold::find_net(patch, options, static_cast<std::uint64_t>(seed), context);
    unfold::FewestPieces few{found.folds, 1, 1};
    if (found.overlaps > 0) {
      few = unfold::fewest_pieces(patch, found, options.tolerance, static_cast<std::uint64_t>(seed), context);
    }
    row.seconds.push_back(cpu_seconds() - start);
    row.iterations.push_back(static_cast<double>(found.iterations));
    if (few.pieces > 1) {
      row.pieces_left.push_back(few.pieces);
      continue;
    }
    ++row.solved;
    if (runs.check) {
      ++row.checked;
      row.false_successes += is_net(surface, patch, few.folds, options.tolerance) ? 0U : 1U;
    }
  }
}

void add(const Row& from, Row& to) {
  to.faces += from.faces;
  to.solved += from.solved;
  to.checked += from.checked;
  to.false_successes += from.false_successes;
  to.seconds.insert(to.seconds.end(), from.seconds.begin(), from.seconds.end());
  to.iterations.insert(to.iterations.end(), from.iterations.begin(), from.iterations.end());
  to.pieces_left.insert(to.pieces_left.end(), from.pieces_left.begin(), from.pieces_left.end());
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace ridgecraft::bench
