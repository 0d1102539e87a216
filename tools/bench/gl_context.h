#pragma once
#define GL_GLEXT_PROTOTYPES
#include <initializer_list>
#include <vector>

#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include "limpid/core/rect.h"

namespace limpid::bench {

/// OpenGL 3.3 by EGL without a surface, current on this thread: Mesa's llvmpipe on a machine
/// without a GPU.
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

/// A program that is compiled, linked and in use.
GLuint use_program(const char* vertex, const char* fragment);

/// Makes a float color buffer of this size the target of later draws, with a float depth buffer if
/// `depth`.
void use_target(Size size, bool depth);

/// Channels of the target (GL_RED, GL_DEPTH_COMPONENT ...) as planes one after the other; rows run
/// from the bottom up, as in OpenGL.
std::vector<float> read_planes(std::initializer_list<GLenum> channels, Size size);

}  // namespace limpid::bench
