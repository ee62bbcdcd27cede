#include "report/page/html_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/units.hpp"
#include "report/chart/polar_chart.hpp"
#include "report/html/tolerance_symbol.hpp"
#include "report/page/html_sections.hpp"
#include "report/terminal_report.hpp"
#include "report/verdict.hpp"
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
        "the program ends without", "tool path chord", "185.600", "Polar chart of",
        "Axis positions of", "data-surface", "data:image/png;base64,"}) {
    EXPECT_THAT(page, HasSubstr(part)) << part;
  }
  EXPECT_EQ(count_of(page, "class=\"polar\""), 2U);
  EXPECT_EQ(chart_data_of(page)["surface"]["vertices"], sample_report().surface.vertices.size());
}

// What the page says without its script.
std::string body_of(const std::string& page) { return between(page, "<body>", "<script"); }

TEST(HtmlReport, Fault2_38_HasAHeadAndSaysHowWasMeasured) {
  RunReport report = sample_report();
  EXPECT_EQ(count_of(body_of(html_report(report)), "not stated"), 7U);
  report.evidence.header = {.part = "Cone", .serial_number = "00<42", .operated_by = "A. Example"};
  report.evidence.measuring = {{"decision_rule", "Decision rule", "ISO 14253-1: as it says"}};
  report.evidence.files = {hashed_file("program", "a/b/part.nc", "abc")};
  const std::string body = body_of(html_report(report));
  for (const char* part : {"00&lt;42", "A. Example", "Decision rule: ISO 14253-1: as it says",
                           "part.nc", "ba7816bf8f01cfea414140de5dae2223"}) {
    EXPECT_THAT(body, HasSubstr(part)) << part;
  }
  EXPECT_EQ(count_of(body, "not stated"), 4U);
}

TEST(HtmlReport, Fault2_40_EachSectionHasItsColourAndNothingIsWrittenOnATrace) {
  RunReport report = sample_report();
  auto& c = report.measurement.characteristics[0];
  const auto angle = c.plot_angle, deviation = c.plot_deviation;
  for (int k = 0; k < 2; ++k) {
    c.plot_angle.insert(c.plot_angle.end(), angle.begin(), angle.end());
    c.plot_deviation.insert(c.plot_deviation.end(), deviation.begin(), deviation.end());
  }
  const std::string figure = between(html_report(report), "<figure class=\"polar\"", "</figure>");
  for (const char* part : {"trace s1", "trace s2", "trace s3", "section 2"}) {
    EXPECT_THAT(figure, HasSubstr(part)) << part;
  }
  EXPECT_THAT(figure, Not(HasSubstr("trace s4")));
  // Outside the circle of radius 176 about (220, 212): angles beside it, the ruler under it.
  std::size_t texts = 0;
  for (std::size_t at = figure.find("<text"); at != std::string::npos;
       at = figure.find("<text", at + 1)) {
    const double x = std::stod(between(figure.substr(at), " x=\"", "\""));
    const double y = std::stod(between(figure.substr(at), " y=\"", "\""));
    EXPECT_GT(std::hypot(x - 220.0, y - 4.0 - 212.0), 176.0 + 10.0);
    ++texts;
  }
  EXPECT_EQ(texts, 16U);
}

TEST(HtmlReport, Fault2_40_AGapIsNoNewSection) {
  metrology::CharacteristicResult c;
  for (int section = 0; section < 2; ++section) {
    for (int k = 0; k < 360; ++k) {
      if (k > 100 && k < 130) continue;  // a keyway
      c.plot_angle.push_back(k * kRadPerDeg);
      c.plot_deviation.push_back(1e-3);
    }
  }
  const auto rounds = polar_rounds(c);
  ASSERT_EQ(rounds.size(), 2U);
  EXPECT_EQ(rounds[0].size(), 332U);  // 331 and the first again
  EXPECT_FALSE(rounds[0][101].follows);
  EXPECT_TRUE(rounds[1][1].follows);
  // Clockwise as well, and arcs that do not close.
  c = {};
  for (int section = 0; section < 3; ++section) {
    for (int k = 90; k >= 45; --k) {
      c.plot_angle.push_back(k * kRadPerDeg);
      c.plot_deviation.push_back(1e-3);
    }
  }
  EXPECT_EQ(polar_rounds(c).size(), 3U);
  EXPECT_EQ(polar_rounds(c)[0].size(), 46U);
}

TEST(HtmlReport, Fault2_42_CountsWhatFailsAndWhatIsUncertainApart) {
  RunReport report = sample_report();
  auto& all = report.measurement.characteristics;  // the third, a roundness, is out of tolerance
  EXPECT_THAT(html_report(report), HasSubstr("<b>Fail</b>4 pass, 1 fails</p>"));
  all[0].pass = false;
  all[0].uncertain = true;
  all[1].value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(html_report(report),
              HasSubstr("<b>Fail</b>2 pass, 1 fails, 1 uncertain, 1 not measured</p>"));
  EXPECT_EQ(counts_text({}), "");
}

TEST(HtmlReport, Fault2_45_TellsThatNoErrorOfTheCmmIsStated) {
  RunReport report = sample_report();
  EXPECT_THAT(html_report(report), Not(HasSubstr("U = 0:")));
  for (auto& c : report.measurement.characteristics) c.expanded_uncertainty = 0.0;
  EXPECT_THAT(html_report(report), HasSubstr("U = 0: no error of the CMM is stated"));
  EXPECT_THAT(terminal_report(report), HasSubstr("U = 0: no error of the CMM is stated"));
}

TEST(HtmlReport, Fault2_52_SaysBesideUWhatIsNotProvenOrNotStated) {
  RunReport report = sample_report();
  EXPECT_THAT(html_report(report), Not(HasSubstr("not proven")));
  EXPECT_THAT(terminal_report(report), Not(HasSubstr("not proven")));
  auto& all = report.measurement.characteristics;
  const double far = all[0].value + all[0].expanded_uncertainty;
  all[0].interval = metrology::TrueValueInterval{0.0, far, metrology::Coverage::not_proven};
  EXPECT_THAT(html_report(report), HasSubstr("<small>not proven</small>"));
  EXPECT_THAT(html_report(report), HasSubstr("that is not shown"));
  EXPECT_THAT(terminal_report(report), HasSubstr(" (not proven)"));
  EXPECT_THAT(html_report(report), Not(HasSubstr("without the value")));
  all[0].interval->low = far;
  EXPECT_THAT(html_report(report), HasSubstr("<small>corrected, without the value</small>"));
  all[0].interval.reset();
  for (auto& c : all) {
    c.expanded_uncertainty = 0.0;
    c.is_accuracy_unknown = true;
  }
  const std::string page = html_report(report);
  EXPECT_THAT(page, HasSubstr("U is not known: no accuracy of the CMM is stated"));
  EXPECT_THAT(page, Not(HasSubstr("holds the true value")));
  EXPECT_THAT(terminal_report(report), HasSubstr("U is not known"));
}

TEST(HtmlReport, Fault2_39_DrawsTheSymbolsOfIso1101) {
  for (const char* kind :
       {"straightness", "flatness", "roundness", "cylindricity", "line_profile", "surface_profile",
        "parallelism", "perpendicularity", "angularity", "position", "concentricity", "coaxiality",
        "symmetry", "circular_run_out", "total_run_out"}) {
    EXPECT_THAT(tolerance_symbol(kind, Wording()), HasSubstr("<svg")) << kind;
  }
  EXPECT_EQ(tolerance_symbol("radius", Wording()), "");
}

TEST(HtmlReport, DrawsAProfileForEveryDistanceOfLines) {
  const RunReport report = step_report(11);
  const std::string page = html_report(report);
  // dL, dH and dL0; angles share their lines
  EXPECT_EQ(count_of(page, "<figure class=\"profile\""), 33U);
  const std::string figure =
      between(page, "<figure class=\"profile\"><figcaption><b>1-a.dH", "</figure>");
  EXPECT_THAT(figure, HasSubstr("1-a.B_d"));
  EXPECT_EQ(count_of(figure, "<circle class=\"dot s1\""), 12U);
  EXPECT_EQ(count_of(figure, "<circle class=\"ring s2\""), 12U);
  EXPECT_EQ(count_of(figure, "class=\"fit s"), 2U);
  EXPECT_THAT(page, HasSubstr("± 40.000"));
}

TEST(HtmlReport, DrawsTheLinesOfAnAngleThatNoDistanceShows) {
  RunReport report = step_report(1);
  auto& all = report.measurement.characteristics;
  all = {all[2], all[3], all[0]};  // theta, phi and dL: phi has its lines alone
  const std::string page = html_report(report);
  EXPECT_EQ(count_of(page, "<figure class=\"profile\""), 2U);
  EXPECT_THAT(page, HasSubstr("<figure class=\"profile\"><figcaption><b>1-a.phi"));
  EXPECT_THAT(page, HasSubstr("<figure class=\"profile\"><figcaption><b>1-a.dL<"));
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
  // dH, dL0, and phi, whose lines are called otherwise now
  EXPECT_EQ(count_of(page, "<figure class=\"profile\""), 3U);
  const std::string figure =
      between(page, "<figure class=\"profile\"><figcaption><b>1-a.dH", "</figure>");
  EXPECT_EQ(count_of(figure, "<circle class=\"dot"), 11U);
  EXPECT_EQ(count_of(figure, "class=\"fit s"), 1U);
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
}

TEST(HtmlReport, NumbersThatAreNotOneAreLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  RunReport report = sample_report();
  report.measurement.characteristics[0].value = kNan;
  report.measurement.characteristics[0].plot_deviation[3] = kNan;
  report.traces[0].axes[0].values[0] = kNan;
  report.surface.deviation[0] = std::numeric_limits<float>::infinity();
  const std::string page = html_report(report);
  std::string body = body_of(page);
  const std::size_t picture = body.find("data:image");  // whose letters may be any
  body.erase(picture, body.find('"', picture) - picture);
  EXPECT_THAT(body, Not(HasSubstr("nan")));
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

TEST(HtmlReport, SaysWhetherMachineCollisionsWereLookedFor_Fault2_25) {
  RunReport report = sample_report();
  report.collisions.clear();
  EXPECT_EQ(html_sections(report).find("Machine collisions"), std::string::npos);
  report.machine_bodies = MachineBodies{};
  EXPECT_NE(html_sections(report).find("Machine collisions were not looked for"),
            std::string::npos);
  report.machine_bodies = MachineBodies{
      .bodies = 7, .smallest_distance = 12.5, .first = "table", .second = "holder", .line = 40};
  EXPECT_NE(html_sections(report).find("smallest distance 12.50 mm, table to holder, line 40"),
            std::string::npos);
}

}  // namespace
}  // namespace frustum::report
