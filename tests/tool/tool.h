#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

/// The tool as its users meet it: run in a folder of its own, judged by what it prints, by its exit
/// code, and by what OpenImageIO's tools find in the files that it wrote.

namespace limpid::test {

using Words = std::vector<std::string>;

struct Ran {
  int code = 0;  ///< exit code, or minus the signal that ended it
  std::string out, err;
  long long memory = 0;  ///< bytes resident at once, at most
};

/// What a command printed says it all when a test fails.
void PrintTo(const Ran& ran, std::ostream* out);

/// Runs a program in a folder, without a shell between: a word is an argument, whatever is in it.
Ran run(const std::filesystem::path& folder, const Words& command);

class ToolTest : public ::testing::Test {
 protected:
  ToolTest();
  ~ToolTest() override;

  Ran limpid(const Words& arguments) const;
  /// composite plate.exr --scene scene.toml --look look.toml -o OUTPUT and what else there is.
  Ran composite(const std::string& output, const Words& more = {}) const;
  /// composite() that must succeed in silence.
  void composed(const std::string& output, const Words& more = {}) const;
  /// Expects exit 1 (or `code`), one sentence on stderr with all of `parts` in it, and no new file.
  void expect_refused(const Ran& ran, const Words& parts, int code = 1) const;
  /// The same of composite() with an old file under the output's name, which must stay.
  void expect_no_composite(const Words& more, const Words& parts, int code = 1) const;

  Ran oiiotool(const Words& arguments) const;
  /// What iinfo says of the files.
  std::string iinfo(const Words& files) const;
  std::string iinfo(const std::string& file) const { return iinfo(Words{file}); }
  /// No channel of any pixel differs by more; 0: the same values.
  bool same(const std::string& a, const std::string& b, double tolerance = 0) const;

  std::string text_of(const std::string& file) const;
  void write_text(const std::string& file, const std::string& text) const;
  std::vector<std::string> files() const;

  std::filesystem::path folder_;
};

}  // namespace limpid::test
