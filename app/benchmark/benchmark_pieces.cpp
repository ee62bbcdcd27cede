#include "app/benchmark/benchmark_pieces.hpp"

#include "programs/cone/cone_frustum.hpp"
#include "programs/contour/contour_piece.hpp"
#include "programs/s_piece/s_piece.hpp"
#include "programs/step/step_pattern.hpp"

namespace frustum::app {
namespace {

using kinematics::Machine;
using programs::TestPiece;

// Coarse enough for a small file, and the same for all machines.
programs::ConeFrustum cone_of(const std::string& machine, bool asked) {
  programs::ConeFrustum cone;
  cone.chord_tolerance = {5e-4};
  if (machine == "dvf5000") cone.center = Vec3(0.0, 0.0, 80.0);
  if (asked) {
    cone.cone_angle = {30.0 * kRadPerDeg};
    cone.inclination = {15.0 * kRadPerDeg};
    cone.orientation = {120.0 * kRadPerDeg};
    cone.radius = {50.0};
  }
  return cone;
}
programs::SPiece s_of(const std::string& machine, bool asked) {
  programs::SPiece piece;
  piece.blocks = 500;
  if (machine == "dvf5000") piece.center = Vec3(0.0, 0.0, 80.0);
  if (asked) {
    piece.orientation = {60.0 * kRadPerDeg};
    piece.center += Vec3(-20.0, -35.0, 10.0);
  }
  return piece;
}
programs::ContourPiece contour_of(const std::string& machine, bool asked) {
  programs::ContourPiece piece;
  piece.center = Vec3(0.0, 0.0, machine == "dvf5000" ? 80.0 : 120.0);
  if (asked) {
    piece.size = {100.0};
    piece.center += Vec3(30.0, -20.0, 15.0);
  }
  return piece;
}

}  // namespace

Result<std::optional<TestPiece>> benchmark_piece(const std::string& name,
                                                 const std::string& machine_name,
                                                 const Machine& machine, bool asked) {
  const auto made = [](Result<TestPiece> piece) -> Result<std::optional<TestPiece>> {
    if (!piece) return std::move(piece).error();
    return std::optional(*std::move(piece));
  };
  if (name == "cone") return made(programs::cone_frustum(cone_of(machine_name, asked), machine));
  if (name == "s-piece") return made(programs::s_piece(s_of(machine_name, asked), machine));
  if (name == "contour") {
    return made(programs::contour_piece(contour_of(machine_name, asked), machine));
  }
  programs::StepTest test;
  test.workpiece = *programs::step_workpiece(name == "steps-1" ? 1 : 2);
  auto steps = programs::step_pattern(test, machine);
  if (!steps) return std::optional<TestPiece>();
  return std::optional(std::move(steps->piece));
}

}  // namespace frustum::app
