#include "gis/solver/work.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "gis/error.hpp"
#include "gis/fields/field_names.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/places.hpp"

namespace coastmesh {

std::vector<std::int32_t> wholeWeights(const std::vector<double>& work) {
  constexpr double kMean = 1000.0, kSum = 1 << 30;
  const double sum = std::accumulate(work.begin(), work.end(), 0.0);
  const double scale = std::min(kMean * static_cast<double>(work.size()), kSum) / sum;
  std::vector<std::int32_t> weights;
  for (const double one : work) weights.push_back(std::max(1, static_cast<std::int32_t>(std::lround(one * scale))));
  return weights;
}

std::vector<double> workOfNodes(const Grid& grid, const std::string& attribute) {
  const NodeField* const field = findField(grid, fullFieldName(attribute));
  if (field == nullptr) {
    std::string names;
    for (const NodeField& other : grid.node_fields)
      if (other.component == 0) names += (names.empty() ? ": " : ", ") + shortFieldName(other.name);
    throw InputError("--partition-weight " + attribute +
                     ": the mesh has no such attribute with one value for each node" +
                     (names.empty() ? names : ", but" + names));
  }
  const auto wrong =
      std::ranges::find_if(field->values, [](double value) { return !(value >= 0.0 && std::isfinite(value)); });
  if (wrong != field->values.end()) {
    const auto node = static_cast<std::size_t>(wrong - field->values.begin());
    throw InputError("--partition-weight " + attribute + ": it is " + (std::isfinite(*wrong) ? "negative" : "unknown") +
                     " at node " + std::to_string(node + 1) + " at " + pointText(grid.nodes[node]));
  }
  if (std::ranges::all_of(field->values, [](double value) { return value == 0.0; }))
    throw InputError("--partition-weight " + attribute + ": it is 0 at every node");
  return field->values;
}

std::vector<double> workOfElements(const Grid& grid, const Elements& elements, const std::string& attribute) {
  const std::vector<double> of_nodes = workOfNodes(grid, attribute);
  std::vector<double> work;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Elements::Nodes nodes = elements.nodesOf(e);
    double sum = 0.0;
    for (const std::uint32_t node : nodes) sum += of_nodes[node];
    work.push_back(sum / static_cast<double>(nodes.count));
  }
  return work;
}

}  // namespace coastmesh
