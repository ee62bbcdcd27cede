// frustum reference: man pages, completion and docs/commands.md.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using testing::HasSubstr;

class ReferenceSystem : public CommandLine {};

TEST_F(ReferenceSystem, TheDocumentOfCommandsIsThatOfTheProgram) {
  const Outcome written = run("reference --markdown commands.md");
  ASSERT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(read(folder_ / "commands.md"), read(fs::path(FRUSTUM_SOURCE_DIR) / "docs/commands.md"))
      << "build/frustum reference --markdown docs/commands.md";
}

TEST_F(ReferenceSystem, AnswersInOneDocument) {
  const Outcome said = run("reference --json");
  ASSERT_EQ(said.exit_code, 0) << said.err;
  const auto document = nlohmann::json::parse(said.out);
  EXPECT_EQ(document["schema"], "frustum/reference/1");
  EXPECT_EQ(document["program"]["commands"][0]["name"], "frustum run");
}

TEST_F(ReferenceSystem, EveryCommandHasAPageOfMan) {
  ASSERT_EQ(run("reference --man man1").exit_code, 0);
  for (const char* name :
       {"frustum", "frustum-run", "frustum-motion-circle", "frustum-reference"}) {
    const std::string page = read(folder_ / "man1" / (std::string(name) + ".1"));
    EXPECT_THAT(page, HasSubstr(".SH SYNOPSIS")) << name;
    EXPECT_THAT(page, HasSubstr(".SH OPTIONS")) << name;
  }
  EXPECT_THAT(read(folder_ / "man1/frustum-motion-circle.1"), HasSubstr("\\-\\-plane TEXT"));
}

// As bash calls it: the words so far, and the place of the one to complete.
TEST_F(ReferenceSystem, BashCompletesCommandsOptionsAndWords) {
  ASSERT_EQ(run("reference --completion comp").exit_code, 0);
  const struct {
    std::string words, expected;
    int at;
  } cases[] = {
      {"frustum moti", "motion", 1},
      {"frustum motion circ", "circle", 2},
      {"frustum motion circle --dial", "--dialect", 3},
      {"frustum motion circle --dialect sin", "sinumerik", 4},
      {"frustum fit cyl", "cylinder", 2},
  };
  for (const auto& each : cases) {
    const std::string script = "source comp/frustum; COMP_WORDS=(" + each.words +
                               "); COMP_CWORD=" + std::to_string(each.at) +
                               "; _frustum; echo \"${COMPREPLY[@]}\"";
    std::ofstream(folder_ / "ask.sh") << script << '\n';
    const Outcome said = shell("bash ask.sh");
    EXPECT_EQ(said.out, each.expected + "\n") << each.words << said.err;
  }
}

}  // namespace
}  // namespace frustum
