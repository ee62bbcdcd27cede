// The cone job of Table 3.9, NC program to inspection plan, against the independent computation on
// the tip's ring: draw by draw and in distribution.
#include "app/study/study_file.hpp"
#include "app/study/study_model.hpp"
#include "studies/statistics/order_statistics.hpp"
#include "tests/law_count.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::app {
namespace {

// Values of one characteristic to first order.
std::vector<double> linear_values(const StudyFile& study, const StudyModel& model,
                                  std::size_t characteristic, std::uint32_t count) {
  const studies::FactorSet& factors = model.factors();
  const std::size_t columns = factors.columns().size();
  std::vector<double> values(factors.variables().size()), weights(count * columns);
  for (std::uint32_t d = 0; d < count; ++d) {
    factors.draw(study.seed, d, values);
    factors.weights(values, std::span(weights).subspan(d * columns, columns));
  }
  const auto view = model.linear_view(characteristic);
  EXPECT_TRUE(view);
  return view ? view->values(weights) : std::vector<double>(count);
}

class StudyJobReference : public testing::TestWithParam<std::pair<const char*, char>> {};

// The ring is at the tip; the job cuts with a cutter of 12 mm and is probed 0.5 mm up: 0.1 um + 2 %
// of a draw, 1 % of a quantile. Half angles are those of a ring written with the tool of 150 mm.
TEST_P(StudyJobReference, MakesTheConesOfTheRing) {
  const auto& [setup, read] = GetParam();
  const auto study = load_study_file(std::string(FRUSTUM_SOURCE_DIR) + "/examples/bossoni-study/" +
                                         setup + (read == 'A' ? "-a.toml" : "-r.toml"),
                                     {});
  ASSERT_TRUE(study) << to_string(study.error().front());
  const auto made = make_model(*study);
  ASSERT_TRUE(made) << to_string(made.error().front());
  const StudyModel& model = **made;
  const std::size_t form_at = *place_of(study->characteristics, "cone.equivalent_form");
  const std::size_t angle_at = *place_of(study->characteristics, "cone.half_angle");

  constexpr std::uint32_t kDraws = 10'000;
  const std::vector<double> forms = linear_values(*study, model, form_at, kDraws);
  const std::vector<double> angles = linear_values(*study, model, angle_at, kDraws);
  const std::string place = std::string(setup) + "/cone";
  const nlohmann::json& expected = studies::expected()["cone"][place][std::string(1, read)];
  const auto& ring = studies::RingPopulation::of(place, read, 150.0);
  std::vector<DrawnMachine> first;
  const auto wholes = proof::law_count<std::uint32_t>(3, 1);
  for (std::uint32_t d = 0; d < 3; ++d) {
    const double form = expected["first_draws"][d];
    EXPECT_NEAR(forms[d], form, 0.1 + 0.02 * form) << d;
    const double angle = studies::value_of(ring.model.characteristics[1], ring.weights(1, d));
    EXPECT_NEAR(angles[d], angle, 1.0 + 0.01 * std::abs(angle)) << d;
    std::vector<double> drawn(model.factors().variables().size());
    model.factors().draw(study->seed, d, drawn);
    if (d < wholes) first.push_back({d, std::move(drawn)});
  }
  // The same draws as whole trials.
  const auto whole = model.full(first, {});
  for (std::uint32_t d = 0; d < wholes; ++d) {
    ASSERT_FALSE(whole[d].values.empty()) << whole[d].failure;
    const double form = expected["first_draws"][d];
    EXPECT_NEAR(whole[d].values[form_at], form, 0.1 + 0.02 * form) << d;
    EXPECT_NEAR(whole[d].values[angle_at], angles[d], 0.5) << d;
  }
  std::vector<double> sorted = forms;
  std::ranges::sort(sorted);
  for (const auto& [name, p] :
       {std::pair{"q05", 0.05}, {"q25", 0.25}, {"q50", 0.5}, {"q75", 0.75}, {"q95", 0.95}}) {
    const double quantile = expected["10000"][name];
    EXPECT_NEAR(studies::sorted_quantile(sorted, p), quantile, 0.01 * quantile) << name;
  }
  const auto accepted =
      std::ranges::count_if(std::span(forms).first(1000), [](double v) { return v <= 10.0; });
  const auto& of_ring = studies::expected()["acceptance"][std::string(setup) + "/" + read];
  EXPECT_NEAR(static_cast<double>(accepted),
              of_ring["cone form <= 10"]["k_first_1000"].get<double>(), 5.0);
}

INSTANTIATE_TEST_SUITE_P(Readings, StudyJobReference,
                         testing::Values(std::pair{"proposed", 'A'}, std::pair{"proposed", 'R'},
                                         std::pair{"comparison", 'A'},
                                         std::pair{"comparison", 'R'}));

}  // namespace
}  // namespace frustum::app
