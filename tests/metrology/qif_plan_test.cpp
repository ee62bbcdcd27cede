// Plans of QIF documents that others wrote: what their elements state, and where they are wrong.
#include "metrology/plan/qif/qif_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace frustum::metrology {
namespace {

// A bore across a datum plane, in inches, with nothing that Frustum would say of its own.
constexpr const char* kForeignQif = R"(<?xml version="1.0" encoding="UTF-8"?>
<QIFDocument xmlns="http://qifstandards.org/xsd/qif3" versionQIF="3.0.0" idMax="60">
<QPId>fd43400a-29bf-4ec6-b96c-e2f846eb6ff6</QPId>
<FileUnits><PrimaryUnits>
<AngularUnit><SIUnitName>radian</SIUnitName><UnitName>deg</UnitName>
<UnitConversion><Factor>0.017453292</Factor></UnitConversion></AngularUnit>
<LinearUnit><SIUnitName>meter</SIUnitName><UnitName>inch</UnitName>
<UnitConversion><Factor>0.0254</Factor></UnitConversion></LinearUnit>
</PrimaryUnits></FileUnits>
<DatumDefinitions n="1"><DatumDefinition id="50"><DatumLabel>A</DatumLabel>
<FeatureNominalIds n="1"><Id>2</Id></FeatureNominalIds></DatumDefinition></DatumDefinitions>
<DatumReferenceFrames n="1"><DatumReferenceFrame id="51"><Datums n="1"><Datum><SimpleDatum>
<DatumDefinitionId>50</DatumDefinitionId><MaterialModifier>REGARDLESS</MaterialModifier>
<ReferencedComponent>ACTUAL</ReferencedComponent></SimpleDatum>
<Precedence><PrecedenceEnum>PRIMARY</PrecedenceEnum></Precedence></Datum></Datums>
</DatumReferenceFrame></DatumReferenceFrames>
<Features>
<FeatureDefinitions n="2">
<PlaneFeatureDefinition id="1"/>
<CylinderFeatureDefinition id="4"><InternalExternal>INTERNAL</InternalExternal>
<Diameter>2</Diameter><Length>3</Length></CylinderFeatureDefinition>
</FeatureDefinitions>
<FeatureNominals n="2">
<PlaneFeatureNominal id="2"><FeatureDefinitionId>1</FeatureDefinitionId>
<Location>0 0 1</Location><Normal>0 0 1</Normal></PlaneFeatureNominal>
<CylinderFeatureNominal id="5"><FeatureDefinitionId>4</FeatureDefinitionId>
<Axis><AxisPoint>4 0 1</AxisPoint><Direction>0 0 -1</Direction></Axis></CylinderFeatureNominal>
</FeatureNominals>
<FeatureItems n="2">
<PlaneFeatureItem id="3"><FeatureNominalId>2</FeatureNominalId><FeatureName> top </FeatureName></PlaneFeatureItem>
<CylinderFeatureItem id="6"><FeatureNominalId>5</FeatureNominalId><FeatureName>bore</FeatureName></CylinderFeatureItem>
</FeatureItems>
</Features>
<Characteristics>
<CharacteristicDefinitions n="2">
<PerpendicularityCharacteristicDefinition id="20"><ToleranceValue>0.001</ToleranceValue>
<DatumReferenceFrameId>51</DatumReferenceFrameId><MaterialCondition>REGARDLESS</MaterialCondition>
<ZoneShape><DiametricalZone/></ZoneShape></PerpendicularityCharacteristicDefinition>
<DiameterCharacteristicDefinition id="23"><Tolerance><MaxValue>2.01</MaxValue>
<MinValue>1.99</MinValue><DefinedAsLimit>true</DefinedAsLimit></Tolerance></DiameterCharacteristicDefinition>
</CharacteristicDefinitions>
<CharacteristicNominals n="2">
<PerpendicularityCharacteristicNominal id="21"><CharacteristicDefinitionId>20</CharacteristicDefinitionId>
<FeatureNominalIds n="1"><Id>5</Id></FeatureNominalIds></PerpendicularityCharacteristicNominal>
<DiameterCharacteristicNominal id="24"><CharacteristicDefinitionId>23</CharacteristicDefinitionId>
<TargetValue>2</TargetValue></DiameterCharacteristicNominal>
</CharacteristicNominals>
<CharacteristicItems n="2">
<PerpendicularityCharacteristicItem id="22"><CharacteristicDesignator><Designator>7.1</Designator></CharacteristicDesignator>
<CharacteristicNominalId>21</CharacteristicNominalId></PerpendicularityCharacteristicItem>
<DiameterCharacteristicItem id="25"><Name>bore size</Name><FeatureItemIds n="1"><Id>6</Id></FeatureItemIds>
<SubstituteFeatureAlgorithm><SubstituteFeatureAlgorithmEnum>LEASTSQUARES</SubstituteFeatureAlgorithmEnum></SubstituteFeatureAlgorithm>
<CharacteristicNominalId>24</CharacteristicNominalId></DiameterCharacteristicItem>
</CharacteristicItems>
</Characteristics>
</QIFDocument>
)";

std::string foreign_with(const std::string& from, const std::string& to) {
  std::string text = kForeignQif;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string plan_refusal(const std::string& text) {
  const auto read = parse_qif_plan(text, "p.qif");
  return read ? "accepted" : to_string(read.error().front());
}

TEST(QifPlan, OfAnotherProgramIsRead) {
  const auto read = parse_qif_plan(kForeignQif, "p.qif");
  ASSERT_TRUE(read) << to_string(read.error().front());
  const InspectionPlan& plan = read->plan;
  ASSERT_EQ(plan.features.size(), 2U);
  EXPECT_EQ(plan.features[0].name, "top");
  EXPECT_EQ(plan.features[0].point, Vec3(0, 0, 25.4));
  EXPECT_EQ(plan.features[1].radius, 25.4);
  EXPECT_EQ(plan.features[1].side, Side::inside);
  EXPECT_EQ(plan.features[1].extent, Extent(AxialExtent{0.0, 3 * 25.4}));
  ASSERT_EQ(plan.characteristics.size(), 2U);
  EXPECT_EQ(plan.characteristics[0].name, "7.1");
  EXPECT_EQ(plan.characteristics[0].features, (std::vector<std::string>{"bore", "top"}));
  EXPECT_DOUBLE_EQ(plan.characteristics[0].tolerance, 0.0254);
  EXPECT_EQ(plan.characteristics[1].criterion, Criterion::least_squares);
  EXPECT_NEAR(plan.characteristics[1].tolerance, 0.254, 1e-12);
  // Where to touch it does not say: points can be evaluated, nothing can be probed.
  ASSERT_EQ(read->warnings.size(), 2U);
  EXPECT_EQ(
      to_string(read->warnings[0]),
      "p.qif:30:1: warning: the document does not say where to touch top, bore: which sections "
      "their points are of is not known (hint: AttributeStr plan.strategy of a feature's item "
      "says so)");
  const auto for_probing = parse_plan(kForeignQif, "p.qif");
  ASSERT_FALSE(for_probing);
  EXPECT_EQ(for_probing.error().front().severity, Severity::error);
}

TEST(QifPlan, IsKnownByItsExtensionAndByItsText) {
  EXPECT_TRUE(is_qif("", "a.QIF"));
  EXPECT_TRUE(is_qif("\xef\xbb\xbf <?xml", "/dev/stdin"));
  EXPECT_FALSE(is_qif("title = \"<\"", "a.toml"));
  EXPECT_EQ(
      plan_refusal("title = \"no\""),
      "p.qif:1:13: error: no XML: No document element found (hint: an XML document of QIF 3.0 "
      "(ISO 23952) is expected, whole)");
}

TEST(QifPlan, IsRefusedWithThePlaceOfTheFault) {
  std::string torus = foreign_with("<CylinderFeatureItem", "<TorusFeatureItem");
  torus.replace(torus.find("</CylinderFeatureItem"), 21, "</TorusFeatureItem");
  EXPECT_EQ(
      plan_refusal(torus),
      "p.qif:31:1: error: <TorusFeatureItem id=\"6\"> is no feature that a plan has (hint: one "
      "of these is expected, with FeatureItem: Plane Cylinder Cone Circle Line Sphere Point)");
  EXPECT_EQ(plan_refusal(foreign_with("<Diameter>2<", "<Diameter>two<")),
            "p.qif:21:1: error: <Diameter> is 'two' (hint: one finite number is expected)");
  EXPECT_EQ(
      plan_refusal(foreign_with("<Diameter>2<", "<Diameter>-2<")),
      "p.qif:21:1: error: <Diameter> is -50.8 mm (hint: a length greater than 0 is expected)");
  EXPECT_EQ(
      plan_refusal(foreign_with("<Diameter>2<", "<Diameter linearUnit=\"mm\">2<")),
      "p.qif:21:1: error: <Diameter> has a unit of its own, mm (hint: the primary unit of the "
      "document is expected: inch)");
  EXPECT_EQ(
      plan_refusal(foreign_with("<Location>0 0 1</Location>", "")),
      "p.qif:24:1: error: <PlaneFeatureNominal id=\"2\"> has no <Location> (hint: three numbers "
      "are expected)");
  EXPECT_EQ(plan_refusal(foreign_with("<Direction>0 0 -1<", "<Direction>0 0 -2<")),
            "p.qif:27:35: error: <Direction> has the length 2 (hint: a unit vector is expected)");
  EXPECT_EQ(plan_refusal(foreign_with("<FeatureNominalId>5<", "<FeatureNominalId>55<")),
            "p.qif:31:1: error: <CylinderFeatureItem id=\"6\"> refers by <FeatureNominalId> to 55, "
            "which is not there (hint: the id of a <CylinderFeatureNominal> is expected)");
  EXPECT_EQ(
      plan_refusal(foreign_with("<MaterialCondition>REGARDLESS", "<MaterialCondition>MAXIMUM")),
      "p.qif:37:50: error: <MaterialCondition> is MAXIMUM (hint: NONE or REGARDLESS is "
      "expected: plans have no material condition)");
  EXPECT_EQ(
      plan_refusal(foreign_with("<DiametricalZone/>", "<PlanarZone/>")),
      "p.qif:38:12: error: <PlanarZone> is another zone than that of the characteristic (hint: "
      "<DiametricalZone> is expected)");
  EXPECT_EQ(plan_refusal(foreign_with("<MaxValue>2.01<", "<MaxValue>2.02<")),
            "p.qif:39:43: error: <Tolerance> allows 0.254 below and 0.508 above the nominal (hint: "
            "limits as far to either side are expected, greater than 0)");
  EXPECT_EQ(plan_refusal(foreign_with("<TargetValue>2<", "<TargetValue>3<")),
            "p.qif:46:1: error: <TargetValue> is 3 (hint: the size of the nominal feature is "
            "expected)");
  EXPECT_EQ(
      plan_refusal(foreign_with("<DatumReferenceFrameId>51</DatumReferenceFrameId>",
                                "<MaximumToleranceValue>1</MaximumToleranceValue>")),
      "p.qif:37:1: error: <MaximumToleranceValue> of a PerpendicularityCharacteristicDefinition "
      "is nothing that a plan has (hint: a definition with ToleranceValue or Tolerance is "
      "expected)");
  EXPECT_EQ(plan_refusal(foreign_with(">LEASTSQUARES", ">NURBS")),
            "p.qif:52:1: error: <SubstituteFeatureAlgorithm> is 'NURBS' (hint: one of these is "
            "expected: LEASTSQUARES MINMAX MAXINSCRIBED MINCIRCUMSCRIBED ONESIDED)");
  EXPECT_EQ(plan_refusal(foreign_with(">LEASTSQUARES", ">MAXINSCRIBED")),
            "p.qif:51:1: error: <DiameterCharacteristicItem id=\"25\"> "
            "(characteristic[2].criterion): a diameter is not evaluated by \"mi\" (hint: it takes "
            "ls)");
  EXPECT_EQ(plan_refusal("<QIFDocument versionQIF=\"3.0.0\"/>"),
            "p.qif:1:1: error: <QIFDocument> states no unit of length (hint: "
            "FileUnits/PrimaryUnits/LinearUnit says how many metres a unit is)");
}

// What XML allows, and what it does not: no number becomes another one without a word.
TEST(QifPlan, ReadsNumbersWhole) {
  const auto commented =
      parse_qif_plan(foreign_with("<Diameter>2<", "<Diameter>0<!-- was 3 --><?keep?>2<"), "p.qif");
  ASSERT_TRUE(commented) << to_string(commented.error().front());
  EXPECT_EQ(commented->plan.features[1].radius, 25.4);
  EXPECT_EQ(plan_refusal(foreign_with("<Diameter>2<", "<Diameter>2<b/>0<")),
            "p.qif:21:1: error: <Diameter> is '2 0' (hint: one finite number is expected)");
  EXPECT_EQ(plan_refusal(foreign_with("<Diameter>2</Diameter>",
                                      "<Diameter>2</Diameter><Diameter>4</Diameter>")),
            "p.qif:21:23: error: <Diameter> is there twice (hint: it is expected once)");
  EXPECT_EQ(plan_refusal(foreign_with("<Factor>0.0254<", "<Factor>0.001<")),
            "p.qif:8:17: error: <Factor> says that an inch is 1 mm (hint: 0.0254 metres are "
            "expected)");
  EXPECT_EQ(plan_refusal(std::string(kForeignQif) + "<QIFDocument/>").substr(0, 60),
            "p.qif:57:1: error: <QIFDocument> follows the root element (h");
}

TEST(QifPlan, RefusesADatumThatTheFrameContradicts) {
  const std::string of_one = "<FeatureNominalIds n=\"1\"><Id>5</Id></FeatureNominalIds></Perpend";
  std::string text = foreign_with(
      of_one, "<FeatureNominalIds n=\"2\"><Id>5</Id><Id>2</Id></FeatureNominalIds></Perpend");
  EXPECT_TRUE(parse_qif_plan(text, "p.qif")) << "they agree";
  const std::string of_datum =
      "<FeatureNominalIds n=\"1\"><Id>2</Id></FeatureNominalIds></DatumDef";
  text.replace(text.find(of_datum), of_datum.size(),
               "<FeatureNominalIds n=\"1\"><Id>5</Id></FeatureNominalIds></DatumDef");
  EXPECT_EQ(plan_refusal(text),
            "p.qif:36:1: error: <PerpendicularityCharacteristicDefinition id=\"20\"> has the datum "
            "'bore' by its frame, 'top' as second feature (hint: one datum is expected)");
}

std::string with_attribute(const std::string& name, const std::string& value) {
  const std::string item = "<CylinderFeatureItem id=\"6\">";
  return foreign_with(item, item + "<Attributes n=\"1\"><AttributeStr name=\"" + name +
                                "\" value=\"" + value + "\"/></Attributes>");
}

TEST(QifPlan, HasKeysOfPlansAsAttributes) {
  const auto read = parse_qif_plan(
      with_attribute("plan.strategy", "{ sections = [20, 40], points_per_section = 12 }"), "p.qif");
  ASSERT_TRUE(read) << to_string(read.error().front());
  EXPECT_EQ(std::get<SectionStrategy>(read->plan.features[1].strategy).sections,
            (std::vector<double>{20, 40}));
  EXPECT_TRUE(parse_qif_plan(with_attribute("mine", "7"), "p.qif")) << "others are others'";
}

TEST(QifPlan, RefusesWrongAttributes) {
  EXPECT_EQ(plan_refusal(with_attribute("plan.strategi", "{ sections = [20] }")).substr(0, 19),
            "p.qif:31:47: error:");
  EXPECT_EQ(plan_refusal(with_attribute("plan.strategy", "{ sections = [")).substr(0, 9),
            "p.qif:31:");
  EXPECT_EQ(
      plan_refusal(with_attribute("plan.radius", "25.5")),
      "p.qif:31:1: error: <CylinderFeatureItem id=\"6\"> has an attribute that contradicts its "
      "elements: radius (hint: the attribute plan. is expected to say the same, or not to be "
      "there)");
  EXPECT_EQ(plan_refusal(with_attribute("plan.name", "&quot;hole&quot;")),
            "p.qif:31:47: error: <AttributeStr> name=\"plan.name\" says what elements say (hint: "
            "names are expected in Name and FeatureName only)");
  EXPECT_EQ(
      plan_refusal(with_attribute("plan.extent", "1&#10;[[feature]]")),
      "p.qif:31:47: error: <AttributeStr> name=\"plan.extent\" has a value over several lines "
      "(hint: a TOML value on one line is expected)");
}

// The ends of a plane and the sections of a bore are in no element: no value is made of a guess.
TEST(QifPlan, RefusesWhatItsElementsDoNotDetermine) {
  std::string text = foreign_with("<Id>5</Id>", "<Id>2</Id>");
  text.replace(text.find("<DiametricalZone/>"), 18, "<PlanarZone/>");
  text.replace(text.find("<FeatureNominalIds n=\"1\"><Id>2</Id></FeatureNominalIds></DatumDef"), 65,
               "<FeatureNominalIds n=\"1\"><Id>5</Id></FeatureNominalIds></DatumDef");
  EXPECT_EQ(
      plan_refusal(text),
      "p.qif:49:1: error: <PerpendicularityCharacteristicItem id=\"22\"> needs sections or the "
      "extent of 'top', which QIF has no element for (hint: AttributeStr plan.strategy, and "
      "plan.extent if wanted, of the feature's item are expected)");
  std::string round = kForeignQif;
  for (std::size_t at = 0; (at = round.find("Perpendicularity", at)) != round.npos; ++at) {
    round.replace(at, 16, "Circularity");
  }
  round.replace(round.find("<DatumReferenceFrameId>51</DatumReferenceFrameId>"), 49, "");
  round.replace(round.find("<MaterialCondition>REGARDLESS</MaterialCondition>"), 49, "");
  round.replace(round.find("<ZoneShape><DiametricalZone/></ZoneShape>"), 41, "");
  EXPECT_NE(plan_refusal(round).find("needs sections or the extent of 'bore'"), std::string::npos)
      << plan_refusal(round);
}

}  // namespace
}  // namespace frustum::metrology
