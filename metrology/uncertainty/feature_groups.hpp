// Which features the characteristics of a plan rest on, and which of these can be moved at once.
//
// Model    : a characteristic rests on the features that it names, on those of its frame, and where
//            it has none on those of the datum system. Features that no characteristic rests on
//            together are a group: moved at once, each characteristic answers to one of them at
//            most. Groups are found greedily, so there are few: of a plan of many like features as
//            many as a characteristic rests on, whatever the number of features
// Units    : none
// Shape    : places in `features`; a time that goes by what the characteristics rest on
// Errors   : none
// Accuracy : exact
// Source   : Curtis, Powell, Reid 1974 (columns of a sparse Jacobian that share differences)
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "metrology/characteristic/fitted_feature.hpp"

namespace frustum::metrology {

struct FeatureGroups {
  std::vector<std::vector<std::size_t>> groups{};
  // Of each feature its group, if anything rests on it; of each characteristic what it rests on
  // beside the datum system's.
  std::vector<std::size_t> group_of{};
  std::vector<std::vector<std::size_t>> named{};
  std::vector<std::size_t> datums{};  // what those rest on that are in the datum system
  std::vector<bool> in_datum{};       // of each characteristic

  // The feature of a group that a characteristic rests on; nothing where it rests on none.
  [[nodiscard]] std::optional<std::size_t> of(std::size_t characteristic, std::size_t group) const;
};

[[nodiscard]] FeatureGroups feature_groups(const InspectionPlan& plan,
                                           std::span<const FittedFeature> features);

}  // namespace frustum::metrology
