// The errors of a virtual CMM: where the ball's centre is, and where the machine says it is.
//
// Model    : measured = centre + geometry(centre) + growth * centre + probe(approach) * approach
//            + noise * approach. The seed fixes geometry and probe; the draw fixes noise, drift,
//            qualification and what the temperature sensors are wrong by
// Units    : mm; workpiece frame of the plan
// Shape    : one point a call, a pure function of model and arguments
// Errors   : none
// Accuracy : first order in the errors
// Source   : ISO 10360-2 and -5 for what is stated; geometry_field.hpp, probe_form.hpp
#pragma once

#include <cstdint>

#include "metrology/probing/cmm_model.hpp"
#include "metrology/probing/geometry_field.hpp"
#include "metrology/probing/probe_form.hpp"

namespace frustum::metrology {

struct ProbedCentre {
  Vec3 centre = Vec3::Zero();    // of the ball at contact
  Vec3 outward = Vec3::UnitZ();  // unit, against the approach
  std::uint64_t index = 0;       // of the point: its own noise
  bool scanned = false;
};
// Of point `point` of feature `feature` of a plan.
[[nodiscard]] constexpr std::uint64_t point_index(std::size_t feature, std::size_t point) {
  return (static_cast<std::uint64_t>(feature) << 32U) | point;
}

class CmmErrors {
 public:
  explicit CmmErrors(const CmmModel& cmm);
  // Another measurement on the same machine: much cheaper than a machine of another seed.
  [[nodiscard]] CmmErrors repeated(std::uint32_t draw) const;

  [[nodiscard]] Vec3 measured(const ProbedCentre& p) const;
  // Without noise: what every repetition shares but for drift and sensors.
  [[nodiscard]] Vec3 systematic(const ProbedCentre& p) const;

  // What the probe was qualified to: the radius that compensation uses for a ball of radius
  // `nominal`.
  [[nodiscard]] double ball_radius(double nominal) const { return nominal + qualified_; }
  // Whether the machine's travels reach there; without a field they always do.
  [[nodiscard]] bool reaches(const Vec3& centre) const;
  // mm: what the probe takes of e0 at worst, noise included; the field has the rest.
  [[nodiscard]] double probing_share() const { return probing_share_; }
  // mm: what the probe takes of p_form, noise included; the rest is the field's.
  [[nodiscard]] double form_share() const { return form_share_; }

 private:
  void start_measurement();
  [[nodiscard]] double noise(const ProbedCentre& p) const;

  CmmModel cmm_;
  ProbeErrors probe_;
  ProbeForm form_;
  GeometryField geometry_;
  double probing_share_ = 0.0;
  double form_share_ = 0.0;
  // Of this draw:
  double qualified_ = 0.0;
  Mat3 linear_ = Mat3::Zero();
};

}  // namespace frustum::metrology
