#include "app/job/output_folder.hpp"

#include <system_error>

namespace frustum::app {

Result<std::filesystem::path> output_folder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (!problem && std::filesystem::is_directory(folder, problem)) return folder;
  Diagnostic failure = error("file-unwritable"_id, "the output folder cannot be made",
                             problem ? problem.message() : "");
  failure.file = folder.string();
  return failure;
}

}  // namespace frustum::app
