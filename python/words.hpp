// Arguments that are words of the command line.
//
// Units : as people write them: "10 um", "20 urad"
// Errors: those of gather_errors(), as Refused
#pragma once

#include <pybind11/pybind11.h>

#include "app/job/error_sources.hpp"
#include "kinematics/model/geometric_errors.hpp"

namespace frustum::python {

// None; the name of an error file; {"EX0C": "10 um"}; a list of such names and dicts.
[[nodiscard]] app::ErrorWords error_words(const pybind11::object& errors);
[[nodiscard]] kinematics::GeometricErrors errors_of(const pybind11::object& errors,
                                                    const kinematics::Machine& machine,
                                                    std::optional<std::uint64_t> draw);

}  // namespace frustum::python
