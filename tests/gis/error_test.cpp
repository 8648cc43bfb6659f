#include "gis/error.hpp"

#include <cpl_error.h>
#include <gtest/gtest.h>

#include "gis/crs/ogr_support.hpp"

namespace coastmesh {
namespace {

TEST(OneLine, FoldsWhiteSpace) {
  EXPECT_EQ(oneLine("  cannot read\r\n\tthe file\x01: \n\n"), "cannot read the file :");
  EXPECT_EQ(oneLine("'süß.gpkg': ok"), "'süß.gpkg': ok");
  EXPECT_EQ(oneLine(" \n"), "");
}

TEST(OneLine, CutsAtAWord) {
  EXPECT_EQ(oneLine("one two three", 13), "one two three");
  EXPECT_EQ(oneLine("one two three", 12), "one two…");
  EXPECT_EQ(oneLine("one two three", 7), "one two…");
  EXPECT_EQ(oneLine("ääää", 3), "ä…");  // two bytes each: characters are not split
}

TEST(Errors, AreOneLine) {
  EXPECT_STREQ(InputError("a\nb").what(), "a b");
  EXPECT_STREQ(OutputError("a\n\n  b\n").what(), "a b");
}

// SQLite's driver quotes whole statements if the disk is full.
TEST(OgrErrors, GiveOneShortLine) {
  const OgrErrors errors;
  std::string statement = "failed to execute:\n";
  for (int i = 0; i < 1000; ++i) statement += "INSERT INTO t\n";
  CPLError(CE_Failure, CPLE_AppDefined, "%s", statement.c_str());
  EXPECT_TRUE(errors.failed());
  EXPECT_TRUE(errors.text().starts_with("failed to execute: INSERT INTO t INSERT")) << errors.text();
  EXPECT_LT(errors.text().size(), 310u);
  EXPECT_EQ(errors.text().find('\n'), std::string::npos);
}

}  // namespace
}  // namespace coastmesh
