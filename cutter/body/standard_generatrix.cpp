#include "cutter/body/standard_generatrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace frustum::cutter {
namespace {

double radius_of(const CutterSpec& spec) { return spec.diameter.value / 2.0; }

// A chain that leaves out what has no length.
class Pen {
 public:
  explicit Pen(MeridianPoint start) : at_(start) {}
  Pen& to(MeridianPoint p) {
    if (std::hypot(p.r - at_.r, p.z - at_.z) > kNothing) chain_.push_back(line(at_, p));
    return moved(p);
  }
  Pen& arc_to(MeridianPoint p, MeridianPoint centre, bool bulges = true) {
    if (std::hypot(p.r - at_.r, p.z - at_.z) > kNothing) {
      chain_.push_back(arc(at_, p, centre, bulges));
    }
    return moved(p);
  }
  [[nodiscard]] const MeridianPoint& at() const { return at_; }
  [[nodiscard]] const GeneratrixChain& chain() const { return chain_; }

 private:
  static constexpr double kNothing = 1e-9;  // mm: what Generatrix takes for no length
  Pen& moved(MeridianPoint p) {
    at_ = chain_.empty() ? p : chain_.back().to;
    return *this;
  }
  MeridianPoint at_;
  GeneratrixChain chain_;
};

Diagnostic too_short(const CutterSpec& spec, double least, std::string_view what) {
  return error("cutter-flute-length"_id,
               fmt::format("flute length {} mm of a {} of diameter {} mm", flute_height(spec).value,
                           type_row(spec.type).title, spec.diameter.value),
               fmt::format("the flutes must reach past the {}: at least {:.6g} mm", what, least));
}

Diagnostic wrong_angle(std::string_view key, Rad angle, std::string_view limits) {
  return error("cutter-angle"_id, fmt::format("{} of {:g} deg", key, angle.value * kDegPerRad),
               fmt::format("it must be {}", limits));
}

// Where the line through `on` along the unit vector `along` meets the corner circle, at the end
// that `along` points to; a line that passes within rounding touches it.
std::optional<MeridianPoint> last_meeting(MeridianPoint on, MeridianPoint along,
                                          MeridianPoint centre, double radius) {
  const double reach = (centre.r - on.r) * along.r + (centre.z - on.z) * along.z;
  const double off = (centre.z - on.z) * along.r - (centre.r - on.r) * along.z;
  if (std::abs(off) > radius + 1e-9) return std::nullopt;
  // Nearly tangent is meant tangent: rounded dimensions must not move the point by a root of
  // rounding.
  const double half2 = (radius - std::abs(off)) * (radius + std::abs(off));
  const double step = reach + (radius - std::abs(off) > 1e-9 ? std::sqrt(half2) : 0.0);
  return MeridianPoint{on.r + step * along.r, on.z + step * along.z};
}

// Centre of the arc of `radius` (negative: concave) over a chord, on the body's side when it
// bulges.
std::optional<MeridianPoint> centre_over(MeridianPoint from, MeridianPoint to, double radius) {
  const double length = std::hypot(to.r - from.r, to.z - from.z);
  const double off2 = (std::abs(radius) - 0.5 * length) * (std::abs(radius) + 0.5 * length);
  if (!(length > 0.0) || !(off2 > 0.0)) return std::nullopt;
  const double off = std::copysign(std::sqrt(off2), radius) / length;
  return MeridianPoint{0.5 * (from.r + to.r) - off * (to.z - from.z),
                       0.5 * (from.z + to.z) + off * (to.r - from.r)};
}

}  // namespace

// End face, corner and flank of the plain end mills: the face rises towards the axis by the minor
// cutting edge angle, the flank leans outwards by the taper angle, the corner is tangent to both.
Result<GeneratrixChain> end_mill_generatrix(const CutterSpec& spec) {
  const double radius = radius_of(spec), height = flute_height(spec).value,
               corner = spec.corner_radius.value;
  const double end = spec.end_angle.value, taper = spec.taper_angle.value;
  if (!(end >= 0.0 && end < 1.0)) {
    return wrong_angle("end_angle", spec.end_angle, "from 0 to 57 degrees; 1 to 2 are usual");
  }
  if (!(std::abs(taper) < 1.5)) {
    return wrong_angle("taper_angle", spec.taper_angle, "between -85 and 85 degrees");
  }
  // The diameter is where end plane and flank would meet; the corner's centre lies inwards of it.
  const double centre = radius - corner * (1.0 - std::sin(taper)) / std::cos(taper);
  if (centre < -1e-9) {
    return error(
        "cutter-corner-radius"_id,
        fmt::format("corner radius {} mm on a diameter of {} mm", corner, spec.diameter.value),
        fmt::format("at most {:.6g} mm", radius * std::cos(taper) / (1.0 - std::sin(taper))));
  }
  const MeridianPoint c{std::max(0.0, centre), corner};
  const MeridianPoint low{std::max(0.0, c.r - corner * std::sin(end)),
                          c.z - corner * std::cos(end)};
  const MeridianPoint high{c.r + corner * std::cos(taper), c.z - corner * std::sin(taper)};
  if (end > 0.0 && c.r < corner * std::sin(end)) {
    return error("cutter-end-angle"_id,
                 fmt::format("end_angle of {:g} deg with a corner radius of {} mm",
                             end * kDegPerRad, corner),
                 "the corner leaves no room for a concave end face");
  }
  if (height < high.z) return too_short(spec, high.z, "corner");
  Pen pen({0.0, low.z + low.r * std::tan(end)});
  pen.to(low);
  if (corner > 0.0) {
    // Apart at the lowest point, which may be within the arc: an arc turns by less than half a
    // turn.
    pen.arc_to({c.r, 0.0}, c).arc_to(high, c);
  }
  const double top = high.r + (height - high.z) * std::tan(taper);
  if (top <= 0.0)
    return wrong_angle("taper_angle", spec.taper_angle, "flatter: the flank meets the axis");
  return pen.to({top, height}).chain();
}

Result<GeneratrixChain> ball_generatrix(const CutterSpec& spec) {
  const double radius = radius_of(spec), height = flute_height(spec).value;
  if (height < radius) {
    return error(
        "cutter-flute-length"_id,
        fmt::format("flute length {} mm of a ball end mill of radius {} mm", height, radius),
        "the flutes must reach past the ball: at least the radius");
  }
  return Pen({0.0, 0.0}).arc_to({radius, radius}, {0.0, radius}).to({radius, height}).chain();
}

Result<GeneratrixChain> taper_ball_generatrix(const CutterSpec& spec) {
  const double radius = radius_of(spec), height = flute_height(spec).value,
               taper = spec.taper_angle.value;
  if (!(std::abs(taper) < 1.5)) {
    return wrong_angle("taper_angle", spec.taper_angle, "between -85 and 85 degrees");
  }
  const MeridianPoint leaves{radius * std::cos(taper), radius * (1.0 - std::sin(taper))};
  if (height < leaves.z) return too_short(spec, leaves.z, "ball");
  const double top = leaves.r + (height - leaves.z) * std::tan(taper);
  if (top <= 0.0)
    return wrong_angle("taper_angle", spec.taper_angle, "flatter: the flank meets the axis");
  return Pen({0.0, 0.0}).arc_to(leaves, {0.0, radius}).to({top, height}).chain();
}

// Drill and chamfer mill: a cone from the tip's diameter to the full one.
Result<GeneratrixChain> pointed_generatrix(const CutterSpec& spec) {
  const double radius = radius_of(spec), height = flute_height(spec).value;
  const double tip = spec.tip_diameter.value / 2.0, angle = spec.tip_angle.value;
  if (!(angle > 0.0 && angle < 3.14)) {
    return wrong_angle("tip_angle", spec.tip_angle, "above 0 and below 180 degrees (included)");
  }
  if (!(tip >= 0.0 && tip < radius)) {
    return error("cutter-diameter"_id,
                 fmt::format("tip diameter {} mm of a tool of diameter {} mm",
                             spec.tip_diameter.value, spec.diameter.value),
                 "the tip must be smaller");
  }
  const double rise = (radius - tip) / std::tan(angle / 2.0);
  if (height < rise) return too_short(spec, rise, "point");
  return Pen({0.0, 0.0}).to({tip, 0.0}).to({radius, rise}).to({radius, height}).chain();
}

Result<GeneratrixChain> lollipop_generatrix(const CutterSpec& spec) {
  const double radius = radius_of(spec), neck = spec.neck_diameter.value / 2.0;
  if (!(neck < radius)) {
    return error("cutter-diameter"_id,
                 fmt::format("neck diameter {} mm of a ball of diameter {} mm",
                             spec.neck_diameter.value, spec.diameter.value),
                 "the neck must be thinner than the ball");
  }
  const MeridianPoint centre{0.0, radius};
  const double top = radius + std::sqrt((radius - neck) * (radius + neck));
  return Pen({0.0, 0.0}).arc_to({radius, radius}, centre).arc_to({neck, top}, centre).chain();
}

Result<GeneratrixChain> t_slot_generatrix(const CutterSpec& spec) {
  const double radius = radius_of(spec), height = flute_height(spec).value,
               corner = spec.corner_radius.value;
  if (corner > radius || 2.0 * corner > height) {
    return error("cutter-corner-radius"_id,
                 fmt::format("corner radius {} mm of a slot cutter {} mm high", corner, height),
                 "at most half the height and the radius");
  }
  const double face = radius - corner;
  return Pen({0.0, 0.0})
      .to({face, 0.0})
      .arc_to({radius, corner}, {face, corner})
      .to({radius, height - corner})
      .arc_to({face, height}, {face, height - corner})
      .chain();
}

Result<GeneratrixChain> dovetail_generatrix(const CutterSpec& spec) {
  const double radius = radius_of(spec), height = flute_height(spec).value;
  const double top = radius - height * std::tan(spec.taper_angle.value);
  if (!(spec.taper_angle.value < 1.5 && top > 0.0)) {
    return wrong_angle("taper_angle", spec.taper_angle,
                       "between flank and axis, above 0, so that the flank stays off the axis");
  }
  return Pen({0.0, 0.0}).to({radius, 0.0}).to({top, height}).chain();
}

// A large arc bulges the flank to the full diameter at the belly; a corner arc touches it and the
// end.
Result<GeneratrixChain> barrel_generatrix(const CutterSpec& spec) {
  const double radius = radius_of(spec), height = flute_height(spec).value,
               flank = spec.flank_radius.value;
  const double corner = spec.corner_radius.value;
  const double belly = spec.belly_height.value > 0.0 ? spec.belly_height.value : height / 2.0;
  const MeridianPoint big{radius - flank, belly};
  const double drop = belly - corner, rest = flank - corner;
  const double centre = rest > std::abs(drop) ? big.r + std::sqrt(rest * rest - drop * drop) : -1.0;
  if (centre < -1e-9 || drop < 0.0) {
    return error("cutter-arcs"_id,
                 fmt::format("flank radius {} mm, corner radius {} mm and belly at {} mm", flank,
                             corner, belly),
                 "the arcs leave no end face: a larger flank radius or a lower belly");
  }
  const MeridianPoint c{std::max(0.0, centre), corner};
  const MeridianPoint leaves{big.r + (c.r - big.r) * flank / rest,
                             big.z + (c.z - big.z) * flank / rest};
  const double up = height - belly;
  const double top = std::abs(up) < flank ? big.r + std::sqrt(flank * flank - up * up) : -1.0;
  if (top <= 0.0 || height < leaves.z) {
    return error("cutter-flute-length"_id,
                 fmt::format("flutes {} mm high over a flank radius of {} mm", height, flank),
                 "the flank closes on the axis before: shorter flutes or a larger radius");
  }
  Pen pen({0.0, 0.0});
  pen.to({c.r, 0.0}).arc_to(leaves, c);
  return pen.arc_to({top, height}, big).chain();
}

// A flat cap of a large sphere, a corner arc that touches it and the flank.
Result<GeneratrixChain> lens_generatrix(const CutterSpec& spec) {
  const double radius = radius_of(spec), height = flute_height(spec).value,
               end = spec.end_radius.value;
  const double corner = spec.corner_radius.value;
  if (corner > radius || end < radius || end <= corner) {
    return error("cutter-arcs"_id,
                 fmt::format("end radius {} mm and corner radius {} mm on a diameter of {} mm", end,
                             corner, spec.diameter.value),
                 "the corner's at most half the diameter, the end's at least that");
  }
  const double out = radius - corner, rest = end - corner;
  const MeridianPoint c{out, end - std::sqrt((rest - out) * (rest + out))};
  const MeridianPoint leaves{out * end / rest, end + (c.z - end) * end / rest};
  if (height < c.z) return too_short(spec, c.z, "corner");
  return Pen({0.0, 0.0})
      .arc_to(leaves, {0.0, end})
      .arc_to({radius, c.z}, c)
      .to({radius, height})
      .chain();
}

// The seven parameters D R E F alpha beta H.
Result<GeneratrixChain> apt_generatrix(const CutterSpec& spec) {
  const double radius = radius_of(spec), corner = spec.corner_radius.value;
  const double alpha = spec.end_slope.value, beta = spec.taper_angle.value;
  if (!(std::abs(alpha) < 1.5)) {
    return wrong_angle("alpha", spec.end_slope, "between -85 and 85 degrees");
  }
  if (!(std::abs(beta) < 1.5))
    return wrong_angle("beta", spec.taper_angle, "between -85 and 85 degrees");
  const MeridianPoint edge{radius, radius * std::tan(alpha)};
  MeridianPoint low = edge, high = edge;
  const MeridianPoint c{spec.arc_offset.value + spec.radius_error.value, spec.arc_height.value};
  if (corner > 0.0) {
    const auto on_end = last_meeting({0.0, 0.0}, {std::cos(alpha), std::sin(alpha)}, c, corner);
    const auto on_flank = last_meeting(edge, {-std::sin(beta), -std::cos(beta)}, c, corner);
    if (!on_end || !on_flank) {
      return error("cutter-arcs"_id,
                   fmt::format("the corner circle (R {} at E {}, F {}) misses the {}", corner, c.r,
                               c.z, on_end ? "flank" : "end"),
                   "it must touch or cut the lines of alpha and beta");
    }
    low = *on_end;
    high = *on_flank;
  }
  if (low.r < -1e-9) {
    return error("cutter-arcs"_id,
                 fmt::format("the corner circle starts {} mm beyond the tool axis", -low.r),
                 "E is too small for R");
  }
  low.r = std::max(0.0, low.r);
  // A concave end or a low corner has its lowest point elsewhere than on the axis: heights count
  // from it.
  double lowest = std::min({0.0, low.z, high.z});
  const bool dips = corner > 0.0 && low.r < c.r && high.r > c.r && low.z < c.z;
  if (dips) lowest = std::min(lowest, c.z - corner);
  const auto lifted = [&](MeridianPoint p) { return MeridianPoint{p.r, p.z - lowest}; };
  const double height = spec.flute_length.value;
  if (height < lifted(high).z) return too_short(spec, lifted(high).z, "corner");
  const double top = high.r + (height - lifted(high).z) * std::tan(beta);
  if (top <= 0.0) return wrong_angle("beta", spec.taper_angle, "flatter: the flank meets the axis");
  Pen pen(lifted({0.0, 0.0}));
  pen.to(lifted(low));
  if (dips) pen.arc_to(lifted({c.r, c.z - corner}), lifted(c));
  if (corner > 0.0) pen.arc_to(lifted(high), lifted(c));
  return pen.to({top, height}).chain();
}

Result<GeneratrixChain> profile_generatrix(const CutterSpec& spec) {
  if (spec.rows.size() < 2) {
    return error("cutter-profile"_id, "a profile of fewer than two points",
                 "outline = [[r, z, arc radius], ...]");
  }
  Pen pen({spec.rows[0][0], spec.rows[0][1]});
  for (std::size_t i = 1; i < spec.rows.size(); ++i) {
    const MeridianPoint p{spec.rows[i][0], spec.rows[i][1]};
    const double radius = spec.rows[i][2];
    if (radius == 0.0) {
      pen.to(p);
      continue;
    }
    const auto centre = centre_over(pen.at(), p, radius);
    if (!centre) {
      return error("cutter-profile"_id,
                   fmt::format("row {} of the outline: an arc of radius {} mm does not reach",
                               i + 1, radius),
                   "its radius must be more than half the distance between its ends");
    }
    pen.arc_to(p, *centre, radius > 0.0);
  }
  return pen.chain();
}

Result<GeneratrixChain> measured_generatrix(const CutterSpec& spec) {
  if (spec.rows.size() < 2) {
    return error("cutter-profile"_id, "a measured profile of fewer than two points",
                 "points = [[height, radius], ...]");
  }
  Pen pen({0.0, spec.rows[0][0]});
  for (std::size_t i = 0; i < spec.rows.size(); ++i) {
    const auto& [z, r, unused] = spec.rows[i];
    if (i > 0 && !(z >= spec.rows[i - 1][0])) {
      return error("cutter-profile"_id,
                   fmt::format("measured height {} mm after {} mm", z, spec.rows[i - 1][0]),
                   "heights rise from the tip");
    }
    if (!(r >= 0.0) || (r == 0.0 && i > 0)) {
      return error("cutter-profile"_id, fmt::format("measured radius {} mm at height {} mm", r, z),
                   "radii are above 0; the first may be 0");
    }
    pen.to({r, z});
  }
  return pen.chain();
}

}  // namespace frustum::cutter
