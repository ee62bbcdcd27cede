#include "metrology/probing/cmm_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "core/units.hpp"
#include "metrology/probing/cmm_errors.hpp"

namespace frustum::metrology {
namespace {

// An error of the machine: a bare number would be mm, where um are meant.
double error_length(const TomlTable& table, std::string_view key, double fallback, Bound bound) {
  const double length = table.length_or(key, Mm{fallback}, bound).value;
  if (table.is_number(key) && length != 0.0) {
    table.fail(key, "no-unit"_id, fmt::format("{:g} has no unit", length),
               "write for example \"0.5 um\"");
  }
  return length;
}

ProbeErrors read_probe(const TomlTable& table, const ProbeErrors& usual) {
  ProbeErrors p;
  const auto length = [&](std::string_view key, double fallback) {
    return error_length(table, key, fallback, Bound::non_negative);
  };
  p.pre_travel = length("pre_travel", usual.pre_travel);
  p.lobe = length("lobe", usual.lobe);
  p.lobe_phase = table.angle_or("lobe_phase", Rad{usual.lobe_phase}).value;
  p.ball_form = length("ball_form", usual.ball_form);
  p.force = table.number_or("force", usual.force, Bound::non_negative);
  p.repeatability = length("repeatability", usual.repeatability);
  p.scan_noise = length("scan_noise", usual.scan_noise);
  return p;
}

Stylus read_stylus(const TomlTable& table) {
  Stylus s;
  const Vec3 direction = table.vector_or("direction", s.direction);
  if (const auto known = UnitVec3::of(direction)) {
    s.direction = *known;
  } else {
    table.fail("direction", "cmm-stylus"_id, "must be a direction, is [0, 0, 0]",
               "from the ball to the head, for example [0, 0, 1]");
  }
  s.length = table.length("length", Bound::positive).value;
  s.diameter = table.length("diameter", Bound::positive).value;
  constexpr double kNewtonPerGigapascal = 1e3;  // N/mm^2
  s.modulus = kNewtonPerGigapascal *
              table.number_or("modulus", s.modulus / kNewtonPerGigapascal, Bound::positive);
  return s;
}

ThermalState read_temperature(const TomlTable& table) {
  ThermalState t;
  constexpr double kMicro = 1e-6;
  // Outside of this a number is a slip of the pen, or in K or degF.
  const auto temperature = [&](std::string_view key, double usual) {
    const double value = table.number_or(key, usual);
    if (value < -40.0 || value > 60.0) {
      table.fail(key, "cmm-temperature"_id,
                 fmt::format("must be between -40 and 60 degC, is {}", value),
                 "temperatures are in degC");
    }
    return value;
  };
  const auto expansion = [&](std::string_view key, double usual) {
    const double value = table.number_or(key, usual / kMicro, Bound::non_negative);
    if (value > 0.0 && value < 0.01) {
      table.fail(key, "cmm-temperature"_id, fmt::format("is {} um/(m K)", value),
                 "write 11.5 for 11.5e-6 1/K");
    }
    return kMicro * value;
  };
  t.part = temperature("part", t.part);
  t.scales = temperature("scales", t.scales);
  t.part_expansion = expansion("part_expansion", t.part_expansion);
  t.scale_expansion = expansion("scale_expansion", t.scale_expansion);
  t.compensated = table.boolean_or("compensated", t.compensated);
  t.sensor_error = table.number_or("sensor_error", 0.0, Bound::non_negative);
  t.expansion_error = kMicro * table.number_or("expansion_error", 0.0, Bound::non_negative);
  if (!t.compensated && (t.sensor_error > 0.0 || t.expansion_error > 0.0)) {
    table.fail(t.sensor_error > 0.0 ? "sensor_error" : "expansion_error", "cmm-temperature"_id,
               "belongs to a compensated machine", "write compensated = true");
  }
  return t;
}

void read_field(const TomlTable& table, CmmModel& cmm) {
  if (table.has("p_form")) cmm.probing_limit = error_length(table, "p_form", 0.0, Bound::positive);
  cmm.travel = table.vector_or("travel", cmm.travel);
  if (!(cmm.travel.minCoeff() > 0.0)) {
    table.fail("travel", "cmm-volume"_id, "must be three lengths greater than 0");
    cmm.travel = CmmModel{}.travel;
  }
  cmm.position = table.vector_or("position", cmm.position);
  if ((cmm.position.cwiseAbs().array() > 0.5 * cmm.travel.array()).any()) {
    table.fail("position", "cmm-volume"_id, "is outside of the travel",
               "the place of the workpiece's origin from the centre of the volume");
  }
}

void refuse_field_keys(const TomlTable& table) {
  for (const char* key : {"p_form", "travel", "position"}) {
    if (table.has(key)) {
      table.fail(key, "cmm-volume"_id, "belongs to a machine with a field",
                 "write model = \"field\"");
    }
  }
}

// A probe that breaks the statement alone leaves no machine to draw.
void check_budget(const TomlTable& table, const CmmModel& cmm) {
  if (cmm.kind != CmmKind::field || !table.is_sound()) return;
  const CmmErrors errors(cmm);
  constexpr double kRounding = 1e-11;  // mm, of a fitted sphere: what an ideal probe is off by
  const char* key = table.has("probe") ? "probe" : "p_form";
  if (errors.probing_share() > 0.9 * cmm.e0_mm + kRounding) {
    table.fail(key, "cmm-probe"_id,
               fmt::format("the probe alone may cost a length {:.3g} um, e0 is {:.3g} um",
                           errors.probing_share() * kUmPerMm, cmm.e0_mm * kUmPerMm),
               "state smaller probe errors, a shorter stylus, or a larger e0");
  }
  if (errors.form_share() > probing_limit(cmm) + kRounding) {
    table.fail(key, "cmm-probe"_id,
               fmt::format("the probe alone makes a form of {:.3g} um of the 25-point sphere, {} "
                           "is {:.3g} um",
                           errors.form_share() * kUmPerMm, table.has("p_form") ? "p_form" : "e0",
                           probing_limit(cmm) * kUmPerMm),
               "state smaller probe errors, a shorter stylus, or a larger p_form");
  }
}

}  // namespace

double length_limit(const CmmModel& cmm, double length_mm) {
  return cmm.e0_mm + (cmm.length_per_error ? 1e-3 * length_mm / *cmm.length_per_error : 0.0);
}

double probing_limit(const CmmModel& cmm) { return cmm.probing_limit.value_or(cmm.e0_mm); }

ProbeErrors probe_errors(const CmmModel& cmm) {
  if (cmm.probe) return *cmm.probe;
  if (cmm.kind == CmmKind::linear) return {};
  // The sphere's form is about twice lobe and ball form, and the noise of 25 points four
  // deviations.
  const double limit = probing_limit(cmm);
  // A lobe lies anywhere.
  const RandomKey key{.seed = cmm.seed, .purpose = RandomPurpose::cmm_probe};
  constexpr std::uint64_t kLobe = 1000;  // past the indices of the ball
  return {.lobe = 0.25 * limit,
          .lobe_phase = 2.0 * std::numbers::pi * uniform(key, kLobe),
          .ball_form = 0.05 * limit,
          .repeatability = 0.04 * limit,
          .scan_noise = 0.04 * limit};
}

CmmModel read_cmm_model(const TomlTable& table) {
  CmmModel cmm;
  cmm.e0_mm = error_length(table, "e0", 0.0, Bound::non_negative);
  if (table.has("l_per_um")) cmm.length_per_error = table.number("l_per_um", Bound::positive);
  cmm.seed = static_cast<std::uint64_t>(table.integer_or("seed", 0, Bound::non_negative));
  cmm.kind = static_cast<CmmKind>(table.choice_or("model", {"linear", "field"}, 0));
  if (cmm.kind == CmmKind::field) {
    read_field(table, cmm);
  } else {
    refuse_field_keys(table);
  }
  if (const auto stylus = table.table_if("stylus")) cmm.stylus = read_stylus(*stylus);
  if (const auto probe = table.table_if("probe")) {
    cmm.probe = read_probe(*probe, probe_errors(cmm));
    if (cmm.probe->force > 0.0 && !cmm.stylus) {
      probe->fail("force", "cmm-stylus"_id, "bends a stylus, and none is stated",
                  "write stylus = { length = 50, diameter = 2 }");
    }
  }
  if (const auto temperature = table.table_if("temperature")) {
    cmm.temperature = read_temperature(*temperature);
  }
  check_budget(table, cmm);
  return cmm;
}

}  // namespace frustum::metrology
