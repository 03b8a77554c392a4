// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/context.hpp"

#include "mesh/error.hpp"

namespace ridgecraft {

void Context::check() const {
  if (stop.stop_requested()) {
    throw Error(ErrorKind::interrupted, "stopped before the work was done; nothing was written");
  }
}

}  // namespace ridgecraft
