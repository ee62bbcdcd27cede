// The program as users and scripts see it: exit codes, messages, files.
#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

class CommandLineSystem : public CommandLine {
 protected:
  // A coarse cone piece in folder_/piece; fast to cut.
  void write_piece(const std::string& more = "--chord-tolerance 1") const {
    const Outcome made = run("program cone --machine iwf-bc --out piece " + more);
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }

  // The run must refuse, say why, and leave no output folder behind.
  void expect_refusal(const std::vector<std::string>& words) const {
    const Outcome outcome = run("run piece/job.toml --out result --quiet");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    for (const std::string& word : words) {
      EXPECT_NE(outcome.err.find(word), std::string::npos)
          << "'" << word << "' in: " << outcome.err;
    }
    EXPECT_FALSE(fs::exists(folder_ / "result"));
  }
};

TEST_F(CommandLineSystem, RunsTheLoopAndWritesItsFiles) {
  write_piece("--chord-tolerance 0.02");
  const Outcome outcome = run("run piece/job.toml --out result --json --error EX0C=10um");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto doc = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(doc["status"], "pass");
  EXPECT_EQ(doc["characteristics"][0]["name"], "cone.equivalent_form");
  EXPECT_NEAR(doc["characteristics"][0]["value"].get<double>(), 2.763, 0.15 + 0.02 * 2.763);
  for (const char* file : {"report.html", "result.json", "points.csv"}) {
    EXPECT_TRUE(fs::exists(folder_ / "result" / file)) << file;
  }
  // Points that were measured come back the same when they are evaluated again.
  const Outcome again =
      run("measure --plan piece/cone.plan.toml --points result/points.csv --json");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  const auto back = nlohmann::json::parse(again.out);
  EXPECT_NEAR(back["characteristics"][0]["value"].get<double>(),
              doc["characteristics"][0]["value"].get<double>(), 1e-6);
}

TEST_F(CommandLineSystem, FailsWithExitCodeOneWhenAToleranceIsMissed) {
  write_piece("--limits tenth --chord-tolerance 1");
  const Outcome outcome =
      run("run piece/job.toml --out result --quiet --error EXX='harmonic 2 40um'");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(fs::exists(folder_ / "result/result.json"));
}

TEST_F(CommandLineSystem, DrawsAxesOverTheConeAngleWhereTheJobSaysSo) {
  write_piece();
  const auto drawn_over_angle = [this] {
    EXPECT_EQ(run("run piece/job.toml --out result --quiet").exit_code, 0);
    const std::string page = read(folder_ / "result/report.html");
    const std::string_view sought = "cone angle φ, degrees";
    int count = 0;
    for (auto at = page.find(sought); at != std::string::npos; at = page.find(sought, at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(drawn_over_angle(), 2);  // roughing and finishing
  // The name of an operation says nothing.
  replace_in("piece/job.toml", "\"cone roughing\"", "\"flank roughing\"");
  EXPECT_EQ(drawn_over_angle(), 2);
  replace_in("piece/job.toml", "kind  = \"cone\"", "");
  EXPECT_EQ(drawn_over_angle(), 1);
  replace_in("piece/job.toml", "kind  = \"cone\"", "kind = \"cones\"");
  fs::remove_all(folder_ / "result");
  expect_refusal({"job.toml:", "kind", "cones"});
}

TEST_F(CommandLineSystem, CutsAClosedMesh) {
  write_piece();
  const Outcome outcome = run("cut piece/job.toml --mesh part.ply --pitch 2 --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto doc = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(doc["closed"].get<bool>());
  EXPECT_TRUE(doc["manifold"].get<bool>());
  EXPECT_TRUE(fs::exists(folder_ / "part.ply"));
}

TEST_F(CommandLineSystem, RefusesBadInputWithPlaceAndRemedy) {
  const struct {
    const char* file;
    const char* from;
    const char* to;
    std::vector<std::string> words;
  } cases[] = {
      {"cone.nc", "G21 G90", "G21 Q7 G90", {"cone.nc:", "error", "Q"}},
      {"cone.nc", " F500", "", {"cone.nc:", "feed"}},
      {"cone.nc", "G53 G0 B0. C0.", "G53 G0 A0. C0.", {"cone.nc:", "has no axis A"}},
      {"cone.nc", "G53 G0 Z500.", "G53 G0 Z5000.", {"cone.nc:", "over-travel: Z", "-300 .. 600"}},
      {"cone.nc", "T1 M6", "T2 M6", {"cone.nc:", "T2 is not defined"}},
      {"job.toml", "[errors]", "[erors]", {"job.toml:", "erors", "did you mean errors?"}},
      {"job.toml",
       "radius_error",
       "radius_eror",
       {"tool.1.radius_eror", "did you mean radius_error?"}},
      {"job.toml", "title ", "tools = \"none.tbl\"\ntitle ", {"none.tbl", "cannot be read"}},
      {"job.toml", "type = \"flat\"", "type = \"bull\"", {"tool.1.corner_radius"}},
      {"job.toml", "diameter = 110", "diameter = 0", {"blank.diameter", "greater than 0"}},
      {"job.toml", "e0 = \"0 um\"", "e0 = \"0 urad\"", {"inspection.cmm.e0", "length"}},
      {"job.toml", "cone.nc", "none.nc", {"program.file", "cannot be read"}},
      {"job.toml", "\"iwf-bc\"", "\"none.toml\"", {"machine", "none.toml", "known: ac-probe"}},
      {"cone.plan.toml", "points_per_section", "points_per_sektion", {"points_per_se"}},
      {"cone.plan.toml", "section_radius = 35", "section_radius = 20", {"cone"}},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.to);
    write_piece();
    replace_in(std::string("piece/") + c.file, c.from, c.to);
    expect_refusal(c.words);
  }
}

TEST_F(CommandLineSystem, RefusesAnUnreachableToolDirection) {
  write_piece();
  replace_in("piece/job.toml", "\"iwf-bc\"", "\"three-axis\"");
  expect_refusal({"cone.nc:", "has no axis B"});
}

TEST_F(CommandLineSystem, WritesAndMeasuresAStepPatternPiece) {
  const Outcome made =
      run("program step --machine zx-yac --patterns 1-a,2-a --workpiece 1 --out piece");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  for (const char* file : {"job.toml", "step.nc", "step.plan.toml", "setup.html"}) {
    EXPECT_TRUE(fs::exists(folder_ / "piece" / file)) << file;
  }
  EXPECT_NE(read(folder_ / "piece/step.nc").find("(PATTERN 1-A, STEP D: SIDE -Y, A0 C-180)"),
            std::string::npos);
  replace_in("piece/job.toml", "report = true", "report = false");
  const Outcome outcome = run("run piece/job.toml --out result --json --error dy_CA=5um");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto doc = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(doc["characteristics"][0]["name"], "1-a.dL");
  EXPECT_NEAR(doc["characteristics"][0]["value"].get<double>(), 10.0, 0.01);  // 2 dy_CA
  EXPECT_NEAR(doc["characteristics"][4]["value"].get<double>(), 0.0, 0.01);   // dL0
  // One step cuts a face whole: it is displaced, not bent.
  for (const auto& feature : doc["features"]) {
    EXPECT_LT(feature["form"]["value_um"].get<double>(), 0.02) << feature["name"];
  }
  // A loft that is no body is refused where it stands.
  fs::remove_all(folder_ / "result");
  replace_in("piece/job.toml", "[180.4, 57.8, 62]", "[170.4, 57.8, 62]");
  expect_refusal({"job.toml:", "blank.sections", "is below the one before"});
}

TEST_F(CommandLineSystem, RefusesBadArguments) {
  for (const char* arguments :
       {"",
        "nonsense",
        "run",
        "run no-such-job.toml",
        "pose --machine iwf-bc --axes Q=1",
        "pose --machine iwf-bc --axes X=1 --error nonsense=1um",
        "pose --machine iwf-bc --inverse 1,2,3",
        "pose --machine iwf-bc --inverse 0,0,0,0,0,0",
        "pose --machine nowhere --axes X=0",
        "program cone --machine iwf-bc --out p --cone-angle 95",
        "program cone --machine iwf-bc --out p --radius -3",
        "program cone --machine iwf-bc --out p --allowance nan",
        "program cone --machine iwf-bc --out p --speed 0",
        "program cone --machine iwf-bc --out p --radius 1e9",
        "program cone --machine iwf-bc --out p --chord-tolerance 1e-12",
        "program cone --machine three-axis --out p",
        "program step --machine three-axis --out p",
        "program step --machine zx-yac --workpiece 3 --out p",
        "program step --machine zx-yac --workpiece 2 --patterns 3,4 --out p",
        "program step --machine zx-yac --patterns 8 --out p",
        "program step --machine zx-yac --center 1 --out p",
        "program step --machine zx-yac --raise nan --out p",
        "program step --machine zx-yac --raise 900 --out p",
        "pose --machine iwf-bc --axes X=1,X=2",
        "pose --machine iwf-bc --axes X=1 --tool-length nan",
        "pose --machine iwf-bc --axes X=1 --tool-length 1e300",
        "pose --machine iwf-bc --axes X=1e308",
        "pose --machine iwf-bc --axes B=1e300",
        "pose --machine iwf-bc --inverse 1e200,0,0,0,0,1",
        "program cone --machine iwf-bc --out p --center 1,2",
        "program cone --machine iwf-bc --form axes --out p --center=900,0,0",
        "fit cone nothing.csv",
        "fit banana nothing.csv",
        "errors nowhere",
        "parse nowhere.nc"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_FALSE(outcome.err.empty()) << arguments;
    EXPECT_FALSE(fs::exists(folder_ / "p")) << arguments;
  }
}

TEST_F(CommandLineSystem, TestsItsOwnCmm) {
  write_piece();
  const Outcome ideal = run("cmm piece/job.toml");
  EXPECT_EQ(ideal.exit_code, 0) << ideal.err;
  EXPECT_NE(ideal.out.find("105 lengths (ISO 10360-2): passed"), std::string::npos) << ideal.out;
  const std::string text = read(folder_ / "piece/job.toml");
  const auto at = text.find("cmm  = {");
  ASSERT_NE(at, std::string::npos);
  const std::string line = text.substr(at, text.find('\n', at) - at);
  replace_in("piece/job.toml", line, "cmm = { model = \"field\", e0 = \"2 um\", l_per_um = 300 }");
  const Outcome many = run("cmm piece/job.toml --seeds 5");
  EXPECT_EQ(many.exit_code, 0) << many.err;
  EXPECT_TRUE(many.out.starts_with("5 machines: 5 passed")) << many.out;
  // The statement covers 20 degC.
  replace_in("piece/job.toml", "l_per_um = 300", "l_per_um = 300, temperature = { part = 30 }");
  const Outcome warm = run("cmm piece/job.toml");
  EXPECT_EQ(warm.exit_code, 1);
  EXPECT_NE(warm.out.find("exceeded"), std::string::npos) << warm.out;
  replace_in("piece/job.toml", "e0 = \"2 um\", l_per_um = 300, ", "");
  const Outcome none = run("cmm piece/job.toml");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.out.find("failed, with errors where the limit is 0"), std::string::npos)
      << none.out;
  const Outcome several = run("cmm piece/job.toml --seeds 3");
  EXPECT_NE(several.out.find("uses more than any share (the limit is 0) on the best machine"),
            std::string::npos)
      << several.out;
  EXPECT_NE(several.out.find("3 failed on the sphere of 25 points; the first that failed has seed"),
            std::string::npos)
      << several.out;
  replace_in("piece/job.toml", "part = 30", "parts = 30");
  const Outcome misspelt = run("cmm piece/job.toml");
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_NE(misspelt.err.find("did you mean part?"), std::string::npos) << misspelt.err;
}

TEST_F(CommandLineSystem, TakesErrorsFromFilesAndDrawsThem) {
  const std::string pose = "pose --machine iwf-bc --axes X=40,B=20,C=30 --json ";
  const Outcome drawn = run(pose + "--errors bossoni-cone-limits --draw 1");
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_EQ(run(pose + "--errors bossoni-cone-limits --draw 1").out, drawn.out);
  EXPECT_NE(run(pose + "--errors bossoni-cone-limits --draw 2").out, drawn.out);
  const Outcome forgotten = run(pose + "--errors bossoni-cone-limits");
  EXPECT_EQ(forgotten.exit_code, 2);
  EXPECT_NE(forgotten.err.find("--draw SEED"), std::string::npos) << forgotten.err;
  const Outcome foreign = run(pose + "--errors jang-key-tolerances --draw 1");
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_NE(foreign.err.find("machine iwf-bc"), std::string::npos) << foreign.err;
  // A workpiece-side X after motion in +: its table lags towards +X, the tip is 5 um nearer in the
  // work.
  const Outcome lag =
      run("pose --machine iwf-bc --axes X=1 --error \"EXX=reversal 10um\" --heading X=1");
  EXPECT_NE(lag.out.find("tip position error         -5.0"), std::string::npos) << lag.out;
}

TEST_F(CommandLineSystem, ReadsTheErrorFileOfAJob) {
  const std::string make = "program step --machine zx-yac --patterns 1-a,2-a --workpiece 1 --out p";
  ASSERT_EQ(run(make).exit_code, 0);
  replace_in("p/job.toml", "report = true", "report = false");
  std::ofstream(folder_ / "p" / "mine.toml")
      << "title = \"t\"\nmachine = \"zx-yac\"\n[errors]\nEXX = \"linear uniform 1um..2um\"\n"
         "EB0C = \"9 urad\"\n";
  const std::string job = "p/job.toml";
  replace_in(job, "[errors]\n", "[errors]\nfile = \"mine.toml\"\n");
  std::ofstream(folder_ / job, std::ios::app) << "\n[error_draw]\nseed = 3\n";
  const Outcome outcome = run("run " + job + " --json --quiet --out out");
  EXPECT_NE(outcome.exit_code, 2) << outcome.err;
  EXPECT_NE(outcome.out.find("EXX"), std::string::npos) << outcome.out.substr(0, 2000);
  EXPECT_NE(outcome.out.find("EB0C"), std::string::npos);
}

TEST_F(CommandLineSystem, ReadsRotaryWordsInDegreesAlsoInInchPrograms_Complaint18) {
  std::ofstream(folder_ / "inch.nc") << "G20 G90\nG0 X1 B45\n";
  const Outcome outcome = run("parse inch.nc --canon");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\"X\":25.4"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\"B\":45"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace frustum
