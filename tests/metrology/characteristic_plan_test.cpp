#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "metrology/plan/inspection_plan.hpp"
#include "test_part.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;

PlannedCharacteristic of(K kind, std::vector<std::string> features) {
  PlannedCharacteristic c;
  c.name = "new";
  c.kind = kind;
  c.features = std::move(features);
  c.tolerance = 0.01;
  return c;
}

// Key and message of the first fault of the small cone part with one more characteristic.
std::string fault(const PlannedCharacteristic& c) {
  InspectionPlan plan = test_part::plan();
  plan.characteristics = {c};
  const Diagnostics found = check(plan);
  return found.empty() ? "" : found.front().key + ": " + found.front().message;
}
std::string datum_fault(const DatumSystem& datum) {
  InspectionPlan plan = test_part::plan();
  plan.datum = datum;
  const Diagnostics found = check(plan);
  return found.empty() ? "" : found.front().key + ": " + found.front().message;
}

TEST(CharacteristicPlan, ReadsBackEveryKey) {
  InspectionPlan plan = test_part::plan();
  PlannedCharacteristic round = of(K::roundness, {"C"});
  round.criterion = Criterion::minimum_zone;
  round.parameter = FormParameter::p;
  round.filter = ProfileFilter{50.0, 2.5, 0.0, 0.0};
  round.harmonics = 15;
  PlannedCharacteristic marked = of(K::equivalent_cone_form, {"cone"});
  marked.name = "marked";
  marked.seam = Seam{0.3 * kRadPerDeg, 5.0 * kRadPerDeg};
  PlannedCharacteristic straight = of(K::straightness, {"C"});
  straight.name = "straight";
  straight.filter = ProfileFilter{0.0, 0.0, 0.1 + 0.2, 8.0};
  PlannedCharacteristic run_out = of(K::circular_run_out, {"cone", "C"});
  run_out.name = "run-out";
  run_out.datum_criterion = Criterion::outside_material;
  PlannedCharacteristic profile = of(K::surface_profile, {"cone", "C", "A"});
  profile.name = "profile";
  profile.floating = true;
  plan.characteristics.insert(plan.characteristics.end(),
                              {round, marked, straight, run_out, profile});
  for (const DatumSystem& datum :
       {*plan.datum, DatumSystem{"A", "", "", Criterion::outside_material},
        DatumSystem{"", "", "", Criterion::least_squares, {"A", "C"}, {"RZ", "TX"}},
        DatumSystem{"A", "C", "", Criterion::least_squares, {}, {}, true}}) {
    plan.datum = datum;
    const std::string text = to_toml(plan);
    const auto read = parse_plan(text);
    ASSERT_TRUE(read) << to_string(read.error().front()) << '\n' << text;
    EXPECT_EQ(*read, plan) << text;
    EXPECT_EQ(to_toml(*read), text);
  }
}

TEST(CharacteristicPlan, FitsAllFeaturesAtOnce) {
  std::string text = to_toml(test_part::plan());
  const std::size_t from = text.find("primary");
  text.replace(from, text.find("[[feature]]") - from, "best_fit = \"all\"\n");
  const auto plan = parse_plan(text);
  ASSERT_TRUE(plan) << to_string(plan.error().front());
  EXPECT_EQ(plan->datum->best_fit, (std::vector<std::string>{"A", "C", "groove", "cone"}));
}

TEST(CharacteristicPlan, TellsWhatACharacteristicDoesNotTake) {
  const std::string at = "characteristic[1].";
  EXPECT_EQ(
      fault(of(K::parallelism, {"A", "C", "cone"})),
      at + "features: a parallelism takes one feature, or two: toleranced, datum, named are 3");
  EXPECT_EQ(fault(of(K::parallelism, {"A", "C"})),
            at + "features: 'A' and 'C' must be planned parallel, they are 90 deg apart");
  EXPECT_EQ(fault(of(K::circular_run_out, {"C"})),
            at + "features: a circular_run_out takes two features or more: toleranced, datum, ..., "
                 "named are 1");
  EXPECT_EQ(
      fault(of(K::circular_run_out, {"C", "A"})),
      at + "features: the datum of a circular_run_out needs a cylinder or cone, 'A' is a plane");
  EXPECT_EQ(fault(of(K::circular_run_out, {"groove", "C"})),
            at + "features: the circular_run_out of 'groove' needs rings, its strategy has none");
  EXPECT_EQ(fault(of(K::total_run_out, {"C", "C"})), at + "features: 'C' is named twice");
  EXPECT_EQ(fault(of(K::symmetry, {"A", "C", "groove"})),
            at + "features: a pair of faces is two planes");

  PlannedCharacteristic c = of(K::flatness, {"A"});
  c.criterion = Criterion::maximum_inscribed;
  EXPECT_EQ(fault(c), at + "criterion: a flatness is not evaluated by \"mi\"");
  c = of(K::position, {"A"});
  c.criterion = Criterion::maximum_inscribed;
  EXPECT_EQ(fault(c), at + "criterion: a plane has no inscribed or circumscribed element");
  c = of(K::parallelism, {"cone"});
  c.datum_criterion = Criterion::outside_material;
  EXPECT_EQ(fault(c), at + "datum_criterion: this parallelism names no datum");
  c = of(K::diameter, {"C"});
  c.parameter = FormParameter::p;
  EXPECT_EQ(fault(c), at + "parameter: a diameter has no parameters t, p, v, q");
  c = of(K::flatness, {"A"});
  c.harmonics = 3;
  EXPECT_EQ(fault(c), at + "harmonics: a flatness has no undulations per revolution");
  c = of(K::position, {"C"});
  c.floating = true;
  EXPECT_EQ(fault(c), at + "floating: not for a position");
  c = of(K::position, {"C"});
  c.frame = "R";
  EXPECT_EQ(fault(c), at + "frame: the plan has no frame 'R'");
  c = of(K::roundness, {"C"});
  c.frame = "R";
  EXPECT_EQ(fault(c), at + "frame: not for a roundness");
}

TEST(CharacteristicPlan, TellsWhichSectionsAConcentricityCompares) {
  const auto with = [](std::vector<std::string> features, std::vector<std::size_t> sections) {
    PlannedCharacteristic c = of(K::concentricity, std::move(features));
    c.sections = std::move(sections);
    return fault(c);
  };
  const std::string at = "characteristic[1].";
  EXPECT_EQ(with({"cone"}, {}), "");
  EXPECT_EQ(with({"cone"}, {0, 2}), "");
  EXPECT_EQ(with({"cone", "C"}, {}), "");
  EXPECT_EQ(with({"cone", "C"}, {1}), "");
  EXPECT_EQ(with({"cone"}, {1}), at + "section: a concentricity within one feature compares two of "
                                      "its sections, named is [1]");
  EXPECT_EQ(with({"cone"}, {0, 1, 2}),
            at + "sections: a concentricity within one feature compares two of its sections, named "
                 "are [0, 1, 2]");
  EXPECT_EQ(with({"cone"}, {1, 1}),
            at + "sections: a concentricity compares two sections, section 1 is named twice");
  EXPECT_EQ(with({"cone"}, {0, 3}), at + "sections: 'cone' has 3 sections, there is no section 3");
  EXPECT_EQ(with({"cone", "C"}, {3}), at + "section: 'cone' has 3 sections, there is no section 3");
  EXPECT_EQ(with({"C", "C"}, {}), at + "features: 'C' is named twice");
  InspectionPlan plan = test_part::plan();
  plan.features[3].strategy = SpiralStrategy{-11.0, -3.0};
  plan.characteristics = {of(K::concentricity, {"cone"})};
  ASSERT_EQ(check(plan).size(), 1U);
  EXPECT_EQ(check(plan).front().message,
            "a concentricity within one feature compares two of its sections, 'cone' has 1");
}

// The small cone part with one of its features shifted and turned about Y.
std::string fault_of(const PlannedCharacteristic& c, const std::string& name, const Vec3& shift,
                     double angle = 0.0) {
  InspectionPlan plan = test_part::plan();
  plan.datum.reset();
  for (PlannedFeature& f : plan.features) {
    if (f.name != name) continue;
    f.point += shift;
    f.axis = rotation_y(angle) * f.axis;
    if (auto* grid = std::get_if<GridStrategy>(&f.strategy)) {
      grid->u = rotation_y(angle) * grid->u;
      grid->v = rotation_y(angle) * grid->v;
    }
    f.extent = {};
  }
  // A second wall of the groove, and a sphere over the cone.
  PlannedFeature wall = test_part::plan().features[2];
  wall.name = "wall";
  wall.point = {50.0, 0.0, -4.0};
  wall.axis = -Vec3::UnitX();
  PlannedFeature ball;
  ball.name = "ball";
  ball.kind = FeatureKind::sphere;
  ball.point = {0.0, 0.0, 60.0};
  ball.radius = 5.0;
  ball.strategy = SphereStrategy{};
  plan.features.insert(plan.features.end(), {wall, ball});
  plan.characteristics = {c};
  const Diagnostics found = check(plan);
  return found.empty() ? "" : found.front().key + ": " + found.front().message;
}

TEST(CharacteristicPlan, TellsWhatNoPartCouldHold) {
  const std::string at = "characteristic[1].features: ";
  const double deg = kRadPerDeg;
  const Vec3 none = Vec3::Zero();
  const auto square = of(K::perpendicularity, {"groove", "A"});
  EXPECT_EQ(fault_of(square, "groove", none), "");
  EXPECT_EQ(fault_of(square, "groove", none, 5e-4), "");
  EXPECT_EQ(fault_of(square, "groove", none, 10.0 * deg),
            at + "'groove' and 'A' must be planned perpendicular, they are 80 deg apart");
  EXPECT_EQ(fault_of(of(K::perpendicularity, {"C", "A"}), "C", none, 10.0 * deg),
            at + "'C' and 'A' must be planned perpendicular, they are 80 deg apart");
  EXPECT_EQ(fault_of(of(K::perpendicularity, {"wall", "groove"}), "", none),
            at + "'wall' and 'groove' must be planned perpendicular, they are 0 deg apart");
  EXPECT_EQ(fault_of(of(K::perpendicularity, {"C", "cone"}), "", none),
            at + "'C' and 'cone' must be planned perpendicular, they are 0 deg apart");
  EXPECT_EQ(fault_of(of(K::angularity, {"C", "cone"}), "cone", none, 10.0 * deg), "");

  for (const K kind : {K::coaxiality, K::concentricity, K::circular_run_out, K::total_run_out}) {
    const auto on_axis = of(kind, {"cone", "C"});
    EXPECT_EQ(fault_of(on_axis, "cone", {0.005, 0, 3}), "");
    EXPECT_EQ(fault_of(on_axis, "cone", {20, 0, 3}),
              at + "'cone' must be planned on the axis of 'C', it is 20 mm off");
    EXPECT_EQ(fault_of(on_axis, "cone", none, 5.0 * deg),
              at + "'cone' must be planned on the axis of 'C', it is 5 deg off");
  }
  EXPECT_EQ(fault_of(of(K::total_run_out, {"A", "C"}), "A", {9, 9, 0}), "");
  EXPECT_EQ(fault_of(of(K::total_run_out, {"A", "C"}), "A", none, 5.0 * deg),
            at + "'A' must be planned perpendicular to the axis of 'C', it is 5 deg off");
  EXPECT_EQ(fault_of(of(K::coaxiality, {"ball", "C"}), "", none), "");
  EXPECT_EQ(fault_of(of(K::coaxiality, {"ball", "C", "cone"}), "cone", {0, 0.5, 0}),
            at + "'cone' must be planned on the axis of 'C', it is 0.5 mm off");
  EXPECT_EQ(fault_of(of(K::coaxiality, {"ball", "C"}), "C", {0, 3, 0}),
            at + "'ball' must be planned on the axis of 'C', it is 3 mm off");

  // The groove lies 45 mm beside the axis.
  EXPECT_EQ(fault_of(of(K::symmetry, {"groove", "wall", "C"}), "C", {45, 7, 0}), "");
  EXPECT_EQ(fault_of(of(K::symmetry, {"C", "groove", "wall"}), "C", {45, 7, 0}), "");
  EXPECT_EQ(fault_of(of(K::symmetry, {"groove", "wall", "C"}), "C", {25, 0, 0}),
            at + "'groove' and 'wall' must be planned symmetric about 'C', they are 20 mm off");
  EXPECT_EQ(fault_of(of(K::symmetry, {"C", "groove", "wall"}), "C", {25, 0, 0}),
            at + "'C' must be planned symmetric about 'groove' and 'wall', they are 20 mm off");
  EXPECT_EQ(fault_of(of(K::symmetry, {"groove", "wall", "C"}), "C", {45, 0, 0}, 5.0 * deg),
            at + "'groove' and 'wall' must be planned symmetric about 'C', they are 5 deg off");
  EXPECT_EQ(fault_of(of(K::symmetry, {"groove", "A"}), "", none),
            at + "'groove' must be planned symmetric about 'A', they are 90 deg off");
  EXPECT_EQ(fault_of(of(K::symmetry, {"groove", "wall"}), "", none),
            at + "'groove' must be planned symmetric about 'wall', they are 10 mm off");
  EXPECT_EQ(fault_of(of(K::symmetry, {"cone", "C"}), "", none), "");
  EXPECT_EQ(fault_of(of(K::symmetry, {"cone", "C"}), "cone", {0, 2, 0}),
            at + "'cone' must be planned symmetric about 'C', they are 2 mm off");
}

TEST(CharacteristicPlan, TellsWhichFiltersMakeSense) {
  const auto filtered = [](K kind, const ProfileFilter& filter) {
    PlannedCharacteristic c = of(kind, {"C"});
    c.filter = filter;
    return fault(c);
  };
  const std::string at = "characteristic[1].filter: ";
  EXPECT_EQ(filtered(K::roundness, {15.0, 2.0, 0.0, 0.0}), "");
  EXPECT_EQ(filtered(K::straightness, {0.0, 0.0, 0.8, 0.0}), "");
  EXPECT_EQ(filtered(K::roundness, {0.0, 0.0, 0.8, 0.0}),
            at + "a roundness is filtered by upr or upr_from, or both");
  EXPECT_EQ(filtered(K::straightness, {15.0, 0.0, 0.0, 0.0}),
            at + "a straightness is filtered by cutoff or cutoff_long, or both");
  EXPECT_EQ(filtered(K::roundness, {}), at + "a roundness is filtered by upr or upr_from, or both");
  EXPECT_EQ(filtered(K::roundness, {15.0, 50.0, 0.0, 0.0}),
            at + "upr_from = 50 must be less than upr = 15");
  EXPECT_EQ(filtered(K::roundness, {15.0, 0.01, 0.0, 0.0}),
            at + "a closed profile has at least 1 undulation per revolution");
  EXPECT_EQ(filtered(K::straightness, {0.0, 0.0, 8.0, 0.8}),
            at + "cutoff = 8 mm must be less than cutoff_long = 0.8 mm");
  EXPECT_EQ(filtered(K::cylindricity, {15.0, 0.0, 0.0, 0.0}),
            at + "a cylindricity is not filtered");
}

TEST(CharacteristicPlan, TellsWhichDatumSystemsMakeSense) {
  EXPECT_EQ(datum_fault({"C", "A", "groove"}), "");
  EXPECT_EQ(datum_fault({"A", "", ""}), "");
  EXPECT_EQ(datum_fault({"A", "", "C"}), "datum.secondary: a tertiary datum needs a secondary one");
  EXPECT_EQ(datum_fault({"A", "A", ""}), "datum.secondary: 'A' is named twice");
  EXPECT_EQ(datum_fault({"C", "cone", "groove"}), "");  // the cone stops along the axis
  EXPECT_EQ(datum_fault({"cone", "C", ""}),
            "datum.secondary: 'C' takes no degree of freedom that the datums before it left");
  EXPECT_EQ(datum_fault({"A", "C", "", Criterion::minimum_zone}),
            "datum.criterion: a datum is associated by \"ls\", \"om\" or \"base\"");
  DatumSystem fit;
  fit.best_fit = {"A", "B"};
  EXPECT_EQ(datum_fault(fit), "datum.best_fit: the plan has no feature 'B'");
  fit.best_fit = {"A"};
  fit.locked = {"RW"};
  EXPECT_EQ(datum_fault(fit), "datum.locked: 'RW' is not a degree of freedom");
  fit.locked = {};
  fit.primary = "A";
  EXPECT_EQ(datum_fault(fit), "datum.best_fit: excludes primary, secondary and tertiary");
  EXPECT_EQ(datum_fault({"A", "C", "", Criterion::least_squares, {}, {"RZ"}}),
            "datum.locked: only a best_fit has locked degrees");
}

TEST(CharacteristicPlan, Fault2_60_AConeIsNoDatumOutsideTheMaterial) {
  EXPECT_EQ(datum_fault({"C", "cone", "groove", Criterion::outside_material}),
            "datum.secondary: 'cone' is a cone, which has no association \"om\"");
  PlannedCharacteristic c = of(K::perpendicularity, {"A", "cone"});
  c.datum_criterion = Criterion::outside_material;
  EXPECT_EQ(fault(c),
            "characteristic[1].datum_criterion: the datum 'cone' is a cone, which has no "
            "association \"om\"");
  c.datum_criterion = Criterion::least_squares;
  EXPECT_EQ(fault(c), "");
  c = of(K::perpendicularity, {"cone", "A"});
  c.datum_criterion = Criterion::outside_material;
  EXPECT_EQ(fault(c), "");
}

TEST(CharacteristicPlan, Fault2_40_ThePlanHasAFilterForAllForms) {
  InspectionPlan unfiltered = test_part::plan();
  unfiltered.characteristics = {of(K::roundness, {"C"}), of(K::straightness, {"C"}),
                                of(K::cylindricity, {"C"}), of(K::roundness, {"C"})};
  const char* name = "abcd";
  for (PlannedCharacteristic& c : unfiltered.characteristics) c.name = std::string(1, *name++);
  unfiltered.characteristics.back().filter = ProfileFilter{.upr = 15.0};
  const std::string text = to_toml(unfiltered);
  const auto plan = parse_plan("filter = { upr = 50, cutoff = \"0.8 mm\" }\n" + text);
  ASSERT_TRUE(plan) << to_string(plan.error().front());
  EXPECT_EQ(plan->characteristics[0].filter, (ProfileFilter{.upr = 50.0}));
  EXPECT_EQ(plan->characteristics[1].filter, (ProfileFilter{.cutoff = 0.8}));
  EXPECT_FALSE(plan->characteristics[2].filter);
  EXPECT_EQ(plan->characteristics[3].filter, (ProfileFilter{.upr = 15.0}));
  const auto empty = parse_plan("filter = {}\n" + text, "p.toml");
  ASSERT_FALSE(empty);
  EXPECT_EQ(to_string(empty.error().front()).substr(0, 50),
            "p.toml:1:1: error: filter: has neither upr nor cut");
}

TEST(CharacteristicPlan, Fault2_29_ASeamIsThatOfARoundProfile) {
  PlannedCharacteristic c = of(K::cylindricity, {"C"});
  c.seam = Seam{0.0, 0.1};
  EXPECT_EQ(fault(c), "characteristic[1].seam: not for a cylindricity");
  c = of(K::roundness, {"C"});
  c.seam = Seam{0.0, 1.0};
  EXPECT_EQ(fault(c),
            "characteristic[1].seam: within must be more than 0 and at most 45 deg to either side");
  c.seam->within = 0.1;
  EXPECT_EQ(fault(c), "");
  c.filter = ProfileFilter{.upr = 50.0};
  EXPECT_EQ(fault(c),
            "characteristic[1].seam: a profile with a gap has no filter and no harmonics");
}

TEST(CharacteristicPlan, Fault2_52_ACommonAxisIsNotOutsideTheMaterial) {
  InspectionPlan plan = test_part::plan();
  PlannedFeature other = *find_feature(plan, "C");
  other.name = "C2";
  plan.features.push_back(other);
  PlannedCharacteristic c = of(K::circular_run_out, {"cone", "C", "C2"});
  plan.characteristics = {c};
  EXPECT_TRUE(check(plan).empty());
  plan.characteristics.front().datum_criterion = Criterion::outside_material;
  ASSERT_FALSE(check(plan).empty());
  EXPECT_EQ(check(plan).front().message,
            "the common axis of 2 datums is of least squares, it has no \"om\"");
  EXPECT_EQ(check(plan).front().key, "characteristic[1].datum_criterion");
}

TEST(CharacteristicPlan, Fault2_31_DirectionsAndPlacesBeyondSenseAreRefused) {
  const auto complaint = [](const std::string& key, const Vec3& value) {
    InspectionPlan plan = test_part::plan();
    PlannedFeature& feature = plan.features[1];
    if (key == "axis") feature.axis = value;
    if (key == "zero") feature.zero = value;
    if (key == "point") feature.point = value;
    const Diagnostics found = check(plan);
    return found.empty() ? "" : found.front().key + ": " + found.front().message;
  };
  for (const double far : {1e300, 1e200, 1e-200}) {
    for (const char* key : {"axis", "zero"}) {
      EXPECT_EQ(complaint(key, Vec3(far, far, 0)),
                std::string("feature[2].") + key +
                    ": must be a direction, of a length between 1e-100 and 1e100");
    }
  }
  EXPECT_EQ(complaint("point", Vec3(0, 1e300, 0)),
            "feature[2].point: must be three numbers of at most 1e+09 mm");
  EXPECT_EQ(complaint("zero", Vec3(0, 5e3, 0)), "");
}

TEST(CharacteristicPlan, TellsTheLineOfWhatNoPartCouldHold) {
  const std::string text = to_toml(test_part::plan());
  const auto plan = parse_plan(text +
                                   "[[characteristic]]\nname = \"n\"\nkind = \"perpendicularity\"\n"
                                   "features = [\"C\", \"cone\"]\ntolerance = \"1 um\"\n",
                               "p.toml");
  ASSERT_FALSE(plan);
  const auto line = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 4;
  EXPECT_TRUE(to_string(plan.error().front()).starts_with(fmt::format("p.toml:{}:", line)))
      << to_string(plan.error().front());
}

TEST(CharacteristicPlan, TellsWhereInTheFile) {
  const auto complaint = [](const std::string& last) {
    const auto plan = parse_plan(to_toml(test_part::plan()) + last, "p.toml");
    return plan ? "" : to_string(plan.error().front());
  };
  const std::string head =
      "[[characteristic]]\nname = \"n\"\nkind = \"roundness\"\n"
      "feature = \"C\"\ntolerance = \"1 um\"\n";
  EXPECT_EQ(complaint(head + "filter = { upr = 50 }\ncriterion = \"mz\"\n"), "");
  EXPECT_NE(complaint(head + "filter = { urp = 50 }\n").find("filter.urp: unknown key"),
            std::string::npos);
  EXPECT_NE(complaint(head + "criterion = \"mx\"\n").find("criterion: 'mx' is not one"),
            std::string::npos);
  EXPECT_NE(complaint(head + "filter = { cutoff = \"8 deg\" }\n").find("filter.cutoff"),
            std::string::npos);
  EXPECT_NE(complaint(head + "parameter = \"z\"\n").find("parameter: 'z' is not one"),
            std::string::npos);
}

}  // namespace
}  // namespace frustum::metrology
