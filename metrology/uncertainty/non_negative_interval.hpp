// Intervals that hold the true size of a form, a zone or an offset in 95 % of measurements.
//
// Model    : parts measured = parts of the part + noise. Noise makes sizes larger, so an interval
//            about the measured size would be too high, and would never hold a true size of 0.
//            Instead every true size t is asked whether the measured size v is a likely one: with
//            true parts t s, s a shape of size 1, v must be between the quantiles a1 and 1 - a2 of
//            size(t s + noise). The interval is of all t that answer yes. a1 + a2 = 5 %; their
//            split is that of the likelihood ratio for a normal value with a limit at 0, shifted as
//            the mean of size(t s + noise) is from that of noise alone: a1 = 0 at t = 0, 2.5 % far
//            from it. So the interval is never empty and holds a true 0 in exactly 95 %. s is the
//            measured parts with the noise taken out of them: of the waves that a rough surface is
//            made of (the modes of exp(-distance/size), where noise has the variance 1 each) those
//            are kept that are more likely there than not. How many there are and how high is
//            weighed by how well it explains all of them; long waves are likelier than short ones
// Units    : as the parts
// Shape    : parts in rows, draws of the noise in columns
// Errors   : none; noise that is zero gives the measured size itself
// Accuracy : coverage 95 % for no form, 93 % to 97 % for most others; 89 % at worst, of a cone
//            whose lobes are 5 times the noise; of zones 92 % to 99 % of perfect features, 84 % at
//            worst of an eccentric journal (docs/uncertainty.md, tests/metrology/coverage_test.cpp,
//            zone_coverage_test.cpp)
// Source   : Feldman, Cousins 1998 (ordering); Chuang, Lai 2000 (inversion of tests along an
//            estimated shape); Johnstone, Silverman 2004 (which waves are there)
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "metrology/non_negative.hpp"

namespace frustum::metrology {

// Takes the noise out of parts.
class ShapeEstimate {
 public:
  // `noise`: a column a draw, at least a few times as many as parts.
  ShapeEstimate(SizeRule rule, std::span<const Vec3> places, const Eigen::MatrixXd& noise);

  // Of size 1.
  [[nodiscard]] Eigen::VectorXd operator()(const Eigen::VectorXd& parts) const;

 private:
  void thin(std::span<const Vec3> places, Eigen::Index per_place);
  [[nodiscard]] Eigen::VectorXd smoothed(const Eigen::VectorXd& parts) const;

  SizeRule rule_;
  Eigen::VectorXd any_{};  // a shape for parts that are all 0
  // Of many places these few tell the shape; each other one is like the nearest of them.
  std::vector<Eigen::Index> chosen_{};
  std::vector<Eigen::Index> nearest_{};
  Eigen::MatrixXd to_modes_{};  // in which noise has the variance 1
  Eigen::MatrixXd from_modes_{};
};

struct SizeInterval {
  double low = 0.0;
  double high = 0.0;
  double standard = 0.0;  // standard deviation of the size of what the part most likely is
};

// Sizes of a part of one shape under noise.
class SizeUnderNoise {
 public:
  // Noise and shape outlive this.
  SizeUnderNoise(SizeRule rule, const Eigen::MatrixXd& noise, const Eigen::VectorXd& shape,
                 double coverage = 0.95);

  // Whether `measured` is a likely size of a part whose size is `truth`.
  [[nodiscard]] bool accepts(double measured, double truth) const;
  [[nodiscard]] SizeInterval interval(double measured) const;

 private:
  struct Likely {
    double low = 0.0;
    double high = 0.0;
    double mean = 0.0;
    double deviation = 0.0;
  };
  [[nodiscard]] std::vector<double> sizes(double truth) const;
  [[nodiscard]] Likely likely(double truth) const;

  SizeRule rule_;
  const Eigen::MatrixXd& noise_;
  const Eigen::VectorXd& shape_;
  double coverage_;
  double mean_at_zero_ = 0.0;
  double largest_ = 0.0;  // size of noise alone
};

// Probabilities beyond the two ends of the region that accepts a normal value of mean `shift` >= 0
// and deviation 1, when no mean is negative.
struct Tails {
  double low = 0.0;
  double high = 0.0;
};
[[nodiscard]] Tails tails_near_zero(double shift, double coverage);

}  // namespace frustum::metrology
