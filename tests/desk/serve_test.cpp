#include "desk/serve.h"

#include <cerrno>
#include <cstdlib>
#include <regex>

#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "desk/pond_desk.h"

namespace limpid::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// A connection that sends raw bytes, valid HTTP or not.
class Raw {
 public:
  explicit Raw(int port, int flags = 0) : socket_(::socket(AF_INET, SOCK_STREAM | flags, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0 ||
                 errno == EINPROGRESS;
  }
  Raw(Raw&& other) noexcept
      : socket_(std::exchange(other.socket_, -1)), connected_(other.connected_) {}
  ~Raw() {
    if (socket_ >= 0) ::close(socket_);
  }

  bool connected() const { return connected_; }
  void send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return;  // the server refused the request on the way
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
  }
  void end() const { ::shutdown(socket_, SHUT_WR); }
  /// Reads until the server closes the connection.
  std::string receive() const {
    std::string all;
    char part[4096];
    for (ssize_t got; (got = ::recv(socket_, part, sizeof part, 0)) > 0;) all.append(part, got);
    return all;
  }

 private:
  int socket_;
  bool connected_ = false;
};

class ServeTest : public PondDesk {
 protected:
  ServeTest() : desk_(options(), *executor_), server_(desk_, 0) {
    std::smatch parts;
    const std::string address = server_.address();
    static const std::regex kAddress("http://127\\.0\\.0\\.1:([0-9]+)(/[0-9a-f]{32}/)");
    EXPECT_TRUE(std::regex_match(address, parts, kAddress)) << address;
    port_ = std::atoi(parts[1].str().c_str());
    root_ = parts[2].str();
  }

  std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
  /// The server's answer to these bytes.
  std::string answer(const std::string& bytes) const {
    const Raw connection(port_);
    connection.send(bytes);
    return connection.receive();
  }
  std::string get(const std::string& path, const std::string& headers = "") const {
    return answer("GET " + path + " HTTP/1.1\r\nHost: " + host() + "\r\n" + headers + "\r\n");
  }
  std::string post(const std::string& name, const std::string& body,
                   const std::string& headers = "") const {
    return answer("POST " + root_ + name + " HTTP/1.1\r\nHost: " + host() + "\r\nContent-Length: " +
                  std::to_string(body.size()) + "\r\n" + headers + "\r\n" + body);
  }
  void expect_alive() const { EXPECT_THAT(get(root_ + "api/desk"), StartsWith("HTTP/1.1 200 ")); }

  Desk desk_;
  DeskServer server_;
  int port_ = 0;
  std::string root_;
};

std::string body_of(const std::string& reply) { return reply.substr(reply.find("\r\n\r\n") + 4); }

TEST_F(ServeTest, AnswersWhatAPageAsks) {
  const auto desk = nlohmann::json::parse(body_of(get(root_ + "api/desk")));
  EXPECT_EQ(desk["size"], nlohmann::json({64, 36}));
  const std::string picture = post("api/picture", R"({"look": "pond", "half": true})");
  EXPECT_THAT(picture, StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(picture, HasSubstr("Content-Type: application/octet-stream\r\n"));
  EXPECT_GT(body_of(picture).size(), 4u * 32 * 18);
  EXPECT_THAT(post("api/picture", R"({"look": "pond", "half": true, "instead": true})"),
              StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(post("api/pixel", R"({"look": "pond", "x": 3, "y": 4})"), HasSubstr("\"aovs\":{"));
  EXPECT_THAT(post("api/command", R"({"look": "pond"})"),
              HasSubstr(R"({"command":"limpid composite plate.exr --look pond -o wet.exr"})"));
  EXPECT_THAT(post("api/save", R"({"look": "pond", "name": "mine.toml"})"),
              HasSubstr("saved/mine.toml\"}"));
  EXPECT_THAT(post("api/save", R"({"look": "pond", "name": "mine.toml"})"),
              StartsWith("HTTP/1.1 409 "));
}

TEST_F(ServeTest, SaysWhatIsWrongWithARequest) {
  const std::string reply = post("api/picture", R"({"look": "pnd"})");
  EXPECT_THAT(reply, StartsWith("HTTP/1.1 400 "));
  EXPECT_EQ(nlohmann::json::parse(body_of(reply))["error"],
            "look = 'pnd': expected one of pond; did you mean 'pond'?");
}

TEST_F(ServeTest, HasAllRepliesKeptAtHome) {
  for (const std::string& reply : {get(root_ + "api/desk"), get("/")}) {
    EXPECT_THAT(reply, HasSubstr("Content-Security-Policy: default-src 'self'"));
    EXPECT_THAT(reply, HasSubstr("Cache-Control: no-store\r\n"));
    EXPECT_THAT(reply, HasSubstr("X-Content-Type-Options: nosniff\r\n"));
    EXPECT_THAT(reply, HasSubstr("Referrer-Policy: no-referrer\r\n"));
    EXPECT_THAT(reply, Not(HasSubstr("Access-Control")));
  }
}

TEST_F(ServeTest, IsNotThereWithoutTheSecret) {
  std::string wrong = root_;
  wrong[1] = wrong[1] == '0' ? '1' : '0';
  const std::string secret = root_.substr(1, 32);
  for (const std::string& path :
       {std::string("/"), std::string("/favicon.ico"), std::string("/api/desk"), wrong,
        wrong + "api/desk", "/" + secret, "/" + secret + "x/", "//" + secret + "/", "/?" + secret,
        root_.substr(0, 17) + "/api/desk"}) {
    const std::string reply = get(path);
    EXPECT_THAT(reply, StartsWith("HTTP/1.1 404 ")) << path;
    EXPECT_THAT(reply, Not(HasSubstr(secret)));
  }
}

TEST_F(ServeTest, HasNoFilesButThePages) {
  for (const char* path : {"../etc/passwd", "..%2f..%2fetc%2fpasswd", "%2e%2e/%2e%2e/etc/passwd",
                           "/etc/passwd", "....//etc/passwd", "api", "api/", "api/shell",
                           "api/../desk.html", "desk.cpp", "desk.html%00.js", "page.css/"}) {
    EXPECT_THAT(get(root_ + path), StartsWith("HTTP/1.1 404 ")) << path;
  }
  const std::string style = get(root_ + "page.css");
  EXPECT_THAT(style, StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(style, HasSubstr("Content-Type: text/css"));
}

TEST_F(ServeTest, RefusesOtherNamesAndOtherPages) {
  const auto asked = [&](const std::string& headers) {
    return answer("GET " + root_ + "api/desk HTTP/1.1\r\n" + headers + "\r\n");
  };
  const std::string port = ":" + std::to_string(port_);
  EXPECT_THAT(asked("Host: localhost" + port + "\r\n"), StartsWith("HTTP/1.1 200 "));
  for (const std::string& host :
       {std::string("127.0.0.1"), "127.0.0.1" + port + "0", "evil.example" + port,
        "127.0.0.1.evil.example" + port, "0.0.0.0" + port, std::string()}) {
    EXPECT_THAT(asked("Host: " + host + "\r\n"), StartsWith("HTTP/1.1 403 ")) << host;
  }
  EXPECT_THAT(asked(""), StartsWith("HTTP/1.1 403 "));
  const std::string here = "Host: " + host() + "\r\n";
  EXPECT_THAT(asked(here + "Origin: http://" + host() + "\r\n"), StartsWith("HTTP/1.1 200 "));
  for (const std::string& origin :
       {std::string("http://evil.example"), std::string("null"), "https://" + host(),
        "http://" + host() + ".evil.example", "http://127.0.0.1" + port + "1"}) {
    EXPECT_THAT(asked(here + "Origin: " + origin + "\r\n"), StartsWith("HTTP/1.1 403 ")) << origin;
  }
}

TEST_F(ServeTest, RefusesOtherMethods) {
  for (const char* method : {"PUT", "DELETE", "PATCH", "OPTIONS"}) {
    const std::string reply =
        answer(std::string(method) + " " + root_ + "api/picture HTTP/1.1\r\nHost: " + host() +
               "\r\nContent-Length: 0\r\n\r\n");
    EXPECT_THAT(reply, StartsWith("HTTP/1.1 405 ")) << method;
  }
  EXPECT_THAT(get(root_ + "api/save"), StartsWith("HTTP/1.1 405 "));
  EXPECT_THAT(post("api/desk", "{}"), StartsWith("HTTP/1.1 405 "));
}

TEST_F(ServeTest, RefusesLargeBodiesUnread) {
  const auto announced = [&](const std::string& headers) {
    return answer("POST " + root_ + "api/picture HTTP/1.1\r\nHost: " + host() + "\r\n" + headers +
                  "\r\n");
  };
  EXPECT_THAT(announced("Content-Length: 1000000000\r\n"), StartsWith("HTTP/1.1 413 "));
  EXPECT_THAT(announced("Content-Length: 99999999999999999999999\r\n"),
              StartsWith("HTTP/1.1 413 "));
  EXPECT_THAT(announced("Content-Length: -1\r\n"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(announced("Content-Length: 2\r\nContent-Length: 3\r\n"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(announced("Transfer-Encoding: chunked\r\n"), StartsWith("HTTP/1.1 411 "));
  EXPECT_THAT(announced("Content-Length: 20\r\nContent-Encoding: gzip\r\n"),
              StartsWith("HTTP/1.1 411 "));
  EXPECT_THAT(announced(""), StartsWith("HTTP/1.1 411 "));
  expect_alive();
}

TEST_F(ServeTest, TakesABodyOfTheMostAllowed) {
  std::string body = R"({"look": "pond"})";
  body.resize(std::size_t{1} << 20, ' ');
  EXPECT_THAT(post("api/command", body), StartsWith("HTTP/1.1 200 "));
  EXPECT_THAT(post("api/command", body + " "), StartsWith("HTTP/1.1 413 "));
}

TEST_F(ServeTest, LivesThroughGarbage) {
  for (const std::string& bytes :
       {std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string(100000, 'x'),
        std::string(1000, '\0'),
        std::string("GET ") + std::string(20000, '/') + " HTTP/1.1\r\n\r\n",
        "GET " + root_ + " HTTP/9.9\r\n\r\n", "POST " + root_ + "api/picture HTTP/1.1\r\n"}) {
    const Raw connection(port_);
    connection.send(bytes);
    connection.end();
    EXPECT_THAT(connection.receive(), Not(HasSubstr("200 OK")));
  }
  expect_alive();
}

TEST_F(ServeTest, LivesThroughThoseWhoHangUp) {
  for (int i = 0; i < 20; ++i) {
    const Raw connection(port_);
    connection.send("POST " + root_ + "api/picture HTTP/1.1\r\nHost: " + host() +
                    "\r\nContent-Length: 16\r\n\r\n{\"look\": \"pond\"}");
  }
  expect_alive();
}

TEST_F(ServeTest, LivesThroughAThousandConnections) {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = std::min<rlim_t>(files.rlim_max, 4096);
  ::setrlimit(RLIMIT_NOFILE, &files);
  std::vector<Raw> connections;
  for (int i = 0; i < 1000; ++i) connections.emplace_back(port_, SOCK_NONBLOCK);
  EXPECT_TRUE(connections.back().connected());
  connections.clear();
  expect_alive();
}

TEST_F(ServeTest, AnswersWhileOthersSayNothing) {
  std::vector<Raw> idle;
  for (int i = 0; i < 20; ++i) idle.emplace_back(port_);
  expect_alive();
}

TEST_F(ServeTest, RefusesAPortThatIsTaken) {
  EXPECT_THAT(refusal([&] { DeskServer(desk_, port_); }),
              StartsWith("port " + std::to_string(port_) + ": cannot be opened (in use"));
}

TEST_F(ServeTest, HasANewSecretEachTime) {
  const DeskServer other(desk_, 0);
  EXPECT_THAT(other.address(), Not(HasSubstr(root_)));
}

}  // namespace
}  // namespace limpid::test
