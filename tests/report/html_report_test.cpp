#include "report/page/html_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "sample_report.hpp"

namespace frustum::report {
namespace {

using testing::HasSubstr;
using testing::Not;

// The text between two marks; empty when either is missing.
std::string between(const std::string& text, const std::string& open, const std::string& close) {
  const std::size_t from = text.find(open);
  if (from == std::string::npos) return {};
  const std::size_t to = text.find(close, from + open.size());
  if (to == std::string::npos) return {};
  return text.substr(from + open.size(), to - from - open.size());
}

nlohmann::json chart_data_of(const std::string& page) {
  return nlohmann::json::parse(between(page, "id=\"chart-data\">", "</script>"));
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(HtmlReport, LoadsNothingFromTheNetwork) {
  const std::string page = html_report(sample_report());
  EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
  EXPECT_THAT(page, Not(HasSubstr("src='http")));
  const std::string head = page.substr(0, page.find("<body"));
  EXPECT_THAT(head, Not(HasSubstr("href=")));
  EXPECT_THAT(head, Not(HasSubstr("url(")));
  EXPECT_THAT(head, Not(HasSubstr("@import")));
}

TEST(HtmlReport, ShowsEveryPartOfTheRun) {
  const std::string page = html_report(sample_report());
  for (const char* part :
       {"Cone frustum 45° inclined by 30°", "t-(C)-Z-Y-b-X-B-C-w", "cone.equivalent_form", "3.987",
        "cylinder.roundness", "EB0C", "tilt of axis C about Y", "128.929",
        "the program ends without", "tool path chord", "185.600", "data-polar=\"1\"",
        "data-trace=\"0\"", "data-surface"}) {
    EXPECT_THAT(page, HasSubstr(part)) << part;
  }
  const nlohmann::json data = chart_data_of(page);
  EXPECT_EQ(data["polar"].size(), 2U);
  EXPECT_EQ(data["polar"][0]["angle"].size(), 720U);
  EXPECT_EQ(data["traces"][0]["axes"].size(), 5U);
  EXPECT_EQ(data["surface"]["vertices"], sample_report().surface.vertices.size());
}

TEST(HtmlReport, DrawsAProfileForEveryDistanceOfLines) {
  const RunReport report = step_report(11);
  const std::string page = html_report(report);
  EXPECT_EQ(count_of(page, "data-profile=\""), 33U);  // dL, dH and dL0; angles share their lines
  const nlohmann::json profiles = chart_data_of(page)["profiles"];
  ASSERT_EQ(profiles.size(), 33U);
  EXPECT_EQ(profiles[1]["name"], "1-a.dH");
  ASSERT_EQ(profiles[1]["lines"].size(), 2U);
  const nlohmann::json& line = profiles[1]["lines"][1];
  EXPECT_EQ(line["feature"], "1-a.B_d");
  EXPECT_EQ(line["position_mm"].size(), 12U);
  EXPECT_EQ(line["position_mm"][0], -27.5);
  const metrology::LineProfile& profile = report.measurement.characteristics[1].profiles[1];
  EXPECT_NEAR(line["deviation_um"][3].get<double>(), 1e3 * profile.deviation[3], 1e-5);
  EXPECT_NEAR(line["fit_offset_um"].get<double>(), 1e3 * profile.fit_offset, 1e-5);
  EXPECT_NEAR(line["fit_slope_urad"].get<double>(), 1e6 * profile.fit_slope, 1e-5);
  EXPECT_THAT(page, HasSubstr("± 40.000"));
}

TEST(HtmlReport, DrawsTheLinesOfAnAngleThatNoDistanceShows) {
  RunReport report = step_report(1);
  auto& all = report.measurement.characteristics;
  all = {all[2], all[3], all[0]};  // theta, phi and dL: phi has its lines alone
  const nlohmann::json profiles = chart_data_of(html_report(report))["profiles"];
  ASSERT_EQ(profiles.size(), 2U);
  EXPECT_EQ(profiles[0]["name"], "1-a.phi");
  EXPECT_EQ(profiles[1]["name"], "1-a.dL");
  EXPECT_EQ(count_of(html_report(report), "data-profile=\""), 2U);
}

TEST(HtmlReport, ProfilesThatAreBrokenAreLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  RunReport report = step_report(1);
  auto& all = report.measurement.characteristics;
  all[0].profiles[0].deviation.pop_back();
  all[1].profiles[0].deviation[2] = kNan;
  all[1].profiles[1].fit_slope = kNan;
  all[1].profiles[1].feature = "</script><b>";
  const std::string page = html_report(report);
  const nlohmann::json profiles = chart_data_of(page)["profiles"];
  ASSERT_EQ(profiles.size(), 3U);  // dH, dL0, and phi, whose lines are called otherwise now
  EXPECT_EQ(profiles[0]["name"], "1-a.dH");
  EXPECT_TRUE(profiles[0]["lines"][0]["deviation_um"][2].is_null());
  EXPECT_TRUE(profiles[0]["lines"][1]["fit_slope_urad"].is_null());
  EXPECT_EQ(count_of(page, "</script"), 2U);
}

TEST(HtmlReport, KeepsAColumnOfNominalsOnlyWhereThereAreSome) {
  EXPECT_THAT(html_report(sample_report()), HasSubstr(">Nominal</th>"));
  RunReport report = step_report(2);  // lines: every nominal is 0
  EXPECT_THAT(html_report(report), Not(HasSubstr(">Nominal</th>")));
  const auto cells_of = [](const std::string& page) {
    const std::string table = between(page, "id=\"characteristics\"", "</section>");
    return std::pair{count_of(table, "<th "), count_of(table, "<td")};
  };
  const std::size_t rows = report.measurement.characteristics.size();
  EXPECT_EQ(cells_of(html_report(report)), (std::pair<std::size_t, std::size_t>(6, 6 * rows)));
  report.measurement.characteristics.back().nominal = 12.0;
  EXPECT_EQ(cells_of(html_report(report)), (std::pair<std::size_t, std::size_t>(7, 7 * rows)));
}

TEST(HtmlReport, CarriesTheLicencesOfWhatItBundles) {
  const std::string page = html_report(small_report());
  EXPECT_THAT(page, HasSubstr("plotly.js 3."));
  EXPECT_THAT(page, HasSubstr("three 0."));
  EXPECT_THAT(page, HasSubstr("Permission is hereby granted"));
}

TEST(HtmlReport, HostileTextsStayTexts) {
  RunReport report = sample_report();
  const std::string hostile = "</script><script>alert(1)</script><!-- \"'&{{script}}";
  report.title = hostile;
  report.machine = hostile;
  report.measurement.characteristics[0].name = hostile;
  report.measurement.characteristics[0].unit = hostile;
  report.errors[0].written = hostile;
  report.traces[0].operation = hostile;
  report.traces[0].axes[0].axis = hostile;
  report.notes = {hostile};
  const std::string page = html_report(report);
  const std::string harmless = html_report(sample_report());
  EXPECT_EQ(count_of(page, "</script"), 2U);
  EXPECT_EQ(count_of(page, "<script"), count_of(harmless, "<script"));
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("<!--")));
  EXPECT_LT(page.size(), harmless.size() + 5000) << "a place of the template was filled twice";
  EXPECT_EQ(chart_data_of(page)["polar"][0]["name"], hostile);
}

TEST(HtmlReport, NumbersThatAreNotOneAreLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  RunReport report = sample_report();
  report.measurement.characteristics[0].value = kNan;
  report.measurement.characteristics[0].plot_deviation[3] = kNan;
  report.traces[0].axes[0].values[0] = kNan;
  report.surface.deviation[0] = std::numeric_limits<float>::infinity();
  const std::string page = html_report(report);
  EXPECT_TRUE(chart_data_of(page)["polar"][0]["deviation_um"][3].is_null());
  EXPECT_THAT(between(page, "<body>", "<script"), Not(HasSubstr("nan")));
}

TEST(HtmlReport, LeavesOutASurfaceThatIsInconsistent) {
  RunReport report = sample_report();
  report.surface.triangles.push_back({0, 1, 4000000});
  const std::string page = html_report(report);
  EXPECT_TRUE(chart_data_of(page)["surface"].is_null());
  EXPECT_EQ(between(page, "<body>", "<script").find("data-surface"), std::string::npos);
}

TEST(HtmlReport, AnEmptyRunIsStillAPage) {
  EXPECT_THAT(html_report(RunReport{}), HasSubstr("Untitled run"));
}

TEST(HtmlReport, NamesTheFileThatCannotBeWritten) {
  const auto result = write_html_report("/no/such/folder/report.html", small_report());
  ASSERT_FALSE(result.has_value());
  EXPECT_THAT(result.error().front().message, HasSubstr("/no/such/folder/report.html"));
  EXPECT_FALSE(result.error().front().hint.empty());
}

}  // namespace
}  // namespace frustum::report
