// The cone test on a shipped machine, ready to run with errors.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kinematics/errors/error_assignment.hpp"
#include "metrology/characteristic/characteristic.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "tests/trials/tip_trace.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {

struct ConeTrial {
  kinematics::Machine machine;
  programs::ConeFrustum cone;
  programs::TestPiece piece;

  static ConeTrial on(const std::string& machine, programs::ConeFrustum cone = {}) {
    auto loaded = kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" +
                                            machine + ".toml");
    EXPECT_TRUE(loaded);
    auto piece = programs::cone_frustum(cone, *loaded);
    EXPECT_TRUE(piece) << (piece ? "" : to_string(piece.error().front()));
    return {*loaded, cone, *piece};
  }

  [[nodiscard]] Trial run(const std::vector<std::string>& errors = {},
                          bool collisions = false) const {
    std::vector<kinematics::ErrorEntry> entries;
    for (const std::string& text : errors) entries.push_back(*kinematics::parse_error(text));
    TrialOptions options;
    options.find_collisions = collisions;
    auto trial = run_trial(machine, entries, piece, {}, options);
    EXPECT_TRUE(trial) << (trial ? "" : to_string(trial.error().front()));
    return trial ? *std::move(trial) : Trial{};
  }

  // um
  [[nodiscard]] static double value(const Trial& trial, const std::string& name) {
    for (const auto& c : trial.measurement.characteristics) {
      if (c.name == name) return c.value;
    }
    ADD_FAILURE() << "no characteristic " << name;
    return -1.0;
  }

  // Equivalent cone form of the bare tip, um.
  [[nodiscard]] double tip_form(const Trial& trial) const {
    const auto tips = tips_of(trial, piece, "cone finishing");
    const auto form =
        metrology::equivalent_cone_form(tips, cone.cone_angle.value, UnitVec3::z(), {});
    EXPECT_TRUE(form);
    return form ? form->peak_to_valley * 1e3 : -1.0;
  }
};

}  // namespace frustum::trials
