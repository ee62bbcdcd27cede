// frustum motion as users and scripts see it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/pose.hpp"
#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class MotionSystem : public CommandLine {
 protected:
  json document(const std::string& arguments) const {
    const Outcome outcome = run("motion " + arguments + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << arguments << outcome.err;
    return outcome.exit_code == 0 ? json::parse(outcome.out) : json();
  }
  // The id of the first fault of a command that must be refused.
  std::string fault(const std::string& arguments) const {
    const Outcome outcome = run("motion " + arguments + " --json");
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.out;
    EXPECT_FALSE(outcome.err.empty() && outcome.out.empty()) << arguments;
    const json doc = json::parse(outcome.out, nullptr, false);
    if (doc.is_discarded()) return outcome.err;
    return doc["diagnostics"][0]["id"].get<std::string>();
  }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
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

void expect_all(const json& found, const json& expected, double within) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(found[i].get<double>(), expected[i].get<double>(), within) << i;
  }
}

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

// The maps of the shipped error file, as computed apart.
TEST_F(MotionSystem, TouchesIdentifyTheMapsOfAAndC) {
  const json expected = json::parse(
      std::ifstream(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/touch_probing.json"));
  const std::string touch = "touch --machine ac-probe --errors ibaraki-position-dependent";
  const auto expect_maps = [](const json& found, const json& a, const json& c, double within) {
    for (std::size_t i = 0; i < 4; ++i) {
      expect_all(found["A"][i], a[i], within);
      for (std::size_t j = 0; j < 6; ++j) expect_all(found["C"][i][j], c[i][j], within);
    }
  };
  const json doc = document(touch + " --out touch");
  ASSERT_FALSE(doc.is_null());
  const json& maps = expected["identified_gauge_fixed"];
  expect_maps(doc["identified"], maps["A"], maps["C"], 2e-6);
  expect_all(doc["identified"]["poses"][3][2], maps["poses"][3][2], 2e-6);
  EXPECT_EQ(doc["touches"], 219);
  EXPECT_EQ(doc["A_deg"], expected["A_deg"]);
  EXPECT_EQ(doc["C_deg"], expected["C_deg"]);
  EXPECT_EQ(doc["sd"]["A"][2], json::array({0.0, 0.0, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_LT(doc["largest_difference"]["um"].get<double>(), 2e-4);
  EXPECT_LT(doc["largest_difference"]["urad"].get<double>(), 5e-4);
  // The maps are errors like any others, and are found again.
  const json again = document("touch --machine ac-probe --errors touch/errors.toml");
  expect_maps(again["identified"], maps["A"], maps["C"], 0.001);
  EXPECT_NE(read(folder_ / "touch/motion.html").find("EBC, at each position of A"),
            std::string::npos);

  const json noisy = document(touch + " --noise 0.35um --seed 5 --repeat 500");
  expect_maps(noisy["sd"], expected["sd_A_analytic"], expected["sd_C_analytic"], 1e-6);
  EXPECT_NEAR(noisy["scatter"]["A"][1][0].get<double>() / noisy["sd"]["A"][1][0].get<double>(), 1.0,
              0.15);
  EXPECT_EQ(document(touch + " --noise 0.35um --seed 5")["identified"], noisy["identified"]);
  EXPECT_NE(document(touch + " --noise 0.35um --seed 6")["identified"], noisy["identified"]);

  const Outcome text = run("motion " + touch + " --noise 0.35um");
  EXPECT_NE(text.out.find("219 touches"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("A -30, C 300"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("-0.000 "), std::string::npos) << text.out;

  EXPECT_EQ(fault("touch --machine iwf-bc"), "machine-unsuited");
  EXPECT_EQ(fault("touch --machine ac-probe --error EX0C=20mm"), "touch-missed");
  EXPECT_EQ(fault("touch --machine ac-probe --tool-length 700"), "axis-overtravel");
  EXPECT_EQ(fault("touch --machine ac-probe --setup length=5"), "setup-without-effect");
  EXPECT_EQ(fault("touch --machine ac-probe --noise 3"), "wrong-quantity");
  EXPECT_EQ(run("motion touch --machine ac-probe --repeat 0").exit_code, 2);
}

// Touches as a machine reports them, in any order, with points or commas.
TEST_F(MotionSystem, MeasuredTouchesAreIdentifiedAlike) {
  for (const char* machine : {"ac-probe", "zx-yac"}) {
    fs::remove_all(folder_ / "out");
    const json virtual_one = document(fmt::format(
        "touch --machine {} --error EX0C=5um --error EB0A=9urad --error \"EYC=harmonic 1 3um\" "
        "--noise 0.35um --seed 9 --out out",
        machine));
    const std::string trace = fmt::format(" --machine {} --noise 0.35um", machine);
    const json measured = document("trace out/touches.csv" + trace);
    ASSERT_FALSE(measured.is_null());
    for (std::size_t j = 0; j < 6; ++j) {
      expect_all(measured["identified"]["C"][2][j], virtual_one["identified"]["C"][2][j], 1e-4);
    }
    EXPECT_EQ(measured["sd"], virtual_one["sd"]);
    EXPECT_FALSE(measured.contains("visible"));
    std::istringstream csv(read(folder_ / "out/touches.csv"));
    std::string header, rows;
    std::getline(csv, header);
    for (std::string line; std::getline(csv, line);) rows.insert(0, line + "\n");
    std::string commas = header + "\n" + rows;
    std::ranges::replace(commas, ',', ';');
    std::ranges::replace(commas, '.', ',');
    write("commas.csv", commas);
    EXPECT_EQ(document("trace commas.csv" + trace)["identified"], measured["identified"]);
  }
  const std::string csv = read(folder_ / "out/touches.csv");
  const std::string row =
      csv.substr(csv.find('\n') + 1, csv.find('\n', csv.find('\n') + 1) - csv.find('\n'));
  const auto refused = [&](const std::string& text) {
    write("bad.csv", text);
    return fault("trace bad.csv --machine zx-yac");
  };
  EXPECT_EQ(refused(csv + row), "given-twice");
  EXPECT_EQ(refused(csv + "45,0,3,0,0,0\n"), "touch-unplanned");
  EXPECT_EQ(refused("A_deg,C_deg,point,x_mm,y_mm,z_mm\n0,0,0,-0.125,-0.075,0.07\n"), "touch-far");
  EXPECT_EQ(refused("A_deg,C_deg,point,x_mm,y_mm,z_mm\n" + row), "touch-missing");
  EXPECT_EQ(refused("A_deg,C_deg,point,x_mm,y_mm\n0,0,0,1,2\n"), "missing-column");
  EXPECT_EQ(fault("trace bad.csv --machine zx-yac --plane XY"), "conflicting-options");
  EXPECT_EQ(fault("trace bad.csv --noise 1um"), "conflicting-options");
}

// The program goes to the planned touches; what it logs is a file of measured touches.
TEST_F(MotionSystem, TheProbingProgramLogsTouches) {
  for (const char* machine : {"ac-probe", "zx-yac"}) {
    fs::remove_all(folder_ / "out");
    document(fmt::format("touch --machine {} --out out", machine));
    const Outcome parsed = run("parse out/touch.ngc --dialect linuxcnc --canon");
    ASSERT_EQ(parsed.exit_code, 0) << parsed.err;
    std::istringstream lines(parsed.out);
    std::string csv;
    json before;
    Vec3 middle = Vec3::Zero();
    std::size_t touches = 0;
    for (std::string line; std::getline(lines, line);) {
      const json motion = json::parse(line);
      const auto place = [](const json& end) {
        return Vec3(end["X"].get<double>(), end["Y"].get<double>(), end["Z"].get<double>());
      };
      if (motion["type"] == "probe") {
        // The ball meets the surface half way.
        middle = (place(before["end"]) + place(motion["end"])) / 2.0;
        EXPECT_NEAR((place(before["end"]) - place(motion["end"])).norm(), 20.0, 1e-5);
        EXPECT_EQ(before["end"].value("A", 0.0), motion["end"].value("A", 0.0));
        ++touches;
      }
      if (motion["type"] == "event" && motion["name"] == "log") {
        const std::string text = motion["text"];
        std::size_t end = 0;
        for (int k = 0; k < 3; ++k) end = text.find(',', end) + 1;
        csv += touches == 0 ? text + "\n"
                            : fmt::format("{}{},{},{}\n", text.substr(0, end), middle.x(),
                                          middle.y(), middle.z());
      }
      before = motion;
    }
    EXPECT_EQ(touches, 219U);
    write("log.csv", csv);
    const json found = document(fmt::format("trace log.csv --machine {}", machine));
    ASSERT_FALSE(found.is_null());
    for (const json& row : found["identified"]["A"]) {
      expect_all(row, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.02);
    }
    // Nothing but that no part is there to be touched.
    const Outcome checked = run(fmt::format("check out/touch.ngc --machine {}", machine));
    EXPECT_NE(checked.out.find("the probe meets nothing"), std::string::npos) << checked.out;
    EXPECT_NE(checked.out.find("1 error, 0 warnings"), std::string::npos) << checked.out;
  }
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
