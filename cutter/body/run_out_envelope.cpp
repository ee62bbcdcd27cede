#include "cutter/body/run_out_envelope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustum::cutter {
namespace {

using Chain = std::vector<GeneratrixSegment>;

bool is_level(const GeneratrixSegment& s) { return s.from.z == s.to.z && s.arc_radius == 0.0; }

GeneratrixSegment moved(GeneratrixSegment s, double dr) {
  for (MeridianPoint* p : {&s.from, &s.to, &s.centre}) p->r += dr;
  return s;
}

// r -> about - r, walked the other way: the body stays on the left.
GeneratrixSegment mirrored(const GeneratrixSegment& s, double about) {
  GeneratrixSegment out = s;
  out.from = {about - s.to.r, s.to.z};
  out.to = {about - s.from.r, s.from.z};
  out.centre = {about - s.centre.r, s.centre.z};
  return out;
}

// Height at which a piece between two heights has the radius `r` (one of its ends is on either
// side).
double height_at(const GeneratrixSegment& s, double r) {
  if (s.arc_radius == 0.0) {
    return s.from.z + (r - s.from.r) / (s.to.r - s.from.r) * (s.to.z - s.from.z);
  }
  const double across = r - s.centre.r;
  const double half = std::sqrt(std::max(0.0, (s.arc_radius - across) * (s.arc_radius + across)));
  return 0.5 * (s.from.z + s.to.z) > s.centre.z ? s.centre.z + half : s.centre.z - half;
}

// The part of a chain up from the axis within radius `r`, and the part beyond it from the crossing
// on.
struct Divided {
  Chain within;
  Chain beyond;
};
Divided divided_at(const Chain& pieces, double r) {
  Divided out;
  for (const GeneratrixSegment& s : pieces) {
    if (!out.beyond.empty()) {
      out.beyond.push_back(s);
    } else if (s.to.r <= r) {
      out.within.push_back(s);
    } else if (s.from.r >= r) {
      out.beyond.push_back(s);
    } else {
      const MeridianPoint cut{r, height_at(s, r)};
      out.within.push_back(s);
      out.within.back().to = cut;
      out.beyond.push_back(s);
      out.beyond.back().from = cut;
    }
  }
  return out;
}

// What of a recess is left when it is narrowed by `by`; its pieces fall.
Chain narrowed(const Chain& recess, double by) {
  Chain out;
  for (const GeneratrixSegment& s : divided_at(recess, by).beyond) out.push_back(moved(s, -by));
  if (!out.empty()) out.front().from.r = 0.0;
  return out;
}

// The dimple that a point leaves on the spindle axis: the end within `offset`, seen from the other
// side.
Chain dimple(const Chain& within, double offset) {
  Chain out;
  for (auto s = within.rbegin(); s != within.rend(); ++s) out.push_back(mirrored(*s, offset));
  if (!out.empty()) out.front().from.r = 0.0;
  return out;
}

// `chain` from `rim` on, turned about it: the radius falls by tilt times height.
void turn_about(Chain& chain, std::size_t first, double tilt) {
  if (tilt == 0.0 || first >= chain.size()) return;
  const MeridianPoint rim = chain[first].from;
  const double c = std::cos(tilt), s = std::sin(tilt);
  for (std::size_t i = first; i < chain.size(); ++i) {
    for (MeridianPoint* p : {&chain[i].from, &chain[i].to, &chain[i].centre}) {
      const double dr = p->r - rim.r, dz = p->z - rim.z;
      *p = {rim.r + c * dr - s * dz, rim.z + s * dr + c * dz};
    }
  }
}

struct Ends {
  Chain recess;  // falls from the axis to the rim
  Chain flank;   // rises
  MeridianPoint inner;
  MeridianPoint outer;  // the end face between the two is at the lowest height
};

Ends ends_of(const Chain& chain) {
  const Chain pieces = monotone_in_height(chain);
  std::size_t falls = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].to.z < pieces[i].from.z) falls = i + 1;
  }
  std::size_t rises = falls;
  while (rises < pieces.size() && is_level(pieces[rises])) ++rises;
  const auto at = [&](std::size_t i) { return pieces.begin() + static_cast<std::ptrdiff_t>(i); };
  Ends ends{{pieces.begin(), at(falls)}, {at(rises), pieces.end()}, {}, {}};
  ends.inner = falls > 0 ? pieces[falls - 1].to : pieces.front().from;
  ends.outer = rises > 0 ? pieces[rises - 1].to : pieces.front().from;
  return ends;
}

void add_level(Chain& chain, MeridianPoint from, MeridianPoint to) {
  if (to.r - from.r > 1e-9) chain.push_back(line(from, to));
}

}  // namespace

Result<Chain> with_run_out(const Chain& chain, double offset, double tilt) {
  if (offset < 0.0) return with_run_out(chain, -offset, -tilt);
  if (offset == 0.0 && tilt == 0.0) return chain;
  const Ends ends = ends_of(chain);
  Chain out = narrowed(ends.recess, offset);
  const double floor = ends.outer.z;
  if (!ends.recess.empty()) {
    if (out.empty()) out.push_back(line({0.0, floor}, {ends.inner.r + offset, floor}));
    add_level(out, out.back().to, {ends.outer.r + offset, floor});
  } else if (ends.outer.r >= offset) {
    add_level(out, {0.0, floor}, {ends.outer.r + offset, floor});
  } else {
    const Divided flank = divided_at(ends.flank, offset);
    if (flank.beyond.empty()) {
      return error(
          "cutter-run-out"_id,
          fmt::format("run-out {:g} mm at the tip of a tool that is nowhere wider", offset),
          "the run-out at the tip must be smaller than the radius");
    }
    out = dimple(flank.within, offset);
    // A ball's dimple is offset^2 / (2 R) deep: below 10 pm it is an end face.
    constexpr double kNoDimple = 1e-8;
    if (!out.empty() && out.front().from.z - floor < kNoDimple) out.clear();
    const MeridianPoint from = out.empty() ? MeridianPoint{0.0, floor} : out.back().to;
    add_level(out, from, {ends.outer.r + offset, floor});
  }
  const std::size_t first = out.size();
  for (const GeneratrixSegment& s : ends.flank) out.push_back(moved(s, offset));
  turn_about(out, first, tilt);
  if (first > 0) {
    for (std::size_t i = first; i < out.size(); ++i) out[i].from = out[i - 1].to;
  }
  return out;
}

Chain widened(const Chain& chain, double by) {
  if (by == 0.0) return chain;
  Chain moved_on;
  if (by < 0.0) {
    // What comes to be beyond the axis is ground off.
    moved_on = narrowed(monotone_in_height(chain), -by);
  } else {
    const double height = chain.front().from.z;
    add_level(moved_on, {0.0, height}, {by, height});
    for (const GeneratrixSegment& s : chain) moved_on.push_back(moved(s, by));
  }
  if (moved_on.empty()) return chain;
  // A point that is ground off leaves a new lowest point, from which heights count.
  double lowest = moved_on.front().from.z;
  for (const GeneratrixSegment& s : moved_on) lowest = std::min(lowest, s.to.z);
  for (GeneratrixSegment& s : moved_on) {
    for (MeridianPoint* p : {&s.from, &s.to, &s.centre}) p->z -= lowest;
  }
  return moved_on;
}

}  // namespace frustum::cutter
