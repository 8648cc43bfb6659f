#include "gis/crs/crs.hpp"

#include <gtest/gtest.h>

#include "gis/crs/crs_from_ogr.hpp"
#include "gis/error.hpp"

namespace coastmesh {
namespace {

TEST(Crs, ReadsCodesTextAndProjStrings) {
  const Crs utm = parseCrs("EPSG:32616");
  EXPECT_EQ(utm.authority, "EPSG:32616");
  EXPECT_FALSE(utm.geographic);
  EXPECT_FALSE(utm.isPlane());
  EXPECT_EQ(utm.wkt.rfind("PROJCRS[", 0), 0u);
  const Crs proj = parseCrs("+proj=laea +lat_0=52 +lon_0=10 +ellps=GRS80 +units=m");
  EXPECT_FALSE(proj.isPlane());
  EXPECT_EQ(proj.authority, "");
  EXPECT_TRUE(sameCrs(parseCrs(utm.wkt), utm));
  EXPECT_EQ(parseCrs(utm.wkt).authority, "EPSG:32616");
}

// Other programs give their own codes the name of EPSG. The definition counts.
TEST(Crs, CodesThatPROJDoesNotKnowAreLeftOut) {
  const std::string code = "AUTHORITY[\"EPSG\",\"102100\"]";
  const std::string wkt =
      "PROJCS[\"Mercator\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
      "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433],AUTHORITY[\"EPSG\",\"4326\"]],"
      "PROJECTION[\"Mercator_1SP\"],PARAMETER[\"central_meridian\",7],PARAMETER[\"scale_factor\",1],"
      "PARAMETER[\"false_easting\",0],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]," +
      code + "]";
  OGRSpatialReference srs;
  ASSERT_EQ(srs.importFromWkt(wkt.c_str()), OGRERR_NONE);
  for (const Crs& crs : {parseCrs(wkt), fromOgr(&srs, "'a.prj'")}) {
    EXPECT_EQ(crs.authority, "");
    EXPECT_EQ(crs.wkt.find("102100"), std::string::npos) << crs.wkt;
    EXPECT_NE(crs.wkt.find("ID[\"EPSG\",4326]"), std::string::npos) << crs.wkt;
    EXPECT_EQ(nameOf(crs), "Mercator");
    EXPECT_TRUE(sameCrs(crs, parseCrs("+proj=merc +lon_0=7 +datum=WGS84")));
    EXPECT_EQ(metresPerUnit(crs), 1.0);
  }
}

TEST(Crs, KnowsGeographicOnesAndTheirEllipsoid) {
  EXPECT_TRUE(wgs84().geographic);
  EXPECT_EQ(wgs84().authority, "EPSG:4326");
  EXPECT_EQ(wgs84().semi_major_m, 6378137.0);
  EXPECT_NEAR(1 / wgs84().flattening, 298.257223563, 1e-9);
  EXPECT_EQ(parseCrs("+proj=longlat +R=6371000").flattening, 0.0);
  EXPECT_NEAR(parseCrs("EPSG:4277").semi_major_m, 6377563.396, 1e-3);  // Airy 1830
}

TEST(Crs, DropsHeights) {
  EXPECT_EQ(parseCrs("EPSG:4979").wkt.find("ellipsoidal height"), std::string::npos);
  EXPECT_TRUE(parseCrs("EPSG:4979").geographic);
  EXPECT_FALSE(parseCrs("EPSG:32616+5773").isPlane());
  EXPECT_EQ(parseCrs("EPSG:32616+5773").wkt.find("VERTCRS"), std::string::npos);
}

TEST(Crs, PlanesHaveNoText) {
  EXPECT_TRUE(parseCrs("plane").isPlane());
  EXPECT_TRUE(parseCrs("LOCAL_CS[\"harbour grid\",UNIT[\"metre\",1]]").isPlane());
  EXPECT_EQ(nameOf(parseCrs("plane")), "plane");
}

TEST(Crs, SameMeansTheSamePlaces) {
  EXPECT_TRUE(sameCrs(wgs84(), parseCrs("OGC:CRS84")));
  EXPECT_FALSE(sameCrs(wgs84(), parseCrs("EPSG:4269")));
  EXPECT_FALSE(sameCrs(wgs84(), parseCrs("EPSG:32616")));
  EXPECT_FALSE(sameCrs(wgs84(), Crs{}));
  EXPECT_TRUE(sameCrs(Crs{}, Crs{}));
}

TEST(Crs, RefusesInOneSentenceThatNamesTheText) {
  for (const std::string text : {"EPSG:0", "no such thing", "", "EPSG:4978", "EPSG:5874", "EPSG:4807", "/etc/passwd"}) {
    try {
      parseCrs(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

TEST(Crs, HasANameForPeople) {
  EXPECT_EQ(nameOf(parseCrs("EPSG:32616")), "EPSG:32616");
  EXPECT_NE(nameOf(parseCrs("+proj=laea +lat_0=52 +lon_0=10")), "");
}

}  // namespace
}  // namespace coastmesh
