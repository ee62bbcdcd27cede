#include "lint/run_errors.hpp"

#include <algorithm>
#include <array>

namespace frustum::lint {
namespace {

struct CheckOfId {
  DiagnosticId id;
  Check check;
};

constexpr std::array kChecksOfIds{
    CheckOfId{"feed-missing"_id, Check::feed_missing},
    CheckOfId{"spindle-off"_id, Check::spindle_off},
    CheckOfId{"arc-radius"_id, Check::arc_radii},
    CheckOfId{"arc-full-by-radius"_id, Check::arc_full_by_radius},
    CheckOfId{"radius-gouge"_id, Check::radius_gouge},
    CheckOfId{"radius-compensation"_id, Check::radius_compensation},
    CheckOfId{"parameter-unset"_id, Check::parameter_unset},
    CheckOfId{"missing-subprogram"_id, Check::missing_subprogram},
    CheckOfId{"missing-label"_id, Check::missing_label},
    CheckOfId{"recursion"_id, Check::recursion},
    CheckOfId{"endless-loop"_id, Check::endless_loop},
    CheckOfId{"tool-length-missing"_id, Check::length_missing},
    CheckOfId{"length-of-other-tool"_id, Check::length_of_other_tool},
    CheckOfId{"unknown-axis"_id, Check::unknown_axis},
    CheckOfId{"unreachable-orientation"_id, Check::unreachable_orientation},
    CheckOfId{"off-great-circle"_id, Check::unreachable_orientation},
    CheckOfId{"axis-over-travel"_id, Check::rotary_over_travel},
};

}  // namespace

Check check_of(const Diagnostic& error, Check otherwise) {
  const auto found = std::find_if(kChecksOfIds.begin(), kChecksOfIds.end(),
                                  [&](const CheckOfId& known) { return known.id == error.id; });
  return found == kChecksOfIds.end() ? otherwise : found->check;
}

bool follows_from_an_earlier_one(const Diagnostic& error) {
  return error.id == "follows-mistake"_id;
}

}  // namespace frustum::lint
