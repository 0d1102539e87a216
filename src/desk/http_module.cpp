// The only source that includes cpp-httplib; built as limpid_http.so, which http_server.cpp loads.
#include <algorithm>
#include <atomic>
#include <charconv>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <httplib.h>
#include <sys/socket.h>

#include "desk/http_abi.h"

namespace {

using httplib::Request;
using httplib::Response;

constexpr const char* kText = "text/plain; charset=utf-8";

// A bounded number of threads and of queued connections: a further connection blocks its caller.
class BoundedThreads : public httplib::TaskQueue {
 public:
  BoundedThreads(int threads, int waiting) : most_(static_cast<std::size_t>(waiting)) {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
  }

  void enqueue(std::function<void()> task) override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return tasks_.size() < most_; });
    tasks_.push_back(std::move(task));
    changed_.notify_all();
  }

  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  void work() {
    while (true) {
      std::function<void()> task;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ended_ || !tasks_.empty(); });
        if (tasks_.empty()) return;
        task = std::move(tasks_.front());
        tasks_.pop_front();
      }
      changed_.notify_all();
      task();
    }
  }

  const std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool ended_ = false;
  std::vector<std::thread> threads_;
};

HttpText text_of(const std::string& text) { return {text.data(), text.size()}; }

// The header's value, stored in `kept`.
HttpText header_of(const Request& request, const char* name, std::string& kept) {
  if (!request.has_header(name)) return {nullptr, 0};
  kept = request.get_header_value(name);
  return text_of(kept);
}

void put_reply(Response& response, int status, const char* type, std::string bytes) {
  response.status = status;
  if (bytes.empty()) return response.set_content("", type);
  // As a provider: the library would compress a body for a browser that accepts it, which takes
  // more time than the transfer.
  const auto held = std::make_shared<const std::string>(std::move(bytes));
  const auto provide = [held](std::size_t offset, std::size_t size, httplib::DataSink& sink) {
    return sink.write(held->data() + offset, size);
  };
  response.set_content_provider(held->size(), type, provide);
}

void reply(void* to, int status, const char* type, const char* bytes, std::size_t size) {
  put_reply(*static_cast<Response*>(to), status, type, std::string(bytes, size));
}

class HttpServer {
 public:
  HttpServer(const HttpOptions& options, const HttpHost& host) : host_(host) {
    const int threads = options.threads, waiting = options.waiting;
    server_.new_task_queue = [=] { return new BoundedThreads(threads, waiting); };
    // One request per connection: the rest of a refused body is not read as a request, and no
    // browser that keeps a connection open occupies a thread.
    server_.set_keep_alive_max_count(1);
    server_.set_keep_alive_timeout(options.seconds_to_begin);
    server_.set_read_timeout(options.seconds);
    server_.set_write_timeout(options.seconds);
    server_.set_payload_max_length(options.most_body);
    // Not the library's own SO_REUSEPORT, which would let another program listen here, too.
    server_.set_socket_options([](int socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server_.set_tcp_nodelay(true);
    httplib::Headers headers;
    for (std::size_t i = 0; i < options.header_count; ++i) {
      headers.emplace(options.headers[i].name, options.headers[i].value);
    }
    server_.set_default_headers(headers);
    const std::size_t most = options.most_body;
    server_.set_pre_routing_handler([this, most](const Request& request, Response& response) {
      return is_admitted(request, response, most) ? httplib::Server::HandlerResponse::Unhandled
                                                  : httplib::Server::HandlerResponse::Handled;
    });
    const auto answer = [this](const Request& request, Response& response) {
      ask(request, response, request.body,
          [this](const auto&... all) { return host_.answer(host_.host, all...), 0; });
    };
    server_.Get(".*", answer);
    server_.Post(".*", answer);
  }

  // The port, or 0 if none is free.
  int bind(int port) {
    if (port == 0) return std::max(0, server_.bind_to_any_port("127.0.0.1"));
    return server_.bind_to_port("127.0.0.1", port) ? port : 0;
  }

  void run() {
    server_.listen_after_bind();
    ended_ = true;
  }

  void stop() {
    // stop() works only once it runs.
    while (!server_.is_running() && !ended_) std::this_thread::yield();
    server_.stop();
  }

 private:
  template <class Call>
  static int ask(const Request& request, Response& response, const std::string& body,
                 const Call& call) {
    std::string host, origin;
    const HttpRequest asked{text_of(request.method), text_of(request.path),
                            header_of(request, "Host", host), header_of(request, "Origin", origin),
                            text_of(body)};
    return call(&asked, &reply, static_cast<void*>(&response));
  }

  bool is_admitted(const Request& request, Response& response, std::size_t most) const {
    const bool admitted = ask(request, response, "", [this](const auto&... all) {
                            return host_.admits(host_.host, all...);
                          }) != 0;
    return admitted && has_plain_body(request, response, most);
  }

  // Bodies of unknown length, or compressed, could exceed their stated size.
  static bool has_plain_body(const Request& request, Response& response, std::size_t most) {
    const auto refuse = [&](int status, const char* sentence) {
      put_reply(response, status, kText, sentence);
      return false;
    };
    if (request.has_header("Transfer-Encoding") || request.has_header("Content-Encoding")) {
      return refuse(411, "body: expected a Content-Length, and no encoding\n");
    }
    if (request.get_header_value_count("Content-Length") == 0) {
      return request.method == "GET" || refuse(411, "body: expected a Content-Length\n");
    }
    const std::string text = request.get_header_value("Content-Length");
    std::size_t length = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, length);
    const bool too_large = read.ec == std::errc::result_out_of_range || length > most;
    if (too_large) return refuse(413, "body: larger than allowed\n");
    if (read.ec != std::errc() || read.ptr != end ||
        request.get_header_value_count("Content-Length") > 1) {
      return refuse(400, "Content-Length: expected a number\n");
    }
    return true;
  }

  HttpHost host_;
  httplib::Server server_;
  std::atomic<bool> ended_ = false;
};

}  // namespace

unsigned limpid_servers_abi() { return kHttpAbi; }

void* limpid_http_open(const HttpOptions* options, const HttpHost* host, int* port, HttpPut* put,
                       void* to) {
  std::string sentence;
  try {
    auto server = std::make_unique<HttpServer>(*options, *host);
    *port = server->bind(options->port);
    if (*port != 0) return server.release();
    sentence = "port " + std::to_string(options->port) +
               ": cannot be opened (in use, or not allowed): expected another port, or 0 for any";
  } catch (const std::exception& error) {
    sentence = std::string("cannot start a server (") + error.what() + ")";
  }
  put(to, sentence.data(), sentence.size());
  return nullptr;
}

void limpid_http_run(void* server) { static_cast<HttpServer*>(server)->run(); }
void limpid_http_stop(void* server) { static_cast<HttpServer*>(server)->stop(); }
void limpid_http_close(void* server) { delete static_cast<HttpServer*>(server); }
