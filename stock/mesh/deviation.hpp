// Gouge and excess of a finished surface against a nominal shape, with place and NC block.
//
// Model    : the nominal shape is a function of point and outward normal: the signed distance from
//            it, outside positive. It is evaluated at the vertices of the surface; the worst one of
//            each sign is looked up in the workpiece for the block that made it
// Units    : mm
// Errors   : none; a point without a nominal has no deviation
// Accuracy : vertices are on the exact surface (surface_mesh.hpp); between them a deviation is
//            missed by at most what it grows over a pitch
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "stock/mesh/surface_mesh.hpp"
#include "stock/solid/program_state.hpp"

namespace frustum::stock {

using SignedDistance = std::function<std::optional<double>(const Vec3& point, const Vec3& normal)>;

// Fills the mesh's deviations.
void compare(SurfaceMesh& mesh, const SignedDistance& nominal);

struct WorstPoint {
  double deviation = 0.0;  // mm, outside positive
  Vec3 point = Vec3::Zero();
  std::optional<std::uint32_t> block{};  // that made it; nothing: the blank, or a vertex on an edge
  std::uint32_t source_line = 0;         // 0: none
  std::shared_ptr<const std::string> source_file{};  // null: the file of the main program
};

struct WorstDeviations {
  std::size_t points = 0;             // with a nominal
  std::optional<WorstPoint> gouge{};  // the lowest deviation, where one is below 0
  std::optional<WorstPoint> excess{};
};

// `tolerance`: how far the vertices may be off the workpiece's surface, for finding the block.
[[nodiscard]] WorstDeviations worst_deviations(const WorkpieceAt& part, const SurfaceMesh& mesh,
                                               Mm tolerance = Mm{1e-3});

}  // namespace frustum::stock
