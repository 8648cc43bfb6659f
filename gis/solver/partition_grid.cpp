#include "gis/solver/partition_grid.hpp"

#include <string>

#include "gis/elements/elements.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/solver/mesh_graph.hpp"

namespace coastmesh {
namespace {

PartitionFigures partition(const MeshGraph& graph, std::uint32_t parts, const char* what, const ItemLoop& loop,
                           std::vector<std::uint32_t>& part_of) {
  if (graph.size() < parts)
    throw InputError("the mesh has " + std::to_string(graph.size()) + ' ' + what + ", too few for " +
                     std::to_string(parts) + " parts: ask for fewer");
  part_of = partitionGraph(graph, parts, loop);
  return figuresOf(graph, part_of, parts);
}

// Both halves of a quadrilateral get its part.
PartitionFigures partitionElements(Grid& grid, std::uint32_t parts, const ItemLoop& loop) {
  const Elements elements(grid);
  std::vector<std::uint32_t> part_of;
  const PartitionFigures figures =
      partition(elementGraph(grid, loop), parts, elements.quads() == 0 ? "triangles" : "elements", loop, part_of);
  grid.part_of.resize(grid.triangles.size());
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) grid.part_of[t] = part_of[elements.elementOf(t)];
  return figures;
}

}  // namespace

PartitionReport partitionGrid(Grid& grid, const PartitionOptions& options, const ItemLoop& loop) {
  PartitionReport report;
  if (options.parts == 0) return report;
  report.parts = options.parts;
  if (options.elements) report.elements = partitionElements(grid, options.parts, loop);
  report.mixed = !quadsOf(grid).empty();
  if (options.nodes) report.nodes = partition(nodeGraph(grid, loop), options.parts, "nodes", loop, grid.node_part_of);
  return report;
}

}  // namespace coastmesh
