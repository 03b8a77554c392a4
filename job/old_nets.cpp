// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/old_nets.hpp"

#include "base/error.hpp"
#include "mesh/reading/pdo/read_seams.hpp"

namespace ridgecraft::job {

bool is_fold_file(const OldNets& old) {
  return !mesh::may_have_seams(old.bytes);
}

verify::File read_fold_file(const OldNets& old) {
  try {
    return verify::read_file(old.bytes);
  } catch (const verify::NotInForm& reason) {
    throw Error(ErrorKind::unreadable_input, old.name + ": " + reason.message, old.name);
  }
}

}  // namespace ridgecraft::job
