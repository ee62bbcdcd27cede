// frustum study of a motion test: many machines before one instrument.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class StudyMotionSystem : public CommandLine {
 protected:
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  json result_of(const std::string& arguments) const {
    const Outcome outcome = run(arguments + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out.empty() ? json() : json::parse(outcome.out);
  }
  static json find(const json& study, const std::string& name) {
    for (const json& item : study["characteristics"]) {
      if (item["name"] == name) return item;
    }
    ADD_FAILURE() << "no characteristic " << name;
    return {};
  }
  // A value that all draws share.
  static double value(const json& study, const std::string& name) {
    const json of = find(study, name);
    EXPECT_EQ(of["min"], of["max"]) << name;
    return of["mean"];
  }
  static double quantile(const json& characteristic, double p) {
    for (const json& q : characteristic["quantiles"]) {
      if (q["p"] == p) return q["value"];
    }
    return -1.0;
  }
  static std::string every(int degrees) {
    std::string angles;
    for (int degree = 0; degree < 360; degree += degrees) {
      angles += (angles.empty() ? "" : ", ") + std::to_string(degree);
    }
    return angles;
  }
  void write_circle(const std::string& more = "") const {
    write("circle.toml",
          "test = \"circle\"\nmachine = \"iwf-bc\"\nplane = \"XY\"\nlength = 150\ncenter = [0, 0, "
          "150]\nangles = [" +
              every(3) + "]\n" + more);
  }
};

// Errors that do not scatter are those of `frustum motion run`.
TEST_F(StudyMotionSystem, DrawsTheMachinesThatMotionTestsRead) {
  const std::string errors =
      "[errors]\nEC0Y = \"-22 urad\"\nEXX = \"linear 8um over -200mm..200mm + reversal 3um\"\n"
      "EX0C = \"6 um\"\nEA0C = \"14 urad\"\n";
  const std::string drawn = errors + "EZZ = \"linear uniform 0um..0.000001um over 0mm..300mm\"\n";
  const struct {
    const char* what;
    std::string test;
    std::map<std::string, std::vector<std::string>> same;  // path in the test's document
  } cases[] = {
      {"circle",
       "plane = \"XY\"\nlength = 150\ncenter = [0, 0, 150]\n",
       {{"circle.G_ccw", {"evaluation", "G_ccw_ls"}},
        {"circle.G_bi", {"evaluation", "G_bi_ls"}},
        {"circle.D", {"evaluation", "D_mean_radial"}},
        {"circle.square", {"evaluation", "signature", "square_urad"}},
        {"circle.backlash_1", {"evaluation", "signature", "backlash_1"}}}},
      {"rotary",
       "axis = \"C\"\ndirection = \"radial\"\nball = [100, 0, 100]\nlength = 150\n",
       {{"rotary.form", {"evaluation", "form_um"}},
        {"rotary.mean", {"evaluation", "harmonics_um", "mean"}}}},
      {"cone",
       "cone_angle = \"45 deg\"\ninclination = \"30 deg\"\nradius = 40\ncenter = [-65, 0, 150]\n",
       {{"cone.form", {"evaluation", "form_um"}}}},
      {"chase",
       "ball = [120, 0, 80]\nat = \"C=0;C=60;C=120;C=180;B=-30,C=90\"\n",
       {{"chase.rms", {"evaluation", "rms_um"}}}},
      {"line",
       "axis = \"X\"\ntargets = [0, 50, 100, 150]\n",
       {{"line.A", {"evaluation", "A"}},
        {"line.E", {"evaluation", "E"}},
        {"line.B", {"evaluation", "B"}},
        {"line.straightness_Y", {"straightness_um", "Y", "minimum_zone"}}}},
  };
  for (const auto& each : cases) {
    SCOPED_TRACE(each.what);
    const std::string head =
        std::string("test = \"") + each.what + "\"\nmachine = \"iwf-bc\"\n" + each.test;
    write("one.toml", head + errors);
    write("many.toml", head + drawn);
    write("study.toml", "motion = \"many.toml\"\nengine = \"full\"\n");
    const json one = result_of("motion run one.toml");
    const json study = result_of("study study.toml --samples 3 --out study");
    fs::remove_all(folder_ / "study");
    for (const auto& [name, path] : each.same) {
      json of = one;
      for (const std::string& key : path) of = of[key];
      const json found = find(study, name);
      EXPECT_NEAR(found["mean"].get<double>(), of.get<double>(), 2e-6) << name;
    }
  }
}

// A squareness S alone makes an ellipse of G = |S| L; quantiles of a normal law's size are known.
TEST_F(StudyMotionSystem, SquarenessOfManyMachinesHasItsClosedForm) {
  write_circle();
  write("study.toml",
        "motion = \"circle.toml\"\n[errors]\nEC0Y = \"normal 0urad sd 20urad\"\n[limits]\n"
        "\"circle.G_bi\" = \"6 um\"\n[shares]\ncharacteristic = \"circle.G_bi\"\n");
  const json study = result_of("study study.toml --samples 20000");
  EXPECT_EQ(study["engine"]["name"], "linear") << study["engine"];
  const json g = find(study, "circle.G_bi");
  constexpr double kSd = 20.0 * 0.150;  // um
  for (const auto& [p, of_size] : {std::pair{0.5, 0.674490}, std::pair{0.95, 1.959964}}) {
    const double root_n = std::sqrt(20000.0);
    EXPECT_NEAR(quantile(g, p), kSd * of_size, 5.0 * kSd / root_n * (p > 0.9 ? 2.2 : 1.2));
  }
  EXPECT_NEAR(g["conform"]["p"].get<double>(), 0.954500, 5.0 * 0.00148) << "two sd";
  const json square = find(study, "circle.square");
  EXPECT_EQ(square["unit"], "urad");
  EXPECT_NEAR(square["sd"].get<double>(), 20.0, 5.0 * 20.0 / std::sqrt(40000.0));
  ASSERT_EQ(study["shares"][0]["groups"].size(), 1U);
  EXPECT_NEAR(study["shares"][0]["groups"][0]["mean_square"].get<double>(), 1.0, 1e-9);
}

// A centre that is off is the set-up's: no form sees it, and the offset of an axis has no share.
TEST_F(StudyMotionSystem, OffsetsOfTheTableHaveNoShareOfItsForm) {
  write(
      "rotary.toml",
      "test = \"rotary\"\nmachine = \"iwf-bc\"\naxis = \"C\"\ndirection = \"radial\"\nball = [100, "
      "0, 100]\nangles = [" +
          every(10) + "]\n");
  write("study.toml",
        "motion = \"rotary.toml\"\n[errors]\nEX0C = \"normal 0um sd 10um\"\nEXC = \"harmonic 2 "
        "normal 0um sd 2um\"\n[shares]\ncharacteristic = \"rotary.form\"\n");
  const json study = result_of("study study.toml --samples 500 --engine linear");
  const json groups = study["shares"][0]["groups"];
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0]["name"], "EXC");
  EXPECT_GT(groups[0]["mean_square"].get<double>(), 0.999);
  EXPECT_GT(groups[0]["total"].get<double>(), 0.99);
}

TEST_F(StudyMotionSystem, LinearAndFullAgreeOnSmallErrors) {
  write_circle(
      "[errors]\nEC0Y = \"uniform -20urad..20urad\"\nEXX = \"linear uniform -8um..8um over "
      "-200mm..200mm + reversal uniform 0um..3um\"\n");
  write("study.toml", "motion = \"circle.toml\"\n");
  const json full = result_of("study study.toml --samples 300 --engine full --out full");
  const json linear = result_of("study study.toml --samples 300 --engine linear --out linear");
  for (const char* name : {"circle.G_ccw", "circle.square", "circle.backlash_1"}) {
    EXPECT_NEAR(quantile(find(full, name), 0.5), quantile(find(linear, name), 0.5), 0.01) << name;
    EXPECT_NEAR(quantile(find(full, name), 0.95), quantile(find(linear, name), 0.95), 0.01) << name;
  }
}

// The scatter that the signature states for its noise is that of many measurements.
TEST_F(StudyMotionSystem, NoiseScattersAsTheSignatureStates) {
  write_circle("[instrument]\nnoise = \"0.5um\"\n");
  const json one = result_of("motion run circle.toml");
  write(
      "study.toml",
      "motion = \"circle.toml\"\n[errors]\nEC0Y = \"uniform 0urad..0.000001urad\"\n[measurement]\n"
      "noise = true\n");
  const json study = result_of("study study.toml --samples 4000");
  EXPECT_EQ(study["engine"]["name"], "full");
  const double sd = 0.5 * one["evaluation"]["signature_sd_per_um"]["square_urad"].get<double>();
  EXPECT_NEAR(find(study, "circle.square")["sd"].get<double>(), sd, 0.06 * sd);
  EXPECT_NEAR(value(result_of("study study.toml --samples 1 --out again"), "circle.square"),
              find(study, "circle.square")["mean"].get<double>(), 6.0 * sd);
}

// Samples are images in memory: nothing on the disk is looked at by their name.
TEST_F(StudyMotionSystem, AFolderThatIsCalledSamplesIsNoHindrance) {
  write_circle();
  write("study.toml", "motion = \"circle.toml\"\n[errors]\nEC0Y = \"normal 0urad sd 20urad\"\n");
  fs::create_directories(folder_ / "samples");
  const Outcome here = run("study study.toml --samples 20 --out .");
  EXPECT_EQ(here.exit_code, 0) << here.err;
  EXPECT_TRUE(fs::exists(folder_ / "samples/part-000000.h5"));
}

// Parts share out whole files of draws: of few draws the first has all.
TEST_F(StudyMotionSystem, PartsWithoutDrawsAreMerged) {
  write_circle();
  write("study.toml", "motion = \"circle.toml\"\n[errors]\nEC0Y = \"normal 0urad sd 20urad\"\n");
  for (const char* part : {"1", "2", "3"}) {
    const Outcome done =
        run(std::string("study study.toml --samples 300 --part ") + part + "/3 --out p" + part);
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  const json merged = result_of("study study.toml --samples 300 --merge p1 p2 p3 --out m");
  const json whole = result_of("study study.toml --samples 300 --out whole");
  EXPECT_EQ(merged["characteristics"], whole["characteristics"]);
}

TEST_F(StudyMotionSystem, SaysWhatItCannotStudy) {
  write_circle();
  const std::string law = "[errors]\nEC0Y = \"normal 0urad sd 20urad\"\n";
  write("touch.toml", "test = \"touch\"\nmachine = \"ac-probe\"\n");
  write("program.toml", read(folder_ / "circle.toml") + "program = \"circle.nc\"\n");
  write("circle.nc", "G21\nM30\n");
  write("short.toml", read(folder_ / "circle.toml") + "[instrument]\nstroke = 0.001\n");
  const struct {
    std::string study, says;
  } cases[] = {
      {"motion = \"touch.toml\"\n" + law, "has maps of errors"},
      {"motion = \"program.toml\"\n" + law, "runs no program"},
      {"motion = \"circle.toml\"\njob = \"job.toml\"\n" + law, "a motion test or a target"},
      {"motion = \"circle.toml\"\n" + law + "[measurement]\nnoise = true\n", "no noise"},
      {"motion = \"circle.toml\"\n" + law + "[limits]\n\"circle.G_both\" = \"3 um\"\n",
       "circle.G_bi"},
      {"motion = \"circle.toml\"\n" + law + "[limits]\n\"circle.square\" = \"3 um\"\n",
       "is a length"},
      {"motion = \"circle.toml\"\n[errors]\nEX0Q = \"1um\"\n", "EX0Q"},
      {"motion = \"none.toml\"\n" + law, "none.toml"},
      {"motion = \"circle.toml\"\n", "drawn"},
      {"motion = \"\"\n" + law, "names no file"},
      {"job = \"\"\n" + law, "names no file"},
      {"motion = \"short.toml\"\n[errors]\nEC0Y = \"normal 500urad sd 20urad\"\n", "stroke"},
      {read(folder_ / "circle.toml"), "motion = \"study.toml\""},
  };
  for (const auto& each : cases) {
    write("study.toml", each.study);
    const Outcome outcome = run("study study.toml --samples 5");
    EXPECT_EQ(outcome.exit_code, each.says == "stroke" ? 0 : 2) << each.study << outcome.err;
    EXPECT_THAT(outcome.err + outcome.out, HasSubstr(each.says)) << each.study;
  }
}

}  // namespace
}  // namespace frustum
