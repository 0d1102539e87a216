#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace limpid {

inline constexpr int kMaxFrames = 1'000'000;

/// The frames of a range in oiiotool's syntax: "1-5", "1-100x33" (every 33rd), "10-1y3" (all but
/// every 3rd), "1,3,7-9"; ranges may run down. Throws Error (Fault::kUsage) for another text, for a
/// range without frames and for more than kMaxFrames.
std::vector<int> frames_of(std::string_view range);

/// The name with a frame number in place of %d or %04d, a single # (four digits, as in oiiotool),
/// or a run like #### or @@ (as many digits as signs). A name without such a pattern stays
/// unchanged. Throws Error (Fault::kUsage) for another % code.
std::string name_of_frame(std::string_view pattern, int frame);

/// Whether the name has such a pattern.
bool has_frame_number(std::string_view pattern);

}  // namespace limpid
