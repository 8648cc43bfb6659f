// Meshes plane graphs with the core alone, one piece and one thread, and prints what came out, a line a mesh: graph and
// angle, vertices, triangles, digest. scripts/compare-builds builds it with every compiler there is.
// usage: core_digests FILE.poly…
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "core/delaunay.hpp"
#include "core/refine/refine.hpp"

namespace {

using namespace coastmesh;

// The next number of a file without comments. Throws std::runtime_error.
template <typename Number>
Number next(std::istream& in) {
  std::string word;
  if (!(in >> word)) throw std::runtime_error("the file ends too early");
  return static_cast<Number>(std::stod(word));
}

// A .poly as tests/golden/inputs.py writes it: numbered from 0, without attributes and markers.
Pslg readPlain(const std::string& path) {
  std::ifstream in(path);
  Pslg pslg;
  const auto points = next<std::size_t>(in);
  for (int skipped = 0; skipped < 3; ++skipped) next<int>(in);
  for (std::size_t i = 0; i < points; ++i) {
    next<int>(in);
    const double x = next<double>(in), y = next<double>(in);
    pslg.points.push_back({x, y});
  }
  const auto segments = next<std::size_t>(in);
  next<int>(in);
  for (std::size_t i = 0; i < segments; ++i) {
    next<int>(in);
    Segment segment;
    segment.a = next<VertexId>(in);
    segment.b = next<VertexId>(in);
    pslg.segments.push_back(segment);
  }
  const auto holes = next<std::size_t>(in);
  for (std::size_t i = 0; i < holes; ++i) {
    next<int>(in);
    const double x = next<double>(in), y = next<double>(in);
    pslg.holes.push_back({x, y});
  }
  return pslg;
}

void printMeshes(const std::string& path) {
  const Pslg pslg = readPlain(path);
  for (const int angle : {20, 30, 33, 34, 35, 36, 38, 40, 41, 42}) {
    RefineOptions options;
    options.min_angle_deg = angle;
    TriMesh mesh = constrainedDelaunay(pslg);
    refine(mesh, pslg, options);
    coarsen(mesh, pslg, options);
    std::printf("%s_%d\t%zu\t%zu\t%016" PRIx64 "\n", std::filesystem::path(path).stem().c_str(), angle,
                mesh.points.size(), mesh.triangles.size(), digestOf(mesh));
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    for (int i = 1; i < argc; ++i) printMeshes(argv[i]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
