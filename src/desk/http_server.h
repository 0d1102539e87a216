#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace limpid {

/// A browser's request. The views are valid during the call.
struct WebRequest {
  std::string_view method, path;
  std::optional<std::string_view> host, origin;
  std::string_view body;
};

struct WebReply {
  int status = 200;
  std::string type, bytes;
};

/// Serves HTTP on 127.0.0.1, by the module limpid_http: with a bounded number of threads, of queued
/// connections, of bytes of a body (1 MiB), and of seconds of silence. One request per connection.
class HttpServer {
 public:
  struct Host {
    /// The refusal of a request whose body has not been read, or none.
    std::function<std::optional<WebReply>(const WebRequest&)> refusal;
    /// The reply to an admitted request. Called from several threads at once.
    std::function<WebReply(const WebRequest&)> answer;
  };

  /// Listens; replies from now on, on threads of its own. `port` 0 is any. Throws Error for a port
  /// in use, and if the module is missing.
  HttpServer(int port, Host host);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const { return port_; }
  /// Returns when the system accepts no more connections.
  void wait();

 private:
  Host host_;
  int port_ = 0;
  void* server_ = nullptr;
  std::thread thread_;
};

}  // namespace limpid
