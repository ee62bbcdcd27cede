// frustum benchmark: from the command line.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/app/command_line.hpp"
#include "tests/law_count.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class BenchmarkSystem : public CommandLine {
 protected:
  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
};

// A CSV of points with its columns and its rows the other way round.
std::string reordered(const std::string& csv) {
  std::vector<std::string> rows;
  for (std::size_t at = 0; at < csv.size();) {
    const std::size_t end = csv.find('\n', at);
    std::string row;
    for (std::size_t from = at; from <= end;) {
      const std::size_t to = std::min(csv.find(',', from), end);
      row = csv.substr(from, to - from) + (row.empty() ? "" : "," + row);
      from = to + 1;
    }
    rows.push_back(row + "\n");
    at = end + 1;
  }
  std::reverse(rows.begin() + 1, rows.end());
  std::string all;
  for (const std::string& row : rows) all += row;
  return all;
}

TEST_F(BenchmarkSystem, ABenchmarkIsMadeAgainBitForBit) {
  write("keys", "m01 00112233445566778899aabbccddeeff\n");
  const Outcome made = run("benchmark make --keys keys --out b --json");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(read(folder_ / "b/machines/m01/s-piece/job.toml").find("seed = 0"), std::string::npos);
  // Nor do the files of a machine depend on the version that made them.
  for (const char* file : {"cone/job.toml", "cone/cone.plan.toml", "contour/blank.ply"}) {
    const std::string bytes = read(folder_ / "b/machines/m01" / file);
    EXPECT_FALSE(bytes.empty()) << file;
    EXPECT_EQ(bytes.find("Made by"), std::string::npos) << file;
  }
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
  EXPECT_NE(read(folder_ / "cone/method.md").find("Data used: cone"), std::string::npos);
  // Columns and rows of points in another order are the same points.
  const std::string predicted = read(folder_ / "cone/m01/predictions.csv");
  const std::string points = read(folder_ / "b/machines/m01/cone/points.csv");
  write("b/machines/m01/cone/points.csv", reordered(points));
  ASSERT_EQ(run("benchmark baseline b --data cone --out cone --quiet").exit_code, 0);
  EXPECT_EQ(read(folder_ / "cone/m01/predictions.csv"), predicted);
  write("b/machines/m01/cone/points.csv", points + points.substr(points.find("cone,0")));
  const Outcome twice = run("benchmark baseline b --data cone --out cone --quiet");
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_NE(twice.err.find("points.csv:"), std::string::npos) << twice.err;
  EXPECT_NE(twice.err.find("at one planned point"), std::string::npos) << twice.err;
  write("b/machines/m01/cone/points.csv", points);
  // Files that the key does not make.
  write("b/machines/m01/cone/notes.txt", "");
  write("b/machines/m77/machine.toml", "");
  const Outcome more = run("benchmark verify b --json");
  EXPECT_EQ(more.exit_code, 1);
  EXPECT_EQ(json::parse(more.out)["machines"][0]["unexpected"],
            json::array({"machines/m01/cone/notes.txt"}));
  EXPECT_EQ(json::parse(more.out)["unexpected"], json::array({"machines/m77"}));
  fs::remove(folder_ / "b/machines/m01/cone/notes.txt");
  fs::remove_all(folder_ / "b/machines/m77");
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

TEST_F(BenchmarkSystem, ScoresRefuseRowsWithTheirPlace) {
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
  EXPECT_NE(scored("q1,1,1\n").err.find("1 question without a row: q2"), std::string::npos);
  fs::create_directories(folder_ / "s/m99");
  EXPECT_NE(scored("q1,1,1\n").err.find("m99: warning: no machine whose answers are known"),
            std::string::npos);
  fs::remove(folder_ / "s/m99");
  for (const auto& [rows, place] : {std::pair{"q1,1,0\n", "predictions.csv:2:6"},
                                    {"q1,nan,0\n", "predictions.csv:2:8"},
                                    {"q1,1e308,1\n", "predictions.csv:2:4"},
                                    {"q1,1,1e-320\n", "predictions.csv:2:6"},
                                    {"q1,1,1\nq9,1,1\n", "predictions.csv:3:1"},
                                    {"q1,1,1\nq1,1,1\n", "predictions.csv:3:1"},
                                    {"q1,one,1\n", "predictions.csv:2:4"}}) {
    const Outcome bad = scored(rows);
    EXPECT_EQ(bad.exit_code, 2) << rows;
    EXPECT_NE(bad.err.find(place), std::string::npos) << bad.err;
  }
  // Those that rank say how.
  fs::create_directories(folder_ / "b/submissions");
  fs::copy(folder_ / "s", folder_ / "b/submissions/s", fs::copy_options::recursive);
  write("b/submissions/s/m01/predictions.csv", "id,mean_um,sd_um\nq1,1,1\nq2,2,1\n");
  const Outcome unsaid = run("benchmark score b b/submissions/s");
  EXPECT_EQ(unsaid.exit_code, 2);
  EXPECT_NE(unsaid.err.find("method.md: error: there is no method.md"), std::string::npos)
      << unsaid.err;
  write("b/submissions/s/method.md", "Guessed from nothing.\n");
  EXPECT_EQ(run("benchmark score b b/submissions/s").exit_code, 0);
  EXPECT_NE(good.err.find("method.md: warning: there is no method.md"), std::string::npos);
  write("s/m01/errors.csv", "name,mean,sd,unit\nEX0C,3,1,urad\n");
  EXPECT_NE(scored("q1,1,1\n").err.find("errors.csv:2:10"), std::string::npos);
  write("keys", "m99 00112233445566778899aabbccddeeff\n");
  EXPECT_NE(run("benchmark make --keys keys --out c").err.find("keys:1"), std::string::npos);
}

// The skills of a row of scores.md: points, poses and errors of each machine.
std::vector<double> row_of(const std::string& table, const std::string& data) {
  const std::string name = "| " + data + " |";
  const auto first = table.find(name);
  std::vector<double> skills;
  if (first == std::string::npos) return skills;
  std::string row =
      table.substr(first + name.size(), table.find('\n', first) - first - name.size());
  std::ranges::replace_if(
      row, [](char c) { return c == '|' || c == ','; }, ' ');
  std::istringstream numbers(row);
  for (double skill = 0.0; numbers >> skill;) skills.push_back(skill);
  return skills;
}

// What scores.md says of our own baselines, made again: the more data, the better. Two minutes with
// all data, which `make laws` takes.
TEST_F(BenchmarkSystem, BaselinesOfTheOpenExamplesAreThoseOfTheTable) {
  const std::string benchmark = std::string("'") + FRUSTUM_SOURCE_DIR + "/benchmark'";
  const std::string table = read(fs::path(FRUSTUM_SOURCE_DIR) / "benchmark/scores.md");
  std::vector<std::string> all{"prior", "cone", "all"};
  all.resize(proof::law_count(3U, 2U));
  std::map<std::string, double> before;
  for (const std::string& data : all) {
    ASSERT_EQ(run("benchmark baseline " + benchmark + " --only m01,m02,m03,m04 --quiet --data " +
                  data + " --out " + data)
                  .exit_code,
              0);
    const Outcome scored = run("benchmark score " + benchmark + " " + data + " --json");
    ASSERT_EQ(scored.exit_code, 0) << scored.err;
    EXPECT_EQ(scored.err, "");
    const std::vector<double> stated = row_of(table, data);
    ASSERT_EQ(stated.size(), 12U) << data;
    std::size_t at = 0;
    const json scores = json::parse(scored.out);
    for (const json& machine : scores["machines"]) {
      const std::string id = machine["id"];
      std::cout << data << ' ' << id;
      for (const char* kind : {"points", "poses", "errors"}) {
        const double skill = machine[kind]["skill"].get<double>();
        EXPECT_NEAR(skill, stated[at], 0.001) << data << ' ' << id << ' ' << kind;
        std::cout << ' ' << kind << ' ' << skill;
        ++at;
      }
      std::cout << '\n';
      const double points = machine["points"]["skill"].get<double>();
      EXPECT_GT(points, before.contains(id) ? before[id] : -1.0) << id << " by " << data;
      before[id] = points;
    }
  }
  EXPECT_EQ(before.size(), 4U);
}

}  // namespace
}  // namespace frustum
