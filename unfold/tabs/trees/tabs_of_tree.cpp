// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tabs/trees/tabs_of_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/boxes.hpp"
#include "base/error.hpp"
#include "unfold/tabs/place/sites.hpp"
#include "unfold/tabs/shape/convex_shape.hpp"
#include "unfold/tabs/shape/shapes.hpp"

namespace ridgecraft::unfold {
namespace {

/// More folds behind one tab are hardly ever all there.
constexpr std::size_t most_folds_behind = 4;

class TargetFinder {
 public:
  TargetFinder(const mesh::Surface& surface, const prepare::Panels& panels, const TabOptions& options)
      : surface_(surface), panels_(panels), options_(options) {}

  /// Sides of the panel behind c's twin that a tab on c might run over, in the frame of tab shapes.
  [[nodiscard]] std::vector<Obstacle> outline(CornerId c) const {
    std::vector<Obstacle> result;
    const CornerId twin = surface_.twin(c);
    const ConvexShape widest = widest_tab(surface_.length(surface_.edge(c)), options_);
    const FaceId g = mesh::face_of(twin);
    if (widest.empty() || !options_.inside_target) {
      return result;
    }
    const Vec3 origin = surface_.point(surface_.vertex(twin));
    const Vec3 along = normalized(surface_.point(surface_.vertex(mesh::next(twin))) - origin);
    const Vec3 inward = cross(surface_.normal(g), along);
    const auto flat = [&](CornerId corner) {
      const Vec3 away = surface_.point(surface_.vertex(corner)) - origin;
      return Vec2{dot(away, along), dot(away, inward)};
    };
    if (flat(mesh::previous(twin)).y < least_target_mm) {
      return {no_target(surface_.length(surface_.edge(c)))};
    }
    for (const FaceId f : panels_.faces[panels_.panel[g]]) {
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId edge = mesh::corner(f, k);
        if (edge == twin || !leads_out(edge)) {
          continue;
        }
        const ConvexShape segment{flat(edge), flat(mesh::next(edge))};
        if (meet(segment.box(), widest.box()) && !apart(widest, segment, 0.0)) {
          result.push_back({segment, Obstacle::Kind::target_edge});
        }
      }
    }
    return result;
  }

  /// What lies behind a tab on c, of the patch, as long as it is bent by no more than a tab follows.
  struct Chain {
    std::vector<Obstacle> outline;      ///< in the frame of tab shapes
    std::vector<std::uint32_t> across;  ///< sides of the patch that lie inside it, one of each
  };
  [[nodiscard]] Chain chain(const Patch& patch, std::uint32_t side) const {
    Chain result;
    const std::uint32_t first = patch.twin[side];
    const ConvexShape widest = widest_tab(patch.length[side], options_);
    if (first == no_index || widest.empty()) {
      return result;
    }
    struct Behind {
      std::uint32_t face;
      Rigid place;
      double bend;
    };
    // The face behind lies over the base, which runs from the start of its side to its end.
    const Triangle& t = patch.shape[first / 3];
    const Vec2 from = t[first % 3];
    const Vec2 along = (t[(first % 3 + 1) % 3] - from) / patch.length[side];
    const Rigid placed = Rigid{along.x, along.y, from}.inverse();
    std::vector<Behind> behind{{first / 3, placed, 0.0}};
    for (std::size_t i = 0; i < behind.size(); ++i) {
      const auto [face, place, bend] = behind[i];
      for (std::uint32_t s = 3 * face; s < 3 * face + 3; ++s) {
        if (s == first) {
          continue;
        }
        const ConvexShape edge{place(patch.shape[face][s % 3]), place(patch.shape[face][(s % 3 + 1) % 3])};
        if (!meet(edge.box(), widest.box()) || apart(widest, edge, -just_touching_mm)) {
          continue;
        }
        const std::uint32_t twin = patch.twin[s];
        const bool frozen = twin != no_index && patch.frozen[s] != 0;
        const double beyond = bend + (frozen ? 0.0 : std::abs(patch.fold_angle[s]));
        if (twin == no_index || beyond > most_bend_of_tab) {
          result.outline.push_back({edge, Obstacle::Kind::target_edge});
          continue;
        }
        if (!frozen) {
          result.across.push_back(std::min(s, twin));
        }
        if (std::none_of(behind.begin(), behind.end(), [&](const Behind& b) { return b.face == twin / 3; })) {
          behind.push_back({twin / 3, place * patch.across[s], beyond});
        }
      }
    }
    std::sort(result.across.begin(), result.across.end());
    result.across.erase(std::unique(result.across.begin(), result.across.end()), result.across.end());
    return result;
  }

  [[nodiscard]] ConvexShape largest(CornerId c, const std::vector<Obstacle>& outline) const {
    const double size = surface_.length(surface_.edge(c));
    return largest_tab({0.0, size, size}, outline, options_, TabNeed::usable);
  }

  [[nodiscard]] bool leads_out(CornerId c) const {
    const FaceId g = surface_.neighbor(c);
    return !g.valid() || panels_.panel[g] != panels_.panel[mesh::face_of(c)];
  }

  [[nodiscard]] double panel_area(FaceId f) const {
    double sum = 0.0;
    for (const FaceId g : panels_.faces[panels_.panel[f]]) {
      sum += surface_.area(g);
    }
    return sum;
  }

 private:
  const mesh::Surface& surface_;
  const prepare::Panels& panels_;
  const TabOptions& options_;
};

}  // namespace

TabTargets find_tab_targets(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
                            const TabOptions& options) {
  const TargetFinder finder(surface, panels, options);
  TabTargets targets;
  const std::size_t sides = patch.twin.size();
  targets.outline.resize(sides);
  targets.largest.resize(sides);
  targets.across.resize(sides);
  targets.seam.assign(sides, 0);
  for (std::uint32_t side = 0; side < sides; ++side) {
    const CornerId c = mesh::corner(patch.face[side / 3], side % 3);
    if (surface.is_border(surface.edge(c)) || !finder.leads_out(c)) {
      continue;
    }
    targets.outline[side] = finder.outline(c);
    targets.largest[side] = finder.largest(c, targets.outline[side]);
    if (targets.largest[side].empty() && options.inside_target) {
      TargetFinder::Chain chain = finder.chain(patch, side);
      if (!chain.across.empty() && chain.across.size() <= most_folds_behind) {
        targets.largest[side] = finder.largest(c, chain.outline);
        if (!targets.largest[side].empty()) {
          targets.outline[side] = std::move(chain.outline);
          targets.across[side] = std::move(chain.across);
        }
      }
    }
    if (patch.twin[side] != no_index || targets.largest[side].empty()) {
      continue;
    }
    const CornerId twin = surface.twin(c);
    const double here = finder.panel_area(mesh::face_of(c));
    const double there = finder.panel_area(mesh::face_of(twin));
    const bool first = here != there ? here < there : c < twin;
    targets.seam[side] = first || finder.largest(twin, finder.outline(twin)).empty() ? 1 : 0;
  }
  return targets;
}

namespace {

/// Two corners of faces that are one vertex and nearer than this are one corner of the net, mm: rounding.
constexpr double same_place_mm = 1e-6;
/// How many tabs one may push aside.
constexpr std::size_t most_pushed = 2;

template <std::size_t n>
Walled<n> moved(const Walled<n>& shape, const Frame& out, const Frame& in) {
  Walled<n> result;
  for (std::size_t i = 0; i < n; ++i) {
    result.corner[i] = in.in(out.out(shape.corner[i]));
  }
  result.build_walls();
  return result;
}

}  // namespace

TabState::TabState(const mesh::Surface& surface, const prepare::Panels& panels, const Patch& patch,
                   Forest& net, const TabOptions& options)
    : patch_(patch),
      net_(net),
      options_(options),
      targets_(find_tab_targets(surface, panels, patch, options)),
      candidates_(patch.twin.size()),
      behind_(patch.twin.size()),
      around_(patch.twin.size()),
      free_(patch.twin.size()),
      chosen_(patch.twin.size()),
      marked_in_(patch.twin.size(), 0) {
  vertex_.reserve(patch.twin.size());
  for (const FaceId f : patch.face) {
    for (const VertexId v : surface.vertices(f)) {
      vertex_.push_back(v.value());
    }
  }
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    candidates_[side] = tab_candidates(targets_.largest[side], patch.length[side], options);
    Box2 box;
    for (const TabCandidate& tab : candidates_[side]) {
      for (const Vec2 p : tab.whole.corner) {
        box.add(p);
        reach_ = std::max(reach_, length(p - Vec2{std::clamp(p.x, 0.0, patch.length[side]), 0.0}));
      }
    }
    for (const std::uint32_t fold : targets_.across[side]) {
      behind_[join_of(fold)].push_back(side);
    }
    if (!candidates_[side].empty()) {
      around_[side] = {0.5 * (box.low + box.high), 0.5 * length(box.size())};
    }
  }
}

Frame TabState::frame(std::uint32_t side) const {
  return {end(side), (start(side) - end(side)) / patch_.length[side]};
}

Circle TabState::circle(std::uint32_t side) const {
  return {frame(side).out(around_[side].centre), around_[side].radius};
}

/// Has the face a corner that is this vertex at this place?
bool TabState::shares(std::uint32_t vertex, Vec2 place, std::uint32_t face) const {
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (vertex_[3 * face + k] == vertex) {
      const Vec2 away = net_.flat(face)[k] - place;
      return dot(away, away) < same_place_mm * same_place_mm;
    }
  }
  return false;
}

/// Are all folds there behind which the tabs of a side lie?
bool TabState::has_folds_behind(std::uint32_t side) const {
  const std::vector<std::uint32_t>& across = targets_.across[side];
  return std::all_of(across.begin(), across.end(),
                     [this](std::uint32_t fold) { return net_.folds()[fold] != 0; });
}

/// The candidates on a side that are clear of all faces.
TabState::Mask TabState::free_among_faces(std::uint32_t side) {
  const std::vector<TabCandidate>& tabs = candidates_[side];
  if (!is_cut(side) || tabs.empty() || !has_folds_behind(side)) {
    return 0;
  }
  const Frame own = frame(side);
  const Circle near = circle(side);
  const double gap = options_.clearance_mm;
  auto free = static_cast<Mask>((1U << tabs.size()) - 1U);
  net_.visit_near(net_.tree_of(side / 3), near.centre, near.radius + gap, [&](std::uint32_t face) {
    if (face == side / 3 || free == 0) {
      return;
    }
    Walled<3> shape;
    for (std::size_t k = 0; k < 3; ++k) {
      shape.corner[k] = own.in(net_.flat(face)[k]);
    }
    if (std::max(shape.corner[0].y, std::max(shape.corner[1].y, shape.corner[2].y)) <= -gap) {
      return;
    }
    shape.build_walls();
    const bool left = shares(vertex_[3 * (side / 3) + (side % 3 + 1) % 3], end(side), face);
    const bool right = shares(vertex_[side], start(side), face);
    for (Mask rest = free; rest != 0; rest = static_cast<Mask>(rest & (rest - 1U))) {
      const auto i = static_cast<std::size_t>(std::countr_zero(rest));
      const bool common = (left && tabs[i].at_left) || (right && tabs[i].at_right);
      if (!keeps_clear(
              common, gap, [&](double least) { return walls_apart(tabs[i].whole, shape, least); },
              [&](double least) { return walls_apart(tabs[i].upper, shape, least); })) {
        free = static_cast<Mask>(free & ~(1U << i));
      }
    }
  });
  return free;
}

void TabState::choose(std::uint32_t join, const Choice& choice) {
  const bool had = chosen_[join].side != no_index;
  const bool has = choice.side != no_index;
  if (had != has) {
    count_.tabs += has ? 1U : static_cast<std::uint32_t>(-1);
    count_.bare_mm += has ? -patch_.length[join] : patch_.length[join];
  }
  chosen_.set(join, choice);
}

void TabState::mark(std::uint32_t side) {
  if (marked_in_[side] != round_ && !candidates_[side].empty()) {
    marked_in_[side] = round_;
    marked_.push_back(side);
  }
}

/// Marks the sides of a face whose tabs might meet another face.
void TabState::mark_beside(std::uint32_t face, std::uint32_t other) {
  for (std::uint32_t side = 3 * face; side < 3 * face + 3; ++side) {
    if (marked_in_[side] == round_ || candidates_[side].empty() || !is_cut(side)) {
      continue;
    }
    const Frame own = frame(side);
    Box2 box;
    for (const Vec2 p : net_.flat(other)) {
      box.add(own.in(p));
    }
    const Circle& tab = around_[side];
    const double radius = tab.radius + options_.clearance_mm;
    if (box.high.y > -options_.clearance_mm && box.low.y < options_.height_mm + options_.clearance_mm &&
        box.low.x < tab.centre.x + radius && box.high.x > tab.centre.x - radius) {
      mark(side);
    }
  }
}

/// Marks what is near between these faces and the others of a tree, and notes which tabs may have come
/// together.
void TabState::mark_near(const Forest::Span& span, std::uint32_t tree, bool pairs) {
  const double reach = 2.0 * reach_ + options_.clearance_mm;
  const auto meet = [&](std::uint32_t f, std::uint32_t g) {
    mark_beside(f, g);
    mark_beside(g, f);
    for (std::uint32_t a = 3 * f; pairs && a < 3 * f + 3; ++a) {
      for (std::uint32_t b = 3 * g; tab_on(a) != nullptr && b < 3 * g + 3; ++b) {
        if (tab_on(b) != nullptr) {
          beside_.emplace_back(a, b);
        }
      }
    }
  };
  for (std::uint32_t i = 0; i < span.count; ++i) {
    const std::uint32_t f = net_.face_in(span, i);
    const Circle& near = net_.circle(f);
    net_.visit_near(tree, near.centre, near.radius + reach, [&](std::uint32_t g) {
      if (!net_.in_span(span, g)) {
        meet(f, g);
      }
    });
  }
}

void TabState::renew_all() {
  chosen_.reset();
  free_.reset();
  count_ = {};
  undo_ = {};
  ++round_;
  marked_.clear();
  for (std::uint32_t side = 0; side < patch_.twin.size(); ++side) {
    count_.bare_mm += join_of(side) == side && is_cut(side) ? patch_.length[side] : 0.0;
    mark(side);
  }
  refresh();
  fill_open();
}

void TabState::make(const Move& move) {
  chosen_.keep();
  free_.keep();
  undo_ = {move.inverse(), count_};
  ++round_;
  marked_.clear();
  beside_.clear();
  if (move.closed != no_index && chosen_[join_of(move.closed)].side != no_index) {
    choose(join_of(move.closed), {});
  }
  count_.bare_mm += (move.opened != no_index ? patch_.length[move.opened] : 0.0) -
                    (move.closed != no_index ? patch_.length[move.closed] : 0.0);
  const Forest::Carried what = net_.carried(move);
  if (!move.joins()) {
    mark_near(what.faces, what.faces.tree, false);
  }
  const bool first_goes = !move.splits() && net_.in_span(what.faces, move.closed / 3);
  net_.make(move);
  for (const std::uint32_t side : {move.closed, move.opened}) {
    for (const std::uint32_t s : {side, side == no_index ? no_index : patch_.twin[side]}) {
      if (s != no_index) {
        mark(s);
        for (const std::uint32_t other : behind_[join_of(s)]) {
          mark(other);
        }
      }
    }
  }
  if (!move.splits()) {
    const std::uint32_t hung = (first_goes ? move.closed : patch_.twin[move.closed]) / 3;
    mark_near(net_.subtree(hung), net_.tree_of(hung), true);
  }
  refresh();
  drop_colliding();
  fill_open();
}

void TabState::take_back() {
  RIDGECRAFT_ASSERT(!(undo_.back == Move()));
  net_.make(undo_.back);
  chosen_.take_back();
  free_.take_back();
  count_ = undo_.count;
  undo_ = {};
}

/// Looks at the marked sides; tabs that no longer fit are taken away.
void TabState::refresh() {
  for (const std::uint32_t side : marked_) {
    const Mask free = free_among_faces(side);
    free_.set(side, free);
    const Choice& choice = chosen_[join_of(side)];
    if (choice.side == side && (free >> choice.shape & 1U) == 0) {
      choose(join_of(side), {});
    }
  }
}

/// Of two tabs that the change brought onto each other one goes.
void TabState::drop_colliding() {
  for (const auto& [a, b] : beside_) {
    const TabCandidate* tab = tab_on(a);
    if (tab != nullptr && tab_on(b) != nullptr && !clear(a, *tab, b)) {
      choose(join_of(b), {});
      mark(a);
      mark(b);
    }
  }
}

/// Tabs for the marked cuts that have none, those with the fewest choices first.
void TabState::fill_open() {
  open_.clear();
  for (const std::uint32_t side : marked_) {
    if (is_cut(side) && free_[side] != 0 && !has_tab(side)) {
      open_.push_back(join_of(side));
    }
  }
  std::sort(open_.begin(), open_.end());
  open_.erase(std::unique(open_.begin(), open_.end()), open_.end());
  const auto choices = [this](std::uint32_t join) {
    const std::uint32_t twin = patch_.twin[join];
    return std::popcount(free_[join]) + (twin == no_index ? 0 : std::popcount(free_[twin]));
  };
  std::stable_sort(open_.begin(), open_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return choices(a) < choices(b); });
  for (const bool may_push : {false, true}) {
    for (const std::uint32_t join : open_) {
      if (chosen_[join].side == no_index) {
        static_cast<void>(place(join, may_push));
      }
    }
  }
}

/// Sides with chosen tabs that a tab on this side might meet.
void TabState::find_tabs_near(std::uint32_t side, std::vector<std::uint32_t>& sides) {
  const Circle near = circle(side);
  sides.clear();
  net_.visit_near(net_.tree_of(side / 3), near.centre, near.radius + reach_ + options_.clearance_mm,
                  [&](std::uint32_t face) {
                    for (std::uint32_t other = 3 * face; other < 3 * face + 3; ++other) {
                      if (other != side && chosen_[join_of(other)].side == other) {
                        sides.push_back(other);
                      }
                    }
                  });
}

std::vector<std::uint32_t> TabState::faces_near(std::uint32_t side) const {
  std::vector<std::uint32_t> faces;
  if (!candidates_[side].empty()) {
    const Circle near = circle(side);
    net_.visit_near(net_.tree_of(side / 3), near.centre, near.radius + reach_ + options_.clearance_mm,
                    [&](std::uint32_t face) { faces.push_back(face); });
  }
  return faces;
}

/// Does a tab on side a keep clear of the tab that side b has?
bool TabState::clear(std::uint32_t a, const TabCandidate& tab_a, std::uint32_t b) const {
  const TabCandidate& tab_b = candidates_[b][chosen_[join_of(b)].shape];
  const Frame here = frame(a);
  const Frame there = frame(b);
  const Walled<4> whole = moved(tab_b.whole, there, here);
  const auto common = [&](bool at_a, std::uint32_t vertex_a, Vec2 place_a, bool at_b, std::uint32_t vertex_b,
                          Vec2 place_b) {
    const Vec2 away = place_a - place_b;
    return at_a && at_b && vertex_a == vertex_b && dot(away, away) < same_place_mm * same_place_mm;
  };
  const std::uint32_t left_a = vertex_[3 * (a / 3) + (a % 3 + 1) % 3];
  const std::uint32_t left_b = vertex_[3 * (b / 3) + (b % 3 + 1) % 3];
  const bool corner = common(tab_a.at_left, left_a, end(a), tab_b.at_left, left_b, end(b)) ||
                      common(tab_a.at_left, left_a, end(a), tab_b.at_right, vertex_[b], start(b)) ||
                      common(tab_a.at_right, vertex_[a], start(a), tab_b.at_left, left_b, end(b)) ||
                      common(tab_a.at_right, vertex_[a], start(a), tab_b.at_right, vertex_[b], start(b));
  return keeps_clear(
      corner, options_.clearance_mm, [&](double least) { return walls_apart(tab_a.whole, whole, least); },
      [&](double least) { return walls_apart(tab_a.upper, moved(tab_b.upper, there, here), least); });
}

/// Finds a join a tab: free, or by pushing others aside.
bool TabState::place(std::uint32_t join, bool may_push) {
  std::vector<std::uint32_t> near;
  std::vector<std::uint32_t> others;
  for (const std::uint32_t side : {join, patch_.twin[join]}) {
    if (side == no_index || free_[side] == 0) {
      continue;
    }
    find_tabs_near(side, near);
    for (std::uint32_t shape = 0; shape < candidates_[side].size(); ++shape) {
      if ((free_[side] >> shape & 1U) == 0) {
        continue;
      }
      others.clear();
      for (const std::uint32_t other : near) {
        if (join_of(other) != join && tab_on(other) != nullptr &&
            !clear(side, candidates_[side][shape], other)) {
          others.push_back(join_of(other));
          if (!may_push || others.size() > most_pushed) {
            break;
          }
        }
      }
      if (others.empty()) {
        choose(join, {side, shape});
        return true;
      }
      if (may_push && others.size() <= most_pushed && push_aside(join, {side, shape}, others)) {
        return true;
      }
    }
  }
  return false;
}

bool TabState::push_aside(std::uint32_t join, const Choice& choice,
                          const std::vector<std::uint32_t>& others) {
  std::vector<Choice> old;
  for (const std::uint32_t other : others) {
    old.push_back(chosen_[other]);
    choose(other, {});
  }
  choose(join, choice);
  const bool all =
      std::all_of(others.begin(), others.end(), [&](std::uint32_t other) { return place(other, false); });
  if (!all) {
    choose(join, {});
    for (std::size_t i = 0; i < old.size(); ++i) {
      choose(others[i], old[i]);
    }
  }
  return all;
}

}  // namespace ridgecraft::unfold
