#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace limpid {

inline constexpr int kMaxFrames = 1'000'000;

/// The frames that a range names, as oiiotool reads it: "1-5", "1-100x33" (every 33rd), "10-1y3"
/// (all but every 3rd), "1,3,7-9"; ranges may run down. Throws Error (Fault::kUsage) for anything
/// else, for none at all and for more than kMaxFrames.
std::vector<int> frames_of(std::string_view range);

/// The name with its frame number put in: %d or %04d, a lone # (four digits, as oiiotool reads it),
/// or a run like #### or @@ (as many digits as letters). A name without any stays as it is. Throws
/// Error (Fault::kUsage) for another % code.
std::string name_of_frame(std::string_view pattern, int frame);

/// Whether name_of_frame() puts a number into it.
bool has_frame_number(std::string_view pattern);

}  // namespace limpid
