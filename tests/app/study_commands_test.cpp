// sensitivity, identify and design as users and scripts see them.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class StudyCommandsSystem : public CommandLine {
 protected:
  void write_steps(const std::string& folder, const std::string& more) const {
    const Outcome made = run("program step --machine zx-yac --out " + folder + " " + more);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    replace_in(folder + "/job.toml", "report = true", "report = false");
  }
  // Measures the piece on a machine with errors and keeps the result as `file`.
  void measure(const std::string& piece, const std::string& errors, const std::string& file) const {
    const Outcome measured = run("measure " + piece + "/job.toml --json " + errors);
    ASSERT_LE(measured.exit_code, 1) << measured.err;
    write(file, measured.out);
  }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  static const json* find(const json& list, const std::string& name) {
    for (const json& item : list) {
      if (item["name"] == name) return &item;
    }
    return nullptr;
  }
};

constexpr const char* kCmm = "[uncertainty]\ncmm = { e0 = \"0.5 um\", l_per_um = 600 }\n";

TEST_F(StudyCommandsSystem, TellsTheDerivativeOfEveryCharacteristic) {
  write_steps("piece", "--patterns 1-a");
  const Outcome outcome = run("sensitivity piece/job.toml --json --out tables");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json doc = json::parse(outcome.out);
  ASSERT_EQ(doc["matrix"].size(), 5U);
  ASSERT_EQ(doc["matrix"][0].size(), doc["errors"].size());
  for (std::size_t k = 0; k < doc["errors"].size(); ++k) {
    const double of_dL = doc["matrix"][0][k];
    const std::string name = doc["errors"][k];
    const std::map<std::string, double> expected{{"alpha_AY", -0.3558},  // um per urad
                                                 {"dy_CA", 2.0},
                                                 {"EY0C", 2.0},
                                                 {"tool_radius_error", -2.0}};
    if (const auto at = expected.find(name); at != expected.end()) {
      EXPECT_NEAR(of_dL, at->second, 1e-6) << name;
    }
  }
  for (const char* file : {"sensitivity.html", "sensitivity.csv", "sensitivity.json"}) {
    EXPECT_TRUE(fs::exists(folder_ / "tables" / file)) << file;
  }
  const Outcome differences =
      run("sensitivity piece/job.toml --json --method differences --parameter dy_CA --step-um 4");
  ASSERT_EQ(differences.exit_code, 0) << differences.err;
  EXPECT_NEAR(json::parse(differences.out)["matrix"][0][0].get<double>(), 2.0, 1e-6);
}

TEST_F(StudyCommandsSystem, Fault2_31_MistakesOfAStudyHaveTheirPlace) {
  const std::string study =
      "title = \"t\"\n[[part]]\nname = \"a\"\njob = 5\nmeasured = [\"m.toml\"]\n";
  write("s.toml", study);
  const Outcome number = run("identify s.toml");
  EXPECT_EQ(number.exit_code, 2);
  EXPECT_EQ(number.err, "s.toml:4:1: error: part[1].job: expected text, found a whole number\n");
  write_steps("piece", "--patterns 1-a");
  measure("piece", "", "m.json");
  write("s.toml",
        "[[part]]\nname = \"a\"\njob = \"piece/job.toml\"\nmeasured = [\"m.json\"]\n"
        "[uncertainty]\ncmm = { e0 = 0 }\n");
  const Outcome ideal = run("identify s.toml");
  EXPECT_EQ(ideal.exit_code, 2);
  EXPECT_NE(ideal.err.find("s.toml:6:9: error: uncertainty.cmm.e0: "), std::string::npos)
      << ideal.err;
}

TEST_F(StudyCommandsSystem, Fault2_31_AnErrorFileNamesAMachine) {
  write_steps("piece", "--patterns 1-a");
  write("mine.toml", "title = \"t\"\nmachine = \"rubbish\"\n[errors]\nEXX = \"linear 1 um\"\n");
  const Outcome outcome = run("measure piece/job.toml --errors mine.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("mine.toml: error: machine: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("rubbish"), std::string::npos) << outcome.err;
}

// It was taken for any machine: the structure of the machine that it names counts.
TEST_F(StudyCommandsSystem, Fault2_31_AnErrorFileWithoutStructureIsOfItsMachine) {
  write_steps("piece", "--patterns 1-a");
  write("mine.toml", "title = \"t\"\nmachine = \"dvf5000\"\n[errors]\nEXX = \"linear 1 um\"\n");
  const Outcome outcome = run("measure piece/job.toml --errors mine.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("the errors are written for dvf5000 (t-(C)-Z-Y-X-b-B-C-w)"),
            std::string::npos)
      << outcome.err;
}

TEST_F(StudyCommandsSystem, IdentifiesThePublishedMachine) {
  const Outcome outcome =
      run("identify '" FRUSTUM_SOURCE_DIR "/examples/ibaraki-2010/study.toml' --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json doc = json::parse(outcome.out);
  EXPECT_TRUE(doc["complete"].get<bool>());
  // Joint fit of 36 values by an independent plane model, with the same floor; one of the values
  // (the second reference width) is not in this study: within half a standard uncertainty.
  for (const auto& [name, value, deviation] : {std::tuple{"alpha_AY", -0.791, 4.90},
                                               {"beta_AY", -40.65, 8.28},
                                               {"beta_CA", 11.28, 10.24},
                                               {"gamma_AY", -101.61, 12.51},
                                               {"dx_AY", 15.48, 2.15},
                                               {"dy_AY", 21.98, 1.96},
                                               {"dy_CA", -6.90, 1.67},
                                               {"dz_AY", -230.02, 1.50},
                                               {"tool_radius_error", 12.31, 0.72}}) {
    const json* estimate = find(doc["estimates"], name);
    ASSERT_NE(estimate, nullptr) << name;
    EXPECT_NEAR((*estimate)["value"].get<double>(), value, 0.5 * deviation) << name;
    EXPECT_NEAR((*estimate)["standard_uncertainty"].get<double>(), deviation, 0.1 * deviation)
        << name;
  }
  const json* dz = find(doc["estimates"], "dz_AY");
  EXPECT_NEAR((*dz)["others"]["paper, Table 8"].get<double>(), -226.0, 1e-9);
  EXPECT_FALSE(doc["recipe"].empty());
}

TEST_F(StudyCommandsSystem, ShipsTheWorkpiecesThatTheProgramWrites) {
  for (const std::string number : {"1", "2"}) {
    const Outcome made =
        run("program step --machine zx-yac --workpiece " + number + " --out piece");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    for (const char* file : {"step.nc", "step.plan.toml"}) {
      const std::string shipped = FRUSTUM_SOURCE_DIR "/examples/ibaraki-2010/workpiece-" + number;
      // But for the version in the first line, which those that ship leave out.
      std::string made_now = read(folder_ / "piece" / file);
      if (made_now.starts_with("# Made by ")) made_now.erase(0, made_now.find('\n') + 1);
      EXPECT_EQ(made_now, read(fs::path(shipped) / file)) << number << file;
    }
  }
}

TEST_F(StudyCommandsSystem, FindsInjectedErrorsAgainFromTheResultsOfRuns) {
  write_steps("one", "--workpiece 1");
  write_steps("two", "--workpiece 2 --patterns 4,7");
  const std::string errors =
      "--error beta_AY=25urad --error dz_AY=-12um --error gamma_AY=-30urad --error beta_ZX=40urad "
      "--tool-radius-error 6um";
  measure("one", errors, "one.json");
  measure("two", errors, "two.json");
  write("study.toml", std::string("[[part]]\nname = \"one\"\njob = \"one/job.toml\"\nmeasured = "
                                  "[\"one.json\"]\n[[part]]\nname = \"two\"\njob = "
                                  "\"two/job.toml\"\nmeasured = [\"two.json\"]\n") +
                          kCmm + "[known]\ngamma_YX = \"0 urad\"\n");
  const Outcome outcome = run("identify study.toml --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  const json doc = json::parse(outcome.out);
  for (const auto& [name, value] : {std::pair{"beta_AY", 25.0},
                                    {"dz_AY", -12.0},
                                    {"gamma_AY", -30.0},
                                    {"beta_ZX", 40.0},
                                    {"tool_radius_error", 6.0},
                                    {"alpha_AY", 0.0},
                                    {"dx_AY", 0.0}}) {
    EXPECT_NEAR((*find(doc["estimates"], name))["value"].get<double>(), value, 0.01) << name;
  }
}

TEST_F(StudyCommandsSystem, PoolsPartsOfOneKind) {
  write_steps("piece", "--patterns 1-a");
  write("a.toml", "[measured]\n\"1-a.dL0\" = \"-10 um\"\n");
  write("b.toml", "[measured]\n\"1-a.dL0\" = \"-14 um\"\n");
  write("study.toml", std::string("[[part]]\nname = \"one\"\njob = \"piece/job.toml\"\nmeasured = "
                                  "[\"a.toml\", \"b.toml\"]\n[unknown]\nerrors = "
                                  "[\"tool_radius_error\"]\n") +
                          kCmm);
  const Outcome outcome = run("identify study.toml --json");
  ASSERT_LE(outcome.exit_code, 1) << outcome.err;
  const json doc = json::parse(outcome.out);
  const json* radius = find(doc["estimates"], "tool_radius_error");
  EXPECT_NEAR((*radius)["value"].get<double>(), 6.0, 1e-6);  // half the mean width missing
  // The parts scatter more than the CMM: 2.83 um between them, 2 um of their mean, half of it a
  // radius.
  EXPECT_NEAR((*radius)["standard_uncertainty"].get<double>(), 1.0, 0.01);
}

TEST_F(StudyCommandsSystem, SaysInWordsWhatCannotBeTold) {
  write_steps("piece", "--patterns 1-a,1-b");
  measure("piece", "--error alpha_AY=20urad", "measured.json");
  write("study.toml",
        std::string("[[part]]\nname = \"one\"\njob = \"piece/job.toml\"\nmeasured = "
                    "[\"measured.json\"]\n") +
            kCmm + "[known]\ngamma_YX = \"0 urad\"\nalpha_ZY = \"0 urad\"\nbeta_ZX = \"0 urad\"\n");
  const Outcome outcome = run("identify study.toml --json");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const json doc = json::parse(outcome.out);
  EXPECT_FALSE(doc["complete"].get<bool>());
  EXPECT_NEAR((*find(doc["estimates"], "alpha_AY"))["value"].get<double>(), 20.0, 0.01);
  for (const char* name : {"beta_AY", "beta_CA", "gamma_AY", "dx_AY", "dy_AY", "dy_CA", "dz_AY"}) {
    EXPECT_TRUE((*find(doc["estimates"], name))["value"].is_null()) << name;
  }
  std::string words = doc["observability"]["null_space"].dump();
  EXPECT_NE(words.find("gamma_AY cannot be identified"), std::string::npos) << words;
  EXPECT_NE(words.find("dy_AY + dy_CA can"), std::string::npos) << words;
  EXPECT_FALSE(doc["observability"]["separating_patterns"].empty());
  EXPECT_NE(run("identify study.toml").out.find("not identified"), std::string::npos);
}

TEST_F(StudyCommandsSystem, ChoosesThePatternsThatTellAllErrors) {
  const Outcome outcome = run(
      "design --machine zx-yac --known gamma_YX=0urad --known alpha_ZY=0urad --known beta_ZX=0urad "
      "--json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json doc = json::parse(outcome.out);
  EXPECT_EQ(doc["smallest"]["patterns"].size(), 3U);
  EXPECT_EQ(doc["smallest_identifying"].size(), 10U);
  EXPECT_GT(doc["smallest"]["standard_deviations"]["beta_CA"].get<double>(), 0.0);
  const Outcome without = run("design --machine zx-yac --patterns 1-a,1-b");
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_NE(without.out.find("cannot be identified"), std::string::npos) << without.out;
}

// A disc on a neck that plunges two micrometres beside a wall: some machines cut the wall with it.
// Its distance from the wall is no convex function of time, as that of convex cutters is. An error
// near the end of its law makes about the most that 40 draws do.
TEST_F(StudyCommandsSystem, SeesWhatAConcaveToolOfAnotherPassCuts) {
  std::string program =
      "%\nO1\nG21 G90 G17\nT1 M6\nS5000 M3\nG54 G43 H1\nG0 X-60 Y15 Z5\nZ-16\nG1 X-40 F500\n";
  for (double x = -39.3; x < 40.0; x += 1.7) program += fmt::format("X{:.3f}\n", x);
  program +=
      "X60\nG0 Z150\nT2 M6\nS5000 M3\nG54 G43 H2\nG0 X0 Y15.002 Z30\nZ5\nG1 Z-14 F500\nG0 "
      "Z30\nM30\n%\n";
  write("p.nc", program);
  write("plan.toml",
        "title = \"wall\"\nalignment = \"plan\"\n[probe]\nball_diameter = 2\nclearance = 2\n"
        "reach = 2\n[[feature]]\nname = \"w\"\nkind = \"plane\"\npoint = [0, 10, -4]\n"
        "axis = [0, 1, 0]\nstrategy = { u = [6, 0, 0], v = [0, 0, 2], columns = 3, rows = 3 }\n"
        "extent = { u = [6, 0, 0], v = [0, 0, 2] }\n[[characteristic]]\nname = \"flat\"\n"
        "kind = \"flatness\"\nfeature = \"w\"\ntolerance = \"100 um\"\n");
  write("job.toml",
        "title = \"wall\"\nmachine = \"three-axis\"\n"
        "program = { file = \"p.nc\", dialect = \"fanuc\" }\n"
        "blank = { shape = \"box\", size = [80, 60, 30], origin = [0, 0, -30] }\n"
        "tool.1 = { type = \"flat\", diameter = 10, length = 80, flute_length = 40 }\n"
        "tool.2 = { type = \"profile\", outline = [[0, 0, 0], [5, 0, 0], [5, 2, 0], [2, 2, 0], "
        "[2, 60, 0]], length = 160 }\n"
        "errors = { EAZ = \"uniform -60urad..60urad\" }\ninspection = { plan = \"plan.toml\" }\n");
  write("study.toml", "job = \"job.toml\"\nsamples = 40\nengine = \"full\"\n");
  const Outcome one = run("run job.toml --out one --json --error EAZ=-57.22urad");
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const double worst = json::parse(one.out)["characteristics"][0]["value"];
  EXPECT_NEAR(worst, 3.321, 1e-3);
  const Outcome all = run("study study.toml --out all --json");
  ASSERT_EQ(all.exit_code, 0) << all.err;
  const double most = json::parse(all.out)["characteristics"][0]["max"];
  EXPECT_GT(most, 0.9 * worst);
  EXPECT_LT(most, 1.1 * worst);
}

TEST_F(StudyCommandsSystem, ReportsPointsThatNothingCut) {
  write_steps("piece", "--workpiece 2 --patterns 3 --allowance 0.2");
  const Outcome outcome = run("run piece/job.toml --out result --error dz_AY=-300um");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE(outcome.out.find("uncut blank"), std::string::npos) << outcome.out;
  const Outcome derivative = run("sensitivity piece/job.toml --error dz_AY=-300um");
  EXPECT_EQ(derivative.exit_code, 2);
  EXPECT_NE(derivative.err.find("uncut blank"), std::string::npos) << derivative.err;
}

TEST_F(StudyCommandsSystem, RefusesBadStudiesWithPlaceAndRemedy) {
  write_steps("piece", "--patterns 1-a");
  measure("piece", "", "measured.json");
  const std::string part =
      "[[part]]\nname = \"one\"\njob = \"piece/job.toml\"\nmeasured = [\"measured.json\"]\n";
  write("table.toml", "[measured]\n\"1-a.dL\" = \"3 urad\"\n");
  write("misspelt.toml", "[measured]\n\"1-a.dl\" = \"3 um\"\n");
  write("bare.toml", "[measured]\n\"1-a.dL\" = 3\n");
  write("zero.toml", "[measured]\n\"1-a.dL\" = { value = \"3 um\", uncertainty = \"0 um\" }\n");
  write("nothing.json", "{}");
  const auto result = [](const std::string& name, const std::string& unit) {
    return "{\"name\":\"" + name + "\",\"value\":3,\"unit\":\"" + unit + "\"}";
  };
  const auto results = [](const std::string& list) {
    return "{\"characteristics\":[" + list + "]}";
  };
  write("foo.json", results(result("1-a.dL", "foo")));
  write("twice.json", results(result("1-a.dL", "um") + "," + result("1-a.dL", "um")));
  write("stranger.json", results(result("1-a.DL", "um")));
  const auto with = [&](const std::string& file) {
    return "[[part]]\nname = \"one\"\njob = \"piece/job.toml\"\nmeasured = [\"" + file + "\"]\n";
  };
  const struct {
    std::string text;
    std::vector<std::string> words;
  } cases[] = {
      {"title = \"empty\"\n", {"study.toml", "no part"}},
      {part, {"no uncertainty", "uncertainty.cmm"}},
      {part + kCmm + "[unknown]\nerrors = [\"beta_CB\"]\n", {"beta_CB", "beta_CA"}},
      {part + kCmm + "[known]\nbeta_CA = \"3 um\"\n", {"study.toml", "known.beta_CA"}},
      {part + kCmm + "[knwon]\nbeta_CA = \"3 urad\"\n", {"study.toml", "knwon", "known"}},
      {part + kCmm + "[method]\nrecipe = \"case-3\"\n", {"method.recipe", "case-2"}},
      {with("nowhere.toml") + kCmm, {"nowhere.toml"}},
      {with("table.toml") + kCmm, {"table.toml", "1-a.dL", "length"}},
      {with("misspelt.toml") + kCmm, {"misspelt.toml", "1-a.dl", "1-a.dL"}},
      {with("bare.toml") + kCmm, {"bare.toml", "unit"}},
      {with("zero.toml") + kCmm, {"zero.toml", "uncertainty"}},
      {with("nothing.json") + kCmm, {"nothing.json", "characteristics"}},
      {with("foo.json") + kCmm, {"foo.json", "1-a.dL", "foo"}},
      {with("twice.json") + kCmm, {"twice.json", "1-a.dL", "twice"}},
      {with("stranger.json") + kCmm, {"stranger.json", "1-a.DL", "1-a.dL"}},
      {part + kCmm + "[unknown]\nerrors = [\"tool_radius_error\"]\ntool_radius = \"each\"\n",
       {"study.toml", "tool_radius_error"}},
      {part + kCmm + "[unknown]\nerrors = [\"dy_CA\", \"dy_CA\"]\n", {"study.toml", "twice"}},
      {with("piece/step.nc") + kCmm, {"step.nc", ".toml"}},
      {"[[part]]\nname = \"one\"\njob = \"nowhere.toml\"\nmeasured = [\"measured.json\"]\n",
       {"nowhere.toml"}},
  };
  for (const auto& c : cases) {
    write("study.toml", c.text);
    const Outcome outcome = run("identify study.toml");
    EXPECT_EQ(outcome.exit_code, 2) << c.text << outcome.out;
    for (const std::string& word : c.words) {
      EXPECT_NE(outcome.err.find(word), std::string::npos) << "'" << word << "' for\n"
                                                           << c.text << "in: " << outcome.err;
    }
  }
  for (const char* arguments :
       {"sensitivity piece/job.toml --parameter nonsense", "sensitivity nowhere.toml",
        "sensitivity piece/job.toml --step-um 0", "identify nowhere.toml",
        "design --machine three-axis", "design --machine zx-yac --patterns 9",
        "design --machine zx-yac --known gamma_YX", "design --machine zx-yac --limit EXX=1um",
        "design --machine zx-yac --e0 3"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << outcome.out;
    EXPECT_FALSE(outcome.err.empty()) << arguments;
  }
}

TEST_F(StudyCommandsSystem, ShowsTheErrorsOverTheWorkingVolume) {
  const Outcome outcome = run(
      "volumetric dvf5000 --tool-length 150 --axes 'X=0,Y=-225,Z=-480;X=0,Y=-225,Z=-480,B=90' "
      "--error bXZ=10urad --tolerance displacements=10um --tolerance rotations=20urad "
      "--tolerance gXY=25urad --tolerance aYZ=25urad --tolerance bXZ=25urad --json --out volume");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json doc = json::parse(outcome.out);
  // 1.44 um per urad at the corner (Table 4-3), on the tool side alone.
  EXPECT_NEAR(doc["statistics_um"]["tool"]["max"], 14.4, 1e-3);
  EXPECT_EQ(doc["statistics_um"]["workpiece"]["max"], 0.0);
  EXPECT_EQ(doc["counts"], json({1, 1, 1}));
  ASSERT_EQ(doc["positions"].size(), 2U);
  EXPECT_EQ(doc["positions"][1]["rotary"]["B"], 90.0);
  EXPECT_EQ(doc["ranking"][0]["name"], "aYZ");
  const json* exY = find(doc["ranking"], "EAY");
  ASSERT_NE(exY, nullptr);
  EXPECT_NEAR((*exY)["gain"], 1.2595395984, 1e-9);
  EXPECT_EQ(read(folder_ / "volume" / "volumetric.json"), outcome.out);
  EXPECT_NE(read(folder_ / "volume" / "volumetric.html").find("data-volume"), std::string::npos);

  EXPECT_EQ((*exY)["gain_unit"], "um/urad");
  for (const json& row : doc["ranking"]) EXPECT_NE(row["gain_unit"], "um/um");

  const Outcome three = run("volumetric three-axis --error EXX=10um --grid 3");
  EXPECT_EQ(three.exit_code, 0) << three.err;
  EXPECT_NE(three.out.find("10.000"), std::string::npos);
}

TEST_F(StudyCommandsSystem, SaysWhatOfAVolumetricStudyIsWrong) {
  const auto told = [&](const std::string& arguments, const std::string& message) {
    const Outcome outcome = run("volumetric iwf-bc " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  };
  told("--grid 1", "a grid of 1 point an axis");
  told("--grid 1000", "at most 41 points an axis");
  told("--axes A=1", "'A=1' is not an axis of machine iwf-bc");
  told("--axes B=200", "B = 200 is outside its travel -110 .. 110 deg");
  told("--tolerance rotations=10um", "tolerance rotations = 10um: expected an angle");
  told("--tolerance EXQ=10um", "unknown error name 'EXQ'");
  told("--error EXA=10um", "has no axis A");
  told("--tool-length -1", "expected a length in mm");
}

}  // namespace
}  // namespace frustum
