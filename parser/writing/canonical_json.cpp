#include "parser/writing/canonical_json.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>
#include <variant>

#include "core/units.hpp"

namespace frustum::parser {
namespace {

using Json = nlohmann::ordered_json;

// In the order of Command.
constexpr std::array kTypes{"traverse",
                            "home",
                            "feed",
                            "arc",
                            "probe",
                            "dwell",
                            "tool_change",
                            "compensation",
                            "work_offset",
                            "work_offset_setting",
                            "orientation_path",
                            "rotary_path",
                            "tilted_plane",
                            "align_to_plane",
                            "spindle",
                            "coolant",
                            "stop",
                            "event"};
static_assert(kTypes.size() == std::variant_size_v<Command>);

constexpr std::array kPlanes{"XY", "ZX", "YZ"};
constexpr std::array kDirections{"off", "clockwise", "counterclockwise"};
constexpr std::array kLengthModes{"off", "length", "tool_centre_point"};
constexpr std::array kFeedModes{"per_minute", "inverse_time", "per_revolution"};
constexpr std::array kOrientationPaths{"rotary_axes", "great_circle"};
constexpr std::array kRotaryPaths{"as_programmed", "shortest", "positive", "negative"};
constexpr std::array kStopKinds{"program_stop", "optional_stop", "program_end"};
constexpr std::array kEventGrades{"known", "builder", "assumed"};

template <typename Names, typename Enum>
const char* name_in(const Names& names, Enum value) {
  return names.at(static_cast<std::size_t>(value));
}

// The shortest number of degrees that is the same angle in radians: 30, not 29.999999999999996.
double degrees_of(double radians) {
  const double degrees = radians * kDegPerRad;
  const double rounded = std::strtod(fmt::format("{:.15g}", degrees).c_str(), nullptr);
  return rounded * kRadPerDeg == radians ? rounded : degrees;
}

// Turned frames leave -0 behind, which means no more than 0.
double plain(double value) { return value + 0.0; }

Json json_of(const Vec3& vector) {
  return Json::array({plain(vector.x()), plain(vector.y()), plain(vector.z())});
}

Json json_of(const AxisTarget& target) {
  Json json = Json::object();
  for (const AxisLetter axis : kAxisLetters) {
    if (!target[axis]) continue;
    json[std::string(1, to_char(axis))] =
        plain(is_rotary(axis) ? degrees_of(*target[axis]) : *target[axis]);
  }
  return json;
}

void add_tool_axis(Json& json, const std::optional<UnitVec3>& tool_axis) {
  if (tool_axis) json["tool_axis"] = json_of(tool_axis->vec());
}
void add_coordinates(Json& json, Coordinates coordinates) {
  if (coordinates == Coordinates::machine) json["coordinates"] = "machine";
}
void add_feed(Json& json, const Feed& feed) {
  json["feed"] = feed.value;
  if (feed.mode != FeedMode::per_minute) json["feed_mode"] = name_in(kFeedModes, feed.mode);
  if (feed.synchronised) json["synchronised"] = true;
}

// One overload a command: writes what belongs to it.
void add(Json& json, const Traverse& traverse) {
  json["end"] = json_of(traverse.end);
  add_tool_axis(json, traverse.tool_axis);
  add_coordinates(json, traverse.coordinates);
}
void add(Json& json, const HomeReturn& home) {
  json["axes"] = Json::array();
  for (const AxisLetter axis : kAxisLetters) {
    if (home.axes.at(static_cast<std::size_t>(axis)))
      json["axes"].push_back(std::string(1, to_char(axis)));
  }
  if (home.point != 1) json["point"] = home.point;
}
void add(Json& json, const LinearFeed& feed) {
  json["end"] = json_of(feed.end);
  add_tool_axis(json, feed.tool_axis);
  add_coordinates(json, feed.coordinates);
  add_feed(json, feed.feed);
}
void add(Json& json, const ArcFeed& arc) {
  json["end"] = json_of(arc.end);
  json["center"] = json_of(arc.center);
  json["plane"] = name_in(kPlanes, arc.plane);
  json["turns"] = arc.turns;
  add_tool_axis(json, arc.tool_axis);
  add_feed(json, arc.feed);
}
void add(Json& json, const Probe& probe) {
  json["end"] = json_of(probe.end);
  json["away"] = probe.away;
  json["must_meet"] = probe.must_meet;
  add_tool_axis(json, probe.tool_axis);
  add_feed(json, probe.feed);
}
void add(Json& json, const Dwell& dwell) { json["seconds"] = dwell.seconds; }
void add(Json& json, const ToolChange& change) { json["tool"] = change.tool; }
void add(Json& json, const CompensationChange& change) {
  json["mode"] = name_in(kLengthModes, change.mode);
  json["tool_vectors"] = change.tool_vectors;
  json["offset"] = change.offset_number;
  if (change.length) json["length"] = *change.length;
  if (change.negative) json["negative"] = true;
}
void add(Json& json, const WorkOffsetChange& change) { json["number"] = change.number; }
void add(Json& json, const WorkOffsetSetting& setting) {
  json["number"] = setting.number;
  json["origin"] = Json::object();
  for (std::size_t i = 0; i < setting.origin.size(); ++i) {
    const auto& value = setting.origin.at(i);
    if (value) json["origin"][std::string(1, to_char(kAxisLetters.at(i)))] = *value;
  }
}
void add(Json& json, const OrientationPathChange& change) {
  json["path"] = name_in(kOrientationPaths, change.path);
}
void add(Json& json, const RotaryPathChange& change) {
  json["path"] = name_in(kRotaryPaths, change.path);
  if (change.axes == RotaryPathChange{}.axes) return;
  json["axes"] = Json::array();
  for (std::size_t i = 0; i < change.axes.size(); ++i) {
    if (change.axes.at(i)) json["axes"].push_back(std::string(1, "ABC"[i]));
  }
}
void add(Json& json, const TiltedPlaneChange& change) {
  if (!change.program_from_plane) return;
  const Pose& plane = *change.program_from_plane;
  json["origin"] = json_of(plane.translation);
  json["x"] = json_of(plane.rotation.col(0));
  json["z"] = json_of(plane.rotation.col(2));
}
void add(Json& /*json*/, const AlignToPlane& /*align*/) {}
void add(Json& json, const SpindleChange& change) {
  json["direction"] = name_in(kDirections, change.direction);
  json["speed"] = change.speed;
}
void add(Json& json, const CoolantChange& change) { json["flood"] = change.flood; }
void add(Json& json, const Stop& stop) { json["kind"] = name_in(kStopKinds, stop.kind); }
void add(Json& json, const Event& event) {
  json["name"] = event.name;
  json["text"] = event.text;
  if (event.grade != EventGrade::known) json["grade"] = name_in(kEventGrades, event.grade);
}

}  // namespace

std::string_view type_of(const Command& command) { return kTypes.at(command.index()); }

std::string to_json_line(const Motion& motion) {
  Json json;
  json["line"] = motion.place.line;
  if (motion.place.file) json["file"] = *motion.place.file;
  json["type"] = type_of(motion.command);
  std::visit([&json](const auto& command) { add(json, command); }, motion.command);
  // An event's text may come from elsewhere than a program, so bytes that are no text are replaced.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string to_json_line(const Diagnostic& error) {
  const Json json{{"line", error.line}, {"column", error.column}, {"file", error.file},
                  {"type", "error"},    {"id", error.id.text()},  {"message", error.message},
                  {"hint", error.hint}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace frustum::parser
