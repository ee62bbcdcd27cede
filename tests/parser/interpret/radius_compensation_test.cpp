// The path of the tool's centre: its laws beside random contours, and the rules of the controls.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "parser/interpret/filters/radius_compensation.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

constexpr double kNear = 1e-9;  // mm

PathPiece piece_of(const Vec2& from, const Command& command) {
  if (const auto* line = std::get_if<LinearFeed>(&command)) {
    return {from, {*line->end[AxisLetter::X], *line->end[AxisLetter::Y]}};
  }
  const auto& arc = std::get<ArcFeed>(command);
  return {from,
          {*arc.end[AxisLetter::X], *arc.end[AxisLetter::Y]},
          {arc.center.x(), arc.center.y()},
          arc.turns};
}

// A part of the way, from 0 to 1.
Vec2 place_on(const PathPiece& piece, double part) {
  if (!piece.is_arc()) return piece.start + part * (piece.end - piece.start);
  const double angle = (piece.turns > 0 ? 1.0 : -1.0) * part * sweep_of(piece);
  const Vec2 arm = piece.start - piece.centre;
  return piece.centre + std::cos(angle) * arm + std::sin(angle) * left_of(arm);
}

double distance_to(const PathPiece& piece, const Vec2& point) {
  const double ends = std::min((point - piece.start).norm(), (point - piece.end).norm());
  if (!piece.is_arc()) {
    const Vec2 along = direction_at_start(piece);
    const double way = along.dot(point - piece.start);
    if (way < 0.0 || way > length_of(piece)) return ends;
    return std::abs(left_of(along).dot(point - piece.start));
  }
  PathPiece to_point = piece;
  to_point.turns = piece.turns > 0 ? 1 : -1;
  to_point.end = piece.centre + (point - piece.centre).normalized() * radius_of(piece);
  if (sweep_of(to_point) > sweep_of(piece)) return ends;
  return std::abs((point - piece.centre).norm() - radius_of(piece));
}

Command move_along(const PathPiece& piece) {
  AxisTarget end;
  end[AxisLetter::X] = piece.end.x();
  end[AxisLetter::Y] = piece.end.y();
  if (!piece.is_arc()) return LinearFeed{end, std::nullopt, Coordinates::program, {100.0}};
  return ArcFeed{end,    Vec3(piece.centre.x(), piece.centre.y(), 0.0), Plane::xy, piece.turns, {},
                 {100.0}};
}

struct Contour {
  std::vector<PathPiece> pieces{};
  RadiusSetting setting{};
};

// An entry and what follows at random: lines and arcs, corners of both kinds, none, and right back.
Contour random_contour(EntryRule entry) {
  Contour contour;
  contour.setting.radius = *rc::gen::inRange(1, 9);
  contour.setting.side = *rc::gen::element(ToolSide::left, ToolSide::right);
  contour.setting.rules.entry = entry;
  double heading = *rc::gen::inRange(0, 360) * std::numbers::pi / 180.0;
  Vec2 at = Vec2::Zero();
  const auto along = [&] { return Vec2(std::cos(heading), std::sin(heading)); };
  const int count = *rc::gen::inRange(3, 12);
  for (int i = 0; i < count; ++i) {
    PathPiece piece{at, at};
    if (i == 0 || *rc::gen::inRange(0, 2) == 0) {
      piece.end = at + *rc::gen::inRange(15, 80) * along();
    } else {
      const double radius = *rc::gen::inRange(4, 40);
      const double sense = *rc::gen::element(-1.0, 1.0);
      const double sweep = *rc::gen::inRange(20, 360) * std::numbers::pi / 180.0;
      piece.centre = at + sense * radius * left_of(along());
      piece.turns = sense > 0.0 ? 1 : -1;
      heading += sense * sweep;
      piece.end = piece.centre - sense * radius * left_of(along());
    }
    at = piece.end;
    contour.pieces.push_back(piece);
    const bool corner = *rc::gen::inRange(0, 3) > 0;
    if (corner) heading += *rc::gen::inRange(-150, 151) * std::numbers::pi / 180.0;
  }
  return contour;
}

struct Path {
  std::vector<Motion> motions{};
  bool fits = true;
};

Path path_of(const Contour& contour) {
  Path path;
  const RadiusCompensation::Sink sink = [&](Motion&& motion) {
    path.motions.push_back(std::move(motion));
  };
  RadiusCompensation stage;
  AxisTarget start;
  start[AxisLetter::X] = 0.0;
  start[AxisLetter::Y] = 0.0;
  stage.start(contour.setting, start);
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    Motion motion{{static_cast<std::uint32_t>(i), 1}, move_along(contour.pieces[i])};
    if (stage.take(std::move(motion), sink)) {
      path.fits = false;
      return path;
    }
  }
  stage.stop(sink);
  return path;
}

bool goes_round_corner(const PathPiece& piece, const PathPiece& programmed) {
  return piece.is_arc() && (piece.centre - programmed.start).norm() < kNear;
}

// The radius away from the move that it belongs to, or from the corner before that; where two paths
// meet, from both moves; all without a gap.
void check(const Contour& contour, const Path& path) {
  const double radius = contour.setting.radius;
  Vec2 at = Vec2::Zero();
  for (std::size_t i = 0; i < path.motions.size(); ++i) {
    const std::size_t of = path.motions[i].place.line;
    const PathPiece& programmed = contour.pieces[of];
    const PathPiece piece = piece_of(at, path.motions[i].command);
    if (piece.is_arc()) {
      RC_ASSERT(std::abs((piece.end - piece.centre).norm() - radius_of(piece)) < kNear);
    }
    if (goes_round_corner(piece, programmed)) {
      RC_ASSERT(std::abs(radius_of(piece) - radius) < kNear);
    } else if (of > 0) {
      for (const double part : {0.0, 0.1, 0.35, 0.5, 0.8, 1.0}) {
        RC_ASSERT(std::abs(distance_to(programmed, place_on(piece, part)) - radius) < kNear);
      }
    }
    at = piece.end;
    if (of == 0 || i + 1 == path.motions.size() || path.motions[i + 1].place.line == of) continue;
    const PathPiece& next = contour.pieces[of + 1];
    if (goes_round_corner(piece_of(at, path.motions[i + 1].command), next)) continue;
    RC_ASSERT(std::abs(distance_to(next, at) - radius) < kNear);
  }
}

RC_GTEST_PROP(RadiusCompensationLaws, ThePathIsTheRadiusAwayFromTheContour, ()) {
  const Contour contour =
      random_contour(*rc::gen::element(EntryRule::beside_its_end, EntryRule::beside_contour));
  const Path path = path_of(contour);
  RC_CLASSIFY(path.fits, "fits");
  check(contour, path);
}

// Its own side: never across the contour, also where both sides are as far.
RC_GTEST_PROP(RadiusCompensationLaws, ThePathIsOnTheToolsSide, ()) {
  const Contour contour = random_contour(EntryRule::beside_contour);
  const Path path = path_of(contour);
  const double side = contour.setting.side == ToolSide::left ? 1.0 : -1.0;
  Vec2 at = Vec2::Zero();
  for (const Motion& motion : path.motions) {
    const PathPiece& programmed = contour.pieces[motion.place.line];
    const PathPiece piece = piece_of(at, motion.command);
    if (motion.place.line > 0 && !goes_round_corner(piece, programmed)) {
      const Vec2 point = place_on(piece, 0.5);
      const double aside =
          programmed.is_arc()
              ? (programmed.turns > 0 ? 1.0 : -1.0) *
                    (radius_of(programmed) - (point - programmed.centre).norm())
              : left_of(direction_at_start(programmed)).dot(point - programmed.start);
      RC_ASSERT(side * aside > 0.0);
    }
    at = piece.end;
  }
}

InterpreterOptions with_tools() {
  InterpreterOptions options;
  options.tools[1].diameter = 12.0;
  options.tools[2].diameter = 8.0;
  return options;
}

std::string plain(double value) {
  std::string text = fmt::format("{:.3f}", value + 0.0);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

// "L 10 6 -2 | A- 16 0 -2": the moves and arcs of a program with their X Y Z.
std::string moves(Dialect dialect, std::string_view text) {
  std::string list;
  for (const Motion& motion : motions(text, with_tools(), dialect)) {
    const AxisTarget* end = nullptr;
    std::string kind;
    if (const auto* traverse = std::get_if<Traverse>(&motion.command)) {
      end = &traverse->end;
      kind = "R";
    } else if (const auto* feed = std::get_if<LinearFeed>(&motion.command)) {
      end = &feed->end;
      kind = "L";
    } else if (const auto* arc = std::get_if<ArcFeed>(&motion.command)) {
      end = &arc->end;
      kind = arc->turns > 0 ? "A+" : "A-";
    }
    if (end == nullptr) continue;
    if (!list.empty()) list += " | ";
    list += kind;
    for (const AxisLetter axis : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) {
      list += (*end)[axis] ? " " + plain(*(*end)[axis]) : " -";
    }
  }
  return list;
}

TEST(RadiusCompensation, OfFanucEntersAbeamOfTheContour) {
  EXPECT_EQ(
      moves(Dialect::fanuc, "G0 X-30 Y-30 Z0\nG41 D1 G1 X0 Y0 F100\nY40\nX50\nY0\nG40 X80\nM30\n"),
      "R -30 -30 0 | L -6 0 0 | L -6 40 0 | A- 0 46 0 | L 50 46 0 | A- 56 40 0 | L 56 0 0 | "
      "L 80 0 0");
}

TEST(RadiusCompensation, OfFanucKeepsD) {
  EXPECT_EQ(
      moves(Dialect::fanuc,
            "G0 X-30 Y0 Z0\nG42 D2 G1 X0 F100\nY-40\nG40 X-30\nG41 X0\nG41\nY-80\nG40 X9\nM30\n"),
      "R -30 0 0 | L -4 0 0 | L -4 -40 0 | L -30 -40 0 | L 4 -40 0 | L 4 -80 0 | L 9 -80 0");
}

TEST(RadiusCompensation, StaysBesideTheContourBehindG40UntilAMoveInThePlane) {
  EXPECT_EQ(
      moves(Dialect::fanuc, "G0 X-30 Y0 Z0\nG42 D1 G1 X0 Z-5 F100\nY-40\nG40\nG0 Z50\nX-30\nM30\n"),
      "R -30 0 0 | L -6 0 -5 | L -6 -40 -5 | R -6 -40 50 | R -30 -40 50");
  EXPECT_EQ(moves(Dialect::linuxcnc,
                  "G0 X-30 Y0 Z0\nG42.1 D12 G1 X0 Z-5 F100\nY-40\nG40\nG0 Z50\nX-30\nM30\n"),
            "R -30 0 0 | L -6 -6 -5 | L -6 -40 -5 | R 0 -40 50 | R -30 -40 50");
}

TEST(RadiusCompensation, OfSinumerikTakesTheToolInTheSpindle) {
  EXPECT_EQ(
      moves(Dialect::sinumerik,
            "T2 D1 M6\nNORM G450\nG0 X=-30 Y=-30 Z0\nG1 G41 X0 Y0 F100\nY40\nG2 X20 Y60 CR=20\n"
            "G40 G1 X=20 Y90\nM30\n"),
      "R -30 -30 0 | L -4 0 0 | L -4 40 0 | A- 20 64 0 | L 20 90 0");
}

TEST(RadiusCompensation, OfKlartextIsInItsPathStatements) {
  EXPECT_EQ(moves(Dialect::heidenhain,
                  "TOOL CALL 1 Z S1000\nL X-30 Y-30 Z+0 R0 FMAX\nL X+0 Y+0 RL F100\nL Y+40 RL\n"
                  "CC X+20 Y+40\nC X+40 Y+40 DR- RL\nL X+40 Y+0\nL Z+50 R0 FMAX\nL X+90 FMAX\n"),
            "R -30 -30 0 | L -6 0 0 | L -6 40 0 | A- 46 40 0 | L 46 0 0 | R 46 0 50 | R 90 0 50");
}

TEST(RadiusCompensation, FeedsStayAndTheTimeOfABlockIsShared) {
  const auto blocks =
      motions("G0 X-30 Y0 Z0\nG41.1 D20\nG93\nG1 X0 F2\nY-40 F3\nG40\nG94\nG0 X50\nM2\n", {},
              Dialect::linuxcnc);
  const auto lines = all_of<LinearFeed>(blocks);
  const auto arcs = all_of<ArcFeed>(blocks);
  ASSERT_EQ(lines.size(), 2U);
  ASSERT_EQ(arcs.size(), 1U);
  EXPECT_EQ(lines[0].feed.value, 2.0);
  EXPECT_NEAR(1.0 / lines[1].feed.value + 1.0 / arcs[0].feed.value, 1.0 / 3.0, 1e-12);
  const double arc_length = std::numbers::pi * 5.0;
  EXPECT_NEAR(arcs[0].feed.value * arc_length, lines[1].feed.value * 40.0, 1e-9);
  EXPECT_EQ(all_of<LinearFeed>(motions(
                                   "G41.1 D2 G1 X9 Y0 F70\nX20\nM2\n",
                                   [] {
                                     InterpreterOptions options;
                                     for (const AxisLetter a : kAxisLetters) options.start[a] = 0;
                                     return options;
                                   }(),
                                   Dialect::linuxcnc))
                .at(1)
                .feed.value,
            70.0);
}

TEST(RadiusCompensation, TellsWhenItGoesOnAndOff) {
  const auto all = motions("G0 X-30 Y0 Z0\nG42 D1 G1 X0 F100\nY-40\nG40 X-30\nM30\n", with_tools());
  std::vector<std::string> texts;
  for (const Event& event : all_of<Event>(all)) {
    if (event.name == "radius_compensation") texts.push_back(event.text);
  }
  EXPECT_EQ(texts, (std::vector<std::string>{"right of the contour, radius 6 mm", "off"}));
}

// Between two arcs that touch from within, rs274 turns about the point; the tool does not fit
// there, and stops where it touches both: 22 mm from one centre, 58 mm from the other.
TEST(RadiusCompensation, StopsWhereAnArcGoesBackWithinAnother) {
  const auto all = motions(
      "G0 X0 Y-60 Z0\nG42.1 D4\nG1 X20 Y0 F100\nG3 X0 Y20 I-20\nG2 X60 Y-40 J-60\nG40 G1 X60 "
      "Y-80\nM2\n",
      {}, Dialect::linuxcnc);
  const AxisTarget end = all_of<ArcFeed>(all).at(1).end;
  EXPECT_NEAR(std::hypot(*end[AxisLetter::X], *end[AxisLetter::Y]), 22.0, 1e-9);
  EXPECT_NEAR(std::hypot(*end[AxisLetter::X], *end[AxisLetter::Y] + 40.0), 58.0, 1e-9);
}

}  // namespace
}  // namespace frustum::parser
