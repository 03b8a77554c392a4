// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/foundation/context.hpp"

#include "mesh/foundation/error.hpp"

namespace ridgecraft {

void Context::check() const {
  if (stop.stop_requested()) {
    throw Error(ErrorKind::interrupted, "stopped before the work was done; nothing was written");
  }
}

}  // namespace ridgecraft
