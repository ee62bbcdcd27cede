// Geometric errors of a machine under their ISO 230-1 names.
//
// Model    : each axis has six component errors, functions of its commanded position (EXX, EYX, ..., ECC)
//            and six location errors, constants (EX0C, EB0C, ...). They are physical displacements of the
//            moving part in its stator frame.
// Units    : mm, rad
// Errors   : read_error and resolve name the error, what is wrong with it and what the machine accepts
// Source   : ISO 230-1 names; where each acts: chain.hpp. The older short names (X0C for EX0C) and the
//            letter O for the digit 0 are read too.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "core/toml_document.hpp"
#include "kinematics/axes.hpp"
#include "kinematics/error_function.hpp"

namespace frustum::kinematics {

class Machine;

// Directions of an error: three displacements, three small rotations.
enum class ErrorDirection : std::uint8_t { X, Y, Z, A, B, C };  // NOLINT: the standard's letters
[[nodiscard]] constexpr bool is_rotation(ErrorDirection d) { return d >= ErrorDirection::A; }

struct ErrorName {
  ErrorDirection direction = ErrorDirection::X;
  AxisLetter axis = AxisLetter::X;
  bool location = false;  // EX0C rather than EXC

  // The ISO name, or nothing when the text is none.
  [[nodiscard]] static std::optional<ErrorName> parse(std::string_view text);
  [[nodiscard]] std::string text() const;     // "EX0C"
  [[nodiscard]] std::string meaning() const;  // "position of C in X"
};

// Errors of one axis.
struct AxisErrors {
  std::array<ErrorFunction, 6> component{};  // by ErrorDirection
  std::array<double, 6> location{};
  Vec3 carried_tilt =
      Vec3::Zero();  // rad: linear axes, a tilt that also turns what the axis carries
  // mm or rad: travel after a reversal over which the axis's play is taken up (kinematics/heading.hpp).
  double settling = 0.0;

  [[nodiscard]] bool depends_on_direction() const;
};

class GeometricErrors {
 public:
  AxisErrors& operator[](AxisLetter axis) { return axes_[static_cast<std::size_t>(axis)]; }
  const AxisErrors& operator[](AxisLetter axis) const {
    return axes_[static_cast<std::size_t>(axis)];
  }
  // Whether any error needs the headings of AxisState.
  [[nodiscard]] bool depends_on_direction() const;
  // These errors plus `factor` times the others; of two settling distances of an axis the longer.
  [[nodiscard]] GeometricErrors plus(const GeometricErrors& others, double factor) const;

 private:
  std::array<AxisErrors, 6> axes_{};
};

// A shape as people write it; spans are absent when the axis's default span is meant.
struct ErrorShape {
  enum class Kind : std::uint8_t { constant, linear, harmonic, table };
  Kind kind = Kind::constant;
  ParsedQuantity amount{};
  int order = 1;
  double phase = 0.0;               // rad
  std::optional<AxisRange> span{};  // mm or rad
  std::optional<double> zero{};     // mm or rad: where a linear term vanishes (default 0)
  std::vector<std::pair<double, double>> points{};  // table, internal units
};

// One error of a job or a command line: name and terms, with the text for the report.
struct ErrorEntry {
  std::string name{};
  std::string written{};
  std::vector<ErrorShape> terms{};
};

// "EB0C=30urad", "EXX=linear 10um", "EYX=harmonic 1 10um over 4.3mm..190mm phase 90deg"; terms are
// added with " + ": "EXY=harmonic 1 10um + -10um".
[[nodiscard]] Result<ErrorEntry> parse_error(std::string_view text);
// The [errors] table of a job: text as above, { value = .. }, { linear = .., span = [..] },
// { harmonic = k, amplitude = .. }, { table = [[q, v], ..], unit = ".." }, or an array of tables.
[[nodiscard]] std::vector<ErrorEntry> read_errors(const TomlTable& table);

// Default spans of shapes, by axis; axes not named use their travel.
using AxisSpans = std::map<AxisLetter, AxisRange>;

// Later entries replace earlier ones of the same error.
[[nodiscard]] Result<GeometricErrors> resolve(const Machine& machine,
                                              std::span<const ErrorEntry> entries,
                                              const AxisSpans& spans = {});

}  // namespace frustum::kinematics
