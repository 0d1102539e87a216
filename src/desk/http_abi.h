#pragma once
#include <cstddef>

/// @file
/// The contract between the desk and limpid_http, the module that it loads to talk to browsers.
/// Plain C, so that neither side needs the other's standard library.

extern "C" {

/// Raised whenever anything here changes.
constexpr unsigned kHttpAbi = 1;

/// Bytes valid during the call that passes them; null for none.
struct HttpText {
  const char* bytes;
  std::size_t size;
};

struct HttpRequest {
  HttpText method;
  HttpText path;          ///< percent-decoded, without the query
  HttpText host, origin;  ///< headers; null if missing
  HttpText body;          ///< empty before the request is admitted
};

/// Sends `bytes`, which are copied, as the reply; to be called once.
using HttpReply = void(void* to, int status, const char* type, const char* bytes, std::size_t size);

/// The host's functions, called from several threads at once. They must not throw.
struct HttpHost {
  void* host;
  /// Called before the body is read: nonzero to continue, or 0 after replying.
  int (*admits)(void* host, const HttpRequest*, HttpReply*, void* to);
  void (*answer)(void* host, const HttpRequest*, HttpReply*, void* to);
};

struct HttpHeader {
  const char *name, *value;
};

struct HttpOptions {
  int port;                   ///< on 127.0.0.1; 0 for any free port
  int threads;                ///< number of threads for replies
  int waiting;                ///< queued connections; further ones are not accepted
  int seconds_to_begin;       ///< limit from accepting a connection to its request
  int seconds;                ///< limit for silence of a connection, and for blocked replies
  std::size_t most_body;      ///< bytes; a larger body is refused with 413, unread
  const HttpHeader* headers;  ///< of all replies
  std::size_t header_count;
};

/// Receives a sentence about an error.
using HttpPut = void(void* to, const char* bytes, std::size_t size);

[[gnu::visibility("default")]] unsigned limpid_servers_abi();
/// A server bound to options->port, or to *port if that is 0; it keeps `host`, but not `options`.
/// Null, with a sentence put, on failure.
[[gnu::visibility("default")]] void* limpid_http_open(const HttpOptions* options,
                                                      const HttpHost* host, int* port, HttpPut* put,
                                                      void* to);
/// Serves until limpid_http_stop() on another thread, or until the system accepts no more
/// connections.
[[gnu::visibility("default")]] void limpid_http_run(void* server);
/// Makes limpid_http_run(), called before or afterwards, return after all replies.
[[gnu::visibility("default")]] void limpid_http_stop(void* server);
[[gnu::visibility("default")]] void limpid_http_close(void* server);
}
