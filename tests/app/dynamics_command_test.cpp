// frustum dynamics on a shipped machine and on files that are wrong.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class DynamicsCommandSystem : public CommandLine {
 protected:
  json document(const std::string& arguments) const {
    const Outcome outcome = run("dynamics " + arguments + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json::parse(outcome.out, nullptr, false);
  }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  static std::string shipped() {
    return read(fs::path(FRUSTUM_SOURCE_DIR) / "machines" / "iwf-bc.toml");
  }
};

constexpr const char* kPlace = "iwf-bc --axes Z=300 --tool-length 150 ";

TEST_F(DynamicsCommandSystem, AnswersWithTheNumbersAndNamesOfTheReference) {
  const json wanted = json::parse(read(fs::path(FRUSTUM_SOURCE_DIR) / "tests/data/dynamics.json"));
  const json& p1 = wanted["iwf-bc"]["P1"];
  const json found = document(std::string(kPlace) +
                              "--frf 20,57 --circle XY --radius 50 --feed 10000 "
                              "--move X:100:0.5:4:100 --rates X=0.1:1");
  EXPECT_EQ(found["schema"], "frustum/dynamics/1");
  EXPECT_EQ(found["axis_order"], p1["axis_order"]);
  for (const auto& [name, value] : p1.items()) EXPECT_TRUE(found.contains(name)) << name;
  EXPECT_EQ(found["undamped_hz"].size(), 20U);
  EXPECT_NEAR(found["undamped_hz"][0].get<double>(), p1["undamped_hz"][0].get<double>(), 1e-6);
  EXPECT_NEAR(found["frf_um_per_n"]["57"][0][0][1].get<double>(),
              p1["frf_um_per_n"]["57"][0][0][1].get<double>(), 1e-10);
  EXPECT_NEAR(found["circle"]["mean_radial_um"].get<double>(),
              wanted["circle_spring_drives"]["mean_radial_um"].get<double>(), 1e-6);
  EXPECT_EQ(found["jerk_move"]["rows"].size(), 61U);
  EXPECT_FALSE(found.contains("states"));
}

TEST_F(DynamicsCommandSystem, MapsAQuantityOverTwoAxes) {
  const json map =
      document("iwf-bc --tool-length 150 --map Y=-300:300:3,Z=-100:500:4 --quantity Hx/x..")["map"];
  EXPECT_EQ(map["values"].size(), 3U);
  EXPECT_EQ(map["values"][0].size(), 4U);
  EXPECT_EQ(map["rows"], json::parse(R"(["Y", -300.0, 300.0, 3])"));
  EXPECT_NEAR(map["box"]["max"].get<double>(), 102.5865864, 1e-6);
  EXPECT_EQ(map["frequency_range_hz"].size(), 3U);
}

TEST_F(DynamicsCommandSystem, ComparesTheTwoConceptsOfTheThesis) {
  const std::string examples = FRUSTUM_SOURCE_DIR "/examples/dynamics/";
  const json compared =
      document(examples + "cantilever-original.toml --axes Y=800,Z=-400 --compare " + examples +
               "cantilever-alternative.toml")["compare"];
  EXPECT_EQ(compared["rows"][0], "Hx/X");
  EXPECT_NEAR(compared["change_percent"][0].get<double>(), 51.106, 1e-3);
  EXPECT_NEAR(compared["second_um_per_gn"][8].get<double>(), 218.1375271, 1e-6);
}

TEST_F(DynamicsCommandSystem, PrintsATableForPeople) {
  const Outcome outcome = run(std::string("dynamics ") + kPlace);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part : {"38.145", "yields most", "static stiffness N/um, as measured  20.360",
                           "-127.177", "dominant peaks", "0.24533"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  }
}

TEST_F(DynamicsCommandSystem, WritesPageResponsesAndMap) {
  const std::string what = std::string(kPlace) + "--frf 20:60 --map Y=-300:300:3,Z=-100:500:4";
  EXPECT_EQ(run("dynamics " + what + " --out d --quiet").exit_code, 0);
  EXPECT_EQ(json::parse(read(folder_ / "d/dynamics.json")), document(what));
  const std::string page = read(folder_ / "d/report.html");
  for (const char* part : {"Frequency responses of the tip", "Force along z", "Shapes of the modes",
                           "<animate", "Over the working space"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  EXPECT_TRUE(read(folder_ / "d/frf.uff").starts_with("    -1\n    58\n"));
  EXPECT_TRUE(read(folder_ / "d/frf.csv").starts_with("frequency_hz,Gxx_re,Gxx_im,Gyx_re"));
  EXPECT_TRUE(read(folder_ / "d/map.csv").starts_with("Y,Z,|Hx/X..| um/gn\n-300,-100,"));
}

TEST_F(DynamicsCommandSystem, IdentifiesTheMountsOfAnotherMachine) {
  write("m.toml", shipped());
  for (int mount = 0; mount < 4; ++mount) {
    replace_in("m.toml", "stiffness = [600, 600, 450]", "stiffness = [600, 600, 900]");
  }
  EXPECT_EQ(run("dynamics m.toml --axes Z=300 --tool-length 150 --frf 20:160:2 --out d --quiet")
                .exit_code,
            0);
  const json found = document(std::string(kPlace) +
                              "--measured d/frf.uff --identify mount.stiffness.z,mount.damping");
  EXPECT_NEAR(found["identified"]["parameters"][0]["factor"].get<double>(), 2.0, 1e-6);
  EXPECT_NEAR(found["identified"]["parameters"][1]["factor"].get<double>(), 1.0, 1e-6);
  EXPECT_TRUE(found["identified"]["not_separated"].empty());
}

struct Refused {
  const char* arguments;
  const char* told;
};

TEST_F(DynamicsCommandSystem, RefusesWhatIsWrongWithARemedy) {
  constexpr Refused kRefused[] = {
      {"three-axis --axes X=0", "states no masses and springs"},
      {"iwf-bc --axes Q=1", "is not an axis"},
      {"iwf-bc --frf 5:1", "rising"},
      {"iwf-bc --frf x", "not a number"},
      {"iwf-bc --rates X=1", "VELOCITY:ACCELERATION"},
      {"iwf-bc --map Y=0:1:2", "two axes"},
      {"iwf-bc --map Y=0:1:2,Y=0:1:2", "given twice"},
      {"iwf-bc --map Y=0:1:2,Z=0:1:2 --quantity Hq/x", "f1 to f36"},
      {"iwf-bc --map Y=0:1:2,Z=0:1:2.5", "whole number"},
      {"iwf-bc --circle XC --radius 50 --feed 1000", "two linear axes"},
      {"iwf-bc --circle XY --feed 1000", "--radius in mm"},
      {"iwf-bc --move X:100:0:4:100", "limits above 0"},
      {"iwf-bc --move X:100:1e-9:4:100", "takes"},
      {"iwf-bc --tool-length nan", "length in mm"},
      {"iwf-bc --compare three-axis", "states no masses"},
      {"iwf-bc --identify mount.stiffness", "needs --measured"},
      {"iwf-bc --measured none.csv", "none.csv"},
      {"iwf-bc --quantity f1", "--quantity is of --map"},
      {"iwf-bc --radius 50", "--radius is of --circle"},
      {"iwf-bc --feed 50", "--feed is of --circle"},
  };
  for (const Refused& refused : kRefused) {
    const Outcome outcome = run(std::string("dynamics ") + refused.arguments);
    EXPECT_EQ(outcome.exit_code, 2) << refused.arguments;
    EXPECT_NE(outcome.err.find(refused.told), std::string::npos)
        << refused.arguments << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << refused.arguments;
  }
}

TEST_F(DynamicsCommandSystem, NamesKeyAndLineOfAMachineFile) {
  write("m.toml", shipped());
  replace_in("m.toml", "mass = 6200", "mass = -6200");
  const Outcome outcome = run("dynamics m.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("m.toml:140"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("dynamics.body.bed.mass"), std::string::npos) << outcome.err;
}

TEST_F(DynamicsCommandSystem, NamesTheAxisOfAnUnstableControl) {
  const std::string control =
      "[dynamics.axis.C.control]\nkind = \"direct\"\nscale = [0, 0, 0]\nkp = 1500\ntn = 12\nkv = ";
  write("m.toml", shipped() + control + "50\n");
  EXPECT_EQ(document("m.toml --axes Z=300 --frf 1")["states"], 73);
  EXPECT_EQ(run("dynamics m.toml --frf 0").exit_code, 2);
  replace_in("m.toml", "tn = 12\nkv = 50", "tn = 0.5\nkv = 5000");
  const Outcome outcome = run("dynamics m.toml --axes Z=300");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("control of axis C is unstable"), std::string::npos) << outcome.err;
  // The line of its table.
  const std::string text = shipped();
  const auto line = std::ranges::count(text, '\n') + 1;
  EXPECT_NE(outcome.err.find("m.toml:" + std::to_string(line)), std::string::npos) << outcome.err;
}

class DynamicsJobSystem : public DynamicsCommandSystem {
 protected:
  void SetUp() override {
    DynamicsCommandSystem::SetUp();
    ASSERT_EQ(run("program cone --machine iwf-bc --cone-angle 45 --inclination 30 --radius 40 "
                  "--center=-65,0,150 --out c")
                  .exit_code,
              0);
    replace_in("c/job.toml", "report = true", "report = false");
    std::string program = read(folder_ / "c/cone.nc");
    for (auto at = program.find(" F"); at != std::string::npos; at = program.find(" F", at + 1)) {
      if (std::isdigit(static_cast<unsigned char>(program[at + 2])) == 0) continue;  // a comment
      const auto end = program.find_first_of("\r\n ", at + 2);
      program.replace(at, end - at, " F4000");
    }
    write("c/cone.nc", program);
    job_ = read(folder_ / "c/job.toml");
  }
  double form(const std::string& controller) const {
    write("c/job.toml", job_ + "\n[controller]\n" + controller);
    const Outcome outcome = run("run c/job.toml --out c/o --json");
    EXPECT_LT(outcome.exit_code, 2) << outcome.err;
    const json result = json::parse(outcome.out);
    for (const json& c : result["characteristics"]) {
      if (c["name"] == "cone.equivalent_form") return c["value"];
    }
    return 0.0;
  }
  std::string job_;
};

TEST_F(DynamicsJobSystem, TheCutConeHasTheFormOfTheDeviation) {
  const double plain = form("");
  EXPECT_EQ(form("dynamics = \"off\"\n"), plain);
  const double found = form("dynamics = \"quasi_static\"\n");
  std::cout << "cut cone at 4000 mm/min: form " << found << " um, without dynamics " << plain
            << " um\n";
  EXPECT_NEAR(found / 13.205246, 1.0, 0.05);
}

json json_of_job(const Outcome& outcome) { return json::parse(outcome.out, nullptr, false); }

TEST_F(DynamicsJobSystem, SensitivitiesAreThoseOfTheMovingMachine) {
  const auto matrix = [&](const std::string& controller, const std::string& options) {
    write("c/job.toml", job_ + controller);
    const Outcome outcome =
        run("sensitivity c/job.toml --parameter EX0C --parameter EB0C --json " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json_of_job(outcome);
  };
  const std::string moving = "\n[controller]\ndynamics = \"quasi_static\"\n";
  const json still = matrix("", "");
  const json gains = matrix(moving, ""), differences = matrix(moving, "--method differences");
  double apart = 0.0;
  for (std::size_t row = 0; row < gains["matrix"].size(); ++row) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double gain = gains["matrix"][row][k], difference = differences["matrix"][row][k];
      EXPECT_NEAR(gain, difference, 5e-3 + 0.02 * std::abs(difference))
          << gains["characteristics"][row] << " by " << gains["errors"][k];
      apart = std::max(apart, std::abs(gain - still["matrix"][row][k].get<double>()));
    }
  }
  // The form of a perfect cone answers otherwise than that of one with 13 um.
  EXPECT_GT(apart, 0.1);
}

TEST_F(DynamicsJobSystem, CompensationTakesTheDeviationOff) {
  const std::string moving = "\n[controller]\ndynamics = \"quasi_static\"\n";
  write("c/job.toml", job_ + moving);
  const Outcome outcome = run("compensate c/job.toml --error EX0C=20um --out k --json");
  // Where the acceleration jumps, the tool is off by as much as before.
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const json found = json_of_job(outcome);
  std::cout << "before " << found["before"]["tip_um"] << " um, after " << found["after"]["tip_um"]
            << " um\n";
  EXPECT_LT(found["after"]["tip_um"], found["before"]["tip_um"]);
  // Cut and measured on the moving machine.
  const auto form_of = [&](const std::string& job) {
    const Outcome ran = run("run " + job + " --error EX0C=20um --out o --json");
    EXPECT_LT(ran.exit_code, 2) << ran.err;
    const json result = json_of_job(ran);
    for (const json& c : result["characteristics"]) {
      if (c["name"] == "cone.equivalent_form") return c["value"].get<double>();
    }
    return -1.0;
  };
  const double before = form_of("c/job.toml"), after = form_of("k/job.toml");
  std::cout << "form before " << before << " um, after " << after << " um\n";
  EXPECT_GT(before, 10.0);
  EXPECT_LT(after, 0.15 * before);
  write("c/job.toml", job_ + moving + "servo_lag = true\n");
  EXPECT_EQ(run("compensate c/job.toml --out k").exit_code, 2);
}

TEST_F(DynamicsJobSystem, RefusesWhatDoesNotGoTogether) {
  const auto refusal = [&](const std::string& controller) {
    write("c/job.toml", job_ + "\n[controller]\n" + controller);
    const Outcome outcome = run("run c/job.toml --out c/o");
    EXPECT_EQ(outcome.exit_code, 2) << controller;
    return outcome.err;
  };
  using testing::HasSubstr;
  EXPECT_THAT(refusal("dynamics = \"lineer\"\n"), HasSubstr("did you mean linear"));
  EXPECT_THAT(refusal("dynamics = \"linear\"\ndynamics_step = 1\n"), HasSubstr("expected"));
  job_.replace(job_.find("\"iwf-bc\""), 8, "\"m.toml\"");
  const std::string machine = shipped();
  write("c/m.toml", machine + "[dynamics.axis.C.control]\nkind = \"direct\"\nkv = 50\nkp = 1500\n");
  EXPECT_THAT(refusal("dynamics = \"linear\"\nservo_lag = true\n"), HasSubstr("lag themselves"));
  write("c/m.toml", machine.substr(0, machine.find("\n[dynamics]")));
  EXPECT_THAT(refusal("dynamics = \"linear\"\n"), HasSubstr("states no masses and springs"));
}

}  // namespace
}  // namespace frustum
