// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/version.hpp"

namespace ridgecraft {

std::string version() {
  return RIDGECRAFT_VERSION;
}

std::string program_and_version() {
  return "ridgecraft " RIDGECRAFT_VERSION;
}

}  // namespace ridgecraft
