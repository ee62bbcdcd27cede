// frustum post, and test pieces in the languages of four controllers.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using PostCommandSystem = CommandLine;

struct Language {
  const char* name;
  const char* extension;
  const char* shows;  // a word of that language
};
constexpr Language kLanguages[] = {{"fanuc", ".nc", "M30\n%"},
                                   {"linuxcnc", ".ngc", "G91.1"},
                                   {"sinumerik", ".mpf", "TRAFOOF"},
                                   {"heidenhain", ".h", "BEGIN PGM"}};

const std::string kCoarseCone =
    "program cone --machine iwf-bc --out piece --chord-tolerance 100 --form ";

TEST_F(PostCommandSystem, RewritesAConeForEveryController) {
  ASSERT_EQ(run(kCoarseCone + "vector").exit_code, 0);
  for (const auto& [name, extension, shows] : kLanguages) {
    for (const std::string form : {"tcp", "axes"}) {
      const std::string out = "out" + form + extension;
      const Outcome made = run(std::string("post piece/cone.nc --job piece/job.toml --to ") + name +
                               " --output " + form + " --json -o " + out);
      ASSERT_EQ(made.exit_code, 0) << made.err;
      const auto told = nlohmann::json::parse(made.out);
      EXPECT_EQ(told["dialect"], name);
      EXPECT_GT(told["lines"], 100);
      EXPECT_EQ(told["inserted_points"] == 0, form == "tcp");
      const std::string text = read(folder_ / out);
      EXPECT_NE(text.find(shows), std::string::npos) << name;
      const Outcome parsed = run("parse " + out + " --canon --dialect " + name);
      EXPECT_EQ(parsed.exit_code, 0) << parsed.err;
    }
  }
}

TEST_F(PostCommandSystem, PlansEveryPartOfTheExamples) {
  for (const std::string part : {"blades", "crown", "flange", "freeform", "plate"}) {
    const std::string folder = FRUSTUM_SOURCE_DIR "/examples/parts/" + part;
    const Outcome made = run("post '" + folder + "/" + part + ".nc' --job '" + folder +
                             "/job.toml' --to linuxcnc --output axes --json -o out.ngc");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_GT(nlohmann::json::parse(made.out)["lines"], 200) << part;
  }
}

TEST_F(PostCommandSystem, RefusesWhatItCannotDoAndLeavesFilesAlone) {
  ASSERT_EQ(run(kCoarseCone + "vector").exit_code, 0);
  const std::string before = read(folder_ / "piece/cone.nc");
  const std::vector<std::pair<std::string, std::string>> refusals{
      {"post piece/cone.nc --job piece/job.toml --to fanuc -o piece/../piece/cone.nc", "overwrite"},
      {"post piece/cone.nc --machine iwf-bc --to fanuc --output axes -o x.nc", "--tool-length 1="},
      {"post piece/cone.nc --machine iwf-bc --to linuxcnc --output vectors -o x.nc",
       "LinuxCNC has no words for tool vectors"},
      {"post piece/none.nc --machine iwf-bc --to fanuc -o x.nc", "cannot be read"},
      {"post piece/cone.nc --to fanuc -o x.nc", "no machine"},
      {"post piece/cone.nc --machine iwf-bc --to klingon -o x.nc", "klingon"},
      {"post piece/cone.nc --machine iwf-bc --to fanuc -o none/x.nc", "none/x.nc"},
      {"post piece/cone.nc --machine iwf-bc --to fanuc --tool-length 1 -o x.nc", "NUMBER=LENGTH"},
      {"post piece/cone.nc --machine iwf-bc --to fanuc --offset G60=0,0,0 -o x.nc", "G54 to G59"},
      {"post piece/cone.nc --machine iwf-bc --to fanuc --tolerance 0 -o x.nc", "--tolerance"},
      {"post piece/cone.nc --machine three-axis --to fanuc -o x.nc", "cone.nc:"},
  };
  for (const auto& [arguments, says] : refusals) {
    const Outcome refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2) << arguments;
    EXPECT_NE(refused.err.find(says), std::string::npos) << arguments << "\n" << refused.err;
    EXPECT_FALSE(fs::exists(folder_ / "x.nc"));
  }
  EXPECT_EQ(read(folder_ / "piece/cone.nc"), before);
}

TEST_F(PostCommandSystem, TestPiecesSpeakEveryLanguageAndTheirJobsRun) {
  for (const auto& [name, extension, shows] : kLanguages) {
    const std::string dialect = name, folder = "step-" + dialect;
    const Outcome made = run("program step --machine zx-yac --patterns 1-a --out " + folder +
                             " --dialect " + dialect);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const std::string text = read(folder_ / folder / ("step" + std::string(extension)));
    EXPECT_NE(text.find(shows), std::string::npos) << name;
    EXPECT_NE(read(folder_ / folder / "job.toml").find("dialect = \"" + dialect + "\""),
              std::string::npos);
    EXPECT_EQ(run("run " + folder + "/job.toml --quiet --out out-" + dialect).exit_code, 0);
  }
  const Outcome cone = run(kCoarseCone + "axes --dialect heidenhain");
  ASSERT_EQ(cone.exit_code, 0) << cone.err;
  EXPECT_EQ(run(kCoarseCone + "vector --dialect linuxcnc").exit_code, 2);
}

}  // namespace
}  // namespace frustum
