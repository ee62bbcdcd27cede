// frustum serve: what is shown, and that nothing else is, whatever is asked.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "app/serve/report_server.hpp"
#include "app/serve/served_file.hpp"
#include "core/random.hpp"
#include "tests/law_count.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class ServeSystem : public testing::Test {
 protected:
  void SetUp() override {
    top_ = fs::path(testing::TempDir()) /
           ("frustum_serve_" +
            std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(top_);
    fs::create_directories(top_ / "reports/a b");
    fs::create_directories(top_ / "reports/.hidden");
    write("secret.txt", "SECRET");
    write("reports/.hidden/report.html", "SECRET");
    write("reports/a b/report.html", "<p>cone</p>");
    write("reports/a b/result.json",
          "{\"schema\": \"frustum/result/1\", \"title\": \"Cone <1>\", \"verdict\": \"pass\"}");
    write("reports/points.csv", "x,y,z\n");
    fs::create_symlink(top_ / "secret.txt", top_ / "reports/out.txt");
    fs::create_directory_symlink(top_, top_ / "reports/up");
    auto server = ReportServer::open(top_ / "reports", 0);
    ASSERT_TRUE(server);
    server_ = std::make_unique<ReportServer>(*std::move(server));
    serving_ = std::thread([this] { server_->serve(); });
  }
  void TearDown() override {
    // It has to be at its work before it can be told to end.
    (void)get("/");
    server_->stop();
    serving_.join();
    fs::remove_all(top_);
  }
  void write(const std::string& file, const std::string& text) const {
    std::ofstream(top_ / file, std::ios::binary) << text;
  }

  // All that comes back on a connection of its own, which the server closes; of a request that is
  // not whole it waits for more, and here nobody waits longer than `patience` for it.
  [[nodiscard]] std::string sent(const std::string& bytes, timeval patience = {60, 0}) const {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(server_->port()));
    ::inet_pton(AF_INET, "127.0.0.1", &to.sin_addr);
    ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    std::string answer;
    if (::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) {
      (void)::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      std::array<char, 4096> part{};
      for (ssize_t n = 0; (n = ::recv(socket, part.data(), part.size(), 0)) > 0;) {
        answer.append(part.data(), static_cast<std::size_t>(n));
      }
    }
    ::close(socket);
    return answer;
  }
  [[nodiscard]] std::string get(const std::string& path, std::string host = {},
                                timeval patience = {60, 0}) const {
    if (host.empty()) host = "localhost:" + std::to_string(server_->port());
    return sent("GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n",
                patience);
  }

  fs::path top_;
  std::unique_ptr<ReportServer> server_;
  std::thread serving_;
};

TEST_F(ServeSystem, ShowsReportsAndTheirIndex) {
  const std::string index = get("/");
  EXPECT_THAT(index, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(index, HasSubstr("<a href=\"a%20b/report.html\">Cone &lt;1&gt;</a>"));
  EXPECT_THAT(index, HasSubstr("<td>pass</td>"));
  EXPECT_THAT(index, Not(HasSubstr(".hidden")));
  const std::string page = get("/a%20b/report.html");
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(page, HasSubstr("text/html"));
  EXPECT_THAT(page, HasSubstr("<p>cone</p>"));
  EXPECT_THAT(get("/points.csv"), HasSubstr("x,y,z"));
}

TEST_F(ServeSystem, NothingBesideTheFolderAndNoOtherName) {
  for (const char* path :
       {"/../secret.txt", "/%2e%2e/secret.txt", "/a%20b/../../secret.txt", "//etc/passwd",
        "/a b/..%2f..%2fsecret.txt", "/..\\secret.txt", "/%5c..%5csecret.txt", "/out.txt",
        "/up/secret.txt", "/.hidden/report.html", "/a%20b", "/a%20b/", "/none.html", "/%00",
        "/etc/passwd", "/points.csv/", "/./points.csv", "*", "http://localhost/points.csv"}) {
    const std::string answer = get(path, {}, {2, 0});
    EXPECT_THAT(answer, testing::AnyOf(StartsWith("HTTP/1.1 404"), StartsWith("HTTP/1.1 400"), ""))
        << path;
    EXPECT_THAT(answer, Not(HasSubstr("SECRET"))) << path;
  }
  const std::string port = std::to_string(server_->port());
  const std::vector<std::string> others{
      "evil.example", "evil.example:" + port, "localhost.evil:" + port,
      "localhost",    "127.0.0.1:1",          "0.0.0.0:" + port};
  for (const std::string& host : others) {
    EXPECT_THAT(get("/", host), StartsWith("HTTP/1.1 403")) << host;
  }
  EXPECT_THAT(get("/", "127.0.0.1:" + port), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(sent("GET / HTTP/1.1\r\nConnection: close\r\n\r\n"), StartsWith("HTTP/1.1 403"))
      << "no host";
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "PATCH"}) {
    const std::string answer =
        sent(std::string(method) + " /points.csv HTTP/1.1\r\nHost: localhost:" + port +
             "\r\nContent-Length: 0\r\nConnection: close\r\n\r\n");
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 405")) << method;
  }
  EXPECT_FALSE(ReportServer::open(top_ / "none", 0));
  EXPECT_FALSE(ReportServer::open(top_ / "reports", server_->port())) << "taken";
}

// Random requests, and random bytes in sound ones.
TEST_F(ServeSystem, LawNoRequestBreaksIt) {
  const std::string port = std::to_string(server_->port());
  const std::string sound = "GET /a%20b/report.html HTTP/1.1\r\nHost: localhost:" + port +
                            "\r\nConnection: close\r\nRange: bytes=0-3\r\n\r\n";
  const auto requests = proof::law_count<std::uint64_t>(20'000, 400);
  std::uint64_t at = 0;
  const auto random = [&](std::uint64_t below) {
    return static_cast<std::uint64_t>(
        uniform({.seed = 11, .draw = 1, .purpose = RandomPurpose::instrument_reading}, at++) *
        static_cast<double>(below));
  };
  for (std::uint64_t i = 0; i < requests; ++i) {
    std::string bytes = sound;
    for (std::uint64_t k = 0; k <= random(6); ++k) {
      const std::size_t place = random(bytes.size());
      switch (random(4)) {
        case 0:
          bytes[place] = static_cast<char>(random(256));
          break;
        case 1:
          bytes.erase(place, random(20));
          break;
        case 2:
          bytes.insert(place, std::string(random(40), static_cast<char>(random(256))));
          break;
        default:
          bytes.insert(place, "/../%2e%2e/secret.txt");
      }
      if (bytes.empty()) bytes = "\r\n";
    }
    EXPECT_THAT(sent(bytes, {0, 20'000}), Not(HasSubstr("SECRET"))) << bytes;
  }
  EXPECT_THAT(get("/a%20b/report.html"), HasSubstr("<p>cone</p>")) << "it still serves";
}

}  // namespace
}  // namespace frustum::app
