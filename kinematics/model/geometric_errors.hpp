// Geometric errors of a machine under their ISO 230-1 names.
//
// Model    : each axis has six component errors, functions of its commanded position (EXX, EYX,
//            ..., ECC) and six location errors, constants (EX0C, EB0C, ...). They are physical
//            displacements of the moving part in its stator frame.
// Units    : mm, rad
// Errors   : none: error_assignment.hpp checks what people write
// Source   : ISO 230-1 names; where each acts: chain.hpp. The older short names (X0C for EX0C) and
//            the letter O for the digit 0 are read too.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "kinematics/model/axes.hpp"
#include "kinematics/model/error_function.hpp"
#include "kinematics/model/volumetric_grid.hpp"

namespace frustum::kinematics {

// Directions of an error: three displacements, three small rotations.
enum class ErrorDirection : std::uint8_t { X, Y, Z, A, B, C };  // NOLINT: the standard's letters
[[nodiscard]] constexpr bool is_rotation(ErrorDirection d) { return d >= ErrorDirection::A; }

struct ErrorName {
  ErrorDirection direction = ErrorDirection::X;
  AxisLetter axis = AxisLetter::X;
  bool location = false;  // EX0C rather than EXC

  // The ISO name, or nothing when the text is none.
  [[nodiscard]] static std::optional<ErrorName> parse(std::string_view text);
  [[nodiscard]] std::string text() const;     // "EX0C"
  [[nodiscard]] std::string meaning() const;  // "position of C in X"
};

// Errors of one axis.
struct AxisErrors {
  std::array<ErrorFunction, 6> component{};  // by ErrorDirection
  std::array<double, 6> location{};
  Vec3 carried_tilt =
      Vec3::Zero();  // rad: linear axes, a tilt that also turns what the axis carries
  // mm or rad: travel after a reversal over which the axis's play is taken up
  // (kinematics/path/approach_direction.hpp).
  double lost_motion = 0.0;

  [[nodiscard]] bool depends_on_direction() const;
};

class GeometricErrors {
 public:
  AxisErrors& operator[](AxisLetter axis) { return axes_[static_cast<std::size_t>(axis)]; }
  const AxisErrors& operator[](AxisLetter axis) const {
    return axes_[static_cast<std::size_t>(axis)];
  }
  // Whether any error needs the approach_directions of AxisState.
  [[nodiscard]] bool depends_on_direction() const;
  // These errors plus `factor` times the others; of two lost_motion distances of an axis the
  // longer.
  [[nodiscard]] GeometricErrors plus(const GeometricErrors& others, double factor) const;

  // Volumetric grids: a displacement of the whole tool chain in the directions of the bed; it turns
  // about the functional point of the chain's last linear axis, or about the bed's origin where
  // there is none.
  [[nodiscard]] bool has_grid() const { return !grids_.empty(); }
  [[nodiscard]] GridErrors grid_at(const AxisPositions& q) const;
  void add_grid(std::shared_ptr<const VolumetricGrid> grid, double factor) {
    grids_.push_back({std::move(grid), factor});
  }

 private:
  struct WeightedGrid {
    std::shared_ptr<const VolumetricGrid> grid{};
    double factor = 1.0;
  };
  std::array<AxisErrors, 6> axes_{};
  std::vector<WeightedGrid> grids_{};
};

}  // namespace frustum::kinematics
