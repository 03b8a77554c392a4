// SPDX-License-Identifier: GPL-3.0-or-later
// A file that is checked, with all that the checks share.
#pragma once

#include "base/context.hpp"
#include "verify/file/file.hpp"
#include "verify/relations/relations.hpp"

namespace ridgecraft::verify {

/// What every check is given.
struct Case {
  const File& file;
  const Relations& relations;
  const Context& context;
};

}  // namespace ridgecraft::verify
