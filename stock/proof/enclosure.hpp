// Intervals that surely hold the true value: what proofs compute with.
//
// Model    : Boost.Interval with a rounding policy of our own. Every operation rounds to nearest,
//            which is off by half a unit in the last place at most, and is then widened by more
//            than that on either side; the processor's rounding mode is left alone, so that neither
//            the optimiser nor other threads can spoil a bound. Only + - * / and the square root
//            are used, which IEEE 754 rounds correctly: no sine or cosine has to be trusted
// Units    : those of the numbers
// Errors   : none; what overflows encloses infinity, which no comparison takes for proven
// Source   : Moore 1966; IEEE 754-2019, section 5.4.1
#pragma once

#include <array>
#include <boost/numeric/interval.hpp>
#include <cmath>
#include <limits>

#include "core/pose.hpp"

namespace frustum::stock {

struct WidenedRounding {
  using unprotected_rounding = WidenedRounding;

  static double add_down(double a, double b) { return below(a + b); }
  static double add_up(double a, double b) { return above(a + b); }
  static double sub_down(double a, double b) { return below(a - b); }
  static double sub_up(double a, double b) { return above(a - b); }
  static double mul_down(double a, double b) { return below(a * b); }
  static double mul_up(double a, double b) { return above(a * b); }
  static double div_down(double a, double b) { return below(a / b); }
  static double div_up(double a, double b) { return above(a / b); }
  static double sqrt_down(double a) { return below(std::sqrt(a)); }
  static double sqrt_up(double a) { return above(std::sqrt(a)); }
  static double median(double a, double b) { return 0.5 * (a + b); }
  static double conv_down(double a) { return a; }
  static double conv_up(double a) { return a; }

 private:
  // Twice the largest rounding error of a result of this size; the second term is for underflow.
  static double slack(double x) {
    return std::abs(x) * std::numeric_limits<double>::epsilon() +
           std::numeric_limits<double>::denorm_min();
  }
  static double below(double x) { return x - slack(x); }
  static double above(double x) { return x + slack(x); }
};

using Enclosure = boost::numeric::interval<
    double, boost::numeric::interval_lib::policies<
                WidenedRounding, boost::numeric::interval_lib::checking_base<double>>>;

struct Enclosure3 {
  Enclosure x{}, y{}, z{};
};

[[nodiscard]] inline Enclosure3 enclose(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
// All vectors no farther than `radius` from v.
[[nodiscard]] inline Enclosure3 enclose(const Vec3& v, double radius) {
  const Enclosure r(-radius, radius);
  return {v.x() + r, v.y() + r, v.z() + r};
}
[[nodiscard]] inline Enclosure3 operator+(const Enclosure3& a, const Enclosure3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] inline Enclosure3 operator-(const Enclosure3& a, const Enclosure3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline Enclosure3 operator*(const Enclosure& f, const Enclosure3& a) {
  return {f * a.x, f * a.y, f * a.z};
}
[[nodiscard]] inline Enclosure dot(const Enclosure3& a, const Enclosure3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] inline Enclosure3 cross(const Enclosure3& a, const Enclosure3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline Enclosure length(const Enclosure3& a) {
  return boost::numeric::sqrt(boost::numeric::square(a.x) + boost::numeric::square(a.y) +
                              boost::numeric::square(a.z));
}

}  // namespace frustum::stock
