// Whether the linear engine may stand for whole trials.
//
// Model    : the first 59 draws by both engines (Wilks: their largest difference D covers 95 % of
//            the draws at 95 % confidence), and again with all errors doubled: a difference of
//            second order grows 4 fold. The growth is the ratio of the root mean squares. Linear is
//            refused outside 4 +- 0.6
//              bound = 1.5 D (s_max / s_c)^2
//            s the largest deviation of a point among the controls (s_c) and among all draws
//            (s_max). A statistical bound, no proof
//            auto takes linear if bound <= min(0.05 um, a tenth of the smallest half width asked
//            for), no shape has an even part, and no contact jumps
// Units    : those of the values (um); deviations mm
// Errors   : none; a refusal has its reason in words
// Accuracy : statistical
// Source   : Wilks 1941; ours
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustum::studies {

inline constexpr std::uint32_t kControls = 59;
inline constexpr double kGrowthOfSecondOrder = 4.0;
inline constexpr double kGrowthLimit = 0.6;

// One characteristic's values of the controls by both engines.
struct ControlValues {
  std::vector<double> full{}, linear{};                  // as drawn
  std::vector<double> full_doubled{}, linear_doubled{};  // all errors doubled
};

struct EngineControls {
  std::uint32_t draws = 0;
  double largest_difference = 0.0;  // D, of all characteristics
  double growth = 0.0;              // of the differences' root mean square, when errors double
  // Differences so small that they are rounding: the growth says nothing, linear is accepted.
  bool is_rounding = false;
  std::string refusal{};  // empty: the linear engine may stand
};

// `rounding`: differences below it are those of the numbers (2 nm of contacts).
[[nodiscard]] EngineControls engine_controls(std::span<const ControlValues> characteristics,
                                             double rounding);
[[nodiscard]] double linear_bound(const EngineControls& controls, double largest_of_controls,
                                  double largest_of_draws);

enum class EngineKind : std::uint8_t { automatic, linear, full };

struct EngineFacts {
  EngineControls controls{};
  double bound = 0.0;
  std::optional<double> smallest_half_width{};  // asked for by the stop rules
  bool has_even_part = false;                   // a face cut by a leaning end of a cutter
  bool jumps = false;                           // a contact jumps between passes
  std::vector<std::string> nonlinear{};         // FactorSet::nonlinear
};
struct EngineChoice {
  EngineKind kind = EngineKind::linear;
  std::string reason{};  // why not linear
};
// What `auto` takes.
[[nodiscard]] EngineChoice automatic_engine(const EngineFacts& facts);

}  // namespace frustum::studies
