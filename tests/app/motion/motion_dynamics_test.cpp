// A ball bar on a machine whose masses and springs move the tip.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

constexpr const char* kCircle =
    "motion circle --machine iwf-bc --tool-length 150 --plane XY --length 50 --center 0,0,150 ";

class MotionDynamicsSystem : public CommandLine {};

TEST_F(MotionDynamicsSystem, TheBallBarReadsTheHarmonicSteadyState) {
  const json wanted = json::parse(
      read(fs::path(FRUSTUM_SOURCE_DIR) / "tests/data/dynamics.json"))["circle_spring_drives"];
  for (const char* method : {"quasi_static", "linear"}) {
    const Outcome outcome = run(std::string(kCircle) + "--feed 10000 --json --dynamics " + method);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json found = json::parse(outcome.out);
    EXPECT_EQ(found["dynamics"], method);
    for (const char* sense : {"ccw", "cw"}) {
      const std::vector<double> readings = found[std::string(sense) + "_um"];
      const double mean = std::accumulate(readings.begin(), readings.end(), 0.0) /
                          static_cast<double>(readings.size());
      const double range = found["evaluation"][std::string("G_") + sense + "_ls"];
      std::cout << method << ' ' << sense << ": mean " << mean << " um, G " << range << " um\n";
      EXPECT_NEAR(mean, wanted["mean_radial_um"].get<double>(), 0.05);
      EXPECT_NEAR(range, wanted["roundness_lsq_um"].get<double>(), 0.05);
    }
  }
}

json moved_answer(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return json::parse(outcome.out, nullptr, false);
}

// Peak to valley without mean, cos and sin.
double form_of(const std::vector<double>& degrees, const std::vector<double>& values) {
  Eigen::MatrixX3d first(static_cast<Eigen::Index>(values.size()), 3);
  Eigen::VectorXd v(first.rows());
  for (Eigen::Index i = 0; i < first.rows(); ++i) {
    const double phi = degrees[static_cast<std::size_t>(i)] * std::numbers::pi / 180.0;
    first.row(i) << 1.0, std::cos(phi), std::sin(phi);
    v[i] = values[static_cast<std::size_t>(i)];
  }
  const Eigen::Matrix3d normal = first.transpose() * first;
  v -= first * normal.ldlt().solve(first.transpose() * v);
  return v.maxCoeff() - v.minCoeff();
}

TEST_F(MotionDynamicsSystem, ABarOnTheConeReadsTheFormOfThePath) {
  const auto form = [&](const char* feed, const char* method) {
    const json found =
        moved_answer(run(std::string("motion cone --machine iwf-bc --tool-length 150 --json "
                                     "--dynamics ") +
                         method + " --feed " + feed));
    EXPECT_EQ(found["dynamics"], method);
    return form_of(found["angles_deg"], found["reading_um"]);
  };
  // At 4000 mm/min the time law slows the rotary axes near phi = 0.
  const double slow = form("1000", "quasi_static"), fast = form("2000", "quasi_static");
  const double linear = form("2000", "linear");
  std::cout << "cone at 1000 and 2000 mm/min: " << slow << ", " << fast << " um, linear " << linear
            << " um\n";
  EXPECT_NEAR(slow, 3.3013116 / 4.0, 0.01 * 0.83);
  EXPECT_NEAR(fast, 3.3013116, 0.01 * 3.3);
  // The accelerations of the time law ring.
  EXPECT_GT(linear, 3.3);
  EXPECT_LT(linear, 1.5 * 3.3);
}

// In the middle of a long turn the rates are those of the chase.
TEST_F(MotionDynamicsSystem, AChaseInMotionReadsTheDeviationOfItsRates) {
  const std::string chase =
      "motion chase --machine iwf-bc --tool-length 150 --ball 120,30,150 --json ";
  const json still = moved_answer(run(chase + "--at \"B=20,C=89.99;B=20,C=90;B=20,C=90.01\""));
  constexpr double kSpeed = 120.0 * std::numbers::pi / 180.0;  // rad/s
  constexpr double kStep = 0.01 * std::numbers::pi / 180.0;
  std::string axes, rates;
  for (const auto& [name, values] : still["axes"].items()) {
    const double unit = name == "B" || name == "C" ? std::numbers::pi / 180.0 : 1e-3;
    const double a = values[0], b = values[1], c = values[2];
    const std::string comma = axes.empty() ? "" : ",";
    axes += comma + fmt::format("{}={}", name, b);
    rates += comma + fmt::format("{}={}:{}", name, (c - a) / (2.0 * kStep) * kSpeed * unit,
                                 (c - 2.0 * b + a) / (kStep * kStep) * kSpeed * kSpeed * unit);
  }
  const json wanted = moved_answer(
      run("dynamics iwf-bc --tool-length 150 --axes " + axes + " --rates " + rates + " --json"));
  const json moving = moved_answer(run(chase + "--at \"B=20,C=0;B=20,C=90;B=20,C=180\" --feed 7200 "
                                               "--dynamics quasi_static"));
  EXPECT_EQ(moving["feed_deg_min"], 7200.0);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(moving["displacement_um"][1][i].get<double>(),
                wanted["rates"]["tip_in_table_um"][i].get<double>(), 0.02);
  }
  EXPECT_GT(std::abs(moving["displacement_um"][1][0].get<double>()), 0.5);
}

TEST_F(MotionDynamicsSystem, ATurnGrowsWithTheSquareOfItsFeed) {
  const auto reading = [&](const char* feed) {
    return moved_answer(
               run(std::string("motion rotary --machine iwf-bc --axis C --direction radial "
                               "--ball 50,0,150 --length 100 --tool-length 150 "
                               "--angles 0,170,180,190,360 "
                               "--dynamics quasi_static --json --feed ") +
                   feed))["reading_um"]
        .get<std::vector<double>>();
  };
  const auto slow = reading("3600"), fast = reading("7200");
  for (std::size_t i = 1; i < 4; ++i) {  // beside the ends, where the axis gets up to its speed
    EXPECT_GT(std::abs(slow[i]), 0.01);
    EXPECT_NEAR(fast[i] / slow[i], 4.0, 0.01);
  }
}

// A cascade without feed-forward is late by v / Kv: a laser that reads on the fly shows it.
TEST_F(MotionDynamicsSystem, ALaserInMotionReadsTheLagOfTheControl) {
  std::ofstream(folder_ / "m.toml", std::ios::binary)
      << read(fs::path(FRUSTUM_SOURCE_DIR) / "machines" / "iwf-bc.toml")
      << "[dynamics.axis.X.control]\nkind = \"direct\"\nkv = 50\nkp = 150\n";
  const std::string line = "motion line --machine m.toml --axis X --targets=-100,0,100 --json ";
  const json found = moved_answer(run(line + "--feed 3000 --dynamics linear --jerk"));
  // 50 mm/s and 50 1/s.
  EXPECT_NEAR(found["deviations_up_um"][1][0].get<double>(), -1000.0, 0.5);
  EXPECT_NEAR(found["deviations_down_um"][1][0].get<double>(), 1000.0, 0.5);
  const json again = moved_answer(run(line + "--feed 3000 --dynamics linear --jerk --out l"));
  const json rerun = moved_answer(run("motion run l/test.toml --json"));
  EXPECT_EQ(rerun["deviations_up_um"], found["deviations_up_um"]);
  const json diagonal = moved_answer(
      run("motion diagonal --machine m.toml --box \"X=-100:100,Y=-100:100\" --points 5 --json "
          "--feed 3000 --dynamics linear --jerk"));
  EXPECT_EQ(diagonal["diagonals"]["++"].size(), 5U);
}

TEST_F(MotionDynamicsSystem, OffReadsWhatItReadBefore) {
  const Outcome plain = run(std::string(kCircle) + "--feed 3000 --json");
  const Outcome off = run(std::string(kCircle) + "--feed 3000 --json --dynamics off");
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_EQ(plain.out, off.out);
}

TEST_F(MotionDynamicsSystem, RefusesWhatIsWrong) {
  const auto refusal = [&](const std::string& options) {
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    return outcome.err;
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal(std::string(kCircle) + "--dynamics linear"), HasSubstr("needs --feed"));
  EXPECT_THAT(refusal(std::string(kCircle) + "--feed 1000 --dynamics lineer"), HasSubstr("linear"));
  EXPECT_THAT(refusal("motion cone --machine iwf-bc --feed 1000"), HasSubstr("is for --dynamics"));
  EXPECT_THAT(refusal("motion line --machine iwf-bc --axis X --targets 0,1 --jerk"),
              HasSubstr("is for --dynamics"));
  EXPECT_THAT(refusal("motion line --machine iwf-bc --axis X --targets 0,1 --feed nan --dynamics "
                      "linear"),
              HasSubstr("above 0"));
  EXPECT_THAT(refusal("motion chase --machine iwf-bc --ball 0,0,150 --at C=0 --feed 10 --dynamics "
                      "linear"),
              HasSubstr("poses between which"));
  EXPECT_THAT(refusal("motion circle --machine zx-yac --plane XY --length 50 --center 0,0,150 "
                      "--feed 1000 --dynamics linear"),
              HasSubstr("states no masses and springs"));
}

}  // namespace
}  // namespace frustum
