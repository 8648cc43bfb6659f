#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/point.hpp"

namespace coastmesh {

// A place in the format of notes and errors: "-87.5, 41.25", and in brackets.
std::string placeInWords(const Point& place);
std::string pointText(const Point& point);

// The same with fewer digits, where some metres, or a unit of a plane, are precise enough.
std::string roughPlaceInWords(const Point& place);

// The first names of a list, and how many more there are: "north, south, and 3 more".
std::string listed(const std::vector<std::string>& names, std::size_t most);

// Numbers in the format of messages: as printf writes it, within 60 characters.
std::string amount(const char* format, double number);
// With so many significant digits, and no exponent up to ten millions: "95000".
std::string roundAmount(double number, int digits);
// A positive number with three significant digits, rounded down: what may at most be used.
std::string atMost(double number);

}  // namespace coastmesh
