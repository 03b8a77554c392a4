// SPDX-License-Identifier: GPL-3.0-or-later
// Errors that name the file they are about.
#pragma once

#include <new>
#include <string>

#include "base/error.hpp"
#include "cli/files/model_input.hpp"

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
    throw Error(error.kind(), name + ": " + error.what(), name);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::unusable_mesh, name + " needs more memory than this machine has", name);
  }
}

}  // namespace ridgecraft::cli
