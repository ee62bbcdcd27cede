// The step patterns of tests/data/step_patterns.json as observations: published measurements, or
// plans of any patterns.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "calibration/design/step_recipes.hpp"
#include "calibration/identify/observations.hpp"

namespace frustum::calibration {

[[nodiscard]] const nlohmann::json& step_data();
[[nodiscard]] std::vector<std::string> all_patterns();

// Closed forms (10) to (21) as printed: characteristic -> gain of each error of the file, um and
// urad.
[[nodiscard]] nlohmann::json closed_form(const std::string& pattern, const nlohmann::json& size);

enum class Gains { eq4, trans, closed_printed };

// Standard deviation of a CMM with E = 0.5 um + L/600, E read as two standard deviations; mm.
[[nodiscard]] double cmm_deviation(double length);

// Tables 5 and 6: 36 rows, 12 unknowns, squareness of table 7 as priors.
[[nodiscard]] Observations published(Gains gains, bool flip_dh_of_1b = false);

// All characteristics of some patterns, squareness fixed at 0, one tool radius error for all.
[[nodiscard]] Observations planned(std::span<const std::string> patterns);

// Tables 5 and 6 for the recipes.
[[nodiscard]] std::vector<StepMeasurement> published_steps(const char* sizes, bool flip_dh_of_1b);
[[nodiscard]] KnownSquareness published_squareness();

}  // namespace frustum::calibration
