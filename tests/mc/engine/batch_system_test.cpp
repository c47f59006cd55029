#include "mc/engine/batch_system.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

#include "core/base/check.hpp"

namespace drift::mc::batch_system_test {
namespace {

using Variables = std::map<std::string, std::string>;

ProcessVariables of(Variables variables) {
  return [v = std::move(variables)](const std::string& name) -> std::optional<std::string> {
    const auto found = v.find(name);
    return found == v.end() ? std::nullopt : std::optional(found->second);
  };
}

std::pair<std::size_t, std::size_t> share(const std::string& text, const Variables& variables) {
  const WorkerShare s = share_of_batch_system(text, of(variables));
  return {s.index, s.count};
}

std::string refusal(const std::string& text, const Variables& variables) {
  try {
    share_of_batch_system(text, of(variables));
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    return e.what();
  }
  return "";
}

using Share = std::pair<std::size_t, std::size_t>;

Variables slurm(int task, int first, int last, int step) {
  return {{"SLURM_ARRAY_TASK_ID", std::to_string(task)},
          {"SLURM_ARRAY_TASK_MIN", std::to_string(first)},
          {"SLURM_ARRAY_TASK_MAX", std::to_string(last)},
          {"SLURM_ARRAY_TASK_STEP", std::to_string(step)},
          {"SLURM_ARRAY_TASK_COUNT", std::to_string((last - first) / step + 1)}};
}

TEST(BatchSystem, EveryTaskOfAnArrayHasItsOwnPart) {
  for (const auto& [first, last, step] : {std::array{0, 15, 1}, {1, 16, 1}, {3, 33, 10}}) {
    std::set<std::size_t> parts;
    for (int task = first; task <= last; task += step) {
      const auto [index, count] = share("auto", slurm(task, first, last, step));
      EXPECT_EQ(count, static_cast<std::size_t>((last - first) / step + 1));
      EXPECT_LT(index, count);
      EXPECT_TRUE(parts.insert(index).second) << task;
    }
  }
  EXPECT_EQ(share("auto", {{"SGE_TASK_ID", "7"},
                           {"SGE_TASK_FIRST", "1"},
                           {"SGE_TASK_LAST", "9"},
                           {"SGE_TASK_STEPSIZE", "2"}}),
            (Share{3, 5}));
}

TEST(BatchSystem, TasksOfSrunAreCountedWithinThoseOfAnArray) {
  const Variables step{{"SLURM_STEP_NUM_TASKS", "4"}, {"SLURM_PROCID", "2"}};
  EXPECT_EQ(share("auto", step), (Share{2, 4}));
  Variables both = slurm(5, 0, 7, 1);
  both.insert(step.begin(), step.end());
  EXPECT_EQ(share("auto", both), (Share{22, 32}));
  both["SLURM_STEP_NUM_TASKS"] = "1";
  EXPECT_EQ(share("auto", both), (Share{5, 8}));
  EXPECT_EQ(launch_of(of(step)).tasks, 4u);
  EXPECT_STREQ(launch_of(of(step)).by, "srun");
  EXPECT_EQ(launch_of(of({})).tasks, 1u);
  EXPECT_EQ(launch_of(of({{"OMPI_COMM_WORLD_SIZE", "2"}})).tasks, 2u);
  EXPECT_EQ(launch_of(of({{"PMI_SIZE", "4"}, {"PMI_RANK", "1"}})).tasks, 4u);
  EXPECT_EQ(launch_of(of({{"PMI_SIZE", "1"}})).tasks, 1u);
  // A batch script beside its steps: many tasks were asked for, one was started.
  EXPECT_NE(refusal("auto", {{"SLURM_JOB_ID", "7"}, {"SLURM_NTASKS", "4"}, {"SLURM_PROCID", "0"}}),
            "");
  EXPECT_EQ(share("auto", {{"SLURM_NTASKS", "4"}, {"SLURM_PROCID", "0"}}), (Share{0, 4}));
  EXPECT_EQ(share("auto", {{"SLURM_NTASKS", "4"}, {"SLURM_PROCID", "3"}}), (Share{3, 4}));
}

TEST(BatchSystem, TasksOfAnMpiexecThatTheBuildDoesNotSpeakHaveTheirParts) {
  EXPECT_EQ(share("auto", {{"PMI_SIZE", "4"}, {"PMI_RANK", "1"}}), (Share{1, 4}));
  EXPECT_EQ(share("auto", {{"OMPI_COMM_WORLD_SIZE", "3"}, {"OMPI_COMM_WORLD_RANK", "2"}}),
            (Share{2, 3}));
  // mpirun within a job of Slurm: srun has started one helper of mpirun on each machine.
  EXPECT_EQ(share("auto", {{"OMPI_COMM_WORLD_SIZE", "8"},
                           {"OMPI_COMM_WORLD_RANK", "5"},
                           {"SLURM_STEP_NUM_TASKS", "2"},
                           {"SLURM_PROCID", "1"}}),
            (Share{5, 8}));
  EXPECT_NE(refusal("auto/3", {{"PMI_SIZE", "4"}, {"PMI_RANK", "1"}}), "");
  EXPECT_NE(refusal("auto", {{"PMI_SIZE", "4"}}), "");
}

TEST(BatchSystem, WhereTheSystemDoesNotSayHowManyTheUserDoes) {
  const Variables pbs{{"PBS_ARRAY_INDEX", "16"}};
  EXPECT_NE(refusal("auto", pbs).find("auto/n"), std::string::npos);
  EXPECT_EQ(share("auto/16", pbs), (Share{0, 16}));  // of 1 to 16, each still has its own
  EXPECT_EQ(share("auto/8", slurm(3, 3, 5, 2)), (Share{3, 8}));  // tasks 3 and 5 of 0 to 7, again
}

TEST(BatchSystem, WhatSaysNothingOrOddThingsIsRefused) {
  EXPECT_NE(refusal("auto", {}), "");
  EXPECT_NE(refusal("auto/16", {}), "");
  EXPECT_NE(refusal("auto/0", slurm(1, 0, 3, 1)), "");
  EXPECT_NE(refusal("automatic", slurm(1, 0, 3, 1)), "");
  EXPECT_NE(refusal("auto", {{"SGE_TASK_ID", "undefined"}}), "");
  Variables list = slurm(3, 1, 7, 1);  // --array=1,3,7
  list["SLURM_ARRAY_TASK_COUNT"] = "3";
  EXPECT_NE(refusal("auto", list).find("not one after the other"), std::string::npos);
}

}  // namespace
}  // namespace drift::mc::batch_system_test
