#include "app/player/player_steps.hpp"

#include <algorithm>
#include <utility>

#include "app/job/job_report.hpp"
#include "stock/mesh/decimate_surface.hpp"
#include "stock/mesh/surface_sequence.hpp"

namespace frustum::app {
namespace {

constexpr double kToleranceOfPitch = 0.05;  // what a mesh of that pitch leaves of curves anyway

}  // namespace

Result<std::vector<WorkpieceStep>> workpiece_steps(const Job& job,
                                                   const stock::Workpiece& workpiece,
                                                   const StepRequest& request,
                                                   const std::function<void(double)>& at) {
  const kinematics::ToolPath& path = workpiece.removed().path();
  const auto pitch = surface_pitch(job, workpiece.blank().bounds(), request.pitch);
  if (!pitch) return pitch.error();
  std::vector<stock::ProgramState> states{stock::start_of(path)};
  if (request.count > 0) {
    const auto later = stock::equally_spaced(path, request.count, stock::end_of(path));
    states.insert(states.end(), later.begin(), later.end());
  }
  stock::SurfaceSequence surfaces(workpiece, *pitch);
  std::vector<WorkpieceStep> steps;
  for (const stock::ProgramState& state : states) {
    at(static_cast<double>(steps.size()) / static_cast<double>(states.size()));
    // What has not cut since shows nothing new.
    if (!steps.empty() && state.segments == steps.back().state.segments) continue;
    auto mesh = surfaces.at(state);
    if (!mesh) return mesh.error();
    const double volume = stock::enclosed_volume(*mesh);
    auto fewer = stock::decimate_surface(*mesh, Mm{kToleranceOfPitch * pitch->value});
    steps.push_back({state, volume, fewer ? *std::move(fewer) : *std::move(mesh)});
  }
  return steps;
}

report::PlayerMesh player_mesh(const stock::SurfaceMesh& mesh) {
  report::PlayerMesh drawn;
  drawn.triangles = mesh.triangles;
  drawn.vertices.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) {
    drawn.vertices.push_back(
        {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())});
  }
  return drawn;
}

}  // namespace frustum::app
