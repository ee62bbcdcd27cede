// DMIS output: the statements of the standard, laid out as the results file that the Digital
// Metrology Standards Consortium makes from QIF, with the numbers of the measurement.
#include "report/exchange/dmis_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/metrology/measured_feature.hpp"

namespace frustum::report {
namespace {

using testing::HasSubstr;

metrology::MeasuredFeature measured(const std::string& name, const std::string& kind) {
  metrology::MeasuredFeature feature;
  feature.name = name;
  feature.kind = kind;
  return feature;
}

metrology::CharacteristicResult result(const std::string& name, const std::string& kind,
                                       std::vector<std::string> features, double value,
                                       double tolerance) {
  metrology::CharacteristicResult c;
  c.name = name;
  c.kind = kind;
  c.features = std::move(features);
  c.value = value;
  c.unit = "um";
  c.tolerance = tolerance;
  c.pass = std::abs(value) <= tolerance;
  return c;
}

struct Document {
  RunReport report{};
  metrology::InspectionPlan plan{};
  [[nodiscard]] std::string text() const { return dmis_report(report, plan); }
};

Document plate() {
  using namespace metrology::measured;
  Document d;
  d.report.title = "It's a plate";
  d.plan.features = {
      plane("DAT_A", {0, 0, 0}, Vec3::UnitZ(), 20 * Vec3::UnitX(), 20 * Vec3::UnitY()),
      cylinder("bore.1", {1, 2, 3}, Vec3::UnitZ(), 6.0)};
  d.plan.features[1].side = metrology::Side::inside;
  auto top = measured("DAT_A", "plane");
  top.parameters = {{"point", {0, 0, 0.0023}}, {"axis", {0, 0, 1}}};
  auto bore = measured("bore.1", "cylinder");
  bore.parameters = {{"point", {1.001, 2, 3}}, {"axis", {0, 0, 1}}, {"radius", {6.0125}}};
  bore.points = {{Vec3(7.0125, 2, 3), Vec3(-1, 0, 0), 0.0, 0}};
  d.report.measurement.features = {top, bore};
  auto size = result("bore.diameter", "diameter", {"bore.1"}, 12.025, 0.1);
  size.unit = "mm";
  size.nominal = 12.0;
  size.pass = true;
  d.report.measurement.characteristics = {
      result("FLAT1", "flatness", {"DAT_A"}, 23.0, 100.0), size,
      result("bore.perp", "perpendicularity", {"bore.1", "DAT_A"}, 120.0, 100.0),
      result("bore.other", "line_distance", {"bore.1"}, 1.0, 2.0)};
  return d;
}

// Lines that end with $ go on.
std::vector<std::string> statements(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream lines(text);
  std::string line, whole;
  while (std::getline(lines, line)) {
    EXPECT_LT(line.size(), 80U) << line;
    whole += line;
    if (line.ends_with(",$")) {
      whole.pop_back();
      continue;
    }
    if (!whole.empty() && !whole.starts_with("$$")) all.push_back(whole);
    whole.clear();
  }
  return all;
}

// What the consortium's file says of a datum plane, letter by letter but for the digits.
TEST(DmisReport, IsLaidOutAsTheConsortiumDoes) {
  const auto all = statements(plate().text());
  const std::vector<std::string> expected{
      "FILNAM/'It s a plate',05.3",
      "UNITS/MM,ANGDEC",
      "OUTPUT/F(DAT_A),T(FLAT1)",
      "F(DAT_A)=FEAT/PLANE,CART,0.0000000,0.0000000,0.0000000,0.000000000,0.000000000,1.000000000",
      "T(FLAT1)=TOL/FLAT,0.1000000",
      "OUTPUT/FA(DAT_A),TA(FLAT1)",
      "FA(DAT_A)=FEAT/PLANE,CART,0.0000000,0.0000000,0.0023000,0.000000000,0.000000000,1.000000000",
      "TA(FLAT1)=TOL/FLAT,0.0230000,INTOL"};
  ASSERT_GT(all.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(all[i], expected[i]);
  EXPECT_EQ(all.back(), "ENDFIL");
}

TEST(DmisReport, HasSizesAsDeviationsAndDatums) {
  const std::string text = plate().text();
  const auto all = statements(text);
  const auto expect_statement = [&](const std::string& one) {
    EXPECT_NE(std::find(all.begin(), all.end(), one), all.end()) << one << "\n" << text;
  };
  expect_statement("DATDEF/FA(DAT_A),DAT(A)");
  expect_statement("OUTPUT/F(BORE_1),T(BORE_DIAMETER),T(BORE_PERP)");
  expect_statement("T(BORE_DIAMETER)=TOL/DIAM,-0.1000000,0.1000000");
  expect_statement("TA(BORE_DIAMETER)=TOL/DIAM,0.0250000,INTOL");
  expect_statement("TA(BORE_PERP)=TOL/PERP,0.1200000,OUTOL,RFS,DAT(A)");
  expect_statement(
      "FA(BORE_1)=FEAT/CYLNDR,INNER,CART,1.0010000,2.0000000,3.0000000,0.000000000,0.000000000,"
      "1.000000000,12.0250000");
  expect_statement(
      "FA(BORE_1_P1)=FEAT/POINT,CART,7.0125000,2.0000000,3.0000000,-1.000000000,0.000000000,"
      "0.000000000");
  EXPECT_THAT(text, HasSubstr("$$ bore.other (line_distance): 1.000 um, tolerance 2.000, pass"));
}

TEST(DmisReport, HasTheApexAndTheFullAngleOfACone) {
  using namespace metrology::measured;
  Document d;
  metrology::PlannedFeature cone = cylinder("cone", {0, 0, 10}, Vec3::UnitZ(), 20.0);
  cone.kind = metrology::FeatureKind::cone;
  cone.half_angle = std::atan(0.5);
  d.plan.features = {cone};
  auto found = measured("cone", "cone");
  // A fit holds the orthogonal distance: 20 across the axis.
  found.parameters = {{"point", {0, 0, 10}},
                      {"axis", {0, 0, 1}},
                      {"radius", {20.0 * std::cos(std::atan(0.5))}},
                      {"half_angle", {std::atan(0.5)}}};
  d.report.measurement.features = {found};
  const auto all = statements(d.text());
  // The apex is 20 / 0.5 below; 2 atan 0.5 is 53.130102354 deg.
  const std::string numbers =
      "FEAT/CONE,OUTER,CART,0.0000000,0.0000000,-30.0000000,0.000000000,0.000000000,1.000000000,"
      "53.130102354";
  EXPECT_EQ(all[3], "F(CONE)=" + numbers);
  EXPECT_EQ(all[5], "FA(CONE)=" + numbers);
}

// Every statement that is written has one of these forms.
TEST(DmisReport, HasNoOtherStatements) {
  const std::string n = R"(-?\d+\.\d+)", label = R"([A-Z0-9_]+)";
  const std::regex form(
      R"(FILNAM/'[^']*',05\.3|UNITS/MM,ANGDEC|ENDFIL|DATDEF/FA\()" + label +
      R"(\),DAT\([A-Z]+\)|)" + R"(OUTPUT/F\()" + label + R"(\)(,T\()" + label +
      R"(\))*|OUTPUT/FA\()" + label + R"(\)(,TA\()" + label + R"(\))*|FA?\()" + label +
      R"(\)=FEAT/(PLANE|POINT|(CYLNDR|CIRCLE|CONE|SPHERE),(INNER|OUTER)|LINE,UNBND),CART(,)" + n +
      R"(){4,9}|T\()" + label + R"(\)=TOL/[A-Z]+(,3D)?(,)" + n +
      R"(){1,2}(,RFS(,DAT\([A-Z]+\))+)?|)" + R"(TA\()" + label + R"(\)=TOL/[A-Z]+(,3D)?,)" + n +
      R"(,(INTOL|OUTOL)(,RFS(,DAT\([A-Z]+\))+)?)");
  for (const std::string& one : statements(plate().text())) {
    EXPECT_TRUE(std::regex_match(one, form)) << one;
  }
}

// Names of any length: 138 letters made lines of 200 before.
TEST(DmisReport, HasNoLineOf80ColumnsWhateverTheNames) {
  Document d = plate();
  const std::string longest(138, 'b');
  d.report.title = longest + ", a part with a title that is longer than a line may be \xc3\xa9";
  auto bore = d.plan.features[1];
  auto measured_bore = d.report.measurement.features[1];
  for (const char* ending : {"1", "2"}) {
    bore.name = measured_bore.name = longest + ending;
    d.plan.features.push_back(bore);
    d.report.measurement.features.push_back(measured_bore);
    d.report.measurement.characteristics.push_back(
        result(longest + ending + ".size", "cylindricity", {bore.name}, 1.0, 2.0));
    d.report.measurement.characteristics.push_back(
        result(longest + ending + ".perp", "perpendicularity", {"DAT_A", bore.name}, 1.0, 2.0));
  }
  std::map<std::string, int> made;
  for (const std::string& one : statements(d.text())) {
    if (one.starts_with("F(")) ++made[one.substr(0, one.find(')'))];
  }
  EXPECT_EQ(made.size(), 4U);
  EXPECT_TRUE(made.contains("F(" + std::string(48, 'B')));
  EXPECT_TRUE(made.contains("F(" + std::string(46, 'B') + "_2"));
  EXPECT_THAT(d.text(), HasSubstr("(" + std::string(46, 'B') + "_2_P1)=FEAT/POINT"));
  for (const auto& [label, times] : made) EXPECT_EQ(times, 1) << label;
}

TEST(DmisReport, CallsDatumsByTheirOwnLetters) {
  using namespace metrology::measured;
  Document d = plate();
  for (const char* name : {"C", "groove", "B", "datum q"}) {
    d.plan.features.push_back(
        plane(name, {0, 0, 0}, Vec3::UnitZ(), 20 * Vec3::UnitX(), 20 * Vec3::UnitY()));
    d.report.measurement.features.push_back(measured(name, "plane"));
    d.report.measurement.characteristics.push_back(
        result(std::string(name) + ".par", "parallelism", {"bore.1", name}, 1.0, 2.0));
  }
  d.report.measurement.characteristics.erase(d.report.measurement.characteristics.end() - 2);
  const std::string text = d.text();
  EXPECT_THAT(text, HasSubstr("DATDEF/FA(C),DAT(C)"));
  EXPECT_THAT(text, HasSubstr("TA(C_PAR)=TOL/PARLEL,0.0010000,INTOL,RFS,DAT(C)"));
  EXPECT_THAT(text, HasSubstr("DATDEF/FA(DATUM_Q),DAT(Q)"));
  // B is a feature that is no datum here: the first free letter is D.
  EXPECT_THAT(text, HasSubstr("$$ datum D: groove\nDATDEF/FA(GROOVE),DAT(D)"));
}

TEST(DmisReport, HasEachLabelOnce) {
  Document d = plate();
  d.report.measurement.characteristics[1].name = "FLAT1";
  EXPECT_THAT(d.text(), HasSubstr("T(FLAT1_2)=TOL/DIAM"));
}

}  // namespace
}  // namespace frustum::report
