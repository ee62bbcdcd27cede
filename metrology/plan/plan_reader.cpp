#include <fmt/format.h>

#include <cmath>

#include "core/spline_surface.hpp"
#include "core/toml_document.hpp"
#include "core/whole_file.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "metrology/plan/plan_check.hpp"
#include "metrology/plan/plan_names.hpp"
#include "metrology/plan/qif/qif_plan.hpp"

namespace frustum::metrology {
namespace {

template <std::size_t N>
std::vector<std::string> words(const std::array<std::string_view, N>& names) {
  return {names.begin(), names.end()};
}

int count(const TomlTable& table, std::string_view key) {
  const std::int64_t value = table.integer(key, Bound::positive);
  // A million points on one circle are a slip of the pen, and would not fit an int times sections.
  if (value > 1000000)
    table.fail(key, "plan-value"_id, fmt::format("must be at most 1000000, is {}", value));
  return static_cast<int>(std::min<std::int64_t>(value, 1000000));
}

constexpr Rad kTurn{2.0 * std::numbers::pi};

// The key `points` or, instead of it, `pitch`; and whether it is a scan.
struct Spacing {
  int points = 0;
  double pitch = 0.0;
  bool scan = false;
};

Spacing spacing_of(const TomlTable& table, std::string_view points) {
  Spacing spacing;
  if (table.has("pitch")) {
    spacing.pitch = table.length("pitch", Bound::positive).value;
    if (table.has(points)) {
      table.fail("pitch", "plan-value"_id, fmt::format("{} and pitch exclude each other", points));
      static_cast<void>(count(table, points));
    }
  } else {
    spacing.points = count(table, points);
  }
  spacing.scan = table.boolean_or("scan", false);
  return spacing;
}

template <typename S>
void read_spacing(const TomlTable& table, std::string_view points, int& number, S& s) {
  const Spacing spacing = spacing_of(table, points);
  number = spacing.points;
  s.pitch = spacing.pitch;
  s.scan = spacing.scan;
}

template <typename S>
void read_sweep(const TomlTable& table, S& s) {
  s.start_angle = table.angle_or("start_angle", {}).value;
  s.sweep = table.angle_or("sweep", kTurn).value;
}

SphereStrategy read_sphere_strategy(const TomlTable& table) {
  SphereStrategy s;
  s.points.clear();
  for (const double value : table.numbers("points")) {
    if (!(value >= 1.0 && value <= 1e6) || value != std::floor(value)) {
      table.fail("points", "plan-value"_id,
                 fmt::format("a number of points is a whole number from 1, found {}", value));
      break;
    }
    s.points.push_back(static_cast<int>(value));
  }
  s.polar_from = table.angle_or("polar_from", Rad{s.polar_from}).value;
  s.polar_to = table.angle_or("polar_to", Rad{s.polar_to}).value;
  s.start_angle = table.angle_or("start_angle", {}).value;
  s.twist = table.angle_or("twist", Rad{s.twist}).value;
  return s;
}

Strategy read_round_strategy(const TomlTable& table) {
  if (table.has("generatrices")) {
    GeneratrixStrategy s;
    s.generatrices = count(table, "generatrices");
    s.from = table.length("from").value;
    s.to = table.length("to").value;
    read_spacing(table, "points", s.points, s);
    read_sweep(table, s);
    return s;
  }
  if (table.has("turns")) {
    SpiralStrategy s;
    s.from = table.length("from").value;
    s.to = table.length("to").value;
    s.turns = table.number("turns");
    read_spacing(table, "points", s.points, s);
    s.start_angle = table.angle_or("start_angle", {}).value;
    return s;
  }
  SectionStrategy s;
  s.sections = table.numbers("sections");
  read_spacing(table, "points_per_section", s.points_per_section, s);
  read_sweep(table, s);
  return s;
}

// Shares of the height and of u; what is left of the material in um.
SurfaceLineStrategy read_surface_lines(const TomlTable& table) {
  SurfaceLineStrategy s;
  s.heights = table.numbers("heights");
  s.points = count(table, "points");
  s.from = table.number("from");
  s.to = table.number("to");
  s.scan = table.boolean_or("scan", false);
  if (table.has("geometric_um")) {
    for (const double um : table.numbers("geometric_um")) s.geometric.push_back(um / kUmPerMm);
  }
  return s;
}

std::vector<Vec3> read_points(const TomlTable& table, std::string_view key) {
  std::vector<Vec3> points;
  for (const std::vector<double>& row : table.rows(key, 3)) {
    points.emplace_back(row[0], row[1], row[2]);
  }
  return points;
}

// Two curves of as many points: v = 0 and v = 1.
NominalNet read_net(const TomlTable& table) {
  const std::vector<Vec3> lower = read_points(table, "lower"), upper = read_points(table, "upper");
  if (!table.is_sound()) return {};
  if (lower.size() < 2 || lower.size() != upper.size()) {
    table.fail("upper", "plan-feature"_id,
               fmt::format("both curves need as many control points, two or more; lower has {}, "
                           "upper has {}",
                           lower.size(), upper.size()));
    return {};
  }
  return {std::make_shared<const SplineSurface>(SplineSurface::ruled(lower, upper))};
}

Strategy read_strategy(const TomlTable& table, FeatureKind kind) {
  if (kind == FeatureKind::ruled) return read_surface_lines(table);
  if (kind == FeatureKind::line) {
    LineStrategy s{table.length("from").value, table.length("to").value};
    read_spacing(table, "points", s.points, s);
    return s;
  }
  if (kind == FeatureKind::sphere && !table.has("sections")) return read_sphere_strategy(table);
  if (kind != FeatureKind::plane) return read_round_strategy(table);
  if (table.has("u") || table.has("v")) {
    GridStrategy s{table.vector("u"), table.vector("v")};
    read_spacing(table, "columns", s.columns, s);
    s.rows = count(table, "rows");
    return s;
  }
  RingStrategy s;
  s.rings = table.numbers("rings");
  read_spacing(table, "points_per_ring", s.points_per_ring, s);
  read_sweep(table, s);
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
  if (f.kind == FeatureKind::ruled) {
    f.net = read_net(table);
    f.strategy = read_strategy(table.table("strategy"), f.kind);
    return f;
  }
  f.point = table.vector("point");
  // A sphere needs a pole only to say where its sections lie.
  f.axis =
      f.kind == FeatureKind::sphere ? table.vector_or("axis", Vec3::UnitZ()) : table.vector("axis");
  if (is_round(f.kind) && f.kind != FeatureKind::cone) {
    f.radius = table.length("radius", Bound::positive).value;
  }
  if (f.kind == FeatureKind::cone) {
    f.radius = table.length("section_radius", Bound::positive).value;
    f.half_angle = table.angle("half_angle", Bound::positive).value;
  }
  if (f.kind == FeatureKind::point) {
    f.strategy = single_touch();
    return f;
  }
  if (f.kind == FeatureKind::line) {
    f.normal = table.vector("normal");
  } else {
    if (is_round(f.kind)) {
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
    table.fail("tolerance", "plan-value"_id, "a tolerance needs a unit",
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
    // Larger than any plan has.
    if (value < 0.0 || value != std::floor(value) || value > 1e6) {
      table.fail("sections", "plan-value"_id,
                 fmt::format("a section is a whole number from 0 to 1000000, found {}", value));
      return sections;
    }
    sections.push_back(static_cast<std::size_t>(value));
  }
  return sections;
}

Criterion read_criterion(const TomlTable& table, std::string_view key) {
  return static_cast<Criterion>(table.choice_or(key, words(kCriterionNames), 0));
}

ProfileFilter read_filter(const TomlTable& table) {
  ProfileFilter filter;
  filter.upr = table.number_or("upr", 0.0, Bound::positive);
  filter.upr_from = table.number_or("upr_from", 0.0, Bound::positive);
  filter.cutoff = table.length_or("cutoff", {}, Bound::positive).value;
  filter.cutoff_long = table.length_or("cutoff_long", {}, Bound::positive).value;
  return filter;
}

// The root's filter is that of all roundnesses and straightnesses that have none of their own: upr
// of closed profiles, cutoff of open ones.
void filter_forms(InspectionPlan& plan, const ProfileFilter& filter) {
  for (PlannedCharacteristic& c : plan.characteristics) {
    if (c.filter || c.seam) continue;
    ProfileFilter own;
    if (c.kind == CharacteristicKind::roundness) {
      own.upr = filter.upr;
      own.upr_from = filter.upr_from;
    } else if (c.kind == CharacteristicKind::straightness) {
      own.cutoff = filter.cutoff;
      own.cutoff_long = filter.cutoff_long;
    }
    if (own != ProfileFilter{}) c.filter = own;
  }
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
    if (c.frame.empty())
      table.fail("frame", "plan-value"_id, "must not be empty", "leave it out for none");
  }
  if (compares_lines(c.kind) || table.has("direction")) c.direction = table.vector("direction");
  c.criterion = read_criterion(table, "criterion");
  c.datum_criterion = read_criterion(table, "datum_criterion");
  if (table.has("parameter")) {
    c.parameter = static_cast<FormParameter>(table.choice("parameter", words(kParameterNames)));
  }
  if (const auto filter = table.table_if("filter")) c.filter = read_filter(*filter);
  if (table.has("harmonics")) c.harmonics = count(table, "harmonics");
  c.floating = table.boolean_or("floating", false);
  c.deviation = table.boolean_or("deviation", false);
  if (table.has("point")) {
    c.point = static_cast<std::size_t>(table.integer("point", Bound::non_negative));
  }
  if (const auto seam = table.table_if("seam")) {
    c.seam = Seam{seam->angle("at").value, seam->angle("within", Bound::positive).value};
  }
  return c;
}

// `best_fit` = "all" names no features: the plan's are filled in when they are known.
DatumSystem read_datum(const TomlTable& table) {
  DatumSystem datum;
  const bool best_fit = table.has("best_fit");
  if (table.is_array("best_fit")) {
    datum.best_fit = table.texts_or("best_fit", {});
    if (datum.best_fit.empty())
      table.fail("best_fit", "plan-value"_id, "name one feature or more, or \"all\"");
  } else if (best_fit && table.text("best_fit") != "all") {
    table.fail("best_fit", "plan-value"_id, "must be a list of features or \"all\"");
  }
  datum.primary = best_fit ? table.text_or("primary", "") : table.text("primary");
  datum.secondary = table.text_or("secondary", "");
  datum.tertiary = table.text_or("tertiary", "");
  datum.base = table.text_or("criterion", "") == "base";
  if (!datum.base) datum.criterion = read_criterion(table, "criterion");
  datum.locked = table.texts_or("locked", {});
  return datum;
}

PlannedFrame read_frame(const TomlTable& table) {
  PlannedFrame frame;
  frame.name = table.text("name");
  if (!table.has("planes")) table.fail("planes", "missing-key"_id, "this key is missing");
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
  if (const auto head = root.table_if("report")) plan.header = read_report_header(*head);
  if (const auto how = root.table_if("uncertainty")) plan.monte_carlo = read_monte_carlo(*how);
  const TomlTable probe = root.table("probe");
  plan.probe.ball_diameter = probe.length("ball_diameter", Bound::positive).value;
  plan.probe.clearance =
      probe.length_or("clearance", {plan.probe.clearance}, Bound::positive).value;
  plan.probe.reach = probe.length_or("reach", {plan.probe.reach}, Bound::positive).value;
  plan.probe.compensation =
      static_cast<Compensation>(probe.choice_or("compensation", words(kCompensationNames), 0));
  const auto datum = root.table_if("datum");
  if (datum) plan.datum = read_datum(*datum);
  const std::vector<TomlTable> frames = root.tables("frame");
  for (const TomlTable& table : frames) plan.frames.push_back(read_frame(table));
  const std::vector<TomlTable> features = root.tables("feature");
  for (const TomlTable& table : features) plan.features.push_back(read_feature(table));
  if (datum && datum->has("best_fit") && plan.datum->best_fit.empty()) {
    for (const PlannedFeature& feature : plan.features)
      plan.datum->best_fit.push_back(feature.name);
  }
  const std::vector<TomlTable> characteristics = root.tables("characteristic");
  for (const TomlTable& table : characteristics) {
    plan.characteristics.push_back(read_characteristic(table));
  }
  if (const auto filter = root.table_if("filter")) {
    const ProfileFilter read = read_filter(*filter);
    if (read == ProfileFilter{}) {
      root.fail("filter", "plan-value"_id, "has neither upr nor cutoff",
                "for example filter = { upr = 50, cutoff = \"0.8 mm\" }");
    }
    filter_forms(plan, read);
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
    table.fail(key, id_of(part), std::move(message), std::move(hint));
  });
  if (Diagnostics found = document.finish(); has_error(found)) return found;
  return plan;
}

}  // namespace

Result<InspectionPlan> load_plan(const std::filesystem::path& file) {
  const auto text = read_whole_file(file);
  if (!text) return text.error();
  return parse_plan(*text, file);
}

Result<InspectionPlan> parse_plan(std::string_view text, const std::filesystem::path& file) {
  if (is_qif(text, file)) {
    auto read = parse_qif_plan(text, file);
    if (!read) return std::move(read).error();
    if (read->warnings.empty()) return std::move(read->plan);
    for (Diagnostic& d : read->warnings) d.severity = Severity::error;
    return std::move(read->warnings);
  }
  auto document = TomlDocument::parse(text, file);
  if (!document) return std::move(document).error();
  return read_plan(*document);
}

}  // namespace frustum::metrology
