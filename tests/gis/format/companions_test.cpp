// Files that belong to a source, which outputs must not replace.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gis/file/output_files.hpp"

namespace coastmesh {
namespace {

using ::testing::Contains;
using ::testing::IsSupersetOf;
using ::testing::Not;

TEST(Companions, OfAShapefile) {
  const std::vector<std::string> beside = companionsOf("d/lake.shp");
  EXPECT_THAT(beside, IsSupersetOf({"d/lake.dbf", "d/lake.shx", "d/lake.prj", "d/lake.cpg"}));
  EXPECT_THAT(beside, Not(Contains("d/lake.shp")));
}

TEST(Companions, InCapitalsIfTheSourceIs) {
  EXPECT_THAT(companionsOf("d/LAKE.SHP"), IsSupersetOf({"d/LAKE.DBF", "d/LAKE.SHX", "d/LAKE.PRJ"}));
  EXPECT_THAT(companionsOf("d/SEA.SLF"), IsSupersetOf({"d/SEA.cli", "d/SEA.CLI", "d/SEA.prj"}));
  EXPECT_THAT(companionsOf("d/SEA_GRD.DAT"), IsSupersetOf({"d/SEA_DEP.DAT", "d/SEA_OBC.DAT"}));
  EXPECT_THAT(companionsOf("d/SEA.POLY"), IsSupersetOf({"d/SEA.node"}));
}

}  // namespace
}  // namespace coastmesh
