// The language and the units of a report: one table of texts, no text left behind, numbers with the
// sign and the unit of the reader.
#include "report/wording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "kinematics/model/geometric_errors.hpp"
#include "metrology/plan/plan_names.hpp"
#include "report/exchange/json_report.hpp"
#include "report/measuring_statement.hpp"
#include "report/page/html_report.hpp"
#include "report/terminal_report.hpp"
#include "sample_report.hpp"
#include "tests/report/page_texts.hpp"

namespace frustum::report {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr ReportStyle kGerman{Language::german, LengthUnits::millimetre};
constexpr ReportStyle kInch{Language::english, LengthUnits::inch};

std::multiset<std::string> places_of(std::string_view text) {
  std::multiset<std::string> places;
  const std::string all(text);
  static const std::regex kPlace(R"(\{\d\})");
  for (auto at = std::sregex_iterator(all.begin(), all.end(), kPlace); at != std::sregex_iterator();
       ++at) {
    places.insert(at->str());
  }
  return places;
}

TEST(Phrases, EachHasOneRowWithBothLanguagesAndTheSamePlaces) {
  std::set<std::string_view> seen;
  for (const PhrasePart& part : kPhraseParts) {
    for (std::size_t i = 0; i < part.count; ++i) {
      const auto& [english, german] = part.rows[i];
      EXPECT_TRUE(seen.insert(english).second) << "twice: " << english;
      EXPECT_FALSE(english.empty());
      EXPECT_FALSE(german.empty()) << english;
      EXPECT_EQ(places_of(english), places_of(german)) << english;
      EXPECT_EQ(english.front() == ' ', german.front() == ' ') << english;
      EXPECT_EQ(english.back() == ' ', german.back() == ' ') << english;
      EXPECT_EQ(english.back() == '.', german.back() == '.') << english;
    }
  }
  EXPECT_GT(seen.size(), 280U);
}

TEST(Phrases, HaveEveryWordOfPlansAndHeads) {
  const auto expect_row = [](std::string_view word) {
    EXPECT_NE(phrase_row(word), nullptr) << word;
  };
  for (const auto word : metrology::kCharacteristicNames) expect_row(word);
  for (const auto word : metrology::kFeatureNames) expect_row(word);
  for (const auto& row : metrology::kHeaderKeys) expect_row(row.label);
}

TEST(Phrases, SayWhatEachMachineErrorMeans) {
  const Wording german(kGerman);
  EXPECT_EQ(german.sentence("radial motion of C in X"), "Radialbewegung von C in X");
  EXPECT_EQ(german.sentence("C axis off the spindle"), "C axis off the spindle") << "a user's text";
  for (const char axis : std::string("XYZABC")) {
    for (const char direction : std::string("XYZABC")) {
      for (const char* between : {"", "0"}) {
        const auto name =
            kinematics::ErrorName::parse(std::string("E") + direction + between + axis);
        ASSERT_TRUE(name);
        EXPECT_NE(german.sentence(name->meaning()), name->meaning());
      }
    }
  }
}

// Without a surface where no picture is asked for: drawing it takes a second.
RunReport full_report(bool with_surface = false) {
  RunReport report = sample_report(24, 2);
  if (!with_surface) report.surface = {};
  metrology::InspectionPlan plan;
  metrology::CmmModel cmm;
  cmm.e0_mm = 0.0018;
  cmm.length_per_error = 350.0;
  report.evidence.measuring = measuring_statement(plan, cmm, PointSource::virtual_cmm);
  report.title = "Kegel";
  report.machine = "Fräsmaschine, C auf B";
  report.evidence.header.part = "Kegel";
  // What comes from users and messages is in their own language.
  report.diagnostics.clear();
  report.measurement.diagnostics.clear();
  report.notes.clear();
  report.collisions.clear();
  for (auto& c : report.measurement.characteristics) {
    if (c.kind == "circularity") c.kind = "roundness";
  }
  for (auto& f : report.measurement.features) f.name = "F" + std::to_string(f.points.size());
  return report;
}

RunReport styled(ReportStyle style, bool with_surface = false) {
  RunReport report = full_report(with_surface);
  metrology::InspectionPlan plan;
  metrology::CmmModel cmm;
  cmm.e0_mm = 0.0018;
  cmm.length_per_error = 350.0;
  report.style = style;
  report.evidence.measuring_shown =
      measuring_statement(plan, cmm, PointSource::virtual_cmm, Wording(style));
  return report;
}

TEST(GermanReport, HasNoEnglishTextOfTheTable) {
  const std::string german = texts_of(html_report(styled(kGerman, true)));
  const std::string english = texts_of(html_report(full_report(true)));
  const Untranslated texts = untranslated(english, german);
  EXPECT_THAT(texts.left, testing::IsEmpty());
  EXPECT_GT(texts.found, 40U) << "the page shows what the table has";
}

TEST(GermanReport, HasDecimalCommasAndItsTerms) {
  const std::string page = html_report(styled(kGerman));
  EXPECT_THAT(page, HasSubstr("<html lang=\"de\">"));
  for (const char* part : {"Messbericht", "Merkmale", "Rundheit", "Form des Kegelmantels", "3,987",
                           "185,600", "Messunsicherheit", "Grenzabweichung", "Entscheidungsregel",
                           "E0 = 1,8 µm", "1,8 µm + L/350"}) {
    EXPECT_THAT(page, HasSubstr(part)) << part;
  }
  EXPECT_THAT(texts_of(page), Not(HasSubstr("3.987")));
  const std::string text = terminal_report(styled(kGerman));
  EXPECT_THAT(text, HasSubstr("Merkmal"));
  EXPECT_THAT(text, HasSubstr("3,987 um"));
  EXPECT_THAT(text, HasSubstr("NICHT KONFORM"));
}

TEST(InchReport, ConvertsLengthsAlone) {
  const Wording words(kInch);
  EXPECT_EQ(words.value(25.4, "mm"), "1.000000");
  EXPECT_EQ(words.value(0.0254, "um"), "1.00");
  EXPECT_EQ(words.value(30.0, "urad"), "30.00");
  EXPECT_EQ(words.value(45.0, "deg"), "45.00000");
  EXPECT_EQ(words.symbol("um"), "µin");
  EXPECT_EQ(words.amount(254.0, "mm/min"), "10 in/min");
  EXPECT_NEAR(words.shown(16387.064, "mm3"), 1.0, 1e-12);
  const std::string page = html_report(styled(kInch));
  EXPECT_THAT(page, HasSubstr("156.97")) << "3.987 um";
  EXPECT_THAT(page, HasSubstr("E0 = 70.8661 µin"));
  EXPECT_THAT(page, HasSubstr("L/350 (L in mil, E in µin)"));
  EXPECT_THAT(texts_of(page), Not(HasSubstr("µm")));
  EXPECT_THAT(texts_of(page), Not(HasSubstr("\u202fmm<")));
}

TEST(Wording, LeavesEnglishAndMillimetresAsTheyWere) {
  EXPECT_EQ(html_report(styled({})), html_report(full_report()));
  EXPECT_EQ(Wording().number("1.5"), "1.5");
  EXPECT_EQ(Wording(kGerman).number("0.000 .. 1.234"), "0,000 .. 1,234");
  EXPECT_EQ(Wording(kGerman).number("ISO 1.x v. 2"), "ISO 1.x v. 2");
}

// The contract of documents for programs: English and mm, whatever a page says.
TEST(Wording, DoesNotReachJson) {
  EXPECT_EQ(json_report(styled(kGerman)), json_report(full_report()));
  EXPECT_EQ(json_report(styled(kInch)), json_report(full_report()));
}

}  // namespace
}  // namespace frustum::report
