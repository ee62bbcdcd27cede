// From a finished trial to what a report shows.
// Units: as report/run_report.hpp. Errors: none.
#pragma once

#include <optional>
#include <string>

#include "app/job/job.hpp"
#include "report/run_report.hpp"
#include "stock/mesh/refine_surface.hpp"
#include "stock/mesh/surface_mesh.hpp"
#include "stock/solid/program_state.hpp"
#include "trials/point_proof.hpp"
#include "trials/trial.hpp"

namespace frustum::app {

// Everything but surface, volumes, timings and files.
[[nodiscard]] report::RunReport report_of(const Job& job, const trials::Trial& trial,
                                          report::Evidence evidence = {});

// What was looked for of machine and fixtures, as reports tell it.
[[nodiscard]] report::MachineBodies machine_bodies_of(const stock::MachineCollisions& met);

// Tells in the report how near the measured points are to the true surface. A point that is refuted
// is an error of the engine, and the run does not pass.
void add_proof(report::RunReport& report, const trials::PointProof& proof);

struct SurfaceRequest {
  double pitch = 0.0;  // mm; 0: what the job says, or the blank's longest side / 120
  double chord = 0.0;  // mm; 0: not refined
};
// Of the sampling grid: what is asked for, the job's, or a hundred and twentieth of the box.
[[nodiscard]] Result<Mm> surface_pitch(const Job& job, const stock::BoundingBox& box, double asked);
struct FinishedSurface {
  stock::SurfaceMesh mesh{};                      // with the deviation of each vertex
  std::optional<stock::Refinement> refinement{};  // where it was refined
};
// The surface at the part's program state.
[[nodiscard]] Result<FinishedSurface> finished_surface(const Job& job,
                                                       const stock::WorkpieceAt& part,
                                                       const SurfaceRequest& request);
// The same of a surface that was extracted at that state.
[[nodiscard]] Result<FinishedSurface> finished_surface(const Job& job,
                                                       const stock::WorkpieceAt& part,
                                                       stock::SurfaceMesh extracted, double chord);
// Fills the deviations of a mesh: from the job's nominal mesh if it has one, or else from the
// plan's nominal surfaces.
void judge_surface(const Job& job, stock::SurfaceMesh& mesh);
[[nodiscard]] std::string collision_text(const stock::Collision& collision);
// Where its line is: the subprogram's own file, else that of the main program.
[[nodiscard]] std::string file_of(const stock::Collision& collision,
                                  const std::string& main_program);
// What was cut away; a part that was not cut shows no rounding.
[[nodiscard]] double removed_volume(double blank, double finished);
[[nodiscard]] report::SurfacePicture picture_of(const stock::SurfaceMesh& mesh,
                                                const metrology::InspectionPlan& plan);

}  // namespace frustum::app
