// SPDX-License-Identifier: GPL-3.0-or-later
// What base/elementary.hpp declares, by musl's functions, which emscripten's C library has. A file of its
// own, and in C, so that the compiler doesn't see what is called: it would put in values that it has computed
// by other functions.
#include <math.h>

#define OF_ONE(name) \
  double ridgecraft_elementary_##name(double x) { return name(x); }
#define OF_TWO(name) \
  double ridgecraft_elementary_##name(double x, double y) { return name(x, y); }

OF_ONE(sin)
OF_ONE(cos)
OF_ONE(tan)
OF_ONE(asin)
OF_ONE(acos)
OF_TWO(atan2)
OF_TWO(pow)
OF_ONE(exp)
OF_ONE(exp2)
OF_ONE(log)
OF_ONE(log2)
OF_ONE(log10)
OF_TWO(hypot)
