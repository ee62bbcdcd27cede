// What goes in and out of the metrology commands: point files, meshes, units, result files.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class ExchangeSystem : public CommandLine {
 protected:
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }

  static constexpr double kRadius = 20.0;

  // Points on a tube of radius 20 along Z, every number divided by `unit`.
  static std::string tube_points(double unit = 1.0, const char* header = "") {
    std::string text = header;
    for (int i = 0; i < 72; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / 24.0;
      text += fmt::format("{:.17g},{:.17g},{:.17g}\n", kRadius * std::cos(turn) / unit,
                          kRadius * std::sin(turn) / unit, (5.0 + 10.0 * (i / 24)) / unit);
    }
    return text;
  }

  // A scan of the tube: facets without lids, so its borders are open.
  static std::string tube_scan(double unit = 1.0, double rounding = 0.0) {
    constexpr int kSteps = 720;
    std::string text = "solid tube\n";
    int corners_written = 0;
    const auto corner = [&](int step, double z) {
      const double turn = 2.0 * std::numbers::pi * (step % kSteps) / kSteps;
      const double off = rounding * ((7 * corners_written++) % 11 - 5) / 5.0;
      return fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", kRadius * std::cos(turn) / unit + off,
                         kRadius * std::sin(turn) / unit - off, z / unit);
    };
    const auto facet = [&](const std::string& corners) {
      text += "facet normal 0 0 0\nouter loop\n" + corners + "endloop\nendfacet\n";
    };
    for (int k = 0; k < kSteps; ++k) {
      facet(corner(k, 0) + corner(k + 1, 0) + corner(k + 1, 30));
      facet(corner(k, 0) + corner(k + 1, 30) + corner(k, 30));
    }
    return text + "endsolid tube\n";
  }

  void write_plan(const std::string& tolerance = "10 um") const {
    write("tube.plan.toml", R"(title = "Tube"
alignment = "plan"
[probe]
ball_diameter = 2
clearance = 2
reach = 2
[[feature]]
name = "tube"
kind = "cylinder"
point = [0, 0, 5]
axis = [0, 0, 1]
radius = 20
side = "outside"
strategy = { sections = [0, 10, 20], points_per_section = 24 }
[[characteristic]]
name = "tube.diameter"
kind = "diameter"
feature = "tube"
tolerance = ")" + tolerance + R"("
[[characteristic]]
name = "tube.form"
kind = "cylindricity"
feature = "tube"
tolerance = "2 um"
)");
  }
};

TEST_F(ExchangeSystem, FitsAnElementAndSaysAllAboutIt) {
  write("p.csv", tube_points());
  const Outcome outcome = run("fit cylinder p.csv --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json doc = json::parse(outcome.out);
  EXPECT_EQ(doc["element"], "cylinder");
  EXPECT_EQ(doc["criterion"], "ls");
  EXPECT_NEAR(doc["parameters"]["radius"].get<double>(), kRadius, 1e-12);
  EXPECT_LT(doc["form"].get<double>(), 1e-12);
  EXPECT_EQ(doc["residuals"].size(), 72U);
  EXPECT_EQ(doc["covariance"].size(), 5U);
  EXPECT_TRUE(doc.contains("iterations"));
  const Outcome text = run("fit cylinder p.csv");
  EXPECT_NE(text.out.find("cylinder by least squares, 72 points"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("radius      20.000000000 mm"), std::string::npos) << text.out;
  EXPECT_NE(run("fit --help").out.find("Example: frustum fit"), std::string::npos);
}

TEST_F(ExchangeSystem, Fault2_60_FailuresAreJsonToo) {
  write_plan();
  write("p.csv", tube_points());
  write("bad.csv", "1 2 3\n4 nan 6\n");
  for (const std::string command :
       {"measure --plan tube.plan.toml --points bad.csv --json", "fit cylinder bad.csv --json",
        "measure --plan none.toml --points p.csv --json", "fit torus p.csv --unit ell --json",
        "measure none.toml --json", "measure none.toml --unit mm --json", "run none.toml --json"}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.exit_code, 2) << command;
    const json doc = json::parse(outcome.out, nullptr, false);
    ASSERT_FALSE(doc.is_discarded()) << command << outcome.out;
    EXPECT_EQ(doc["status"], "error") << command;
    EXPECT_EQ(doc["diagnostics"][0]["severity"], "error") << command;
    EXPECT_FALSE(outcome.err.empty()) << command;
  }
  const json doc = json::parse(run("fit cylinder bad.csv --json").out);
  EXPECT_EQ(doc["diagnostics"][0]["line"], 2);
  EXPECT_EQ(doc["diagnostics"][0]["column"], 3);
}

TEST_F(ExchangeSystem, Fault2_60_SectionsThatThePlanLacksAreRefused) {
  write_plan();
  std::string points = "feature,section,x,y,z\n";
  for (int i = 0; i < 24; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / 24.0;
    points += fmt::format("tube,{},{:.17g},{:.17g},{}\n", i < 12 ? 0 : 3, kRadius * std::cos(turn),
                          kRadius * std::sin(turn), i < 12 ? 5 : 35);
  }
  write("p.csv", points);
  expect_refusal("measure --plan tube.plan.toml --points p.csv",
                 {"p.csv:14: error", "'tube' has 3 sections in the plan, there is no section 3"});
}

TEST_F(ExchangeSystem, FitsInTheUnitOfTheFile) {
  write("inch.csv", tube_points(25.4, "x [inch],y [inch],z [inch]\n"));
  write("bare.csv", tube_points(25.4));
  for (const char* arguments :
       {"fit cylinder inch.csv --json", "fit cylinder bare.csv --unit in --json"}) {
    const Outcome outcome = run(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NEAR(json::parse(outcome.out)["parameters"]["radius"].get<double>(), kRadius, 1e-12);
  }
}

TEST_F(ExchangeSystem, RefusesFitsThatCannotBe) {
  write("p.csv", tube_points());
  write("nan.csv", "1 2 3\n4 nan 6\n");
  write("two.csv", "1 2 3\n4 5 6\n");
  write("cut.ply",
        "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\n"
        "property float z\nend_header\n1 2 3\n");
  expect_refusal("fit cylinder nan.csv", {"nan.csv:2:3", "'nan' is not a finite number"});
  expect_refusal("fit plane two.csv", {"two.csv", "too few points"});
  expect_refusal("fit plane cut.ply", {"cut.ply", "ends within vertex 2 of 9"});
  expect_refusal("fit cylinder p.csv --axis 0,0,0", {"--axis 0,0,0", "not a direction"});
  expect_refusal("fit cylinder p.csv --perpendicular-to 1,2", {"--perpendicular-to"});
  expect_refusal("fit cylinder p.csv --unit furlong", {"--unit furlong", "inch"});
  expect_refusal("fit cylinder p.csv --radius nan", {"--radius"});
  expect_refusal("fit cylinder p.csv --criterion best", {"--criterion", "mz"});
  expect_refusal("fit pyramid p.csv", {"torus"});
}

TEST_F(ExchangeSystem, WritesResultsInEveryFormatThatIsAskedFor) {
  write_plan();
  write("p.csv", tube_points());
  const Outcome outcome = run(
      "measure --plan tube.plan.toml --points p.csv --quiet --export t.qif --export t.csv --export "
      "t.junit.xml --export t.dfq --export t.JSON");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(read(folder_ / "t.qif").find("<CylinderFeatureMeasurement"), std::string::npos);
  EXPECT_NE(read(folder_ / "t.csv").find("\ntube.diameter,diameter,tube,"), std::string::npos);
  EXPECT_NE(read(folder_ / "t.junit.xml").find("tests=\"2\" failures=\"0\""), std::string::npos);
  EXPECT_EQ(read(folder_ / "t.dfq").rfind("K0100 2\n", 0), 0U);
  EXPECT_EQ(json::parse(read(folder_ / "t.JSON"))["status"], "pass");
}

TEST_F(ExchangeSystem, RefusesResultFilesBeforeTheWork) {
  write_plan();
  write("p.csv", tube_points());
  const std::string measure = "measure --plan tube.plan.toml --points p.csv --export ";
  expect_refusal(measure + "t.pdf --export ok.csv", {"t.pdf", "known: .qif .csv .json .xml .dfq"});
  expect_refusal(measure + "p.csv/t.qif", {"p.csv/t.qif", "p.csv is not a folder"});
  EXPECT_FALSE(fs::exists(folder_ / "ok.csv"));
  // A job names the key.
  const Outcome made = run("program cone --machine iwf-bc --out piece --chord-tolerance 1");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  replace_in("piece/job.toml", "report = true",
             "report = false\nexport = [\"x/a.qif\", \"b.doc\"]");
  expect_refusal("run piece/job.toml --out result", {"job.toml:", "output.export", "b.doc"});
  EXPECT_FALSE(fs::exists(folder_ / "result"));
  replace_in("piece/job.toml", "b.doc", "b.junit.xml");
  EXPECT_NE(run("run piece/job.toml --out result --quiet").exit_code, 2);
  EXPECT_TRUE(fs::exists(folder_ / "piece/x/a.qif"));
  EXPECT_TRUE(fs::exists(folder_ / "piece/b.junit.xml"));
}

TEST_F(ExchangeSystem, TellsCiOfMeasurementsThatCouldNotBeMade) {
  write_plan();
  write("p.csv", "1,2,3\n4,5,6\n");
  const Outcome outcome =
      run("measure --plan tube.plan.toml --points p.csv --export t.xml --export t.qif");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(read(folder_ / "t.xml").find("tests=\"2\" failures=\"0\" errors=\"2\""),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "t.qif"));
}

TEST_F(ExchangeSystem, MeasuresAScanLikeAPart) {
  write_plan();
  write("tube.stl", tube_scan());
  const Outcome outcome = run("measure --plan tube.plan.toml --mesh tube.stl --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json doc = json::parse(outcome.out);
  // 720 facets leave the tube by 0.19 um.
  EXPECT_NEAR(doc["characteristics"][0]["value"].get<double>(), 2.0 * kRadius, 5e-4);
  EXPECT_LT(doc["characteristics"][1]["value"].get<double>(), 0.25);
}

TEST_F(ExchangeSystem, DoesNotDecideOnAScanOfAnUnknownMachine) {
  write_plan();
  replace_in("tube.plan.toml", "title", "decision = \"iso14253\"\ntitle");
  write("tube.stl", tube_scan());
  const std::string mesh = "measure --plan tube.plan.toml --mesh tube.stl ";
  const json bare = json::parse(run(mesh + "--json --export t.qif").out);
  EXPECT_EQ(bare["status"], "uncertain");
  EXPECT_EQ(bare["characteristics"][0]["coverage"], "not stated");
  EXPECT_EQ(bare["evidence"]["measuring"]["accuracy"],
            "not stated: the mesh counts as the part, and every U is 0");
  EXPECT_NE(read(folder_ / "t.qif").find("<InspectionStatusEnum>UNKNOWN<"), std::string::npos);
  const json stated = json::parse(run(mesh + "--json --e0 '0.1 um' --l-per-um 3000").out);
  EXPECT_EQ(stated["status"], "pass");
}

TEST_F(ExchangeSystem, MeasuresAScanWhoseSeamsAreRounded) {
  write_plan();
  write("tube.stl", tube_scan());
  const Outcome whole = run("measure --plan tube.plan.toml --mesh tube.stl --json");
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  // Every facet has its corners a little elsewhere; the points are on seams.
  for (const double rounding : {3.6e-15, 1e-12, 1e-9}) {
    write("loose.stl", tube_scan(1.0, rounding));
    const Outcome loose = run("measure --plan tube.plan.toml --mesh loose.stl --json");
    ASSERT_EQ(loose.exit_code, 0) << rounding << loose.err;
    for (const int i : {0, 1}) {
      EXPECT_NEAR(json::parse(loose.out)["characteristics"][i]["value"].get<double>(),
                  json::parse(whole.out)["characteristics"][i]["value"].get<double>(), 1e-5);
    }
  }
}

TEST_F(ExchangeSystem, SaysThatAMeshIsInsideOut) {
  write_plan();
  std::string text = tube_scan();
  // Each facet's first corner comes last but one.
  std::string turned;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    const std::string line = text.substr(at, end - at);
    if (line.starts_with("vertex") && turned.ends_with("outer loop\n")) {
      const std::size_t next = text.find('\n', end) + 1;
      turned += text.substr(end, next - end) + line;
      at = next;
    } else {
      turned += line;
      at = end;
    }
  }
  write("tube.stl", turned);
  expect_refusal(
      "measure --plan tube.plan.toml --mesh tube.stl",
      {"tube.stl: error: 72 of the plan's 72 points meet facets of the mesh from behind, "
       "first of all feature 'tube' at [20.000, 0.000, 5.000]",
       "the mesh is inside out"});
}

TEST_F(ExchangeSystem, StatesTheAccuracyOfTheMachineThatMeasured) {
  write_plan();
  write("p.csv", tube_points());
  const std::string points = "measure --plan tube.plan.toml --points p.csv --json ";
  const auto uncertainty = [&](const std::string& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_NE(outcome.exit_code, 2) << outcome.err;
    return json::parse(outcome.out)["characteristics"][0]["expanded_uncertainty"].get<double>();
  };
  const Outcome bare = run(points);
  EXPECT_NE(bare.out.find("nothing is known of the machine that measured:"), std::string::npos)
      << bare.out;
  EXPECT_EQ(uncertainty(points), 0.0);
  const double stated = uncertainty(points + "--e0 '2 um' --l-per-um 300");
  EXPECT_GT(stated, 1e-5);
  EXPECT_EQ(run(points + "--e0 '2 um'").out.find("nothing is known"), std::string::npos);
  write("cmm.toml", "e0 = \"2 um\"\nl_per_um = 300\n");
  EXPECT_EQ(uncertainty(points + "--cmm cmm.toml"), stated);
  const Outcome made = run("program cone --machine iwf-bc --out piece");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string job = read(folder_ / "piece/job.toml");
  const auto line = job.find("cmm  = {");
  ASSERT_NE(line, std::string::npos);
  replace_in("piece/job.toml", job.substr(line, job.find('\n', line) - line),
             "cmm = { e0 = \"2 um\", l_per_um = 300 }");
  EXPECT_EQ(uncertainty(points + "--cmm piece/job.toml"), stated);
  // The same machine probes a mesh: with its errors, not only with its uncertainties.
  write("tube.stl", tube_scan());
  const std::string mesh = "measure --plan tube.plan.toml --mesh tube.stl --json ";
  EXPECT_EQ(uncertainty(mesh), 0.0);
  EXPECT_GT(uncertainty(mesh + "--cmm cmm.toml"), 1e-5);
  const auto form = [&](const std::string& arguments) {
    return json::parse(run(arguments).out)["characteristics"][1]["value"].get<double>();
  };
  EXPECT_LT(form(mesh), 0.25);
  EXPECT_GT(form(mesh + "--cmm cmm.toml"), 1.0);
  // No conformity is proven by an uncertainty of nothing.
  const Outcome simple = run(points);
  EXPECT_EQ(simple.exit_code, 0) << simple.out;
  EXPECT_EQ(json::parse(simple.out)["characteristics"][0]["coverage"], "not stated");
  replace_in("tube.plan.toml", "title", "decision = \"iso14253\"\ntitle");
  const Outcome unknown = run(points);
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_EQ(json::parse(unknown.out)["status"], "uncertain");
  EXPECT_NE(unknown.out.find("calls all characteristics uncertain: no accuracy is stated"),
            std::string::npos);
  EXPECT_EQ(run(points + "--e0 '2 um'").out.find("no accuracy is stated"), std::string::npos);
}

TEST_F(ExchangeSystem, SaysWhichTermOfTheAccuracyIsMissing) {
  write_plan();
  write("p.csv", tube_points());
  const std::string points = "measure --plan tube.plan.toml --points p.csv ";
  const std::string length = "grow with length (l_per_um)", point = "of a single point (e0)";
  for (const auto& [arguments, lacks_length, lacks_point] :
       {std::tuple{"--e0 2um", true, false},
        {"--l-per-um 300", false, true},
        {"--e0 2um --l-per-um 300", false, false}}) {
    // The points are perfect: a remark, and nothing else.
    const json doc = json::parse(run(points + arguments + " --json").out);
    const std::string text = doc["diagnostics"].dump();
    EXPECT_EQ(text.find(length) != std::string::npos, lacks_length) << text;
    EXPECT_EQ(text.find(point) != std::string::npos, lacks_point) << text;
  }
  EXPECT_EQ(run(points + "--l-per-um 300 --e0 '0.0001 inch' --quiet").exit_code, 0);
}

TEST_F(ExchangeSystem, PointsOfARealCmmHaveNoMachineTool) {
  write_plan();
  replace_in("tube.plan.toml", "title = \"Tube\"\n", "");
  write("p.csv", tube_points());
  const std::string points = "measure --plan tube.plan.toml --points p.csv ";
  const Outcome shown = run(points);
  EXPECT_TRUE(shown.out.starts_with("p.csv ")) << shown.out;
  EXPECT_EQ(shown.out.find("Errors"), std::string::npos) << shown.out;
  EXPECT_EQ(json::parse(run(points + "--json").out)["title"], "p.csv");
}

TEST_F(ExchangeSystem, DistancesOfJoinedCornersHaveNoExponent) {
  write_plan();
  // Far off, and large: two corners 0.9 mm apart are within the seam, 1e-9 of the size.
  std::string scan = tube_scan();
  scan.insert(scan.find("endsolid"),
              "facet normal 0 0 0\nouter loop\nvertex 1e9 0 0\nvertex 1e9 1e7 0\nvertex 1e9 0 1e7\n"
              "endloop\nendfacet\n"
              "facet normal 0 0 0\nouter loop\nvertex 1e9 0 0.9\nvertex 1e9 -1e7 0\nvertex 1e9 0 "
              "-1e7\nendloop\nendfacet\n");
  write("tube.stl", scan);
  const Outcome measured = run("measure --plan tube.plan.toml --mesh tube.stl --json");
  EXPECT_NE(measured.out.find("others 900 um away"), std::string::npos) << measured.out;
}

TEST_F(ExchangeSystem, RefusesAccuraciesThatCannotBe) {
  write_plan();
  write("p.csv", tube_points());
  write("cmm.toml", "e0 = \"2 um\"\nl_per_mm = 300\n");
  const std::string points = "measure --plan tube.plan.toml --points p.csv ";
  expect_refusal(points + "--e0 2urad", {"2urad"});
  expect_refusal(points + "--e0=-1um", {"--e0 -1um", "0 or more"});
  expect_refusal(points + "--l-per-um 0", {"--l-per-um"});
  expect_refusal(points + "--cmm cmm.toml", {"cmm.toml:2:1", "l_per_um"});
  expect_refusal(points + "--cmm none.toml", {"none.toml"});
  expect_refusal(points + "--cmm cmm.toml --e0 2um", {"--cmm together with --e0"});
  write("job.toml", "[inspection]\nplan = \"tube.plan.toml\"\n");
  expect_refusal(points + "--cmm job.toml", {"job.toml: error: inspection.cmm", "states no CMM"});
  expect_refusal("measure job.toml --e0 2um", {"go with --points or --mesh"});
}

TEST_F(ExchangeSystem, NamesFileLineAndFeatureOfPointsThatThePlanDoesNotKnow) {
  write_plan();
  write("p.csv", "feature,x,y,z\n\ntub,20,0,5\n");
  expect_refusal(
      "measure --plan tube.plan.toml --points p.csv",
      {"p.csv:3: error: the plan has no feature 'tub'", "did you mean tube? the plan has tube"});
  fs::create_directories(folder_ / "points");
  expect_refusal("measure --plan tube.plan.toml --points points", {"points: error", "a directory"});
  expect_refusal("fit plane points", {"points: error", "a directory"});
  expect_refusal("measure --plan tube.plan.toml --mesh points.stl", {"points.stl"});
  write("inch.csv", tube_points(25.4, "x [inch],y [inch],z [inch]\n"));
  expect_refusal("fit cylinder inch.csv --unit mm", {"inch.csv:1:1", "states the unit inch", "mm"});
  EXPECT_EQ(run("fit cylinder inch.csv --unit in").exit_code, 0);
}

TEST_F(ExchangeSystem, FindsOutUnitsThatNobodyStated) {
  write_plan();
  write("inch.csv", tube_points(25.4));
  write("metre.csv", tube_points(1000.0));
  write("inch.stl", tube_scan(25.4));
  const std::string measure = "measure --plan tube.plan.toml ";
  expect_refusal(measure + "--points inch.csv", {"inch.csv", "look like inch", "--unit inch"});
  expect_refusal(measure + "--points metre.csv", {"metre.csv", "look like m "});
  expect_refusal(measure + "--mesh inch.stl", {"inch.stl", "look like inch"});
  EXPECT_EQ(run(measure + "--points inch.csv --unit inch").exit_code, 0);
  EXPECT_EQ(run(measure + "--mesh inch.stl --unit inch").exit_code, 0);
  expect_refusal(measure + "--mesh inch.stl --points inch.csv", {"--mesh SCAN.stl"});
  expect_refusal(measure + "--mesh none.stl", {"none.stl"});
}

}  // namespace
}  // namespace frustum
