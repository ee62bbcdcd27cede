// What a virtual coordinate measuring machine is said to be: accuracy, probe, stylus, temperatures.
//
// Units  : mm, rad, degC, 1/K, N; everything in the workpiece frame of the plan. In files mm,
//          degrees, degC, um/(m K), N, GPa
// Errors : read_cmm_model notes every misspelt key and impossible value in the table's document
#pragma once

#include <cstdint>
#include <optional>

#include "core/pose.hpp"
#include "core/toml_document.hpp"

namespace frustum::metrology {

// linear: noise of e0/2 along the approach and one linear field a measurement (standard
// deviations). field: one machine a seed, whose 21 smooth parametric errors keep E = e0 + L/k as a
// limit.
enum class CmmKind { linear, field };

struct ProbeErrors {
  double pre_travel = 0.0;     // mm: the same in every direction; qualification takes it out
  double lobe = 0.0;           // mm: amplitude of the three-lobed part about the stylus
  double lobe_phase = 0.0;     // rad about the stylus, from its zero direction to a lobe
  double ball_form = 0.0;      // mm: largest departure of the ball from a sphere
  double force = 0.0;          // N at the trigger: bends the stylus
  double repeatability = 0.0;  // mm: standard deviation of a point
  double scan_noise = 0.0;     // mm: what scanning adds to it, standard deviation

  bool operator==(const ProbeErrors&) const = default;
};

// A straight shank behind the ball.
struct Stylus {
  UnitVec3 direction = UnitVec3::z();  // from the ball to the head
  double length = 50.0;                // mm, from the centre of the ball
  double diameter = 2.0;               // mm, of the shank
  double modulus = 600e3;              // N/mm^2; cemented carbide
};

struct ThermalState {
  double part = 20.0;               // degC
  double scales = 20.0;             // degC
  double part_expansion = 11.5e-6;  // 1/K; steel
  double scale_expansion = 8e-6;    // 1/K; glass
  bool compensated = false;         // by sensors and stated coefficients
  double sensor_error = 0.0;     // K: half width of what a sensor is wrong by, both sensors alike
  double expansion_error = 0.0;  // 1/K: half width of what a stated coefficient is wrong by

  bool operator==(const ThermalState&) const = default;
};

// What a CmmModel without errors is: an ideal virtual machine, or one of which nothing is stated.
enum class NoErrors { ideal, unknown };

// E = e0 + L / length_per_error. The default is an ideal machine: no error at all.
struct CmmModel {
  double e0_mm = 0.0;
  // mm of length per um of error; absent: no errors that grow with length
  std::optional<double> length_per_error{};
  std::uint64_t seed = 0;  // the machine
  std::uint32_t draw = 0;  // another measurement on the same machine
  CmmKind kind = CmmKind::linear;
  // field: limit of the probing form error of the 25-point sphere; absent: e0
  std::optional<double> probing_limit{};
  // absent: an ideal probe (linear), shares of the probing limit (field)
  std::optional<ProbeErrors> probe{};
  std::optional<Stylus> stylus{};  // stated: collisions of its shank are looked for
  std::optional<ThermalState> temperature{};
  // field: the measuring volume, and where the workpiece's origin lies from its centre
  Vec3 travel = Vec3(700.0, 1000.0, 600.0);
  Vec3 position = Vec3::Zero();
};

// Largest permitted error of a length: e0 + L/k.
[[nodiscard]] double length_limit(const CmmModel& cmm, double length_mm);
// Of the form of the 25-point sphere.
[[nodiscard]] double probing_limit(const CmmModel& cmm);
// Those stated, or what the kind supposes.
[[nodiscard]] ProbeErrors probe_errors(const CmmModel& cmm);

// Reads the keys of docs/cmm.md, for example { e0 = "0.5 um", l_per_um = 600, seed = 1 }; all are
// optional.
[[nodiscard]] CmmModel read_cmm_model(const TomlTable& table);

}  // namespace frustum::metrology
