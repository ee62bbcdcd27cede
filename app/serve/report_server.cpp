#include "app/serve/report_server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include "app/serve/report_index.hpp"
#include "app/serve/served_file.hpp"
#include "core/whole_file.hpp"

namespace frustum::app {

namespace fs = std::filesystem;

struct ReportServer::State {
  fs::path folder{};
  int port = 0;
  httplib::Server server{};
};

namespace {

constexpr int kOk = 200, kForbidden = 403, kNotFound = 404, kNotAllowed = 405;

void refuse_request(httplib::Response& response, int status, const char* text) {
  response.status = status;
  response.set_content(std::string(text) + "\n", "text/plain; charset=utf-8");
}

void answer_request(const fs::path& folder, const httplib::Request& request,
                    httplib::Response& response) {
  if (request.path == "/") {
    response.set_content(index_html(folder.filename().string(), reports_in(folder)),
                         "text/html; charset=utf-8");
    return;
  }
  const auto file = served_file(folder, request.path);
  const auto bytes = file ? read_whole_file(*file) : Result<std::string>(error("no file"));
  if (!bytes) return refuse_request(response, kNotFound, "There is no such report.");
  response.set_content(*bytes, std::string(content_type(*file)));
}

}  // namespace

ReportServer::ReportServer(std::unique_ptr<State> state) : state_(std::move(state)) {}
ReportServer::ReportServer(ReportServer&&) noexcept = default;
ReportServer& ReportServer::operator=(ReportServer&&) noexcept = default;
ReportServer::~ReportServer() = default;

Result<ReportServer> ReportServer::open(const fs::path& folder, int port) {
  std::error_code problem;
  if (!fs::is_directory(folder, problem)) {
    return error("no-folder"_id, fmt::format("'{}' is no folder", folder.string()),
                 "name the folder in which reports are, for example out");
  }
  auto state = std::make_unique<State>();
  state->folder = fs::canonical(folder, problem);
  httplib::Server& server = state->server;
  // Requests are short, and nobody needs a connection for long.
  constexpr time_t kSeconds = 5;
  constexpr std::size_t kLongestBody = 1024;
  // The library's own options let several servers have one port.
  server.set_socket_options([](socket_t) {});
  server.set_read_timeout(kSeconds);
  server.set_write_timeout(kSeconds);
  server.set_keep_alive_timeout(kSeconds);
  server.set_payload_max_length(kLongestBody);
  server.set_default_headers({{"X-Content-Type-Options", "nosniff"},
                              {"X-Frame-Options", "DENY"},
                              {"Referrer-Policy", "no-referrer"},
                              {"Cache-Control", "no-store"},
                              {"Content-Security-Policy",
                               "default-src 'none'; script-src 'unsafe-inline' blob:; style-src "
                               "'unsafe-inline'; img-src data: blob: 'self'; font-src data:; "
                               "connect-src 'none'; base-uri 'none'; form-action 'none'"}});
  server.set_pre_routing_handler(
      [&at = *state](const httplib::Request& request, httplib::Response& response) {
        if (!is_own_host(request.get_header_value("Host"), at.port)) {
          refuse_request(response, kForbidden, "Reports are shown under the name localhost alone.");
        } else if (request.method != "GET" && request.method != "HEAD") {
          refuse_request(response, kNotAllowed, "Reports are read, nothing else.");
        } else {
          response.status = kOk;
          answer_request(at.folder, request, response);
        }
        return httplib::Server::HandlerResponse::Handled;
      });
  state->port = port == 0                                ? server.bind_to_any_port("127.0.0.1")
                : server.bind_to_port("127.0.0.1", port) ? port
                                                         : -1;
  if (state->port < 0) {
    return error("port-taken"_id, fmt::format("port {} cannot be had", port),
                 "--port 0 takes a free one");
  }
  return ReportServer(std::move(state));
}

int ReportServer::port() const { return state_->port; }
void ReportServer::serve() { state_->server.listen_after_bind(); }
void ReportServer::stop() { state_->server.stop(); }

}  // namespace frustum::app
