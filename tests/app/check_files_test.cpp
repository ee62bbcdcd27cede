// frustum check in continuous integration: many files, settings, suppression, baseline.
#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class CheckFilesSystem : public CommandLine {
 protected:
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
};

const std::string kFine = "G0 X1\nM30\n";
const std::string kWrong = "G0 X1\nG999\nM30\n";

TEST_F(CheckFilesSystem, Fault2_19_TakesSeveralFiles) {
  write("a.nc", kFine);
  write("b.nc", kWrong);
  const Outcome outcome = run("check a.nc b.nc --quiet");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(has(outcome.out, "b.nc:2:1: error: unknown word G999 [program-error]"))
      << outcome.out;
  EXPECT_TRUE(has(outcome.out, "1 error, 0 warnings, 0 notes in 5 blocks that ran, 2 programs\n"))
      << outcome.out;
  EXPECT_EQ(outcome.err, "");
  const json doc = json::parse(run("check a.nc b.nc a.nc --json").out);
  EXPECT_EQ(doc["status"], "fail");
  EXPECT_EQ(doc["counts"]["error"], 1);
  ASSERT_EQ(doc["files"].size(), 2U);
  EXPECT_EQ(doc["files"][0]["status"], "pass");
  EXPECT_EQ(doc["files"][1]["findings"][0]["id"], "program-error");
}

TEST_F(CheckFilesSystem, Fault2_19_TakesFoldersAndKnowsProgramsByEndingOrContent) {
  write("parts/a.nc", kWrong);
  write("parts/deep/O1000", "%\nO1000\nN10 G0 X1 Y2\nN20 G0 Z5\nM30\n%\n");
  write("parts/part.h", "BEGIN PGM P MM\nL X+1 Y+2 FMAX\nL Z+5 FMAX\nM30\nEND PGM P MM\n");
  write("parts/header.h", "#include <vector>\nint main() { return 0; }\n");
  write("parts/notes.md", "# Parts\n\nX= is 5 here. Run them all.\n\n- a list\n- of words\n");
  write("parts/data.csv", "a,b\n1,2\n3,4\n");
  write("parts/picture.nc", std::string("\0\1\2\3", 4));
  write("parts/.hidden/b.nc", kWrong);
  const json doc = json::parse(run("check parts --json").out);
  std::string files;
  for (const json& each : doc["files"]) files += each["file"].get<std::string>() + " ";
  EXPECT_EQ(files, "parts/a.nc parts/deep/O1000 parts/part.h ");
}

TEST_F(CheckFilesSystem, Fault2_19_TakesTheStandardInput) {
  write("b.nc", kWrong);
  const Outcome outcome = shell("frustum check - --quiet < b.nc");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_TRUE(
      has(outcome.out, "<stdin>:2:1: error: unknown word G999 [program-error]\n     2 | G999\n"))
      << outcome.out;
}

TEST_F(CheckFilesSystem, WhatCannotBeReadIsTroubleAndTheRestIsChecked) {
  write("b.nc", kWrong);
  const Outcome outcome = run("check no-such.nc b.nc --sarif found.sarif");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(has(outcome.err, "no-such.nc")) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "b.nc:2:1: error")) << outcome.out;
  const json run = json::parse(read(folder_ / "found.sarif"))["runs"][0];
  EXPECT_EQ(run["invocations"][0]["executionSuccessful"], false);
  EXPECT_EQ(run["results"].size(), 1U);
}

TEST_F(CheckFilesSystem, SettingsAreFoundUpwards) {
  write(".frustum.toml", "fail_on = \"warning\"\n");
  write("old/.frustum.toml", "disable = [\"end-incremental\"]\n");
  write("new/deep/part.nc", "G0 X1\nG91\nM30\n");
  write("old/part.nc", "G0 X1\nG91\nM30\n");
  EXPECT_EQ(run("check new/deep/part.nc").exit_code, 1);
  EXPECT_TRUE(has(run("check new/deep/part.nc").err, "note: settings of "));
  EXPECT_EQ(run("check new/deep/part.nc --no-config").exit_code, 0);
  EXPECT_EQ(run("check new/deep/part.nc --fail-on error").exit_code, 0);
  EXPECT_TRUE(has(run("check old/part.nc").out, "0 warnings"));
  EXPECT_EQ(run("check new old").exit_code, 1);
}

TEST_F(CheckFilesSystem, SettingsHaveMachineWordsAndFolders) {
  write(".frustum.toml",
        "machine = \"iwf-bc\"\ntool_length = [\"1=100\"]\noffset = [\"G54=0,0,0\"]\n"
        "exclude = [\"old\", \"*_t.nc\"]\nendings = [\"prg\"]\nsearch = [\"macros\"]\n"
        "[controller]\nwords = [\"M250\"]\n");
  write("macros/O9010.nc", "O9010\nG0 X5\nM99\n");
  write("parts/a.prg", "G0 X412\nM250\nG65 P9010\nM30\n");
  write("parts/b_t.nc", kWrong);
  write("old/c.nc", kWrong);
  const json doc = json::parse(run("check parts old --json").out);
  ASSERT_EQ(doc["files"].size(), 1U);
  EXPECT_EQ(doc["files"][0]["machine"], "iwf-bc");
  EXPECT_FALSE(has(doc.dump(), "builder-word")) << doc;
  EXPECT_EQ(doc["files"][0]["findings"][0]["id"], "over-travel");
}

TEST_F(CheckFilesSystem, AMisspeltKeyOfTheSettingsIsAnErrorWithItsPlace) {
  write("part.nc", kFine);
  for (const char* text : {"fail_no = \"warning\"\n", "disable = [\"no-such\"]\n", "machine = 5\n",
                           "[controller]\nword = []\n", "fail_on = \"all\"\n"}) {
    write(".frustum.toml", std::string("# settings\n") + text);
    const Outcome outcome = run("check part.nc");
    EXPECT_EQ(outcome.exit_code, 2) << text;
    EXPECT_TRUE(has(outcome.err, ".frustum.toml:")) << outcome.err;
  }
  write(".frustum.toml", "\nfail_no = \"warning\"\n");
  const std::string said = run("check part.nc").err;
  EXPECT_TRUE(has(said, ".frustum.toml:2:") && has(said, "fail_on")) << said;
}

TEST_F(CheckFilesSystem, CommentsSuppressAndCount) {
  write("part.nc", "G0 X1\nG999 (frustum: ignore program-error -- the caller has one)\nM30\n");
  const Outcome outcome = run("check part.nc --quiet --disable not-simulated");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "0 errors, 0 warnings, 0 notes, 1 suppressed in ")) << outcome.out;
  const json doc = json::parse(run("check part.nc --json").out);
  EXPECT_EQ(doc["status"], "pass");
  EXPECT_EQ(doc["suppressed"][0]["suppressed"], "comment");
  EXPECT_EQ(doc["suppressed"][0]["reason"], "the caller has one");
}

TEST_F(CheckFilesSystem, ABaselineTakesKnownFindingsAway) {
  write("parts/a.nc", kWrong);
  const Outcome written = run("check parts --baseline known.json --write-baseline");
  EXPECT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(run("check parts --baseline known.json").exit_code, 0);
  write("parts/a.nc", "(moved)\n" + kWrong);
  const Outcome moved = run("check parts --baseline known.json --sarif found.sarif");
  EXPECT_EQ(moved.exit_code, 0) << moved.out;
  const json result = json::parse(read(folder_ / "found.sarif"))["runs"][0]["results"][0];
  EXPECT_EQ(result["suppressions"][0]["kind"], "external");
  write("parts/b.nc", kWrong);
  EXPECT_EQ(run("check parts --baseline known.json").exit_code, 1);
  write("parts/a.nc", kFine);
  EXPECT_TRUE(has(run("check parts --baseline known.json").err, "1 finding of known.json is gone"));
  EXPECT_EQ(run("check parts --baseline no-such.json").exit_code, 2);
}

TEST_F(CheckFilesSystem, ABaselineNeedsAName) {
  write("a.nc", kWrong);
  EXPECT_EQ(run("check a.nc --write-baseline").exit_code, 2);
}

TEST_F(CheckFilesSystem, RapidsThroughTheStockOfAJobAreFindings) {
  write("job.toml",
        "title = \"a block\"\nmachine = \"three-axis\"\n"
        "program = { file = \"part.nc\", dialect = \"fanuc\" }\n"
        "blank = { shape = \"box\", size = [40, 40, 20] }\n"
        "tool.1 = { type = \"flat\", diameter = 10, length = 100, flute_length = 30 }\n"
        "setup = { origin = [0, 0, 0] }\n");
  const std::string head = "T1 M6\nS1000 M3\nG54 G43 H1\nG0 X-40 Y0 Z50\nG0 Z-5\n";
  const std::string end = "G0 Z60\nM5\nM30\n";
  write("part.nc", head + "G0 X40\n" + end);
  const Outcome outcome = run("check --job job.toml");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.err;
  EXPECT_TRUE(has(outcome.out, "part.nc:6:1: error: rapid move (G0) through material: tool T1"))
      << outcome.out << outcome.err;
  EXPECT_TRUE(has(outcome.out, "[rapid-in-material]")) << outcome.out;
  write("fine.nc", head + "G1 X40 F500\n" + end);
  EXPECT_EQ(run("check fine.nc --job job.toml").exit_code, 0)
      << run("check fine.nc --job job.toml").out;
}

}  // namespace
}  // namespace frustum
