// Shapes of errors, in words and in tables: their values along the axis.
#include "kinematics/errors/error_shape.hpp"
#include "kinematics/errors/error_assignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/toml_document.hpp"
#include "kinematics/errors/error_table.hpp"
#include "kinematics/path/approach_direction.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

using std::numbers::pi;

constexpr double kUm = 1e-3, kUrad = 1e-6;

std::string shape_problem(const std::string& text, const std::string& machine = "iwf-bc") {
  const auto entry = parse_error(text);
  if (!entry) return entry.error().front().message;
  const auto errors = resolve(shipped(machine), std::vector{*entry});
  return errors ? "accepted" : errors.error().front().message;
}

double value_of(const GeometricErrors& errors, const std::string& name, const AxisState& at) {
  const ErrorName error = *ErrorName::parse(name);
  return errors[error.axis].component[static_cast<std::size_t>(error.direction)](error.axis, at);
}

double shape_value_at(const std::string& text, const AxisState& at,
                      const std::string& machine = "iwf-bc") {
  const auto entry = parse_error(text);
  if (!entry) ADD_FAILURE() << entry.error().front().message;
  const auto errors = resolve(shipped(machine), std::vector{*entry});
  if (!errors) ADD_FAILURE() << errors.error().front().message;
  return value_of(*errors, entry->name, at);
}

AxisState at(AxisLetter axis, double q, double heading = 0.0) {
  AxisState state;
  state.q[axis] = q;
  state.heading[axis] = heading;
  return state;
}

ErrorList read(const std::string& toml, Diagnostics* problems = nullptr) {
  const auto document = TomlDocument::parse(toml, "errors.toml");
  if (!document) {
    ADD_FAILURE() << document.error().front().message;
    return {};
  }
  ErrorList list = read_errors(document->root().table("errors"));
  const Diagnostics found = document->finish();
  if (problems != nullptr) {
    *problems = found;
  } else if (has_error(found)) {
    ADD_FAILURE() << to_string(found.front());
  }
  return list;
}

TEST(ErrorShape, CyclicErrorsCountTheirPeriodFromZero) {
  const auto x = AxisLetter::X;
  const double expected = 2 * kUm * std::cos(2 * pi * 1.3 / 5.0 + pi / 6);
  EXPECT_NEAR(shape_value_at("EXX=cyclic 2um period 5mm phase 30deg", at(x, 1.3)), expected, 1e-15);
  EXPECT_NEAR(shape_value_at("EXX=cyclic 2um period 5mm phase 30deg", at(x, 101.3)), expected,
              1e-14);
  EXPECT_NEAR(shape_value_at("EBB=cyclic 4urad period 10deg", at(AxisLetter::B, 5 * pi / 180)),
              -4 * kUrad, 1e-18);
}

TEST(ErrorShape, PolynomialsAreOfTheCoordinateFromMinusToPlusOneOverTheSpan) {
  const std::string text = "EXX=polynomial 1um 2um -3um over -100mm..300mm";
  for (const double q : {-100.0, 100.0, 150.0, 300.0}) {
    const double t = (q - 100.0) / 200.0;
    EXPECT_NEAR(shape_value_at(text, at(AxisLetter::X, q)), (1 + 2 * t - 3 * t * t) * kUm, 1e-15)
        << q;
  }
}

// The part lags behind its own motion: a tool-side axis by -h/2 times the direction of approach of
// q; a workpiece-side one moves by -q, so that its lag shows as +h/2; dvf5000 turns B by +q
// although the work hangs on it.
TEST(ErrorShape, AReversalLagsBehindTheMotionOfThePart) {
  EXPECT_DOUBLE_EQ(shape_value_at("EYY=reversal 10um", at(AxisLetter::Y, 3.0, +1.0)), -5 * kUm);
  EXPECT_DOUBLE_EQ(shape_value_at("EYY=reversal 10um", at(AxisLetter::Y, 3.0, -1.0)), +5 * kUm);
  EXPECT_DOUBLE_EQ(shape_value_at("EXX=reversal 10um", at(AxisLetter::X, 3.0, +1.0)), +5 * kUm);
  EXPECT_DOUBLE_EQ(shape_value_at("EBB=reversal 4urad", at(AxisLetter::B, 0.3, +1.0)), +2 * kUrad);
  EXPECT_DOUBLE_EQ(shape_value_at("EBB=reversal 4urad", at(AxisLetter::B, 0.3, +1.0), "dvf5000"),
                   -2 * kUrad);
  EXPECT_DOUBLE_EQ(shape_value_at("EXX=reversal 10um", at(AxisLetter::X, 3.0)), 0.0);
}

TEST(ErrorShape, AnAxisHasOneSettlingDistance) {
  const auto resolved = [](std::vector<std::string> texts) {
    std::vector<ErrorEntry> entries;
    for (const std::string& text : texts) entries.push_back(*parse_error(text));
    return resolve(shipped("iwf-bc"), entries);
  };
  const auto one = resolved({"EXX=reversal 4um settle 0.01mm", "EYX=reversal 1um"});
  ASSERT_TRUE(one);
  EXPECT_DOUBLE_EQ((*one)[AxisLetter::X].lost_motion, 0.01);
  EXPECT_TRUE(one->depends_on_direction());
  const auto two = resolved({"EXX=reversal 4um settle 0.01mm", "EYX=reversal 1um settle 0.02mm"});
  ASSERT_FALSE(two);
  EXPECT_EQ(two.error().front().message,
            "error EYX: X takes up its play over another distance than in EXX");
  EXPECT_EQ(shape_problem("EXX=reversal 4um settle 0.01mm + reversal 1um settle 0.02mm"),
            "error EXX: two take-up distances of X");
  // A replaced entry leaves nothing behind.
  EXPECT_TRUE(resolved({"EXX=reversal 4um settle 0.01mm", "EXX=reversal 1um settle 0.02mm"}));
}

TEST(ErrorShape, ATentRisesToItsPeakAndFalls) {
  const auto tent = [](double deg) {
    return shape_value_at("EZC=tent 8um at -90deg over -360deg..0deg",
                          at(AxisLetter::C, deg * pi / 180));
  };
  EXPECT_NEAR(tent(-360), 0.0, 1e-18);
  EXPECT_NEAR(tent(-225), 4 * kUm, 1e-15);
  EXPECT_NEAR(tent(-90), 8 * kUm, 1e-15);
  EXPECT_NEAR(tent(-45), 4 * kUm, 1e-15);
  EXPECT_NEAR(tent(77), 0.0, 1e-18);
}

TEST(ErrorShape, AFactorOfAnotherAxisMultipliesAShape) {
  const std::string text =
      "EXC=harmonic 1 2um over 0deg..360deg times B -90deg:2.5 0deg:0.5 90deg:2.5";
  AxisState state;
  state.q[AxisLetter::C] = 1.1;
  state.q[AxisLetter::B] = -30 * pi / 180;
  EXPECT_NEAR(shape_value_at(text, state), 2 * kUm * std::cos(1.1) * (0.5 + 30.0 / 45.0), 1e-15);
}

TEST(ErrorShape, TermsAddUpWhateverTheirShape) {
  const AxisState state = at(AxisLetter::X, 40.0, -1.0);
  const double sum = shape_value_at("EXX=reversal 2um + cyclic 1um period 30mm + 3um", state);
  EXPECT_NEAR(sum, (-1.0 + std::cos(2 * pi * 40 / 30) + 3.0) * kUm, 1e-15);
}

TEST(ErrorShape, CubicTablesPassTheirPointsSmoothlyAndDoNotOvershoot) {
  const std::vector<std::pair<double, double>> points{{0, 0}, {10, 1}, {20, 1}, {30, 4}, {40, 3}};
  const ErrorFunction f({TableTerm::of(points, TableKind::cubic, false)});
  const auto value = [&](double q) { return f(AxisLetter::X, at(AxisLetter::X, q)); };
  for (const auto& [q, v] : points) EXPECT_NEAR(value(q), v, 1e-14);
  for (double q = -5.0; q < 45.0; q += 0.1) {
    EXPECT_GE(value(q), -1e-12);
    EXPECT_LE(value(q), 4.0 + 1e-12);
  }
  EXPECT_NEAR(value(15.0), 1.0, 1e-14);
  const double h = 1e-6;  // the slope is continuous at the points
  for (const double q : {10.0, 20.0, 30.0}) {
    EXPECT_NEAR((value(q + h) - value(q)) / h, (value(q) - value(q - h)) / h, 1e-5) << q;
  }
  EXPECT_DOUBLE_EQ(value(-3.0), 0.0);
  EXPECT_DOUBLE_EQ(value(99.0), 3.0);
  // Cubic tables of a straight line are the line.
  const ErrorFunction line({TableTerm::of({{0, 0}, {1, 2}, {5, 10}}, TableKind::cubic, false)});
  EXPECT_NEAR(line(AxisLetter::X, at(AxisLetter::X, 3.7)), 7.4, 1e-14);
}

TEST(ErrorShape, PeriodicTablesRepeat) {
  for (const TableKind kind : {TableKind::linear, TableKind::cubic}) {
    const ErrorFunction f({TableTerm::of({{0, 1}, {2, 4}, {5, 0}, {6, 1}}, kind, true)});
    for (const double q : {-13.0, 0.3, 5.9}) {
      EXPECT_NEAR(f(AxisLetter::X, at(AxisLetter::X, q)),
                  f(AxisLetter::X, at(AxisLetter::X, q + 12.0)), 1e-12);
    }
  }
}

TEST(ErrorShape, SurfacesAreBilinearInTwoAxesAndHeldAtTheirEdges) {
  const ErrorList list = read(R"([errors]
[errors.EXC]
surface = ["B", "C"]
first = [0, 90]
second = [0, 180, 360]
value_unit = "um"
values = [[1, 2, 1], [3, 6, 3]]
)");
  const auto errors = resolve(shipped("iwf-bc"), list.entries);
  ASSERT_TRUE(errors);
  const auto value = [&](double b, double c) {
    AxisState state;
    state.q[AxisLetter::B] = b * pi / 180;
    state.q[AxisLetter::C] = c * pi / 180;
    return value_of(*errors, "EXC", state) / kUm;
  };
  EXPECT_NEAR(value(0, 90), 1.5, 1e-12);
  EXPECT_NEAR(value(45, 90), 3.0, 1e-12);
  EXPECT_NEAR(value(45, 270), 3.0, 1e-12);
  EXPECT_NEAR(value(200, -50), 3.0, 1e-12);
  EXPECT_EQ(list.entries.front().written, "surface of 2 x 3 points over B and C");
}

TEST(ErrorShape, TablesOfAJobSayTheSameAsWords) {
  const ErrorList list = read(R"([errors]
EXX = { linear = "10 um", span = ["0 mm", "200 mm"], zero = "20 mm" }
EYX = { harmonic = 2, amplitude = "3 um", phase = "40 deg" }
EZX = { polynomial = ["1 um", "-2 um"], span = ["-100 mm", "100 mm"] }
EXY = [{ cyclic = "2 um", period = "5 mm" }, { value = "1 um" }]
EYY = { reversal = "4 um", settle = "0.01 mm" }
EZC = { tent = "8 um", at = "-90 deg", span = ["-360 deg", "0 deg"] }
EXZ = "30 um"
[errors.EXC]
harmonic = 1
amplitude = "2 um"
span = ["0 deg", "360 deg"]
times = { axis = "B", table = [-90, 0, 90], values = [2.5, 0.5, 2.5] }
)");
  const std::vector<std::string> words{
      "EXX=linear 10um over 0mm..200mm zero 20mm",
      "EYX=harmonic 2 3um phase 40deg",
      "EZX=polynomial 1um -2um over -100mm .. 100mm",
      "EXY=cyclic 2um period 5mm + 1um",
      "EYY=reversal 4um settle 0.01mm",
      "EZC=tent 8um at -90deg over -360deg..0deg",
      "EXC=harmonic 1 2um over 0deg..360deg times B -90deg:2.5 0deg:0.5 90deg:2.5",
      "EXZ=30um"};
  const Machine machine = shipped("iwf-bc");
  const auto from_tables = resolve(machine, list.entries);
  ASSERT_TRUE(from_tables);
  AxisState state;
  state.q[AxisLetter::X] = 77.0;
  state.q[AxisLetter::Y] = -12.0;
  state.q[AxisLetter::B] = 0.4;
  state.q[AxisLetter::C] = -2.0;
  state.heading[AxisLetter::Y] = 1.0;
  for (const std::string& text : words) {
    const auto entry = parse_error(text);
    ASSERT_TRUE(entry) << text;
    const auto errors = resolve(machine, std::vector{*entry});
    ASSERT_TRUE(errors) << text;
    EXPECT_NEAR(value_of(*errors, entry->name, state), value_of(*from_tables, entry->name, state),
                1e-15)
        << text;
  }
}

// 5000 was read as 1000.
TEST(ErrorShape, OrdersThatAreTooHighAreRefusedInTables) {
  const auto document =
      TomlDocument::parse("EXX = { harmonic = 5000, amplitude = \"1 um\" }", "e.toml");
  ASSERT_TRUE(document);
  (void)read_errors(document->root());
  const Diagnostics found = document->finish();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(to_string(found.front()),
            "e.toml:1:9: error: EXX.harmonic: the order of a harmonic is a whole number from 1 to "
            "1000, is 5000");
}

TEST(ErrorShape, WordsNameWhatIsWrong) {
  EXPECT_EQ(shape_problem("EXX=cyclic 2um"),
            "error EXX = cyclic 2um: a cyclic error needs its period, above 0: period 5mm");
  EXPECT_EQ(shape_problem("EXX=cyclic 2um period 5deg"),
            "error EXX = cyclic 2um period 5deg: a position of X is a length");
  EXPECT_EQ(shape_problem("EBB=linear 2urad over 0mm..10mm"),
            "error EBB = linear 2urad over 0mm..10mm: a position of B is an angle");
  EXPECT_EQ(shape_problem("EXX=polynomial over 0mm..10mm"),
            "error EXX = polynomial over 0mm..10mm: a polynomial needs coefficients");
  EXPECT_EQ(shape_problem("EZC=tent 2um over 0deg..90deg"),
            "error EZC = tent 2um over 0deg..90deg: a triangular error needs the place of its "
            "peak: at 90deg");
  EXPECT_EQ(shape_problem("EXX=1um times Q 0mm:1 1mm:2"),
            "error EXX = 1um times Q 0mm:1 1mm:2: 'Q' is not an axis");
  EXPECT_EQ(shape_problem("EXX=1um times A 0deg:1 1deg:2"),
            "error EXX = 1um times A 0deg:1 1deg:2: machine iwf-bc has no axis A");
  EXPECT_EQ(shape_problem("EXX=reversal 2um settle -1mm"),
            "error EXX = reversal 2um settle -1mm: the take-up distance is 0 or more");
}

TEST(ErrorShape, TablesNameWhatIsWrong) {
  const auto first_problem = [](const std::string& entry) {
    Diagnostics problems;
    (void)read("[errors]\n" + entry + "\n", &problems);
    return problems.empty() ? "accepted" : problems.front().key + ": " + problems.front().message;
  };
  EXPECT_EQ(first_problem("EXX = { linaer = \"10 um\" }"), "errors.EXX: an error needs a shape");
  EXPECT_EQ(first_problem("EXX = { table = [0, 5, 5], values = [1, 2, 3], position_unit = \"mm\", "
                          "value_unit = \"um\" }"),
            "errors.EXX.table: position 5 follows 5");
  EXPECT_EQ(first_problem("EXX = { cyclic = \"1 um\" }"),
            "errors.EXX.period: a cyclic error needs its period");
  EXPECT_EQ(first_problem("EXC = { surface = [\"A\", \"A\"], first = [0, 1], second = [0, 1], "
                          "value_unit = \"um\", values = [[1, 2], [3, 4]] }"),
            "errors.EXC.surface: expected two axes");
  EXPECT_EQ(first_problem("datum = [\"Y\"]"), "errors.datum: expected two different linear axes");
}

}  // namespace
}  // namespace frustum::kinematics
