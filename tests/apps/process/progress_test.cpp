#include "apps/process/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace coastmesh {

namespace {

TEST(ProgressLine, TellsPhaseShareAndTime) {
  EXPECT_EQ(progressLine("refine", 0.5, 65.0, 40), "refine [#########          ]  50 %  1:05");
  EXPECT_EQ(progressLine("refine", 0.5, 3725.0, 24), "refine  50 %  1:02:05");
}

TEST(ProgressLine, NeverIsWiderThanTheTerminal) {
  for (int width = 0; width <= 200; ++width) {
    for (const double share : {-1.0, 0.0, 0.003, 0.999, 1.0, 7.0}) {
      const std::string line = progressLine("refine", share, 1e5, width);
      EXPECT_LE(line.size(), static_cast<std::size_t>(width));
      EXPECT_EQ(line.find('\n'), std::string::npos);
    }
  }
}

TEST(ProgressLine, TheBarFillsWithTheShare) {
  const auto filled = [](double share) {
    const std::string line = progressLine("read", share, 0.0, 100);
    return std::count(line.begin(), line.end(), '#');
  };
  EXPECT_EQ(filled(0.0), 0);
  EXPECT_EQ(filled(1.0), 40);
  EXPECT_LT(filled(0.2), filled(0.4));
}

}  // namespace

}  // namespace coastmesh
