#include "app/dynamics/dynamics_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/constants.hpp"
#include "core/program_version.hpp"

namespace frustum::app {
namespace {

using dynamics::DynamicModel;
using kinematics::AxisPositions;
using nlohmann::ordered_json;

// Rounding leaves a sign on nothing.
double without_sign_of_zero(double x) { return x == 0.0 ? 0.0 : x; }

ordered_json json_of(double x) { return without_sign_of_zero(x); }
ordered_json json_of(const std::complex<double>& z) {
  return {without_sign_of_zero(z.real()), without_sign_of_zero(z.imag())};
}
ordered_json json_of(const Vec3& v) { return {json_of(v.x()), json_of(v.y()), json_of(v.z())}; }
template <typename Matrix>
ordered_json rows_json(const Matrix& matrix) {
  ordered_json rows = ordered_json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    ordered_json row = ordered_json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(json_of(matrix(r, c)));
    rows.push_back(std::move(row));
  }
  return rows;
}

// Columns in the unit of their axis.
template <typename Matrix>
Matrix in_inertial_units(const DynamicModel& model, Matrix matrix) {
  for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
    matrix.col(k) *= dynamics::inertial_scale(model.axes[static_cast<std::size_t>(k)].joint);
  }
  return matrix;
}

template <typename Values>
ordered_json first_of(const Values& values, std::size_t most) {
  ordered_json list = ordered_json::array();
  for (const double value : values) {
    if (list.size() < most) list.push_back(value);
  }
  return list;
}

ordered_json axes_json(const DynamicModel& model, const AxisPositions& q) {
  ordered_json axes = ordered_json::object();
  for (const auto letter : kinematics::kAxisLetters) {
    if (!model.axis(letter)) continue;
    axes[std::string(1, to_char(letter))] = is_rotary(letter) ? q[letter] * kDegPerRad : q[letter];
  }
  return axes;
}

ordered_json poles_json(const dynamics::Poles& poles, std::size_t modes) {
  return {{"frequency_hz", first_of(poles.frequencies, modes)},
          {"damping_ratio", first_of(poles.ratios, modes)},
          {"real_poles_1_s", poles.real}};
}

ordered_json places_json(const DynamicModel& model, const DynamicsAnswer& answer,
                         std::size_t count) {
  ordered_json list = ordered_json::array();
  for (std::size_t m = 0; m < count; ++m) {
    const dynamics::ModePlace& place = answer.places[m];
    list.push_back(
        {{"moves_most", model.body_name(place.body)},
         {"kinetic_share", place.kinetic_share},
         {"yields_most", place.connection == 0 ? "mounts" : model.body_name(place.connection)},
         {"strain_share", place.strain_share}});
  }
  return list;
}

void add_modes(ordered_json& doc, const DynamicModel& model, const DynamicsAnswer& answer,
               std::size_t modes) {
  const auto count = std::min(modes, static_cast<std::size_t>(answer.coordinates));
  doc["undamped_hz"] = first_of(answer.modes.frequencies, count);
  doc["highest_hz"] = answer.modes.frequencies[answer.coordinates - 1];
  const Eigen::MatrixXd weights =
      answer.modes.tip.leftCols(static_cast<Eigen::Index>(count)).cwiseAbs2().transpose();
  doc["tip_shape_squared"] = rows_json(weights);
  doc["modes"] = places_json(model, answer, count);
  doc["damped"] = poles_json(answer.damped, modes);
}

void add_rest(ordered_json& doc, const DynamicModel& model, const DynamicsAnswer& answer) {
  const dynamics::StaticResponse& rest = answer.rest;
  doc["static_compliance_um_per_n"] = rows_json(Mat3(rest.compliance * kMicrometres));
  doc["static_stiffness_n_per_um"] = json_of(Vec3(rest.stiffness() / kMicrometres));
  doc["held_stiffness_n_per_um"] = json_of(Vec3(rest.held_stiffness() / kMicrometres));
  doc["gravity_sag_um"] = json_of(Vec3(rest.sag * kMicrometres));
  ordered_json order = ordered_json::array();
  for (std::size_t k = 0; k < model.axes.size(); ++k) order.push_back(model.body_name(k + 1));
  doc["axis_order"] = order;
  doc["inertial_compliance"] = rows_json(in_inertial_units(model, rest.inertial));
  ordered_json peaks = ordered_json::array();
  for (const dynamics::Peak& p : answer.peaks) {
    peaks.push_back({{"direction", std::string(1, "xyz"[p.direction])},
                     {"frequency_hz", p.frequency},
                     {"compliance_um_per_n", p.compliance * kMicrometres}});
  }
  doc["dominant_peaks"] = peaks;
}

void add_frequencies(ordered_json& doc, const DynamicModel& model, const DynamicsAnswer& answer) {
  if (answer.frequencies.empty()) return;
  ordered_json frf = ordered_json::object(), inertial = frf, tracking = frf;
  for (const FrequencyAnswer& f : answer.frequencies) {
    const std::string key = fmt::format("{:.12g}", f.frequency);
    frf[key] = rows_json(Eigen::Matrix3cd(f.compliance * kMicrometres));
    inertial[key] = rows_json(in_inertial_units(model, f.inertial));
    if (answer.control) tracking[key] = rows_json(f.tracking);
  }
  doc["frf_um_per_n"] = frf;
  doc["inertial_frf"] = inertial;
  if (answer.control) doc["tracking_deviation"] = tracking;
}

ordered_json map_axis_json(const dynamics::MapAxis& axis) {
  const double unit = is_rotary(axis.letter) ? kDegPerRad : 1.0;
  return {std::string(1, to_char(axis.letter)), axis.from * unit, axis.to * unit, axis.count};
}

ordered_json map_json(const WorkspaceMapRequest& request, const dynamics::WorkspaceMap& map) {
  return {{"rows", map_axis_json(request.rows)},
          {"columns", map_axis_json(request.columns)},
          {"quantity", request.title},
          {"values", rows_json(map.values)},
          {"box",
           {{"min", map.box.min},
            {"q1", map.box.q1},
            {"median", map.box.median},
            {"q3", map.box.q3},
            {"max", map.box.max}}},
          {"frequency_range_hz", map.frequency_ranges}};
}

ordered_json circle_json(const CircleRequest& request, const dynamics::HarmonicCircle& circle) {
  const auto phasor = [&](std::size_t direction) {
    ordered_json list = ordered_json::array();
    for (const auto& z : circle.phasors[direction]) list.push_back(json_of(z * kMicrometres));
    return list;
  };
  return {{"radius_mm", request.radius * kMillimetres},
          {"feed_mm_min", request.speed * kMillimetres * kSecondsPerMinute},
          {"omega_rad_s", circle.omega},
          {"mean_radial_um", circle.mean_radial * kMicrometres},
          {"roundness_lsq_um", circle.roundness * kMicrometres},
          {"phasor_x_um", phasor(0)},
          {"phasor_y_um", phasor(1)}};
}

ordered_json move_json(const DynamicModel& model, const MoveRequest& request,
                       const dynamics::JerkMove& move) {
  const bool rotary = model.axes[request.axis].joint.rotary();
  ordered_json breakpoints = ordered_json::array(), rows = breakpoints;
  for (const dynamics::Breakpoint& b : move.breakpoints) {
    breakpoints.push_back({b.time, b.acceleration});
  }
  for (const auto& row : move.rows) {
    const Vec3 d = row.tip * kMicrometres;
    rows.push_back({row.time, json_of(d.x()), json_of(d.y()), json_of(d.z())});
  }
  return {{"axis", model.body_name(request.axis + 1)},
          {rotary ? "breakpoints_s_rad_s2" : "breakpoints_s_m_s2", breakpoints},
          {"columns", {"t_s", "x_um", "y_um", "z_um"}},
          {"rows", rows},
          {"largest_um", json_of(Vec3(move.largest * kMicrometres))},
          {"largest_after_the_move_um", json_of(Vec3(move.largest_after * kMicrometres))},
          {"peak_um", json_of(Vec3(move.peak * kMicrometres))}};
}

ordered_json compared_json(const ComparedMachine& compared) {
  ordered_json names = ordered_json::array(), first = names, second = names, change = names;
  for (const ComparedRow& row : compared.rows) {
    names.push_back(row.name);
    first.push_back(row.first);
    second.push_back(row.second);
    change.push_back(row.change ? ordered_json(*row.change) : ordered_json());
  }
  return {{"machine", compared.name},
          {"rows", names},
          {"first_um_per_gn", first},
          {"second_um_per_gn", second},
          {"change_percent", change}};
}

ordered_json identified_json(const dynamics::Identification& identified) {
  ordered_json parameters = ordered_json::array();
  for (const dynamics::IdentifiedParameter& p : identified.parameters) {
    parameters.push_back({{"name", p.name},
                          {"factor", p.factor},
                          {"relative_standard_uncertainty", p.relative_uncertainty},
                          {"interval_95", {p.low, p.high}}});
  }
  return {{"parameters", parameters},
          {"noise", identified.noise},
          {"not_separated", identified.not_separated}};
}

}  // namespace

std::string dynamics_json(const DynamicsReport& report) {
  const auto& [machine, model, request, answer, modes, compared, identified] = report;
  ordered_json doc{{"schema", "frustum/dynamics/1"},
                   {"version", program_version()},
                   {"machine", machine.name()},
                   {"structure", machine.structure()},
                   {"axes", axes_json(model, request.axes)},
                   {"tool_length_mm", request.tool_length},
                   {"tip_in_machine_mm", json_of(Vec3(answer.tip_in_machine * kMillimetres))},
                   {"coordinates", answer.coordinates}};
  add_modes(doc, model, answer, modes);
  add_rest(doc, model, answer);
  if (answer.control) {
    doc["states"] = answer.control->states;
    doc["poles"] = poles_json(answer.control->poles, modes);
  }
  add_frequencies(doc, model, answer);
  if (answer.rates) {
    doc["rates"] = {
        {"tip_in_machine_um", json_of(Vec3(answer.rates->tip_in_machine * kMicrometres))},
        {"tip_in_table_um", json_of(Vec3(answer.rates->tip_in_table * kMicrometres))},
        {"turn_in_table_urad", json_of(Vec3(answer.rates->turn_in_table * kUradPerRad))}};
  }
  if (answer.map) doc["map"] = map_json(*request.map, *answer.map);
  if (answer.circle) doc["circle"] = circle_json(*request.circle, *answer.circle);
  if (answer.move) doc["jerk_move"] = move_json(model, *request.move, *answer.move);
  if (compared) doc["compare"] = compared_json(*compared);
  if (identified) doc["identified"] = identified_json(*identified);
  return doc.dump(2);
}

}  // namespace frustum::app
