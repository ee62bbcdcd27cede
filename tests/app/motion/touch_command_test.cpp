// frustum motion touch as users and scripts see it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/pose.hpp"
#include "core/units.hpp"
#include "tests/app/motion_commands.hpp"

namespace frustum {
namespace {

class TouchSystem : public MotionCommands {};

// The maps of the shipped error file, as computed apart.
TEST_F(TouchSystem, TouchesIdentifyTheMapsOfAAndC) {
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
TEST_F(TouchSystem, MeasuredTouchesAreIdentifiedAlike) {
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
TEST_F(TouchSystem, TheProbingProgramLogsTouches) {
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

// What a line of a program says of an axis, X+3.
std::optional<double> word_of(const std::string& line, const std::string& axis) {
  const auto at = line.find(" " + axis);
  if (at == std::string::npos) return std::nullopt;
  return std::stod(line.substr(at + 1 + axis.size()));
}

// The programs of the other controls touch what that of LinuxCNC touches.
TEST_F(TouchSystem, TheProbingProgramsOfFourControls) {
  document("touch --machine zx-yac --noise 0.35um --out out");
  struct Control {
    const char* file;
    const char* probe;
    const char* relative;  // before the axes of the way of the probe; empty: its end
  };
  std::vector<std::vector<Vec3>> ends;
  std::vector<Vec3> starts;  // of Fanuc's probes
  for (const Control& control :
       {Control{"touch.ngc", "G38.2", ""}, Control{"touch.nc", "G31", ""},
        Control{"touch.mpf", "MEAS=1 G1", ""}, Control{"touch.h", "TCH PROBE 4.2", "I"}}) {
    std::istringstream lines(read(folder_ / "out" / control.file));
    std::vector<Vec3> found;
    Vec3 at = Vec3::Zero();
    for (std::string line; std::getline(lines, line);) {
      const bool probes = line.find(control.probe) != std::string::npos;
      const std::string relative = probes ? control.relative : "";
      Vec3 to = at;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const std::string axis = relative + "XYZ"[k];
        if (line.find("DPRNT") != std::string::npos || line.find("LOG") != std::string::npos ||
            line.find("WRITE") != std::string::npos || line.find("TOOL CALL") != std::string::npos)
          continue;
        if (const auto value = word_of(line, axis)) to[k] = *value + (relative.empty() ? 0 : at[k]);
      }
      if (probes) found.push_back(to);
      if (probes && ends.size() == 1) starts.push_back(at);
      if (!probes) at = to;
    }
    EXPECT_EQ(found.size(), 219U) << control.file;
    ends.push_back(std::move(found));
  }
  for (std::size_t c = 1; c < ends.size(); ++c) {
    ASSERT_EQ(ends[c].size(), ends[0].size());
    for (std::size_t i = 0; i < ends[c].size(); ++i) {
      EXPECT_LT((ends[c][i] - ends[0][i]).norm(), 3e-6) << c << ", touch " << i;
    }
  }
  // What DPRNT writes of touches at their nominal places is read again.
  std::istringstream lines(read(folder_ / "out/touch.nc"));
  std::string printed = "A C POINT BALLX BALLY BALLZ\n";
  std::size_t touch = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("DPRNT[") || line.find('#') == std::string::npos) continue;
    std::string places = line.substr(6, line.find('#') - 6);
    std::ranges::replace(places, '*', ' ');
    const Vec3 ball = ends[1][touch] + (starts[touch] - ends[1][touch]) / 2.0;
    printed += fmt::format("{}{:.4f} {:.4f} {:.4f}\n", places, ball.x(), ball.y(), ball.z());
    ++touch;
  }
  write("printed.txt", printed);
  const json found = document("trace printed.txt --machine zx-yac");
  ASSERT_FALSE(found.is_null());
  EXPECT_EQ(found["touches"], 219U);
  for (const json& row : found["identified"]["A"]) {
    expect_all(row, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.5);  // of four decimals
  }
  // Those that the parser knows run to their end; MEAS and TCH PROBE 4 it refuses by name.
  for (const char* file : {"touch.ngc", "touch.nc"}) {
    EXPECT_EQ(run(std::string("parse out/") + file + " --canon").exit_code, 0) << file;
  }
}

// Normals of columns at 0 and 180 deg are on lobes of opposite sign, those at 90 deg on none; a
// turn by 60 deg exchanges the signs: the columns seem to be shifted by twice the amplitude along X
// of the table, at every other position of C. What is the same in every direction cancels.
TEST_F(TouchSystem, LobesOfTheProbeShiftTheTable) {
  const json doc = document("touch --machine ac-probe --pretravel 7um --lobe 1um --out out");
  ASSERT_FALSE(doc.is_null());
  EXPECT_EQ(doc["pretravel_um"]["lobe"], 1.0);
  const json& upright = doc["identified"]["poses"][0];
  for (std::size_t j = 0; j < 6; ++j) {
    const double angle = 60.0 * static_cast<double>(j) * kRadPerDeg;
    const double shift = j % 2 == 1 ? 2.0 : 0.0;
    expect_all(upright[j], {shift * std::cos(angle), shift * std::sin(angle), 0.0, 0.0, 0.0, 0.0},
               1e-6);
  }
  // What is opposite for opposite faces is a shift at any pose: nothing is left over to see it by.
  EXPECT_GT(std::abs(doc["identified"]["poses"][2][1][1].get<double>()), 0.1);
  EXPECT_LT(doc["residuals"]["rms_um"].get<double>(), 1e-6);
  const json none = document("touch --machine ac-probe --pretravel 7um");
  EXPECT_LT(none["residuals"]["rms_um"].get<double>(), 1e-6);
  const Outcome again = run("motion run out/test.toml --json");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(json::parse(again.out)["identified"], doc["identified"]);
  EXPECT_EQ(fault("touch --machine ac-probe --lobe 3"), "wrong-quantity");
}

// Three R-tests identify the maps that touches do, and write them as errors.
TEST_F(TouchSystem, RTestsWithThreeBallsMakeTheSameMaps) {
  const std::string machine = "--machine ac-probe --errors ibaraki-position-dependent";
  const json touched = document("touch " + machine);
  std::string files;
  for (const char* ball : {"100,0,60", "-80,90,40", "-20,-110,80"}) {
    const std::string out = fmt::format("b{}", files.size());
    document(fmt::format("chase {} --ball={} --at maps --out {} --setup \"table_ball=30,-20,10\"",
                         machine, ball, out));
    files += out + "/trace.csv ";
  }
  const json found = document("trace " + files +
                              "--machine ac-probe --noise 0.2um --out maps --balls "
                              "\"100,0,60;-80,90,40;-20,-110,80\"");
  ASSERT_FALSE(found.is_null());
  // Second order of both, and the balls are off by 37 um.
  for (std::size_t i = 0; i < 4; ++i) {
    expect_all(found["identified"]["A"][i], touched["visible"]["A"][i], 0.01);
    for (std::size_t j = 0; j < 6; ++j) {
      expect_all(found["identified"]["C"][i][j], touched["visible"]["C"][i][j], 0.01);
    }
  }
  EXPECT_GT(found["sd"]["A"][1][0].get<double>(), 0.01);
  // As errors of a machine they are what was identified.
  const json again = document("touch --machine ac-probe --errors maps/errors.toml");
  for (std::size_t i = 0; i < 4; ++i) {
    expect_all(again["identified"]["A"][i], touched["visible"]["A"][i], 0.01);
  }
  EXPECT_EQ(fault("trace " + files + "--machine ac-probe --balls \"0,0,0;10,0,0;20,0,0\""),
            "balls-in-line");
}

// The lines of the axes as a control asks for them.
TEST_F(TouchSystem, VectorsOfTheRotaryAxes) {
  const json found = document("vectors --machine zx-yac --error EX0C=10um --error EB0C=20urad");
  ASSERT_FALSE(found.is_null());
  const json& c = found["vectors"]["C"];
  EXPECT_EQ(c["side"], "table");
  EXPECT_NEAR(c["point_off_um"][0].get<double>(), 10.0, 1e-3);
  EXPECT_NEAR(c["direction_off_urad"][0].get<double>(), 20.0, 1e-6);
  EXPECT_EQ(fault("vectors --machine three-axis"), "no-rotary-axis");
  // Errors of motion are not in them.
  const std::string remarks =
      document("vectors --machine zx-yac --error EXC=10um")["diagnostics"].dump();
  EXPECT_NE(remarks.find("error-not-used"), std::string::npos) << remarks;
}

}  // namespace
}  // namespace frustum
