#include "tests/house/rooms.hpp"

#include "tests/house/source_tree.hpp"

namespace frustum::house {

const std::map<std::string, Room>& rooms() {
  static const std::map<std::string, Room> kRooms{
      {"core", {1}},
      {"parser",
       {2,
        {"language", "dialects", "reading", "interpret/state", "interpret/frames",
         "interpret/moves", "interpret/cycles", "interpret/filters", "writing"}}},
      {"metrology", {2, {"fit", "points", "plan", "probing", "characteristic", "uncertainty"}}},
      {"kinematics", {3, {"model", "errors", "controller", "timing", "path"}}},
      {"dynamics", {4}},
      {"instruments", {4, {"traces"}}},
      {"post", {4, {"planning", "comparing"}}},
      {"lint", {4}},
      {"cutter", {4, {"body", "sweep", "search"}}},
      {"stock", {5, {"solid", "dexel", "mesh", "collision", "proof", "polyhedral", "step"}}},
      {"programs", {6, {"milling", "cone", "step", "contour", "s_piece", "surface", "motion"}}},
      {"report", {6, {"html", "chart", "picture", "page", "player", "exchange", "sheet"}}},
      {"trials", {7, {"population"}}},
      {"calibration", {8, {"identify", "design", "compensate", "history"}}},
      {"studies", {8, {"laws", "statistics", "engine", "samples", "answers"}}},
      {"app",
       {9,
        {"job", "player", "dynamics", "benchmark", "view", "motion", "study", "serve", "history",
         "command"}}},
      {"python", {.floor = 10, .is_library = false}},
  };
  return kRooms;
}

const std::vector<UpwardArrow>& upward_arrows() {
  static const std::vector<UpwardArrow> kArrows{};
  return kArrows;
}

std::string room_of(const std::string& path) { return path.substr(0, path.find('/')); }

std::string folder_of(const std::string& path) {
  const auto first = path.find('/');
  const auto last = path.rfind('/');
  return first == last ? "" : path.substr(first + 1, last - first - 1);
}

std::vector<std::string> sources_of(const std::string& room) {
  return files_of(room, {".cpp", ".hpp"});
}

std::vector<std::string> sources_of_all_rooms() {
  std::vector<std::string> files;
  for (const auto& [room, plan] : rooms()) {
    for (std::string& file : sources_of(room)) files.push_back(std::move(file));
  }
  return files;
}

}  // namespace frustum::house
