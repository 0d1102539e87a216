#include <gmock/gmock.h>

#include "tool/tool.h"

namespace limpid::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CompletionTest : public ToolTest {
 protected:
  /// The words that bash offers in place of the last of these words.
  std::string offered(const std::string& words) {
    write_text("limpid.bash", limpid({"completion", "bash"}).out);
    write_text("ask.bash", ". ./limpid.bash\nCOMP_WORDS=(" + words +
                               ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_limpid\n"
                               "echo \" ${COMPREPLY[*]} \"\n");
    const Ran ran = run(folder_, {"/bin/bash", "ask.bash"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out;
  }
};

TEST_F(CompletionTest, BashIsOfferedVerbsOptionsAndTheWordsOfAnOption) {
  EXPECT_THAT(offered("limpid com"), HasSubstr(" composite compare "));
  EXPECT_EQ(offered("limpid composite --run"), " --runner \n");
  EXPECT_EQ(offered("limpid composite plate.exr --missing ''"), " error skip hold \n");
  EXPECT_EQ(offered("limpid --threads 2 plan --sce"), " --scene \n");
  EXPECT_EQ(offered("limpid composite plate.exr -o ''"), "  \n") << "names of files are bash's own";
  EXPECT_THAT(offered("limpid help re"), HasSubstr(" render "));
  EXPECT_THAT(offered("limpid inspect --"), Not(HasSubstr("--runner")));
}

TEST_F(CompletionTest, OtherShellsHaveScriptsOfTheSameOptions) {
  EXPECT_THAT(limpid({"completion", "zsh"}).out, HasSubstr("bashcompinit\n_limpid() {"));
  const std::string fish = limpid({"completion", "fish"}).out;
  EXPECT_THAT(fish, HasSubstr("complete -c limpid -n __fish_use_subcommand -a composite -d "));
  EXPECT_THAT(fish, HasSubstr(" -n '__fish_seen_subcommand_from composite' -l missing -r -a "
                              "'error skip hold' -d "));
  expect_refused(limpid({"completion", "tcsh"}), {"'tcsh': expected bash, zsh or fish"}, 2);
  expect_refused(limpid({"completion"}), {"shell is required"}, 2);
}

}  // namespace
}  // namespace limpid::test
