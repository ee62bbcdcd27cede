// A ray against a convex cutter moving over one segment of tool path: the exact covered intervals.
//
// Model    : at time t in [0, 1] the body meets the ray in [A(t), B(t)] or not at all; over each
//            connected span of times with a chord the union is [min A, max B], each found as
//            highest_end.hpp has it
// Units    : mm; frame: workpiece
// Errors   : none; degenerate motions (no motion, pure rotation, ray along the motion) are ordinary
// Accuracy : ends within 0.001 nm normal to the swept surface: proven by the planes, not sampled. A
//            span of times without a chord is proven empty by separating planes down to a
//            penetration of 0.5 nm
// Source   : ours; highest_end.hpp has that of the ends
#pragma once

#include <boost/container/small_vector.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "cutter/body/profile.hpp"
#include "cutter/sweep/segment_motion.hpp"
#include "cutter/sweep/tangent_plane.hpp"

namespace frustum::cutter {

// Where and when the cutter touches an end of what it covers.
struct SweptEnd {
  double s = 0.0;
  double t = 0.0;
  ProfileFace face = kTopFace;
};
struct SegmentInterval {
  SweptEnd lo{};
  SweptEnd hi{};
};

// Of one ray: mostly one.
using SegmentIntervals = boost::container::small_vector_base<SegmentInterval>;
using FewSegmentIntervals = boost::container::small_vector<SegmentInterval, 4>;

// No error of an end, normal to the surface, is larger than this because the search stops (mm).
inline constexpr double kSearchTolerance = 4e-10;
// A piece of the ray that is covered may be missed only where the ray enters the sweep by less than
// this, normal to its surface (mm).
inline constexpr double kMissedDepth = 0.5e-6;

// Appends the exact intervals, in no particular order, possibly overlapping. An end inside an
// interval of `known` (what is covered anyway) that the interval overlaps may be left inexact.
void append_swept_intervals(const Profile& body, const SegmentMotion& motion, const Ray& ray,
                            std::span<const Chord> known, SegmentIntervals& found);
[[nodiscard]] std::vector<SegmentInterval> swept_intervals(const Profile& body,
                                                           const SegmentMotion& motion,
                                                           const Ray& ray);

// A moment at which what is swept ends at s, which swept_intervals() has found; nothing where it is
// not plain that it is the first end or the last. Faster than all of them.
[[nodiscard]] std::optional<SweptEnd> swept_end_at(const Profile& body, const SegmentMotion& motion,
                                                   const Ray& ray, double s);

// Sorts them and unites those that overlap: rays that graze make many pieces of one.
void join_overlapping(SegmentIntervals& pieces);

// Where the ray leaves the sweep last, with the planes that touch the body there as the motion
// begins and ends. Only if the ray meets the body at both ends of a motion that turns little.
struct LastExit {
  SweptEnd end;
  TangentPlane at_begin;
  TangentPlane at_end;
};
[[nodiscard]] std::optional<LastExit> last_exit(const Profile& body, const SegmentMotion& motion,
                                                const Ray& ray);

}  // namespace frustum::cutter
