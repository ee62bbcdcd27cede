// Holds the tree against the architecture: a room includes only rooms below it, says so in its
// CMakeLists.txt, and heavy headers stay where they are wanted.
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/house/rooms.hpp"
#include "tests/house/source_tree.hpp"

namespace frustum::house {
namespace {

// The rooms that a room's CMakeLists.txt names: frustum::core, ...
std::set<std::string> stated_rooms(const std::string& room) {
  std::set<std::string> stated;
  const std::string text = text_of(room + "/CMakeLists.txt");
  const std::regex target("frustum::([a-z_]+)");
  for (auto hit = std::sregex_iterator(text.begin(), text.end(), target);
       hit != std::sregex_iterator(); ++hit) {
    const std::string name = (*hit)[1].str();
    if (rooms().contains(name)) stated.insert(name);
  }
  return stated;
}

// A header that only some files may include, and why.
struct Confined {
  std::string what;
  std::regex header;
  std::regex allowed_file;
};

std::vector<Confined> confined_headers() {
  const auto entry = [](const char* what, const char* header, const char* allowed) {
    return Confined{what, std::regex(header), std::regex(allowed)};
  };
  return {
      entry("Boost.Spirit", "boost/(spirit|fusion|phoenix)/.*",
            "parser/reading/rs274/grammar\\.cpp"),
      entry("CGAL", "CGAL/.*", "stock/polyhedral/[a-z0-9_]*\\.cpp"),
      entry("OpenCASCADE", ".*\\.hxx", "stock/step/step_reader\\.cpp|tests/stock/step_.*"),
      entry("OpenMesh", "OpenMesh/.*", ".*\\.cpp|stock/mesh/open_mesh\\.hpp"),
      entry("Embree", "embree[0-9]/.*",
            "stock/solid/box_scene\\.cpp|report/picture/surface_rays\\.cpp"),
      entry("toml++", "toml\\+\\+/.*|toml\\.hpp", "core/toml_(document|edit)\\.cpp"),
      entry("Random123", "Random123/.*", "core/random\\.cpp"),
      entry("CLI11", "CLI/.*", "app/command/command_line\\.cpp|bench/peers/peers\\.cpp"),
      entry("GoogleTest", "(gtest|gmock|rapidcheck).*", "tests/.*"),
  };
}

TEST(Architecture, HasEveryFolder) {
  for (const auto& [room, plan] : rooms()) {
    EXPECT_TRUE(std::filesystem::is_directory(source_dir() / room)) << room << "/ is missing";
  }
  for (const char* folder :
       {"machines", "tests", "bench", "examples", "docs", "scripts", "cmake"}) {
    EXPECT_TRUE(std::filesystem::is_directory(source_dir() / folder)) << folder << "/ is missing";
  }
}

TEST(Architecture, IncludesPointDownTheTower) {
  for (const auto& [room, plan] : rooms()) {
    for (const std::string& file : sources_of(room)) {
      for (const Include& include : includes_of(file)) {
        const auto target = rooms().find(room_of(include.target));
        if (!include.quoted || target == rooms().end() || target->first == room) continue;
        EXPECT_LT(target->second.floor, plan.floor) << file << ":" << include.line << ": " << room
                                                    << "/ may not include " << include.target;
      }
    }
  }
}

TEST(Architecture, ProjectIncludesStartWithARoomAndExist) {
  for (const auto& [room, plan] : rooms()) {
    for (const std::string& file : sources_of(room)) {
      for (const Include& include : includes_of(file)) {
        if (!include.quoted) {
          EXPECT_FALSE(rooms().contains(room_of(include.target)) &&
                       std::filesystem::exists(source_dir() / include.target))
              << file << ":" << include.line << ": write \"" << include.target << "\" in quotes";
          continue;
        }
        EXPECT_TRUE(rooms().contains(room_of(include.target)))
            << file << ":" << include.line << ": write the path from the root: " << include.target;
      }
    }
  }
}

TEST(Architecture, EveryIncludedRoomIsStatedInCMakeLists) {
  for (const auto& [room, plan] : rooms()) {
    const std::set<std::string> stated = stated_rooms(room);
    for (const std::string& file : sources_of(room)) {
      for (const Include& include : includes_of(file)) {
        const std::string target = room_of(include.target);
        if (!include.quoted || target == room || !rooms().contains(target)) continue;
        EXPECT_TRUE(stated.contains(target))
            << file << ":" << include.line << " includes " << include.target
            << ": add frustum::" << target << " to USES in " << room << "/CMakeLists.txt";
      }
    }
  }
}

TEST(Architecture, CMakeListsStateOnlyLowerRooms) {
  for (const auto& [room, plan] : rooms()) {
    for (const std::string& stated : stated_rooms(room)) {
      if (stated == room) continue;
      EXPECT_LT(rooms().at(stated).floor, plan.floor)
          << room << "/CMakeLists.txt may not link frustum::" << stated;
    }
  }
}

TEST(Architecture, EverySourceIsListedInCMakeLists) {
  for (const auto& [room, plan] : rooms()) {
    std::istringstream words(
        std::regex_replace(text_of(room + "/CMakeLists.txt"), std::regex("[()\"]"), " "));
    const std::set<std::string> listed{std::istream_iterator<std::string>(words), {}};
    for (const std::string& file : files_of(room, {".cpp"})) {
      EXPECT_TRUE(listed.contains(file.substr(room.size() + 1)))
          << file << " is not listed in " << room << "/CMakeLists.txt";
    }
  }
}

TEST(Architecture, HeavyHeadersStayInTheirFiles) {
  std::vector<std::string> files;
  for (const char* folder : {"tests", "bench"}) {
    for (const std::string& file : files_of(folder, {".cpp", ".hpp"})) files.push_back(file);
  }
  for (const auto& [room, plan] : rooms()) {
    for (const std::string& file : sources_of(room)) files.push_back(file);
  }
  for (const Confined& confined : confined_headers()) {
    for (const std::string& file : files) {
      if (std::regex_match(file, confined.allowed_file)) continue;
      for (const Include& include : includes_of(file)) {
        EXPECT_FALSE(std::regex_match(include.target, confined.header))
            << file << ":" << include.line << ": " << confined.what << " (" << include.target
            << ") may not be included here";
      }
    }
  }
}

TEST(Architecture, EveryHeaderIsGuardedByPragmaOnce) {
  for (const auto& [room, plan] : rooms()) {
    for (const std::string& file : files_of(room, {".hpp"})) {
      EXPECT_NE(text_of(file).find("\n#pragma once\n"), std::string::npos) << file;
    }
  }
}

}  // namespace
}  // namespace frustum::house
