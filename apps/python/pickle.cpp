#include "apps/python/pickle.hpp"

#include "apps/job/bytes.hpp"

namespace coastmesh {

auto partsOf(auto& result) requires std::is_same_v<std::remove_cvref_t<decltype(result)>, MeshResult> {
  auto& [grid, report, summary, warnings, refusals, complete, node_source, triangle_source, node_mesh, triangle_mesh] =
      result;
  return std::tie(grid, report, summary, warnings, refusals, complete, node_source, triangle_source, node_mesh,
                  triangle_mesh);
}

std::string bytesOf(const MeshResult& result) {
  ByteWriter writer;
  writer.pass(std::string(COASTMESH_VERSION));
  writer.pass(result);
  return writer.take();
}

MeshResult resultOf(const std::string& bytes) {
  ByteReader reader(bytes, "the pickled mesh");
  std::string version;
  reader.pass(version);
  if (version != COASTMESH_VERSION) {
    throw InputError("the mesh was pickled by coastmesh " + version + ", this is " + COASTMESH_VERSION +
                     "; keep meshes in files instead");
  }
  MeshResult result;
  reader.pass(result);
  if (!reader.atEnd()) throw InputError("the pickled mesh is longer than it should be");
  return result;
}

}  // namespace coastmesh
