// SPDX-License-Identifier: GPL-3.0-or-later
// render MODEL PICTURE.png [--show model|ridges|valleys|regions|parts]: a flat shaded picture of a model, or
// of what the segmentation sees of it, for the documentation. Ridges, valleys and regions are of the first
// cut of the largest component.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "prepare/prepared/options.hpp"
#include "samples/picture.hpp"
#include "segment/concavity/measure.hpp"
#include "segment/concavity/valley_search.hpp"
#include "segment/cutting/cut.hpp"
#include "segment/cutting/regions.hpp"
#include "segment/segment.hpp"
#include "segment/surface/scaled_surface.hpp"

namespace {

using namespace ridgecraft;

constexpr Vec3 plain{0.86, 0.87, 0.9};
constexpr Vec3 open_to_cuts{0.62, 0.62, 0.64};
constexpr Vec3 bridge_colour{0.8, 0.1, 0.1};
constexpr Vec3 valley_colour{0.1, 0.25, 0.75};

struct Arguments {
  std::string model;
  std::string picture;
  std::string show = "model";
  double concavity = 0.1;
  double azimuth = 35.0;
  double elevation = 20.0;
  int pixels = 360;
  int divide = 0;
};

/// Colours far from each other for any number of regions: hues a golden section apart.
Vec3 colour_of(std::size_t number) {
  const double hue = std::fmod(0.08 + 0.61803398875 * static_cast<double>(number), 1.0);
  const auto channel = [&](double shift) {
    const double x = std::fmod(hue + shift, 1.0) * 6.0;
    return 0.45 + 0.5 * std::clamp(std::abs(x - 3.0) - 1.0, 0.0, 1.0);
  };
  return {channel(0.0), channel(2.0 / 3.0), channel(1.0 / 3.0)};
}

/// Each face in four: a model of few, large faces shows regions and cuts better so.
mesh::Surface divided(const mesh::Surface& surface) {
  std::vector<Vec3> points(surface.points().begin(), surface.points().end());
  std::map<std::pair<VertexId, VertexId>, VertexId> middles;
  const auto middle = [&](VertexId a, VertexId b) {
    const auto [at, fresh] = middles.try_emplace(std::minmax(a, b), VertexId(points.size()));
    if (fresh) {
      points.push_back(0.5 * (surface.point(a) + surface.point(b)));
    }
    return at->second;
  };
  std::vector<std::array<VertexId, 3>> corners;
  for (const FaceId f : ids<FaceId>(surface.face_count())) {
    const auto [a, b, c] = surface.vertices(f);
    const VertexId ab = middle(a, b);
    const VertexId bc = middle(b, c);
    const VertexId ca = middle(c, a);
    for (const auto& part : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) {
      corners.push_back(part);
    }
  }
  return {std::move(points), std::move(corners)};
}

/// Folds below this are flat regions, radians: they get no line, as on paper.
constexpr double faint_fold = prepare::hidden_fold_angle;
constexpr std::uint32_t no_region = std::numeric_limits<std::uint32_t>::max();

/// The flat region of each face, named by its smallest face; regions end where the material changes.
std::vector<std::uint32_t> flat_regions(const mesh::Model& model) {
  const mesh::Surface& surface = model.surface;
  std::vector<std::uint32_t> region(surface.face_count(), no_region);
  const auto material = [&model](FaceId f) { return model.material.empty() ? 0U : model.material[f]; };
  for (const FaceId first : ids<FaceId>(surface.face_count())) {
    std::vector<FaceId> open;
    if (region[first.value()] == no_region) {
      region[first.value()] = first.value();
      open.push_back(first);
    }
    while (!open.empty()) {
      const FaceId f = open.back();
      open.pop_back();
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId side = mesh::corner(f, k);
        const FaceId g = surface.neighbor(side);
        if (g.valid() && region[g.value()] == no_region && material(f) == material(g) &&
            std::abs(surface.fold_angle(surface.edge(side))) < faint_fold) {
          region[g.value()] = first.value();
          open.push_back(g);
        }
      }
    }
  }
  return region;
}

std::vector<Vec3> colours_of(const mesh::Model& model) {
  std::vector<Vec3> all;
  for (const FaceId f : ids<FaceId>(model.surface.face_count())) {
    mesh::Colour colour = {0.82, 0.84, 0.88};
    if (!model.material.empty() && model.material[f] != mesh::Soup::none) {
      colour = model.materials[model.material[f]].colour.value_or(colour);
    }
    all.push_back({colour[0], colour[1], colour[2]});
  }
  return all;
}

/// The first cut of the largest component, taken apart.
class FirstCut {
 public:
  FirstCut(const mesh::Surface& surface, double tolerance)
      : surface_(segment::scale_surface(surface, {})),
        weights_(segment::weigh_edges(surface_, {})),
        graph_(segment::build_vertex_graph(surface_, segment::arc_sagitta_share * tolerance)),
        measurer_(surface_, graph_, {tolerance}, context_),
        regions_(surface_) {
    segment::Cutter cutter(surface_, weights_);
    segment::Facets all(surface_.facet_count());
    std::iota(all.begin(), all.end(), 0U);
    for (segment::Facets& component : cutter.components(all)) {
      if (component.size() > component_.size()) {
        component_ = std::move(component);
      }
    }
    measurer_.measure(component_, {}, {}, measurement_);
    ridges_ = segment::find_ridges(measurement_, surface_.points);
    regions_.assign(measurer_, ridges_);
  }

  [[nodiscard]] const std::vector<segment::Ridge>& ridges() const { return ridges_; }

  /// Of each face: the ridge that it surely belongs to, or segment::fuzzy.
  [[nodiscard]] std::vector<std::uint32_t> owners() const {
    std::vector<std::uint32_t> owners(surface_.facet_count(), segment::fuzzy);
    for (const std::uint32_t f : component_) {
      owners[f] = regions_.owner(f);
    }
    return owners;
  }

  /// The deepest high bridge between each two ridges.
  [[nodiscard]] std::vector<segment::Bridge> deepest_bridges() const {
    std::map<std::uint32_t, std::size_t> ridge_of;
    for (std::size_t r = 0; r < ridges_.size(); ++r) {
      for (const std::uint32_t v : ridges_[r].vertices) {
        ridge_of[v] = r;
      }
    }
    std::map<std::pair<std::size_t, std::size_t>, segment::Bridge> deepest;
    for (const segment::Bridge& bridge : measurement_.bridges) {
      if (bridge.high) {
        const auto [at, fresh] =
            deepest.try_emplace(std::minmax(ridge_of.at(bridge.a), ridge_of.at(bridge.b)), bridge);
        if (!fresh && greatest_concavity(bridge) > greatest_concavity(at->second)) {
          at->second = bridge;
        }
      }
    }
    std::vector<segment::Bridge> bridges;
    for (const auto& [pair, bridge] : deepest) {
      bridges.push_back(bridge);
    }
    return bridges;
  }

  /// Vertices of the shortest way over the surface between a bridge's ends.
  std::vector<std::uint32_t> valley(const segment::Bridge& bridge) {
    std::vector<segment::Step> steps;
    measurer_.search().find(bridge.a, bridge.b, steps);
    std::vector<std::uint32_t> vertices;
    for (const segment::Step& step : steps) {
      vertices.push_back(step.vertex);
    }
    return vertices;
  }

 private:
  Context context_;
  segment::ScaledSurface surface_;
  segment::EdgeWeights weights_;
  segment::VertexGraph graph_;
  segment::Measurer measurer_;
  segment::Regions regions_;
  segment::Facets component_;
  segment::Measurement measurement_;
  std::vector<segment::Ridge> ridges_;
};

void paint_owners(samples::Picture& picture, const std::vector<std::uint32_t>& owners) {
  std::vector<Vec3> colours;
  for (const std::uint32_t owner : owners) {
    colours.push_back(owner == segment::fuzzy ? open_to_cuts : colour_of(owner));
  }
  picture.paint(colours, owners);
}

void paint_plain(samples::Picture& picture, const mesh::Surface& surface) {
  picture.paint(std::vector<Vec3>(surface.face_count(), plain),
                std::vector<std::uint32_t>(surface.face_count(), 0));
}

void draw_ridges(samples::Picture& picture, const mesh::Surface& surface, const FirstCut& cut) {
  paint_plain(picture, surface);
  for (std::size_t r = 0; r < cut.ridges().size(); ++r) {
    for (const std::uint32_t v : cut.ridges()[r].vertices) {
      picture.spot(surface.point(VertexId(v)), colour_of(r), 3.5);
    }
  }
}

void draw_valleys(samples::Picture& picture, const mesh::Surface& surface, FirstCut& cut) {
  paint_plain(picture, surface);
  for (const segment::Bridge& bridge : cut.deepest_bridges()) {
    std::vector<Vec3> points;
    for (const std::uint32_t v : cut.valley(bridge)) {
      points.push_back(surface.point(VertexId(v)));
    }
    picture.line(points, valley_colour, 2.5);
    picture.line(std::vector<Vec3>{points.front(), points.back()}, bridge_colour, 1.5);
  }
}

bool draw(const Arguments& arguments) {
  const mesh::Model model = mesh::read(arguments.model, {}, {});
  const samples::View view = samples::view_from(arguments.azimuth, arguments.elevation);
  if (arguments.show == "model") {
    samples::Picture picture(model.surface, view, arguments.pixels);
    picture.paint(colours_of(model), flat_regions(model));
    return picture.write_png(arguments.picture);
  }
  mesh::Surface surface = model.surface;
  for (int i = 0; i < arguments.divide; ++i) {
    surface = divided(surface);
  }
  samples::Picture picture(surface, view, arguments.pixels);
  if (arguments.show == "parts") {
    segment::Options options;
    options.concavity = arguments.concavity;
    std::vector<std::uint32_t> parts;
    for (const PartId p : segment::segment(surface, {}, options, {}).part) {
      parts.push_back(p.value());
    }
    paint_owners(picture, parts);
    return picture.write_png(arguments.picture);
  }
  FirstCut cut(surface, arguments.concavity);
  if (arguments.show == "ridges") {
    draw_ridges(picture, surface, cut);
  } else if (arguments.show == "valleys") {
    draw_valleys(picture, surface, cut);
  } else {
    paint_owners(picture, cut.owners());
  }
  return picture.write_png(arguments.picture);
}

bool parse(int argc, char** argv, Arguments& arguments) {
  if (argc < 3 || argc % 2 == 0) {
    return false;
  }
  arguments.model = argv[1];
  arguments.picture = argv[2];
  for (int i = 3; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    const char* value = argv[i + 1];
    if (option == "--show") {
      arguments.show = value;
    } else if (option == "--concavity") {
      arguments.concavity = std::atof(value);
    } else if (option == "--azimuth") {
      arguments.azimuth = std::atof(value);
    } else if (option == "--elevation") {
      arguments.elevation = std::atof(value);
    } else if (option == "--pixels") {
      arguments.pixels = std::clamp(std::atoi(value), 16, 4000);
    } else if (option == "--divide") {
      arguments.divide = std::clamp(std::atoi(value), 0, 6);
    } else {
      return false;
    }
  }
  const std::vector<std::string> shown{"model", "ridges", "valleys", "regions", "parts"};
  return std::find(shown.begin(), shown.end(), arguments.show) != shown.end();
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!parse(argc, argv, arguments)) {
    std::fputs(
        "usage: render MODEL PICTURE.png [--show model|ridges|valleys|regions|parts] [--concavity T] "
        "[--azimuth DEGREES] [--elevation DEGREES] [--pixels N] [--divide TIMES]\n",
        stderr);
    return 2;
  }
  try {
    if (!draw(arguments)) {
      std::fprintf(stderr, "render: can't write %s\n", arguments.picture.c_str());
      return 1;
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "render: %s\n", error.what());
    return 1;
  }
  return 0;
}
