// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of the libraries as exceptions of Python.
#pragma once

#include <pybind11/pybind11.h>

namespace ridgecraft::python {

/// Adds ridgecraft.Error and a class below it for each kind that a caller may want to catch, and has every
/// ridgecraft::Error that leaves a function of the module raised as the class of its kind.
void add_errors(pybind11::module_& module);

}  // namespace ridgecraft::python
