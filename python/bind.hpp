// The parts of the module, one a source.
//
// Units: mm, degrees, um and urad outside, as the docstrings say. Errors: Refused.
#pragma once

#include <pybind11/pybind11.h>

namespace frustum::python {

void bind_machine(pybind11::module_& module);
void bind_job(pybind11::module_& module);
void bind_study(pybind11::module_& module);
void bind_answers(pybind11::module_& module);

}  // namespace frustum::python
