#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

/// The tool as a program: it runs in its own folder, and its printed text, its exit code and its
/// files, read by OpenImageIO's tools, are checked.

namespace limpid::test {

using Words = std::vector<std::string>;

struct Ran {
  int code = 0;  ///< exit code, or minus the signal that ended it
  std::string out, err;
  long long memory = 0;  ///< bytes resident at once, at most
};

/// A failing test prints the output of the command.
void PrintTo(const Ran& ran, std::ostream* out);

/// Runs a program in a folder, without a shell: each word is one argument, with any characters.
Ran run(const std::filesystem::path& folder, const Words& command);

class ToolTest : public ::testing::Test {
 protected:
  ToolTest();
  ~ToolTest() override;

  Ran limpid(const Words& arguments) const;
  /// composite plate.exr --scene scene.toml --look look.toml -o OUTPUT, and further arguments.
  Ran composite(const std::string& output, const Words& more = {}) const;
  /// composite() that must succeed and print nothing.
  void composed(const std::string& output, const Words& more = {}) const;
  /// Expects exit 1 (or `code`), one sentence on stderr with all of `parts` in it, and no new file.
  void expect_refused(const Ran& ran, const Words& parts, int code = 1) const;
  /// The same for composite() with an old file under the output's name, which must stay.
  void expect_no_composite(const Words& more, const Words& parts, int code = 1) const;

  Ran oiiotool(const Words& arguments) const;
  /// The output of iinfo for the files.
  std::string iinfo(const Words& files) const;
  std::string iinfo(const std::string& file) const { return iinfo(Words{file}); }
  /// No channel of any pixel differs by more than the tolerance; 0: the same values.
  bool same(const std::string& a, const std::string& b, double tolerance = 0) const;

  std::string text_of(const std::string& file) const;
  void write_text(const std::string& file, const std::string& text) const;
  std::vector<std::string> files() const;

  std::filesystem::path folder_;
};

}  // namespace limpid::test
