// The tables of a study file besides its errors: tolerances, correlated errors, limits, and what is
// asked of the samples.
// Units: as StudyFile. Errors: noted in the document.
#pragma once

#include "app/study/study_file.hpp"
#include "core/toml_document.hpp"

namespace frustum::app {

// The characteristics, the machine and the errors are known before.
void read_study_tables(const TomlTable& root, StudyFile& study);

}  // namespace frustum::app
