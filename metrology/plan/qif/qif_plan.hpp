// An inspection plan as a QIF 3.0 document.
//
// Model  : what the elements of the document state (qif_stated.hpp), and keys of plans that QIF has
//          no element for, or not to the last bit, as AttributeStr "plan.KEY" of the document, of a
//          feature's item or of a characteristic's; their value is that of the key in a plan file.
//          Without them a plan can evaluate measured points, and warns of what is not stated; it
//          cannot probe
// Units  : as the document states; as in a plan file in attributes
// Errors : no QIF 3.0; what qif_stated.hpp and the reader of plans refuse; an attribute that
//          contradicts its element; evaluations that need an extent or sections where none are
//          stated: with file, line, column, element
// Source : QIF 3.0 (ISO 23952)
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "metrology/plan/qif/plan_texts.hpp"

namespace frustum::metrology {

// By the extension of the file, or as XML begins.
[[nodiscard]] bool is_qif(std::string_view text, const std::filesystem::path& file);

// A plan, and what its file does not say that only measured points can do without.
struct ReadPlan {
  InspectionPlan plan{};
  Diagnostics warnings{};
};
[[nodiscard]] Result<ReadPlan> parse_qif_plan(std::string_view bytes,
                                              const std::filesystem::path& file);
// A plan for measured points, TOML or QIF; parse_plan refuses what this one warns of.
[[nodiscard]] Result<ReadPlan> parse_plan_for_points(std::string_view text,
                                                     const std::filesystem::path& file);

// For each feature and characteristic of the plan, in its order, and for the document: the keys
// that its elements do not state, to be written as attributes; an empty value where the plan lacks
// a key that they state.
[[nodiscard]] PlanTexts unstated_keys(const InspectionPlan& plan, std::string_view document);

}  // namespace frustum::metrology
