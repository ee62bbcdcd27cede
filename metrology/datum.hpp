// The frame that datum features span.
//
// Model    : Z = normal of the primary plane; origin = secondary axis pierced with that plane; Y =
//            trace of the tertiary plane in the primary one, or a given direction laid into it
// Units    : mm; all elements in one frame
// Shape    : one frame
// Errors   : axis parallel to the primary plane, tertiary parallel to it
// Accuracy : rounding of doubles
// Source   : Bossoni 2010, appendix A.4.1
#pragma once

#include <optional>

#include "core/result.hpp"
#include "metrology/element.hpp"

namespace frustum::metrology {

struct DatumElements {
  Plane primary{};                  // its axis out of the material
  Line secondary{};                 // axis of the datum cylinder
  std::optional<Plane> tertiary{};  // its axis out of the material
  Vec3 clocking = Vec3::UnitY();    // gives Y when there is no tertiary
};

// frame_from_datum: the datum frame seen from the frame of the elements.
[[nodiscard]] Result<Pose> datum_frame(const DatumElements& elements);

}  // namespace frustum::metrology
