// The error gains of the DVF 5000, as the volumetric error thesis prints them and as computed apart
// from this program.
#include "kinematics/errors/error_ranking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

using enum parser::AxisLetter;
using nlohmann::json;

const json& expected() {
  static const json data = [] {
    std::ifstream in(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/dvf5000_gains.json");
    return json::parse(in);
  }();
  return data;
}

std::vector<MachineError> named(const Machine& machine, const std::vector<std::string>& names) {
  const auto errors = errors_named(machine, names);
  EXPECT_TRUE(errors);
  return *errors;
}

const std::vector<std::string>& tool_names() {
  static const auto names = expected()["tool_corner"]["names"].get<std::vector<std::string>>();
  return names;
}
const std::vector<std::string>& work_names() {
  static const auto names = expected()["work_home"]["names"].get<std::vector<std::string>>();
  return names;
}

constexpr double kTool = 150.0;
const Vec3 kOnTable(0, 275, 450);

GainMatrix tool_at(const Machine& machine, const std::vector<MachineError>& errors, double y,
                   double z) {
  AxisPositions q;
  q[Y] = y, q[Z] = z;
  return tool_side_gain(machine, errors, q, kTool);
}

double unit(const MachineError& error) { return is_rotation(error.error.direction) ? 1e-3 : 1.0; }

void expect_gains(const GainMatrix& gains, const std::vector<MachineError>& errors,
                  const json& table) {
  for (std::size_t i = 0; i < errors.size(); ++i) {
    for (std::size_t row = 0; row < 3; ++row) {
      EXPECT_NEAR(
          gains(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i)) * unit(errors[i]),
          table["G"][row][i].get<double>(), 1e-9)
          << errors[i].name << " row " << row;
    }
  }
}

TEST(ErrorGainReference, JangGainMatrixOfTheToolAtTheCorner) {
  const Machine machine = shipped("dvf5000");
  const auto errors = named(machine, tool_names());
  expect_gains(tool_at(machine, errors, -225, -480), errors, expected()["tool_corner"]);
}

TEST(ErrorGainReference, JangGainMatrixOfTheWorkpieceAtHome) {
  const Machine machine = shipped("dvf5000");
  const auto errors = named(machine, work_names());
  expect_gains(work_side_gain(machine, errors, {}, kOnTable), errors, expected()["work_home"]);
}

// |E|, |Ex|, |Ey|, |Ez| of one error, um per urad.
struct PrintedRow {
  const char* name;
  double values[4];
};

using Largest = std::map<std::string, std::array<double, 4>>;

void widen(Largest& largest, const std::vector<MachineError>& errors, const GainMatrix& gains) {
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const Vec3 g = gains.col(static_cast<Eigen::Index>(i)).head(3) * unit(errors[i]);
    auto& row = largest[errors[i].name];
    const double now[4] = {g.norm(), std::abs(g.x()), std::abs(g.y()), std::abs(g.z())};
    for (std::size_t k = 0; k < 4; ++k) row[k] = std::max(row[k], now[k]);
  }
}

int entries_that_match(const Largest& largest, std::span<const PrintedRow> printed) {
  int matches = 0;
  for (const PrintedRow& row : printed) {
    for (std::size_t k = 0; k < 4; ++k) {
      // Two printed digits; 0.275 is printed as .27.
      matches += std::abs(largest.at(row.name)[k] - row.values[k]) <= 0.005 + 1e-9 ? 1 : 0;
    }
  }
  return matches;
}

constexpr PrintedRow kTable43[] = {
    {"exX", {1.05, 0, 0.47, 0.94}}, {"eyX", {0.49, 0.47, 0, 0.14}}, {"ezX", {0.95, 0.94, 0.14, 0}},
    {"exY", {1.26, 0, 0.66, 1.07}}, {"eyY", {0.66, 0.66, 0, 0.07}}, {"ezY", {1.08, 1.07, 0.07, 0}},
    {"exZ", {0.99, 0, 0.96, 0.24}}, {"eyZ", {0.96, 0.96, 0, 0}},    {"ezZ", {0.24, 0.24, 0, 0}},
    {"gXY", {1.3, 1.3, 0.07, 0}},   {"aYZ", {1.46, 0, 1.44, 0.24}}, {"bXZ", {1.44, 1.44, 0, 0}}};

TEST(ErrorGainReference, JangTable4_3_All48EntriesAtTheCornerAndAsMaximaOverTheVolume) {
  const Machine machine = shipped("dvf5000");
  const auto errors = named(machine, tool_names());
  Largest corner, volume;
  widen(corner, errors, tool_at(machine, errors, -225, -480));
  for (double y = -225; y <= 225; y += 25) {
    for (double z = -480; z <= -80; z += 25) widen(volume, errors, tool_at(machine, errors, y, z));
  }
  EXPECT_EQ(entries_that_match(corner, kTable43), 48);
  EXPECT_EQ(entries_that_match(volume, kTable43), 48);
}

constexpr PrintedRow kTable44[] = {
    {"exB", {0.49, 0.27, 0.4, 0.27}},  {"eyB", {0.49, 0.48, 0, 0.48}},
    {"ezB", {0.27, 0.27, 0.27, 0.27}}, {"exC", {0.53, 0.53, 0.45, 0.53}},
    {"eyC", {0.45, 0.45, 0.45, 0.45}}, {"ezC", {0.27, 0.27, 0.27, 0.27}},
    {"aZB", {0.49, 0, 0.48, 0.27}},    {"gXB", {0.49, 0.27, 0.48, 0}},
    {"aYC", {0.53, 0.27, 0.45, 0.27}}, {"bXC", {0.53, 0.53, 0, 0.53}}};

TEST(ErrorGainReference, JangTable4_4_All40EntriesAsMaximaOverACoarseGrid) {
  const Machine machine = shipped("dvf5000");
  const auto errors = named(machine, work_names());
  for (const int step : {10, 15, 30}) {
    Largest largest;
    for (int b = -90; b <= 90; b += step) {
      for (int c = 0; c <= 360; c += step) {
        AxisPositions q;
        q[B] = b * kRadPerDeg, q[C] = c * kRadPerDeg;
        widen(largest, errors, work_side_gain(machine, errors, q, kOnTable));
      }
    }
    EXPECT_EQ(entries_that_match(largest, kTable44), 40) << step << " deg";
  }
}

void expect_ranking(const std::vector<RankedError>& found, const json& published) {
  ASSERT_EQ(found.size(), published.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    // Equal weights (the deltas) may be in any order among themselves.
    EXPECT_NEAR(found[i].weight, published[i][1].get<double>(), 1e-9) << i;
    const auto same = std::find_if(published.begin(), published.end(),
                                   [&](const json& row) { return row[0] == found[i].name; });
    ASSERT_NE(same, published.end());
    EXPECT_NEAR(found[i].weight, (*same)[1].get<double>(), 1e-9) << found[i].name;
  }
}

// The thesis' general tolerances: 10 um, 20 urad, squareness 25 urad.
std::vector<double> general_tolerances(const std::vector<MachineError>& errors) {
  std::vector<double> tolerances;
  for (const MachineError& e : errors) {
    tolerances.push_back(!is_rotation(e.error.direction) ? 10e-3
                         : e.error.location              ? 25e-6
                                                         : 20e-6);
  }
  return tolerances;
}

TEST(ErrorRankingReference, JangKeyErrorsByGainAndByShareOfTheMeanSquare) {
  const Machine machine = shipped("dvf5000");
  const auto tool = named(machine, tool_names()), work = named(machine, work_names());
  const GainMatrix of_tool = tool_at(machine, tool, -225, -480);
  const GainMatrix of_work = work_side_gain(machine, work, {}, kOnTable);
  const auto by_gain = rank_by_gain(tool, of_tool);
  expect_ranking(by_gain, expected()["ranking"]["by_gain"]);
  std::string first;
  for (std::size_t i = 0; i < 6; ++i) first += by_gain[i].name + " ";
  EXPECT_EQ(first, "aYZ bXZ gXY exY ezY exX ");
  expect_ranking(rank_by_share(tool, of_tool, general_tolerances(tool)),
                 expected()["ranking"]["by_variance_share"]);
  expect_ranking(rank_by_share(work, of_work, general_tolerances(work)),
                 expected()["ranking"]["work_by_variance_share"]);
}

TEST(ErrorRanking, HasNoSharesWithoutTolerances) {
  const Machine machine = shipped("dvf5000");
  const auto errors = named(machine, tool_names());
  const std::vector<double> none(errors.size(), 0.0);
  for (const RankedError& e : rank_by_share(errors, tool_at(machine, errors, 0, 0), none)) {
    EXPECT_EQ(e.weight, 0.0);
  }
}

}  // namespace
}  // namespace frustum::kinematics
