// The measured points as CSV: what `frustum measure --points` reads back.
//
// Columns: feature,section,x,y,z,nominal_x,nominal_y,nominal_z,i,j,k,deviation: the point, the
//          place on the planned surface that is nearest to it, the planned normal there, out of
//          the material, and how far the point is along it; the last seven where the plan has
//          all features
// Units: mm in the datum frame, 17 significant digits.
// Errors: none; points with a coordinate that is not finite are left out.
#pragma once

#include <string>

#include "metrology/measurement.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::report {

[[nodiscard]] std::string points_csv(const metrology::Measurement& measurement,
                                     const metrology::InspectionPlan& plan);

}  // namespace frustum::report
