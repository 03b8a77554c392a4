// SPDX-License-Identifier: GPL-3.0-or-later
// How a model becomes paper: all that a user chooses, as values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "export/machine/thick_nets.hpp"
#include "export/sheet/pages.hpp"
#include "export/sheet/paper.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/options.hpp"
#include "prepare/prepared/prepared.hpp"
#include "prepare/selection/selection.hpp"
#include "unfold/net/options.hpp"

namespace ridgecraft::job {

/// Edges by the numbers of their ends: indices into mesh::Model::file_points
/// (mesh::ReadOptions::keep_points).
struct EdgeList {
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::string
      digest;  ///< of the text that they were read from (base/encodings.hpp); kept as a setting of the nets
};

/// Nets made before: the bytes of their FOLD file, or of a model's file that holds nets
/// (mesh/reading/pdo/read_pdo.hpp).
struct OldNets {
  std::string name;  ///< for messages: the file's name
  std::string bytes;
};

/// Edges that a user wants cut or kept together. What is to be cut and kept is cut; both count more than nets
/// made before, and edges that the model's file marks (mesh::Model::lines) are cut, too.
struct EdgeRequests {
  std::optional<EdgeList> cut, keep;
  std::optional<OldNets> from;

  [[nodiscard]] bool any() const { return cut || keep || from; }
};

/// Extents of a model that stands as its guide shows it: from its left to its right, from its back to its
/// front, from its foot to its top.
enum class ExtentKind { width, depth, height };

/// How large the model is to be in one direction.
struct Extent {
  ExtentKind kind = ExtentKind::height;
  double mm = 150.0;
};

/// Which faces are unfolded together.
enum class PartsFrom {
  segmentation,  ///< nearly convex parts
  components,    ///< each component as a whole
};

/// What the pieces of a page have in common, for paper in several colours.
enum class PageBy { any, material, object };

/// All that a whole job can be told; members that stages share are theirs.
struct Options {
  prepare::Selection selection;
  /// Bodies that touch or run into each other become one skin. Not where a model's file holds nets that are
  /// taken over (EdgeRequests::from): these are of its bodies; nets of our own tell which it was.
  prepare::Bodies bodies = prepare::Bodies::unite;
  prepare::SizeOptions size;
  std::optional<Extent> extent;  ///< instead of the size's largest extent
  /// Which axis of the file's points up, for the guide, the page and `extent`; none: as export_::up_axis_of()
  /// finds.
  std::optional<mesh::Axis> up;
  prepare::SimplifyOptions simplify;  ///< its hidden_fold_angle is that of `style`, whatever stands here
  PartsFrom parts = PartsFrom::segmentation;
  double concavity = 0.1;  ///< segment::Options::concavity
  std::optional<export_::Paper> paper{
      export_::Paper{}};  ///< none: nets without pages, each as large as it likes
  unfold::TabOptions tabs;
  unfold::TabChoice tab_choice;  ///< of tabs on the finished nets
  std::string tab_file_digest;   ///< of the text that tab_choice.edges was read from, or nothing
  unfold::PieceRules pieces = unfold::rules_of_single_parts();
  unfold::PanelCuts panel_cuts = unfold::PanelCuts::only_if_too_large;
  EdgeRequests edges;
  export_::Style style;
  PageBy page_by = PageBy::any;
  export_::Board board;  ///< what pages are cut from; nets in files stay those of paper
  bool guide = false;    ///< pages that tell how the model is built; with paper only
  bool strict = false;   ///< what nobody could build at this size isn't made
};

/// What a job used where it decides more than its options say: where edges are named that are those of the
/// file, `simplify` keeps all faces; where no bodies were united, `bodies` keeps them; `size` is the size
/// that was chosen.
struct UsedOptions {
  prepare::Bodies bodies = prepare::Bodies::unite;
  prepare::SizeOptions size;
  prepare::SimplifyOptions simplify;
};

}  // namespace ridgecraft::job
