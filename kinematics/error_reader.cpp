// Reads error shapes as people write them: on the command line and in the [errors] table of a job.
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "kinematics/geometric_errors.hpp"

namespace frustum::kinematics {
namespace {

constexpr const char* kForms =
    "write NAME=VALUE, for example EB0C=30urad, \"EXX=linear 10um\" or "
    "\"EYX=harmonic 1 10um over 0mm..200mm phase 90deg\"";

bool is_bare_number(const std::string& word) {
  const auto parsed = parse_quantity(word);
  return parsed && parsed->kind == UnitKind::none;
}

bool is_keyword(const std::string& word) {
  return word == "over" || word == "phase" || word == "zero" || word == "linear" ||
         word == "harmonic" || word == "constant";
}

// Words of the text; "10 um" counts as one.
std::vector<std::string> words_of(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    const bool unit = std::isalpha(static_cast<unsigned char>(word.front())) != 0 ||
                      static_cast<unsigned char>(word.front()) > 127;
    const bool after_order = words.size() == 2 && words[0] == "harmonic";
    if (unit && !is_keyword(word) && !words.empty() && !after_order &&
        is_bare_number(words.back())) {
      words.back() += word;
    } else {
      words.push_back(word);
    }
  }
  return words;
}

// Reads the words of one term from left to right.
class TermReader {
 public:
  explicit TermReader(std::string_view text) : words_(words_of(text)) {}

  Result<ErrorShape> read() {
    ErrorShape shape;
    if (take("linear")) {
      shape.kind = ErrorShape::Kind::linear;
    } else if (take("harmonic")) {
      shape.kind = ErrorShape::Kind::harmonic;
      shape.order = static_cast<int>(quantity(UnitKind::none, "the order of the harmonic").value);
      if (!(shape.order >= 1 && shape.order <= 1000))
        problem("the order of a harmonic is 1 or more");
    } else {
      (void)take("constant");
    }
    shape.amount = quantity(std::nullopt, "an amount with its unit");
    if (shape.amount.kind == UnitKind::none && shape.amount.value != 0.0) {
      problem("the amount has no unit");
    }
    while (next_ < words_.size() && problem_.empty()) {
      if (shape.kind != ErrorShape::Kind::constant && take("over")) {
        shape.span = span();
      } else if (shape.kind == ErrorShape::Kind::harmonic && take("phase")) {
        shape.phase = quantity(UnitKind::angle, "the phase as an angle").value;
      } else if (shape.kind == ErrorShape::Kind::linear && take("zero")) {
        shape.zero = quantity(std::nullopt, "the position of the zero").value;
      } else {
        problem(fmt::format("'{}' is not understood here", words_[next_]));
      }
    }
    if (!problem_.empty()) return error(problem_, kForms);
    return shape;
  }

 private:
  bool take(std::string_view word) {
    if (next_ >= words_.size() || words_[next_] != word) return false;
    ++next_;
    return true;
  }

  void problem(std::string text) {
    if (problem_.empty()) problem_ = std::move(text);
  }

  ParsedQuantity quantity(std::optional<UnitKind> kind, const char* what) {
    if (next_ >= words_.size()) {
      problem(fmt::format("{} is missing", what));
      return {1.0, UnitKind::none};
    }
    const auto parsed = parse_quantity(words_[next_++]);
    if (!parsed) {
      problem(parsed.error().front().message);
      return {1.0, UnitKind::none};
    }
    if (kind && parsed->kind != *kind) problem(fmt::format("expected {}", what));
    return *parsed;
  }

  AxisRange span() {
    const std::string word = next_ < words_.size() ? words_[next_++] : "";
    const auto dots = word.find("..");
    if (dots != std::string::npos) {
      const auto lo = parse_quantity(word.substr(0, dots));
      const auto hi = parse_quantity(word.substr(dots + 2));
      if (lo && hi && lo->kind != UnitKind::none && hi->kind == lo->kind && lo->value < hi->value) {
        return {lo->value, hi->value};
      }
    }
    problem(fmt::format("'over {}' is not a span such as 0mm..200mm", word));
    return {0.0, 1.0};
  }

  std::vector<std::string> words_;
  std::size_t next_ = 0;
  std::string problem_;
};

std::optional<double> position_in(const TomlTable& table, std::string_view key) {
  if (!table.has(key)) return std::nullopt;
  const ParsedQuantity q = table.quantity(key);
  if (q.kind == UnitKind::none)
    table.fail(key, "needs a unit", "for example \"10 mm\" or \"15 deg\"");
  return q.value;
}

ParsedQuantity amount_in(const TomlTable& table, std::string_view key) {
  const ParsedQuantity q = table.quantity(key);
  if (q.kind == UnitKind::none && q.value != 0.0) {
    table.fail(key, "needs a unit", "for example \"10 um\" or \"30 urad\"");
  }
  return q;
}

std::optional<AxisRange> span_in(const TomlTable& table) {
  const std::vector<std::string> ends = table.texts_or("span", {});
  if (!table.has("span")) return std::nullopt;
  if (ends.size() == 2) {
    const auto lo = parse_quantity(ends[0]);
    const auto hi = parse_quantity(ends[1]);
    if (lo && hi && lo->kind != UnitKind::none && lo->kind == hi->kind && lo->value < hi->value) {
      return AxisRange{lo->value, hi->value};
    }
  }
  table.fail("span", "expected two increasing positions with units",
             "span = [\"0 mm\", \"200 mm\"]");
  return std::nullopt;
}

ErrorShape table_shape(const TomlTable& table) {
  ErrorShape shape{.kind = ErrorShape::Kind::table};
  const auto positions = table.numbers("table");
  const auto values = table.numbers("values");
  const std::size_t position_unit = table.choice("position_unit", {"mm", "deg"});
  const std::size_t value_unit = table.choice("value_unit", {"um", "urad"});
  if (positions.size() != values.size() || positions.size() < 2) {
    table.fail("values", fmt::format("{} positions and {} values", positions.size(), values.size()),
               "give as many values as positions, at least two");
    return shape;
  }
  shape.amount.kind = value_unit == 0 ? UnitKind::length : UnitKind::angle;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (i > 0 && !(positions[i] > positions[i - 1])) {
      table.fail("table", fmt::format("position {} follows {}", positions[i], positions[i - 1]),
                 "positions must increase");
      return shape;
    }
    const double q = position_unit == 0 ? positions[i] : positions[i] * kRadPerDeg;
    shape.points.emplace_back(q, values[i] * (value_unit == 0 ? 1e-3 : 1e-6));
  }
  return shape;
}

ErrorShape shape_in(const TomlTable& table) {
  ErrorShape shape;
  if (table.has("table")) return table_shape(table);
  if (table.has("linear")) {
    shape.kind = ErrorShape::Kind::linear;
    shape.amount = amount_in(table, "linear");
    shape.zero = position_in(table, "zero");
    shape.span = span_in(table);
  } else if (table.has("harmonic")) {
    shape.kind = ErrorShape::Kind::harmonic;
    shape.order = static_cast<int>(table.integer("harmonic", Bound::positive));
    shape.amount = amount_in(table, "amplitude");
    shape.phase = table.angle_or("phase", {}).value;
    shape.span = span_in(table);
  } else {
    shape.amount = amount_in(table, "value");
  }
  return shape;
}

std::string written(const ErrorShape& shape) {
  const bool length = shape.amount.kind == UnitKind::length;
  const std::string amount =
      fmt::format("{:.6g} {}", shape.amount.value * (length ? 1e3 : 1e6), length ? "um" : "urad");
  switch (shape.kind) {
    case ErrorShape::Kind::linear:
      return "linear " + amount;
    case ErrorShape::Kind::harmonic:
      return fmt::format("harmonic {} {}", shape.order, amount);
    case ErrorShape::Kind::table:
      return fmt::format("table of {} points", shape.points.size());
    case ErrorShape::Kind::constant:
      break;
  }
  return amount;
}

}  // namespace

Result<ErrorEntry> parse_error(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    return error(fmt::format("'{}' is not an error", text), kForms);
  }
  std::string name(text.substr(0, equals));
  name.erase(name.find_last_not_of(" \t") + 1);
  name.erase(0, name.find_first_not_of(" \t"));
  std::string value(text.substr(equals + 1));
  ErrorEntry entry{name, value, {}};
  std::size_t start = 0;
  while (start != std::string::npos) {
    const std::size_t plus = value.find(" + ", start);
    const std::size_t length = plus == std::string::npos ? plus : plus - start;
    auto shape = TermReader(value.substr(start, length)).read();
    if (!shape) {
      Diagnostic failure = shape.error().front();
      failure.message = fmt::format("error {} = {}: {}", name, value, failure.message);
      return failure;
    }
    entry.terms.push_back(*std::move(shape));
    start = plus == std::string::npos ? plus : plus + 3;
  }
  return entry;
}

std::vector<ErrorEntry> read_errors(const TomlTable& table) {
  std::vector<ErrorEntry> entries;
  for (const std::string& name : table.keys()) {
    ErrorEntry entry{name, {}, {}};
    if (table.is_table(name)) {
      entry.terms.push_back(shape_in(table.table(name)));
    } else if (table.is_array(name)) {
      for (const TomlTable& term : table.tables(name)) entry.terms.push_back(shape_in(term));
    } else {
      entry.written = table.text(name);
      auto parsed = parse_error(name + "=" + entry.written);
      if (!parsed) {
        table.fail(name, parsed.error().front().message, parsed.error().front().hint);
        continue;
      }
      entry = *parsed;
    }
    if (entry.written.empty()) {
      for (const ErrorShape& shape : entry.terms) {
        entry.written += (entry.written.empty() ? "" : " + ") + written(shape);
      }
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace frustum::kinematics
