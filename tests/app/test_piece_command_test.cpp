// frustum program s-piece and surface, compare: from the command line.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

class TestPieceSystem : public CommandLine {
 protected:
  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
};

TEST_F(TestPieceSystem, TheSPieceSpeaksFourDialectsAndAxisPositions) {
  const struct {
    const char* options;
    const char* file;
  } forms[] = {{"--dialect fanuc", "s-piece.nc"},
               {"--dialect linuxcnc", "s-piece.ngc"},
               {"--dialect sinumerik", "s-piece.mpf"},
               {"--dialect heidenhain", "s-piece.h"},
               {"--form axes", "s-piece.nc"}};
  json first;
  for (const auto& form : forms) {
    const Outcome made =
        run(std::string("program s-piece --machine iwf-bc --blocks 200 --out s ") + form.options);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_TRUE(fs::exists(folder_ / "s" / form.file)) << form.options;
    replace_in("s/job.toml", "report = true", "report = false");
    const Outcome ran = run("run s/job.toml --json --out o");
    ASSERT_EQ(ran.exit_code, 0) << form.options << ran.err;
    const json result = json::parse(ran.out);
    if (first.is_null()) first = result;
    for (std::size_t f = 0; f < 2; ++f) {
      const json &one = first["features"][f]["deviations_um"],
                 &other = result["features"][f]["deviations_um"];
      ASSERT_EQ(one.size(), 147u);
      EXPECT_EQ(result["features"][f]["kind"], "ruled");
      EXPECT_EQ(result["features"][f]["geometric_um"].size(), 147u);
      for (std::size_t i = 0; i < one.size(); ++i) {
        // Between blocks an axis form goes where a vector form goes.
        EXPECT_NEAR(one[i].get<double>(), other[i].get<double>(), 0.05) << form.options << i;
      }
    }
    fs::remove_all(folder_ / "s");
  }
}

TEST_F(TestPieceSystem, SaysHowFarEachAxisIsBeyondItsTravel) {
  fs::copy(FRUSTUM_SOURCE_DIR "/machines/zx-yac.toml", folder_ / "small.toml");
  replace_in("small.toml", "[-300, 600]", "[200, 600]");
  replace_in("small.toml", "[-350, 350]", "[-40, 40]");
  const Outcome small = run("program cone --machine small.toml --out cone");
  EXPECT_EQ(small.exit_code, 2);
  EXPECT_NE(small.err.find("at its farthest: Z = 97.7534 mm, travel 200 .. 600; Y = -190.1960 mm, "
                           "travel -40 .. 40 (hint: "),
            std::string::npos)
      << small.err;
  EXPECT_NE(small.err.find("--tool-length"), std::string::npos) << small.err;
}

TEST_F(TestPieceSystem, WarnsOfAHomeThatIsNotAboveThePartAndOfWhatComesOfIt) {
  fs::copy(FRUSTUM_SOURCE_DIR "/machines/zx-yac.toml", folder_ / "low.toml");
  replace_in("low.toml", "home   = 500", "home   = -200");
  const Outcome made = run("program cone --machine low.toml --out cone");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("axis.Z.home: the program lifts the tool to the home position of Z, "
                          "-200 mm"),
            std::string::npos)
      << made.err;
  const Outcome ran = run("run cone/job.toml --out o");
  EXPECT_EQ(ran.exit_code, 2) << ran.out;
  EXPECT_NE(ran.err.find("cone.nc:"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("the program runs into the part"), std::string::npos) << ran.err;
}

TEST_F(TestPieceSystem, TheSPieceSaysWhatDoesNotFit) {
  const Outcome large = run("program s-piece --machine zx-yac --cutter 90 --out s");
  EXPECT_EQ(large.exit_code, 2);
  EXPECT_NE(large.err.find("at u = 0."), std::string::npos) << large.err;
  EXPECT_NE(large.err.find("largest radius"), std::string::npos) << large.err;
  EXPECT_FALSE(fs::exists(folder_ / "s/job.toml"));
  write("p.csv", "curve,x,y,z\nC0,0,0,oops\n");
  const Outcome points = run("program s-piece --machine zx-yac --points p.csv --out s");
  EXPECT_EQ(points.exit_code, 2);
  EXPECT_NE(points.err.find("p.csv:2:8"), std::string::npos) << points.err;
  EXPECT_EQ(run("program s-piece --machine zx-yac --method two --out s").exit_code, 2);
}

TEST_F(TestPieceSystem, IdentifySaysWhatTheSAloneDoesNotTell) {
  ASSERT_EQ(run("program s-piece --machine zx-yac --blocks 500 --out s --quiet").exit_code, 0);
  replace_in("s/job.toml", "report = true", "report = false");
  ASSERT_NE(
      run("run s/job.toml --out o --quiet --error dx_AY=8um --error gamma_YX=12urad").exit_code, 2);
  write("study.toml",
        "[[part]]\nname = \"s\"\njob = \"s/job.toml\"\nmeasured = [\"o/result.json\"]\n"
        "[uncertainty]\ncmm = { e0 = \"0.5 um\", l_per_um = 600 }\n");
  // Not all of them are told.
  const Outcome found = run("identify study.toml --json");
  ASSERT_EQ(found.exit_code, 1) << found.err;
  const json result = json::parse(found.out);
  std::vector<std::string> told;
  for (const json& each : result["combinations"]) told.push_back(each["text"]);
  EXPECT_EQ(told, (std::vector<std::string>{"alpha_AY - alpha_ZY", "beta_AY - beta_ZX"}));
  EXPECT_EQ(result["observability"]["rank"], 9);
  bool dx_found = false;
  for (const json& each : result["estimates"]) {
    if (each["name"] != "dx_AY" || !each.contains("value") || each["value"].is_null()) continue;
    dx_found = true;
    EXPECT_NEAR(each["value"].get<double>(), 8.0, 0.5);
  }
  EXPECT_TRUE(dx_found) << found.out.substr(0, 2000);
}

TEST_F(TestPieceSystem, DesignChoosesPiecesAndMotionTestsUnderABudget) {
  for (const char* piece :
       {"cone --chord-tolerance 5", "s-piece --blocks 300", "contour --center=0,0,120"}) {
    const std::string words = piece;
    ASSERT_EQ(run("program " + words + " --machine zx-yac --quiet --out " +
                  words.substr(0, words.find(' ')))
                  .exit_code,
              0);
  }
  ASSERT_EQ(run("motion chase --machine zx-yac --ball 80,30,60 --out r --at \"A=-80,C=0;A=-80,C=90;"
                "A=-40,C=-30;A=-40,C=60;A=0,C=-120;A=0,C=0;A=0,C=120;A=40,C=-60;A=40,C=30\"")
                .exit_code,
            0);
  write("plan.toml",
        "[[part]]\nname = \"cone\"\njob = \"cone/job.toml\"\nrows = \"floating-points\"\n"
        "[[part]]\nname = \"S\"\njob = \"s-piece/job.toml\"\n"
        "[[part]]\nname = \"contour\"\njob = \"contour/job.toml\"\nhours = 1.5\n"
        "[[motion]]\nname = \"R-test\"\ntest = \"r/test.toml\"\nnoise = \"0.3um\"\n"
        "hours = 0.75\n"
        "[uncertainty]\ncmm = { e0 = \"0.5 um\", l_per_um = 600 }\n"
        "[times]\npiece_setup_min = 30\ncmm_setup_min = 30\ntouch_s = 3\n");
  const Outcome outcome = run("design --study plan.toml --hours 3 --json");
  ASSERT_NE(outcome.exit_code, 2) << outcome.err;
  const json doc = json::parse(outcome.out);
  EXPECT_EQ(doc["tests"], json::array({"cone", "S", "contour", "R-test"}));
  EXPECT_NEAR(doc["items"]["contour"]["machine_hours"].get<double>() +
                  doc["items"]["contour"]["cmm_hours"].get<double>(),
              1.5, 1e-12);
  // 294 touches, and what cutting takes.
  EXPECT_NEAR(doc["items"]["S"]["cmm_hours"].get<double>(), 0.5 + 294 * 3.0 / 3600.0, 1e-9);
  EXPECT_GT(doc["items"]["S"]["machine_hours"].get<double>(), 0.5 + 2 * 0.279 / 36.0);
  for (const json& item : doc["items"]) EXPECT_GT(item["bits_per_hour"].get<double>(), 0.0);
  EXPECT_LE(doc["within_budget"]["hours"].get<double>(), 3.0);
  // More hours tell no less.
  const json more = json::parse(run("design --study plan.toml --hours 6 --json").out);
  EXPECT_GT(more["within_budget"]["bits"].get<double>(),
            doc["within_budget"]["bits"].get<double>());
  EXPECT_NE(run("design --study plan.toml --hours 0.5").out.find("Nothing that may be chosen"),
            std::string::npos);
  EXPECT_EQ(run("design --study plan.toml --hours 0").exit_code, 2);
  EXPECT_EQ(run("design zx-yac --hours 3").exit_code, 2);
  // The same file is refused as measurements: there are none.
  EXPECT_EQ(run("identify plan.toml").exit_code, 2);
}

// The numbers of a row of docs/test-pieces.md that begins with `name`.
std::vector<double> documented(const std::string& text, const std::string& name) {
  const std::string begin = "\n| " + name + " |";
  std::vector<double> numbers;
  const auto at = text.find(begin, text.find("### Information per hour"));
  if (at == std::string::npos) return numbers;
  std::istringstream cells(
      text.substr(at + begin.size(), text.find('\n', at + 1) - at - begin.size()));
  for (std::string cell; std::getline(cells, cell, '|') && numbers.size() < 8;) {
    numbers.push_back(std::strtod(cell.c_str(), nullptr));
  }
  return numbers;
}

TEST_F(TestPieceSystem, TheInformationPerHourIsAsDocumented) {
  const fs::path source = FRUSTUM_SOURCE_DIR;
  for (const char* example : {"which-piece", "r-test", "ballbar"}) {
    fs::copy(source / "examples" / example, folder_ / example);
  }
  for (const char* words :
       {"cone --out which-piece/cone", "step --workpiece 1 --out which-piece/steps-1",
        "step --workpiece 2 --out which-piece/steps-2", "s-piece --out which-piece/s-piece",
        "contour --out which-piece/contour"}) {
    ASSERT_EQ(run(std::string("program ") + words + " --machine zx-yac --quiet").exit_code, 0)
        << words;
  }
  const std::string text = read(source / "docs/test-pieces.md");
  const json points = json::parse(run("design --study which-piece/plan.toml --json").out)["items"];
  const json values =
      json::parse(run("design --study which-piece/values.toml --json").out)["items"];
  EXPECT_EQ(points.size(), 8U);
  for (const auto& [item, name] : {std::pair{"cone", "cone"},
                                   {"steps-1", "steps-1"},
                                   {"steps-2", "steps-2"},
                                   {"s-piece", "S"},
                                   {"contour", "contouring"},
                                   {"bar XY", "ball bar XY"},
                                   {"bar C", "ball bar, C axis"},
                                   {"R-test", "R-test, 30 poses"}}) {
    const std::vector<double> row = documented(text, name);
    ASSERT_EQ(row.size(), 8U) << name;
    std::vector<double> found;
    for (const char* key : {"machine_hours", "cmm_hours", "rank", "bits", "bits_per_hour"}) {
      found.push_back(points[item][key].get<double>());
    }
    for (const char* key : {"rank", "bits", "bits_per_hour"}) {
      found.push_back(values.contains(item) ? values[item][key].get<double>() : 0.0);
    }
    for (std::size_t k = 0; k < 8; ++k)
      EXPECT_NEAR(row[k], found[k], k < 2 ? 0.006 : 0.06) << name << k;
  }
}

TEST_F(TestPieceSystem, ASurfaceOfYourOwnIsCut) {
  std::string net = "row,x,y,z\n";
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      net += std::to_string(i) + "," + std::to_string(20 - 12 * j) + "," +
             std::to_string(12 * i - 18) + "," + std::to_string(i * j) + "\n";
    }
  }
  write("net.csv", net);
  const Outcome made =
      run("program surface --machine zx-yac --net net.csv --cusp 50 --blocks 60 --out f");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  replace_in("f/job.toml", "report = true", "report = false");
  const Outcome ran = run("run f/job.toml --json --out o");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_LT(json::parse(ran.out)["characteristics"][0]["value"].get<double>(), 5.0);
}

// A cube of 20 mm, each corner moved outward by `grown` mm in x.
std::string cube_obj(double grown, double shifted) {
  std::string text;
  for (int c = 0; c < 8; ++c) {
    const double x = (c & 1) != 0 ? 20.0 + grown : 0.0;
    text += "v " + std::to_string(x + shifted) + " " + std::to_string((c & 2) != 0 ? 20.0 : 0.0) +
            " " + std::to_string((c & 4) != 0 ? 20.0 : 0.0) + "\n";
  }
  return text +
         "f 1 3 2\nf 2 3 4\nf 5 6 7\nf 6 8 7\nf 1 2 5\nf 2 6 5\nf 3 7 4\nf 4 7 8\nf 1 5 3\n"
         "f 3 5 7\nf 2 4 6\nf 4 8 6\n";
}

TEST_F(TestPieceSystem, CompareTellsDeviationsAndTheShareWithin) {
  write("nominal.obj", cube_obj(0.0, 0.0));
  write("part.obj", cube_obj(0.1, 0.0));
  const Outcome found =
      run("compare part.obj nominal.obj --tolerance 50um --json --mesh out.ply --picture out.png");
  EXPECT_EQ(found.exit_code, 1) << found.err;
  const json result = json::parse(found.out);
  EXPECT_EQ(result["points"], 8);
  EXPECT_NEAR(result["highest_um"].get<double>(), 100.0, 1e-3);
  EXPECT_NEAR(result["lowest_um"].get<double>(), 0.0, 1e-9);
  EXPECT_NEAR(result["within_percent"].get<double>(), 50.0, 1e-9);
  std::size_t counted = 0;
  for (const json& bar : result["histogram"]) counted += bar["count"].get<std::size_t>();
  EXPECT_EQ(counted, 8u);
  EXPECT_TRUE(fs::exists(folder_ / "out.ply") && fs::exists(folder_ / "out.png"));
  write("moved.obj", cube_obj(0.0, 0.3));
  const Outcome aligned =
      run("compare moved.obj nominal.obj --tolerance 1um --align best-fit --json");
  EXPECT_EQ(aligned.exit_code, 0) << aligned.err << aligned.out;
  const std::string scan = read(folder_ / "part.obj");
  write("part.ply", read(folder_ / "out.ply"));
  for (const char* output : {"--mesh part.ply", "--mesh out.stl", "--picture part.ply"}) {
    const Outcome kept = run(std::string("compare part.ply nominal.obj ") + output);
    EXPECT_EQ(kept.exit_code, 2) << output;
  }
  EXPECT_EQ(read(folder_ / "part.ply"), read(folder_ / "out.ply"));
  EXPECT_EQ(read(folder_ / "part.obj"), scan);
  EXPECT_EQ(run("compare part.obj nominal.step").exit_code, 2);
  EXPECT_EQ(run("compare part.obj nominal.obj --tolerance 5").exit_code, 2);
  EXPECT_EQ(run("compare part.obj nominal.obj --align datum").exit_code, 2);
}

TEST_F(TestPieceSystem, CompareRefusesANominalShapeThatDoesNotClose) {
  const std::string cube = cube_obj(0.0, 0.0);
  write("part.obj", cube);
  // Without its last facet.
  write("open.obj", cube.substr(0, cube.rfind("f ")));
  const Outcome open = run("compare part.obj open.obj --json");
  EXPECT_EQ(open.exit_code, 2);
  EXPECT_NE(open.err.find("open.obj: error: the nominal shape is not closed: 3 edges"),
            std::string::npos)
      << open.err;
  EXPECT_NE(open.err.find("(20.000, 20.000, 0.000) to (20.000, 0.000, 20.000)"), std::string::npos)
      << open.err;
  // One facet against the others, and all of them.
  std::string turned = cube;
  turned.replace(turned.find("f 1 3 2"), 7, "f 1 2 3");
  write("turned.obj", turned);
  EXPECT_NE(run("compare part.obj turned.obj").err.find("not closed: 3 edges"), std::string::npos);
  std::string inside_out = cube.substr(0, cube.find("f "));
  std::istringstream facets(cube.substr(inside_out.size()));
  for (std::string f, a, b, c; facets >> f >> a >> b >> c;) {
    inside_out.append("f ").append(a).append(" ").append(c).append(" ").append(b).append("\n");
  }
  write("inside.obj", inside_out);
  EXPECT_NE(run("compare part.obj inside.obj").err.find("inside out"), std::string::npos);
  // Corners that each facet has for itself are one.
  std::istringstream words(cube);
  std::vector<std::string> corners;
  std::string apart, own;
  for (std::string kind, x, y, z; words >> kind >> x >> y >> z;) {
    if (kind == "v") {
      corners.push_back("v " + x + " " + y + " " + z + "\n");
      continue;
    }
    const std::size_t first = static_cast<std::size_t>(std::ranges::count(apart, 'v')) + 1;
    for (const std::string& corner : {x, y, z}) apart += corners.at(std::stoul(corner) - 1);
    own += "f " + std::to_string(first) + " " + std::to_string(first + 1) + " " +
           std::to_string(first + 2) + "\n";
  }
  write("apart.obj", apart + own);
  EXPECT_EQ(run("compare part.obj apart.obj --quiet").exit_code, 0);
}

std::string net_csv(int rows, bool turned_over) {
  std::string net = "row,x,y,z\n";
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < 4; ++j) {
      const int x = turned_over ? 12 * j - 16 : 20 - 12 * j;
      net += std::to_string(i) + "," + std::to_string(x) + "," + std::to_string(12 * i - 18) + "," +
             std::to_string(rows == 2 ? 30 * i : 0) + "\n";
    }
  }
  return net;
}

TEST_F(TestPieceSystem, ASurfaceRefusesWordsThatItDoesNotUse) {
  write("ball.csv", net_csv(4, false));
  write("flank.csv", net_csv(2, false));
  const struct {
    const char* words;
    const char* option;
  } unused[] = {{"--net flank.csv --cusp 5", "--cusp"},
                {"--net flank.csv --lead 10", "--lead"},
                {"--net ball.csv --method balanced", "--method"}};
  for (const auto& each : unused) {
    const Outcome refused =
        run(std::string("program surface --machine zx-yac --out f ") + each.words);
    EXPECT_EQ(refused.exit_code, 2) << each.words;
    EXPECT_NE(refused.err.find(std::string("error: ") + each.option + " is of a"),
              std::string::npos)
        << refused.err;
  }
  EXPECT_FALSE(fs::exists(folder_ / "f/job.toml"));
}

TEST_F(TestPieceSystem, ASurfaceThatIsTurnedOverSaysSo) {
  write("over.csv", net_csv(4, true));
  const Outcome over = run("program surface --machine zx-yac --net over.csv --blocks 60 --out f");
  EXPECT_EQ(over.exit_code, 2);
  EXPECT_NE(over.err.find("turned over"), std::string::npos) << over.err;
  EXPECT_NE(over.err.find("opposite order"), std::string::npos) << over.err;
  write("right.csv", net_csv(4, false));
  EXPECT_EQ(run("program surface --machine zx-yac --net right.csv --blocks 60 --cusp 50 --out f")
                .exit_code,
            0);
  std::string rows = net_csv(2, false);
  for (std::size_t at = 0; (at = rows.find(",30\n", at)) != std::string::npos; at += 5) {
    rows.replace(at, 4, ",-30\n");
  }
  write("down.csv", rows);
  const Outcome down = run("program surface --machine zx-yac --net down.csv --blocks 60 --out g");
  EXPECT_EQ(down.exit_code, 2);
  EXPECT_NE(down.err.find("exchange the rows"), std::string::npos) << down.err;
}

TEST_F(TestPieceSystem, NothingIsMeantThatIsHalfWrong) {
  const Outcome form = run("program contour --machine zx-yac --form axes --out c");
  EXPECT_EQ(form.exit_code, 2);
  EXPECT_EQ(form.err.find("did you mean"), std::string::npos) << form.err;
  EXPECT_NE(run("program contour --machine zx-yac --siz 80 --out c").err.find("mean --size?"),
            std::string::npos);
}

}  // namespace
}  // namespace frustum
