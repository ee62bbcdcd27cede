// Measured motion tests in a study: frustum identify.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/random.hpp"
#include "tests/app/motion_commands.hpp"
#include "tests/law_count.hpp"

namespace frustum {
namespace {

constexpr std::array kSought{"alpha_AY", "beta_AY", "gamma_AY", "beta_CA",  "dx_AY",  "dy_AY",
                             "dz_AY",    "dy_CA",   "gamma_YX", "alpha_ZY", "beta_ZX"};

class MotionIdentifySystem : public MotionCommands {
 protected:
  // A machine that nobody has seen: um and urad by name.
  static std::map<std::string, double> machine(int number) {
    std::map<std::string, double> errors;
    for (std::size_t k = 0; k < kSought.size(); ++k) {
      const double size = std::string(kSought.at(k)).starts_with("d") ? 10.0 : 30.0;
      errors[kSought.at(k)] =
          size * normal({.seed = 5, .draw = static_cast<std::uint32_t>(number)}, k);
    }
    return errors;
  }
  static std::string errors_of(const std::map<std::string, double>& machine) {
    std::string text;
    for (const auto& [name, value] : machine) {
      text += fmt::format(" --error {}={:.6f}{}", name, value, name[0] == 'd' ? "um" : "urad");
    }
    return text;
  }
  // Runs a virtual test into a folder.
  void measure(const std::string& folder, const std::string& test) const {
    const Outcome outcome = run("motion " + test + " --out " + folder + " --quiet");
    ASSERT_EQ(outcome.exit_code, 0) << test << outcome.err;
  }
  // The trace of a test in another variant of a file.
  void rewrite(const std::string& folder, int variant) const {
    if (variant == 0) return;
    std::istringstream in(read(folder_ / folder / "trace.csv"));
    std::string out, line;
    double time = 0.0;
    bool header = true;
    while (std::getline(in, line)) {
      if (line.starts_with("#")) {
        out += line + "\n";
        continue;
      }
      if (header) {
        header = false;
        out += variant == 1 ? "angle_deg;radial_um\n" : "time_s,radial_mm\n";
        continue;
      }
      const auto comma = line.find(',');
      std::string angle = line.substr(0, comma), reading = line.substr(comma + 1);
      if (variant == 1) {
        for (std::string* each : {&angle, &reading}) {
          if (const auto point = each->find('.'); point != std::string::npos) (*each)[point] = ',';
        }
        out += angle + ";" + reading + "\n";
      } else {
        out += fmt::format("{},{:.9f}\n", time, std::stod(reading) / 1000.0);
        time += 0.01;
      }
    }
    write(folder + "/trace.csv", out);
  }
  [[nodiscard]] json identified(const std::string& study) const {
    const Outcome outcome = run("identify " + study + " --json");
    EXPECT_LE(outcome.exit_code, 1) << outcome.err;
    return outcome.exit_code <= 1 ? json::parse(outcome.out) : json();
  }
  [[nodiscard]] std::string fault_of(const std::string& study) const {
    const Outcome outcome = run("identify " + study + " --json");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    const json doc = json::parse(outcome.out, nullptr, false);
    return doc.is_discarded() ? outcome.err : doc["diagnostics"][0]["id"].get<std::string>();
  }
  static std::string motion(const std::string& name, const std::string& more = "") {
    return fmt::format(
        "[[motion]]\nname = \"{0}\"\ntest = \"{0}/test.toml\"\ntraces = [\"{0}/trace.csv\"]\n{1}\n",
        name, more);
  }
  static json estimate(const json& found, const std::string& name) {
    for (const json& each : found["estimates"]) {
      if (each["name"] == name) return each;
    }
    return {};
  }
};

constexpr const char* kMounted =
    " --setup \"ball=12,-7,5;table_ball=20,-15,10;length=2\" --machine zx-yac --noise 0.3um";

// Bars of machines that were not seen, in three variants of a file.
TEST_F(MotionIdentifySystem, BlindMachinesAreWithinTheirIntervals) {
  int covered = 0, intervals = 0, seed = 0;
  const int machines = proof::law_count(20, 4);
  for (int number = 0; number < machines; ++number) {
    const auto truth = machine(number);
    const std::string common = kMounted + errors_of(truth);
    std::string study = "title = \"blind\"\n";
    for (const char* plane : {"XY", "YZ", "ZX"}) {
      measure(plane, fmt::format("circle --plane {} --length 150 --center 0,0,150 --seed {}{}",
                                 plane, ++seed, common));
      study += motion(plane);
    }
    for (const char* axis : {"C", "A"}) {
      int variant = 0;
      for (const char* direction : {"axial", "radial", "tangential"}) {
        const std::string name = std::string(axis) + direction;
        // From one end of the capture to the other, as a bar that measures times samples it.
        std::string angles;
        if (variant == 2) {
          for (int i = 0; i <= 720; ++i) angles += fmt::format("{}{:g}", i > 0 ? "," : "", 0.5 * i);
        }
        measure(name,
                fmt::format("rotary --axis {} --direction {} --ball 60,80,40 --length 100 "
                            "--seed {}{}{}",
                            axis, direction, ++seed, common,
                            std::string(axis) == "C" && !angles.empty() ? " --angles " + angles
                                                                        : std::string()));
        // A bar measures no angle: of a full turn times are as good.
        rewrite(name, std::string(axis) == "C" ? variant++ : variant++ % 2);
        study += motion(name);
      }
    }
    write("study.toml", study);
    const json found = identified("study.toml");
    ASSERT_FALSE(found.is_null());
    EXPECT_FALSE(found["agreement"]["rejected"]) << number;
    for (const auto& [name, value] : truth) {
      const json each = estimate(found, name);
      if (each["value"].is_null()) continue;
      ++intervals;
      if (value >= each["lower"] && value <= each["upper"]) ++covered;
    }
    // Positions of the first axis are those of the ball with the other sign.
    EXPECT_EQ(found["combinations"].size(), 3U);
    for (const json& each : found["combinations"]) {
      const std::string text = each["text"];
      const double ball = text.ends_with("X") ? 12.0 : text.ends_with("Y") ? -7.0 : 5.0;
      ++intervals;
      const double value = truth.at(text.substr(0, 5)) - ball;
      if (value >= each["lower"] && value <= each["upper"]) ++covered;
    }
  }
  RecordProperty("covered", fmt::format("{} of {}", covered, intervals));
  EXPECT_EQ(intervals, 11 * machines);
  EXPECT_GE(covered, 0.95 * intervals - 4.0 * std::sqrt(0.0475 * intervals));
}

// Bars, an R-test, diagonals and touches in one estimate, the ball known.
TEST_F(MotionIdentifySystem, EveryKindOfTestInOneEstimate) {
  const auto truth = machine(77);
  const std::string common =
      " --machine zx-yac --noise 0.3um --setup \"table_ball=20,-15,10\"" + errors_of(truth);
  measure("XY", "circle --plane XY --center 0,0,150 --seed 1" + common);
  measure("C", "rotary --axis C --direction radial --ball 60,80,40 --length 100 --seed 2" + common);
  measure("R",
          "chase --ball 80,30,60 --seed 3 --at "
          "\"A=-80,C=-90;A=-80,C=0;A=-80,C=90;A=-40,C=-150;A=-40,C=-30;A=-40,C=60;A=0,C=-120;A=0,"
          "C=0;A=0,C=120;A=40,C=-60;A=40,C=30;A=40,C=150\"" +
              common);
  measure("D", "diagonal --box \"X=-200:200,Y=-150:150,Z=0:300\" --points 11 --seed 4" + common);
  measure("T", "touch --seed 5" + common);
  fs::copy_file(folder_ / "T/touches.csv", folder_ / "T/trace.csv");
  std::string study = "title = \"all\"\n";
  for (const char* name : {"XY", "C", "R", "D", "T"}) study += motion(name, "ball = \"exact\"");
  write("study.toml", study);
  const json found = identified("study.toml");
  ASSERT_FALSE(found.is_null());
  EXPECT_TRUE(found["complete"]);
  EXPECT_FALSE(found["agreement"]["rejected"]) << found["agreement"];
  for (const auto& [name, value] : truth) {
    const json each = estimate(found, name);
    ASSERT_TRUE(each["value"].is_number()) << name;
    // Four standard uncertainties.
    EXPECT_NEAR(each["value"].get<double>(), value,
                4.0 * each["standard_uncertainty"].get<double>())
        << name;
    EXPECT_LT(each["standard_uncertainty"].get<double>(), 1.0) << name;
  }
  for (const char* group : {"XY", "C", "R", "D", "T"}) {
    EXPECT_TRUE(found["information_shares"]["gamma_YX"].contains(group)) << group;
  }
}

// A cut part and a bar in one estimate: neither identifies all.
TEST_F(MotionIdentifySystem, PartsBesideTests) {
  const auto truth = machine(78);
  const Outcome made =
      run("program step --machine zx-yac --patterns 1-a,2-a --workpiece 1 --out piece");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Outcome cut = run("run piece/job.toml --json --out cut" + errors_of(truth));
  ASSERT_LE(cut.exit_code, 1) << cut.err;
  measure("XY", "circle --plane XY --center 0,0,150 --seed 1" + (kMounted + errors_of(truth)));
  measure("A", "rotary --axis A --direction radial --ball 60,80,40 --length 100 --seed 2" +
                   (kMounted + errors_of(truth)));
  write("study.toml",
        "[[part]]\nname = \"w1\"\njob = \"piece/job.toml\"\nmeasured = [\"cut/result.json\"]\n"
        "[uncertainty.cmm]\ne0 = \"0.5 um\"\nl_per_um = 600\n" +
            motion("XY") + motion("A"));
  const json found = identified("study.toml");
  ASSERT_FALSE(found.is_null());
  const json squareness = estimate(found, "gamma_YX");
  ASSERT_TRUE(squareness["value"].is_number());
  EXPECT_NEAR(squareness["value"].get<double>(), truth.at("gamma_YX"),
              4.0 * squareness["standard_uncertainty"].get<double>());
  EXPECT_FALSE(found["complete"]);
  EXPECT_FALSE(found["observability"]["null_space"].empty());
  bool has_part = false, has_bar = false;
  for (const json& each : found["residuals"]) {
    has_part = has_part || each["name"] == "1-a.dL";
    has_bar = has_bar || each["name"] == "XY.sin2";
  }
  EXPECT_TRUE(has_part && has_bar);
}

// Table 8 of the machining-test paper: the shipped example.
TEST_F(MotionIdentifySystem, NeglectedSquarenessMakesThePrintedBallBarColumn) {
  const std::string folder = std::string(FRUSTUM_SOURCE_DIR) + "/examples/ballbar/table-8/";
  const json numbers = json::parse(
      std::ifstream(std::string(FRUSTUM_SOURCE_DIR) + "/tests/data/motion_tests.json"))["table_8"];
  const json neglected = identified(folder + "neglected.toml");
  const json measured = identified(folder + "measured.toml");
  constexpr double kUradPerDeg = 1e6 * 3.14159265358979323846 / 180.0;
  const auto shown = [](const json& found, const std::string& name) {
    const double value = estimate(found, name)["value"];
    return name[1] == 'Y' ? value / 1000.0 : value / kUradPerDeg;
  };
  for (const auto& [name, value] :
       numbers["predicted"]["ISO line tilt; A -90..90; six tests"].items()) {
    EXPECT_NEAR(shown(neglected, name), value.get<double>(), name[1] == 'Y' ? 5.1e-6 : 5.1e-5);
  }
  for (const auto& [name, value] : numbers["published_deg_mm"]["machining"].items()) {
    EXPECT_NEAR(shown(measured, name), value.get<double>(), 1e-7) << name;
  }
  EXPECT_TRUE(neglected["agreement"]["rejected"]);
  EXPECT_FALSE(measured["agreement"]["rejected"]);
}

TEST_F(MotionIdentifySystem, TheRTestOfTheExample) {
  const json found = identified(std::string(FRUSTUM_SOURCE_DIR) + "/examples/r-test/study.toml");
  EXPECT_EQ(found["observability"]["rank"], 11);
  EXPECT_NEAR(estimate(found, "EB0C")["value"].get<double>(), 18.0, 4.0);
  EXPECT_FALSE(found["agreement"]["rejected"]);
}

// Which tests to run: planned ones need no traces.
TEST_F(MotionIdentifySystem, DesignChoosesTests) {
  std::string study;
  const auto plan = [&](const std::string& name, const std::string& test) {
    measure(name, test + " --machine zx-yac");
    study += fmt::format(
        "[[motion]]\nname = \"{0}\"\ntest = \"{0}/test.toml\"\nnoise = \"0.3um\"\nball = "
        "\"exact\"\n",
        name);
  };
  plan("XY", "circle --plane XY --center 0,0,150");
  plan("C", "rotary --axis C --direction axial --ball 60,80,40 --length 100");
  plan("A", "rotary --axis A --direction radial --ball 60,80,40 --length 100");
  plan("R",
       "chase --ball 80,30,60 --at \"A=-80,C=0;A=-80,C=90;A=-40,C=-30;A=-40,C=60;A=0,C=-120;"
       "A=0,C=0;A=0,C=120;A=40,C=-60;A=40,C=30;A=40,C=150\"");
  write("plan.toml", study);
  const Outcome outcome = run("design --study plan.toml --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json doc = json::parse(outcome.out);
  EXPECT_EQ(doc["tests"], json::array({"XY", "C", "A", "R"}));
  EXPECT_EQ(doc["smallest"]["tests"], json::array({"R"}));
  EXPECT_LT(doc["smallest"]["standard_deviations"]["dx_AY"].get<double>(), 1.0);
  EXPECT_LT(doc["best_of_size"]["4"]["standard_deviations"]["gamma_YX"].get<double>(),
            doc["smallest"]["standard_deviations"]["gamma_YX"].get<double>());
  EXPECT_EQ(run("design --study plan.toml --limit dx_AY=1nm").exit_code, 1);
  // Of a ball that is known to 30 um no more is known of the position of the first axis.
  const auto with_ball = [&](const std::string& ball) {
    std::string changed = study;
    const std::string exact = "ball = \"exact\"\n";
    for (std::size_t at = 0; (at = changed.find(exact, at)) != std::string::npos;) {
      changed.replace(at, exact.size(), ball);
      at += ball.size();
    }
    return changed;
  };
  write("usual.toml", with_ball("ball = \"one\"\nball_uncertainty = \"30um\"\n"));
  const json known = json::parse(run("design --study usual.toml --json").out);
  EXPECT_NEAR(known["smallest"]["standard_deviations"]["dx_AY"].get<double>(), 30.0, 0.1);
  // Of one that nobody has measured it is not known at all, here as where the tests are evaluated;
  // a study that does not ask for it is answered.
  write("unknown.toml", with_ball(""));
  const Outcome open = run("design --study unknown.toml --json");
  EXPECT_EQ(open.exit_code, 1) << open.err;
  const json none = json::parse(open.out);
  EXPECT_FALSE(none.contains("smallest"));
  EXPECT_TRUE(none["best_of_size"]["4"]["standard_deviations"]["dx_AY"].is_null());
  EXPECT_TRUE(none["best_of_size"]["4"]["standard_deviations"]["beta_AY"].is_number());
  write("unknown.toml", with_ball("") + "[unknown]\nerrors = [\"gamma_YX\"]\n");
  EXPECT_EQ(run("design --study unknown.toml").exit_code, 0);
  write("wrong.toml", with_ball("ball_uncertainty = \"30\"\n"));
  EXPECT_EQ(run("design --study wrong.toml").exit_code, 2);
  write("wrong.toml", with_ball("ball_uncertainty = \"30um\"\n") +
                          "[[motion]]\ntest = \"XY/test.toml\"\nnoise = \"0.3um\"\n"
                          "ball_uncertainty = \"20um\"\n");
  EXPECT_EQ(run("design --study wrong.toml").exit_code, 2);
  EXPECT_EQ(run("design --study plan.toml --require Q").exit_code, 2);
  EXPECT_EQ(run("design").exit_code, 2);
}

TEST_F(MotionIdentifySystem, RefusesWhatCannotBeIdentified) {
  measure("XY", "circle --plane XY --center 0,0,150 --seed 1" + std::string(kMounted));
  measure("L", "line --axis X --targets=-100,0,100 --machine zx-yac --noise 0.3um");
  write("L/trace.csv", "run,direction,target_mm,deviation_um\n");
  const std::string xy = motion("XY");
  write("s.toml", xy + "[unknown]\nerrors = [\"beta_CA\"]\n");
  EXPECT_EQ(fault_of("s.toml"), "squareness-not-said");
  write("s.toml", xy + "[unknown]\nerrors = [\"beta_CA\"]\n[known]\nEC0Y = \"5 urad\"\n");
  EXPECT_NE(identified("s.toml"), json());
  write("s.toml", motion("L"));
  EXPECT_EQ(fault_of("s.toml"), "line-in-study");
  write("s.toml", "[[motion]]\ntest = \"XY/test.toml\"\n");
  EXPECT_EQ(fault_of("s.toml"), "nothing-measured");
  write("s.toml", "[[motion]]\ntest = \"XY/test.toml\"\nnoise = \"0.3um\"\n");
  EXPECT_EQ(run("identify s.toml").err.find("unknown key"), std::string::npos);
  write("s.toml", "[[motion]]\ntest = \"XY/no.toml\"\ntraces = [\"XY/trace.csv\"]\n");
  EXPECT_EQ(fault_of("s.toml"), "file-unreadable");
  write("s.toml", xy + "nois = \"1um\"\n");
  EXPECT_EQ(fault_of("s.toml"), "unknown-key");
  for (const char* noise : {"0.2", "\"0.2\"", "\"0um\"", "\"5urad\""}) {
    write("s.toml", xy + "noise = " + noise + "\n");
    EXPECT_EQ(run("identify s.toml").exit_code, 2) << noise;
  }
  write("s.toml", xy);
  EXPECT_EQ(run("design --study s.toml --raise 9").exit_code, 2);
  EXPECT_EQ(run("motion trace XY/trace.csv --stroke nan").exit_code, 2);
  measure("B", "circle --plane XY --center 0,0,150 --machine iwf-bc --noise 0.3um");
  write("s.toml", xy + motion("B"));
  EXPECT_EQ(fault_of("s.toml"), "different-machines");
  measure("R", "chase --ball 80,30,60 --at \"A=0,C=0;A=0,C=90\" --machine zx-yac");
  write("s.toml", motion("R"));
  EXPECT_EQ(fault_of("s.toml"), "no-uncertainty");
}

}  // namespace
}  // namespace frustum
