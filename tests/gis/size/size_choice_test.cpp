// Sizes for seas with little or no shore.
#include "gis/size/size_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gis/coast/segment_tags.hpp"
#include "tests/support/followed_coasts.hpp"

namespace coastmesh {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kSide = 40e3;

// A square of 40 km with open sides.
Domain openBox() {
  Domain domain;
  addShore(domain, {{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}});
  for (Segment& s : domain.pslg.segments) s.tag = kOpenTag;
  return domain;
}

SizeOptions chosenFor(const Domain& domain) {
  SizeOptions options;
  options.choose = true;
  const SizeOptions chosen = chooseSizes(options, {}, domain, inOrder);
  constexpr double kMany = 1e6;
  const double vertices = makeSizeFunction(chosen, {}, domain, kMany, inOrder).demand.vertices;
  EXPECT_GT(vertices, 18e3);
  EXPECT_LT(vertices, 50e3);
  return chosen;
}

TEST(SizeChoice, WithoutAShoreOneSizeIsChosen) {
  const SizeOptions chosen = chosenFor(openBox());
  EXPECT_EQ(chosen.shore_m, SizeOptions::kNone);
  EXPECT_NEAR(chosen.size_m, kSide / 160.0, kSide / 800.0);  // 30,000 vertices
  const std::string text = sizesAsOptions(chosen);
  EXPECT_THAT(text, HasSubstr("--size "));
  EXPECT_THAT(text, Not(HasSubstr("--size-shore")));
  EXPECT_THAT(text, Not(HasSubstr("inf")));
}

TEST(SizeChoice, AnIsletIsNotMeshedToTheGrain) {
  Domain domain = openBox();
  const Point at{0.3 * kSide, 0.6 * kSide};
  addRing(domain, at, 50.0, 8, true);
  const SizeOptions chosen = chosenFor(domain);
  EXPECT_GE(chosen.shore_m, 1.0);
  EXPECT_LT(chosen.shore_m, 100.0);
  EXPECT_LT(chosen.most_m, kSide / 20.0);  // the other vertices are in the open sea
  EXPECT_GT(chosen.most_m, kSide / 200.0);
}

TEST(SizeChoice, AStraightShoreDecides) {
  Domain domain = openBox();
  domain.pslg.segments[0].tag = 0;
  const SizeOptions chosen = chosenFor(domain);
  EXPECT_EQ(chosen.most_m, kSide / 20.0);
  EXPECT_NEAR(chosen.shore_m, kSide / 4000.0, kSide / 8000.0);
}

TEST(SizeChoice, KeepsTheMinimumSize) {
  Domain domain = openBox();
  domain.pslg.segments[0].tag = 0;
  SizeOptions options;
  options.choose = true;
  for (const double least : {300.0, 1234.5, 5000.0}) {
    options.least_m = least;
    const SizeOptions chosen = chooseSizes(options, {}, domain, inOrder);
    EXPECT_GE(chosen.shore_m, least);
    EXPECT_GE(chosen.most_m, chosen.shore_m);
  }
  // Where the shore may not be finer, the open sea is.
  options.least_m = 200.0;
  const SizeOptions chosen = chooseSizes(options, {}, domain, inOrder);
  EXPECT_EQ(chosen.shore_m, 200.0);
  EXPECT_GT(makeSizeFunction(chosen, {}, domain, 1e6, inOrder).demand.vertices, 18e3);
}

TEST(SizeChoice, LeavesVerticesToOtherDomains) {
  const Domain domain = openBox();
  SizeOptions options;
  options.choose = true;
  const double all = chooseSizes(options, {}, domain, inOrder).size_m;
  EXPECT_NEAR(chooseSizes(options, {}, domain, inOrder, 0.25).size_m, 2.0 * all, 0.1 * all);
}

TEST(SizeChoice, OptionsThatWereGivenAreNotRepeated) {
  SizeOptions options;
  options.shore_m = 1.0 / 3.0;
  EXPECT_EQ(sizesAsOptions(options), "--size-shore 0.3333333333333333 --shore-rate 0.15 --grade 0.3 --coast keep");
  options.depth.wave_elements = 60.0;
  options.time_step_s = 5.0;
  EXPECT_EQ(sizesAsOptions(options),
            "--size-shore 0.3333333333333333 --shore-rate 0.15 --grade 0.3 --wave-elements 60 --time-step 5 "
            "--coast keep");
  options.given = {true, true, true, true};
  EXPECT_EQ(sizesAsOptions(options), "--size-shore 0.3333333333333333 --wave-elements 60");
}

}  // namespace
}  // namespace coastmesh
