#include "parser/dialect_rules.hpp"

#include <array>

namespace frustum::parser {
namespace {

constexpr std::string_view kNeedsMotion = "axis words need a motion word (G0, G1, G2, G3) or G28";
constexpr std::string_view kNeedsIsoMotion = "axis words need a motion word: G0, G1, G2 or G3";
constexpr std::string_view kNeedsStatement =
    "axis words belong to L, LN, C, CR and CC; I before one makes it incremental";
constexpr std::string_view kNeedsVectors =
    "I J K give the centre of G2 and G3 along the axes of the plane (G17 I J, G18 I K, G19 J K), "
    "and "
    "the tool vector of G0 and G1 after G43.4 or G43.5";
constexpr std::string_view kNeedsArc =
    "I J K give the centre of G2 and G3 along the axes of the plane (G17 I J, G18 I K, G19 J K)";
constexpr std::string_view kNeedsTraori = "A3= B3= C3= give the tool vector after TRAORI";
constexpr std::string_view kNeedsTcpm = "TX TY TZ give the tool vector in LN after M128";
constexpr std::string_view kNoRadius = "cutter radius compensation is not simulated; leave D out";

constexpr std::array kFanucLetters{
    LetterUse{'A', kNeedsMotion},
    LetterUse{'B', kNeedsMotion},
    LetterUse{'C', kNeedsMotion},
    LetterUse{'D', kNoRadius},
    LetterUse{'H', "H belongs to G43, G43.4 and G43.5"},
    LetterUse{'I', kNeedsVectors},
    LetterUse{'J', kNeedsVectors},
    LetterUse{'K', kNeedsVectors},
    LetterUse{'L', "L belongs to M98"},
    LetterUse{'P', "P belongs to G4, G2, G3, M98, G5.1, G8 and G64"},
    LetterUse{'Q', "Q belongs to G5.1, G8 and G64"},
    LetterUse{'R', "R belongs to G2 and G3"},
    LetterUse{'U', "U belongs to G4"},
    LetterUse{'X', kNeedsMotion},
    LetterUse{'Y', kNeedsMotion},
    LetterUse{'Z', kNeedsMotion},
};
constexpr std::array kLinuxcncLetters{
    LetterUse{'A', kNeedsMotion},
    LetterUse{'B', kNeedsMotion},
    LetterUse{'C', kNeedsMotion},
    LetterUse{'D', kNoRadius},
    LetterUse{'E', "E belongs to M66 to M68"},
    LetterUse{'H', "H belongs to G43"},
    LetterUse{'I', kNeedsArc},
    LetterUse{'J', kNeedsArc},
    LetterUse{'K', kNeedsArc},
    LetterUse{'L', "L belongs to M98"},
    LetterUse{'P', "P belongs to G4, G2, G3, G64 and M98"},
    LetterUse{'Q', "Q belongs to G64"},
    LetterUse{'R', "R belongs to G2 and G3"},
    LetterUse{'X', kNeedsMotion},
    LetterUse{'Y', kNeedsMotion},
    LetterUse{'Z', kNeedsMotion},
};
constexpr std::array kSinumerikLetters{
    LetterUse{'A', kNeedsIsoMotion},
    LetterUse{'B', kNeedsIsoMotion},
    LetterUse{'C', kNeedsIsoMotion},
    LetterUse{'H', "auxiliary functions H are not read; leave it out"},
    LetterUse{'I', kNeedsArc},
    LetterUse{'J', kNeedsArc},
    LetterUse{'K', kNeedsArc},
    LetterUse{'P', "TURN= belongs to G2 and G3"},
    LetterUse{'R', "CR= belongs to G2 and G3"},
    LetterUse{'X', kNeedsIsoMotion},
    LetterUse{'Y', kNeedsIsoMotion},
    LetterUse{'Z', kNeedsIsoMotion},
    LetterUse{'a', kNeedsTraori},
    LetterUse{'b', kNeedsTraori},
    LetterUse{'c', kNeedsTraori},
};
constexpr std::array kHeidenhainLetters{
    LetterUse{'A', kNeedsStatement},
    LetterUse{'B', kNeedsStatement},
    LetterUse{'C', kNeedsStatement},
    LetterUse{'P', "it belongs to a dwell or a preset"},
    LetterUse{'R', "R and a number give the radius of CR"},
    LetterUse{'X', kNeedsStatement},
    LetterUse{'Y', kNeedsStatement},
    LetterUse{'Z', kNeedsStatement},
    LetterUse{'a', kNeedsTcpm},
    LetterUse{'b', kNeedsTcpm},
    LetterUse{'c', kNeedsTcpm},
    LetterUse{'d', "it belongs to PLANE"},
    LetterUse{'t', "FT gives the time of a cutting block"},
};
constexpr std::array kCldataLetters{
    LetterUse{'a', "tool vectors need MULTAX/ON"},
    LetterUse{'b', "tool vectors need MULTAX/ON"},
    LetterUse{'c', "tool vectors need MULTAX/ON"},
};

constexpr std::array kFanucDwell{DwellWord{'P', DwellUnit::milliseconds_without_point},
                                 DwellWord{'X', DwellUnit::seconds},
                                 DwellWord{'U', DwellUnit::seconds}};
constexpr std::array kSinumerikDwell{DwellWord{'F', DwellUnit::seconds},
                                     DwellWord{'S', DwellUnit::revolutions}};
constexpr std::array kPlainDwell{DwellWord{'P', DwellUnit::seconds}};
constexpr std::array kCldataDwell{DwellWord{'P', DwellUnit::seconds},
                                  DwellWord{'S', DwellUnit::revolutions}};

constexpr std::array<std::string_view, 3> kFanucFiles{"{}", "{}.nc", "{}.NC"};
constexpr std::array<std::string_view, 2> kLinuxcncFiles{"{}.ngc", "{}.nc"};

const std::array<DialectRules, kDialects.size()> kRules{
    DialectRules{Dialect::fanuc,
                 "IJK",
                 "I J K",
                 "switch it on with G43.4 or G43.5",
                 kFanucDwell,
                 "give P in milliseconds, or X in seconds",
                 false,
                 false,
                 false,
                 false,
                 LetterSet("FST"),
                 kFanucLetters,
                 "A B C F G H I J K L M N O P Q R S T U X Y Z",
                 {.locals = 33, .unset_is_vacant = true},
                 {},
                 {},
                 kFanucFiles},
    DialectRules{Dialect::linuxcnc,
                 "abc",
                 "",
                 "",
                 kPlainDwell,
                 "give P in seconds",
                 false,
                 false,
                 true,
                 false,
                 LetterSet("FST"),
                 kLinuxcncLetters,
                 "A B C F G H I J K L M N O P Q R S T X Y Z",
                 {.locals = 30, .named_locals = true, .unset_is_zero = true},
                 {false, true, true, true},
                 LetterSet("pq"),
                 kLinuxcncFiles},
    DialectRules{Dialect::sinumerik, "abc", "A3= B3= C3=", "switch it on with TRAORI",
                 kSinumerikDwell, "give F in seconds, or S in revolutions", true, true, false,
                 false, LetterSet("FSTD"), kSinumerikLetters,
                 "A B C D F G I J K M N R S T X Y Z A3 B3 C3 CR TURN"},
    DialectRules{Dialect::heidenhain, "abc", "TX TY TZ", "switch it on with M128", kPlainDwell,
                 "give the time in seconds", true, false, false, true, LetterSet("FST"),
                 kHeidenhainLetters, "X Y Z A B C F FT M R"},
    DialectRules{Dialect::cldata, "abc", "i, j, k", "switch it on with MULTAX/ON", kCldataDwell,
                 "write DELAY/seconds or DELAY/n,REV", true, false, true, false, LetterSet("FST"),
                 kCldataLetters, ""}};

}  // namespace

const DialectRules& rules_of(Dialect dialect) {
  return kRules.at(static_cast<std::size_t>(dialect));
}

std::string_view letter_use(const DialectRules& rules, char letter) {
  for (const LetterUse& use : rules.letters) {
    if (use.letter == letter) return use.use;
  }
  return {};
}

}  // namespace frustum::parser
