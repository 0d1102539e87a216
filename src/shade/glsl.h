#pragma once
#include <set>
#include <string>

#include "shade/recording.h"

namespace limpid {

/// The functions and declarations that a program's statements need, collected while they are
/// printed.
struct GlslNeeds {
  std::set<NodeOp> ops;
  std::set<std::pair<NodeOp, int>> lookups;  ///< of a plane or a texture
  std::set<int> powers;                      ///< whole exponents
  bool power = false;                        ///< any other exponent
  bool infinity = false;
  bool loops = false;
  bool slope_moments = false;  ///< mean and square of one place
  bool nearest_of = false;     ///< of four texels
};

/// A recording as the statements of a GLSL function body. Numbers of the frame are `limpid.NAME`,
/// NAME as glsl_name() makes it; lookups are calls of limpid_NAME (glsl_lookups.h).
class GlslBody {
 public:
  /// With `computes_frame`, what follows from numbers of the frame alone is computed here, once, in
  /// double: pixels read `limpid.frame_K`, K counted from 0, and frame_numbers() has the values.
  explicit GlslBody(const Recording& recording, bool computes_frame = false);
  const std::string& text() const { return text_; }
  const GlslNeeds& needs() const { return needs_; }
  const std::vector<double>& frame_numbers() const { return frame_numbers_; }
  /// The expression of an output, after the statements.
  const std::string& output(std::size_t i) const { return outputs_[i]; }

 private:
  std::string text_;
  GlslNeeds needs_;
  std::vector<double> frame_numbers_;
  std::vector<std::string> outputs_;
};

/// "waves.phase[2]" -> "waves_phase_2".
std::string glsl_name(const std::string& name);
/// "depth", "color": the role of the plane, and the letter of its channel in a texel.
std::string role_word(PlaneId plane);
char channel_letter(PlaneId plane);

}  // namespace limpid
