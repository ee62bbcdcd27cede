#include "tests/calibration/independent_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/path/path_comparison.hpp"
#include "kinematics/path/travel.hpp"
#include "tests/calibration/frechet_distance.hpp"
#include "trials/trial.hpp"

namespace frustum::calibration {
namespace {

using kinematics::GeometricErrors;
using kinematics::Machine;
using kinematics::ToolPath;

ToolPath path_of(const Machine& machine, const programs::TestPiece& piece,
                 const GeometricErrors& errors) {
  const auto commanded = trials::command_piece(machine, piece);
  EXPECT_TRUE(commanded) << (commanded ? "" : to_string(commanded.error().front()));
  if (!commanded) return {};
  return kinematics::travel(machine, trials::setup_of(piece), commanded->program, errors).path;
}

// Its feed moves, with a pose at least every `step` mm.
ToolPath divided(const ToolPath& path, double step) {
  ToolPath fine;
  fine.blocks = path.blocks;
  for (const kinematics::PathSegment& segment : path.segments) {
    if (path.blocks[segment.block].kind != kinematics::PathKind::feed) continue;
    const auto &from = path.from(segment), &to = path.to(segment);
    const int parts = 1 + static_cast<int>((to.tip - from.tip).norm() / step);
    fine.poses.push_back(from);
    for (int k = 1; k <= parts; ++k) {
      fine.segments.push_back({static_cast<std::uint32_t>(fine.poses.size() - 1), segment.block});
      fine.poses.push_back(kinematics::between(from, to, static_cast<double>(k) / parts));
    }
  }
  return fine;
}

PathError farthest(const kinematics::PathMatches& found) {
  PathError error;
  for (const kinematics::PathMatch& match : found.matches) {
    error.tip = std::max(error.tip, match.tip_distance());
    error.axis = std::max(error.axis, match.axis_angle());
  }
  return error;
}

// Feed moves between two interruptions.
struct FeedLine {
  std::vector<Vec3> tips{}, axes{};

  void add(const kinematics::ToolPose& pose) {
    tips.push_back(pose.tip);
    axes.push_back(pose.axis);
  }
};

std::vector<FeedLine> feed_lines(const ToolPath& path) {
  constexpr double kTurnStep = 1e-3;  // rad: chords are 0.125 urad within great circles
  std::vector<FeedLine> lines;
  bool feeds = false;
  for (const kinematics::PathSegment& segment : path.segments) {
    const bool fed =
        std::exchange(feeds, path.blocks[segment.block].kind == kinematics::PathKind::feed);
    if (!feeds) continue;
    const auto &from = path.from(segment), &to = path.to(segment);
    if (!fed) lines.emplace_back().add(from);
    const int parts = 1 + static_cast<int>(angle_between(from.axis, to.axis) / kTurnStep);
    for (int k = 1; k <= parts; ++k) {
      lines.back().add(kinematics::between(from, to, static_cast<double>(k) / parts));
    }
  }
  return lines;
}

PathError walked_together(const ToolPath& wanted, const ToolPath& actual) {
  const auto of_wanted = feed_lines(wanted), of_actual = feed_lines(actual);
  EXPECT_EQ(of_wanted.size(), of_actual.size());
  PathError error;
  for (std::size_t k = 0; k < std::min(of_wanted.size(), of_actual.size()); ++k) {
    error.tip = std::max(error.tip, frechet_distance(of_actual[k].tips, of_wanted[k].tips));
    error.axis = std::max(error.axis, frechet_distance(of_actual[k].axes, of_wanted[k].axes));
  }
  return error;
}

}  // namespace

GeometricErrors errors_from(const Machine& machine, const std::vector<std::string>& texts) {
  std::vector<kinematics::ErrorEntry> entries;
  for (const std::string& text : texts) {
    const auto entry = kinematics::parse_error(text);
    EXPECT_TRUE(entry) << text;
    if (entry) entries.push_back(*entry);
  }
  const auto errors = kinematics::resolve(machine, entries);
  EXPECT_TRUE(errors) << (errors ? "" : to_string(errors.error().front()));
  return errors ? *errors : GeometricErrors{};
}

programs::TestPiece cone_piece(const Machine& machine, programs::ProgramForm form, double chord) {
  programs::ConeFrustum cone;
  cone.form = form;
  cone.chord_tolerance = Mm{chord};
  const auto piece = programs::cone_frustum(cone, machine);
  EXPECT_TRUE(piece) << (piece ? "" : to_string(piece.error().front()));
  return piece ? *piece : programs::TestPiece{};
}

double allowed_residual(const PathError& before) { return std::max(5e-5, 0.01 * before.tip); }

IndependentRun run_independently(const Machine& machine, const GeometricErrors& errors,
                                 const programs::TestPiece& nominal,
                                 const programs::TestPiece& written) {
  const ToolPath wanted = path_of(machine, nominal, {}), actual = path_of(machine, written, errors);
  return {.nominal = farthest(kinematics::match_paths(divided(wanted, 0.1), actual)),
          .walked = walked_together(wanted, actual)};
}

}  // namespace frustum::calibration
