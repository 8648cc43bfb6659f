#include "gis/fields/plain_field.hpp"

#include <string>

#include "gis/fields/field_names.hpp"
#include "gis/fields/node_fields.hpp"

namespace coastmesh {

bool hasPlain(const Grid& grid) { return findField(grid, std::string(kFloodPlain)) != nullptr; }

std::vector<std::uint8_t> landNodes(const Grid& grid) {
  constexpr double kNearer = 0.5;  // edits interpolate before values are rounded to states
  const NodeField* field = findField(grid, std::string(kFloodPlain));
  if (field == nullptr) field = findField(grid, "surface_submergence_state");
  std::vector<std::uint8_t> land;
  if (field == nullptr) return land;
  land.reserve(field->values.size());
  for (const double value : field->values) land.push_back(value >= kNearer ? 1 : 0);
  return land;
}

void markPlain(Grid& grid, const std::vector<std::uint8_t>& land) {
  const std::string name(kFloodPlain);
  NodeField* field = findField(grid, name);
  if (field == nullptr) {
    const FieldName& known = *findFieldName(name);
    field = &grid.node_fields.emplace_back(NodeField{name, std::string(known.unit), 0, known.usual, {}});
  }
  field->values.assign(land.begin(), land.end());
}

}  // namespace coastmesh
