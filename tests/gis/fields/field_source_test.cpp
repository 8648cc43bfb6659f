// Texts that say where attributes come from, and names of attributes in models.
#include "gis/fields/field_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gis/fields/field_names.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

FieldSource sourceOf(const std::string& text) {
  std::vector<FieldSource> sources;
  EXPECT_EQ(addFieldSource(text, sources), "") << text;
  EXPECT_THAT(sources, SizeIs(1)) << text;
  return sources.empty() ? FieldSource{} : sources.front();
}

TEST(FieldSourceTest, WhatCanBeReadAsANumberIsOne) {
  for (const auto& [text, number] : {std::pair{"0.02", 0.02}, {"-1", -1.0}, {"+3", 3.0}, {"1e-3", 0.001}}) {
    const FieldSource source = sourceOf(std::string("manning=") + text);
    EXPECT_EQ(source.name, "mannings_n_at_sea_floor");
    EXPECT_EQ(source.number, number);
    EXPECT_EQ(source.file + source.table, "");
  }
}

TEST(FieldSourceTest, AFileWithTheNameOfANumberHasItsFolder) {
  const FieldSource source = sourceOf("canopy=./0.02");
  EXPECT_EQ(source.name, "surface_canopy_coefficient");
  EXPECT_FALSE(source.number);
  EXPECT_EQ(source.file, "./0.02");
  EXPECT_EQ(sourceOf("canopy=nan").file, "nan");
}

TEST(FieldSourceTest, OnlyATableFollowsAComma) {
  EXPECT_EQ(sourceOf("albedo=a.tif").table, "");
  EXPECT_EQ(sourceOf("albedo=a,b.tif").file, "a,b.tif");
  const FieldSource source = sourceOf("albedo=NETCDF:\"a.nc\":b,c=d,land cover.CSV");
  EXPECT_EQ(source.name, "albedo");
  EXPECT_EQ(source.file, "NETCDF:\"a.nc\":b,c=d");
  EXPECT_EQ(source.table, "land cover.CSV");
  EXPECT_THAT(filesOfFieldSource("albedo=a.tif,b.csv"), ElementsAre("a.tif", "b.csv"));
  EXPECT_THAT(filesOfFieldSource("albedo=a.tif"), ElementsAre("a.tif"));
  EXPECT_THAT(filesOfFieldSource("albedo=7"), IsEmpty());
}

TEST(FieldSourceTest, OtherTextsAreRejected) {
  std::vector<FieldSource> sources;
  for (const char* const text : {"manning", "=0.02", "manning=", ""})
    EXPECT_THAT(addFieldSource(text, sources), HasSubstr("is not NAME=FILE")) << text;
  for (const char* const text : {"2d=1", "a b=1", "a/b=1", "\xC3\xA9=1"})
    EXPECT_THAT(addFieldSource(text, sources), HasSubstr("letters, digits and underscores")) << text;
  for (const char* const text : {"depth=1", "Z=1", "hgrid=a.tif"})
    EXPECT_THAT(addFieldSource(text, sources), HasSubstr("something else")) << text;
  EXPECT_THAT(addFieldSource("manning=,t.csv", sources), HasSubstr("no raster of classes"));
  EXPECT_THAT(sources, IsEmpty());
  EXPECT_EQ(addFieldSource("manning=0.02", sources), "");
  EXPECT_EQ(addFieldSource("drag=0.02", sources), "");
  EXPECT_EQ(addFieldSource("manning=a.tif", sources), "");
  EXPECT_EQ(addFieldSource("mannings_n_at_sea_floor=0.03", sources), "gives mannings_n_at_sea_floor a second number");
  EXPECT_THAT(sources, SizeIs(3));
}

TEST(FieldNamesTest, OfModels) {
  EXPECT_EQ(fullFieldName("drag"), "quadratic_friction_coefficient_at_sea_floor");
  EXPECT_EQ(fullFieldName("albedo"), "albedo");
  EXPECT_EQ(shortFieldName("mannings_n_at_sea_floor"), "manning");
  EXPECT_EQ(shortFieldName("a b/c"), "a_b_c");
  EXPECT_EQ(telemacFieldName("mannings_n_at_sea_floor"), "BOTTOM FRICTION");
  EXPECT_EQ(telemacFieldName("rough"), "BOTTOM FRICTION");
  EXPECT_EQ(telemacFieldName("wave_refraction_in_swan"), "WAVE REFRACTION");
}

TEST(FieldNamesTest, FrictionOfTelemacHasTheLawOfItsUnit) {
  EXPECT_EQ(fieldOfTelemac("BOTTOM FRICTION", "s/m^(1/3)"), "mannings_n_at_sea_floor");
  EXPECT_EQ(fieldOfTelemac("BOTTOM FRICTION", "m"), "bottom_roughness_length");
  EXPECT_EQ(fieldOfTelemac("BOTTOM FRICTION", ""), "friction");
  EXPECT_EQ(fieldOfTelemac("CANOPY", "1"), "surface_canopy_coefficient");
  EXPECT_EQ(fieldOfTelemac("VELOCITY U", "M/S"), "");
  EXPECT_EQ(fieldOfTelemac("BOTTOM", "M"), "");
}

}  // namespace
}  // namespace coastmesh
