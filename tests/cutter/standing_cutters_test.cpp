// Ends of swept intervals against standing cutters: random rays over every kind of cutter and
// motion.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>

#include "tests/cutter/sweep_judge.hpp"
#include "tests/law_count.hpp"

namespace frustum::proof {
namespace {

constexpr double kNanometre = 1e-6;  // mm

struct Case {
  const Kind* kind;
  MotionFamily family;
};
struct AnyPath {
  const Kind* kind;
};
void PrintTo(const AnyPath& each, std::ostream* out) { *out << each.kind->name; }
void PrintTo(const Case& each, std::ostream* out) {
  *out << each.kind->name << ' ' << to_string(each.family);
}

std::vector<Case> all_cases() {
  std::vector<Case> all;
  for (const Kind& kind : cutter_kinds()) {
    for (const MotionFamily family : kMotionFamilies) all.push_back({&kind, family});
  }
  return all;
}

// All cases together: 100,000, or as many as asked for; 6,000 in `make test`.
int rays_of_a_case() {
  const char* wanted = std::getenv("FRUSTUM_ORACLE_RAYS");
  const int total = wanted ? std::atoi(wanted) : law_count(100000, 6000);
  const auto all = all_cases();
  const auto convex =
      std::count_if(all.begin(), all.end(), [](const Case& c) { return c.kind->is_convex; });
  return 1 + total / static_cast<int>(convex);
}

bool within_a_nanometre(const Judgement& one) {
  return one.worst_end < kNanometre && one.worst_covered < kNanometre &&
         one.worst_void < kNanometre && one.worst_contact < kNanometre && one.worst_normal < 1e-3;
}

std::string text_of(const Judgement& all) {
  return fmt::format(
      "{} rays, {} ends: worst end {:.4f} nm, covered {:.4f} nm, void {:.4f} nm, contact {:.4f} "
      "nm, "
      "normal {:.0e}",
      all.rays, all.ends, all.worst_end * 1e6, all.worst_covered * 1e6, all.worst_void * 1e6,
      all.worst_contact * 1e6, all.worst_normal);
}

// Counts what is judged, and complains of the first few that are wrong.
class Court {
 public:
  void hear(const Judgement& one, const std::string& of) {
    all_.add(one);
    if (within_a_nanometre(one)) return;
    ++wrong_;
    if (wrong_ <= 5) ADD_FAILURE() << of << ": " << text_of(one) << ' ' << one.where;
  }
  void close() const {
    EXPECT_EQ(wrong_, 0) << "rays of " << all_.rays;
    EXPECT_GT(all_.ends, 0);
    using ::testing::Test;
    Test::RecordProperty("rays", std::to_string(all_.rays));
    Test::RecordProperty("ends", std::to_string(all_.ends));
    Test::RecordProperty("worst_end_nm", fmt::format("{:.5f}", all_.worst_end * 1e6));
    Test::RecordProperty("worst_void_nm", fmt::format("{:.5f}", all_.worst_void * 1e6));
    Test::RecordProperty("worst_covered_nm", fmt::format("{:.5f}", all_.worst_covered * 1e6));
    std::cout << text_of(all_) << '\n';
  }

 private:
  Judgement all_;
  int wrong_ = 0;
};

class StandingCuttersOracle : public ::testing::TestWithParam<Case> {};

TEST_P(StandingCuttersOracle, FindEveryEndWithinANanometre) {
  const auto [kind, family] = GetParam();
  constexpr int kRaysOfAPath = 20;
  // Of a body that is not convex, times are taken one by one at half a micrometre where a wall
  // slides along.
  const int paths = 1 + rays_of_a_case() / kRaysOfAPath / (kind->is_convex ? 1 : 5);
  Court court;
  for (int p = 0; p < paths; ++p) {
    Draw draw(11, static_cast<std::uint32_t>(p));
    const SweepJudge judge(*kind, random_path(family, draw));
    for (int k = 0; k < kRaysOfAPath; ++k) {
      court.hear(judge.along(judge.random_ray(draw), draw), fmt::format("path {} ray {}", p, k));
    }
  }
  court.close();
}

INSTANTIATE_TEST_SUITE_P(Sweeps, StandingCuttersOracle, ::testing::ValuesIn(all_cases()),
                         [](const auto& each) {
                           return each.param.kind->name + "_" + to_string(each.param.family);
                         });

// Steps beside a place where something begins or ends: through it, and to either side by a hair.
constexpr std::array kHairs = {0.0,   1e-12, -1e-12, 1e-9, -1e-9, 2e-6,
                               -2e-6, 1e-4,  -1e-4,  0.1,  -0.1};

class DegenerateSweepsOracle : public ::testing::TestWithParam<AnyPath> {
 protected:
  using Rays = std::vector<Ray>;
  [[nodiscard]] const Kind& kind() const { return *GetParam().kind; }
  [[nodiscard]] double radius() const { return static_cast<double>(kind().meridian.max_radius()); }
  [[nodiscard]] double height() const { return static_cast<double>(kind().meridian.height()); }

  void judge(const kinematics::ToolPath& path, const Rays& rays, const std::string& what) {
    const SweepJudge judge(kind(), path);
    Draw draw(5);
    for (std::size_t k = 0; k < rays.size(); k += stride(19U)) {
      court_.hear(judge.along(rays[k], draw), fmt::format("{}, ray {}", what, k));
    }
  }
  // One ray in how many is judged: those along a concave body take up to a second each, so
  // `make test` judges one in `reduced`, a prime, so that each kind of ray has its turn.
  [[nodiscard]] std::size_t stride(std::size_t reduced) const {
    return kind().cutter.body().concave().empty() ? 1U : law_count<std::size_t>(1U, reduced);
  }
  void judge_at_random(const kinematics::ToolPath& path, Draw& draw, int rays,
                       const std::string& what) {
    const SweepJudge judge(kind(), path);
    for (int k = 0; k < rays; ++k) {
      court_.hear(judge.along(judge.random_ray(draw), draw), fmt::format("{}, ray {}", what, k));
    }
  }
  // Rays that slide along a concave body take a second each: few of them, unless all are asked for.
  [[nodiscard]] std::uint32_t paths_with_sliding_rays(std::uint32_t all) const {
    const bool few = !kind().cutter.body().concave().empty() &&
                     std::getenv("FRUSTUM_ORACLE_HOLLOWED") == nullptr;
    return few ? std::min(all, 2U) : all;
  }
  void TearDown() override { court_.close(); }

  Court court_;
};

TEST_P(DegenerateSweepsOracle, RaysTangentToTheEnvelope) {
  for (const MotionFamily family : kMotionFamilies) {
    for (std::uint32_t p = 0; p < paths_with_sliding_rays(law_count(6U, 1U)); ++p) {
      Draw draw(21, p);
      const kinematics::ToolPath path = random_path(family, draw);
      const SweepJudge judge(kind(), path);
      const Ray any = judge.random_ray(draw);
      const IntervalSet met = judge.swept().along(any, {-300.0, 300.0});
      for (const Interval& i : met.intervals()) {
        const Vec3 n =
            judge.swept().contact(any, i.lo, static_cast<std::uint32_t>(i.lo_tag)).normal;
        for (std::size_t h = 0; h < kHairs.size(); h += stride(7U)) {
          const double hair = kHairs[h];
          const Ray tangent{any.at(i.lo) + hair * n, n.cross(draw.direction()).normalized()};
          court_.hear(judge.along(tangent, draw),
                      fmt::format("{} path {} hair {}", to_string(family), p, hair));
        }
      }
    }
  }
}

TEST_P(DegenerateSweepsOracle, RaysThroughTheToolAxis) {
  for (const MotionFamily family : kMotionFamilies) {
    Draw draw(22, static_cast<std::uint32_t>(family));
    const kinematics::ToolPath path = random_path(family, draw);
    Rays rays;
    for (int k = 0; k < law_count(20, 4); ++k) {
      const kinematics::ToolPose at =
          kinematics::between(path.poses[0], path.poses[1], draw.between(0.0, 1.0));
      const Vec3 on_axis = at.tip + draw.between(-1.0, height() + 1.0) * at.axis;
      rays.push_back({on_axis, draw.direction()});
      rays.push_back({on_axis, at.axis.cross(draw.direction()).normalized()});
      rays.push_back({on_axis, k % 2 == 0 ? at.axis : Vec3(-at.axis)});
      const double lean = draw.decades(1e-15, 1e-3);
      rays.push_back({on_axis, (at.axis + lean * draw.direction()).normalized()});
    }
    judge(path, rays, to_string(family));
  }
}

TEST_P(DegenerateSweepsOracle, RaysAlongTheMotion) {
  for (std::uint32_t p = 0; p < paths_with_sliding_rays(law_count(12U, 3U)); ++p) {
    Draw draw(23, p);
    const bool level = p % 3 == 0;
    const kinematics::ToolPath path =
        random_path(level ? MotionFamily::straight : MotionFamily::tilted, draw);
    const Vec3 feed = (path.poses[1].tip - path.poses[0].tip).normalized();
    const Vec3 axis = path.poses[0].axis;
    const Vec3 side = axis.cross(feed).normalized();
    Rays rays;
    for (const double hair : kHairs) {
      for (const double up : {0.0, 0.3 * height(), height()}) {
        const Vec3 origin = path.poses[0].tip + (up + hair) * axis;
        rays.push_back({origin, feed});
        rays.push_back({origin + (radius() + hair) * side, feed});
        rays.push_back({origin - (radius() + hair) * side, -feed});
        rays.push_back({origin + 0.4 * radius() * side, feed});
      }
    }
    judge(path, rays, fmt::format("path {}", p));
  }
}

TEST_P(DegenerateSweepsOracle, RaysInTheEndFace) {
  for (const MotionFamily family : kMotionFamilies) {
    for (std::uint32_t p = 0; p < law_count(3U, 1U); ++p) {
      Draw draw(24, p + 16 * static_cast<std::uint32_t>(family));
      const kinematics::ToolPath path = random_path(family, draw);
      Rays rays;
      for (const double hair : kHairs) {
        const double t = draw.chance(0.5) ? draw.between(0.0, 1.0) : draw.below(2);
        const kinematics::ToolPose at = kinematics::between(path.poses[0], path.poses[1], t);
        for (const double z : {0.0, height()}) {
          const Vec3 in_face = at.tip + (z + hair) * at.axis;
          const Vec3 along = at.axis.cross(draw.direction()).normalized();
          rays.push_back({in_face, along});
          rays.push_back({in_face + 0.7 * radius() * at.axis.cross(along), along});
          rays.push_back({in_face + radius() * at.axis.cross(along), along});
        }
      }
      judge(path, rays, to_string(family));
    }
  }
}

TEST_P(DegenerateSweepsOracle, PureRotationAboutTheTip) {
  for (std::uint32_t p = 0; p < law_count(15U, 3U); ++p) {
    Draw draw(25, p);
    const Vec3 from = draw.axis(1.0);
    const Vec3 about = from.cross(draw.direction()).normalized();
    const double turn = draw.decades(1e-9, 2.8);
    const kinematics::ToolPath path =
        path_through({{Vec3::Zero(), from}, {Vec3::Zero(), rotation_about(about, turn) * from}});
    Rays rays = {{Vec3::Zero(), about}, {Vec3::Zero(), from}, {Vec3::Zero(), draw.direction()}};
    for (const double hair : kHairs) rays.push_back({hair * from, about.cross(from)});
    judge(path, rays, fmt::format("turn {}", turn));
    judge_at_random(path, draw, 40, fmt::format("turn {}", turn));
  }
}

TEST_P(DegenerateSweepsOracle, RotationAboutAPointOfTheAxisOrBesideIt) {
  for (std::uint32_t p = 0; p < law_count(15U, 3U); ++p) {
    Draw draw(26, p);
    const Vec3 from = draw.axis(1.0);
    const Vec3 about = from.cross(draw.direction()).normalized();
    const Vec3 centre = draw.between(-10.0, 40.0) * from + (p % 2) * draw.between(0, 9) * about;
    const Mat3 turn = rotation_about(about, draw.decades(1e-4, 1.5));
    const kinematics::ToolPath path =
        path_through({{-centre, from}, {-(turn * centre), turn * from}});
    judge_at_random(path, draw, 40, fmt::format("path {}", p));
  }
}

TEST_P(DegenerateSweepsOracle, Plunges) {
  for (std::uint32_t p = 0; p < law_count(8U, 2U); ++p) {
    Draw draw(27, p);
    const kinematics::ToolPath path = random_path(MotionFamily::plunge, draw);
    const Vec3 axis = path.poses[0].axis;
    const Vec3 side = perpendicular_to(axis);
    Rays rays;
    for (const double hair : kHairs) {
      rays.push_back({path.poses[0].tip + (radius() + hair) * side, axis});
      rays.push_back({path.poses[1].tip + 0.5 * radius() * side, -axis});
      rays.push_back({path.poses[1].tip + (radius() + hair) * side, axis.cross(side)});
    }
    judge(path, rays, fmt::format("path {}", p));
  }
}

TEST_P(DegenerateSweepsOracle, DwellsAndBlocksOfNoLengthAmongOthers) {
  for (std::uint32_t p = 0; p < law_count(8U, 2U); ++p) {
    Draw draw(28, p);
    const kinematics::ToolPose a{draw.point(Vec3(-5, -5, 0), Vec3(5, 5, 3)), draw.axis(0.3)};
    const kinematics::ToolPose b{draw.point(Vec3(-5, -5, 0), Vec3(5, 5, 3)), draw.axis(0.3)};
    const kinematics::ToolPose hair{a.tip + Vec3(1e-15, 0, 0), a.axis};
    judge_at_random(path_through({a, a}), draw, 60, "a dwell");
    judge_at_random(path_through({a, a, b, b, b}), draw, 60, "among others");
    judge_at_random(path_through({a, hair, a, b, a}), draw, 60, "there and back");
  }
}

TEST_P(DegenerateSweepsOracle, SweepsThatCrossThemselves) {
  for (std::uint32_t p = 0; p < law_count(20U, 3U); ++p) {
    Draw draw(29, p);
    judge_at_random(random_path(MotionFamily::crossing, draw), draw, 40, fmt::format("path {}", p));
  }
}

TEST_P(DegenerateSweepsOracle, CuttersThatTurnByTensOfDegreesInOneBlock) {
  for (std::uint32_t p = 0; p < law_count(20U, 3U); ++p) {
    Draw draw(30, p);
    const Vec3 from = draw.axis(1.0);
    const Vec3 about = from.cross(draw.direction()).normalized();
    const double turn = draw.between(0.2, 3.0);
    const kinematics::ToolPath path = path_through(
        {{Vec3::Zero(), from},
         {draw.between(0.0, 40.0) * draw.direction(), rotation_about(about, turn) * from}});
    judge_at_random(path, draw, 40, fmt::format("turn {}", turn));
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, DegenerateSweepsOracle, ::testing::ValuesIn([] {
                           std::vector<AnyPath> all;
                           for (const Kind& kind : cutter_kinds()) all.push_back({&kind});
                           return all;
                         }()),
                         [](const auto& each) { return each.param.kind->name; });

// The judge itself: what it throws away unseen holds nothing.
TEST(StandingCutters, FindNothingHigherThanTimesInDenseOrder) {
  for (const Case& each : all_cases()) {
    Draw draw(31, static_cast<std::uint32_t>(each.family));
    const kinematics::ToolPath path = random_path(each.family, draw);
    const StandingCutters standing(each.kind->meridian, each.kind->is_convex, path);
    for (int k = 0; k < law_count(10, 1); ++k) {
      const Vec3L point = draw.point(Vec3(-12, -12, -8), Vec3(12, 12, 35)).cast<Real>();
      Real dense = 1e9L;
      for (std::size_t s = 0; s < path.segments.size(); ++s) {
        for (int i = 0; i <= 1000; ++i) {
          dense = std::min(dense, standing.distance_at(s, 1e-3 * i, point));
        }
      }
      const Real depth = standing.depth(point, 1e3L, -1e3L);
      EXPECT_LE(depth, dense + 1e-9L) << each.kind->name << ' ' << to_string(each.family);
      EXPECT_GT(depth, dense - 0.1L) << each.kind->name << ' ' << to_string(each.family);
    }
  }
}

}  // namespace
}  // namespace frustum::proof
