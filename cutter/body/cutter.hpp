// A rotating cutter: nominal shape and what is wrong with it.
//
// Units : mm, rad. `length` runs from the spindle gauge point to the tip; `flute_length` is the
//            cutting
//         height above the tip (default: the whole length). Radius and length errors and run-out
//         change the body that really cuts, not what the controller believes.
// Errors: make() names the value and the limit that it breaks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/units.hpp"
#include "cutter/body/body.hpp"
#include "cutter/body/cutter_spec.hpp"
#include "cutter/body/profile.hpp"

namespace frustum::cutter {

class Cutter {
 public:
  [[nodiscard]] static Result<Cutter> make(const CutterSpec& spec);

  [[nodiscard]] const CutterSpec& spec() const { return spec_; }
  // The body that really cuts: radius error and run-out included. The length error moves the tip
  // and therefore belongs to the tool path.
  [[nodiscard]] const Body& body() const { return body_; }
  // What must not touch material: from the flutes up to the holder, and the holder up to the gauge
  // point. A tool that states flute_length and neither shank nor neck has a shank as wide as its
  // flutes, less a relief of 0.05 mm; one without flute_length cuts over its whole length.
  [[nodiscard]] const std::optional<Body>& shank() const { return shank_; }
  [[nodiscard]] const std::optional<Body>& holder() const { return holder_; }

 private:
  Cutter(const CutterSpec& spec, Body body) : spec_(spec), body_(std::move(body)) {}
  CutterSpec spec_;
  Body body_;
  std::optional<Body> shank_;
  std::optional<Body> holder_;
};

}  // namespace frustum::cutter
