#include "apps/job/memory_share.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <string>
#include <vector>

#include "apps/job/group_task.hpp"
#include "apps/job/mesh_job.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

TEST(MemoryShare, ThoseMeshedTogetherTakeNoMoreThanThereIs) {
  const std::vector<std::size_t> points{900000, 100000, 40, 40, 40, 4, 4, 4, 4, 4};
  const std::size_t all = std::accumulate(points.begin(), points.end(), std::size_t{0});
  for (const std::size_t at_a_time : {1u, 2u, 5u, 10u, 64u}) {
    const Together together{points.size(), all, at_a_time};
    double sum = 0.0;
    for (std::size_t g = 0; g < std::min(points.size(), at_a_time); ++g)
      sum += memoryShare(1e9, points[g], together);  // the largest groups
    EXPECT_LE(sum, 1e9 * (1.0 + 1e-12)) << at_a_time;
    EXPECT_GT(memoryShare(1e9, points.back(), together), 1e9 / 200.0) << at_a_time;
  }
}

TEST(MemoryShare, OneAloneHasAll) {
  EXPECT_EQ(memoryShare(1e9, 5, {1, 5, 64}), 1e9);
  EXPECT_EQ(memoryShare(1e9, 0, {0, 0, 1}), 1e9);
}

TEST(MemoryShare, WithoutALimitThereIsNone) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(memoryShare(kInfinity, 3, {7, 100, 2}), kInfinity);
  EXPECT_EQ(memoryShare(kInfinity, 0, {7, 0, 2}), kInfinity);
}

TEST(MemoryShare, AGridHoldsAllOfItsArrays) {
  Grid grid;
  EXPECT_EQ(bytesHeldBy(grid), 0.0);
  grid.nodes.resize(10);
  grid.size_m.resize(10);
  grid.triangles.resize(7);
  grid.area_m2.resize(7);
  EXPECT_EQ(bytesHeldBy(grid), 10 * 24 + 7 * 20);
}

// Square lakes with sides of 1 km in a plane, each meshed on its own: some 11,500 vertices with edges of 10 m.
constexpr double kEdge = 10.0, kVertices = 1e6 / (kEdge * kEdge) * 1.15;
constexpr double kPeakBytes = 320.0;  // per vertex, as estimated by a job

MeshJob jobOfLakes(int count, double memory) {
  auto lakes = std::make_shared<Coastline>();
  for (int i = 0; i < count; ++i) {
    const double west = 3000.0 * i;
    Feature& lake = lakes->features.emplace_back();
    lake.fid = i;
    lake.polygons.push_back({{{west, 0}, {west + 1000, 0}, {west + 1000, 1000}, {west, 1000}}, {}});
  }
  MeshJob job;
  job.input.ready = lakes;
  job.sizes.most_m = kEdge;
  job.memory = memory;
  return job;
}

std::vector<std::int64_t> refusedOf(const MeshJobResult& result) {
  std::vector<std::int64_t> fids;
  for (const Refusal& refusal : result.refusals) {
    EXPECT_TRUE(refusal.lacks_memory) << refusal.reason;
    EXPECT_NE(refusal.reason.find("there is memory for about"), std::string::npos) << refusal.reason;
    fids.insert(fids.end(), refusal.fids.begin(), refusal.fids.end());
  }
  return fids;
}

// Two lakes at once exceed the memory; one after another they fit.
TEST(JobMemory, WhatDoesNotFitTogetherIsMeshedOneByOne) {
  MeshJob job = jobOfLakes(3, 1.9 * kVertices * kPeakBytes);
  const MeshJob unlimited = jobOfLakes(3, std::numeric_limits<double>::infinity());
  const MeshJobResult expected = runMeshJob(unlimited);
  for (const int threads : {1, 2, 8}) {
    job.parallel.threads = threads;
    const MeshJobResult result = runMeshJob(job);
    EXPECT_TRUE(result.refusals.empty());
    EXPECT_EQ(result.digest, expected.digest);
    EXPECT_EQ(result.grid.nodes, expected.grid.nodes);
    EXPECT_EQ(result.grid.triangles, expected.grid.triangles);
  }
}

// Each lake fits alone, but not beside the finished meshes of all others.
TEST(JobMemory, FinishedMeshesCount) {
  MeshJob job = jobOfLakes(4, 1.3 * kVertices * kPeakBytes);
  for (const int threads : {1, 2, 8}) {
    job.parallel.threads = threads;
    const MeshJobResult result = runMeshJob(job);
    const std::vector<std::int64_t> refused = refusedOf(result);
    EXPECT_GT(result.regions, 0u);
    EXPECT_EQ(refused, (std::vector<std::int64_t>{2, 3})) << threads;
  }
}

TEST(JobMemory, OneThatNeverFitsIsRefused) {
  const MeshJobResult result = runMeshJob(jobOfLakes(1, 0.7 * kVertices * kPeakBytes));
  EXPECT_EQ(refusedOf(result), std::vector<std::int64_t>{0});
  EXPECT_EQ(result.regions, 0u);
}

// `keep` is called once per group with its final result, also if that lacks memory.
TEST(JobMemory, KeepersLearnWhatLacksMemory) {
  MeshJob job = jobOfLakes(4, 1.3 * kVertices * kPeakBytes);
  std::mutex mutex;
  std::map<std::size_t, bool> lacking;
  job.exchange.keep = [&](std::size_t group, const GroupResult& result) {
    const std::lock_guard lock(mutex);
    EXPECT_TRUE(lacking.emplace(group, result.lacks_memory).second) << group;
  };
  runMeshJob(job);
  EXPECT_EQ(lacking, (std::map<std::size_t, bool>{{0, false}, {1, false}, {2, true}, {3, true}}));
}

// Each lake has room while it is meshed, but all finished meshes together exceed the memory.
TEST(JobMemory, MoreMeshesThanMemoryEndTheRun) {
  MeshJob job = jobOfLakes(16, 2.3 * kVertices * kPeakBytes);
  job.parallel.threads = 1;
  EXPECT_THROW(runMeshJob(job), InputError);
}

}  // namespace

}  // namespace coastmesh
