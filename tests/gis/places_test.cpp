// Numbers in messages.
#include "gis/places.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace coastmesh {
namespace {

TEST(AtMost, IsNeverMoreThanTheNumber) {
  EXPECT_EQ(atMost(33.996), "33.9");
  EXPECT_EQ(atMost(34.0), "34");
  EXPECT_EQ(atMost(0.99999), "0.999");
  EXPECT_EQ(atMost(100.0), "100");
  EXPECT_EQ(atMost(99.96), "99.9");
  EXPECT_EQ(atMost(1234.0), "1.23e+03");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-4.0, 5.0);
  for (int i = 0; i < 10'000; ++i) {
    const double number = std::pow(10.0, exponent(random));
    const double shown = std::strtod(atMost(number).c_str(), nullptr);
    EXPECT_LE(shown, number);
    EXPECT_GT(shown, 0.989 * number);
  }
}

}  // namespace
}  // namespace coastmesh
