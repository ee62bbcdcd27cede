#include "dynamics/response_units.hpp"

#include <array>
#include <cctype>
#include <string>

#include "dynamics/inertial_load.hpp"

namespace frustum::dynamics {
namespace {

// Types of data of a universal file.
enum : int {
  kUnknown = 0,
  kGeneral = 1,
  kDisplacement = 8,
  kForce = 13,
  kVelocity = 11,
  kAcceleration = 12,
  kExcitation = 9
};

struct NamedUnit {
  std::string_view name;
  MotionUnit unit;
};
constexpr std::array<NamedUnit, 14> kMotions{{{"m", {0, 1.0}},
                                              {"mm", {0, 1e-3}},
                                              {"um", {0, 1e-6}},
                                              {"nm", {0, 1e-9}},
                                              {"m/s", {1, 1.0}},
                                              {"mm/s", {1, 1e-3}},
                                              {"um/s", {1, 1e-6}},
                                              {"m/s2", {2, 1.0}},
                                              {"m/s/s", {2, 1.0}},
                                              {"mm/s2", {2, 1e-3}},
                                              {"mm/s/s", {2, 1e-3}},
                                              {"um/s2", {2, 1e-6}},
                                              {"g", {2, kGravity}},
                                              {"gn", {2, kGravity}}}};
struct NamedForce {
  std::string_view name;
  double newton;
};
constexpr std::array<NamedForce, 4> kForces{
    {{"n", 1.0}, {"kn", 1e3}, {"mn", 1e-3}, {"newton", 1.0}}};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

// "m/s^2", "(m/s²)/N", "(1/N)*(m/s^2)": all are "m/s2".
std::string plain(std::string_view label) {
  std::string text;
  for (const char c : label) {
    if (c == ' ' || c == '(' || c == ')' || c == '^') continue;
    text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  replace_all(text, "**", "");
  replace_all(text, "\xc2\xb2", "2");  // a raised 2 in UTF-8, then in Latin-1
  replace_all(text, "\xb2", "2");
  replace_all(text, "\xc2\xb5", "u");
  replace_all(text, "\xb5", "u");
  if (text == "none") return {};
  if (text.starts_with("1/n*")) text.erase(0, 4);
  if (text.ends_with("/n")) text.erase(text.size() - 2);
  return text;
}

std::optional<int> order_of(int type) {
  if (type == kDisplacement) return 0;
  if (type == kVelocity) return 1;
  if (type == kAcceleration) return 2;
  return std::nullopt;
}

}  // namespace

std::optional<MotionUnit> motion_unit(int type, std::string_view label, double unlabelled) {
  const std::optional<int> order = order_of(type);
  if (!order && type != kUnknown && type != kGeneral) return std::nullopt;
  const std::string name = plain(label);
  if (name.empty()) return order ? std::optional(MotionUnit{*order, unlabelled}) : std::nullopt;
  for (const NamedUnit& known : kMotions) {
    if (known.name != name) continue;
    return order && *order != known.unit.order ? std::nullopt : std::optional(known.unit);
  }
  return std::nullopt;
}

std::optional<double> force_unit(int type, std::string_view label, double unlabelled) {
  if (type != kForce && type != kExcitation && type != kUnknown && type != kGeneral) {
    return std::nullopt;
  }
  const std::string name = plain(label);
  if (name.empty()) return unlabelled;
  for (const NamedForce& known : kForces) {
    if (known.name == name) return known.newton;
  }
  return std::nullopt;
}

}  // namespace frustum::dynamics
