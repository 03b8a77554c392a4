// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/tab_state.hpp"

#include <algorithm>
#include <cmath>

#include "unfold/tab_assignment.hpp"

namespace ridgecraft::unfold {

namespace {

/// Two corners of faces that are one vertex and nearer than this are one corner of the net, mm: rounding.
constexpr double same_place_mm = 1e-6;
/// How many tabs one may push aside.
constexpr std::size_t most_pushed = 2;

}  // namespace

TabState::TabState(const mesh::Surface& surface, const mesh::Panels& panels, const Patch& patch,
                   TreeSearch& net, const TabOptions& options)
    : surface_(surface),
      patch_(patch),
      net_(net),
      options_(options),
      targets_(find_tab_targets(surface, panels, patch, options)),
      shapes_(patch.twin.size()),
      chosen_(patch.twin.size()) {
  vertex_.reserve(patch.twin.size());
  for (const FaceId f : patch.face) {
    for (const VertexId v : surface_.vertices(f)) {
      vertex_.push_back(v.value());
    }
  }
}

Frame TabState::frame(std::uint32_t side) const {
  const Vec2 along = start(side) - end(side);
  return {end(side), along / length(along)};
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

/// The faces that a tab inside `room` might meet, those at its corners first.
std::vector<Obstacle> TabState::obstacles(std::uint32_t side, const ConvexShape& room) {
  const Frame own = frame(side);
  const Box2 box = room.box();
  const Vec2 middle = 0.5 * (box.low + box.high);
  const std::uint32_t left = vertex_[3 * (side / 3) + (side % 3 + 1) % 3];
  const std::uint32_t right = vertex_[side];
  std::vector<Obstacle> result = targets_.outline[side];
  std::vector<Obstacle> others;
  net_.visit_near(own.out(middle), 0.5 * length(box.size()) + options_.clearance_mm, [&](std::uint32_t face) {
    if (face == side / 3) {
      return;
    }
    const bool at_left = shares(left, end(side), face);
    const bool at_right = shares(right, start(side), face);
    Obstacle obstacle{own.in(ConvexShape(std::span<const Vec2>(net_.flat(face)))), Obstacle::Kind::thing};
    if (at_left || at_right) {
      obstacle.kind = at_left && at_right ? Obstacle::Kind::at_both
                      : at_left           ? Obstacle::Kind::at_base_left
                                          : Obstacle::Kind::at_base_right;
    }
    if (!clear_of(room, obstacle, options_.clearance_mm)) {
      (at_left || at_right ? result : others).push_back(obstacle);
    }
  });
  result.insert(result.end(), others.begin(), others.end());
  return result;
}

/// What fits on a side among the faces; a tab that stands there and no longer fits is taken away.
void TabState::look_at(std::uint32_t side) {
  const bool stands = chosen_[join_of(side)].side == side;
  if (!is_cut(side) || targets_.largest[side].empty()) {
    if (stands) {
      choose(join_of(side), {});
    }
    if (!shapes_[side].empty()) {
      set_shapes(side, {});
    }
    return;
  }
  const double edge = patch_.length[side];
  const std::vector<Obstacle> things = obstacles(side, widest_tab(edge, options_));
  const ConvexShape largest = largest_tab({0.0, edge, edge}, things, options_, TabNeed::usable);
  std::vector<TabShape> shapes = tab_shapes(largest, edge, options_);
  if (shapes.empty()) {
    shapes = partial_tab_shapes(edge, things, options_);
  }
  if (stands) {
    const ConvexShape& outline = chosen_[join_of(side)].outline;
    const bool fits = std::all_of(things.begin(), things.end(), [&](const Obstacle& thing) {
      return clear_of(outline, thing, options_.clearance_mm);
    });
    if (!fits) {
      choose(join_of(side), {});
    }
  }
  if (!shapes.empty() || !shapes_[side].empty()) {
    set_shapes(side, std::move(shapes));
  }
}

void TabState::set_shapes(std::uint32_t side, std::vector<TabShape> shapes) {
  if (recording_) {
    old_shapes_.emplace_back(side, std::move(shapes_[side]));
  }
  shapes_[side] = std::move(shapes);
}

void TabState::choose(std::uint32_t join, const Choice& choice) {
  if (recording_) {
    old_choices_.emplace_back(join, chosen_[join]);
  }
  tabs_ += choice.side != nothing ? 1U : 0U;
  tabs_ -= chosen_[join].side != nothing ? 1U : 0U;
  chosen_[join] = choice;
}

void TabState::begin() {
  recording_ = true;
  old_shapes_.clear();
  old_choices_.clear();
}

void TabState::roll_back() {
  recording_ = false;
  for (; !old_shapes_.empty(); old_shapes_.pop_back()) {
    shapes_[old_shapes_.back().first] = std::move(old_shapes_.back().second);
  }
  for (; !old_choices_.empty(); old_choices_.pop_back()) {
    choose(old_choices_.back().first, old_choices_.back().second);
  }
}

void TabState::renew_all() {
  std::vector<std::uint32_t> faces(patch_.size());
  for (std::uint32_t f = 0; f < patch_.size(); ++f) {
    faces[f] = f;
  }
  renew(faces);
}

void TabState::renew(std::vector<std::uint32_t>& faces) {
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  for (const std::uint32_t f : faces) {
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      look_at(side);
    }
  }
  // Tabs that the change brought onto each other, and the joins that have none.
  std::vector<std::uint32_t> open;
  for (const std::uint32_t f : faces) {
    for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
      if (!is_cut(side)) {
        continue;
      }
      const std::uint32_t join = join_of(side);
      if (chosen_[join].side == side) {
        const ConvexShape outline = chosen_[join].outline;
        for (const Near& near : tabs_near(side)) {
          if (near.join != join && !clear(side, outline, near)) {
            choose(join, {});
            break;
          }
        }
      }
      if (chosen_[join].side == nothing) {
        open.push_back(join);
      }
    }
  }
  std::sort(open.begin(), open.end());
  open.erase(std::unique(open.begin(), open.end()), open.end());
  const auto choices = [this](std::uint32_t join) {
    return shapes_[join].size() + (patch_.twin[join] == nothing ? 0 : shapes_[patch_.twin[join]].size());
  };
  std::stable_sort(open.begin(), open.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return choices(a) < choices(b); });
  for (const int may_push : {0, 1}) {
    for (const std::uint32_t join : open) {
      if (chosen_[join].side == nothing && choices(join) > 0) {
        static_cast<void>(place(join, may_push));
      }
    }
  }
}

/// Chosen tabs that a tab on this side might meet.
std::vector<TabState::Near> TabState::tabs_near(std::uint32_t side) {
  const Frame own = frame(side);
  const double edge = patch_.length[side];
  const double radius = 0.5 * length(Vec2{edge, options_.height_mm}) + reach();
  std::vector<Near> near;
  net_.visit_near(own.out({0.5 * edge, 0.5 * options_.height_mm}), radius, [&](std::uint32_t face) {
    for (std::uint32_t other = 3 * face; other < 3 * face + 3; ++other) {
      if (other != side && chosen_[join_of(other)].side == other) {
        near.push_back({join_of(other), other});
      }
    }
  });
  return near;
}

bool TabState::clear(std::uint32_t side, const ConvexShape& tab, const Near& other) const {
  const ConvexShape& there = chosen_[other.join].outline;
  const auto site = [this](std::uint32_t s) {
    TabSite result;
    result.own = frame(s);
    result.length = patch_.length[s];
    result.ends = {vertex_[3 * (s / 3) + (s % 3 + 1) % 3], vertex_[s]};
    return result;
  };
  const TabSite a = site(side);
  TabSite b = site(other.side);
  // One vertex at two places is no common corner.
  for (std::uint32_t i = 0; i < 2; ++i) {
    const Vec2 place = i == 0 ? end(other.side) : start(other.side);
    if (!shares(b.ends[i], place, side / 3)) {
      b.ends[i] = nothing;
    }
  }
  return tabs_clear(a, tab, b, there, options_.clearance_mm);
}

/// Finds a join a tab: free, or in room that is left between others, or by pushing others aside.
bool TabState::place(std::uint32_t join, int may_push) {
  const std::uint32_t sides[2] = {join, patch_.twin[join]};
  for (const std::uint32_t side : sides) {
    if (side == nothing || shapes_[side].empty()) {
      continue;
    }
    const std::vector<Near> near = tabs_near(side);
    for (const TabShape& shape : shapes_[side]) {
      std::vector<std::uint32_t> others;
      for (const Near& tab : near) {
        if (tab.join != join && chosen_[tab.join].side == tab.side && !clear(side, shape.outline, tab)) {
          others.push_back(tab.join);
          if (may_push == 0 || others.size() > most_pushed) {
            break;
          }
        }
      }
      if (others.empty()) {
        choose(join, {side, shape.outline});
        return true;
      }
      if (may_push > 0 && others.size() <= most_pushed &&
          push_aside(join, side, ConvexShape(shape.outline), others, may_push)) {
        return true;
      }
    }
    if (place_trimmed(side, near)) {
      return true;
    }
  }
  return false;
}

bool TabState::place_trimmed(std::uint32_t side, const std::vector<Near>& near) {
  const double edge = patch_.length[side];
  const Frame own = frame(side);
  ConvexShape tab = shapes_[side].back().outline;
  for (const TabShape& shape : shapes_[side]) {
    tab = shape.outline.area() > tab.area() ? shape.outline : tab;
  }
  for (const Near& other : near) {
    if (other.join == join_of(side) || chosen_[other.join].side != other.side) {
      continue;
    }
    const bool at_left = shares(vertex_[3 * (side / 3) + (side % 3 + 1) % 3], end(side), other.side / 3);
    const bool at_right = shares(vertex_[side], start(side), other.side / 3);
    Obstacle obstacle{own.in(frame(other.side).out(chosen_[other.join].outline)),
                      at_left && at_right ? Obstacle::Kind::at_both
                      : at_left           ? Obstacle::Kind::at_base_left
                      : at_right          ? Obstacle::Kind::at_base_right
                                          : Obstacle::Kind::thing};
    tab = trimmed(tab, obstacle, options_.clearance_mm);
    if (!is_usable(tab, edge, options_)) {
      return false;
    }
  }
  const bool free = std::all_of(near.begin(), near.end(), [&](const Near& other) {
    return other.join == join_of(side) || chosen_[other.join].side != other.side || clear(side, tab, other);
  });
  if (free) {
    choose(join_of(side), {side, tab});
  }
  return free;
}

bool TabState::push_aside(std::uint32_t join, std::uint32_t side, const ConvexShape& outline,
                          const std::vector<std::uint32_t>& others, int may_push) {
  std::vector<Choice> old;
  for (const std::uint32_t other : others) {
    old.push_back(chosen_[other]);
    choose(other, {});
  }
  choose(join, {side, outline});
  const bool all = std::all_of(others.begin(), others.end(),
                               [&](std::uint32_t other) { return place(other, may_push - 1); });
  if (!all) {
    choose(join, {});
    for (std::size_t i = 0; i < old.size(); ++i) {
      choose(others[i], old[i]);
    }
  }
  return all;
}

}  // namespace ridgecraft::unfold
