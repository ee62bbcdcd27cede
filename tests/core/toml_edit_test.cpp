#include "core/toml_edit.hpp"

#include <gtest/gtest.h>

namespace frustum {
namespace {

TEST(TomlEdit, ReplacesValuesAndKeepsAllElse) {
  const std::string text =
      "# the head: \xC3\xBC\n"
      "title   = \"a \xC3\xBC\"   # of \xC3\xBC\n"
      "program = { file = \"\xC3\xBC.nc\", dialect = \"iso\" } # stays\r\n"
      "\n"
      "[[operation]]\nlines = [1,\n  2]\nname = 'x'\n"
      "[[operation]]\nlines = [3, 4]\n";
  const auto changed = changed_toml(text, {.replaced = {{"operation[0].lines", "[5, 6]"},
                                                        {"operation[1].lines", "[70, 80]"},
                                                        {"program.file", "\"b.nc\""},
                                                        {"title", "\"b\""}}});
  ASSERT_TRUE(changed) << changed.error().front().message;
  EXPECT_EQ(*changed,
            "# the head: \xC3\xBC\n"
            "title   = \"b\"   # of \xC3\xBC\n"
            "program = { file = \"b.nc\", dialect = \"iso\" } # stays\r\n"
            "\n"
            "[[operation]]\nlines = [5, 6]\nname = 'x'\n"
            "[[operation]]\nlines = [70, 80]\n");
}

TEST(TomlEdit, AddsAKeyHoweverItsTableIsWritten) {
  const auto with_dialect = [](std::string_view text) {
    const auto changed = changed_toml(text, {.added = {{"program.file", "dialect", "\"iso\""}}});
    return changed ? *changed : changed.error().front().message;
  };
  EXPECT_EQ(with_dialect("program = { file = \"a\" }"),
            "program = { file = \"a\", dialect = \"iso\" }");
  EXPECT_EQ(with_dialect("program.file = \"a\" # x\n"),
            "program.file = \"a\"\nprogram.dialect = \"iso\" # x\n");
  EXPECT_EQ(with_dialect("[program]\nfile = \"a\""), "[program]\nfile = \"a\"\ndialect = \"iso\"");
}

TEST(TomlEdit, EmptiesATableHoweverItIsWritten) {
  const auto without = [](std::string_view text) {
    const auto changed = changed_toml(text, {.emptied = {"errors"}});
    return changed ? *changed : changed.error().front().message;
  };
  EXPECT_EQ(without("a = 1\n"), "a = 1\n");
  EXPECT_EQ(without("errors = { EXX = \"1 um\" }\na = 1\n"), "errors = {}\na = 1\n");
  EXPECT_EQ(without("a = 1\nerrors.EXX = \"1 um\"\nerrors.EYY = 0\nb = 1\n"), "a = 1\nb = 1\n");
  EXPECT_EQ(
      without("# Of the machine\n[errors]\nEXX = \"1 um\" # x\nEYY = [\n  { a = 1 },\n]\n"
              "[errors.EZZ]\nvalue = 1\n[[errors.EBB]]\nvalue = 2\n[[errors.EBB]]\nvalue = 3\n"
              "[errors.drawn]\na.b = 1\n[other]\nc = 1\n"),
      "# Of the machine\n[errors]\n[other]\nc = 1\n");
}

TEST(TomlEdit, RefusesWhatIsNotThere) {
  const auto changed = changed_toml("a = 1\n", {.replaced = {{"b", "2"}}});
  ASSERT_FALSE(changed);
  EXPECT_EQ(changed.error().front().key, "b");
  EXPECT_FALSE(changed_toml("a = \n", {}));
}

}  // namespace
}  // namespace frustum
