// The machines and numbers of tests/data/dynamics.json.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "dynamics/model_file.hpp"

namespace frustum::dynamics {

using nlohmann::json;

constexpr double kUm = 1e6;      // in a metre
constexpr double kShare = 1e-8;  // of the largest entry: the numbers have ten digits

inline const json& expected() {
  static const json kNumbers = [] {
    std::ifstream in(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/dynamics.json");
    return json::parse(in);
  }();
  return kNumbers;
}

inline std::string keys_of(const json& table) {
  std::string text;
  for (const auto& [key, value] : table.items()) text += key + " = " + value.dump() + "\n";
  return text;
}

// A machine file, one key a line. `control`: with the controls of the axes.
inline std::string machine_text(const json& machine, bool control = false) {
  const std::string structure = machine["structure"];
  std::string text = "name = " + machine["name"].dump() + "\nstructure = \"" + structure + "\"\n";
  const json offset = machine.value("offset", json::object());
  for (const char axis : std::string("XYZABC")) {
    const std::string letter(1, axis);
    if (structure.find("-" + letter + "-") == std::string::npos) continue;
    text += "[axis." + letter + "]\n";
    text += axis < 'X' ? "endless = true\n" : "travel = [-2000, 2000]\n";
    if (offset.contains(letter)) text += "offset = " + offset[letter].dump() + "\n";
  }
  text += "[dynamics]\n";
  if (machine.contains("workpiece")) text += "workpiece = " + machine["workpiece"].dump() + "\n";
  for (const auto& [name, body] : machine["bodies"].items()) {
    text += "[dynamics.body." + name + "]\n" + keys_of(body);
  }
  for (const json& mount : machine["mounts"]) text += "[[dynamics.mount]]\n" + keys_of(mount);
  for (const auto& [letter, axis] : machine["axes"].items()) {
    for (const char* kind : {"carriage", "bearing"}) {
      for (const json& element : axis.value(std::string(kind) + "s", json::array())) {
        text += "[[dynamics.axis." + letter + "." + kind + "]]\n" + keys_of(element);
      }
    }
    text += "[dynamics.axis." + letter + ".drive]\n" + keys_of(axis["drive"]);
    if (control && machine["control"].contains(letter)) {
      text += "[dynamics.axis." + letter + ".control]\n" + keys_of(machine["control"][letter]);
    }
  }
  return text;
}

inline Result<std::optional<DynamicModel>> model_from_text(const std::string& text) {
  return kinematics::Machine::read(text, "machine.toml").and_then([&](const auto& machine) {
    return read_model(text, "machine.toml", machine);
  });
}

inline DynamicModel model_named(const std::string& name, bool control = false) {
  auto model = model_from_text(machine_text(expected()["machines"][name], control));
  if (!model) {
    print(std::cerr, model.error());
    std::abort();
  }
  return **std::move(model);
}

inline kinematics::AxisPositions positions_of(const json& axes) {
  kinematics::AxisPositions q;
  for (const auto& [letter, value] : axes.items()) {
    const auto axis = *kinematics::axis_named(letter);
    q[axis] = value.get<double>() * (is_rotary(axis) ? kRadPerDeg : 1.0);
  }
  return q;
}

// Numbers of nested arrays, one after the other.
inline void flatten(const json& numbers, std::vector<double>& flat) {
  if (numbers.is_array()) {
    for (const json& entry : numbers) flatten(entry, flat);
  } else {
    flat.push_back(numbers.get<double>());
  }
}

inline json as_json(const Eigen::MatrixXd& matrix) {
  json rows = json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    json row = json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(matrix(r, c));
    rows.push_back(row);
  }
  return rows;
}
inline json as_json(const Eigen::MatrixXcd& matrix) {
  json rows = json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    json row = json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) {
      row.push_back({matrix(r, c).real(), matrix(r, c).imag()});
    }
    rows.push_back(row);
  }
  return rows;
}
inline json as_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// Both flat, within `share` of the largest entry that is expected.
inline void expect_near(const json& found, const json& wanted, double share,
                        const std::string& what) {
  std::vector<double> f, w;
  flatten(found, f);
  flatten(wanted, w);
  ASSERT_EQ(f.size(), w.size()) << what;
  double largest = 0.0, off = 0.0;
  for (const double x : w) largest = std::max(largest, std::abs(x));
  for (std::size_t i = 0; i < w.size(); ++i) off = std::max(off, std::abs(f[i] - w[i]));
  EXPECT_LE(off, share * largest) << what << ": " << off / largest << " of the largest, "
                                  << found.dump().substr(0, 300) << " for "
                                  << wanted.dump().substr(0, 300);
  EXPECT_FALSE(std::isnan(off)) << what;
}

template <typename Values>
json first(const Values& values, std::size_t count) {
  json list = json::array();
  for (std::size_t i = 0; i < count && i < static_cast<std::size_t>(values.size()); ++i) {
    list.push_back(values[static_cast<decltype(values.size())>(i)]);
  }
  return list;
}

}  // namespace frustum::dynamics
