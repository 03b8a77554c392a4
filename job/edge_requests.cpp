// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/edge_requests.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/vector.hpp"
#include "mesh/mesh.hpp"
#include "mesh/model/surface.hpp"
#include "mesh/reading/pdo/read_pdo.hpp"
#include "verify/file/file.hpp"

namespace ridgecraft::job {
namespace {

// Where nets made before lie in a model that may have another size now, or has changed here and there.

/// The points of a surface, found by place.
class PointSet {
 public:
  /// `share` of the surface's largest extent lies between points that count as one. O(n log n).
  PointSet(const mesh::Surface& surface, double share);

  /// The share of these points that are points of the surface. O(log n) each.
  [[nodiscard]] double share_of(std::span<const Vec3> points) const;

 private:
  using Cell = std::array<std::int64_t, 3>;
  [[nodiscard]] Cell cell_of(Vec3 p) const;
  [[nodiscard]] bool contains(Vec3 p) const;

  double size_;
  std::set<Cell> cells_;
};

/// p becomes here + factor * (p - there).
struct Similarity {
  Vec3 there;
  Vec3 here;
  double factor = 1.0;

  [[nodiscard]] Vec3 operator()(Vec3 p) const { return here + factor * (p - there); }
};

/// Rounding lies between points of one model at two sizes, as a share of its largest extent.
constexpr double same_point_share = 1e-4;
/// As many points tell which way is the best.
constexpr std::size_t most_tried = 500;

std::vector<Vec3> some_of(std::span<const Vec3> points) {
  const std::size_t step = points.size() / most_tried + 1;
  std::vector<Vec3> some;
  for (std::size_t i = 0; i < points.size(); i += step) {
    some.push_back(points[i]);
  }
  return some;
}

/// Each axis has its box's low or its high side in place.
std::vector<Similarity> ways_between(const Box3& there, const Box3& here) {
  std::vector<double> factors{here.largest_extent() / there.largest_extent()};
  const Vec3 a = there.size();
  const Vec3 b = here.size();
  for (const auto& [old_extent, new_extent] :
       {std::pair(a.x, b.x), std::pair(a.y, b.y), std::pair(a.z, b.z)}) {
    if (old_extent > 0.0 && new_extent > 0.0) {
      factors.push_back(new_extent / old_extent);
    }
  }
  std::vector<Similarity> ways;
  for (const double factor : factors) {
    for (unsigned high = 0; high < 8; ++high) {
      const auto side = [high](const Box3& box) {
        return Vec3{(high & 1U) != 0 ? box.high.x : box.low.x, (high & 2U) != 0 ? box.high.y : box.low.y,
                    (high & 4U) != 0 ? box.high.z : box.low.z};
      };
      ways.push_back({side(there), side(here), factor});
    }
  }
  return ways;
}

PointSet::PointSet(const mesh::Surface& surface, double share)
    : size_(share * surface.bounds().largest_extent()) {
  for (const Vec3 p : surface.points()) {
    cells_.insert(cell_of(p));
  }
}

PointSet::Cell PointSet::cell_of(Vec3 p) const {
  return {std::llround(p.x / size_), std::llround(p.y / size_), std::llround(p.z / size_)};
}

bool PointSet::contains(Vec3 p) const {
  const auto [x, y, z] = cell_of(p);
  for (std::int64_t i = 0; i < 27; ++i) {
    if (cells_.count({x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1}) != 0) {
      return true;
    }
  }
  return false;
}

double PointSet::share_of(std::span<const Vec3> points) const {
  const auto found = std::count_if(points.begin(), points.end(), [&](Vec3 p) { return contains(p); });
  return static_cast<double>(found) / static_cast<double>(std::max<std::size_t>(1, points.size()));
}

/// Takes points of nets to the surface that they were made of: box to box, in the way in which most points
/// meet points of the surface. Finds the place, too, where the model grew or shrank at some sides of its box,
/// as long as one of its extents stayed. O(n log n). `points`: at least one.
Similarity same_place(std::span<const Vec3> points, const mesh::Surface& surface) {
  Box3 there;
  for (const Vec3 p : points) {
    there.add(p);
  }
  const PointSet known(surface, same_point_share);
  const std::vector<Vec3> tried = some_of(points);
  const std::vector<Similarity> ways = ways_between(there, surface.bounds());
  Similarity best = ways.front();
  double most = -1.0;
  for (const Similarity& way : ways) {
    std::vector<Vec3> placed;
    for (const Vec3 p : tried) {
      placed.push_back(way(p));
    }
    // Sums of small errors decide nothing.
    constexpr double better = 0.01;
    if (const double share = known.share_of(placed); share > most + better) {
      most = share;
      best = way;
    }
  }
  return best;
}

std::vector<std::string> names_in(const verify::Settings& settings, std::string_view key) {
  const verify::Setting* const value = settings.find(key);
  const auto* const text = value == nullptr ? nullptr : std::get_if<std::string>(value);
  std::vector<std::string> names;
  std::istringstream lines(text == nullptr ? "" : *text);
  for (std::string line; std::getline(lines, line);) {
    names.push_back(line);
  }
  return names;
}

}  // namespace

bool is_fold_file(const OldNets& old) {
  return !mesh::may_have_seams(old.bytes);
}

/// Numbers among the settings are taken over: what no option could have set is refused.
void require_numbers(const OldNets& old, const verify::Settings& settings) {
  constexpr double most = 1e6;
  for (const char* const name : {"size_mm", "mm_per_unit", "judged_at_mm", "hours"}) {
    if (settings.find(name) == nullptr) {
      continue;
    }
    const std::optional<double> length = settings.number(name);
    if (!length || !(*length > 0.0) || (name != std::string_view("mm_per_unit") && *length > most)) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("{}: its setting \"{}\" is nothing that an option takes", old.name, name),
                  old.name);
    }
  }
}

verify::File read_fold_file(const OldNets& old) {
  try {
    verify::File file = verify::read_file(old.bytes);
    require_numbers(old, file.settings);
    return file;
  } catch (const verify::NotInForm& reason) {
    throw Error(ErrorKind::unreadable_input, old.name + ": " + reason.message, old.name);
  }
}

prepare::Selection selection_of(std::string_view fold_file) {
  try {
    const verify::Settings settings = verify::read_file(fold_file).settings;
    return {names_in(settings, "only"), names_in(settings, "without")};
  } catch (const verify::NotInForm&) {
    return {};  // the check says what is wrong with it
  }
}

namespace {

/// Points of one model and of its nets that are one, as a share of the model's largest extent: FOLD files
/// keep all digits, so rounding alone lies between them.
constexpr double unchanged_share = 1e-6;
/// Flat regions are remeshed, so even nets of the model as it is lack some of its points, and have others
/// where a page cut a region.
constexpr double most_other_points = 0.1;

std::optional<prepare::SimplifyOptions> simplified_by(const verify::Settings& settings) {
  prepare::SimplifyOptions simplify;
  if (const std::optional<double> faces = settings.number("faces")) {
    simplify.mode = prepare::Simplification::count;
    simplify.faces = static_cast<std::size_t>(*faces);
    return simplify;
  }
  if (const std::optional<double> hours = settings.number("hours")) {
    simplify.budget.hours = *hours;
  }
  const verify::Setting* const word = settings.find("faces");
  const auto* const text = word == nullptr ? nullptr : std::get_if<std::string>(word);
  return text != nullptr && *text == "auto" ? std::optional(simplify) : std::nullopt;
}

/// Millimetres of the nets for 1 of the model's surface.
std::optional<double> scale_of(const verify::Settings& settings, const mesh::Model& model) {
  if (const auto factor = settings.number("mm_per_unit")) {
    return *factor * model.file_scale;
  }
  const auto size = settings.number("size_mm");
  return size ? std::optional(*size / model.surface.bounds().largest_extent()) : std::nullopt;
}

std::string as_off(const std::vector<Vec3>& points, const verify::FaceList& faces) {
  std::string text = fmt::format("OFF\n{} {} 0\n", points.size(), faces.faces());
  for (const Vec3 p : points) {
    text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  }
  for (verify::Index face = 0; face < faces.faces(); ++face) {
    text += fmt::format("{} {}\n", faces.size(face), fmt::join(faces.vertices(face), " "));
  }
  return text;
}

}  // namespace

std::optional<prepare::SimplifyOptions> simplified_by(const OldNets& old) {
  return is_fold_file(old) ? simplified_by(read_fold_file(old).settings) : std::nullopt;
}

std::optional<ModelOfNets> model_of_nets(const OldNets& old, const mesh::Model& model,
                                         const Context& context) {
  if (!is_fold_file(old)) {
    return std::nullopt;
  }
  const verify::File nets = read_fold_file(old);
  const auto simplify = simplified_by(nets.settings);
  const auto scale = scale_of(nets.settings, model);
  if (!simplify || !scale || nets.digest != model.digest || nets.model.points.empty()) {
    return std::nullopt;
  }
  // prepare() puts the middle of a model's box at the origin.
  const Vec3 middle = 0.5 * (model.surface.bounds().low + model.surface.bounds().high);
  std::vector<Vec3> points;
  for (const Vec3 p : nets.model.points) {
    points.push_back(p / *scale + middle);
  }
  if (PointSet(model.surface, unchanged_share).share_of(points) >= 1.0 - most_other_points) {
    return std::nullopt;
  }
  mesh::Model found = mesh::read({as_off(points, nets.model.faces), old.name, model.name, {}}, {}, context);
  found.digest = model.digest;
  found.frame = model.frame;
  found.format = model.format;
  found.repairs = model.repairs;
  found.polygon_count = model.polygon_count;
  found.file_scale = model.file_scale;
  found.file_points = model.file_points;
  return ModelOfNets{std::move(found), *simplify};
}

namespace {

using unfold::EdgeConstraint;
using unfold::EdgeConstraints;
using unfold::Segment;
using unfold::SegmentCount;

/// A model may have changed since its nets were made; what shares fewer edges with them is another one.
constexpr double most_lost = 0.9;

struct Seams {
  std::vector<Segment> cut, keep;
};

/// The folds and cuts of nets of our own.
Seams seams_of_fold(const OldNets& old, const mesh::Surface& surface) {
  const verify::File nets = read_fold_file(old);
  const Similarity rescaled = same_place(nets.model.points, surface);
  const auto point = [&](verify::Index v) { return rescaled(nets.model.points[v]); };
  Seams seams;
  for (verify::Index side = 0; side < nets.faces.sides(); ++side) {
    const verify::Index face = nets.faces.face(side);
    const verify::Index there_side =
        nets.model.faces.first(nets.face_model[face]) + side - nets.faces.first(face);
    if (nets.model.twin[there_side] == verify::none) {
      continue;
    }
    const bool cut = nets.edges[nets.side_edge[side]].assignment == verify::Assignment::cut;
    (cut ? seams.cut : seams.keep)
        .push_back({point(nets.model.faces.tail(there_side)), point(nets.model.faces.head(there_side))});
  }
  return seams;
}

/// Largest extent of the model that nets of our own were made for, mm; none where they don't tell.
std::optional<double> size_of(const OldNets& old) {
  if (!is_fold_file(old)) {
    return std::nullopt;
  }
  const verify::File nets = read_fold_file(old);
  if (const auto size = nets.settings.number("size_mm")) {
    return size;
  }
  Box3 box;
  for (const Vec3 p : nets.model.points) {
    box.add(p);
  }
  return box.largest_extent() > 0.0 ? std::optional(box.largest_extent()) : std::nullopt;
}

/// At which size of the model nets of our own leave out what is too small; none where they don't tell.
std::optional<double> judged_at(const OldNets& old) {
  if (!is_fold_file(old)) {
    return std::nullopt;
  }
  const verify::File nets = read_fold_file(old);
  const auto judged = nets.settings.number("judged_at_mm");
  return judged ? judged : nets.settings.number("size_mm");
}

/// Those of nets that another program keeps with its model.
Seams seams_of_model_file(const OldNets& old, const mesh::Surface& surface, const Context& context) {
  const mesh::FileSeams file = mesh::read_seams(old.bytes, old.name, context);
  const Similarity rescaled = same_place(file.points, surface);
  Seams seams;
  for (const Segment& edge : file.cut) {
    seams.cut.push_back({rescaled(edge[0]), rescaled(edge[1])});
  }
  for (const Segment& edge : file.keep) {
    seams.keep.push_back({rescaled(edge[0]), rescaled(edge[1])});
  }
  return seams;
}

/// `what`: "cuts" or "keeps".
void note_count(const SegmentCount& count, const std::string& what, std::vector<Message>& notes) {
  const std::size_t all = count.found + count.flat + count.lost;
  if (count.flat > 0) {
    notes.push_back(Message(what + "_in_flat", {{"n", count.flat}, {"all", all}}));
  }
  if (count.lost > 0) {
    notes.push_back(Message(what + "_lost", {{"n", count.lost}, {"all", all}}));
  }
}

/// Cuts and edges to be kept, matched each for itself so that contradictions show. Of these the cut counts:
/// it can always be made, and what is kept is a constraint that may fail for other reasons, too.
EdgeConstraints constraints_asked(const prepare::Prepared& prepared, const std::vector<Segment>& cut,
                                  const std::vector<Segment>& keep, const Context& context,
                                  std::vector<Message>& notes) {
  const auto match = [&](const std::vector<Segment>& to_cut, const std::vector<Segment>& to_keep) {
    return unfold::match_segments(prepared.model.surface, prepared.panels, to_cut, to_keep, context);
  };
  auto [constraints, cuts, none] = match(cut, {});
  const unfold::MatchedSegments kept = match({}, keep);
  std::size_t both = 0;
  for (const EdgeId e : ids<EdgeId>(constraints.size())) {
    both += constraints[e] == EdgeConstraint::cut && kept.constraints[e] == EdgeConstraint::keep ? 1U : 0U;
    constraints[e] = constraints[e] == EdgeConstraint::none ? kept.constraints[e] : constraints[e];
  }
  if (both > 0) {
    notes.push_back(Message("cut_and_kept", {{"n", both}}));
  }
  note_count(cuts, "cuts", notes);
  note_count(kept.keep, "keeps", notes);
  return std::move(constraints);
}

EdgeConstraints constraints_from_nets(const OldNets& old, const prepare::Prepared& prepared,
                                      const Context& context, std::vector<Message>& notes) {
  const mesh::Surface& surface = prepared.model.surface;
  const Seams seams =
      is_fold_file(old) ? seams_of_fold(old, surface) : seams_of_model_file(old, surface, context);
  auto [constraints, cuts, keeps] =
      unfold::match_segments(surface, prepared.panels, seams.cut, seams.keep, context);
  const std::size_t lost = cuts.lost + keeps.lost;
  const std::size_t all = seams.cut.size() + seams.keep.size();
  if (static_cast<double>(lost) > most_lost * static_cast<double>(all)) {
    throw Error(ErrorKind::unusable_mesh,
                Message("nets_of_another_model", {{"file", old.name}, {"n", lost}, {"all", all}}), old.name);
  }
  if (lost > 0) {
    notes.push_back(Message("old_edges_lost", {{"n", lost}, {"all", all}, {"file", old.name}}));
  }
  return std::move(constraints);
}

/// Edges by the numbers of their ends, at their places.
std::vector<Segment> segments_of(const std::optional<EdgeList>& list, const mesh::Model& model) {
  std::vector<Segment> segments;
  if (list) {
    for (const auto& [from, to] : list->edges) {
      segments.push_back({model.file_points.at(from), model.file_points.at(to)});
    }
  }
  return segments;
}

/// Before any work is done for edges that can't be found.
void require_points(const std::optional<EdgeList>& list, const mesh::Model& model) {
  if (!list) {
    return;
  }
  for (const auto& edge : list->edges) {
    const std::uint32_t last = std::max(edge[0], edge[1]);
    if (last >= model.file_points.size()) {
      throw Error(ErrorKind::unreadable_input,
                  Message("no_such_point", {{"point", last}, {"all", model.file_points.size()}}));
    }
  }
}

}  // namespace

void apply_edge_requests(const EdgeRequests& edges, mesh::Model& model, prepare::SimplifyOptions& simplify,
                         std::vector<Message>& notes) {
  require_points(edges.cut, model);
  require_points(edges.keep, model);
  if (edges.from) {
    model.lines.clear();
  } else if (2 * model.lines.size() > model.surface.edge_count()) {
    notes.emplace_back("most_edges_marked");
    model.lines.clear();
  }
  if (simplify.mode != prepare::Simplification::automatic || (!edges.any() && model.lines.empty())) {
    return;
  }
  const bool of_points = edges.cut || edges.keep;
  if (edges.from && !of_points) {
    // A model that changed since its nets were made is simplified as it was for them.
    if (const auto before = simplified_by(*edges.from)) {
      simplify.mode = before->mode;
      simplify.faces = before->faces;
      simplify.budget = before->budget;
      return;
    }
  }
  simplify.mode = prepare::Simplification::keep;
  if (!edges.any()) {
    notes.emplace_back("marked_so_unsimplified");
  }
}

void use_size_of_nets(const EdgeRequests& edges, const mesh::Model& model, prepare::SizeOptions& size) {
  if (edges.from) {
    size.judged_at_mm = judged_at(*edges.from);
  }
  if (!size.adapts || (!edges.any() && model.lines.empty())) {
    return;
  }
  size.adapts = false;
  if (edges.from) {
    size.largest_extent_mm = size_of(*edges.from).value_or(size.largest_extent_mm);
  }
}

prepare::Bodies bodies_for(const EdgeRequests& edges, prepare::Bodies wanted) {
  if (!edges.from) {
    return wanted;
  }
  if (!is_fold_file(*edges.from)) {
    return prepare::Bodies::keep;
  }
  return read_fold_file(*edges.from).settings.find("bodies") != nullptr ? prepare::Bodies::unite
                                                                        : prepare::Bodies::keep;
}

bool parts_standing_for(const EdgeRequests& edges, bool wanted) {
  if (!edges.from) {
    return wanted;
  }
  return is_fold_file(*edges.from) && read_fold_file(*edges.from).settings.find("standing") != nullptr;
}

prepare::Skins skins_for(const EdgeRequests& edges, prepare::Skins wanted) {
  if (!edges.from || !is_fold_file(*edges.from)) {
    return wanted;
  }
  const verify::File before = read_fold_file(*edges.from);
  const verify::Setting* const skins = before.settings.find("skins");
  if (skins == nullptr) {
    return prepare::Skins::outer;
  }
  return *skins == verify::Setting("middle") ? prepare::Skins::middle : prepare::Skins::both;
}

EdgeConstraints constraints_of(const EdgeRequests& edges, const prepare::Prepared& prepared,
                               const Context& context, std::vector<Message>& notes) {
  EdgeConstraints constraints;
  if (edges.from) {
    constraints = constraints_from_nets(*edges.from, prepared, context, notes);
  }
  std::vector<Segment> cut = prepared.model.lines;
  const std::vector<Segment> named = segments_of(edges.cut, prepared.model);
  cut.insert(cut.end(), named.begin(), named.end());
  const std::vector<Segment> keep = segments_of(edges.keep, prepared.model);
  if (cut.empty() && keep.empty()) {
    return constraints;
  }
  EdgeConstraints asked = constraints_asked(prepared, cut, keep, context, notes);
  if (constraints.empty()) {
    return asked;
  }
  for (const EdgeId e : ids<EdgeId>(asked.size())) {
    constraints[e] = asked[e] != EdgeConstraint::none ? asked[e] : constraints[e];
  }
  return constraints;
}

}  // namespace ridgecraft::job
