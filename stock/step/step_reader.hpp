// Shapes out of STEP files, as triangle meshes.
//
// Model    : faces are cut into triangles that leave them by the deflection at most; corners on an
//            edge are common to the faces beside it
// Units    : mm, whatever unit the file states
// Shape    : facets counter-clockwise seen from outside
// Errors   : a file that cannot be read or holds no faces; a deflection that is not above 0
// Accuracy : curved faces within the deflection (tests/stock/step_reader_test.cpp)
// Source   : OpenCASCADE, with which alone this room is built (FRUSTUM_WITH_STEP)
#pragma once

#include <filesystem>

#include "core/result.hpp"
#include "core/units.hpp"
#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

[[nodiscard]] Result<SurfaceMesh> read_step(const std::filesystem::path& file, Mm deflection);

}  // namespace frustum::stock
