#include "desk/http_server.h"

#include <exception>
#include <iterator>
#include <utility>

#include "limpid/core/error.h"

#include "desk/http_abi.h"
#include "files/module_file.h"

namespace limpid {
namespace {

/// For the page itself and its pictures only.
constexpr HttpHeader kHeaders[] = {
    {"Content-Security-Policy",
     "default-src 'self' 'unsafe-inline' blob: data:; frame-ancestors 'none'"},
    {"Cache-Control", "no-store"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
};

/// Idle connections, which browsers open in advance, occupy a thread for a second.
constexpr int kThreads = 32;
constexpr int kWaiting = 64;
constexpr int kSecondsToBegin = 1;
constexpr int kSeconds = 5;
constexpr std::size_t kMaxBody = std::size_t{1} << 20;

struct Module {
  decltype(&limpid_http_open) open;
  decltype(&limpid_http_run) run;
  decltype(&limpid_http_stop) stop;
  decltype(&limpid_http_close) close;
};

Module load() {
  const auto path = module_file("limpid_http.so", "a page for a browser needs");
  void* const library = open_module(path, "server", kHttpAbi);
  const auto function = [&](const char* name) { return module_function(library, path, name); };
  return {reinterpret_cast<decltype(Module::open)>(function("limpid_http_open")),
          reinterpret_cast<decltype(Module::run)>(function("limpid_http_run")),
          reinterpret_cast<decltype(Module::stop)>(function("limpid_http_stop")),
          reinterpret_cast<decltype(Module::close)>(function("limpid_http_close"))};
}

const Module& module() {
  static const Module loaded = load();
  return loaded;
}

std::string_view view_of(const HttpText& text) {
  return text.bytes ? std::string_view(text.bytes, text.size) : std::string_view();
}

std::optional<std::string_view> header_of(const HttpText& text) {
  if (!text.bytes) return std::nullopt;
  return view_of(text);
}

WebRequest request_of(const HttpRequest& request) {
  return {view_of(request.method), view_of(request.path), header_of(request.host),
          header_of(request.origin), view_of(request.body)};
}

void send(const WebReply& with, HttpReply* reply, void* to) {
  reply(to, with.status, with.type.c_str(), with.bytes.data(), with.bytes.size());
}

/// No exception may cross into the module.
template <class Work>
std::optional<WebReply> guarded(const Work& work) {
  try {
    return work();
  } catch (const std::exception&) {
    return WebReply{503, "text/plain; charset=utf-8", "the desk is out of memory\n"};
  }
}

int admits(void* host, const HttpRequest* request, HttpReply* reply, void* to) {
  const auto& h = *static_cast<const HttpServer::Host*>(host);
  const auto refused = guarded([&] { return h.refusal(request_of(*request)); });
  if (refused) send(*refused, reply, to);
  return refused ? 0 : 1;
}

void answer(void* host, const HttpRequest* request, HttpReply* reply, void* to) {
  const auto& h = *static_cast<const HttpServer::Host*>(host);
  send(*guarded([&] { return std::optional(h.answer(request_of(*request))); }), reply, to);
}

}  // namespace

HttpServer::HttpServer(int port, Host host) : host_(std::move(host)) {
  const HttpOptions options{port,     kThreads, kWaiting, kSecondsToBegin,
                            kSeconds, kMaxBody, kHeaders, std::size(kHeaders)};
  const HttpHost called{&host_, &admits, &answer};
  std::string sentence;
  const auto put = [](void* to, const char* bytes, std::size_t size) {
    static_cast<std::string*>(to)->assign(bytes, size);
  };
  server_ = module().open(&options, &called, &port_, put, &sentence);
  if (!server_) throw Error(sentence);
  thread_ = std::thread(module().run, server_);
}

HttpServer::~HttpServer() {
  module().stop(server_);
  wait();
  module().close(server_);
}

void HttpServer::wait() {
  if (thread_.joinable()) thread_.join();
}

}  // namespace limpid
