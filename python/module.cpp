// SPDX-License-Identifier: GPL-3.0-or-later
// The extension ridgecraft._core: what the package of Python around it calls.
#include <pybind11/pybind11.h>

#include "base/version.hpp"
#include "python/background.hpp"
#include "python/errors.hpp"
#include "python/nets.hpp"
#include "python/parts.hpp"
#include "python/reading.hpp"

PYBIND11_MODULE(_core, module) {
  module.attr("__version__") = ridgecraft::version();
  ridgecraft::python::add_errors(module);
  ridgecraft::python::add_parts(module);
  ridgecraft::python::add_nets(module);
  ridgecraft::python::add_reading(module);
  ridgecraft::python::wait_for_left_work_at_exit();
}
