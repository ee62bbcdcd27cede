// Points of QIF documents: by feature, in mm, whole sets, ranges and single points.
#include "metrology/points/qif_points.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "metrology/points/point_file.hpp"

namespace frustum::metrology {
namespace {

// A document with two items; `lists` are of their measurements, `sets` the point sets.
std::string document(const std::string& lists, const std::string& sets, double metres = 0.001) {
  const auto count = [](const std::string& text, const std::string& element) {
    std::size_t found = 0;
    for (std::size_t at = text.find(element); at != text.npos; at = text.find(element, at + 1))
      ++found;
    return found;
  };
  return fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<QIFDocument xmlns="http://qifstandards.org/xsd/qif3" versionQIF="3.0.0" idMax="99">
<FileUnits><PrimaryUnits><LinearUnit><SIUnitName>meter</SIUnitName><UnitName>unit</UnitName>
<UnitConversion><Factor>{}</Factor></UnitConversion></LinearUnit></PrimaryUnits></FileUnits>
<Features><FeatureItems n="2">
<CircleFeatureItem id="4"><FeatureName>bore</FeatureName></CircleFeatureItem>
<PlaneFeatureItem id="5"><FeatureName>top</FeatureName></PlaneFeatureItem>
</FeatureItems></Features>
<Results><MeasurementResultsSet n="1"><MeasurementResults id="6">
<MeasuredFeatures n="{}">{}</MeasuredFeatures><MeasuredPointSets n="{}">{}</MeasuredPointSets>
</MeasurementResults></MeasurementResultsSet></Results></QIFDocument>)",
      metres, count(lists, "FeatureMeasurement id="), lists, count(sets, "<MeasuredPointSet "),
      sets);
}

std::string measured(int item, const std::string& references) {
  return fmt::format(
      "<CircleFeatureMeasurement id=\"7\"><FeatureItemId>{}</FeatureItemId><PointList n=\"1\">{}"
      "</PointList></CircleFeatureMeasurement>",
      item, references);
}

const std::string kWhole = "<WholePointSetId>8</WholePointSetId>";
const std::string kSet =
    "<MeasuredPointSet count=\"3\" id=\"8\"><Points>1 2 3  4 5 6\n7 8 9</Points>"
    "<Compensated>true</Compensated></MeasuredPointSet>";

TEST(QifPoints, AreThoseOfTheirFeatures) {
  const auto found = parse_qif_points(document(
      measured(4, kWhole) + measured(5, "<RangePointSetId range=\"2 3\">8</RangePointSetId>") +
          measured(5, "<SinglePointSetId index=\"1\">8</SinglePointSetId>"),
      kSet));
  ASSERT_TRUE(found) << to_string(found.error().front());
  const auto& features = found->features;
  ASSERT_EQ(features.size(), 2U);
  EXPECT_EQ(features[0].feature, "bore");
  ASSERT_EQ(features[0].points.size(), 3U);
  EXPECT_EQ(features[0].points[2], Vec3(7, 8, 9));
  EXPECT_EQ(features[1].feature, "top");
  ASSERT_EQ(features[1].points.size(), 3U);
  EXPECT_EQ(features[1].points[0], Vec3(4, 5, 6));
  EXPECT_EQ(features[1].points[2], Vec3(1, 2, 3)) << "a later measurement of the same feature";
}

TEST(QifPoints, AreInMillimetres) {
  const auto inches = parse_qif_points(document(measured(4, kWhole), kSet, 0.0254));
  ASSERT_TRUE(inches);
  EXPECT_EQ(inches->features.front().points[0], Vec3(25.4, 50.8, 3 * 25.4));
}

TEST(QifPoints, AreFoundByTheExtensionOfAFile) {
  const std::string text = document(measured(4, kWhole), kSet);
  const auto found = parse_feature_points(text, "part.QIF");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->front().file, "part.QIF");
  EXPECT_FALSE(parse_feature_points(text, "part.qif", length_unit("inch")))
      << "the document states its unit";
}

TEST(QifPoints, AreRefusedWhereTheyAreNotTheSurface) {
  const auto id_of = [](const std::string& text) {
    const auto found = parse_qif_points(text);
    return found ? std::string() : std::string(found.error().front().id.text());
  };
  const auto replaced = [](const std::string& from, const std::string& to) {
    std::string set = kSet;
    set.replace(set.find(from), from.size(), to);
    return document(measured(4, kWhole), set);
  };
  EXPECT_EQ(id_of("no xml"), "bad-xml");
  EXPECT_EQ(id_of("<other/>"), "not-qif");
  EXPECT_EQ(id_of("<QIFDocument/>"), "qif-version");
  EXPECT_EQ(id_of("<QIFDocument versionQIF=\"3.0.0\"/>"), "length-unit");
  EXPECT_EQ(id_of(document("", "")), "file-without-points");
  EXPECT_EQ(id_of(document(measured(9, kWhole), kSet)), "bad-reference");
  EXPECT_EQ(id_of(document(measured(4, "<WholePointSetId>3</WholePointSetId>"), kSet)),
            "bad-reference");
  EXPECT_EQ(
      id_of(document(measured(4, "<RangePointSetId range=\"2 4\">8</RangePointSetId>"), kSet)),
      "bad-reference");
  EXPECT_EQ(
      id_of(document(measured(4, "<SinglePointSetId index=\"0\">8</SinglePointSetId>"), kSet)),
      "bad-reference");
  EXPECT_EQ(id_of(replaced("true", "false")), "not-compensated");
  EXPECT_TRUE(parse_qif_points(replaced("true", "false"), PointMeaning::ball_centre));
  EXPECT_FALSE(parse_qif_points(replaced("true", "true"), PointMeaning::ball_centre));
  EXPECT_EQ(id_of(replaced("<Compensated>true</Compensated>",
                           "<Compensations>true false true</Compensations>")),
            "not-compensated");
  EXPECT_EQ(id_of(replaced("<Points>", "<CoordinateSystemId>3</CoordinateSystemId><Points>")),
            "own-frame");
  EXPECT_EQ(id_of(replaced("9</Points>", "nan</Points>")), "bad-numbers");
  EXPECT_EQ(id_of(replaced("9</Points>", "</Points>")), "bad-numbers");
}

// Line and column as editors count them; the line of a feature's points is that of its measurement.
TEST(QifPoints, HaveAPlaceInTheDocument) {
  const auto said = [](const std::string& text) {
    const auto found = parse_feature_points(text, "p.qif");
    return found ? std::string() : to_string(found.error().front());
  };
  const std::string text = document(measured(4, kWhole), kSet);
  EXPECT_EQ(said(text.substr(0, text.size() - 20)),
            "p.qif:12:48: error: no XML: Start-end tags mismatch (hint: an XML document of "
            "QIF 3.0 (ISO 23952) is expected, whole)");
  EXPECT_EQ(
      said(document(measured(4, "<WholePointSetId>47</WholePointSetId>"), kSet)),
      "p.qif:10:107: error: <WholePointSetId> of 'bore' names point set 47, which is not there "
      "(hint: the id of a MeasuredPointSet)");
  std::string counted = text;
  counted.replace(counted.find("count=\"3\""), 9, "count=\"4\"");
  EXPECT_EQ(said(counted),
            "p.qif:10:226: error: <MeasuredPointSet id=\"8\"> states count=\"4\", its Points are 3 "
            "(hint: as many points as count says are expected: is the set whole?)");
  std::string old = text;
  old.replace(old.find("3.0.0"), 5, "2.1.0");
  EXPECT_EQ(said(old),
            "p.qif:2:1: error: <QIFDocument> is of versionQIF \"2.1.0\" (hint: "
            "versionQIF=\"3.0.0\" is expected: save the document as QIF 3.0)");
  const auto found = parse_feature_points(text, "p.qif");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->front().line, 10);
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string refusal_of(const std::string& text) {
  const auto read = parse_qif_points(text);
  return read ? "read" : to_string(read.error().front()).substr(1);
}

TEST(QifForm, ListsHaveAsManyElementsAsTheySay) {
  const std::string whole = document(measured(4, kWhole), kSet);
  EXPECT_EQ(refusal_of(whole), "read");
  EXPECT_EQ(refusal_of(changed(whole, "<FeatureItems n=\"2\">", "<FeatureItems n=\"3\">")),
            "5:11: error: <FeatureItems> states n=\"3\", it has 2 elements (hint: as many elements "
            "as n says are expected: is the document whole?)");
  for (const char* wrong : {"-1", "1.0", "", "one"}) {
    const std::string list = fmt::format("<PointList n=\"{}\">", wrong);
    const std::string refusal = refusal_of(changed(whole, "<PointList n=\"1\">", list));
    EXPECT_TRUE(refusal.starts_with(
        fmt::format("10:90: error: <PointList> states n=\"{}\", it has 1 element ", wrong)))
        << refusal;
  }
  // What is not read may say what it likes.
  EXPECT_EQ(
      refusal_of(changed(whole, "<Features>", "<Product><LoopSet n=\"8\"/></Product><Features>")),
      "read");
}

TEST(QifForm, WhatIsReferredToHasANumber) {
  const std::string whole = document(measured(4, kWhole), kSet);
  EXPECT_EQ(refusal_of(changed(whole, "<PlaneFeatureItem id=\"5\">", "<PlaneFeatureItem>")),
            "7:1: error: <PlaneFeatureItem> has no id (hint: a whole number is expected, by which "
            "others refer to it)");
  for (const char* wrong : {"-5", "five", "5.0", ""}) {
    const std::string item = fmt::format("<PlaneFeatureItem id=\"{}\">", wrong);
    EXPECT_EQ(
        refusal_of(changed(whole, "<PlaneFeatureItem id=\"5\">", item)),
        fmt::format(
            "7:1: error: {} has an id that is not a whole number (hint: a number from 1 on is "
            "expected, by which others refer to it)",
            item));
  }
}

TEST(QifForm, NamesMayHaveThePrefixOfTheirNamespace) {
  std::string text = document(measured(4, kWhole), kSet);
  std::string prefixed;
  for (std::size_t i = 0; i < text.size(); ++i) {
    prefixed += text[i];
    if (text[i] != '<' || text[i + 1] == '?') continue;
    if (text[i + 1] == '/') prefixed += text[++i];
    prefixed += "q:";
  }
  prefixed = changed(prefixed, "xmlns=", "xmlns:q=");
  const auto read = parse_qif_points(prefixed);
  ASSERT_TRUE(read) << to_string(read.error().front());
  EXPECT_EQ(read->features.front().points.size(), 3U);
  EXPECT_EQ(refusal_of(changed(prefixed, "n=\"2\"", "n=\"1\"")).substr(0, 29),
            "5:13: error: <FeatureItems> s");
}

TEST(QifForm, ReferencesThatXmlDoesNotDefineAreRefused) {
  const std::string whole = document(measured(4, kWhole), kSet);
  EXPECT_EQ(refusal_of(changed(whole, "bore", "&part; bore")),
            "6:40: error: &part; is an entity that is not read (hint: only &amp; &lt; &gt; &quot; "
            "&apos; and "
            "numbers such as &#8960; are read)");
  for (const char* right : {"&#8960;20", "A &amp; B", "<!-- &part; -->", "<![CDATA[&part;]]>"}) {
    EXPECT_EQ(refusal_of(changed(whole, "bore", std::string("bore ") + right)), "read") << right;
  }
}

// As bytes, two for each.
std::string in_utf16(const std::string& text) {
  std::string wide = "\xFF\xFE";
  for (const char c : text) (wide += c) += '\0';
  return wide;
}

TEST(QifForm, EncodingsThatAreNotReadAreNamed) {
  const std::string whole = document(measured(4, kWhole), kSet);
  const std::string umlaut = changed(whole, "bore",
                                     "B\xFC"
                                     "chse");
  EXPECT_EQ(refusal_of(changed(umlaut, "UTF-8", "windows-1252")),
            "1:1: error: the document is in the encoding windows-1252 (hint: save the document as "
            "UTF-8)");
  EXPECT_EQ(refusal_of(changed(whole, "UTF-8", "windows-1252")), "read") << "all in ASCII";
  EXPECT_EQ(refusal_of(changed(umlaut, "UTF-8", "iso-8859-1")), "read");
  EXPECT_EQ(refusal_of(changed(whole, "UTF-8", "utf8")), "read");
  EXPECT_EQ(refusal_of(changed(whole, " encoding=\"UTF-8\"", "")), "read");
  const std::string wide = changed(changed(whole, "UTF-8", "UTF-16"), "bore", "A &amp; B");
  EXPECT_EQ(refusal_of(in_utf16(wide)), "read");
}

// What is counted there is not every element.
TEST(QifForm, OtherCountsAreNotLookedAt) {
  const std::string whole = document(measured(4, kWhole), kSet);
  for (const char* more :
       {"<BestFit n=\"2\"><NominalsCalculated/><BaseFeature/><BaseFeature/></BestFit>",
        "<TipIds n=\"3\"><Ids>1 2 3</Ids></TipIds>"}) {
    EXPECT_EQ(
        refusal_of(changed(whole, "<FeatureName>bore", more + std::string("<FeatureName>bore"))),
        "read")
        << more;
  }
  std::string deep;
  for (int k = 0; k < 100'000; ++k) deep += "<a>";
  for (int k = 0; k < 100'000; ++k) deep += "</a>";
  EXPECT_EQ(refusal_of(changed(whole, "<FeatureName>bore", deep + "<FeatureName>bore")), "read");
}

}  // namespace
}  // namespace frustum::metrology
