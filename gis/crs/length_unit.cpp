#include "gis/crs/length_unit.hpp"

#include <algorithm>
#include <cctype>
#include <string>

namespace coastmesh {

namespace {

struct Unit {
  double metres;
  std::string_view names;  // between bars, in lower case, with single blanks
};

// Names of UDUNITS, EPSG, GDAL's drivers and GMT.
constexpr Unit kUnits[] = {
    {1.0, "||1|-|none|unknown|unspecified|n/a|z|user_z_unit|"},
    {1.0, "|m|m.|mt|mtr|mtrs|masl|meter|meters|metre|metres|meter(s)|metre(s)|"},
    {1000.0, "|km|kilometer|kilometers|kilometre|kilometres|"},
    {0.1, "|dm|decimeter|decimeters|decimetre|decimetres|"},
    {0.01, "|cm|centimeter|centimeters|centimetre|centimetres|"},
    {0.001, "|mm|millimeter|millimeters|millimetre|millimetres|"},
    {0.3048, "|ft|foot|feet|international foot|international feet|international_foot|international_feet|foot (intl)|"},
    {1200.0 / 3937.0,
     "|us-ft|us_ft|usft|ftus|us survey foot|us survey feet|u.s. survey foot|u.s. survey feet|us_survey_foot|"
     "us_survey_feet|survey foot|survey feet|foot_us|us foot|us feet|foot (us survey)|us survey foot (ftus)|"},
    {1.8288, "|fathom|fathoms|fth|ftm|fath|"},
};

std::string inPlainLetters(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isspace(byte) == 0)
      plain += static_cast<char>(std::tolower(byte));
    else if (!plain.empty() && plain.back() != ' ')
      plain += ' ';
  }
  if (!plain.empty() && plain.back() == ' ') plain.pop_back();
  return plain;
}

std::optional<double> metresIn(std::string_view plain) {
  if (plain.find('|') != std::string_view::npos) return std::nullopt;
  const std::string entry = "|" + std::string(plain) + "|";
  for (const Unit& unit : kUnits)
    if (unit.names.find(entry) != std::string_view::npos) return unit.metres;
  return std::nullopt;
}

// True if `rest`, the text after a unit, names a datum or a direction, unlike the "s-1" of "m s-1".
bool saysFromWhere(std::string_view rest) {
  constexpr std::string_view kBeginnings[] = {"above", "below",  "over", "under", "relative", "positive", "depth",
                                              "deep",  "height", "down", "up",    "asl",      "bsl",      "msl",
                                              "lat",   "mllw",   "mlw",  "mhw",   "mhhw",     "navd",     "ngvd",
                                              "nap",   "nhn",    "ahd",  "igld",  "egm",      "chart"};
  if (rest.starts_with('(')) rest.remove_prefix(1);
  return std::ranges::any_of(kBeginnings, [&](std::string_view word) { return rest.starts_with(word); });
}

}  // namespace

std::optional<double> metresInUnit(std::string_view name) {
  std::string plain = inPlainLetters(name);
  if (plain.size() > 2 &&
      ((plain.front() == '[' && plain.back() == ']') || (plain.front() == '(' && plain.back() == ')')))
    plain = plain.substr(1, plain.size() - 2);
  if (const auto whole = metresIn(plain)) return whole;
  for (std::size_t blank = plain.find(' '); blank != std::string::npos; blank = plain.find(' ', blank + 1)) {
    std::string_view unit = std::string_view(plain).substr(0, blank);
    if (unit.ends_with(',')) unit.remove_suffix(1);
    if (saysFromWhere(std::string_view(plain).substr(blank + 1)))
      if (const auto metres = metresIn(unit)) return metres;
  }
  return std::nullopt;
}

}  // namespace coastmesh
