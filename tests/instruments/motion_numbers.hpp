// The numbers of tests/data/motion_tests.json, and the tests that they are of.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "instruments/circle_test.hpp"
#include "instruments/rotary_test.hpp"
#include "instruments/setup_errors.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::instruments {

using nlohmann::json;

inline const json& motion_numbers() {
  static const json kNumbers =
      json::parse(std::ifstream(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/motion_tests.json"));
  return kNumbers;
}

inline Vec3 vector_of(const json& v) {
  return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

inline kinematics::GeometricErrors errors_of(const kinematics::Machine& machine,
                                             const std::vector<std::string>& texts) {
  std::vector<kinematics::ErrorEntry> entries;
  for (const std::string& text : texts) entries.push_back(*kinematics::parse_error(text));
  return *kinematics::resolve(machine, entries);
}

// {"EX0C": 4, "EA0C": "12urad"}: a bare number is in um or urad.
inline std::vector<std::string> error_texts(const json& errors) {
  std::vector<std::string> texts;
  for (const auto& [name, value] : errors.items()) {
    const bool angle = name[1] >= 'A' && name[1] <= 'C';
    texts.push_back(
        name + "=" +
        (value.is_string() ? value.get<std::string>() : value.dump() + (angle ? "urad" : "um")));
  }
  return texts;
}

inline SetupErrors setup_of(const json& um) {
  if (um.is_null()) return {};
  return {vector_of(um["ball"]) / kUmPerMm, vector_of(um["table_ball"]) / kUmPerMm,
          um["length"].get<double>() / kUmPerMm};
}

inline std::vector<double> radians(const json& degrees) {
  std::vector<double> angles;
  for (const json& each : degrees) angles.push_back(each.get<double>() * kRadPerDeg);
  return angles;
}

inline kinematics::AxisPositions axes_of(const json& degrees) {
  kinematics::AxisPositions q;
  for (const auto& [name, value] : degrees.items()) {
    q[*kinematics::axis_named(name)] = value.get<double>() * kRadPerDeg;
  }
  return q;
}

inline RotaryTest rotary_case(const json& test) {
  const auto hold = test["hold"] == "rotor" ? BarHold::rotor : BarHold::bed;
  return {.axis = *kinematics::axis_named(test["axis"].get<std::string>()),
          .direction = *bar_direction_named(test["direction"].get<std::string>()),
          .hold = hold,
          .table_ball = vector_of(test["table_ball_mm"]),
          .length = test["bar_mm"],
          .angles = radians(test["angle_deg"]),
          .held = axes_of(test["held_deg"]),
          .tool_length = test["tool_length_mm"]};
}

// Heads have the tool length with which the numbers were computed.
inline double tool_length_of(const kinematics::Machine& machine) {
  for (const kinematics::Joint& joint : machine.tool_chain()) {
    if (joint.rotary()) return 150.0;
  }
  return 0.0;
}

}  // namespace frustum::instruments
