#include "cutter/body/cutter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cutter/body/run_out_envelope.hpp"

namespace frustum::cutter {
namespace {

using Chain = std::vector<GeneratrixSegment>;

bool finite(const std::vector<CutterRow>& rows) {
  for (const CutterRow& row : rows) {
    for (const double value : row) {
      if (!std::isfinite(value)) return false;
    }
  }
  return true;
}

constexpr double kLargest = 1e6;  // mm

// Every number of the spec is a number, and not negative where that means nothing.
std::optional<Diagnostic> wrong_number(const CutterSpec& spec, std::span<const CutterKey> keys) {
  for (const CutterKey& key : keys) {
    double value = 0.0;
    if (const auto* length = std::get_if<Mm CutterSpec::*>(&key.value)) {
      value = (spec.**length).value;
    } else if (const auto* angle = std::get_if<Rad CutterSpec::*>(&key.value)) {
      value = (spec.**angle).value;
    } else if (!finite(spec.*std::get<std::vector<CutterRow> CutterSpec::*>(key.value))) {
      value = NAN;
    }
    if (!std::isfinite(value)) {
      return error("cutter-size"_id, fmt::format("tool {} is not a number", key.name),
                   "give mm or degrees");
    }
    if (std::abs(value) > kLargest) {
      return error("cutter-size"_id, fmt::format("tool {} {:g} mm", key.name, value),
                   "no tool is that large");
    }
    const bool empty = key.required && value == 0.0 && key.value.index() == 0;
    if (empty || (value < 0.0 && key.bound != Bound::any)) {
      return error("cutter-size"_id, fmt::format("tool {} {} mm", key.name, value),
                   key.name == "length" ? "give the length from the spindle gauge point to the tip"
                   : key.required       ? "it must be above 0"
                                        : "it must not be negative");
    }
  }
  return std::nullopt;
}

bool has_diameter(const CutterTypeRow& row) {
  return std::get_if<Mm CutterSpec::*>(&row.keys.front().value) != nullptr;
}

// The generatrix that cuts: the type's own, larger by the radius error, off the spindle axis by the
// run-out.
Result<Chain> real_generatrix(const CutterSpec& spec) {
  const CutterTypeRow& row = type_row(spec.type);
  CutterSpec larger = spec;
  larger.diameter = larger.diameter + 2.0 * spec.radius_error;
  if (has_diameter(row) && !(larger.diameter.value > 0.0)) {
    return error("cutter-radius-error"_id,
                 fmt::format("radius error {} mm leaves no tool of diameter {} mm",
                             spec.radius_error.value, spec.diameter.value),
                 "the error must be smaller than the radius");
  }
  auto nominal = row.generatrix(larger);
  if (!nominal) return nominal.error();
  // Judged before it is moved: what is wrong with it must be reported in its own numbers.
  if (auto made = Generatrix::make(*nominal); !made) return made.error();
  const Chain chain = has_diameter(row) ? *nominal : widened(*nominal, spec.radius_error.value);
  const double at_tip = spec.run_out.value + spec.run_out_tilt.value * spec.length.value;
  return with_run_out(chain, at_tip, spec.run_out_tilt.value);
}

double height_of(const std::vector<CutterRow>& holder) {
  double height = 0.0;
  for (const CutterRow& row : holder) height += row[0];
  return height;
}

// A stack of cones on `bottom`, drawn from its axis.
class Stack {
 public:
  explicit Stack(double bottom) : bottom_(bottom), at_{0.0, bottom} {}
  void widen(double radius) { go({radius, at_.z}); }
  void rise(double radius, double z) { go({radius, z}); }
  [[nodiscard]] Result<Body> body() const {
    return Generatrix::make(chain_, bottom_).transform([](Generatrix o) {
      return Body(std::move(o));
    });
  }
  [[nodiscard]] double height() const { return at_.z; }

 private:
  void go(MeridianPoint to) {
    if (to.r != at_.r || to.z != at_.z) chain_.push_back(line(at_, to));
    at_ = to;
  }
  double bottom_;
  MeridianPoint at_;
  std::vector<GeneratrixSegment> chain_;
};

// Radius of the shank of a tool that states neither shank nor neck; 0: none. It is that of the
// cutter where its flutes end, less a relief, so that it does not touch the wall that the flutes
// have cut before on a machine whose errors are of that size.
double unstated_shank(const CutterSpec& spec, double flutes_end_radius) {
  constexpr double kRelief = 0.05;  // mm
  // The neck of a T-slot cutter is slimmer than its disc, and only its maker knows by how much.
  if (spec.flute_length.value <= 0.0 || spec.type == CutterType::t_slot) return 0.0;
  return std::max(0.0, flutes_end_radius - kRelief);
}

// `unstated` is the radius where the spec states neither shank nor neck.
Result<Body> shank_body(const CutterSpec& spec, double flutes_end, double top, double unstated) {
  const double neck = 0.5 * spec.neck_diameter.value;
  const double stated = spec.shank_diameter.value > 0.0 ? 0.5 * spec.shank_diameter.value : neck;
  const double shank = stated > 0.0 ? stated : unstated;
  Stack stack(flutes_end);
  if (neck > 0.0) {
    const double rest = top - flutes_end;
    const double length = spec.neck_length.value > 0.0 ? spec.neck_length.value : rest;
    const double slope = std::tan(spec.neck_angle.value);
    const double cone = slope > 0.0 ? (shank - neck) / slope : 0.0;
    if (cone < 0.0 || length + cone > rest * (1.0 + 1e-12)) {
      return error(
          "cutter-shank"_id,
          fmt::format("a neck of {:.6g} mm above the flutes where {:.6g} mm are free",
                      length + cone, rest),
          "neck_length and the cone of neck_angle end below the holder; the shank is wider");
    }
    stack.widen(neck);
    stack.rise(neck, flutes_end + std::min(length, rest));
    if (cone > 0.0) stack.rise(shank, std::min(stack.height() + cone, top));
  }
  if (stack.height() < top) {
    stack.widen(shank);
    stack.rise(shank, top);
  }
  return stack.body();
}

Result<Body> holder_body(const CutterSpec& spec, double bottom) {
  Stack stack(bottom);
  for (const auto& [height, lower, upper] : spec.holder) {
    if (!(height > 0.0 && lower > 0.0 && upper > 0.0)) {
      return error("cutter-holder"_id, fmt::format("holder row [{}, {}, {}]", height, lower, upper),
                   "height, lower diameter and upper diameter in mm, all above 0");
    }
    stack.widen(0.5 * lower);
    stack.rise(0.5 * upper, stack.height() + height);
  }
  return stack.body();
}

// Twice what the largest tools of the largest machines have: wider ones are slips, which would
// reach all of a part in every block.
std::optional<Diagnostic> too_large(const Cutter& cutter) {
  static constexpr double kWidest = 1000.0, kLongest = 10'000.0;  // mm
  if (const double length = cutter.spec().length.value; length > kLongest) {
    return error("cutter-size"_id, fmt::format("the tool is {:g} mm long", length),
                 fmt::format("at most {:g} mm", kLongest));
  }
  const auto too_wide = [](const char* what, const Body& body) {
    return error("cutter-size"_id,
                 fmt::format("the {} is {:g} mm wide", what, 2.0 * body.max_radius()),
                 fmt::format("at most {:g} mm", kWidest));
  };
  const auto is_wide = [](const Body& body) { return 2.0 * body.max_radius() > kWidest; };
  if (is_wide(cutter.body())) return too_wide("cutter", cutter.body());
  if (cutter.shank() && is_wide(*cutter.shank())) return too_wide("shank", *cutter.shank());
  if (cutter.holder() && is_wide(*cutter.holder())) return too_wide("holder", *cutter.holder());
  return std::nullopt;
}

}  // namespace

Result<Cutter> Cutter::make(const CutterSpec& spec) {
  const CutterTypeRow& row = type_row(spec.type);
  if (auto wrong = wrong_number(spec, row.keys)) return *std::move(wrong);
  if (auto wrong = wrong_number(spec, common_keys())) return *std::move(wrong);
  if (spec.flute_length.value > spec.length.value) {
    return error("cutter-flute-length"_id,
                 fmt::format("flute length {} mm exceeds the tool length {} mm",
                             spec.flute_length.value, spec.length.value),
                 "the flutes end below the gauge point");
  }
  if (std::abs(spec.length_error.value) >= spec.length.value) {
    return error("cutter-length-error"_id,
                 fmt::format("length_error {} mm on a tool of {} mm", spec.length_error.value,
                             spec.length.value),
                 "an error of a tool's length is a small part of it");
  }
  auto chain = real_generatrix(spec);
  if (!chain) return chain.error();
  auto generatrix = Generatrix::make(*std::move(chain));
  if (!generatrix) return generatrix.error();
  const double unstated = unstated_shank(spec, generatrix->segments().back().to.r);
  Cutter cutter(spec, Body(*std::move(generatrix)));

  const double flutes_end = cutter.body_.height();
  const double holder_bottom = spec.length.value - height_of(spec.holder);
  const double shortest = 1e-6;  // mm: below it there is no room and no body
  if (flutes_end > spec.length.value + shortest) {
    return error("cutter-flute-length"_id,
                 fmt::format("the cutting part is {:.6g} mm high, the tool {} mm long", flutes_end,
                             spec.length.value),
                 "the flutes end below the gauge point");
  }
  if (!spec.holder.empty() && holder_bottom < flutes_end - shortest) {
    return error(
        "cutter-flute-length"_id,
        fmt::format("a holder of {:.6g} mm on a tool of {} mm with {:.6g} mm of flutes",
                    height_of(spec.holder), spec.length.value, flutes_end),
        "the holder reaches from the gauge point down to above the flutes; state flute_length");
  }
  const bool has_shank =
      spec.shank_diameter.value > 0.0 || spec.neck_diameter.value > 0.0 || unstated > 0.0;
  if (has_shank && holder_bottom > flutes_end + shortest) {
    auto shank = shank_body(spec, flutes_end, holder_bottom, unstated);
    if (!shank) return shank.error();
    cutter.shank_ = *std::move(shank);
  }
  if (!spec.holder.empty()) {
    auto holder = holder_body(spec, holder_bottom);
    if (!holder) return holder.error();
    cutter.holder_ = *std::move(holder);
  }
  if (auto wrong = too_large(cutter)) return *std::move(wrong);
  return cutter;
}

}  // namespace frustum::cutter
