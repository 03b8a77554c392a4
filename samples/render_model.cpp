// SPDX-License-Identifier: GPL-3.0-or-later
// render_model MODEL PICTURE.png [AZIMUTH ELEVATION [PIXELS]]: a flat shaded picture of a model for the
// documentation, seen from the given direction (degrees; 0 0 looks at its front, 90 0 at its left side).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "prepare/prepared/options.hpp"
#include "samples/picture.hpp"

namespace {

using namespace ridgecraft;

/// Folds below this are flat regions, radians: they get no line, as on paper.
constexpr double faint_fold = prepare::hidden_fold_angle;
constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

/// The flat region of each face, named by its smallest face; regions end where the material changes.
std::vector<std::uint32_t> regions(const mesh::Model& model) {
  const mesh::Surface& surface = model.surface;
  std::vector<std::uint32_t> region(surface.face_count(), nothing);
  const auto material = [&model](FaceId f) { return model.material.empty() ? 0U : model.material[f]; };
  for (const FaceId first : ids<FaceId>(surface.face_count())) {
    std::vector<FaceId> open;
    if (region[first.value()] == nothing) {
      region[first.value()] = first.value();
      open.push_back(first);
    }
    while (!open.empty()) {
      const FaceId f = open.back();
      open.pop_back();
      for (unsigned k = 0; k < 3; ++k) {
        const CornerId side = mesh::corner(f, k);
        const FaceId g = surface.neighbor(side);
        if (g.valid() && region[g.value()] == nothing && material(f) == material(g) &&
            std::abs(surface.fold_angle(surface.edge(side))) < faint_fold) {
          region[g.value()] = first.value();
          open.push_back(g);
        }
      }
    }
  }
  return region;
}

std::vector<Vec3> colours(const mesh::Model& model) {
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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 5 && argc != 6) {
    std::fputs("usage: render_model MODEL PICTURE.png [AZIMUTH ELEVATION [PIXELS]]\n", stderr);
    return 2;
  }
  try {
    const mesh::Model model = mesh::read(argv[1], {}, {});
    const samples::View view = argc > 3 ? samples::view_from(std::atof(argv[3]), std::atof(argv[4]))
                                        : samples::view_from(35.0, 20.0);
    const int pixels = argc > 5 ? std::clamp(std::atoi(argv[5]), 16, 4000) : 480;
    samples::Picture picture(model.surface, view, pixels);
    picture.paint(colours(model), regions(model));
    if (!picture.write_png(argv[2])) {
      std::fprintf(stderr, "render_model: can't write %s\n", argv[2]);
      return 1;
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "render_model: %s\n", error.what());
    return 1;
  }
  return 0;
}
