#include "parallel/work_log.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {
namespace {

TEST(WorkLog, SumsAndPaths) {
  WorkLog log;
  log.addAlone("first", 1.0);
  log.stages.push_back({"second", 0.5, {4.0, 3.0, 2.0, 1.0}});
  EXPECT_DOUBLE_EQ(log.work(), 11.5);
  EXPECT_DOUBLE_EQ(log.criticalPath(), 5.5);
  EXPECT_DOUBLE_EQ(log.timeOn(1), 11.5);
  EXPECT_DOUBLE_EQ(log.timeOn(2), 1.5 + 5.0);  // 4 and 1 on one thread, 3 and 2 on the other
  EXPECT_DOUBLE_EQ(log.timeOn(64), 5.5);
}

TEST(WorkLog, AppendKeepsTheOrder) {
  WorkLog log, other;
  log.addAlone("a", 1.0);
  other.addAlone("b", 2.0);
  log.append(std::move(other));
  ASSERT_EQ(log.stages.size(), 2u);
  EXPECT_EQ(log.stages[1].name, "b");
}

TEST(WorkLog, PicksStagesByName) {
  WorkLog log;
  for (const char* name : {"read", "refine", "read", "cut"}) log.addAlone(name, 1.0);
  EXPECT_EQ(log.only({"read"}).work(), 2.0);
  EXPECT_EQ(log.only({"cut", "refine"}).stages.front().name, "refine");
}

TEST(Recorder, WritesDownEveryItem) {
  withThreads({.threads = 3}, [] {
    Recorder recorder;
    std::atomic<int> calls = 0;
    recorder.forEach("calls", 17, {}, [&](std::size_t) { ++calls; });
    std::vector<int> touched(100'000, 0);
    forEachByStretches(recorder.loop("stretches"), touched.size(), [&](std::size_t i) { ++touched[i]; });
    const WorkLog log = recorder.finish();
    EXPECT_EQ(calls, 17);
    for (const int times : touched) ASSERT_EQ(times, 1);
    ASSERT_EQ(log.stages.size(), 3u);
    EXPECT_EQ(log.stages[0].items.size(), 17u);
    EXPECT_EQ(log.stages[1].name, "stretches");
    EXPECT_GT(log.stages[1].items.size(), 1u);
    for (const Stage& stage : log.stages) EXPECT_GE(stage.alone, 0.0);
  });
}

// A stage consists of many loops, each of which would report up to 1.
TEST(Recorder, LoopsToPassOnReportNoProgress) {
  withThreads({.threads = 2}, [] {
    Recorder recorder;
    int reports = 0;
    bool is_cancelled = false;
    const ItemLoop loop = recorder.loop("loop", {[&] { return is_cancelled; }, [&](double) { ++reports; }});
    loop(100, [](std::size_t) {});
    EXPECT_EQ(reports, 0);
    is_cancelled = true;
    EXPECT_THROW(loop(100, [](std::size_t) {}), Cancelled);
  });
}

// Nested loops: a region is cut while others wait.
TEST(ForEachItem, NestsWithoutMixing) {
  for (const int threads : {1, 2, 5}) {
    withThreads({.threads = threads}, [] {
      std::vector<std::atomic<int>> outer(20);
      forEachItem(outer.size(), {}, [&](std::size_t i) {
        thread_local bool inside = false;
        EXPECT_FALSE(inside) << "an outer item began within another";
        inside = true;
        std::atomic<int> sum = 0;
        forEachItem(50, {}, [&](std::size_t j) { sum += static_cast<int>(j); });
        EXPECT_EQ(sum, 49 * 50 / 2);
        ++outer[i];
        inside = false;
      });
      for (const auto& times : outer) EXPECT_EQ(times, 1);
    });
  }
}

}  // namespace
}  // namespace coastmesh
