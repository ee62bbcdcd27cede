// Drawings for CAD: DXF of tools and of measured sections, SVG of tools. What is written is read
// again, by a reader of the format's groups here, and by ezdxf where Python has it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cutter/body/cutter.hpp"
#include "report/exchange/charts_svg.hpp"
#include "report/exchange/dxf_drawing.hpp"
#include "report/exchange/sections_dxf.hpp"
#include "report/exchange/tool_drawing.hpp"
#include "sample_report.hpp"

namespace frustum::report {
namespace {

using testing::HasSubstr;

// One entity: its type, and its groups by code (the last of each).
struct Entity {
  std::string type{};
  std::map<int, std::string> groups{};
  [[nodiscard]] double number(int code) const { return std::stod(groups.at(code)); }
};

std::vector<Entity> entities_of(const std::string& file) {
  std::vector<Entity> entities;
  std::istringstream lines(file);
  std::string code, value;
  bool within = false;
  while (std::getline(lines, code) && std::getline(lines, value)) {
    if (std::stoi(code) == 2 && value == "ENTITIES") within = true;
    if (!within) continue;
    if (std::stoi(code) == 0) {
      entities.push_back({value, {}});
    } else if (!entities.empty()) {
      entities.back().groups[std::stoi(code)] = value;
    }
  }
  return entities;
}

std::size_t count_of(const std::vector<Entity>& entities, const std::string& type,
                     const std::string& layer) {
  std::size_t count = 0;
  for (const Entity& e : entities) {
    count += e.type == type && e.groups.contains(8) && e.groups.at(8) == layer;
  }
  return count;
}

cutter::Cutter tool_of(cutter::CutterType type, double corner = 0.0) {
  cutter::CutterSpec spec;
  spec.type = type;
  spec.diameter = Mm{12.0};
  spec.length = Mm{60.0};
  spec.flute_length = Mm{25.0};
  spec.corner_radius = Mm{corner};
  spec.holder = {{20.0, 30.0, 40.0}};
  auto tool = cutter::Cutter::make(spec);
  EXPECT_TRUE(tool);
  return *std::move(tool);
}

TEST(ToolDrawing, HasTheArcsOfABullNose) {
  const auto entities = entities_of(tool_dxf(tool_of(cutter::CutterType::bull, 2.0)));
  ASSERT_EQ(count_of(entities, "ARC", "CUTTER"), 2U) << "one on each side";
  EXPECT_EQ(count_of(entities, "LINE", "AXIS"), 1U);
  EXPECT_GT(count_of(entities, "LINE", "SHANK"), 0U);
  EXPECT_GT(count_of(entities, "LINE", "HOLDER"), 0U);
  std::vector<Entity> arcs;
  for (const Entity& e : entities) {
    if (e.type == "ARC") arcs.push_back(e);
  }
  // By hand: centre 2 above the tip, 4 from the axis; from straight down to straight outwards.
  EXPECT_NEAR(arcs[0].number(10), 4.0, 1e-12);
  EXPECT_NEAR(arcs[0].number(20), 2.0, 1e-12);
  EXPECT_NEAR(arcs[0].number(40), 2.0, 1e-12);
  EXPECT_NEAR(std::remainder(arcs[0].number(50) - 270.0, 360.0), 0.0, 1e-9);
  EXPECT_NEAR(std::remainder(arcs[0].number(51), 360.0), 0.0, 1e-9);
  EXPECT_NEAR(arcs[1].number(10), -4.0, 1e-12);
  EXPECT_NEAR(std::remainder(arcs[1].number(50) - 180.0, 360.0), 0.0, 1e-9);
  EXPECT_NEAR(std::remainder(arcs[1].number(51) - 270.0, 360.0), 0.0, 1e-9);
}

TEST(ToolDrawing, IsInTrueSizeInSvg) {
  const std::string svg = tool_svg(tool_of(cutter::CutterType::ball), "Ball <12>");
  EXPECT_THAT(svg, HasSubstr("<title>Ball &lt;12&gt;</title>"));
  EXPECT_THAT(svg, HasSubstr("A6 6 0 0 0 6 -6")) << "from the tip at the origin to the side";
  EXPECT_THAT(svg, HasSubstr("A6 6 0 0 1 -6 -6"));
  EXPECT_THAT(svg, HasSubstr("height=\"64mm\""));
}

TEST(SectionsDxf, HasThePointsOfEachFeatureAndItsSections) {
  const RunReport report = sample_report();
  const auto entities = entities_of(sections_dxf(report.measurement));
  for (const auto& feature : report.measurement.features) {
    EXPECT_EQ(count_of(entities, "POINT", feature.name), feature.points.size());
    EXPECT_EQ(count_of(entities, "POLYLINE", feature.name + "_SECTION"), 1U);
    EXPECT_EQ(count_of(entities, "VERTEX", feature.name + "_SECTION"), feature.points.size());
  }
  const Vec3& first = report.measurement.features.front().points.front().point;
  for (const Entity& e : entities) {
    if (e.type == "POLYLINE") {
      EXPECT_EQ(e.groups.at(70), "9") << "closed, in space";
    }
    if (e.type != "POINT") continue;
    EXPECT_EQ(e.number(10), first.x());
    EXPECT_EQ(e.number(20), first.y());
    EXPECT_EQ(e.number(30), first.z());
    break;
  }
}

TEST(DxfDrawing, PutsNamesIntoTheCharactersOfLayers) {
  EXPECT_EQ(DxfDrawing::layer_name("1-a.dL µ"), "1-a_dL___");
  EXPECT_EQ(DxfDrawing::layer_name(""), "0");
  EXPECT_EQ(DxfDrawing::layer_name(std::string(40, 'x')).size(), 31U);
}

TEST(ChartsSvg, HasEachChartOnceAndNeedsNoPage) {
  const std::string svg = charts_svg(sample_report());
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg.c_str()));
  std::vector<std::string> names;
  double bottom = 0.0;
  for (const pugi::xml_node each : document.child("svg")) {
    if (std::string(each.attribute("class").value()) == "name") names.push_back(each.text().get());
    if (std::string(each.name()) != "svg") continue;
    EXPECT_GE(each.attribute("y").as_double(), bottom) << "one below the other";
    bottom = each.attribute("y").as_double() + each.attribute("height").as_double();
    EXPECT_TRUE(each.child("path"));
  }
  EXPECT_THAT(names, testing::ElementsAre("cone.equivalent_form", "cylinder.roundness"));
  EXPECT_LE(bottom, document.child("svg").attribute("height").as_double());
  EXPECT_THAT(svg, testing::Not(HasSubstr("var(")));
  EXPECT_THAT(charts_svg({}), HasSubstr("no charts of forms or lines"));
}

// ezdxf's own audit, and what it finds of a bull nose.
TEST(DxfReference, IsReadByEzdxf) {
  namespace fs = std::filesystem;
  if (std::system("/usr/bin/python3 -c 'import ezdxf' 2>/dev/null") != 0) {
    GTEST_SKIP() << "no ezdxf for Debian's Python (package python3-ezdxf)";
  }
  const fs::path folder = fs::path(testing::TempDir()) / "frustum_dxf";
  fs::create_directories(folder);
  std::ofstream(folder / "tool.dxf") << tool_dxf(tool_of(cutter::CutterType::bull, 2.0));
  std::ofstream(folder / "sections.dxf") << sections_dxf(sample_report().measurement);
  std::ofstream(folder / "read.py") << R"(import ezdxf, sys
for name in ('tool.dxf', 'sections.dxf'):
    doc = ezdxf.readfile(name)
    audit = doc.audit()
    assert not audit.errors, audit.errors
tool = ezdxf.readfile('tool.dxf').modelspace()
arcs = tool.query('ARC')
assert len(arcs) == 2 and abs(arcs[0].dxf.radius - 2.0) < 1e-12
ends = sorted((round(p.x, 9), round(p.y, 9)) for a in arcs for p in (a.start_point, a.end_point))
assert ends == [(-6.0, 2.0), (-4.0, 0.0), (4.0, 0.0), (6.0, 2.0)], ends
lines = ezdxf.readfile('sections.dxf').modelspace().query('POLYLINE')
assert len(lines) == 2 and all(p.is_closed and len(p) == 360 for p in lines)
)";
  EXPECT_EQ(std::system(("cd '" + folder.string() + "' && /usr/bin/python3 read.py").c_str()), 0);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace frustum::report
