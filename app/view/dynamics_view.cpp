#include "app/view/dynamics_view.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/view/text_table.hpp"
#include "core/constants.hpp"
#include "dynamics/inertial_load.hpp"
#include "report/number_text.hpp"

namespace frustum::app {
namespace {

using dynamics::DynamicModel;
using report::fixed_text;

std::string fixed(double value, int decimals) { return fixed_text(value, decimals); }
std::string exponent(double value) { return fmt::format("{:.3e}", value); }
std::string percent(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

std::string axes_text(const DynamicModel& model, const kinematics::AxisPositions& q) {
  std::string text;
  for (const auto letter : kinematics::kAxisLetters) {
    if (!model.axis(letter)) continue;
    text += fmt::format("{}{} {:g}{}", text.empty() ? "" : ", ", to_char(letter),
                        is_rotary(letter) ? q[letter] * kDegPerRad : q[letter],
                        is_rotary(letter) ? "°" : "");
  }
  return text;
}

std::string modes_text(const DynamicModel& model, const DynamicsAnswer& answer, std::size_t modes) {
  TextTable table(
      {"mode", "Hz", "moves most", "", "yields most", "", "tip x 1/kg", "tip y", "tip z"});
  const auto count = std::min(modes, static_cast<std::size_t>(answer.coordinates));
  for (std::size_t m = 0; m < count; ++m) {
    const auto k = static_cast<Eigen::Index>(m);
    const dynamics::ModePlace& place = answer.places[m];
    const Vec3 weight = answer.modes.tip.col(k).cwiseAbs2();
    table.row({std::to_string(m + 1), fixed(answer.modes.frequencies[k], 3),
               model.body_name(place.body), percent(place.kinetic_share),
               place.connection == 0 ? "mounts" : model.body_name(place.connection),
               percent(place.strain_share), exponent(weight.x()), exponent(weight.y()),
               exponent(weight.z())});
  }
  return table.text();
}

std::string poles_text(const dynamics::Poles& poles, std::size_t modes) {
  TextTable table({"pole", "Hz", "damping ratio"});
  for (std::size_t m = 0; m < std::min(modes, poles.frequencies.size()); ++m) {
    table.row({std::to_string(m + 1), fixed(poles.frequencies[m], 3), fixed(poles.ratios[m], 4)});
  }
  std::string text = table.text();
  if (!poles.real.empty()) {
    text += "real poles, 1/s:";
    for (const double pole : poles.real) text += fmt::format(" {:.5g}", pole);
    text += '\n';
  }
  return text;
}

std::string rest_text(const dynamics::StaticResponse& rest) {
  TextTable table({"at rest", "x", "y", "z"});
  const auto row = [&](const char* name, const Vec3& v, int decimals) {
    table.row({name, fixed(v.x(), decimals), fixed(v.y(), decimals), fixed(v.z(), decimals)});
  };
  row("static stiffness N/um, as measured", rest.stiffness() / kMicrometres, 3);
  row("  with the tip held across", rest.held_stiffness() / kMicrometres, 3);
  row("sag um", rest.sag * kMicrometres, 3);
  return table.text();
}

std::string inertial_text(const DynamicModel& model, const dynamics::StaticResponse& rest) {
  std::vector<std::string> headings{"inertial compliance"};
  for (std::size_t k = 0; k < model.axes.size(); ++k) {
    headings.push_back(model.body_name(k + 1) +
                       (model.axes[k].joint.rotary() ? " um/(rad/s²)" : " um/gn"));
  }
  TextTable table(headings);
  for (Eigen::Index i = 0; i < 3; ++i) {
    std::vector<std::string> cells{fmt::format("H{}", "xyz"[i])};
    for (std::size_t k = 0; k < model.axes.size(); ++k) {
      const kinematics::Joint& joint = model.axes[k].joint;
      cells.push_back(
          fixed(rest.inertial(i, static_cast<Eigen::Index>(k)) * dynamics::inertial_scale(joint),
                joint.rotary() ? 4 : 3));
    }
    table.row(cells);
  }
  // That of a spring which gives way as much.
  std::vector<std::string> cells{"equivalent frequency Hz"};
  for (std::size_t k = 0; k < model.axes.size(); ++k) {
    const double most = rest.inertial.col(static_cast<Eigen::Index>(k)).norm();
    const bool shown = !model.axes[k].joint.rotary() && most > 0.0;
    cells.push_back(shown ? fixed(1.0 / std::sqrt(most) / kTurn, 2) : "");
  }
  table.row(cells);
  return table.text();
}

std::string peaks_text(const std::vector<dynamics::Peak>& peaks) {
  constexpr int kMostInADirection = 3;
  TextTable table({"dominant peaks", "Hz", "um/N"});
  std::array<int, 3> shown{};
  for (const dynamics::Peak& p : peaks) {
    if (shown[static_cast<std::size_t>(p.direction)]++ >= kMostInADirection) continue;
    table.row({std::string(1, "xyz"[p.direction]), fixed(p.frequency, 2),
               fixed(p.compliance * kMicrometres, 5)});
  }
  return table.text();
}

std::string frequencies_text(const DynamicsAnswer& answer) {
  TextTable table({"Hz", "|Gxx| um/N", "|Gyy|", "|Gzz|", "|Gxy|", "|Gxz|", "|Gyz|", "arg Gxx deg",
                   "arg Gyy", "arg Gzz"});
  for (const FrequencyAnswer& f : answer.frequencies) {
    const auto size = [&](int i, int j) {
      return fixed(std::abs(f.compliance(i, j)) * kMicrometres, 6);
    };
    const auto phase = [&](int i) { return fixed(std::arg(f.compliance(i, i)) * kDegPerRad, 1); };
    table.row({fmt::format("{:.6g}", f.frequency), size(0, 0), size(1, 1), size(2, 2), size(0, 1),
               size(0, 2), size(1, 2), phase(0), phase(1), phase(2)});
  }
  return table.text();
}

std::string vectors_text(const std::vector<std::pair<const char*, Vec3>>& vectors) {
  TextTable table({"", "x", "y", "z"});
  for (const auto& [name, v] : vectors) {
    table.row({name, fixed(v.x(), 4), fixed(v.y(), 4), fixed(v.z(), 4)});
  }
  return table.text();
}

std::string map_text(const WorkspaceMapRequest& request, const dynamics::WorkspaceMap& map) {
  TextTable table({request.title, "min", "Q1", "median", "Q3", "max"});
  table.row(
      {fmt::format("over {} and {}", to_char(request.rows.letter), to_char(request.columns.letter)),
       fixed(map.box.min, 3), fixed(map.box.q1, 3), fixed(map.box.median, 3), fixed(map.box.q3, 3),
       fixed(map.box.max, 3)});
  std::string text = table.text();
  for (std::size_t m = 0; m < map.frequency_ranges.size(); ++m) {
    text += fmt::format("f{}  {:.3f} .. {:.3f} Hz\n", m + 1, map.frequency_ranges[m][0],
                        map.frequency_ranges[m][1]);
  }
  return text;
}

std::string compared_text(const ComparedMachine& compared) {
  TextTable table({"um/gn", "this machine", compared.name, "change"});
  for (const ComparedRow& row : compared.rows) {
    table.row({row.name, fixed(row.first, 2), fixed(row.second, 2),
               row.change ? fmt::format("{:+.0f} %", *row.change) : "-"});
  }
  return table.text();
}

std::string identified_text(const dynamics::Identification& identified) {
  TextTable table({"identified", "factor", "95 % from", "to"});
  for (const dynamics::IdentifiedParameter& p : identified.parameters) {
    table.row({p.name, fixed(p.factor, 4), fixed(p.low, 4), fixed(p.high, 4)});
  }
  std::string text = table.text() + fmt::format("left of magnitude and phase: {:.2f} %\n",
                                                100.0 * identified.noise);
  for (const auto& combination : identified.not_separated) {
    text += fmt::format("cannot be separated: {}\n", fmt::join(combination, ", "));
  }
  return text;
}

}  // namespace

std::string dynamics_text(const DynamicsReport& report) {
  const auto& [machine, model, request, answer, modes, compared, identified] = report;
  std::string text = fmt::format("{} at {}, tool {:g} mm\n\n", machine.title(),
                                 axes_text(model, request.axes), request.tool_length);
  const auto add = [&](const std::string& part) { text += part + '\n'; };
  add(modes_text(model, answer, modes));
  add(poles_text(answer.damped, modes));
  add(rest_text(answer.rest));
  add(inertial_text(model, answer.rest));
  add(peaks_text(answer.peaks));
  if (answer.control) {
    add(fmt::format("with the controls of the drives, {} states", answer.control->states));
    add(poles_text(answer.control->poles, modes));
  }
  if (!answer.frequencies.empty()) add(frequencies_text(answer));
  if (answer.rates) {
    add(vectors_text({{"tip in the machine um", answer.rates->tip_in_machine * kMicrometres},
                      {"tip in the table um", answer.rates->tip_in_table * kMicrometres},
                      {"turn in the table urad", answer.rates->turn_in_table * kUradPerRad}}));
  }
  if (answer.map) add(map_text(*request.map, *answer.map));
  if (answer.circle) {
    add(fmt::format("circle: mean radial deviation {} um, roundness (LSQ) {} um\n",
                    fixed(answer.circle->mean_radial * kMicrometres, 4),
                    fixed(answer.circle->roundness * kMicrometres, 4)));
  }
  if (answer.move) {
    add(vectors_text({{"largest um", answer.move->largest * kMicrometres},
                      {"after the move um", answer.move->largest_after * kMicrometres},
                      {"peak um", answer.move->peak * kMicrometres}}));
  }
  if (compared) add(compared_text(*compared));
  if (identified) add(identified_text(*identified));
  text.pop_back();
  return text;
}

}  // namespace frustum::app
