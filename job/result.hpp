// SPDX-License-Identifier: GPL-3.0-or-later
// What a job comes to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/context.hpp"
#include "base/message.hpp"
#include "export/export.hpp"
#include "job/options.hpp"
#include "job/remark.hpp"
#include "job/stage_clock.hpp"
#include "mesh/model/model.hpp"
#include "prepare/prepared/panels.hpp"
#include "prepare/prepared/prepared.hpp"
#include "unfold/net/edge_constraints.hpp"
#include "unfold/net/nets.hpp"
#include "unfold/net/options.hpp"
#include "verify/verify.hpp"

namespace ridgecraft::job {

/// A finished job with all that was made on the way; every value is complete in itself.
struct Result {
  Options options;  ///< as requested
  UsedOptions used;
  std::uint64_t seed = 1;           ///< that the nets were searched with
  export_::Settings searched_with;  ///< what else they were: with_tabs and with_pages change `options` alone
  /// What was done to the nets by hand, a step a line (with_nets); kept as a setting of the file. Where
  /// with_tabs() or with_pages() lay them out anew, that is the step `laid_out_anew`.
  std::string edits;
  /// A ground that the model stands on (prepare::ground_name): leaving it out makes the rest larger.
  std::optional<std::string> ground;
  mesh::Axis up = mesh::Axis::y;   ///< that points up, judged before anything of the model was changed
  prepare::CleanupReport cleanup;  ///< of bodies before they were united
  prepare::SkinReport skin;        ///< of uniting them
  prepare::Prepared prepared;
  std::vector<Remedy> remedies;   ///< that make it buildable, or an evening's work, where it isn't
  std::size_t slivers = 0;        ///< faces of it (prepare::count_slivers)
  IdVector<FaceId, PartId> part;  ///< of each face; parts end at the borders of flat regions
  std::size_t part_count = 0;
  /// The deadline left no time to find parts, so each component is one; whoever set it says so.
  bool parts_given_up = false;
  unfold::EdgeConstraints
      constraints;                   ///< of each edge, which cuts and folds were wanted; none where none were
  std::vector<Message> early_notes;  ///< of the stages before the nets
  unfold::Nets nets;                 ///< its notes begin with those
  export_::Assembly assembly;        ///< in which order the pieces are put together
  export_::Pages pages;              ///< none where Options::paper is none
  std::vector<PieceId> off_grain;    ///< pieces that lie across the grain that is to be heeded
  /// What lies on the pages where Options::board is as thick as to matter; else none: `nets` do.
  std::optional<unfold::Nets> nets_of_board;
  export_::ThickReport thickened;
  std::optional<double>
      share_saving_a_page;  ///< of the size, where a slightly smaller model would take a page less
  std::vector<export_::Drawing> drawings;  ///< one a page
  export_::DrawReport drawn;
  export_::Guide guide;     ///< empty where Options::guide doesn't ask for it
  export_::Mark mark;       ///< of all its files: model, settings
  std::string fold;         ///< bytes of the FOLD file, checked: what fails its check is never returned
  verify::Figures figures;  ///< of that check
  StageSeconds seconds;     ///< of all steps since the model; what is done anew adds to its stage
};

}  // namespace ridgecraft::job
