#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "cutter/body/cutter.hpp"
#include "cutter/body/cutter_file.hpp"
#include "cutter/body/run_out_envelope.hpp"
#include "cutter/body/tool_table.hpp"
#include "tool_shapes.hpp"

namespace frustum::cutter {
namespace {

double draw_between(std::uint64_t index, double lo, double hi) {
  return lo + (hi - lo) * uniform({.seed = 41}, index);
}

Cutter made(const CutterSpec& spec) {
  auto cutter = Cutter::make(spec);
  EXPECT_TRUE(cutter) << to_string(spec.type) << ": "
                      << (cutter ? "" : to_string(cutter.error().front()));
  return *cutter;
}

// Points along a chain, densely.
std::vector<MeridianPoint> along(const Generatrix& generatrix, int n) {
  std::vector<MeridianPoint> points;
  for (const GeneratrixSegment& s : generatrix.segments()) {
    for (int i = 0; i <= n; ++i) {
      const double t = static_cast<double>(i) / n;
      MeridianPoint p{s.from.r + t * (s.to.r - s.from.r), s.from.z + t * (s.to.z - s.from.z)};
      if (s.arc_radius > 0.0) {
        const double scale = s.arc_radius / std::hypot(p.r - s.centre.r, p.z - s.centre.z);
        p = {s.centre.r + scale * (p.r - s.centre.r), s.centre.z + scale * (p.z - s.centre.z)};
      }
      points.push_back(p);
    }
  }
  const MeridianPoint rim = generatrix.segments().back().to;
  for (int i = 0; i <= n; ++i) points.push_back({rim.r * i / n, rim.z});
  return points;
}

bool contains(const Profile& part, double r, double z) {
  const ToolPose upright{Vec3::Zero(), Vec3::UnitZ()};
  const auto chord = part.chord(upright, {Vec3(-100.0, 0.0, z), Vec3::UnitX()});
  return chord && r <= chord->hi - 100.0;
}

TEST(ToolTypesLaws, DistanceAgreesWithADenselySampledOutline) {
  std::uint64_t index = 0;
  for (const CutterSpec& spec : specimens()) {
    const Generatrix generatrix = made(spec).body().generatrix();
    const auto points = along(generatrix, 2000);
    for (int i = 0; i < 60; ++i) {
      const double r = draw_between(index++, 0.0, 1.3 * generatrix.max_radius());
      const double z = draw_between(index++, -2.0, generatrix.height() + 2.0);
      double nearest = 1e9;
      for (const auto& p : points) nearest = std::min(nearest, std::hypot(p.r - r, p.z - z));
      const double d = generatrix.distance(r, z);
      // A chord of a 2000th of a segment below 100 mm is within 0.05 mm of its neighbours.
      EXPECT_LE(std::abs(d), nearest + 1e-12) << to_string(spec.type);
      EXPECT_NEAR(std::abs(d), nearest, 1.25e-3 / std::max(0.05, nearest) + 1e-6)
          << to_string(spec.type) << " at " << r << ", " << z;
    }
  }
}

TEST(ToolTypesLaws, APointIsInsideWhenAPartOrACarvedHullWithinTheOutlineHoldsIt) {
  std::uint64_t index = 100000;
  for (const CutterSpec& spec : specimens()) {
    const Body body = made(spec).body();
    for (int i = 0; i < 1500; ++i) {
      const double r = draw_between(index++, 0.0, 1.1 * body.max_radius());
      const double z = draw_between(index++, -0.5, i % 2 == 0 ? 2.0 : body.height() + 0.5);
      const double d = body.generatrix().distance(r, z);
      if (std::abs(d) < 1e-9) continue;
      const auto holds = [&](const Profile& p) { return contains(p, r, z); };
      const bool in_part = std::any_of(body.parts().begin(), body.parts().end(), holds);
      const bool in_hull = std::any_of(body.concave().begin(), body.concave().end(), holds);
      EXPECT_EQ(in_part || (in_hull && d < 0.0), d < 0.0)
          << to_string(spec.type) << " at " << r << ", " << z;
      EXPECT_FALSE(in_part && d > 0.0) << to_string(spec.type) << " at " << r << ", " << z;
    }
  }
}

TEST(ToolTypesLaws, SupportIsTheFarthestPointOfTheOutline) {
  for (const CutterSpec& spec : specimens()) {
    const Body body = made(spec).body();
    const auto points = along(body.generatrix(), 2000);
    for (int i = -20; i <= 20; ++i) {
      const double u = i / 20.0, across = std::sqrt(1.0 - u * u);
      double best = -1e9, reach = 0.0;
      for (const auto& p : points) {
        best = std::max(best, across * p.r + u * p.z);
        reach = std::max(reach, std::hypot(p.r, p.z));
      }
      EXPECT_GE(body.support(u), best - 1e-12) << to_string(spec.type);
      EXPECT_NEAR(body.support(u), best, 1e-5) << to_string(spec.type);
      EXPECT_GE(body.reach(), reach - 1e-12) << to_string(spec.type);
    }
  }
}

TEST(ToolTypesLaws, ArcsMeetTheirNeighboursSmoothlyWhereTheTypeSaysSo) {
  for (const CutterType type : {CutterType::ball, CutterType::bull, CutterType::taper_ball,
                                CutterType::taper, CutterType::barrel, CutterType::lens}) {
    for (const CutterSpec& spec : specimens()) {
      if (spec.type != type) continue;
      const Generatrix generatrix = made(spec).body().generatrix();
      const auto s = generatrix.segments();
      for (std::size_t i = 0; i + 1 < s.size(); ++i) {
        const auto direction = [](const GeneratrixSegment& seg, const MeridianPoint& at) {
          if (seg.arc_radius == 0.0) {
            const double l = std::hypot(seg.to.r - seg.from.r, seg.to.z - seg.from.z);
            return MeridianPoint{(seg.to.r - seg.from.r) / l, (seg.to.z - seg.from.z) / l};
          }
          return MeridianPoint{-(at.z - seg.centre.z) / seg.arc_radius,
                               (at.r - seg.centre.r) / seg.arc_radius};
        };
        const auto a = direction(s[i], s[i].to), b = direction(s[i + 1], s[i + 1].from);
        EXPECT_NEAR(a.r * b.z - a.z * b.r, 0.0, 1e-12) << to_string(type) << " joint " << i;
      }
    }
  }
}

void expect_same(const Generatrix& a, const Generatrix& b) {
  for (int i = 0; i < 400; ++i) {
    const double r = draw_between(static_cast<std::uint64_t>(i), 0.0, 9.0);
    const double z = draw_between(static_cast<std::uint64_t>(i) + 1000, -1.0, 31.0);
    EXPECT_NEAR(a.distance(r, z), b.distance(r, z), 1e-12);
  }
}

TEST(ToolTypes, SevenParametersHoldFlatBallAndBull) {
  CutterSpec apt{
      .type = CutterType::apt, .diameter = {12.0}, .length = {90.0}, .flute_length = {30.0}};
  CutterSpec plain = apt;
  plain.type = CutterType::flat;
  expect_same(made(apt).body().generatrix(), made(plain).body().generatrix());
  apt.corner_radius = apt.arc_height = {6.0};
  plain.type = CutterType::ball;
  expect_same(made(apt).body().generatrix(), made(plain).body().generatrix());
  apt.corner_radius = apt.arc_height = {2.0};
  apt.arc_offset = {4.0};
  plain.type = CutterType::bull;
  plain.corner_radius = {2.0};
  expect_same(made(apt).body().generatrix(), made(plain).body().generatrix());
}

TEST(ToolTypes, AHollowEndRisesByRadiusTimesTheTangentOfItsAngle) {
  const Generatrix generatrix = made(specimens()[1]).body().generatrix();
  EXPECT_NEAR(generatrix.segments().front().from.z, 10.0 * std::tan(1.7 * kRadPerDeg), 1e-14);
  EXPECT_GT(generatrix.distance(0.0, 0.1), 0.0);
  EXPECT_EQ(made(specimens()[1]).body().concave().size(), 1U);
}

TEST(ToolTypes, ConvexOnesAreOnePart) {
  for (const CutterSpec& spec : specimens()) {
    const bool hollow = spec.end_angle.value > 0.0 || spec.type == CutterType::profile;
    EXPECT_EQ(made(spec).body().is_convex(), !hollow) << to_string(spec.type);
  }
}

TEST(ToolTypes, TextReadsBackAsTheSameTool) {
  for (CutterSpec spec : specimens()) {
    spec.holder = {{20.0, 30.0, 40.0}, {10.0, 50.0, 50.0}};
    spec.run_out = {0.004};
    spec.radius_error = {-0.003};
    spec.name = "mill \"8.5\" Fräser";
    const std::string text = "tool.7 = " + cutter_text(spec) + "\n";
    const auto document = TomlDocument::parse(text, "library.toml");
    ASSERT_TRUE(document) << text;
    const ToolList tools = read_tools(document->root().table("tool"));
    EXPECT_TRUE(document->finish().empty()) << text << to_string(document->finish().front());
    EXPECT_TRUE(tools.at(7) == spec) << text;
    made(spec);
  }
}

TEST(RunOutLaws, TheBodyIsWhatTheTurningToolCovers) {
  const double offset = 0.3;
  std::uint64_t index = 500000;
  for (CutterSpec spec : specimens()) {
    const Generatrix still = made(spec).body().generatrix();
    spec.run_out = {offset};
    const Generatrix turning = made(spec).body().generatrix();
    for (int i = 0; i < 200; ++i) {
      const double r = draw_between(index++, 0.0, i % 3 == 0 ? 1.0 : still.max_radius() + 0.5);
      const double z = draw_between(index++, -0.1, i % 2 == 0 ? 1.0 : still.height());
      if (std::abs(turning.distance(r, z)) < 1e-3) continue;
      bool covered = false;
      for (int k = 0; k <= 4000 && !covered; ++k) {
        const double a = std::numbers::pi * k / 4000;
        covered = still.distance(std::hypot(r - offset * std::cos(a), offset * std::sin(a)), z) < 0;
      }
      EXPECT_EQ(covered, turning.distance(r, z) < 0.0)
          << to_string(spec.type) << " at " << r << ", " << z;
    }
  }
}

TEST(ToolTypes, ARadiusErrorOfAFreeOutlineMovesItWhole) {
  CutterSpec spec = specimens()[15];
  const Generatrix nominal = made(spec).body().generatrix();
  for (const double by : {0.02, -0.02}) {
    spec.radius_error = {by};
    const Generatrix real = made(spec).body().generatrix();
    for (const auto& p : along(nominal, 50)) {
      if (p.r + by < 0.0 || p.z >= nominal.height()) continue;
      EXPECT_NEAR(real.distance(p.r + by, p.z), 0.0, 1e-9);
    }
  }
}

TEST(RunOut, TiltWidensTheTipAndLeavesTheGaugePoint) {
  CutterSpec spec = specimens()[0];
  spec.run_out_tilt = 100.0_urad;
  const Generatrix generatrix = made(spec).body().generatrix();
  EXPECT_NEAR(generatrix.distance(6.01, 0.0), 0.0, 1e-12);
  EXPECT_NEAR(generatrix.distance(6.0 + 100e-6 * 70.0, 30.0), 0.0, 1e-6);
}

TEST(Cutter, ShankAndHolderStandBetweenFlutesAndGaugePoint) {
  CutterSpec spec = specimens()[2];
  spec.neck_diameter = {8.0};
  spec.neck_length = {20.0};
  spec.neck_angle = 45.0_deg;
  spec.shank_diameter = {12.0};
  spec.holder = {{20.0, 30.0, 40.0}};
  const Cutter cutter = made(spec);
  ASSERT_TRUE(cutter.shank() && cutter.holder());
  EXPECT_NEAR(cutter.shank()->generatrix().distance(5.0, 46.0), 0.0, 1e-12);
  EXPECT_NEAR(cutter.shank()->height(), 80.0, 0.0);
  EXPECT_NEAR(cutter.holder()->generatrix().distance(17.5, 90.0), 0.0, 1e-12);
  EXPECT_NEAR(cutter.holder()->height(), 100.0, 0.0);
}

TEST(Cutter, OfAMetreAndMoreIsRefused) {
  CutterSpec spec{.diameter = {10.0}, .length = {100.0}, .flute_length = {10.0}};
  const auto complaint = [&spec] {
    const auto cutter = Cutter::make(spec);
    return cutter ? "" : cutter.error().front().message;
  };
  spec.holder = {{60.0, 40.0, 1000.0}};
  EXPECT_EQ(complaint(), "");
  spec.holder = {{60.0, 4000.0, 40.0}};
  EXPECT_EQ(complaint(), "the holder is 4000 mm wide");
  spec.holder.clear();
  spec.shank_diameter = {1200.0};
  EXPECT_EQ(complaint(), "the shank is 1200 mm wide");
  spec.shank_diameter = {};
  spec.diameter = {1200.0};
  EXPECT_EQ(complaint(), "the cutter is 1200 mm wide");
  spec.diameter = {10.0};
  spec.length = {20e3};
  EXPECT_EQ(complaint(), "the tool is 20000 mm long");
}

// Radius 5 less a relief of 0.05 mm, from the flutes to the holder or the gauge point.
TEST(Cutter, Fault2_24_HasAShankAboveFlutesThatAreStated) {
  CutterSpec spec{.diameter = {10.0}, .length = {100.0}, .flute_length = {10.0}};
  const Cutter plain = made(spec);
  ASSERT_TRUE(plain.shank());
  EXPECT_NEAR(plain.shank()->generatrix().distance(4.95, 50.0), 0.0, 1e-12);
  EXPECT_NEAR(plain.shank()->generatrix().distance(0.0, 10.0), 0.0, 1e-12);
  EXPECT_NEAR(plain.shank()->height(), 100.0, 1e-12);
  spec.holder = {{60.0, 40.0, 40.0}};
  EXPECT_NEAR(made(spec).shank()->height(), 40.0, 1e-12);
  spec.shank_diameter = {8.0};
  EXPECT_NEAR(made(spec).shank()->max_radius(), 4.0, 1e-12);

  // 10 mm of flank that leans out by 45 degrees, and in by 26.565.
  CutterSpec taper{.type = CutterType::taper,
                   .diameter = {20.0},
                   .length = {100.0},
                   .flute_length = {10.0},
                   .taper_angle = 45.0_deg};
  EXPECT_NEAR(made(taper).shank()->max_radius(), 19.95, 1e-9);
  taper.taper_angle = {-std::atan(0.5)};
  EXPECT_NEAR(made(taper).shank()->max_radius(), 4.95, 1e-9);

  const CutterSpec whole{.diameter = {10.0}, .length = {100.0}};
  EXPECT_FALSE(made(whole).shank());
  const CutterSpec slot{
      .type = CutterType::t_slot, .diameter = {20.0}, .length = {100.0}, .flute_length = {6.0}};
  EXPECT_FALSE(made(slot).shank());
}

TEST(CutterFile, Fault2_30_HandIsReadAndWritten) {
  const auto read = [](const std::string& hand) {
    auto document =
        TomlDocument::parse("type = \"flat\"\ndiameter = 10\nlength = 80\n" + hand, "tool.toml");
    EXPECT_TRUE(document);
    const CutterSpec spec = read_cutter(document->root());
    return std::pair(spec, has_error(document->finish()));
  };
  EXPECT_EQ(read("").first.hand, CutterHand::right);
  const CutterSpec left = read("hand = \"left\"\n").first;
  EXPECT_EQ(left.hand, CutterHand::left);
  EXPECT_TRUE(read("hand = \"both\"\n").second);
  EXPECT_NE(cutter_text(left).find("hand = \"left\""), std::string::npos);
  EXPECT_EQ(cutter_text(read("").first).find("hand"), std::string::npos);
}

TEST(Outline, WhatIsNoMeridianIsRefused) {
  const auto refused = [](std::vector<GeneratrixSegment> chain, std::string_view why) {
    const auto generatrix = Generatrix::make(std::move(chain));
    ASSERT_FALSE(generatrix) << why;
    EXPECT_NE(generatrix.error().front().message.find(why), std::string::npos)
        << generatrix.error().front().message;
    EXPECT_FALSE(generatrix.error().front().hint.empty());
  };
  refused({}, "without segments");
  refused({line({1, 0}, {1, 5})}, "off the tool axis");
  refused({line({0, 1}, {2, 1}), line({2, 1}, {2, 5})}, "lowest point");
  refused({line({0, 0}, {2, 0}), line({2, 1}, {2, 5})}, "gap");
  refused({line({0, 0}, {2, 0}), line({2, 0}, {2, 0})}, "not above");
  refused({line({0, 0}, {2, 0}), line({2, 0}, {0, 2}), line({0, 2}, {2, 4})}, "axis");
  refused({line({0, 0}, {2, 0}), line({2, 0}, {2, 4}), line({2, 4}, {3, 2}), line({3, 2}, {3, 6})},
          "falls");
  refused({line({0, 3}, {2, 0}), line({2, 0}, {0.2, 1}), line({0.2, 1}, {0.2, 4})}, "crosses");
  refused({line({0, 0}, {4, 0}), line({4, 0}, {2, 0}), line({2, 0}, {2, 4})}, "runs back");
  refused({line({0, 0}, {NAN, 0}), line({2, 0}, {2, 4})}, "not a number");
  refused({arc({0, 0}, {0.5, 4}, {0, 2}, false)}, "off its circle");
  refused({arc({0, 0}, {2, 2}, {0, 2}, false)}, "half a turn");
}

TEST(Cutter, ValuesThatMakeNoToolAreNamed) {
  const auto refused = [](CutterSpec spec, std::string_view why) {
    const auto cutter = Cutter::make(spec);
    ASSERT_FALSE(cutter) << why;
    EXPECT_NE(cutter.error().front().message.find(why), std::string::npos)
        << cutter.error().front().message;
    EXPECT_FALSE(cutter.error().front().hint.empty()) << why;
  };
  const auto all = specimens();
  const auto with = [&](std::size_t i, auto member, auto value) {
    CutterSpec spec = all[i];
    spec.*member = value;
    return spec;
  };
  refused(with(0, &CutterSpec::diameter, Mm{0.0}), "diameter");
  refused(with(0, &CutterSpec::diameter, Mm{NAN}), "diameter");
  refused(with(0, &CutterSpec::length, Mm{20.0}), "flute length");
  refused(with(0, &CutterSpec::radius_error, Mm{-6.0}), "radius error");
  refused(with(0, &CutterSpec::run_out, Mm{-0.1}), "run_out");
  refused(with(1, &CutterSpec::end_angle, Rad{1.2}), "end_angle");
  refused(with(2, &CutterSpec::flute_length, Mm{4.0}), "flute length");
  refused(with(3, &CutterSpec::corner_radius, Mm{9.0}), "corner radius");
  refused(with(5, &CutterSpec::taper_angle, Rad{1.6}), "taper_angle");
  refused(with(5, &CutterSpec::taper_angle, Rad{-0.5}), "taper_angle");
  refused(with(7, &CutterSpec::tip_angle, Rad{3.2}), "tip_angle");
  refused(with(8, &CutterSpec::tip_diameter, Mm{11.0}), "tip diameter");
  refused(with(9, &CutterSpec::neck_diameter, Mm{9.0}), "neck diameter");
  refused(with(10, &CutterSpec::corner_radius, Mm{5.0}), "corner radius");
  refused(with(11, &CutterSpec::taper_angle, Rad{1.0}), "taper_angle");
  refused(with(12, &CutterSpec::flank_radius, Mm{5.0}), "flank radius");
  refused(with(13, &CutterSpec::end_radius, Mm{5.0}), "end radius");
  refused(with(14, &CutterSpec::arc_offset, Mm{20.0}), "corner circle");
  refused(with(15, &CutterSpec::rows, std::vector<CutterRow>{{0, 0, 0}}), "two points");
  refused(with(16, &CutterSpec::rows, std::vector<CutterRow>{{1, 2, 0}, {0, 3, 0}}), "height");
  refused(with(0, &CutterSpec::holder, std::vector<CutterRow>{{80, 20, 20}}), "holder");
  refused(with(0, &CutterSpec::holder, std::vector<CutterRow>{{10, 0, 20}}), "holder row");
}

TEST(ToolLibrary, MistakesAreReportedWithTheirKeys) {
  const auto document = TomlDocument::parse(
      "[tool.1]\ntype = \"bal\"\n[tool.2]\ntype = \"bull\"\ndiameter = 8\nlength = 50\n"
      "corner_radios = 1\n[tool.x]\n[tool.03]\ntype = \"flat\"\ndiameter = -2\nlength = 9\n"
      "[tool.3]\ntype = \"flat\"\ndiameter = 2\nlength = 9\n",
      "library.toml");
  ASSERT_TRUE(document);
  static_cast<void>(read_tools(document->root().table("tool")));
  std::string all;
  for (const Diagnostic& d : document->finish()) all += to_string(d) + "\n";
  for (const char* part : {"bal", "tool.2.corner_radius", "did you mean corner_radius", "tool.x",
                           "must be greater than 0", "described twice"}) {
    EXPECT_NE(all.find(part), std::string::npos) << part << " in\n" << all;
  }
}

TEST(ToolLibrary, NamesThatDifferByCapitalsAloneAreTheSame) {
  const auto complaints = [](std::string_view text, ToolList base = {}) {
    const auto document = TomlDocument::parse(text, "job.toml");
    static_cast<void>(read_tools(document->root().table("tool"), std::move(base)));
    std::string all;
    for (const Diagnostic& d : document->finish()) all += to_string(d) + "\n";
    return all;
  };
  const std::string mill = "type = \"flat\", diameter = 2, length = 9";
  const std::string twice = complaints("tool.1 = { name = \"Mill 8\", " + mill +
                                       " }\ntool.4 = { name = \"MILL 8\", " + mill + " }\n");
  EXPECT_NE(twice.find("tool.4.name"), std::string::npos) << twice;
  EXPECT_NE(twice.find("tool.1 has the name \"Mill 8\" too"), std::string::npos) << twice;
  CutterSpec drill;
  drill.name = "drill";
  const ToolList library{{4, drill}, {5, drill}};  // remarks may be the same
  EXPECT_EQ(complaints("tool.1 = { name = \"Mill 8\", " + mill + " }\n", library), "");
  EXPECT_NE(
      complaints("tool.1 = { name = \"DRILL\", " + mill + " }\n", library).find("tool.1.name"),
      std::string::npos);
}

TEST(ToolLibrary, AJobChangesSingleValues) {
  ToolList base{{4, specimens()[3]}};
  const auto document = TomlDocument::parse(
      "tool.4 = { radius_error = \"-5 um\", length = 120 }\ntool.9 = { length = 50 }\n",
      "job.toml");
  const ToolList tools = read_tools(document->root().table("tool"), base);
  EXPECT_EQ(tools.at(4).corner_radius.value, 3.0);
  EXPECT_EQ(tools.at(4).length.value, 120.0);
  EXPECT_NEAR(tools.at(4).radius_error.value, -0.005, 1e-15);
  ASSERT_EQ(document->finish().size(), 1U);
  EXPECT_NE(document->finish().front().message.find("no tool 9"), std::string::npos);
}

TEST(ToolTable, ReadsWordsInAnyOrderAndRemarks) {
  const auto tools = read_tool_table(
      ";\nT1 P1 D12.5 Z+100.25 ;roughing; end mill\r\n\n  t2 p2 z80 D6\nT99 P7 Z50 ; probe\n",
      "t.tbl");
  ASSERT_TRUE(tools);
  ASSERT_EQ(tools->size(), 2U);
  EXPECT_EQ(tools->at(1).diameter.value, 12.5);
  EXPECT_EQ(tools->at(1).length.value, 100.25);
  EXPECT_EQ(tools->at(1).name, "roughing; end mill");
  EXPECT_EQ(tools->at(2).length.value, 80.0);
  EXPECT_EQ(tools->at(2).type, CutterType::flat);
}

TEST(ToolTable, BadLinesAreNamed) {
  const auto refused = [](std::string_view text, int line, std::string_view why) {
    const auto tools = read_tool_table(text, "t.tbl");
    ASSERT_FALSE(tools) << text;
    EXPECT_EQ(tools.error().front().line, line);
    EXPECT_NE(tools.error().front().message.find(why), std::string::npos)
        << tools.error().front().message;
  };
  refused("T1 P1 D12 Z9\nT1 P2 D3 Z9\n", 2, "twice");
  refused("T1 D12 D13 Z9\n", 1, "twice on the line");
  refused("P1 D12 Z9\n", 1, "tool number");
  refused("T1.5 D12 Z9\n", 1, "tool number");
  refused("T1 D Z9\n", 1, "no number");
  refused("T1 D1 end mill\n", 1, "no word");
  refused("T1 Dnan Z9\n", 1, "no number");
  refused("; nothing\n", 0, "no tool");
}

}  // namespace
}  // namespace frustum::cutter
