// Pages and texts in German, with lengths in inches: no text of the table is left in English, and
// what programs read does not change.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/app/command_line.hpp"
#include "tests/report/page_texts.hpp"

namespace frustum {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kGermanInch = " --language de --units inch";

class LanguageSystem : public CommandLine {
 protected:
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  void link_examples() const {
    fs::create_symlink(fs::path(FRUSTUM_SOURCE_DIR) / "examples", folder_ / "examples");
  }

  // Without the titles of machines, which are in the language of whoever wrote them.
  static std::string ours(std::string text) {
    for (const auto& file : fs::directory_iterator(fs::path(FRUSTUM_SOURCE_DIR) / "machines")) {
      if (file.path().extension() != ".toml") continue;
      const std::string toml = read(file.path());
      const auto from = toml.find('"', toml.find("title")) + 1;
      const std::string title = toml.substr(from, toml.find('"', from) - from);
      for (std::size_t at = 0; (at = text.find(title, at)) != std::string::npos;) {
        text.erase(at, title.size());
      }
    }
    return text;
  }

  // Runs a command in both languages; `page` is the name of its page in the folder of --out, `json`
  // that of its document.
  void expect_german(const std::string& command, const std::string& page, const std::string& json,
                     std::size_t page_texts, std::size_t texts) const {
    const Outcome english = run(command + " --out en");
    ASSERT_LE(english.exit_code, 1) << command << english.err;
    const Outcome german = run(command + " --out de" + kGermanInch);
    ASSERT_EQ(german.exit_code, english.exit_code) << command << german.err;
    const std::string en = ours(report::texts_of(read(folder_ / "en" / page)));
    const std::string de_page = read(folder_ / "de" / page);
    EXPECT_THAT(de_page, HasSubstr("<html lang=\"de\">"));
    const std::string de = ours(report::texts_of(de_page));
    const auto of_page = report::untranslated(en, de);
    EXPECT_THAT(of_page.left, IsEmpty()) << command;
    EXPECT_GE(of_page.found, page_texts) << command;
    const auto of_text = report::untranslated(ours(english.out), ours(german.out));
    EXPECT_THAT(of_text.left, IsEmpty()) << command << "\n" << german.out;
    EXPECT_GE(of_text.found, texts) << command << "\n" << english.out;
    EXPECT_THAT(de, Not(HasSubstr("µm"))) << command;
    // Not "versetzt um".
    const std::regex micrometres("[0-9] um");
    EXPECT_FALSE(std::regex_search(de, micrometres)) << command;
    EXPECT_FALSE(std::regex_search(german.out, micrometres)) << command << german.out;
    EXPECT_EQ(read(folder_ / "de" / json), read(folder_ / "en" / json)) << command;
  }
};

TEST_F(LanguageSystem, RefusesOtherLanguagesAndUnits) {
  for (const char* command : {"measure", "history .", "study s.toml"}) {
    EXPECT_EQ(run(std::string(command) + " --language fr").exit_code, 2) << command;
    EXPECT_EQ(run(std::string(command) + " --units m").exit_code, 2) << command;
  }
}

TEST_F(LanguageSystem, Measure) {
  write("plane.plan.toml", R"(title = "Ebene 7"
alignment = "plan"
[probe]
ball_diameter = 2
clearance = 1
reach = 1
[[feature]]
name = "A"
kind = "plane"
point = [0, 0, 0]
axis = [0, 0, 1]
strategy = { u = [20, 0, 0], v = [0, 20, 0], columns = 3, rows = 3 }
[[characteristic]]
name = "A.flat"
kind = "flatness"
feature = "A"
tolerance = "5 um"
)");
  std::string points = "Element;Punkt-Nr.;X-Istwert [mm];Y-Istwert [mm];Z-Istwert [mm]\r\n";
  for (int k = 0; k < 9; ++k) {
    points += fmt::format("A;{};{};{};0,00{}\r\n", k + 1, 10 * (k % 3) - 10, 10 * (k / 3) - 10,
                          k % 2 == 0 ? "12" : "0");
  }
  write("p.csv", points);
  expect_german("measure --plan plane.plan.toml --points p.csv --e0 \"1.8 um\" --l-per-um 350",
                "report.html", "result.json", 12, 5);
  EXPECT_EQ(read(folder_ / "de/points.csv"), read(folder_ / "en/points.csv"));
  EXPECT_THAT(read(folder_ / "de/report.html"), HasSubstr("47,24")) << "1.2 um";
}

TEST_F(LanguageSystem, History) {
  link_examples();
  expect_german("history examples/history", "history.html", "history.json", 20, 12);
  const std::string page = read(folder_ / "de/history.html");
  for (const char* part : {"Verlauf einer Maschine", "Eingriffsgrenze", "OEG", "vorgefunden",
                           "Form des Kegelmantels", "387,46", "gleitende"}) {
    EXPECT_THAT(page, HasSubstr(part)) << part;
  }
}

TEST_F(LanguageSystem, Study) {
  write("study.toml",
        "target = \"volumetric\"\nmachine = \"dvf5000\"\naxes = \"Y=-225,Z=-480\"\n"
        "tool_length = 150\nsamples = 200\n[errors]\ndxX = \"nominal 0um tolerance 10um\"\n"
        "eyY = \"nominal 0urad tolerance 20urad\"\n[tolerances]\nread_as = \"normal-3sd\"\n"
        "[limits]\n\"volumetric.error\" = \"12 um\"\n[measurement]\nu = \"2 um\"\n"
        "[risk]\nrules = [\"simple\", \"guard 1.0\"]\n[shares]\ncharacteristic = "
        "\"volumetric.error\"\n");
  expect_german("study study.toml --seed 5", "report.html", "result.json", 12, 6);
}

TEST_F(LanguageSystem, Motion) {
  struct Case {
    const char* command;
    std::size_t of_page, of_text;
  };
  const Case cases[] = {
      {"circle iwf-bc --plane XY --length 150 --center 0,0,150 --error EC0Y=30urad --error "
       "\"EXX=linear 10um\" --noise 0.1um --tool-length 150 --dialect fanuc",
       35, 12},
      {"rotary zx-yac --axis C --direction radial --ball 100,0,100 --length 150 --error EX0C=10um",
       15, 4},
      {"cone iwf-bc --tool-length 200 --angles 0,30,60,90,120,150,180,210,240,270,300,330", 15, 4},
      {"chase zx-yac --ball 100,0,100 --at \"A=-90,C=0;A=0,C=60\" --error EX0C=10um", 8, 3},
      {"line zx-yac --axis X --targets=-180,-97,-31,42,111,178 --error \"EXX=linear 10um\"", 15, 8},
      {"diagonal iwf-bc --box \"X=-200:200,Y=-150:150,Z=0:300\" --error EC0Y=20urad", 8, 4},
      {"touch ac-probe --error EX0C=10um --noise 0.35um", 15, 5},
      {"vectors zx-yac --error EX0C=10um --error EB0C=20urad", 8, 4},
  };
  for (const Case& each : cases) {
    expect_german(std::string("motion ") + each.command, "motion.html", "motion.json", each.of_page,
                  each.of_text);
  }
  EXPECT_EQ(read(folder_ / "de/vectors.csv"), read(folder_ / "en/vectors.csv"));
}

TEST_F(LanguageSystem, MeasuredMotion) {
  ASSERT_EQ(
      run("motion circle iwf-bc --plane XY --center 0,0,150 --error EC0Y=30urad --tool-length "
          "150 --dialect fanuc --out bar7")
          .exit_code,
      0);
  expect_german("motion trace bar7/trace.csv --plane XY --length 150", "motion.html", "motion.json",
                20, 8);
  // A test that is run again, and its set-up sheet for programs.
  expect_german("motion run bar7/test.toml", "motion.html", "motion.json", 20, 8);
  EXPECT_EQ(
      run("motion circle iwf-bc --plane XY --center 0,0,150 --tool-length 150 --dialect fanuc "
          "--error EC0Y=30urad --out de" +
          std::string(kGermanInch))
          .exit_code,
      0);
  EXPECT_EQ(read(folder_ / "de/setup.csv"), read(folder_ / "bar7/setup.csv"));
  ASSERT_EQ(run("motion line zx-yac --axis X --targets=-180,-97,-31,42 --out line").exit_code, 0);
  expect_german("motion trace line/trace.csv --axis X", "motion.html", "motion.json", 12, 7);
  ASSERT_EQ(run("motion touch ac-probe --noise 0.35um --out touch").exit_code, 0);
  expect_german("motion trace touch/touches.csv --machine ac-probe --noise 0.35um", "motion.html",
                "motion.json", 15, 5);
}

TEST_F(LanguageSystem, ProbedPart) {
  ASSERT_EQ(run("program cone --machine iwf-bc --chord-tolerance 1 --out piece").exit_code, 0);
  expect_german("motion probe piece/job.toml --error EX0C=10um --noise 0.35um", "motion.html",
                "motion.json", 15, 7);
}

}  // namespace
}  // namespace frustum
