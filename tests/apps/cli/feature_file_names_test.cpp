#include "apps/cli/feature_file_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gis/error.hpp"

namespace coastmesh {

namespace {

using testing::ElementsAre;

TEST(SafeFileName, HoldsNothingThatMeansSomethingInAPath) {
  EXPECT_EQ(safeFileName("Lake Superior"), "Lake Superior");
  EXPECT_EQ(safeFileName("../../etc/passwd"), "_.._etc_passwd");
  EXPECT_EQ(safeFileName("C:\\x|y?*<z>\"{}"), "C__x_y___z____");
  EXPECT_EQ(safeFileName(std::string("a\0b\nc", 5)), "a_b_c");
  EXPECT_EQ(safeFileName(" .. "), "");
  EXPECT_EQ(safeFileName("..."), "");
  EXPECT_EQ(safeFileName(""), "");
  EXPECT_EQ(safeFileName("Ladožskoje ozero, Ладожское озеро"), "Ladožskoje ozero, Ладожское озеро");
}

TEST(SafeFileName, IsCutBetweenLettersAndNotWithinOne) {
  EXPECT_EQ(safeFileName(std::string(300, 'x')), std::string(100, 'x'));
  std::string name = "a";
  for (int i = 0; i < 80; ++i) name += "é";  // two bytes each, starting at odd offsets
  EXPECT_EQ(safeFileName(name), name.substr(0, 99));
  EXPECT_EQ(safeFileName(std::string(99, 'x') + " y"), std::string(99, 'x'));
}

Feature feature(std::int64_t fid, const std::string& source, const std::string& name) {
  Feature feature;
  feature.fid = fid;
  feature.source = source;
  if (!name.empty()) feature.attributes.emplace_back("name", name);
  return feature;
}

TEST(NamesOfFeatures, AreNumbersWithTheirFilesWhereThereAreSeveral) {
  const Feature a = feature(3, "in/lakes.gpkg|big", "x"), b = feature(3, "in/lakes.gpkg|small", ""),
                c = feature(4, "in/lakes.gpkg|big", "x");
  EXPECT_THAT(namesOfFeatures({&a, &c}, ""), ElementsAre("3", "4"));
  EXPECT_THAT(namesOfFeatures({&a, &b, &c}, ""), ElementsAre("lakes-big-3", "lakes-small-3", "lakes-big-4"));
  EXPECT_THAT(namesOfFeatures({&a, &b}, "name"), ElementsAre("x", "lakes-small-3"));
  EXPECT_THROW(namesOfFeatures({&a, &b, &c}, "name"), InputError);
  EXPECT_THROW(namesOfFeatures({&a, &b}, "title"), OptionError);
}

TEST(NamesOfFeatures, OfFilesOfOneNameAreRefused) {
  const Feature a = feature(0, "x/lakes.shp", ""), b = feature(0, "y/lakes.shp", "");
  EXPECT_THROW(namesOfFeatures({&a, &b}, ""), InputError);
}

}  // namespace

}  // namespace coastmesh
