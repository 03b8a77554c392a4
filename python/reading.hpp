// SPDX-License-Identifier: GPL-3.0-or-later
// Model files.
#pragma once

#include <pybind11/pybind11.h>

namespace ridgecraft::python {

/// Adds `read`.
void add_reading(pybind11::module_& module);

}  // namespace ridgecraft::python
