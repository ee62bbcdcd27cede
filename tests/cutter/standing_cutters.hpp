// Standing cutters in long double: what a swept cutter covers, told without envelopes and chords.
//
// Model    : a meridian of lines and arcs with its signed distance; a point's depth in a sweep is
//            the least signed distance over all times. The search over time throws away spans of
//            times only when a bound on the motion proves that they hold nothing lower
// Units    : mm, rad; frames: tool (meridian), workpiece (motions)
// Errors   : none; meridians and motions are given by tests
// Accuracy : convex bodies: proven to 1e-4 nm. Others: times at 0.5 um of motion or closer (0.05 mm
//            while the distance stays the same), then the valley between three of them to 1e-4 nm
#pragma once

#include <Eigen/Core>
#include <vector>

#include "kinematics/path/tool_path.hpp"

namespace frustum::proof {

using Real = long double;
using Vec3L = Eigen::Matrix<Real, 3, 1>;

// From the axis round the end and up to the top, which a flat face closes.
class Meridian {
 public:
  explicit Meridian(Real z_on_axis = 0) : last_r_(0), last_z_(z_on_axis) {}
  Meridian& line_to(Real r, Real z);
  // The shorter way round the centre.
  Meridian& arc_to(Real r, Real z, Real centre_r, Real centre_z);

  // Negative inside.
  [[nodiscard]] Real distance(Real r, Real z) const;
  [[nodiscard]] Real height() const { return last_z_; }
  [[nodiscard]] Real max_radius() const { return max_radius_; }
  // A point of the generatrix, u in [0, 1], and the outward direction there or roughly so.
  struct Spot {
    Real r = 0, z = 0;
  };
  [[nodiscard]] Spot spot(Real u) const;

 private:
  struct Piece {
    Real r0 = 0, z0 = 0, r1 = 0, z1 = 0;
    Real arc = 0, centre_r = 0, centre_z = 0;  // arc 0: a line
  };
  [[nodiscard]] static Real piece_distance(const Piece& piece, Real r, Real z);
  [[nodiscard]] static bool crosses(const Piece& piece, Real r, Real z);

  std::vector<Piece> pieces_;
  Real last_r_;
  Real last_z_;
  Real max_radius_ = 0;
};

struct StandingMotion {
  StandingMotion(const kinematics::ToolPose& from, const kinematics::ToolPose& to);
  [[nodiscard]] Real distance(const Meridian& body, const Vec3L& point, Real t) const;

  Vec3L tip, travel, axis, across;  // axis(t) = cos(turn t) axis + sin(turn t) across
  Real turn;
};

class StandingCutters {
 public:
  StandingCutters(Meridian body, bool is_convex, const kinematics::ToolPath& path);

  // The least signed distance of the point to any standing cutter at any time. Values above
  // `of_interest` need not be found exactly; the search ends when one below `deep_enough` is found.
  [[nodiscard]] Real depth(const Vec3L& point, Real of_interest = 1e-5L,
                           Real deep_enough = -1e-5L) const;
  // Signed distance at one time of one segment.
  [[nodiscard]] Real distance_at(std::size_t segment, double t, const Vec3L& point) const {
    return motions_[segment].distance(body_, point, t);
  }
  [[nodiscard]] const Meridian& body() const { return body_; }
  [[nodiscard]] const std::vector<StandingMotion>& motions() const { return motions_; }

 private:
  struct Search;
  Meridian body_;
  bool is_convex_;
  std::vector<StandingMotion> motions_;
};

}  // namespace frustum::proof
