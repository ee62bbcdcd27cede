// Holds the tree against the architecture: a room includes only rooms below it, says so in its
// CMakeLists.txt, and heavy headers stay where they are wanted.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/house/source_tree.hpp"

namespace frustum::house {
namespace {

// Floors of the tower. A room may include a room of a lower floor, never one of its own.
const std::map<std::string, int>& floors() {
  static const std::map<std::string, int> kFloors{
      {"core", 1},   {"parser", 2},      {"metrology", 2}, {"kinematics", 3}, {"post", 4},
      {"lint", 4},   {"cutter", 4},      {"stock", 5},     {"programs", 7},   {"report", 7},
      {"trials", 8}, {"calibration", 9}, {"app", 10}};
  return kFloors;
}

std::string room_of(const std::string& path) { return path.substr(0, path.find('/')); }

std::vector<std::string> sources_of(const std::string& room) {
  return files_of(room, {".cpp", ".hpp"});
}

// The rooms that a room's CMakeLists.txt names: frustum::core, ...
std::set<std::string> stated_rooms(const std::string& room) {
  std::set<std::string> stated;
  const std::string text = text_of(room + "/CMakeLists.txt");
  const std::regex target("frustum::([a-z_]+)");
  for (auto hit = std::sregex_iterator(text.begin(), text.end(), target);
       hit != std::sregex_iterator(); ++hit) {
    const std::string name = (*hit)[1].str();
    if (floors().contains(name)) stated.insert(name);
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
      entry("Boost.Spirit", "boost/(spirit|fusion|phoenix)/.*", "parser/reading/grammar\\.cpp"),
      entry("CGAL", "CGAL/.*", "stock/(polyhedral[a-z0-9_]*|mesh_faults)\\.cpp"),
      entry("OpenMesh", "OpenMesh/.*", ".*\\.cpp|stock/open_mesh\\.hpp"),
      entry("toml++", "toml\\+\\+/.*|toml\\.hpp", "core/toml_document\\.cpp"),
      entry("Random123", "Random123/.*", "core/random\\.cpp"),
      entry("CLI11", "CLI/.*", "app/[a-z0-9_]+\\.cpp"),
      entry("GoogleTest", "(gtest|gmock|rapidcheck).*", "tests/.*"),
  };
}

TEST(Architecture, HasEveryFolder) {
  for (const auto& [room, floor] : floors()) {
    EXPECT_TRUE(std::filesystem::is_directory(source_dir() / room)) << room << "/ is missing";
  }
  for (const char* folder :
       {"machines", "tests", "bench", "examples", "docs", "scripts", "cmake"}) {
    EXPECT_TRUE(std::filesystem::is_directory(source_dir() / folder)) << folder << "/ is missing";
  }
}

TEST(Architecture, IncludesPointDownTheTower) {
  for (const auto& [room, floor] : floors()) {
    for (const std::string& file : sources_of(room)) {
      for (const Include& include : includes_of(file)) {
        const auto target = floors().find(room_of(include.target));
        if (!include.quoted || target == floors().end() || target->first == room) continue;
        EXPECT_LT(target->second, floor) << file << ":" << include.line << ": " << room
                                         << "/ may not include " << include.target;
      }
    }
  }
}

// Within metrology/ the fits know no plan, and the probes no characteristic.
TEST(Architecture, FoldersOfARoomPointDown) {
  const std::map<std::string, std::set<std::string>> may_include{
      {"metrology/fit", {"fit"}},
      {"metrology/probing", {"probing", "plan", "fit"}},
      {"metrology/points", {"points", "plan", "cmm.hpp"}},
      {"parser/language", {"language", "motion.hpp"}},
      {"parser/dialects", {"dialects", "language", "motion.hpp", "dialect.hpp"}},
      {"parser/reading",
       {"reading", "dialects", "language", "motion.hpp", "dialect.hpp", "program.hpp"}},
      {"parser/writing",
       {"writing", "reading", "dialects", "language", "motion.hpp", "dialect.hpp"}},
  };
  for (const auto& [folder, below] : may_include) {
    const std::string room = room_of(folder);
    for (const std::string& file : files_of(folder, {".cpp", ".hpp"})) {
      for (const Include& include : includes_of(file)) {
        if (!include.quoted || room_of(include.target) != room) continue;
        EXPECT_TRUE(below.contains(room_of(include.target.substr(room.size() + 1))))
            << file << ":" << include.line << ": " << folder << "/ may not include "
            << include.target;
      }
    }
  }
}

TEST(Architecture, ProjectIncludesStartWithARoomAndExist) {
  for (const auto& [room, floor] : floors()) {
    for (const std::string& file : sources_of(room)) {
      for (const Include& include : includes_of(file)) {
        if (!include.quoted) {
          EXPECT_FALSE(floors().contains(room_of(include.target)) &&
                       std::filesystem::exists(source_dir() / include.target))
              << file << ":" << include.line << ": write \"" << include.target << "\" in quotes";
          continue;
        }
        EXPECT_TRUE(floors().contains(room_of(include.target)))
            << file << ":" << include.line << ": write the path from the root: " << include.target;
      }
    }
  }
}

TEST(Architecture, EveryIncludedRoomIsStatedInCMakeLists) {
  for (const auto& [room, floor] : floors()) {
    const std::set<std::string> stated = stated_rooms(room);
    for (const std::string& file : sources_of(room)) {
      for (const Include& include : includes_of(file)) {
        const std::string target = room_of(include.target);
        if (!include.quoted || target == room || !floors().contains(target)) continue;
        EXPECT_TRUE(stated.contains(target))
            << file << ":" << include.line << " includes " << include.target
            << ": add frustum::" << target << " to USES in " << room << "/CMakeLists.txt";
      }
    }
  }
}

TEST(Architecture, CMakeListsStateOnlyLowerRooms) {
  for (const auto& [room, floor] : floors()) {
    for (const std::string& stated : stated_rooms(room)) {
      if (stated == room) continue;
      EXPECT_LT(floors().at(stated), floor)
          << room << "/CMakeLists.txt may not link frustum::" << stated;
    }
  }
}

TEST(Architecture, EverySourceIsListedInCMakeLists) {
  for (const auto& [room, floor] : floors()) {
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
  for (const auto& [room, floor] : floors()) {
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
  for (const auto& [room, floor] : floors()) {
    for (const std::string& file : files_of(room, {".hpp"})) {
      EXPECT_NE(text_of(file).find("\n#pragma once\n"), std::string::npos) << file;
    }
  }
}

}  // namespace
}  // namespace frustum::house
