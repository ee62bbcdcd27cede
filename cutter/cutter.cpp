#include "cutter/cutter.hpp"

#include <fmt/format.h>

#include <cmath>

namespace frustum::cutter {

std::string to_string(CutterType type) { return type == CutterType::flat ? "flat" : "ball"; }

Result<Cutter> Cutter::body_of(const CutterSpec& spec, std::vector<OutlineSegment> chain) {
  return Outline::make(std::move(chain)).transform([&](Outline outline) {
    return Cutter(spec, Body(std::move(outline)));
  });
}

Result<Cutter> Cutter::make(const CutterSpec& spec) {
  const double radius = spec.diameter.value / 2.0 + spec.radius_error.value;
  const double height = spec.flute_length.value > 0.0 ? spec.flute_length.value : spec.length.value;
  if (!(spec.diameter.value > 0.0) || !std::isfinite(spec.diameter.value)) {
    return error(fmt::format("tool diameter {} mm", spec.diameter.value), "it must be above 0");
  }
  if (!(radius > 0.0)) {
    return error(fmt::format("radius error {} mm leaves no tool of diameter {} mm",
                             spec.radius_error.value, spec.diameter.value),
                 "the error must be smaller than the radius");
  }
  if (!(spec.length.value > 0.0)) {
    return error(fmt::format("tool length {} mm", spec.length.value),
                 "give the length from the spindle gauge point to the tip");
  }
  if (spec.flute_length.value > spec.length.value) {
    return error(fmt::format("flute length {} mm exceeds the tool length {} mm",
                             spec.flute_length.value, spec.length.value),
                 "the flutes end below the gauge point");
  }
  if (spec.type == CutterType::flat) {
    return body_of(spec, {line({0.0, 0.0}, {radius, 0.0}), line({radius, 0.0}, {radius, height})});
  }
  if (height < radius) {
    return error(
        fmt::format("flute length {} mm of a ball end mill of radius {} mm", height, radius),
        "the flutes must reach past the ball: at least the radius");
  }
  std::vector<OutlineSegment> chain{arc({0.0, 0.0}, {radius, radius}, {0.0, radius})};
  if (height > radius) chain.push_back(line({radius, radius}, {radius, height}));
  return body_of(spec, std::move(chain));
}

}  // namespace frustum::cutter
