#pragma once
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace limpid {

/// What the caller can do about an error; the tool turns it into its exit code.
enum class Fault {
  kJob,     ///< the input or the request is wrong: exit 1
  kUsage,   ///< the command line is wrong: exit 2
  kRetry,   ///< trying again may work (disk full, file vanished): exit 75
  kMemory,  ///< memory ended: exit 1 where a limit says how much there may be, else 75
};

/// The one exception of the library. what() is one sentence that names the thing, the value and
/// what was expected, as in `depth_fog.density = -1: expected 0 ... 1000 (1/unit)`. The library
/// never prints.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& sentence, Fault fault = Fault::kJob)
      : std::runtime_error(sentence), fault_(fault) {}
  Fault fault() const { return fault_; }

 private:
  Fault fault_;
};

/// How the sentence of each Error of Fault::kMemory ends.
inline constexpr std::string_view kNeedsMemory = "needs more memory than there is";

/// The Error of Fault::kMemory: "NAME: needs more memory than there is", or without a name.
Error no_memory(const std::string& name = "");

/// The name of `known` that is closest to `word` by edit distance, or "" when none is near enough
/// to be a slip of the hand (more than a third of the letters differ).
std::string nearest_name(std::string_view word, const std::vector<std::string>& known);

/// "; did you mean 'x'?" for the nearest known name, or "" when nothing is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

/// "a, b, c" for error texts that list what there is.
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

}  // namespace limpid
