// A mesh given where a coastline is expected is refused, whatever its format.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "apps/job/mesh_job.hpp"
#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::sampleGrid;
using testing::TemporaryFolder;

std::string written(const TemporaryFolder& folder, const std::string& name) {
  const std::string path = folder / name;
  StagedOutput output(path, gridFormatFor(path), false);
  output.write(sampleGrid(wgs84(), {-87.5, 43.1}, 0.01));
  output.commit();
  return path;
}

MeshJobResult meshed(const std::string& path, const std::vector<std::string>& layers) {
  MeshJob job;
  job.input.files = {path};
  job.input.filter.layers = layers;
  return runMeshJob(job);
}

std::string refusalOf(const std::string& path) {
  try {
    meshed(path, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "meshed";
}

TEST(MeshAsInput, IsNamedAsOne) {
  const TemporaryFolder folder;
  for (const char* name : {"mesh.14", "mesh.nc", "mesh.2dm", "mesh.slf"}) {
    const std::string path = written(folder, name);
    EXPECT_EQ(refusalOf(path), "'" + path + "': a mesh, not a coastline; convert, check, info and plot read meshes");
  }
}

TEST(MeshAsInput, LayersOfTrianglesAreReadIfTheyAreNamed) {
  const TemporaryFolder folder;
  for (const char* name : {"mesh.gpkg", "mesh.geojson", "mesh.fgb"}) {
    const std::string path = written(folder, name), layer = std::string(name) == "mesh.fgb" ? "mesh" : "triangles";
    EXPECT_EQ(refusalOf(path), "'" + path + "': layer '" + layer +
                                   "' has the triangles of a mesh, which convert, check, info and plot read; --layer " +
                                   layer + " takes each as a polygon");
    EXPECT_GT(meshed(path, {layer}).grid.triangles.size(), 0u) << name;
  }
}

// Not every file that OGR does not open is a mesh.
TEST(MeshAsInput, OtherFilesAreRefusedAsBefore) {
  const TemporaryFolder folder;
  const std::string path = folder / "cut.14";
  std::ofstream(path) << "a title\n12 ";
  EXPECT_NE(refusalOf(path).find("not a vector file"), std::string::npos);
}

}  // namespace
}  // namespace coastmesh
