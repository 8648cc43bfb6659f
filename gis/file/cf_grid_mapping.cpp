#include "gis/file/cf_grid_mapping.hpp"

#include <ogr_srs_api.h>

#include <cmath>
#include <string_view>

#include "gis/crs/ogr_support.hpp"

namespace coastmesh {
namespace {

struct Parameter {
  const char* ogr;
  const char* cf;
};

constexpr Parameter kFalseOrigin[] = {{SRS_PP_FALSE_EASTING, "false_easting"},
                                      {SRS_PP_FALSE_NORTHING, "false_northing"}};

struct Method {
  const char* ogr;
  const char* cf;
  std::vector<Parameter> parameters;  // without the false origin
};

const std::vector<Method>& methods() {
  static const std::vector<Method> known = {
      {SRS_PT_TRANSVERSE_MERCATOR,
       "transverse_mercator",
       {{SRS_PP_CENTRAL_MERIDIAN, "longitude_of_central_meridian"},
        {SRS_PP_LATITUDE_OF_ORIGIN, "latitude_of_projection_origin"},
        {SRS_PP_SCALE_FACTOR, "scale_factor_at_central_meridian"}}},
      {SRS_PT_MERCATOR_1SP,
       "mercator",
       {{SRS_PP_CENTRAL_MERIDIAN, "longitude_of_projection_origin"},
        {SRS_PP_SCALE_FACTOR, "scale_factor_at_projection_origin"}}},
      {SRS_PT_MERCATOR_2SP,
       "mercator",
       {{SRS_PP_CENTRAL_MERIDIAN, "longitude_of_projection_origin"},
        {SRS_PP_STANDARD_PARALLEL_1, "standard_parallel"}}},
      {SRS_PT_LAMBERT_AZIMUTHAL_EQUAL_AREA,
       "lambert_azimuthal_equal_area",
       {{SRS_PP_LONGITUDE_OF_CENTER, "longitude_of_projection_origin"},
        {SRS_PP_LATITUDE_OF_CENTER, "latitude_of_projection_origin"}}},
      {SRS_PT_POLAR_STEREOGRAPHIC,
       "polar_stereographic",
       {{SRS_PP_CENTRAL_MERIDIAN, "straight_vertical_longitude_from_pole"}}},  // and `addPole`
      {SRS_PT_OBLIQUE_STEREOGRAPHIC,
       "stereographic",
       {{SRS_PP_CENTRAL_MERIDIAN, "longitude_of_projection_origin"},
        {SRS_PP_LATITUDE_OF_ORIGIN, "latitude_of_projection_origin"},
        {SRS_PP_SCALE_FACTOR, "scale_factor_at_projection_origin"}}},
  };
  return known;
}

// CF has the pole, and either the scale there or the parallel that is true to scale; OGR has a latitude that is one or
// the other.
void addPole(const OGRSpatialReference& srs, CfGridMapping& mapping) {
  constexpr double kPole = 90.0;
  const double latitude = srs.GetNormProjParm(SRS_PP_LATITUDE_OF_ORIGIN, 0.0);
  mapping.parameters.emplace_back("latitude_of_projection_origin", std::copysign(kPole, latitude));
  if (std::abs(latitude) == kPole)
    mapping.parameters.emplace_back("scale_factor_at_projection_origin", srs.GetNormProjParm(SRS_PP_SCALE_FACTOR, 1.0));
  else
    mapping.parameters.emplace_back("standard_parallel", latitude);
}

}  // namespace

CfGridMapping cfGridMapping(const Crs& crs) {
  const OgrErrors caught;  // of grids of a datum shift, as in `toOgr`
  const OGRSpatialReference srs = toOgr(crs);
  CfGridMapping mapping;
  const auto add = [&](const Parameter& parameter) {
    mapping.parameters.emplace_back(parameter.cf, srs.GetNormProjParm(parameter.ogr, 0.0));
  };
  if (crs.geographic) {
    mapping.name = "latitude_longitude";
  } else {
    mapping.name = "Unknown projected";
    const char* const name = srs.GetAttrValue("PROJECTION");
    for (const Method& method : methods()) {
      if (name == nullptr || std::string_view(name) != method.ogr) continue;
      mapping.name = method.cf;
      for (const Parameter& parameter : method.parameters) add(parameter);
      if (method.ogr == std::string_view(SRS_PT_POLAR_STEREOGRAPHIC)) addPole(srs, mapping);
      // CF has these in the unit of the coordinates.
      for (const Parameter& parameter : kFalseOrigin)
        mapping.parameters.emplace_back(parameter.cf, srs.GetProjParm(parameter.ogr, 0.0));
    }
  }
  mapping.parameters.emplace_back("semi_major_axis", srs.GetSemiMajor());
  mapping.parameters.emplace_back("inverse_flattening", srs.GetInvFlattening());
  mapping.parameters.emplace_back("longitude_of_prime_meridian", srs.GetPrimeMeridian());
  return mapping;
}

}  // namespace coastmesh
