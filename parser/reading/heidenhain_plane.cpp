// PLANE of Klartext: tilted planes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include "parser/dialects/code_table.hpp"
#include "parser/reading/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

struct SpatialAngle {
  const char* name;
  char letter;
};
constexpr std::array kSpatialAngles{SpatialAngle{"SPA", 'A'}, SpatialAngle{"SPB", 'B'},
                                    SpatialAngle{"SPC", 'C'}};

class PlaneReader {
 public:
  explicit PlaneReader(BlockDraft& draft) : draft_(draft), in_(draft.in), block_(draft.block) {}

  void read_plane(std::uint32_t column) {
    const std::string kind = in_.name();
    if (kind != "SPATIAL" && kind != "RESET") {
      return in_.fail(column, fmt::format("PLANE {} is not simulated", kind),
                      "use PLANE SPATIAL SPA SPB SPC, or PLANE RESET");
    }
    add_code(block_, *find_code(Dialect::heidenhain, "PLANE " + kind), column);
    int angles = 0;
    bool behaviour = false;
    while (!in_.at_end()) {
      const std::uint32_t place = in_.column();
      if (in_.peek() == ';') {
        draft_.read_comment();
        continue;
      }
      const std::string name = in_.letters();
      const auto* angle =
          std::find_if(kSpatialAngles.begin(), kSpatialAngles.end(),
                       [&](const SpatialAngle& known) { return known.name == name; });
      if (angle != kSpatialAngles.end() && kind == "SPATIAL") {
        add_number(block_, angle->letter, in_.signed_number(name, place), place, angle->name);
        ++angles;
      } else if (name == "TURN" || name == "STAY") {
        behaviour = true;
        if (name == "TURN") add_number(block_, 'd', 1.0, place, "TURN ");
      } else if (name == "MOVE") {
        in_.fail(place, "PLANE ... MOVE is not simulated",
                 "retract the tool and use TURN, or STAY and turn the axes by L");
      } else {
        read_plane_option(name, place);
      }
    }
    if (kind == "SPATIAL" && angles < 3) {
      in_.fail(column, "PLANE SPATIAL needs three angles", "give SPA, SPB and SPC, zero or not");
    }
    if (!behaviour) {
      in_.fail(column, fmt::format("PLANE {} does not say whether the axes turn", kind),
               "end it with TURN or STAY");
    }
  }

 private:
  // How the axes get there, which is not simulated.
  void read_plane_option(const std::string& name, std::uint32_t place) {
    const auto pass = [&](const char* event, std::string text) {
      draft_.add_event(event, place, std::move(text));
    };
    if (name == "FMAX" || name == "FAUTO") return;
    if (name == "F") {
      if (in_.take_name("MAX") || in_.take_name("AUTO")) return;
      (void)in_.signed_number(name, place);
      return;
    }
    if (name == "MB" || name == "DIST" || name == "ABST") {
      if (in_.take_name("MAX")) return pass("PLANE MB", "MAX");
      return pass("PLANE MB", fmt::format("{}", in_.signed_number(name, place)));
    }
    if (name == "SEQ" || name == "SYM") {
      const char sign = in_.peek();
      if (!in_.take('+') && !in_.take('-')) {
        return in_.fail(place, name + " has no sign", "write SEQ+ or SEQ-");
      }
      return pass("PLANE SEQ", std::string(1, sign));
    }
    if ((name == "TABLE" || name == "COORD") && in_.take_name("ROT")) {
      return pass("PLANE ROT", name);
    }
    if (name.empty()) return in_.fail_unexpected("write PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY");
    in_.fail(place, fmt::format("{} has no meaning in PLANE", name),
             "known are SPA SPB SPC, TURN, STAY, MB, F, SEQ, SYM, TABLE ROT, COORD ROT");
  }

  BlockDraft& draft_;
  LineScanner& in_;
  Block& block_;
};

}  // namespace

void read_heidenhain_plane(BlockDraft& draft, std::uint32_t column) {
  PlaneReader(draft).read_plane(column);
}

}  // namespace frustum::parser
