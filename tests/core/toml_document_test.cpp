#include "core/toml_document.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frustum {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TomlDocument parsed(std::string_view text) {
  auto document = TomlDocument::parse(text, "jobs/job.toml");
  EXPECT_TRUE(document.has_value());
  return std::move(document).value();
}

std::vector<std::string> printed(const Diagnostics& diagnostics) {
  std::vector<std::string> lines;
  for (const Diagnostic& diagnostic : diagnostics) lines.push_back(to_string(diagnostic));
  return lines;
}
std::vector<std::string> verdict(const TomlDocument& document) {
  return printed(document.finish());
}

TEST(TomlDocument, ReadsEveryKindOfValue) {
  const TomlDocument document = parsed(R"(
title = "Cone"
shape = "cylinder"
factor = 1.5
whole = 3
count = 12
report = true
diameter = 110
radius_error = "10 um"
tilt = 30
squareness = "20 urad"
mixed = "5 um"
origin = [-65, 0, 150.5]
steps = [1, 2.5]
words = ["a", "b"]
)");
  const TomlTable& root = document.root();
  EXPECT_EQ(root.text("title"), "Cone");
  EXPECT_EQ(root.choice("shape", {"box", "cylinder"}), 1U);
  EXPECT_EQ(root.number("factor"), 1.5);
  EXPECT_EQ(root.number("whole"), 3.0);
  EXPECT_EQ(root.integer("count"), 12);
  EXPECT_TRUE(root.boolean_or("report", false));
  EXPECT_EQ(root.length("diameter").value, 110.0);
  EXPECT_DOUBLE_EQ(root.length("radius_error").value, 0.01);
  EXPECT_DOUBLE_EQ(root.angle("tilt").value, 30 * kRadPerDeg);
  EXPECT_DOUBLE_EQ(root.angle("squareness").value, 20e-6);
  EXPECT_EQ(root.quantity("mixed").kind, UnitKind::length);
  EXPECT_EQ(root.quantity("whole").kind, UnitKind::none);
  EXPECT_EQ(root.vector("origin"), Vec3(-65, 0, 150.5));
  EXPECT_THAT(root.numbers("steps"), ElementsAre(1.0, 2.5));
  EXPECT_THAT(root.texts_or("words", {}), ElementsAre("a", "b"));
  EXPECT_THAT(verdict(document), IsEmpty());
}

TEST(TomlDocument, FallsBackWhereAKeyIsAbsent) {
  const TomlDocument document = parsed("");
  const TomlTable& root = document.root();
  EXPECT_EQ(root.text_or("a", "b"), "b");
  EXPECT_EQ(root.choice_or("a", {"x", "y"}, 1), 1U);
  EXPECT_EQ(root.number_or("a", 2.5), 2.5);
  EXPECT_EQ(root.integer_or("a", 7), 7);
  EXPECT_TRUE(root.boolean_or("a", true));
  EXPECT_EQ(root.length_or("a", 2.0_mm), 2.0_mm);
  EXPECT_EQ(root.angle_or("a", 2.0_deg), 2.0_deg);
  EXPECT_EQ(root.vector_or("a", Vec3(1, 2, 3)), Vec3(1, 2, 3));
  EXPECT_THAT(root.texts_or("a", {"z"}), ElementsAre("z"));
  EXPECT_FALSE(root.table_if("a"));
  EXPECT_THAT(root.tables("a"), IsEmpty());
  EXPECT_FALSE(root.has("a"));
  EXPECT_FALSE(root.is_table("a"));
  EXPECT_FALSE(root.is_array("a"));
  EXPECT_FALSE(root.is_number("a"));
  EXPECT_THAT(verdict(document), IsEmpty());
}

TEST(TomlDocument, PrefersTheFileToTheFallback) {
  const TomlDocument document =
      parsed("a = 1\nb = \"two\"\nc = \"3 um\"\nd = \"4 mrad\"\ne = [1, 2, 3]\n");
  const TomlTable& root = document.root();
  EXPECT_EQ(root.integer_or("a", 7), 1);
  EXPECT_EQ(root.number_or("a", 7), 1.0);
  EXPECT_EQ(root.text_or("b", "x"), "two");
  EXPECT_EQ(root.choice_or("b", {"one", "two"}, 0), 1U);
  EXPECT_DOUBLE_EQ(root.length_or("c", 1.0_mm).value, 0.003);
  EXPECT_DOUBLE_EQ(root.angle_or("d", 1.0_deg).value, 0.004);
  EXPECT_EQ(root.vector_or("e", Vec3::Zero()), Vec3(1, 2, 3));
  EXPECT_THAT(verdict(document), IsEmpty());
}

TEST(TomlDocument, DescendsIntoTablesAndArraysOfTables) {
  const TomlDocument document = parsed(R"(
tool.1 = { diameter = 12 }
[inspection]
cmm = { seed = 1 }
[[feature]]
name = "cone"
[[feature]]
name = "cylinder"
)");
  const TomlTable tool = document.root().table("tool").table("1");
  EXPECT_EQ(tool.path(), "tool.1");
  EXPECT_EQ(tool.number("diameter"), 12.0);
  const auto inspection = document.root().table_if("inspection");
  ASSERT_TRUE(inspection);
  EXPECT_TRUE(inspection->is_table("cmm"));
  EXPECT_FALSE(inspection->is_number("cmm"));
  EXPECT_EQ(inspection->table("cmm").integer("seed"), 1);
  EXPECT_TRUE(document.root().is_array("feature"));
  EXPECT_FALSE(document.root().is_array("inspection"));
  const auto features = document.root().tables("feature");
  ASSERT_EQ(features.size(), 2U);
  EXPECT_EQ(features[0].text("name"), "cone");
  EXPECT_EQ(features[1].path(), "feature[2]");
  EXPECT_EQ(features[1].text("name"), "cylinder");
  EXPECT_THAT(verdict(document), IsEmpty());
}

TEST(TomlDocument, ListsKeysInFileOrderWithoutReadingThem) {
  const TomlDocument document = parsed("zeta = 1\nalpha = 2\n[errors]\nEX0C = 1\nEB0B = 2\n");
  EXPECT_THAT(document.root().keys(), ElementsAre("zeta", "alpha", "errors"));
  EXPECT_THAT(document.root().table("errors").keys(), ElementsAre("EX0C", "EB0B"));
  EXPECT_EQ(document.finish().size(), 4U);
}

TEST(TomlDocument, NamesAnUnknownKeyWithItsPlaceAndTheNearestKnownOne) {
  const TomlDocument document = parsed("[blank]\nshape = \"box\"\n  diametr = 110\n");
  const TomlTable blank = document.root().table("blank");
  EXPECT_EQ(blank.text("shape"), "box");
  EXPECT_EQ(blank.number_or("diameter", 5), 5.0);
  EXPECT_THAT(verdict(document), ElementsAre("jobs/job.toml:3:3: error: blank.diametr: unknown key "
                                             "(hint: did you mean diameter?)"));
}

TEST(TomlDocument, TellsAFaultOnceAndKnowsWhichTablesAreSound) {
  const TomlDocument document = parsed("[a]\nx = 1\n[ab]\ny = 1\n[b.c]\nz = 1\n");
  const TomlTable a = document.root().table("a"), b = document.root().table("b");
  EXPECT_EQ(a.number("x") + document.root().table("ab").number("y"), 2.0);
  EXPECT_EQ(b.table("c").number("z"), 1.0);
  EXPECT_TRUE(a.is_sound());
  for (int k = 0; k < 2; ++k) document.root().table("ab").fail("y", "is wrong");
  b.table("c").fail("z", "is wrong");
  EXPECT_TRUE(a.is_sound());
  EXPECT_FALSE(b.is_sound());
  EXPECT_FALSE(document.root().is_sound());
  EXPECT_EQ(verdict(document).size(), 2U);
}

TEST(TomlDocument, ListsKnownKeysWhenNoneIsNear) {
  const TomlDocument document = parsed("colour = \"red\"\n");
  EXPECT_EQ(document.root().number_or("height", 1), 1.0);
  EXPECT_EQ(document.root().number_or("diameter", 1), 1.0);
  EXPECT_THAT(verdict(document), ElementsAre("jobs/job.toml:1:1: error: colour: unknown key "
                                             "(hint: known: diameter, height)"));
}

TEST(TomlDocument, NamesUnknownKeysOfTablesInArrays) {
  const TomlDocument document = parsed("[[feature]]\nname = \"a\"\n[[feature]]\nnam = \"b\"\n");
  for (const TomlTable& feature : document.root().tables("feature")) {
    EXPECT_EQ(feature.text_or("name", ""), feature.path() == "feature[1]" ? "a" : "");
  }
  EXPECT_THAT(verdict(document), ElementsAre("jobs/job.toml:4:1: error: feature[2].nam: unknown "
                                             "key (hint: did you mean name?)"));
}

TEST(TomlDocument, GivesTheSameVerdictTwice) {
  const TomlDocument document = parsed("colour = 1\n");
  const auto first = verdict(document);
  EXPECT_EQ(first.size(), 1U);
  EXPECT_EQ(verdict(document), first);
}

TEST(TomlDocument, ReportsAMissingKeyOnceAtItsTable) {
  const TomlDocument document = parsed("title = \"x\"\n[blank]\n");
  EXPECT_EQ(document.root().text("title"), "x");
  const TomlTable blank = document.root().table("blank");
  EXPECT_EQ(blank.length("diameter", Bound::positive).value, 1.0);
  EXPECT_THAT(verdict(document),
              ElementsAre("jobs/job.toml:2:2: error: blank.diameter: this key is missing"));
}

TEST(TomlDocument, ReportsAMissingTableOnceAndNotItsKeys) {
  const TomlDocument document = parsed("title = \"x\"\n");
  EXPECT_EQ(document.root().text("title"), "x");
  const TomlTable blank = document.root().table("blank");
  EXPECT_FALSE(blank.has("shape"));
  EXPECT_EQ(blank.number("diameter"), 1.0);
  EXPECT_EQ(blank.table("inner").text("key"), "");
  EXPECT_THAT(blank.keys(), IsEmpty());
  EXPECT_THAT(verdict(document), ElementsAre(HasSubstr("error: blank: this key is missing")));
}

struct Mistake {
  const char* text;
  void (*read)(const TomlTable&);
  const char* complaint;
};

class TomlMistake : public testing::TestWithParam<Mistake> {};

TEST_P(TomlMistake, IsReportedOnceWithItsPlace) {
  const TomlDocument document = parsed(GetParam().text);
  GetParam().read(document.root());
  const Diagnostics diagnostics = document.finish();
  ASSERT_EQ(diagnostics.size(), 1U) << testing::PrintToString(printed(diagnostics));
  EXPECT_EQ(diagnostics[0].severity, Severity::error);
  EXPECT_EQ(diagnostics[0].file, "jobs/job.toml");
  EXPECT_EQ(diagnostics[0].line, 1);
  EXPECT_EQ(diagnostics[0].column, 1);
  EXPECT_EQ(diagnostics[0].key, "k");
  EXPECT_THAT(to_string(diagnostics[0]), HasSubstr(GetParam().complaint));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, TomlMistake,
    testing::Values(
        Mistake{"k = 1", [](const TomlTable& root) { (void)root.text("k"); },
                "expected text, found a whole number"},
        Mistake{"k = \"1\"", [](const TomlTable& root) { (void)root.number("k"); },
                "expected a finite number, found text"},
        Mistake{"k = inf", [](const TomlTable& root) { (void)root.number("k"); },
                "expected a finite number, found inf or nan"},
        Mistake{"k = 1.5", [](const TomlTable& root) { (void)root.integer("k"); },
                "expected a whole number, found a number"},
        Mistake{"k = 1", [](const TomlTable& root) { (void)root.boolean_or("k", true); },
                "expected true or false, found a whole number"},
        Mistake{"k = true", [](const TomlTable& root) { (void)root.quantity("k"); },
                "expected a number or text with a unit, found true/false"},
        Mistake{"k = 2026-01-31", [](const TomlTable& root) { (void)root.text("k"); },
                "expected text, found a date"},
        Mistake{"k = 1", [](const TomlTable& root) { (void)root.table("k"); },
                "expected a table, found a whole number"},
        Mistake{"k = 1", [](const TomlTable& root) { (void)root.table_if("k")->number("x"); },
                "expected a table, found a whole number"},
        Mistake{"k = 1", [](const TomlTable& root) { (void)root.tables("k"); },
                "expected an array of tables, found a whole number (hint: write [[k]])"},
        Mistake{"k = [1]", [](const TomlTable& root) { (void)root.tables("k"); },
                "expected tables only, found a whole number"},
        Mistake{"k = 1", [](const TomlTable& root) { (void)root.numbers("k"); },
                "expected an array of numbers, found a whole number"},
        Mistake{"k = [1, \"2\"]", [](const TomlTable& root) { (void)root.numbers("k"); },
                "expected finite numbers only, found text"},
        Mistake{"k = [1, 2]", [](const TomlTable& root) { (void)root.vector("k"); },
                "expected three numbers [x, y, z], found 2"},
        Mistake{"k = 5", [](const TomlTable& root) { (void)root.vector("k"); },
                "expected an array of numbers, found a whole number"},
        Mistake{"k = \"a\"", [](const TomlTable& root) { (void)root.texts_or("k", {}); },
                "expected an array of texts, found text"},
        Mistake{"k = [1]", [](const TomlTable& root) { (void)root.texts_or("k", {}); },
                "expected texts only, found a whole number"},
        Mistake{"k = 1", [](const TomlTable& root) { (void)root.choice("k", {"a"}); },
                "expected text, found a whole number"},
        Mistake{"k = \"cylindr\"",
                [](const TomlTable& root) {
                  (void)root.choice("k", {"box", "cylinder"});
                },
                "'cylindr' is not one of the choices (hint: did you mean cylinder? choices: box, "
                "cylinder)"},
        Mistake{"k = \"ball\"",
                [](const TomlTable& root) {
                  (void)root.choice("k", {"box", "cylinder"});
                },
                "'ball' is not one of the choices (hint: choices: box, cylinder)"}));

INSTANTIATE_TEST_SUITE_P(
    UnitsAndBounds, TomlMistake,
    testing::Values(
        Mistake{"k = \"3 urad\"",
                [](const TomlTable& root) { (void)root.length("k", Bound::positive); },
                "expected a length, found an angle (hint: units: mm um nm m in)"},
        Mistake{"k = \"3 um\"", [](const TomlTable& root) { (void)root.angle("k"); },
                "expected an angle, found a length (hint: units: deg rad mrad urad arcsec)"},
        Mistake{"k = \"3 furlong\"",
                [](const TomlTable& root) { (void)root.length("k", Bound::positive); },
                "unknown unit 'furlong' in '3 furlong'"},
        Mistake{"k = \"wide\"", [](const TomlTable& root) { (void)root.quantity("k"); },
                "'wide' is not a number with a unit"},
        Mistake{"k = 0", [](const TomlTable& root) { (void)root.number("k", Bound::positive); },
                "must be greater than 0, is 0"},
        Mistake{"k = -1",
                [](const TomlTable& root) { (void)root.integer("k", Bound::non_negative); },
                "must not be negative, is -1"},
        Mistake{"k = \"-2 um\"",
                [](const TomlTable& root) { (void)root.length("k", Bound::positive); },
                "must be greater than 0"},
        Mistake{"k = -5", [](const TomlTable& root) { (void)root.angle("k", Bound::non_negative); },
                "must not be negative"}));

TEST(TomlDocument, ReportsAllMistakesAtOnce) {
  const TomlDocument document = parsed(R"(title = 5
[blank]
shape = "cilinder"
diameter = "110 urad"
[cmm]
sed = 1
)");
  const TomlTable& root = document.root();
  (void)root.text("title");
  (void)root.text("machine");
  const TomlTable blank = root.table("blank");
  (void)blank.choice("shape", {"box", "cylinder"});
  (void)blank.length("diameter");
  (void)root.table("cmm").integer_or("seed", 0);
  EXPECT_THAT(verdict(document),
              ElementsAre(HasSubstr("job.toml:1:1: error: title: expected text"),
                          HasSubstr("machine: this key is missing"),
                          HasSubstr("job.toml:3:1: error: blank.shape: 'cilinder'"),
                          HasSubstr("job.toml:4:1: error: blank.diameter: expected a length"),
                          HasSubstr("job.toml:6:1: error: cmm.sed: unknown key")));
}

TEST(TomlDocument, NotesAReadersOwnObjectionAtTheKey) {
  const TomlDocument document = parsed("[a]\nlow = 3\nhigh = 2\n");
  const TomlTable table = document.root().table("a");
  if (table.number("low") > table.number("high")) table.fail("high", "is below low", "swap them");
  table.fail("", "is odd");
  EXPECT_THAT(verdict(document),
              ElementsAre("jobs/job.toml:3:1: error: a.high: is below low (hint: swap them)",
                          "jobs/job.toml:1:2: error: a: is odd"));
}

TEST(TomlDocument, ResolvesPathsAgainstItsFolder) {
  const TomlDocument document = parsed("a = \"cone.nc\"\nb = \"/abs/cone.nc\"\n");
  EXPECT_EQ(document.folder(), "jobs");
  EXPECT_EQ(document.file(), "jobs/job.toml");
  EXPECT_EQ(document.root().file_path("a"), "jobs/cone.nc");
  EXPECT_EQ(document.root().file_path("b"), "/abs/cone.nc");
}

TEST(TomlDocument, RefusesInvalidTomlWithLineAndColumn) {
  const auto document = TomlDocument::parse("a = 1\nb = = 2\n", "job.toml");
  ASSERT_FALSE(document);
  ASSERT_EQ(document.error().size(), 1U);
  EXPECT_EQ(document.error()[0].file, "job.toml");
  EXPECT_EQ(document.error()[0].line, 2);
  EXPECT_EQ(document.error()[0].column, 5);
}

TEST(TomlDocument, RefusesAKeyOfThousandsOfNames) {
  std::string key = "a";
  for (int k = 1; k < 100000; ++k) key += ".a";
  for (const auto& [text, place] :
       {std::pair("# 1\n" + key + " = 1\n", ":2:1"), std::pair("t = 'x'\n[" + key + "]\n", ":2:2"),
        std::pair("b = { \"c.d\" = 1," + key + " = 1 }\n", ":1:17")}) {
    const auto document = TomlDocument::parse(text, "job.toml");
    ASSERT_FALSE(document);
    EXPECT_EQ(printed(document.error()),
              std::vector{std::string("job.toml") + place +
                          ": error: a key of more than 16 names (hint: no table here is so deep in "
                          "others)"});
  }
}

TEST(TomlDocument, CountsNoDotsOfTextsCommentsAndNumbers) {
  const std::string dots(50, '.');
  const TomlDocument document = parsed(
      "a = \"" + dots + "\\\"" + dots + "\" # \" " + dots + "\nb = '" + dots + "'\nc = '''\n'" +
      dots + "''' # '\nd = \"\"\"\n\"\\\"" + dots +
      "\"\"\"\nlist = [1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, " +
      "8.5, 9.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5]\na1.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p = 1\n");
  EXPECT_EQ(document.root().text("b"), dots);
  EXPECT_EQ(document.root().numbers("list").size(), 17U);
}

// Each error was compared with all before it, each key was looked for among all: 20 s.
// That they take time by their number, and not by its square, shows where this test ends at all.
TEST(TomlDocument, ReadsSixtyThousandKeys) {
  std::string text;
  for (int k = 0; k < 60000; ++k) text += fmt::format("k{} = {{ a = 1 }}\n", k);
  const TomlDocument document = parsed(text);
  EXPECT_EQ(document.finish().size(), 60000U);
  for (const std::string& key : document.root().keys()) (void)document.root().table(key).text("a");
  EXPECT_EQ(document.finish().size(), 60000U);
}

TEST(TomlDocument, SaysOnlyThatATableIsMissing) {
  const TomlDocument document = parsed("a = 1\n");
  (void)document.root().integer("a");
  const TomlTable blank = document.root().table("blank");
  (void)blank.vector("size");
  blank.fail("size", "the blank is empty");
  EXPECT_THAT(verdict(document),
              ElementsAre("jobs/job.toml:1:1: error: blank: this key is missing"));
}

TEST(TomlDocument, RefusesPlacesBeyondAllSense) {
  const TomlDocument document = parsed("near = [1e15, -1e15, 0]\nfar = [0, 1e16, 0]\n");
  EXPECT_EQ(document.root().vector("near"), Vec3(1e15, -1e15, 0));
  (void)document.root().vector("far");
  EXPECT_THAT(verdict(document),
              ElementsAre("jobs/job.toml:2:1: error: far: must be within 1e15, is [0, 1e+16, 0]"));
}

TEST(TomlDocument, RefusesAKeyGivenTwice) {
  const auto document = TomlDocument::parse("a = 1\na = 2\n", "job.toml");
  ASSERT_FALSE(document);
  EXPECT_EQ(document.error()[0].line, 2);
}

class TomlFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("frustum_toml_") + info->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::filesystem::path written(std::string_view text) const {
    const auto file = folder_ / "job.toml";
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

TEST_F(TomlFile, Loads) {
  const auto document = TomlDocument::load(written("a = 5\r\n# comment\r\n"));
  ASSERT_TRUE(document);
  EXPECT_EQ(document->root().integer("a"), 5);
  EXPECT_EQ(document->folder(), folder());
}

TEST_F(TomlFile, LoadsWhenEmptySoThatTheReaderNamesWhatIsMissing) {
  const auto document = TomlDocument::load(written(""));
  ASSERT_TRUE(document);
  (void)document->root().text("title");
  EXPECT_EQ(document->finish().size(), 1U);
}

TEST_F(TomlFile, ThatIsAbsentOrAFolderCannotBeRead) {
  for (const auto& file : {folder() / "none.toml", folder()}) {
    const auto document = TomlDocument::load(file);
    ASSERT_FALSE(document) << file;
    EXPECT_EQ(document.error()[0].file, file.string());
    EXPECT_EQ(document.error()[0].message, "the file cannot be read");
  }
}

}  // namespace
}  // namespace frustum
