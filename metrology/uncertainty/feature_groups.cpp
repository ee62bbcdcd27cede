#include "metrology/uncertainty/feature_groups.hpp"

#include <algorithm>
#include <set>

#include "core/name_index.hpp"
#include "metrology/characteristic/datum_system.hpp"

namespace frustum::metrology {
namespace {

class Grouping {
 public:
  Grouping(const InspectionPlan& plan, std::span<const FittedFeature> features)
      : plan_(plan),
        places_(features,
                [](const FittedFeature& f) -> const std::string& { return f.planned->name; }),
        frames_(plan.frames, &PlannedFrame::name),
        resting_(features.size()) {
    found_.group_of.resize(features.size(), kNone);
  }

  FeatureGroups found() {
    if (uses_datum(plan_)) {
      for (const std::string& name : features_of(*plan_.datum)) add(found_.datums, name);
    }
    // Nearly all rest on these together.
    for (const std::size_t datum : found_.datums) {
      if (found_.group_of[datum] == kNone) put(datum, found_.groups.size());
    }
    first_shared_ = found_.groups.size();
    for (const PlannedCharacteristic& c : plan_.characteristics) add(c);
    for (std::size_t feature = 0; feature < found_.group_of.size(); ++feature) {
      const bool is_free = found_.group_of[feature] == kNone;
      if (is_free && !resting_[feature].empty()) put(feature, free_group(feature));
    }
    return std::move(found_);
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  void add(std::vector<std::size_t>& places, const std::string& name) const {
    const auto place = places_.find(name);
    if (place && std::find(places.begin(), places.end(), *place) == places.end()) {
      places.push_back(*place);
    }
  }

  void add(const PlannedCharacteristic& c) {
    std::vector<std::size_t> named;
    for (const std::string& name : c.features) add(named, name);
    if (const auto frame = frames_.find(c.frame); frame && !c.frame.empty()) {
      const PlannedFrame& planned = plan_.frames[*frame];
      for (const std::string& name : planned.planes) add(named, name);
      add(named, planned.line);
    }
    for (const std::size_t feature : named) resting_[feature].push_back(found_.named.size());
    found_.named.push_back(std::move(named));
    found_.in_datum.push_back(c.frame.empty() && uses_datum(plan_));
  }

  void put(std::size_t feature, std::size_t group) {
    if (group == found_.groups.size()) found_.groups.emplace_back();
    found_.groups[group].push_back(feature);
    found_.group_of[feature] = group;
  }

  // The first that has no feature on which something rests together with this one.
  [[nodiscard]] std::size_t free_group(std::size_t feature) const {
    std::set<std::size_t> taken;
    for (const std::size_t c : resting_[feature]) {
      for (const std::size_t other : found_.named[c]) {
        if (found_.group_of[other] != kNone) taken.insert(found_.group_of[other]);
      }
    }
    std::size_t group = first_shared_;
    while (taken.contains(group)) ++group;
    return group;
  }

  const InspectionPlan& plan_;
  NameIndex places_;
  NameIndex frames_;
  std::vector<std::vector<std::size_t>> resting_;  // characteristics on each feature
  std::size_t first_shared_ = 0;                   // group
  FeatureGroups found_{};
};

}  // namespace

std::optional<std::size_t> FeatureGroups::of(std::size_t characteristic, std::size_t group) const {
  for (const std::size_t feature : named[characteristic]) {
    if (group_of[feature] == group) return feature;
  }
  // A group with a datum has nothing else.
  const std::size_t first = groups[group].front();
  const bool is_datum = group < datums.size();
  return is_datum && in_datum[characteristic] ? std::optional(first) : std::nullopt;
}

FeatureGroups feature_groups(const InspectionPlan& plan, std::span<const FittedFeature> features) {
  return Grouping(plan, features).found();
}

}  // namespace frustum::metrology
