// A pose that is being moved from the left, joint by joint: two columns of its rotation by rows,
// and its translation. The third column is the cross product of the others, taken at the end.
//
// Model    : a rotation of the pose is a sum of multiples of rows; rotations about X, Y and Z touch
//            two of them. A row of two numbers is one vector register.
// Units    : mm, rad
// Errors   : none
#pragma once

#include "core/pose.hpp"
#include "kinematics/model/small_rotation.hpp"

namespace frustum::kinematics {

class PoseRows {
 public:
  explicit PoseRows(const Vec3& translation)
      : tx_(translation.x()), ty_(translation.y()), tz_(translation.z()) {}

  void shift(const Vec3& by) {
    tx_ += by.x();
    ty_ += by.y();
    tz_ += by.z();
  }
  void turn(const Mat3& r) {
    const Row x = r(0, 0) * x_ + r(0, 1) * y_ + r(0, 2) * z_;
    const Row y = r(1, 0) * x_ + r(1, 1) * y_ + r(1, 2) * z_;
    z_ = r(2, 0) * x_ + r(2, 1) * y_ + r(2, 2) * z_;
    x_ = x;
    y_ = y;
    const double tx = r(0, 0) * tx_ + r(0, 1) * ty_ + r(0, 2) * tz_;
    const double ty = r(1, 0) * tx_ + r(1, 1) * ty_ + r(1, 2) * tz_;
    tz_ = r(2, 0) * tx_ + r(2, 1) * ty_ + r(2, 2) * tz_;
    tx_ = tx;
    ty_ = ty;
  }
  void turn_x(const SineCosine& a) {
    turn(y_, z_, a);
    turn(ty_, tz_, a);
  }
  void turn_y(const SineCosine& a) {
    turn(z_, x_, a);
    turn(tz_, tx_, a);
  }
  void turn_z(const SineCosine& a) {
    turn(x_, y_, a);
    turn(tx_, ty_, a);
  }
  // By angles about X, Y and Z, multiplied in the given order; those that are zero cost nothing.
  void turn(const Vec3& angles, RotationOrder order) {
    const bool x_first = order == RotationOrder::zyx;
    if (x_first && angles.x() != 0.0) turn_x(sine_cosine(angles.x()));
    if (!x_first && angles.z() != 0.0) turn_z(sine_cosine(angles.z()));
    if (angles.y() != 0.0) turn_y(sine_cosine(angles.y()));
    if (x_first && angles.z() != 0.0) turn_z(sine_cosine(angles.z()));
    if (!x_first && angles.x() != 0.0) turn_x(sine_cosine(angles.x()));
  }

  [[nodiscard]] Pose pose() const {
    Pose p;
    p.rotation << x_[0], x_[1], y_[0] * z_[1] - z_[0] * y_[1],  //
        y_[0], y_[1], z_[0] * x_[1] - x_[0] * z_[1],            //
        z_[0], z_[1], x_[0] * y_[1] - y_[0] * x_[1];
    p.translation << tx_, ty_, tz_;
    return p;
  }

 private:
  using Row = Eigen::Array2d;

  template <typename Numbers>
  static void turn(Numbers& first, Numbers& second, const SineCosine& a) {
    const Numbers turned = a.cosine * first - a.sine * second;
    second = a.sine * first + a.cosine * second;
    first = turned;
  }

  Row x_{1.0, 0.0}, y_{0.0, 1.0}, z_{0.0, 0.0};
  double tx_, ty_, tz_;
};

}  // namespace frustum::kinematics
