// Many machines that cut and measure one job: whole trials, but for what they have in common.
//
// Model    : the job is cut and measured once by the machine in the middle of all laws. Each
//            contact of the probe's ball keeps the pieces of commanded motion around it. A draw
//            moves the cutter along these pieces by its own exact chain, and the contact is solved
//            anew: the ball's centre on its line of approach and the time on the piece, where the
//            distance from the cutter and its change with time vanish; between two pieces also the
//            edge that both leave. That nothing else reaches the contact is shown by the distances
//            of the middle machine less how much other parts of the path may move relatively, on
//            any machine within its laws or else on this one. Where it is not shown the draw's
//            cutter is swept near by ("local"), or the whole program is ("whole"). Then the plan is
//            evaluated as the CMM does: datum features first, and the others where the datum system
//            of the draw has them
// Units    : mm, rad
// Shape    : one call for any number of draws; parallel over blocks of draws (oneTBB's arena of the
//            caller), the same bits for any number of threads, blocks or neighbours in a block
// Errors   : make(): those of the middle machine's trial; "population-whole". evaluate(): a draw
//            that fails has its diagnostics; the others go on. What cannot be followed is no error:
//            it is asked whole, and reasons() says why
// Accuracy : follows the commanded motion itself, so that path_bound enters only where points are
//            local or whole: within 2 nm of run_trial() with a path_bound of 1 nm, which itself is
//            within its path_bound of the motion (tests/trials/population_test.cpp)
// Speed    : bench/population_bench.cpp
// Source   : envelope condition of swept volumes; ours
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "kinematics/model/machine.hpp"
#include "metrology/cmm.hpp"
#include "metrology/measurement.hpp"
#include "programs/test_piece.hpp"
#include "trials/population/population_laws.hpp"
#include "trials/surface_gain.hpp"
#include "trials/trial.hpp"

namespace frustum::trials {

struct PopulationOptions {
  double path_bound = 1e-6;  // mm, of what is swept locally or whole
  bool follow = true;        // false: every draw is a whole trial; for comparison
  // make() refuses a job with a point that every draw would have to ask of the whole program.
  bool refuse_whole = false;
};

// One machine of the population and the part that it makes.
struct PopulationMember {
  // Of the plan's characteristics, in its order, as values_of() gives them: mm, rad (those with a
  // nominal value as measured, not as a deviation). Empty: the draw failed.
  std::vector<double> values{};
  // Of each probed point, features and points in the order of the plan: from the planned point to
  // where the ball touched, the ball's radius taken off against the approach, mm along the planned
  // normal. The CMM approaches in the datum system of this draw. Only if asked for.
  std::vector<double> travels{};
  Pose workpiece_from_datum{};  // in which these points were approached
  std::size_t local = 0;        // points that were swept near by
  std::size_t whole = 0;        // points that were asked of the whole program
  Diagnostics failure{};        // why there are no values
};

struct EvaluateOptions {
  bool travels = false;
  // The CMM of the draw at a place of the span; empty: one without errors.
  std::function<metrology::CmmModel(std::size_t)> cmm{};
};

class Population {
 public:
  // Copies what it needs.
  [[nodiscard]] static Result<Population> make(const kinematics::Machine& machine,
                                               const programs::TestPiece& piece,
                                               const CommandedPiece& commanded,
                                               const PopulationLaws& laws,
                                               const PopulationOptions& options = {});

  [[nodiscard]] std::vector<PopulationMember> evaluate(std::span<const Weights> draws,
                                                       const EvaluateOptions& options = {}) const;

  // Of the machine in the middle: its measurement, without errors of the CMM.
  [[nodiscard]] const Trial& middle_trial() const;
  [[nodiscard]] const PopulationLaws& laws() const;
  // All points of the plan, as in PopulationMember::travels.
  [[nodiscard]] std::size_t point_count() const;

  // For linear engines: the motion of every measured point of the middle machine along its normal,
  // mm per unit of weight; rows in the order of travels, columns those of the laws
  // (surface_gain.hpp). The even part is what a face cut by a leaning end of a cutter adds:
  // where it is not zero a point is not linear in the weights.
  [[nodiscard]] Result<SurfaceGains> gains() const;
  // What the plan says of the middle machine's points, each moved by this along its normal (mm).
  // As evaluate() gives it; the datum system follows the points.
  [[nodiscard]] Result<std::vector<double>> evaluate_moved(std::span<const double> moved) const;

  // Why points cannot be followed for any draw, once each: "reversal of X", "concave cutter", ...
  struct Reason {
    std::string why{};
    std::size_t points = 0;
  };
  [[nodiscard]] std::vector<Reason> reasons() const;

 private:
  struct State;
  explicit Population(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

}  // namespace frustum::trials
