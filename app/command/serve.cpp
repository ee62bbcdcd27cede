// frustum serve: the reports of a folder in a browser.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/serve/report_server.hpp"
#include "app/view/console.hpp"
#include "core/program_version.hpp"

namespace frustum::app {
namespace {

struct ServeOptions : AnswerOptions {
  std::string folder{};
  unsigned port = 8979;
};

int serve_folder(const ServeOptions& options) {
  auto server = ReportServer::open(options.folder, static_cast<int>(options.port));
  if (!server) return refuse(server.error(), options);
  if (options.json) {
    std::cout << fmt::format(
        "{{\"schema\": \"frustum/serve/1\", \"version\": \"{}\", \"url\": "
        "\"http://localhost:{}/\"}}\n",
        program_version(), server->port());
  } else if (!options.quiet) {
    std::cout << fmt::format("http://localhost:{}/ shows {}; Ctrl-C ends it\n", server->port(),
                             options.folder);
  }
  std::cout.flush();
  server->serve();
  return kDone;
}

}  // namespace

void add_serve(Command& program) {
  auto o = std::make_shared<ServeOptions>();
  Command command = program.command("serve", "The reports of a folder in a browser, read alone");
  command.option("folder", o->folder, "Folder with reports, at any depth").required();
  command.option("--port", o->port, "Of localhost (default 8979); 0: a free one")
      .within(0U, 65535U);
  add_answer_options(command, *o);
  command.footer(
      "It answers this computer alone (127.0.0.1), and changes nothing.\nExample: frustum serve "
      "out");
  command.runs([o] { return serve_folder(*o); });
}

}  // namespace frustum::app
