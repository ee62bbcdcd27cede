// The values of a circular test as a document and for a terminal: of a virtual bar and of a
// measured trace alike.
//
// Units  : um and urad, as named
// Errors : an evaluation that the samples do not allow is a warning, its value null
#pragma once

#include <string>
#include <vector>

#include "app/motion/motion_answer.hpp"
#include "instruments/signature.hpp"

namespace frustum::app {

// Puts `evaluation` into the document and its tables into the text.
void add_circle_evaluation(MotionAnswer& answer,
                           const std::vector<instruments::CircleTrace>& traces, double length,
                           instruments::Plane plane);

// The traces as `frustum motion trace` reads them.
[[nodiscard]] std::string circle_csv(const std::vector<instruments::CircleTrace>& traces,
                                     instruments::Plane plane, double length);

}  // namespace frustum::app
