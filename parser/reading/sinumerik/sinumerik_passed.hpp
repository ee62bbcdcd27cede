// Words of Sinumerik that change nothing which is simulated, by how they are written: SPOS=30,
// ACC[X]=50, FGROUP(X,Y), WAITP(X).
//
// Units : none
// Errors: none
// Source: SINUMERIK 840D sl, Programming Manuals Fundamentals and Job Planning: lists of statements
//         and predefined procedures
#pragma once

#include <array>
#include <string_view>

namespace frustum::parser {

// With a value: SPOS=30, ACC[X]=50.
inline constexpr std::array<const char*, 46> kPassedSettings{
    "SPOS",    "SPOSA",    "ADIS",     "ADISPOS", "LIMS",   "OVR",     "OVRRAP",  "ACC",
    "CTOL",    "OTOL",     "STOLF",    "ATOL",    "FD",     "JERKLIM", "VELOLIM", "FGREF",
    "ACCLIMA", "OVRA",     "SCC",      "FL",      "FPR",    "TOLFRC",  "CUTMOD",  "STAT",
    "TU",      "VELOLIMA", "JERKLIMA", "FDA",     "SCPARA", "FXST",    "FXSW",    "FA",
    "FP",      "CTOLG0",   "OTOLG0",   "COARSEA", "FINEA",  "IPOENDA", "IPOBRKA", "ADISPOSA",
    "FMA",     "DITS",     "DITE",     "SUG",     "ORIS",   "DIAMOFA"};

// Where to an interruption of the program lifts the tool.
inline constexpr std::array<const char*, 6> kLiftWords{"POLFA",    "POLF", "POLFMASK",
                                                       "POLFMLIN", "DILF", "ALF"};

// Settings that change nothing at zero, where they are switched off or what they are anyway.
inline constexpr std::array<const char*, 12> kIdleAtZero{
    "OFFN", "DL", "TOFF", "TOFFL", "TOFFR", "TOFFLR", "DISC", "TCARR", "FXS", "ISD", "SPN", "SPP"};

// Statements that take anything in brackets.
inline constexpr std::array<const char*, 109> kPassedProcedures{
    "CYCLE832",  "WORKPIECE",  "FGROUP",     "GROUP_BEGIN", "GROUP_END", "SETMS",      "WAITM",
    "WAITE",     "WAITMC",     "SETM",       "CLEARM",      "INIT",      "START",      "SETPIECE",
    "CYCLE_HSC", "STOPREOF",   "FCTDEF",     "SYNFCT",      "CANCEL",    "WRITE",      "DELETE",
    "ISFILE",    "SETAL",      "TMON",       "GETSELT",     "SPCON",     "SPCOF",      "NEWCONF",
    "SETINT",    "DISABLE",    "ENABLE",     "LOCK",        "UNLOCK",    "CLRINT",     "STOPRE",
    "WAITS",     "GET",        "GETD",       "RELEASE",     "AXTOCHAN",  "WAITP",      "WAITC",
    "WAITENC",   "SPLINEPATH", "JERKA",      "SOFTA",       "BRISKA",    "DRIVEA",     "FPRAON",
    "FPRAOF",    "DRFOF",      "CORROF",     "TOFFOF",      "MASLDEF",   "MASLDEL",    "MASLON",
    "MASLOF",    "MASLOFS",    "TANG",       "TANGDEL",     "TANGOF",    "TLIFT",      "TRAILOF",
    "LEADOF",    "COUPDEF",    "COUPDEL",    "COUPOF",      "COUPOFS",   "COUPRES",    "EGDEF",
    "EGOFS",     "EGOFC",      "EGDEL",      "CTABDEL",     "CTABLOCK",  "CTABUNLOCK", "CPROT",
    "NPROT",     "PROTA",      "PROTS",      "PROTD",       "COLLPAIR",  "GWPSOF",     "TMOF",
    "IPTRLOCK",  "IPTRUNLOCK", "BLSYNC",     "CALLPATH",    "CHANDATA",  "MMC",        "WRTPR",
    "EXTOPEN",   "EXTWRITE",   "EXTCLOSE",   "MVTOOL",      "POSM",      "SETMTH",     "SETTA",
    "TCI",       "SETTIA",     "RESETTIA",   "RESETMON",    "DELDL",     "DELT",       "DELTC",
    "DZERO",     "TOOLENV",    "DELTOOLENV", "PUNCHACC"};

// Those that may do without brackets.
inline constexpr std::array<std::string_view, 26> kBareProcedures{
    "SETMS",  "FGROUP", "SPCON", "SPCOF",    "STOPREOF",   "NEWCONF", "STOPRE",
    "DRFOF",  "EGOFS",  "JERKA", "FPRAOF",   "TANGOF",     "TRAILOF", "LEADOF",
    "COUPOF", "GWPSOF", "TMOF",  "IPTRLOCK", "IPTRUNLOCK", "DZERO",   "CALLPATH",
    "PROTS",  "PROTD",  "PROTA", "SETMTH",   "RESETMON"};

}  // namespace frustum::parser
