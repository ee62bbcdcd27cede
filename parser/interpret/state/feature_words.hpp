// The description of a tilted plane by G68.2, as far as its blocks have been read.
//
// Units : mm, rad
// Errors: none
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/pose.hpp"

namespace frustum::parser {

enum class FeatureForm : std::uint8_t {
  euler,
  roll_pitch_yaw,
  three_points,
  two_vectors,
  projection
};
constexpr int kFeatureForms = 5;

// One block's part of a description.
struct FeaturePart {
  Vec3 place = Vec3::Zero();    // X Y Z
  Vec3 numbers = Vec3::Zero();  // I J K: angles in rad, or a vector
  double turn = 0.0;            // R
};
struct FeatureWords {
  FeatureForm form = FeatureForm::euler;
  int order = 123;  // of P1
  std::array<std::optional<FeaturePart>, 4>
      parts{};  // by Q; those on one block have only the first

  // Whether all blocks of the description have been read.
  [[nodiscard]] bool whole() const;
};

}  // namespace frustum::parser
