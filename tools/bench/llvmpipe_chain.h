#pragma once
#include "limpid/core/frame.h"

#include "gl_process.h"
#include "realistic_numbers.h"

namespace limpid::bench {

/// The look `realistic` as a shader over a full-screen triangle, from float textures into a float
/// target; llvmpipe is up to a fifth faster with the map in eight bits, which it then also filters
/// in eight bits, with 700 times the error. The timed part is the draw call up to the finished
/// picture: the textures are uploaded before, and the picture is not read back. Needs a GlContext.
class LlvmpipeChain : public GlDrawing {
 public:
  LlvmpipeChain(const RealisticNumbers& numbers, const Frame& frame);

  void draw() override;
  std::vector<float> picture() const override;  ///< red, green, blue

 private:
  Size size_;
};

}  // namespace limpid::bench
