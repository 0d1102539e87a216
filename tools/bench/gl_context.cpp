#include "gl_context.h"

#include <stdexcept>
#include <string>

#include <EGL/eglext.h>

namespace limpid::bench {
namespace {

GLuint compiled(GLenum kind, const char* text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  expect_gl(good, "compiling a shader");
  return shader;
}

void attach_buffer(GLenum place, GLenum format, Size size) {
  GLuint buffer = 0;
  glGenRenderbuffers(1, &buffer);
  glBindRenderbuffer(GL_RENDERBUFFER, buffer);
  glRenderbufferStorage(GL_RENDERBUFFER, format, size.width, size.height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer);
}

}  // namespace

void expect_gl(bool good, const char* what) {
  if (!good) throw std::runtime_error(std::string("OpenGL: ") + what + " failed");
}

GlContext::GlContext() {
  display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  expect_gl(eglInitialize(display_, nullptr, nullptr), "eglInitialize");
  expect_gl(eglBindAPI(EGL_OPENGL_API), "eglBindAPI");
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               3,
                               EGL_CONTEXT_MINOR_VERSION,
                               3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  expect_gl(context_ != EGL_NO_CONTEXT, "eglCreateContext");
  expect_gl(eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_), "eglMakeCurrent");
}

GlContext::~GlContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

GLuint use_program(const char* vertex, const char* fragment) {
  const GLuint program = glCreateProgram();
  glAttachShader(program, compiled(GL_VERTEX_SHADER, vertex));
  glAttachShader(program, compiled(GL_FRAGMENT_SHADER, fragment));
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  expect_gl(good, "linking a program");
  glUseProgram(program);
  return program;
}

void use_target(Size size, bool depth) {
  GLuint frame = 0;
  glGenFramebuffers(1, &frame);
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  attach_buffer(GL_COLOR_ATTACHMENT0, GL_RGBA32F, size);
  if (depth) attach_buffer(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, size);
  expect_gl(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE,
            "the frame buffer");
  glViewport(0, 0, size.width, size.height);
}

std::vector<float> read_planes(std::initializer_list<GLenum> channels, Size size) {
  const std::size_t area =
      static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  std::vector<float> planes(channels.size() * area);
  float* plane = planes.data();
  for (const GLenum channel : channels) {
    glReadPixels(0, 0, size.width, size.height, channel, GL_FLOAT, plane);
    plane += area;
  }
  expect_gl(glGetError() == GL_NO_ERROR, "reading the picture");
  return planes;
}

}  // namespace limpid::bench
