// Error vectors over a working volume as one HTML page that opens without a network: statistics,
// the ranking of the errors, and a grid with magnified arrows to be turned with the mouse.
//
// Units: places mm, errors um. Errors: writing: a diagnostic that names the file.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"

namespace frustum::report {

// The vectors at one rotary position, one a point, um.
struct VolumetricView {
  std::string position{};  // "B 30°, C 0°"
  std::vector<Vec3> tool{};
  std::vector<Vec3> workpiece{};
  std::vector<Vec3> relative{};
};

struct VolumetricPage {
  std::string title{};
  std::vector<std::array<std::string, 2>> facts{};       // name, value
  std::vector<std::array<std::string, 4>> statistics{};  // side, maximum, mean, 95 %
  std::string worst{};                                   // where the relative error is largest
  std::vector<std::array<std::string, 4>> ranking{};  // error, meaning, gain, share; may be empty
  std::array<int, 3> counts{};                        // points along X (fastest), Y and Z
  std::vector<Vec3> places{};                         // mm
  std::vector<VolumetricView> views{};
};

// By how much the errors are drawn larger: 1, 2 or 5 times a power of ten that makes the longest
// vector about an eighth of the volume's diagonal.
[[nodiscard]] double magnification(const VolumetricPage& page);
[[nodiscard]] std::string volumetric_html(const VolumetricPage& page);
// The folder must exist. Returns the path.
[[nodiscard]] Result<std::filesystem::path> write_volumetric_page(const std::filesystem::path& path,
                                                                  const VolumetricPage& page);

}  // namespace frustum::report
