// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/join_parts.hpp"

#include <algorithm>
#include <utility>

#include "segment/joining/merge.hpp"

namespace ridgecraft::segment {
namespace {

/// Puts all parts through the merge pass, or with `from_scratch` only those that the last measurement divided
/// and their neighbours: no union may be more than what reporting would find. Takes the facets of the parts.
std::vector<MergePart> merged(std::vector<MeasuredPart>& parts, bool from_scratch,
                              const JoiningTools& tools) {
  std::vector<MergePart> merging;
  for (MeasuredPart& part : parts) {
    merging.push_back({std::move(part.facets), part.hull.vertices, false, !from_scratch || part.depth > 0});
  }
  const ValleyLoan loan(tools.measurer->valleys(), *tools.valleys);
  merge_parts(*tools.measurer, *tools.weights, merging, from_scratch);
  return merging;
}

/// What the assembly makes of the parts.
template <class Assemble>
std::vector<PartTask> assembled(std::vector<MeasuredPart> parts, const JoiningTools& tools,
                                const Assemble& assemble) {
  std::vector<Facets> before;
  std::vector<PartReason> reasons;
  for (MeasuredPart& part : parts) {
    before.push_back(std::move(part.facets));
    reasons.push_back(part.reason);
  }
  parts.clear();  // the hulls aren't needed any more, and are large
  const ValleyLoan loan(tools.measurer->valleys(), *tools.valleys);
  std::vector<PartTask> tasks;
  for (AssembledPart& part : assemble(before)) {
    // Parts ascend by smallest facet, so as wholes, too.
    const auto same = std::lower_bound(before.begin(), before.end(), part.facets);
    const bool kept = same != before.end() && *same == part.facets;
    const PartReason cut = part.joined ? PartReason::merged : PartReason::ridge;
    tasks.push_back(
        {std::move(part.facets), 0, kept ? reasons[static_cast<std::size_t>(same - before.begin())] : cut});
  }
  return tasks;
}

}  // namespace

std::vector<PartTask> leave_parts(std::vector<MeasuredPart> parts) {
  std::vector<PartTask> tasks;
  for (MeasuredPart& part : parts) {
    tasks.push_back({std::move(part.facets), 0, part.reason, std::move(part.hull)});
  }
  return tasks;
}

std::vector<PartTask> join_parts(std::vector<MeasuredPart> parts, const JoiningTools& tools) {
  if (tools.assembly != nullptr) {
    return assembled(std::move(parts), tools,
                     [&](const std::vector<Facets>& whole) { return tools.assembly->assemble(whole); });
  }
  std::vector<MergePart> merging = merged(parts, false, tools);
  std::vector<PartTask> tasks;
  for (std::size_t i = 0; i < merging.size(); ++i) {
    if (merging[i].facets.empty()) {
      continue;  // went into another one, perhaps with others that had gone into it
    }
    if (merging[i].merged) {
      tasks.push_back({std::move(merging[i].facets), 0, PartReason::merged});
    } else {
      tasks.push_back({std::move(merging[i].facets), 0, parts[i].reason, std::move(parts[i].hull)});
    }
  }
  return tasks;
}

Rejoined rejoin_divided(std::vector<MeasuredPart> parts, const JoiningTools& tools) {
  Rejoined result;
  if (tools.assembly != nullptr) {
    result.changed = assembled(std::move(parts), tools, [&](const std::vector<Facets>& whole) {
      return tools.assembly->join_from_scratch(whole);
    });
    return result;
  }
  std::vector<MergePart> merging = merged(parts, true, tools);
  for (std::size_t i = 0; i < merging.size(); ++i) {
    if (merging[i].facets.empty()) {
      continue;  // as above
    }
    if (merging[i].merged) {
      result.changed.push_back({std::move(merging[i].facets), 0, PartReason::merged});
    } else {
      parts[i].facets = std::move(merging[i].facets);
      result.kept.push_back(std::move(parts[i]));
    }
  }
  return result;
}

}  // namespace ridgecraft::segment
