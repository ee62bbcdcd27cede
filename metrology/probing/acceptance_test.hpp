// The acceptance test of a coordinate measuring machine, run on the virtual one.
//
// Model    : 5 lengths in 7 directions, 3 times each: the four space diagonals of the volume and
//            parallels to the axes through its centre, the longest length 90 % of what the volume
//            has there. A length is the distance of two opposite touches on a gauge block,
//            compensated by the qualified ball; its error shall be within e0 + L/k. Then a sphere
//            of 25 mm in the centre, touched at 25 points: form and size of its least-squares
//            sphere
// Units    : mm
// Shape    : 105 lengths, 25 points
// Errors   : none; what fails is in the report
// Accuracy : that of ball contacts, 1e-12 mm
// Source   : ISO 10360-2:2009 (E0), ISO 10360-5:2020 (P_Form.Sph.1x25, P_Size.Sph.1x25)
#pragma once

#include <string>
#include <vector>

#include "metrology/probing/cmm_model.hpp"

namespace frustum::metrology {

struct TestedLength {
  Vec3 direction = Vec3::UnitX();
  double length = 0.0;  // mm, of the gauge
  int repetition = 0;
  double error = 0.0;  // mm, indicated less true
  double limit = 0.0;  // mm
};

struct AcceptanceReport {
  std::vector<TestedLength> lengths{};
  double probing_form = 0.0;   // mm
  double probing_size = 0.0;   // mm, diameter indicated less true
  double probing_limit = 0.0;  // mm, of either

  [[nodiscard]] bool lengths_pass() const;
  [[nodiscard]] bool probing_passes() const;
  [[nodiscard]] bool passes() const { return lengths_pass() && probing_passes(); }
  // Largest |error| / limit; 0 for a machine without errors, infinite for errors where the limit is
  // 0.
  [[nodiscard]] double worst_length_share() const;
};

[[nodiscard]] AcceptanceReport acceptance_test(const CmmModel& cmm);

// A table for people: the worst repetition of every length, then the sphere and the verdict.
[[nodiscard]] std::string to_text(const AcceptanceReport& report);

}  // namespace frustum::metrology
