// A table [[motion]] of a study: a motion test and what was measured of it.
//
// Text   : test = "test.toml" (test_file.hpp; its [errors] and [setup] are those of a virtual
//          machine and are left out), traces = ["trace.csv"], noise = "0.3um" (standard deviation
//          of a reading; default: that of the test file, else what the residuals of the harmonics
//          show), ball = "exact" (its offset is known to be zero) or a name (tests with the same
//          one share it; default: one each for bars, R-tests and probes), name (default: of the
//          test file)
// Units  : as in test files and traces
// Errors : keys; what of test and traces cannot be read, with file and line; a line along an axis,
//          which tells no constant error
#pragma once

#include "app/job/study.hpp"

namespace frustum::app {

[[nodiscard]] Result<std::optional<StudyMotion>> read_measured_motion(const TomlTable& table);
// Of a test that is only planned: no traces, the noise has to be said.
[[nodiscard]] Result<std::optional<StudyMotion>> read_planned_motion(const TomlTable& table);

}  // namespace frustum::app
