// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/context.hpp"

#include "base/error.hpp"

namespace ridgecraft {

void Context::check() const {
  if (stop.stop_requested()) {
    throw Error(ErrorKind::interrupted, "stopped before the work was done; nothing was written");
  }
  if (give_up && give_up->has_passed()) {
    throw Error(ErrorKind::out_of_time,
                "the time given passed before the work was done; nothing was written");
  }
}

Context until_deadline(const Context& context, double share) {
  Context strict = context;
  if (context.deadline) {
    strict.give_up = Deadline::in(share * context.deadline->seconds_left());
  }
  return strict;
}

}  // namespace ridgecraft
