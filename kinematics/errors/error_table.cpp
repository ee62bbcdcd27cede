#include "kinematics/errors/error_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/counted.hpp"
#include "kinematics/errors/harmonic_order.hpp"
#include "kinematics/errors/measured_errors.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/model/structure_code.hpp"

namespace frustum::kinematics {
namespace {

constexpr const char* kShapeKeys =
    "value, linear, polynomial, harmonic, cyclic, reversal, tent, table, surface or csv";

double position_scale(AxisLetter axis) { return is_rotary(axis) ? kRadPerDeg : 1.0; }

bool increase(const TomlTable& table, std::string_view key, const std::vector<double>& positions) {
  for (std::size_t i = 1; i < positions.size(); ++i) {
    if (positions[i] > positions[i - 1]) continue;
    table.fail(key, "not-increasing"_id,
               fmt::format("position {} follows {}", positions[i], positions[i - 1]),
               "positions must increase");
    return false;
  }
  return true;
}

// One shape of an [errors] table.
class ShapeReader {
 public:
  ShapeReader(const TomlTable& table, const DrawnQuantities& drawn)
      : table_(table), drawn_(drawn) {}

  ErrorShape read() {
    if (table_.has("table")) {
      read_table();
    } else if (table_.has("surface")) {
      read_surface();
    } else {
      read_formula();
    }
    if (const auto factor = table_.table_if("times")) read_factor(*factor);
    return shape_;
  }

 private:
  using Kind = ErrorShape::Kind;

  void read_formula() {
    for (const Kind kind : {Kind::linear, Kind::polynomial, Kind::harmonic, Kind::cyclic,
                            Kind::reversal, Kind::tent}) {
      if (table_.has(name_of(kind))) shape_.kind = kind;
    }
    switch (shape_.kind) {
      case Kind::linear:
        shape_.amount = amount("linear");
        shape_.zero = position("zero");
        break;
      case Kind::polynomial:
        for (const std::string& text : table_.texts_or("polynomial", {})) {
          shape_.coefficients.push_back(parsed("polynomial", text));
          const UnitKind kind = shape_.coefficients.back().kind;
          if (kind != UnitKind::none) shape_.amount.kind = kind;
        }
        if (shape_.coefficients.empty())
          table_.fail("polynomial", "error-table"_id, "expected coefficients",
                      "polynomial = [\"1 um\", \"-2 um\"]");
        break;
      case Kind::harmonic:
        read_order();
        shape_.amount = amount("amplitude");
        break;
      case Kind::cyclic:
        shape_.amount = amount("cyclic");
        shape_.period = position("period").value_or(0.0);
        if (!(shape_.period > 0.0))
          table_.fail("period", "error-table"_id, "a cyclic error needs its period",
                      "period = \"5 mm\"");
        break;
      case Kind::reversal:
        shape_.amount = amount("reversal");
        shape_.settle = position("settle");
        break;
      case Kind::tent:
        shape_.amount = amount("tent");
        shape_.peak = parsed("at", table_.text("at"));
        place("at", shape_.peak.kind);
        break;
      default:
        if (!table_.has("value"))
          table_.fail("", "error-table"_id, "an error needs a shape", kShapeKeys);
        else
          shape_.amount = amount("value");
        return;
    }
    if (shape_.kind == Kind::harmonic || shape_.kind == Kind::cyclic) read_phase();
    if (shape_.kind != Kind::cyclic && shape_.kind != Kind::reversal) read_span();
  }

  void read_order() {
    const std::int64_t order = table_.integer("harmonic", Bound::positive);
    shape_.order = static_cast<int>(std::clamp<std::int64_t>(order, 1, kHighestHarmonic));
    if (order > kHighestHarmonic) {
      table_.fail("harmonic", "error-table"_id,
                  fmt::format("the order of a harmonic is a whole number from 1 to {}, is {}",
                              kHighestHarmonic, order));
    }
  }

  void read_phase() {
    if (!table_.has("phase")) return;
    if (table_.is_number("phase")) {
      shape_.phase = {.value = table_.angle("phase").value, .kind = UnitKind::angle};
      return;
    }
    shape_.phase = parsed("phase", table_.text("phase"));
    if (shape_.phase.kind != UnitKind::angle)
      table_.fail("phase", "error-kind"_id, "expected an angle");
  }

  Amount parsed(std::string_view key, const std::string& text) {
    auto amount = parse_amount(text, drawn_);
    if (amount) return *std::move(amount);
    if (!text.empty()) table_.fail(key, amount.error().front());
    return {};
  }

  Amount amount(std::string_view key) {
    Amount read;
    if (table_.is_number(key)) {
      const ParsedQuantity q = table_.quantity(key);
      read = {.value = q.value, .kind = q.kind};
    } else {
      read = parsed(key, table_.text(key));
    }
    if (read.kind == UnitKind::none && (read.value != 0.0 || !read.drawn.empty())) {
      table_.fail(key, "unit-missing"_id, "needs a unit", "for example \"10 um\" or \"30 urad\"");
    }
    return read;
  }

  void place(std::string_view key, UnitKind kind) {
    if (kind == UnitKind::none)
      table_.fail(key, "unit-missing"_id, "needs a unit", "for example \"10 mm\" or \"15 deg\"");
    if (shape_.position_kind != UnitKind::none && kind != shape_.position_kind)
      table_.fail(key, "unit-mixed"_id, "positions in mm and in degrees are mixed");
    shape_.position_kind = kind;
  }

  std::optional<double> position(std::string_view key) {
    if (!table_.has(key)) return std::nullopt;
    const ParsedQuantity q = table_.quantity(key);
    place(key, q.kind);
    return q.value;
  }

  void read_span() {
    if (!table_.has("span")) return;
    const std::vector<std::string> ends = table_.texts_or("span", {});
    const auto range = ends.size() == 2 ? parse_range(ends[0] + ".." + ends[1]) : std::nullopt;
    if (!range || range->first.kind == UnitKind::none) {
      table_.fail("span", "error-table"_id, "expected two increasing positions with units",
                  "span = [\"0 mm\", \"200 mm\"]");
      return;
    }
    place("span", range->first.kind);
    shape_.span = AxisRange{range->first.value, range->second.value};
  }

  double value_scale() {
    const std::size_t unit = table_.choice("value_unit", {"um", "urad"});
    shape_.amount.kind = unit == 0 ? UnitKind::length : UnitKind::angle;
    return unit == 0 ? 1.0 / kUmPerMm : 1.0 / kUradPerRad;
  }

  void read_table() {
    shape_.kind = Kind::table;
    const auto positions = table_.numbers("table");
    const auto values = table_.numbers("values");
    const bool degrees = table_.choice("position_unit", {"mm", "deg"}) == 1;
    const double scale = value_scale();
    shape_.position_kind = degrees ? UnitKind::angle : UnitKind::length;
    shape_.interpolation =
        static_cast<TableKind>(table_.choice_or("interpolation", {"linear", "cubic"}, 0));
    shape_.periodic = table_.boolean_or("periodic", false);
    if (positions.size() != values.size() || positions.size() < 2) {
      table_.fail("values", "error-table"_id,
                  fmt::format("{} and {}", counted(positions.size(), "position"),
                              counted(values.size(), "value")),
                  "give as many values as positions, at least two");
      return;
    }
    if (!increase(table_, "table", positions)) return;
    if (shape_.periodic && values.front() != values.back()) {
      table_.fail("values", "error-table"_id, "the last value of a periodic table is its first",
                  "the table covers one whole period");
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
      shape_.points.emplace_back(degrees ? positions[i] * kRadPerDeg : positions[i],
                                 values[i] * scale);
    }
  }

  // surface = ["A", "C"], first = [..], second = [..], values = [[..], ..]
  void read_surface() {
    shape_.kind = Kind::surface;
    SurfaceTerm& surface = shape_.surface;
    const std::vector<std::string> names = table_.texts_or("surface", {});
    surface.second = surface.first;
    if (names.size() == 2 && axis_named(names[0]) && axis_named(names[1])) {
      surface.first = axis_named(names[0]).value_or(surface.first);
      surface.second = axis_named(names[1]).value_or(surface.first);
    }
    surface.first_positions = table_.numbers("first");
    surface.second_positions = table_.numbers("second");
    const double scale = value_scale();
    const auto rows =
        table_.rows("values", std::max<std::size_t>(1, surface.second_positions.size()));
    if (surface.first == surface.second) {
      table_.fail("surface", "error-table"_id, "expected two axes", "surface = [\"A\", \"C\"]");
      return;
    }
    if (surface.first_positions.size() < 2 || surface.second_positions.size() < 2) {
      table_.fail("first", "error-table"_id,
                  "a surface needs at least two positions of either axis");
      return;
    }
    if (!increase(table_, "first", surface.first_positions) ||
        !increase(table_, "second", surface.second_positions)) {
      return;
    }
    if (rows.size() != surface.first_positions.size()) {
      table_.fail("values", "wrong-size"_id,
                  fmt::format("{} for {} of {}", counted(rows.size(), "row"),
                              counted(surface.first_positions.size(), "position"), names[0]),
                  "a row of values for each position of the first axis");
      return;
    }
    for (double& q : surface.first_positions) q *= position_scale(surface.first);
    for (double& q : surface.second_positions) q *= position_scale(surface.second);
    for (const auto& row : rows) {
      for (const double v : row) surface.values.push_back(v * scale);
    }
  }

  void read_factor(const TomlTable& table) {
    const auto axis = axis_named(table.text("axis"));
    const auto positions = table.numbers("table");
    const auto values = table.numbers("values");
    if (!axis) {
      table.fail("axis", "error-table"_id, "expected an axis letter");
      return;
    }
    if (positions.size() != values.size() || positions.size() < 2) {
      table.fail("values", "error-table"_id,
                 fmt::format("{} and {}", counted(positions.size(), "position"),
                             counted(values.size(), "value")),
                 "give as many values as positions, at least two");
      return;
    }
    if (!increase(table, "table", positions)) return;
    AxisFactor factor{*axis, {}};
    for (std::size_t i = 0; i < positions.size(); ++i) {
      factor.points.emplace_back(positions[i] * position_scale(*axis), values[i]);
    }
    shape_.factor = std::move(factor);
  }

  const TomlTable& table_;
  const DrawnQuantities& drawn_;
  ErrorShape shape_;
};

// The keys of one [errors] table.
class ErrorsReader {
 public:
  ErrorsReader(const TomlTable& table, const FileFinder& find, bool in_error_file)
      : table_(table), find_(find), in_error_file_(in_error_file) {}

  ErrorList read() {
    read_drawn();
    if (table_.has("file")) read_file();
    if (table_.has("etalon")) {
      add(read_calibration(table_.file_path("etalon")));
    }
    for (const std::string& file : table_.texts_or("csv", {})) {
      add(read_error_csv(table_.folder() / file));
    }
    for (const std::string& name : table_.keys()) {
      if (is_option(name)) continue;
      add_entry(name);
    }
    if (table_.has("grid")) read_grid();
    if (table_.has("datum")) read_datum();
    return std::move(list_);
  }

 private:
  static bool is_option(std::string_view key) {
    constexpr std::array kOptions{"drawn", "file", "csv", "etalon", "grid", "datum"};
    return std::find(kOptions.begin(), kOptions.end(), key) != kOptions.end();
  }

  void add(Result<std::vector<ErrorEntry>> entries) {
    if (!entries) {
      list_.problems.insert(list_.problems.end(), entries.error().begin(), entries.error().end());
      return;
    }
    for (ErrorEntry& entry : *entries) put(std::move(entry));
  }

  void put(ErrorEntry entry) {
    std::erase_if(list_.entries, [&](const ErrorEntry& e) { return e.name == entry.name; });
    list_.entries.push_back(std::move(entry));
  }

  void read_drawn() {
    const auto drawn = table_.table_if("drawn");
    if (!drawn) return;
    for (const std::string& name : drawn->keys()) {
      const std::string text = drawn->text(name);
      if (text.empty()) continue;
      if (const auto distribution = parse_distribution(text)) {
        drawn_.emplace(name, *distribution);
      } else {
        drawn->fail(name, distribution.error().front());
      }
    }
  }

  void read_file() {
    if (in_error_file_) {
      table_.fail("file", "error-table"_id, "an error file does not name another one",
                  "only a job does");
      return;
    }
    const std::filesystem::path file =
        find_ ? find_(table_.text("file"), table_.folder()) : table_.file_path("file");
    auto other = load_error_file(file);
    if (!other) {
      list_.problems.insert(list_.problems.end(), other.error().begin(), other.error().end());
      return;
    }
    list_ = *std::move(other);
  }

  void add_entry(const std::string& name) {
    ErrorEntry entry{.name = name};
    if (table_.is_table(name)) {
      const TomlTable shape = table_.table(name);
      if (shape.has("csv")) return add_csv(name, shape);
      entry.terms.push_back(ShapeReader(shape, drawn_).read());
    } else if (table_.is_array(name)) {
      for (const TomlTable& term : table_.tables(name)) {
        entry.terms.push_back(ShapeReader(term, drawn_).read());
      }
    } else {
      const std::string text = table_.text(name);
      auto parsed = parse_error(name + "=" + text, drawn_);
      if (!parsed) {
        table_.fail(name, parsed.error().front());
        return;
      }
      entry = *std::move(parsed);
    }
    if (entry.written.empty()) entry.written = written(entry.terms);
    put(std::move(entry));
  }

  // { csv = "exx.csv", interpolation = "cubic" }
  void add_csv(const std::string& name, const TomlTable& shape) {
    const auto wanted = ErrorName::parse(name);
    const auto kind =
        static_cast<TableKind>(shape.choice_or("interpolation", {"linear", "cubic"}, 0));
    auto entries = read_error_csv(shape.file_path("csv"));
    if (!entries) return add(std::move(entries));
    for (ErrorEntry& entry : *entries) {
      if (!wanted || entry.name != wanted->text()) continue;
      entry.name = name;
      entry.terms.front().interpolation = kind;
      return put(std::move(entry));
    }
    shape.fail("csv", "unknown-column"_id, fmt::format("the file has no column {}", name));
  }

  void read_grid() {
    auto grid = VolumetricGrid::load(table_.file_path("grid"));
    if (!grid) {
      list_.problems.insert(list_.problems.end(), grid.error().begin(), grid.error().end());
      return;
    }
    const auto n = grid->size();
    put({.name = "grid",
         .written = fmt::format("{} x {} x {} points", n[0], n[1], n[2]),
         .grid = std::make_shared<const VolumetricGrid>(*std::move(grid))});
  }

  void read_datum() {
    ErrorEntry entry{.name = "datum"};
    for (const std::string& text : table_.texts_or("datum", {})) {
      const auto axis = axis_named(text);
      if (!axis || is_rotary(*axis)) {
        table_.fail("datum", "reference-axes"_id, fmt::format("'{}' is not a linear axis", text),
                    "the primary and the secondary reference axis: datum = [\"Y\", \"Z\"]");
        return;
      }
      entry.datum.push_back(*axis);
      entry.written += (entry.written.empty() ? "" : ", ") + text;
    }
    if (entry.datum.size() != 2 || entry.datum[0] == entry.datum[1]) {
      table_.fail("datum", "reference-axes"_id, "expected two different linear axes",
                  "the primary and the secondary reference axis: datum = [\"Y\", \"Z\"]");
      return;
    }
    put(std::move(entry));
  }

  const TomlTable& table_;
  const FileFinder& find_;
  bool in_error_file_;
  DrawnQuantities drawn_;
  ErrorList list_;
};

}  // namespace

ErrorList read_errors(const TomlTable& table, const FileFinder& find) {
  return ErrorsReader(table, find, false).read();
}

Result<ErrorList> load_error_file(const std::filesystem::path& file) {
  const auto document = TomlDocument::load(file);
  if (!document) return document.error();
  const TomlTable& root = document->root();
  ErrorFileHead head{.file = file,
                     .title = root.text("title"),
                     .source = root.text_or("source", ""),
                     .machine = root.text("machine"),
                     .structure = root.text_or("structure", "")};
  if (!head.structure.empty()) {
    if (const auto parsed = parse_structure(head.structure); !parsed)
      root.fail("structure", parsed.error().front());
  }
  const TomlTable errors = root.table("errors");
  const FileFinder beside;
  ErrorList list = ErrorsReader(errors, beside, true).read();
  for (ErrorEntry& entry : list.entries) {
    if (entry.file.empty()) entry.file = file.string();
  }
  list.files.push_back(std::move(head));
  Diagnostics problems = document->finish();
  problems.insert(problems.end(), list.problems.begin(), list.problems.end());
  if (has_error(problems)) return problems;
  return list;
}

std::optional<Diagnostic> mismatch(const ErrorFileHead& file, const Machine& machine) {
  if (file.structure.empty()) return std::nullopt;
  const auto structure = parse_structure(file.structure);
  if (!structure) return std::nullopt;
  const auto check = [&](const std::vector<AxisLetter>& axes,
                         int side) -> std::optional<Diagnostic> {
    for (const AxisLetter axis : axes) {
      const Joint* joint = machine.joint(axis);
      if (joint != nullptr && joint->side == side) continue;
      const std::string lacks = joint == nullptr
                                    ? fmt::format("has no axis {}", to_char(axis))
                                    : fmt::format("carries {} on the other side", to_char(axis));
      Diagnostic problem =
          error("error-table"_id,
                fmt::format("the errors are written for {} ({}); machine {} ({}) {}", file.machine,
                            file.structure, machine.name(), machine.structure(), lacks),
                "errors belong to the machine they were found on");
      problem.file = file.file.string();
      problem.key = "structure";
      return problem;
    }
    return std::nullopt;
  };
  if (auto problem = check(structure->tool, +1)) return problem;
  return check(structure->work, -1);
}

}  // namespace frustum::kinematics
