// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/context.hpp"

#include "base/error.hpp"

namespace ridgecraft {

void Context::check() const {
  if (stop.stop_requested()) {
    throw Error(ErrorKind::interrupted, "stopped before the work was done; nothing was written");
  }
}

}  // namespace ridgecraft
