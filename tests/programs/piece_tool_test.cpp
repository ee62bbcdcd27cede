// The tool of a test piece: shank and holder, in the job that is written, and clear of the piece.
#include "programs/piece_tool.hpp"

#include <gtest/gtest.h>

#include <string>

#include "cutter/body/cutter.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "programs/test_piece_files.hpp"
#include "trials/trial.hpp"

namespace frustum::programs {
namespace {

TEST(PieceTool, Fault2_24_HasShankAndHolder) {
  const auto tool = cutter::Cutter::make(piece_tool({12.0}, {150.0}, {20.0}));
  ASSERT_TRUE(tool);
  ASSERT_TRUE(tool->shank() && tool->holder());
  EXPECT_NEAR(tool->shank()->max_radius(), 6.0, 1e-12);
  EXPECT_NEAR(tool->shank()->height(), 90.0, 1e-12);
  EXPECT_NEAR(tool->holder()->max_radius(), 21.0, 1e-12);
  EXPECT_NEAR(tool->holder()->height(), 150.0, 1e-12);
  // 10 mm of shank stay free; where less than 20 mm would be left there is no holder.
  const auto shorter = cutter::Cutter::make(piece_tool({12.0}, {50.0}, {20.0}));
  ASSERT_TRUE(shorter);
  EXPECT_NEAR(shorter->shank()->height(), 30.0, 1e-12);
  EXPECT_NEAR(shorter->holder()->height(), 50.0, 1e-12);
  for (const double length : {49.0, 20.0, 15.0}) {
    const auto bare = cutter::Cutter::make(piece_tool({12.0}, {length}, {20.0}));
    ASSERT_TRUE(bare) << length;
    EXPECT_FALSE(bare->holder()) << length;
  }
}

TEST(PieceTool, Fault2_24_IsInTheJobAndClearOfThePiece) {
  for (const std::string name : {"iwf-bc", "double-pivot-head"}) {
    const auto machine =
        kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
    ASSERT_TRUE(machine);
    const auto piece = cone_frustum(ConeFrustum{}, *machine);
    ASSERT_TRUE(piece);
    const std::string job = job_text(*piece, name, "cone.plan.toml");
    EXPECT_NE(job.find("shank_diameter = 12, holder = [[60, 42, 42]]"), std::string::npos) << job;
    const auto trial =
        trials::run_trial(*machine, kinematics::GeometricErrors{}, *piece, {}, {.measure = false});
    ASSERT_TRUE(trial) << to_string(trial.error().front());
    EXPECT_TRUE(trial->collisions.empty()) << name;
  }
}

}  // namespace
}  // namespace frustum::programs
