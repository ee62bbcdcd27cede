// NC programs of motion tests: written in every dialect, read back and run, and read by the
// instrument.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tests/app/motion_commands.hpp"

namespace frustum {
namespace {

class MotionProgramSystem : public MotionCommands {
 protected:
  // The document of a test's program, run in place of analytic samples.
  json through(const std::string& test, const std::string& program) const {
    fs::remove_all(folder_ / "out");
    const json written = document(test + " " + program + " --out out");
    if (written.is_null()) return {};
    const json run = document("run out/test.toml");
    EXPECT_TRUE(run.contains("program")) << test << program;
    return run;
  }
};

constexpr const char* kErrors =
    " --error EC0Y=20urad --error EX0C=8um --error EB0C=15urad --error \"EXX=linear 6um over "
    "-200mm..200mm";

// Backlash, too, where every axis turns back before it is looked at: elsewhere it depends on the
// way to the first pose, which samples do not have.
std::string errors_of(const std::string& test) {
  const bool turns_back = test.starts_with("circle") || test.starts_with("line");
  return std::string(kErrors) + (turns_back ? " + reversal 3um\"" : "\"");
}

TEST_F(MotionProgramSystem, EveryTestInEveryDialectReadsAsItsSamples) {
  const std::vector<std::string> tests{
      "circle --machine iwf-bc --plane XY --length 150 --center 0,0,150",
      "circle --machine iwf-bc --plane YZ --length 100 --center 0,0,150",
      "circle --machine iwf-bc --plane ZX --length 100 --center 0,0,150 --angles=-20,0.5,77,199.5",
      "rotary --machine iwf-bc --axis C --direction radial --ball 100,0,100 --at B=-30",
      "rotary --machine iwf-bc --axis C --direction tangential --hold bed --ball 100,0,100",
      "rotary --machine iwf-bc --axis B --direction axial --ball 60,0,100",
      "cone --machine iwf-bc --cone-angle 45 --inclination 30 --radius 40 --center=-65,0,150",
      "chase --machine iwf-bc --ball 100,0,100 --at \"B=-60,C=0;B=0,C=90;B=30,C=200\"",
      "line --machine iwf-bc --axis X --targets=-180,-97,-31,42,111,178 --runs 2",
      "diagonal --machine iwf-bc --box \"X=-180:180,Y=-150:150,Z=0:300\""};
  for (const std::string& test : tests) {
    for (const char* dialect : {"fanuc", "linuxcnc", "sinumerik", "heidenhain"}) {
      const json run =
          through(test + errors_of(test), fmt::format("--dialect {} --form tcp", dialect));
      ASSERT_FALSE(run.is_null()) << test << dialect;
      EXPECT_LT(run["program"]["largest_difference_um"].get<double>(), 0.02) << test << dialect;
    }
    const json axes = through(test + errors_of(test), "--dialect fanuc --form axes");
    ASSERT_FALSE(axes.is_null()) << test;
    EXPECT_LT(axes["program"]["largest_difference_um"].get<double>(), 0.02) << test;
  }
}

TEST_F(MotionProgramSystem, HeadsAndTablesInBothForms) {
  for (const char* test :
       {"rotary --machine swivel-head-table --axis B --direction radial --ball 0,0,100 "
        "--tool-length 150",
        "rotary --machine swivel-head-table --axis B --direction axial --hold rotor --ball "
        "0,40,100 "
        "--tool-length 150",
        "rotary --machine double-pivot-head --axis C --direction radial --ball 0,0,100 "
        "--tool-length 250 --at B=60",
        "rotary --machine zx-yac --axis A --direction tangential --ball 100,0,100"}) {
    for (const char* form : {"tcp", "axes"}) {
      const json run = through(std::string(test) + " --error EB0C=15urad --error EC0Y=20urad",
                               fmt::format("--dialect fanuc --form {}", form));
      ASSERT_FALSE(run.is_null()) << test << form;
      EXPECT_LT(run["program"]["largest_difference_um"].get<double>(), 0.02) << test << form;
      EXPECT_EQ(run["reading_back_um"].size(), run["reading_um"].size());
    }
  }
}

// The lag of the position loops: analytic amplitude and phase against the time law and the loops.
TEST_F(MotionProgramSystem, ServoLagIsThatOfTheSteadyCircle) {
  std::string text = read(fs::path(FRUSTUM_SOURCE_DIR) / "machines/iwf-bc.toml");
  const auto first = text.find("\nservo_gain");
  ASSERT_NE(first, std::string::npos);
  // The second axis of the file, Y, becomes slower, so that the circle becomes an ellipse.
  const auto second = text.find("\nservo_gain", first + 1);
  const auto equals = text.find('=', second);
  const auto end = text.find('\n', equals);
  text.replace(equals, end - equals, "= 41");
  write("slow.toml", text);
  for (const char* plane : {"XY", "YZ"}) {
    for (const char* dialect : {"fanuc", "heidenhain"}) {
      const json run =
          through(fmt::format("circle --machine slow.toml --plane {} --length 150 --center 0,0,150 "
                              "--feed 3000",
                              plane),
                  fmt::format("--dialect {}", dialect));
      ASSERT_FALSE(run.is_null());
      EXPECT_GT(run["evaluation"]["G_ccw_ls"].get<double>(), 1.0);
      EXPECT_LT(run["program"]["largest_difference_um"].get<double>(), 0.01) << plane << dialect;
    }
  }
}

// What goes where, what is captured, what of travels and stroke it takes.
TEST_F(MotionProgramSystem, TheSetUpSheetOfABar) {
  const json circle = document(
      "circle --machine iwf-bc --plane XY --length 150 --center 0,0,150 --error EC0Y=20urad "
      "--dialect heidenhain --out out");
  ASSERT_FALSE(circle.is_null());
  const json& sheet = circle["setup_sheet"];
  expect_all(sheet["g54_in_table_mm"], {0.0, 0.0, 150.0}, 1e-9);
  expect_all(sheet["pass_deg"], {-180.0, 540.0}, 1e-9);
  expect_all(sheet["travels"]["X"], {-150.0, 150.0}, 1e-6);
  EXPECT_EQ(sheet["stroke_um"], 1000.0);
  EXPECT_NEAR(sheet["largest_reading_um"].get<double>(), 1.5, 0.01);
  EXPECT_NE(read(folder_ / "out/motion.html").find("Set-up sheet"), std::string::npos);
  EXPECT_NE(read(folder_ / "out/setup.csv").find("circle.h"), std::string::npos);
  const json tilt = document(
      "rotary --machine iwf-bc --axis B --direction axial --ball 60,0,100 --dialect fanuc "
      "--out out");
  // As far as the travel goes, with overshoot where there is any left.
  EXPECT_LE(tilt["setup_sheet"]["pass_deg"][0].get<double>(),
            tilt["setup_sheet"]["capture_deg"][0].get<double>());
}

// The top of the table is 70 mm below the crossing of the axes, the bar is 8 mm thick.
TEST_F(MotionProgramSystem, ABarThatMeetsTheMachineIsRefused) {
  const json level = document(
      "circle --machine zx-yac --plane XY --length 100 --center 0,0,0 --dialect fanuc --out out");
  EXPECT_NEAR(level["setup_sheet"]["nearest_mm"].get<double>(), 66.0, 0.01);
  EXPECT_NE(level["setup_sheet"]["nearest"].get<std::string>().find("bar and table"),
            std::string::npos);
  const std::string page = read(folder_ / "out/motion.html");
  for (const char* drawn : {"Set-up on the table", "from the front", "phi grows", "table ball"}) {
    EXPECT_NE(page.find(drawn), std::string::npos) << drawn;
  }
  const std::string upright = "circle --machine zx-yac --plane YZ --length 150 --center 0,0,50";
  EXPECT_EQ(fault(upright + " --dialect fanuc --out out"), "setup-collides");
  // From -20 to 200 deg it stays 1.3 mm below the ball's height at most.
  std::string arc;
  for (int i = 0; i <= 220; ++i) arc += fmt::format("{}{}", i > 0 ? "," : "", i - 20 + 0.5);
  EXPECT_EQ(run("motion " + upright + " --dialect fanuc --out out --angles=" + arc).exit_code, 0);
  // The spindle, which a tool of 150 mm brings down to the cup of the ball.
  const std::string head =
      "rotary --machine double-pivot-head --axis C --direction radial --ball 0,0,100 --at B=60 "
      "--dialect fanuc --out out --tool-length ";
  EXPECT_EQ(fault(head + "150"), "setup-collides");
  EXPECT_EQ(run("motion " + head + "250").exit_code, 0);
  EXPECT_NE(read(folder_ / "out/motion.html").find("C grows"), std::string::npos);
}

TEST_F(MotionProgramSystem, AProgramThatIsNotOfTheTestIsRefused) {
  const std::string circle = "circle --machine iwf-bc --plane XY --length 150 --center 0,0,150";
  ASSERT_FALSE(through(circle, "--dialect fanuc").is_null());
  std::string test = read(folder_ / "out/test.toml");
  const auto change = [&](const std::string& from, const std::string& to) {
    std::string changed = test;
    const auto at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << test;
    changed.replace(at, from.size(), to);
    write("out/changed.toml", changed);
    return fault("run out/changed.toml");
  };
  EXPECT_EQ(change("length = 150", "length = 149"), "program-without-test");
  EXPECT_EQ(change("program = \"circle.nc\"", "program = \"none.nc\""), "file-unreadable");
  EXPECT_EQ(change("plane = \"XY\"", "plane = \"XY\"\nangles = [0, 900]"), "capture-short");
  EXPECT_EQ(fault(circle + " --dialect fanuc --form polar --out out"), "usage");
}

}  // namespace
}  // namespace frustum
