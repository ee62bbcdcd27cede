#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/counted.hpp"
#include "core/spelling.hpp"
#include "core/toml_document.hpp"
#include "core/toml_node.hpp"

namespace frustum {
namespace {

using toml_detail::joined;
using toml_detail::Node;
using toml_detail::State;

std::optional<double> as_number(const Node& node) {
  if (const auto* whole = std::get_if<std::int64_t>(&node.value))
    return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&node.value);
      real != nullptr && std::isfinite(*real)) {
    return *real;
  }
  return std::nullopt;
}

const char* kind_of(const Node& node) {
  constexpr const char* kNames[] = {"a date", "true/false", "a whole number", "a number",
                                    "text",   "an array",   "a table"};
  if (std::holds_alternative<double>(node.value) && !as_number(node)) return "inf or nan";
  return kNames[node.value.index()];
}

}  // namespace

Diagnostic toml_detail::placed(const State& state, const Node& table, const std::string& path,
                               std::string_view key, Diagnostic diagnostic) {
  diagnostic.file = state.file.string();
  diagnostic.key = joined(path, key);
  const Node* child = table.table()->find(key);
  const Node& place = child != nullptr ? *child : table;
  diagnostic.line = place.line;
  diagnostic.column = place.column;
  return diagnostic;
}

TomlTable::TomlTable(std::shared_ptr<State> state, const Node* node, std::string path)
    : state_(std::move(state)), node_(node), path_(std::move(path)) {
  if (node_ != nullptr && node_->table() != nullptr) node_->table()->opened = true;
}

const Node* TomlTable::find(std::string_view key, bool required) const {
  if (node_ == nullptr) return nullptr;
  const Node::Table& table = *node_->table();
  table.asked.emplace(key);
  if (const Node* found = table.find(key)) return found;
  if (required) fail(key, "missing-key"_id, "this key is missing");
  return nullptr;
}

void TomlTable::fail(std::string_view key, std::string message, std::string hint) const {
  fail(key, "bad-value"_id, std::move(message), std::move(hint));
}

void TomlTable::fail(std::string_view key, const Diagnostic& found) const {
  fail(key, found.id, found.message, found.hint);
}

void TomlTable::fail(std::string_view key, DiagnosticId id, std::string message,
                     std::string hint) const {
  if (node_ == nullptr) return;  // the table is missing, which has been reported
  Diagnostic failure =
      placed(*state_, *node_, path_, key, frustum::error(id, std::move(message), std::move(hint)));
  const bool is_new = state_->noted.emplace(failure.key, failure.message).second;
  if (is_new) state_->diagnostics.push_back(std::move(failure));
}

bool TomlTable::is_sound() const {
  return std::ranges::none_of(state_->diagnostics, [&](const Diagnostic& d) {
    const bool here = path_.empty() || d.key == path_ || d.key.starts_with(path_ + '.');
    return here && d.severity == Severity::error;
  });
}

bool TomlTable::has(std::string_view key) const { return find(key, false) != nullptr; }

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> names;
  if (node_ == nullptr) return names;
  for (const auto& [name, child] : node_->table()->entries) names.push_back(name);
  return names;
}

std::string TomlTable::text(std::string_view key) const {
  const Node* node = find(key, true);
  if (node == nullptr) return {};
  if (const auto* text = std::get_if<std::string>(&node->value)) return *text;
  fail(key, "wrong-type"_id, fmt::format("expected text, found {}", kind_of(*node)));
  return {};
}

std::string TomlTable::text_or(std::string_view key, std::string_view fallback) const {
  return has(key) ? text(key) : std::string(fallback);
}

std::size_t TomlTable::choice(std::string_view key, const std::vector<std::string>& choices) const {
  const Node* node = find(key, true);
  if (node == nullptr) return 0;
  const std::string word = text(key);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == word) return i;
  }
  if (std::holds_alternative<std::string>(node->value)) {
    const auto nearest = nearest_word(word, choices);
    fail(key, "unknown-choice"_id, fmt::format("'{}' is not one of the choices", word),
         fmt::format("{}choices: {}", nearest ? "did you mean " + *nearest + "? " : "",
                     fmt::join(choices, ", ")));
  }
  return 0;
}

std::size_t TomlTable::choice_or(std::string_view key, const std::vector<std::string>& choices,
                                 std::size_t fallback) const {
  return has(key) ? choice(key, choices) : fallback;
}

double TomlTable::bounded(std::string_view key, double value, Bound bound) const {
  if (bound == Bound::positive && !(value > 0.0)) {
    fail(key, "out-of-range"_id, fmt::format("must be greater than 0, is {:g}", value));
  } else if (bound == Bound::non_negative && !(value >= 0.0)) {
    fail(key, "out-of-range"_id, fmt::format("must not be negative, is {:g}", value));
  }
  return value;
}

double TomlTable::number(std::string_view key, Bound bound) const {
  const Node* node = find(key, true);
  if (node == nullptr) return 1.0;
  if (const auto value = as_number(*node)) return bounded(key, *value, bound);
  fail(key, "wrong-type"_id, fmt::format("expected a finite number, found {}", kind_of(*node)));
  return 1.0;
}

double TomlTable::number_or(std::string_view key, double fallback, Bound bound) const {
  return has(key) ? number(key, bound) : fallback;
}

std::int64_t TomlTable::integer(std::string_view key, Bound bound) const {
  const Node* node = find(key, true);
  if (node == nullptr) return 1;
  if (const auto* whole = std::get_if<std::int64_t>(&node->value)) {
    bounded(key, static_cast<double>(*whole), bound);
    return *whole;
  }
  fail(key, "wrong-type"_id, fmt::format("expected a whole number, found {}", kind_of(*node)));
  return 1;
}

std::int64_t TomlTable::integer_or(std::string_view key, std::int64_t fallback, Bound bound) const {
  return has(key) ? integer(key, bound) : fallback;
}

bool TomlTable::boolean_or(std::string_view key, bool fallback) const {
  const Node* node = find(key, false);
  if (node == nullptr) return fallback;
  if (const auto* flag = std::get_if<bool>(&node->value)) return *flag;
  fail(key, "wrong-type"_id, fmt::format("expected true or false, found {}", kind_of(*node)));
  return fallback;
}

std::optional<ParsedQuantity> TomlTable::read_quantity(std::string_view key) const {
  const Node* node = find(key, true);
  if (node == nullptr) return std::nullopt;
  if (const auto value = as_number(*node)) return ParsedQuantity{*value, UnitKind::none};
  if (const auto* text = std::get_if<std::string>(&node->value)) {
    const auto parsed = parse_quantity(*text);
    if (parsed) return *parsed;
    fail(key, parsed.error().front());
    return std::nullopt;
  }
  fail(key, "wrong-type"_id,
       fmt::format("expected a number or text with a unit, found {}", kind_of(*node)));
  return std::nullopt;
}

ParsedQuantity TomlTable::quantity(std::string_view key) const {
  return read_quantity(key).value_or(ParsedQuantity{});
}

double TomlTable::scaled(std::string_view key, UnitKind kind, double bare_number_scale,
                         Bound bound) const {
  const std::optional<ParsedQuantity> parsed = read_quantity(key);
  if (!parsed) return 1.0;
  // Judged as written.
  if (parsed->kind == UnitKind::none) return bounded(key, parsed->value, bound) * bare_number_scale;
  if (parsed->kind == kind) return bounded(key, parsed->value, bound);
  fail(key, "wrong-unit"_id,
       kind == UnitKind::length ? "expected a length, found an angle"
                                : "expected an angle, found a length",
       kind == UnitKind::length ? "units: mm um nm m in" : "units: deg rad mrad urad arcsec");
  return 1.0;
}

Mm TomlTable::length(std::string_view key, Bound bound) const {
  return {scaled(key, UnitKind::length, 1.0, bound)};
}
Mm TomlTable::length_or(std::string_view key, Mm fallback, Bound bound) const {
  return has(key) ? length(key, bound) : fallback;
}
Rad TomlTable::angle(std::string_view key, Bound bound) const {
  return {scaled(key, UnitKind::angle, kRadPerDeg, bound)};
}
Rad TomlTable::angle_or(std::string_view key, Rad fallback, Bound bound) const {
  return has(key) ? angle(key, bound) : fallback;
}

std::vector<double> TomlTable::numbers(std::string_view key) const {
  const Node* node = find(key, true);
  std::vector<double> values;
  if (node == nullptr) return values;
  if (const Node::Array* items = node->array()) {
    for (const Node& item : *items) {
      if (const auto value = as_number(item)) {
        values.push_back(*value);
      } else {
        fail(key, "wrong-type"_id,
             fmt::format("expected finite numbers only, found {}", kind_of(item)));
        return values;
      }
    }
    return values;
  }
  fail(key, "wrong-type"_id, fmt::format("expected an array of numbers, found {}", kind_of(*node)));
  return values;
}

std::vector<std::vector<double>> TomlTable::rows(std::string_view key, std::size_t width) const {
  const Node* node = find(key, true);
  if (node == nullptr) return {};
  const std::string expected =
      fmt::format("expected a list of rows of {} each", counted(width, "number"));
  const Node::Array* items = node->array();
  if (items == nullptr) {
    fail(key, "wrong-type"_id, fmt::format("{}, found {}", expected, kind_of(*node)));
    return {};
  }
  std::vector<std::vector<double>> rows;
  for (const Node& item : *items) {
    std::vector<double> row;
    if (const Node::Array* cells = item.array()) {
      for (const Node& cell : *cells) {
        if (const auto value = as_number(cell)) row.push_back(*value);
      }
      if (row.size() == width && cells->size() == width) {
        rows.push_back(std::move(row));
        continue;
      }
    }
    fail(key, "wrong-type"_id, fmt::format("{}; row {} is not", expected, rows.size() + 1));
    return {};
  }
  return rows;
}

Vec3 TomlTable::vector(std::string_view key) const {
  const std::size_t before = state_->diagnostics.size();
  const std::vector<double> values = numbers(key);
  if (values.size() != 3) {
    if (state_->diagnostics.size() == before) {
      fail(key, "wrong-type"_id,
           fmt::format("expected three numbers [x, y, z], found {}", values.size()));
    }
    return Vec3::Zero();
  }
  // No machine is so large, and sums and squares of what is smaller are finite.
  constexpr double kLargest = 1e15;
  const Vec3 vector(values[0], values[1], values[2]);
  if (vector.cwiseAbs().maxCoeff() <= kLargest) return vector;
  fail(key, "out-of-range"_id,
       fmt::format("must be within 1e15, is [{}]", fmt::join(values, ", ")));
  return Vec3::Zero();
}

Vec3 TomlTable::vector_or(std::string_view key, const Vec3& fallback) const {
  return has(key) ? vector(key) : fallback;
}

std::vector<std::string> TomlTable::texts_or(std::string_view key,
                                             std::vector<std::string> fallback) const {
  const Node* node = find(key, false);
  if (node == nullptr) return fallback;
  std::vector<std::string> words;
  const Node::Array* items = node->array();
  if (items == nullptr) {
    fail(key, "wrong-type"_id, fmt::format("expected an array of texts, found {}", kind_of(*node)));
    return words;
  }
  for (const Node& item : *items) {
    if (const auto* text = std::get_if<std::string>(&item.value)) {
      words.push_back(*text);
    } else {
      fail(key, "wrong-type"_id, fmt::format("expected texts only, found {}", kind_of(item)));
    }
  }
  return words;
}

bool TomlTable::is_table(std::string_view key) const {
  const Node* node = find(key, false);
  return node != nullptr && node->table() != nullptr;
}

bool TomlTable::is_array(std::string_view key) const {
  const Node* node = find(key, false);
  return node != nullptr && node->array() != nullptr;
}

bool TomlTable::is_number(std::string_view key) const {
  const Node* node = find(key, false);
  return node != nullptr && as_number(*node).has_value();
}

TomlTable TomlTable::table(std::string_view key) const {
  const Node* node = find(key, true);
  if (node != nullptr && node->table() == nullptr) {
    fail(key, "wrong-type"_id, fmt::format("expected a table, found {}", kind_of(*node)));
    node = nullptr;
  }
  return {state_, node, joined(path_, key)};
}

std::optional<TomlTable> TomlTable::table_if(std::string_view key) const {
  if (!has(key)) return std::nullopt;
  return table(key);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  const Node* node = find(key, false);
  std::vector<TomlTable> found;
  if (node == nullptr) return found;
  const Node::Array* items = node->array();
  if (items == nullptr) {
    fail(key, "wrong-type"_id, fmt::format("expected an array of tables, found {}", kind_of(*node)),
         fmt::format("write [[{}]]", joined(path_, key)));
    return found;
  }
  for (std::size_t i = 0; i < items->size(); ++i) {
    if ((*items)[i].table() == nullptr) {
      fail(key, "wrong-type"_id,
           fmt::format("expected tables only, found {}", kind_of((*items)[i])));
      continue;
    }
    found.push_back(
        TomlTable(state_, &(*items)[i], fmt::format("{}[{}]", joined(path_, key), i + 1)));
  }
  return found;
}

std::filesystem::path TomlTable::folder() const { return state_->file.parent_path(); }

std::filesystem::path TomlTable::file_path(std::string_view key) const {
  const std::filesystem::path written = text(key);
  return written.is_absolute() ? written : state_->file.parent_path() / written;
}

}  // namespace frustum
