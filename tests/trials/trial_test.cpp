#include "trials/trial.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "core/random.hpp"
#include "tests/trials/cone_trial.hpp"

namespace frustum::trials {
namespace {

using programs::ConeFrustum;
using programs::ProgramForm;

double draw(std::uint64_t index, double size) {
  return size * (2.0 * uniform({.seed = 5}, index) - 1.0);
}

class EveryFamily : public testing::TestWithParam<const char*> {};

TEST_P(EveryFamily, CutsAConeWithoutFormErrorInAllThreeProgramForms) {
  std::vector<double> forms, cylinders;
  for (const ProgramForm form : {ProgramForm::vector, ProgramForm::angles, ProgramForm::axes}) {
    ConeFrustum cone;
    cone.form = form;
    const Trial trial = ConeTrial::on(GetParam(), cone).run({}, true);
    EXPECT_LT(ConeTrial::value(trial, "cone.equivalent_form"), 0.02);
    EXPECT_LT(ConeTrial::value(trial, "cone.form"), 0.02);
    EXPECT_LT(ConeTrial::value(trial, "cylinder.cylindricity"), 0.02);
    EXPECT_LT(ConeTrial::value(trial, "cone.concentricity"), 0.02);
    EXPECT_TRUE(trial.collisions.empty());
    // The same part: every probed point of the cone agrees.
    for (const auto& feature : trial.measurement.features) {
      if (feature.name == "cone") forms.push_back(feature.points[100].point.norm());
      if (feature.name == "cylinder") cylinders.push_back(feature.points[100].point.norm());
    }
  }
  ASSERT_EQ(forms.size(), 3U);
  for (int k = 1; k < 3; ++k) {
    EXPECT_NEAR(forms[k], forms[0], 2e-5);
    EXPECT_NEAR(cylinders[k], cylinders[0], 2e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, EveryFamily,
                         testing::Values("iwf-bc", "double-pivot-head", "swivel-head-table"));

TEST(Trial, SeesNoFormErrorFromARigidDisplacementOfThePart) {
  for (std::uint64_t k = 0; k < 3; ++k) {
    ConeTrial cone = ConeTrial::on("iwf-bc");
    // The blank lies askew on the table; the program does not know.
    cone.piece.placement.origin +=
        Vec3(draw(6 * k, 0.05), draw(6 * k + 1, 0.05), draw(6 * k + 2, 0.05));
    cone.piece.placement.tilt +=
        Vec3(draw(6 * k + 3, 5e-4), draw(6 * k + 4, 5e-4), draw(6 * k + 5, 5e-4));
    const Trial trial = cone.run();
    EXPECT_LT(ConeTrial::value(trial, "cone.equivalent_form"), 0.02);
    EXPECT_LT(ConeTrial::value(trial, "cone.form"), 0.02);
  }
}

TEST(Trial, SeesNoFormErrorAlongOrAboutTheToolAxis) {
  const ConeTrial cone = ConeTrial::on("iwf-bc");
  for (const char* error : {"EZ0Z=10um", "EC0B=30urad"}) {
    EXPECT_LT(ConeTrial::value(cone.run({error}), "cone.equivalent_form"), 0.02) << error;
  }
  // A longer tool moves along its axis: cone form none.
  ConeTrial longer = cone;
  longer.piece.tools[1].length_error = 10.0_um;
  EXPECT_LT(ConeTrial::value(longer.run(), "cone.equivalent_form"), 0.02);
  // A larger cutter cuts a smaller cone of the same form.
  ConeTrial larger = cone;
  larger.piece.tools[1].radius_error = 10.0_um;
  EXPECT_LT(ConeTrial::value(larger.run(), "cone.equivalent_form"), 0.02);
}

TEST(Trial, PassesThePoleWhenBothAnglesAreEqual) {
  ConeFrustum cone;
  cone.cone_angle = 30.0_deg;
  cone.inclination = 30.0_deg;
  const Trial trial = ConeTrial::on("iwf-bc", cone).run();
  EXPECT_LT(ConeTrial::value(trial, "cone.equivalent_form"), 0.02);
  for (const OperationTrace& op : trial.operations) {
    if (op.name != "cone finishing") continue;
    // Table 3.1: B from -2 alpha to +2 alpha, C turns 180 deg.
    EXPECT_NEAR(op.ranges.at(kinematics::AxisLetter::B).width() * kDegPerRad, 120.0, 1e-6);
    EXPECT_NEAR(op.ranges.at(kinematics::AxisLetter::C).width() * kDegPerRad, 180.0, 0.06);
  }
}

TEST(Trial, GivesTheSameBitsTwice) {
  const ConeTrial cone = ConeTrial::on("iwf-bc");
  const Trial a = cone.run({"EX0C=10um"}), b = cone.run({"EX0C=10um"});
  ASSERT_EQ(a.measurement.characteristics.size(), b.measurement.characteristics.size());
  for (std::size_t i = 0; i < a.measurement.characteristics.size(); ++i) {
    EXPECT_EQ(a.measurement.characteristics[i].value, b.measurement.characteristics[i].value);
  }
}

kinematics::Machine three_axes() {
  return *kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/three-axis.toml");
}

std::string three_axes_text() {
  std::ifstream file(std::string(FRUSTUM_SOURCE_DIR) + "/machines/three-axis.toml");
  return {std::istreambuf_iterator<char>(file), {}};
}

// A plate on the three-axis machine and a program of a few lines.
programs::TestPiece plate_piece(const std::string& nc) {
  programs::TestPiece piece;
  piece.program = nc;
  piece.program_file = "plate.nc";
  piece.work_offsets = {{1, Vec3::Zero()}};
  piece.tools[1] = {.diameter = 10.0_mm, .length = 100.0_mm, .flute_length = 30.0_mm};
  piece.blank = stock::BoxShape{80.0, 60.0, 20.0};
  piece.blank_origin = Vec3(0, 0, -20);
  return piece;
}

Result<Trial> plate(const std::string& nc) {
  return run_trial(three_axes(), kinematics::GeometricErrors{}, plate_piece(nc), {},
                   {.measure = false});
}

constexpr const char* kDoubtful =
    "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\nM31\nM32\nM32\nG0 X30000 Y0 Z10.\nM30\n";

TEST(Trial, WarnsOfEachWordOfTheBuilderAndOfWhatIsTakenForGranted) {
  const auto commanded = command_piece(three_axes(), plate_piece(kDoubtful));
  EXPECT_FALSE(commanded);  // X30000: 30 m
  const auto near = command_piece(
      three_axes(), plate_piece("G20 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\nM31\nM32\nM32\nG0 X1 "
                                "Y0. Z1.\nM30\n"));
  ASSERT_TRUE(near) << to_string(near.error().front());
  std::vector<std::string> told;
  for (const Diagnostic& each : near->warnings) {
    told.push_back(fmt::format("{}:{} {}", each.line, each.id.text(), each.message));
    EXPECT_EQ(each.file, "plate.nc");
  }
  EXPECT_THAT(told, testing::ElementsAre(
                        "5:builder-word M31 is a word of the machine's builder, passed over",
                        "6:builder-word M32 is a word of the machine's builder, passed over",
                        testing::StartsWith("8:assumed decimal point: taken that X1 counts")));
}

TEST(Trial, ReadsTheProgramAsTheControlOfTheMachineDoes) {
  const std::string control = "[controller]\nwords = [\"M31\"]\ndecimal_point = \"increment\"\n";
  const auto machine = kinematics::Machine::read(three_axes_text() + control, "increments.toml");
  ASSERT_TRUE(machine) << to_string(machine.error().front());
  const auto commanded = command_piece(*machine, plate_piece(kDoubtful));
  ASSERT_TRUE(commanded) << to_string(commanded.error().front());
  ASSERT_EQ(commanded->warnings.size(), 1U) << to_string(commanded->warnings.back());
  EXPECT_EQ(commanded->warnings[0].id, "builder-word"_id);
  EXPECT_EQ(commanded->warnings[0].line, 6);
  const auto& samples = kinematics::block_ends(commanded->program);
  EXPECT_NEAR(samples.back().axes[kinematics::AxisLetter::X], 30.0, 1e-9);
  EXPECT_NEAR(samples.back().axes[kinematics::AxisLetter::Z], 110.0, 1e-9);
}

TEST(Trial, NamesTheWordOfAMachineFileThatIsNone) {
  const auto machine = kinematics::Machine::read(
      three_axes_text() + "[controller]\nwords = [\"M31\", \"31\"]\n", "m.toml");
  ASSERT_FALSE(machine);
  EXPECT_EQ(machine.error().front().key, "controller.words");
}

TEST(Trial, ReportsRapidsThroughMaterialWithTheirLine) {
  const auto trial = plate(
      "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\nG0 X-60 Y0 Z10\nG0 Z-5\nG0 X60\nG0 Z10\nG0 "
      "X0\nM30\n");
  ASSERT_TRUE(trial) << to_string(trial.error().front());
  ASSERT_EQ(trial->collisions.size(), 1U);
  EXPECT_EQ(trial->collisions[0].source_line, 7U);
  EXPECT_EQ(trial->collisions[0].kind, stock::CollisionKind::rapid_through_material);
  EXPECT_NEAR(trial->collisions[0].depth, 5.0, 0.02);
}

TEST(Trial, CallsToolsByTheNamesThatTheJobGivesThem) {
  programs::TestPiece named =
      plate_piece("N1 G71 G90 G17 G54\nT=\"Drill 8.5\"\nM6\nS1000 M3\nD1\nG0 X0 Y0\nG0 Z10\nM30\n");
  named.dialect = parser::Dialect::sinumerik;
  const int number = named.tools.begin()->first;
  EXPECT_FALSE(command_piece(three_axes(), named));  // tool 1001, which the job has not
  named.tools.at(number).name = "DRILL 8.5";
  const auto commanded = command_piece(three_axes(), named);
  ASSERT_TRUE(commanded) << to_string(commanded.error().front());
  EXPECT_TRUE(commanded->warnings.empty());
}

TEST(Trial, ReportsARapidThatOnlyShavesTheEdge) {
  // The cutter of radius 5 reaches 0.3 mm into the face at X = 40.
  const auto trial = plate(
      "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\nG0 X44.7 Y-50 Z10\nG0 Z-5\nG0 Y50\nG0 Z10\nM30\n");
  ASSERT_TRUE(trial);
  ASSERT_EQ(trial->collisions.size(), 1U);
  EXPECT_EQ(trial->collisions[0].source_line, 7U);
}

TEST(Trial, ReportsFeedsWithTheSpindleOffWithTheirLine) {
  const auto trial =
      plate("G21 G90 G17\nT1 M6\nG54 G43 H1\nG0 X-60 Y0 Z10\nG0 Z-5\nG1 X60 F300\nG0 Z10\nM30\n");
  ASSERT_TRUE(trial);
  ASSERT_EQ(trial->collisions.size(), 1U);
  EXPECT_EQ(trial->collisions[0].source_line, 6U);
  EXPECT_EQ(trial->collisions[0].kind, stock::CollisionKind::feed_with_spindle_off);
}

// Line 6 cuts; after the change of direction line 10 does.
TEST(Trial, Fault2_30_WarnsOfCutsAgainstTheHandOfTheTool) {
  const std::string head = "G21 G90 G17\nT1 M6\nS1000 ";
  const std::string tail =
      "\nG54 G43 H1\nG0 X-60 Y0 Z-5\nG1 X60 F300\nX-60\nM3\nG1 X60 Z-8\nM4 X-60 Z-11\nG0 "
      "Z10\nM30\n";
  const auto lines = [&](const std::string& nc) {
    const auto trial = plate(nc);
    EXPECT_TRUE(trial) << to_string(trial.error().front());
    std::vector<int> found;
    for (const Diagnostic& d : trial ? trial->warnings : Diagnostics{}) {
      if (d.id == "spindle-hand"_id) found.push_back(d.line);
    }
    return found;
  };
  EXPECT_EQ(lines(head + "M4" + tail), (std::vector<int>{6, 10}));
  EXPECT_EQ(lines(head + "M3" + tail), std::vector<int>{10});
}

TEST(Trial, HasNoPhantomContactAtTheStart_Complaint11) {
  // Complaint 11: the first rapid comes from the machine's home, not through the part, and a rapid
  // along the wall just cut is no collision.
  const auto trial = plate(
      "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\nG0 X-60 Y0 Z10\nG0 Z-5\nG1 X60 F300\nG0 X-60\nG0 "
      "Z10\nM30\n");
  ASSERT_TRUE(trial);
  EXPECT_TRUE(trial->collisions.empty());
}

TEST(Trial, NamesThePlaceWhenThePlanMissesThePart) {
  ConeTrial cone = ConeTrial::on("iwf-bc");
  for (auto& feature : cone.piece.plan.features) {
    if (feature.name == "cone") feature.point += Vec3(0, 0, 60);
  }
  const auto trial = run_trial(cone.machine, kinematics::GeometricErrors{}, cone.piece, {});
  ASSERT_FALSE(trial);
  EXPECT_NE(to_string(trial.error().front()).find("cone"), std::string::npos);
}

}  // namespace
}  // namespace frustum::trials
