// Which of the shipped machines, and of machines made from them, have a tilting rotary table.
#include "programs/step/tilting_table.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <string>

namespace frustum::programs {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Machine;

const std::filesystem::path kMachines = std::filesystem::path(FRUSTUM_SOURCE_DIR) / "machines";

Machine tilting_machine(const std::filesystem::path& file) {
  auto loaded = Machine::load(file);
  EXPECT_TRUE(loaded) << (loaded ? "" : to_string(loaded.error().front()));
  return *loaded;
}

// zx-yac with other words in its file, without its aliases.
Machine changed(const std::map<std::string, std::string>& words) {
  std::ifstream in(kMachines / "zx-yac.toml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  text.resize(text.find("[alias]"));
  for (const auto& [from, to] : words) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
  }
  auto machine = Machine::read(text, kMachines / "changed.toml");
  EXPECT_TRUE(machine) << (machine ? "" : to_string(machine.error().front()));
  return *std::move(machine);
}

std::string refusal(const Machine& of) {
  const auto table = TiltingTable::of(of);
  EXPECT_FALSE(table);
  return table ? "" : to_string(table.error().front());
}

TEST(TiltingTable, IsFoundOnEveryShippedMachineThatHasOneAndRefusedOnTheOthers) {
  struct Expected {
    AxisLetter tilt = AxisLetter::A;
    double sense = 1.0;  // of both joints
    double orientation = 0.0;
    Vec3 crossing = Vec3::Zero();
    const char* refusal = nullptr;
  };
  // dvf5000 and ac-probe give their rotary axes the directions of the sources, against ISO 841.
  const std::map<std::string, Expected> expected{
      {"zx-yac", {AxisLetter::A, 1.0}},
      {"ac-probe", {AxisLetter::A, -1.0}},
      {"iwf-bc", {AxisLetter::B, 1.0, 0.5 * std::numbers::pi}},
      {"dvf5000", {AxisLetter::B, -1.0, 0.5 * std::numbers::pi, {0.0, 0.0, 50.0}}},
      {"swivel-head-table", {.refusal = "B turns the tool, not the workpiece"}},
      {"double-pivot-head", {.refusal = "turns the tool, not the workpiece"}},
      {"three-axis", {.refusal = "0 rotary axes on the workpiece side, not two"}}};
  std::size_t shipped = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kMachines)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string name = entry.path().stem().string();
    SCOPED_TRACE(name);
    ++shipped;
    ASSERT_TRUE(expected.contains(name)) << "a new machine: say here what its table is";
    const Expected& wanted = expected.at(name);
    const Machine m = tilting_machine(entry.path());
    if (wanted.refusal != nullptr) {
      const std::string text = refusal(m);
      EXPECT_NE(text.find(name), std::string::npos) << text;
      EXPECT_NE(text.find(wanted.refusal), std::string::npos) << text;
      EXPECT_NE(text.find("they need a table that tilts about X or Y"), std::string::npos) << text;
      continue;
    }
    const auto table = TiltingTable::of(m);
    ASSERT_TRUE(table) << to_string(table.error().front());
    EXPECT_EQ(table->tilt, wanted.tilt);
    EXPECT_EQ(table->turn, AxisLetter::C);
    EXPECT_EQ(table->tilt_sense, wanted.sense);
    EXPECT_EQ(table->turn_sense, wanted.sense);
    EXPECT_EQ(table->orientation, wanted.orientation);
    EXPECT_LT((table->crossing - wanted.crossing).norm(), 1e-12) << table->crossing.transpose();
  }
  EXPECT_EQ(shipped, expected.size());
}

TEST(TiltingTable, NamesTheAxisThatDoesNotFit) {
  const struct {
    std::map<std::string, std::string> words;
    const char* reason;
  } cases[] = {
      {{{"Y-A-C-w", "Y-C-A-w"}}, "C, the outer rotary axis, is parallel to neither X nor Y"},
      {{{"Y-A-C-w", "Y-A-B-w"}, {"[axis.C]", "[axis.B]"}},
       "B, the inner rotary axis, is not vertical"},
      {{{"b-Y-A-C-w", "b-A-Y-C-w"}}, "the table carries a linear axis"},
      {{{"[axis.Y]", "[axis.Y]\ndirection = [0, 0.8, 0.6]"}},
       "its linear axes are not parallel to X, Y and Z"},
      {{{"Y-A-C-w", "Y-C-w"},
        {"[axis.A]\ntravel = [-120, 120]   # deg\nvelocity     = 180   # deg/s\n"
         "acceleration = 900   # deg/s^2\njerk         = 9000   # deg/s^3\n"
         "servo_gain   = 40\n",
         ""}},
       "1 rotary axes on the workpiece side, not two"}};
  for (const auto& c : cases) {
    const std::string text = refusal(changed(c.words));
    EXPECT_NE(text.find(c.reason), std::string::npos) << "'" << c.reason << "' in: " << text;
  }
}

TEST(TiltingTable, CrossesOnTheTurnAxisAtTheHeightOfTheTilt) {
  const auto table = TiltingTable::of(changed({{"endless = true",
                                                "offset = [3, 20, -50]\n"
                                                "endless = true"}}));
  ASSERT_TRUE(table);
  EXPECT_LT((table->crossing - Vec3(0.0, 0.0, 50.0)).norm(), 1e-12) << table->crossing.transpose();
}

TEST(TiltingTable, TurnsByWholeTurnsIntoItsTravelIfItCan) {
  const Machine limited = changed({{"endless = true", "travel = [-200, 200]"}});
  const auto table = TiltingTable::of(limited);
  ASSERT_TRUE(table);
  const double quarter = 0.5 * std::numbers::pi;
  const auto c_of = [&](const Machine& m, double c) {
    return table->positions(m, 0.0, c)[AxisLetter::C];
  };
  EXPECT_NEAR(c_of(limited, -3.0 * quarter), quarter, 1e-12);  // not -270 deg
  EXPECT_NEAR(c_of(limited, 3.0 * quarter), -quarter, 1e-12);
  EXPECT_NEAR(c_of(limited, 2.0 * quarter), 2.0 * quarter, 1e-12);  // within: stays
  EXPECT_NEAR(c_of(tilting_machine(kMachines / "zx-yac.toml"), -3.0 * quarter), -3.0 * quarter,
              1e-12);
  // Nowhere within travel: stays, and is what shortfalls() tells.
  const Machine narrow = changed({{"endless = true", "travel = [-10, 10]"}});
  const AxisPositions q = table->positions(narrow, 0.0, -quarter);
  EXPECT_NEAR(q[AxisLetter::C], -quarter, 1e-12);
  const auto found = shortfalls(narrow, q);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].axis, AxisLetter::C);
  EXPECT_NEAR(found[0].missing, 80.0 * kRadPerDeg, 1e-12);
  EXPECT_EQ(found[0].text, "C = -90 deg, travel -10 .. 10 deg: 80 deg short");
}

TEST(TiltingTable, EveryAxisOutOfTravelIsToldButNoLimitReachedWithRounding) {
  const Machine m = tilting_machine(kMachines / "zx-yac.toml");
  AxisPositions q;
  q[AxisLetter::X] = 400.0 + 4e-10;
  q[AxisLetter::C] = 1000.0;  // endless
  EXPECT_TRUE(shortfalls(m, q).empty());
  q[AxisLetter::X] = 412.5;
  q[AxisLetter::Z] = -301.0;
  std::string texts;
  for (const Shortfall& s : shortfalls(m, q)) texts += s.text + "; ";
  EXPECT_NE(texts.find("X = 412.5 mm, travel -400 .. 400 mm: 12.5 mm short"), std::string::npos)
      << texts;
  EXPECT_NE(texts.find("Z = -301 mm, travel -300 .. 600 mm: 1 mm short"), std::string::npos)
      << texts;
  EXPECT_EQ(shortfalls(m, q).size(), 2U);
}

}  // namespace
}  // namespace frustum::programs
