// SPDX-License-Identifier: GPL-3.0-or-later
// Words of the guide: how they are set in lines, and what a step says.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/assembly/assembly.hpp"
#include "export/sheet/bodies.hpp"
#include "export/sheet/drawing.hpp"
#include "export/view/camera.hpp"
#include "mesh/model/surface.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/nets.hpp"

namespace ridgecraft::export_ {

enum class Weight {
  plain,
  bold,
  heading,  ///< bold, and what the words below it are about
  title,    ///< that of the whole guide
};

/// A text whose baseline begins at `at`.
[[nodiscard]] Text words_from(std::string_view words, Vec2 at, double height, Weight weight = Weight::plain);
/// A text whose baseline ends at `at`.
[[nodiscard]] Text words_to(std::string_view words, Vec2 at, double height, Weight weight = Weight::plain);

struct Callout {
  std::string words;
  Vec2 anchor;  ///< on the page
};

/// Where names may stand: two columns, left and right of a picture.
struct CalloutColumns {
  Box2 box;                 ///< outer ends of the columns, mm
  double left_edge = 0.0;   ///< the left column's words end here ...
  double right_edge = 0.0;  ///< ... and those of the right one begin here
  double height = 2.2;      ///< of the words, mm
};

/// Adds as many as have room, the first ones first: each in the nearer column, or in the other one where that
/// is full, as near to the height of its anchor as others leave room; lines of one column don't cross.
/// Returns how many have found room.
std::size_t add_callouts(const std::vector<Callout>& callouts, const CalloutColumns& columns, Group& group);

/// "C", "C and D", "C, D, E", "C to N (12)".
[[nodiscard]] std::string step_title(const unfold::Nets& nets, const AssemblyStep& step);

/// Sentences, in the order in which they are done: "Roll C round a pen of 12 mm.", "Close 3-5 first.", "Glue
/// to A: 1, 2; to B: 7.", "Hard: 7 (no tab).", "...".
[[nodiscard]] std::vector<std::string> step_sentences(const prepare::Prepared& model,
                                                      const unfold::Nets& nets, const Assembly& assembly,
                                                      std::size_t step, std::span<const Body> bodies);

/// What the picture of a step shows, for whoever doesn't see it: "C and D, glued to A".
[[nodiscard]] std::string picture_words(const mesh::Surface& surface, const unfold::Nets& nets,
                                        const AssemblyStep& step);

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
