#include "farm/slurm_text.h"

#include <gmock/gmock.h>

#include "limpid/core/error.h"

namespace limpid::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

template <class Work>
std::string refused(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(SlurmTextTest, TasksOfSqueueHaveTheirStates) {
  EXPECT_THAT(tasks_of_squeue("12|3|RUNNING|None|n1\n"
                              "12|4|PENDING|Resources|\n"
                              "12|2|FAILED|NonZeroExitCode|n2\n"
                              "13|N/A|PENDING|Dependency|(null)\n"),
              ElementsAre(SlurmTask{12, 3, "RUNNING", "", "n1"},
                          SlurmTask{12, 4, "PENDING", "Resources", ""},
                          SlurmTask{12, 2, "FAILED", "NonZeroExitCode", "n2"},
                          SlurmTask{13, 0, "PENDING", "Dependency", ""}));
  EXPECT_THAT(tasks_of_squeue(""), IsEmpty());
}

TEST(SlurmTextTest, AnotherFormIsRefused) {
  EXPECT_THAT(refused([] { tasks_of_squeue("12|3|RUNNING\n"); }),
              HasSubstr("squeue printed '12|3|RUNNING': expected 5 columns"));
  EXPECT_THAT(refused([] { tasks_of_squeue("12|[5-9]|PENDING|None|\n"); }),
              HasSubstr("expected numbers of a job and its task"));
  EXPECT_THAT(refused([] { tasks_of_sacct("x_3|FAILED|1:0|n1\n"); }),
              HasSubstr("sacct printed 'x_3'"));
}

TEST(SlurmTextTest, TasksOfSacctAreThoseThatHaveBegun) {
  EXPECT_THAT(tasks_of_sacct("12_1|COMPLETED|0:0|n1\n"
                             "12_1.batch|COMPLETED|0:0|n1\n"
                             "12_2|FAILED|1:0|n2\n"
                             "12_3|CANCELLED by 1000|0:15|None assigned\n"
                             "12_[5-9]|PENDING|0:0|None assigned\n"
                             "13|COMPLETED|0:0|n3\n"),
              ElementsAre(SlurmTask{12, 1, "COMPLETED", "", "n1"},
                          SlurmTask{12, 2, "FAILED", "exit code 1:0", "n2"},
                          SlurmTask{12, 3, "CANCELLED", "exit code 0:15", ""},
                          SlurmTask{13, 0, "COMPLETED", "", "n3"}));
}

TEST(SlurmTextTest, AStateIsOverOrMayStillBecomeFrames) {
  for (const char* over : {"COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL", "PREEMPTED",
                           "BOOT_FAIL", "DEADLINE", "REVOKED", "OUT_OF_MEMORY"}) {
    EXPECT_TRUE(is_over(over)) << over;
    EXPECT_FALSE(is_running(over)) << over;
  }
  for (const char* not_over : {"PENDING", "RUNNING", "COMPLETING", "REQUEUED", "REQUEUE_HOLD",
                               "SUSPENDED", "CONFIGURING", "OF_A_LATER_SLURM"}) {
    EXPECT_FALSE(is_over(not_over)) << not_over;
  }
  EXPECT_TRUE(is_running("RUNNING"));
  EXPECT_FALSE(is_running("PENDING"));
}

TEST(SlurmTextTest, TheNumberOfAJobMayHaveACluster) {
  EXPECT_EQ(job_of_sbatch("12\n"), 12);
  EXPECT_EQ(job_of_sbatch("12;render\n"), 12);
  EXPECT_THAT(refused([] { job_of_sbatch("Submitted batch job 12\n"); }),
              HasSubstr("expected the number of a job"));
  EXPECT_THAT(refused([] { job_of_sbatch(""); }), HasSubstr("sbatch printed ''"));
}

TEST(SlurmTextTest, TheMostTasksOfAnArrayAreOneLessThanItsSize) {
  EXPECT_EQ(most_tasks_of("MaxArrayTasks = 7\nMaxArraySize            = 1001\nMaxDBDMsgs = 2\n"),
            1000);
  EXPECT_EQ(most_tasks_of("MaxJobCount = 10000\n"), std::nullopt);
  EXPECT_EQ(most_tasks_of("MaxArraySize = 0\n"), std::nullopt);
}

}  // namespace
}  // namespace limpid::test
