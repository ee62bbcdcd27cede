// A circle from NC text to what a ball bar between table and tool reads of the moving machine.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "dynamics/model_file.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {
namespace {

const Vec3 kBall(0, 0, 150);
constexpr double kBar = 50.0;      // mm
constexpr double kFeed = 10000.0;  // mm/min

programs::TestPiece circle_piece() {
  programs::TestPiece piece;
  piece.program =
      "G21 G90 G17 G54\nT1 M6\nG43 H1\nS1000 M3\nG0 X50 Y0\nG0 Z0\nG3 X50 Y0 I-50 J0 F10000\n"
      "G3 X50 Y0 I-50 J0\nG3 X50 Y0 I-50 J0\nG3 X50 Y0 I-50 J0\nM5\nM30\n";
  piece.program_file = "circle.nc";
  piece.work_offsets = {{1, kBall}};
  cutter::CutterSpec tool;
  tool.diameter = Mm{10.0};
  tool.length = Mm{150.0};
  piece.tools = {{1, tool}};
  return piece;
}

struct BarCircle {
  double mean = 0.0, range = 0.0;  // um
};
// About the least-squares circle, to first order.
BarCircle evaluated(const kinematics::ToolPath& path, double from, double to) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vec3 right = Vec3::Zero();
  std::vector<std::pair<Vec3, double>> rows;
  double sum = 0.0;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    if (path.times[i] < from || path.times[i] >= to) continue;
    const double reading = ((path.poses[i].tip - kBall).norm() - kBar) * 1e3;
    const Vec3 e = (path.poses[i].tip - kBall).normalized();
    rows.emplace_back(Vec3(1.0, e.x(), e.y()), reading);
    normal += rows.back().first * rows.back().first.transpose();
    right += reading * rows.back().first;
    sum += reading;
  }
  const Vec3 circle = normal.ldlt().solve(right);
  double low = 1e300, high = -1e300;
  for (const auto& [row, reading] : rows) {
    low = std::min(low, reading - row.dot(circle));
    high = std::max(high, reading - row.dot(circle));
  }
  return {sum / static_cast<double>(rows.size()), high - low};
}

TEST(MovingCircleReference, ABallBarReadsTheHarmonicSteadyStateOfTheProgram) {
  const std::string file = FRUSTUM_SOURCE_DIR "/machines/iwf-bc.toml";
  const auto machine = kinematics::Machine::load(file);
  ASSERT_TRUE(machine);
  auto model = dynamics::load_model(file, *machine);
  ASSERT_TRUE(model && *model);
  std::ifstream in(FRUSTUM_SOURCE_DIR "/tests/data/dynamics.json");
  const auto wanted = nlohmann::json::parse(in)["circle_spring_drives"];
  const programs::TestPiece piece = circle_piece();
  const auto commanded = command_piece(*machine, piece);
  ASSERT_TRUE(commanded) << to_string(commanded.error().front());
  for (const auto method : {dynamics::PathMethod::quasi_static, dynamics::PathMethod::linear}) {
    TrialOptions options;
    options.time_law = {};  // with the limits of the axes
    options.dynamic_model = std::make_shared<const dynamics::DynamicModel>(**model);
    options.dynamics.method = method;
    const auto travel = tool_travel(*machine, {}, setup_of(piece), commanded->program, options);
    ASSERT_TRUE(travel);
    // The third of the four turns: the feed is reached, and the end not yet seen.
    const double turn = 2.0 * std::numbers::pi * kBar / kFeed * 60.0;
    const double arrives = travel->cycle_time - 1.5 * turn;
    const BarCircle found = evaluated(travel->path, arrives - turn, arrives);
    std::cout << "mean " << found.mean << " um (" << wanted["mean_radial_um"] << "), range "
              << found.range << " um (" << wanted["roundness_lsq_um"] << ")\n";
    EXPECT_NEAR(found.mean, wanted["mean_radial_um"].get<double>(), 0.05);
    EXPECT_NEAR(found.range, wanted["roundness_lsq_um"].get<double>(), 0.05);
  }
}

}  // namespace
}  // namespace frustum::trials
