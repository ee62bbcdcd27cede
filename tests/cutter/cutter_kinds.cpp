#include "tests/cutter/cutter_kinds.hpp"

#include <cstdlib>

namespace frustum::proof {
namespace {

using cutter::Cutter;
using cutter::CutterSpec;
using cutter::CutterType;

Kind kind(const std::string& name, const CutterSpec& spec, Meridian meridian,
          bool is_convex = true) {
  auto made = Cutter::make(spec);
  if (!made) std::abort();
  return {name, *std::move(made), std::move(meridian), is_convex};
}

std::vector<Kind> make_all() {
  return {
      kind("flat",
           {.type = CutterType::flat, .diameter = {12.0}, .length = {80.0}, .flute_length = {30.0}},
           Meridian().line_to(6, 0).line_to(6, 30)),
      kind("ball",
           {.type = CutterType::ball, .diameter = {10.0}, .length = {80.0}, .flute_length = {25.0}},
           Meridian().arc_to(5, 5, 0, 5).line_to(5, 25)),
  };
}

}  // namespace

const std::vector<Kind>& cutter_kinds() {
  static const std::vector<Kind> all = make_all();
  return all;
}

const Kind& kind_named(const std::string& name) {
  for (const Kind& each : cutter_kinds()) {
    if (each.name == name) return each;
  }
  std::abort();
}

}  // namespace frustum::proof
