#include "desk/serve.h"

#include <exception>
#include <new>
#include <optional>

#include "limpid/core/error.h"

#include "desk/desk_json.h"
#include "desk/page_files.h"
#include "desk/secret.h"

namespace limpid {
namespace {

constexpr const char* kJson = "application/json";
constexpr const char* kBytes = "application/octet-stream";
constexpr std::string_view kApi = "api/";

WebReply refused(int status, const std::string& sentence) {
  return {status, kJson, text_json("error", sentence)};
}

/// The path below the root, or none.
std::optional<std::string_view> below(std::string_view path, const std::string& root) {
  if (!is_same(path.substr(0, root.size()), root)) return std::nullopt;
  return path.substr(root.size());
}

bool is_reading(std::string_view name) { return !name.starts_with(kApi) || name == "api/desk"; }

bool is_api(std::string_view name) {
  for (const std::string_view known :
       {"api/desk", "api/picture", "api/pixel", "api/save", "api/command"}) {
    if (name == known) return true;
  }
  return false;
}

}  // namespace

DeskServer::DeskServer(Desk& desk, int port)
    : desk_(desk),
      root_("/" + new_secret() + "/"),
      server_(port, {[this](const WebRequest& request) { return refusal(request); },
                     [this](const WebRequest& request) { return answer(request); }}) {}

std::string DeskServer::address() const {
  return "http://127.0.0.1:" + std::to_string(server_.port()) + root_;
}

std::optional<WebReply> DeskServer::refusal(const WebRequest& r) const {
  const std::string port = ":" + std::to_string(server_.port());
  const auto is_here = [&](std::string_view host, const std::string& scheme) {
    return host == scheme + "127.0.0.1" + port || host == scheme + "localhost" + port;
  };
  if (!r.host || !is_here(*r.host, "")) {
    return refused(403, "Host: expected 127.0.0.1" + port + " or localhost" + port);
  }
  if (r.origin && !is_here(*r.origin, "http://")) {
    return refused(403, "Origin: expected this page");
  }
  const auto name = below(r.path, root_);
  if (!name) return refused(404, "no such page");
  if (name->starts_with(kApi) ? !is_api(*name) : !page_file(*name)) {
    return refused(404, "no such page");
  }
  const std::string expected = is_reading(*name) ? "GET" : "POST";
  if (r.method != expected) return refused(405, "expected the method " + expected);
  return std::nullopt;
}

WebReply DeskServer::answer(const WebRequest& request) {
  const std::string_view name = request.path.substr(root_.size());
  try {
    if (name.starts_with(kApi)) return answer_api(name.substr(kApi.size()), request.body);
    const std::optional<PageFile> file = page_file(name);
    if (!file) return refused(404, "no such page");
    return {200, file->type, file->text};
  } catch (const NameTaken& error) {
    return refused(409, error.what());
  } catch (const Stopped& error) {
    return refused(410, error.what());
  } catch (const Error& error) {
    return refused(error.fault() == Fault::kMemory ? 503 : 400, error.what());
  } catch (const std::bad_alloc&) {
    return refused(503, no_memory().what());
  } catch (const std::exception& error) {
    return refused(500, error.what());
  }
}

WebReply DeskServer::answer_api(std::string_view name, std::string_view body) {
  if (name == "desk") return {200, kJson, desk_json(desk_)};
  if (name == "picture") {
    const NewPicture asked = picture_request(body);
    if (asked.instead) desk_.break_off();
    return {200, kBytes, picture_bytes(desk_.paint(asked))};
  }
  if (name == "pixel") {
    const PixelRequest asked = pixel_request(body);
    return {200, kJson, pixel_json(asked, desk_.pixel(asked, asked.x, asked.y))};
  }
  if (name == "save") {
    const SaveRequest asked = save_request(body);
    return {200, kJson, text_json("saved", desk_.save(asked, asked.name, asked.replace).string())};
  }
  return {200, kJson, text_json("command", desk_.command(choice_request(body)))};
}

}  // namespace limpid
