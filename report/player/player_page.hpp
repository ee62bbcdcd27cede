// One page that plays a program on the machine: bodies, tool, path and the workpiece in steps.
//
// Model : the machine is a bed with two chains of joints, as kinematics/model/joint_motion.hpp
//         moves them without errors; the page computes their frames from the axis positions of each
//         point. Tool, path and workpiece are in the workpiece frame, where a point of the path is
//         the error-free tip and its deviation
// Units : mm, rad, s
// Errors: none; texts are escaped here
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/pose.hpp"

namespace frustum::report {

struct PlayerJoint {
  char letter = 'X';
  bool rotary = false;
  int side = +1;  // +1 tool side, -1 workpiece side
  Vec3 direction = Vec3::UnitX();
  Vec3 offset = Vec3::Zero();
};

struct PlayerBox {
  Vec3 size = Vec3::Zero();  // the origin is the centre of its bottom
};
// A body of revolution about Z: radius and height along its meridian, from the axis to the axis.
struct PlayerTurned {
  std::vector<std::array<double, 2>> meridian{};
};
struct PlayerMesh {
  std::vector<std::array<float, 3>> vertices{};
  std::vector<std::array<std::uint32_t, 3>> triangles{};
};
using PlayerShape = std::variant<PlayerBox, PlayerTurned, PlayerMesh>;

// On the part of the machine after the first `joints` of a side; side 0: the bed.
struct PlayerBody {
  std::string name{};
  bool is_fixture = false;
  int side = 0;
  std::size_t joints = 0;
  Pose part_from_body{};
  PlayerShape shape{};
};

struct PlayerTool {
  int number = 0;
  std::string title{};
  double length = 0.0;  // as measured, without its error
  // "cutter", "shank" and "holder", in the frame of the tip.
  std::vector<std::pair<std::string, PlayerTurned>> bodies{};
};

struct PlayerBlock {
  std::uint32_t line = 0;
  std::uint32_t text = 0;  // index into PlayerPage::texts
  bool is_rapid = false;
  int tool = 0;
  double feed = 0.0;  // mm/min as programmed; 0: none
};

struct PlayerPoint {
  double time = 0.0;
  Vec3 tip = Vec3::Zero();  // without errors
  Vec3 deviation = Vec3::Zero();
  double feed = 0.0;           // mm/min, of the tip on the motion that ends here
  std::vector<double> axes{};  // in the order of the joints: tool side, then workpiece side
  std::uint32_t block = 0;     // whose motion ends here; of the first point, that which begins
  bool starts = false;         // no path leads here from the point before
};

// The workpiece after the path up to a time.
struct PlayerStep {
  double time = 0.0;
  PlayerMesh mesh{};
};

struct PlayerText {
  std::string name{};
  std::string text{};
};

struct PlayerPage {
  std::string title{};
  std::vector<std::pair<std::string, std::string>> facts{};
  std::vector<std::string> notes{};
  std::string deviation{};  // what a deviation is, as a sentence
  std::vector<PlayerJoint> joints{};
  Vec3 spindle_offset = Vec3::Zero();  // from the last joint of the tool side
  Vec3 table_offset = Vec3::Zero();
  Pose table_from_workpiece{};
  std::vector<PlayerBody> bodies{};
  std::vector<PlayerTool> tools{};
  std::vector<PlayerBlock> blocks{};
  std::vector<PlayerPoint> points{};
  std::vector<PlayerStep> steps{};
  std::vector<PlayerText> texts{};  // the main program first
};

[[nodiscard]] std::string player_html(const PlayerPage& page);

}  // namespace frustum::report
