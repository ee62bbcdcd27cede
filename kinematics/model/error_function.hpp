// One component error as a function of where the machine's axes are: a sum of simple terms.
//
// Model    : of the own axis's position q:
//              constant   a
//              linear     s (q - q0)
//              polynomial c0 + c1 t + c2 t^2 + ..., t = (q - m)/r
//              harmonic   a cos(w (q - q0) + psi); a cyclic error is one, too
//              tent       a rise and a fall, straight
//              table straight or monotone cubic between its points, held at its ends or periodic
//            of its direction of motion:
//              reversal   a times the direction of approach, -1 .. +1
//            of two axes:
//              surface    bilinear between the points of a grid, held at its ends
//              modulated  any of these times a table of another axis
// Units    : q and value in mm or rad, whichever the axis and the error are
// Errors   : none; shapes are checked where they are read
// Source   : linear and harmonic of the ETH thesis, sections 3.8 and 3.9; monotone cubic of Fritsch
//            and Butland 1984, SIAM J. Sci. Stat. Comput. 5(2)
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "kinematics/model/axes.hpp"

namespace frustum::kinematics {

struct ConstantTerm {
  double value = 0.0;
};
struct LinearTerm {
  double slope = 0.0;
  double zero = 0.0;  // position where the term vanishes
};
struct PolynomialTerm {
  std::vector<double> coefficients{};  // of 1, t, t^2, ...
  double middle = 0.0;
  double reach = 1.0;  // t = (q - middle) / reach, held at -1 and 1
};
struct HarmonicTerm {
  double amplitude = 0.0;
  double angular_frequency = 0.0;  // rad per unit of q
  double origin = 0.0;
  double phase = 0.0;  // rad
};
struct ReversalTerm {
  double at_plus = 0.0;  // value after motion in +; after motion in - it is the opposite
};

struct TablePoint {
  double position = 0.0;
  double value = 0.0;
  double slope = 0.0;  // cubic tables
};
enum class TableKind : std::uint8_t { linear, cubic };
struct TableTerm {
  std::vector<TablePoint> points{};  // positions increase
  TableKind kind = TableKind::linear;
  bool periodic = false;  // the first point continues the last

  // Slopes of a cubic table are found here: no overshoot, level at the extremes.
  [[nodiscard]] static TableTerm of(std::vector<std::pair<double, double>> points, TableKind kind,
                                    bool periodic);
};
struct SurfaceTerm {
  AxisLetter first = AxisLetter::A;
  AxisLetter second = AxisLetter::C;
  std::vector<double> first_positions{};  // increasing
  std::vector<double> second_positions{};
  std::vector<double> values{};  // a row for each first position
};
// Rises from nothing at `lo` to its amplitude at `peak` and falls to nothing at `hi`; held outside.
// A peak outside leaves one of the two slopes.
struct TriangularTerm {
  double amplitude = 0.0;
  double lo = 0.0, peak = 0.0, hi = 0.0;
};
using PlainTerm = std::variant<ConstantTerm, LinearTerm, PolynomialTerm, HarmonicTerm, ReversalTerm,
                               TriangularTerm, TableTerm, SurfaceTerm>;
// A term times a factor that changes with the position of some axis.
struct ModulatedTerm {
  PlainTerm term{};
  AxisLetter axis = AxisLetter::B;
  TableTerm factor{};
};
using ErrorTerm = std::variant<ConstantTerm, LinearTerm, PolynomialTerm, HarmonicTerm, ReversalTerm,
                               TriangularTerm, TableTerm, SurfaceTerm, ModulatedTerm>;

class ErrorFunction {
 public:
  ErrorFunction() = default;
  explicit ErrorFunction(std::vector<ErrorTerm> terms);

  [[nodiscard]] bool is_zero() const { return terms_.empty(); }
  [[nodiscard]] bool depends_on_direction() const;
  // Of `axis`, where the axes are.
  [[nodiscard]] double operator()(AxisLetter axis, const AxisState& at) const {
    const double line = at_zero_ + slope_ * at.q[axis];
    return straight_ == terms_.size() ? line : line + bent(axis, at);
  }
  // This function plus `factor` times the other.
  [[nodiscard]] ErrorFunction plus(const ErrorFunction& other, double factor) const;

 private:
  [[nodiscard]] double bent(AxisLetter axis, const AxisState& at) const;

  std::vector<ErrorTerm> terms_;  // constants and lines first
  std::size_t straight_ = 0;      // how many those are, and their sum
  double at_zero_ = 0.0;
  double slope_ = 0.0;
};

}  // namespace frustum::kinematics
