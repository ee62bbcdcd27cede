// What small errors of the points do to the parts of a non-negative value, and how far they may
// have set the value apart from the truth.
//
// Model    : a place moves with the elements it is made from (a column an independent error) or by
//            its own points (NonNegative::own), whichever is more. The standard uncertainty is that
//            of the place that makes the value, in its direction where it is well above its
//            uncertainty, in the worst one where it is not; of a peak to valley that of the
//            difference of its ends. Sizes are largest values, so noise makes them larger: a value
//            is above the truth by what noise does to the place that makes the value at most, and
//            below it by what noise does to the one that makes the truth. The first may be any that
//            is nearly as far, so the largest noise of all these is drawn; the second is one place.
//            No shape of the part is assumed
// Units    : mm
// Shape    : one characteristic; 40 draws or more
// Errors   : none
// Accuracy : the truth is within the bounds in 95 % of measurements or more
//            (tests/metrology/size_bounds_test.cpp). Draws are pure functions of their number
// Source   : JCGM 100:2008, section 5.1.2; Feldman, Cousins 1998 (how the 5 % are shared by the
//            ends near zero)
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "metrology/non_negative.hpp"

namespace frustum::metrology {

// How far the truth may be from a value, either way.
struct TruthBounds {
  double below = 0.0;
  double above = 0.0;
};

// Of a size with this standard uncertainty; `noise`: sizes that noise alone would give it. Changes
// their order.
[[nodiscard]] TruthBounds truth_bounds(double size, double standard, std::span<double> noise);

// Of all parts: a column an independent error of one standard deviation. Empty ones say nothing.
using PartAnswers = std::vector<Eigen::VectorXd>;

// The normal numbers of draws: pure functions of their places, which many characteristics ask for.
class NormalDraws {
 public:
  [[nodiscard]] double of_element(std::uint32_t draw, std::size_t error);
  [[nodiscard]] double of_place(std::uint32_t draw, std::size_t number);

 private:
  static double kept(std::vector<std::vector<double>>& known, RandomPurpose purpose,
                     std::uint32_t draw, std::size_t number);

  std::vector<std::vector<double>> elements_{};  // a row a draw
  std::vector<std::vector<double>> places_{};
};

class PartNoise {
 public:
  // `elements`: answers to the elements whose points or sections the parts are of; `others`: to
  // datums and machine. `probing`: standard deviation of a point. All outlive this.
  PartNoise(const NonNegative& parts, const PartAnswers& elements, const PartAnswers& others,
            double probing);

  [[nodiscard]] double standard() const;
  [[nodiscard]] TruthBounds bounds(NormalDraws& normals) const;

 private:
  // Where the size may come from: the places of a row that may be its peak and its valley, of a
  // size without valleys the first alone.
  struct Ends {
    std::vector<std::size_t> peaks{};
    std::vector<std::size_t> valleys{};
  };

  [[nodiscard]] std::size_t place_count() const;
  [[nodiscard]] Eigen::VectorXd part(std::size_t place) const;
  [[nodiscard]] bool stands_alone(std::size_t place) const;
  [[nodiscard]] Eigen::MatrixXd covariance(std::size_t place) const;
  [[nodiscard]] double standard_of(std::size_t place) const;
  [[nodiscard]] double standard_of_farthest() const;
  [[nodiscard]] double standard_of_ends() const;
  [[nodiscard]] std::vector<Ends> rows_within(double reach) const;
  [[nodiscard]] std::vector<Ends> places_within(double reach) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> toward(std::size_t place) const;

  const NonNegative& parts_;
  const PartAnswers& elements_;
  const PartAnswers& others_;
  double probing_;
  Eigen::Index per_place_;  // parts
  double factor_;           // of a distance in the size
};

}  // namespace frustum::metrology
