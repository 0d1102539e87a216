#define GL_GLEXT_PROTOTYPES
#include "raster_llvmpipe.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <glm/gtc/type_ptr.hpp>

namespace limpid::bench {
namespace {

constexpr const char* kVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
uniform mat4 clip_from_world;
out vec3 world;
out vec3 n;
out vec2 texel;
void main() {
  world = position;
  n = normal;
  texel = uv;
  gl_Position = clip_from_world * vec4(position, 1.0);
})";

constexpr const char* kFragment = R"(#version 330 core
in vec3 world;
in vec3 n;
in vec2 texel;
uniform sampler2D base_texture;
uniform vec3 eye, sun, sun_color, base_color, ambient, specular;
uniform float power;
out vec4 color;
void main() {
  vec3 normal = normalize(n), viewer = normalize(eye - world);
  float cosine = dot(normal, sun);
  vec3 c = base_color * texture(base_texture, texel).rgb;
  color = vec4(c * (ambient + clamp(cosine, 0.0, 1.0) * sun_color), 1.0);
  if (cosine > 0.0) {
    vec3 r = 2.0 * cosine * normal - sun;
    color.rgb += specular * pow(clamp(dot(r, viewer), 0.0, 1.0), power) * sun_color;
  }
})";

void expect(bool good, const char* what) {
  if (!good) throw std::runtime_error(std::string("OpenGL: ") + what + " failed");
}

GLuint compiled(GLenum kind, const char* text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  expect(good, "compiling a shader");
  return shader;
}

template <class T>
void fill(GLenum target, const std::vector<T>& data) {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(),
               GL_STATIC_DRAW);
}

template <class T>
void attribute(GLuint location, const std::vector<T>& data) {
  fill(GL_ARRAY_BUFFER, data);
  glVertexAttribPointer(location, sizeof(T) / sizeof(float), GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(location);
}

}  // namespace

struct GlRasteriser::State {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  GLuint program = 0;
  Size size;
  GLsizei indices = 0;
};

GlRasteriser::GlRasteriser() : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  expect(eglInitialize(s.display, nullptr, nullptr), "eglInitialize");
  expect(eglBindAPI(EGL_OPENGL_API), "eglBindAPI");
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  s.context = eglCreateContext(s.display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  expect(s.context != EGL_NO_CONTEXT, "eglCreateContext");
  expect(eglMakeCurrent(s.display, EGL_NO_SURFACE, EGL_NO_SURFACE, s.context), "eglMakeCurrent");
  s.program = glCreateProgram();
  glAttachShader(s.program, compiled(GL_VERTEX_SHADER, kVertex));
  glAttachShader(s.program, compiled(GL_FRAGMENT_SHADER, kFragment));
  glLinkProgram(s.program);
  glUseProgram(s.program);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
}

GlRasteriser::~GlRasteriser() {
  eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(state_->display, state_->context);
  eglTerminate(state_->display);
}

const char* GlRasteriser::renderer() const {
  return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

void GlRasteriser::load(const RasterScene& scene) {
  State& s = *state_;
  s.size = scene.view.display.size();
  GLuint targets[2], frame = 0;
  glGenRenderbuffers(2, targets);
  glBindRenderbuffer(GL_RENDERBUFFER, targets[0]);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, s.size.width, s.size.height);
  glBindRenderbuffer(GL_RENDERBUFFER, targets[1]);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, s.size.width, s.size.height);
  glGenFramebuffers(1, &frame);
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, targets[0]);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, targets[1]);
  expect(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, "the frame buffer");
  glViewport(0, 0, s.size.width, s.size.height);

  const Mesh& mesh = scene.model.meshes[0];
  GLuint array = 0;
  glGenVertexArrays(1, &array);
  glBindVertexArray(array);
  attribute(0, mesh.positions);
  attribute(1, mesh.normals);
  attribute(2, mesh.uvs);
  fill(GL_ELEMENT_ARRAY_BUFFER, mesh.indices);
  s.indices = static_cast<GLsizei>(mesh.indices.size());

  const ModelTexture& texture = scene.model.textures[0];
  std::vector<std::uint8_t> bytes;
  for (float value : texture.rgba) bytes.push_back(static_cast<std::uint8_t>(value * 255 + 0.5f));
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, texture.width, texture.height, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, bytes.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);

  const auto color = [&](const char* uniform, double r, double g, double b) {
    glUniform3f(glGetUniformLocation(s.program, uniform), static_cast<float>(r),
                static_cast<float>(g), static_cast<float>(b));
  };
  const Camera& camera = scene.view.camera;
  const glm::mat4 clip_from_world(camera.projection * camera.view);
  glUniformMatrix4fv(glGetUniformLocation(s.program, "clip_from_world"), 1, GL_FALSE,
                     glm::value_ptr(clip_from_world));
  const glm::dvec3 eye = camera.eye(), sun = scene.lighting.sun.direction;
  const Material& m = scene.model.materials[0];
  color("eye", eye.x, eye.y, eye.z);
  color("sun", sun.x, sun.y, sun.z);
  color("sun_color", scene.lighting.sun.color.r, scene.lighting.sun.color.g,
        scene.lighting.sun.color.b);
  color("base_color", m.base_color.r, m.base_color.g, m.base_color.b);
  color("ambient", m.ambient.r, m.ambient.g, m.ambient.b);
  color("specular", m.specular.r, m.specular.g, m.specular.b);
  glUniform1f(glGetUniformLocation(s.program, "power"), static_cast<float>(m.power));
  const Rgb<double>& sky = scene.model.background;
  glClearColor(static_cast<float>(sky.r), static_cast<float>(sky.g), static_cast<float>(sky.b), 1);
  expect(glGetError() == GL_NO_ERROR, "loading the scene");
}

void GlRasteriser::draw() {
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDrawElements(GL_TRIANGLES, state_->indices, GL_UNSIGNED_INT, nullptr);
  glFinish();
}

std::vector<float> GlRasteriser::picture() const {
  const int width = state_->size.width, height = state_->size.height;
  const std::size_t area = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<float> planes(4 * area), rows(area);
  const GLenum kinds[] = {GL_RED, GL_GREEN, GL_BLUE, GL_DEPTH_COMPONENT};
  for (std::size_t p = 0; p < 4; ++p) {
    glReadPixels(0, 0, width, height, kinds[p], GL_FLOAT, rows.data());
    for (int y = 0; y < height; ++y) {
      const float* from = rows.data() + static_cast<std::ptrdiff_t>(height - 1 - y) * width;
      std::copy(
          from, from + width,
          planes.data() + p * area + static_cast<std::size_t>(y) * static_cast<std::size_t>(width));
    }
  }
  return planes;
}

}  // namespace limpid::bench
