#pragma once
#include <cstddef>

/// @file
/// The contract between the desk and limpid_http, the module that it loads to talk with browsers.
/// Plain C, so that neither side's standard library crosses.

extern "C" {

/// Raised whenever anything here changes.
constexpr unsigned kHttpAbi = 1;

/// Bytes that last as long as the call that hands them over; null for none.
struct HttpText {
  const char* bytes;
  std::size_t size;
};

struct HttpRequest {
  HttpText method;
  HttpText path;          ///< its percent signs decoded, without what follows a '?'
  HttpText host, origin;  ///< headers; null where there are none
  HttpText body;          ///< empty before the request is admitted
};

/// Sends `bytes`, which are copied, in reply; to be called once.
using HttpReply = void(void* to, int status, const char* type, const char* bytes, std::size_t size);

/// Who answers, on several threads at once. Nothing may be thrown.
struct HttpHost {
  void* host;
  /// Before the body is read: other than 0 to go on, or 0 where it has replied.
  int (*admits)(void* host, const HttpRequest*, HttpReply*, void* to);
  void (*answer)(void* host, const HttpRequest*, HttpReply*, void* to);
};

struct HttpHeader {
  const char *name, *value;
};

struct HttpOptions {
  int port;                   ///< on 127.0.0.1; 0 for any that is free
  int threads;                ///< that answer
  int waiting;                ///< connections that wait for one; more are not accepted meanwhile
  int seconds_to_begin;       ///< that a connection may take until its request begins
  int seconds;                ///< that it may then say nothing, or take none of a reply
  std::size_t most_body;      ///< bytes; a larger body is refused with 413, unread
  const HttpHeader* headers;  ///< of all replies
  std::size_t header_count;
};

/// A sentence of what is wrong.
using HttpPut = void(void* to, const char* bytes, std::size_t size);

[[gnu::visibility("default")]] unsigned limpid_servers_abi();
/// A server that is bound to options->port, or to *port where that is 0; it keeps `host`, not
/// `options`. Null, with a sentence put, where that fails.
[[gnu::visibility("default")]] void* limpid_http_open(const HttpOptions* options,
                                                      const HttpHost* host, int* port, HttpPut* put,
                                                      void* to);
/// Answers until limpid_http_stop() of another thread, or until the system lets it accept no more.
[[gnu::visibility("default")]] void limpid_http_run(void* server);
/// Has limpid_http_run(), which has been or will be called, return once all answers are given.
[[gnu::visibility("default")]] void limpid_http_stop(void* server);
[[gnu::visibility("default")]] void limpid_http_close(void* server);
}
