#include "app/job/job.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/fuzz/files/file_checks.hpp"
#include "tests/fuzz/files/one_file.hpp"

namespace frustum::fuzz {
namespace {

namespace fs = std::filesystem;

// A folder of this process with the files that the seeds name.
class JobFolder {
 public:
  JobFolder() : path_(fs::temp_directory_path() / ("frustum-fuzz-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
    fs::copy(FRUSTUM_SOURCE_DIR "/tests/fuzz/job/beside", path_,
             fs::copy_options::overwrite_existing);
  }
  ~JobFolder() {
    std::error_code left_behind;
    fs::remove_all(path_, left_behind);
  }
  JobFolder(const JobFolder&) = delete;
  JobFolder& operator=(const JobFolder&) = delete;

  [[nodiscard]] fs::path file() const { return path_ / "job.toml"; }

 private:
  fs::path path_;
};

void check_piece(const programs::TestPiece& piece) {
  check_finite(piece.blank_origin, "origin of the blank");
  check_finite(piece.placement.origin, "origin of the set-up");
  check_finite(piece.placement.tilt, "tilt");
  for (const auto& [number, origin] : piece.work_offsets) check_finite(origin, "an offset");
  for (const auto& [number, tool] : piece.tools) {
    check_finite(tool.radius_error.value, "radius_error");
    check_finite(tool.diameter.value, "diameter");
    check_finite(tool.length.value, "length");
  }
  for (const auto& body : piece.fixtures) {
    check_finite(body.part_from_body.translation, "a fixture");
  }
}

// What is wrong is in the job, with its place, or in a file that it names.
void check_places(const Diagnostics& failures, const fs::path& job) {
  if (!has_error(failures)) throw std::runtime_error("a failure without an error");
  for (const Diagnostic& failure : failures) {
    const bool is_placed = (failure.line > 0 && failure.column > 0) || failure.file != job;
    if (!failure.message.empty() && !failure.file.empty() && is_placed) continue;
    throw std::runtime_error("a failure without file, place or message: " + to_string(failure));
  }
}

}  // namespace

void run_one_job(std::string_view text) {
  static const JobFolder kFolder;
  const fs::path file = kFolder.file();
  std::ofstream(file, std::ios::binary) << text;
  for (const bool wants_plan : {false, true}) {
    const auto job = app::load_job(file, {}, wants_plan);
    if (!job) {
      check_places(job.error(), file);
      continue;
    }
    check_piece(job->piece);
    check_finite(job->path_bound, "path_bound");
    check_finite(job->mesh_pitch, "mesh_pitch");
    const auto& law = job->controller.time_law;
    for (const double value : {law.rapid, law.rotary_rapid, law.corner_time}) {
      check_finite(value, "a value of the time law");
    }
  }
}

}  // namespace frustum::fuzz
