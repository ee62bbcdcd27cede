// Populations against whole trials: the program is cut again by every machine drawn.
#include "trials/population/population.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include "kinematics/errors/error_draw.hpp"
#include "kinematics/errors/error_table.hpp"
#include "metrology/plan/strategy.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "tests/law_count.hpp"

namespace frustum::trials {
namespace {

using kinematics::ErrorEntry;

// The cone in 250 blocks a turn or in finer chords (mm), measured at points of three sections, or
// with its datum system.
struct ConePopulation {
  kinematics::Machine machine;
  programs::TestPiece piece{};
  CommandedPiece commanded{};
  std::vector<ErrorEntry> entries{};
  PopulationLaws laws{};

  static ConePopulation of(int points, bool with_datums, const std::string& errors = {},
                           double chord = 3e-3) {
    auto machine =
        *kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
    programs::ConeFrustum cone;
    cone.chord_tolerance = {chord};
    auto piece = *programs::cone_frustum(cone, machine);
    auto& plan = piece.plan;
    std::erase_if(plan.features, [&](const auto& f) {
      const bool is_datum = f.name == "A" || f.name == "C" || f.name == "groove";
      return f.name != "cone" && !(with_datums && is_datum);
    });
    for (auto& feature : plan.features) {
      if (feature.name != "cone") continue;
      std::get<metrology::SectionStrategy>(feature.strategy).points_per_section = points;
    }
    std::erase_if(plan.characteristics, [](const auto& c) {
      return c.name != "cone.equivalent_form" && c.name != "cone.form" &&
             c.name != "cone.half_angle";
    });
    if (!with_datums) plan.datum.reset();
    auto commanded = *command_piece(machine, piece);
    std::vector<ErrorEntry> entries;
    if (errors.empty()) {
      entries = kinematics::load_error_file(std::string(FRUSTUM_SOURCE_DIR) +
                                            "/machines/errors/bossoni-cone-limits.toml")
                    ->entries;
    } else {
      entries.push_back(*kinematics::parse_error(errors));
    }
    auto laws = *PopulationLaws::of(machine, entries, piece, commanded);
    return {machine, piece, commanded, entries, laws};
  }

  [[nodiscard]] Weights draw(std::uint32_t index, double times = 1.0) const {
    Weights weights = laws.weights(kinematics::draw(entries, 1, index));
    for (double& w : weights) w *= times;
    return weights;
  }
  [[nodiscard]] std::vector<Weights> draws(std::uint32_t count, double times = 1.0) const {
    std::vector<Weights> all;
    for (std::uint32_t d = 0; d < count; ++d) all.push_back(draw(d, times));
    return all;
  }
  [[nodiscard]] Population population() const {
    auto made = Population::make(machine, piece, commanded, laws);
    EXPECT_TRUE(made);
    return *made;
  }
};

// As population.hpp defines travels, from what a whole trial touched.
std::vector<double> travels_of(const ConePopulation& cone, const Trial& trial) {
  std::vector<double> travels;
  const Pose& frame = trial.measurement.workpiece_from_datum;
  const double ball = 0.5 * cone.piece.plan.probe.ball_diameter;
  for (std::size_t f = 0; f < cone.piece.plan.features.size(); ++f) {
    const auto planned = metrology::planned_points(cone.piece.plan.features[f]);
    for (std::size_t i = 0; i < planned.size(); ++i) {
      const metrology::Touch& touch = trial.measurement.features[f].touches[i];
      const Vec3 centre = touch.point + ball * touch.normal;
      travels.push_back(
          (centre - frame.point(planned[i].point)).dot(frame.direction(planned[i].normal)) - ball);
    }
  }
  return travels;
}

void expect_equal_to_whole_trials(const ConePopulation& cone, std::uint32_t count, double times) {
  const Population population = cone.population();
  const auto draws = cone.draws(count, times);
  const auto members = population.evaluate(draws, {.travels = true});
  TrialOptions fine{.path_bound = 1e-6};  // the path's own error stays below a nanometre
  fine.find_collisions = false;
  double worst = 0.0, worst_value = 0.0;
  for (std::size_t d = 0; d < draws.size(); ++d) {
    const auto trial =
        run_trial(cone.machine, cone.laws.errors(draws[d]), cone.piece, cone.commanded, {}, fine);
    ASSERT_TRUE(trial);
    ASSERT_TRUE(members[d].failure.empty());
    const auto travels = travels_of(cone, *trial);
    ASSERT_EQ(travels.size(), members[d].travels.size());
    for (std::size_t i = 0; i < travels.size(); ++i) {
      worst = std::max(worst, std::abs(travels[i] - members[d].travels[i]));
    }
    for (std::size_t c = 0; c < members[d].values.size(); ++c) {
      const double value = metrology::internal_value(trial->measurement.characteristics[c]);
      worst_value = std::max(worst_value, std::abs(value - members[d].values[c]));
    }
  }
  EXPECT_LT(worst, 2e-6);
  EXPECT_LT(worst_value, 4e-6);
  testing::Test::RecordProperty("worst_nm", std::to_string(1e6 * worst));
}

TEST(PopulationLaws, FollowWholeTrialsWithinTwoNanometres) {
  expect_equal_to_whole_trials(ConePopulation::of(proof::law_count(120, 8), false),
                               proof::law_count(200U, 1U), 1.0);
}

TEST(PopulationLaws, FollowWholeTrialsOfErrorsTenTimesLarger) {
  expect_equal_to_whole_trials(ConePopulation::of(proof::law_count(120, 4), false),
                               proof::law_count(20U, 1U), 10.0);
}

// The points at which the lanes are in doubt: the ball rests where facets meet.
TEST(Population, SweepsNearByWhatAWholeTrialMakes) {
  expect_equal_to_whole_trials(ConePopulation::of(40, false), 1, 1.0);
}

std::size_t points_asked_whole(const Population& population, const std::vector<Weights>& draws) {
  std::size_t whole = 0;
  for (const PopulationMember& member : population.evaluate(draws)) whole += member.whole;
  return whole;
}

// Half a degree beside them the cutter comes and goes along straight tangents, which are microns
// off the cone in the middle of segments of 18 mm.
TEST(Population, FollowsPointsBesideThePassesInAndOut) {
  const auto cone = ConePopulation::of(360, false, {}, 1e-4);
  const Population population = cone.population();
  EXPECT_TRUE(population.reasons().empty());
  EXPECT_EQ(points_asked_whole(population, cone.draws(8)), 0U);
  expect_equal_to_whole_trials(cone, proof::law_count(20U, 1U), 1.0);
}

// Plane and cylinder of the datum system are the blank's own, the groove's wall was cut.
TEST(Population, FollowsTheDatumSystemOfTheBlank) {
  const auto cone = ConePopulation::of(12, true, {}, 1e-4);
  const Population population = cone.population();
  EXPECT_TRUE(population.reasons().empty());
  EXPECT_EQ(points_asked_whole(population, cone.draws(20)), 0U);
  expect_equal_to_whole_trials(cone, proof::law_count(20U, 2U), 1.0);
}

TEST(Population, SweepingNearByAsksHardlyAPointOfTheWholeProgram) {
  const auto cone = ConePopulation::of(40, false);
  const Population population = cone.population();
  std::size_t whole = 0, local = 0;
  const auto draws = cone.draws(3);
  for (const PopulationMember& member : population.evaluate(draws)) {
    EXPECT_EQ(member.values.size(), 3);
    whole += member.whole;
    local += member.local;
  }
  const double points = static_cast<double>(draws.size() * population.point_count());
  EXPECT_LT(static_cast<double>(whole), 0.01 * points);
  EXPECT_LT(static_cast<double>(local), 0.1 * points);
}

// Other passes come as near as they may, but not those of one machine.
TEST(Population, ErrorsTenTimesLargerAskHardlyAPointOfTheWholeProgram) {
  const auto cone = ConePopulation::of(120, false, {}, 1e-4);
  const Population population = cone.population();
  const auto draws = cone.draws(8, 10.0);
  const double points = static_cast<double>(draws.size() * population.point_count());
  const auto whole = static_cast<double>(points_asked_whole(population, draws));
  testing::Test::RecordProperty("whole_percent", std::to_string(100.0 * whole / points));
  EXPECT_LT(whole, 0.01 * points);
}

TEST(Population, HasTheSameBitsForAnyThreadsAndNeighbours) {
  const auto cone = ConePopulation::of(6, false);
  const Population population = cone.population();
  const auto draws = cone.draws(19);
  std::vector<PopulationMember> first;
  for (const int threads : {1, 2, 8}) {
    oneapi::tbb::task_arena arena(threads);
    std::vector<PopulationMember> members;
    arena.execute([&] { members = population.evaluate(draws, {.travels = true}); });
    if (first.empty()) first = members;
    for (std::size_t d = 0; d < draws.size(); ++d) {
      EXPECT_EQ(members[d].travels, first[d].travels);
      EXPECT_EQ(members[d].values, first[d].values);
    }
  }
  for (const std::size_t d : {std::size_t{0}, std::size_t{7}, std::size_t{18}}) {
    const std::vector<Weights> alone{draws[d]};
    EXPECT_EQ(population.evaluate(alone, {.travels = true}).front().travels, first[d].travels);
  }
}

TEST(PopulationLawsOfErrors, AreTheErrorsOfADraw) {
  const auto machine =
      *kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
  std::vector<ErrorEntry> entries;
  for (const char* text :
       {"EXX=linear uniform -3um..3um + cyclic uniform -1um..1um period 30mm phase "
        "uniform 0deg..360deg + 2um",
        "EYX=polynomial 1um uniform -2um..2um 3um", "EX0C=normal 3um sd 2um",
        "EBB=harmonic 2 normal 0urad sd 5urad limit 9urad phase 30deg"}) {
    const auto entry = kinematics::parse_error(text);
    ASSERT_TRUE(entry) << text << ": " << to_string(entry.error().front());
    entries.push_back(*entry);
  }
  const auto read = PopulationLaws::of(machine, entries, kinematics::AxisSpans{});
  ASSERT_TRUE(read) << to_string(read.error().front());
  const PopulationLaws& laws = *read;
  EXPECT_EQ(laws.columns().size(), 6);
  for (std::uint32_t d = 0; d < 4; ++d) {
    const auto drawn = kinematics::draw(entries, 9, d);
    const auto expected = *kinematics::resolve(machine, drawn);
    const auto errors = laws.errors(laws.weights(drawn));
    for (const auto letter :
         {kinematics::AxisLetter::X, kinematics::AxisLetter::B, kinematics::AxisLetter::C}) {
      kinematics::AxisState at;
      at.q[letter] = 0.3 + 0.1 * d;
      for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_NEAR(errors[letter].component[k](letter, at),
                    expected[letter].component[k](letter, at), 1e-17);
        EXPECT_NEAR(errors[letter].location[k], expected[letter].location[k], 1e-17);
      }
    }
  }
}

TEST(PopulationLawsOfErrors, RefuseATentThatIsDrawnWhereItStands) {
  const auto machine =
      *kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/iwf-bc.toml");
  const std::vector<ErrorEntry> entries{
      *kinematics::parse_error("EXX=tent 3um at uniform -10mm..10mm")};
  const auto laws = PopulationLaws::of(machine, entries, kinematics::AxisSpans{});
  ASSERT_FALSE(laws);
  EXPECT_EQ(laws.error().front().id, "population-law"_id);
}

}  // namespace
}  // namespace frustum::trials
