#include "parser/reading/sinumerik/sinumerik_cycle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "parser/dialects/code_table.hpp"
#include "parser/reading/sinumerik/sinumerik_values.hpp"

namespace frustum::parser {
namespace {

using CycleParameter = CycleParameter;
constexpr CycleParameter kBack{'z', "RTP="};
constexpr CycleParameter kReference{'V', "RFP="};
constexpr CycleParameter kClearance{'u', "SDIS="};
constexpr CycleParameter kDepth{'Z', "DP="};
constexpr CycleParameter kRelativeDepth{'d', "DPR="};
constexpr CycleParameter kDwell{'P', "DTB="};
constexpr CycleParameter kDirection{'e', "SDIR="};
constexpr CycleParameter kAxis{'x', "_AXN="};
constexpr CycleParameter kGeometry{'g', "_GMODE="};
constexpr CycleParameter kDisplay{'h', "_DMODE="};
constexpr CycleParameter kAlternative{'i', "_AMODE="};

// In the order of the call.
constexpr std::array kOfDrilling{kBack,  kReference, kClearance, kDepth,      kRelativeDepth,
                                 kDwell, kGeometry,  kDisplay,   kAlternative};
constexpr std::array kOfPecking{kBack,
                                kReference,
                                kClearance,
                                kDepth,
                                kRelativeDepth,
                                CycleParameter{'K', "FDEP="},
                                CycleParameter{'Q', "FDPR="},
                                CycleParameter{'r', "DAM="},
                                kDwell,
                                CycleParameter{'W', "DTS="},
                                CycleParameter{'f', "FRF="},
                                CycleParameter{'e', "VARI="},
                                kAxis,
                                CycleParameter{'m', "_MDEP="},
                                CycleParameter{'v', "_VRT="},
                                CycleParameter{'t', "_DTD="},
                                CycleParameter{'w', "_DIS1="},
                                kGeometry,
                                kDisplay,
                                kAlternative};
constexpr std::array kOfTapping{kBack,
                                kReference,
                                kClearance,
                                kDepth,
                                kRelativeDepth,
                                kDwell,
                                CycleParameter{'e', "SDAC="},
                                CycleParameter{'m', "MPIT="},
                                CycleParameter{'k', "PIT="},
                                CycleParameter{'E', "POSS="},
                                CycleParameter{'s', "SST="},
                                CycleParameter{'l', "SST1="},
                                kAxis,
                                CycleParameter{'f', "_PTAB="},
                                CycleParameter{'r', "_TECHNO="},
                                CycleParameter{'t', "_VARI="},
                                CycleParameter{'Q', "_DAM="},
                                CycleParameter{'v', "_VRT="}};
constexpr std::array kOfFloatingTap{kBack,
                                    kReference,
                                    kClearance,
                                    kDepth,
                                    kRelativeDepth,
                                    kDwell,
                                    CycleParameter{'s', "SDR="},
                                    CycleParameter{'e', "SDAC="},
                                    CycleParameter{'t', "ENC="},
                                    CycleParameter{'m', "MPIT="},
                                    CycleParameter{'k', "PIT="},
                                    kAxis,
                                    CycleParameter{'f', "_PTAB="},
                                    CycleParameter{'r', "_TECHNO="},
                                    kDisplay,
                                    kAlternative};
constexpr std::array kOfReaming{kBack,
                                kReference,
                                kClearance,
                                kDepth,
                                kRelativeDepth,
                                kDwell,
                                CycleParameter{'f', "FFR="},
                                CycleParameter{'r', "RFF="},
                                kGeometry,
                                kDisplay,
                                kAlternative};
constexpr std::array kOfOrientedBoring{kBack,
                                       kReference,
                                       kClearance,
                                       kDepth,
                                       kRelativeDepth,
                                       kDwell,
                                       kDirection,
                                       CycleParameter{'I', "RPA="},
                                       CycleParameter{'J', "RPO="},
                                       CycleParameter{'K', "RPAP="},
                                       CycleParameter{'E', "POSS="},
                                       kGeometry,
                                       kDisplay,
                                       kAlternative};
constexpr std::array kOfStoppedBoring{kBack,  kReference,     kClearance,
                                      kDepth, kRelativeDepth, kDirection};
constexpr std::array kOfBoring{kBack,          kReference, kClearance, kDepth,
                               kRelativeDepth, kDwell,     kDirection};

constexpr CycleParameter kFirstPlace{'u', "SPCA="};
constexpr CycleParameter kSecondPlace{'v', "SPCO="};
constexpr CycleParameter kStartAngle{'q', "STA1="};
constexpr std::array kOfRow{kFirstPlace,
                            kSecondPlace,
                            kStartAngle,
                            CycleParameter{'f', "FDIS="},
                            CycleParameter{'d', "DBH="},
                            CycleParameter{'k', "NUM="}};
constexpr std::array kOfCircle{CycleParameter{'u', "CPA="},  CycleParameter{'v', "CPO="},
                               CycleParameter{'r', "RAD="},  kStartAngle,
                               CycleParameter{'d', "INDA="}, CycleParameter{'k', "NUM="}};
constexpr std::array kOfGrid{CycleParameter{'u', "_SPCA="}, CycleParameter{'v', "_SPCO="},
                             CycleParameter{'q', "_STA="},  CycleParameter{'f', "_DIS1="},
                             CycleParameter{'d', "_DIS2="}, CycleParameter{'k', "_NUM1="},
                             CycleParameter{'l', "_NUM2="}};

struct Cycle {
  std::string_view name;
  std::span<const CycleParameter> parameters;
};
constexpr std::array kCycles{
    Cycle{"CYCLE81", kOfDrilling},
    Cycle{"CYCLE82", kOfDrilling},
    Cycle{"CYCLE83", kOfPecking},
    Cycle{"CYCLE84", kOfTapping},
    Cycle{"CYCLE840", kOfFloatingTap},
    Cycle{"CYCLE85", kOfReaming},
    Cycle{"CYCLE86", kOfOrientedBoring},
    Cycle{"CYCLE87", kOfStoppedBoring},
    Cycle{"CYCLE88", kOfBoring},
    Cycle{"CYCLE89", kOfDrilling},
    Cycle{"HOLES1", kOfRow},
    Cycle{"HOLES2", kOfCircle},
    Cycle{"CYCLE801", kOfGrid},
};
const Cycle* cycle_of(std::string_view name) {
  const auto* found = std::find_if(kCycles.begin(), kCycles.end(),
                                   [name](const Cycle& cycle) { return cycle.name == name; });
  return found == kCycles.end() ? nullptr : found;
}

}  // namespace

std::span<const CycleParameter> sinumerik_cycle_parameters(std::string_view name) {
  const Cycle* cycle = cycle_of(name);
  return cycle == nullptr ? std::span<const CycleParameter>{} : cycle->parameters;
}

bool is_sinumerik_cycle(std::string_view name) { return cycle_of(name) != nullptr; }

void read_sinumerik_cycle(BlockDraft& draft, const std::string& name, std::uint32_t column) {
  LineScanner& in = draft.in;
  const auto parameters = cycle_of(name)->parameters;
  const auto is_cycle = [](const Word& word) {
    return word.letter == kNamedWord && is_sinumerik_cycle(code_at(word.number).word);
  };
  if (std::any_of(draft.block.words.begin(), draft.block.words.end(), is_cycle)) {
    return in.fail("word-twice"_id, column, name + " beside another cycle", "write two blocks");
  }
  add_code(draft.block, *find_code(Dialect::sinumerik, name), column);
  if (!in.take('(')) {
    in.fail("value-missing"_id, column, name + " has no parameters",
            fmt::format("give them in ( ): {}(RTP, RFP, SDIS, DP)", name));
    return;
  }
  for (std::size_t i = 0; !in.failed(); ++i) {
    if (in.peek() != ',' && in.peek() != ')' && !in.at_end()) {
      if (i >= parameters.size()) {
        in.fail("argument-count"_id, in.column(), name + " has too many parameters",
                fmt::format("{} are simulated", parameters.size()));
        return;
      }
      Word word;
      word.letter = parameters[i].letter;
      word.spelled = parameters[i].spelled;
      word.column = in.column();
      draft.read_value(word, ExpressionLevel::sum);
      draft.block.words.push_back(word);
    }
    if (in.take(')')) return;
    if (in.at_end()) {
      in.fail("bracket-not-closed"_id, column, fmt::format("the bracket of {} is not closed", name),
              "close it with )");
    } else if (!in.take(',')) {
      in.fail_unexpected(fmt::format("separate the parameters of {} by ,", name));
    }
  }
}

void read_sinumerik_modal_call(BlockDraft& draft, std::uint32_t column) {
  LineScanner& in = draft.in;
  add_code(draft.block, *find_code(Dialect::sinumerik, "MCALL"), column);
  const std::string name = in.next_name();
  if (name.empty() ||
      (is_sinumerik_cycle(name) && name.starts_with("CYCLE8") && name != "CYCLE801")) {
    return;
  }
  in.fail("not-supported"_id, column, fmt::format("MCALL {} is not simulated", name),
          "MCALL calls CYCLE81 to CYCLE89; call a program in a block of its own at each place");
}

}  // namespace frustum::parser
