#include "parser/interpret/frames/klartext_plane.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/units.hpp"
#include "parser/interpret/frames/feature_frame.hpp"
#include "parser/interpret/frames/tilted_plane.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/word_values.hpp"

namespace frustum::parser {
namespace {

constexpr double kRightAngle = 90.0;

Mat3 turn_of_plane(int axis, double angle) { return rotation_about(Vec3::Unit(axis), angle); }

// X as near to `x` as the normal `z` leaves it; nothing where they have no directions, or one.
std::optional<Mat3> axes_along(const Vec3& x, const Vec3& z) {
  constexpr double kParallel = 1e-9;  // sine of the angle
  const auto normal = UnitVec3::of(z);
  const auto along = UnitVec3::of(x);
  if (!normal || !along) return std::nullopt;
  const Vec3 flat = along->vec() - normal->vec() * along->vec().dot(normal->vec());
  if (!(flat.norm() > kParallel)) return std::nullopt;
  Mat3 axes;
  axes.col(0) = flat.normalized();
  axes.col(2) = normal->vec();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

}  // namespace

Outcome set_plane(InterpreterState& state, const BlockWords& words) {
  const GivenCode& code = words[CodeGroup::tilted_plane];
  const auto kind = static_cast<TiltWord>(code.code->value);
  const bool within = kind == TiltWord::relative;
  const ProgrammedFrame& frame = state.modes.programmed_frame;
  if (frame.turns() || frame.is_mirrored() || frame.scale != 1.0) {
    return fail(state, code.column, "plane-frame"_id,
                "PLANE within a rotation, mirror image or scaling",
                "end them before, by CYCL DEF 10.1 ROT+0, 8.1 and 11.1 SCL 1");
  }
  if (!within && state.modes.frame_below && !frame.is_identity()) {
    return fail(state, code.column, "plane-frame"_id,
                "PLANE on top of a datum shift in the plane before",
                "end that plane by PLANE RESET");
  }
  std::optional<Mat3> rotation;
  switch (kind) {
    case TiltWord::turns: {
      const Vec3 angles = vector_of(words, "IJK") * kRadPerDeg;
      rotation =
          turn_of_plane(2, angles[0]) * turn_of_plane(0, angles[1]) * turn_of_plane(2, angles[2]);
      break;
    }
    case TiltWord::projected: {
      for (const char letter : {'I', 'J'}) {
        if (std::abs(words[letter].value) < kRightAngle) continue;
        return fail(state, words[letter].column, "out-of-range"_id,
                    fmt::format("{} is out of range", words.text_of(letter)),
                    "the angles of the lines go from above -90 to below 90 degrees");
      }
      FeatureWords lines{.form = FeatureForm::projection};
      lines.parts[0] = FeaturePart{.numbers = vector_of(words, "IJK") * kRadPerDeg};
      const auto plane = feature_frame(lines);
      if (!plane) {
        return fail(state, code.column, plane.error().front());
      }
      rotation = plane->rotation;
      break;
    }
    case TiltWord::vectors:
      rotation = axes_along(vector_of(words, "ABC"), vector_of(words, "IJK"));
      break;
    case TiltWord::points: {
      const Vec3 first = vector_of(words, "XYZ");
      const Vec3 x = vector_of(words, "IJK") - first;
      rotation = axes_along(x, x.cross(vector_of(words, "uvw") - first));
      break;
    }
    default: {
      // Of `relative` one angle is given.
      const Vec3 angles = vector_of(words, "ABC") * kRadPerDeg;
      rotation =
          turn_of_plane(2, angles[2]) * turn_of_plane(1, angles[1]) * turn_of_plane(0, angles[0]);
    }
  }
  if (!rotation) {
    const bool points = kind == TiltWord::points;
    return fail(state, code.column, "plane-degenerate"_id,
                points ? "the points of PLANE POINTS are on one line"
                       : "the vectors of PLANE VECTOR span no plane",
                points ? "give three points of the plane that form a triangle"
                       : "give B a direction across N, both longer than zero");
  }
  if (auto done = tilt(state, code, Pose::rotated(*rotation), within); !done) return done;
  return turn_to_plane(state, words);
}

}  // namespace frustum::parser
