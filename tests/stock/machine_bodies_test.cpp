// Bodies of machines in random poses: their distances against those of all their triangles.
#include "stock/collision/machine_collision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "stock/collision/pair_watch.hpp"
#include "tests/kinematics/machines.hpp"
#include "tests/law_count.hpp"

namespace frustum::stock {
namespace {

using kinematics::Machine;
using kinematics::MachineBody;
using kinematics::shipped;

// --- The independent test: closed meshes, all triangles against all others ----------------------

using Triangle = std::array<Vec3, 3>;

struct Facets {
  std::vector<Triangle> triangles{};
  double sagitta = 0.0;  // by how much the body may be outside of its facets

  void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
};

Facets facets_of(const kinematics::BoxBody& box, const Pose& at) {
  const Vec3 h = 0.5 * box.size;
  const auto p = [&](double x, double y, double z) {
    return at.point({x * h.x(), y * h.y(), (z + 1.0) * h.z()});
  };
  Facets f;
  f.quad(p(-1, -1, -1), p(-1, 1, -1), p(1, 1, -1), p(1, -1, -1));
  f.quad(p(-1, -1, 1), p(1, -1, 1), p(1, 1, 1), p(-1, 1, 1));
  f.quad(p(-1, -1, -1), p(1, -1, -1), p(1, -1, 1), p(-1, -1, 1));
  f.quad(p(1, 1, -1), p(-1, 1, -1), p(-1, 1, 1), p(1, 1, 1));
  f.quad(p(1, -1, -1), p(1, 1, -1), p(1, 1, 1), p(1, -1, 1));
  f.quad(p(-1, 1, -1), p(-1, -1, -1), p(-1, -1, 1), p(-1, 1, 1));
  return f;
}

Facets facets_of(const kinematics::CylinderBody& cylinder, const Pose& at) {
  constexpr int kSides = 40;
  const double r = 0.5 * cylinder.diameter;
  const auto p = [&](int k, double z) {
    const double t = 2.0 * std::numbers::pi * k / kSides;
    return at.point({r * std::cos(t), r * std::sin(t), z});
  };
  const Vec3 bottom = at.point(Vec3::Zero());
  const Vec3 top = at.point({0, 0, cylinder.height});
  Facets f;
  f.sagitta = r * (1.0 - std::cos(std::numbers::pi / kSides));
  for (int k = 0; k < kSides; ++k) {
    f.quad(p(k, 0), p(k + 1, 0), p(k + 1, cylinder.height), p(k, cylinder.height));
    f.triangles.push_back({bottom, p(k + 1, 0), p(k, 0)});
    f.triangles.push_back({top, p(k, cylinder.height), p(k + 1, cylinder.height)});
  }
  return f;
}

Facets facets_of(const MachineBody& body, const Pose& bed_from_body) {
  if (const auto* box = std::get_if<kinematics::BoxBody>(&body.shape))
    return facets_of(*box, bed_from_body);
  return facets_of(std::get<kinematics::CylinderBody>(body.shape), bed_from_body);
}

double point_to_triangle(const Vec3& p, const Triangle& t) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  bool above = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = t[k];
    const Vec3 e = t[(k + 1) % 3] - a;
    above = above && e.cross(p - a).dot(n) >= 0.0;
    const double s = std::clamp(e.dot(p - a) / e.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - a - s * e).norm());
  }
  return above ? std::abs(n.dot(p - t[0])) / n.norm() : nearest;
}

// Of segments that are not parallel where they are inside both; ends are points of triangles.
double edge_to_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const double den = uu * vv - uv * uv;
  if (den <= 1e-12 * uu * vv) return std::numeric_limits<double>::infinity();
  const double s = (uv * vw - vv * uw) / den, t = (uu * vw - uv * uw) / den;
  if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return std::numeric_limits<double>::infinity();
  return (w + s * u - t * v).norm();
}

bool pierces(const Vec3& a, const Vec3& b, const Triangle& t) {
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double da = n.dot(a - t[0]), db = n.dot(b - t[0]);
  if (da * db >= 0.0) return false;
  const Vec3 p = a + da / (da - db) * (b - a);
  for (std::size_t k = 0; k < 3; ++k) {
    if ((t[(k + 1) % 3] - t[k]).cross(p - t[k]).dot(n) < 0.0) return false;
  }
  return true;
}

double triangle_distance(const Triangle& a, const Triangle& b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    nearest = std::min({nearest, point_to_triangle(a[i], b), point_to_triangle(b[i], a)});
    if (pierces(a[i], a[(i + 1) % 3], b) || pierces(b[i], b[(i + 1) % 3], a)) return 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      nearest = std::min(nearest, edge_to_edge(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
    }
  }
  return nearest;
}

double apart_at_least(const Triangle& a, const Triangle& b) {
  const Vec3 lo_a = a[0].cwiseMin(a[1]).cwiseMin(a[2]), hi_a = a[0].cwiseMax(a[1]).cwiseMax(a[2]);
  const Vec3 lo_b = b[0].cwiseMin(b[1]).cwiseMin(b[2]), hi_b = b[0].cwiseMax(b[1]).cwiseMax(b[2]);
  return (lo_a - hi_b).cwiseMax(lo_b - hi_a).cwiseMax(Vec3::Zero()).norm();
}

// Both are convex.
bool is_inside(const Vec3& p, const Facets& f) {
  return std::ranges::all_of(f.triangles, [&p](const Triangle& t) {
    return (t[1] - t[0]).cross(t[2] - t[0]).dot(p - t[0]) <= 0.0;
  });
}

double mesh_distance(const Facets& a, const Facets& b) {
  if (is_inside(a.triangles[0][0], b) || is_inside(b.triangles[0][0], a)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Triangle& p : a.triangles) {
    for (const Triangle& q : b.triangles) {
      if (apart_at_least(p, q) < nearest) nearest = std::min(nearest, triangle_distance(p, q));
    }
  }
  return nearest;
}

kinematics::AxisPositions random_axes(const Machine& machine, std::uint64_t draw) {
  kinematics::AxisPositions q;
  std::uint64_t k = 0;
  for (const kinematics::Joint& joint : machine.joints()) {
    q[joint.letter] =
        joint.travel.lo + uniform({.seed = 25}, 8 * draw + k++) * joint.travel.width();
  }
  return q;
}

// The part of the machine in the bed, joint by joint, by other means than the search.
Pose bed_from(const Machine& machine, const kinematics::MachinePart& part,
              const kinematics::AxisPositions& q) {
  const auto& chain = part.side < 0 ? machine.work_chain() : machine.tool_chain();
  Pose pose;
  for (std::size_t k = 0; k < part.joints; ++k) {
    const kinematics::Joint& joint = chain[k];
    const double moved = joint.side * q[joint.letter];
    pose = pose * Pose::translated(joint.offset);
    pose = pose * (joint.rotary()
                       ? Pose::rotated(Eigen::AngleAxisd(moved, joint.direction).toRotationMatrix())
                       : Pose::translated(moved * joint.direction));
  }
  return pose;
}

class MachineBodiesOf : public ::testing::TestWithParam<const char*> {};

TEST_P(MachineBodiesOf, AreAsFarApartAsTheirTrianglesIn200RandomPoses_Fault2_25) {
  const Machine machine = shipped(GetParam());
  const auto scene = *bodies_of(machine);
  int met = 0, apart = 0;
  for (std::uint64_t draw = 0; draw < 200; ++draw) {
    const kinematics::AxisPositions q = random_axes(machine, draw);
    std::vector<Facets> facets;
    for (const MachineBody& body : machine.bodies()) {
      facets.push_back(facets_of(body, bed_from(machine, body.part, q) * body.part_from_body));
    }
    for (std::size_t i = 0; i < scene.size(); ++i) {
      for (std::size_t j = i + 1; j < scene.size(); ++j) {
        if (!may_meet(scene[i], scene[j])) continue;
        const double meshes = mesh_distance(facets[i], facets[j]);
        const Separation found = PairWatch(machine, scene[i], scene[j]).separation_at(q);
        const double outside = facets[i].sagitta + facets[j].sagitta;
        EXPECT_LE(found.lower, meshes + 1e-5) << scene[i].name << ' ' << scene[j].name;
        EXPECT_GE(found.upper, meshes - outside - 1e-5) << scene[i].name << ' ' << scene[j].name;
        EXPECT_LE(found.upper - found.lower, 1e-5 * (1.0 + found.upper));
        ++(found.upper == 0.0 ? met : apart);
      }
    }
  }
  EXPECT_GT(met, 20);
  EXPECT_GT(apart, 2000);
}

// Small steps between random positions see nothing that the search has not seen.
TEST_P(MachineBodiesOf, ArePassedOverNowhereByFastAxes_Fault2_25) {
  const Machine machine = shipped(GetParam());
  const auto scene = *bodies_of(machine);
  const int ways = proof::law_count(40, 2);
  for (int way = 0; way < ways; ++way) {
    const auto begin = static_cast<std::uint64_t>(10 * way);
    std::vector<AxisVertex> vertices;
    for (std::uint64_t k = 0; k < 4; ++k) {
      vertices.push_back(
          {random_axes(machine, 1000 + begin + k), static_cast<std::uint32_t>(k), 1});
    }
    for (std::size_t i = 0; i < scene.size(); ++i) {
      for (std::size_t j = i + 1; j < scene.size(); ++j) {
        if (!may_meet(scene[i], scene[j])) continue;
        PairWatch watch(machine, scene[i], scene[j]);
        watch.follow(vertices);
        double nearest = std::numeric_limits<double>::infinity();
        constexpr int kSteps = 150;
        for (std::size_t k = 1; k < vertices.size(); ++k) {
          for (int s = 0; s <= kSteps; ++s) {
            const auto q = kinematics::part_way(vertices[k - 1].q, vertices[k].q, 1.0 * s / kSteps);
            nearest = std::min(nearest, watch.separation_at(q).upper);
          }
        }
        ASSERT_TRUE(watch.nearest());
        EXPECT_LE(watch.nearest()->distance, nearest / 0.99 + 2.0 * kNearness)
            << scene[i].name << ' ' << scene[j].name;
        if (nearest <= kMeeting) {
          EXPECT_FALSE(watch.meetings().empty());
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, MachineBodiesOf,
                         ::testing::Values("zx-yac", "double-pivot-head"));

TEST(MachineBodies, OfShippedMachinesAreThereAndDoNotTouchAtHome_Fault2_25) {
  for (const char* name : {"ac-probe", "double-pivot-head", "dvf5000", "iwf-bc",
                           "swivel-head-table", "three-axis", "zx-yac"}) {
    const Machine machine = shipped(name);
    EXPECT_GE(machine.bodies().size(), 5U) << name;
    const MachineScene scene{&machine, *bodies_of(machine), machine.bodies().size()};
    for (const TouchingPair& pair : touching_at_home(scene)) {
      ADD_FAILURE() << name << ": " << pair.first << ' ' << pair.second;
    }
  }
}

TEST(MachineBodies, ConvexDistancesAreThoseOfTheirForms_Fault2_25) {
  const Vec3 h(10, 20, 30);
  const ConvexShape box = ConvexShape::box({-h, h});
  // Corner to corner: 3, 4 and 12 apart.
  const Separation corners = convex_distance(box, box, Pose::translated({23, 44, 72}));
  EXPECT_NEAR(corners.upper, 13.0, 1e-9);
  EXPECT_NEAR(corners.lower, 13.0, 1e-5);
  // A cylinder of radius 5 beside the box, its axis parallel to an edge at (3, 4) from it.
  const ConvexShape cylinder =
      ConvexShape::revolved(std::array{cutter::Zone{cutter::ZoneKind::cone, -9, 9, 5}});
  EXPECT_NEAR(convex_distance(box, cylinder, Pose::translated({16, 28, 0})).upper, 5.0, 1e-5);
  // Its rim over the top face, leaning by 30 degrees: the axis' end is 8 above, the rim lower by
  // 5 sin 30.
  const Pose leaning{rotation_x(std::numbers::pi / 6.0),
                     Vec3(0, 0, 38.0 + 9.0 * std::cos(std::numbers::pi / 6.0))};
  EXPECT_NEAR(convex_distance(box, cylinder, leaning).upper, 5.5, 1e-5);
  EXPECT_EQ(convex_distance(box, cylinder, Pose::translated({0, 0, 38.9})).upper, 0.0);
}

}  // namespace
}  // namespace frustum::stock
