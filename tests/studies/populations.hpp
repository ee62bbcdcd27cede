// The populations of Table 3.9 of the ETH thesis on the tip's ring, and the numbers of an
// independent computation.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "kinematics/errors/error_table.hpp"
#include "studies/engine/tip_ring.hpp"

namespace frustum::studies {

inline const nlohmann::json& expected() {
  static const nlohmann::json kNumbers = nlohmann::json::parse(
      std::ifstream(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/studies.json"));
  return kNumbers;
}

// Reading A: as drawn. R: reversals by half, orders 2 and 3 of X, Y and Z by half (of angular ones
// order 2), and three tilts of the rotary axes not at all.
inline std::vector<ScaleRule> reading(char name) {
  if (name == 'A') return {};
  return {{"*:reversal", 0.5},
          {"E?X:harmonic 2", 0.5},
          {"E?Y:harmonic 2", 0.5},
          {"E?Z:harmonic 2", 0.5},
          {"E?X:harmonic 3", 0.5},
          {"E?Y:harmonic 3", 0.5},
          {"E?Z:harmonic 3", 0.5},
          {"ECB", 0.0},
          {"EAC", 0.0},
          {"EBC", 0.0}};
}

inline kinematics::Machine machine_named(const std::string& name) {
  auto machine =
      kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  EXPECT_TRUE(machine);
  return *std::move(machine);
}

inline std::vector<kinematics::ErrorEntry> errors_of_file(const std::string& name) {
  const auto list = kinematics::load_error_file(std::string(FRUSTUM_SOURCE_DIR) +
                                                "/machines/errors/" + name + ".toml");
  EXPECT_TRUE(list);
  return list->entries;
}

inline ConeRing ring_named(const std::string& setup) {
  const nlohmann::json& s = expected()["setups"][setup];
  ConeRing ring;
  ring.half_angle = s["half_angle"].get<double>() * kRadPerDeg;
  ring.inclination = s["inclination"].get<double>() * kRadPerDeg;
  ring.radius = s["radius"];
  ring.center = Vec3(s["centre"][0], s["centre"][1], s["centre"][2]);
  return ring;
}

struct RingPopulation {
  FactorSet set;
  LinearModel model;
  Eigen::MatrixXd gains;  // um, centred

  // "proposed/cone", 'R'; made once.
  static const RingPopulation& of(const std::string& place, char read, double tool_length = 0.0) {
    static std::map<std::string, RingPopulation> known;
    const std::string key = place + read + std::to_string(tool_length);
    const auto found = known.find(key);
    if (found != known.end()) return found->second;
    return known.emplace(key, made(place, read, tool_length)).first->second;
  }

  static RingPopulation made(const std::string& place, char read, double tool_length) {
    static const kinematics::Machine kMachine = machine_named("iwf-bc");
    ConeRing ring = ring_named(place.substr(0, place.find('/')));
    ring.tool_length = tool_length;
    const bool is_cone = place.ends_with("/cone");
    const auto path = is_cone ? cone_path(kMachine, ring) : cylinder_path(kMachine, ring);
    EXPECT_TRUE(path);
    auto set = FactorSet::make(kMachine, errors_of_file("bossoni-cone-limits"),
                               {.scale = reading(read), .spans = path->spans});
    EXPECT_TRUE(set) << (set ? "" : to_string(set.error().front()));
    LinearModel model = is_cone ? cone_model(kMachine, *path, *set, ring)
                                : cylinder_model(kMachine, *path, *set, ring);
    Eigen::MatrixXd gains = 1e3 * ring_gains(kMachine, *path, *set, tool_length);
    return {*std::move(set), std::move(model), std::move(gains)};
  }

  [[nodiscard]] Eigen::VectorXd weights(std::uint64_t seed, std::uint32_t draw) const {
    std::vector<double> values(set.variables().size());
    Eigen::VectorXd w(static_cast<Eigen::Index>(set.columns().size()));
    set.draw(seed, draw, values);
    set.weights(values, {w.data(), set.columns().size()});
    return w;
  }
};

}  // namespace frustum::studies
