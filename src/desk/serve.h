#pragma once
#include <string>

#include "desk/desk.h"
#include "desk/http_server.h"

namespace limpid {

/// Serves a desk to the browsers of this machine's user: the page and its requests, below an
/// address that cannot be guessed.
///
/// All paths outside of the secret do not exist. A request whose Host is not this server (it came
/// by another name of the machine) or whose Origin is another page is refused before its body is
/// read. Nothing is written but saved looks.
class DeskServer {
 public:
  /// Listens at once. The desk must outlive it. Throws Error as HttpServer.
  DeskServer(Desk& desk, int port);

  /// "http://127.0.0.1:PORT/SECRET/"
  std::string address() const;
  /// Returns when no more requests can be served.
  void wait() { server_.wait(); }

 private:
  std::optional<WebReply> refusal(const WebRequest& request) const;
  WebReply answer(const WebRequest& request);
  WebReply answer_api(std::string_view name, std::string_view body);

  Desk& desk_;
  const std::string root_;  ///< "/SECRET/"
  HttpServer server_;
};

}  // namespace limpid
