// frustum cut as users and scripts see it: states of the program, removal, limits, engines, files
// whole or not at all.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/app/command_line.hpp"

namespace frustum {
namespace {

using nlohmann::json;

// A plate and a slot of 10 mm in two passes, 5 and 8 mm deep; the last line comes back in rapid.
class CutCommandSystem : public CommandLine {
 protected:
  void write_plate(const std::string& last = "G0 Z10") const {
    std::ofstream(folder_ / "plate.nc") << "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\n"
                                           "G0 X-60 Y0 Z10\nG0 Z-5\nG1 X60 F600\nG0 Z10\n"
                                           "G0 X-60\nG0 Z-8\nG1 X60 F600\n"
                                        << last << "\nM30\n";
    std::ofstream(folder_ / "plate.toml")
        << "title = \"plate\"\nmachine = \"three-axis\"\n"
           "program = { file = \"plate.nc\", dialect = \"fanuc\" }\n"
           "blank = { shape = \"box\", size = [80, 60, 20] }\n"
           "tool.1 = { type = \"flat\", diameter = 10, length = 100, flute_length = 30 }\n";
  }
  json cut(const std::string& more, int exit_code = 0) const {
    const Outcome outcome = run("cut plate.toml --json " + more);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    return json::parse(outcome.out, nullptr, false);
  }
};

TEST_F(CutCommandSystem, TellsWhatEachBlockRemoves) {
  write_plate();
  const json doc = cut("--removal removal.csv --pitch 1");
  EXPECT_NEAR(doc["removal"]["volume_mm3"].get<double>(), 6400.0, 1e-3);
  EXPECT_EQ(doc["removal"]["blocks"], 2);
  const std::string csv = read(folder_ / "removal.csv");
  EXPECT_TRUE(csv.starts_with("line,block,kind,tool,start_s"));
  EXPECT_NE(csv.find("\n7,"), std::string::npos);
  const json first = cut("--removal removal.csv --pitch 1 --until-line 9");
  EXPECT_NEAR(first["removal"]["volume_mm3"].get<double>(), 4000.0, 1e-3);
  EXPECT_FALSE(first["finished"].get<bool>());
}

TEST_F(CutCommandSystem, ShowsThePartAtAnyMoment) {
  write_plate();
  EXPECT_NEAR(cut("--mesh a.stl --pitch 2")["volume_mm3"].get<double>(), 96000.0 - 6400.0, 1.0);
  EXPECT_NEAR(cut("--mesh a.stl --pitch 2 --until-line 7")["volume_mm3"].get<double>(),
              96000.0 - 4000.0, 1.0);
  EXPECT_EQ(cut("--point 0,1,-5 --until-line 7")["made_by"]["line"], 7);
  EXPECT_EQ(cut("--point 0,1,-8")["made_by"]["line"], 11);
  EXPECT_FALSE(cut("--point 0,1,-5", 1)["made_by"]["on_surface"].get<bool>());
  EXPECT_EQ(run("cut plate.toml --point 0,1,-8 --quiet").out,
            "the point was made by line 11, block 6\n");
  // The rim of the slot is an edge of the blank's own face: the slot has made it.
  EXPECT_EQ(cut("--point 0,5,0")["made_by"]["line"], 7);
}

// The shoulder is on the contour: the radius is that of the job's tool, and the contour in a file
// of its own.
TEST_F(CutCommandSystem, CompensatesTheRadiusOfTheJobsTool) {
  write_plate();
  std::ofstream(folder_ / "plate.nc") << "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\n"
                                         "G0 X-60 Y0 Z10\nG0 Z-5\nM98 P7\nG0 Z10\nM30\n";
  std::ofstream(folder_ / "O7.nc") << "O7\nG1 G41 D1 X-50 Y10 F600\nX60\nG40 X80\nM99\n";
  EXPECT_NEAR(cut("--removal removal.csv --pitch 1")["removal"]["volume_mm3"].get<double>(), 4000.0,
              1e-3);
  EXPECT_EQ(cut("--point 0,10,-2")["made_by"]["on_surface"], true);
}

// The slot is cut by lines 2 and 3 of a subprogram, first 5 mm deep and then 8.
TEST_F(CutCommandSystem, CountsTheLinesOfEachFileByThemselves) {
  write_plate();
  std::ofstream(folder_ / "plate.nc")
      << "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\nG0 X-60 Y0 Z-5\n"
         "M98 P7\nG0 X-60\nG0 Z-8\nM98 P7\nM30\n";
  std::ofstream(folder_ / "O7.nc") << "O7\nG1 X0 F600\nX60\nG0 Z10\nM99\n";
  const auto removed = [&](const std::string& line) {
    return cut("--removal r.csv --pitch 1 --until-line " + line)["removal"]["volume_mm3"]
        .get<double>();
  };
  EXPECT_NEAR(removed("5"), 0.0, 1e-9);  // not those of the subprogram, whose lines are lower
  EXPECT_NEAR(removed("6"), 4000.0, 1e-3);
  EXPECT_NEAR(removed("9"), 6400.0, 1e-3);
  EXPECT_NEAR(removed("O7.nc:3"), 6400.0, 1e-3);
  EXPECT_GT(removed("O7.nc:2"), 4000.0);
  EXPECT_LT(removed("O7.nc:2"), 6400.0);
  const json made = cut("--point 30,1,-8")["made_by"];
  EXPECT_EQ(made["line"], 3);
  EXPECT_TRUE(made["program_file"].get<std::string>().ends_with("O7.nc")) << made;
  EXPECT_NE(run("cut plate.toml --until-line O7.nc:2 --point 30,1,-5").out.find("line 2 of O7.nc"),
            std::string::npos);
  for (const char* wrong : {"O8.nc:2", "O7.nc:0", "O7.nc", "3x", "-1", ":3"}) {
    EXPECT_EQ(run(std::string("cut plate.toml --point 0,1,-5 --until-line ") + wrong).exit_code, 2)
        << wrong;
  }
}

// Its first cut is that of line 6 and of what it calls, its second that of line 9.
TEST_F(CutCommandSystem, OperationsHaveTheSubprogramsThatTheirLinesCall) {
  write_plate();
  std::ofstream(folder_ / "plate.nc")
      << "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\nG0 X-60 Y0 Z-5\n"
         "M98 P7\nG0 X-60\nG0 Z-8\nM98 P7\nM30\n";
  std::ofstream(folder_ / "O7.nc") << "O7\n\n\n\n\n\n\nG1 X60 F600\nG0 Z10\nM99\n";
  std::ofstream(folder_ / "plan.toml")
      << "[probe]\nball_diameter = 2\nclearance = 1\nreach = 1\n"
         "[[feature]]\nname = \"floor\"\nkind = \"plane\"\npoint = [0, 0, -8]\naxis = [0, 0, 1]\n"
         "strategy = { u = [20, 0, 0], v = [0, 2, 0], columns = 3, rows = 2 }\n"
         "extent = { u = [30, 0, 0], v = [0, 4, 0] }\n"
         "[[characteristic]]\nname = \"flat\"\nkind = \"flatness\"\nfeature = \"floor\"\n"
         "tolerance = \"10 um\"\n";
  const std::string job = read(folder_ / "plate.toml");
  const auto warned = [&](const std::string& lines) {
    std::ofstream(folder_ / "plate.toml")
        << job << "inspection = { plan = \"plan.toml\" }\n"
        << "operation = [{ name = \"slot\", lines = " << lines << ", makes = [\"floor\"] }]\n";
    const std::string out = "out" + lines.substr(1, 1);
    const Outcome outcome = run("run plate.toml --out " + out);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return read(folder_ / out / "result.json").find("were cut by another operation") !=
           std::string::npos;
  };
  EXPECT_FALSE(warned("[9, 9]"));
  EXPECT_TRUE(warned("[6, 6]"));
  EXPECT_TRUE(warned("[7, 8]"));
}

TEST_F(CutCommandSystem, Fault2_30_ABlankAwayFromTheToolPathIsAFault) {
  write_plate();
  replace_in("plate.toml", "[80, 60, 20] }", "[80, 60, 20], origin = [0, 500, 0] }");
  const Outcome away = run("cut plate.toml --mesh part.stl --pitch 4");
  EXPECT_EQ(away.exit_code, 1) << away.out;
  EXPECT_NE(away.err.find("nothing is removed: the tool, "), std::string::npos) << away.err;
}

// Passes of 5 and 8 mm with flutes of 4: the shank begins 1 mm below the top of the first one, and
// at the bottom of the second it is in what the flutes have not reached.
TEST_F(CutCommandSystem, Fault2_24_ACutDeeperThanTheFlutesIsACollisionOfTheShank) {
  write_plate();
  EXPECT_EQ(cut("--point 0,1,-8")["collisions"], 0);
  replace_in("plate.toml", "flute_length = 30", "flute_length = 4");
  const json doc = cut("--point 0,1,-8", 1);
  ASSERT_FALSE(doc["collision_list"].empty());
  const json& first = doc["collision_list"][0];
  EXPECT_EQ(first["kind"], "body_in_material");
  EXPECT_EQ(first["body"], "shank");
  EXPECT_EQ(first["tool"], 1);
  EXPECT_EQ(first["line"], 7);
  EXPECT_NEAR(first["depth_mm"].get<double>(), 1.0, 0.03);
  EXPECT_TRUE(first["text"].get<std::string>().starts_with(
      "shank in material above the flutes during a feed move: tool T1, "))
      << first["text"];
  replace_in("plate.toml", ", flute_length = 4", "");
  EXPECT_EQ(cut("--point 0,1,-8")["collisions"], 0);
}

TEST_F(CutCommandSystem, Fault2_30_TheSpindleAgainstTheHandOfTheToolIsAWarning) {
  write_plate();
  EXPECT_EQ(run("cut plate.toml --point 0,1,-8").err, "");
  replace_in("plate.nc", "S1000 M3", "S1000 M4");
  const std::string message =
      "plate.nc:7: warning: tool T1 is a right-hand cutter and cuts while the "
      "spindle turns counterclockwise (M4)";
  const Outcome warned = run("cut plate.toml --point 0,1,-8");
  EXPECT_EQ(warned.exit_code, 0) << warned.err;
  EXPECT_NE(warned.err.find(message), std::string::npos) << warned.err;
  EXPECT_EQ(warned.err.find("plate.nc:11"), std::string::npos) << warned.err;
  const std::string checked = run("check plate.nc --job plate.toml").out;
  EXPECT_NE(checked.find("spindle-hand"), std::string::npos) << checked;
  replace_in("plate.toml", "length = 100", "length = 100, hand = \"left\"");
  EXPECT_EQ(run("cut plate.toml --point 0,1,-8").err, "");
  EXPECT_EQ(run("check plate.nc --job plate.toml").out.find("spindle-hand"), std::string::npos);
}

// A left-hand tap turns counterclockwise on the way in; its tool states no hand.
TEST_F(CutCommandSystem, Fault2_30_ALeftHandTapIsNotAgainstTheHand) {
  write_plate();
  for (const std::string tap :
       {"S500 M4\nG74 X0 Y0 Z-15 R5 F500", "M3 S500\nG84 X0 Y0 Z-15 R5 F500",
        "M29 S500\nG74 X0 Y0 Z-15 R5 F500"}) {
    std::ofstream(folder_ / "plate.nc") << "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\n"
                                           "G0 X0 Y0 Z10\n"
                                        << tap << "\nG80\nG0 Z50\nM30\n";
    const Outcome tapped = run("cut plate.toml --point 5,0,-8");
    EXPECT_EQ(tapped.exit_code, 0) << tapped.err;
    EXPECT_EQ(tapped.err.find("-hand cutter"), std::string::npos) << tap << tapped.err;
  }
  // A drill that turns the wrong way.
  replace_in("plate.nc", "M29 S500\nG74", "M4\nG81");
  EXPECT_NE(run("cut plate.toml --point 5,0,-8").err.find("-hand cutter"), std::string::npos);
}

TEST_F(CutCommandSystem, WritesSnapshotsWithAnIndex) {
  write_plate();
  cut("--mesh film.ply --pitch 2 --snapshots 4");
  const json index = json::parse(read(folder_ / "film.json"));
  ASSERT_EQ(index["snapshots"].size(), 4U);
  double volume = 96000.1;
  for (const json& s : index["snapshots"]) {
    EXPECT_TRUE(fs::exists(folder_ / s["file"].get<std::string>()));
    EXPECT_LE(s["volume_mm3"].get<double>(), volume);
    volume = s["volume_mm3"].get<double>() + 1e-6;
  }
  EXPECT_FALSE(fs::exists(folder_ / "film.ply"));
}

TEST_F(CutCommandSystem, DrawsAtTheSizeThatIsAskedFor) {
  write_plate();
  ASSERT_EQ(run("cut plate.toml --pitch 4 --picture a.png --size 96,64").exit_code, 0);
  // Width and height are in the file's first block, highest byte first.
  EXPECT_EQ(read(folder_ / "a.png").substr(16, 8), std::string("\0\0\0\x60\0\0\0\x40", 8));
  for (const std::string size : {"96", "96,6.5", "96,1e30", "10,10", "nan,64"}) {
    const Outcome refused = run("cut plate.toml --pitch 4 --picture b.png --size " + size);
    EXPECT_EQ(refused.exit_code, 2) << size;
    EXPECT_NE(refused.err.find("size"), std::string::npos) << refused.err;
  }
  EXPECT_FALSE(fs::exists(folder_ / "b.png"));
}

// The two five-axis parts take longer; tests/app/post_command_test.cpp plans them.
TEST_F(CutCommandSystem, CutsTheThreeAxisPartsOfTheExamplesWithoutCollision) {
  for (const std::string part : {"flange", "freeform", "plate"}) {
    const Outcome done = run("cut '" FRUSTUM_SOURCE_DIR "/examples/parts/" + part +
                             "/job.toml' --removal r.csv --pitch 4 --json");
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const json told = json::parse(done.out);
    EXPECT_EQ(told["collisions"], 0) << part;
    EXPECT_EQ(told["finished"], true) << part;
  }
}

// At this pitch a vertex of the groove's floor, by the blank's side, has triangles that face as the
// side does: judged by them it would be a gouge of 250 um.
TEST_F(CutCommandSystem, JudgesPointsOfASmoothFaceByTheirOwnNormalAlone) {
  const Outcome done =
      run("cut '" FRUSTUM_SOURCE_DIR "/examples/cone/job.toml' --gouge-limit 30 --json");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NEAR(json::parse(done.out)["gouge"]["deviation_um"].get<double>(), -10.7, 0.1);
}

TEST_F(CutCommandSystem, FailsWithExitCodeOneOnACollision) {
  write_plate("G0 X-60 Y8");
  const json doc = cut("--mesh a.stl --pitch 2", 1);
  ASSERT_EQ(doc["collisions"], 1);
  EXPECT_EQ(doc["collision_list"][0]["line"], 12);
  EXPECT_EQ(doc["collision_list"][0]["body"], "cutter");
  // Before that line there is none.
  EXPECT_EQ(cut("--mesh a.stl --pitch 2 --until-line 11")["collisions"], 0);
}

// A clamp beside the plate, its top 5 mm above it: lines 6 and 10 go down into it.
constexpr const char* kClamp =
    "[[fixtures]]\nname = \"clamp\"\nshape = \"box\"\nsize = [20, 20, 25]\n"
    "origin = [-60, 0, -20]\n";

TEST_F(CutCommandSystem, ToolsThatMeetAFixtureAreCollisionsOfTheirLines_Fault2_25) {
  write_plate();
  const json free = cut("--removal r.csv --pitch 4");
  EXPECT_EQ(free["collisions"], 0);
  EXPECT_EQ(free["machine_collisions"]["looked_for"], true);
  EXPECT_GT(free["machine_collisions"]["smallest_distance_mm"], 10.0);
  std::ofstream(folder_ / "plate.toml", std::ios::app) << kClamp;
  const json doc = cut("--removal r.csv --pitch 4", 1);
  ASSERT_EQ(doc["collisions"], 2);
  const json& first = doc["collision_list"][0];
  EXPECT_EQ(first["line"], 6);
  EXPECT_EQ(first["last_line"], 7);
  EXPECT_EQ(first["kind"], "bodies_meet");
  EXPECT_EQ(first["body"], "clamp");
  EXPECT_EQ(first["other_body"], "cutter");
  EXPECT_NEAR(first["point"][2].get<double>(), 5.0, 0.03);
  EXPECT_EQ(doc["collision_list"][1]["line"], 10);
  EXPECT_EQ(doc["machine_collisions"]["between"], (json{"clamp", "cutter"}));
  EXPECT_EQ(cut("--removal r.csv --pitch 4 --until-line 9", 1)["collisions"], 1);
  const Outcome checked = run("check --job plate.toml");
  EXPECT_EQ(checked.exit_code, 1);
  EXPECT_NE(checked.out.find("plate.nc:6:1: error: clamp meets cutter with tool T1"),
            std::string::npos)
      << checked.out << checked.err;
  EXPECT_NE(checked.out.find("[machine-collision]"), std::string::npos) << checked.out;
}

TEST_F(CutCommandSystem, WithoutBodiesItSaysThatNoneWereLookedFor_Fault2_25) {
  write_plate();
  std::string machine = read(FRUSTUM_SOURCE_DIR "/machines/three-axis.toml");
  machine.resize(machine.find("[[bodies]]"));
  std::ofstream(folder_ / "bare.toml") << machine;
  std::string job = read(folder_ / "plate.toml");
  job.replace(job.find("\"three-axis\""), 12, "\"bare.toml\"");
  std::ofstream(folder_ / "plate.toml") << job;
  const json doc = cut("--removal r.csv --pitch 4");
  EXPECT_EQ(doc["machine_collisions"]["looked_for"], false);
  const Outcome told = run("cut plate.toml --removal r.csv --pitch 4");
  EXPECT_NE(told.out.find("Machine collisions were not looked for"), std::string::npos) << told.out;
}

TEST_F(CutCommandSystem, SaysHowNearARefinedSurfaceIs) {
  write_plate("G0 Z10\nG0 X0 Y20\nG1 Z-4\nG0 Z10");
  EXPECT_FALSE(cut("--mesh a.ply --pitch 2").contains("worst_chord_um"));
  const json doc = cut("--mesh a.ply --pitch 2 --chord 0.01");
  EXPECT_GT(doc["worst_chord_um"].get<double>(), 1.0);
  EXPECT_LE(doc["worst_chord_um"].get<double>(), 10.0);
  EXPECT_EQ(doc["unresolved_edges"], 0);
  EXPECT_EQ(doc["unresolved_vertices"], 0);
  const std::string text = run("cut plate.toml --mesh a.ply --pitch 2 --chord 0.01").out;
  EXPECT_NE(text.find("largest distance found between triangles and surface"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("was not found"), std::string::npos) << text;
}

TEST_F(CutCommandSystem, AgreesWithThePolyhedralEngineOrSaysThatItIsMissing) {
  write_plate();
  const Outcome outcome = run("cut plate.toml --json --engine polyhedral --facets 32 --mesh p.stl");
  if (outcome.exit_code == 2) {
    EXPECT_NE(outcome.err.find("built without the polyhedral engine"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder_ / "p.stl"));
    return;
  }
  const json doc = json::parse(outcome.out);
  EXPECT_EQ(doc["engine"], "polyhedral");
  EXPECT_TRUE(doc["closed"].get<bool>());
  EXPECT_LE(doc["volume_mm3"].get<double>(), 89600.1);
  // Walls stand off by up to 5 mm (1/cos(pi/32) - 1) on both sides of 80 x 8 mm.
  EXPECT_NEAR(doc["volume_mm3"].get<double>(), 89600.0, 31.5);
}

// A box of 80 x 60 mm whose top is at z; facets face out.
std::string box_obj(double z) {
  std::string text;
  for (const double height : {-20.0, z}) {
    for (const char* corner : {"-40 -30", "40 -30", "40 30", "-40 30"}) {
      text += "v " + std::string(corner) + " " + std::to_string(height) + "\n";
    }
  }
  return text + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

TEST_F(CutCommandSystem, HoldsThePartAgainstANominalMesh) {
  write_plate();
  std::ofstream(folder_ / "part.obj") << box_obj(-8.1);
  std::ofstream(folder_ / "plate.toml", std::ios::app) << "nominal = { file = \"part.obj\" }\n";
  const json doc = cut("--pitch 2 --excess-limit 9000");
  EXPECT_NEAR(doc["excess"]["deviation_um"].get<double>(), 8100.0, 1e-3);
  cut("--pitch 2 --excess-limit 8000", 1);
  std::ofstream(folder_ / "part.obj") << box_obj(-7.5);
  EXPECT_EQ(cut("--pitch 2 --gouge-limit 400", 1)["gouge"]["line"], 11);
  // Flat floors lose their vertices to decimation, not their verdict.
  EXPECT_NEAR(
      cut("--mesh a.ply --decimate 0.01 --pitch 2 --gouge-limit 400", 1)["gouge"]["deviation_um"]
          .get<double>(),
      -500.0, 1e-3);
}

TEST_F(CutCommandSystem, NamesTheKeyOfWhatIsWrongInAJob) {
  write_plate();
  const std::string job = read(folder_ / "plate.toml");
  const auto told = [&](const std::string& from, const std::string& to) {
    std::string changed = job;
    changed.replace(changed.find(from), from.size(), to);
    std::ofstream(folder_ / "wrong.toml") << changed;
    const Outcome outcome = run("cut wrong.toml --mesh part.ply");
    EXPECT_EQ(outcome.exit_code, 2) << to;
    return outcome.err;
  };
  using testing::HasSubstr;
  EXPECT_THAT(told("three-axis", "three-axes"),
              AllOf(HasSubstr("wrong.toml:2:1: error: machine:"), HasSubstr("mean three-axis?")));
  EXPECT_THAT(told("blank =", "errors.EXXX = \"1 um\"\nblank ="),
              HasSubstr("wrong.toml:4:8: error: errors.EXXX: unknown error name"));
  EXPECT_THAT(told("length = 100", "length = 20"),
              HasSubstr("wrong.toml:5:6: error: tool.1: flute length 30 mm exceeds"));
  EXPECT_THAT(told("length = 100", "length = 100, length_error = -100"),
              HasSubstr("tool.1: length_error -100 mm"));
}

TEST_F(CutCommandSystem, WarnsOfAProgramThatMovesNothing) {
  write_plate();
  std::ofstream(folder_ / "plate.nc") << "G21 G90\nM30\n";
  const Outcome idle = run("cut plate.toml --mesh a.stl --pitch 4");
  EXPECT_EQ(idle.exit_code, 0);
  EXPECT_NE(idle.err.find("warning: the program moves no tool"), std::string::npos) << idle.err;
}

TEST_F(CutCommandSystem, RefusesAndWritesNothing) {
  write_plate();
  for (const char* arguments : {"",
                                "--snapshots 3",
                                "--mesh part.xyz",
                                "--removal part.txt",
                                "--picture part.gif",
                                "--point 1,2",
                                "--mesh part.ply --engine voxel",
                                "--mesh part.ply --until-line 0",
                                "--mesh part.ply --gouge-limit -1",
                                "--mesh part.ply --gouge-limit 5",
                                "--mesh part.ply --chord 1e-12",
                                "--mesh part.ply --facets 2",
                                "--mesh part.ply --facets 12",
                                "--mesh part.ply --until-line 14",
                                "--mesh part.ply --engine polyhedral --chord 0.1",
                                "--mesh part.ply --view 10,20",
                                "--picture part.png --view 10",
                                "--picture part.png --view 10,91",
                                "--removal no/such/folder/part.csv",
                                "--removal part.csv --pitch 1e-4",
                                "--removal part.csv --chord 0.1",
                                "--removal part.csv --decimate 0.1"}) {
    SCOPED_TRACE(arguments);
    const Outcome outcome = run(std::string("cut plate.toml --quiet ") + arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_FALSE(outcome.err.empty());
    const auto files = fs::directory_iterator(folder_);
    EXPECT_TRUE(std::none_of(begin(files), end(files),
                             [](const auto& entry) { return entry.path().stem() == "part"; }));
  }
}

}  // namespace
}  // namespace frustum
