// The eleven step patterns on zx-yac, ready to run, and the independent numbers for them.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "programs/step/step_pattern.hpp"
#include "trials/sensitivity.hpp"

namespace frustum::trials {

inline nlohmann::json test_data(const std::string& name) {
  std::ifstream in(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/" + name);
  return nlohmann::json::parse(in);
}

inline kinematics::Machine step_machine() {
  auto machine =
      kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/zx-yac.toml");
  EXPECT_TRUE(machine);
  return *machine;
}

inline programs::TestPiece step_piece(int workpiece, std::vector<std::string> patterns) {
  programs::StepTest test;
  test.workpiece = *programs::step_workpiece(workpiece);
  test.patterns = std::move(patterns);
  auto piece = programs::step_pattern(test, step_machine());
  EXPECT_TRUE(piece) << (piece ? "" : to_string(piece.error().front()));
  return piece->piece;
}

// All eleven patterns take three workpieces: 3 and 4 cut the same surfaces.
inline std::vector<programs::TestPiece> all_step_pieces() {
  return {step_piece(1, {}), step_piece(2, {}), step_piece(2, {"4"})};
}

// The paper's symbols in the order of the data file, as the machine's error names; gamma_YX,
// alpha_ZY and beta_ZX carry (literal equation (4)), EC0Y only tilts the line.
struct Symbol {
  const char* in_data;
  const char* error;
};
inline constexpr Symbol kStepSymbols[] = {
    {"a_AY", "alpha_AY"}, {"b_AY", "beta_AY"},  {"b_CA", "beta_CA"}, {"g_AY", "gamma_AY"},
    {"dx_AY", "dx_AY"},   {"dy_AY", "dy_AY"},   {"dy_CA", "dy_CA"},  {"dz_AY", "dz_AY"},
    {"g_YX", "gamma_YX"}, {"a_ZY", "alpha_ZY"}, {"b_ZX", "beta_ZX"}, {"d_r", "tool_radius_error"}};

}  // namespace frustum::trials
