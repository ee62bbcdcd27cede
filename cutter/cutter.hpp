// A rotating cutter: nominal shape and what is wrong with it.
//
// Units: mm. `length` runs from the spindle gauge point to the tip; `flute_length` is the cutting height
// above the tip (default: the whole length). Radius and length errors change the body that really cuts,
// not what the controller believes.
// Errors: make() names the key and the limit that a value breaks.
#pragma once

#include <string>

#include "core/result.hpp"
#include "core/units.hpp"
#include "cutter/body.hpp"
#include "cutter/profile.hpp"

namespace frustum::cutter {

enum class CutterType { flat, ball };
[[nodiscard]] std::string to_string(CutterType type);

struct CutterSpec {
  CutterType type = CutterType::flat;
  Mm diameter{};
  Mm length{};
  Mm flute_length{};  // 0: the whole length
  Mm radius_error{};
  Mm length_error{};
};

class Cutter {
 public:
  [[nodiscard]] static Result<Cutter> make(const CutterSpec& spec);

  [[nodiscard]] const CutterSpec& spec() const { return spec_; }
  // The body that really cuts: radius error included. The length error moves the tip and therefore
  // belongs to the tool path.
  [[nodiscard]] const Body& body() const { return body_; }
  // The same while sweeps take one convex part.
  [[nodiscard]] const Profile& profile() const { return body_.parts().front(); }

 private:
  [[nodiscard]] static Result<Cutter> body_of(const CutterSpec& spec,
                                              std::vector<OutlineSegment> chain);
  Cutter(const CutterSpec& spec, Body body) : spec_(spec), body_(std::move(body)) {}
  CutterSpec spec_;
  Body body_;
};

}  // namespace frustum::cutter
