// Errors as people write them, before they are laid over a machine's axes.
//
// Model    : an entry is a named error, a sum of shapes; an amount in a shape may be a number with
//            a unit or drawn from distributions: amount = value x product of the factors drawn
// Units    : mm, rad
// Errors   : parsing names the text, what is wrong with it and the forms that would be accepted
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "core/units.hpp"
#include "kinematics/model/axes.hpp"
#include "kinematics/model/error_function.hpp"
#include "kinematics/model/volumetric_grid.hpp"

namespace frustum::kinematics {

// What a tolerance T about a nominal value says of the values within it: that they are uniform, or
// normal with a standard deviation of T/2 or T/3 (cut: drawn again beyond T), or triangular.
enum class ToleranceReading : std::uint8_t {
  uniform,
  normal_2sd,
  normal_3sd,
  normal_3sd_cut,
  triangular
};
// "uniform", "normal-2sd", "normal-3sd", "normal-3sd-cut", "triangular"
[[nodiscard]] std::string_view name_of(ToleranceReading reading);
[[nodiscard]] std::optional<ToleranceReading> tolerance_reading_named(std::string_view text);

// What an amount may be drawn from.
struct Distribution {
  enum class Kind : std::uint8_t { uniform, normal, triangular, tolerance };
  Kind kind = Kind::uniform;
  UnitKind unit = UnitKind::none;
  double lo = 0.0, hi = 0.0;  // uniform; triangular, with its peak in the middle
  double mean = 0.0, deviation = 0.0;
  std::optional<double> limit{};  // normal: |x - mean| stays within it; tolerance: its size
  std::optional<ToleranceReading> reading{};  // of a tolerance, where it is written

  // A tolerance as the law that its own reading, else this one, makes of it; others as they are.
  [[nodiscard]] Distribution read_as(ToleranceReading otherwise) const;
};
// Quantities drawn once and used by several amounts, by name.
using DrawnQuantities = std::map<std::string, Distribution>;

struct DrawnFactor {
  enum class Function : std::uint8_t { itself, cosine, sine };
  Distribution distribution{};
  std::string name{};  // empty: drawn for this amount alone
  double shift = 0.0;  // added to what is drawn
  Function function = Function::itself;
};

struct Amount {
  double value = 0.0;
  UnitKind kind = UnitKind::none;
  std::vector<DrawnFactor> drawn{};
};

// A factor that changes with the position of some axis; straight between points, held at the ends.
struct AxisFactor {
  AxisLetter axis = AxisLetter::B;
  std::vector<std::pair<double, double>> points{};
};

// How the values of a random function are alike at a distance x, for a correlation length l:
// exp(-x^2 / 2 l^2), or (1 + sqrt(3) x / l) exp(-sqrt(3) x / l).
enum class FieldKernel : std::uint8_t { gaussian, matern32 };
[[nodiscard]] std::string_view name_of(FieldKernel kernel);

// A shape; spans are absent when the axis's default span is meant.
struct ErrorShape {
  enum class Kind : std::uint8_t {
    constant,
    linear,
    polynomial,
    harmonic,
    cyclic,
    reversal,
    tent,
    field,
    table,
    surface
  };
  Kind kind = Kind::constant;
  Amount amount{};
  std::vector<Amount> coefficients{};  // polynomial: of 1, t, t^2, ...
  int order = 1;                       // harmonic
  Amount phase{};                      // harmonic, cyclic
  Amount peak{};                       // tent: where it stands
  std::optional<AxisRange> span{};
  std::optional<double> zero{};    // where a linear term vanishes (default 0)
  std::optional<double> settle{};  // reversal: travel that takes up the play
  double period = 0.0;             // cyclic
  double correlation = 0.0;        // field: the length over which its values are alike
  FieldKernel kernel = FieldKernel::gaussian;
  UnitKind position_kind =
      UnitKind::none;  // of span, zero, settle, period, correlation, peak, table; none: not given
  std::vector<std::pair<double, double>> points{};  // table
  TableKind interpolation = TableKind::linear;
  bool periodic = false;
  SurfaceTerm surface{};
  std::optional<AxisFactor> factor{};
};

[[nodiscard]] std::string_view name_of(ErrorShape::Kind kind);

// One error of a job or a command line: name and terms, with the text for the report. A volumetric
// grid and the reference axes that errors are written for are entries of their own ("grid",
// "datum").
struct ErrorEntry {
  std::string name{};
  std::string written{};
  std::vector<ErrorShape> terms{};
  std::string file{};  // where it stands, when that is a file of errors
  std::shared_ptr<const VolumetricGrid> grid{};
  std::vector<AxisLetter> datum{};
};

// "EB0C=30urad", "EXX=linear 10um", "EYX=harmonic 1 10um over 4.3mm..190mm phase 90deg"; terms are
// added with " + ": "EXY=harmonic 1 10um + -10um". All forms: docs/errors.md.
[[nodiscard]] Result<ErrorEntry> parse_error(std::string_view text,
                                             const DrawnQuantities& drawn = {});
// "10um", "uniform -10um..10um", "normal 0urad sd 5urad limit 15urad", "nominal 17urad tolerance
// 4urad as normal-3sd", "-a1", "b1*cos(zeta)".
[[nodiscard]] Result<Amount> parse_amount(std::string_view text, const DrawnQuantities& drawn = {});
[[nodiscard]] Result<Distribution> parse_distribution(std::string_view text);
// "0mm..200mm"
[[nodiscard]] std::optional<std::pair<ParsedQuantity, ParsedQuantity>> parse_range(
    std::string_view text);

// For the report; an amount not drawn yet shows as what it is drawn from.
[[nodiscard]] std::string written(const ErrorShape& shape);
[[nodiscard]] std::string written(const std::vector<ErrorShape>& terms);

}  // namespace frustum::kinematics
