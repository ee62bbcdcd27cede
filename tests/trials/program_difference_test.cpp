// Programs that do the same, and ten seeded faults, each found and named.
#include "post/comparing/program_difference.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "parser/interpreter.hpp"
#include "parser/program.hpp"
#include "post/comparing/fault.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "tests/trials/cone_trial.hpp"

namespace frustum::trials {
namespace {

using parser::AxisLetter;
using parser::Motion;
using post::ComparedProgram;
using post::DifferenceKind;
using programs::ProgramForm;

programs::ConeFrustum coarse_cone(ProgramForm form) {
  programs::ConeFrustum cone;
  cone.form = form;
  cone.chord_tolerance = Mm{5e-4};
  return cone;
}

ComparedProgram cone_program(const std::string& machine, ProgramForm form) {
  const ConeTrial trial = ConeTrial::on(machine, coarse_cone(form));
  const auto program = parser::parse_program(trial.piece.program, "cone.nc", trial.piece.dialect);
  return {"cone.nc", *parser::motions_of(*program), setup_of(trial.piece)};
}

kinematics::Machine shipped(const std::string& name) {
  return ConeTrial::on(name, coarse_cone(ProgramForm::vector)).machine;
}

template <typename Command>
void each(ComparedProgram& program, const std::function<void(Command&)>& change) {
  for (Motion& motion : program.motions) {
    if (auto* command = std::get_if<Command>(&motion.command)) change(*command);
  }
}

void each_target(ComparedProgram& program, const std::function<void(parser::AxisTarget&)>& change) {
  each<parser::LinearFeed>(program, [&](parser::LinearFeed& move) { change(move.end); });
  each<parser::Traverse>(program, [&](parser::Traverse& move) {
    if (move.coordinates == parser::Coordinates::program) change(move.end);
  });
}

class SameConeInThreeForms : public ::testing::TestWithParam<const char*> {};

TEST_P(SameConeInThreeForms, Agrees) {
  const auto machine = shipped(GetParam());
  const auto vectors = cone_program(GetParam(), ProgramForm::vector);
  for (const ProgramForm form : {ProgramForm::angles, ProgramForm::axes}) {
    const auto found = compare_programs(machine, vectors, cone_program(GetParam(), form));
    ASSERT_TRUE(found) << to_string(found.error().front());
    // The cone's axis positions carry the feed of the linear axes, which is not that of the tip.
    const bool feed_only = form == ProgramForm::axes && found->first.kind == DifferenceKind::feed;
    EXPECT_TRUE(found->same() || feed_only)
        << found->first.likely_cause << " at line " << found->first.first_line << ", tip "
        << found->first.tip;
    EXPECT_LT(found->largest_tip, 5e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, SameConeInThreeForms,
                         ::testing::Values("iwf-bc", "double-pivot-head", "swivel-head-table"));

class SameConeInFourDialects : public ::testing::TestWithParam<parser::Dialect> {};

TEST_P(SameConeInFourDialects, Agrees) {
  const ConeTrial trial = ConeTrial::on("iwf-bc", coarse_cone(ProgramForm::angles));
  const auto written =
      programs::cone_frustum(coarse_cone(ProgramForm::angles), trial.machine, GetParam());
  ASSERT_TRUE(written) << to_string(written.error().front());
  const auto program = parser::parse_program(written->program, "cone", GetParam());
  ASSERT_TRUE(program) << to_string(program.error().front());
  const auto motions = parser::motions_of(*program);
  ASSERT_TRUE(motions) << to_string(motions.error().front());
  const ComparedProgram second{"cone", *motions, setup_of(*written)};
  const auto found =
      compare_programs(trial.machine, cone_program("iwf-bc", ProgramForm::vector), second);
  ASSERT_TRUE(found) << to_string(found.error().front());
  EXPECT_TRUE(found->same()) << found->first.likely_cause << " at line " << found->first.first_line
                             << ", tip " << found->first.tip;
}

INSTANTIATE_TEST_SUITE_P(Dialects, SameConeInFourDialects,
                         ::testing::Values(parser::Dialect::fanuc, parser::Dialect::linuxcnc,
                                           parser::Dialect::sinumerik,
                                           parser::Dialect::heidenhain));

struct SeededFault {
  const char* name;
  const char* machine;
  ProgramForm form;
  std::function<void(ComparedProgram&)> seed;
  const char* cause;  // part of the words
};

void PrintTo(const SeededFault& fault, std::ostream* out) { *out << fault.name; }

class SeededFaults : public ::testing::TestWithParam<SeededFault> {};

TEST_P(SeededFaults, AreFoundAndNamed) {
  const SeededFault& fault = GetParam();
  const auto machine = shipped(fault.machine);
  const auto good = cone_program(fault.machine, ProgramForm::vector);
  ComparedProgram bad = cone_program(fault.machine, fault.form);
  fault.seed(bad);
  const auto found = compare_programs(machine, good, bad);
  ASSERT_TRUE(found) << to_string(found.error().front());
  EXPECT_FALSE(found->same());
  EXPECT_GT(found->first.first_line, 0U);
  EXPECT_NE(found->first.likely_cause.find(fault.cause), std::string::npos)
      << "named: '" << found->first.likely_cause << "', tip " << found->first.tip << ", axis "
      << found->first.axis;
}

// Axis positions as a post-processor writes them that believes the tool to be longer.
void posted_for_longer_tool(ComparedProgram& program) {
  const auto machine = shipped("double-pivot-head");
  each_target(program, [&](parser::AxisTarget& end) {
    if (!end[AxisLetter::B] || !end[AxisLetter::Z]) return;
    const double b = *end[AxisLetter::B], c = end[AxisLetter::C].value_or(0.0);
    const Vec3 axis(std::cos(c) * std::sin(b), std::sin(c) * std::sin(b), std::cos(b));
    const Vec3 more = 3.0 * (axis - Vec3::UnitZ());
    for (const AxisLetter letter : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
      if (end[letter]) *end[letter] += more[static_cast<int>(letter)];
    }
  });
}

// Axis positions for a B axis believed 0.4 mm lower, the C/B table of iwf-bc.
void posted_for_lower_axis(ComparedProgram& program) {
  each_target(program, [&](parser::AxisTarget& end) {
    if (!end[AxisLetter::B] || !end[AxisLetter::X] || !end[AxisLetter::Z]) return;
    const double b = *end[AxisLetter::B];
    *end[AxisLetter::X] -= 0.4 * std::sin(b);
    *end[AxisLetter::Z] += 0.4 * (std::cos(b) - 1.0);
  });
}

// The feed move that the path misses most when it is left out.
std::vector<Motion>::iterator corner_of(ComparedProgram& program) {
  const auto end_of = [](const Motion& motion) -> std::optional<Vec3> {
    const auto* move = std::get_if<parser::LinearFeed>(&motion.command);
    if (move == nullptr || !move->end[AxisLetter::X] || !move->end[AxisLetter::Z]) return {};
    return Vec3(*move->end[AxisLetter::X], move->end[AxisLetter::Y].value_or(0.0),
                *move->end[AxisLetter::Z]);
  };
  auto best = program.motions.end();
  double most = 0.0;
  for (auto m = program.motions.begin() + 1; m + 1 != program.motions.end(); ++m) {
    const auto a = end_of(*(m - 1)), b = end_of(*m), c = end_of(*(m + 1));
    if (!a || !b || !c || (*c - *a).norm() == 0.0) continue;
    const double off = (*b - *a).cross(*c - *a).norm() / (*c - *a).norm();
    if (off > most) {
      most = off;
      best = m;
    }
  }
  return best;
}

INSTANTIATE_TEST_SUITE_P(
    Programs, SeededFaults,
    ::testing::Values(
        SeededFault{"rotary_sign", "iwf-bc", ProgramForm::angles,
                    [](ComparedProgram& p) {
                      each_target(p, [](parser::AxisTarget& end) {
                        if (end[AxisLetter::C]) *end[AxisLetter::C] *= -1.0;
                      });
                    },
                    "rotary axis C has the opposite sign"},
        SeededFault{"tilt_sign", "swivel-head-table", ProgramForm::angles,
                    [](ComparedProgram& p) {
                      each_target(p, [](parser::AxisTarget& end) {
                        if (end[AxisLetter::B]) *end[AxisLetter::B] *= -1.0;
                      });
                    },
                    "rotary axis B has the opposite sign"},
        SeededFault{"inch", "iwf-bc", ProgramForm::angles,
                    [](ComparedProgram& p) {
                      each_target(p, [](parser::AxisTarget& end) {
                        for (const AxisLetter l : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
                          if (end[l]) *end[l] /= 25.4;
                        }
                      });
                    },
                    "inches"},
        SeededFault{"spindle_off", "iwf-bc", ProgramForm::angles,
                    [](ComparedProgram& p) {
                      each<parser::SpindleChange>(p, [](parser::SpindleChange& spindle) {
                        spindle.direction = parser::SpindleDirection::off;
                      });
                    },
                    "the spindle turns in one of the programs only"},
        SeededFault{"missing_tcp", "iwf-bc", ProgramForm::angles,
                    [](ComparedProgram& p) {
                      each<parser::CompensationChange>(p, [](parser::CompensationChange& c) {
                        if (c.mode == parser::LengthCompensation::tool_centre_point)
                          c.mode = parser::LengthCompensation::length;
                      });
                    },
                    "tool-centre-point control is missing"},
        SeededFault{"pivot_length", "double-pivot-head", ProgramForm::axes, posted_for_longer_tool,
                    "another pivot or tool length, different by 3.000"},
        SeededFault{"axis_place", "iwf-bc", ProgramForm::axes, posted_for_lower_axis,
                    "rotary axis B that is located elsewhere"},
        SeededFault{"work_offset", "iwf-bc", ProgramForm::vector,
                    [](ComparedProgram& p) {
                      for (auto& [number, offset] : p.setup.work_offsets)
                        offset += Vec3(0.3, -0.2, 0.1);
                    },
                    "displaced by (0.3000, -0.2000, 0.1000)"},
        SeededFault{"wrong_tool_length", "swivel-head-table", ProgramForm::vector,
                    [](ComparedProgram& p) {
                      for (auto& [number, tool] : p.setup.tools) tool.length_error += 1.25;
                    },
                    "tool length compensated differs by -1.25"},
        SeededFault{"rotary_zero", "swivel-head-table", ProgramForm::angles,
                    [](ComparedProgram& p) {
                      each_target(p, [](parser::AxisTarget& end) {
                        if (end[AxisLetter::C]) *end[AxisLetter::C] += 0.5 * kRadPerDeg;
                      });
                    },
                    "rotary axis C is off by 0.5000 deg"},
        SeededFault{"feed_per_second", "iwf-bc", ProgramForm::angles,
                    [](ComparedProgram& p) {
                      each<parser::LinearFeed>(
                          p, [](parser::LinearFeed& move) { move.feed.value /= 60.0; });
                    },
                    "per second"},
        SeededFault{"missing_block", "iwf-bc", ProgramForm::vector,
                    [](ComparedProgram& p) { p.motions.erase(corner_of(p)); },
                    "is missing in the second"},
        SeededFault{"wrong_word", "iwf-bc", ProgramForm::angles,
                    [](ComparedProgram& p) {
                      auto& motion = p.motions[p.motions.size() / 3];
                      *std::get<parser::LinearFeed>(motion.command).end[AxisLetter::Y] += 0.5;
                    },
                    "only this block differs"},
        SeededFault{"vector_sign", "iwf-bc", ProgramForm::vector,
                    [](ComparedProgram& p) {
                      each<parser::LinearFeed>(p, [](parser::LinearFeed& m) {
                        if (!m.tool_axis) return;
                        const Vec3 v = m.tool_axis->vec();
                        m.tool_axis = UnitVec3::of(Vec3(v.x(), -v.y(), v.z()));
                      });
                      each<parser::Traverse>(p, [](parser::Traverse& m) {
                        if (!m.tool_axis) return;
                        const Vec3 v = m.tool_axis->vec();
                        m.tool_axis = UnitVec3::of(Vec3(v.x(), -v.y(), v.z()));
                      });
                    },
                    "component J is reversed"}),
    [](const auto& seeded) { return std::string(seeded.param.name); });

}  // namespace
}  // namespace frustum::trials
