#include "cutter/search/gap_pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cutter/sweep/segment_motion.hpp"
#include "tests/cutter/cutter_kinds.hpp"
#include "tests/cutter/random_paths.hpp"

namespace frustum::proof {
namespace {

using cutter::Body;
using cutter::GapPiece;
using cutter::RayGap;
using cutter::RayQuestion;
using cutter::SegmentMotion;

RayQuestion question_of(const kinematics::ToolPath& path, const Ray& ray) {
  RayQuestion question;
  question.path = &path;
  question.ray = ray;
  return question;
}

// 200 short segments about an arc.
kinematics::ToolPath arc_of_chords() {
  std::vector<kinematics::ToolPose> poses;
  for (int i = 0; i <= 200; ++i) {
    const double phi = 0.005 * i;
    poses.push_back({Vec3(40.0 * std::cos(phi), 40.0 * std::sin(phi), 0.1 * phi),
                     Vec3(0.1 * std::sin(phi), 0.05, 1.0).normalized()});
  }
  return path_through(poses);
}

std::vector<RayGap> whole_gaps(const kinematics::ToolPath& path, double hi) {
  std::vector<RayGap> gaps;
  for (std::uint32_t s = 0; s < path.segments.size(); ++s) gaps.push_back({s, 0.0, hi});
  return gaps;
}

// What a segment covers at any of many moments is in a piece of its gap; and pieces are in their
// gaps, in order, apart from each other.
TEST(GapPieces, LeaveNothingOutThatASegmentCovers) {
  const auto path = arc_of_chords();
  Draw draw(7);
  for (const char* name : {"flat", "bull"}) {
    const auto& kinds = cutter_kinds();
    const auto kind = std::ranges::find(kinds, name, &Kind::name);
    const Body& body = (kind == kinds.end() ? kinds.front() : *kind).cutter.body();
    for (int k = 0; k < 20; ++k) {
      const Vec3 target = path.poses[static_cast<std::size_t>(draw.below(200))].tip;
      const Vec3 along = draw.direction();
      const Ray ray{target + 3.0 * draw.direction() - 20.0 * along, along};
      const RayQuestion question = question_of(path, ray);
      const auto gaps = whole_gaps(path, 40.0);
      const auto pieces = pieces_to_walk(question, body, gaps);
      for (std::size_t i = 1; i < pieces.size(); ++i) {
        if (pieces[i].gap != pieces[i - 1].gap) continue;
        EXPECT_GT(pieces[i].lo, pieces[i - 1].hi);
      }
      for (const RayGap& gap : gaps) {
        const SegmentMotion motion(path, path.segments[gap.segment], body.reach());
        for (int n = 0; n < 40; ++n) {
          const double s = draw.between(gap.lo, gap.hi);
          if (!(body.distance(motion.at(draw.between(0.0, 1.0)), ray.at(s)) < 0.0)) continue;
          EXPECT_TRUE(std::ranges::any_of(pieces, [&](const GapPiece& piece) {
            return gaps[piece.gap].segment == gap.segment && piece.lo <= s && s <= piece.hi;
          }));
        }
      }
    }
  }
}

TEST(GapPieces, AreNoneWhereTheCutterDoesNotCome) {
  const auto path = arc_of_chords();
  const Body& body = cutter_kinds().front().cutter.body();
  const Ray beside{Vec3(0.0, 0.0, -50.0), Vec3::UnitX()};
  EXPECT_TRUE(pieces_to_walk(question_of(path, beside), body, whole_gaps(path, 40.0)).empty());
  EXPECT_TRUE(pieces_to_walk(question_of(path, beside), body, {}).empty());
}

}  // namespace
}  // namespace frustum::proof
