// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/concavity/valley_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/geometry.hpp"
#include "base/no_index.hpp"

namespace ridgecraft::segment {
namespace {

struct Candidate {
  std::uint32_t from;
  std::uint32_t to;
  float length;  ///< negative: no such arc
};

/// The straight line between the corners opposite to side k of f and its neighbour g, if it crosses the open
/// side.
Candidate line_across(const ScaledSurface& s, std::uint32_t f, unsigned k, std::uint32_t g, double sagitta) {
  const std::uint32_t a = s.corners[f][k];
  const std::uint32_t b = s.corners[f][(k + 1) % 3];
  const std::uint32_t p = s.corners[f][(k + 2) % 3];
  const auto& c = s.corners[g];
  const std::uint32_t q = c[0] != a && c[0] != b ? c[0] : (c[1] != a && c[1] != b ? c[1] : c[2]);
  Candidate none_there{p, q, -1.0F};
  const Vec3 along = s.points[b] - s.points[a];
  const double size = length(along);
  if (p == q || !(size > 0.0)) {
    return none_there;
  }
  const Vec3 unit = along / size;
  const Vec3 to_p = s.points[p] - s.points[a];
  const Vec3 to_q = s.points[q] - s.points[a];
  const double tp = dot(to_p, unit);
  const double tq = dot(to_q, unit);
  const double hp = length(to_p - tp * unit);
  const double hq = length(to_q - tq * unit);
  const double rise = hp + hq;
  if (!(rise > 0.0)) {
    return none_there;
  }
  const double at = tp + (tq - tp) * (hp / rise);
  if (!(at > 0.0 && at < size)) {
    return none_there;
  }
  if (distance_to_segment(s.points[a] + at * unit, s.points[p], s.points[q]) > sagitta) {
    return none_there;
  }
  return {p, q, static_cast<float>(std::sqrt((tp - tq) * (tp - tq) + rise * rise))};
}

/// Calls visit(facet, side, neighbour) for each edge, from the smaller of its two facets; a border's
/// neighbour is none.
template <class Visit>
void for_edges(const ScaledSurface& s, const Visit& visit) {
  for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = s.neighbors[f][k];
      if (g == no_index || g >= f) {
        visit(f, k, g);
      }
    }
  }
}

/// Makes room for the arcs of each vertex: those along edges, then those across.
struct ArcPlaces {
  explicit ArcPlaces(std::size_t vertices) : along(vertices, 0), across(vertices, 0) {}

  /// From counts to the places where the next arc of each vertex goes.
  void lay_out(VertexGraph& graph) {
    const std::size_t vertices = along.size();
    graph.first.resize(vertices + 1);
    graph.across.resize(vertices);
    std::uint32_t total = 0;
    for (std::size_t v = 0; v < vertices; ++v) {
      graph.first[v] = total;
      total += std::exchange(along[v], total);
      graph.across[v] = total;
      total += std::exchange(across[v], total);
    }
    graph.first[vertices] = total;
    graph.arcs.resize(total);
    graph.side.resize(total);
  }

  std::vector<std::uint32_t> along;
  std::vector<std::uint32_t> across;
};

/// Width of the queue's buckets, in mean lengths of an arc: about a dozen buckets are then in use at once.
constexpr double bucket_share = 0.125;
/// Sums of keys and estimates are rounded to float: ways that are as long as the best known one aren't left
/// out for that, or which one is found would depend on what was searched before.
constexpr float rounding_slack = 1.0F + 4.0F * std::numeric_limits<float>::epsilon();

/// Small: each part that is measured for itself has a cache of its own.
constexpr std::size_t first_size = 64;

std::uint64_t key_of(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t{from} << 32U | to;
}

}  // namespace

VertexGraph build_vertex_graph(const ScaledSurface& s, double sagitta) {
  VertexGraph graph;
  ArcPlaces places(s.vertex_count());
  std::vector<Candidate> lines;
  lines.reserve(3 * s.facet_count() / 2 + 1);
  for_edges(s, [&](std::uint32_t f, unsigned k, std::uint32_t g) {
    ++places.along[s.corners[f][k]];
    ++places.along[s.corners[f][(k + 1) % 3]];
    if (g == no_index) {
      return;
    }
    lines.push_back(line_across(s, f, k, g, sagitta));
    if (lines.back().length >= 0.0F) {
      ++places.across[lines.back().from];
      ++places.across[lines.back().to];
    }
  });
  places.lay_out(graph);
  std::size_t line = 0;
  for_edges(s, [&](std::uint32_t f, unsigned k, std::uint32_t g) {
    const std::uint32_t a = s.corners[f][k];
    const std::uint32_t b = s.corners[f][(k + 1) % 3];
    const auto size = static_cast<float>(length(s.points[b] - s.points[a]));
    const std::uint32_t side = 3 * f + k;
    const auto add = [&](std::uint32_t at, std::uint32_t target, float arc_length) {
      graph.arcs[at] = {target, arc_length};
      graph.side[at] = side;
    };
    add(places.along[a]++, b, size);
    add(places.along[b]++, a, size);
    if (g == no_index) {
      return;
    }
    const Candidate& c = lines[line++];
    if (c.length >= 0.0F) {
      add(places.across[c.from]++, c.to, c.length);
      add(places.across[c.to]++, c.from, c.length);
    }
  });
  double sum = 0.0;
  for (const Arc& arc : graph.arcs) {
    sum += static_cast<double>(arc.length);
  }
  graph.mean_length = sum > 0.0 ? sum / static_cast<double>(graph.arcs.size()) : 1.0;
  return graph;
}

/// How far a jump may lean out of the surface at its ends, as the cosine to the normal there
/// (docs/design/segmentation.md, "Arcs and jumps").
constexpr double jump_lean = 0.3;

PartGraph::PartGraph(const ScaledSurface& surface, const VertexGraph& graph, bool jumps)
    : surface_(&surface),
      graph_(&graph),
      jumps_(jumps),
      member_(surface.facet_count(), 0),
      vertex_mark_(surface.vertex_count(), 0),
      partial_(surface.vertex_count(), 0),
      loop_mark_(surface.vertex_count(), 0),
      loop_(surface.vertex_count(), no_index) {}

void PartGraph::select(std::span<const std::uint32_t> facets) {
  ++current_;
  facets_.assign(facets.begin(), facets.end());
  vertices_.clear();
  for (const std::uint32_t f : facets_) {
    member_[f] = current_;
    for (const std::uint32_t v : surface_->corners[f]) {
      if (vertex_mark_[v] != current_) {
        vertex_mark_[v] = current_;
        vertices_.push_back(v);
      }
    }
  }
  find_loops();
}

/// Marks what lies at edges whose neighbour facet is in another part, and collects these edges where jumps
/// are allowed.
void PartGraph::find_cut_edges() {
  cut_edges_.clear();
  on_cut_.clear();
  for (const std::uint32_t f : facets_) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t g = surface_->neighbors[f][k];
      if (g == no_index || member_[g] == current_) {
        continue;
      }
      const std::uint32_t a = surface_->corners[f][k];
      const std::uint32_t b = surface_->corners[f][(k + 1) % 3];
      // Their facets are incomplete; the third corner lacks its arc across this edge. All other vertices of
      // the part have all their facets, since a fan that is partly outside has a cut edge.
      partial_[a] = partial_[b] = partial_[surface_->corners[f][(k + 2) % 3]] = current_;
      if (!jumps_) {
        continue;
      }
      cut_edges_.push_back({a, b});
      for (const std::uint32_t v : {a, b}) {
        if (loop_mark_[v] != current_) {
          loop_mark_[v] = current_;
          on_cut_.push_back(v);
        }
      }
    }
  }
}

/// Cut edges that hang together over vertices are a loop; loops are numbered by their smallest vertex.
void PartGraph::find_loops() {
  find_cut_edges();
  loop_first_.assign(1, 0);
  loop_vertices_.clear();
  if (on_cut_.empty()) {
    return;
  }
  std::sort(on_cut_.begin(), on_cut_.end());
  const auto place = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::lower_bound(on_cut_.begin(), on_cut_.end(), v) - on_cut_.begin());
  };
  DisjointSets sets(on_cut_.size());
  for (const auto& [a, b] : cut_edges_) {
    sets.join(place(a), place(b));
  }
  // The first of each set stands for it, so it has its number before the others ask for it.
  std::vector<std::uint32_t> count;
  for (std::uint32_t i = 0; i < on_cut_.size(); ++i) {
    const std::uint32_t first = sets.find(i);
    if (first == i) {
      loop_[on_cut_[i]] = static_cast<std::uint32_t>(count.size());
      count.push_back(0);
    }
    loop_[on_cut_[i]] = loop_[on_cut_[first]];
    ++count[loop_[on_cut_[i]]];
  }
  for (const std::uint32_t c : count) {
    loop_first_.push_back(loop_first_.back() + c);
  }
  std::vector<std::uint32_t> fill(loop_first_.begin(), loop_first_.end() - 1);
  loop_vertices_.resize(on_cut_.size());
  for (const std::uint32_t v : on_cut_) {
    loop_vertices_[fill[loop_[v]]++] = v;
  }
}

bool PartGraph::arc_exists(std::uint32_t v, std::uint32_t i) const {
  return i < graph_->across[v] ? has_one_beside(i) : has_both_beside(i);
}

std::uint32_t PartGraph::find_arc(std::uint32_t from, std::uint32_t to) const {
  std::uint32_t best = no_index;
  for_arcs(from, [&](std::uint32_t i, const Arc& a) {
    if (a.target == to && (best == no_index || a.length < graph_->arcs[best].length)) {
      best = i;
    }
  });
  return best;
}

bool PartGraph::starts_inside(std::uint32_t p, std::uint32_t q, double distance) const {
  const Vec3 way = surface_->points[q] - surface_->points[p];
  const double limit = jump_lean * distance;
  return dot(surface_->vertex_normals[p], way) <= limit && -dot(surface_->vertex_normals[q], way) <= limit;
}

bool PartGraph::jump_exists(std::uint32_t p, std::uint32_t q) const {
  const std::uint32_t at = loop_at(p);
  if (at == no_index || loop_at(q) != at || p == q) {
    return false;
  }
  return starts_inside(p, q, length(surface_->points[q] - surface_->points[p]));
}

void BucketQueue::start(float base, float width) {
  for (std::uint32_t i = current_; i <= last_ && i < buckets_.size(); ++i) {
    buckets_[i].clear();
  }
  base_ = base;
  inverse_width_ = 1.0F / width;
  current_ = 0;
  last_ = 0;
}

void BucketQueue::drain(std::vector<Entry>& left) {
  for (; current_ <= last_ && current_ < buckets_.size(); ++current_) {
    left.insert(left.end(), buckets_[current_].begin(), buckets_[current_].end());
    buckets_[current_].clear();
  }
  // All buckets in use are past; pop() looks at the next one.
  if (current_ >= buckets_.size()) {
    buckets_.resize(std::size_t{current_} + 1);
  }
}

bool BucketQueue::pop(Entry& entry) {
  while (buckets_[current_].empty()) {
    if (current_ >= last_) {
      return false;
    }
    ++current_;
  }
  entry = buckets_[current_].back();
  buckets_[current_].pop_back();
  return true;
}

ValleySearch::ValleySearch(const PartGraph& graph)
    : graph_(&graph),
      nodes_(graph.surface().vertex_count()),
      bucket_width_(static_cast<float>(bucket_share * graph.mean_arc_length())) {}

float ValleySearch::estimate(std::uint32_t v, const Node& node) const {
  return node.search == search_ && node.goal == goal_
             ? node.estimate
             : static_cast<float>(length(goal_point_ - graph_->surface().points[v]));
}

/// Whether all jumps were taken that shorten a way; false when some lead beyond `bound`.
bool ValleySearch::relax_jumps(std::uint32_t v, std::uint32_t to, float bound) {
  const std::uint32_t loop = graph_->loop_at(v);
  if (loop == no_index) {
    return true;
  }
  bool finished = true;
  const auto& points = graph_->surface().points;
  const double key = nodes_[v].key;
  for (const std::uint32_t q : graph_->loop(loop)) {
    const double distance = length(points[q] - points[v]);
    const double reached = key + distance;
    Node& node = nodes_[q];
    if (q == v || (node.search == search_ && reached >= node.key) || distance == 0.0) {
      continue;
    }
    const float ahead = estimate(q, node);
    const float through = static_cast<float>(reached) + ahead;
    if (through > bound) {
      finished = false;
      continue;
    }
    if (!graph_->starts_inside(v, q, distance)) {
      continue;
    }
    node = {reached, ahead, search_, v, jump_arc, goal_};
    queue_.push(through, q);
    if (q == to) {
      bound = rounding_slack * through;
    }
  }
  return finished;
}

bool ValleySearch::comes_first(std::uint32_t v, std::uint32_t other) const {
  const double a = nodes_[v].key;
  const double b = nodes_[other].key;
  return a != b ? a < b : v < other;
}

void ValleySearch::begin(std::uint32_t from) {
  ++search_;
  source_ = from;
  selection_ = graph_->selection();
  unfinished_.clear();
  const auto ahead = static_cast<float>(length(goal_point_ - graph_->surface().points[from]));
  nodes_[from] = {0.0, ahead, search_, no_index, no_index, goal_};
  queue_.start(ahead, bucket_width_);
  queue_.push(ahead, from);
}

/// Puts the vertices from which ways may still be found into the queue again, now for this goal.
void ValleySearch::go_on() {
  left_.clear();
  queue_.drain(left_);
  // An entry that was overtaken has another key than its vertex now.
  for (const BucketQueue::Entry& entry : left_) {
    const Node& node = nodes_[entry.vertex];
    if (static_cast<float>(node.key) + node.estimate == entry.key) {
      unfinished_.push_back(entry.vertex);
    }
  }
  left_.clear();
  const float base = static_cast<float>(length(goal_point_ - graph_->surface().points[source_]));
  queue_.start(base, bucket_width_);
  for (const std::uint32_t v : unfinished_) {
    Node& node = nodes_[v];
    if (node.goal != goal_) {
      node.estimate = static_cast<float>(length(goal_point_ - graph_->surface().points[v]));
      node.goal = goal_;
      queue_.push(static_cast<float>(node.key) + node.estimate, v);
    }
  }
  unfinished_.clear();
}

/// `bound`: entries behind that of the goal are never taken, so they aren't even pushed.
void ValleySearch::expand(std::uint32_t v, std::uint32_t to, float& bound) {
  const double key = nodes_[v].key;
  bool finished = true;
  graph_->for_arcs(v, [&](std::uint32_t i, const Arc& arc) {
    const double reached = key + static_cast<double>(arc.length);
    Node& node = nodes_[arc.target];
    if (node.search == search_ && reached >= node.key) {
      // Of two ways of one length, the one over the vertex that Dijkstra's queue would have taken first.
      if (reached == node.key && arc.length > 0.0F && node.from != no_index && comes_first(v, node.from)) {
        node.from = v;
        node.arc = i;
      }
      return;
    }
    const float ahead = estimate(arc.target, node);
    const float through = static_cast<float>(reached) + ahead;
    if (through > bound) {
      finished = false;
      return;
    }
    node = {reached, ahead, search_, v, i, goal_};
    queue_.push(through, arc.target);
    if (arc.target == to) {
      bound = rounding_slack * through;
    }
  });
  finished = relax_jumps(v, to, bound) && finished;
  if (!finished) {
    unfinished_.push_back(v);
  }
}

double ValleySearch::find(std::uint32_t from, std::uint32_t to, std::vector<Step>& path) {
  path.clear();
  ++goal_;
  goal_point_ = graph_->surface().points[to];
  if (from == source_ && graph_->selection() == selection_) {
    go_on();
  } else {
    begin(from);
  }
  const Node& goal = nodes_[to];
  float bound = std::numeric_limits<float>::infinity();
  if (goal.search == search_) {
    bound = rounding_slack * static_cast<float>(goal.key);
  }
  BucketQueue::Entry entry{};
  while (!queue_.is_past(bound) && queue_.pop(entry)) {
    const Node& node = nodes_[entry.vertex];
    if (static_cast<float>(node.key) + node.estimate != entry.key) {
      continue;  // a shorter way was found since
    }
    if (entry.vertex == to || entry.key > bound) {
      unfinished_.push_back(entry.vertex);
      continue;
    }
    expand(entry.vertex, to, bound);
    if (goal.search == search_) {
      bound = rounding_slack * static_cast<float>(goal.key);
    }
  }
  if (goal.search != search_) {
    return infinite;
  }
  for (std::uint32_t v = to; v != no_index; v = nodes_[v].from) {
    path.push_back({v, nodes_[v].arc});
  }
  std::reverse(path.begin(), path.end());
  return goal.key;
}

void ValleySearch::flood(std::span<const Start> starts, double limit, std::vector<std::uint32_t>& reached) {
  ++search_;
  source_ = no_index;
  queue_.start(0.0F, bucket_width_);
  reached.clear();
  double least = 0.0;
  for (const Start& s : starts) {
    least = std::min(least, s.key);
  }
  // Keys in the heap are counted from the least start, so that none is negative.
  for (const Start& s : starts) {
    Node& node = nodes_[s.vertex];
    if (s.key < limit && (node.search != search_ || s.key < node.key)) {
      node = {s.key, 0.0F, search_, no_index, no_index, no_index};
      queue_.push(static_cast<float>(s.key - least), s.vertex);
    }
  }
  BucketQueue::Entry entry{};
  while (queue_.pop(entry)) {
    const std::uint32_t v = entry.vertex;
    const double key = nodes_[v].key;
    if (static_cast<float>(key - least) != entry.key) {
      continue;  // a shorter way was found since
    }
    if (nodes_[v].from != v) {
      nodes_[v].from = v;  // counted
      reached.push_back(v);
    }
    graph_->for_arcs(v, [&](std::uint32_t, const Arc& arc) {
      const double next = key + static_cast<double>(arc.length);
      Node& node = nodes_[arc.target];
      const bool fresh = node.search != search_;
      if (next >= limit || (!fresh && next >= node.key)) {
        return;
      }
      node.key = next;
      if (fresh) {
        node.search = search_;
        node.from = no_index;
      }
      queue_.push(static_cast<float>(next - least), arc.target);
    });
  }
}

ValleyCache::ValleyCache() : table_(first_size) {}

std::size_t ValleyCache::slot(std::uint64_t key) const {
  // Finaliser of splitmix64: neighbouring vertex numbers spread over the table.
  std::uint64_t z = key;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  std::size_t i = static_cast<std::size_t>(z ^ (z >> 31U)) & (table_.size() - 1);
  while (table_[i].count != 0 && table_[i].key != key) {
    i = (i + 1) & (table_.size() - 1);
  }
  return i;
}

bool ValleyCache::find(std::uint32_t from, std::uint32_t to, Valley& out) const {
  const Entry& e = table_[slot(key_of(from, to))];
  if (e.count == 0) {
    return false;
  }
  out.steps = {steps_.data() + e.first, e.count};
  out.concavity = {concavity_.data() + e.first, e.count};
  out.length = e.length;
  out.greatest = e.greatest;
  out.part = e.part;
  return true;
}

void ValleyCache::store(std::uint32_t from, std::uint32_t to, const Valley& valley) {
  if (2 * (used_ + 1) > table_.size()) {
    grow();
  }
  Entry& e = table_[slot(key_of(from, to))];
  used_ += e.count == 0 ? 1 : 0;
  e = {key_of(from, to), steps_.size(),   static_cast<std::uint32_t>(valley.steps.size()),
       valley.length,    valley.greatest, valley.part};
  steps_.insert(steps_.end(), valley.steps.begin(), valley.steps.end());
  concavity_.insert(concavity_.end(), valley.concavity.begin(), valley.concavity.end());
}

void ValleyCache::absorb(const ValleyCache& other) {
  for (const Entry& e : other.table_) {
    if (e.count != 0) {
      const auto from = static_cast<std::uint32_t>(e.key >> 32U);
      const auto to = static_cast<std::uint32_t>(e.key & 0xffffffffU);
      store(from, to,
            {{other.steps_.data() + e.first, e.count},
             {other.concavity_.data() + e.first, e.count},
             e.length,
             e.greatest,
             e.part});
    }
  }
}

void ValleyCache::grow() {
  const std::vector<Entry> old = std::exchange(table_, std::vector<Entry>(2 * table_.size()));
  for (const Entry& e : old) {
    if (e.count != 0) {
      table_[slot(e.key)] = e;
    }
  }
}

}  // namespace ridgecraft::segment
