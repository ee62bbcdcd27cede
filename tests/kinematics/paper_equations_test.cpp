// The equations of the papers, written out as their authors print them (products of 4x4 matrices),
// against the generic chain with the papers' machine files. Misprints are put right where noted.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numbers>

#include "core/random.hpp"
#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/model/chain.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

using enum parser::AxisLetter;
using Mat4 = Eigen::Matrix4d;

Mat4 matrix(const Pose& pose) {
  Mat4 m = Mat4::Identity();
  m.topLeftCorner<3, 3>() = pose.rotation;
  m.topRightCorner<3, 1>() = pose.translation;
  return m;
}

// Elementary matrices of the papers: shifts along and turns about X, Y and Z.
Mat4 shift(double x, double y, double z) {
  Mat4 m;
  m << 1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1;
  return m;
}
Mat4 turn_x(double a) {
  const double c = std::cos(a), s = std::sin(a);
  Mat4 m;
  m << 1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, 0, 0, 1;
  return m;
}
Mat4 turn_y(double a) {
  const double c = std::cos(a), s = std::sin(a);
  Mat4 m;
  m << c, 0, s, 0, 0, 1, 0, 0, -s, 0, c, 0, 0, 0, 0, 1;
  return m;
}
Mat4 turn_z(double a) {
  const double c = std::cos(a), s = std::sin(a);
  Mat4 m;
  m << c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  return m;
}

// Relative to the entries of rotations (1) and to the lengths in the chain (1000 mm).
void expect_same(const Mat4& chain, const Mat4& paper) {
  constexpr double kRelative = 1e-12;
  const Pose off{Mat3((chain - paper).topLeftCorner(3, 3)),
                 Vec3((chain - paper).topRightCorner(3, 1))};
  EXPECT_LT(off.rotation.cwiseAbs().maxCoeff(), kRelative);
  EXPECT_LT(off.translation.norm(), kRelative * std::max(1.0, paper.topRightCorner(3, 1).norm()));
}

class Draws {
 public:
  explicit Draws(std::uint32_t stream) : stream_(stream) {}
  double within(double size) {
    return size * (2.0 * uniform({.seed = 1871, .draw = stream_}, index_++) - 1.0);
  }

 private:
  std::uint32_t stream_;
  std::uint64_t index_ = 0;
};

AxisPositions drawn_position(Draws& draws) {
  AxisPositions q;
  for (const AxisLetter letter : kAxisLetters) {
    q[letter] = draws.within(is_rotary(letter) ? 3.0 : 300.0);
  }
  return q;
}

// The symbols of a machine file with their values, mm and rad.
using Symbols = std::map<std::string, double>;

GeometricErrors errors_of_symbols(const Machine& machine, const Symbols& symbols) {
  std::vector<ErrorEntry> entries;
  for (const auto& [name, value] : symbols) {
    const bool angle = is_rotation(machine.aliases().at(name).error.direction);
    ErrorEntry entry{.name = name};
    entry.terms = {ErrorShape{.amount = {value, angle ? UnitKind::angle : UnitKind::length}}};
    entries.push_back(entry);
  }
  const auto errors = resolve(machine, entries);
  EXPECT_TRUE(errors) << (errors ? "" : to_string(errors.error().front()));
  return *errors;
}

Symbols random_symbols(const Machine& machine, Draws& draws, double mm, double rad) {
  Symbols symbols;
  for (const auto& [name, alias] : machine.aliases()) {
    symbols[name] = draws.within(is_rotation(alias.error.direction) ? rad : mm);
  }
  return symbols;
}

// --- Ibaraki et al., machining tests: zx-yac
// -------------------------------------------------------

struct Ibaraki {
  Machine machine = shipped("zx-yac");
  Draws draws;
  Symbols e;
  GeometricErrors errors;
  AxisPositions q;

  explicit Ibaraki(std::uint32_t k)
      : draws(k),
        e(random_symbols(machine, draws, 0.05, 5e-4)),
        errors(errors_of_symbols(machine, e)),
        q(drawn_position(draws)) {}

  // (2)
  [[nodiscard]] Mat4 rTx() const { return shift(q[X], 0, 0); }
  [[nodiscard]] Mat4 xTz() const {
    return turn_x(e.at("alpha_ZY")) * turn_y(e.at("beta_ZX")) * shift(0, 0, q[Z]);
  }
  // (4)
  [[nodiscard]] Mat4 aTc() const {
    return shift(0, e.at("dy_CA"), 0) * turn_y(e.at("beta_CA")) * turn_z(-q[C]);
  }
  [[nodiscard]] Mat4 yTa() const {
    return shift(e.at("dx_AY"), 0, 0) * shift(0, e.at("dy_AY"), 0) * shift(0, 0, e.at("dz_AY")) *
           turn_x(e.at("alpha_AY")) * turn_y(e.at("beta_AY")) * turn_z(e.at("gamma_AY")) *
           turn_x(-q[A]);
  }
  [[nodiscard]] Mat4 rTy() const { return turn_z(-e.at("gamma_YX")) * shift(0, -q[Y], 0); }
};

TEST(PaperEquationsReference, IbarakiEquations1And2_ToolInTheReferenceFrame) {
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Ibaraki i(k);
    const ForwardChain chain(i.machine, i.errors, 0.0);
    expect_same(matrix(chain.bed_from_tool(i.q)), i.rTx() * i.xTz());
  }
}

TEST(PaperEquationsReference, IbarakiEquations3And4_WorkpieceInTheReferenceFrame) {
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Ibaraki i(k);
    const ForwardChain chain(i.machine, i.errors, 0.0);
    expect_same(matrix(chain.bed_from_table(i.q)), i.rTy() * i.yTa() * i.aTc());
  }
}

TEST(PaperEquationsReference, IbarakiEquation5_ToolInTheWorkpieceFrame) {
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Ibaraki i(k);
    const Mat4 rTw = i.rTy() * i.yTa() * i.aTc();
    expect_same(matrix(actual_pose(i.machine, i.errors, i.q, 0.0)),
                rTw.inverse() * i.rTx() * i.xTz());
  }
}

// --- Jang, volumetric error thesis: dvf5000
// --------------------------------------------------------
//
// Put right against the print: aYZ only in the Z joint, not in (4-3); in (4-8) and (4-9) the errors
// stand after the rotation and the displacements turn with it; Table 4-1 without the surplus zeros,
// the 50 as -50 at C. The products below have the full small rotations of (3-11), for which the
// print has their first order.

struct Jang {
  Machine machine = shipped("dvf5000");
  Draws draws;
  Symbols e;
  AxisPositions q;

  explicit Jang(std::uint32_t k, double mm = 0.05, double rad = 5e-4)
      : draws(k), e(random_symbols(machine, draws, mm, rad)), q(drawn_position(draws)) {}

  [[nodiscard]] double of(const std::string& name, char joint) const { return e.at(name + joint); }
  [[nodiscard]] Mat4 rotation(char joint) const {  // (3-11)
    return turn_x(of("ex", joint)) * turn_y(of("ey", joint)) * turn_z(of("ez", joint));
  }
  [[nodiscard]] Mat4 displacement(char joint, const Vec3& move) const {  // (3-15), with the motion
    return shift(move.x() + of("dx", joint), move.y() + of("dy", joint),
                 move.z() + of("dz", joint));
  }
  [[nodiscard]] Mat4 RTX() const {  // (4-2)
    return shift(-136, 717.5, 423) * displacement('X', {q[X], 0, 0}) * rotation('X');
  }
  [[nodiscard]] Mat4 XTY() const {  // (4-3)
    return shift(206, 356.5, 184) * turn_z(e.at("gXY")) * displacement('Y', {0, q[Y], 0}) *
           rotation('Y');
  }
  [[nodiscard]] Mat4 YTZ() const {  // (4-4)
    return shift(-70, -832, 782) * turn_x(e.at("aYZ")) * turn_y(e.at("bXZ")) *
           displacement('Z', {0, 0, q[Z]}) * rotation('Z');
  }
  [[nodiscard]] static Mat4 ZTS() { return shift(0, -242, -810); }  // (4-5)
  [[nodiscard]] static Mat4 STt() { return shift(0, 0, -150); }     // (4-6)
  [[nodiscard]] Mat4 RTB() const {                                  // (4-8)
    return turn_x(e.at("aZB")) * turn_z(e.at("gXB")) * turn_y(q[B]) * rotation('B') *
           displacement('B', Vec3::Zero());
  }
  [[nodiscard]] Mat4 BTC() const {  // (4-9)
    return shift(0, 0, -50) * turn_x(e.at("aYC")) * turn_y(e.at("bXC")) * turn_z(q[C]) *
           rotation('C') * displacement('C', Vec3::Zero());
  }
  [[nodiscard]] static Mat4 CTW() { return shift(0, 0, 0); }  // (4-10)

  // The errors of one joint alone: the others are nominal.
  void keep_only(char joint) {
    for (auto& [name, value] : e) {
      if (name.back() != joint) value = 0.0;
    }
  }
  [[nodiscard]] Pose bed_from_tool() const {
    const GeometricErrors errors = errors_of_symbols(machine, e);
    return ForwardChain(machine, errors, 150.0).bed_from_tool(q);
  }
  [[nodiscard]] Pose bed_from_table() const {
    const GeometricErrors errors = errors_of_symbols(machine, e);
    return ForwardChain(machine, errors, 150.0).bed_from_table(q);
  }
};

constexpr double kPaperTool = 150.0;

TEST(PaperEquationsReference, JangEquation4_2_XJoint) {
  for (std::uint32_t k = 0; k < 20; ++k) {
    Jang j(k);
    j.keep_only('X');
    const Mat4 rest = shift(206, 356.5 + j.q[Y], 184) * shift(-70, -832, 782 + j.q[Z]) *
                      Jang::ZTS() * Jang::STt();
    expect_same(matrix(j.bed_from_tool()) * rest.inverse(), j.RTX());
  }
}

TEST(PaperEquationsReference, JangEquation4_3_YJoint) {
  for (std::uint32_t k = 0; k < 20; ++k) {
    Jang j(k);
    j.keep_only('Y');
    const Mat4 before = shift(-136 + j.q[X], 717.5, 423);
    const Mat4 after = shift(-70, -832, 782 + j.q[Z]) * Jang::ZTS() * Jang::STt();
    expect_same(before.inverse() * matrix(j.bed_from_tool()) * after.inverse(), j.XTY());
  }
}

TEST(PaperEquationsReference, JangEquations4_4To4_6_ZJointSpindleAndTool) {
  for (std::uint32_t k = 0; k < 20; ++k) {
    Jang j(k);
    j.keep_only('Z');
    const Mat4 before = shift(-136 + j.q[X], 717.5, 423) * shift(206, 356.5 + j.q[Y], 184);
    expect_same(before.inverse() * matrix(j.bed_from_tool()), j.YTZ() * Jang::ZTS() * Jang::STt());
  }
}

TEST(PaperEquationsReference, JangEquation4_7_ToolChain) {
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Jang j(k);
    expect_same(matrix(j.bed_from_tool()), j.RTX() * j.XTY() * j.YTZ() * Jang::ZTS() * Jang::STt());
  }
}

TEST(PaperEquationsReference, JangEquation4_8_BJoint) {
  for (std::uint32_t k = 0; k < 20; ++k) {
    Jang j(k);
    j.keep_only('B');
    const Mat4 rest = shift(0, 0, -50) * turn_z(j.q[C]);
    expect_same(matrix(j.bed_from_table()) * rest.inverse(), j.RTB());
  }
}

TEST(PaperEquationsReference, JangEquations4_9And4_10_CJointAndWorkpiece) {
  for (std::uint32_t k = 0; k < 20; ++k) {
    Jang j(k);
    j.keep_only('C');
    expect_same(turn_y(j.q[B]).inverse() * matrix(j.bed_from_table()), j.BTC() * Jang::CTW());
  }
}

TEST(PaperEquationsReference, JangEquation4_11_WorkpieceChain) {
  for (std::uint32_t k = 0; k < 50; ++k) {
    const Jang j(k);
    expect_same(matrix(j.bed_from_table()), j.RTB() * j.BTC() * Jang::CTW());
    // (3-4): the tool as the workpiece sees it.
    const GeometricErrors errors = errors_of_symbols(j.machine, j.e);
    expect_same(
        matrix(actual_pose(j.machine, errors, j.q, kPaperTool)),
        (j.RTB() * j.BTC()).inverse() * j.RTX() * j.XTY() * j.YTZ() * Jang::ZTS() * Jang::STt());
  }
}

// The printed first order 1 + e: (3-13), (4-2) and the like.
Mat4 printed(double x, double y, double z) {
  Mat4 m;
  m << 1, -z, y, 0, z, 1, -x, 0, -y, x, 1, 0, 0, 0, 0, 1;
  return m;
}

TEST(PaperEquationsReference, JangEquations4_2To4_7_AsPrintedWithErrorsWhoseSquareVanishes) {
  for (std::uint32_t k = 0; k < 50; ++k) {
    // 1e-7 rad: the squares that the print leaves out are 1e-14 of the lengths.
    const Jang j(k, 1e-5, 1e-7);
    const auto small = [&](char joint) {
      return printed(j.of("ex", joint), j.of("ey", joint), j.of("ez", joint));
    };
    const Mat4 paper = shift(-136, 717.5, 423) * j.displacement('X', {j.q[X], 0, 0}) * small('X') *
                       shift(206, 356.5, 184) * printed(0, 0, j.e.at("gXY")) *
                       j.displacement('Y', {0, j.q[Y], 0}) * small('Y') * shift(-70, -832, 782) *
                       printed(j.e.at("aYZ"), j.e.at("bXZ"), 0) *
                       j.displacement('Z', {0, 0, j.q[Z]}) * small('Z') * Jang::ZTS() * Jang::STt();
    expect_same(matrix(j.bed_from_tool()), paper);
  }
}

// --- Bossoni, thesis on a five-axis test piece
// -----------------------------------------------------

// A cone of tool directions of half angle alpha, inclined by beta, turned by gamma, at radial angle
// phi.
struct Cone {
  double alpha, beta, gamma, r, l, phi;

  explicit Cone(Draws& draws)
      : alpha(0.8 + draws.within(0.4)),
        beta(0.5 + draws.within(0.2)),
        gamma(draws.within(1.5)),
        r(60.0 + draws.within(40.0)),
        l(150.0 + draws.within(50.0)),
        phi(draws.within(std::numbers::pi)) {}

  // In the frame that gamma turns into: tool tip and tool axis.
  [[nodiscard]] Vec3 tip() const {
    return rotation_z(gamma) * rotation_y(beta) * Vec3(r * std::cos(phi), r * std::sin(phi), 0);
  }
  [[nodiscard]] Vec3 axis() const {
    return rotation_z(gamma) * rotation_y(beta) *
           Vec3(-std::sin(alpha) * std::cos(phi), -std::sin(alpha) * std::sin(phi),
                std::cos(alpha));
  }
  // (3.16), (3.17), (3.19)
  [[nodiscard]] Vec3 crossing() const {
    const double rQ = r - l * std::sin(alpha);
    const double cb = std::cos(beta), sb = std::sin(beta), cg = std::cos(gamma),
                 sg = std::sin(gamma), cp = std::cos(phi), sp = std::sin(phi),
                 h = l * std::cos(alpha);
    return {h * sb * cg + rQ * (cb * cp * cg - sp * sg),
            h * sb * sg + rQ * (cb * cp * sg + sp * cg), h * cb - rQ * sb * cp};
  }
  // Rotary positions that point the tool along its axis: Rz(C) Ry(B) ez.
  [[nodiscard]] AxisPositions rotary() const {
    const Vec3 u = axis();
    AxisPositions q;
    q[B] = std::atan2(std::hypot(u.x(), u.y()), u.z());
    q[C] = std::atan2(u.y(), u.x());
    return q;
  }
};

AxisPositions at_linear(AxisPositions q, const Vec3& xyz) {
  q[X] = xyz.x(), q[Y] = xyz.y(), q[Z] = xyz.z();
  return q;
}

void expect_on_cone(const Pose& pose, const Vec3& tip, const Vec3& axis) {
  EXPECT_LT((pose.translation - tip).norm(), 1e-12 * 300.0);
  EXPECT_LT((pose.rotation.col(2) - axis).norm(), 1e-12);
}

TEST(PaperEquationsReference, BossoniEquation3_19_BothRotaryAxesInTheHead) {
  const Machine machine = shipped("double-pivot-head");
  Draws draws(1);
  for (int k = 0; k < 100; ++k) {
    const Cone cone(draws);
    const AxisPositions q = at_linear(cone.rotary(), cone.crossing());
    expect_on_cone(nominal_pose(machine, q, cone.l), cone.tip(), cone.axis());
  }
}

TEST(PaperEquationsReference, BossoniEquations3_22And3_25_SwivelHeadAndRotaryTable) {
  const Machine machine = shipped("swivel-head-table");
  Draws draws(2);
  for (int k = 0; k < 100; ++k) {
    const Cone cone(draws);
    const Vec3 x0(draws.within(100.0), 0, 0);
    AxisPositions q = cone.rotary();
    const double c = std::cos(q[C]), s = std::sin(q[C]);
    Mat3 table;  // (3.23)
    table << c, s, 0, -s, c, 0, 0, 0, 1;
    q = at_linear(q, table * (cone.crossing() + x0));
    expect_on_cone(nominal_pose(machine, q, cone.l), cone.tip() + x0, cone.axis());
  }
}

TEST(PaperEquationsReference, BossoniEquation3_30_BothRotaryAxesInTheTable) {
  // The print has + sin B in the first row of the tilt; (3.29) has it right.
  const Machine machine = shipped("iwf-bc");
  Draws draws(3);
  for (int k = 0; k < 100; ++k) {
    Cone cone(draws);
    cone.gamma = 0.0;
    const Vec3 x0(draws.within(100.0), draws.within(100.0), draws.within(100.0));
    AxisPositions q = cone.rotary();
    const double cB = std::cos(q[B]), sB = std::sin(q[B]), cC = std::cos(q[C]), sC = std::sin(q[C]),
                 cb = std::cos(cone.beta), sb = std::sin(cone.beta);
    Mat3 tilt, table;
    tilt << cB, 0, -sB, 0, 1, 0, sB, 0, cB;
    table << cC, sC, 0, -sC, cC, 0, 0, 0, 1;
    const Vec3 on_table(cone.r * cb * std::cos(cone.phi) + x0.x(),
                        cone.r * std::sin(cone.phi) + x0.y(),
                        -cone.r * sb * std::cos(cone.phi) + x0.z());
    q = at_linear(q, tilt * table * on_table);
    expect_on_cone(nominal_pose(machine, q, 0.0), cone.tip() + x0, cone.axis());
  }
}

}  // namespace
}  // namespace frustum::kinematics
