#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/counted.hpp"
#include "core/spelling.hpp"
#include "metrology/fit/element.hpp"
#include "metrology/plan/plan_check.hpp"
#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {
namespace {

using enum FeatureKind;

// Keys that a kind takes.
enum Takes : unsigned {
  frame_key = 1,
  parameter_key = 2,
  closed_filter = 4,
  open_filter = 8,
  harmonics_key = 16,
  datum_criterion_key = 32,
  floating_key = 64,
  deviation_key = 128
};

struct Rule {
  CharacteristicKind kind;
  std::vector<FeatureKind> toleranced;
  std::vector<FeatureKind> datums;  // what follows the first
  std::size_t least;                // features
  std::size_t most;
  std::string_view features;  // in words
  std::size_t sections;       // how many it takes; 0: it concerns the whole feature
  unsigned keys;
  std::string_view criteria;  // names that it takes
};

constexpr std::size_t kMany = 1000;
constexpr std::string_view kOne = "one feature";
constexpr std::string_view kPair = "two lines: first, second";
constexpr std::string_view kDatum = "one feature, or two: toleranced, datum";
constexpr std::string_view kAxis = "two features or more: toleranced, datum, ...";

// In the order of CharacteristicKind.
const std::vector<Rule>& rules() {
  using K = CharacteristicKind;
  static const std::vector<FeatureKind> around{cylinder, cone, circle};
  static const std::vector<FeatureKind> sized{cylinder, cone, circle, sphere};
  static const std::vector<FeatureKind> axes{cylinder, cone};
  static const std::vector<FeatureKind> directed{plane, cylinder, cone, line};
  static const std::vector<FeatureKind> any{plane, cylinder, cone, circle, line, sphere, point};
  static const std::vector<FeatureKind> surfaces{plane, cylinder, cone,  circle,
                                                 line,  sphere,   point, ruled};
  static const std::vector<Rule> table{
      {K::roundness,
       around,
       {},
       1,
       1,
       kOne,
       1,
       parameter_key | closed_filter | harmonics_key,
       "ls mz mi mc"},
      {K::cylindricity, {cylinder}, {}, 1, 1, kOne, 0, parameter_key, "ls mz mi mc"},
      {K::cone_form, {cone}, {}, 1, 1, kOne, 0, parameter_key, "ls mz"},
      {K::equivalent_cone_form, {cone}, {}, 1, 1, kOne, 1, 0, "ls"},
      {K::flatness, {plane}, {}, 1, 1, kOne, 0, parameter_key, "ls mz"},
      {K::straightness,
       {line, cylinder, cone},
       {line, cylinder, cone},
       1,
       kMany,
       "one feature or more",
       0,
       parameter_key | open_filter,
       "ls mz"},
      {K::half_angle, {cone}, {}, 1, 1, kOne, 0, deviation_key, "ls"},
      {K::concentricity, axes, axes, 1, 2, kDatum, 2, 0, "ls"},
      {K::perpendicularity, directed, directed, 1, 2, kDatum, 0, datum_criterion_key | frame_key,
       "ls mz mi mc"},
      {K::radius, sized, {}, 1, 1, kOne, 0, deviation_key, "ls"},
      {K::diameter, sized, {}, 1, 1, kOne, 0, deviation_key, "ls"},
      {K::line_distance, {line}, {line}, 2, 2, kPair, 0, frame_key, "ls"},
      {K::line_angle, {line}, {line}, 2, 2, kPair, 0, frame_key, "ls"},
      {K::axis_straightness, axes, {}, 1, 1, kOne, 0, 0, "ls mz"},
      {K::parallelism, directed, directed, 1, 2, kDatum, 0, datum_criterion_key | frame_key,
       "ls mz mi mc"},
      {K::angularity, directed, directed, 1, 2, kDatum, 0, datum_criterion_key | frame_key,
       "ls mz mi mc"},
      {K::position, any, {}, 1, 1, kOne, 0, frame_key, "ls mz mi mc"},
      {K::coaxiality, sized, around, 2, kMany, kAxis, 0, datum_criterion_key, "ls mz mi mc"},
      {K::symmetry,
       {plane, cylinder, cone},
       {plane, cylinder, cone},
       2,
       4,
       "two to four features: toleranced, datum, either of them also a pair of faces",
       0,
       datum_criterion_key,
       "ls"},
      {K::circular_run_out,
       {cylinder, cone, circle, plane},
       axes,
       2,
       kMany,
       kAxis,
       1,
       datum_criterion_key | closed_filter | harmonics_key,
       "ls"},
      {K::total_run_out,
       {cylinder, cone, plane},
       axes,
       2,
       kMany,
       kAxis,
       0,
       datum_criterion_key,
       "ls"},
      {K::line_profile,
       {plane, cylinder, cone, circle, line, sphere, ruled},
       {},
       1,
       1,
       kOne,
       1,
       floating_key | frame_key,
       "ls"},
      {K::surface_profile, surfaces, surfaces, 1, kMany, "one feature or more", 0,
       floating_key | frame_key, "ls"},
      {K::thickness,
       {ruled},
       {ruled},
       2,
       2,
       "two features: one side, the other",
       1,
       frame_key,
       "ls"},
      {K::deviation, {ruled}, {}, 1, 1, kOne, 0, frame_key, "ls"}};
  return table;
}

bool contains(std::string_view words, std::string_view word) {
  return words.find(word) != std::string_view::npos;
}

class CharacteristicCheck {
 public:
  CharacteristicCheck(const NamedPlan& named, std::size_t index, const PlanFault& fault)
      : named_(named),
        plan_(named.plan),
        c_(named.plan.characteristics[index]),
        index_(index),
        fault_(fault),
        rule_(rules().at(static_cast<std::size_t>(c_.kind))) {}

  void run() {
    name();
    if (!(c_.tolerance > 0.0)) wrong("tolerance", "must be greater than 0");
    if (!find_features()) return;
    place();
    sections();
    criteria();
    keys();
    geometry();
  }

 private:
  void wrong(std::string_view key, std::string message, std::string hint = {}) const {
    fault_(PlanPart::characteristic, index_, key, std::move(message), std::move(hint));
  }
  [[nodiscard]] std::string_view kind() const { return name_of(c_.kind); }
  [[nodiscard]] bool takes(unsigned keys) const { return (rule_.keys & keys) != 0; }

  void name() const {
    if (c_.name.empty()) wrong("name", "must not be empty");
    if (named_.characteristics.find(c_.name) != index_) {
      wrong("name", fmt::format("'{}' names two characteristics", c_.name));
    }
  }

  bool find_features() {
    if (c_.features.size() < rule_.least || c_.features.size() > rule_.most) {
      wrong("features",
            fmt::format("a {} takes {}, named are {}", kind(), rule_.features, c_.features.size()));
      return false;
    }
    for (const std::string& name : c_.features) {
      const bool is_first = features_.empty();
      const bool as_first = is_first || rule_.datums == rule_.toleranced;
      const std::string purpose = fmt::format("{} {}", as_first ? "a" : "the datum of a", kind());
      features_.push_back(suitable(named_, name, is_first ? rule_.toleranced : rule_.datums,
                                   purpose, [&](std::string message, std::string hint) {
                                     wrong(c_.features.size() == 1 ? "feature" : "features",
                                           std::move(message), std::move(hint));
                                   }));
      if (features_.back() == nullptr || !UnitVec3::of(features_.back()->axis)) return false;
    }
    for (std::size_t i = 1; i < c_.features.size(); ++i) {
      if (!compares_lines(c_.kind) &&
          std::count(c_.features.begin(), c_.features.end(), c_.features[i]) > 1) {
        wrong("features", fmt::format("'{}' is named twice", c_.features[i]));
        return false;
      }
    }
    return true;
  }

  // Frame and direction.
  void place() const {
    if (compares_lines(c_.kind)) {
      check_line_pair(plan_, index_, *features_[0], *features_[1], fault_);
    } else if (c_.direction != Vec3::Zero()) {
      wrong("direction", fmt::format("not for a {}", kind()),
            "only line_distance and line_angle take one");
    }
    if (c_.frame.empty()) return;
    if (!takes(frame_key)) {
      wrong("frame", fmt::format("not for a {}", kind()),
            "only kinds that compare with planned places and directions take one");
    } else if (!named_.frames.find(c_.frame)) {
      std::vector<std::string> names;
      for (const PlannedFrame& frame : plan_.frames) names.push_back(frame.name);
      wrong("frame", fmt::format("the plan has no frame '{}'", c_.frame),
            suggestion(c_.frame, names));
    }
  }

  void sections() const {
    if (c_.kind == CharacteristicKind::concentricity) {
      sections_of_concentricity();
      return;
    }
    if (c_.sections.empty()) return;
    if (rule_.sections == 0) {
      wrong("section", fmt::format("a {} concerns the whole feature", kind()));
      return;
    }
    if (c_.sections.size() != rule_.sections) {
      wrong("sections", fmt::format("a {} takes {} section{}, named are {}", kind(), rule_.sections,
                                    rule_.sections == 1 ? "" : "s", c_.sections.size()));
      return;
    }
    sections_exist();
  }

  [[nodiscard]] std::string_view section_key() const {
    return c_.sections.size() == 1 ? "section" : "sections";
  }
  void sections_exist() const {
    const PlannedFeature& feature = *features_.front();
    const std::size_t count = section_count(feature);
    for (const std::size_t section : c_.sections) {
      if (section < count) continue;
      wrong(section_key(),
            fmt::format("'{}' has {} section{}, there is no section {}", feature.name, count,
                        count == 1 ? "" : "s", section),
            "the first section is 0");
    }
  }

  // Two of one feature, or any of the feature that is compared with a datum.
  void sections_of_concentricity() const {
    constexpr std::string_view kRemedy =
        "write sections = [first, second], or features = [toleranced, datum]";
    if (features_.size() > 1) {
      sections_exist();
    } else if (c_.sections.empty() && section_count(*features_.front()) < 2) {
      wrong("feature",
            fmt::format("a concentricity within one feature compares two of its sections, '{}' has "
                        "{}",
                        features_.front()->name, section_count(*features_.front())),
            "plan more sections, or write features = [toleranced, datum]");
    } else if (!c_.sections.empty() && c_.sections.size() != 2) {
      wrong(section_key(),
            fmt::format("a concentricity within one feature compares two of its sections, named "
                        "{} [{}]",
                        c_.sections.size() == 1 ? "is" : "are", fmt::join(c_.sections, ", ")),
            std::string(kRemedy));
    } else if (!c_.sections.empty() && c_.sections[0] == c_.sections[1]) {
      wrong("sections",
            fmt::format("a concentricity compares two sections, section {} is named twice",
                        c_.sections[0]),
            std::string(kRemedy));
    } else {
      sections_exist();
    }
  }

  void criteria() const {
    if (!contains(rule_.criteria, name_of(c_.criterion))) {
      wrong("criterion",
            fmt::format("a {} is not evaluated by \"{}\"", kind(), name_of(c_.criterion)),
            fmt::format("it takes {}", rule_.criteria));
    }
    const bool inscribes = c_.criterion == Criterion::maximum_inscribed ||
                           c_.criterion == Criterion::minimum_circumscribed;
    const FeatureKind first = features_.front()->kind;
    if (inscribes && (first == plane || first == cone || first == line || first == point) &&
        c_.kind != CharacteristicKind::roundness) {
      wrong("criterion",
            fmt::format("a {} has no inscribed or circumscribed element", name_of(first)),
            "choose \"ls\" or \"mz\"");
    }
    if (c_.datum_criterion == Criterion::least_squares) return;
    if (!takes(datum_criterion_key) || c_.features.size() < 2) {
      wrong("datum_criterion", fmt::format("this {} names no datum", kind()));
    } else if (c_.datum_criterion != Criterion::outside_material) {
      wrong("datum_criterion", "a datum is associated by \"ls\" or \"om\"");
    } else {
      datums_outside_material();
    }
  }

  void datums_outside_material() const {
    const auto datum = std::find_if(features_.begin() + 1, features_.end(),
                                    [](const PlannedFeature* f) { return f->kind == cone; });
    if (datum == features_.end()) {
      common_axis_outside_material();
      return;
    }
    wrong("datum_criterion",
          fmt::format("the datum '{}' is a cone, which has no association \"om\"", (*datum)->name),
          "choose \"ls\": a cone has no largest or smallest size");
  }

  // Coaxial cylinders of their own sizes that touch from outside together are no association here.
  void common_axis_outside_material() const {
    const std::size_t toleranced = c_.kind == CharacteristicKind::symmetry &&
                                           features_.front()->kind == plane && features_.size() > 2
                                       ? 2
                                       : 1;
    if (features_.size() < toleranced + 2 || features_.back()->kind == plane) return;
    wrong("datum_criterion",
          fmt::format("the common axis of {} datums is of least squares, it has no \"om\"",
                      features_.size() - toleranced),
          "leave it out, or name one datum");
  }

  void keys() const {
    if (c_.parameter && !takes(parameter_key)) {
      wrong("parameter", fmt::format("a {} has no parameters t, p, v, q", kind()));
    }
    if (c_.harmonics < 0 || (c_.harmonics > 0 && !takes(harmonics_key))) {
      wrong("harmonics", fmt::format("a {} has no undulations per revolution", kind()),
            "only roundness and circular_run_out have them");
    }
    if (c_.floating && !takes(floating_key)) {
      wrong("floating", fmt::format("not for a {}", kind()),
            "only line_profile and surface_profile can do without datums");
    }
    if (c_.deviation && !takes(deviation_key)) {
      wrong("deviation", fmt::format("not for a {}", kind()),
            "only radius, diameter and half_angle have a value besides it");
    }
    if (c_.filter) filter(*c_.filter);
    point_number();
    if (c_.seam) seam(*c_.seam);
  }

  void point_number() const {
    if (c_.kind != CharacteristicKind::deviation) {
      if (c_.point) wrong("point", fmt::format("not for a {}", kind()), "only a deviation has one");
      return;
    }
    const std::size_t count = planned_points(*features_.front()).size();
    if (c_.point && *c_.point < count) return;
    wrong("point",
          c_.point ? fmt::format("'{}' has {}, there is no point {}", features_.front()->name,
                                 counted(count, "point"), *c_.point)
                   : "a deviation is that of one point",
          "the first point is 0");
  }

  void seam(const Seam& s) const {
    constexpr double kMostOfEitherSide = 0.25 * std::numbers::pi;
    if (c_.kind != CharacteristicKind::roundness &&
        c_.kind != CharacteristicKind::equivalent_cone_form) {
      wrong("seam", fmt::format("not for a {}", kind()),
            "only roundness and equivalent_cone_form have a value without a seam");
    } else if (c_.filter || c_.harmonics > 0) {
      wrong("seam", "a profile with a gap has no filter and no harmonics", "leave one of them out");
    } else if (!(s.within > 0.0 && s.within <= kMostOfEitherSide)) {
      wrong("seam", "within must be more than 0 and at most 45 deg to either side");
    }
  }

  void filter(const ProfileFilter& f) const {
    const bool closed = f.upr != 0.0 || f.upr_from != 0.0;
    const bool open = f.cutoff != 0.0 || f.cutoff_long != 0.0;
    if (!takes(closed_filter | open_filter)) {
      wrong("filter", fmt::format("a {} is not filtered", kind()),
            "only roundness, straightness and circular_run_out are");
    } else if (closed == open || open != takes(open_filter)) {
      wrong("filter", fmt::format("a {} is filtered by {}", kind(),
                                  takes(open_filter) ? "cutoff or cutoff_long, or both"
                                                     : "upr or upr_from, or both"));
    } else if (!(f.upr >= 0.0 && f.upr_from >= 0.0 && f.cutoff >= 0.0 && f.cutoff_long >= 0.0)) {
      wrong("filter", "cut-offs must be greater than 0");
    } else if ((f.upr > 0.0 && f.upr < 1.0) || (f.upr_from > 0.0 && f.upr_from < 1.0)) {
      wrong("filter", "a closed profile has at least 1 undulation per revolution");
    } else if (f.upr > 0.0 && !(f.upr_from < f.upr)) {
      wrong("filter", fmt::format("upr_from = {} must be less than upr = {}", f.upr_from, f.upr));
    } else if (f.cutoff_long > 0.0 && !(f.cutoff < f.cutoff_long)) {
      wrong("filter", fmt::format("cutoff = {} mm must be less than cutoff_long = {} mm", f.cutoff,
                                  f.cutoff_long));
    }
  }

  void geometry() const {
    if (c_.kind == CharacteristicKind::symmetry && !symmetry()) return;
    if (c_.kind == CharacteristicKind::circular_run_out && features_.front()->kind == plane &&
        !std::holds_alternative<RingStrategy>(features_.front()->strategy)) {
      wrong("features",
            fmt::format("the circular_run_out of '{}' needs rings, its strategy has none",
                        features_.front()->name));
      return;
    }
    check_places(c_, features_, [this](std::string message, std::string hint) {
      wrong("features", std::move(message), std::move(hint));
    });
  }

  [[nodiscard]] bool symmetry() const {
    const std::size_t count = features_.size();
    std::size_t planes = 0;
    for (const PlannedFeature* f : features_) planes += f->kind == plane ? 1 : 0;
    const bool first = features_.front()->kind == plane;
    const bool last = features_.back()->kind == plane;
    // [face, face, datum], [axis, face, face], [face, face, face, face] and pairs of anything.
    const bool sound =
        count == 2 || (count == 3 && (first ? features_[1]->kind == plane : planes == 2 && last)) ||
        (count == 4 && planes == 4);
    if (!sound) {
      wrong("features", "a pair of faces is two planes",
            "toleranced first, then the datum: [face, face, datum]");
    }
    return sound;
  }

  const NamedPlan& named_;
  const InspectionPlan& plan_;
  const PlannedCharacteristic& c_;
  std::size_t index_;
  const PlanFault& fault_;
  const Rule& rule_;
  std::vector<const PlannedFeature*> features_{};
};

}  // namespace

void check_characteristic(const NamedPlan& named, std::size_t index, const PlanFault& fault) {
  CharacteristicCheck(named, index, fault).run();
}

}  // namespace frustum::metrology
