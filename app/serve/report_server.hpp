// Shows the reports of a folder to a browser on the same computer; reads alone.
//
// Model : GET and HEAD of the index (/) and of files below the folder (served_file.hpp), over
//         HTTP on 127.0.0.1; anything else is refused
// Units : none
// Errors: a folder that is none; a port that is taken
// Source: RFC 9110; libcpp-httplib speaks it
#pragma once

#include <filesystem>
#include <memory>

#include "core/result.hpp"

namespace frustum::app {

class ReportServer {
 public:
  // `port` 0: a free one.
  [[nodiscard]] static Result<ReportServer> open(const std::filesystem::path& folder, int port);
  ReportServer(ReportServer&&) noexcept;
  ReportServer& operator=(ReportServer&&) noexcept;
  ~ReportServer();

  [[nodiscard]] int port() const;
  // Until stop(), which any thread may call, or a signal ends the program.
  void serve();
  void stop();

 private:
  struct State;
  explicit ReportServer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace frustum::app
