#pragma once
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace limpid {

/// The kind of an error, which tells the caller how to react; the tool makes its exit code from it.
enum class Fault {
  kJob,     ///< the input or the request is invalid: exit 1
  kUsage,   ///< the command line is invalid: exit 2
  kRetry,   ///< another attempt may succeed (disk full, file vanished): exit 75
  kMemory,  ///< out of memory: exit 1 if the process has a memory limit, else 75
};

/// The exception of the library; besides it the library throws only std::bad_alloc. what() is one
/// sentence that names the input, its value and the expected value, as in `depth_fog.density = -1:
/// expected 0 ... 1000 (1/unit)`. The library never prints.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& sentence, Fault fault = Fault::kJob)
      : std::runtime_error(sentence), fault_(fault) {}
  Fault fault() const { return fault_; }

 private:
  Fault fault_;
};

/// The end of the sentence of each Error of Fault::kMemory.
inline constexpr std::string_view kNeedsMemory = "needs more memory than there is";

/// An Error of Fault::kMemory: "NAME: needs more memory than there is", or the same without a name.
Error no_memory(const std::string& name = "");

/// The name of `known` that is closest to `word` by edit distance; "" if more than a third of the
/// letters differ, too many for a typing error.
std::string nearest_name(std::string_view word, const std::vector<std::string>& known);

/// "; did you mean 'x'?" with the nearest known name, or "" if nearest_name() finds none.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

/// "a, b, c", for messages that list known names.
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

}  // namespace limpid
