// SPDX-License-Identifier: GPL-3.0-or-later
// Nearly convex parts, and a convex hull of each.
#pragma once

#include <pybind11/pybind11.h>

namespace ridgecraft::python {

/// Adds `segment` and `hulls`.
void add_parts(pybind11::module_& module);

}  // namespace ridgecraft::python
