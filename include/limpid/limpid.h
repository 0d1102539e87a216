#ifndef LIMPID_LIMPID_H
#define LIMPID_LIMPID_H

/** @file
 * limpid as a post-processing stage, for C11 and for languages that call C: the interface of
 * limpid/compositor.h, which has the full documentation.
 *
 *     limpid_compositor* water = NULL;
 *     limpid_conventions conventions = LIMPID_CONVENTIONS;
 *     conventions.depth = LIMPID_DEPTH_DEVICE;
 *     char why[256];
 *     if (limpid_create(&conventions, NULL, &water, why, sizeof why) != LIMPID_OK) ...
 *     limpid_set_number(water, "depth_fog", "density", 0.4);
 *     if (limpid_run(water, &frame, &picture) != LIMPID_OK) puts(limpid_message(water));
 *     limpid_destroy(water);
 *
 * Structs begin with their size in the caller's version, which the macros below set; all other
 * members may be 0. Members that later versions append count as 0 for an older caller; a size that
 * this library does not know is refused. Values of enums and limpid_channel never change. One
 * compositor, or shader, is for one thread at a time; several may run at once. C++ code reads look
 * files by limpid/files/text/look_file.h.
 */

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define LIMPID_API __attribute__((visibility("default")))
#else
#define LIMPID_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum limpid_status {
  LIMPID_OK = 0,
  /** An argument is invalid: limpid_message() names it. No setting and no picture was changed. */
  LIMPID_REFUSED = 1,
  LIMPID_NO_MEMORY = 2, /**< out of memory; no setting was changed */
  LIMPID_FAILED = 3     /**< a fault of the library */
} limpid_status;

/** The kind of depth in depth planes. */
typedef enum limpid_depth {
  LIMPID_DEPTH_EYE = 0,        /**< distance along the view axis */
  LIMPID_DEPTH_RAY = 1,        /**< distance from the eye along the pixel's ray */
  LIMPID_DEPTH_INVERSE = 2,    /**< 1 / eye depth */
  LIMPID_DEPTH_NORMALISED = 3, /**< 0 at near ... 1 at far, linear */
  LIMPID_DEPTH_DEVICE = 4      /**< clip z after the division */
} limpid_depth;

/** The range of clip z. */
typedef enum limpid_clip {
  LIMPID_CLIP_GL = 0,      /**< -1 near ... 1 far */
  LIMPID_CLIP_D3D = 1,     /**< 0 near ... 1 far: Vulkan, too */
  LIMPID_CLIP_REVERSED = 2 /**< 1 near ... 0 far */
} limpid_clip;

typedef enum limpid_sample { LIMPID_FLOAT = 0, LIMPID_HALF = 1 } limpid_sample;

/** The planes of a frame. Color and depth must be present. */
typedef enum limpid_plane {
  LIMPID_COLOR_R = 0,
  LIMPID_COLOR_G = 1,
  LIMPID_COLOR_B = 2,
  LIMPID_COLOR_A = 3,
  LIMPID_DEPTH = 4,
  LIMPID_SHADOW = 5,
  LIMPID_REFLECTION_R = 6,
  LIMPID_REFLECTION_G = 7,
  LIMPID_REFLECTION_B = 8,
  LIMPID_SURFACE_DEPTH = 9,
  LIMPID_SURFACE_NORMAL_X = 10,
  LIMPID_SURFACE_NORMAL_Y = 11,
  LIMPID_SURFACE_NORMAL_Z = 12,
  LIMPID_REFLECTION_VALID = 13,
  LIMPID_REFLECTION_DEPTH = 14,
  LIMPID_BELOW_R = 15,
  LIMPID_BELOW_G = 16,
  LIMPID_BELOW_B = 17,
  LIMPID_BELOW_DEPTH = 18,
  LIMPID_SURFACE_SHADOW = 19,
  LIMPID_SKY_R = 20,
  LIMPID_SKY_G = 21,
  LIMPID_SKY_B = 22,
  LIMPID_ALBEDO_R = 23,
  LIMPID_ALBEDO_G = 24,
  LIMPID_ALBEDO_B = 25,
  LIMPID_SUN_COLOR_R = 26,
  LIMPID_SUN_COLOR_G = 27,
  LIMPID_SUN_COLOR_B = 28,
  LIMPID_BASIN = 29
} limpid_plane;

/** The outputs. Channel i of an AOV (x y z, r g b, u v) is its value + i. */
typedef enum limpid_output {
  LIMPID_OUT_R = 0,
  LIMPID_OUT_G = 1,
  LIMPID_OUT_B = 2,
  LIMPID_OUT_A = 3, /**< may be absent */
  LIMPID_OUT_TRANSMITTED = 4,
  LIMPID_OUT_IN_SCATTER = 7,
  LIMPID_OUT_REFLECTED = 10,
  LIMPID_OUT_HIGHLIGHT = 13,
  LIMPID_OUT_FRESNEL = 16,
  LIMPID_OUT_TRANSMITTANCE = 19,
  LIMPID_OUT_PATH = 22,
  LIMPID_OUT_CONFIDENCE = 25,
  LIMPID_OUT_NORMAL = 28,
  LIMPID_OUT_SURFACE_DEPTH = 31,
  LIMPID_OUT_STMAP_R = 34,
  LIMPID_OUT_STMAP_G = 37,
  LIMPID_OUT_STMAP_B = 40,
  LIMPID_OUT_MIRROR_SOURCES = 43,
  LIMPID_OUT_REFLECTION_DEPTH = 46,
  LIMPID_OUT_REFLECTION_VALID = 49,
  LIMPID_OUT_SKY = 52,
  LIMPID_OUT_SURFACE_SHADOW = 55
} limpid_output;

/** One channel in the host's memory. `data` points at the sample of the first pixel of the window.
 * Strides count bytes; a stride of 0, for planes of a frame only, repeats a sample. A window of
 * four zeros is the whole picture. */
typedef struct limpid_channel {
  int32_t id;     /**< limpid_plane of a frame, limpid_output of a picture */
  int32_t sample; /**< limpid_sample */
  void* data;     /**< planes of a frame are only read, unless the picture overlaps them */
  ptrdiff_t x_stride, y_stride;
  int32_t x0, y0, x1, y1; /**< pixels x0 <= x < x1, y0 <= y < y1 */
} limpid_channel;

/** The conventions of the host for cameras and depths: limpid::Conventions. */
typedef struct limpid_conventions {
  size_t size;
  int32_t depth; /**< limpid_depth */
  int32_t clip;  /**< limpid_clip */
  int32_t looks_along_plus_z, clip_y_down, trusted;
  /** 1: matrices are stored row after row. 0: column after column, as in OpenGL (and as in
   * Direct3D, whose matrices are for row vectors and stored by rows). */
  int32_t row_major;
  double near_depth, far_depth; /**< scene units, for normalised depth only */
  /** The color space of frames, environments and looks: the name of a linear space ("ACEScg"), or
   * eight numbers, x and y of red, green, blue and white, as for `--colorspace` of the tool. NULL:
   * Rec.709. Only limpid_create() reads the text. */
  const char* colorspace;
} limpid_conventions;
#define LIMPID_CONVENTIONS \
  { sizeof(limpid_conventions), 0, 0, 0, 0, 0, 0, 0, 0, NULL }

/** Threads of the host. run() calls task(context, i) once for each i in 0 ... count - 1, on any
 * threads, in any order, and returns when all calls have returned. Several threads may call run()
 * at once, if their compositors share the executor. */
typedef void (*limpid_task)(void* context, int index);
typedef struct limpid_executor {
  size_t size;
  void* host; /**< passed to run() */
  void (*run)(void* host, int count, limpid_task task, void* context);
} limpid_executor;
#define LIMPID_EXECUTOR \
  { sizeof(limpid_executor), NULL, NULL }

/** The runner of a compositor. */
typedef enum limpid_runner {
  LIMPID_RUNNER_FUSED = 0, /**< the CPU */
  LIMPID_RUNNER_GPU = 1    /**< a GPU, by Vulkan 1.2: limpid::GpuRunner */
} limpid_runner;

typedef struct limpid_options {
  size_t size;
  const limpid_executor* executor; /**< copied; NULL: the compositor makes a pool of threads */
  int32_t threads;                 /**< of that pool; 0: one per core */
  const char* simd;                /**< NULL: the best; else avx512 avx2 sse4 neon scalar */
  double max_error;                /**< as in limpid::make_plan(); 0 on a GPU */
  int32_t runner;                  /**< limpid_runner */
  const char* gpu;       /**< a part of the GPU's name; NULL: the first GPU of the fastest kind */
  const char* gpu_cache; /**< a folder that caches compiled shaders of the GPU; NULL: none */
} limpid_options;
#define LIMPID_OPTIONS \
  { sizeof(limpid_options), NULL, 0, NULL, 0, 0, NULL, NULL }

/** A frame of the host: limpid::HostFrame. */
typedef struct limpid_frame {
  size_t size;
  int32_t width, height;
  const limpid_channel* planes; /**< in any order, each at most once */
  size_t plane_count;
  double view[16];       /**< view from world */
  double projection[16]; /**< clip from view */
  double water_up[3];    /**< world up of the water plane, need not be unit */
  double water_height;
  const double* waves; /**< amplitude k_x k_y phase omega of each wave: limpid::SineWave */
  size_t wave_count;
  int32_t has_sun;
  double sun_direction[3]; /**< towards the sun, need not be unit */
  double sun_color[3];
  double time; /**< seconds */
  int32_t has_sky;
  double sky_radiance[3]; /**< of a uniform sky: limpid::SkyLight */
} limpid_frame;
#define LIMPID_FRAME                                                                         \
  {                                                                                          \
    sizeof(limpid_frame), 0, 0, NULL, 0, {0}, {0}, {0}, 0, NULL, 0, 0, {0}, {0}, 0, 0, { 0 } \
  }

typedef struct limpid_picture {
  size_t size;
  const limpid_channel* outputs; /**< in any order, each at most once */
  size_t output_count;
} limpid_picture;
#define LIMPID_PICTURE \
  { sizeof(limpid_picture), NULL, 0 }

/** Interleaved pixels of floats r g b; further channels are ignored. y_stride is the number of
 * bytes from row to row; 0: rows follow one another without a gap. */
typedef struct limpid_texture {
  size_t size;
  const float* data;
  int32_t width, height, channels;
  ptrdiff_t y_stride;
} limpid_texture;
#define LIMPID_TEXTURE \
  { sizeof(limpid_texture), NULL, 0, 0, 0, 0 }

/** The parts of a shader text besides declarations and the function. */
typedef enum limpid_shader_stage {
  LIMPID_SHADER_FUNCTION = 0, /**< none: for a shader of the host */
  LIMPID_SHADER_COMPUTE = 1,  /**< a main() for groups of 16 x 8 pixels, which writes images */
  LIMPID_SHADER_FRAGMENT = 2  /**< a main() for the pixels of a full-screen triangle */
} limpid_shader_stage;

/** Options of a shader text: limpid::ShaderOptions. */
typedef struct limpid_shader_options {
  size_t size;
  int32_t stage;         /**< limpid_shader_stage */
  const char* function;  /**< a word of letters, digits and _; NULL: limpid_water */
  int32_t set;           /**< descriptor set of all declarations, 0 ... 31 */
  int32_t first_binding; /**< first binding, 0 ... 1000 */
  /** AOVs that the function returns besides the picture, each by its first channel
   * (LIMPID_OUT_PATH, not LIMPID_OUT_PATH + 1) and at most once. */
  const int32_t* aovs;
  size_t aov_count;
} limpid_shader_options;
#define LIMPID_SHADER_OPTIONS \
  { sizeof(limpid_shader_options), 0, NULL, 0, 0, NULL, 0 }

/** The source of the values of a shader's texture. */
typedef enum limpid_texture_source {
  LIMPID_TEXTURE_PLANES = 0, /**< the host's planes of `role`, in the channels r g b a */
  LIMPID_TEXTURE_ROWS = 1,   /**< `texels`: numbers of each row of the picture */
  LIMPID_TEXTURE_MADE = 2    /**< `texels`: a map of the look, or data computed for the frame */
} limpid_texture_source;

/** A shader and its uniform block: limpid::ShaderText. */
typedef struct limpid_shader_info {
  size_t size;
  const char* text; /**< GLSL 4.50 for Vulkan */
  const char* id;   /**< a hash of the text, 16 hexadecimal digits */
  const char* function;
  int32_t stage; /**< limpid_shader_stage */
  int32_t set;
  int32_t block_binding;
  const void* block; /**< std140, with the values of the frame */
  size_t block_size; /**< bytes */
  size_t number_count, texture_count, output_count;
  int32_t x0, y0, x1, y1; /**< pixels that the shader computes */
} limpid_shader_info;
#define LIMPID_SHADER_INFO \
  { sizeof(limpid_shader_info), NULL, NULL, NULL, 0, 0, 0, NULL, 0, 0, 0, 0, 0, 0, 0, 0 }

/** A float of the uniform block. */
typedef struct limpid_shader_number {
  size_t size;
  const char* name;  /**< "refraction.strength"; the text has _ for . and [ */
  size_t offset;     /**< bytes */
  float value;       /**< of the frame */
  int32_t has_range; /**< 1 for a parameter that is used unchanged, with the range below */
  double least, most;
} limpid_shader_number;
#define LIMPID_SHADER_NUMBER \
  { sizeof(limpid_shader_number), NULL, 0, 0, 0, 0, 0 }

/** A sampler2D of the text, which reads it only by texelFetch, without a filter. */
typedef struct limpid_shader_texture {
  size_t size;
  const char* name; /**< "limpid_depth" */
  int32_t binding;
  int32_t source;   /**< limpid_texture_source */
  const char* role; /**< of planes, also computed ones: "depth", "color"; else "" */
  int32_t plane;    /**< limpid_plane of its channel r; -1 without a role */
  int32_t channels; /**< number of channels that are read, 1 ... 4 */
  int32_t width, height;
  const float* texels; /**< `channels` floats each, row after row; NULL for the host's planes */
} limpid_shader_texture;
#define LIMPID_SHADER_TEXTURE \
  { sizeof(limpid_shader_texture), NULL, 0, 0, NULL, 0, 0, 0, 0, NULL }

/** An output of main(). The first is the picture. */
typedef struct limpid_shader_output {
  size_t size;
  const char* name; /**< "color", or the AOV, such as "path" */
  int32_t channels;
  int32_t binding; /**< of an image; the location of a fragment output */
} limpid_shader_output;
#define LIMPID_SHADER_OUTPUT \
  { sizeof(limpid_shader_output), NULL, 0, 0 }

typedef struct limpid_compositor limpid_compositor;
typedef struct limpid_shader limpid_shader;

/** "MAJOR.MINOR.PATCH" of the running library. */
LIMPID_API const char* limpid_version(void);

/** Makes a compositor with the default parameters of all operators (limpid::Look). NULL for
 * conventions or options: the defaults. If it does not return LIMPID_OK, *compositor is NULL, and
 * `message`, if not NULL, has the reason, cut to message_size - 1 bytes. */
LIMPID_API limpid_status limpid_create(const limpid_conventions* conventions,
                                       const limpid_options* options,
                                       limpid_compositor** compositor, char* message,
                                       size_t message_size);
LIMPID_API void limpid_destroy(limpid_compositor* compositor); /**< NULL is allowed */

/** The error of the last call on this compositor that did not return LIMPID_OK; "" before the
 * first. Valid until the next call on the compositor. */
LIMPID_API const char* limpid_message(const limpid_compositor* compositor);

/** Sets one parameter of the look, from the next frame on; `limpid operators` lists their names,
 * such as "refraction", "strength". limpid_set_rows() is for tables of numbers: `rows` rows of
 * `columns` numbers, one after another. */
LIMPID_API limpid_status limpid_set_number(limpid_compositor* compositor, const char* table,
                                           const char* key, double value);
LIMPID_API limpid_status limpid_set_word(limpid_compositor* compositor, const char* table,
                                         const char* key, const char* word);
LIMPID_API limpid_status limpid_set_color(limpid_compositor* compositor, const char* table,
                                          const char* key, const double rgb[3]);
LIMPID_API limpid_status limpid_set_rows(limpid_compositor* compositor, const char* table,
                                         const char* key, const double* numbers, size_t rows,
                                         size_t columns);
/** Sets all parameters to their defaults, from the next frame on. */
LIMPID_API limpid_status limpid_reset_look(limpid_compositor* compositor);

/** Set the wave map and the surroundings: limpid::Compositor. The memory belongs to the host and
 * must stay valid and unchanged: set a changed texture again. NULL removes the texture. */
LIMPID_API limpid_status limpid_set_wave_map(limpid_compositor* compositor,
                                             const limpid_texture* map);
LIMPID_API limpid_status limpid_set_environment(limpid_compositor* compositor,
                                                const limpid_texture* environment);

/** Puts water into a frame: limpid::Compositor::run(). */
LIMPID_API limpid_status limpid_run(limpid_compositor* compositor, const limpid_frame* frame,
                                    const limpid_picture* picture);

/** The look as a TOML text; the plan of the last frame, with one line per operator; and the numbers
 * of its replaced values, as in "color 3 NaN 1 inf, depth 2 NaN". All write at most size - 1 bytes
 * and a 0, and return the length of the whole text without that 0, or 0 if there is no text. */
LIMPID_API size_t limpid_look_text(const limpid_compositor* compositor, char* text, size_t size);
LIMPID_API size_t limpid_plan_text(const limpid_compositor* compositor, char* text, size_t size);
LIMPID_API size_t limpid_replaced_text(const limpid_compositor* compositor, char* text,
                                       size_t size);

/** The name of the GPU and its driver, written in the same way; no text if the CPU computes. */
LIMPID_API size_t limpid_device_text(const limpid_compositor* compositor, char* text, size_t size);

/** The look, with its maps, as one shader for frames of this kind, with the values of this frame:
 * limpid::Compositor::shader(). The text is the same for any size, time and camera as long as the
 * set of planes, the number of waves and the camera's side of the water stay the same; call this
 * for each frame for its block and textures, and compile the text once. NULL for options: the
 * defaults. The host binds textures of LIMPID_TEXTURE_PLANES, with eye depth, unit normals and row
 * 0 at the top, for any conventions. The shader does not refer to the compositor. If the call does
 * not return LIMPID_OK, *shader is NULL and limpid_message() of the compositor has the reason. */
LIMPID_API limpid_status limpid_create_shader(limpid_compositor* compositor,
                                              const limpid_frame* frame,
                                              const limpid_shader_options* options,
                                              limpid_shader** shader);
LIMPID_API void limpid_destroy_shader(limpid_shader* shader); /**< NULL is allowed */

/** The error of the last of the calls below on this shader, as limpid_message(). */
LIMPID_API const char* limpid_shader_message(const limpid_shader* shader);

/** Fill a struct up to its size, which stays. Its pointers are valid until the shader is destroyed.
 * Return LIMPID_REFUSED for an index that is not below the count, and then leave the struct
 * unchanged. Numbers are sorted by offset, textures by binding; outputs have the order of the
 * options. */
LIMPID_API limpid_status limpid_get_shader(limpid_shader* shader, limpid_shader_info* info);
LIMPID_API limpid_status limpid_get_shader_number(limpid_shader* shader, size_t index,
                                                  limpid_shader_number* number);
LIMPID_API limpid_status limpid_get_shader_texture(limpid_shader* shader, size_t index,
                                                   limpid_shader_texture* texture);
LIMPID_API limpid_status limpid_get_shader_output(limpid_shader* shader, size_t index,
                                                  limpid_shader_output* output);

#ifdef __cplusplus
}
#endif

#endif
