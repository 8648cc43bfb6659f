#include "gis/solver/partition_grid.hpp"

#include <string>

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

}  // namespace

PartitionReport partitionGrid(Grid& grid, const PartitionOptions& options, const ItemLoop& loop) {
  PartitionReport report;
  if (options.parts == 0) return report;
  report.parts = options.parts;
  if (options.elements)
    report.elements = partition(elementGraph(grid, loop), options.parts, "triangles", loop, grid.part_of);
  if (options.nodes) report.nodes = partition(nodeGraph(grid, loop), options.parts, "nodes", loop, grid.node_part_of);
  return report;
}

}  // namespace coastmesh
