#include "shade/program.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>

#include "limpid/core/error.h"

#include "op/bottom_layer.h"
#include "op/caustics_table.h"
#include "op/continuation.h"
#include "op/edge_surfaces.h"
#include "shade/glsl_lookups.h"
#include "shade/record.h"
#include "shade/uniform_block.h"

namespace limpid {
namespace {

constexpr int kLevels = LevelSizes::kMost;

void check(const ShaderOptions& options) {
  const std::string& name = options.function;
  const bool word = !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
                    std::all_of(name.begin(), name.end(), [](unsigned char c) {
                      return c < 128 && (std::isalnum(c) || c == '_');
                    });
  if (!word || name.find("__") != std::string::npos || name.starts_with("gl_")) {
    throw Error("'" + name + "' is not a function name: expected letters, digits and _");
  }
  if (options.set < 0 || options.set > 31) {
    throw Error("descriptor set " + std::to_string(options.set) + " is out of 0 ... 31");
  }
  if (options.max_threads < 128) {
    throw Error("max_threads = " + std::to_string(options.max_threads) + ": expected 128 at least");
  }
  if (options.first_binding < 0 || options.first_binding > 1000) {
    throw Error("first binding " + std::to_string(options.first_binding) + " is out of 0 ... 1000");
  }
}

/// Fowler, Noll & Vo 1991, "FNV hash", 1a with 64 bits.
std::string id_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

glm::ivec4 corners(const Rect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

/// Assembles the text and its values.
class Writer {
 public:
  /// `frame` is the frame that completers made from `plate`.
  Writer(const Plan& plan, const Frame& plate, const Frame& frame, const Pass& pass,
         const ShaderOptions& options, Gathered gathered)
      : plan_(plan),
        plate_(plate),
        frame_(frame),
        pass_(pass),
        options_(options),
        gathered_(gathered),
        recording_(record(plan, pass, options.aovs)),
        body_(recording_, gathers_made()) {}

  ShaderProgram write() {
    to_.work = frame_.work();
    to_.group = group();
    to_.block_binding = options_.first_binding;
    next_ = options_.first_binding + 1;
    add_outputs();
    add_planes();
    add_rows();
    add_textures();
    add_levels();
    add_numbers();
    to_.text = head() + struct_text() + lookups() + function() + main();
    to_.id = id_of(to_.text);
    to_.block = block_.take();
    return std::move(to_);
  }

 private:
  std::string layout(int binding) const {
    return "set = " + std::to_string(options_.set) + ", binding = " + std::to_string(binding);
  }

  /// Of the program, by its live nodes.
  enum class Length : std::uint8_t { kShort, kMiddle, kLong };
  Length length() const {
    constexpr std::ptrdiff_t kMiddleNodes = 1500, kLongNodes = 5000;
    const auto nodes = std::count(recording_.live.begin(), recording_.live.end(), true);
    return nodes > kLongNodes     ? Length::kLong
           : nodes > kMiddleNodes ? Length::kMiddle
                                  : Length::kShort;
  }
  /// A program as long as a march waits for its lookups more than it computes: more threads per
  /// register file are faster, even if some registers spill. (NVIDIA H100, beside kShort: with
  /// kLong `physical` takes .8 of the time, shorter looks 1.1 to 1.2; with kMiddle `fast` takes
  /// .95, shorter looks 1.05.)
  Size group() const {
    constexpr Size kShort{16, 8}, kMiddle{16, 16}, kLong{16, 64};
    const auto fits = [&](Size group) {
      return group.width * group.height <= options_.max_threads;
    };
    if (length() == Length::kLong && fits(kLong)) return kLong;
    return length() != Length::kShort && fits(kMiddle) ? kMiddle : kShort;
  }

  bool gathers_made() const { return gathered_ != Gathered::kNothing; }
  bool packs_map() const { return gathers_made() && pass_.wave_map.bytes; }
  /// Whether corners of quads come from sums. (NVIDIA H100: then `fast` takes .91 of the time,
  /// `physical` 1.10, shorter looks 1.00: the driver gives `fast` 64 registers, not 80, so that a
  /// third more threads run at once.)
  bool sums_quads() const { return gathers_made() && length() == Length::kMiddle; }
  std::string lookups() const {
    return glsl_lookups(body_.needs(), gathered_, packs_map(), sums_quads());
  }

  void add_outputs() {
    const auto add = [&](std::string name, int channels) {
      const bool image = options_.stage == ShaderOptions::Stage::kCompute;
      const int place = static_cast<int>(to_.outputs.size());
      to_.outputs.push_back({std::move(name), channels, image ? next_++ : place});
    };
    add("color", 4);
    for (const Aov aov : options_.aovs) {
      const AovInfo& info = aovs()[static_cast<std::size_t>(aov)];
      if (!info.planes.empty()) {
        throw Error("the AOV " + std::string(info.name) +
                    " shows a buffer of the frame: a shader has none to make");
      }
      add(std::string(info.name), static_cast<int>(info.suffixes.size()));
    }
  }

  using Fill = decltype(ProgramTexture::fill);
  ProgramTexture& declare(std::string name, ShaderTexture::Source source, int channels, Size size,
                          Fill fill) {
    ProgramTexture& texture = declare(std::move(name), source, channels, size);
    samplers_ += "uniform sampler2D " + texture.name + ";\n";
    texture.fill = std::move(fill);
    return texture;
  }
  using Pack = decltype(ProgramTexture::pack);
  void declare_packed(std::string name, Size size, Pack pack) {
    ProgramTexture& texture = declare(std::move(name), ShaderTexture::Source::kMade, 1, size);
    samplers_ += "uniform usampler2D " + texture.name + ";\n";
    texture.pack = std::move(pack);
  }
  ProgramTexture& declare(std::string name, ShaderTexture::Source source, int channels, Size size) {
    samplers_ += "layout(" + layout(next_) + ") ";
    ProgramTexture texture;
    texture.name = std::move(name);
    texture.binding = next_++;
    texture.source = source;
    texture.channels = channels;
    texture.width = size.width, texture.height = size.height;
    to_.textures.push_back(std::move(texture));
    return to_.textures.back();
  }

  /// The same for one channel, or for colors with the usual layout, for which the compiler makes
  /// vectors. A frame's planes take this function.
  static bool copied_plain(const std::vector<View<const float>>& views, const Rect& window, int y,
                           float* row, int step) {
    const auto from = [&](std::size_t k) { return &views[k].at(window.x0, y); };
    const int width = window.width();
    if (views.size() == 1 && step == 1) {
      std::copy_n(from(0), width, row);
      return true;
    }
    if (views.size() < 3 || step != 4) return false;
    const float *r = from(0), *g = from(1), *b = from(2);
    const auto put = [&](const auto& alpha) {
      for (int x = 0; x < width; ++x) {
        float* to = row + 4 * std::ptrdiff_t{x};
        to[0] = r[x], to[1] = g[x], to[2] = b[x], to[3] = alpha(x);
      }
    };
    if (views.size() == 3) {
      put([](int) { return 0.0f; });
    } else {
      put([a = from(3)](int x) { return a[x]; });
    }
    return true;
  }

  /// Rows of a window, one channel per view; 0 outside of a view.
  static Fill rows_of(std::vector<View<const float>> views) {
    const Rect window = views[0].window;
    const bool plain = std::all_of(views.begin(), views.end(), [&](const View<const float>& view) {
      return view.window == window && view.x_stride == 1;
    });
    return [views = std::move(views), window, plain](int row_index, float* row, int step) {
      const int y = window.y0 + row_index;
      if (plain && copied_plain(views, window, y, row, step)) return;
      for (std::size_t k = 0; k < views.size(); ++k) {
        const View<const float>& view = views[k];
        const bool reaches = y >= view.window.y0 && y < view.window.y1;
        const int begin = reaches ? std::max(window.x0, view.window.x0) : window.x1;
        const int end = reaches ? std::min(window.x1, view.window.x1) : window.x1;
        float* to = row + k;
        for (int x = window.x0; x < begin; ++x, to += step) *to = 0;
        const float* from = begin < end ? &view.at(begin, y) : nullptr;
        for (int x = begin; x < end; ++x, to += step) *to = from[(x - begin) * view.x_stride];
        for (int x = std::max(begin, end); x < window.x1; ++x, to += step) *to = 0;
      }
    };
  }

  void add_planes() {
    block_.add("work", corners(to_.work));
    block_.add("display", glm::ivec4(pass_.corner.x, pass_.corner.y, pass_.size.x, pass_.size.y));
    const PlaneSet read = recording_.planes();
    for (const Role& role : roles()) {
      std::vector<View<const float>> views;
      for (int k = role.count - 1; k >= 0; --k) {
        const PlaneId plane = plane_after(role.first, k);
        if (read.has(plane) || !views.empty()) views.push_back(frame_.plane(plane));
      }
      if (views.empty()) continue;
      std::reverse(views.begin(), views.end());
      const std::string name(role.name);
      const Rect window = views[0].window;
      for (std::size_t k = 0; k < views.size(); ++k) {
        // The pixel reads alpha only at its own place.
        const bool own = plane_after(role.first, static_cast<int>(k)) == PlaneId::kColorA;
        if (own || views[k].window == window) continue;
        throw Error("the channels of " + name + " have their own windows: a shader reads them " +
                    "as one texture");
      }
      const auto source =
          is_made(role, views) ? ShaderTexture::Source::kMade : ShaderTexture::Source::kPlanes;
      declare(plane_sampler(role.first), source, static_cast<int>(views.size()), window.size(),
              rows_of(views))
          .role = name;
      block_.add("window_" + name, corners(window));
      if (gathered_ == Gathered::kAll) {
        add_texel_size(name, window.size(), 1 - window.x0, 1 - window.y0);
      }
    }
  }

  void add_texel_size(const std::string& name, Size size, double z = 0, double w = 0) {
    block_.add("texel_" + name, glm::vec4(1.0 / size.width, 1.0 / size.height, z, w));
  }

  /// Whether the plate lacks them, or has other views.
  bool is_made(const Role& role, const std::vector<View<const float>>& views) const {
    for (std::size_t k = 0; k < views.size(); ++k) {
      const PlaneId plane = plane_after(role.first, static_cast<int>(k));
      if (plate_.plane(plane).data != views[k].data) return true;
    }
    return false;
  }

  void add_rows() {
    if (body_.needs().ops.count(NodeOp::kRow) == 0) return;
    // One value to a texel, or four: as few lookups as there can be.
    const int channels = gathers_made() ? 4 : 1;
    const auto fill = [&pass = pass_, y0 = to_.work.y0, channels](int y, float* row, int step) {
      const RowRays<double> r(pass, y0 + y - pass.corner.y + 0.5);
      const std::ptrdiff_t next = channels == 1 ? step : 1;
      for (const double x : {r.origin.x, r.origin.y, r.origin.z, r.ray.x, r.ray.y, r.ray.z, r.v,
                             r.calm_over, r.calm_under}) {
        *row = static_cast<float>(x);
        row += next;
      }
    };
    declare("limpid_rows", ShaderTexture::Source::kRows, channels,
            {(kRowValues + channels - 1) / channels, to_.work.height()}, fill);
  }

  bool looks_up(NodeOp op) const {
    const auto& lookups = body_.needs().lookups;
    return std::any_of(lookups.begin(), lookups.end(),
                       [&](const auto& lookup) { return lookup.first == op; });
  }
  bool looks_up(NodeOp op, TextureId id) const {
    return body_.needs().lookups.count({op, static_cast<int>(id)}) > 0;
  }

  void add_texture(TextureId id, const Texture& texture) {
    declare(texture_sampler(static_cast<int>(id)), ShaderTexture::Source::kMade, 3,
            texture.channels[0].window.size(),
            rows_of({texture.channels.begin(), texture.channels.end()}));
  }

  /// Row y, from 0 on, of a level with a texel of its other side at each edge. The texels have
  /// their first column and row once more at their end.
  template <class Texel>
  static void copy_around(const Texel* texels, Size level, int y, Texel* row) {
    const int from = y == 0 ? level.height - 1 : y - 1;
    texels += std::ptrdiff_t{from} * (level.width + 1);
    row[0] = texels[level.width - 1];
    std::copy_n(texels, level.width + 1, row + 1);
  }
  /// Such a level whose edge begins at row `top` of a texture.
  static glm::vec4 place_of(Size level, int top, Size texture) {
    return {level.width, level.height, 2.0 / texture.width, (2.0 + top) / texture.height};
  }

  /// With a texel of its other side at both ends of each row.
  void add_around(TextureId id, const Texture& texture) {
    const Size size = texture.channels[0].window.size(), wide{size.width + 2, size.height};
    const std::ptrdiff_t width = size.width;
    declare(texture_sampler(static_cast<int>(id)), ShaderTexture::Source::kMade, 3, wide,
            [rows = rows_of({texture.channels.begin(), texture.channels.end()}), width](
                int y, float* row, int step) {
              rows(y, row + step, step);
              std::copy_n(row + width * step, step, row);
              std::copy_n(row + step, step, row + (width + 1) * step);
            });
    const std::string name = "lat_long_" + std::to_string(static_cast<int>(id));
    block_.add("level_" + name,
               glm::vec4(size.width, size.height, 2.0 / wide.width, 1.0 / wide.height));
    add_texel_size(name, wide);
  }

  void add_packed_map() {
    const Size map = pass_.wave_map.channels[0].window.size();
    const Size size{map.width + 2, map.height + 2};
    declare_packed(texture_sampler(static_cast<int>(TextureId::kWaveMap)), size,
                   [bytes = pass_.wave_map.bytes, map](int y, std::uint32_t* row) {
                     copy_around(bytes, map, y, row);
                   });
    block_.add("level_wave_map", place_of(map, 0, size));
    add_texel_size("wave_map", size);
  }

  void add_textures() {
    if (looks_up(NodeOp::kTiled) || looks_up(NodeOp::kTiledWide)) {
      packs_map() ? add_packed_map() : add_texture(TextureId::kWaveMap, pass_.wave_map);
    }
    const auto lat_long = [&](TextureId id, const Texture& texture) {
      gathers_made() ? add_around(id, texture) : add_texture(id, texture);
    };
    if (looks_up(NodeOp::kLatLong, TextureId::kEnvironment)) {
      lat_long(TextureId::kEnvironment, pass_.environment);
    }
    if (looks_up(NodeOp::kLatLong, TextureId::kEdgeColors)) {
      lat_long(TextureId::kEdgeColors, pass_.edge_surfaces->colors);
    }
    if (looks_up(NodeOp::kLatLong, TextureId::kEdgeShape)) {
      lat_long(TextureId::kEdgeShape, pass_.edge_surfaces->shape);
    }
    if (looks_up(NodeOp::kLatLong, TextureId::kContinuation)) {
      lat_long(TextureId::kContinuation, pass_.continuation->colors);
    }
    if (looks_up(NodeOp::kLatLong, TextureId::kBottomColors)) {
      lat_long(TextureId::kBottomColors, pass_.bottom_layer->colors);
    }
    if (looks_up(NodeOp::kLatLong, TextureId::kBottomShape)) {
      lat_long(TextureId::kBottomShape, pass_.bottom_layer->shape);
    }
  }

  /// Levels one below the other, each without the column and row that repeat its first.
  template <class TexelOf>
  void add_level_texture(const std::string& name, const LevelSizes& sizes, int channels,
                         TexelOf texel_of) {
    std::vector<glm::ivec4> levels(kLevels, glm::ivec4(0));
    int height = 0;
    for (int k = 0; k < sizes.count; ++k) {
      levels[static_cast<std::size_t>(k)] = {sizes.width[k], sizes.height[k], height, 0};
      height += sizes.height[k];
    }
    const int width = sizes.width[0];
    const auto fill = [=, &sizes](int y, float* row, int step) {
      int level = 0;
      while (y >= sizes.height[level]) y -= sizes.height[level++];
      for (int x = 0; x < width; ++x, row += step) {
        if (x < sizes.width[level]) {
          texel_of(sizes.place(level, x, y), row);
        } else {
          std::fill_n(row, channels, 0.0f);
        }
      }
    };
    declare(name, ShaderTexture::Source::kMade, channels, {width, height}, fill);
    level_places_.emplace_back("levels_" + name.substr(std::string("limpid_").size()),
                               std::move(levels));
  }

  /// The same with a texel of its other side at each edge of a level.
  static std::vector<glm::vec4> places_of(const LevelSizes& sizes, Size texture) {
    std::vector<glm::vec4> levels(kLevels, glm::vec4(0));
    int top = 0;
    for (int k = 0; k < sizes.count; ++k) {
      levels[static_cast<std::size_t>(k)] =
          place_of({sizes.width[k], sizes.height[k]}, top, texture);
      top += sizes.height[k] + 2;
    }
    return levels;
  }
  static Size size_with_all(const LevelSizes& sizes) {
    int height = 0;
    for (int k = 0; k < sizes.count; ++k) height += sizes.height[k] + 2;
    return {sizes.width[0] + 2, height};
  }
  /// The texels of a row of those; what is right of a level is left alone.
  template <class Texel>
  static void copy_level_row(const LevelSizes& sizes, const Texel* texels, int y, Texel* row) {
    int k = 0;
    while (y > sizes.height[k] + 1) y -= sizes.height[k++] + 2;
    copy_around(texels + sizes.place(k, 0, 0), {sizes.width[k], sizes.height[k]}, y, row);
  }

  void add_packed_levels() {
    const TextureLevels& levels = *pass_.wave_map.levels;
    const Size size = size_with_all(levels.sizes);
    declare_packed("limpid_wave_levels", size, [&levels](int y, std::uint32_t* row) {
      copy_level_row(levels.sizes, levels.texels, y, row);
    });
    add_texel_size("wave_levels", size);
    block_.add("levels_wave_levels", places_of(levels.sizes, size));
  }
  /// All planes, one below the other.
  void add_slopes() {
    const SlopeLevels& levels = *pass_.wave_slopes;
    const Size one = size_with_all(levels.sizes);
    const Size size{one.width, TextureLevels::kMoments * one.height};
    declare("limpid_slopes", ShaderTexture::Source::kMade, 1, size,
            [&levels, one](int y, float* row, int step) {
              if (step != 1) throw Error("a texture of one channel has others");
              copy_level_row(levels.sizes, levels.planes[y / one.height], y % one.height, row);
            });
    add_texel_size("slopes", size, static_cast<double>(one.height) / size.height);
    block_.add("levels_slopes", places_of(levels.sizes, size));
  }

  void add_levels() {
    glm::ivec4 counts(0);
    const bool wide = looks_up(NodeOp::kTiledWide);
    const bool mean = looks_up(NodeOp::kSlopeMean), square = looks_up(NodeOp::kSlopeSquare);
    if (wide) counts.x = pass_.wave_map.levels->sizes.count;
    if (mean || square) counts.y = pass_.wave_slopes->sizes.count;
    if (gathers_made()) {
      if (wide) add_packed_levels();
      if (mean || square) add_slopes();
    }
    if (wide && !gathers_made()) {
      const TextureLevels& levels = *pass_.wave_map.levels;
      add_level_texture("limpid_wave_levels", levels.sizes, 3, [&levels](int i, float* texel) {
        const std::uint32_t rgb = levels.texels[i];
        texel[0] = static_cast<float>(rgb & 2047);
        texel[1] = static_cast<float>(rgb >> 11 & 2047);
        texel[2] = static_cast<float>(rgb >> 22);
      });
    }
    const auto moments = [&](const std::string& name, int first, int channels) {
      const SlopeLevels& levels = *pass_.wave_slopes;
      add_level_texture(name, levels.sizes, channels, [=, &levels](int i, float* texel) {
        for (int c = 0; c < channels; ++c) texel[c] = levels.planes[first + c][i];
      });
    };
    if (mean && !gathers_made()) moments("limpid_slope_means", 0, 2);
    if (square && !gathers_made()) moments("limpid_slope_squares", 2, 3);
    if (wide || mean || square) block_.add("counts", counts);
    for (const auto& [name, places] : level_places_) block_.add(name, places);
    if (looks_up(NodeOp::kGrid)) add_caustics();
  }

  /// All levels of all tables, one below the other, each as wide as the widest; beyond a level, the
  /// light of calm water.
  void add_caustics() {
    struct Level {
      const View<const float>* light;
      int top;
    };
    std::vector<Level> all;
    const std::size_t tables = pass_.caustics->in_water ? 2 : 1;
    std::vector<glm::ivec4> levels(tables * CausticsTable::kMaxLevels, glm::ivec4(0));
    int width = 1, height = 0;
    for (const CausticsTable* table = pass_.caustics; table; table = table->in_water) {
      for (int k = 0; k < table->count; ++k) {
        const View<const float>& light = table->levels[static_cast<std::size_t>(k)].light;
        const Size size = light.window.size();
        all.push_back({&light, height});
        levels[static_cast<std::size_t>(table->first + k)] = {size.width, size.height, height, 0};
        width = std::max(width, size.width);
        height += size.height;
      }
    }
    const auto fill = [=](int y, float* row, int step) {
      for (int x = 0; x < width; ++x) row[std::ptrdiff_t{x} * step] = 1;
      for (const Level& level : all) {
        const Rect& window = level.light->window;
        const int own = window.y0 + y - level.top;
        if (own < window.y0 || own >= window.y1) continue;
        for (int x = 0; x < window.width(); ++x) {
          row[std::ptrdiff_t{x} * step] = level.light->at(window.x0 + x, own);
        }
      }
    };
    const Size size{width, std::max(height, 1)};
    declare("limpid_caustics", ShaderTexture::Source::kMade, 1, size, fill);
    if (gathers_made()) add_texel_size("caustics", size);
    block_.add("levels_caustics", levels);
  }

  void add_numbers() {
    const std::map<std::string, Range> ranges = ranges_of(plan_.look);
    for (const GivenNumber& given : recording_.given) {
      const float value = static_cast<float>(given.value);
      const std::size_t offset = block_.add(glsl_name(given.name), value);
      const auto range = ranges.find(given.name);
      to_.numbers.push_back({given.name, offset, value,
                             range == ranges.end() ? std::nullopt : std::optional(range->second)});
    }
    for (std::size_t k = 0; k < body_.frame_numbers().size(); ++k) {
      block_.add("frame_" + std::to_string(k), static_cast<float>(body_.frame_numbers()[k]));
    }
  }
  /// The ranges of the numeric parameters.
  static std::map<std::string, Range> ranges_of(const Look& look) {
    std::map<std::string, Range> ranges;
    for (const Parameter& parameter : parameters(look)) {
      const std::string name = std::string(parameter.table) + "." + std::string(parameter.name);
      if (parameter.kind == FieldKind::kReal) ranges[name] = parameter.range;
      if (parameter.kind != FieldKind::kColor) continue;
      for (const char* channel : {".r", ".g", ".b"}) ranges[name + channel] = parameter.range;
    }
    return ranges;
  }

  std::string head() const {
    std::string text = "#version 450\n";
    if (body_.needs().loops) text += "#extension GL_EXT_control_flow_attributes : enable\n";
    text += "// " + title() + "\n";
    if (options_.stage == ShaderOptions::Stage::kCompute) {
      text += "layout(local_size_x = " + std::to_string(to_.group.width) +
              ", local_size_y = " + std::to_string(to_.group.height) + ") in;\n";
    }
    text += "layout(std140, " + layout(to_.block_binding) + ") uniform LimpidNumbers {\n" +
            block_.text() + "} limpid;\n";
    return text + samplers_;
  }
  std::string title() const {
    std::string kept;
    for (const PlannedOperator& op : plan_.operators) {
      if (op.verdict == Verdict::kKept) kept += (kept.empty() ? "" : ", ") + std::string(op.name);
    }
    return "Water, by limpid: " + (kept.empty() ? "nothing to do" : kept) + ".";
  }

  static std::string type_of(int channels) {
    return channels == 1 ? "float" : "vec" + std::to_string(channels);
  }
  std::string struct_text() const {
    std::string text = "\nstruct LimpidPixel {\n";
    for (const ShaderOutput& output : to_.outputs) {
      text += "  " + type_of(output.channels) + " " + glsl_name(output.name) + ";\n";
    }
    return text + "};\n\n";
  }

  std::string function() const {
    std::string text = "\nLimpidPixel " + options_.function +
                       "(ivec2 pixel) {\n  limpid_pixel = pixel;\n" + body_.text() +
                       "  return LimpidPixel(";
    std::size_t next = 0;
    for (const ShaderOutput& output : to_.outputs) {
      if (next > 0) text += ", ";
      std::string values;
      for (int k = 0; k < output.channels; ++k) {
        values += (k > 0 ? ", " : "") + body_.output(next++);
      }
      text += output.channels == 1 ? values : type_of(output.channels) + "(" + values + ")";
    }
    return text + ");\n}\n";
  }

  std::string main() const {
    using Stage = ShaderOptions::Stage;
    if (options_.stage == Stage::kFunction) return "";
    const bool compute = options_.stage == Stage::kCompute;
    std::string declared, written;
    for (const ShaderOutput& output : to_.outputs) {
      const std::string name = "limpid_out_" + glsl_name(output.name);
      const std::string value = "made." + glsl_name(output.name);
      std::string four = value;
      if (output.channels == 1) four = "vec4(" + value + ", 0.0, 0.0, 1.0)";
      if (output.channels == 2) four = "vec4(" + value + ", 0.0, 1.0)";
      if (output.channels == 3) four = "vec4(" + value + ", 1.0)";
      if (compute) {
        declared += "layout(" + layout(output.binding) +
                    (options_.half ? ", rgba16f" : ", rgba32f") + ") writeonly uniform image2D " +
                    name + ";\n";
        written += "  imageStore(" + name + ", pixel - limpid.work.xy, " + four + ");\n";
      } else {
        declared +=
            "layout(location = " + std::to_string(output.binding) + ") out vec4 " + name + ";\n";
        written += "  " + name + " = " + four + ";\n";
      }
    }
    const std::string from =
        compute ? "  ivec2 pixel = limpid.work.xy + ivec2(gl_GlobalInvocationID.xy);\n"
                  "  if (any(greaterThanEqual(pixel, limpid.work.zw))) return;\n"
                : "  ivec2 pixel = limpid.work.xy + ivec2(gl_FragCoord.xy);\n";
    return "\n" + declared + "\nvoid main() {\n" + from +
           "  LimpidPixel made = " + options_.function + "(pixel);\n" + written + "}\n";
  }

  ShaderProgram to_;
  const Plan& plan_;
  const Frame& plate_;
  const Frame& frame_;
  const Pass& pass_;
  const ShaderOptions& options_;
  const Gathered gathered_;
  Recording recording_;
  GlslBody body_;
  UniformBlock block_;
  std::vector<std::pair<std::string, std::vector<glm::ivec4>>> level_places_;
  std::string samplers_;
  int next_ = 0;
};

}  // namespace

ShaderProgram program_of(const Plan& plan, const Frame& plate, const Frame& frame, const Pass& pass,
                         const ShaderOptions& options, Gathered gathered) {
  check(options);
  return Writer(plan, plate, frame, pass, options, gathered).write();
}

}  // namespace limpid
