#include "cutter/body/cutter_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "cutter/body/cutter.hpp"
#include "cutter/body/tool_table.hpp"
#include "kinematics/model/number_table.hpp"
#include "parser/language/letter_case.hpp"

namespace frustum::cutter {
namespace {

// Measured points have no arcs: a height and a radius.
std::size_t width_of(std::string_view key) { return key == "points" ? 2 : 3; }

std::vector<CutterRow> read_rows(const TomlTable& table, std::string_view key) {
  std::vector<CutterRow> rows;
  for (const auto& row : table.rows(key, width_of(key))) {
    rows.push_back({row[0], row[1], row.size() > 2 ? row[2] : 0.0});
  }
  return rows;
}

// A measured profile in a file of its own: columns Z and R, with units.
std::optional<std::vector<CutterRow>> read_measured(const TomlTable& table) {
  if (!table.has("file")) return std::nullopt;
  std::vector<CutterRow> rows;
  const auto file = table.file_path("file");
  const auto numbers = kinematics::read_number_table(file);
  if (!numbers) {
    const Diagnostic& why = numbers.error().front();
    table.fail("file", why.id, fmt::format("{}: {}", file.string(), why.message), why.hint);
    return rows;
  }
  const auto* z = numbers->column("Z");
  const auto* r = numbers->column("R");
  if (z == nullptr || r == nullptr || z->unit != UnitKind::length || r->unit != UnitKind::length) {
    table.fail("file", "cutter-profile"_id,
               fmt::format("{} has no columns of heights and radii", file.string()),
               "its first line is Z_mm,R_mm");
    return rows;
  }
  for (std::size_t i = 0; i < z->values.size(); ++i) {
    rows.push_back({z->values[i], r->values[i], 0.0});
  }
  return rows;
}

void read_key(const TomlTable& table, const CutterKey& key, CutterSpec& spec) {
  if (const auto* length = std::get_if<Mm CutterSpec::*>(&key.value)) {
    Mm& value = spec.**length;
    const bool known = !key.required || value.value != 0.0;
    value = known ? table.length_or(key.name, value, key.bound) : table.length(key.name, key.bound);
  } else if (const auto* angle = std::get_if<Rad CutterSpec::*>(&key.value)) {
    Rad& value = spec.**angle;
    const bool known = !key.required || value.value != 0.0;
    value = known ? table.angle_or(key.name, value, key.bound) : table.angle(key.name, key.bound);
  } else {
    auto& rows = spec.*std::get<std::vector<CutterRow> CutterSpec::*>(key.value);
    std::optional<std::vector<CutterRow>> from_file;
    if (key.name == "points") from_file = read_measured(table);
    if (from_file) {
      rows = *std::move(from_file);
    } else if (table.has(key.name) || (key.required && rows.empty())) {
      rows = read_rows(table, key.name);
    }
  }
}

std::vector<std::string> type_names() {
  std::vector<std::string> names;
  for (const CutterTypeRow& row : cutter_types()) names.emplace_back(row.name);
  return names;
}

// In the order of CutterHand.
std::vector<std::string> hand_names() { return {"right", "left"}; }

std::optional<int> tool_number(const std::string& key) {
  const bool whole =
      !key.empty() && key.size() < 6 && key.find_first_not_of("0123456789") == std::string::npos;
  const int number = whole ? std::stoi(key) : 0;
  return number > 0 ? std::optional(number) : std::nullopt;
}

std::string rows_text(const std::vector<CutterRow>& rows, std::size_t width) {
  std::vector<std::string> all;
  for (const CutterRow& row : rows) {
    all.push_back(fmt::format("[{}]", fmt::join(row.begin(), row.begin() + width, ", ")));
  }
  return fmt::format("[{}]", fmt::join(all, ", "));
}

std::optional<std::string> value_text(const CutterSpec& spec, const CutterKey& key) {
  if (const auto* length = std::get_if<Mm CutterSpec::*>(&key.value)) {
    const double value = (spec.**length).value;
    // The error that people try first: a place to write it.
    if (value == 0.0 && key.name == "radius_error") return "\"0 um\"";
    if (value == 0.0) return std::nullopt;
    return fmt::format("{}", value);
  }
  if (const auto* angle = std::get_if<Rad CutterSpec::*>(&key.value)) {
    const double value = (spec.**angle).value;
    if (value == 0.0) return std::nullopt;
    return fmt::format("\"{} rad\"", value);
  }
  const auto& rows = spec.*std::get<std::vector<CutterRow> CutterSpec::*>(key.value);
  if (rows.empty()) return std::nullopt;
  return rows_text(rows, width_of(key.name));
}

// Programs call a tool by its name, in which capitals and small letters are the same. Remarks of a
// tool table may be there twice as long as no program calls them. `keys`: of the tools in the file.
void check_names(const TomlTable& tools, const std::map<int, std::string>& keys,
                 const ToolList& all) {
  const auto is_named = [&](int number) {
    const auto key = keys.find(number);
    return key != keys.end() && tools.table(key->second).has("name");
  };
  std::map<std::string, int> named;
  for (const auto& [number, spec] : all) {
    if (spec.name.empty()) continue;
    const auto [first, is_new] = named.emplace(parser::upper_case(spec.name), number);
    if (is_new) continue;
    const bool at_this = is_named(number);
    if (!at_this && !is_named(first->second)) continue;
    const int wrong = at_this ? number : first->second;
    const int other = at_this ? first->second : number;
    tools.table(keys.at(wrong))
        .fail("name", "tool-name"_id,
              fmt::format("tool.{} has the name \"{}\" too", other, all.at(other).name),
              "programs call tools by their names, in which capitals and small letters are the "
              "same: give each its own");
  }
}

}  // namespace

CutterSpec read_cutter(const TomlTable& table, const std::optional<CutterSpec>& base) {
  CutterSpec spec = base.value_or(CutterSpec{});
  const std::size_t type =
      base ? table.choice_or("type", type_names(), static_cast<std::size_t>(spec.type))
           : table.choice("type", type_names());
  spec.type = static_cast<CutterType>(type);
  spec.name = table.text_or("name", spec.name);
  spec.hand = static_cast<CutterHand>(
      table.choice_or("hand", hand_names(), static_cast<std::size_t>(spec.hand)));
  for (const CutterKey& key : type_row(spec.type).keys) read_key(table, key, spec);
  for (const CutterKey& key : common_keys()) read_key(table, key, spec);
  return spec;
}

ToolList read_tools(const TomlTable& tools, ToolList base) {
  const bool on_library = !base.empty();
  std::map<int, std::string> seen;
  for (const std::string& key : tools.keys()) {
    const TomlTable table = tools.table(key);
    const auto number = tool_number(key);
    if (!number) {
      tools.fail(key, "tool-number"_id, "a tool is named by its number", "for example tool.1");
      continue;
    }
    if (const auto [first, is_new] = seen.emplace(*number, key); !is_new) {
      tools.fail(key, "tool-number"_id, fmt::format("tool {} is described twice", *number),
                 fmt::format("first as tool.{}", first->second));
      continue;
    }
    const auto known = base.find(*number);
    if (on_library && known == base.end() && !table.has("type")) {
      std::vector<int> numbers;
      for (const auto& [n, spec] : base) numbers.push_back(n);
      tools.fail(
          key, "unknown-tool"_id, fmt::format("the tool library has no tool {} to change", *number),
          fmt::format("it has {}; a tool of the job's own needs a type", fmt::join(numbers, ", ")));
      for (const std::string& inner : table.keys()) static_cast<void>(table.has(inner));
      continue;
    }
    const std::optional<CutterSpec> start =
        known == base.end() ? std::nullopt : std::optional(known->second);
    CutterSpec spec = read_cutter(table, start);
    if (table.is_sound()) {
      if (const auto made = Cutter::make(spec); !made) {
        tools.fail(key, made.error().front());
      }
    }
    base.insert_or_assign(*number, std::move(spec));
  }
  check_names(tools, seen, base);
  return base;
}

Result<ToolList> load_tool_library(const std::filesystem::path& file) {
  if (file.extension() == ".tbl") return load_tool_table(file);
  auto document = TomlDocument::load(file);
  if (!document) return document.error();
  static_cast<void>(document->root().text_or("title", ""));
  ToolList tools = read_tools(document->root().table("tool"));
  Diagnostics problems = document->finish();
  if (has_error(problems)) return problems;
  for (const auto& [number, spec] : tools) {
    const auto made = Cutter::make(spec);
    if (made) continue;
    for (Diagnostic d : made.error()) {
      d.file = file.string();
      d.key = fmt::format("tool.{}", number);
      problems.push_back(std::move(d));
    }
  }
  if (has_error(problems)) return problems;
  return tools;
}

std::string cutter_text(const CutterSpec& spec) {
  const CutterTypeRow& row = type_row(spec.type);
  std::string text = fmt::format("{{ type = \"{}\"", row.name);
  if (!spec.name.empty()) text += fmt::format(", name = {}", toml_text(spec.name));
  if (spec.hand != CutterHand::right) {
    text +=
        fmt::format(", hand = {}", toml_text(hand_names()[static_cast<std::size_t>(spec.hand)]));
  }
  std::vector<std::string_view> written;
  const auto write = [&](std::span<const CutterKey> keys) {
    for (const CutterKey& key : keys) {
      if (std::find(written.begin(), written.end(), key.name) != written.end()) continue;
      written.push_back(key.name);
      if (const auto value = value_text(spec, key))
        text += fmt::format(", {} = {}", key.name, *value);
    }
  };
  write(row.keys);
  write(common_keys());
  return text + " }";
}

}  // namespace frustum::cutter
