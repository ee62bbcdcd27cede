// What a study finds, as result.json holds it.
//
// Units : values of a characteristic in its unit ("um", "urad", "mm"); bounds um; shares none
// Errors: none
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "studies/engine/engine_controls.hpp"
#include "studies/statistics/conformity_risk.hpp"
#include "studies/statistics/proportion.hpp"
#include "studies/statistics/summary.hpp"

namespace frustum::studies {

struct RiskResult {
  std::string rule{};  // as written
  double acceptance_limit = 0.0;
  Risks risks{};
};

// Exact statistics where every law is normal and the model is a length (normal_length.hpp).
struct ExactLength {
  double mean = 0.0;
  double rms = 0.0;
  std::vector<QuantileEstimate> quantiles{};  // without intervals
  std::optional<double> conform{};            // P(value <= limit)
};

struct CharacteristicResult {
  std::string name{};
  std::string unit{};
  Summary summary{};
  std::optional<double> limit{};
  bool both_sides = false;  // the limit is of the absolute value
  std::optional<Proportion> conform{};
  // At limit - bound and limit + bound of the linear engine.
  std::optional<Proportion> conform_low{}, conform_high{};
  std::vector<RiskResult> risks{};
  std::optional<ExactLength> exact{};
};

struct EngineResult {
  std::string name{};  // "linear", "full"
  double bound_um = 0.0;
  std::uint32_t controls = 0;
  double growth = 0.0;
  std::string reason{};  // why full
};

struct ShareResult {
  std::string name{};
  double mean_square = 0.0;
  double first = 0.0, first_se = 0.0;
  double total = 0.0, total_se = 0.0;
};
struct SharesResult {
  std::string characteristic{};
  std::uint32_t draws = 0;
  std::vector<ShareResult> groups{};  // largest total first
};

struct AllocationResult {
  std::string characteristic{};
  double probability = 0.0;
  std::vector<std::string> groups{};
  std::vector<double> factors{};
  double cost = 0.0;
  double equal_factor = 1.0;
  Interval equal_factor_ci95{};
  double equal_cost = 0.0;
};

struct MapRow {
  double cone_angle_deg = 0.0;
  double inclination_deg = 0.0;
  std::vector<double> center_mm{};
  double rms_um = 0.0;      // of the centred deviation
  double directions = 0.0;  // participation ratio of its principal components
  std::size_t shown = 0;    // errors that make 1 um of form at their limit
  double median_um = 0.0;
  Interval median_ci95{};
  double q95_um = 0.0;
};

struct FailedDraw {
  std::uint32_t draw = 0;
  std::string message{};
};

struct StudyResult {
  std::string title{};
  std::uint64_t seed = 0;
  std::string scheme{};
  std::uint64_t samples = 0;
  EngineResult engine{};
  std::vector<CharacteristicResult> characteristics{};
  std::optional<Proportion> joint{};  // all limits at once
  std::vector<SharesResult> shares{};
  std::optional<AllocationResult> allocation{};
  std::vector<MapRow> map{};
  std::vector<FailedDraw> failed{};
  // What was asked for and not reached: at_least of a limit, a stop rule.
  std::vector<std::string> not_reached{};
};

}  // namespace frustum::studies
