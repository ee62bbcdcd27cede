// frustum program s-piece and surface, compare, benchmark: from the command line.
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class TestPieceSystem : public CommandLine {
 protected:
  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
};

TEST_F(TestPieceSystem, TheSPieceSpeaksFourDialectsAndAxisPositions) {
  const struct {
    const char* options;
    const char* file;
  } forms[] = {{"--dialect fanuc", "s-piece.nc"},
               {"--dialect linuxcnc", "s-piece.ngc"},
               {"--dialect sinumerik", "s-piece.mpf"},
               {"--dialect heidenhain", "s-piece.h"},
               {"--form axes", "s-piece.nc"}};
  json first;
  for (const auto& form : forms) {
    const Outcome made =
        run(std::string("program s-piece --machine iwf-bc --blocks 200 --out s ") + form.options);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_TRUE(fs::exists(folder_ / "s" / form.file)) << form.options;
    replace_in("s/job.toml", "report = true", "report = false");
    const Outcome ran = run("run s/job.toml --json --out o");
    ASSERT_EQ(ran.exit_code, 0) << form.options << ran.err;
    const json result = json::parse(ran.out);
    if (first.is_null()) first = result;
    for (std::size_t f = 0; f < 2; ++f) {
      const json &one = first["features"][f]["deviations_um"],
                 &other = result["features"][f]["deviations_um"];
      ASSERT_EQ(one.size(), 147u);
      EXPECT_EQ(result["features"][f]["kind"], "ruled");
      EXPECT_EQ(result["features"][f]["geometric_um"].size(), 147u);
      for (std::size_t i = 0; i < one.size(); ++i) {
        // Between blocks an axis form goes where a vector form goes.
        EXPECT_NEAR(one[i].get<double>(), other[i].get<double>(), 0.05) << form.options << i;
      }
    }
    fs::remove_all(folder_ / "s");
  }
}

TEST_F(TestPieceSystem, TheSPieceSaysWhatDoesNotFit) {
  const Outcome large = run("program s-piece --machine zx-yac --cutter 90 --out s");
  EXPECT_EQ(large.exit_code, 2);
  EXPECT_NE(large.err.find("at u = 0."), std::string::npos) << large.err;
  EXPECT_NE(large.err.find("largest radius"), std::string::npos) << large.err;
  EXPECT_FALSE(fs::exists(folder_ / "s/job.toml"));
  write("p.csv", "curve,x,y,z\nC0,0,0,oops\n");
  const Outcome points = run("program s-piece --machine zx-yac --points p.csv --out s");
  EXPECT_EQ(points.exit_code, 2);
  EXPECT_NE(points.err.find("p.csv:2:8"), std::string::npos) << points.err;
  EXPECT_EQ(run("program s-piece --machine zx-yac --method two --out s").exit_code, 2);
}

TEST_F(TestPieceSystem, IdentifySaysWhatTheSAloneDoesNotTell) {
  ASSERT_EQ(run("program s-piece --machine zx-yac --blocks 500 --out s --quiet").exit_code, 0);
  replace_in("s/job.toml", "report = true", "report = false");
  ASSERT_NE(
      run("run s/job.toml --out o --quiet --error dx_AY=8um --error gamma_YX=12urad").exit_code, 2);
  write("study.toml",
        "[[part]]\nname = \"s\"\njob = \"s/job.toml\"\nmeasured = [\"o/result.json\"]\n"
        "[uncertainty]\ncmm = { e0 = \"0.5 um\", l_per_um = 600 }\n");
  // Not all of them are told.
  const Outcome found = run("identify study.toml --json");
  ASSERT_EQ(found.exit_code, 1) << found.err;
  const json result = json::parse(found.out);
  std::vector<std::string> told;
  for (const json& each : result["combinations"]) told.push_back(each["text"]);
  EXPECT_EQ(told, (std::vector<std::string>{"alpha_AY - alpha_ZY", "beta_AY - beta_ZX"}));
  EXPECT_EQ(result["observability"]["rank"], 9);
  bool dx_found = false;
  for (const json& each : result["estimates"]) {
    if (each["name"] != "dx_AY" || !each.contains("value") || each["value"].is_null()) continue;
    dx_found = true;
    EXPECT_NEAR(each["value"].get<double>(), 8.0, 0.5);
  }
  EXPECT_TRUE(dx_found) << found.out.substr(0, 2000);
}

TEST_F(TestPieceSystem, ASurfaceOfYourOwnIsCut) {
  std::string net = "row,x,y,z\n";
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      net += std::to_string(i) + "," + std::to_string(20 - 12 * j) + "," +
             std::to_string(12 * i - 18) + "," + std::to_string(i * j) + "\n";
    }
  }
  write("net.csv", net);
  const Outcome made =
      run("program surface --machine zx-yac --net net.csv --cusp 50 --blocks 60 --out f");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  replace_in("f/job.toml", "report = true", "report = false");
  const Outcome ran = run("run f/job.toml --json --out o");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_LT(json::parse(ran.out)["characteristics"][0]["value"].get<double>(), 5.0);
}

// A cube of 20 mm, each corner moved outward by `grown` mm in x.
std::string cube_obj(double grown, double shifted) {
  std::string text;
  for (int c = 0; c < 8; ++c) {
    const double x = (c & 1) != 0 ? 20.0 + grown : 0.0;
    text += "v " + std::to_string(x + shifted) + " " + std::to_string((c & 2) != 0 ? 20.0 : 0.0) +
            " " + std::to_string((c & 4) != 0 ? 20.0 : 0.0) + "\n";
  }
  return text +
         "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\nf 1 5 3\n"
         "f 3 5 7\nf 2 4 6\nf 4 8 6\n";
}

TEST_F(TestPieceSystem, CompareTellsDeviationsAndTheShareWithin) {
  write("nominal.obj", cube_obj(0.0, 0.0));
  write("part.obj", cube_obj(0.1, 0.0));
  const Outcome found =
      run("compare part.obj nominal.obj --tolerance 50um --json --mesh out.ply --picture out.png");
  EXPECT_EQ(found.exit_code, 1) << found.err;
  const json result = json::parse(found.out);
  EXPECT_EQ(result["points"], 8);
  EXPECT_NEAR(result["highest_um"].get<double>(), 100.0, 1e-3);
  EXPECT_NEAR(result["lowest_um"].get<double>(), 0.0, 1e-9);
  EXPECT_NEAR(result["within_percent"].get<double>(), 50.0, 1e-9);
  std::size_t counted = 0;
  for (const json& bar : result["histogram"]) counted += bar["count"].get<std::size_t>();
  EXPECT_EQ(counted, 8u);
  EXPECT_TRUE(fs::exists(folder_ / "out.ply") && fs::exists(folder_ / "out.png"));
  write("moved.obj", cube_obj(0.0, 0.3));
  const Outcome aligned =
      run("compare moved.obj nominal.obj --tolerance 1um --align best-fit --json");
  EXPECT_EQ(aligned.exit_code, 0) << aligned.err << aligned.out;
  const std::string scan = read(folder_ / "part.obj");
  write("part.ply", read(folder_ / "out.ply"));
  for (const char* output : {"--mesh part.ply", "--mesh out.stl", "--picture part.ply"}) {
    const Outcome kept = run(std::string("compare part.ply nominal.obj ") + output);
    EXPECT_EQ(kept.exit_code, 2) << output;
  }
  EXPECT_EQ(read(folder_ / "part.ply"), read(folder_ / "out.ply"));
  EXPECT_EQ(read(folder_ / "part.obj"), scan);
  EXPECT_EQ(run("compare part.obj nominal.step").exit_code, 2);
  EXPECT_EQ(run("compare part.obj nominal.obj --tolerance 5").exit_code, 2);
  EXPECT_EQ(run("compare part.obj nominal.obj --align datum").exit_code, 2);
}

TEST_F(TestPieceSystem, ABenchmarkIsMadeAgainBitForBit) {
  write("keys", "m01 00112233445566778899aabbccddeeff\n");
  const Outcome made = run("benchmark make --keys keys --out b --json");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(read(folder_ / "b/machines/m01/s-piece/job.toml").find("seed = 0"), std::string::npos);
  const Outcome holds = run("benchmark verify b --json");
  EXPECT_EQ(holds.exit_code, 0) << holds.out;
  // The laws alone, and what was measured of a cone: better.
  for (const char* data : {"prior", "cone", "motion"}) {
    const std::string name = data;
    ASSERT_EQ(run("benchmark baseline b --data " + name + " --out " + name + " --quiet").exit_code,
              0);
  }
  const auto skill = [&](const std::string& name) {
    const json scores = json::parse(run("benchmark score b " + name + " --json").out);
    return scores["machines"][0]["points"]["skill"].get<double>();
  };
  EXPECT_LT(std::abs(skill("prior")), 1.0);
  EXPECT_GT(skill("cone"), 0.5);
  EXPECT_GT(skill("motion"), skill("cone"));
  // What was committed to stays.
  const std::string committed = read(folder_ / "b/commitments.json");
  write("other", "m01 ff112233445566778899aabbccddeeff\n");
  EXPECT_EQ(run("benchmark make --keys other --out b").exit_code, 2);
  EXPECT_EQ(read(folder_ / "b/commitments.json"), committed);
  // One byte more.
  std::ofstream(folder_ / "b/machines/m01/cone/points.csv", std::ios::app) << "\n";
  const Outcome differs = run("benchmark verify b --json");
  EXPECT_EQ(differs.exit_code, 1);
  EXPECT_EQ(json::parse(differs.out)["machines"][0]["differing"][0],
            "machines/m01/cone/points.csv");
}

TEST_F(TestPieceSystem, ScoresRefuseRowsWithTheirPlace) {
  write("b/answers/m01.json", R"({"points":{"q1":1.0,"q2":2.0},"poses":{},"errors":{"EX0C":3.0}})");
  write("b/prior/m01.csv", "id,sd\nq1,3\nq2,3\nEX0C,15\n");
  write("b/machines/m01/laws.csv", "name,unit,mean,sd\nEX0C,um,0,15\n");
  write("s/m01/errors.csv", "name,mean,sd,unit\nEX0C,3,1,um\n");
  const auto scored = [&](const std::string& rows) {
    write("s/m01/predictions.csv", "id,mean_um,sd_um\n" + rows);
    return run("benchmark score b s --json");
  };
  const Outcome good = scored("q1,1,1\nq2,2,1\n");
  ASSERT_EQ(good.exit_code, 0) << good.err;
  EXPECT_NEAR(json::parse(good.out)["machines"][0]["points"]["crps"].get<double>(),
              std::sqrt(2.0 / M_PI) - 1.0 / std::sqrt(M_PI), 1e-9);
  // Missing, or not finite: ten times the prior's.
  for (const char* rows : {"q1,1,1\n", "q1,1,1\nq2,nan,1\n"}) {
    const Outcome short_of = scored(rows);
    ASSERT_EQ(short_of.exit_code, 0) << short_of.err;
    const json points = json::parse(short_of.out)["machines"][0]["points"];
    EXPECT_EQ(points["missing"], 1);
    const double own = std::sqrt(2.0) - 1.0;
    EXPECT_NEAR(points["skill"].get<double>(), 1.0 - (own + 30.0) / 6.0, 1e-9);
  }
  for (const auto& [rows, place] : {std::pair{"q1,1,0\n", "predictions.csv:2:6"},
                                    {"q1,1,1\nq9,1,1\n", "predictions.csv:3:1"},
                                    {"q1,1,1\nq1,1,1\n", "predictions.csv:3:1"},
                                    {"q1,one,1\n", "predictions.csv:2:4"}}) {
    const Outcome bad = scored(rows);
    EXPECT_EQ(bad.exit_code, 2) << rows;
    EXPECT_NE(bad.err.find(place), std::string::npos) << bad.err;
  }
  write("s/m01/errors.csv", "name,mean,sd,unit\nEX0C,3,1,urad\n");
  EXPECT_NE(scored("q1,1,1\n").err.find("errors.csv:2:10"), std::string::npos);
  write("keys", "m99 00112233445566778899aabbccddeeff\n");
  EXPECT_NE(run("benchmark make --keys keys --out c").err.find("keys:1"), std::string::npos);
}

}  // namespace
}  // namespace frustum
