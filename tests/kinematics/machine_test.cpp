#include "kinematics/model/machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

std::string shipped_text() {
  std::ifstream in(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
  return {std::istreambuf_iterator<char>(in), {}};
}

// The first diagnostic after replacing `from` by `to` in a good machine file.
std::string first_problem(const std::string& from, const std::string& to) {
  std::string text = shipped_text();
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const auto machine = Machine::read(text, "machine_test.toml");
  if (machine) return "accepted";
  return machine.error().front().key + ": " + machine.error().front().message;
}

TEST(Machine, ReadsChainsFromTheBedOutwards) {
  const Machine machine = shipped("iwf-bc");
  ASSERT_EQ(machine.tool_chain().size(), 2U);
  EXPECT_EQ(machine.tool_chain()[0].letter, AxisLetter::Y);
  EXPECT_EQ(machine.tool_chain()[1].letter, AxisLetter::Z);
  ASSERT_EQ(machine.work_chain().size(), 3U);
  EXPECT_EQ(machine.work_chain()[2].letter, AxisLetter::C);
  EXPECT_EQ(machine.work_chain()[2].side, -1);
}

// A good machine file, one line a key, so that a mistake has a line of its own.
constexpr const char* kGood = R"(name = "small"
structure = "t-(C)-Z-Y-b-X-A-C-w"
datum = ["X", "Y"]
rotation_order = "zyx"
[spindle]
offset = [0, 0, -50]
[axis.X]
travel = [-400, 400]
velocity = 500
acceleration = 4000
jerk = 40000
servo_gain = 50
[axis.Y]
travel = [-300, 300]
[axis.Z]
travel = [-100, 500]
home = 400
functional_point = "tip"
[axis.A]
travel = [-120, 120]
[axis.C]
endless = true
[alias]
tilt = { error = "EB0C" }
)";

struct BadFile {
  const char* good;  // this
  const char* bad;   // replaced by this
  int line;
  const char* told;  // "key: message (hint: ...)", its beginning
};

constexpr BadFile kBadFiles[] = {
    // the structure: axis twice, no path from tool to workpiece
    {"t-(C)-Z-Y-b-X-A-C-w", "t-(C)-Z-Y-b-X-A-A-w", 2,
     "structure: structure code 't-(C)-Z-Y-b-X-A-A-w': axis A is there twice (hint: tool first, b"},
    {"t-(C)-Z-Y-b-X-A-C-w", "t-(C)-Z-Y-X-A-C-w", 2,
     "structure: structure code 't-(C)-Z-Y-X-A-C-w': there is no bed b between tool and workpiece"},
    {"t-(C)-Z-Y-b-X-A-C-w", "t-(C)-Z-b-Y-b-X-A-C-w", 2,
     "structure: structure code 't-(C)-Z-b-Y-b-X-A-C-w': there are two beds"},
    {"t-(C)-Z-Y-b-X-A-C-w", "(C)-Z-Y-b-X-A-C-w", 2,
     "structure: structure code '(C)-Z-Y-b-X-A-C-w': it must begin with t, the tool"},
    {"t-(C)-Z-Y-b-X-A-C-w", "t-(C)-Z-Y-b-X-A-C", 2,
     "structure: structure code 't-(C)-Z-Y-b-X-A-C': it must end with w, the workpiece"},
    {"t-(C)-Z-Y-b-X-A-C-w", "t-(C)-Z-b-X-A-C-w", 2,
     "structure: structure code 't-(C)-Z-b-X-A-C-w': axis Y is missing"},
    {"t-(C)-Z-Y-b-X-A-C-w", "t-(C)-Z-Y-b-X-U-C-w", 2,
     "structure: structure code 't-(C)-Z-Y-b-X-U-C-w': 'U' is not an axis (X Y Z A B C)"},
    {"t-(C)-Z-Y-b-X-A-C-w", "t-(C)-Z-Y-b-X-A-B-C-w", 2,
     "structure: structure code 't-(C)-Z-Y-b-X-A-B-C-w': 3 rotary axes, at most two are supported"},
    {"t-(C)-Z-Y-b-X-A-C-w", "t-Z-(C)-Y-b-X-A-C-w", 2,
     "structure: structure code 't-Z-(C)-Y-b-X-A-C-w': the spindle (C) must follow the tool"},
    {"\"t-(C)-Z-Y-b-X-A-C-w\"", "5", 2, "structure: expected text, found a whole number"},
    {"\"t-(C)-Z-Y-b-X-A-C-w\"", "\"\"", 2,
     "structure: structure code '': it must begin with t, the tool"},
    {"structure = ", "strcture = ", 1, "structure: this key is missing"},
    // axes that the structure and the tables do not share
    {"t-(C)-Z-Y-b-X-A-C-w", "t-(C)-Z-Y-b-X-C-w", 19,
     "axis.A: axis A is not in the structure t-(C)-Z-Y-b-X-C-w (hint: add it to the structure"},
    {"[axis.C]", "[axis.B]", 7, "axis.C: this key is missing"},
    {"[axis.X]\n", "[axis.U]\ntravel = [0, 1]\n[axis.X]\n", 7, "axis.U: 'U' is not an axis"},
    // travel and home
    {"[-400, 400]", "[400, -400]", 8, "axis.X.travel: expected [lowest, highest] (hint: in mm)"},
    {"[-120, 120]", "[120, 120]", 20,
     "axis.A.travel: expected [lowest, highest] (hint: in degrees, or endless = true)"},
    {"[-400, 400]", "[-400, 0, 400]", 8, "axis.X.travel: expected [lowest, highest]"},
    {"[-400, 400]", "\"long\"", 8, "axis.X.travel: expected an array of numbers, found text"},
    {"travel = [-400, 400]", "travle = [-400, 400]", 7, "axis.X.travel: this key is missing"},
    {"travel = [-400, 400]", "endless = true", 8,
     "axis.X.endless: a linear axis has a travel (hint: write travel = [lowest, highest] in mm)"},
    {"endless = true", "endless = \"yes\"", 22,
     "axis.C.endless: expected true or false, found text"},
    {"home = 400", "home = 900", 17, "axis.Z.home: 900 is outside the travel"},
    {"home = 400", "home = nan", 17, "axis.Z.home: expected a finite number, found inf or nan"},
    // directions
    {"travel = [-400, 400]", "travel = [-400, 400]\ndirection = [1, 1, 0]", 9,
     "axis.X.direction: the direction has length 1.4142135623730951, not 1 (hint: give a unit"},
    {"travel = [-400, 400]", "travel = [-400, 400]\ndirection = [1, 0]", 9,
     "axis.X.direction: expected three numbers [x, y, z], found 2"},
    {"travel = [-400, 400]", "travel = [-400, 400]\ndirection = [0, 1, 0]", 7,
     "axis: the directions of X, Y and Z are in one plane (hint: they must span space)"},
    {"endless = true", "endless = true\ndirection = [1, 0, 0]", 7,
     "axis: the two rotary axes are parallel (hint: they must orient the tool in two ways)"},
    // drives
    {"velocity = 500", "velocity = -500", 9, "axis.X.velocity: must be greater than 0, is -500"},
    {"velocity = 500", "velocty = 500", 9,
     "axis.X.velocty: unknown key (hint: did you mean velocity?)"},
    {"acceleration = 4000", "acceleration = \"fast\"", 10,
     "axis.X.acceleration: expected a finite number, found text"},
    {"jerk = 40000", "jerk = -1", 11, "axis.X.jerk: must be greater than 0, is -1"},
    {"servo_gain = 50", "servo_gain = 0", 12, "axis.X.servo_gain: must be greater than 0, is 0"},
    // functional points, reference axes, conventions
    {"\"tip\"", "\"tool\"", 18,
     "axis.Z.functional_point: 'tool' is not one of the choices (hint: choices: tip)"},
    {"\"tip\"", "[0, 1]", 18, "axis.Z.functional_point: expected three numbers [x, y, z], found 2"},
    {"[\"X\", \"Y\"]", "[\"X\", \"C\"]", 3, "datum: 'C' is not a linear axis (hint: name the"},
    {"[\"X\", \"Y\"]", "[\"X\", \"X\"]", 3, "datum: expected at most two different axes"},
    {"\"zyx\"", "\"zxy\"", 4,
     "rotation_order: 'zxy' is not one of the choices (hint: choices: zyx, xyz)"},
    {"[0, 0, -50]", "[0, 0, \"-50\"]", 6, "spindle.offset: expected finite numbers only"},
    // aliases: unknown error name, error on a missing axis
    {"EB0C", "EB0D", 24, "alias.tilt.error: unknown error name 'EB0D' (hint: E, the direction"},
    {"EB0C", "EB0B", 24,
     "alias.tilt.error: error EB0B: the structure t-(C)-Z-Y-b-X-A-C-w has no axis B"},
    {"\"EB0C\"", "\"EB0C\", carries = true", 24,
     "alias.tilt.carries: only an orientation error of a linear axis can carry"},
    {"error = \"EB0C\"", "meaning = \"tilt\"", 24, "alias.tilt.error: this key is missing"},
    // not TOML
    {"[axis.X]", "[axis.X", 7, "Error while parsing table header: expected ']'"},
    {"[axis.Y]", "[axis.X]", 13, "cannot redefine existing table"},
};

TEST(Machine, SaysOfABadFileWhatIsWrongWhere) {
  ASSERT_TRUE(Machine::read(kGood, "small.toml"));
  for (const BadFile& file : kBadFiles) {
    std::string text = kGood;
    const auto at = text.find(file.good);
    ASSERT_NE(at, std::string::npos) << file.good;
    text.replace(at, std::string(file.good).size(), file.bad);
    const auto machine = Machine::read(text, "small.toml");
    ASSERT_FALSE(machine) << file.bad;
    const Diagnostic& first = machine.error().front();
    Diagnostic without_place = first;
    without_place.file.clear();
    without_place.line = without_place.column = 0;
    EXPECT_EQ(first.line, file.line) << file.bad;
    EXPECT_THAT(to_string(without_place), testing::HasSubstr(file.told));
  }
}

TEST(Machine, DoesNotCallKeysUnknownThatABadStructureKeptFromBeingRead) {
  std::string text = kGood;
  text.replace(text.find("Z-Y-b"), 5, "Z-Y");
  const auto machine = Machine::read(text, "small.toml");
  ASSERT_FALSE(machine);
  EXPECT_EQ(machine.error().size(), 1U);
}

constexpr const char* kBodies = R"([[bodies]]
name = "trunnion"
on = "A"
shape = "box"
size = [300, 200, 60]
origin = [0, 0, -100]
tilt = [0, 0, 90]
ignore = ["disc"]
[[bodies]]
name = "disc"
on = "table"
shape = "cylinder"
diameter = 250
height = "0.04 m"
[[bodies]]
name = "head"
on = "spindle"
shape = "box"
size = [200, 200, 300]
)";

TEST(Machine, ReadsBodiesAndWhatCarriesThem_Fault2_25) {
  const auto machine = Machine::read(std::string(kGood) + kBodies, "small.toml");
  ASSERT_TRUE(machine) << to_string(machine.error().front());
  const auto& bodies = machine->bodies();
  ASSERT_EQ(bodies.size(), 3U);
  EXPECT_EQ(bodies[0].part, (MachinePart{-1, 2}));  // X carries A
  EXPECT_EQ(bodies[0].ignored, std::vector<std::string>{"disc"});
  // Turned by 90 degrees about Z, X of the body is Y of the axis.
  EXPECT_LE((bodies[0].part_from_body.point({10, 0, 0}) - Vec3(0, 10, -100)).norm(), 1e-12);
  EXPECT_EQ(bodies[1].part, (MachinePart{-1, 3}));
  EXPECT_EQ(std::get<CylinderBody>(bodies[1].shape).height, 40.0);
  EXPECT_EQ(bodies[2].part, (MachinePart{+1, 2}));
  EXPECT_EQ(bodies[2].part_from_body.translation, Vec3(0, 0, -50));  // the gauge point
}

TEST(Machine, SaysOfABadBodyWhatIsWrong_Fault2_25) {
  struct BadBody {
    const char* good;
    const char* bad;
    const char* told;
  };
  for (const BadBody& body : {
           BadBody{"on = \"A\"", "on = \"B\"", "the machine has no part 'B'"},
           BadBody{"on = \"A\"", "", "this key is missing"},
           BadBody{"size = [300, 200, 60]", "size = [300, 0, 60]", "every size must be above 0"},
           BadBody{"diameter = 250", "diameter = -250", "must be greater than 0"},
           BadBody{"diameter = 250", "diametr = 250", "did you mean diameter?"},
           BadBody{"[\"disc\"]", "[\"disk\"]", "did you mean disc?"},
           BadBody{"\"head\"", "\"disc\"", "another body called 'disc'"},
           BadBody{"shape = \"cylinder\"", "shape = \"mesh\"\nfile = \"none.stl\"",
                   "none.stl cannot be read"},
       }) {
    std::string text = std::string(kGood) + kBodies;
    text.replace(text.find(body.good), std::string(body.good).size(), body.bad);
    const auto machine = Machine::read(text, "small.toml");
    ASSERT_FALSE(machine) << body.bad;
    std::string all;
    for (const Diagnostic& d : machine.error()) {
      EXPECT_GT(d.line, 20) << to_string(d);
      all += to_string(d) + "\n";
    }
    EXPECT_THAT(all, testing::HasSubstr(body.told));
  }
}

TEST(Machine, ReadsWhatTheDrivesCanDoInMillimetresAndRadians) {
  const AxisDynamics x = shipped("iwf-bc").joint(AxisLetter::X)->dynamics;
  EXPECT_EQ(x.velocity, 500.0);
  EXPECT_EQ(x.acceleration, 4000.0);
  EXPECT_EQ(x.jerk, 40000.0);
  EXPECT_EQ(x.servo_gain, 50.0);
  const AxisDynamics b = shipped("iwf-bc").joint(AxisLetter::B)->dynamics;
  EXPECT_NEAR(b.velocity, std::numbers::pi, 1e-15);  // 180 deg/s
  EXPECT_NEAR(b.jerk, 9000.0 * std::numbers::pi / 180.0, 1e-12);
  EXPECT_EQ(b.servo_gain, 40.0);
  EXPECT_EQ(first_problem("jerk         = 40000", "jerk         = -40000"),
            "axis.X.jerk: must be greater than 0, is -40000");
}

TEST(Machine, RefusesErrorsThatTheReferenceAxesMakeZero) {
  const Machine machine = shipped("iwf-bc");
  EXPECT_TRUE(machine.refused(*ErrorName::parse("EB0X")));
  EXPECT_TRUE(machine.refused(*ErrorName::parse("EA0Y")));
  EXPECT_FALSE(machine.refused(*ErrorName::parse("EC0Y")));
  EXPECT_FALSE(machine.refused(*ErrorName::parse("EA0Z")));
  EXPECT_TRUE(machine.refused(*ErrorName::parse("EC0Z")));
  EXPECT_FALSE(machine.refused(*ErrorName::parse("EC0B")));
}

}  // namespace
}  // namespace frustum::kinematics
