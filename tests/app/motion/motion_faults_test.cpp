// What frustum motion refuses, with its place; what it finds of a set-up; exit codes of studies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/app/motion_commands.hpp"

namespace frustum {
namespace {

class MotionFaults : public MotionCommands {
 protected:
  // The first fault of a command that must be refused.
  json first_fault(const std::string& command) const {
    const Outcome outcome = run(command + " --json");
    EXPECT_EQ(outcome.exit_code, 2) << command << outcome.out;
    const json doc = json::parse(outcome.out, nullptr, false);
    return doc.is_discarded() ? json() : doc["diagnostics"][0];
  }
  void expect_fault_at(const std::string& text, const char* id, int line) const {
    write("test.toml", text);
    const json found = first_fault("motion run test.toml");
    ASSERT_FALSE(found.is_null()) << text;
    EXPECT_EQ(found["id"], id) << found;
    EXPECT_TRUE(found["file"].get<std::string>().ends_with("test.toml")) << found;
    EXPECT_EQ(found["line"], line) << found;
    EXPECT_EQ(found["message"].get<std::string>().find("--"), std::string::npos) << found;
  }
  void measure(const std::string& folder, const std::string& test) const {
    const Outcome outcome = run("motion " + test + " --out " + folder + " --quiet");
    ASSERT_EQ(outcome.exit_code, 0) << test << outcome.err;
  }
};

TEST_F(MotionFaults, FaultsOfATestFileHaveTheirLine) {
  expect_fault_at("test = \"circle\"\nplane = \"XW\"\ncenter = [0, 0, 150]\nmachine = \"iwf-bc\"\n",
                  "unknown-choice", 2);
  expect_fault_at("test = \"circle\"\nplane = \"XY\"\ncenter = [0, 150]\nmachine = \"iwf-bc\"\n",
                  "number-count", 3);
  expect_fault_at(
      "test = \"rotary\"\naxis = \"Q\"\ndirection = \"axial\"\nball = [0, 0, 9]\nmachine = "
      "\"iwf-bc\"\n",
      "unknown-axis", 2);
  expect_fault_at(
      "test = \"rotary\"\naxis = \"C\"\ndirection = \"axial\"\nball = [0, 0, 9]\nmachine = "
      "\"iwf-bc\"\nat = \"C=30\"\n",
      "axis-moved", 6);
  expect_fault_at(
      "test = \"cone\"\ncone_angle = 45\ninclination = 30\nradius = 40\ncenter = [-65, 0, 150]\n"
      "machine = \"iwf-bc\"\nat = \"C=30\"\n",
      "axis-moved", 7);
  const std::string circle =
      "test = \"circle\"\nplane = \"XY\"\ncenter = [0, 0, 150]\nmachine = \"iwf-bc\"\n";
  expect_fault_at(circle + "[instrument]\nseed = 1\nnoise = \"3\"\n", "wrong-quantity", 7);
  expect_fault_at(circle + "[setup]\nball_um = [1, 2]\n", "number-count", 6);
  expect_fault_at(circle + "dynamics = \"fast\"\n", "unknown-choice", 5);
  expect_fault_at(circle + "dynamics = \"linear\"\n", "missing-option", 5);
  // A study that names such a file.
  write("study.toml", "[[motion]]\ntest = \"test.toml\"\ntraces = [\"t.csv\"]\n");
  write("test.toml",
        "test = \"circle\"\nplane = \"XW\"\ncenter = [0, 0, 150]\nmachine = \"iwf-bc\"\n");
  const json found = first_fault("identify study.toml");
  EXPECT_TRUE(found["file"].get<std::string>().ends_with("test.toml")) << found;
  EXPECT_EQ(found["line"], 2);
  // What the study itself says wrongly is its own.
  write("test.toml", circle + "[instrument]\nnoise = \"1um\"\n");
  measure("L", "line --axis X --targets=-100,0,100 --machine iwf-bc --noise 0.3um");
  write("study.toml", "title = \"t\"\n[[motion]]\ntest = \"L/test.toml\"\ntraces = [\"t.csv\"]\n");
  const json own = first_fault("identify study.toml");
  EXPECT_TRUE(own["file"].get<std::string>().ends_with("study.toml")) << own;
  EXPECT_EQ(own["line"], 3) << own;
}

TEST_F(MotionFaults, AxesThatTheTestMovesAreNotHeld) {
  EXPECT_EQ(fault("rotary --axis C --direction axial --ball 100,0,100 --machine zx-yac --at C=30"),
            "axis-moved");
  EXPECT_EQ(fault("line --axis X --targets=0,50,100 --machine zx-yac --at X=10"), "axis-moved");
  EXPECT_EQ(fault("diagonal --box \"X=-100:100,Y=-100:100\" --machine zx-yac --at X=10"),
            "axis-moved");
  EXPECT_EQ(
      run("motion diagonal --box \"X=-100:100,Y=-100:100\" --machine zx-yac --at Z=200").exit_code,
      0);
}

TEST_F(MotionFaults, NothingIsTakenTwiceAndNoSeedIsNegative) {
  const std::string circle = "circle --machine iwf-bc --plane XY --center 0,0,150";
  EXPECT_EQ(fault(circle + " --setup \"ball=1,2,3;ball=1,2,3\""), "given-twice");
  EXPECT_EQ(fault(circle + " --setup \"length=1;ball=1,2,3;length=2\""), "given-twice");
  for (const char* seed : {"-1", "-18446744073709551615"}) {
    const Outcome outcome = run("motion " + circle + " --noise 1um --seed=" + seed);
    EXPECT_EQ(outcome.exit_code, 2) << seed;
    EXPECT_NE(outcome.err.find("seed"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(run("motion " + circle + " --noise 1um --seed 0").exit_code, 0);
}

TEST_F(MotionFaults, ALineWritesTheTraceThatIsReadAgain) {
  const json line = document(
      "line --axis X --targets=-180,-97,-31,42,111,178 --machine zx-yac --noise 0.5um --error "
      "\"EXX=linear 10um + reversal 3um\" --out line");
  ASSERT_FALSE(line.is_null());
  const json again = document("trace line/trace.csv --axis X");
  ASSERT_FALSE(again.is_null());
  for (const char* value : {"A", "E", "R", "B", "M"}) {
    EXPECT_NEAR(again["evaluation"][value].get<double>(), line["evaluation"][value].get<double>(),
                1e-9)
        << value;
  }
}

// A turn at 1 deg/min takes six hours of half milliseconds: that is said, not begun.
TEST_F(MotionFaults, ARunThatNobodyWaitsForIsRefused) {
  const std::string turn =
      "rotary --machine iwf-bc --axis C --direction radial --ball 100,0,100 --tool-length 150 "
      "--dynamics linear --angles 0,90,180,270";
  EXPECT_EQ(fault(turn + " --feed 1"), "run-too-long");
  const Outcome outcome = run("motion " + turn + " --feed 1");
  EXPECT_NE(outcome.err.find(" s, which are"), std::string::npos) << outcome.err;
}

// Balls that are off are found where the machine is right.
TEST_F(MotionFaults, TheSetUpThatWasFoundIsShown) {
  const std::string off = " --setup \"table_ball=6,-4,2;length=3\" --machine zx-yac";
  const json circle = document("circle --plane XY --length 150 --center 0,0,150" + off);
  // What is across the plane is not seen.
  expect_all(circle["setup_found_um"]["table_ball"], {6.0, -4.0, 0.0}, 1e-3);
  EXPECT_NEAR(circle["setup_found_um"]["length"].get<double>(), 3.0, 1e-3);
  const json chase =
      document("chase --ball 100,0,100 --at \"A=-60,C=0;A=0,C=60;A=30,C=200\"" + off);
  expect_all(chase["setup_found_um"]["table_ball"], {6.0, -4.0, 2.0}, 1e-6);
  const json radial =
      document("rotary --axis C --direction radial --ball 100,0,100 --hold bed --out bar" + off);
  EXPECT_FALSE(radial["setup_found_um"].is_null());
  measure("XY", "circle --plane XY --length 150 --center 0,0,150" + off);
  const json traced = document("trace XY/trace.csv --length 150");
  // A table ball that is off the other way moves the circle.
  expect_all(traced["setup_found_um"]["center"], {-6.0, 4.0}, 1e-3);
  EXPECT_NE(read(folder_ / "XY/motion.html").find("Set-up found"), std::string::npos);
}

// What was asked for is answered, although nobody knows where the ball in the spindle is.
TEST_F(MotionFaults, AStudyThatIsAnsweredEndsWithZero) {
  const std::string common =
      " --machine zx-yac --noise 0.3um --error EC0Y=20urad --setup \"table_ball=20,-15,10\"";
  measure("XY", "circle --plane XY --center 0,0,150 --seed 1" + common);
  measure("again", "circle --plane XY --center 0,0,150 --seed 2" + common);
  const std::string first = "[[motion]]\ntest = \"XY/test.toml\"\ntraces = [\"XY/trace.csv\"]\n";
  write("s.toml", first + "[unknown]\nerrors = [\"EC0Y\"]\n");
  const Outcome one = run("identify s.toml --json");
  EXPECT_EQ(one.exit_code, 0) << one.err;
  const json found = json::parse(one.out);
  EXPECT_EQ(found["answered"], true);
  EXPECT_EQ(found["complete"], false);
  EXPECT_NEAR(found["estimates"][0]["value"].get<double>(), 20.0, 0.5);
  ASSERT_EQ(found["setup_found"].size(), 1U);
  EXPECT_NEAR(found["setup_found"][0]["table ball X um"].get<double>(), 20.0, 0.1);
  EXPECT_NEAR(found["setup_found"][0]["table ball Y um"].get<double>(), -15.0, 0.1);
  // Where the asked for is not answered it does not.
  write("s.toml", first + "[unknown]\nerrors = [\"EC0Y\", \"EX0C\"]\n");
  EXPECT_EQ(run("identify s.toml").exit_code, 1);
  // The same test twice: both rows of readings count.
  write("s.toml", first +
                      "[[motion]]\ntest = \"XY/test.toml\"\ntraces = [\"again/trace.csv\"]\n"
                      "[unknown]\nerrors = [\"EC0Y\"]\n");
  const Outcome twice = run("identify s.toml --json");
  ASSERT_EQ(twice.exit_code, 0) << twice.err << twice.out;
  const json both = json::parse(twice.out);
  EXPECT_NEAR(both["estimates"][0]["standard_uncertainty"].get<double>(),
              found["estimates"][0]["standard_uncertainty"].get<double>() / std::sqrt(2.0), 1e-6);
  EXPECT_EQ(both["setup_found"].size(), 2U);
}

}  // namespace
}  // namespace frustum
