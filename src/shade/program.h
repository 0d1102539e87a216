#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "limpid/plan/plan.h"
#include "limpid/shade/shader_text.h"

#include "op/pass.h"

namespace limpid {

/// The textures from which a shader reads four texels at once (textureGather, which some languages
/// lack): completed ones, or all, whose images must then have the size of their windows.
enum class Gathered { kNothing, kMade, kAll };

/// A texture of a program, and the source of its values; ShaderTexture::texels is empty.
struct ProgramTexture : ShaderTexture {
  /// Writes row y, 0 ... height - 1: `width` texels of `step` floats each. The first `channels`
  /// floats are written; the others are unchanged or 0.
  std::function<void(int y, float* row, int step)> fill;
  /// The alternative for a usampler2D, for gathered textures: `width` texels of 32 bits.
  std::function<void(int y, std::uint32_t* row)> pack;
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

/// Records the plan. `frame` is the frame that completers made from `plate`, `pass` belongs to
/// `frame`. All must live until textures are filled. Throws Error as ShaderText.
ShaderProgram program_of(const Plan& plan, const Frame& plate, const Frame& frame, const Pass& pass,
                         const ShaderOptions& options, Gathered gathered = Gathered::kNothing);

}  // namespace limpid
