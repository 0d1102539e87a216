#include "limpid/limpid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/type_ptr.hpp>

#include "limpid/compositor.h"
#include "limpid/core/error.h"
#include "limpid/shade/shader_text.h"
#include "limpid/version.h"

/// The C functions: they convert structs of C to those of compositor.h, and exceptions to a status.

namespace limpid {
namespace {

static_assert(LIMPID_BASIN + 1 == kPlaneCount);
static_assert(LIMPID_OUT_SURFACE_SHADOW + 3 == 4 + 3 * kAovCount);

/// Copies the first `size` bytes of the caller's struct; the rest is 0.
template <class Struct>
Struct known(const Struct* given, const char* name) {
  Struct whole{};
  if (!given) return whole;
  if (given->size < sizeof given->size || given->size > sizeof(Struct)) {
    throw Error(std::string(name) + ".size = " + std::to_string(given->size) +
                ": expected at most " + std::to_string(sizeof(Struct)) +
                ", the size in this library");
  }
  std::memcpy(&whole, given, given->size);
  return whole;
}

/// Fills the part of the caller's struct that the caller's version has.
template <class Struct>
void tell(Struct whole, Struct* to, const char* name) {
  if (!to) throw Error(std::string(name) + " is NULL, expected a place for one");
  whole.size = known(to, name).size;
  std::memcpy(to, &whole, whole.size);
}

template <class Enum>
Enum named(int value, Enum last, const char* name) {
  if (value < 0 || value > static_cast<int>(last)) {
    throw Error(std::string(name) + " = " + std::to_string(value) + ": expected 0 ... " +
                std::to_string(static_cast<int>(last)));
  }
  return static_cast<Enum>(value);
}

std::string text_of(const char* text, const char* name) {
  if (!text) throw Error(std::string(name) + " is NULL, expected a string");
  return text;
}

class HostExecutor final : public Executor {
 public:
  explicit HostExecutor(const limpid_executor& host) : host_(host) {}
  void run(int count, Task task, void* context) override {
    host_.run(host_.host, count, task, context);
  }

 private:
  limpid_executor host_;
};

std::unique_ptr<Executor> executor_of(const limpid_options& options) {
  if (!options.executor) return make_executor(options.threads);
  const limpid_executor host = known(options.executor, "limpid_executor");
  if (!host.run) throw Error("limpid_executor.run is NULL, expected a function");
  if (options.threads != 0) {
    throw Error("limpid_options has an executor and threads = " + std::to_string(options.threads) +
                ": expected one or the other");
  }
  return std::make_unique<HostExecutor>(host);
}

std::optional<GpuOptions> gpu_of(const limpid_options& options) {
  if (options.runner < LIMPID_RUNNER_FUSED || options.runner > LIMPID_RUNNER_GPU) {
    throw Error("limpid_options.runner = " + std::to_string(options.runner) +
                ": expected LIMPID_RUNNER_FUSED or LIMPID_RUNNER_GPU");
  }
  if (options.runner == LIMPID_RUNNER_GPU) {
    return GpuOptions{.device = options.gpu ? options.gpu : "",
                      .cache = options.gpu_cache ? options.gpu_cache : ""};
  }
  for (const char* text : {options.gpu, options.gpu_cache}) {
    if (!text) continue;
    throw Error("limpid_options names a GPU or a folder for it, '" + std::string(text) +
                "': expected LIMPID_RUNNER_GPU beside it");
  }
  return {};
}

Conventions conventions_of(const limpid_conventions& c) {
  return {.depth = named(c.depth, DepthKind::kDevice, "limpid_conventions.depth"),
          .near = c.near_depth,
          .far = c.far_depth,
          .clip = named(c.clip, ClipSpace::kReversed, "limpid_conventions.clip"),
          .looks_along_plus_z = c.looks_along_plus_z != 0,
          .clip_y_down = c.clip_y_down != 0,
          .trusted = c.trusted != 0};
}

Primaries primaries_of(const limpid_conventions& c) {
  if (!c.colorspace) return kRec709;
  try {
    return color_space_named(c.colorspace);
  } catch (const Error& e) {
    throw Error("limpid_conventions.colorspace: " + std::string(e.what()));
  }
}

glm::dmat4 matrix_of(const double* numbers, bool row_major) {
  const glm::dmat4 m = glm::make_mat4(numbers);
  return row_major ? glm::transpose(m) : m;
}

/// The channels of a list, each passed to place(id, view). `kinds` is the number of ids.
template <class Place>
void for_each_channel(const limpid_channel* list, std::size_t count, int kinds, Size size,
                      const char* name, Place&& place) {
  if (count > 0 && !list) throw Error(std::string(name) + " is NULL, expected channels");
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const limpid_channel& c = list[i];
    const auto refuse = [&](const std::string& why) {
      throw Error(std::string(name) + "[" + std::to_string(i) + "]." + why);
    };
    if (c.id < 0 || c.id >= kinds) {
      refuse("id = " + std::to_string(c.id) + ": expected 0 ... " + std::to_string(kinds - 1));
    }
    if ((seen >> c.id) & 1u) refuse("id = " + std::to_string(c.id) + ": it is given twice");
    if (c.sample != LIMPID_FLOAT && c.sample != LIMPID_HALF) {
      refuse("sample = " + std::to_string(c.sample) + ": expected LIMPID_FLOAT or LIMPID_HALF");
    }
    if (!c.data) refuse("data is NULL, expected pixels");
    seen |= std::uint64_t{1} << c.id;
    Rect window{c.x0, c.y0, c.x1, c.y1};
    if (window == Rect{}) window = rect_of(size);
    place(static_cast<std::size_t>(c.id),
          HostOutput{c.data, static_cast<Sample>(c.sample), c.x_stride, c.y_stride, window});
  }
}

Texture texture_of(const limpid_texture* given, const char* name) {
  const limpid_texture t = known(given, name);
  if (!given) return {};
  if (!t.data || t.width < 1 || t.height < 1 || t.channels < 3) {
    throw Error(std::string(name) + ": expected pixels of at least three channels");
  }
  constexpr std::ptrdiff_t kSize = sizeof(float);
  const std::ptrdiff_t row =
      t.y_stride != 0 ? t.y_stride / kSize : std::ptrdiff_t{t.width} * t.channels;
  if (t.y_stride % kSize != 0 || reinterpret_cast<std::uintptr_t>(t.data) % kSize != 0) {
    throw Error(std::string(name) +
                ": expected floats at whole multiples of their size, y_stride = " +
                std::to_string(t.y_stride));
  }
  Texture texture;
  for (std::size_t i = 0; i < 3; ++i) {
    texture.channels[i] = {t.data + i, t.channels, row, rect_of({t.width, t.height})};
  }
  return texture;
}

ShaderOptions shader_options_of(const limpid_shader_options* given) {
  const limpid_shader_options o = known(given, "limpid_shader_options");
  ShaderOptions options;
  options.stage = named(o.stage, ShaderOptions::Stage::kFragment, "limpid_shader_options.stage");
  if (o.function) options.function = o.function;
  options.set = o.set;
  options.first_binding = o.first_binding;
  const std::string name = "limpid_shader_options.aovs";
  if (o.aov_count > 0 && !o.aovs) throw Error(name + " is NULL, expected values of limpid_output");
  for (std::size_t i = 0; i < o.aov_count; ++i) {
    const int first = o.aovs[i];
    const auto refuse = [&](const std::string& why) {
      throw Error(name + "[" + std::to_string(i) + "] = " + std::to_string(first) + why);
    };
    if (first < LIMPID_OUT_TRANSMITTED || first > LIMPID_OUT_SKY ||
        (first - LIMPID_OUT_TRANSMITTED) % 3 != 0) {
      refuse(": expected the first channel of an AOV");
    }
    const auto aov = static_cast<Aov>((first - LIMPID_OUT_TRANSMITTED) / 3);
    if (std::find(options.aovs.begin(), options.aovs.end(), aov) != options.aovs.end()) {
      refuse(": it is given twice");
    }
    options.aovs.push_back(aov);
  }
  return options;
}

template <class Thing>
const Thing& at(const std::vector<Thing>& list, std::size_t index, const char* name) {
  if (index < list.size()) return list[index];
  throw Error(std::string(name) + " " + std::to_string(index) + " of a shader that has " +
              std::to_string(list.size()));
}

/// Runs body(); an exception becomes a status and, by say(), a sentence.
template <class Body, class Say>
limpid_status guarded(Body&& body, Say&& say) noexcept {
  try {
    body();
    return LIMPID_OK;
  } catch (const Error& e) {
    say(e.what());
    return e.fault() == Fault::kMemory ? LIMPID_NO_MEMORY : LIMPID_REFUSED;
  } catch (const std::bad_alloc&) {
    say("out of memory");
    return LIMPID_NO_MEMORY;
  } catch (const std::exception& e) {
    say(e.what());
    return LIMPID_FAILED;
  } catch (...) {
    say("unknown exception");
    return LIMPID_FAILED;
  }
}

/// The error of the last call that failed.
struct Message {
  char text[1024] = "";

  /// Keeps an error; never allocates.
  template <class Body>
  limpid_status guarded(Body&& body) noexcept {
    return limpid::guarded(body,
                           [&](const char* why) { std::strncpy(text, why, sizeof text - 1); });
  }
};

}  // namespace
}  // namespace limpid

struct limpid_shader {
  limpid::ShaderText made;
  limpid::Message message = {};
};

struct limpid_compositor {
  std::unique_ptr<limpid::Executor> executor;
  limpid::Compositor compositor;
  bool row_major;
  limpid::HostFrame frame;  ///< of the last run: keeps the memory of waves, and the primaries
  limpid::Message message = {};

  void set(const char* table, const char* key, const limpid::Value& value) {
    limpid::Look look = compositor.look();
    look.set(limpid::text_of(table, "table"), limpid::text_of(key, "key"), value);
    compositor.set_look(look);
  }

  void enter(const limpid_frame& host) {
    const limpid::Size size{host.width, host.height};
    frame.display = limpid::rect_of(size);
    frame.planes = {};
    limpid::for_each_channel(
        host.planes, host.plane_count, limpid::kPlaneCount, size, "limpid_frame.planes",
        [&](std::size_t what, const limpid::HostOutput& view) { frame.planes[what] = view; });
    limpid::Scene& scene = frame.scene;
    scene.camera = limpid::Camera{limpid::matrix_of(host.view, row_major),
                                  limpid::matrix_of(host.projection, row_major)};
    if (!scene.water) scene.water.emplace();
    scene.water->up = glm::make_vec3(host.water_up);
    const double length = glm::length(scene.water->up);
    if (!(length > 0) || std::isinf(length)) {
      throw limpid::Error("limpid_frame.water_up has length " + std::to_string(length) +
                          ": expected a direction");
    }
    scene.water->up /= length;
    scene.water->height = host.water_height;
    if (host.wave_count > 0 && !host.waves) {
      throw limpid::Error("limpid_frame.waves is NULL, expected rows of 5 numbers");
    }
    scene.water->waves.clear();
    for (std::size_t i = 0; i < host.wave_count; ++i) {
      const double* w = host.waves + 5 * i;
      scene.water->waves.push_back({w[0], w[1], w[2], w[3], w[4]});
    }
    scene.sun.reset();
    if (host.has_sun) {
      const glm::dvec3 direction = glm::make_vec3(host.sun_direction);
      const double far = glm::length(direction);
      scene.sun = limpid::Sun{far > 0 ? direction / far : direction,
                              {host.sun_color[0], host.sun_color[1], host.sun_color[2]}};
    }
    scene.sky.reset();
    if (host.has_sky) {
      const double* sky = host.sky_radiance;
      scene.sky = limpid::SkyLight{{sky[0], sky[1], sky[2]}};
    }
    scene.time = host.time;
  }
};

namespace {

/// Runs body() on a compositor or a shader, if the pointer is not null.
template <class Handle, class Body>
limpid_status on(Handle* handle, Body&& body) noexcept {
  return handle ? handle->message.guarded(body) : LIMPID_REFUSED;
}

/// As limpid_look_text() says.
template <class Text>
size_t copy_text(char* to, size_t size, Text&& text) noexcept {
  if (to && size > 0) to[0] = 0;
  size_t length = 0;
  limpid::guarded(
      [&] {
        const std::string whole = text();
        length = whole.size();
        if (!to || size == 0) return;
        const size_t count = std::min(length, size - 1);
        std::memcpy(to, whole.data(), count);
        to[count] = 0;
      },
      [](const char*) {});
  return length;
}

}  // namespace

const char* limpid_version(void) { return limpid::kVersion; }

limpid_status limpid_create(const limpid_conventions* conventions, const limpid_options* options,
                            limpid_compositor** compositor, char* message, size_t message_size) {
  if (compositor) *compositor = nullptr;
  return limpid::guarded(
      [&] {
        using namespace limpid;
        if (!compositor) throw Error("compositor is NULL, expected a place for one");
        const limpid_conventions c = known(conventions, "limpid_conventions");
        const limpid_options o = known(options, "limpid_options");
        std::unique_ptr<Executor> executor = executor_of(o);
        Compositor made(conventions_of(c), {},
                        {.executor = executor.get(),
                         .simd = o.simd ? o.simd : "",
                         .max_error = o.max_error,
                         .gpu = gpu_of(o)});
        HostFrame frame;
        frame.scene.primaries = primaries_of(c);
        *compositor = new limpid_compositor{std::move(executor), std::move(made), c.row_major != 0,
                                            std::move(frame)};
      },
      [&](const char* why) {
        if (!message || message_size == 0) return;
        std::strncpy(message, why, message_size - 1);
        message[message_size - 1] = 0;
      });
}

void limpid_destroy(limpid_compositor* compositor) { delete compositor; }

const char* limpid_message(const limpid_compositor* compositor) {
  return compositor ? compositor->message.text : "compositor is NULL";
}

limpid_status limpid_set_number(limpid_compositor* compositor, const char* table, const char* key,
                                double value) {
  return on(compositor, [&] { compositor->set(table, key, value); });
}

limpid_status limpid_set_word(limpid_compositor* compositor, const char* table, const char* key,
                              const char* word) {
  return on(compositor, [&] { compositor->set(table, key, limpid::text_of(word, "word")); });
}

limpid_status limpid_set_color(limpid_compositor* compositor, const char* table, const char* key,
                               const double rgb[3]) {
  return on(compositor, [&] {
    if (!rgb) throw limpid::Error("rgb is NULL, expected three numbers");
    compositor->set(table, key, limpid::Rgb<double>{rgb[0], rgb[1], rgb[2]});
  });
}

limpid_status limpid_set_rows(limpid_compositor* compositor, const char* table, const char* key,
                              const double* numbers, size_t rows, size_t columns) {
  return on(compositor, [&] {
    if (!numbers && rows > 0) throw limpid::Error("numbers is NULL, expected rows");
    limpid::Rows all;
    for (size_t i = 0; i < rows; ++i) {
      all.emplace_back(numbers + i * columns, numbers + (i + 1) * columns);
    }
    compositor->set(table, key, all);
  });
}

limpid_status limpid_reset_look(limpid_compositor* compositor) {
  return on(compositor, [&] { compositor->compositor.set_look({}); });
}

limpid_status limpid_set_wave_map(limpid_compositor* compositor, const limpid_texture* map) {
  return on(compositor, [&] {
    compositor->compositor.set_wave_map(limpid::texture_of(map, "limpid_texture of the wave map"));
  });
}

limpid_status limpid_set_environment(limpid_compositor* compositor,
                                     const limpid_texture* environment) {
  return on(compositor, [&] {
    compositor->compositor.set_environment(
        limpid::texture_of(environment, "limpid_texture of the environment"));
  });
}

limpid_status limpid_run(limpid_compositor* compositor, const limpid_frame* frame,
                         const limpid_picture* picture) {
  return on(compositor, [&] {
    using namespace limpid;
    if (!frame) throw Error("frame is NULL");
    if (!picture) throw Error("picture is NULL");
    const limpid_frame host = known(frame, "limpid_frame");
    const limpid_picture out = known(picture, "limpid_picture");
    compositor->enter(host);
    HostPicture target;
    for_each_channel(out.outputs, out.output_count, LIMPID_OUT_SKY + 3, {host.width, host.height},
                     "limpid_picture.outputs", [&](std::size_t what, const HostOutput& view) {
                       HostOutput& place = what < 3 ? target.color[what]
                                           : what == 3
                                               ? target.alpha
                                               : target.aovs[(what - 4) / 3][(what - 4) % 3];
                       place = view;
                     });
    compositor->compositor.run(compositor->frame, target);
  });
}

size_t limpid_look_text(const limpid_compositor* compositor, char* text, size_t size) {
  return copy_text(text, size, [&] {
    return compositor ? to_toml(compositor->compositor.look()) : std::string();
  });
}

size_t limpid_plan_text(const limpid_compositor* compositor, char* text, size_t size) {
  return copy_text(text, size, [&] {
    return compositor ? to_text(compositor->compositor.plan()) : std::string();
  });
}

size_t limpid_replaced_text(const limpid_compositor* compositor, char* text, size_t size) {
  return copy_text(text, size, [&] {
    return compositor ? compositor->compositor.replaced().to_text() : std::string();
  });
}

size_t limpid_device_text(const limpid_compositor* compositor, char* text, size_t size) {
  return copy_text(text, size,
                   [&] { return compositor ? compositor->compositor.device() : std::string(); });
}

limpid_status limpid_create_shader(limpid_compositor* compositor, const limpid_frame* frame,
                                   const limpid_shader_options* options, limpid_shader** shader) {
  if (shader) *shader = nullptr;
  return on(compositor, [&] {
    using namespace limpid;
    if (!shader) throw Error("shader is NULL, expected a place for one");
    if (!frame) throw Error("frame is NULL");
    const limpid_frame host = known(frame, "limpid_frame");
    const ShaderOptions wanted = shader_options_of(options);
    compositor->enter(host);
    *shader = new limpid_shader{compositor->compositor.shader(compositor->frame, wanted)};
  });
}

void limpid_destroy_shader(limpid_shader* shader) { delete shader; }

const char* limpid_shader_message(const limpid_shader* shader) {
  return shader ? shader->message.text : "shader is NULL";
}

limpid_status limpid_get_shader(limpid_shader* shader, limpid_shader_info* info) {
  return on(shader, [&] {
    const limpid::ShaderText& made = shader->made;
    limpid_shader_info whole{};
    whole.text = made.text().c_str();
    whole.id = made.id().c_str();
    whole.function = made.options().function.c_str();
    whole.stage = static_cast<int32_t>(made.options().stage);
    whole.set = made.options().set;
    whole.block_binding = made.block_binding();
    whole.block = made.block().data();
    whole.block_size = made.block().size();
    whole.number_count = made.numbers().size();
    whole.texture_count = made.textures().size();
    whole.output_count = made.outputs().size();
    const limpid::Rect& work = made.work();
    whole.x0 = work.x0, whole.y0 = work.y0, whole.x1 = work.x1, whole.y1 = work.y1;
    limpid::tell(whole, info, "limpid_shader_info");
  });
}

limpid_status limpid_get_shader_number(limpid_shader* shader, size_t index,
                                       limpid_shader_number* number) {
  return on(shader, [&] {
    const limpid::ShaderNumber& of = limpid::at(shader->made.numbers(), index, "number");
    const limpid::Range range = of.range.value_or(limpid::Range{});
    limpid::tell({0, of.name.c_str(), of.offset, of.value, of.range.has_value(),
                  of.range ? range.min : 0, of.range ? range.max : 0},
                 number, "limpid_shader_number");
  });
}

limpid_status limpid_get_shader_texture(limpid_shader* shader, size_t index,
                                        limpid_shader_texture* texture) {
  return on(shader, [&] {
    const limpid::ShaderTexture& of = limpid::at(shader->made.textures(), index, "texture");
    const int plane = of.role.empty() ? -1 : limpid::index_of(limpid::role_named(of.role).first);
    limpid::tell(
        {0, of.name.c_str(), of.binding, static_cast<int32_t>(of.source), of.role.c_str(), plane,
         of.channels, of.width, of.height, of.texels.empty() ? nullptr : of.texels.data()},
        texture, "limpid_shader_texture");
  });
}

limpid_status limpid_get_shader_output(limpid_shader* shader, size_t index,
                                       limpid_shader_output* output) {
  return on(shader, [&] {
    const limpid::ShaderOutput& of = limpid::at(shader->made.outputs(), index, "output");
    limpid::tell({0, of.name.c_str(), of.channels, of.binding}, output, "limpid_shader_output");
  });
}
