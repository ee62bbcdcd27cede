// frustum study as users and scripts see it: what it draws, finds and refuses.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"
#include "tests/law_count.hpp"

namespace frustum {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class StudySystem : public CommandLine {
 protected:
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  // A cone with few chords and points: a trial takes a tenth of the time.
  void write_cone() const {
    const Outcome made =
        run("program cone --machine iwf-bc --chord-tolerance 2 --out piece --cone-angle 45 "
            "--inclination 30");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    std::string plan = read(folder_ / "piece/cone.plan.toml");
    for (std::size_t at = 0; (at = plan.find("points_per_section = 360", at)) != std::string::npos;)
      plan.replace(at, 24, "points_per_section = 24");
    write("piece/cone.plan.toml", plan);
  }
  void write_cone_study(const std::string& more) const {
    write("study.toml", "job = \"piece/job.toml\"\nengine = \"full\"\n" + more +
                            "[errors]\nEX0C = \"uniform -10um..10um\"\nEB0C = \"normal 0urad sd "
                            "20urad\"\n");
  }
  json result_of(const std::string& arguments, int exit_code = 0) const {
    const Outcome outcome = run("study " + arguments + " --json");
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    return outcome.out.empty() ? json() : json::parse(outcome.out);
  }
  static json find(const json& list, const std::string& name) {
    for (const json& item : list) {
      if (item["name"] == name) return item;
    }
    return {};
  }
  static double quantile(const json& characteristic, double p) {
    for (const json& q : characteristic["quantiles"]) {
      if (q["p"] == p) return q["value"];
    }
    return -1.0;
  }
  // The machine of the volumetric thesis, all tolerances read as three standard deviations.
  static std::string volumetric() {
    std::string text =
        "target = \"volumetric\"\nmachine = \"dvf5000\"\naxes = \"X=0,Y=-225,Z=-480,B=0,C=0\"\n"
        "tool_length = 150\n[errors]\n";
    for (const char* axis : {"X", "Y", "Z"}) {
      for (const char* at : {"x", "y", "z"}) {
        text += std::string("d") + at + axis + " = \"nominal 0um tolerance 10um\"\n";
        text += std::string("e") + at + axis + " = \"nominal 0urad tolerance 20urad\"\n";
      }
    }
    for (const char* name : {"gXY", "aYZ", "bXZ"})
      text += std::string(name) + " = \"nominal 0urad tolerance 25urad\"\n";
    return text + "[tolerances]\nread_as = \"normal-3sd\"\n";
  }
};

TEST_F(StudySystem, DrawsTheMachinesThatRunDraws) {
  write_cone();
  write_cone_study("");
  write("errors.toml",
        "title = \"the same\"\nmachine = \"iwf-bc\"\n[errors]\nEX0C = \"uniform "
        "-10um..10um\"\nEB0C = "
        "\"normal 0urad sd 20urad\"\n");
  const json study = result_of("study.toml --samples 2 --seed 7 --csv draws.csv");
  const Outcome alone = run("run piece/job.toml --errors errors.toml --draw 7 --json --out out");
  ASSERT_LE(alone.exit_code, 1) << alone.err;
  const json one = find(json::parse(alone.out)["characteristics"], "cone.equivalent_form");
  std::istringstream csv(read(folder_ / "draws.csv"));
  std::string head, first;
  std::getline(csv, head);
  std::getline(csv, first);
  EXPECT_TRUE(head.starts_with("draw,characteristics/cone.equivalent_form,")) << head;
  const double drawn = std::stod(first.substr(first.find(',') + 1));
  EXPECT_NEAR(drawn, one["value"].get<double>(), 1e-9);
  EXPECT_EQ(study["engine"]["name"], "full");
}

// The cone alone, without datums: every contact is followed from the middle machine.
TEST_F(StudySystem, FollowedMachinesMakeWhatTheirTrialsDo) {
  write_cone();
  std::string plan = read(folder_ / "piece/cone.plan.toml"), cone;
  for (std::size_t at = 0; at < plan.size();) {
    const std::size_t next = std::min(plan.find("\n[", at), plan.size() - 1);
    const std::string block = plan.substr(at, next + 1 - at);
    const bool is_other = block.starts_with("[datum]") || block.starts_with("[[");
    if (!is_other || block.find("\nname = \"cone\"") != std::string::npos ||
        block.find("\nname = \"cone.form\"") != std::string::npos) {
      cone += block;
    }
    at = next + 1;
  }
  cone.replace(cone.find("\"datum\""), 7, "\"plan\"");
  write("piece/cone.plan.toml", cone);
  write_cone_study("");
  const json study = result_of("study.toml --samples 1 --seed 7");
  EXPECT_FALSE(study["engine"].contains("reason")) << study["engine"]["reason"];
  const double followed = find(study["characteristics"], "cone.form")["mean"];
  write("errors.toml",
        "title = \"the same\"\nmachine = \"iwf-bc\"\n[errors]\nEX0C = \"uniform "
        "-10um..10um\"\nEB0C = \"normal 0urad sd 20urad\"\n");
  const Outcome alone = run("run piece/job.toml --errors errors.toml --draw 7 --json --out out");
  const json one = find(json::parse(alone.out)["characteristics"], "cone.form");
  EXPECT_NEAR(followed, one["value"].get<double>(), 0.02);  // um: twice the path's own bound
}

TEST_F(StudySystem, ReportsWhatItFoundWithIntervals) {
  write_cone();
  write_cone_study("");
  const json study = result_of("study.toml --samples 60 --out out");
  EXPECT_EQ(study["samples"], 60);
  const json form = find(study["characteristics"], "cone.equivalent_form");
  EXPECT_EQ(form["unit"], "um");
  EXPECT_EQ(form["limit"], 100.0);
  EXPECT_EQ(form["conform"]["n"], 60);
  EXPECT_LT(quantile(form, 0.05), quantile(form, 0.95));
  EXPECT_LE(form["min"].get<double>(), quantile(form, 0.05));
  for (const json& q : form["quantiles"]) {
    if (q["p"] != 0.5) continue;
    EXPECT_LT(q["ci95"][0].get<double>(), q["value"].get<double>());
    EXPECT_GT(q["ci95"][1].get<double>(), q["value"].get<double>());
  }
  const json angle = find(study["characteristics"], "cone.half_angle");
  EXPECT_EQ(angle["unit"], "urad");
  EXPECT_LT(angle["min"].get<double>(), 0.0) << "a deviation from the nominal";
  EXPECT_EQ(json::parse(read(folder_ / "out/result.json")), study);
}

TEST_F(StudySystem, KnowsNormalLengthsExactly) {
  write("v.toml", volumetric());
  const json study = result_of("v.toml --samples 20000");
  const json error = study["characteristics"][0];
  EXPECT_EQ(error["name"], "volumetric.error");
  // ../spec/expected/studies.json, volumetric, "tool corner/general"
  EXPECT_NEAR(error["exact"]["mean"].get<double>(), 26.2379148006, 1e-4);
  EXPECT_NEAR(error["exact"]["rms"].get<double>(), 28.9610397776, 1e-4);
  EXPECT_NEAR(quantile(error["exact"], 0.95), 48.7774749452, 1e-4);
  // Five standard errors, and what is of second order.
  EXPECT_NEAR(error["mean"].get<double>(), 26.2379148006,
              5.0 * error["mean_se"].get<double>() + 0.01);
}

TEST_F(StudySystem, AJobAloneIsAStudyWithTheDefaults) {
  write_cone();
  const Outcome none = run("study piece/job.toml --samples 2");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("draw")) << "nothing in it is drawn";
  const json study =
      result_of("piece/job.toml --samples 2 --engine full --error \"EX0C=uniform -10um..10um\"");
  EXPECT_EQ(study["seed"], 1);
  EXPECT_EQ(study["scheme"], "random");
  EXPECT_TRUE(fs::exists(folder_ / "piece/job.out/result.json"));
}

TEST_F(StudySystem, SaysByItsExitCodeWhatWasNotReached) {
  write("v.toml", volumetric() + "[limits]\n\"volumetric.error\" = \"24 um\"\nat_least = 0.9\n");
  const Outcome bad = run("study v.toml --samples 500");
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.err, HasSubstr("is below 0.9"));
  write("w.toml", volumetric());
  const json stopped =
      result_of("w.toml --samples 100000 --stop \"volumetric.error q50=0.4um\" --out s");
  EXPECT_EQ(stopped["samples"], 4096 * 2) << "after 4096 the half width is about 0.5";
  (void)result_of("w.toml --samples 5000 --stop \"volumetric.error q50=0.01um\"", 1);
}

// By itself it goes to whole trials, and says why; asked for the linear engine, it refuses.
TEST_F(StudySystem, TakesWholeTrialsWhereErrorsDoNotActLinearly) {
  write_cone();
  write("piece/cone.plan.toml", read(folder_ / "piece/cone.plan.toml") +
                                    "\n[[characteristic]]\nname = \"flange.flatness\"\nkind = "
                                    "\"flatness\"\nfeature = \"flange\"\ntolerance = \"100 um\"\n");
  const std::string cone = "job = \"piece/job.toml\"\n[errors]\n";
  const std::string pose =
      "target = \"volumetric\"\nmachine = \"iwf-bc\"\naxes = "
      "\"X=100,Y=-50,Z=200,B=-30,C=40\"\n[errors]\n";
  const std::string beside = "whole trials differ from the linear model by";
  const struct {
    const char* what;
    std::string study, reason;
  } cases[] = {
      {"an axis that turns at a probe", cone + "EXX = \"reversal uniform 0um..4um\"\n", beside},
      {"a dish", cone + "EBX = \"linear uniform -300urad..300urad\"\n", beside},
      {"small errors", pose + "EB0C = \"uniform -20urad..20urad\"\n", ""},
      {"a thousand times larger", pose + "EB0C = \"uniform -20mrad..20mrad\"\n", "above 0.05 um"},
  };
  for (const auto& c : cases) {
    write("s.toml", c.study);
    const json engine = result_of("s.toml --samples 2")["engine"];
    EXPECT_EQ(engine["name"], c.reason.empty() ? "linear" : "full") << c.what;
    if (!c.reason.empty()) {
      EXPECT_THAT(engine["reason"].get<std::string>(), HasSubstr(c.reason)) << c.what;
    }
  }
  if (proof::laws_are_reduced()) return;  // all controls
  write("s.toml", cases[1].study);
  const Outcome asked = run("study s.toml --samples 2 --engine linear");
  EXPECT_EQ(asked.exit_code, 2);
  EXPECT_THAT(asked.err, HasSubstr("grows 2.00 fold"));
}

TEST_F(StudySystem, RisksAndSharesAreAsked) {
  write("v.toml", volumetric() +
                      "[limits]\n\"volumetric.error\" = \"40 um\"\n[measurement]\nu = \"2 um\"\n"
                      "[risk]\nrules = [\"simple\", \"guard 1.0\", \"consumer 0.005\"]\n"
                      "[shares]\ngroups = { angles = [\"E[ABC]?\"], rest = [\"E[XYZ]?\"] }\n");
  const Outcome refused = run("study v.toml --samples 2000");
  EXPECT_EQ(refused.exit_code, 2) << "no such patterns";
  EXPECT_THAT(refused.err, HasSubstr("error: shares.groups: "));
  std::string text = read(folder_ / "v.toml");
  const std::string from = "{ angles = [\"E[ABC]?\"], rest = [\"E[XYZ]?\"] }";
  text.replace(text.find(from), from.size(),
               "{ angles = [\"e??\"], displacements = [\"d??\"], square = [\"gXY\", \"aYZ\", "
               "\"bXZ\"] }");
  write("v.toml", text);
  const json study = result_of("v.toml --samples 2000");
  const json error = study["characteristics"][0];
  ASSERT_EQ(error["risks"].size(), 3U);
  EXPECT_EQ(error["risks"][1]["rule"], "guard 1.0");
  EXPECT_NEAR(error["risks"][1]["acceptance_limit"].get<double>(), 36.0, 1e-9);
  EXPECT_LT(error["risks"][1]["consumer"].get<double>(),
            error["risks"][0]["consumer"].get<double>());
  EXPECT_NEAR(error["risks"][2]["consumer"].get<double>(), 0.005, 1e-4);
  double sum = 0.0;
  for (const json& group : study["shares"][0]["groups"]) {
    sum += group["mean_square"].get<double>();
  }
  EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST_F(StudySystem, RefusesBadInputAllAtOnceWithPlaceAndRemedy) {
  write_cone();
  write("bad.toml", R"(job = "piece/job.toml"
samples = 0
scheme = "sobbol"
engin = "auto"
[errors]
EX0C = "uniform -10um..10um"
EX0D = "uniform -10um..10um"
[limits]
"cone.equivalent" = "10 um"
"cone.half_angle" = "10 um"
"cone.form" = 3
[measurement]
u = "0 um"
[stop]
"cone.form q500" = "0.1 um"
)");
  const Outcome bad = run("study bad.toml --engine sloppy");
  EXPECT_EQ(bad.exit_code, 2);
  for (const char* words :
       {"bad.toml:2", "samples", "sobbol", "random", "engin", "EX0D", "cone.equivalent_form",
        "cone.half_angle", "urad", "no unit", "q500", "above 0", "sloppy"}) {
    EXPECT_THAT(bad.err, HasSubstr(words));
  }
  EXPECT_EQ(run("study bad.toml --samples 0").exit_code, 2);
}

TEST_F(StudySystem, RefusesWhatCannotBeDrawn) {
  const std::string pose =
      "target = \"volumetric\"\nmachine = \"iwf-bc\"\n[errors]\nEX0C = \"uniform -10um..10um\"\n"
      "EY0C = \"uniform -10um..10um\"\n";
  const struct {
    std::string more;
    std::string words;
  } cases[] = {
      {"[[correlated]]\nnames = [\"EX0C\", \"EY0C\"]\ncorrelation = [[1, 1.2], [1.2, 1]]\n",
       "eigenvalue"},
      {"[[correlated]]\nnames = [\"EX0C\", \"EY0C\"]\ncorrelation = [[1, 0.2], [0.3, 1]]\n",
       "symmetric"},
      {"[[correlated]]\nnames = [\"EX0C\", \"EY0D\"]\ncorrelation = [[1, 0.2], [0.2, 1]]\n",
       "EY0D"},
      {"[tolerances]\nscale = { \"EZ?\" = 0.5 }\n", "EZ?"},
      {"[shares]\ngroups = { one = [\"EX0C\"], two = [\"E?0C\"] }\n", "group"},
      {"[map]\ncone_angle = [45]\ninclination = [30]\ncenter = [[0, 0, 100]]\n", "cone"},
      {"[risk]\nrules = [\"simpel\"]\n", "simpel"},
  };
  for (const auto& c : cases) {
    write("bad.toml", pose + c.more);
    const Outcome bad = run("study bad.toml --samples 10");
    EXPECT_EQ(bad.exit_code, 2) << c.more;
    EXPECT_THAT(bad.err, HasSubstr(c.words)) << c.more;
  }
}

TEST_F(StudySystem, RefusesAllBadLawsAndGroupsAtOnceEachAtItsLine) {
  write("bad.toml", R"(target = "volumetric"
machine = "iwf-bc"
[errors]
EX0C = "uniform -10um..10um"
EY0C = "uniform -10um..10um"
EA0B = "unifrom -10urad..10urad"
EB0B = "uniform -10um..10um"
EC0B = "normal 0urad sd -3urad"
EXX = "liner 3um"
EYX = "field 3urad correlation 40mm"
[[correlated]]
names = ["EX0C", "EY0C"]
correlation = [[1, 1.2], [1.2, 1]]
[[correlated]]
names = ["EX0C", "EA0B"]
correlation = [[1, 0.2], [0.2, 2]]
[[correlated]]
names = ["EY0D", "EYX"]
correlation = [[1, 0.2], [0.3, 1]]
)");
  const Outcome bad = run("study bad.toml --error \"EX0C=noraml 0um sd 1um\"");
  EXPECT_EQ(bad.exit_code, 2);
  for (const char* words : {"bad.toml:6:1: error: errors.EA0B",
                            "did you mean uniform?",
                            "bad.toml:7:1",
                            "expected an angle",
                            "bad.toml:8:1",
                            "above 0",
                            "did you mean linear?",
                            "bad.toml:10:1",
                            "expected a length",
                            "bad.toml:13:1",
                            "its smallest eigenvalue is -0.2",
                            "bad.toml:15:1",
                            "EX0C is named twice",
                            "bad.toml:16:1",
                            "2 on its diagonal",
                            "bad.toml:18:1",
                            "EY0D is not a constant error",
                            "EYX is not",
                            "bad.toml:19:1",
                            "is not symmetric",
                            "did you mean normal?"}) {
    EXPECT_THAT(bad.err, HasSubstr(words));
  }
  EXPECT_THAT(bad.err, Not(HasSubstr("EA0B is not a constant"))) << "its law could not be read";
}

TEST_F(StudySystem, RefusesMoreDrawnNumbersThanASobolSequenceHas) {
  std::string study =
      "target = \"volumetric\"\nmachine = \"iwf-bc\"\nscheme = \"sobol\"\n[errors]\n";
  for (const char* error : {"EXX", "EYX", "EZX", "EXY", "EYY", "EZY", "EXZ", "EYZ", "EZZ"})
    study += error + std::string(" = \"field 3um correlation 0.5mm over 0mm..300mm\"\n");
  write("s.toml", study);
  const Outcome many = run("study s.toml --samples 10");
  EXPECT_EQ(many.exit_code, 2);
  EXPECT_THAT(many.err, HasSubstr("s.toml:3:1: error: scheme: the errors have"));
  EXPECT_THAT(many.err, HasSubstr("drawn numbers, a Sobol sequence at most 3667"));
}

TEST_F(StudySystem, NamesTheLineOfTheLimitThatTheNominalMachineFails) {
  write_cone();
  write_cone_study("[limits]\n\"cone.equivalent_form\" = \"0.001 um\"\n");
  const Outcome study = run("study study.toml --samples 2");
  EXPECT_EQ(study.exit_code, 2);
  EXPECT_THAT(study.err,
              HasSubstr("study.toml:4:1: error: limits.cone.equivalent_form: the machine "
                        "without errors makes"));
  std::string plan = read(folder_ / "piece/cone.plan.toml");
  const std::size_t at = plan.find("tolerance = \"100 um\"");
  ASSERT_NE(at, std::string::npos) << plan;
  plan.replace(at, 20, "tolerance = \"0.001 um\"");
  write("piece/cone.plan.toml", plan);
  const auto line =
      1 + std::count(plan.begin(), plan.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  write_cone_study("");
  const Outcome planned = run("study study.toml --samples 2");
  EXPECT_EQ(planned.exit_code, 2);
  EXPECT_THAT(planned.err, HasSubstr("cone.plan.toml:" + std::to_string(line) + ":1: error: "));
}

TEST_F(StudySystem, AndIdentifyRefuseEachOthersFilesWithAHint) {
  write_cone();
  write("measured.toml", "[[part]]\nname = \"one\"\njob = \"piece/job.toml\"\nmeasured = []\n");
  const Outcome study = run("study measured.toml");
  EXPECT_EQ(study.exit_code, 2);
  EXPECT_THAT(study.err, HasSubstr("frustum identify reads it"));
  write_cone_study("");
  const Outcome identify = run("identify study.toml");
  EXPECT_EQ(identify.exit_code, 2);
  EXPECT_THAT(identify.err, HasSubstr("frustum study"));
}

}  // namespace
}  // namespace frustum
