// SPDX-License-Identifier: GPL-3.0-or-later
// What jobs share: errors that name the model and the time limit, and the parts that the options ask for.
#pragma once

#include <new>
#include <optional>
#include <string>

#include "base/context.hpp"
#include "base/error.hpp"
#include "cli/arguments/options.hpp"
#include "cli/files/input_files.hpp"
#include "mesh/model/model.hpp"
#include "segment/hierarchy.hpp"
#include "segment/segment.hpp"

namespace ridgecraft::cli {

/// Stages after reading don't know the model's file; where they refuse what comes from it and name no other,
/// the sentence that the user gets names it all the same.
template <class Work>
auto about(const std::string& model, const Work& work) {
  const std::string name = shown_name(model);
  try {
    return work();
  } catch (const Error& error) {
    const bool about_model = error.kind() == ErrorKind::unusable_mesh || error.kind() == ErrorKind::no_nets ||
                             error.kind() == ErrorKind::unbuildable || error.kind() == ErrorKind::internal;
    if (!about_model || !error.about().empty()) {
      throw;
    }
    throw Error(error.kind(), Message("of_model", {{"model", name}, {"what", std::vector{error.message()}}}),
                name);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::unusable_mesh, Message("memory", {{"model", name}}), name);
  }
}

/// What completes a result (tabs, numbers on pages) may go on for this share of the time limit beyond it: a
/// model of ordinary size gets all of them.
inline constexpr double finishing_share = 0.1;

/// Runs stage(context that is given up at the deadline). Throws Error(out_of_time) with a sentence for users
/// when the time is up before its end.
template <class Stage>
auto in_time(const Context& context, const std::string& doing, const Stage& stage) {
  try {
    return stage(until_deadline(context));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::out_of_time) {
      throw;
    }
    throw Error(ErrorKind::out_of_time, "--time-limit passed while " + doing + "; nothing was written");
  }
}

/// The options for a model whose unit is known: lengths become shares of the radius of its enclosing ball.
[[nodiscard]] segment::Options options_for(const mesh::Model& model, const PartArguments& parts);

/// `file` is what messages call the model. A hierarchy that is given is used for a number of parts, one that
/// isn't is found where a number is asked for and left in `hierarchy`. Throws Error(usage) when there are no
/// such parts.
[[nodiscard]] segment::Segmentation find_parts(const mesh::Model& model, const std::string& file,
                                               const PartArguments& parts,
                                               std::optional<segment::Hierarchy>& hierarchy,
                                               const Context& context);

}  // namespace ridgecraft::cli
