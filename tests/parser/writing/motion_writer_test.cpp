// Written and read again, canonical motions stay what they were.
#include "parser/writing/motion_writer.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "core/units.hpp"
#include "parser/arc.hpp"
#include "tests/parser/writing/read_back.hpp"

namespace frustum::parser {
namespace {

// A motion or stop with the state that it finds: what two programs must agree on.
struct Seen {
  Command command{};
  CompensationChange compensation{};
  int offset = 1;
  int tool = 0;
  SpindleChange spindle{};
  bool flood = false;
};

std::vector<Seen> seen_by_a_machine(const std::vector<Motion>& motions) {
  std::vector<Seen> seen;
  Seen now;
  for (const Motion& motion : motions) {
    const Command& command = motion.command;
    if (const auto* c = std::get_if<CompensationChange>(&command)) {
      now.compensation = c->mode == LengthCompensation::off ? CompensationChange{} : *c;
    } else if (const auto* o = std::get_if<WorkOffsetChange>(&command)) {
      now.offset = o->number;
    } else if (const auto* t = std::get_if<ToolChange>(&command)) {
      now.tool = t->tool;
    } else if (const auto* s = std::get_if<SpindleChange>(&command)) {
      now.spindle = *s;
    } else if (const auto* f = std::get_if<CoolantChange>(&command)) {
      now.flood = f->flood;
    } else if (!std::holds_alternative<Event>(command) &&
               !std::holds_alternative<OrientationPathChange>(command) &&
               !std::holds_alternative<RotaryPathChange>(command)) {
      now.command = command;
      seen.push_back(now);
    }
  }
  return seen;
}

// Random programs of a five-axis machine with axes B and C.
class RandomProgram {
 public:
  RandomProgram(std::uint64_t seed, bool vectors, Dialect dialect = Dialect::fanuc)
      : seed_(seed), vectors_(vectors), dialect_(dialect) {}

  std::vector<Motion> make() {
    add(ToolChange{3});
    add(SpindleChange{SpindleDirection::clockwise, 8333.0});
    add(WorkOffsetChange{1 + pick(6)});
    set_compensation();
    place();
    for (int i = 0; i < 60; ++i) step();
    add(Stop{StopKind::program_end});
    return motions_;
  }

 private:
  double random() { return uniform({.seed = seed_}, draw_++); }
  double random(double size) { return size * (2.0 * random() - 1.0); }
  int pick(int choices) { return static_cast<int>(random() * choices); }
  void add(Command command) { motions_.push_back({{++line_, 1}, std::move(command)}); }

  void set_compensation() {
    using enum LengthCompensation;
    compensation_ = {pick(2) == 0 && !vectors_ ? length : tool_centre_point, vectors_, 3};
    add(compensation_);
    at_ = {};
  }
  // Positions are known again.
  void place() {
    at_ = {};
    for (const AxisLetter letter : {AxisLetter::X, AxisLetter::Y, AxisLetter::Z}) move(letter);
    if (!vectors_) {
      move(AxisLetter::B);
      move(AxisLetter::C);
    }
    add(Traverse{at_, axis(), Coordinates::program});
  }
  void move(AxisLetter letter) { at_[letter] = is_rotary(letter) ? random(7.0) : random(300.0); }
  std::optional<UnitVec3> axis() {
    if (!vectors_) return {};
    last_axis_ = UnitVec3::of(Vec3(random(1.0), random(1.0), 0.2 + random()));
    return last_axis_;
  }
  Feed feed() {
    if (pick(2) == 0) feed_ = {std::pow(10.0, random(3.0)), static_cast<FeedMode>(pick(2))};
    return feed_;
  }

  void step() {
    switch (pick(12)) {
      case 0:
        add(CoolantChange{pick(2) == 0});
        break;
      case 1:
        add(SpindleChange{static_cast<SpindleDirection>(1 + pick(2)), 1000.0 * (1 + pick(9))});
        break;
      case 2: {
        AxisTarget up;
        up[AxisLetter::Z] = random(400.0);
        add(Traverse{up, std::nullopt, Coordinates::machine});
        place();
        break;
      }
      case 3:
        add(WorkOffsetChange{1 + pick(6)});
        place();
        break;
      case 4:
        set_compensation();
        place();
        break;
      case 5:
        add(Dwell{random() * 10.0});
        break;
      case 6:
      case 7:
        arc();
        break;
      case 8:
        add(Event{"comment", "ABOUT TO TURN"});
        break;
      default:
        some_axes();
        if (pick(3) == 0) {
          add(Traverse{at_, axis(), Coordinates::program});
        } else {
          add(LinearFeed{at_, axis(), Coordinates::program, feed()});
        }
    }
  }
  void some_axes() {
    for (const AxisLetter letter :
         {AxisLetter::X, AxisLetter::Y, AxisLetter::Z, AxisLetter::B, AxisLetter::C}) {
      if (pick(2) == 0 && !(vectors_ && is_rotary(letter))) move(letter);
    }
  }
  void arc() {
    // Klartext has flat circles in X and Y.
    const bool klartext = dialect_ == Dialect::heidenhain;
    const auto plane = klartext ? Plane::xy : static_cast<Plane>(pick(3));
    const PlaneAxes axes = axes_of(plane);
    const auto u = static_cast<AxisLetter>(axes.u), v = static_cast<AxisLetter>(axes.v);
    const auto w = static_cast<AxisLetter>(axes.w);
    ArcFeed arc;
    arc.plane = plane;
    const double radius = 1.0 + 100.0 * random(), from = random(3.0), to = random(3.0);
    arc.center[axes.u] = *at_[u] - radius * std::cos(from);
    arc.center[axes.v] = *at_[v] - radius * std::sin(from);
    const bool full = pick(4) == 0;
    if (!full) {
      at_[u] = arc.center[axes.u] + radius * std::cos(to);
      at_[v] = arc.center[axes.v] + radius * std::sin(to);
    }
    if (pick(2) == 0 && !klartext) *at_[w] += random(5.0);
    arc.center[axes.w] = 0.0;
    arc.end = at_;
    // Of Fanuc each turn is a block of its own.
    const bool by_turns = klartext || dialect_ == Dialect::fanuc;
    arc.turns = (pick(2) == 0 ? 1 : -1) * (by_turns ? 1 : 1 + pick(3));
    arc.tool_axis = last_axis_;
    arc.feed = feed();
    add(arc);
  }

  std::uint64_t seed_;
  bool vectors_;
  Dialect dialect_;
  std::optional<UnitVec3> last_axis_{};
  std::uint64_t draw_ = 0;
  std::uint32_t line_ = 0;
  AxisTarget at_{};
  CompensationChange compensation_{};
  Feed feed_{500.0, FeedMode::per_minute};
  std::vector<Motion> motions_{};
};

void expect_same_end(const AxisTarget& written, const AxisTarget& read) {
  for (const AxisLetter letter : kAxisLetters) {
    if (!written[letter]) continue;
    ASSERT_TRUE(read[letter]) << to_char(letter);
    const double bound = is_rotary(letter) ? 0.51e-7 * kRadPerDeg : 0.51e-6;
    EXPECT_NEAR(*written[letter], *read[letter], bound) << to_char(letter);
  }
}
void expect_same_axis(const std::optional<UnitVec3>& written, const std::optional<UnitVec3>& read) {
  ASSERT_EQ(written.has_value(), read.has_value());
  if (written) {
    EXPECT_LT(angle_between(*written, *read), 1e-10);
  }
}
void expect_same_feed(const Feed& written, const Feed& read, double bound = 1e-8) {
  EXPECT_EQ(written.mode, read.mode);
  EXPECT_NEAR(read.value / written.value, 1.0, bound);
}

void expect_same(const Traverse& a, const Traverse& b) {
  expect_same_end(a.end, b.end);
  expect_same_axis(a.tool_axis, b.tool_axis);
  EXPECT_EQ(a.coordinates, b.coordinates);
}
void expect_same(const LinearFeed& a, const LinearFeed& b) {
  expect_same_end(a.end, b.end);
  expect_same_axis(a.tool_axis, b.tool_axis);
  EXPECT_EQ(a.coordinates, b.coordinates);
  expect_same_feed(a.feed, b.feed);
}
void expect_same(const ArcFeed& a, const ArcFeed& b) {
  expect_same_end(a.end, b.end);
  expect_same_axis(a.tool_axis, b.tool_axis);
  // F of Fanuc counts along the arc, whose places are rounded to 1e-6 mm: the shortest here is of
  // 0.01 mm.
  expect_same_feed(a.feed, b.feed, 1e-4);
  EXPECT_EQ(a.plane, b.plane);
  EXPECT_EQ(a.turns, b.turns);
  for (const int axis : {axes_of(a.plane).u, axes_of(a.plane).v}) {
    EXPECT_NEAR(a.center[axis], b.center[axis], 1.1e-6);
  }
}
void expect_same(const Dwell& a, const Dwell& b) { EXPECT_NEAR(a.seconds, b.seconds, 1e-3); }
template <typename Command>
void expect_same(const Command& /*a*/, const Command& /*b*/) {}

void expect_same(const Seen& written, const Seen& read) {
  ASSERT_EQ(written.command.index(), read.command.index());
  std::visit(
      [&](const auto& command) {
        expect_same(command, std::get<std::decay_t<decltype(command)>>(read.command));
      },
      written.command);
  EXPECT_EQ(written.offset, read.offset);
  EXPECT_EQ(written.tool, read.tool);
  EXPECT_EQ(written.flood, read.flood);
  EXPECT_EQ(written.spindle.direction, read.spindle.direction);
  if (written.spindle.direction != SpindleDirection::off) {
    EXPECT_EQ(written.spindle.speed, read.spindle.speed);
  }
  const auto* move = std::get_if<Traverse>(&written.command);
  const bool machine = move != nullptr && move->coordinates == Coordinates::machine;
  if (machine) return;
  EXPECT_EQ(written.compensation.mode, read.compensation.mode);
  EXPECT_EQ(written.compensation.offset_number, read.compensation.offset_number);
}

TEST(NcWriterLaws, RandomMotionsReadBackAsTheyWere) {
  for (const Dialect dialect : written_dialects()) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const bool vectors = seed % 3 == 0 && dialect != Dialect::linuxcnc;
      const auto motions = RandomProgram(seed, vectors, dialect).make();
      const auto written = write_nc(motions, dialect);
      ASSERT_TRUE(written) << first_of(written.error());
      const auto before = seen_by_a_machine(motions);
      const auto after = seen_by_a_machine(motions_in(written->text, dialect));
      ASSERT_EQ(before.size(), after.size()) << written->text;
      for (std::size_t i = 0; i < before.size(); ++i) {
        expect_same(before[i], after[i]);
        if (testing::Test::HasFailure()) {
          FAIL() << name_of(dialect) << " seed " << seed << " motion " << i << "\n"
                 << written->text;
        }
      }
    }
  }
}

TEST(NcWriterLaws, NothingIsSaidTwiceAndEveryLineKnowsItsSource) {
  const auto motions = RandomProgram(7, false).make();
  const auto written = write_nc(motions, Dialect::fanuc, {.source_lines = true});
  ASSERT_TRUE(written);
  std::istringstream lines(written->text);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const std::uint32_t source = written->source_lines.at(count);
    const std::string mark = fmt::format("({})", source);
    const bool block = source != 0 && line.front() != '(';
    EXPECT_EQ(block, line.ends_with(mark)) << line;
  }
  EXPECT_EQ(count, written->source_lines.size());
  const LineRange range = lines_from(*written, {10, 20});
  EXPECT_GE(written->source_lines.at(range.first - 1), 10U);
  EXPECT_LE(written->source_lines.at(range.last - 1), 20U);
  EXPECT_EQ(lines_from(*written, {5000, 6000}).first, 0U);
}

std::string fanuc_of(std::vector<Command> commands) {
  std::vector<Motion> motions;
  for (auto& command : commands) motions.push_back({{1, 1}, std::move(command)});
  const auto written = write_nc(motions, Dialect::fanuc);
  return written ? written->text : first_of(written.error());
}

TEST(NcWriter, LeavesOutWordsThatAreInForce) {
  AxisTarget a, b;
  a[AxisLetter::X] = 1.0;
  a[AxisLetter::Y] = -2.5;
  b = a;
  b[AxisLetter::Y] = 1e-9;
  const Feed feed{500.0, FeedMode::per_minute};
  const auto program = Coordinates::program;
  EXPECT_EQ(fanuc_of({Traverse{a, {}, program}, LinearFeed{b, {}, program, feed},
                      LinearFeed{a, {}, program, feed},
                      LinearFeed{b, {}, program, {2.0, FeedMode::inverse_time}},
                      LinearFeed{a, {}, program, {2.0, FeedMode::inverse_time}}}),
            "%\nO1001 (FRUSTUM)\nG21 G90 G17 G40 G49 G80 G94\n"
            "G0 X1. Y-2.5\nG1 Y0. F500\nY-2.5\nY0. G93 F2\nY-2.5 F2\n%\n");
}

TEST(NcWriter, SaysWhatADialectHasNoWordsFor) {
  const std::vector<Motion> vectors{
      {{12, 3}, CompensationChange{LengthCompensation::tool_centre_point, true, 1}}};
  const auto linuxcnc = write_nc(vectors, Dialect::linuxcnc);
  ASSERT_FALSE(linuxcnc);
  EXPECT_EQ(linuxcnc.error().front().message, "LinuxCNC has no words for tool vectors");
  EXPECT_EQ(linuxcnc.error().front().line, 12);
  EXPECT_FALSE(write_nc(vectors, Dialect::cldata));
}

TEST(NcWriter, SubtractsALengthWhereTheControlCan) {
  const CompensationChange negative{
      .mode = LengthCompensation::length, .offset_number = 3, .negative = true};
  EXPECT_NE(fanuc_of({negative}).find("\nG44 H3\n"), std::string::npos);
  for (const Dialect dialect : {Dialect::linuxcnc, Dialect::sinumerik, Dialect::heidenhain}) {
    const auto written =
        write_nc(std::vector<Motion>{{{1, 1}, ToolChange{3}}, {{2, 3}, negative}}, dialect);
    ASSERT_FALSE(written) << name_of(dialect);
    EXPECT_NE(written.error().front().message.find("a tool length that is subtracted (G44)"),
              std::string::npos);
  }
}

// A quarter and two turns more, by 4 mm a turn.
TEST(NcWriter, WritesEachTurnOfAHelixWhereTheDialectHasNoWordForThem) {
  AxisTarget start, end;
  start[AxisLetter::X] = 10.0;
  start[AxisLetter::Y] = 0.0;
  start[AxisLetter::Z] = 0.0;
  end[AxisLetter::X] = 0.0;
  end[AxisLetter::Y] = 10.0;
  end[AxisLetter::Z] = -9.0;
  const auto lines = [&](const Feed& feed, Dialect dialect) {
    const std::vector<Motion> motions{
        {{1, 1}, Traverse{start, std::nullopt, Coordinates::program}},
        {{2, 1}, ArcFeed{end, Vec3::Zero(), Plane::xy, 3, std::nullopt, feed}}};
    const auto written = write_nc(motions, dialect, {});
    std::vector<std::string> arcs;
    if (!written) return arcs;
    std::istringstream text(written->text);
    for (std::string line; std::getline(text, line);) {
      if (line.find("G3") != std::string::npos || line.find("I-10.") != std::string::npos) {
        arcs.push_back(line);
      }
    }
    return arcs;
  };
  using Lines = std::vector<std::string>;
  const Feed feed{100.0, FeedMode::per_minute};
  EXPECT_EQ(lines(feed, Dialect::fanuc),
            (Lines{"G3 X10. Y0. Z-4. I-10. J0. F99.7979715", "G3 X10. Y0. Z-8. I-10. J0.",
                   "G3 X0. Y10. Z-9. I-10. J0."}));
  EXPECT_EQ(lines(feed, Dialect::linuxcnc), Lines{"G3 X0. Y10. Z-9. I-10. J0. P3 F100"});
  // Nine minutes, of which each turn takes four.
  const auto timed = lines({1.0 / 9.0, FeedMode::inverse_time}, Dialect::fanuc);
  ASSERT_EQ(timed.size(), 3U);
  // Speed over radius: a turn in four minutes, a quarter in one.
  EXPECT_NE(timed[1].find("F1.57079633"), std::string::npos) << timed[1];
  EXPECT_NE(timed[2].find("F1.57079633"), std::string::npos) << timed[2];
}

TEST(NcWriter, WritesThreadsWhereTheDialectHasThemAndNoProbing) {
  AxisTarget a, b;
  a[AxisLetter::Z] = -5.0;
  b[AxisLetter::Z] = -9.0;
  const auto program = Coordinates::program;
  const Feed lead{1.5, FeedMode::per_revolution, true};
  const Feed feed{500.0, FeedMode::per_minute};
  const std::vector<Motion> threads{{{1, 1}, LinearFeed{a, {}, program, lead}},
                                    {{2, 1}, LinearFeed{b, {}, program, lead}},
                                    {{3, 1}, LinearFeed{a, {}, program, feed}}};
  const auto written = write_nc(threads, Dialect::linuxcnc);
  ASSERT_TRUE(written) << first_of(written.error());
  EXPECT_NE(written->text.find("G33 Z-5. K1.5\nZ-9. K1.5\nG1 Z-5. F500\n"), std::string::npos)
      << written->text;
  for (const auto& [dialect, words] :
       {std::pair{Dialect::fanuc, "G33 Z-5. F1.5\nZ-9. F1.5\nG1 Z-5. F500\n"},
        std::pair{Dialect::sinumerik, "G33 Z-5 K1.5\nZ-9 K1.5\nG1 Z-5 F500\n"}}) {
    const auto text = write_nc(threads, dialect);
    ASSERT_TRUE(text) << first_of(text.error());
    EXPECT_NE(text->text.find(words), std::string::npos) << text->text;
  }
  const auto refused = write_nc(threads, Dialect::heidenhain);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().message,
            "Heidenhain has no words for a move synchronised with the spindle");
  const std::vector<Motion> probe{{{7, 1}, Probe{a, {}, feed}}};
  const auto probing = write_nc(probe, Dialect::linuxcnc);
  ASSERT_FALSE(probing);
  EXPECT_EQ(probing.error().front().line, 7);
}

// 1.5 mm a turn on a way of 3, 0, 4 mm: 1.2 mm of Z, which is the longest.
TEST(NcWriter, GivesTheLeadOfAThreadAlongItsLongestAxis) {
  AxisTarget start, end;
  start[AxisLetter::X] = 7.0;
  start[AxisLetter::Z] = 5.0;
  end[AxisLetter::X] = 10.0;
  end[AxisLetter::Z] = 1.0;
  const Feed lead{1.5, FeedMode::per_revolution, true};
  const std::vector<Motion> thread{{{1, 1}, Traverse{start, {}, Coordinates::program}},
                                   {{2, 1}, LinearFeed{end, {}, Coordinates::program, lead}}};
  const auto sinumerik = write_nc(thread, Dialect::sinumerik);
  ASSERT_TRUE(sinumerik) << first_of(sinumerik.error());
  EXPECT_NE(sinumerik->text.find("G33 X10 Z1 K1.2\n"), std::string::npos) << sinumerik->text;
  EXPECT_FALSE(write_nc(thread, Dialect::fanuc));
}

// With words of their own, the tap would wait for the spindle twice, and be torn between.
TEST(NcWriter, TapsRigidlyInOneBlock) {
  const std::string taps = "G21 G90\nS500 M3\nG0 X1 Y2 Z3\nG33.1 Z-10 K1.5\nG0 X4\nG0 Z20\nM2\n";
  const auto motions = motions_in(taps, Dialect::linuxcnc);
  const auto written = write_nc(motions, Dialect::linuxcnc);
  ASSERT_TRUE(written) << first_of(written.error());
  EXPECT_NE(written->text.find("\nG0 X1. Y2. Z3.\nG33.1 Z-10. K1.5\n"), std::string::npos)
      << written->text;
  const auto taps_of = [](const std::vector<Motion>& all) {
    return std::ranges::count_if(all, [](const Motion& motion) {
      const auto* cut = std::get_if<LinearFeed>(&motion.command);
      return cut != nullptr && cut->feed.synchronised;
    });
  };
  EXPECT_EQ(taps_of(motions_in(written->text, Dialect::linuxcnc)), 2);
}

// M137 counts when the move of its block is done, and F before.
TEST(NcWriter, SwitchesTheFeedOfKlartextBeforeTheMove) {
  std::vector<Motion> motions;
  for (const Feed& feed : {Feed{100.0, FeedMode::per_minute}, Feed{0.5, FeedMode::per_revolution},
                           Feed{200.0, FeedMode::per_minute}}) {
    AxisTarget end;
    end[AxisLetter::X] = feed.value;
    motions.push_back({{1, 1}, LinearFeed{end, {}, Coordinates::program, feed}});
  }
  const auto written = write_nc(motions, Dialect::heidenhain);
  ASSERT_TRUE(written) << first_of(written.error());
  EXPECT_NE(written->text.find(" L X+100 F100\n2 M136\n3 L X+0.5 F0.5\n4 M137\n5 L X+200 F200\n"),
            std::string::npos)
      << written->text;
  const auto read = motions_in(written->text, Dialect::heidenhain);
  EXPECT_EQ(std::ranges::count_if(read,
                                  [](const Motion& motion) {
                                    return std::holds_alternative<LinearFeed>(motion.command);
                                  }),
            3);
}

TEST(NcWriter, KeepsCommentsReadable) {
  EXPECT_EQ(fanuc_of({Event{"comment", "a (b) \xC3\xA4 c  "}}),
            "%\nO1001 (FRUSTUM)\nG21 G90 G17 G40 G49 G80 G94\n(A [B] ? C)\n%\n");
}

}  // namespace
}  // namespace frustum::parser
