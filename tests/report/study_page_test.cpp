// The page of a study: what is asked of it is drawn, and each drawing's numbers are beside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/base64.hpp"
#include "report/page/study_page.hpp"

namespace frustum::report {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

StudyPageCharacteristic form() {
  return {.name = "a<b",
          .unit = "um",
          .box = {"a<b", 1.0, 2.0, 3.0, 4.0, 9.0, {6.0}},
          .distribution = {{1.0, 2.0, 3.0}, {0.25, 0.5, 1.0}, 0.1, {2.5}},
          .row = {"1", "3 (2 .. 4)", "8", "6", "70 %"}};
}

TEST(StudyPage, DrawsABoxAndADistributionOfEachCharacteristic) {
  StudyPage page{.title = "<study>"};
  page.characteristics = {form(), form()};
  const std::string html = study_html(page);
  EXPECT_THAT(html, HasSubstr("&lt;study&gt;"));
  // The script compares such names of its own.
  EXPECT_THAT(html.substr(0, html.find("<script")), Not(HasSubstr("a<b")));
  EXPECT_EQ(count(html, "class=\"box s1\""), 2U);
  EXPECT_EQ(count(html, "class=\"band s1\""), 2U);
  // A limit in each box plot and each distribution.
  EXPECT_EQ(count(html, "class=\"limit\""), 4U);
  EXPECT_EQ(count(html, "<a download="), 3U) << "boxes, and each distribution";
  EXPECT_THAT(html, Not(HasSubstr("What a guard band costs"))) << "nobody has asked";
}

TEST(StudyPage, LeavesOutALimitFarBeyondAllValues) {
  StudyPage page;
  page.characteristics = {form()};
  page.characteristics[0].box.limits = {-600.0, 600.0};
  page.characteristics[0].distribution.limits = {600.0};
  EXPECT_EQ(count(study_html(page), "class=\"limit\""), 0U);
}

TEST(StudyPage, DrawsBothLimitsOfDeviationsOfEitherSign) {
  StudyPage page;
  page.characteristics = {form()};
  page.characteristics[0].box.limits = {-6.0, 6.0};
  page.characteristics[0].distribution.limits.clear();
  const std::string html = study_html(page);
  EXPECT_EQ(count(html, "class=\"limit\""), 2U);
  const std::string csv =
      "characteristic,unit,min,q1,median,q3,max,lower_limit,upper_limit\na<b,um,1,2,3,4,9,-6,6\n";
  EXPECT_THAT(html,
              HasSubstr(base64({reinterpret_cast<const unsigned char*>(csv.data()), csv.size()})));
}

TEST(StudyPage, NamesRisksThatAreTooRareForAPicture) {
  StudyPage page;
  page.characteristics = {form()};
  page.characteristics[0].risk = RiskCurve{{0.0, 1.0}, {1e-7, 0.0}, {0.0, 1e-5}};
  const std::string html = study_html(page);
  EXPECT_THAT(html, HasSubstr("Both risks are below 0.0001"));
  EXPECT_THAT(html, Not(HasSubstr("a&lt;b.risk.csv")));
  EXPECT_EQ(count(html, "<a download="), 2U);
}

TEST(StudyPage, DrawsSharesRisksScatterAndMapsWhereTheyAreAsked) {
  StudyPage page;
  page.characteristics = {form()};
  page.characteristics[0].risk = RiskCurve{{0.0, 0.5, 1.0}, {0.02, 0.01, 0.001}, {0.02, 0.06, 0.1}};
  page.shares = {{"EXX", 0.6, 0.8}, {"EYY", 0.4, 0.5}};
  page.scatter = {ScatterSeries{"a", {1.0, 2.0}, {1.5}}, ScatterSeries{"b", {3.0, 4.0}, {}}};
  page.maps = {{"rms", "cone", "inclination", {"30°"}, {"10°", "20°"}, {2.5, std::nullopt}, {}}};
  const std::string html = study_html(page);
  EXPECT_EQ(count(html, "class=\"column s"), 4U);
  EXPECT_EQ(count(html, "class=\"spot s1\""), 2U);
  EXPECT_EQ(count(html, "class=\"cell\""), 1U) << "a set-up without a value stays empty";
  EXPECT_THAT(html, HasSubstr("What a guard band costs"));
  EXPECT_EQ(count(html, "<a download="), 6U);
}

TEST(StudyPage, MapsThatAreComparedShareTheirShades) {
  HeatMap map{"rms", "cone", "inclination", {"30°"}, {"10°", "20°"}, {1.0, 2.0}, {}};
  EXPECT_EQ(range_of(map), (std::array<double, 2>{1.0, 2.0}));
  const std::string darkest = "#103e70";
  EXPECT_THAT(heat_map_figure(map), HasSubstr(darkest));
  map.shades = {1.0, 3.0};
  EXPECT_THAT(heat_map_figure(map), Not(HasSubstr(darkest)));
}

}  // namespace
}  // namespace frustum::report
