// What one NC block commands: the positions of all axes as a function of u in [0, 1].
//
// Model    : three ways to move. Axes: every axis linear. Words: X Y Z on a line or arc as axis
//            positions, rotary axes linear (tool centre point control off). Tip: the tip on a line
//            or arc in the programmed frame, rotary axes linear or the tool axis on the great
//            circle, linear axes by the closed form of the nominal machine (tool centre point
//            control on, tilted plane)
// Units    : mm, rad
// Errors   : a great circle that the machine cannot follow
#pragma once

#include <array>
#include <memory>
#include <span>
#include <variant>

#include "core/result.hpp"
#include "kinematics/controller/orientation_path.hpp"
#include "kinematics/controller/tip_curve.hpp"
#include "kinematics/controller/tip_frame.hpp"
#include "kinematics/model/axes.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

[[nodiscard]] Vec3 linear_positions(const AxisPositions& q);
[[nodiscard]] AxisPositions with_linear_positions(AxisPositions q, const Vec3& xyz);
// A fraction u of the way, every axis on its own.
[[nodiscard]] AxisPositions part_way(const AxisPositions& from, const AxisPositions& to, double u);
// Equal parts of a motion so fine that what bends or repeats within it cannot hide between them;
// `arc_turn`: rad of a curve in the programmed frame.
[[nodiscard]] int least_parts(const AxisPositions& from, const AxisPositions& to,
                              double arc_turn = 0.0);

// A value of some 300 bytes, so that a program of a million blocks fits into memory; the machine
// must outlive it.
class BlockMotion {
 public:
  [[nodiscard]] AxisPositions at(double u) const;
  [[nodiscard]] const AxisPositions& start() const { return start_; }
  [[nodiscard]] const AxisPositions& end() const { return end_; }
  // Every axis moves evenly.
  [[nodiscard]] bool straight() const;
  // u in (0, 1), increasing: where the axes change their law.
  [[nodiscard]] std::span<const double> breaks() const;
  // What the feed counts, uniform in u: mm of the tip or of the linear axes; degrees of the rotary
  // axes where those are at rest.
  [[nodiscard]] double feed_length() const { return feed_length_; }
  [[nodiscard]] int least_parts() const;

 private:
  using RotaryPositions = std::array<double, 3>;  // A, B, C
  struct AxesLaw {
    AxisPositions to{};
  };
  struct WordsLaw {
    RotaryPositions rotary_to{};
    TipCurve words{};
    Vec3 shift = Vec3::Zero();
  };
  struct TipLaw {
    const Machine* machine = nullptr;
    RotaryPositions rotary_to{};
    TipCurve tip{};
    std::shared_ptr<const TipFrame> frame{};
  };
  struct VectorLaw {
    const Machine* machine = nullptr;
    std::shared_ptr<const OrientationPath> orientation{};
    TipCurve tip{};
    std::shared_ptr<const TipFrame> frame{};
  };
  using Law = std::variant<AxesLaw, WordsLaw, TipLaw, VectorLaw>;

  friend BlockMotion axes_motion(const AxisPositions& from, const AxisPositions& to);
  friend BlockMotion words_motion(const AxisPositions& from, const AxisPositions& rotary_to,
                                  const TipCurve& words, const Vec3& shift);
  friend BlockMotion tip_motion(const Machine& machine, const AxisPositions& from,
                                const AxisPositions& rotary_to, const TipCurve& tip,
                                std::shared_ptr<const TipFrame> frame);
  friend Result<BlockMotion> vector_motion(const Machine& machine, const AxisPositions& from,
                                           const Vec3& to_tool_axis, const TipCurve& tip,
                                           std::shared_ptr<const TipFrame> frame);

  BlockMotion(const AxisPositions& from, Law law, double linear);

  [[nodiscard]] AxisPositions position(const AxesLaw& law, double u) const;
  [[nodiscard]] AxisPositions position(const WordsLaw& law, double u) const;
  [[nodiscard]] AxisPositions position(const TipLaw& law, double u) const;
  [[nodiscard]] AxisPositions position(const VectorLaw& law, double u) const;
  [[nodiscard]] AxisPositions with_rotary(const RotaryPositions& to, double u) const;
  [[nodiscard]] double arc_turn() const;  // rad: of the curve in the programmed frame

  AxisPositions start_{};
  Law law_;
  AxisPositions end_{};
  double feed_length_ = 0.0;
};

[[nodiscard]] BlockMotion axes_motion(const AxisPositions& from, const AxisPositions& to);

// `shift`: what to add to X Y Z words to get axis positions.
[[nodiscard]] BlockMotion words_motion(const AxisPositions& from, const AxisPositions& rotary_to,
                                       const TipCurve& words, const Vec3& shift);

// Blocks share their frame.
[[nodiscard]] BlockMotion tip_motion(const Machine& machine, const AxisPositions& from,
                                     const AxisPositions& rotary_to, const TipCurve& tip,
                                     std::shared_ptr<const TipFrame> frame);
// The tool axis, in the table frame, runs on the great circle.
[[nodiscard]] Result<BlockMotion> vector_motion(const Machine& machine, const AxisPositions& from,
                                                const Vec3& to_tool_axis, const TipCurve& tip,
                                                std::shared_ptr<const TipFrame> frame);

}  // namespace frustum::kinematics
