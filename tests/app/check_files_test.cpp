// frustum check in continuous integration: many files, settings, suppression, baseline.
#include <unistd.h>

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

const std::string kFine = "G21 G0 X1\nM30\n";
const std::string kWrong = "G21 G0 X1\nG999\nM30\n";

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
  EXPECT_EQ(files, "parts/a.nc parts/deep/O1000 parts/part.h parts/picture.nc ");
}

TEST_F(CheckFilesSystem, WhatIsNamedAsAProgramIsCheckedWhateverIsInIt) {
  write("tapes/blank.nc", kWrong + std::string(64, '\0'));
  std::string wide;
  for (const char c : kWrong) wide += {c, '\0'};
  write("wide/a.nc", wide);
  EXPECT_TRUE(has(run("check tapes").out, "tapes/blank.nc:2:1: error: unknown word G999"));
  EXPECT_EQ(run("check wide").exit_code, 1);
}

TEST_F(CheckFilesSystem, WhatAFolderHasAndCannotBeReadIsTrouble) {
  write("parts/a.nc", kFine);
  fs::create_symlink("nowhere.nc", folder_ / "parts/gone.nc");
  const Outcome outcome = run("check parts");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(has(outcome.err, "parts/gone.nc: error: the file cannot be read")) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "1 program") || has(outcome.out, "in 2 blocks")) << outcome.out;
  write(".frustum.toml", "exclude = [\"gone.nc\"]\n");
  EXPECT_EQ(run("check parts").exit_code, 0);
}

TEST_F(CheckFilesSystem, AFolderWithoutAProgramIsTrouble) {
  write("parts/notes.md", "# Parts\n");
  const Outcome outcome = run("check parts --json");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(has(outcome.err, "there is no program in this folder")) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["troubles"][0]["diagnostic"], "no-program");
  write("parts/a.nc", kWrong);
  write(".frustum.toml", "exclude = [\"a.nc\"]\n");
  EXPECT_EQ(run("check parts").exit_code, 0) << "the settings say so";
}

TEST_F(CheckFilesSystem, AFolderThatTheSettingsExcludeIsNone) {
  write("old/a.nc", kWrong);
  for (const char* pattern : {"old", "old/", "./old", "**/old", "/old", "old/*", "old/a.nc"}) {
    write(".frustum.toml", std::string("exclude = [\"") + pattern + "\"]\n");
    const Outcome outcome = run("check old");
    EXPECT_EQ(outcome.exit_code, 0) << pattern << outcome.err;
    EXPECT_TRUE(has(outcome.err, "but what the settings exclude")) << outcome.err;
  }
}

TEST_F(CheckFilesSystem, ExcludedNamesAreThoseOfFoldersWithinToo) {
  write("parts/a.nc", kFine);
  write("parts/sub/old/b.nc", kWrong);
  const auto checked = [&](const std::string& pattern) {
    write(".frustum.toml", "exclude = [\"" + pattern + "\"]\n");
    return json::parse(run("check parts --json").out)["files"].size();
  };
  EXPECT_EQ(checked("old"), 1U);
  EXPECT_EQ(checked("parts/sub/old"), 1U);
  EXPECT_EQ(checked("parts/old"), 2U);
  EXPECT_EQ(checked("/old"), 2U) << "from the folder of the settings";
}

TEST_F(CheckFilesSystem, TablesOfLinuxCncAreNoPrograms) {
  write("parts/a.nc", kFine);
  write("parts/tool.tbl", "T1 P1 D10 Z100\nT2 P2 D8 Z90\n");
  write("parts/tools.txt", "T1 P1 D10 Z100\nT2 P2 D8 Z90\n");
  write("parts/linuxcnc.var", "5161 0.0\n5162 0.0\n");
  write("parts/mill.nc", "T1 P1 D10 Z100\nT2 P2 D8 Z90\n");
  write(".frustum.toml", "tools = \"parts/mill.nc\"\n");
  const json doc = json::parse(run("check parts --json").out);
  ASSERT_EQ(doc["files"].size(), 1U) << doc;
}

TEST_F(CheckFilesSystem, AClosedFolderIsTrouble) {
  if (geteuid() == 0) GTEST_SKIP() << "nothing is closed to root";
  write("parts/a.nc", kFine);
  write("parts/closed/b.nc", kWrong);
  fs::permissions(folder_ / "parts/closed", fs::perms::none);
  const Outcome outcome = run("check parts");
  fs::permissions(folder_ / "parts/closed", fs::perms::owner_all);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(has(outcome.err, "parts/closed: error: the folder cannot be read")) << outcome.err;
}

TEST_F(CheckFilesSystem, AFileIsCheckedOnceHoweverItIsSpelt) {
  write("parts/a.nc", kWrong);
  const std::string all =
      "parts ./parts/a.nc parts/../parts/a.nc " + (folder_ / "parts/a.nc").string();
  EXPECT_EQ(json::parse(run("check " + all + " --json").out)["counts"]["error"], 1);
}

TEST_F(CheckFilesSystem, SubprogramsOfAFolderAreCheckedThroughTheirCallers) {
  write("parts/main.nc",
        "G21 T1 M6\nS1000 M3\nG43 H1\nG0 X0 Y0 Z50\nM98 P9010\nM98 P9020\nG0 Z60\nM5\nM30\n");
  write("parts/O9010.nc", "O9010\nG1 X5 F200\nG999\nM99\n");
  write("parts/O9020.nc", "O9020\nG1 X6\nM99\nM30\n");  // by its text a program
  const Outcome outcome = run("check parts --fail-on warning --json");
  const json doc = json::parse(outcome.out);
  EXPECT_EQ(outcome.exit_code, 1) << doc;  // M30 behind M99
  ASSERT_EQ(doc["files"].size(), 3U);
  EXPECT_EQ(doc["files"][0]["subprogram"], true);
  EXPECT_EQ(doc["files"][0]["findings"].size(), 0U) << doc;
  EXPECT_EQ(doc["files"][2]["findings"].size(), 1U) << "G999, which a caller tells";
  EXPECT_EQ(doc["files"][1]["subprogram"], true);
  ASSERT_EQ(doc["files"][1]["findings"].size(), 1U) << doc;
  EXPECT_EQ(doc["files"][1]["findings"][0]["id"], "unreachable-code");
  EXPECT_FALSE(doc["files"][2].contains("subprogram"));
  EXPECT_EQ(run("check parts/O9010.nc").exit_code, 1) << "named, it is a program";
}

TEST_F(CheckFilesSystem, NothingIsWrittenOverWhatIsRead) {
  write("a.nc", kWrong);
  write("known.json", "{\"frustum_baseline\": 1, \"findings\": []}\n");
  for (const char* words :
       {"a.nc --sarif a.nc", "a.nc --sarif ./a.nc", ". --sarif a.nc",
        "a.nc --baseline known.json --sarif known.json", "a.nc --baseline a.nc --write-baseline",
        "a.nc --baseline new.json --write-baseline --sarif new.json"}) {
    const Outcome outcome = run(std::string("check ") + words);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_TRUE(has(outcome.err, "would overwrite")) << outcome.err;
    EXPECT_EQ(read(folder_ / "a.nc"), kWrong) << words;
  }
  EXPECT_FALSE(fs::exists(folder_ / "new.json"));
}

TEST_F(CheckFilesSystem, SarifMayGoToTheStandardOutput) {
  write("a.nc", kWrong);
  const Outcome outcome = run("check a.nc --sarif - --quiet");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(json::parse(outcome.out)["version"], "2.1.0");
  EXPECT_EQ(run("check a.nc --sarif - --json").exit_code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "-"));
}

TEST_F(CheckFilesSystem, JsonTellsWhatCouldNotBeRead) {
  write("a.nc", kFine);
  const Outcome some = run("check a.nc no-such.nc --json");
  EXPECT_EQ(some.exit_code, 2);
  const json doc = json::parse(some.out);
  EXPECT_EQ(doc["status"], "fail");
  EXPECT_EQ(doc["files"][0]["status"], "pass");
  EXPECT_EQ(doc["troubles"][0]["file"], "no-such.nc") << doc;
  const json none = json::parse(run("check no-such.nc --json").out);
  EXPECT_EQ(none["status"], "fail");
  EXPECT_EQ(none["troubles"].size(), 1U);
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
  write("new/deep/part.nc", "G21 G0 X1\nG91\nM30\n");
  write("old/part.nc", "G21 G0 X1\nG91\nM30\n");
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
  write("parts/a.prg", "G21 G0 X412\nM250\nG65 P9010\nM30\n");
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

TEST_F(CheckFilesSystem, AWrongValueOfTheSettingsIsAnErrorWithItsPlace) {
  write("part.nc", kFine);
  for (const char* text :
       {"tool_length = [\"x\"]\n", "tool_diameter = [\"1=0\"]\n", "offset = [\"G99=1,2,3\"]\n",
        "start = \"Q1\"\n", "search = [\"nodir\"]\n", "disable = [\"end-coolantt\"]\n",
        "most_repeats = 0\n", "[controller]\nwords = [\"250\"]\n"}) {
    write(".frustum.toml", std::string("# settings\n") + text);
    const Outcome outcome = run("check part.nc");
    EXPECT_EQ(outcome.exit_code, 2) << text;
    EXPECT_TRUE(has(outcome.err, ".frustum.toml:2:") || has(outcome.err, ".frustum.toml:3:"))
        << outcome.err;
    EXPECT_FALSE(has(outcome.err, "disable: disable")) << outcome.err;
  }
}

TEST_F(CheckFilesSystem, CommentsSuppressAndCount) {
  write("part.nc", "G21 G0 X1\nG999 (frustum: ignore program-error -- the caller has one)\nM30\n");
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

TEST_F(CheckFilesSystem, ABaselineDoesNotHideWhatIsNew) {
  write("a.nc", "G21 G0 X1\nG999\nM250\nM30\n");
  EXPECT_EQ(run("check a.nc --baseline known.json --write-baseline").exit_code, 0);
  const std::string known = "check a.nc --baseline known.json --fail-on note";
  EXPECT_EQ(run(known).exit_code, 0);
  write("a.nc", "G21 G0 X1\nG999\nG999 X50\nM250\nM30\n");
  EXPECT_EQ(run(known).exit_code, 1);
  write("a.nc", "G21 G0 X1\nG999\nM250\nM250\nM30\n");
  EXPECT_EQ(run(known).exit_code, 1);
}

TEST_F(CheckFilesSystem, ABaselineSeesWhatIsNotListed) {
  const auto flood = [](int errors) {
    std::string text = "G21 G0 X1\n";
    for (int i = 0; i < errors; ++i) text += "G999\n";
    return text + "M30\n";
  };
  write("a.nc", flood(120));
  EXPECT_EQ(run("check a.nc --baseline known.json --write-baseline").exit_code, 0);
  EXPECT_EQ(run("check a.nc --baseline known.json").exit_code, 0);
  write("a.nc", flood(121));
  EXPECT_EQ(run("check a.nc --baseline known.json").exit_code, 1);
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
  const std::string head = "G21 T1 M6\nS1000 M3\nG54 G43 H1\nG0 X-40 Y0 Z50\nG0 Z-5\n";
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
  // In a subprogram that has a file of its own the line is of that file.
  write("part.nc", head + "M98 P1234\n" + end);
  write("O1234.nc", "O1234\n(the move)\nG0 X40\nM99\n");
  const Outcome called = run("check --job job.toml");
  EXPECT_TRUE(has(called.out, "O1234.nc:3:1: error: rapid move (G0) through material: tool T1"))
      << called.out << called.err;
}

}  // namespace
}  // namespace frustum
