// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold of every result of unfold(), checked from the nets alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "prepare/prepared/panels.hpp"
#include "support/flat_panels.hpp"
#include "unfold/patch/patch.hpp"
#include "unfold/patch/tree.hpp"
#include "unfold/search/net_search.hpp"
#include "unfold/unfold.hpp"

namespace ridgecraft::test {

/// Depth to which faces of a net may lie over each other without a fault, mm.
inline constexpr double tolerance = 1e-5;

/// What faults_of() gives where nothing is wrong.
inline const std::vector<std::string> none;

/// Sentences about what is wrong; empty when nothing is.
[[nodiscard]] std::vector<std::string> faults_of(const mesh::Surface& surface, const unfold::Nets& nets,
                                                 const unfold::Options& options);

/// Default options on a sheet of this size, mm.
[[nodiscard]] unfold::Options on_sheet(double width, double height);

/// Every face in a panel of its own.
[[nodiscard]] prepare::Panels no_panels(const mesh::Surface& surface);
/// All faces as one patch, each a panel of its own, or in these panels.
[[nodiscard]] unfold::Patch whole_patch(const mesh::Surface& surface);
[[nodiscard]] unfold::Patch whole_patch(const mesh::Surface& surface, const prepare::Panels& panels,
                                        std::span<const std::uint32_t> labels = {});
/// Any spanning tree that holds as many frozen sides as a tree can.
[[nodiscard]] unfold::Folds random_tree(const unfold::Patch& patch, Random& random);
/// What find_net finds from this tree.
[[nodiscard]] unfold::NetFound net_of(const unfold::Patch& patch, const unfold::Folds& start,
                                      std::uint64_t seed);
/// What it finds from that of the shortest cuts.
[[nodiscard]] unfold::NetFound net_of(const unfold::Patch& patch, std::uint64_t seed);
/// `size` faces of a patch that grow from one of them at random, in order.
[[nodiscard]] std::vector<std::uint32_t> grown(const unfold::Patch& patch, std::size_t size, Random& random);
/// All faces in part 0.
[[nodiscard]] IdVector<FaceId, PartId> one_part(const mesh::Surface& surface);
/// Of flat panels and one part, with default options.
[[nodiscard]] unfold::Nets default_nets(const mesh::Surface& surface);
/// The triangles of an OFF file.
[[nodiscard]] mesh::Surface read_off(const std::string& path);
/// The models of ../shared/models/unfold, or none where the folder is missing.
[[nodiscard]] std::vector<std::string> shared_models();

}  // namespace ridgecraft::test
