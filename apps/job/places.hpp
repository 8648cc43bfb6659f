#pragma once

#include <string>

#include "core/point.hpp"

namespace coastmesh {

// Places and numbers in the format of messages.
std::string pointText(const Point& point);              // "(-87.5, 41.25)"
std::string amount(const char* format, double number);  // as printf writes it, within 60 characters
// With so many significant digits, and no exponent up to ten millions: "95000".
std::string roundAmount(double number, int digits);

}  // namespace coastmesh
