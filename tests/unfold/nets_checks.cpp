// SPDX-License-Identifier: GPL-3.0-or-later
#include "unfold/nets_checks.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "unfold/net/chains.hpp"

namespace ridgecraft::test {
namespace {

using unfold::EdgeUse;
using unfold::Nets;

class Faults {
 public:
  void expect(bool holds, const std::string& what) {
    if (!holds && list.size() < 20) {
      list.push_back(what);
    }
  }
  std::vector<std::string> list;
};

/// Area of the intersection by clipping one triangle at the sides of the other (I. Sutherland, G. Hodgman
/// 1974).
double common_area(std::vector<Vec2> polygon, const std::array<Vec2, 3>& clip) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a = clip[k];
    const Vec2 along = clip[(k + 1) % 3] - a;
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 p = polygon[i];
      const Vec2 q = polygon[(i + 1) % polygon.size()];
      const double dp = cross(along, p - a);
      const double dq = cross(along, q - a);
      if (dp >= 0.0) {
        kept.push_back(p);
      }
      if ((dp > 0.0 && dq < 0.0) || (dp < 0.0 && dq > 0.0)) {
        kept.push_back(p + (dp / (dp - dq)) * (q - p));
      }
    }
    polygon = std::move(kept);
  }
  double doubled = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    doubled += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return 0.5 * doubled;
}

void check_faces(const mesh::Surface& surface, const Nets& nets, Faults& faults) {
  std::vector<int> seen(surface.face_count(), 0);
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    const auto& piece = nets.pieces[p];
    faults.expect(!piece.faces.empty(), "a piece without faces");
    faults.expect(std::is_sorted(piece.faces.begin(), piece.faces.end()), "faces not ascending");
    for (const FaceId f : piece.faces) {
      ++seen[f.value()];
      faults.expect(nets.piece[f] == p, "piece of face differs");
    }
  }
  const double slack = 1e-9 * std::max(1e-30, surface.bounds().diagonal());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faults.expect(seen[f.value()] == 1, "face " + std::to_string(f.value()) + " not exactly once");
    const auto& flat = nets.flat[f];
    for (unsigned k = 0; k < 3; ++k) {
      const double expected = surface.length(surface.edge(mesh::corner(f, k)));
      faults.expect(std::abs(length(flat[(k + 1) % 3] - flat[k]) - expected) <= slack, "length not kept");
    }
    faults.expect(cross(flat[1] - flat[0], flat[2] - flat[0]) >= -slack * slack, "face mirrored");
  }
}

/// The cut that follows a side around its piece, found without the outline's code: over the folds at its end.
CornerId following(const mesh::Surface& surface, const Nets& nets, CornerId side) {
  CornerId next = mesh::next(side);
  while (nets.use[surface.edge(next)] == EdgeUse::fold) {
    next = mesh::next(surface.twin(next));
  }
  return next;
}

/// Each join in one chain; a chain is the same edges in a row on both outlines, one way round on the one and
/// the other way round on the other.
void check_chains(const mesh::Surface& surface, const Nets& nets, Faults& faults) {
  std::set<JoinId> seen;
  std::uint32_t number = 0;
  for (const unfold::Chain& chain : unfold::chains_of(surface, nets)) {
    faults.expect(chain.number == ++number, "chains not numbered from 1");
    faults.expect(!chain.joins.empty() && chain.joins.size() == chain.sides.size(), "chain without joins");
    for (std::size_t i = 0; i < chain.joins.size(); ++i) {
      const unfold::Join& join = nets.joins[chain.joins[i]];
      const CornerId side = chain.sides[i];
      faults.expect(seen.insert(chain.joins[i]).second, "join in two chains");
      faults.expect(join.number == chain.number, "join has another number than its chain");
      faults.expect(surface.edge(side) == join.edge, "side of another join");
      faults.expect(nets.piece[mesh::face_of(side)] == chain.pieces[0] &&
                        nets.piece[mesh::face_of(surface.twin(side))] == chain.pieces[1],
                    "chain between other pieces");
      faults.expect(i == 0 || chain.joins[i - 1].value() + 1 == chain.joins[i].value(),
                    "joins of a chain not in a row");
      faults.expect(
          i == 0 || (following(surface, nets, chain.sides[i - 1]) == side &&
                     following(surface, nets, surface.twin(side)) == surface.twin(chain.sides[i - 1])),
          "edges of a chain don't follow each other on both pieces");
    }
  }
  faults.expect(seen.size() == nets.joins.size(), "join in no chain");
}

void check_edges(const mesh::Surface& surface, const Nets& nets, Faults& faults) {
  std::set<EdgeId> joined;
  check_chains(surface, nets, faults);
  for (const auto& join : nets.joins) {
    faults.expect(joined.insert(join.edge).second, "edge joined twice");
    faults.expect(nets.use[join.edge] == EdgeUse::cut, "join of an edge that is no cut");
  }
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    faults.expect((nets.use[e] == EdgeUse::border) == surface.is_border(e), "border wrong");
    faults.expect((nets.use[e] == EdgeUse::cut) == joined.contains(e), "cut without join");
    if (nets.use[e] == EdgeUse::fold) {
      const auto at = [&](CornerId corner) { return nets.flat[mesh::face_of(corner)][corner.value() % 3]; };
      faults.expect(nets.piece[mesh::face_of(c)] == nets.piece[mesh::face_of(d)], "fold between pieces");
      faults.expect(length(at(c) - at(mesh::next(d))) < 2e-6 && length(at(mesh::next(c)) - at(d)) < 2e-6,
                    "copies of a fold apart");
    }
  }
}

/// Connected over folds, a disc with the stated holes, no two edges with the same two ends.
void check_patches(const mesh::Surface& surface, const Nets& nets, Faults& faults) {
  std::vector<std::uint32_t> vertex(surface.corner_count());
  std::vector<std::uint32_t> piece(surface.face_count());
  for (std::uint32_t c = 0; c < vertex.size(); ++c) {
    vertex[c] = c;
  }
  for (std::uint32_t f = 0; f < piece.size(); ++f) {
    piece[f] = f;
  }
  const auto join = [](std::vector<std::uint32_t>& label, std::uint32_t a, std::uint32_t b) {
    while (label[a] != a) {
      a = label[a];
    }
    while (label[b] != b) {
      b = label[b];
    }
    label[std::max(a, b)] = std::min(a, b);
  };
  const auto root = [](const std::vector<std::uint32_t>& label, std::uint32_t a) {
    while (label[a] != a) {
      a = label[a];
    }
    return a;
  };
  for (const EdgeId e : ids<EdgeId>(surface.edge_count())) {
    const auto [c, d] = surface.sides(e);
    if (nets.use[e] == EdgeUse::fold) {
      join(vertex, c.value(), mesh::next(d).value());
      join(vertex, mesh::next(c).value(), d.value());
      join(piece, mesh::face_of(c).value(), mesh::face_of(d).value());
    }
  }
  std::map<PieceId, std::set<std::uint32_t>> roots;
  std::map<PieceId, long> euler;
  std::set<std::pair<std::uint32_t, std::uint32_t>> ends;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    roots[nets.piece[f]].insert(root(piece, f.value()));
    ++euler[nets.piece[f]];
  }
  for (const CornerId c : ids<CornerId>(surface.corner_count())) {
    const PieceId p = nets.piece[mesh::face_of(c)];
    euler[p] += root(vertex, c.value()) == c.value() ? 1 : 0;
    const EdgeId e = surface.edge(c);
    const bool second_side = nets.use[e] == EdgeUse::fold && surface.sides(e)[0] != c;
    if (!second_side) {
      --euler[p];
      const std::pair<std::uint32_t, std::uint32_t> pair =
          std::minmax({root(vertex, c.value()), root(vertex, mesh::next(c).value())});
      faults.expect(ends.insert(pair).second, "two edges with the same two ends");
    }
  }
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    faults.expect(roots[p].size() == 1, "piece not connected over folds");
    faults.expect(euler[p] == 1 - static_cast<long>(nets.pieces[p].holes), "holes of a piece wrong");
  }
}

void check_overlaps(const Nets& nets, Faults& faults) {
  for (const auto& piece : nets.pieces) {
    for (std::size_t i = 0; i < piece.faces.size(); ++i) {
      const auto& a = nets.flat[piece.faces[i]];
      for (std::size_t j = 0; j < i; ++j) {
        const auto& b = nets.flat[piece.faces[j]];
        const auto [al, ah] = std::minmax({a[0].x, a[1].x, a[2].x});
        const auto [bl, bh] = std::minmax({b[0].x, b[1].x, b[2].x});
        if (al >= bh || bl >= ah) {
          continue;
        }
        double longest = 0.0;
        for (unsigned k = 0; k < 3; ++k) {
          longest = std::max({longest, length(a[(k + 1) % 3] - a[k]), length(b[(k + 1) % 3] - b[k])});
        }
        // An overlap of the permitted depth has at most that depth times the longest side as its area.
        faults.expect(common_area({b.begin(), b.end()}, a) <= 1e-3 * longest,
                      "faces " + std::to_string(piece.faces[i].value()) + " and " +
                          std::to_string(piece.faces[j].value()) + " overlap");
      }
    }
  }
}

void check_sheet(const Nets& nets, const unfold::Options& options, Faults& faults) {
  if (!options.sheet) {
    return;
  }
  for (const auto& piece : nets.pieces) {
    bool fits = false;
    for (int step = 0; step < 1440 && !fits; ++step) {
      const double angle = step * 3.14159265358979323846 / 1440.0;
      const Vec2 u{std::cos(angle), std::sin(angle)};
      Box2 box;
      for (const FaceId f : piece.faces) {
        for (const Vec2 p : nets.flat[f]) {
          box.add({dot(u, p), cross(u, p)});
        }
      }
      for (const auto& tab : nets.tabs) {
        if (nets.piece[mesh::face_of(tab.side)] == nets.piece[piece.faces.front()]) {
          for (const Vec2 p : tab.polygon) {
            box.add({dot(u, p), cross(u, p)});
          }
        }
      }
      // Tried in steps of an eighth of a degree, hence the slack.
      const Vec2 size = box.size();
      fits = size.x <= 1.002 * options.sheet->width && size.y <= 1.002 * options.sheet->height;
    }
    faults.expect(fits, "piece " + piece.name + " doesn't fit the sheet");
  }
}

}  // namespace

std::vector<std::string> faults_of(const mesh::Surface& surface, const Nets& nets,
                                   const unfold::Options& options) {
  Faults faults;
  check_faces(surface, nets, faults);
  check_edges(surface, nets, faults);
  check_patches(surface, nets, faults);
  check_overlaps(nets, faults);
  check_sheet(nets, options, faults);
  std::set<std::string> names;
  for (const auto& piece : nets.pieces) {
    faults.expect(names.insert(piece.name).second, "two pieces have one name");
  }
  return faults.list;
}

unfold::Options on_sheet(double width, double height) {
  unfold::Options options;
  options.sheet = unfold::Sheet{width, height};
  return options;
}

prepare::Panels no_panels(const mesh::Surface& surface) {
  prepare::Panels panels;
  panels.panel.resize(surface.face_count());
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    panels.panel[f] = PanelId(f.value());
    panels.faces.push_back({f});
  }
  return panels;
}

unfold::Patch whole_patch(const mesh::Surface& surface) {
  return whole_patch(surface, no_panels(surface));
}

unfold::Patch whole_patch(const mesh::Surface& surface, const prepare::Panels& panels,
                          std::span<const std::uint32_t> labels) {
  std::vector<FaceId> faces;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    faces.push_back(f);
  }
  return unfold::make_patch(surface, panels, faces, {}, labels);
}

unfold::Folds random_tree(const unfold::Patch& patch, Random& random) {
  unfold::Patch lengths = patch;
  for (std::uint32_t side = 0; side < patch.twin.size(); ++side) {
    if (patch.twin[side] != no_index && side < patch.twin[side]) {
      lengths.length[side] = lengths.length[patch.twin[side]] = random.unit();
    }
  }
  return unfold::start_tree(lengths, random);
}

unfold::NetFound net_of(const unfold::Patch& patch, const unfold::Folds& start, std::uint64_t seed) {
  return unfold::find_net(patch, start, unfold::net_tolerance(patch.extent), seed, {});
}

unfold::NetFound net_of(const unfold::Patch& patch, std::uint64_t seed) {
  Random random(seed);
  return net_of(patch, unfold::start_tree(patch, random), seed);
}

std::vector<std::uint32_t> grown(const unfold::Patch& patch, std::size_t size, Random& random) {
  std::vector<std::uint32_t> faces{random.below(patch.size())};
  while (faces.size() < size) {
    const std::uint32_t from = faces[random.below(static_cast<std::uint32_t>(faces.size()))];
    const std::uint32_t twin = patch.twin[3 * from + random.below(3)];
    if (twin != no_index && std::find(faces.begin(), faces.end(), twin / 3) == faces.end()) {
      faces.push_back(twin / 3);
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

IdVector<FaceId, PartId> one_part(const mesh::Surface& surface) {
  return IdVector<FaceId, PartId>(surface.face_count(), PartId(0));
}

unfold::Nets default_nets(const mesh::Surface& surface) {
  return unfold::unfold(surface, flat_panels(surface), one_part(surface), {}, {});
}

mesh::Surface read_off(const std::string& path) {
  std::ifstream in(path);
  std::string word;
  std::size_t points = 0;
  std::size_t faces = 0;
  std::size_t edges = 0;
  in >> word >> points >> faces >> edges;
  std::vector<Vec3> p(points);
  for (Vec3& q : p) {
    in >> q.x >> q.y >> q.z;
  }
  std::vector<std::array<VertexId, 3>> triangles(faces);
  for (auto& t : triangles) {
    unsigned count = 0;
    unsigned a = 0;
    unsigned b = 0;
    unsigned c = 0;
    in >> count >> a >> b >> c;
    t = {VertexId(a), VertexId(b), VertexId(c)};
  }
  return {std::move(p), std::move(triangles)};
}

std::vector<std::string> shared_models() {
  std::vector<std::string> paths;
  const std::filesystem::path folder = std::filesystem::path(RIDGECRAFT_SHARED_DIR) / "models" / "unfold";
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".off") {
        paths.push_back(entry.path().string());
      }
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace ridgecraft::test
