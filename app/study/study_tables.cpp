#include "app/study/study_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/spelling.hpp"
#include "studies/laws/correlation.hpp"

namespace frustum::app {
namespace {

void read_tolerances(const TomlTable& table, StudyFile& study) {
  using kinematics::ToleranceReading;
  study.read_as = static_cast<ToleranceReading>(table.choice_or(
      "read_as", {"uniform", "normal-2sd", "normal-3sd", "normal-3sd-cut", "triangular"}, 0));
  const auto scale = table.table_if("scale");
  if (!scale) return;
  for (const std::string& pattern : scale->keys()) {
    study.scale.push_back({pattern, scale->number(pattern, Bound::non_negative)});
  }
}

void read_correlated(const TomlTable& table, StudyFile& study) {
  studies::CorrelatedGroup group;
  group.names = table.texts_or("names", {});
  const std::size_t n = group.names.size();
  if (n < 2) {
    table.fail("names", "correlation"_id, "a correlated group has two names or more",
               "names = [\"EX0C\", \"EY0C\"]");
  }
  const auto rows = table.rows("correlation", std::max<std::size_t>(n, 1));
  if (n < 2 || rows.empty()) return;
  if (rows.size() != n) {
    table.fail("correlation", "correlation"_id,
               fmt::format("the matrix has {} rows for {} names", rows.size(), n),
               "one row and one column a name, in their order");
    return;
  }
  const auto size = static_cast<Eigen::Index>(n);
  group.correlation.resize(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index k = 0; k < size; ++k) {
      group.correlation(i, k) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
    }
  }
  if (const auto lower = studies::cholesky_of(group.correlation, n); !lower) {
    table.fail("correlation", lower.error().front());
  }
  study.correlated.push_back(std::move(group));
}

// Each name once in all groups, and of an error that can be a member; an error whose law could not
// be read has been told of.
void check_members(const TomlTable& root, const StudyFile& study) {
  const auto errors = root.table_if("errors");
  std::set<std::string> taken;
  for (const TomlTable& group : root.tables("correlated")) {
    std::optional<Diagnostic> wrong;  // a key has one message
    const auto note = [&](const Diagnostic& problem) {
      if (wrong) {
        wrong->message += "; " + problem.message;
      } else {
        wrong = problem;
      }
    };
    for (const std::string& name : group.texts_or("names", {})) {
      if (!taken.insert(name).second) {
        note(error("correlated-twice"_id, fmt::format("{} is named twice", name),
                   "an error is in one correlated group, once"));
        continue;
      }
      const bool was_read = std::ranges::any_of(
          study.errors, [&](const kinematics::ErrorEntry& e) { return e.name == name; });
      if (!was_read && errors && errors->has(name)) continue;
      if (const auto problem = studies::uncorrelatable(study.errors, name)) note(*problem);
    }
    if (wrong) group.fail("names", *wrong);
  }
}

void read_limits(const TomlTable& table, StudyFile& study) {
  for (const std::string& name : table.keys()) {
    if (name == "at_least") {
      study.questions.at_least = table.number("at_least", Bound::positive);
      if (study.questions.at_least > 1.0) {
        table.fail("at_least", "out-of-range"_id, "a probability is at most 1");
      }
      continue;
    }
    const auto at = place_of(study.characteristics, name);
    if (!at) {
      (void)table.has(name);
      Diagnostic unknown = unknown_characteristic(name, study.characteristics);
      table.fail(name, unknown.id, unknown.message, unknown.hint);
      continue;
    }
    if (table.is_number(name)) {
      const char* example = study.characteristics[*at].angular ? "60 urad" : "10 um";
      table.fail(name, "no-unit"_id, fmt::format("{:g} has no unit", table.number(name)),
                 fmt::format("write for example \"{}\"", example));
      continue;
    }
    const auto limit = parse_limit(table.text(name), study.characteristics[*at]);
    if (limit) {
      study.characteristics[*at].limit = *limit;
    } else {
      table.fail(name, limit.error().front());
    }
  }
}

void read_measurement(const TomlTable& table, StudyFile& study) {
  study.measurement.noise = table.boolean_or("noise", false);
  const bool has_instrument = study.motion && study.motion->setup->instrument.noise > 0.0;
  if (study.measurement.noise && !study.job && !has_instrument) {
    table.fail("noise", "no-cmm"_id,
               study.motion ? "the instrument of the motion test has no noise that could be drawn"
                            : "only a job has a CMM whose noise could be drawn",
               study.motion ? "the test file says it: [instrument] noise = \"0.3um\"" : "");
  }
  if (!table.has("u")) return;
  if (table.is_number("u")) {
    table.fail("u", "no-unit"_id, fmt::format("{:g} has no unit", table.number("u")),
               "write for example \"0.6 um\"");
    return;
  }
  const auto u = parse_limit(table.text("u"), {.name = "the measuring uncertainty"});
  if (u) {
    study.measurement.u = *u;
  } else {
    table.fail("u", u.error().front());
  }
}

void read_stop(const TomlTable& table, StudyFile& study) {
  for (const std::string& statistic : table.keys()) {
    if (statistic == "samples_at_most") {
      study.questions.samples_at_most = static_cast<std::uint64_t>(
          std::max<std::int64_t>(table.integer("samples_at_most", Bound::positive), 1));
      continue;
    }
    const auto rule = parse_stop_rule(statistic, table.text(statistic), study.characteristics);
    if (rule) {
      study.questions.stop.push_back(*rule);
    } else {
      table.fail(statistic, rule.error().front());
    }
  }
}

void read_risk(const TomlTable& table, StudyFile& study) {
  for (const std::string& text : table.texts_or("rules", {"simple"})) {
    auto rule = studies::DecisionRule::parse(text);
    if (rule) {
      study.questions.rules.push_back(*std::move(rule));
    } else {
      table.fail("rules", rule.error().front());
    }
  }
}

// The name of a characteristic, or nothing.
std::string read_characteristic(const TomlTable& table, const StudyFile& study) {
  const std::string name = table.text_or("characteristic", "");
  if (name.empty() || place_of(study.characteristics, name)) return name;
  const Diagnostic unknown = unknown_characteristic(name, study.characteristics);
  table.fail("characteristic", unknown.id, unknown.message, unknown.hint);
  return {};
}

void read_shares(const TomlTable& table, StudyFile& study) {
  study.questions.shares = true;
  study.questions.share_characteristic = read_characteristic(table, study);
  const auto groups = table.table_if("groups");
  if (!groups) return;
  for (const std::string& name : groups->keys()) {
    study.questions.groups[name] = groups->texts_or(name, {});
  }
}

void read_allocation(const TomlTable& table, StudyFile& study) {
  AllocationRequest request;
  if (!table.has("characteristic")) (void)table.text("characteristic");
  request.characteristic = read_characteristic(table, study);
  request.probability = table.number_or("probability", 0.95, Bound::positive);
  if (request.probability >= 1.0) {
    table.fail("probability", "out-of-range"_id, "must be below 1",
               "no sample shows that every machine is good");
  }
  if (const auto cost = table.table_if("cost")) {
    std::vector<std::string> known;
    for (const auto& [name, patterns] : study.questions.groups) known.push_back(name);
    for (const std::string& name : cost->keys()) {
      request.cost[name] = cost->number(name, Bound::positive);
      if (!study.questions.groups.contains(name)) {
        cost->fail(name, "unknown-group"_id, fmt::format("there is no group '{}'", name),
                   known.empty() ? "groups are those of [shares]" : suggestion(name, known));
      }
    }
  }
  study.questions.allocation = std::move(request);
}

void read_map(const TomlTable& table, StudyFile& study) {
  MapRequest request;
  request.cone_angle_deg = table.numbers("cone_angle");
  request.inclination_deg = table.numbers("inclination");
  request.center_mm = table.rows("center", 3);
  if (!study.job || study.job->piece.operations.empty() ||
      std::ranges::none_of(study.job->piece.operations, [](const auto& operation) {
        return operation.kind == programs::OperationKind::cone;
      })) {
    table.fail("", "map-of-no-cone"_id, "a map compares set-ups of a cone; the job cuts none",
               "frustum program cone makes such a job");
  }
  study.questions.map = std::move(request);
}

}  // namespace

void read_study_tables(const TomlTable& root, StudyFile& study) {
  if (const auto table = root.table_if("tolerances")) read_tolerances(*table, study);
  for (const TomlTable& table : root.tables("correlated")) read_correlated(table, study);
  check_members(root, study);
  if (const auto table = root.table_if("limits")) read_limits(*table, study);
  if (const auto table = root.table_if("measurement")) read_measurement(*table, study);
  if (const auto table = root.table_if("stop")) read_stop(*table, study);
  if (const auto table = root.table_if("risk")) read_risk(*table, study);
  if (const auto table = root.table_if("shares")) read_shares(*table, study);
  if (const auto table = root.table_if("allocate")) read_allocation(*table, study);
  if (const auto table = root.table_if("map")) read_map(*table, study);
}

}  // namespace frustum::app
