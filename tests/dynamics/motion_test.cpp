#include "dynamics/jerk_move.hpp"
#include "tests/dynamics/machines.hpp"

namespace frustum::dynamics {
namespace {

TEST(JerkMoveReference, HasTheMovesOfTwoAxes) {
  const DynamicModel model = model_named("iwf-bc");
  for (const json& wanted : expected()["jerk_move"]) {
    const auto axis = *kinematics::axis_named(wanted["axis"].get<std::string>());
    const JerkMove move = jerk_move(model, positions_of(wanted["axes"]), wanted["tool_length_mm"],
                                    *model.axis(axis), {0.1, 0.5, 4.0, 100.0});
    json breakpoints = json::array(), rows = json::array();
    for (const Breakpoint& b : move.breakpoints) breakpoints.push_back({b.time, b.acceleration});
    for (const auto& row : move.rows) {
      const Vec3 d = row.tip * kUm;
      rows.push_back({row.time, d.x(), d.y(), d.z()});
    }
    expect_near(breakpoints, wanted["breakpoints_s_m_s2"], 1e-12, "breakpoints");
    expect_near(rows, wanted["rows"], 1e-9, "rows");
    expect_near(as_json(Vec3(move.largest * kUm)), wanted["largest_um"], 1e-6, "largest");
    expect_near(as_json(Vec3(move.largest_after * kUm)), wanted["largest_after_the_move_um"], 1e-6,
                "largest after the move");
  }
}

TEST(JerkMove, KeepsItsLimitsAndArrives) {
  for (const double distance : {1e-6, 1e-3, 0.02, 0.1, -1.0}) {
    for (const double jerk : {10.0, 1e3, 1e6}) {
      const MoveLimits limits{distance, 0.5, 4.0, jerk};
      const auto profile = jerk_profile(limits);
      double way = 0.0, speed = 0.0;
      for (std::size_t i = 1; i < profile.size(); ++i) {
        const double t = profile[i].time - profile[i - 1].time;
        const double a = profile[i - 1].acceleration, b = profile[i].acceleration;
        EXPECT_LE(std::abs(b - a), jerk * t * (1 + 1e-9));
        EXPECT_LE(std::abs(b), 4.0 * (1 + 1e-12));
        way += speed * t + t * t * (2.0 * a + b) / 6.0;
        speed += 0.5 * t * (a + b);
        EXPECT_LE(std::abs(speed), 0.5 * (1 + 1e-9));
      }
      EXPECT_NEAR(way, distance, 1e-12);
      EXPECT_NEAR(speed, 0.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace frustum::dynamics
