#include "metrology/characteristic/workpiece_frame.hpp"

#include <gtest/gtest.h>

#include "step_part.hpp"
#include "synthetic.hpp"

namespace frustum::metrology {
namespace {

using step_part::part;
using step_part::Part;
using step_part::plan;

Pose frame_of(const InspectionPlan& p, const Part& body) {
  std::vector<FittedFeature> features;
  for (const FeaturePoints& points : step_part::surface_points(p, body)) {
    auto fit = fit_feature(*find_feature(p, points.feature), points.points,
                           std::vector<std::size_t>(points.points.size(), 0), 0.0);
    EXPECT_TRUE(fit);
    if (fit) features.push_back(std::move(*fit));
  }
  const auto pose = workpiece_from_frame(p, p.frames.front(), features);
  EXPECT_TRUE(pose) << (pose ? "" : to_string(pose.error().front()));
  return pose ? *pose : Pose{};
}

void expect_near(const Pose& found, const Pose& wanted, double mm, double rad) {
  EXPECT_LT((found.translation - wanted.translation).norm(), mm) << found.translation;
  EXPECT_LT((found.rotation - wanted.rotation).norm(), rad) << found.rotation;
}

TEST(WorkpieceFrame, IsTheIdentityForAPerfectPart) {
  expect_near(frame_of(plan(), part()), {}, 1e-12, 1e-13);
  InspectionPlan down = plan();
  down.features[2].axis = {-2, 0, 0};  // the sense of the line does not count
  expect_near(frame_of(down, part()), {}, 1e-12, 1e-13);
}

TEST(WorkpieceFrameLaws, MovesWithThePartButAlongTheLine) {
  synthetic::Draws draws(61);
  for (int i = 0; i < 100; ++i) {
    const Pose lie{rotation_about(draws.direction(), draws.between(-0.05, 0.05)), draws.place(1.0)};
    const Pose found = frame_of(plan(), part().moved(lie));
    EXPECT_LT((found.rotation - lie.rotation).norm(), 1e-12);
    // What is left is a slide along X of the part: no feature tells its place there.
    const Vec3 left = (lie.inverse() * found).translation;
    EXPECT_LT(Vec3(0, left.y(), left.z()).norm(), 1e-11);
    // The origin of the frame is the planned point of the line, whose place along X stays.
    const Vec3 planned = plan().features[2].point;
    EXPECT_NEAR((found.point(planned) - planned).dot(found.rotation.col(0)), 0.0, 1e-11);
  }
}

TEST(WorkpieceFrame, FollowsTheWallAcrossAndTheFloorsUp) {
  Part body = part();
  body.faces.at("S_a") =
      body.faces.at("S_a").shifted(0.02).turned(rotation_z(70e-6), {10, -40.02, 2.5});
  body.faces.at("F_a") = body.faces.at("F_a").shifted(0.01);
  body.faces.at("F_b") = body.faces.at("F_b").shifted(0.01);
  const Pose found = frame_of(plan(), body);
  // Turned by 70 urad about the wall's pivot at x = 10, moved 20 um outward and 10 um up.
  const Vec3 pivot(10, -40, 0);
  const Mat3 turn = rotation_z(70e-6);
  const Vec3 wanted = pivot - turn * pivot + Vec3(0, -0.02, 0.01);
  EXPECT_LT((found.rotation - turn).norm(), 1e-12);
  EXPECT_NEAR(found.translation.y(), wanted.y(), 1e-8);
  EXPECT_NEAR(found.translation.z(), 0.01, 1e-9);
}

TEST(WorkpieceFrameLaws, ALeaningWallIsReadAtItsPlannedHeight) {
  // A chamfer as the wall: exact wherever the part lies, although its points are not at one
  // height over the floors.
  InspectionPlan p = plan();
  p.frames.front().line = "E_c";
  synthetic::Draws draws(62);
  for (int i = 0; i < 50; ++i) {
    const Pose lie{rotation_about(draws.direction(), draws.between(-0.02, 0.02)), draws.place(0.5)};
    const Pose found = frame_of(p, part().moved(lie));
    EXPECT_LT((found.rotation - lie.rotation).norm(), 1e-10);
    const Vec3 left = (lie.inverse() * found).translation;
    EXPECT_LT(Vec3(0, left.y(), left.z()).norm(), 1e-9);
  }
  Part lowered = part();
  lowered.faces.at("F_a") = lowered.faces.at("F_a").shifted(-0.01);
  lowered.faces.at("F_b") = lowered.faces.at("F_b").shifted(-0.01);
  expect_near(frame_of(p, lowered), Pose::translated({0, -0.01, -0.01}), 1e-11, 1e-12);
}

}  // namespace
}  // namespace frustum::metrology
