// Combinations of machine errors in words.
//
// Units    : terms in mm and rad; texts say "mm", "um" and "urad"
// Errors   : none
#pragma once

#include <span>
#include <string>
#include <vector>

#include "calibration/identify/observability.hpp"

namespace frustum::calibration {

// Terms of a quantity that can be identified: small whole coefficients among unknowns of one kind,
// lengths with coefficient 1 first where kinds mix ("dz_AY + 97.15 mm * beta_AY").
[[nodiscard]] Combination readable(std::vector<Term> terms, std::span<const Unknown> unknowns);

// Terms of a change that no measurement sees.
[[nodiscard]] NullDirection unseen(std::vector<Term> terms, std::span<const Unknown> unknowns);

}  // namespace frustum::calibration
