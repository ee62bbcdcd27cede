// frustum motion as users and scripts see it.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/motion_commands.hpp"

namespace frustum {
namespace {

class MotionSystem : public MotionCommands {
 protected:
  static const json& numbers() {
    static const json kNumbers = json::parse(
        std::ifstream(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/motion_tests.json"));
    return kNumbers;
  }
  static std::string list_of(const json& values) {
    std::string text;
    for (const json& each : values) text += (text.empty() ? "" : ",") + each.dump();
    return text;
  }
  static std::string errors_of(const json& errors) {
    std::string text;
    for (const auto& [name, value] : errors.items()) {
      const bool angle = name[1] >= 'A' && name[1] <= 'C';
      text +=
          " --error \"" + name + "=" +
          (value.is_string() ? value.get<std::string>() : value.dump() + (angle ? "urad" : "um")) +
          "\"";
    }
    return text;
  }
  static constexpr const char* kSetup = " --setup \"ball=10,-5,3;table_ball=6,-4,2;length=2\"";
};

TEST_F(MotionSystem, RotaryReadingsOfEveryMachine) {
  for (const auto& [machine, all] : numbers()["rotary"].items()) {
    const json& test = all["tests"].back();
    std::string held;
    for (const auto& [axis, value] : test["held_deg"].items()) held = axis + "=" + value.dump();
    const json doc = document(fmt::format(
        "rotary --machine {} --axis {} --direction {} --hold {} --ball={} --length {} "
        "--tool-length {} --angles={}{}{}{}",
        machine, test["axis"].get<std::string>(), test["direction"].get<std::string>(),
        test["hold"].get<std::string>(), list_of(test["table_ball_mm"]), test["bar_mm"].dump(),
        test["tool_length_mm"].dump(), list_of(test["angle_deg"]),
        held.empty() ? "" : " --at " + held, errors_of(all["errors_um_urad"]), kSetup));
    ASSERT_FALSE(doc.is_null()) << machine;
    expect_all(doc["reading_um"], test["reading_with_setup_um"], 1.1e-6);
    expect_all(doc["angles_deg"], test["angle_deg"], 1e-12);
    EXPECT_EQ(doc["schema"], "frustum/motion/1");
    EXPECT_TRUE(doc["axes"].contains("X"));
    EXPECT_TRUE(doc.contains("told") && doc.contains("not_told"));
    EXPECT_TRUE(doc["evaluation"]["harmonics_um"].contains("sin2"));
  }
}

TEST_F(MotionSystem, CirclesHaveTheValuesOfTheContract) {
  const json& test = numbers()["plane"].back();
  const json doc = document(fmt::format(
      "circle --machine {} --plane {} --length {} --center={}{}{}",
      test["machine"].get<std::string>(), test["plane"].get<std::string>(), test["bar_mm"].dump(),
      list_of(test["centre_mm"]), errors_of(test["errors"]), kSetup));
  ASSERT_FALSE(doc.is_null());
  EXPECT_EQ(doc["ccw_um"].size(), 3600U);
  EXPECT_EQ(doc["cw_um"].size(), 3600U);
  EXPECT_EQ(doc["angles_deg"].size(), 3600U);
  EXPECT_EQ(doc["told"], json::array({"EC0Y"}));
  const json& evaluation = doc["evaluation"];
  for (const char* name : {"G_ccw_ls", "G_cw_ls", "G_bi_ls", "G_ccw_mz", "G_bi_mz", "D_mean_radial",
                           "F_ccw_max", "F_ccw_min", "F_cw_max", "F_cw_min"}) {
    EXPECT_NEAR(evaluation[name].get<double>(), test[name].get<double>(), 1.1e-6) << name;
  }
  EXPECT_TRUE(evaluation.contains("G_cw_mz"));
  for (const auto& [name, value] : test["signature"].items()) {
    EXPECT_NEAR(evaluation["signature"][name].get<double>(), value.get<double>(), 1.1e-6) << name;
    EXPECT_TRUE(evaluation["signature_sd"].contains(name));
  }
  for (const auto& [name, value] : test["contribution_um"].items()) {
    EXPECT_NEAR(evaluation["contribution_um"][name].get<double>(), value.get<double>(), 1.1e-6);
  }
}

TEST_F(MotionSystem, ChasesConesAndDiagonals) {
  const json& chase = numbers()["rtest"]["zx-yac"];
  std::string poses;
  for (const json& pose : chase["tilt_C_deg"]) {
    poses += fmt::format("{}A={},C={}", poses.empty() ? "" : ";", pose[0].dump(), pose[1].dump());
  }
  const json r =
      document("chase --machine zx-yac --ball=" + list_of(chase["table_ball_mm"]) + " --at \"" +
               poses + "\"" + errors_of(numbers()["rotary"]["zx-yac"]["errors_um_urad"]));
  ASSERT_FALSE(r.is_null());
  for (std::size_t i = 0; i < r["displacement_um"].size(); ++i) {
    expect_all(r["displacement_um"][i], chase["displacement_table_frame_um"][i], 1.1e-6);
  }
  const json known =
      document("chase --machine zx-yac --ball=100,0,100 --at \"" + poses + "\" --ball-known");
  EXPECT_EQ(r["told"].size(), 8U);
  EXPECT_EQ(known["told"].size(), 11U);
  const json cone = document(
      "cone --machine iwf-bc --cone-angle 45 --inclination 30 --radius 40 --center=-65,0,150 "
      "--sense radial --error EX0C=10um");
  ASSERT_FALSE(cone.is_null());
  EXPECT_NEAR(cone["evaluation"]["form_um"].get<double>(), 0.9159, 5e-4);
  const json& box = numbers()["diagonals"][2];
  const json d = document(
      "diagonal --machine iwf-bc --box \"X=-200:200,Y=-150:150,Z=0:300\" "
      "--points 11" +
      errors_of(box["errors"]));
  ASSERT_FALSE(d.is_null());
  for (const auto& [signs, um] : box["last_um"].items()) {
    EXPECT_NEAR(d["diagonals"][signs][10].get<double>(), um.get<double>(), 1.1e-6) << signs;
    EXPECT_EQ(d["diagonals"][signs][0], 0.0);
  }
  const json face = document(
      "diagonal --machine iwf-bc --box \"X=-200:200,Y=-200:200\" "
      "--error EC0Y=20urad");
  ASSERT_FALSE(face.is_null());
  EXPECT_NEAR(
      face["diagonals"]["++"].back().get<double>() - face["diagonals"]["+-"].back().get<double>(),
      -2.0 * 20e-3 * 400.0 * 400.0 / std::hypot(400.0, 400.0), 1e-3);
}

TEST_F(MotionSystem, LinesAndTheirTraces) {
  const json line = document(
      "line --machine zx-yac --axis X --targets=-180,-97,-31,42,111,178 --error "
      "\"EXX=cyclic 4um period 250mm phase -90deg + linear 6um over -180mm..180mm + reversal "
      "3um\"");
  ASSERT_FALSE(line.is_null());
  const json& simulated = numbers()["iso230_2"][2]["computed_um"];
  for (const auto& [name, value] : simulated.items()) {
    if (value.is_array()) {
      expect_all(line["evaluation"][name], value, 1.1e-6);
    } else {
      EXPECT_NEAR(line["evaluation"][name].get<double>(), value.get<double>(), 1.1e-6) << name;
    }
  }
  const json& report = numbers()["iso230_2"][0];
  std::string csv = "run,direction,target_mm,deviation_um\n";
  for (const char* direction : {"up", "down"}) {
    const json& rows = report[fmt::format("deviations_{}_um", direction)];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (std::size_t j = 0; j < rows[i].size(); ++j) {
        csv += fmt::format("{},{},{},{}\n", j + 1, direction, 37 * i, rows[i][j].dump());
      }
    }
  }
  write("l.csv", csv);
  const json trace = document("trace l.csv --axis X");
  ASSERT_FALSE(trace.is_null());
  for (const char* name : {"B", "B_mean", "R", "E", "M", "A"}) {
    EXPECT_NEAR(trace["evaluation"][name].get<double>(), report["computed_um"][name].get<double>(),
                1e-6)
        << name;
  }
}

// What the virtual bar reads is what its trace says, in every variant of a file.
TEST_F(MotionSystem, ATraceSaysWhatTheBarRead) {
  const json bar = document(
      "circle --machine zx-yac --plane YZ --length 100 --center 0,0,150 --error EA0Z=25urad "
      "--error \"EYY=reversal 4um\" --setup \"table_ball=5,3,-2\"");
  ASSERT_FALSE(bar.is_null());
  std::string point = "# plane YZ\nrun,angle_deg,radial_um\n";
  std::string comma = "# plane YZ\n# radius 100\nangle_deg;radial_um;run\n";
  const auto decimal = [](const json& v) {
    std::string text = v.dump();
    if (const auto at = text.find('.'); at != std::string::npos) text[at] = ',';
    return text;
  };
  const auto row = [&](std::size_t i, const char* run) {
    const json& um = bar[run == std::string("ccw") ? "ccw_um" : "cw_um"][i];
    point += fmt::format("{},{},{}\n", run, bar["angles_deg"][i].dump(), um.dump());
    comma += fmt::format("{};{};{}\n", decimal(bar["angles_deg"][i]), decimal(um), run);
  };
  for (std::size_t i = 0; i < 3600; ++i) row(i, "ccw");
  for (std::size_t i = 3600; i-- > 0;) row(i, "cw");
  write("point.csv", point);
  write("comma.csv", comma);
  for (const char* arguments : {"trace point.csv --plane YZ --length 100", "trace comma.csv"}) {
    const json trace = document(arguments);
    ASSERT_FALSE(trace.is_null());
    for (const auto& [name, value] : bar["evaluation"].items()) {
      if (!value.is_number()) continue;
      EXPECT_NEAR(trace["evaluation"][name].get<double>(), value.get<double>(), 1e-9) << name;
    }
    // The shifted table ball adds 0.0014 urad of second order.
    EXPECT_NEAR(trace["evaluation"]["signature"]["square_urad"].get<double>(), 25.0, 2e-3);
    EXPECT_NEAR(trace["evaluation"]["signature"]["backlash_1"].get<double>(), 4.0, 1e-3);
    EXPECT_EQ(trace["not_told"], json::array());
  }
}

TEST_F(MotionSystem, AQuadrantTellsBacklashAndServoOnly) {
  std::string csv = "run,angle_deg,radial_um\n";
  for (int i = 0; i <= 90; ++i) csv += fmt::format("ccw,{},{}\n", i, std::sin(0.1 * i));
  for (int i = 90; i >= 0; --i) csv += fmt::format("cw,{},{}\n", i, std::cos(0.1 * i));
  write("q.csv", csv);
  const json trace = document("trace q.csv --plane XY --length 150");
  ASSERT_FALSE(trace.is_null());
  EXPECT_EQ(trace["told"], json::array({"servo", "backlash_1", "backlash_2"}));
}

TEST_F(MotionSystem, NoiseHasItsStandardDeviationAndItsSeed) {
  const std::string circle = "circle --machine iwf-bc --plane XY --center 0,0,150 --noise 0.3um";
  const json one = document(circle), again = document(circle),
             other = document(circle + " --seed 2");
  EXPECT_EQ(one["ccw_um"], again["ccw_um"]);
  EXPECT_NE(one["ccw_um"], other["ccw_um"]);
  EXPECT_NEAR(one["evaluation"]["residual_rms"].get<double>(), 0.3, 0.015);
  const json coarse = document(circle + " --resolution 0.1um");
  const double steps = coarse["ccw_um"][7].get<double>() / 0.1;
  EXPECT_NEAR(steps, std::round(steps), 1e-9);
}

TEST_F(MotionSystem, RefusesWhatCannotBe) {
  EXPECT_EQ(fault("rotary --machine iwf-bc --axis C --ball=100,0,100 --length 150"),
            "direction-missing");
  EXPECT_EQ(fault("rotary --machine iwf-bc --axis A --direction axial --ball=100,0,100"),
            "unknown-axis");
  EXPECT_EQ(fault("rotary --machine iwf-bc --axis C --direction radiel --ball=100,0,100"),
            "unknown-choice");
  EXPECT_EQ(fault("rotary --machine iwf-bc --axis C --direction axial --hold table --ball=1,0,1"),
            "unknown-choice");
  EXPECT_EQ(fault("rotary --machine iwf-bc --axis C --direction axial --ball=1,0"), "number-count");
  EXPECT_EQ(fault("rotary --machine iwf-bc --axis B --direction radial --ball=100,0,100 "
                  "--angles=0,170"),
            "axis-overtravel");
  EXPECT_EQ(fault("circle --machine iwf-bc --plane XY --length 900 --center=0,0,150"),
            "axis-overtravel");
  EXPECT_EQ(fault("circle --machine iwf-bc --plane XZ --center=0,0,150"), "unknown-choice");
  EXPECT_EQ(fault("circle --machine iwf-bc --plane XY --length -5 --center=0,0,150"),
            "out-of-range");
  EXPECT_EQ(fault("circle --machine iwf-bc --plane XY --center=0,0,150 --at X=5"), "axis-moved");
  EXPECT_EQ(fault("circle --machine iwf-bc --plane XY --center=0,0,150 --setup \"bal=1,2,3\""),
            "unknown-choice");
  EXPECT_EQ(fault("circle --machine iwf-bc --plane XY --center=0,0,150 --noise 3"),
            "wrong-quantity");
  EXPECT_EQ(fault("circle --machine iwf-bc --plane XY --center=0,0,150 --feed 0"), "out-of-range");
  EXPECT_EQ(fault("circle --machine iwf-bc --plane XY --center=0,0,150 --angles=0,x"),
            "not-a-number");
  EXPECT_EQ(fault("circle --machine iwf-bc --plane XY --center=0,0,150 --error \"EXX=linear 8mm\""),
            "stroke-exceeded");
  EXPECT_EQ(fault("cone --machine iwf-bc --cone-angle 95"), "out-of-range");
  EXPECT_EQ(fault("cone --machine iwf-bc --radius 4000"), "axis-overtravel");
  EXPECT_EQ(fault("chase --machine zx-yac --ball 100,0,100 --at \"A=-150,C=0\""),
            "axis-overtravel");
  EXPECT_EQ(fault("line --machine zx-yac --axis X --targets=0,5,5"), "targets-not-increasing");
  EXPECT_EQ(fault("line --machine zx-yac --axis X --targets=0,500"), "axis-overtravel");
  EXPECT_EQ(fault("line --machine zx-yac --axis C --targets=0,5"), "unknown-axis");
  EXPECT_EQ(fault("diagonal --machine iwf-bc --box X=-200:200"), "box-axes");
  EXPECT_EQ(fault("diagonal --machine iwf-bc --box X=-200:200,Y=5:5"), "box-empty");
  EXPECT_EQ(fault("diagonal --machine iwf-bc --box X=-200:200,Y=5"), "box-text");
  write("g.csv", "run,angle_deg,radial_um\nccw,0,0\nccw,1,0\nccw,2,0\nccw,1,0\nccw,0,0\n");
  EXPECT_EQ(fault("trace g.csv --plane XY --length 150"), "angles-fall-back");
  EXPECT_EQ(fault("trace g.csv --plane XY --axis X"), "conflicting-options");
  write("l.csv", "run,angle_deg,radial_um\nccw,0,0\nccw,1,0\nccw,2,0\n");
  EXPECT_EQ(fault("trace l.csv"), "length-unknown");
  EXPECT_EQ(run("motion").exit_code, 2);
  EXPECT_EQ(run("motion circel").exit_code, 2);
}

TEST_F(MotionSystem, WritesPageDocumentAndTrace) {
  const std::string circle =
      "circle --machine iwf-bc --plane XY --center 0,0,150 "
      "--error EC0Y=30urad --out circle";
  const json bar = document(circle);
  ASSERT_FALSE(bar.is_null());
  EXPECT_EQ(json::parse(read(folder_ / "circle/motion.json")), bar);
  EXPECT_NE(read(folder_ / "circle/motion.html").find("class=\"trace dashed"), std::string::npos);
  const json trace = document("trace circle/trace.csv --out again");
  ASSERT_FALSE(trace.is_null());
  EXPECT_NEAR(trace["evaluation"]["G_bi_mz"].get<double>(),
              bar["evaluation"]["G_bi_mz"].get<double>(), 1e-9);
  for (const char* test :
       {"rotary --machine zx-yac --axis C --direction radial --ball 100,0,100",
        "cone --machine iwf-bc", "chase --machine zx-yac --ball 100,0,100 --at \"A=-90;A=0,C=60\"",
        "line --machine zx-yac --axis X --targets=-100,0,100",
        "diagonal --machine iwf-bc --box X=-200:200,Y=-200:200"}) {
    fs::remove_all(folder_ / "out");
    EXPECT_FALSE(document(std::string(test) + " --out out").is_null());
    EXPECT_NE(read(folder_ / "out/motion.html").find("<figure"), std::string::npos) << test;
  }
}

// The file that --out writes gives the same document again.
TEST_F(MotionSystem, RunsATestAgainFromItsFile) {
  const std::string common =
      " --error \"EXX=linear 10um over -200mm..200mm\" --error EX0C=4um --noise 0.2um --seed 3 "
      "--setup \"ball=10,-5,3;table_ball=6,-4,2;length=2\" --out out";
  for (const char* test :
       {"circle --machine iwf-bc --plane ZX --length 100 --center 0,0,150 --feed 1000",
        "rotary --machine zx-yac --axis C --direction radial --ball 100,0,100 --at A=-30 "
        "--angles 0,40,80,120,160,200",
        "cone --machine iwf-bc --cone-angle 45 --inclination 30 --radius 40 --center=-65,0,150 "
        "--sense radial",
        "chase --machine zx-yac --ball 100,0,100 --at \"A=-90,C=5;A=0,C=60\"",
        "line --machine zx-yac --axis X --targets=-100,0.5,100 --runs 3 --at Y=20",
        "diagonal --machine iwf-bc --box X=-200:200,Y=-200:200 --points 5 --at Z=30"}) {
    fs::remove_all(folder_ / "out");
    const json first = document(test + common);
    ASSERT_FALSE(first.is_null()) << test;
    EXPECT_EQ(document("run out/test.toml"), first) << read(folder_ / "out/test.toml");
    const json other = document("run out/test.toml --error EX0C=9um");
    EXPECT_EQ(other["errors"]["EX0C"], "9um");
  }
  const std::string touch =
      "touch --machine ac-probe --errors ibaraki-position-dependent --noise 0.35um --repeat 3 "
      "--setup \"ball=1,2,0;table_ball=300,0,0\" --out out";
  const json first = document(touch);
  EXPECT_EQ(document("run out/test.toml"), first) << read(folder_ / "out/test.toml");
  write("bad.toml", "test = \"circle\"\nmachine = \"iwf-bc\"\nplane = \"XY\"\ncentre = [0,0,1]\n");
  const Outcome bad = run("motion run bad.toml");
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_NE(bad.err.find("bad.toml:4"), std::string::npos) << bad.err;
  EXPECT_NE(bad.err.find("center"), std::string::npos) << bad.err;
}

TEST_F(MotionSystem, AnswersAsItIsAsked) {
  const std::string circle = "motion circle --machine iwf-bc --plane XY --center 0,0,150";
  const Outcome text = run(circle);
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_NE(text.out.find("G minimum zone"), std::string::npos);
  EXPECT_EQ(text.out.find("-0.000"), std::string::npos) << text.out;
  const Outcome quiet = run(circle + " --quiet");
  EXPECT_EQ(quiet.out + quiet.err, "");
  // Too few angles to evaluate: readings with a warning.
  const Outcome few = run(circle + " --angles 10,20,30 --json");
  EXPECT_EQ(few.exit_code, 0);
  EXPECT_EQ(json::parse(few.out)["ccw_um"].size(), 3U);
  EXPECT_NE(few.err.find("warning"), std::string::npos);
}

}  // namespace
}  // namespace frustum
