// Within a room a folder includes itself and the folders that the plan lists before it.
//
// A header beside the folders (parser/program.hpp, metrology/cmm.hpp) has the place of the latest
// folder that it includes, directly or through other headers beside the folders.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/house/rooms.hpp"
#include "tests/house/source_tree.hpp"

namespace frustum::house {
namespace {

class FolderOrder {
 public:
  explicit FolderOrder(const std::string& room) : room_(room), folders_(rooms().at(room).folders) {
    for (const std::string& file : sources_of(room)) {
      for (const Include& include : includes_of(file)) {
        if (!include.quoted || room_of(include.target) != room) continue;
        includes_[file].insert(include.target);
      }
    }
  }

  // -1: below all folders
  [[nodiscard]] int place_of(const std::string& path) const {
    std::set<std::string> seen;
    return place(path, seen);
  }

  [[nodiscard]] bool knows(const std::string& folder) const {
    return std::any_of(folders_.begin(), folders_.end(), [&](const std::string& listed) {
      return within(folder, listed) || within(listed, folder);
    });
  }

 private:
  // "reading/rs274" is within "reading"
  static bool within(const std::string& folder, const std::string& outer) {
    return outer.empty() || folder == outer || folder.starts_with(outer + "/");
  }

  [[nodiscard]] int place(const std::string& name, std::set<std::string>& seen) const {
    const std::string folder = folder_of(name);
    for (std::size_t i = 0; i < folders_.size(); ++i) {
      if (within(folder, folders_[i])) return static_cast<int>(i);
    }

    if (!seen.insert(name).second) return -1;
    int highest = -1;
    const auto below = includes_.find(name);
    if (below == includes_.end()) return highest;
    for (const std::string& included : below->second) {
      highest = std::max(highest, place(included, seen));
    }
    return highest;
  }

  std::string room_;
  std::vector<std::string> folders_;
  std::map<std::string, std::set<std::string>> includes_;
};

bool is_at(const std::string& file, const std::string& place) {
  return file == place || file.starts_with(place + "/");
}

TEST(Architecture, FoldersOfARoomPointDown) {
  std::set<const UpwardArrow*> used;
  for (const auto& [room, plan] : rooms()) {
    const FolderOrder order(room);
    for (const std::string& file : sources_of(room)) {
      for (const Include& include : includes_of(file)) {
        if (!include.quoted || room_of(include.target) != room) continue;
        if (order.place_of(include.target) <= order.place_of(file)) continue;
        const auto arrow =
            std::find_if(upward_arrows().begin(), upward_arrows().end(), [&](const UpwardArrow& a) {
              return is_at(file, a.from) && is_at(include.target, a.to);
            });
        if (arrow != upward_arrows().end()) {
          used.insert(&*arrow);
          continue;
        }
        ADD_FAILURE() << file << ":" << include.line << ": may not include " << include.target
                      << ", which is in a later folder of " << room << "/";
      }
    }
  }
  for (const UpwardArrow& arrow : upward_arrows()) {
    EXPECT_TRUE(used.contains(&arrow)) << arrow.from << " no longer includes " << arrow.to
                                       << ": remove the arrow from tests/house/rooms.cpp";
  }
}

TEST(Architecture, EveryFolderOfARoomIsInThePlan) {
  for (const auto& [room, plan] : rooms()) {
    const FolderOrder order(room);
    for (const std::string& file : sources_of(room)) {
      const std::string folder = folder_of(file);
      EXPECT_TRUE(folder.empty() || order.knows(folder))
          << file << ": list " << folder << "/ in tests/house/rooms.cpp, in its order";
    }
  }
}

}  // namespace
}  // namespace frustum::house
