// The soft shadow of the part on the ground it is on.
//
// Model   : a ray from the ground towards the light at each pixel, then blurred. The light is
//           high and to the left at the viewer's back: shadows fall back and to the right
// Units   : pixels
// Errors  : none; a view along the ground shows none of it
// Accuracy: for the eye
// Source  : common practice
#pragma once

#include "report/picture/image.hpp"
#include "report/picture/scene.hpp"

namespace frustum::report {

// Darkens the image; call before shade().
void cast_ground_shadow(const Scene& scene, Image& image);

}  // namespace frustum::report
