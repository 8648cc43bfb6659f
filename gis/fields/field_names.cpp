#include "gis/fields/field_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

#include "gis/lower_case.hpp"

namespace coastmesh {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// The names, and what units ADCIRC expects, are those of its user's manual on fort.13.
constexpr std::array<FieldName, 21> kFields{{
    {"mannings_n_at_sea_floor", "manning", "s/m^(1/3)", "Manning's n at the sea floor", "", kNone},
    {"quadratic_friction_coefficient_at_sea_floor", "drag", "1", "quadratic friction coefficient at the sea floor", "",
     kNone},
    {"chezy_friction_coefficient_at_sea_floor", "chezy", "m^(1/2)/s", "Chezy coefficient at the sea floor", "", kNone},
    {"bottom_roughness_length", "rough", "m", "roughness length of the sea floor", "", kNone},
    {"friction", "", "", "friction coefficient of the bed", "", kNone},
    {"primitive_weighting_in_continuity_equation", "tau0", "1",
     "weight of the primitive form in the wave continuity equation", "", kNone},
    {"surface_submergence_state", "", "1", "1 where the model starts dry below the geoid", "", 0.0, true},
    {"surface_directional_effective_roughness_length", "", "m", "roughness length of the land upwind", "", 0.0},
    {"surface_canopy_coefficient", "canopy", "1", "0 where a canopy keeps the wind off the water, else 1", "", 1.0},
    {"sea_surface_height_above_geoid", "geoid", "m", "sea surface height above the geoid",
     "sea_surface_height_above_geoid", 0.0},
    {"wave_refraction_in_swan", "", "1", "1 where SWAN computes refraction", "", 1.0, true},
    {"average_horizontal_eddy_viscosity_in_sea_water_wrt_depth", "eddy_viscosity", "m2 s-1",
     "horizontal eddy viscosity", "", kNone},
    {"average_horizontal_eddy_diffusivity_in_sea_water_wrt_depth", "eddy_diffusivity", "m2 s-1",
     "horizontal eddy diffusivity", "", kNone},
    {"elemental_slope_limiter", "slope_limiter", "1", "slope of the water above which it is limited", "", kNone},
    {"advection_state", "", "m", "depth below which advection is left out", "", kNone},
    {"initial_river_elevation", "", "m", "elevation of rivers at the start", "", kNone},
    {"internal_tide_friction", "", "s-1", "friction of internal tides", "", 0.0},
    {"bridge_pilings_friction_parameters", "", "", "friction of bridge pilings", "", 0.0},
    // Of FVCOM.
    {"sponge_radius", "", "m", "radius of the sponge at an open boundary", "", 0.0},
    {"sponge_coefficient", "", "s2 m-2", "damping of the sponge at an open boundary", "", 0.0},
    // Of coastmesh: see plain_field.hpp.
    {"flood_plain", "", "1", "1 on the land of a flood plain", "", 0.0, true},
}};

constexpr std::string_view kFriction = "friction";
constexpr std::string_view kTelemacFriction = "BOTTOM FRICTION";

// The four laws of friction that TELEMAC, ADCIRC and SCHISM share, and a coefficient of any.
constexpr std::array<std::string_view, 5> kFrictions{
    "mannings_n_at_sea_floor", "quadratic_friction_coefficient_at_sea_floor", "chezy_friction_coefficient_at_sea_floor",
    "bottom_roughness_length", "friction"};

bool isNameCharacter(unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_'); }

}  // namespace

const FieldName* findFieldName(std::string_view name) {
  const auto found = std::ranges::find_if(
      kFields, [name](const FieldName& field) { return field.name == name || (field.alias == name && !name.empty()); });
  return found == kFields.end() ? nullptr : &*found;
}

bool isState(std::string_view name) {
  const FieldName* const known = findFieldName(name);
  return known != nullptr && known->is_state;
}

std::string fullFieldName(const std::string& name) {
  const FieldName* const known = findFieldName(name);
  return known != nullptr ? std::string(known->name) : name;
}

std::string shortFieldName(const std::string& name) {
  const FieldName* const known = findFieldName(name);
  return asWord(known != nullptr && !known->alias.empty() ? std::string(known->alias) : name);
}

std::string asWord(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return !isNameCharacter(c); }, '_');
  return name;
}

std::string telemacWord(std::string word) {
  constexpr std::size_t kLongest = 16;
  word = upperCase(word).substr(0, kLongest);
  std::ranges::replace(word, '_', ' ');
  return word.substr(0, word.find_last_not_of(' ') + 1);
}

std::string telemacFieldName(const std::string& name) {
  if (std::ranges::find(kFrictions, fullFieldName(name)) != kFrictions.end()) return std::string(kTelemacFriction);
  return telemacWord(shortFieldName(name));
}

std::string fieldOfTelemac(const std::string& variable, const std::string& unit) {
  const auto isIt = [&](const FieldName& field) {
    if (telemacFieldName(std::string(field.name)) != variable) return false;
    return variable != kTelemacFriction || field.name == kFriction || (field.unit == unit && !unit.empty());
  };
  const auto found = std::ranges::find_if(kFields, isIt);
  return found == kFields.end() ? std::string() : std::string(found->name);
}

std::string wrongFieldName(const std::string& name) {
  constexpr std::size_t kLongest = 80;  // in a fort.13
  constexpr std::array<std::string_view, 11> kTaken{"x",    "y",     "z",      "id",    "fid",  "geom",
                                                    "size", "depth", "bottom", "hgrid", "vgrid"};
  const bool is_word = !name.empty() && name.size() <= kLongest &&
                       std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
                       std::ranges::all_of(name, isNameCharacter);
  if (!is_word) return "is not made of letters, digits and underscores, beginning with a letter, 80 at most";
  if (std::ranges::find(kTaken, lowerCase(name)) == kTaken.end()) return {};
  return "is a name that files of meshes have for something else; depths are given by --bathymetry";
}

}  // namespace coastmesh
