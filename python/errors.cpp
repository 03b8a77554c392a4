// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/errors.hpp"

#include <array>
#include <exception>
#include <string>

#include "base/error.hpp"

namespace ridgecraft::python {
namespace {

namespace py = pybind11;

/// The class that errors of a kind are raised as; it stands below ridgecraft.Error and, where there is one,
/// below a built-in class.
struct ErrorClass {
  ErrorKind kind;
  const char* name;
  PyObject* builtin;
  const char* doc;
};

/// Built-in classes are there as long as the interpreter is.
std::array<ErrorClass, 6> error_classes() {
  return {{
      {ErrorKind::usage, "UsageError", PyExc_ValueError, "An argument is wrong."},
      {ErrorKind::unreadable_input, "UnreadableInput", PyExc_OSError, "A file is missing or can't be read."},
      {ErrorKind::unusable_mesh, "UnusableMesh", PyExc_ValueError,
       "Vertices and faces that can't be made into a surface."},
      {ErrorKind::no_nets, "NoNets", nullptr,
       "No net of this model can be cut from the paper that was asked for."},
      {ErrorKind::unbuildable, "Unbuildable", nullptr, "Nobody could fold the model at this size."},
      {ErrorKind::out_of_time, "OutOfTime", PyExc_TimeoutError,
       "The time given passed while there was no result."},
  }};
}

py::object new_class(const std::string& name, const char* doc, const py::handle& bases) {
  return py::reinterpret_steal<py::object>(
      PyErr_NewExceptionWithDoc(("ridgecraft." + name).c_str(), doc, bases.ptr(), nullptr));
}

void raise(const Error& failed) {
  std::string name = "Error";
  for (const ErrorClass& added : error_classes()) {
    if (added.kind == failed.kind()) {
      name = added.name;
    }
  }
  const py::object raised = py::module_::import("ridgecraft._core").attr(name.c_str());
  PyErr_SetString(raised.ptr(), failed.what());
}

}  // namespace

void add_errors(py::module_& module) {
  const py::object error = new_class("Error", "What ridgecraft can't do, in one sentence.", {});
  module.attr("Error") = error;
  for (const ErrorClass& added : error_classes()) {
    const py::tuple bases =
        added.builtin == nullptr ? py::make_tuple(error) : py::make_tuple(error, py::handle(added.builtin));
    module.attr(added.name) = new_class(added.name, added.doc, bases);
  }
  py::register_exception_translator([](std::exception_ptr failure) {
    try {
      if (failure) {
        std::rethrow_exception(failure);
      }
    } catch (const Error& failed) {
      raise(failed);
    }
  });
}

}  // namespace ridgecraft::python
