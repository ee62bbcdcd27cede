#include <fmt/format.h>

#include <cmath>

#include "core/toml_document.hpp"
#include "metrology/inspection_plan.hpp"
#include "metrology/plan_check.hpp"
#include "metrology/plan_names.hpp"

namespace frustum::metrology {
namespace {

template <std::size_t N>
std::vector<std::string> words(const std::array<std::string_view, N>& names) {
  return {names.begin(), names.end()};
}

int count(const TomlTable& table, std::string_view key) {
  const std::int64_t value = table.integer(key, Bound::positive);
  // A million points on one circle are a slip of the pen, and would not fit an int times sections.
  if (value > 1000000) table.fail(key, fmt::format("must be at most 1000000, is {}", value));
  return static_cast<int>(std::min<std::int64_t>(value, 1000000));
}

constexpr Rad kTurn{2.0 * std::numbers::pi};

Strategy read_strategy(const TomlTable& table, FeatureKind kind) {
  if (kind == FeatureKind::line) {
    return LineStrategy{table.length("from").value, table.length("to").value,
                        count(table, "points")};
  }
  if (kind != FeatureKind::plane) {
    SectionStrategy s;
    s.sections = table.numbers("sections");
    s.points_per_section = count(table, "points_per_section");
    s.start_angle = table.angle_or("start_angle", {}).value;
    s.sweep = table.angle_or("sweep", kTurn).value;
    return s;
  }
  if (table.has("u") || table.has("v")) {
    return GridStrategy{table.vector("u"), table.vector("v"), count(table, "columns"),
                        count(table, "rows")};
  }
  RingStrategy s;
  s.rings = table.numbers("rings");
  s.points_per_ring = count(table, "points_per_ring");
  s.start_angle = table.angle_or("start_angle", {}).value;
  s.sweep = table.angle_or("sweep", kTurn).value;
  return s;
}

Extent read_extent(const TomlTable& table, FeatureKind kind) {
  if (kind != FeatureKind::plane) {
    return AxialExtent{table.length("from").value, table.length("to").value};
  }
  if (table.has("u") || table.has("v")) {
    return RectangleExtent{table.vector("u"), table.vector("v")};
  }
  return RadialExtent{table.length_or("inner", {}, Bound::non_negative).value,
                      table.length("outer").value};
}

PlannedFeature read_feature(const TomlTable& table) {
  PlannedFeature f;
  f.name = table.text("name");
  f.kind = static_cast<FeatureKind>(table.choice("kind", words(kFeatureNames)));
  f.point = table.vector("point");
  f.axis = table.vector("axis");
  if (f.kind == FeatureKind::cylinder || f.kind == FeatureKind::circle) {
    f.radius = table.length("radius", Bound::positive).value;
  }
  if (f.kind == FeatureKind::cone) {
    f.radius = table.length("section_radius", Bound::positive).value;
    f.half_angle = table.angle("half_angle", Bound::positive).value;
  }
  if (f.kind == FeatureKind::line) {
    f.normal = table.vector("normal");
  } else {
    if (f.kind != FeatureKind::plane) {
      f.side = static_cast<Side>(table.choice_or("side", words(kSideNames), 0));
    }
    if (table.has("zero")) f.zero = table.vector("zero");
  }
  f.strategy = read_strategy(table.table("strategy"), f.kind);
  if (const auto extent = table.table_if("extent")) f.extent = read_extent(*extent, f.kind);
  return f;
}

double read_tolerance(const TomlTable& table, CharacteristicKind kind) {
  const bool angle = is_angle(kind);
  const ParsedQuantity tolerance = table.quantity("tolerance");
  if (table.has("tolerance") && tolerance.kind == UnitKind::none) {
    table.fail("tolerance", "a tolerance needs a unit",
               angle ? "write for example \"600 urad\"" : "write for example \"8 um\"");
    return 1.0;
  }
  return angle ? table.angle("tolerance", Bound::positive).value
               : table.length("tolerance", Bound::positive).value;
}

std::vector<std::size_t> read_sections(const TomlTable& table) {
  if (table.has("section")) {
    return {static_cast<std::size_t>(table.integer("section", Bound::non_negative))};
  }
  std::vector<std::size_t> sections;
  if (!table.has("sections")) return sections;
  for (const double value : table.numbers("sections")) {
    if (value < 0.0 || value != std::floor(value)) {
      table.fail("sections", fmt::format("a section is a whole number from 0, found {}", value));
      return sections;
    }
    sections.push_back(static_cast<std::size_t>(value));
  }
  return sections;
}

PlannedCharacteristic read_characteristic(const TomlTable& table) {
  PlannedCharacteristic c;
  c.name = table.text("name");
  c.kind = static_cast<CharacteristicKind>(table.choice("kind", words(kCharacteristicNames)));
  if (table.has("features")) {
    c.features = table.texts_or("features", {});
  } else {
    c.features = {table.text("feature")};
  }
  c.sections = read_sections(table);
  c.tolerance = read_tolerance(table, c.kind);
  if (table.has("frame")) {
    c.frame = table.text("frame");
    if (c.frame.empty()) table.fail("frame", "must not be empty", "leave it out for none");
  }
  if (compares_lines(c.kind) || table.has("direction")) c.direction = table.vector("direction");
  return c;
}

PlannedFrame read_frame(const TomlTable& table) {
  PlannedFrame frame;
  frame.name = table.text("name");
  if (!table.has("planes")) table.fail("planes", "this key is missing");
  frame.planes = table.texts_or("planes", {});
  frame.line = table.text("line");
  return frame;
}

Result<InspectionPlan> read_plan(const TomlDocument& document) {
  const TomlTable& root = document.root();
  InspectionPlan plan;
  plan.title = root.text_or("title", "");
  plan.alignment = static_cast<Alignment>(root.choice_or("alignment", words(kAlignmentNames), 0));
  plan.decision = read_decision(root);
  if (const auto how = root.table_if("uncertainty")) plan.monte_carlo = read_monte_carlo(*how);
  const TomlTable probe = root.table("probe");
  plan.probe.ball_diameter = probe.length("ball_diameter", Bound::positive).value;
  plan.probe.clearance =
      probe.length_or("clearance", {plan.probe.clearance}, Bound::positive).value;
  plan.probe.reach = probe.length_or("reach", {plan.probe.reach}, Bound::positive).value;
  const auto datum = root.table_if("datum");
  if (datum) {
    plan.datum = DatumSystem{datum->text("primary"), datum->text("secondary"),
                             datum->text_or("tertiary", "")};
  }
  const std::vector<TomlTable> frames = root.tables("frame");
  for (const TomlTable& table : frames) plan.frames.push_back(read_frame(table));
  const std::vector<TomlTable> features = root.tables("feature");
  for (const TomlTable& table : features) plan.features.push_back(read_feature(table));
  const std::vector<TomlTable> characteristics = root.tables("characteristic");
  for (const TomlTable& table : characteristics) {
    plan.characteristics.push_back(read_characteristic(table));
  }
  if (Diagnostics found = document.finish(); has_error(found)) return found;
  check(plan, [&](PlanPart part, std::size_t index, std::string_view key, std::string message,
                  std::string hint) {
    const TomlTable& table = part == PlanPart::probe            ? probe
                             : part == PlanPart::datum          ? *datum
                             : part == PlanPart::frame          ? frames[index]
                             : part == PlanPart::feature        ? features[index]
                             : part == PlanPart::characteristic ? characteristics[index]
                                                                : root;
    table.fail(key, std::move(message), std::move(hint));
  });
  if (Diagnostics found = document.finish(); has_error(found)) return found;
  return plan;
}

}  // namespace

Result<InspectionPlan> load_plan(const std::filesystem::path& file) {
  auto document = TomlDocument::load(file);
  if (!document) return std::move(document).error();
  return read_plan(*document);
}

Result<InspectionPlan> parse_plan(std::string_view text, const std::filesystem::path& file) {
  auto document = TomlDocument::parse(text, file);
  if (!document) return std::move(document).error();
  return read_plan(*document);
}

}  // namespace frustum::metrology
