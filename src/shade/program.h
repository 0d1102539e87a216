#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "limpid/plan/plan.h"
#include "limpid/shade/shader_text.h"

#include "op/pass.h"

namespace limpid {

/// A texture of a program, and where its values come from; ShaderTexture::texels is empty.
struct ProgramTexture : ShaderTexture {
  /// Writes row y, 0 ... height - 1: `width` texels of `step` floats each, of which the first
  /// `channels` are written.
  std::function<void(int y, float* row, int step)> fill;
};

/// A shader, and the values of the frame that it was recorded for.
struct ShaderProgram {
  std::string text, id;
  int block_binding = 0;
  std::vector<std::byte> block;
  std::vector<ShaderNumber> numbers;
  std::vector<ProgramTexture> textures;
  std::vector<ShaderOutput> outputs;
  Rect work;
  Size group;  ///< ShaderText::group()
};

/// Records the plan. `frame` is what completers made of `plate`, `pass` is of that. All of them are
/// to live as long as textures are filled. Throws Error as ShaderText.
ShaderProgram program_of(const Plan& plan, const Frame& plate, const Frame& frame, const Pass& pass,
                         const ShaderOptions& options);

}  // namespace limpid
