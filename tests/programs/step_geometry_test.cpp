// The table of patterns against positions computed independently (tests/data).
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "programs/step/near_net_blank.hpp"
#include "programs/step/step_pattern.hpp"
#include "programs/step/tilting_table.hpp"

namespace frustum::programs {
namespace {

using kinematics::AxisLetter;

struct Row {
  std::string pattern{};
  StepName step = StepName::a;
  std::vector<double> numbers{};  // A, C, Cx, Cy, H, L, W, H0, L0, from XYZ, to XYZ
};

std::vector<Row> expected_commands() {
  std::ifstream in(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/step-pattern-commands.csv");
  std::vector<Row> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#' || line.starts_with("pattern")) continue;
    std::istringstream cells(line);
    Row row;
    std::string cell;
    std::getline(cells, row.pattern, ',');
    std::getline(cells, cell, ',');
    row.step = static_cast<StepName>(cell[0] - 'a');
    while (std::getline(cells, cell, ',')) row.numbers.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

kinematics::Machine machine(const std::string& name) {
  auto loaded =
      kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  EXPECT_TRUE(loaded);
  return *loaded;
}

StepWorkpiece workpiece_of(const std::string& pattern) {
  StepWorkpiece first = *step_workpiece(1);
  return first.size(pattern) != nullptr ? first : *step_workpiece(2);
}

TEST(StepGeometryReference, CommandsOfEveryStepAgreeWithTheIndependentComputation) {
  const auto zx_yac = machine("zx-yac");
  const auto table = TiltingTable::of(zx_yac);
  ASSERT_TRUE(table);
  const auto rows = expected_commands();
  ASSERT_EQ(rows.size(), 44U);
  double worst = 0.0;
  for (const Row& row : rows) {
    SCOPED_TRACE(row.pattern + " " + to_char(row.step));
    const auto& n = row.numbers;
    const StepPattern& pattern = *find_step_pattern(row.pattern);
    const StepWorkpiece piece = workpiece_of(row.pattern);
    const StepSize& size = *piece.size(row.pattern);
    EXPECT_EQ((std::vector{piece.centre_x, piece.centre_y, size.height, size.width, size.length,
                           size.reference_height, size.reference_width}),
              std::vector<double>(n.begin() + 2, n.begin() + 9));
    const StepPass& pass = pattern.pass(row.step);
    EXPECT_NEAR(pass.tilt * kDegPerRad, n[0], 1e-12);
    EXPECT_NEAR(pass.turn * kDegPerRad, n[1], 1e-12);
    // That computation has the tip 10 mm below the line wherever the side edge leaves it free.
    const double depth = pattern.depth > 0.0 ? 10.0 : 0.0;
    const StepLine line = step_line(piece, pattern, row.step, 10.0, depth);
    const auto rotary = table->positions(zx_yac, pass.tilt, pass.turn);
    for (const int end : {0, 1}) {
      const double along = (end == 0 ? -0.5 : 0.5) * size.length;
      const auto q = kinematics::place_tip(zx_yac, line.tip + along * line.feed, 0.0, rotary);
      for (const int k : {0, 1, 2}) {
        const double found = q[static_cast<AxisLetter>(k)];
        const double wanted = n[static_cast<std::size_t>(9 + 3 * end + k)];
        worst = std::max(worst, std::abs(found - wanted));
        EXPECT_NEAR(found, wanted, 1e-6) << "XYZ"[k] << (end == 0 ? " from" : " to");
      }
    }
  }
  RecordProperty("worst_nm", std::to_string(worst * 1e6));
}

TEST(StepGeometry, TheNominalTableTurnsAsTheDefinitionSaysOnEveryTiltingTable) {
  for (const char* name : {"zx-yac", "iwf-bc", "dvf5000"}) {
    SCOPED_TRACE(name);
    const auto m = machine(name);
    const auto table = TiltingTable::of(m);
    ASSERT_TRUE(table);
    const Mat3 turned = rotation_z(table->orientation);
    for (const StepPattern& pattern : step_patterns()) {
      for (const StepPass& pass : pattern.passes) {
        const auto q = table->positions(m, pass.tilt, pass.turn);
        const Mat3 wanted =
            turned * rotation_z(pass.turn) * rotation_x(pass.tilt) * turned.transpose();
        EXPECT_LT((kinematics::nominal_pose(m, q, 0.0).rotation - wanted).norm(), 1e-12)
            << pattern.name;
      }
    }
    // The crossing stays where it is in the machine, whatever the table does.
    const auto at_zero = kinematics::place_tip(m, table->crossing, 100.0, {});
    auto tilted = table->positions(m, -0.7, 1.1);
    tilted = kinematics::place_tip(m, table->crossing, 100.0, tilted);
    for (const AxisLetter letter : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
      EXPECT_NEAR(tilted[letter], at_zero[letter], 1e-9);
    }
  }
}

TEST(StepGeometry, TheNearNetBlankStandsOffEveryFaceByTheAllowance) {
  for (const int number : {1, 2}) {
    const stock::LoftShape body = step_workpiece(number)->body;
    const stock::LoftShape blank = near_net_blank(body, 0.1);
    ASSERT_TRUE(stock::Blank::make(blank, Vec3::Zero()));
    const auto finished = stock::slabs_of(body);
    const auto raw = stock::slabs_of(blank);
    ASSERT_EQ(finished.size(), raw.size());
    for (std::size_t i = 0; i < raw.size(); ++i) {
      const auto& f = finished[i];
      const auto& r = raw[i];
      const double slope = 0.5 * (f.top.size_x - f.bottom.size_x) / (f.top.z - f.bottom.z);
      // Distance of the raw face's ends from the plane of the finished one.
      for (const auto& [section, base] : {std::pair{r.bottom, f.bottom}, {r.top, f.top}}) {
        const double across = 0.5 * (section.size_x - base.size_x) - slope * (section.z - base.z);
        EXPECT_NEAR(across / std::hypot(1.0, slope), 0.1, 1e-6) << number << " slab " << i;
      }
      EXPECT_NEAR(r.bottom.z - f.bottom.z, i == 0 ? 0.0 : 0.1, 1e-9);
    }
  }
}

}  // namespace
}  // namespace frustum::programs
