#include "report/html/tolerance_symbol.hpp"

#include <fmt/format.h>

#include <array>

namespace frustum::report {
namespace {

struct SymbolRow {
  std::string_view kind;
  std::string_view name;   // the term of ISO 1101
  std::string_view shape;  // in a square of 24
};

constexpr std::string_view kStraight = R"(<path d="M2 12H22"/>)";
constexpr std::string_view kRings =
    R"(<circle cx="12" cy="12" r="9"/><circle cx="12" cy="12" r="4.5"/>)";

constexpr std::array kSymbols{
    SymbolRow{"straightness", "straightness", kStraight},
    SymbolRow{"axis_straightness", "straightness", kStraight},
    SymbolRow{"flatness", "flatness", R"(<path d="M2 18L8 6H22L16 18Z"/>)"},
    SymbolRow{"roundness", "roundness", R"(<circle cx="12" cy="12" r="9"/>)"},
    SymbolRow{"cylindricity", "cylindricity",
              R"(<circle cx="12" cy="12" r="5"/><path d="M2.5 21L10 3M14 21L21.5 3"/>)"},
    SymbolRow{"line_profile", "profile any line", R"(<path d="M3 17A9 9 0 0 1 21 17"/>)"},
    SymbolRow{"surface_profile", "profile any surface", R"(<path d="M3 17A9 9 0 0 1 21 17Z"/>)"},
    SymbolRow{"parallelism", "parallelism", R"(<path d="M5 21L11 3M13 21L19 3"/>)"},
    SymbolRow{"perpendicularity", "perpendicularity", R"(<path d="M12 4V20M3 20H21"/>)"},
    SymbolRow{"angularity", "angularity", R"(<path d="M20 5L3 19H21"/>)"},
    SymbolRow{"position", "position",
              R"(<circle cx="12" cy="12" r="6"/><path d="M12 2V22M2 12H22"/>)"},
    SymbolRow{"concentricity", "concentricity", kRings},
    SymbolRow{"coaxiality", "coaxiality", kRings},
    SymbolRow{"symmetry", "symmetry", R"(<path d="M2 12H22M7 6H17M7 18H17"/>)"},
    SymbolRow{"circular_run_out", "circular run-out",
              R"(<path d="M4 21L18 5"/><path class="tip" d="M20 3L18.4 10.4L12.6 5.4Z"/>)"},
    SymbolRow{"total_run_out", "total run-out",
              R"(<path d="M2 21L11 8M12 21L21 8M2 21H12"/>)"
              R"(<path class="tip" d="M13 5L12 12L6.5 8ZM23 5L22 12L16.5 8Z"/>)"}};

}  // namespace

std::string tolerance_symbol(std::string_view kind, const Wording& words) {
  for (const SymbolRow& row : kSymbols) {
    if (row.kind != kind) continue;
    return fmt::format(
        "<svg class=\"gps\" viewBox=\"0 0 24 24\" role=\"img\" aria-label=\"{}\">{}</svg>",
        words.word(row.name), row.shape);
  }
  return {};
}

}  // namespace frustum::report
