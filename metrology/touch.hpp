// Where a probe met a surface.
//
// Units : mm; the frame of the probe
// Errors: none
#pragma once

#include <optional>

#include "core/pose.hpp"
#include "core/provenance.hpp"

namespace frustum::metrology {

struct Touch {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  // unit, out of the material
  // What made the surface there, of probes that know it: passed on, never read in this room.
  std::optional<Provenance> provenance{};
};

}  // namespace frustum::metrology
