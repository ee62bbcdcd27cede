#include "cutter/body/generatrix.hpp"
#include "core/constants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace frustum::cutter {
namespace {

// Ends that people write with rounded numbers meet within this; below any cutter's own roundness,
// mm.
constexpr double kMeets = 1e-9;

MeridianPoint operator-(const MeridianPoint& a, const MeridianPoint& b) {
  return {a.r - b.r, a.z - b.z};
}
double cross(const MeridianPoint& a, const MeridianPoint& b) { return a.r * b.z - a.z * b.r; }
double dot(const MeridianPoint& a, const MeridianPoint& b) { return a.r * b.r + a.z * b.z; }
double length(const MeridianPoint& a) { return std::hypot(a.r, a.z); }
bool finite(const MeridianPoint& p) { return std::isfinite(p.r) && std::isfinite(p.z); }

// The body is to the left of the chain: an arc that bulges turns left.
double turn_of(const GeneratrixSegment& s) { return s.bulges ? 1.0 : -1.0; }

// True when the direction `v` from the centre points at the arc.
bool faces(const GeneratrixSegment& s, const MeridianPoint& v) {
  const double turn = turn_of(s);
  return turn * cross(s.from - s.centre, v) >= 0.0 && turn * cross(v, s.to - s.centre) >= 0.0;
}

// Asked so often that std::hypot, which also takes numbers beyond 1e154, would be most of the time.
double distance_to(const GeneratrixSegment& s, const MeridianPoint& p) {
  const MeridianPoint a = p - s.from;
  if (is_arc(s)) {
    const MeridianPoint v = p - s.centre;
    if (faces(s, v)) return std::abs(std::sqrt(dot(v, v)) - s.arc_radius);
  } else {
    const MeridianPoint along = s.to - s.from;
    const double share = dot(a, along), whole = dot(along, along);
    if (share > 0.0 && share < whole) return std::abs(cross(along, a)) / std::sqrt(whole);
  }
  const MeridianPoint b = p - s.to;
  return std::sqrt(std::min(dot(a, a), dot(b, b)));
}

// The arc's point straight below, above or beside its centre, when it has one.
std::optional<MeridianPoint> arc_point(const GeneratrixSegment& s, const MeridianPoint& direction) {
  if (!is_arc(s) || !faces(s, direction)) return std::nullopt;
  const MeridianPoint at{s.centre.r + s.arc_radius * direction.r,
                         s.centre.z + s.arc_radius * direction.z};
  const bool is_end = length(at - s.from) <= kMeets || length(at - s.to) <= kMeets;
  return is_end ? std::nullopt : std::optional(at);
}

std::string name_of(std::size_t index) {
  return fmt::format("segment {} of the outline", index + 1);
}

std::optional<Diagnostic> wrong_arc(const GeneratrixSegment& s, std::size_t i) {
  if (!finite(s.centre) || !std::isfinite(s.arc_radius) || s.arc_radius < 0.0) {
    return error("cutter-profile"_id,
                 fmt::format("{} has an arc without a centre and radius", name_of(i)),
                 "an arc needs a radius above 0");
  }
  if (!is_arc(s)) return std::nullopt;
  for (const MeridianPoint& end : {s.from, s.to}) {
    const double off = length(end - s.centre) - s.arc_radius;
    if (std::abs(off) > kMeets) {
      return error("cutter-profile"_id,
                   fmt::format("{}: an end of the arc is {} mm off its circle", name_of(i), off),
                   "both ends must have the arc's radius as distance from its centre");
    }
  }
  if (!(turn_of(s) * cross(s.from - s.centre, s.to - s.centre) > 0.0)) {
    return error(
        "cutter-profile"_id,
        fmt::format("{} is an arc of half a turn or more, or turns the other way", name_of(i)),
        "divide it; an arc bulges when its centre is on the body's side");
  }
  return std::nullopt;
}

std::optional<Diagnostic> wrong_segment(const std::vector<GeneratrixSegment>& chain,
                                        std::size_t i) {
  const GeneratrixSegment& s = chain[i];
  if (!finite(s.from) || !finite(s.to)) {
    return error("cutter-profile"_id, fmt::format("{} has an end that is not a number", name_of(i)),
                 "give r and z in mm");
  }
  if (length(s.to - s.from) <= kMeets) {
    return error("cutter-profile"_id, fmt::format("{} has no length", name_of(i)), "leave it out");
  }
  if (i > 0 && length(s.from - chain[i - 1].to) > kMeets) {
    return error(
        "cutter-profile"_id,
        fmt::format("a gap of {:g} mm before {}", length(s.from - chain[i - 1].to), name_of(i)),
        "each segment starts where the one before ends");
  }
  if (auto wrong = wrong_arc(s, i)) return wrong;
  const auto inmost = arc_point(s, {-1.0, 0.0});
  const bool last = i + 1 == chain.size();
  if (s.to.r < 0.0 || (s.to.r == 0.0 && !last) || (inmost && inmost->r <= 0.0)) {
    return error("cutter-profile"_id,
                 fmt::format("{} reaches the tool axis or passes it", name_of(i)),
                 "the outline leaves the axis at its start and may return to it only at the top");
  }
  return std::nullopt;
}

bool horizontal(const GeneratrixSegment& s) { return s.from.z == s.to.z; }

// From the lowest point on z may not fall, before it not rise; and no way leads straight back.
std::optional<Diagnostic> turns_back(const std::vector<GeneratrixSegment>& chain) {
  bool rising = false;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const GeneratrixSegment& s = chain[i];
    for (const GeneratrixSegment& piece : monotone_in_height(std::span(&s, 1))) {
      if (piece.to.z > piece.from.z) rising = true;
      if (rising && piece.to.z < piece.from.z - kMeets) {
        return error(
            "cutter-profile"_id,
            fmt::format("{} falls towards the tip after the outline has risen", name_of(i)),
            "from its lowest point on the outline may only rise or step in and out");
      }
    }
    if (i == 0 || !horizontal(s) || !horizontal(chain[i - 1]) || is_arc(s)) continue;
    if ((s.to.r - s.from.r) * (chain[i - 1].to.r - chain[i - 1].from.r) < 0.0) {
      return error("cutter-profile"_id, fmt::format("{} runs back on the one before", name_of(i)),
                   "leave both out");
    }
  }
  return std::nullopt;
}

// The material between a concave end and the flank, at its thinnest over the heights that both
// share. The wall is looked at in 256 places: it may be thin, and a recess that leaves none is a
// mistake in the data.
double thinnest_wall(const GeneratrixSegment& recess, const GeneratrixSegment& flank,
                     double bottom) {
  constexpr int kPlaces = 256;
  const double lo = std::max(recess.to.z, flank.from.z), hi = std::min(recess.from.z, flank.to.z);
  double thinnest = kInfinity;
  for (int k = 0; k <= kPlaces && lo <= hi; ++k) {
    const double z = k == kPlaces ? hi : lo + (hi - lo) * k / kPlaces;
    // At the rim the two meet.
    if (z > bottom + kMeets)
      thinnest = std::min(thinnest, radius_at(flank, z) - radius_at(recess, z));
  }
  return thinnest;
}

std::optional<Diagnostic> crosses_itself(const std::vector<GeneratrixSegment>& chain,
                                         double bottom) {
  const auto pieces = monotone_in_height(chain);
  for (const GeneratrixSegment& recess : pieces) {
    if (recess.to.z >= recess.from.z - kMeets) continue;
    for (const GeneratrixSegment& flank : pieces) {
      if (flank.to.z <= flank.from.z) continue;
      if (thinnest_wall(recess, flank, bottom) <= 0.0) {
        return error("cutter-profile"_id, "the concave end of the outline crosses its flank",
                     "the recess must stay inside the outer side");
      }
    }
  }
  return std::nullopt;
}

std::optional<Diagnostic> wrong_place(const std::vector<GeneratrixSegment>& chain, double bottom) {
  if (chain.empty())
    return error("cutter-profile"_id, "an outline without segments",
                 "give lines and arcs from r = 0");
  if (chain.front().from.r != 0.0) {
    return error("cutter-profile"_id,
                 fmt::format("the outline starts {} mm off the tool axis", chain.front().from.r),
                 "it starts at r = 0");
  }
  double lowest = chain.front().from.z;
  for (const GeneratrixSegment& s : monotone_in_height(chain)) lowest = std::min(lowest, s.to.z);
  if (!(std::abs(lowest - bottom) <= kMeets)) {
    return error("cutter-profile"_id,
                 fmt::format("the lowest point of the outline is at z = {} mm", lowest),
                 fmt::format("heights count from the lowest point: it has z = {}", bottom));
  }
  if (!(chain.back().to.z > std::max(bottom + kMeets, chain.front().from.z))) {
    return error(
        "cutter-profile"_id,
        fmt::format("the outline ends at z = {} mm, not above its start", chain.back().to.z),
        "the last point is the top of the body");
  }
  return std::nullopt;
}

// Whether the level line through `p` towards larger r crosses a piece; its lower end belongs to it.
bool crosses(const GeneratrixSegment& piece, const MeridianPoint& p) {
  const double lo = std::min(piece.from.z, piece.to.z), hi = std::max(piece.from.z, piece.to.z);
  return p.z >= lo && p.z < hi && radius_at(piece, p.z) > p.r;
}

}  // namespace

GeneratrixSegment line(MeridianPoint from, MeridianPoint to) { return {.from = from, .to = to}; }

GeneratrixSegment arc(MeridianPoint from, MeridianPoint to, MeridianPoint centre, bool bulges) {
  return {.from = from,
          .to = to,
          .arc_radius = 0.5 * (length(from - centre) + length(to - centre)),
          .centre = centre,
          .bulges = bulges};
}

std::vector<GeneratrixSegment> monotone_in_height(std::span<const GeneratrixSegment> segments) {
  std::vector<GeneratrixSegment> pieces;
  pieces.reserve(segments.size() + 1);
  for (const GeneratrixSegment& s : segments) {
    auto turning = arc_point(s, {0.0, -1.0});
    if (!turning) turning = arc_point(s, {0.0, 1.0});
    if (!turning) {
      pieces.push_back(s);
      continue;
    }
    pieces.push_back(s);
    pieces.back().to = *turning;
    pieces.push_back(s);
    pieces.back().from = *turning;
  }
  return pieces;
}

double radius_at(const GeneratrixSegment& piece, double z) {
  if (!is_arc(piece)) {
    const double share = (z - piece.from.z) / (piece.to.z - piece.from.z);
    return piece.from.r + share * (piece.to.r - piece.from.r);
  }
  const double h = z - piece.centre.z;
  const double half = std::sqrt(std::max(0.0, (piece.arc_radius - h) * (piece.arc_radius + h)));
  const bool outer = piece.from.r + piece.to.r > 2.0 * piece.centre.r;
  return outer ? piece.centre.r + half : piece.centre.r - half;
}

Result<Generatrix> Generatrix::make(std::vector<GeneratrixSegment> segments, double bottom) {
  if (auto wrong = wrong_place(segments, bottom)) return *std::move(wrong);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (auto wrong = wrong_segment(segments, i)) return *std::move(wrong);
    if (i > 0) segments[i].from = segments[i - 1].to;
  }
  if (auto wrong = turns_back(segments)) return *std::move(wrong);
  if (auto wrong = crosses_itself(segments, bottom)) return *std::move(wrong);
  return Generatrix(std::move(segments));
}

Generatrix::Generatrix(std::vector<GeneratrixSegment> segments)
    : segments_(std::move(segments)), pieces_(monotone_in_height(segments_)) {
  for (const GeneratrixSegment& s : segments_) {
    max_radius_ = std::max({max_radius_, s.from.r, s.to.r});
    reach_ = std::max({reach_, length(s.from), length(s.to)});
    if (const auto outmost = arc_point(s, {1.0, 0.0})) {
      max_radius_ = std::max(max_radius_, outmost->r);
    }
    const double to_centre = length(s.centre);
    if (!is_arc(s) || !s.bulges || to_centre == 0.0) continue;
    const MeridianPoint away{s.centre.r / to_centre, s.centre.z / to_centre};
    if (const auto farthest = arc_point(s, away)) reach_ = std::max(reach_, length(*farthest));
  }
}

double Generatrix::distance(double r, double z) const {
  const MeridianPoint p{std::abs(r), z};
  const MeridianPoint& rim = segments_.back().to;
  const MeridianPoint to_top{std::max(0.0, p.r - rim.r), p.z - rim.z};
  double nearest = std::sqrt(dot(to_top, to_top));
  bool inside = false;
  for (const GeneratrixSegment& piece : pieces_) {
    nearest = std::min(nearest, distance_to(piece, p));
    if (crosses(piece, p)) inside = !inside;
  }
  return inside ? -nearest : nearest;
}

}  // namespace frustum::cutter
