// What a report says about part, operator, files and rules: the head of a job and of its plan.
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/sha256.hpp"
#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class EvidenceSystem : public CommandLine {
 protected:
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  // A slot in a plate, by a subprogram of its own file.
  void write_plate() const {
    write("plate.toml",
          "title = \"a plate\"\nmachine = \"three-axis\"\nprogram = { file = \"part.nc\" }\n"
          "tools = \"library.toml\"\nsetup = { origin = [0, 0, 0] }\n"
          "blank = { shape = \"box\", size = [40, 40, 20] }\n"
          "errors = { file = \"machine.errors.toml\" }\nerror_draw = { seed = 2, index = 3 }\n"
          "fixtures = [{ name = \"vise\", shape = \"mesh\", file = \"vise.obj\" }]\n"
          "inspection = { plan = \"floor.plan.toml\" }\noutput = { report = false }\n");
    write("part.nc", "G21 G90\nT1 M6\nS1000 M3\nG54 G43 H1\nM98 P7\nM98 P8\nM5\nM30\n");
    write("O7.nc", "O7\n#100=-5\nM99\n");
    write("O8.nc", "O8\nG0 X-40 Y0 Z50\nG1 Z#100 F500\nG1 X40\nG0 Z60\nM99\n");
    write("O9.nc", "O9\nM99\n");  // which nobody calls
    write("library.toml",
          "[tool.1]\ntype = \"flat\"\ndiameter = 10\nlength = 100\n"
          "flute_length = 30\n");
    write("machine.errors.toml",
          "title = \"a\"\nmachine = \"three-axis\"\n[errors]\nEZX = { csv = \"ezx.csv\" }\n");
    write("ezx.csv", "X_mm,EZX_um\n-500,0\n500,1\n");
    write("vise.obj",
          "v 90 0 0\nv 95 0 0\nv 90 5 0\nv 90 0 5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    write("more.toml",
          "title = \"b\"\nmachine = \"three-axis\"\n[errors]\nEZZ = \"normal 0um sd 20um\"\n");
    write("floor.plan.toml",
          "title = \"floor\"\n[probe]\nball_diameter = 2\n[[feature]]\nname = \"floor\"\n"
          "kind = \"plane\"\npoint = [0, 0, -5]\naxis = [0, 0, 1]\n"
          "strategy = { u = [20, 0, 0], v = [0, 4, 0], columns = 3, rows = 3 }\n"
          "extent = { u = [30, 0, 0], v = [0, 6, 0] }\n"
          "[[characteristic]]\nname = \"place\"\nkind = \"surface_profile\"\nfeature = \"floor\"\n"
          "tolerance = \"100 um\"\n");
  }
  // Roles and names.
  static std::map<std::string, std::vector<std::string>> files_of(const json& result) {
    std::map<std::string, std::vector<std::string>> files;
    for (const json& file : result["evidence"]["files"]) {
      files[file["role"]].push_back(file["name"]);
    }
    return files;
  }
  void write_piece() const {
    const Outcome made = run("program cone --machine iwf-bc --out piece --chord-tolerance 1");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    replace_in("piece/cone.plan.toml", "[probe]",
               "[report]\npart = \"Cone\"\nserial_number = \"1\"\n[probe]");
    replace_in("piece/job.toml", "[output]", "[report]\nserial_number = \"2\"\n[output]");
  }
};

TEST_F(EvidenceSystem, Fault2_38_AJobAndItsPlanAndTheirFilesAreInTheResult) {
  write_piece();
  const Outcome first = run("run piece/job.toml --out a --quiet --export a/r.qif --export a/r.dfq");
  ASSERT_LE(first.exit_code, 1) << first.err;
  const json evidence = json::parse(read(folder_ / "a/result.json"))["evidence"];
  EXPECT_EQ(evidence["part"], "Cone");
  EXPECT_EQ(evidence["serial_number"], "2");
  EXPECT_TRUE(evidence["date"].is_null());
  ASSERT_EQ(evidence["files"].size(), 4U);
  for (const auto& [role, file] :
       {std::pair{"program", "cone.nc"}, {"plan", "cone.plan.toml"}, {"job", "job.toml"}}) {
    bool found = false;
    for (const json& entry : evidence["files"]) {
      if (entry["role"] != role) continue;
      found = true;
      EXPECT_EQ(entry["name"], file);
      EXPECT_EQ(entry["sha256"], sha256(read(folder_ / "piece" / file)));
    }
    EXPECT_TRUE(found) << role;
  }
  // Nothing of the clock: the same again to the last byte.
  ASSERT_LE(run("run piece/job.toml --out b --quiet --export b/r.qif --export b/r.dfq").exit_code,
            1);
  EXPECT_EQ(read(folder_ / "a/r.qif"), read(folder_ / "b/r.qif"));
  EXPECT_EQ(read(folder_ / "a/r.dfq"), read(folder_ / "b/r.dfq"));
}

TEST_F(EvidenceSystem, Fault2_38_MeasuredPointsCarryTheHeadOfTheirPlan) {
  write_piece();
  ASSERT_LE(run("run piece/job.toml --out a --quiet").exit_code, 1);
  const Outcome told =
      run("measure --plan piece/cone.plan.toml --points a/points.csv --e0 1.8um --json");
  ASSERT_LE(told.exit_code, 1) << told.err;
  const json evidence = json::parse(told.out)["evidence"];
  EXPECT_EQ(evidence["serial_number"], "1");
  EXPECT_EQ(evidence["measuring"]["accuracy"],
            "E0 = 1.8 µm; how errors grow with length is not stated, no U contains it");
  EXPECT_EQ(evidence["files"][1]["sha256"], sha256(read(folder_ / "a/points.csv")));
}

TEST_F(EvidenceSystem, Fault2_38_AWrongDateIsToldWithItsLine) {
  write_piece();
  replace_in("piece/job.toml", "serial_number = \"2\"", "date = \"yesterday\"");
  const Outcome told = run("run piece/job.toml --out a");
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_NE(told.err.find("report.date"), std::string::npos) << told.err;
}

TEST_F(EvidenceSystem, Attack2_3_EveryFileThatMadeThePartIsInTheResult) {
  write_plate();
  const std::string command = "measure plate.toml --json --errors more.toml --draw 5";
  const Outcome first = run(command + " --export a.qif");
  ASSERT_LE(first.exit_code, 1) << first.err;
  const json result = json::parse(first.out);
  auto files = files_of(result);
  using Names = std::vector<std::string>;
  EXPECT_EQ(files["program"], Names{"part.nc"});
  EXPECT_EQ(files["subprogram"], (Names{"O7.nc", "O8.nc"}));
  EXPECT_EQ(files["tools"], Names{"library.toml"});
  EXPECT_EQ(files["fixture"], Names{"vise.obj"});
  EXPECT_EQ(files["errors"], (Names{"machine.errors.toml", "ezx.csv", "more.toml"}));
  EXPECT_EQ(result["evidence"]["files"][2]["sha256"], sha256(read(folder_ / "O8.nc")));
  EXPECT_NE(read(folder_ / "a.qif").find("sha256_subprogram_2"), std::string::npos);
  // A subprogram that only counts is one, too.
  replace_in("O7.nc", "-5", "-5.004");
  const Outcome second = run(command);
  EXPECT_NE(json::parse(second.out)["evidence"]["files"], result["evidence"]["files"]);
}

TEST_F(EvidenceSystem, Attack2_3_ADrawIsStatedAndItsValuesMakeTheSamePart) {
  write_plate();
  const Outcome drawn = run("run plate.toml --out a --quiet --errors more.toml --draw 5");
  ASSERT_LE(drawn.exit_code, 1) << drawn.err;
  const json result = json::parse(read(folder_ / "a/result.json"));
  EXPECT_EQ(result["evidence"]["error_draw"], (json{{"seed", 5}, {"index", 3}}));
  std::string value;
  for (const json& error : result["errors"]) {
    if (error["name"] == "EZZ") value = error["value"];
  }
  ASSERT_FALSE(value.empty());
  const Outcome again = run("measure plate.toml --json --error 'EZZ=" + value + "'");
  ASSERT_LE(again.exit_code, 1) << again.err;
  const json same = json::parse(again.out);
  EXPECT_NEAR(same["characteristics"][0]["value"].get<double>(),
              result["characteristics"][0]["value"].get<double>(), 1e-9);
  EXPECT_EQ(same["evidence"]["error_draw"], (json{{"seed", 2}, {"index", 3}}));
  replace_in("plate.toml", "report = false", "report = true");
  ASSERT_LE(run("run plate.toml --out b --quiet --errors more.toml --draw 5").exit_code, 1);
  EXPECT_NE(read(folder_ / "b/report.html").find("seed 5, number 3"), std::string::npos);
}

TEST_F(EvidenceSystem, Attack2_3_TheFileOfTheCmmIsInTheResult) {
  write_piece();
  ASSERT_LE(run("run piece/job.toml --out a --quiet").exit_code, 1);
  write("cmm.toml", "e0 = \"1.8 um\"\n");
  const Outcome told =
      run("measure --plan piece/cone.plan.toml --points a/points.csv --cmm cmm.toml --json");
  ASSERT_LE(told.exit_code, 1) << told.err;
  EXPECT_EQ(files_of(json::parse(told.out))["cmm"], std::vector<std::string>{"cmm.toml"});
}

TEST_F(EvidenceSystem, Attack3_3_PlanAndPointsFromPipesHaveTheirHashes) {
  write_piece();
  ASSERT_LE(run("run piece/job.toml --out a --quiet").exit_code, 1);
  const Outcome told = shell(
      "mkfifo p.toml q.csv; cat piece/cone.plan.toml >p.toml & cat a/points.csv >q.csv & "
      "frustum measure --plan p.toml --points q.csv --json");
  ASSERT_LE(told.exit_code, 1) << told.err;
  const json files = json::parse(told.out)["evidence"]["files"];
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0]["sha256"], sha256(read(folder_ / "piece/cone.plan.toml")));
  EXPECT_EQ(files[1]["sha256"], sha256(read(folder_ / "a/points.csv")));
}

TEST_F(EvidenceSystem, Attack3_3_OtherPipesAreNamedWithoutAHash) {
  write_plate();
  const Outcome told = shell(
      "mkfifo e.toml f.toml; cat more.toml >e.toml & cat floor.plan.toml >f.toml & "
      "sed -i s/floor.plan/f/ plate.toml; "
      "frustum measure plate.toml --json --errors e.toml --export a.qif");
  ASSERT_LE(told.exit_code, 1) << told.err;
  const json result = json::parse(told.out);
  bool found = false;
  for (const json& file : result["evidence"]["files"]) {
    if (file["role"] == "plan") {
      EXPECT_EQ(file["sha256"], sha256(read(folder_ / "floor.plan.toml")));
    }
    if (file["name"] != "e.toml") continue;
    found = true;
    EXPECT_TRUE(file["sha256"].is_null());
  }
  EXPECT_TRUE(found);
  EXPECT_NE(read(folder_ / "a.qif").find("read from a pipe"), std::string::npos);
}

}  // namespace
}  // namespace frustum
