// SPDX-License-Identifier: GPL-3.0-or-later
// Nets and pages of paper.
#pragma once

#include <pybind11/pybind11.h>

namespace ridgecraft::python {

/// Adds `make` and the classes of what it gives: Nets, and Paper for nets on pages.
void add_nets(pybind11::module_& module);

}  // namespace ridgecraft::python
