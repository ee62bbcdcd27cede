// A volumetric error grid: displacement of the tool against the bed over the positions of X, Y and
// Z.
//
// Model    : trilinear between the points of a rectangular grid, held at its faces
// Units    : mm, rad; in the file the units that its header names
// Errors   : reading names file, line and column: no header, unknown column, missing unit, no
//            number, a point given twice or missing
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "kinematics/model/axes.hpp"

namespace frustum::kinematics {

// A displacement and a small rotation of the tool chain, in the directions of the bed.
struct GridErrors {
  Vec3 shift = Vec3::Zero();
  Vec3 turn = Vec3::Zero();
};

class VolumetricGrid {
 public:
  // CSV with the columns x_mm,y_mm,z_mm,dx_um,dy_um,dz_um and perhaps da_urad,db_urad,dc_urad, in
  // any order of rows and columns.
  [[nodiscard]] static Result<VolumetricGrid> load(const std::filesystem::path& file);
  // `errors` with z running fastest, x slowest; positions increase, at least two a direction.
  VolumetricGrid(std::array<std::vector<double>, 3> positions, std::vector<GridErrors> errors);

  [[nodiscard]] GridErrors at(const AxisPositions& q) const;
  // Points along X, Y and Z.
  [[nodiscard]] std::array<std::size_t, 3> size() const;

 private:
  std::array<std::vector<double>, 3> positions_;
  std::vector<GridErrors> errors_;
};

}  // namespace frustum::kinematics
