// The machine in one position as matrices: mass, stiffness, damping, and where the tip is in them.
//
// Model    : absolute coordinates in the frame of the machine, for each body the displacement u of
//            its centre and its small rotation t, body after body: the bed, then the axes. x is the
//            deviation from where the commands have the body. An element at P along n between
//            bodies j and i has the elongation
//              n.(u_j + t_j x (P - C_j)) - n.(u_i + t_i x (P - C_i)) = b.x,  or  n.(t_j - t_i)
//            K = sum k b b^T, D = sum d b b^T, M = diag(m 1, R I R^T)
//            Tip: displacement and rotation of the tool less those of the workpiece, at the nominal
//            tip
// Units    : SI; positions of the axes and the tool length in mm, rad as everywhere
// Shape    : 6 (1 + axes) coordinates
// Errors   : none; loose_body says which body nothing holds
// Accuracy : 1e-8 of the largest entry against relative coordinates with particles
//            (tests/dynamics/reference_test.cpp)
// Source   : ETH thesis, chapters 5 and 6
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"
#include "dynamics/dynamic_model.hpp"
#include "kinematics/model/axes.hpp"

namespace frustum::dynamics {

using Row6 = Eigen::Matrix<double, 6, 1>;

// The elongation of one spring: `outer` is body j, `inner` body i, -1 the ground.
struct ElementRow {
  int outer = 0;
  int inner = -1;
  Row6 of_outer = Row6::Zero();
  Row6 of_inner = Row6::Zero();

  [[nodiscard]] double of(const Eigen::VectorXd& x) const;
  [[nodiscard]] Eigen::VectorXd dense(Eigen::Index coordinates) const;
};

struct Element {
  ElementRow row{};
  SpringDamper spring{};
  bool is_drive = false;
};

// Where a body is, in the frame of the machine.
struct BodyPlace {
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Identity();
  double mass = 1.0;
};

// Where a joint is and how it moves its body.
struct JointPlace {
  Pose machine_from_fixed{};   // the joint's frame at zero
  Pose machine_from_moving{};  // the body's frame
  Vec3 direction = Vec3::UnitX();
};

struct Structure {
  Eigen::MatrixXd mass{};
  Eigen::MatrixXd stiffness{};
  Eigen::MatrixXd damping{};
  Eigen::MatrixXd tip{};  // 6 rows: displacement, rotation
  Mat3 machine_from_table = Mat3::Identity();
  Vec3 tip_in_machine = Vec3::Zero();
  std::vector<BodyPlace> bodies{};
  std::vector<JointPlace> joints{};
  std::vector<Element> elements{};

  [[nodiscard]] Eigen::Index coordinates() const {
    return 6 * static_cast<Eigen::Index>(bodies.size());
  }
  [[nodiscard]] Eigen::MatrixXd tip_displacement() const { return tip.topRows(3); }
};

enum class Drives { springs, none };  // none: controlled axes are without the springs of drives

// Where everything is, without the matrices and the rows of the tip: enough for static_chain.hpp.
[[nodiscard]] Structure layout_at(const DynamicModel& model, const kinematics::AxisPositions& q,
                                  double tool_length, Drives drives = Drives::springs);
[[nodiscard]] Structure structure_at(const DynamicModel& model, const kinematics::AxisPositions& q,
                                     double tool_length, Drives drives = Drives::springs);

// The elongation along or about an axis at a point of it: what a drive or a scale is for.
[[nodiscard]] ElementRow row_along_axis(const DynamicModel& model, const Structure& structure,
                                        std::size_t axis, const Vec3& at, Attached on);

// M = L L^T; blocks of a body are its own.
[[nodiscard]] Eigen::MatrixXd mass_root(const Structure& structure);
// L^-1 matrix L^-T.
[[nodiscard]] Eigen::MatrixXd mass_normalised(const Eigen::MatrixXd& root,
                                              const Eigen::MatrixXd& matrix);

// A body that can move without a force, and which key of [dynamics] would hold it.
struct LooseBody {
  std::string key{};
  Diagnostic problem{};
};
[[nodiscard]] std::optional<LooseBody> loose_body(const DynamicModel& model,
                                                  const Structure& structure);

}  // namespace frustum::dynamics
