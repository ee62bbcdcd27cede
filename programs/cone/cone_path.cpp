#include "programs/cone/cone_path.hpp"
#include "core/constants.hpp"

#include <cmath>
#include <numbers>

namespace frustum::programs {
namespace {

using kinematics::ToolPose;

constexpr double kClear = 30.0;       // mm above the part, where the tool may travel freely
constexpr double kRoughChord = 2e-3;  // mm: a hundredth of the stock that finishing removes
constexpr double kRingStep = 1.4;     // of the cutter radius between neighbouring roughing rings

// Number of equal chords of a full circle that stay within `tolerance` of it.
int chords_of_circle(double radius, double tolerance) {
  return std::max(16, static_cast<int>(std::ceil(kTurn / std::sqrt(8.0 * tolerance / radius))));
}

// Builds moves in the workpiece frame and turns them into program coordinates.
class ConePath {
 public:
  ConePath(const ConeFrustum& cone, const ConeGeometry& shape)
      : cone_(cone),
        shape_(shape),
        program_from_workpiece_(rotation_z(cone.orientation.value) *
                                rotation_y(cone.inclination.value)),
        start_(cone.start_angle ? cone.start_angle->value : default_start(cone)) {}

  std::vector<PathOperation> operations() {
    return {cylinder_roughing(), cylinder_finishing(), groove(),
            cone_pass("cone roughing", cone_.allowance.value, kRoughChord),
            cone_pass("cone finishing", 0.0, cone_.chord_tolerance.value)};
  }

 private:
  static double default_start(const ConeFrustum& cone) {
    // The pole is on the path when both angles are equal; 1e-9 rad separates equal from written so.
    const bool equal = std::abs(cone.cone_angle.value - cone.inclination.value) < 1e-9;
    return equal ? std::numbers::pi : 0.0;
  }

  [[nodiscard]] PathMove move(const Vec3& tip, const Vec3& axis, bool rapid) const {
    return {{program_from_workpiece_ * tip, (program_from_workpiece_ * axis).normalized()}, rapid};
  }
  [[nodiscard]] PathMove upright(const Vec3& tip, bool rapid = false) const {
    return move(tip, Vec3::UnitZ(), rapid);
  }

  static Vec3 on_circle(double radius, double phi, double z) {
    return {radius * std::cos(phi), radius * std::sin(phi), z};
  }
  static Vec3 tangent(double phi) { return {-std::sin(phi), std::cos(phi), 0.0}; }

  [[nodiscard]] double clear_z() const { return shape_.top_z + kClear; }
  // Long enough that the cutter has left the finished wall before it moves along its axis.
  [[nodiscard]] double lead() const { return 3.0 * shape_.cutter_radius; }

  void ring(std::vector<PathMove>& moves, double radius, double tolerance) const {
    const int chords = chords_of_circle(radius, tolerance);
    for (int i = 1; i <= chords; ++i) {
      moves.push_back(upright(on_circle(radius, start_ + kTurn * i / chords, shape_.floor_z)));
    }
  }

  [[nodiscard]] PathOperation cylinder_roughing() const {
    PathOperation op{.name = "cylinder roughing"};
    const double outside = shape_.blank_radius + shape_.cutter_radius + 3.0;
    op.lead_in = {upright(on_circle(outside, start_, clear_z()), true),
                  upright(on_circle(outside, start_, shape_.floor_z), true)};
    const double last = shape_.base_radius + shape_.cutter_radius + cone_.allowance.value;
    const double width = shape_.blank_radius - last;
    const int rings =
        1 + std::max(0, static_cast<int>(std::ceil(width / (kRingStep * shape_.cutter_radius))));
    for (int i = 0; i < rings; ++i) {
      const double radius = rings == 1 ? last : shape_.blank_radius - width * i / (rings - 1);
      op.cut.push_back(upright(on_circle(radius, start_, shape_.floor_z)));
      ring(op.cut, radius, kRoughChord);
    }
    op.lead_out = {upright(on_circle(last, start_, clear_z()), true)};
    return op;
  }

  [[nodiscard]] PathOperation cylinder_finishing() const {
    PathOperation op{.name = "cylinder finishing"};
    const double radius = shape_.base_radius + shape_.cutter_radius;
    const Vec3 begin = on_circle(radius, start_, shape_.floor_z);
    const Vec3 run_in = begin - lead() * tangent(start_);
    const Vec3 run_out = begin + lead() * tangent(start_);
    const Vec3 up = (clear_z() - shape_.floor_z) * Vec3::UnitZ();
    op.lead_in = {upright(run_in + up, true), upright(run_in), upright(begin)};
    ring(op.cut, radius, cone_.chord_tolerance.value);
    op.lead_out = {upright(run_out), upright(run_out + up, true)};
    return op;
  }

  [[nodiscard]] PathOperation groove() const {
    PathOperation op{.name = "groove"};
    const double z = shape_.groove_floor_z;
    const Vec3 outside(0.0, shape_.blank_radius + shape_.cutter_radius + 3.0, z);
    const Vec3 inside(0.0, shape_.groove_inner_y, z);
    const Vec3 up = (clear_z() - z) * Vec3::UnitZ();
    op.lead_in = {upright(outside + up, true), upright(outside, true)};
    op.cut = {upright(inside), upright(outside)};
    op.lead_out = {upright(outside + up, true)};
    return op;
  }

  // The tool leans on the generatrix; `allowance` keeps it off along the surface normal.
  [[nodiscard]] PathOperation cone_pass(const char* name, double allowance,
                                        double tolerance) const {
    PathOperation op{.name = name, .kind = OperationKind::cone};
    const double a = cone_.cone_angle.value;
    const double radius = cone_.radius.value + allowance * std::cos(a);
    const double z = allowance * std::sin(a);
    const auto axis = [&](double phi) -> Vec3 { return on_circle(-std::sin(a), phi, std::cos(a)); };
    const auto leaning = [&](const Vec3& tip, double phi, bool rapid = false) {
      return move(tip, axis(phi), rapid);
    };
    const Vec3 begin = on_circle(radius, start_, z);
    const Vec3 run_in = begin - lead() * tangent(start_);
    const Vec3 run_out = begin + lead() * tangent(start_);
    const Vec3 back = (kClear + shape_.top_z) / std::cos(a) * axis(start_);
    op.lead_in = {leaning(run_in + back, start_, true), leaning(run_in, start_),
                  leaning(begin, start_)};
    const int chords = chords_of_circle(radius, tolerance);
    for (int i = 1; i <= chords; ++i) {
      const double phi = start_ + kTurn * i / chords;
      op.cut.push_back(leaning(on_circle(radius, phi, z), phi));
    }
    op.lead_out = {leaning(run_out, start_), leaning(run_out + back, start_, true)};
    return op;
  }

  const ConeFrustum& cone_;
  const ConeGeometry& shape_;
  Mat3 program_from_workpiece_;
  double start_;
};

}  // namespace

std::vector<PathOperation> cone_path(const ConeFrustum& cone, const ConeGeometry& shape) {
  return ConePath(cone, shape).operations();
}

}  // namespace frustum::programs
