#include "app/motion/test_file.hpp"

#include <fmt/format.h>

#include <array>

#include "app/job/machine_files.hpp"
#include "core/decimal.hpp"
#include "core/made_by.hpp"
#include "core/toml_document.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

std::string list_text(const std::vector<double>& numbers) {
  std::string text;
  for (const double each : numbers) text += (text.empty() ? "" : ",") + shortest_decimal(each);
  return text;
}

// "x,y,z" or "0,30,60" of a list; empty where there is none.
std::string list_or(const TomlTable& table, std::string_view key,
                    const std::string& fallback = {}) {
  if (!table.has(key)) return fallback;
  const auto numbers = table.numbers(key);
  if (numbers.empty()) {
    table.fail(key, "out-of-range"_id, "the list is empty", "numbers, or leave it out");
  }
  return list_text(numbers);
}
std::string list_at(const TomlTable& table, std::string_view key) {
  return list_text(table.numbers(key));
}

// A count within what the command line takes.
int count_or(const TomlTable& table, std::string_view key, int fallback, int least, int most) {
  const std::int64_t count = table.integer_or(key, fallback);
  if (count >= least && count <= most) return static_cast<int>(count);
  table.fail(key, "out-of-range"_id, fmt::format("expected {} to {}, is {}", least, most, count));
  return fallback;
}

std::string read_setup(const TomlTable& root) {
  const auto setup = root.table_if("setup");
  if (!setup) return {};
  std::string text;
  for (const char* name : {"ball", "table_ball", "length"}) {
    const std::string key = std::string(name) + "_um";
    if (!setup->has(key)) continue;
    const bool one = key == "length_um";
    const std::string value =
        one ? shortest_decimal(setup->number(key)) : list_text(setup->numbers(key));
    text += fmt::format("{}{}={}", text.empty() ? "" : ";", name, value);
  }
  return text;
}

void read_common(const TomlTable& root, MotionWords& words) {
  if (const auto machine = find_machine(root.text("machine"), root.folder())) {
    words.machine = machine->string();
  } else {
    root.fail("machine", machine.error().front());
  }
  words.tool_length = root.length_or("tool_length", {0.0}, Bound::non_negative).value;
  words.at = root.text_or("at", "");
  words.setup = read_setup(root);
  if (root.has("program")) {
    words.nc.file = root.file_path("program").string();
    words.nc.run = true;
    words.nc.servo_lag = root.boolean_or("servo_lag", false);
    const std::vector<std::string> known{"fanuc", "linuxcnc", "sinumerik", "heidenhain"};
    if (root.has("dialect")) {
      words.nc.dialect = known[root.choice("dialect", known)];
    }
  }
  words.ball_known = root.boolean_or("ball_known", false);
  if (const auto instrument = root.table_if("instrument")) {
    words.noise = instrument->text_or("noise", "");
    words.resolution = instrument->text_or("resolution", "");
    words.seed = static_cast<std::uint64_t>(instrument->integer_or("seed", 1, Bound::non_negative));
    words.stroke = instrument->length_or("stroke", {1.0}, Bound::positive).value;
  }
  if (const auto errors = root.table_if("errors")) {
    words.of_file = kinematics::read_errors(*errors, find_error_file);
  }
}

void read_feed(const TomlTable& root, MotionWords& words) {
  if (root.has("feed")) words.feed = root.number("feed", Bound::positive);
  words.dynamics = root.text_or("dynamics", words.dynamics);
}
// Of a test that is run from rest to rest.
void read_run(const TomlTable& root, MotionWords& words) {
  read_feed(root, words);
  words.jerk = root.boolean_or("jerk", words.jerk);
}

CircleWords read_circle(const TomlTable& root) {
  CircleWords words;
  words.plane = root.text("plane");
  words.length = root.length_or("length", {150.0}, Bound::positive).value;
  words.centre = list_at(root, "center");
  words.angles = list_or(root, "angles");
  read_feed(root, words);
  return words;
}

RotaryWords read_rotary(const TomlTable& root) {
  RotaryWords words;
  words.axis = root.text("axis");
  words.direction = root.text("direction");
  words.hold = root.text_or("hold", "");
  words.ball = list_at(root, "ball");
  words.length = root.length_or("length", {150.0}, Bound::positive).value;
  words.angles = list_or(root, "angles");
  read_run(root, words);
  return words;
}

ConeMotionWords read_cone(const TomlTable& root) {
  ConeMotionWords words;
  words.cone_angle = as_stated(root.angle("cone_angle").value * kDegPerRad);
  words.inclination = as_stated(root.angle("inclination").value * kDegPerRad);
  words.radius = root.length("radius", Bound::positive).value;
  words.centre = list_at(root, "center");
  words.sense = root.text_or("sense", "normal");
  words.angles = list_or(root, "angles");
  read_run(root, words);
  return words;
}

ChaseWords read_chase(const TomlTable& root) {
  ChaseWords words;
  words.ball = list_at(root, "ball");
  read_run(root, words);
  return words;
}

LineWords read_line(const TomlTable& root) {
  LineWords words;
  words.axis = root.text("axis");
  words.targets = list_at(root, "targets");
  words.runs = count_or(root, "runs", 5, 2, 1000);
  read_run(root, words);
  return words;
}

DiagonalWords read_diagonal(const TomlTable& root) {
  DiagonalWords words;
  words.box = root.text("box");
  words.points = count_or(root, "points", 11, 2, 100000);
  read_run(root, words);
  return words;
}

TouchWords read_touch(const TomlTable& root) {
  TouchWords words;
  words.repeat = count_or(root, "repeat", 1, 1, kMostCalibrations);
  words.lobes.constant = root.text_or("pretravel", "");
  words.lobes.amplitude = root.text_or("lobe", "");
  words.lobes.phase = root.number_or("lobe_phase", 0.0);
  return words;
}

// --- writing -------------------------------------------------------------------------------------

class TestWriter {
 public:
  explicit TestWriter(const std::string& test) { text("test", test); }

  void text(const std::string& key, const std::string& value) {
    if (!value.empty()) out_ += fmt::format("{} = {}\n", key, toml_text(value));
  }
  void number(const std::string& key, double value) {
    out_ += fmt::format("{} = {}\n", key, shortest_decimal(value));
  }
  void yes(const std::string& key) { out_ += key + " = true\n"; }
  void list(const std::string& key, const std::string& numbers) {
    if (!numbers.empty()) out_ += fmt::format("{} = [{}]\n", key, numbers);
  }
  void remark(const std::string& text) { out_ += "# " + text + "\n"; }
  void table(const std::string& name) { out_ += fmt::format("\n[{}]\n", name); }
  [[nodiscard]] std::string toml() const { return out_; }

 private:
  std::string out_{};
};

TestWriter written(const CircleWords& words) {
  TestWriter out("circle");
  out.text("plane", words.plane);
  out.number("length", words.length);
  out.list("center", words.centre);
  out.list("angles", words.angles);
  return out;
}

TestWriter written(const RotaryWords& words) {
  TestWriter out("rotary");
  out.text("axis", words.axis);
  out.text("direction", words.direction);
  out.text("hold", words.hold);
  out.list("ball", words.ball);
  out.number("length", words.length);
  out.list("angles", words.angles);
  return out;
}

TestWriter written(const ConeMotionWords& words) {
  TestWriter out("cone");
  out.number("cone_angle", words.cone_angle);
  out.number("inclination", words.inclination);
  out.number("radius", words.radius);
  out.list("center", words.centre);
  out.text("sense", words.sense);
  out.list("angles", words.angles);
  return out;
}

TestWriter written(const ChaseWords& words) {
  TestWriter out("chase");
  out.list("ball", words.ball);
  return out;
}

TestWriter written(const LineWords& words) {
  TestWriter out("line");
  out.text("axis", words.axis);
  out.list("targets", words.targets);
  out.number("runs", words.runs);
  return out;
}

TestWriter written(const DiagonalWords& words) {
  TestWriter out("diagonal");
  out.text("box", words.box);
  out.number("points", words.points);
  return out;
}

TestWriter written(const TouchWords& words) {
  TestWriter out("touch");
  out.number("repeat", words.repeat);
  out.text("pretravel", words.lobes.constant);
  out.text("lobe", words.lobes.amplitude);
  if (words.lobes.phase != 0.0) out.number("lobe_phase", words.lobes.phase);
  return out;
}

// "ball=10,-5,3;length=2": the keys of [setup].
void write_setup(const std::string& setup, TestWriter& out) {
  if (setup.empty()) return;
  out.table("setup");
  std::size_t from = 0;
  while (from < setup.size()) {
    const std::size_t end = std::min(setup.find(';', from), setup.size());
    const std::string part = setup.substr(from, end - from);
    const auto equals = part.find('=');
    const std::string key = part.substr(0, equals) + "_um", value = part.substr(equals + 1);
    if (key == "length_um") {
      out.number(key, std::stod(value));
    } else {
      out.list(key, value);
    }
    from = end + 1;
  }
}

// "NAME=VALUE" of the command line.
void write_errors(const ErrorWords& errors, const fs::path& folder, TestWriter& out) {
  if (errors.errors.empty() && errors.files.empty()) return;
  out.table("errors");
  for (std::size_t i = 0; i + 1 < errors.files.size(); ++i) {
    out.remark("run with --errors " + errors.files[i]);
  }
  if (errors.draw) out.remark(fmt::format("run with --draw {}", *errors.draw));
  if (!errors.files.empty()) {
    out.text("file", path_from(find_error_file(errors.files.back(), "."), folder));
  }
  for (const std::string& each : errors.errors) {
    const auto equals = each.find('=');
    out.text(each.substr(0, equals), each.substr(equals + 1));
  }
}

}  // namespace

Result<TestFile> read_test_file(const fs::path& file) {
  auto document = TomlDocument::load(file);
  if (!document) return document.error();
  const TomlTable& root = document->root();
  const auto kind =
      root.choice("test", {"circle", "rotary", "cone", "chase", "line", "diagonal", "touch"});
  const std::array<TestWords (*)(const TomlTable&), 7> readers{
      [](const TomlTable& t) -> TestWords { return read_circle(t); },
      [](const TomlTable& t) -> TestWords { return read_rotary(t); },
      [](const TomlTable& t) -> TestWords { return read_cone(t); },
      [](const TomlTable& t) -> TestWords { return read_chase(t); },
      [](const TomlTable& t) -> TestWords { return read_line(t); },
      [](const TomlTable& t) -> TestWords { return read_diagonal(t); },
      [](const TomlTable& t) -> TestWords { return read_touch(t); }};
  TestWords words = readers.at(kind)(root);
  read_common(root, common_words(words));
  common_words(words).in_file = true;
  if (auto problems = document->finish(); has_error(problems)) return problems;
  return TestFile{std::move(words), *std::move(document)};
}

Diagnostics in_test_file(const TestFile& file, Diagnostics problems) {
  const TomlTable& root = file.document.root();
  for (const Diagnostic& each : problems) {
    // Of a program, a machine or a trace, which has its own place.
    if (!each.file.empty()) continue;
    Diagnostic found = each;
    found.key.clear();
    const auto dot = each.key.find('.');
    const auto table =
        dot == std::string::npos ? std::optional(root) : root.table_if(each.key.substr(0, dot));
    if (table) {
      table->fail(each.key.substr(dot == std::string::npos ? 0 : dot + 1), found);
    } else {
      root.fail(each.key, found);
    }
  }
  std::erase_if(problems, [](const Diagnostic& each) { return each.file.empty(); });
  const Diagnostics placed = file.document.finish();
  problems.insert(problems.end(), placed.begin(), placed.end());
  return problems;
}

MotionWords& common_words(TestWords& words) {
  return std::visit([](auto& each) -> MotionWords& { return each; }, words);
}

Result<MotionAnswer> answer_of(const TestWords& words) {
  struct Answers {
    Result<MotionAnswer> operator()(const CircleWords& w) const { return circle_answer(w); }
    Result<MotionAnswer> operator()(const RotaryWords& w) const { return rotary_answer(w); }
    Result<MotionAnswer> operator()(const ConeMotionWords& w) const { return cone_answer(w); }
    Result<MotionAnswer> operator()(const ChaseWords& w) const { return chase_answer(w); }
    Result<MotionAnswer> operator()(const LineWords& w) const { return line_answer(w); }
    Result<MotionAnswer> operator()(const DiagonalWords& w) const { return diagonal_answer(w); }
    Result<MotionAnswer> operator()(const TouchWords& w) const { return touch_answer(w); }
  };
  return std::visit(Answers{}, words);
}

std::string test_toml(const TestWords& words, const fs::path& folder) {
  return std::visit(
      [&folder](const auto& each) {
        TestWriter out = written(each);
        const MotionWords& common = each;
        if (const auto file = find_machine(common.machine, ".")) {
          out.text("machine", name_for_job(*file, folder));
        }
        out.text("at", common.at);
        if (common.feed) out.number("feed", *common.feed);
        if (common.dynamics != "off") out.text("dynamics", common.dynamics);
        if (common.jerk) out.yes("jerk");
        if (common.ball_known) out.yes("ball_known");
        if (!common.nc.file.empty()) {
          out.text("program", path_from(common.nc.file, folder));
          out.text("dialect", common.nc.dialect.empty() ? "fanuc" : common.nc.dialect);
        }
        if (common.tool_length > 0.0) out.number("tool_length", common.tool_length);
        write_setup(common.setup, out);
        out.table("instrument");
        out.text("noise", common.noise);
        out.text("resolution", common.resolution);
        out.number("seed", static_cast<double>(common.seed));
        out.number("stroke", common.stroke);
        write_errors(common.errors, folder, out);
        return "# " + made_by() + "\n" + out.toml();
      },
      words);
}

}  // namespace frustum::app
