// The workpiece in steps of the program, as meshes for the player.
//
// Model    : surfaces as `frustum cut --snapshots` has them, at equal steps of time, with the
//            triangles that a twentieth of the pitch needs
// Units    : mm, s; frame: workpiece
// Errors   : a pitch that is too coarse for the blank; those of the surface
#pragma once

#include <functional>
#include <vector>

#include "app/job/job.hpp"
#include "core/result.hpp"
#include "report/player/player_page.hpp"
#include "stock/mesh/surface_mesh.hpp"
#include "stock/solid/program_state.hpp"

namespace frustum::app {

struct StepRequest {
  int count = 12;      // after the blank
  double pitch = 0.0;  // mm; 0: as of a report
};

struct WorkpieceStep {
  stock::ProgramState state{};
  double volume = 0.0;  // mm3
  stock::SurfaceMesh mesh{};
};

// The blank, then `count` steps, the last of them finished. `at`: hears which share is done.
[[nodiscard]] Result<std::vector<WorkpieceStep>> workpiece_steps(
    const Job& job, const stock::Workpiece& workpiece, const StepRequest& request,
    const std::function<void(double)>& at);

[[nodiscard]] report::PlayerMesh player_mesh(const stock::SurfaceMesh& mesh);

}  // namespace frustum::app
