#include "gis/crs/known_code.hpp"

#include <ogr_spatialref.h>

#include "gis/crs/ogr_support.hpp"

namespace coastmesh {

bool isKnownCode(const std::string& code) {
  OGRSpatialReference srs;
  const OgrErrors ignored;
  const char* const options[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
  return srs.SetFromUserInput(code.c_str(), options) == OGRERR_NONE;
}

}  // namespace coastmesh
