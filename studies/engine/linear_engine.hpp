// A million machines a second: the values of a linear model for many draws.
//
// Model    : draws in lanes of 16. A range is screened first: the gains, scaled by the largest
//            weights, are written as rank-r products in single precision; what that leaves out and
//            what single precision rounds is bounded for each draw. Only points within twice that
//            bound of the screen's extremes can be extremes; they are evaluated with all columns in
//            double precision, 8 partial sums in a fixed order. So the values are those of
//            evaluating every point, bit by bit
// Units    : weights mm and rad, values as the model makes them
// Shape    : any number of draws; parallel over blocks of 1,024 (oneTBB's arena of the caller)
// Errors   : none
// Accuracy : bit-equal for any lane, number of threads, and with and without AVX2, which is found
//            at run time (tests/studies/linear_engine_test.cpp)
// Source   : ours; truncated singular value decomposition: Eckart and Young 1936
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "studies/engine/linear_model.hpp"
#include "studies/laws/factors.hpp"
#include "studies/laws/scheme.hpp"

namespace frustum::studies {

enum class Lanes : std::uint8_t { best, plain };  // plain: without AVX2

class LinearEngine {
 public:
  // Copies what it needs.
  LinearEngine(const FactorSet& set, const LinearModel& model, Lanes lanes = Lanes::best);

  [[nodiscard]] std::size_t characteristic_count() const;

  // Draws first .. first + count - 1 of a scheme: characteristic after characteristic, each with
  // `count` values.
  [[nodiscard]] std::vector<double> evaluate(const Scheme& scheme, std::uint64_t seed,
                                             std::uint32_t first, std::uint32_t count) const;
  // Of given values of all variables, a row a draw.
  [[nodiscard]] std::vector<double> evaluate_values(std::span<const double> values) const;
  // Of given weights of all columns, a row a draw.
  [[nodiscard]] std::vector<double> evaluate_weights(std::span<const double> weights) const;

  // What the screens are made of, for reports and tests.
  struct Screen {
    std::size_t columns = 0;  // that move any point
    std::size_t rank = 0;     // of the screen
    double left_out = 0.0;    // bound of what the rank leaves out, unit of the values
  };
  [[nodiscard]] Screen screen(std::size_t characteristic) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace frustum::studies
