// Our own submissions to the benchmark: what the laws alone say, and what the laws and data say by
// linear Bayes.
//
// Model    : unknowns z ~ N(mean, sd^2) of laws.csv; every measured point is linear in them, by
//            the gains of an error-free cut; noise of 1 um a point of a CMM and
//            0.2 um of a motion test. The posterior is Gaussian, and so are the predictions from it
// Units    : um, urad, 1/s as the files
// Shape    : one machine
// Errors   : files that are missing or damaged, those of the trials
// Accuracy : first order in the errors; tool radius, drift and deflection of each piece are
//            unknowns, servo gains are not fitted and count as noise of the prior
// Source   : textbook linear Gaussian model
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace frustum::app {

inline constexpr std::array<std::string_view, 6> kBaselines{"prior",   "cone",   "steps",
                                                            "s-piece", "motion", "all"};

struct BaselineFiles {
  std::string predictions{}, errors{};
};
// What method.md of such a submission says.
[[nodiscard]] std::string baseline_method(std::string_view method);
// Of machine `id` of a benchmark's folder.
[[nodiscard]] Result<BaselineFiles> baseline_of(const std::filesystem::path& benchmark,
                                                const std::string& id, std::string_view method);

}  // namespace frustum::app
