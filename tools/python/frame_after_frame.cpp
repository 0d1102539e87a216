#include "frame_after_frame.h"

#include <vector>

#include "limpid/core/error.h"

#include "arrays.h"
#include "looks.h"
#include "shaders.h"
#include "values.h"

namespace limpid::python {
namespace {

namespace py = pybind11;

Conventions conventions_of(const py::dict& keywords) {
  const std::vector<std::string> kinds = {"eye", "ray", "inverse", "normalised", "device"};
  Conventions c;
  c.depth = static_cast<DepthKind>(
      choice_of(word_of(keywords["depth_kind"], "depth_kind"), "depth_kind", kinds));
  c.clip = clip_named(word_of(keywords["clip"], "clip"));
  c.near = number_in(keywords["near"], "near");
  c.far = number_in(keywords["far"], "far");
  c.looks_along_plus_z = flag_in(keywords["looks_along_plus_z"], "looks_along_plus_z");
  c.clip_y_down = flag_in(keywords["clip_y_down"], "clip_y_down");
  c.trusted = flag_in(keywords["trusted"], "trusted");
  return c;
}

std::optional<GpuOptions> gpu_of(const py::dict& keywords) {
  const std::string runner = word_of(keywords["runner"], "runner");
  GpuOptions gpu{.device = word_of(keywords["gpu"], "gpu"),
                 .cache = word_of(keywords["gpu_cache"], "gpu_cache")};
  if (choice_of(runner, "runner", {"fused", "gpu"}) == 1) return gpu;
  const std::string named = gpu.device.empty() ? gpu.cache.string() : gpu.device;
  if (named.empty()) return {};
  throw Error("gpu or gpu_cache is '" + named + "', expected runner='gpu' beside it");
}

Look changed(const py::dict& changes) {
  Look look;
  change(look, changes);
  return look;
}

Scene scene_of(const py::dict& dict) {
  Scene scene;
  scene.camera = Camera{matrix_of(dict["view"], "camera.view"),
                        matrix_of(dict["projection"], "camera.projection")};
  scene.water = water_of(dict["water"]);
  if (const py::object sun = dict["sun"]; !sun.is_none()) scene.sun = sun_of(sun);
  if (const py::object sky = dict["sky_radiance"]; !sky.is_none()) scene.sky = sky_of(sky);
  scene.time = number_in(dict["time"], "time");
  return scene;
}

/// In the pixels of color.
Rect display_of(const py::object& object, Size color) {
  if (object.is_none()) return rect_of(color);
  const auto numbers = numbers_of(object);
  const Rect all = rect_of(color);
  Rect display;
  int* const sides[] = {&display.x0, &display.y0, &display.x1, &display.y1};
  bool good = numbers && numbers->size() == 4;
  for (std::size_t i = 0; good && i < 4; ++i) {
    const double side = (*numbers)[i];
    good = side >= 0 && side <= std::max(all.x1, all.y1) && side == std::floor(side);
    if (good) *sides[i] = static_cast<int>(side);
  }
  if (good && !display.empty() && all.contains(display)) return display;
  throw Error("display is " + py::repr(object).cast<std::string>() +
              ", expected whole numbers (x0, y0, x1, y1) of a window in the " +
              std::to_string(color.width) + "x" + std::to_string(color.height) +
              " pixels of color");
}

Sample sample_of(const std::string& dtype) {
  return choice_of(dtype, "dtype", {"float32", "float16"}) == 0 ? Sample::kFloat : Sample::kHalf;
}

/// The array that is given, or a fresh one.
py::object array_or_new(const py::object& given, Size size, int channels, Sample sample) {
  return given.is_none() ? py::object(new_array(size, channels, sample)) : given;
}

/// Planes lie where their arrays are.
struct ArrayFrame {
  HostFrame frame;
  Rect window;   ///< of color, that the camera's picture has
  int channels;  ///< of color
};

ArrayFrame frame_of(const py::dict& planes, const py::dict& scene, const Primaries& primaries,
                    const py::object& display) {
  const Picture color = picture_of(planes["color"], "color");
  const int channels = color.channels;
  if (channels != 3 && channels != 4) expect(color, "color", color.size, 4);
  ArrayFrame made{{}, display_of(display, color.size), channels};
  HostFrame& frame = made.frame;
  frame.display = rect_of(made.window.size());
  frame.scene = scene_of(scene);
  frame.scene.primaries = primaries;
  for (const auto& [name, array] : planes) {
    const Role& role = role_named(word_of(name, "a plane"));
    const std::string role_name(role.name);
    const bool is_color = role.first == PlaneId::kColorR;
    const Picture picture = picture_of(array, role_name);
    expect(picture, role_name, color.size, is_color ? channels : role.count);
    for (int c = 0; c < picture.channels; ++c) {
      frame.plane(plane_after(role.first, c)) =
          input_of(picture, c, -made.window.x0, -made.window.y0);
    }
  }
  return made;
}

/// Until the end of its block no other call may use the compositor. Under the interpreter's
/// lock when made and when left.
class Busy {
 public:
  explicit Busy(bool& flag) : flag_(flag) {
    if (flag) {
      throw Error("the compositor is at work in another thread, expected one for each");
    }
    flag_ = true;
  }
  ~Busy() { flag_ = false; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  bool& flag_;
};

const char* verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kKept:
      return "kept";
    case Verdict::kNeutral:
      return "neutral";
    case Verdict::kAbsent:
      return "absent";
    case Verdict::kUnread:
      return "unread";
    case Verdict::kInvisible:
      return "invisible";
  }
  return "";
}

}  // namespace

FrameAfterFrame::FrameAfterFrame(const py::dict& conventions, const py::dict& look, int threads,
                                 const std::string& simd, double max_error, const py::dict& runner)
    : primaries_(primaries_of(conventions["colorspace"], "colorspace")),
      executor_(make_executor(threads)),
      compositor_(std::make_unique<Compositor>(conventions_of(conventions), changed(look),
                                               CompositorOptions{.executor = executor_.get(),
                                                                 .simd = simd,
                                                                 .max_error = max_error,
                                                                 .gpu = gpu_of(runner)})) {}

void FrameAfterFrame::change_look(const py::dict& changes) {
  const Busy busy(busy_);
  Look look = compositor_->look();
  change(look, changes);
  compositor_->set_look(look);
}

py::dict FrameAfterFrame::look() const {
  const Busy busy(busy_);
  return dict_of(compositor_->look());
}

void FrameAfterFrame::set_wave_map(const py::object& array) {
  const Busy busy(busy_);
  compositor_->set_wave_map(
      array.is_none() ? Texture{} : texture_of(picture_of(array, "wave_map"), "wave_map", false));
  wave_map_ = array;
}

void FrameAfterFrame::set_environment(const py::object& array) {
  const Busy busy(busy_);
  compositor_->set_environment(
      array.is_none() ? Texture{}
                      : texture_of(picture_of(array, "environment"), "environment", true));
  environment_ = array;
}

py::tuple FrameAfterFrame::run(const py::dict& planes, const py::dict& scene,
                               const py::object& display, const py::object& out,
                               const std::string& dtype, const py::dict& aov_arrays) {
  const Busy busy(busy_);
  const auto [frame, window, channels] = frame_of(planes, scene, primaries_, display);

  HostPicture picture;
  const py::object wet = array_or_new(out, window.size(), channels, sample_of(dtype));
  const Picture wet_picture = writable_picture_of(wet, "out");
  expect(wet_picture, "out", window.size(), wet_picture.channels == 3 ? 3 : 4);
  for (int c = 0; c < 3; ++c) picture.color[c] = output_of(wet_picture, c);
  if (wet_picture.channels == 4) picture.alpha = output_of(wet_picture, 3);
  py::dict aovs_made;
  for (const auto& [key, array] : aov_arrays) {
    const std::string name = word_of(key, "an AOV");
    const Aov aov = aov_named(name);
    const int count = static_cast<int>(aovs()[static_cast<std::size_t>(aov)].suffixes.size());
    const py::object made = array_or_new(py::reinterpret_borrow<py::object>(array), window.size(),
                                         count, Sample::kFloat);
    const Picture aov_picture = writable_picture_of(made, "AOV " + name);
    expect(aov_picture, "AOV " + name, window.size(), count);
    for (int c = 0; c < count; ++c) picture.of(aov)[c] = output_of(aov_picture, c);
    aovs_made[key] = made;
  }

  {
    const py::gil_scoped_release unlocked;
    compositor_->run(frame, picture);
  }
  return py::make_tuple(wet, aovs_made);
}

py::dict FrameAfterFrame::shader(const py::dict& planes, const py::dict& scene,
                                 const py::object& display, const py::dict& keywords) {
  const Busy busy(busy_);
  const HostFrame frame = frame_of(planes, scene, primaries_, display).frame;
  const ShaderOptions options = shader_options_of(keywords);
  const ShaderText made = [&] {
    const py::gil_scoped_release unlocked;
    return compositor_->shader(frame, options);
  }();
  return dict_of(made);
}

py::tuple FrameAfterFrame::plan() const {
  const Busy busy(busy_);
  const Plan& plan = compositor_->plan();
  py::list entries, roles_read;
  for (const PlannedOperator& op : plan.operators) {
    entries.append(py::make_tuple(op.name, verdict_name(op.verdict), op.reason, op.rule));
  }
  for (const Role& role : roles()) {
    if (plan.planes.meets(role.planes())) roles_read.append(role.name);
  }
  return py::make_tuple(entries, roles_read, to_text(plan));
}

py::dict FrameAfterFrame::replaced() const {
  const Busy busy(busy_);
  py::dict counts;
  for (const Role& role : roles()) {
    const Replaced& replaced = compositor_->replaced().of(role);
    if (replaced.total() == 0) continue;
    py::dict kinds;
    if (replaced.nan != 0) kinds["nan"] = replaced.nan;
    if (replaced.inf != 0) kinds["inf"] = replaced.inf;
    counts[py::str(role.name)] = kinds;
  }
  return counts;
}

std::string FrameAfterFrame::device() const {
  const Busy busy(busy_);
  return compositor_->device();
}

}  // namespace limpid::python
