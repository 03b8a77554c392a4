// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of a step: which pieces, what is glued to what.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "export/assembly/assembly.hpp"
#include "export/sheet/bodies.hpp"
#include "export/view/camera.hpp"
#include "mesh/model/surface.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

/// "C", "C and D", "C, D, E", "C to N (12)".
[[nodiscard]] std::string step_title(const unfold::Nets& nets, const AssemblyStep& step);

/// Sentences, in the order in which they are done: "Close 3-5 first.", "Glue to A: 1, 2; to B: 7.", "Hard: 7
/// (no tab).", "...".
[[nodiscard]] std::vector<std::string> step_sentences(const mesh::Surface& surface, const unfold::Nets& nets,
                                                      const Assembly& assembly, std::size_t step,
                                                      std::span<const Body> bodies);

/// The pieces that stand before the step and are glued to its pieces, ascending.
[[nodiscard]] std::vector<PieceId> glued_before(const mesh::Surface& surface, const unfold::Nets& nets,
                                                const AssemblyStep& step);

/// Two pieces of which one is the mirror image of the other, and no third is like them.
struct MirrorPair {
  PieceId piece, image;
};
/// The pairs that a step's pieces belong to; the other piece may come in another step. In the order of the
/// step's pieces, none twice.
[[nodiscard]] std::vector<MirrorPair> mirror_pairs(const unfold::Nets& nets, const AssemblyStep& step);

/// Which of two mirror images is where: "Of the mirror images C and G, C is on the left here." Empty where
/// one lies before the other.
[[nodiscard]] std::string words_of_sides(const mesh::Surface& surface, const unfold::Nets& nets,
                                         const MirrorPair& pair, const Camera& camera);

}  // namespace ridgecraft::export_
