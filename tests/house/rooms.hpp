// The plan of the house as data: rooms with their floors, folders in their order, and the arrows
// that do not hold.
//
// Units : floors count from 1, the ground floor
// Errors: none
#pragma once

#include <map>
#include <string>
#include <vector>

namespace frustum::house {

struct Room {
  int floor = 0;
  std::vector<std::string> folders{};  // in their order; empty: the room is flat
  bool is_library = true;              // whose headers are installed
};

[[nodiscard]] const std::map<std::string, Room>& rooms();

// "kinematics" of "kinematics/model/chain.hpp"
[[nodiscard]] std::string room_of(const std::string& path);
// "model" of "kinematics/model/chain.hpp", "" of "core/pose.hpp"
[[nodiscard]] std::string folder_of(const std::string& path);

// Sources and headers of a room, or of all rooms.
[[nodiscard]] std::vector<std::string> sources_of(const std::string& room);
[[nodiscard]] std::vector<std::string> sources_of_all_rooms();

// An include that goes up within a room, and why it is there.
struct UpwardArrow {
  std::string from;  // "cutter/sweep", or one file "cutter/sweep/segment_sweep.hpp"
  std::string to;
  std::string why;
};

[[nodiscard]] const std::vector<UpwardArrow>& upward_arrows();

}  // namespace frustum::house
