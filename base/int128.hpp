// SPDX-License-Identifier: GPL-3.0-or-later
// Signed integers of 128 bits: the compiler's own where it has any, and builds don't ask for the portable
// way.
#pragma once

#if defined(__SIZEOF_INT128__) && !defined(RIDGECRAFT_PORTABLE)

namespace ridgecraft {
__extension__ using Int128 = __int128;
}  // namespace ridgecraft

#else

#include "base/portable_int128.hpp"

namespace ridgecraft {
using Int128 = PortableInt128;
}  // namespace ridgecraft

#endif
