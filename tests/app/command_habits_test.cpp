// What all commands share: their output folder, how they refuse, and what they say meanwhile.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

class CommandHabitsSystem : public CommandLine {
 protected:
  void write_piece(const std::string& more = "") const {
    const Outcome made =
        run("program cone --machine iwf-bc --chord-tolerance 50 --out piece " + more);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    replace_in("piece/job.toml", "report = true", "report = false");  // takes seconds
  }
};

TEST_F(CommandHabitsSystem, Fault2_32_ARunIntoAFolderThatAnotherWritesToIsRefused) {
  write_piece();
  fs::create_directories(folder_ / "out");
  const int other = open((folder_ / "out").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_GE(other, 0);
  ASSERT_EQ(flock(other, LOCK_EX | LOCK_NB), 0);
  const Outcome refused = run("run piece/job.toml --out out --json");
  close(other);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("out: error: another run is writing to this folder"),
            std::string::npos)
      << refused.err;
  EXPECT_EQ(nlohmann::json::parse(refused.out)["diagnostics"][0]["id"], "output-in-use");
}

TEST_F(CommandHabitsSystem, Fault2_32_AnExportInTheFolderIsOneOfTheSet) {
  write_piece();
  fs::create_directories(folder_ / "out");
  std::ofstream(folder_ / "out/notes.txt") << "of the user";
  std::ofstream(folder_ / "out/points.csv") << "of an older run";
  const Outcome done = run("run piece/job.toml --out out --export out/part.csv --quiet");
  EXPECT_NE(done.exit_code, 2) << done.err;
  EXPECT_EQ(read(folder_ / "out/notes.txt"), "of the user");
  EXPECT_NE(read(folder_ / "out/part.csv").find("cone.equivalent_form"), std::string::npos);
  EXPECT_EQ(read(folder_ / "out/points.csv").rfind("feature,", 0), 0U);
}

TEST_F(CommandHabitsSystem, WritesOverNothingThatItHasRead) {
  write_piece();
  ASSERT_NE(run("run piece/job.toml --out first --quiet").exit_code, 2);
  const fs::path piece = folder_ / "piece";
  fs::copy(folder_ / "first/points.csv", piece / "points.csv");
  std::ofstream(piece / "exx.csv") << "X_mm,EXX_um\n-100,0\n100,5\n";
  const std::map<std::string, std::string> read_by_command{
      {"measure --plan cone.plan.toml --points points.csv --export points.csv", "points.csv"},
      {"measure --plan cone.plan.toml --points points.csv --export ./cone.plan.csv --export "
       "../piece/points.csv",
       "points.csv"},
      {"cut job.toml --removal points.csv --error EXX=points.csv", "points.csv"},
      {"run job.toml --out o --error 'EXX=exx.csv' --export exx.csv", "exx.csv"},
      {"view cone.nc --machine iwf-bc --tool-length 1=150 --offset G54=-65,0,150 --out .",
       "cone.nc"},
      {"history . --out .", "history.json"},
  };
  fs::copy(folder_ / "first/result.json", piece / "history.json");
  std::ofstream(piece / "history.toml")
      << "[[result]]\nfile = \"history.json\"\ndate = 2026-01-01\n";
  for (const auto& [command, file] : read_by_command) {
    const std::string before = read(piece / file);
    const Outcome refused = shell("cd piece && frustum " + command);
    EXPECT_EQ(read(piece / file), before) << command;
    if (command.starts_with("view")) continue;  // view.html, which it has not read
    EXPECT_EQ(refused.exit_code, 2) << command << refused.out << refused.err;
  }
  const Outcome twice = run("run piece/job.toml --out first --export first/points.csv --quiet");
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_NE(twice.err.find("this run writes that file already"), std::string::npos) << twice.err;
}

TEST_F(CommandHabitsSystem, Fault2_43_AFolderThatCannotBeIsRefusedBeforeTheWork) {
  write_piece();
  std::ofstream(folder_ / "file") << "";
  for (const char* command :
       {"run piece/job.toml --out file", "run piece/job.toml --out file/out",
        "sensitivity piece/job.toml --out file", "compensate piece/job.toml --out file",
        "volumetric iwf-bc --grid 100 --out file/out", "program cone --machine iwf-bc --out file",
        "post piece/cone.nc --job piece/job.toml --to sinumerik -o no/cone.mpf",
        "cut piece/job.toml --mesh no/part.stl", "cut piece/job.toml --picture no/part.png",
        "cut piece/job.toml --removal no/part.csv"}) {
    const Outcome refused = run(command);
    EXPECT_EQ(refused.exit_code, 2) << command;
    EXPECT_NE(refused.err.find("cannot"), std::string::npos) << command << ": " << refused.err;
    EXPECT_EQ(refused.out, "") << command;
  }
}

TEST_F(CommandHabitsSystem, Fault2_43_AMisspeltCommandOrOptionIsNamedWithTheNearest) {
  const Outcome command = run("runn x");
  EXPECT_EQ(command.exit_code, 2);
  EXPECT_NE(command.err.find("'runn' is not a command (hint: did you mean run?)"),
            std::string::npos)
      << command.err;
  EXPECT_NE(run("program cones --machine iwf-bc").err.find("did you mean cone?"),
            std::string::npos);
  const Outcome option = run("pose iwf-bc --axse X=1");
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_NE(option.err.find("did you mean --axes?"), std::string::npos) << option.err;
}

TEST_F(CommandHabitsSystem, Fault2_43_EveryFailureIsJsonWhereJsonIsAskedFor) {
  for (const char* command :
       {"sensitivity no.toml", "identify no.toml", "design no-machine",
        "program cone no-machine --out p", "post no.nc --machine iwf-bc --to fanuc -o b.nc",
        "diff a.nc b.nc --machine iwf-bc", "compensate no.toml --out c",
        "pose no-machine --axes X=1", "cut no.toml --mesh a.stl", "cmm no.toml",
        "errors no-machine", "volumetric no-machine", "runn", "pose --nonsense"}) {
    const Outcome refused = run(std::string(command) + " --json");
    EXPECT_EQ(refused.exit_code, 2) << command;
    const auto doc = nlohmann::json::parse(refused.out, nullptr, false);
    ASSERT_TRUE(doc.is_object()) << command << ": " << refused.out;
    EXPECT_EQ(doc["status"], "error") << command;
    EXPECT_TRUE(doc["diagnostics"][0].contains("id")) << command;
    EXPECT_TRUE(doc["diagnostics"][0].contains("message")) << command;
  }
}

TEST_F(CommandHabitsSystem, Fault2_43_QuietCommandsPrintNothingAndJsonOnesADocument) {
  const std::string piece = "program cone iwf-bc --chord-tolerance 50 --out piece";
  EXPECT_EQ(run(piece + " --quiet").out, "");
  EXPECT_EQ(nlohmann::json::parse(run(piece + " --json").out)["files"][0], "piece/job.toml");
  EXPECT_EQ(run("cmm piece/job.toml --quiet").out, "");
  EXPECT_EQ(nlohmann::json::parse(run("cmm piece/job.toml --json").out)["lengths"].size(), 105U);
  EXPECT_EQ(nlohmann::json::parse(run("cmm piece/job.toml --seeds 2 --json").out)["passed"], 2);
  EXPECT_EQ(run("volumetric iwf-bc --grid 2 --quiet").out, "");
  const std::string post = "post piece/cone.nc --job piece/job.toml --to sinumerik -o b.mpf";
  EXPECT_EQ(run(post + " --quiet").out, "");
  EXPECT_EQ(run("diff piece/cone.nc b.mpf --job piece/job.toml --quiet").out, "");
}

TEST_F(CommandHabitsSystem, Attack2_13_CommandsThatOnlyAnswerCanBeQuiet) {
  std::ofstream(folder_ / "p.csv") << "0,0,0\n1,0,0\n0,1,0\n1,1,0.1\n";
  for (const char* command :
       {"pose iwf-bc --axes X=1", "pose iwf-bc --inverse 0,0,100,0,0,1", "fit plane p.csv",
        "machines", "errors iwf-bc", "parse - --dialect fanuc </dev/null"}) {
    EXPECT_EQ(run(std::string(command) + " --quiet").out, "") << command;
  }
  EXPECT_EQ(run("fit plane none.csv --quiet").exit_code, 2);
}

TEST_F(CommandHabitsSystem, Attack2_13_AParsedProgramIsADocument) {
  std::ofstream(folder_ / "part.nc") << "O1\nG21 G90\nG0 X1 Y2\nG1 Z-1 F100\nM107\nX5\nM30\n";
  const Outcome parsed = run("parse part.nc --dialect fanuc --json");
  EXPECT_EQ(parsed.exit_code, 0) << parsed.err;
  const auto doc = nlohmann::json::parse(parsed.out);
  EXPECT_EQ(doc["schema"], "frustum/parse/1");
  EXPECT_EQ(doc["dialect"], "fanuc");
  EXPECT_TRUE(doc["recognised_by"].is_null());
  EXPECT_EQ(doc["motions"]["traverse"], 1);
  EXPECT_EQ(doc["motions"]["feed"], 2);
  EXPECT_EQ(doc["diagnostics"][0]["id"], "builder-word");
  EXPECT_EQ(doc["diagnostics"][0]["line"], 5);
  EXPECT_TRUE(nlohmann::json::parse(run("parse part.nc --json").out)["recognised_by"].is_string());
  std::ofstream(folder_ / "bad.nc") << "O1\nG1 X\nM30\n";
  const Outcome bad = run("parse bad.nc --dialect fanuc --json");
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_EQ(nlohmann::json::parse(bad.out)["diagnostics"][0]["line"], 2);
  EXPECT_EQ(run("parse part.nc --json --canon").exit_code, 2);
}

TEST_F(CommandHabitsSystem, Fault2_43_APoseBeyondTravelSaysSo) {
  const Outcome pose = run("pose --machine iwf-bc --axes X=1000");
  EXPECT_EQ(pose.exit_code, 0);
  EXPECT_NE(pose.err.find("beyond travel: X = 1000"), std::string::npos) << pose.err;
  const auto doc = nlohmann::json::parse(run("pose iwf-bc --axes X=1000 --json").out);
  EXPECT_EQ(doc["within_travel"], false);
  EXPECT_EQ(doc["beyond_travel"].size(), 1U);
  EXPECT_EQ(run("pose iwf-bc --axes X=10").err, "");
  EXPECT_EQ(run("volumetric --machine iwf-bc --grid 2").out, run("volumetric iwf-bc --grid 2").out);
}

TEST_F(CommandHabitsSystem, Fault2_43_AJobIsNoStudy) {
  write_piece();
  const Outcome refused = run("identify piece/job.toml");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("this is a job, not a study"), std::string::npos) << refused.err;
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
}

TEST_F(CommandHabitsSystem, Fault2_33_AnyNumberOfThreadsGivesTheSameBits) {
  write_piece();
  EXPECT_NE(run("run piece/job.toml --threads 1 --out one --quiet").exit_code, 2);
  EXPECT_NE(run("run piece/job.toml --threads 3 --out three --quiet").exit_code, 2);
  EXPECT_EQ(read(folder_ / "one/points.csv"), read(folder_ / "three/points.csv"));
  EXPECT_GT(read(folder_ / "one/points.csv").size(), 1000U);
  EXPECT_EQ(run("cut piece/job.toml --threads 1 --mesh one.stl --pitch 4 --quiet").exit_code, 0);
  EXPECT_EQ(run("cut piece/job.toml --threads 3 --mesh three.stl --pitch 4 --quiet").exit_code, 0);
  EXPECT_EQ(read(folder_ / "one.stl"), read(folder_ / "three.stl"));
  for (const char* number : {"0", "-1", "many"}) {
    EXPECT_EQ(run(std::string("run piece/job.toml --threads ") + number).exit_code, 2) << number;
  }
}

TEST_F(CommandHabitsSystem, Fault2_44_EveryDocumentNamesItsSchema) {
  write_piece();
  const auto schema = [this](const std::string& command) {
    const auto doc = nlohmann::json::parse(run(command + " --json").out, nullptr, false);
    return doc.is_object() && doc.contains("schema") ? doc["schema"].get<std::string>() : "none";
  };
  std::ofstream(folder_ / "p.csv") << "0,0,0\n1,0,0\n0,1,0\n1,1,0.1\n";
  EXPECT_EQ(schema("run piece/job.toml"), "frustum/result/1");
  EXPECT_EQ(schema("run no.toml"), "frustum/failure/1");
  EXPECT_EQ(schema("pose iwf-bc --axes X=1"), "frustum/pose/1");
  EXPECT_EQ(schema("pose iwf-bc --inverse 0,0,100,0,0,1"), "frustum/pose/1");
  EXPECT_EQ(schema("errors iwf-bc"), "frustum/errors/1");
  EXPECT_EQ(schema("parse piece/cone.nc"), "frustum/parse/1");
  EXPECT_EQ(schema("fit plane p.csv"), "frustum/fit/1");
  EXPECT_EQ(schema("volumetric iwf-bc --grid 2"), "frustum/volumetric/1");
  EXPECT_EQ(schema("motion chase iwf-bc --ball 0,0,100 --at B=30"), "frustum/motion/1");
  EXPECT_EQ(schema("motion touch ac-probe"), "frustum/motion/1");
  EXPECT_EQ(schema("check piece/cone.nc --job piece/job.toml"), "frustum/check/1");
  EXPECT_EQ(schema("check piece/cone.nc piece/cone.nc"), "frustum/check-files/1");
  EXPECT_EQ(schema("cut piece/job.toml --point 0,0,0"), "frustum/cut/1");
  EXPECT_EQ(schema("diff piece/cone.nc piece/cone.nc --job piece/job.toml"), "frustum/diff/1");
}

TEST_F(CommandHabitsSystem, Fault2_44_TolerancesOfAPieceAreWrittenAsTheyAreMeant) {
  write_piece("--limits tenth");
  const std::string plan = read(folder_ / "piece/cone.plan.toml");
  EXPECT_NE(plan.find("tolerance = \"10 um\""), std::string::npos) << plan;
  EXPECT_EQ(plan.find("0000000002 um"), std::string::npos) << plan;
}

}  // namespace
}  // namespace frustum
