#include "limpid/files/picture/display.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include <glm/vec3.hpp>

#include "limpid/core/error.h"
#include "limpid/files/picture/preview.h"

#include "files/picture/formats.h"

namespace limpid {
namespace {

constexpr const char* kOcio = "OpenColorIO needs";
constexpr const char* kWithout = "; --display sRGB needs no OpenColorIO";

/// Throws the text in `error` of a format module's function as an Error.
[[noreturn]] void refuse(const std::filesystem::path& config, int code, const char* error) {
  if (code == formats::kNoMemory) throw no_memory(config.string());
  throw Error(config.string() + ": " + error + kWithout);
}

/// Color spaces (with their aliases) and views of a config.
struct Config {
  std::vector<std::string> spaces, views;
};

Config config_of(const std::filesystem::path& path) {
  std::string lines;
  const auto take = [](void* host, const void* bytes, std::size_t size) {
    static_cast<std::string*>(host)->assign(static_cast<const char*>(bytes), size);
    return 0;
  };
  std::array<char, formats::kErrorSize> error{};
  const int code =
      formats::module(path.string(), kOcio).config(path.c_str(), take, &lines, error.data());
  if (code != 0) refuse(path, code, error.data());
  Config config;
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = lines.find('\n', at);
    const std::string line = lines.substr(at, end - at);
    if (line.starts_with(formats::kSpaceLine)) {
      config.spaces.push_back(line.substr(formats::kSpaceLine.size()));
    } else {
      config.views.push_back(line.substr(formats::kViewLine.size()));
    }
    at = end + 1;
  }
  return config;
}

/// A view of the list: by its full name, or as a view of the first display.
std::string view_named(const std::string& name, const std::vector<std::string>& views,
                       const std::filesystem::path& config) {
  if (views.empty()) {
    throw Error(config.string() + ": expected an OpenColorIO config with views" + kWithout);
  }
  if (name.empty()) return views.front();
  const std::string first = views.front().substr(0, views.front().find('/') + 1);
  for (const std::string& view : views) {
    if (view == name || view == first + name) return view;
  }
  throw Error("view '" + name + "' of " + config.string() + ": expected sRGB or one of " +
                  join(views) + did_you_mean(name, views),
              Fault::kUsage);
}

/// Whether a config's space of that name is linear: by its name, or because it is an ACES space. A
/// config's "Rec.709" is display-encoded.
bool says_linear(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name.find("lin") != std::string::npos || name.find("ap0") != std::string::npos ||
         name.find("ap1") != std::string::npos || name.find("aces") != std::string::npos;
}

/// The config's space for light of these primaries, or another known one.
struct Entry {
  std::string space;
  Primaries primaries;
};
Entry entry_of(const Config& config, const Primaries& primaries,
               const std::filesystem::path& path) {
  std::optional<Entry> other;
  for (const std::string& name : config.spaces) {
    const auto known = find_color_space(name);
    if (!known || !says_linear(name)) continue;
    if (agree(*known, primaries)) return {name, *known};
    if (!other) other = {name, *known};
  }
  if (other) return *other;
  throw Error(path.string() + ": expected a linear color space with a known name of one of " +
              join(color_space_names()) + kWithout);
}

/// Clamped to finite values, because a matrix would make NaN of infinities.
float finite(float light, float gain) {
  return std::isnan(light) ? 0.0f : std::clamp(light * gain, -1e30f, 1e30f);
}

}  // namespace

struct __attribute__((visibility("hidden"))) DisplayTransform::Ocio {
  Ocio(const std::filesystem::path& path, const std::string& space, const std::string& view)
      : config(path), module(formats::module(path.string(), kOcio)) {
    const std::size_t slash = view.find('/');
    std::array<char, formats::kErrorSize> error{};
    const int code = module.open_display(path.c_str(), space.c_str(), view.substr(0, slash).c_str(),
                                         view.substr(slash + 1).c_str(), &display, error.data());
    if (code != 0) refuse(path, code, error.data());
  }
  ~Ocio() { module.close_display(display); }
  Ocio(const Ocio&) = delete;
  Ocio& operator=(const Ocio&) = delete;

  void apply(std::vector<float>& rgb) const {
    std::array<char, formats::kErrorSize> error{};
    const int code =
        module.display(display, rgb.data(), static_cast<int>(rgb.size() / 3), error.data());
    if (code != 0) refuse(config, code, error.data());
  }

  std::filesystem::path config;
  const formats::Module& module;
  formats::FormatsDisplay* display = nullptr;
};

std::vector<std::string> display_views(const std::filesystem::path& config) {
  return config_of(config).views;
}

std::string display_view(const std::filesystem::path& config, const std::string& name) {
  return view_named(name, display_views(config), config);
}

DisplayTransform::DisplayTransform(const DisplayChoice& choice, const Primaries& primaries)
    : exposure_(choice.exposure) {
  if (!(std::abs(exposure_) <= 100)) {
    throw Error("exposure = " + std::to_string(exposure_) + ": expected -100 ... 100 (stops)");
  }
  Primaries shown = kRec709;
  if (!choice.config.empty()) {
    const Config config = config_of(choice.config);
    const std::string view = view_named(choice.view, config.views, choice.config);
    const Entry entry = entry_of(config, primaries, choice.config);
    ocio_ = std::make_shared<Ocio>(choice.config, entry.space, view);
    shown = entry.primaries;
  }
  if (!agree(primaries, shown)) matrix_ = glm::mat3(rgb_from_rgb(shown, primaries));
}

std::array<Plane, 3> DisplayTransform::displayed(
    const std::array<View<const float>, 3>& light) const {
  if (!matrix_ && !ocio_) {
    return {limpid::displayed(light[0], exposure_), limpid::displayed(light[1], exposure_),
            limpid::displayed(light[2], exposure_)};
  }
  const Rect window = light[0].window;
  std::array<Plane, 3> planes{Plane(window), Plane(window), Plane(window)};
  const auto gain = static_cast<float>(std::exp2(exposure_));
  std::vector<float> row(std::size_t{3} * window.width());
  for (int y = window.y0; y < window.y1; ++y) {
    float* to = row.data();
    for (int x = window.x0; x < window.x1; ++x, to += 3) {
      glm::vec3 c(finite(light[0].at(x, y), gain), finite(light[1].at(x, y), gain),
                  finite(light[2].at(x, y), gain));
      if (matrix_) c = *matrix_ * c;
      for (int i = 0; i < 3; ++i) to[i] = c[i];
    }
    if (ocio_) ocio_->apply(row);
    const float* from = row.data();
    for (int x = window.x0; x < window.x1; ++x, from += 3) {
      for (std::size_t i = 0; i < 3; ++i) {
        const float value = from[i];
        planes[i].view().at(x, y) = ocio_       ? value
                                    : value > 0 ? srgb_from_linear(std::fmin(value, 1.0f))
                                                : 0.0f;
      }
    }
  }
  return planes;
}

}  // namespace limpid
