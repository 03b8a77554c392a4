// SPDX-License-Identifier: GPL-3.0-or-later
// Models and people of an unpacked Princeton Segmentation Benchmark, and the figures of a segmentation of
// one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/context.hpp"
#include "mesh/mesh.hpp"
#include "segment/segment.hpp"

namespace ridgecraft::bench {

struct BenchmarkModel {
  int number = 0;
  mesh::Model read;
  std::vector<std::vector<std::uint32_t>> people;  ///< part of each polygon, by each person
  double seconds = 0.0;                            ///< CPU time of reading and repairing
};

/// Figures of one segmentation, or means of several.
struct Figures {
  int model = 0;
  std::string category;
  std::size_t faces = 0;
  double tolerance = 0.0;
  double parts = 0.0;
  double volume = 0.0;   ///< of the union of the parts' hulls over that of the model
  double seconds = 0.0;  ///< CPU time of reading and segmenting
  double reading = 0.0;
  double rand = 0.0;        ///< 1 - Rand index, mean over the people
  double worst = 0.0;       ///< greatest concavity of a part
  std::size_t outside = 0;  ///< vertices outside a hull that must hold them
};

[[nodiscard]] int category_number(int model);  ///< from 0 on
[[nodiscard]] std::string category_of(int model);
/// Numbers of the models in the folder; `subset`: only the first and the ninth of each category.
[[nodiscard]] std::vector<int> models_in(const std::filesystem::path& psb, bool subset);
/// Reads `off/NUMBER.off` and, where they are, the files of `seg/NUMBER`.
[[nodiscard]] BenchmarkModel read_model(const std::filesystem::path& psb, int number, const Context& context);
/// Parts, volume and agreement of a labeling of the faces; the rest stays 0.
[[nodiscard]] Figures judge(const BenchmarkModel& model, std::span<const std::uint32_t> part_of_face,
                            const Context& context);
/// How many vertices lie outside the hull of a part with a face of theirs, in exact arithmetic on the grid of
/// segment/surface/scaled_surface.hpp (2^-40 of the model's radius). Hulls are those of the reported hull
/// vertices.
[[nodiscard]] std::size_t outside_hulls(const mesh::Surface& surface,
                                        const segment::Segmentation& segmentation);
/// Means; `worst` is the greatest, `outside` the sum, model and category are the first's.
[[nodiscard]] Figures mean_of(std::span<const Figures> rows);
/// One line for machines.
[[nodiscard]] std::string json_line(const Figures& figures);
/// CPU time of this process.
[[nodiscard]] double cpu_seconds();

}  // namespace ridgecraft::bench
