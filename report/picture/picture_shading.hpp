// Light on the surface of a picture: from what each sample sees to colours.
//
// Model   : two diffuse lights and a sky fixed to the camera, a faint highlight, ambient occlusion,
//           thin lines where the surface bends or breaks off
// Units   : mm in depths; colours in linear light
// Errors  : none
// Accuracy: for the eye; the same bits for any number of threads
// Source  : common practice
#pragma once

#include "report/picture/image.hpp"
#include "report/picture/scene.hpp"

namespace frustum::report {

// Draws the workpiece over `image`, whose pixels are those of the scene. The ends of the colour
// scale are at +-deviation_span (mm).
void shade(const Scene& scene, double deviation_span, Image& image);

}  // namespace frustum::report
