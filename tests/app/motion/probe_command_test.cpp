// frustum motion probe: a cut part on the machine that cut it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/app/motion_commands.hpp"

namespace frustum {
namespace {

constexpr double kBoss = 20.0, kCutter = 3.0;  // mm, radii

class ProbeSystem : public MotionCommands {
 protected:
  // A boss of radius 20 on a machine without rotary axes, cut by a ball whose centre goes round at
  // z = -7, and probed there.
  void write_boss(double ball_diameter) const {
    write("boss.nc",
          "%\nO1\nG21 G90 G17\nT1 M6\nS5000 M3\nG54 G43 H1\nG0 X30. Y0. Z5.\nZ-10.\nG1 X23. F500\n"
          "G3 X23. Y0. I-23. J0.\nG1 X30.\nG0 Z5.\nM30\n%\n");
    write("boss.plan.toml",
          fmt::format("title = \"Boss\"\nalignment = \"plan\"\n[probe]\nball_diameter = {}\n"
                      "clearance = 1\nreach = 1\n[[feature]]\nname = \"boss\"\nkind = \"circle\"\n"
                      "point = [0, 0, -7]\naxis = [0, 0, 1]\nradius = 20\nside = \"outside\"\n"
                      "strategy = {{ sections = [0], points_per_section = 72, start_angle = 0, "
                      "sweep = 360 }}\n[[characteristic]]\nname = \"boss.roundness\"\nkind = "
                      "\"roundness\"\nfeature = \"boss\"\nsection = 0\ntolerance = \"100 um\"\n"
                      "[[characteristic]]\nname = \"boss.radius\"\nkind = \"radius\"\nfeature = "
                      "\"boss\"\ntolerance = \"100 um\"\n",
                      ball_diameter));
    write(
        "boss.toml",
        "title = \"Boss\"\nmachine = \"three-axis\"\nprogram = { file = \"boss.nc\", dialect = "
        "\"fanuc\" }\nblank = { shape = \"cylinder\", diameter = 50, height = 30, origin = [0, 0, "
        "-30] }\ntool.1 = { type = \"ball\", diameter = 6, length = 100, flute_length = 30 }\n"
        "[inspection]\nplan = \"boss.plan.toml\"\n");
  }
  static json characteristic(const json& doc, const std::string& name) {
    for (const json& each : doc["characteristics"]) {
      if (each["name"] == name) return each;
    }
    return {};
  }
  static double gain(const json& doc, const char* where, const std::string& name,
                     const std::string& error) {
    const json& gains = doc["gains"];
    const auto place = [](const json& list, const std::string& wanted) {
      return static_cast<std::size_t>(std::ranges::find(list, json(wanted)) - list.begin());
    };
    return gains[where][place(gains["characteristics"], name)][place(gains["errors"], error)];
  }
  static bool holds(const json& list, const std::string& name) {
    return std::ranges::find(list, json(name)) != list.end();
  }
};

// A circle of tool centres of radius r about an axis of squareness c is an ellipse that is c r out
// of round. The probe makes the same ellipse of its own circle of centres: the difference of both
// balls is left.
TEST_F(ProbeSystem, SquarenessShowsOnTheCmmAlone) {
  constexpr double kSquareness = 100e-6;
  for (const double ball : {6.0, 2.0}) {
    write_boss(ball);
    const json doc = document("probe boss.toml --error EC0Y=100urad --tool-length 97");
    ASSERT_FALSE(doc.is_null());
    const json roundness = characteristic(doc, "boss.roundness");
    EXPECT_NEAR(roundness["on_cmm"].get<double>(), kSquareness * (kBoss + kCutter) * 1e3, 0.02);
    EXPECT_NEAR(roundness["on_machine"].get<double>(),
                kSquareness * std::abs(kCutter - 0.5 * ball) * 1e3, 0.02);
    EXPECT_NEAR(roundness["difference"].get<double>(),
                roundness["on_machine"].get<double>() - roundness["on_cmm"].get<double>(), 1e-12);
    // The same as first-order gains: um per urad.
    EXPECT_NEAR(gain(doc, "on_cmm", "boss.roundness", "EC0Y"), 1e-3 * (kBoss + kCutter), 2e-4);
    EXPECT_NEAR(gain(doc, "on_machine", "boss.roundness", "EC0Y"),
                1e-3 * std::abs(kCutter - 0.5 * ball), 2e-4);
    // Below 5 % it cancels: with a ball of the cutter's radius, not with one of 1 mm.
    EXPECT_EQ(holds(doc["cancel"], "EC0Y"), ball == 6.0);
    EXPECT_TRUE(holds(doc["stay"], "tool_radius_error"));
    // The tool's radius is of the part, wherever it is measured.
    EXPECT_NEAR(gain(doc, "on_machine", "boss.radius", "tool_radius_error"), 1.0, 1e-6);
    EXPECT_EQ(doc["touches"], 72);
    EXPECT_EQ(doc["reading_um"].size(), 72U);
  }
}

// A point probed at the axis positions at which it was cut, by a ball where the cutter's was, reads
// what is programmed, whatever the errors.
TEST_F(ProbeSystem, NothingShowsWhereCutterAndProbeAreAlike) {
  write_boss(6.0);
  const std::string errors =
      " --error \"EXX=linear 60um + harmonic 3 12um over -30mm..30mm\" --error \"EYX=harmonic 2 "
      "15um "
      "over -30mm..30mm\" --error \"EZX=linear 40um\" --error \"EAX=linear 300urad\" --error "
      "\"EBX=harmonic 1 200urad over -30mm..30mm\" --error \"ECX=linear 250urad\" --error "
      "\"EYY=harmonic 4 9um over -30mm..30mm\" --error \"EXY=linear 35um\" --error \"ECY=linear "
      "150urad\" --error EC0Y=120urad --error EA0Z=80urad --error EB0Z=-60urad";
  const json doc = document("probe boss.toml --tool-length 97" + errors);
  ASSERT_FALSE(doc.is_null());
  EXPECT_GT(characteristic(doc, "boss.roundness")["on_cmm"].get<double>(), 5.0);
  // The path's own bound is 0.01 um.
  EXPECT_LT(characteristic(doc, "boss.roundness")["on_machine"].get<double>(), 0.03);
  for (const json& reading : doc["reading_um"]) EXPECT_LT(std::abs(reading.get<double>()), 0.02);
  for (const char* error : {"EC0Y", "EXX linear", "EYY linear", "EYX linear"}) {
    EXPECT_TRUE(holds(doc["cancel"], error)) << error;
  }
  // Without the option the probe is as long as the tool, 3 mm longer: on this machine, where X and
  // Y move the work, that is no difference either.
  EXPECT_LT(characteristic(document("probe boss.toml" + errors), "boss.roundness")["on_machine"]
                .get<double>(),
            0.03);
}

// On a table that turns while the part is cut and stands while it is probed.
TEST_F(ProbeSystem, RotaryErrorsStayWhereTheTableStands) {
  const Outcome made =
      run("program cone --machine iwf-bc --cone-angle 45 --inclination 30 --radius 40 "
          "--center=-65,0,150 --out cone");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json doc = document("probe cone/job.toml --error EX0C=10um --out probed");
  ASSERT_FALSE(doc.is_null());
  // The workpiece is upright on the tilted table.
  EXPECT_NEAR(std::abs(doc["poses"][0]["B"].get<double>()), 30.0, 1e-9);
  EXPECT_NEAR(doc["poses"][0]["C"].get<double>(), 0.0, 1e-9);
  // Where axes stand, an error of their place shifts the whole part.
  const json form = characteristic(doc, "cone.equivalent_form");
  EXPECT_GT(form["on_cmm"].get<double>(), 1.0);
  EXPECT_NEAR(form["on_machine"].get<double>(), form["on_cmm"].get<double>(), 0.01);
  EXPECT_NEAR(gain(doc, "on_machine", "cone.equivalent_form", "EX0C"),
              gain(doc, "on_cmm", "cone.equivalent_form", "EX0C"), 1e-4);
  EXPECT_FALSE(holds(doc["cancel"], "EX0C"));
  // Program for four controls; the two that the parser reads make all touches.
  for (const char* file : {"probe.ngc", "probe.nc"}) {
    const Outcome parsed = run(std::string("parse probed/") + file + " --canon");
    ASSERT_EQ(parsed.exit_code, 0) << file << parsed.err;
    std::size_t probes = 0;
    for (std::size_t at = 0; (at = parsed.out.find("\"type\":\"probe\"", at)) != std::string::npos;
         ++at) {
      ++probes;
    }
    EXPECT_EQ(probes, doc["touches"].get<std::size_t>()) << file;
  }
  // The blank comes up to Z 28 of the program while the table turns from where it is level.
  const std::string fanuc = read(folder_ / "probed/probe.nc");
  const std::size_t first = fanuc.find("G0 Z");
  ASSERT_NE(first, std::string::npos);
  EXPECT_GT(std::stod(fanuc.substr(first + 4)), 28.0 + 10.0);
  EXPECT_LT(first, fanuc.find("G0 B"));
  EXPECT_LT(fanuc.find("G0 B"), fanuc.find("G0 X"));
  EXPECT_NE(read(folder_ / "probed/probe.ngc").find("T1 M6\nG43 H1\n"), std::string::npos);
  for (const char* file : {"probe.mpf", "probe.h", "probe.a", "touches.csv", "points.csv",
                           "motion.json", "motion.html"}) {
    EXPECT_TRUE(fs::exists(folder_ / "probed" / file)) << file;
  }
  EXPECT_NE(read(folder_ / "probed/motion.html").find("What becomes of each error"),
            std::string::npos);
}

// Squareness of X and Y at the cone: first-order sum over its points, by hand. The tip is shifted
// by -c y along X of the bed, at the cut and at the touch alike; what it was at the cut is turned
// back with the table.
TEST_F(ProbeSystem, SquarenessOnTheConeIsWhatTheTableTurnsAway) {
  const Outcome made =
      run("program cone --machine iwf-bc --cone-angle 45 --inclination 30 --radius 40 "
          "--center=-65,0,150 --out cone");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json none = document("probe cone/job.toml");
  const json doc = document("probe cone/job.toml --error EC0Y=100urad");
  ASSERT_FALSE(doc.is_null());
  const json form = characteristic(doc, "cone.equivalent_form");
  const double there = form["on_cmm"].get<double>(), here = form["on_machine"].get<double>();
  // 0.975 um for 30 urad on the CMM (cone tests of the reference numbers).
  EXPECT_NEAR(there, 0.975 * 100.0 / 30.0, 0.05);
  // The sum over the path of the tip, computed apart: 3.232 and 2.046 um, in first order and
  // without the facets of the program.
  EXPECT_NEAR(there, 3.232, 0.04);
  EXPECT_NEAR(here, 2.046, 0.04);
  // First order: what is shown is what the gains say.
  EXPECT_NEAR(here, 100.0 * gain(doc, "on_machine", "cone.equivalent_form", "EC0Y"), 0.02 * here);
  EXPECT_NEAR(there, 100.0 * gain(doc, "on_cmm", "cone.equivalent_form", "EC0Y"), 0.02 * there);
  EXPECT_LT(characteristic(none, "cone.equivalent_form")["on_machine"].get<double>(), 0.05);
}

TEST_F(ProbeSystem, ALogOfTheProgramIsEvaluatedAlike) {
  write_boss(6.0);
  const std::string command = "probe boss.toml --error EC0Y=100urad --tool-length 147";
  const json simulated = document(command + " --noise 0.35um --seed 4 --out out");
  const json measured = document(command + " --measured out/touches.csv");
  ASSERT_FALSE(measured.is_null());
  EXPECT_NEAR(characteristic(measured, "boss.roundness")["on_machine"].get<double>(),
              characteristic(simulated, "boss.roundness")["on_machine"].get<double>(), 1e-5);
  // What was given stays as it is; what only simulated touches have is refused.
  const std::string simulated_log = read(folder_ / "out/touches.csv");
  const std::string given = "# of Monday\n" + simulated_log;
  write("out/touches.csv", given);
  EXPECT_FALSE(document(command + " --measured out/touches.csv --out out").is_null());
  EXPECT_EQ(read(folder_ / "out/touches.csv"), given);
  EXPECT_EQ(fault("probe boss.toml --measured out/touches.csv --noise 1um"), "conflicting-options");
  write("out/touches.csv", simulated_log);
  // One touch that lies apart is named.
  std::string apart = given;
  const std::size_t of_five = apart.find("\n5,");
  ASSERT_NE(of_five, std::string::npos);
  const std::size_t x = of_five + 3;
  const double there = std::stod(apart.substr(x));
  apart.replace(x, apart.find(',', x) - x, fmt::format("{:.9f}", there + 0.9));
  write("apart.csv", apart);
  const std::string found = document(command + " --measured apart.csv")["diagnostics"].dump();
  EXPECT_NE(found.find("touch-apart"), std::string::npos) << found;
  EXPECT_NE(found.find("point 5"), std::string::npos) << found;
  // The points are a file for `measure`, too.
  const Outcome evaluated =
      run("measure --plan boss.plan.toml --points out/points.csv --ball-centres --json");
  ASSERT_LE(evaluated.exit_code, 1) << evaluated.err;
  for (const json& each : json::parse(evaluated.out)["characteristics"]) {
    if (each["name"] != "boss.roundness") continue;
    EXPECT_NEAR(each["value"].get<double>(),
                characteristic(simulated, "boss.roundness")["on_machine"].get<double>(), 1e-5);
  }
  // As Fanuc prints it, with four decimals.
  std::istringstream in(read(folder_ / "out/touches.csv"));
  std::string printed = "POINT BALLX BALLY BALLZ\n", line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::ranges::replace(line, ',', ' ');
    printed += line + "\n";
  }
  write("printed.txt", printed);
  EXPECT_NEAR(
      characteristic(document(command + " --measured printed.txt"), "boss.roundness")["on_machine"]
          .get<double>(),
      characteristic(simulated, "boss.roundness")["on_machine"].get<double>(), 1e-5);
  const std::string csv = read(folder_ / "out/touches.csv");
  const std::string header = csv.substr(0, csv.find('\n') + 1);
  const std::string row =
      csv.substr(header.size(), csv.find('\n', header.size()) - header.size() + 1);
  const auto refused = [&](const std::string& text) {
    write("bad.csv", text);
    return fault(command + " --measured bad.csv");
  };
  EXPECT_EQ(refused(csv + row), "given-twice");
  EXPECT_EQ(refused(header + row), "touch-missing");
  EXPECT_EQ(refused(header + "72,0,0,0\n"), "touch-unplanned");
  EXPECT_EQ(refused(header + "0,30,0,-7\n"), "touch-far");
  EXPECT_EQ(refused("point,ball_x_mm,ball_y_mm\n0,1,2\n"), "missing-column");
}

TEST_F(ProbeSystem, RefusesWhatItCannotProbe) {
  write_boss(6.0);
  EXPECT_EQ(fault("probe boss.toml --at C=10"), "unknown-axis");
  EXPECT_EQ(fault("probe boss.toml --at X=10"), "axis-moved");
  EXPECT_EQ(fault("probe boss.toml --setup length=3"), "setup-without-effect");
  EXPECT_EQ(fault("probe boss.toml --tool-length 700"), "axis-overtravel");
  EXPECT_EQ(fault("probe boss.toml --noise 3"), "wrong-quantity");
  EXPECT_EQ(run("motion probe boss.toml --seed -1").exit_code, 2);
  const Outcome made =
      run("program cone --machine iwf-bc --cone-angle 45 --inclination 30 --radius 40 "
          "--center=-65,0,150 --out cone");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(fault("probe cone/job.toml --at B=60,C=0"), "point-unreachable");
}

// A round boss is out of round by twice the amplitude of the probe's three lobes.
TEST_F(ProbeSystem, LobesOfTheProbeAreOutOfRound) {
  write_boss(6.0);
  const json doc = document("probe boss.toml --tool-length 97 --pretravel 5um --lobe 1.5um");
  EXPECT_NEAR(characteristic(doc, "boss.roundness")["on_machine"].get<double>(), 3.0, 0.03);
  EXPECT_LT(characteristic(doc, "boss.roundness")["on_cmm"].get<double>(), 0.03);
}

}  // namespace
}  // namespace frustum
