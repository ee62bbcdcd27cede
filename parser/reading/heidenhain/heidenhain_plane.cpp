// PLANE of Klartext: tilted planes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include "core/decimal.hpp"
#include "parser/dialects/code_table.hpp"
#include "parser/reading/heidenhain/heidenhain_statements.hpp"

namespace frustum::parser {
namespace {

struct PlaneWord {
  const char* name;
  char letter;
};
struct PlaneForm {
  std::string_view kind;
  const char* code;
  std::size_t needed;
  std::string_view what;
  std::span<const PlaneWord> words;
};
constexpr std::array kSpatial{PlaneWord{"SPA", 'A'}, PlaneWord{"SPB", 'B'}, PlaneWord{"SPC", 'C'}};
constexpr std::array kEuler{PlaneWord{"EULPR", 'I'}, PlaneWord{"EULNU", 'J'},
                            PlaneWord{"EULROT", 'K'}};
constexpr std::array kProjected{PlaneWord{"PROPR", 'I'}, PlaneWord{"PROMIN", 'J'},
                                PlaneWord{"ROT", 'K'}};
constexpr std::array kVectors{PlaneWord{"BX", 'A'}, PlaneWord{"BY", 'B'}, PlaneWord{"BZ", 'C'},
                              PlaneWord{"NX", 'I'}, PlaneWord{"NY", 'J'}, PlaneWord{"NZ", 'K'}};
constexpr std::array kPoints{PlaneWord{"P1X", 'X'}, PlaneWord{"P1Y", 'Y'}, PlaneWord{"P1Z", 'Z'},
                             PlaneWord{"P2X", 'I'}, PlaneWord{"P2Y", 'J'}, PlaneWord{"P2Z", 'K'},
                             PlaneWord{"P3X", 'u'}, PlaneWord{"P3Y", 'v'}, PlaneWord{"P3Z", 'w'}};
constexpr std::array kForms{
    PlaneForm{"SPATIAL", "PLANE SPATIAL", 3, "three angles: SPA, SPB and SPC", kSpatial},
    PlaneForm{"PROJECTED", "PLANE PROJECTED", 3, "three angles: PROPR, PROMIN and ROT", kProjected},
    PlaneForm{"EULER", "PLANE EULER", 3, "three angles: EULPR, EULNU and EULROT", kEuler},
    PlaneForm{"VECTOR", "PLANE VECTOR", 6, "two vectors: BX BY BZ and NX NY NZ", kVectors},
    PlaneForm{"POINTS", "PLANE POINTS", 9, "three points: P1X P1Y P1Z to P3Z", kPoints},
    PlaneForm{"RELATIV", "PLANE RELATIV", 1, "one angle: SPA, SPB or SPC", kSpatial},
    PlaneForm{"RELATIVE", "PLANE RELATIV", 1, "one angle: SPA, SPB or SPC", kSpatial},
    PlaneForm{"RESET", "PLANE RESET", 0, "", {}}};

class PlaneReader {
 public:
  explicit PlaneReader(BlockDraft& draft) : draft_(draft), in_(draft.in), block_(draft.block) {}

  void read_plane(std::uint32_t column) {
    const std::string kind = in_.name();
    const auto* form = std::find_if(kForms.begin(), kForms.end(),
                                    [&](const PlaneForm& known) { return known.kind == kind; });
    if (kind == "AXIAL") {
      return in_.fail("not-supported"_id, column, "PLANE AXIAL is not simulated",
                      "which plane the axes' positions give is the machine's to know: use PLANE "
                      "SPATIAL SPA SPB SPC");
    }
    if (form == kForms.end()) {
      return in_.fail("not-supported"_id, column, fmt::format("PLANE {} is not simulated", kind),
                      "use PLANE SPATIAL SPA SPB SPC, PROJECTED, EULER, VECTOR, POINTS, RELATIV or "
                      "RESET");
    }
    add_code(block_, *find_code(Dialect::heidenhain, form->code), column);
    std::size_t given = 0;
    std::string behaviour;
    while (!in_.at_end()) {
      const std::uint32_t place = in_.column();
      if (in_.peek() == ';') {
        draft_.read_comment();
        continue;
      }
      if (const PlaneWord* word = take_word(*form)) {
        add_value(draft_, word->letter, word->name, place, word->name);
        ++given;
        continue;
      }
      const std::string name = in_.letters();
      if (name == "TURN" || name == "STAY" || name == "MOVE") {
        if (!behaviour.empty()) {
          return in_.fail("word-twice"_id, place, fmt::format("{} beside {}", name, behaviour),
                          "say once whether the axes turn: TURN, MOVE or STAY");
        }
        behaviour = name;
        if (name == "TURN") add_number(block_, 'd', 1.0, place, "TURN ");
        if (name == "MOVE") add_number(block_, 'm', 1.0, place, "MOVE ");
      } else {
        read_plane_option(name, place);
      }
    }
    if (in_.failed()) return;
    const bool all = form->kind.starts_with("RELATIV") ? given == 1 : given >= form->needed;
    if (!all) {
      return in_.fail(
          "value-missing"_id, column,
          fmt::format("PLANE {} needs {}", kind, form->what.substr(0, form->what.find(':'))),
          fmt::format("give {}", form->what.substr(form->what.find(':') + 2)));
    }
    if (behaviour.empty()) {
      return in_.fail("keyword-missing"_id, column,
                      fmt::format("PLANE {} does not say whether the axes turn", kind),
                      "end it with TURN, MOVE or STAY");
    }
    if (behaviour == "MOVE" && distance_ != 0.0) {
      in_.fail("not-supported"_id, distance_column_,
               fmt::format("DIST {} with MOVE is not simulated", distance_),
               "hold the tip itself, by DIST0, or retract the tool and use TURN");
    }
  }

 private:
  // A word of the form, with its number after it: SPA+45, P1X+0, BX+1.
  const PlaneWord* take_word(const PlaneForm& form) {
    const std::uint32_t place = in_.column();
    const std::string name = in_.name();
    for (const PlaneWord& word : form.words) {
      const std::string_view known = word.name;
      // SPA45: the number has no sign.
      const bool run_on =
          name.starts_with(known) && (name.size() == known.size() || name[known.size()] == 'Q' ||
                                      (name[known.size()] >= '0' && name[known.size()] <= '9'));
      if (!run_on) continue;
      in_.go_to(place + static_cast<std::uint32_t>(known.size()));
      return &word;
    }
    in_.go_to(place);
    return nullptr;
  }

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
      const double value = in_.signed_number(name, place);
      if (name != "MB") {
        distance_ = value;
        distance_column_ = place;
      }
      return pass(name == "MB" ? "PLANE MB" : "PLANE DIST", shortest_decimal(value));
    }
    if (name == "SEQ" || name == "SYM") {
      const char sign = in_.peek();
      if (!in_.take('+') && !in_.take('-')) {
        return in_.fail("keyword-missing"_id, place, name + " has no sign", "write SEQ+ or SEQ-");
      }
      return pass("PLANE SEQ", std::string(1, sign));
    }
    if ((name == "TABLE" || name == "COORD") && in_.take_name("ROT")) {
      return pass("PLANE ROT", name);
    }
    if (name.empty()) return in_.fail_unexpected("write PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY");
    in_.fail("unknown-word"_id, place, fmt::format("{} has no meaning in PLANE", name),
             "known are the words of its form, TURN, MOVE, STAY, MB, DIST, F, SEQ, SYM, TABLE ROT, "
             "COORD ROT");
  }

  BlockDraft& draft_;
  LineScanner& in_;
  Block& block_;
  // Of MOVE: how far in front of the tip the point is that is held.
  double distance_ = 0.0;
  std::uint32_t distance_column_ = 0;
};

}  // namespace

void read_heidenhain_plane(BlockDraft& draft, std::uint32_t column) {
  PlaneReader(draft).read_plane(column);
}

}  // namespace frustum::parser
