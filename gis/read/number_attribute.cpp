#include "gis/read/number_attribute.hpp"

#include <cpl_conv.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <limits>

#include "gis/error.hpp"

namespace coastmesh {

std::optional<double> numberAttribute(const OGRFeature& feature, int field, double least, const std::string& what) {
  if (field < 0 || !feature.IsFieldSetAndNotNull(field)) return std::nullopt;
  double value = feature.GetFieldAsDouble(field);
  if (feature.GetFieldDefnRef(field)->GetType() == OFTString) {
    // OGR accepts a text that begins with a number: 1 for "1 km".
    const std::string text = feature.GetFieldAsString(field);
    char* end = nullptr;
    value = CPLStrtod(text.c_str(), &end);
    while (*end == ' ') ++end;
    if (text.empty() || *end != '\0') value = std::numeric_limits<double>::quiet_NaN();
  }
  if (std::isfinite(value) && value >= least) return value;
  const char* const range = least > 0.0 ? " above 0" : least == 0.0 ? " of 0 or more" : "";
  throw InputError(what + ": its attribute '" + feature.GetFieldDefnRef(field)->GetNameRef() + "' is " +
                   feature.GetFieldAsString(field) + ", not a number" + range + "; correct it, or leave it empty");
}

}  // namespace coastmesh
