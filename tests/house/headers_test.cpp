// What an installed header includes, directly or through others, is installed with it or comes
// from a package that find_package(Frustum) finds.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/house/rooms.hpp"
#include "tests/house/source_tree.hpp"

namespace frustum::house {
namespace {

// Packages that public headers may show, and what FrustumConfig.cmake.in says to find them.
struct PublicPackage {
  std::string prefix;
  std::string found_by;
};

const std::vector<PublicPackage>& public_packages() {
  static const std::vector<PublicPackage> kPackages{
      {"Eigen/", "find_dependency(Eigen3"},        {"boost/container/", "find_dependency(Boost"},
      {"boost/numeric/", "find_dependency(Boost"}, {"pugixml.hpp", "find_dependency(pugixml"},
      {"OpenMesh/", "find_dependency(OpenMesh"},
  };
  return kPackages;
}

// The rooms of FRUSTUM_FOLDERS, whose headers cmake --install puts below include/frustum.
std::set<std::string> installed_rooms() {
  const std::string text = text_of("CMakeLists.txt");
  std::smatch list;
  std::set<std::string> installed;
  if (!std::regex_search(text, list, std::regex(R"(set\(FRUSTUM_FOLDERS([^)]*)\))")))
    return installed;
  const std::string names = list[1].str();
  const std::regex name("[a-z_]+");
  for (auto hit = std::sregex_iterator(names.begin(), names.end(), name);
       hit != std::sregex_iterator(); ++hit) {
    installed.insert(hit->str());
  }
  return installed;
}

TEST(InstalledHeaders, ReachOnlyInstalledHeadersAndPublicPackages) {
  const std::set<std::string> installed = installed_rooms();
  const std::string config = text_of("cmake/FrustumConfig.cmake.in");
  for (const std::string& file : sources_of_all_rooms()) {
    if (!file.ends_with(".hpp") || !rooms().at(room_of(file)).is_library) continue;
    EXPECT_TRUE(installed.contains(room_of(file))) << file;
    for (const Include& include : includes_of(file)) {
      const std::string at = file + ":" + std::to_string(include.line) + ": " + include.target;
      if (include.quoted) {
        EXPECT_TRUE(include.target.ends_with(".hpp") && installed.contains(room_of(include.target)))
            << at << " is not installed";
        EXPECT_TRUE(std::filesystem::exists(source_dir() / include.target)) << at;
        continue;
      }
      if (include.target.find_first_of("/.") == std::string::npos) continue;  // <vector>
      bool is_public = false;
      for (const PublicPackage& package : public_packages()) {
        if (!include.target.starts_with(package.prefix)) continue;
        is_public = true;
        EXPECT_NE(config.find(package.found_by), std::string::npos)
            << at << ": FrustumConfig.cmake.in lacks " << package.found_by << " ..)";
      }
      EXPECT_TRUE(is_public) << at << " is not of a public package; include it in a .cpp file";
    }
  }
}

}  // namespace
}  // namespace frustum::house
