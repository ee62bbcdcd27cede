// The studies of the cones of Table 3.9 (examples/bossoni-study), with a plan of the cone alone.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "app/study/study_file.hpp"

namespace frustum::app {

// "proposed" or "comparison", reading 'A' or 'R'.
inline Result<StudyFile> cone_study(const char* setup, char read) {
  return load_study_file(std::string(FRUSTUM_SOURCE_DIR) + "/examples/bossoni-study/" + setup +
                             (read == 'A' ? "-a.toml" : "-r.toml"),
                         {});
}

// The first two sections, approached as planned: no datum system is measured.
inline void measure_the_cone_alone(StudyFile& study) {
  auto& plan = study.job->piece.plan;
  std::erase_if(plan.features, [](const auto& feature) { return feature.name != "cone"; });
  std::get<metrology::SectionStrategy>(plan.features.front().strategy).sections.resize(2);
  std::erase_if(plan.characteristics, [](const auto& c) {
    return c.name != "cone.equivalent_form" && c.name != "cone.half_angle";
  });
  plan.datum.reset();
  study.characteristics = characteristics_of(plan);
}

}  // namespace frustum::app
