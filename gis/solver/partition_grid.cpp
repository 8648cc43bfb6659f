#include "gis/solver/partition_grid.hpp"

#include <string>

#include "gis/elements/elements.hpp"
#include "gis/error.hpp"
#include "gis/solver/mesh_graph.hpp"
#include "gis/solver/work.hpp"

namespace coastmesh {
namespace {

PartitionFigures partition(const MeshGraph& graph, const PartitionOptions& options, const char* what,
                           const ItemLoop& loop, std::vector<std::uint32_t>& part_of) {
  const std::uint32_t parts = options.parts;
  if (graph.size() < parts)
    throw InputError("the mesh has " + std::to_string(graph.size()) + ' ' + what + ", too few for " +
                     std::to_string(parts) + " parts: ask for fewer");
  part_of = partitionGraph(graph, parts, loop);
  return figuresOf(graph, part_of, parts);
}

MeshGraph elementsWithWork(const Grid& grid, const Elements& elements, const PartitionOptions& options,
                           const ItemLoop& loop) {
  MeshGraph graph = elementGraph(grid, loop);
  if (options.levels)
    graph.weights = wholeWeights(layersOfElements(grid, elements, *options.levels));
  else if (!options.attribute.empty())
    graph.weights = wholeWeights(workOfElements(grid, elements, options.attribute));
  return graph;
}

MeshGraph nodesWithWork(const Grid& grid, const Elements& elements, const PartitionOptions& options,
                        const ItemLoop& loop) {
  MeshGraph graph = nodeGraph(grid, loop);
  if (options.levels)
    graph.weights = wholeWeights(layersOfNodes(grid, elements, *options.levels));
  else if (!options.attribute.empty())
    graph.weights = wholeWeights(workOfNodes(grid, options.attribute));
  return graph;
}

// Both halves of a quadrilateral get its part.
PartitionFigures partitionElements(Grid& grid, const Elements& elements, const PartitionOptions& options,
                                   const ItemLoop& loop) {
  std::vector<std::uint32_t> part_of;
  const PartitionFigures figures = partition(elementsWithWork(grid, elements, options, loop), options,
                                             elements.quads() == 0 ? "triangles" : "elements", loop, part_of);
  grid.part_of.resize(grid.triangles.size());
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) grid.part_of[t] = part_of[elements.elementOf(t)];
  return figures;
}

std::string weightOf(const PartitionOptions& options) {
  if (options.levels) return "layers";
  return options.attribute.empty() ? "even" : options.attribute;
}

}  // namespace

PartitionReport partitionGrid(Grid& grid, const PartitionOptions& options, const ItemLoop& loop) {
  PartitionReport report;
  if (options.parts == 0) return report;
  report.parts = options.parts;
  report.weight = weightOf(options);
  const Elements elements(grid);
  report.mixed = elements.quads() > 0;
  if (options.elements) report.elements = partitionElements(grid, elements, options, loop);
  if (options.nodes)
    report.nodes = partition(nodesWithWork(grid, elements, options, loop), options, "nodes", loop, grid.node_part_of);
  return report;
}

}  // namespace coastmesh
