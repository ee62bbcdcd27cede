#include "app/motion/probe_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "app/view/text_table.hpp"
#include "core/decimal.hpp"
#include "trials/part_program.hpp"

namespace frustum::app {
namespace {

using report::Phrase;
using report::Wording;
using trials::ErrorFate;
using trials::PartGains;
using trials::PartTouches;

std::vector<std::string> names_of(const PartGains& gains, const std::vector<std::size_t>& which) {
  std::vector<std::string> names;
  for (const std::size_t c : which) names.push_back(gains.characteristics[c]);
  return names;
}

// "cone.form 72 %": what an error does on the machine, of what it does on a CMM.
std::vector<std::string> shares_of(const PartGains& gains, std::size_t parameter,
                                   const std::vector<std::size_t>& which, const Wording& words) {
  constexpr double kManifold = 10.0;
  std::vector<std::string> texts;
  for (const std::size_t c : which) {
    const auto row = static_cast<Eigen::Index>(c), k = static_cast<Eigen::Index>(parameter);
    const double share = gains.on_machine(row, k) / gains.on_cmm(row, k);
    texts.push_back(share < kManifold
                        ? fmt::format("{} {:.0f} %", gains.characteristics[c], 100.0 * share)
                        : gains.characteristics[c] + words(" (there alone)"));
  }
  return texts;
}

const char* unit_name(bool angular) { return angular ? "urad" : "um"; }

// um and urad per um and urad.
Lists shown_gains(const PartGains& gains, const Eigen::MatrixXd& matrix) {
  Lists rows;
  for (std::size_t c = 0; c < gains.characteristics.size(); ++c) {
    std::vector<double> row;
    for (std::size_t k = 0; k < gains.parameters.size(); ++k) {
      row.push_back(matrix(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k)) *
                    (gains.angular[c] ? kUradPerRad : kUmPerMm) /
                    (gains.parameters[k].angular ? kUradPerRad : kUmPerMm));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

void add_characteristics(MotionAnswer& answer, const PartFindings& found) {
  std::vector<Document> list;
  const Wording& words = answer.words;
  TextTable table({words("characteristic"), words("unit"), words("on a CMM"),
                   words("on the machine"), words("difference")});
  report::MotionTable shown{
      .heading = words("The same part on a CMM and on its machine"),
      .columns = {words("characteristic"), words("unit"), ">" + words("on a CMM"),
                  ">" + words("on the machine"), ">" + words("difference")}};
  for (const auto& there : found.on_cmm.characteristics) {
    const auto at = found.on_machine.find(there.name);
    if (!at) continue;
    const auto& here = found.on_machine.characteristics[*at];
    const double difference = here.value - there.value;
    list.push_back({{"name", there.name},
                    {"unit", there.unit},
                    {"on_cmm", there.value},
                    {"on_machine", here.value},
                    {"difference", difference}});
    // A degree shows a microradian in its fifth decimal.
    const int decimals = there.unit == "deg" || there.unit == "mm" ? 6 : 3;
    const auto number = [&](double value) {
      return words.number(fixed_decimal(words.shown(value, there.unit), decimals));
    };
    const std::vector<std::string> cells{there.name, std::string(words.unit(there.unit)),
                                         number(there.value), number(here.value),
                                         number(difference)};
    table.row(cells);
    shown.rows.push_back(cells);
  }
  answer.document["characteristics"] = list;
  answer.text += table.text();
  shown.note = words(
      "The CMM makes no error here; what differs are the errors of the machine, which cut the part "
      "and probe it.");
  answer.page.tables.push_back(std::move(shown));
}

struct Group {
  ErrorFate fate;
  const char* key;
  Phrase says;
  Phrase shown;  // in the table of the page
};
constexpr std::array<Group, 5> kGroups{
    {{ErrorFate::cancels, "cancel",
      "cancel: the machine makes them again where it probes, and no measurement there shows them",
      "cancels"},
     {ErrorFate::in_part, "cancel_in_part", "cancel in part", "cancels in part"},
     {ErrorFate::stays, "stay", "are seen on the machine about as on a CMM", "stays"},
     {ErrorFate::grows, "grow", "are seen more on the machine than on a CMM", "grows"},
     {ErrorFate::nothing, "without_effect", "do nothing to these characteristics", "stays"}}};

void add_fates(MotionAnswer& answer, const PartGains& gains) {
  std::vector<trials::FateOfError> fates;
  for (std::size_t k = 0; k < gains.parameters.size(); ++k) fates.push_back(fate_of(gains, k));
  const Wording& words = answer.words;
  report::MotionTable shown{
      .heading = words("What becomes of each error on the machine"),
      .columns = {words("error"), words("on the machine"), words("of its effect on a CMM")}};
  for (const Group& group : kGroups) {
    std::vector<std::string> names;
    std::vector<Document> parts;
    for (std::size_t k = 0; k < fates.size(); ++k) {
      if (fates[k].fate != group.fate) continue;
      const std::string& name = gains.parameters[k].name;
      names.push_back(name);
      const auto cancelled = names_of(gains, fates[k].cancelled),
                 kept = names_of(gains, fates[k].kept);
      parts.push_back({{"error", name}, {"cancelled", cancelled}, {"kept", kept}});
      if (group.fate == ErrorFate::nothing) continue;
      std::string where =
          fmt::format("{}", fmt::join(shares_of(gains, k, fates[k].kept, words), ", "));
      if (!cancelled.empty()) {
        where = words("not in {0}", fmt::format("{}", fmt::join(cancelled, ", "))) +
                (where.empty() ? "" : words("; in ")) + where;
      }
      shown.rows.push_back({name, words(group.shown), where});
    }
    if (group.fate == ErrorFate::in_part) {
      answer.document[group.key] = parts;
    } else {
      answer.document[group.key] = names;
    }
    if (!names.empty()) {
      answer.text += fmt::format("{}: {}\n", words(group.says), fmt::join(names, ", "));
    }
  }
  shown.note = words(
      "An error cancels where its effect on the machine is below {0} % of that on a CMM. Of "
      "component errors it is a share that grows evenly over the travel.",
      words.general(100.0 * trials::kCancels));
  answer.page.tables.push_back(std::move(shown));
}

void add_gains(Document& doc, const PartGains& gains) {
  std::vector<std::string> errors, units;
  for (const trials::Parameter& parameter : gains.parameters) {
    errors.push_back(parameter.name);
    units.emplace_back(unit_name(parameter.angular));
  }
  std::vector<std::string> own_units;
  for (const bool angular : gains.angular) own_units.emplace_back(unit_name(angular));
  doc["gains"] = Document{{"characteristics", gains.characteristics},
                          {"characteristic_units", own_units},
                          {"errors", errors},
                          {"units", units},
                          {"on_cmm", shown_gains(gains, gains.on_cmm)},
                          {"on_machine", shown_gains(gains, gains.on_machine)}};
}

std::string points_csv(const Job& job, const PartTouches& plan,
                       const std::vector<double>& readings) {
  std::string csv = "feature,section,x,y,z\n";
  for (std::size_t t = 0; t < plan.touches.size(); ++t) {
    const trials::PartTouch& touch = plan.touches[t];
    const Vec3 ball = centre_of(plan, touch, readings[t]);
    csv += fmt::format("{},{},{},{},{}\n", job.piece.plan.features[touch.feature].name,
                       touch.section, fixed_decimal(ball.x(), 9), fixed_decimal(ball.y(), 9),
                       fixed_decimal(ball.z(), 9));
  }
  return csv;
}

}  // namespace

void add_part_findings(MotionAnswer& answer, const Job& job, const PartTouches& plan,
                       const PartFindings& found) {
  const Wording& words = answer.words;
  Document& doc = answer.document;
  doc["ball_diameter_mm"] = 2.0 * plan.ball_radius;
  doc["touches"] = static_cast<std::uint64_t>(plan.touches.size());
  if (!found.log.empty()) doc["log"] = found.log;
  std::vector<Document> poses;
  std::string where;
  for (const auto& pose : plan.poses) {
    Document each;
    std::string text;
    for (const auto letter : kinematics::kRotaryAxes) {
      if (job.machine.joint(letter) == nullptr) continue;
      const double degrees = as_stated(pose[letter] * kDegPerRad);
      each[std::string(1, to_char(letter))] = degrees;
      text += fmt::format("{}{} = {}°", text.empty() ? "" : ", ", to_char(letter),
                          words.general(degrees));
    }
    where += (where.empty() ? "" : "; ") + text;
    poses.push_back(std::move(each));
  }
  doc["poses"] = poses;
  Lists planned;
  for (const trials::PartTouch& touch : plan.touches) {
    planned.push_back({static_cast<double>(touch.feature), static_cast<double>(touch.section),
                       static_cast<double>(touch.pose)});
  }
  doc["plan"] = planned;  // feature, section and pose, each counted from 0
  std::vector<instruments::TestPose> at;
  for (const auto& state : found.at) at.push_back({.at = state});
  doc["axes"] = axes_of(job.machine, at);
  doc["reading_um"] = in_um(found.readings);
  auto& facts = answer.page.facts;
  std::erase_if(facts, [&](const auto& fact) {
    return fact[0] == words("Bar longer by") || fact[0] == words("Table ball off");
  });
  for (auto& [name, value] : facts) {
    if (name == words("Spindle ball off")) name = words("Ball of the probe off");
  }
  const std::string ball = words.amount(2.0 * plan.ball_radius, "mm");
  if (!where.empty()) facts.push_back({words("Probed at"), where});
  facts.push_back({words("Ball"), ball});
  if (!found.log.empty()) facts.push_back({words("Touches of"), found.log});
  answer.text += words("{0} touches with a ball of {1}", plan.touches.size(), ball) +
                 (where.empty() ? "" : words(" at {0}", where)) + "\n";
  add_characteristics(answer, found);
  add_fates(answer, found.gains);
  add_gains(doc, found.gains);
  report::TraceLine line{
      .name = words("reading"), .value = drawn_um(found.readings, words), .dots = true};
  line.along.resize(line.value.size());
  std::iota(line.along.begin(), line.along.end(), 0.0);
  answer.page.charts.push_back({.title = words("How far out the surface seems to be"),
                                .along_title = words("touch"),
                                .value_title = words("reading, {0}", words.symbol("um")),
                                .lines = {std::move(line)}});
  answer.files["touches.csv"] = part_log(job.machine, job.piece, plan, found.readings);
  answer.files["points.csv"] = points_csv(job, plan, found.readings);
}

}  // namespace frustum::app
