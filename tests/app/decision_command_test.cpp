// Uncertainties and decisions that a plan or a job asks for: verdicts, intervals and exit codes.
#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class DecisionSystem : public CommandLine {
 protected:
  // A coarse cone piece in folder_/piece on a CMM of 2 um. Its half angle is seen 7.4 urad off with
  // U = 26 urad; the tolerance is between them.
  void write_piece() const {
    const Outcome made = run("program cone --machine iwf-bc --out piece --chord-tolerance 1");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    in_job("cmm  = { e0 = \"0 um\" }", "cmm = { e0 = \"2 um\", seed = 1 }");
    in_plan("tolerance = \"600 urad\"", "tolerance = \"20 urad\"");
  }
  void in_job(const std::string& from, const std::string& to) const {
    replace_in("piece/job.toml", from, to);
  }
  void in_plan(const std::string& from, const std::string& to) const {
    replace_in("piece/cone.plan.toml", from, to);
  }
  void job_asks(const std::string& line) const {
    in_job("plan = \"cone.plan.toml\"", line + "\nplan = \"cone.plan.toml\"");
  }
  void plan_asks(const std::string& line) const { in_plan("alignment =", line + "\nalignment ="); }

  struct Told {
    int exit_code = -1;
    json all{};
    json half_angle{};
  };
  [[nodiscard]] Told measured() const {
    const Outcome outcome = run("measure piece/job.toml --json");
    Told told{outcome.exit_code, json::parse(outcome.out, nullptr, false), {}};
    EXPECT_FALSE(told.all.is_discarded()) << outcome.err;
    for (const json& c : told.all["characteristics"]) {
      if (c["name"] == "cone.half_angle") told.half_angle = c;
    }
    return told;
  }
  void expect_verdict(const std::string& verdict) const {
    const Told told = measured();
    EXPECT_EQ(told.half_angle["verdict"], verdict);
    EXPECT_EQ(told.half_angle["pass"], verdict == "pass");
    EXPECT_EQ(told.all["status"], verdict);
    EXPECT_EQ(told.exit_code, verdict == "pass" ? 0 : 1);
  }
};

TEST_F(DecisionSystem, ExitsWithOneWhereConformityIsNotProven) {
  write_piece();
  expect_verdict("pass");  // the value is within its tolerance
  job_asks("decision = \"iso14253\"");
  expect_verdict("uncertain");
  const Outcome whole = run("run piece/job.toml --out result --quiet");
  EXPECT_EQ(whole.exit_code, 1) << whole.err;
  EXPECT_EQ(json::parse(read(folder_ / "result/result.json"))["status"], "uncertain");
  EXPECT_NE(run("measure piece/job.toml").out.find("UNCERTAIN"), std::string::npos);
  in_plan("tolerance = \"20 urad\"", "tolerance = \"200 urad\"");
  expect_verdict("pass");
}

TEST_F(DecisionSystem, Fault2_60_SaysThatTheCmmFailsItsOwnTest) {
  write_piece();
  const auto tells = [&] {
    const Told told = measured();
    for (const json& d : told.all["diagnostics"]) {
      if (d["id"] == "cmm-acceptance") return true;
    }
    return false;
  };
  EXPECT_EQ(run("cmm piece/job.toml").exit_code, 1);
  EXPECT_TRUE(tells());
  in_job("e0 = \"2 um\"", "model = \"field\", e0 = \"2 um\", l_per_um = 300");
  EXPECT_EQ(run("cmm piece/job.toml").exit_code, 0);
  EXPECT_FALSE(tells());
}

TEST_F(DecisionSystem, FailsWhatIsWhollyOutside) {
  write_piece();
  job_asks("decision = \"iso14253\"");
  // The cutter's path makes 45 deg; the plan asks for 100 urad less.
  in_plan("half_angle = 45", "half_angle = \"0.785298163397448 rad\" # 45");
  expect_verdict("fail");
}

TEST_F(DecisionSystem, TheRuleOfAJobGoesBeforeThatOfItsPlan) {
  write_piece();
  plan_asks("decision = \"iso14253\"");
  expect_verdict("uncertain");
  job_asks("decision = \"simple\"");
  expect_verdict("pass");
}

TEST_F(DecisionSystem, SimulatesAsThePlanOrTheJobAsks) {
  write_piece();
  const Told linear = measured();
  EXPECT_EQ(linear.half_angle["coverage"], "95 %");
  EXPECT_FALSE(linear.half_angle.contains("draws"));
  plan_asks("uncertainty = { method = \"monte_carlo\", draws = 2000, seed = 3 }");
  const Told planned = measured();
  EXPECT_EQ(planned.half_angle["draws"], 2000);
  EXPECT_EQ(planned.half_angle["value"], linear.half_angle["value"]);
  EXPECT_NE(planned.half_angle["interval"], linear.half_angle["interval"]);
  for (const json& c : planned.all["characteristics"]) {
    ASSERT_EQ(c["interval"].size(), 2U) << c["name"];
    EXPECT_LE(c["interval"][0], c["interval"][1]) << c["name"];
    EXPECT_GT(c["standard_uncertainty"], 0.0) << c["name"];
    EXPECT_TRUE(c["stable"].is_boolean()) << c["name"];
  }
  EXPECT_EQ(measured().all["characteristics"], planned.all["characteristics"]);
  job_asks("uncertainty = { method = \"monte_carlo\", draws = 2001, seed = 3 }");
  EXPECT_EQ(measured().half_angle["draws"], 4000);  // whole blocks
  in_job("draws = 2001, seed = 3", "draws = 2000, seed = 4");
  EXPECT_NE(measured().half_angle["interval"], planned.half_angle["interval"]);
  in_job("method = \"monte_carlo\", draws = 2000, seed = 4", "method = \"linear\"");
  EXPECT_EQ(measured().half_angle["interval"], linear.half_angle["interval"]);
}

TEST_F(DecisionSystem, DecidesByTheSimulatedInterval) {
  write_piece();
  job_asks("decision = \"iso14253\"\nuncertainty = { method = \"monte_carlo\", draws = 2000 }");
  expect_verdict("uncertain");
  in_plan("tolerance = \"20 urad\"", "tolerance = \"200 urad\"");
  expect_verdict("pass");
  // Noise alone is seen as a form of 6 um. The simulation takes it for none, by what it thinks the
  // shape of the part to be: nothing is decided by that.
  in_plan("kind = \"cone_form\"\nfeature = \"cone\"\ntolerance = \"100 um\"",
          "kind = \"cone_form\"\nfeature = \"cone\"\ntolerance = \"3 um\"");
  const Told told = measured();
  EXPECT_EQ(told.half_angle["verdict"], "pass");
  EXPECT_EQ(told.all["status"], "uncertain");
  EXPECT_EQ(told.exit_code, 1);
  in_job("decision = \"iso14253\"", "decision = \"simple\"");
  EXPECT_EQ(measured().exit_code, 1);
}

TEST_F(DecisionSystem, RefusesWhatItDoesNotKnow) {
  write_piece();
  const std::string job = read(folder_ / "piece/job.toml");
  const struct {
    const char* line;
    std::vector<std::string> words;
  } cases[] = {
      {"decision = \"iso\"", {"inspection.decision", "'iso' is not one", "iso14253"}},
      {"uncertainty = { method = \"monte\" }", {"inspection.uncertainty.method", "monte_carlo"}},
      {"uncertainty = { draws = 2000 }", {"inspection.uncertainty.method", "missing"}},
      {"uncertainty = { method = \"monte_carlo\", digits = 3 }",
       {"inspection.uncertainty.digits", "must be 1 or 2, is 3"}},
      {"uncertainty = { method = \"monte_carlo\", draws = \"many\" }",
       {"inspection.uncertainty.draws", "adaptive"}},
      {"uncertainty = { method = \"monte_carlo\", draw = 3 }",
       {"inspection.uncertainty.draw", "did you mean draws?"}},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.line);
    std::ofstream(folder_ / "piece/job.toml", std::ios::binary) << job;
    job_asks(c.line);
    const Outcome outcome = run("measure piece/job.toml --json");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("job.toml:"), std::string::npos) << outcome.err;
    for (const std::string& word : c.words) {
      EXPECT_NE(outcome.err.find(word), std::string::npos) << "'" << word << "' in " << outcome.err;
    }
  }
}

TEST_F(DecisionSystem, RefusesAPlanThatNoPartCanHold) {
  write_piece();
  in_plan("features = [\"cylinder\", \"A\"]", "features = [\"groove\", \"cylinder\"]");
  const Outcome outcome = run("measure piece/job.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  for (const char* word : {"cone.plan.toml:", "characteristic[8].features",
                           "must be planned perpendicular, they are 0 deg apart"}) {
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace frustum
