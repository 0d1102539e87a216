/* limpid in a host written in C: a beach that slopes into the water, planar floats, matrices row
 * after row, tiles on the host's own (here: the one) thread, and the path through the water as
 * an AOV. */
#include <limpid/limpid.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 320, HEIGHT = 180, PIXELS = WIDTH * HEIGHT };

static float red[PIXELS], green[PIXELS], blue[PIXELS], depth[PIXELS];
static float wet_red[PIXELS], wet_green[PIXELS], wet_blue[PIXELS], path[PIXELS];

/* The camera is 2 above the water and looks along -z, half a radian down. */
static const double kEyeY = 2, kPitch = 0.5, kZoom = 2; /* zoom: 1 / tan(half the vertical angle) */

/* Where the ray of a pixel goes for each unit of eye depth. */
static void ray_of(int i, double ray[3]) {
  const double right = (2 * (i % WIDTH + 0.5) - WIDTH) / HEIGHT / kZoom;
  const double up = (HEIGHT - 2 * (i / WIDTH + 0.5)) / HEIGHT / kZoom;
  ray[0] = right;
  ray[1] = up * cos(kPitch) - sin(kPitch);
  ray[2] = -up * sin(kPitch) - cos(kPitch);
}

/* Sand: the plane y = x / 4. Returns how many pixels of it lie below the water, y = 0. */
static int draw(void) {
  int below = 0;
  for (int i = 0; i < PIXELS; ++i) {
    double ray[3];
    ray_of(i, ray);
    const double z = -kEyeY / (ray[1] - ray[0] / 4);
    const float shade = fmod(fabs(z * ray[2]), 1) < 0.5 ? 0.9f : 0.7f;
    red[i] = 0.6f * shade;
    green[i] = 0.5f * shade;
    blue[i] = 0.4f * shade;
    depth[i] = (float)z; /* eye depth, as limpid itself has it */
    below += kEyeY + z * ray[1] < 0;
  }
  return below;
}

/* A host with threads would hand the tasks to them here. */
static void run_tasks(void* host, int count, limpid_task task, void* context) {
  (void)host;
  for (int i = 0; i < count; ++i) task(context, i);
}

static limpid_channel channel(int32_t id, float* data) {
  const limpid_channel all = {.id = id,
                              .sample = LIMPID_FLOAT,
                              .data = data,
                              .x_stride = sizeof(float),
                              .y_stride = WIDTH * sizeof(float)};
  return all;
}

static void check(limpid_status status, const limpid_compositor* water) {
  if (status == LIMPID_OK) return;
  fprintf(stderr, "limpid %s: %s\n", limpid_version(), limpid_message(water));
  exit(1);
}

int main(void) {
  const int below = draw();

  /* Once: how the host keeps its pictures, whose threads compute, what water it is. */
  limpid_conventions conventions = LIMPID_CONVENTIONS;
  conventions.row_major = 1;
  limpid_executor executor = LIMPID_EXECUTOR;
  executor.run = run_tasks;
  limpid_options options = LIMPID_OPTIONS;
  options.executor = &executor;
  limpid_compositor* water = NULL;
  char why[256];
  if (limpid_create(&conventions, &options, &water, why, sizeof why) != LIMPID_OK) {
    fprintf(stderr, "limpid %s: %s\n", limpid_version(), why);
    return 1;
  }
  const double sky[3] = {0.5, 0.7, 1};
  check(limpid_set_word(water, "depth_fog", "water_type", "3C"), water);
  check(limpid_set_word(water, "fresnel_reflection", "source", "constant"), water);
  check(limpid_set_color(water, "fresnel_reflection", "color", sky), water);

  /* Each frame: where its planes lie, its camera, and where the picture shall lie. */
  const double s = sin(kPitch), c = cos(kPitch), near = 0.1, far = 100;
  const limpid_channel planes[] = {channel(LIMPID_COLOR_R, red), channel(LIMPID_COLOR_G, green),
                                   channel(LIMPID_COLOR_B, blue), channel(LIMPID_DEPTH, depth)};
  const limpid_frame frame = {
      .size = sizeof frame,
      .width = WIDTH,
      .height = HEIGHT,
      .planes = planes,
      .plane_count = sizeof planes / sizeof *planes,
      .view = {1, 0, 0, 0, /**/ 0, c, -s, -c * kEyeY, /**/ 0, s, c, -s * kEyeY, /**/ 0, 0, 0, 1},
      .projection = {kZoom * HEIGHT / WIDTH, 0, 0, 0, /**/ 0, kZoom, 0, 0, /**/ 0, 0,
                     (far + near) / (near - far), 2 * far * near / (near - far), /**/ 0, 0, -1, 0},
      .water_up = {0, 1, 0},
      .has_sun = 1,
      .sun_direction = {0.3, 1, 0.2},
      .sun_color = {3, 3, 3},
  };
  const limpid_channel outputs[] = {
      channel(LIMPID_OUT_R, wet_red), channel(LIMPID_OUT_G, wet_green),
      channel(LIMPID_OUT_B, wet_blue), channel(LIMPID_OUT_PATH, path)};
  const limpid_picture picture = {sizeof picture, outputs, sizeof outputs / sizeof *outputs};
  check(limpid_run(water, &frame, &picture), water);
  limpid_destroy(water);

  /* Water lies on what is below it, and on nothing else. */
  int wet = 0, misplaced = 0;
  float longest = 0;
  for (int i = 0; i < PIXELS; ++i) {
    const int changed = wet_red[i] != red[i] || wet_green[i] != green[i] || wet_blue[i] != blue[i];
    wet += path[i] > 0;
    misplaced += changed != (path[i] > 0);
    longest = fmaxf(longest, path[i]);
  }
  printf("%d of %d pixels are wet, the longest way through the water is %.2f\n", wet, PIXELS,
         longest);
  return wet == 0 || misplaced > 0 || abs(wet - below) > below / 100;
}
