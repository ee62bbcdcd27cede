// Two bodies of a machine along a program: where they meet, and how near they come.
//
// Model    : conservative advancement. The distance d at axis positions q0 proves, with a bound of
//            what the axes can take away of it (stock/collision/body_motion.hpp), that the bodies
//            are apart up to where the bound reaches d. That place is found along the program, most
//            often many blocks ahead, and the distance there is found again: nothing is passed
//            over, however fast the axes are. The bodies have met where they are within kMeeting
// Units    : mm
// Errors   : none
// Accuracy : the smallest distance is found within kNearness + 1 % of it. Where bodies have met
//            they are followed in steps of 1 mm, or of 1/64 of a way, until they are apart again
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "stock/collision/body_motion.hpp"
#include "stock/collision/machine_scene.hpp"

namespace frustum::stock {

// Between vertices the axes move evenly.
struct AxisVertex {
  AxisPositions q{};
  std::uint32_t move = 0;  // of those that the vertex's way comes from
  int tool = 0;            // in the spindle on this way
};

// Twice what the axes may be off the even motion between vertices, and far below what matters.
inline constexpr double kMeeting = 0.02;   // mm
inline constexpr double kNearness = 0.01;  // mm

class PairWatch {
 public:
  // The bodies must outlive the watch.
  PairWatch(const kinematics::Machine& machine, const SceneBody& a, const SceneBody& b);

  // The ways between these vertices; the first was the last before.
  void follow(std::span<const AxisVertex> vertices);

  [[nodiscard]] const SceneBody& first() const { return *a_; }
  [[nodiscard]] const SceneBody& second() const { return *b_; }
  [[nodiscard]] Separation separation_at(const AxisPositions& q) const;

  struct Meeting {
    std::uint32_t first_move = 0, last_move = 0;
    AxisPositions q{};          // where it begins
    Vec3 point = Vec3::Zero();  // in the frame of the bed
  };
  [[nodiscard]] const std::vector<Meeting>& meetings() const { return meetings_; }
  struct Nearest {
    double distance = 0.0;  // 0: they have met
    std::uint32_t move = 0;
  };
  // Nothing: the bodies were never there together.
  [[nodiscard]] const std::optional<Nearest>& nearest() const { return nearest_; }

 private:
  void follow(const AxisPositions& from, const AxisVertex& vertex);
  void look(const AxisPositions& q, std::uint32_t move);
  void meet(const AxisPositions& q, std::uint32_t move, const Separation& apart);
  void certify(const AxisPositions& q, const Separation& apart);
  [[nodiscard]] double limit_from(double lower) const;
  // By how much the distance that is proven there is above the limit: nothing is, if not above 0.
  [[nodiscard]] double spare_at(const AxisPositions& q) const {
    return clear_ - bound_.at(q) - limit_;
  }
  [[nodiscard]] double proven_to(const AxisPositions& from, const AxisPositions& to,
                                 double u) const;

  const kinematics::Machine* machine_;
  const SceneBody* a_;
  const SceneBody* b_;
  kinematics::MachinePart common_{};
  BodyBranch branch_a_, branch_b_;
  int tool_ = 0;  // 0: any
  bool is_followed_ = false;
  bool has_met_ = false;
  double clear_ = 0.0;  // the distance that is proven where bound_ begins
  double limit_ = 0.0;
  ClosingBound bound_{};
  std::vector<Meeting> meetings_{};
  std::optional<Nearest> nearest_{};
};

}  // namespace frustum::stock
