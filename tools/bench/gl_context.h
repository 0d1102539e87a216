#pragma once
#define GL_GLEXT_PROTOTYPES
#include <initializer_list>
#include <vector>

#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include "limpid/core/rect.h"

namespace limpid::bench {

/// OpenGL 3.3 by EGL without a surface, current on this thread: Mesa's llvmpipe where there is no
/// GPU.
class GlContext {
 public:
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

 private:
  EGLDisplay display_;
  EGLContext context_;
};

/// Throws std::runtime_error, "OpenGL: WHAT failed", unless `good`.
void expect_gl(bool good, const char* what);

/// Compiled, linked and in use.
GLuint use_program(const char* vertex, const char* fragment);

/// Draws into a float color buffer of this size from now on, with a float depth buffer if wanted.
void use_target(Size size, bool depth);

/// Channels of the target (GL_RED, GL_DEPTH_COMPONENT ...) as planes one after the other, rows as
/// OpenGL has them, from the bottom.
std::vector<float> read_planes(std::initializer_list<GLenum> channels, Size size);

}  // namespace limpid::bench
