// Motion tests that were measured (ball bar, R-test, laser, touch probe) as observations of the
// machine errors behind them.
//
// Model    : readings y of a test answer the tip's displacement G along directions e, the offset ds
//            of the ball in the spindle, and the unknowns s of its mounting:
//              y = f(errors) + R ds . e + M s + noise
//            A test becomes rows T y: the harmonics of a trace, not its samples, whose neighbours
//            are correlated; poses of an R-test; pose errors of touches. Combinations that the
//            mounting cannot make are kept, in reduced form: each names one row that no other has.
//            ds is an unknown of the study, common to the tests with one ball. f is exact; with
//            every estimate of errors and ds the mounting is found anew, so that its squares (a
//            ball that is off by d shows d^2 / 2L) go with it
// Units    : mm, rad
// Shape    : rows of all tests one after the other
// Errors   : nothing left of a test without its mounting; no reading
// Accuracy : rounding on exact readings
// Source   : ours; elimination of nuisance parameters by projection
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calibration/identify/refinement.hpp"
#include "calibration/identify/trial_model.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::calibration {

struct MeasuredMotion {
  std::string name{};
  std::string ball{};  // tests with the same one share ds; empty: ds is zero or does not matter
  std::optional<double> ball_known_to{};  // standard deviation of each component of ds beforehand
  double tool_length = 0.0;
  // Where each reading is taken, and along what it sees the tip move.
  std::vector<kinematics::AxisState> at{};
  std::vector<Vec3> along{};
  // What it would read with these errors, this ds and these unknowns of the mounting.
  std::function<Eigen::VectorXd(const kinematics::GeometricErrors&, const Vec3& ds,
                                const Eigen::VectorXd& mounting)>
      readings{};
  Eigen::MatrixXd of_mounting{};    // M: readings x unknowns of the mounting
  std::vector<Unknown> mounting{};  // as many names
  Eigen::MatrixXd rows{};           // T: rows x readings
  std::vector<Row> names{};         // as many as rows; the group is that of the test
  Eigen::VectorXd measured{};
  double noise = 0.0;                  // standard deviation of a reading
  kinematics::GeometricErrors base{};  // errors that are there whatever the causes
};

struct MotionObservations {
  Observations observations{};         // gain with all unknowns at zero
  Eigen::VectorXd without_unknowns{};  // rows with all unknowns at zero
  Model model{};
};

// The mounting with which these errors and ds explain the readings best: of those that do so as
// well the smallest. `rounds`: of Gauss-Newton; a millimetre off takes three.
[[nodiscard]] Eigen::VectorXd mounting_with(const MeasuredMotion& motion,
                                            const kinematics::GeometricErrors& errors,
                                            const Vec3& ds, int rounds = 3);

// Three unknowns, X, Y and Z in the frame of the tool, for each ball of the tests; what is known of
// a ball beforehand is what the first test that says it says.
[[nodiscard]] std::vector<Unknown> ball_unknowns(const std::vector<MeasuredMotion>& motions);

// The set-up of each test at values of the unknowns, those of the causes one by one, then the
// balls'.
struct FoundMounting {
  std::string test{};
  std::vector<Unknown> unknowns{};
  Eigen::VectorXd values{};
};
[[nodiscard]] std::vector<FoundMounting> found_mountings(const std::vector<MeasuredMotion>& motions,
                                                         const std::vector<Unknown>& unknowns,
                                                         const std::vector<Cause>& causes,
                                                         const Eigen::VectorXd& values);

// What of its mounting a test does not see to first order, as a table ball that is off across an
// axial bar, shows as the product of that and of what the errors move the ball by, over the length
// of the bar. Covariance of all rows for mountings that are known to `size`, one standard
// deviation, beforehand.
constexpr double kMountingSize = 0.03;  // mm
[[nodiscard]] Result<Eigen::MatrixXd> unseen_mounting_covariance(
    const std::vector<MeasuredMotion>& motions, const std::vector<Unknown>& unknowns,
    const std::vector<Cause>& causes, const Eigen::VectorXd& values, double size = kMountingSize);

// `unknowns`: those of the causes one by one, then the balls'. Causes without a machine error (tool
// radii) do nothing.
[[nodiscard]] Result<MotionObservations> observations_of(const kinematics::Machine& machine,
                                                         const std::vector<MeasuredMotion>& motions,
                                                         std::vector<Unknown> unknowns,
                                                         const std::vector<Cause>& causes);

// Standard deviation of white noise that leaves the same uncertainty as residuals whose neighbours
// are correlated: their root mean square times the root of the sum of their autocorrelation up to
// its first zero. `parameters`: that the residuals were fitted with.
[[nodiscard]] double effective_noise(const Eigen::VectorXd& residuals, int parameters);

}  // namespace frustum::calibration
