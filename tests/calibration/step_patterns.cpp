#include "tests/calibration/step_patterns.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "core/units.hpp"

namespace frustum::calibration {
namespace {

using nlohmann::json;

bool angular_row(const std::string& quantity) { return quantity == "th" || quantity == "ph"; }
bool angular_error(const std::string& name) { return name.find('_') == 1 && name[0] != 'd'; }

std::vector<Unknown> unknowns_of_file() {
  std::vector<Unknown> unknowns;
  for (const std::string name : step_data()["errors"]) {
    unknowns.push_back({name, angular_error(name), {}, {}});
  }
  return unknowns;
}

// um per um and so on -> mm, rad.
double internal(double gain, bool row_angular, bool error_angular) {
  if (row_angular == error_angular) return gain;
  return row_angular ? gain * 1e-3 : gain * 1e3;
}

class Builder {
 public:
  Builder() { result_.unknowns = unknowns_of_file(); }

  void add(const std::string& pattern, const std::string& name, const std::string& quantity,
           const json& gain, double value, double deviation) {
    const bool angular = angular_row(quantity);
    result_.rows.push_back({pattern + "." + name, pattern, angular});
    Eigen::VectorXd row(static_cast<Eigen::Index>(result_.unknowns.size()));
    for (Eigen::Index j = 0; j < row.size(); ++j) {
      const Unknown& unknown = result_.unknowns[static_cast<std::size_t>(j)];
      row[j] = internal(gain.value(unknown.name, 0.0), angular, unknown.angular);
    }
    gains_.push_back(row);
    values_.push_back(value);
    deviations_.push_back(deviation);
  }

  Observations finish() && {
    const auto n = static_cast<Eigen::Index>(gains_.size());
    result_.gain.resize(n, static_cast<Eigen::Index>(result_.unknowns.size()));
    result_.values.resize(n);
    result_.covariance = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      result_.gain.row(i) = gains_[k].transpose();
      result_.values[i] = values_[k];
      result_.covariance(i, i) = deviations_[k] * deviations_[k];
    }
    return std::move(result_);
  }

 private:
  Observations result_{};
  std::vector<Eigen::VectorXd> gains_{};
  std::vector<double> values_{}, deviations_{};
};

json gains_of(const std::string& pattern, Gains gains) {
  const json& entry = step_data()["patterns"][pattern];
  if (gains == Gains::closed_printed) return closed_form(pattern, entry["nominal"]["printed"]);
  return entry["sensitivity"][gains == Gains::eq4 ? "eq4" : "trans"];
}

// Value in mm or rad as the tables have it: um, or [um, over mm].
double measured_value(const json& value) {
  if (value.is_array()) return value[0].get<double>() / kUmPerMm / value[1].get<double>();
  return value.get<double>() / kUmPerMm;
}

void add_prior(Observations& observations, const char* name, double value, double deviation) {
  for (Unknown& unknown : observations.unknowns) {
    if (unknown.name == name) unknown.prior = Prior{value, deviation};
  }
}

}  // namespace

const json& step_data() {
  static const json kData = [] {
    std::ifstream file(FRUSTUM_SOURCE_DIR "/tests/data/step_patterns.json");
    return json::parse(file);
  }();
  return kData;
}

std::vector<std::string> all_patterns() {
  return {"1-a", "1-b", "2-a", "2-b", "3", "4", "5-a", "5-b", "6-a", "6-b", "7"};
}

json closed_form(const std::string& pattern, const json& size) {
  const double root2 = std::numbers::sqrt2;
  const double um = 1e-3;  // mm per rad -> um per urad
  const double height = size["H"].get<double>() * um;
  const double half = size["h"].get<double>() * um / 2.0;
  const double width = size["L"].get<double>() * um;
  const double edge = width + size["l"].get<double>() * um;
  const double cy = size["Cy"].get<double>() * um;
  const double arm = 2.0 * (height + half);
  json f;
  f["dL0"] = {{"d_r", -2.0}};
  f["th"] = json::object();
  if (pattern[0] == '1') {
    f["dL"] = {{"dy_CA", 2.0}, {"dy_AY", 2.0}, {"a_AY", -arm}, {"a_ZY", arm}, {"d_r", -2.0}};
    f["ph"] = {{"b_AY", -2.0}, {"b_CA", -2.0}};
    f["dH"] = {{"a_AY", 2.0 * cy + edge}};
    if (pattern == "1-b") f["dH"] = {{"a_AY", edge}, {"b_AY", -2.0 * cy}, {"b_CA", -2.0 * cy}};
  } else if (pattern[0] == '2') {
    f["dL"] = {{"dx_AY", -2.0}, {"b_AY", -arm}, {"b_CA", -arm}, {"b_ZX", arm}, {"d_r", -2.0}};
    f["ph"] = {{"a_AY", 2.0}};
    const double beta = pattern == "2-a" ? edge : edge + 2.0 * cy;
    f["dH"] = {{"b_AY", beta}, {"b_CA", beta}, {"a_AY", pattern == "2-a" ? 2.0 * cy : 0.0}};
  } else if (pattern == "3") {
    f["dL"] = {{"dy_CA", -2.0}, {"dz_AY", -2.0}, {"a_AY", arm}};
    f["dH"] = {{"b_AY", edge}, {"b_CA", edge + 2.0 * cy}, {"g_AY", 2.0 * cy}};
    f["ph"] = {{"b_CA", 2.0}, {"g_AY", 2.0}};
  } else if (pattern == "4") {
    f["dL"] = {{"b_AY", -2.0 * cy}, {"dz_AY", -2.0}};
    f["dH"] = {{"dy_AY", -2.0}, {"a_AY", edge},  {"b_AY", edge},
               {"b_CA", edge},  {"a_ZY", -edge}, {"g_AY", 2.0 * cy}};
    f["ph"] = {{"g_AY", 2.0}};
    f["th"] = {{"b_AY", -2.0}};
  } else if (pattern == "5-a") {
    f["dL"] = {{"dz_AY", 2.0}, {"a_ZY", 2.0 * cy}, {"d_r", -2.0 * root2}};
    f["th"] = {{"b_AY", -2.0}};
  } else if (pattern == "5-b") {
    f["dL"] = {{"dy_CA", 2.0},         {"dy_AY", 2.0 * root2},
               {"dz_AY", 2.0},         {"a_AY", 2.0 * (cy - height)},
               {"a_ZY", 2.0 * height}, {"d_r", -2.0 * root2}};
    f["th"] = {{"a_AY", -2.0}};
  } else if (pattern == "6-a") {
    f["dL"] = {{"dz_AY", -2.0 * (root2 - 1.0)}};
    f["th"] = {{"b_AY", 2.0 * (root2 - 1.0)}};
  } else if (pattern == "6-b") {
    f["dL"] = {{"dz_AY", -2.0 * (root2 - 1.0)}, {"dy_CA", -2.0}, {"a_AY", -(width - 2.0 * cy)}};
    f["th"] = {{"a_AY", -2.0}};
  } else {
    f["dL"] = {{"b_AY", -root2 * cy},
               {"g_AY", -root2 * height},
               {"g_YX", -root2 * height},
               {"b_ZX", root2 * cy},
               {"d_r", -2.0}};
    f["th"] = {{"b_AY", -root2}, {"b_ZX", root2}};
  }
  return f;
}

double cmm_deviation(double length) { return 0.5 * (0.5 + length / 600.0) / kUmPerMm; }

Observations published(Gains gains, bool flip_dh_of_1b) {
  Builder builder;
  const json& measured = step_data()["measured"];
  const char* sizes = gains == Gains::closed_printed ? "printed" : "consistent";
  for (const auto& [pattern, values] : measured["patterns"].items()) {
    const json& size = step_data()["patterns"][pattern]["nominal"][sizes];
    const json gain = gains_of(pattern, gains);
    for (const auto& [quantity, value] : values.items()) {
      const double sign = flip_dh_of_1b && pattern == "1-b" && quantity == "dH" ? -1.0 : 1.0;
      double deviation = cmm_deviation(size[quantity == "dL0" ? "L0" : "L"].get<double>());
      if (angular_row(quantity)) {
        const auto length = size["W"].get<double>();
        deviation = cmm_deviation(length) / length;
      }
      builder.add(pattern, quantity, quantity, gain[quantity], sign * measured_value(value),
                  deviation);
    }
  }
  for (const auto& [name, value] : measured["reference_steps_2"].items()) {
    const auto width = step_data()["patterns"]["3"]["nominal"][sizes]["L0"].get<double>();
    builder.add("reference 2", name, "dL0", {{"d_r", -2.0}}, measured_value(value),
                cmm_deviation(width));
  }
  Observations result = std::move(builder).finish();
  const json& squareness = measured["squareness_deg"];
  for (const char* name : {"g_YX", "a_ZY", "b_ZX"}) {
    add_prior(result, name, squareness[name].get<double>() * kRadPerDeg,
              squareness["standard_deviation"].get<double>() * kRadPerDeg);
  }
  return result;
}

Observations planned(std::span<const std::string> patterns) {
  Builder builder;
  for (const std::string& pattern : patterns) {
    const json& size = step_data()["patterns"][pattern]["nominal"]["consistent"];
    const json gains = gains_of(pattern, Gains::eq4);
    for (const auto& [quantity, gain] : gains.items()) {
      const auto length = size[angular_row(quantity) ? "W" : "L"].get<double>();
      const double deviation = cmm_deviation(length) / (angular_row(quantity) ? length : 1.0);
      builder.add(pattern, quantity, quantity, gain, 0.0, deviation);
    }
  }
  Observations result = std::move(builder).finish();
  for (Unknown& unknown : result.unknowns) {
    const bool known = unknown.name == "g_YX" || unknown.name == "a_ZY" || unknown.name == "b_ZX";
    if (known) unknown.fixed = 0.0;
  }
  return result;
}

std::vector<StepMeasurement> published_steps(const char* sizes, bool flip_dh_of_1b) {
  std::vector<StepMeasurement> steps;
  for (const auto& [pattern, values] : step_data()["measured"]["patterns"].items()) {
    const json& size = step_data()["patterns"][pattern]["nominal"][sizes];
    StepMeasurement step;
    step.pattern = pattern;
    step.height = size["H"].get<double>();
    step.width = size["L"].get<double>();
    step.centre_y = size["Cy"].get<double>();
    step.step_height = size["h"].get<double>();
    step.step_width = size["l"].get<double>();
    if (values.contains("dL")) step.dL = measured_value(values["dL"]);
    if (values.contains("dH")) step.dH = measured_value(values["dH"]);
    if (values.contains("th")) step.theta = measured_value(values["th"]);
    if (values.contains("ph")) step.phi = measured_value(values["ph"]);
    if (values.contains("dL0")) step.dL0 = measured_value(values["dL0"]);
    if (flip_dh_of_1b && pattern == "1-b") step.dH = -*step.dH;
    steps.push_back(step);
  }
  return steps;
}

KnownSquareness published_squareness() {
  const json& known = step_data()["measured"]["squareness_deg"];
  return {known["g_YX"].get<double>() * kRadPerDeg, known["a_ZY"].get<double>() * kRadPerDeg,
          known["b_ZX"].get<double>() * kRadPerDeg};
}

}  // namespace frustum::calibration
