// From a finished trial to what a report shows.
// Units: as report/run_report.hpp. Errors: none.
#pragma once

#include <string>

#include "app/job.hpp"
#include "report/run_report.hpp"
#include "stock/moment.hpp"
#include "stock/surface_mesh.hpp"
#include "trials/trial.hpp"

namespace frustum::app {

// Everything but surface, volumes, timings and files.
[[nodiscard]] report::RunReport report_of(const Job& job, const trials::Trial& trial);

// The surface at the part's moment, at the pitch the job or `pitch` (mm; 0: the blank's longest side / 120) asks for,
// with the deviation of each vertex from the plan's nominal surfaces.
[[nodiscard]] Result<stock::SurfaceMesh> finished_surface(const Job& job,
                                                          const stock::WorkpieceAt& part,
                                                          double pitch);
// Fills the deviations of a mesh from the plan's nominal surfaces.
void judge_surface(const Job& job, stock::SurfaceMesh& mesh);
[[nodiscard]] std::string collision_text(const stock::Collision& collision);
// What was cut away; a part that was not cut shows no rounding.
[[nodiscard]] double removed_volume(double blank, double finished);
[[nodiscard]] report::SurfacePicture picture_of(const stock::SurfaceMesh& mesh,
                                                const metrology::InspectionPlan& plan);

}  // namespace frustum::app
