// The only source that includes OpenImageIO; built as limpid_formats.so, which formats.cpp loads.
#include <algorithm>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <OpenImageIO/color.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include "files/picture/formats_abi.h"

namespace limpid::formats {
namespace {

// Still-picture formats whose readers refuse truncated files, as tested. OpenImageIO also offers
// videos, volumes, readers that turn missing pixels black, and a `null` format that invents pixels.
const std::set<std::string> kFormats = {"bmp", "dpx", "gif",   "hdr",  "jpeg2000", "pnm",
                                        "rla", "sgi", "targa", "tiff", "webp"};

constexpr int kRowsAtOnce = 64;

void check(bool ok, const std::string& phrase) {
  if (!ok) throw std::runtime_error(phrase);
}

// OpenImageIO's message on one line, or `otherwise` if it has none.
std::string message(std::string text, const char* otherwise) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? otherwise : text;
}

// Runs the work of one call; converts any exception to text.
template <class Work>
int guarded(char* error, Work work) {
  try {
    work();
    return 0;
  } catch (const std::bad_alloc&) {
    return kNoMemory;
  } catch (const std::exception& e) {
    std::strncpy(error, e.what(), kErrorSize - 1);
  } catch (...) {
    std::strncpy(error, "unknown exception in OpenImageIO", kErrorSize - 1);
  }
  error[kErrorSize - 1] = '\0';
  return 1;
}

// A limpid program decides about its threads itself. Set once, before any other call of
// OpenImageIO: its pool must not be resized while another thread uses it.
void stay_on_this_thread() {
  static const bool said = OIIO::attribute("threads", 1) && OIIO::attribute("exr_threads", -1);
  check(said, "OpenImageIO cannot be held to one thread");
}

void check_limits(const OIIO::ImageSpec& spec, const FormatsLimits& limits) {
  const std::int64_t width = spec.width, height = spec.height, channels = spec.nchannels;
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  check(width > 0 && height > 0 && channels > 0,
        size + " pixels of " + std::to_string(channels) + " channels: expected at least 1x1 of 1");
  check(std::max(width, height) <= limits.max_side,
        size + " pixels: expected sides of at most " + std::to_string(limits.max_side));
  check(width * height <= limits.max_pixels,
        size + " pixels: expected at most " + std::to_string(limits.max_pixels) + " in all");
  check(channels <= limits.max_channels, std::to_string(channels) + " channels: expected at most " +
                                             std::to_string(limits.max_channels));
  const std::int64_t bytes = width * height * channels * std::int64_t{sizeof(float)};
  check(bytes <= limits.max_memory, "needs " + std::to_string(bytes) +
                                        " bytes of memory: expected at most " +
                                        std::to_string(limits.max_memory));
  for (const std::int64_t offset :
       {std::int64_t{spec.x} - spec.full_x, std::int64_t{spec.y} - spec.full_y}) {
    check(std::max(offset, -offset) <= limits.max_side,
          "window starts at " + std::to_string(offset) + ": expected at most " +
              std::to_string(limits.max_side) + " pixels off the display window");
  }
}

// The host's memory for the pixels.
struct Target {
  std::vector<float*> planes;
  std::ptrdiff_t stride = 0;
};

// Reads a few rows at a time as T, where `largest` becomes 1 in the float planes.
template <class T>
void read_pixels(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, float largest,
                 const Target& target) {
  constexpr auto kType = OIIO::BaseTypeFromC<T>::value;
  const int rows_at_once = spec.tile_height > 0 ? spec.tile_height : kRowsAtOnce;
  const std::ptrdiff_t channels = spec.nchannels;
  std::vector<T> band(static_cast<std::size_t>(spec.width) * channels *
                      std::min(rows_at_once, spec.height));
  for (int y = 0; y < spec.height; y += rows_at_once) {
    const int end = std::min(y + rows_at_once, spec.height);
    const bool ok =
        spec.tile_width > 0
            ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z,
                               spec.z + 1, 0, spec.nchannels, kType, band.data())
            : input.read_scanlines(0, 0, spec.y + y, spec.y + end, spec.z, 0, spec.nchannels, kType,
                                   band.data());
    // Some readers fill in missing pixels, set an error message, and report success.
    const std::string said = input.geterror();
    check(ok && said.empty(), message(said, "its pixels are damaged or end too early"));
    for (std::ptrdiff_t c = 0; c < channels; ++c) {
      const T* from = band.data() + c;
      for (int row = y; row < end; ++row) {
        float* to = target.planes[c] + row * target.stride;
        for (int x = 0; x < spec.width; ++x, from += channels) {
          to[x] = static_cast<float>(*from) / largest;
        }
      }
    }
  }
}

void read(const char* path, const FormatsLimits& limits, FormatsAllocate* allocate, void* host) {
  stay_on_this_thread();
  OIIO::ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(path, &as_stored);
  check(input != nullptr, message(OIIO::geterror(), "its format is not known"));
  const std::string format = input->format_name();
  if (!kFormats.contains(format)) {
    throw std::runtime_error("its format is " + format + ": expected one of " +
                             OIIO::Strutil::join(kFormats, ", "));
  }
  const OIIO::ImageSpec spec = input->spec();
  check(!spec.deep && spec.depth <= 1, "deep samples or a volume: expected one value a pixel");
  check_limits(spec, limits);

  std::vector<const char*> names;
  for (int c = 0; c < spec.nchannels; ++c) names.push_back(spec.channelnames.at(c).c_str());
  const bool straight =
      spec.alpha_channel >= 0 && spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
  const FormatsHeader header = {spec.x - spec.full_x, spec.y - spec.full_y, spec.width,
                                spec.height,          spec.nchannels,       straight,
                                names.data()};
  Target target{std::vector<float*>(names.size())};
  check(allocate(host, &header, target.planes.data(), &target.stride) == 0,
        "no memory for its pixels");
  if (spec.format == OIIO::TypeUInt8 && spec.channelformats.empty()) {
    read_pixels<std::uint8_t>(*input, spec, 255, target);
  } else if (spec.format == OIIO::TypeUInt16 && spec.channelformats.empty()) {
    read_pixels<std::uint16_t>(*input, spec, 65535, target);
  } else {
    read_pixels<float>(*input, spec, 1, target);
  }
}

void write8(const char* format, int width, int height, int channels, const std::uint8_t* pixels,
            FormatsTake* take, void* host) {
  stay_on_this_thread();
  // In memory, because on a full disk OpenImageIO's writers end the program or report success.
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput file(bytes);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  check(output != nullptr, message(OIIO::geterror(), "cannot be written"));
  check(output->supports("ioproxy"), std::string(format) + " cannot be written");
  check(channels == 3 || output->supports("alpha"),
        std::string(format) + " has no alpha: expected 3 channels");
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeUInt8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);
  // Fixed, so that the file does not contain the time of writing.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  // Its directory is linked by reading the file back, which fails in memory.
  spec.attribute("tiff:write_exif", 0);
  check(output->set_ioproxy(&file), message(output->geterror(), "cannot be encoded"));
  check(output->open(std::string("memory.") + format, spec),
        message(output->geterror(), "cannot be encoded"));
  const bool written = output->write_image(OIIO::TypeUInt8, pixels);
  const bool closed = output->close();
  const std::string said = output->geterror();
  check(written && closed && said.empty(), message(said, "cannot be encoded"));
  check(take(host, bytes.data(), bytes.size()) == 0, "its bytes were not written");
}

/// Parsed configs: each once, for the rest of the program.
const OIIO::ColorConfig& config_at(const std::string& path) {
  static std::mutex mutex;
  static std::map<std::string, std::unique_ptr<OIIO::ColorConfig>> configs;
  const std::lock_guard lock(mutex);
  std::unique_ptr<OIIO::ColorConfig>& config = configs[path];
  if (!config) {
    stay_on_this_thread();
    check(OIIO::ColorConfig::supportsOpenColorIO(), "this OpenImageIO has no OpenColorIO");
    auto read = std::make_unique<OIIO::ColorConfig>(path);
    check(!read->has_error(), message(read->geterror(), "is not an OpenColorIO config"));
    config = std::move(read);
  }
  return *config;
}

/// The default name first.
std::vector<std::string> default_first(std::vector<std::string> names, const char* chosen) {
  const auto at = std::find(names.begin(), names.end(), chosen ? chosen : "");
  if (at != names.end()) std::rotate(names.begin(), at, at + 1);
  return names;
}

void list_config(const char* path, FormatsTake* take, void* host) {
  const OIIO::ColorConfig& config = config_at(path);
  std::string lines;
  const auto add = [&](std::string_view kind, const std::string& name) {
    if (name.find('\n') == std::string::npos) lines += std::string(kind) + name + "\n";
  };
  for (const std::string& space : config.getColorSpaceNames()) {
    add(kSpaceLine, space);
    for (const std::string& alias : config.getAliases(space)) add(kSpaceLine, alias);
  }
  for (const std::string& display :
       default_first(config.getDisplayNames(), config.getDefaultDisplayName())) {
    for (const std::string& view :
         default_first(config.getViewNames(display), config.getDefaultViewName(display))) {
      add(kViewLine, display + "/" + view);
    }
  }
  check(take(host, lines.data(), lines.size()) == 0, "its names were not taken");
}

}  // namespace

struct FormatsDisplay {
  OIIO::ColorProcessorHandle processor;
};

unsigned limpid_formats_abi() { return kFormatsAbi; }

int limpid_formats_read(const char* path, const FormatsLimits* limits, FormatsAllocate* allocate,
                        void* host, char* error) {
  return guarded(error, [&] { read(path, *limits, allocate, host); });
}

int limpid_formats_write8(const char* format, int width, int height, int channels,
                          const std::uint8_t* pixels, FormatsTake* take, void* host, char* error) {
  return guarded(error, [&] { write8(format, width, height, channels, pixels, take, host); });
}

int limpid_formats_config(const char* config, FormatsTake* take, void* host, char* error) {
  return guarded(error, [&] { list_config(config, take, host); });
}

int limpid_formats_open_display(const char* config, const char* space, const char* display,
                                const char* view, FormatsDisplay** opened, char* error) {
  return guarded(error, [&] {
    const OIIO::ColorConfig& known = config_at(config);
    auto made = std::make_unique<FormatsDisplay>();
    made->processor = known.createDisplayTransform(display, view, space);
    check(made->processor != nullptr,
          "its view " + std::string(display) + "/" + view + " of " + space + " cannot be made");
    *opened = made.release();
  });
}

int limpid_formats_display(const FormatsDisplay* display, float* rgb, int pixels, char* error) {
  constexpr OIIO::stride_t kSample = sizeof(float);
  return guarded(error, [&] {
    display->processor->apply(rgb, pixels, 1, 3, kSample, 3 * kSample, 3 * kSample * pixels);
  });
}

void limpid_formats_close_display(FormatsDisplay* display) { delete display; }

}  // namespace limpid::formats
