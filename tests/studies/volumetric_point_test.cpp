#include "studies/engine/volumetric_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "kinematics/errors/error_draw.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "studies/statistics/order_statistics.hpp"
#include "tests/document_section.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

using kinematics::AxisLetter;

// Errors of the linear axes (tool) or of the rotary ones (work).
FactorSet set_of(const kinematics::Machine& machine, const std::string& file, bool rotary,
                 bool centred) {
  std::vector<kinematics::ErrorEntry> entries;
  for (kinematics::ErrorEntry& entry : errors_of_file(file)) {
    const char axis = entry.name.back();
    if ((axis == 'B' || axis == 'C') != rotary) continue;
    if (centred) entry.terms[0].amount.drawn[0].distribution.mean = 0.0;
    entries.push_back(std::move(entry));
  }
  auto set = FactorSet::make(machine, entries);
  EXPECT_TRUE(set) << to_string(set.error().front());
  return *std::move(set);
}

TEST(VolumetricPointReference, LengthsHaveTheExactQuantilesOfTheIndependentComputation) {
  const kinematics::Machine machine = machine_named("dvf5000");
  constexpr double kTool = 150.0;
  kinematics::AxisPositions corner;
  corner[AxisLetter::Y] = -225.0;
  corner[AxisLetter::Z] = -480.0;
  const kinematics::AxisPositions home =
      kinematics::place_tip(machine, Vec3(0.0, 275.0, 450.0), kTool, {});
  const struct {
    const char* name;
    const char* file;
    bool rotary, centred;
  } rows[] = {{"tool corner/general", "jang-general-tolerances", false, false},
              {"tool corner/proposed", "jang-key-tolerances", false, false},
              {"tool corner/centred", "jang-key-tolerances", false, true},
              {"work home/general", "jang-general-tolerances", true, false},
              {"work home/proposed", "jang-key-tolerances", true, false}};
  std::string text = R"(## Volumetric errors of many machines (Jang, section 4.3, on `dvf5000`)

Length of the error of one point in um, exactly: all laws are normal, a tolerance is three standard deviations. *Tool*: errors of
the linear axes at a corner of the volume; *work*: those of the rotary axes. *Proposed*: the tolerances of the key errors, with
the means that the thesis gives them; *centred*: with means of 0. The thesis predicts one number, "about", for each.

| point, tolerances | median | 95 % | 99 % | published | machines below it | verdict |
| --- | --- | --- | --- | --- | --- | --- |
)";
  const std::map<std::string, double> published{{"tool corner/general", 41.0},
                                                {"tool corner/proposed", 24.0},
                                                {"work home/general", 15.0},
                                                {"work home/proposed", 10.0}};
  for (const auto& row : rows) {
    const FactorSet set = set_of(machine, row.file, row.rotary, row.centred);
    const VolumetricPoint point = volumetric_point(machine, set, row.rotary ? home : corner, kTool);
    const auto exact = exact_length(point, set);
    ASSERT_TRUE(exact);
    const auto printed = published.find(row.name);
    text += fmt::format("| {} | {:.2f} | {:.2f} | {:.2f} |", row.name, exact->quantile(0.5),
                        exact->quantile(0.95), exact->quantile(0.99));
    if (printed == published.end()) {
      text += fmt::format(" none | {:.1f} % below 24 | |\n", 100.0 * exact->probability(24.0));
    } else {
      text += fmt::format(" {:g} | {:.1f} % | no bound of all machines |\n", printed->second,
                          100.0 * exact->probability(printed->second));
    }
    const nlohmann::json& numbers = expected()["volumetric"][row.name];
    EXPECT_NEAR(exact->mean(), numbers["mean"].get<double>(), 1e-6) << row.name;
    EXPECT_NEAR(exact->rms(), numbers["rms"].get<double>(), 1e-6) << row.name;
    EXPECT_NEAR(exact->quantile(0.5), numbers["q50"].get<double>(), 1e-6) << row.name;
    EXPECT_NEAR(exact->quantile(0.95), numbers["q95"].get<double>(), 1e-6) << row.name;
    EXPECT_NEAR(exact->quantile(0.99), numbers["q99"].get<double>(), 1e-6) << row.name;
    for (const double r : {24.0, 41.0, 10.0, 15.0}) {
      const std::string key = "P(|E|<=" + std::to_string(static_cast<int>(r)) + ")";
      if (numbers.contains(key)) {
        EXPECT_NEAR(exact->probability(r), numbers[key].get<double>(), 1e-8) << row.name << r;
      }
    }
  }
  text += R"(
"Less than 24 um" holds for 56 % of the machines with the proposed tolerances and for 91 % of those with means of 0: it is a
typical value, not a limit. The other printed numbers are as far up in their distributions as the table says.
)";
  expect_section("reproduction.md", "volumetric errors", text);
}

TEST(VolumetricPoint, DrawnLengthsAreThoseOfTheExactChain) {
  const kinematics::Machine machine = machine_named("dvf5000");
  const auto entries = errors_of_file("jang-key-tolerances");
  const auto set = FactorSet::make(machine, entries);
  ASSERT_TRUE(set);
  kinematics::AxisPositions at;
  at[AxisLetter::Y] = 100.0;
  at[AxisLetter::Z] = -200.0;
  at[AxisLetter::B] = 0.4;
  const VolumetricPoint point = volumetric_point(machine, *set, at, 150.0);
  std::vector<double> values(set->variables().size()), weights(set->columns().size());
  const Pose nominal = kinematics::nominal_pose(machine, at, 150.0);
  for (std::uint32_t d = 0; d < 20; ++d) {
    const auto errors = kinematics::resolve(machine, kinematics::draw(entries, 1, d));
    ASSERT_TRUE(errors);
    const Pose actual = kinematics::actual_pose(machine, *errors, {at}, 150.0);
    set->draw(1, d, values);
    set->weights(values, weights);
    EXPECT_NEAR(point.length(weights), 1e3 * (actual.translation - nominal.translation).norm(),
                0.01);
  }
}

TEST(VolumetricPoint, UniformAndCutLawsHaveNoExactLength) {
  const kinematics::Machine machine = machine_named("dvf5000");
  for (const char* law : {"dxX=uniform -1um..1um", "dxX=normal 0um sd 1um limit 2um",
                          "dxX=harmonic 1 normal 0um sd 1um phase normal 0deg sd 9deg"}) {
    const auto entry = kinematics::parse_error(law);
    ASSERT_TRUE(entry);
    const auto set = FactorSet::make(machine, {&*entry, 1});
    ASSERT_TRUE(set) << law;
    EXPECT_FALSE(exact_length(volumetric_point(machine, *set, {}, 150.0), *set)) << law;
  }
}

}  // namespace
}  // namespace frustum::studies
