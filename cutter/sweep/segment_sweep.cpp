#include "cutter/sweep/segment_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "cutter/sweep/chord_times.hpp"
#include "cutter/sweep/highest_end.hpp"

namespace frustum::cutter {
namespace {

// The known interval that a chord overlaps; one that holds nothing if there is none.
Chord overlapped(std::span<const Chord> known, const Chord& chord) {
  for (const Chord& k : known) {
    if (overlap(k, chord)) return k;
  }
  return {kInfinity, -kInfinity};
}

// Both ends of a motion that turns little, where their chords overlap: then all that the ray meets
// hangs together, whether or not it meets the body all the time.
struct SegmentEnds {
  ChordSample from;
  ChordSample to;
};
std::optional<SegmentEnds> ends_that_overlap(const Profile& body, const SegmentMotion& motion,
                                             const Ray& ray) {
  if (motion.turn() > kTurnPerSample) return std::nullopt;
  SegmentEnds ends{{0.0, motion.at(0.0)}, {1.0, motion.at(1.0)}};
  ends.from.chord = body.chord(ends.from.pose, ray);
  if (!ends.from.chord) return std::nullopt;
  ends.to.chord = body.chord(ends.to.pose, ray);
  if (!ends.to.chord || !overlap(*ends.from.chord, *ends.to.chord)) return std::nullopt;
  return ends;
}

}  // namespace

void append_swept_intervals(const Profile& body, const SegmentMotion& motion, const Ray& ray,
                            std::span<const Chord> known, SegmentIntervals& found) {
  // Nearly always the ray meets the cutter at both ends of a short motion.
  if (const auto ends = ends_that_overlap(body, motion, ray)) {
    const Chord inside = overlapped(known, *ends->from.chord);
    HighestEnd lo(body, motion, ray, false, -inside.lo);
    HighestEnd hi(body, motion, ray, true, inside.hi);
    lo.search_joined(ends->from, ends->to);
    hi.search_joined(ends->from, ends->to);
    if (!lo.gap() && !hi.gap()) {
      found.push_back({lo.best(), hi.best()});
      return;
    }
  }
  ChordTimes times(body, motion, ray);
  constexpr int kMostGaps = 64;
  int gaps = 0;
  for (std::size_t i = 0; i < times.samples().size();) {
    if (!times.samples()[i].chord) {
      ++i;
      continue;
    }
    const Chord inside = overlapped(known, *times.samples()[i].chord);
    HighestEnd lo(body, motion, ray, false, -inside.lo);
    HighestEnd hi(body, motion, ray, true, inside.hi);
    // A body that turns may slide along the ray within rounding: gaps without end.
    if (gaps == kMostGaps) {
      lo.pass_gaps();
      hi.pass_gaps();
    }
    lo.offer(times.samples()[i]);
    hi.offer(times.samples()[i]);
    std::size_t next = i + 1;
    for (; next < times.samples().size() && times.samples()[next].chord; ++next) {
      const ChordSample from = times.samples()[next - 1], to = times.samples()[next];
      lo.search(from, to);
      hi.search(from, to);
      if (lo.gap() || hi.gap()) break;
    }
    if (lo.gap() || hi.gap()) {
      ++gaps;
      times.insert(next - 1, lo.gap() ? *lo.gap() : *hi.gap());
      continue;  // the run is shorter now
    }
    found.push_back({lo.best(), hi.best()});
    i = next;
  }
}

std::optional<SweptEnd> swept_end_at(const Profile& body, const SegmentMotion& motion,
                                     const Ray& ray, double s) {
  constexpr double kNear = 1e-6;  // mm, above rounding
  const auto ends = ends_that_overlap(body, motion, ray);
  if (!ends) return std::nullopt;
  const bool leaving = s > std::max(ends->from.chord->hi, ends->to.chord->hi) - kNear;
  const bool entering = s < std::min(ends->from.chord->lo, ends->to.chord->lo) + kNear;
  if (leaving == entering) return std::nullopt;
  HighestEnd end(body, motion, ray, leaving, -kInfinity);
  end.stop_at(leaving ? s : -s);
  end.search(ends->from, ends->to);
  if (end.gap()) return std::nullopt;
  return end.best();
}

std::optional<LastExit> last_exit(const Profile& body, const SegmentMotion& motion,
                                  const Ray& ray) {
  const auto ends = ends_that_overlap(body, motion, ray);
  if (!ends) return std::nullopt;
  HighestEnd hi(body, motion, ray, true, -kInfinity);
  const auto [from, to] = hi.search_with_planes(ends->from, ends->to);
  if (hi.gap()) return std::nullopt;
  return LastExit{hi.best(), from, to};
}

std::vector<SegmentInterval> swept_intervals(const Profile& body, const SegmentMotion& motion,
                                             const Ray& ray) {
  FewSegmentIntervals found;
  append_swept_intervals(body, motion, ray, {}, found);
  return {found.begin(), found.end()};
}

void join_overlapping(SegmentIntervals& pieces) {
  std::ranges::sort(pieces, {}, [](const SegmentInterval& p) { return p.lo.s; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    if (pieces[i].lo.s > pieces[last].hi.s) {
      pieces[++last] = pieces[i];
    } else if (pieces[i].hi.s > pieces[last].hi.s) {
      pieces[last].hi = pieces[i].hi;
    }
  }
  if (!pieces.empty()) pieces.resize(last + 1);
}

}  // namespace frustum::cutter
