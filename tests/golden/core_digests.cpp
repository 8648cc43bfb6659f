// Meshes plane graphs with the core alone, in one piece and on one thread, and prints a line per mesh: graph and angle
// (or rule for sizes), vertices, triangles, digest. scripts/compare-builds builds it with every installed compiler.
// usage: core_digests FILE.poly…
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/lattice/lattice.hpp"
#include "core/lattice/lattice_core.hpp"
#include "core/metric.hpp"
#include "core/optimise/optimise.hpp"
#include "core/refine/refine.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/triangulate/delaunay.hpp"

namespace {

using namespace coastmesh;

// The next number of a file without comments. Throws std::runtime_error if there is none.
template <typename Number>
Number next(std::istream& in) {
  std::string word;
  if (!(in >> word)) throw std::runtime_error("the file ends too early");
  return static_cast<Number>(std::stod(word));
}

// Reads a .poly as tests/golden/inputs.py writes it: numbered from 0, without attributes and markers.
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

void print(const std::string& path, const std::string& how, const TriMesh& mesh) {
  std::printf("%s_%s\t%zu\t%zu\t%016" PRIx64 "\n", std::filesystem::path(path).stem().c_str(), how.c_str(),
              mesh.points.size(), mesh.triangles.size(), digestOf(mesh));
}

// Lengths that grow with the distance from a point.
class GrowingSize final : public SizeFunction {
 public:
  GrowingSize(const Point& from, double least, double rate, double most)
      : from_(from), least_(least), rate_(rate), most_(most) {}

  double at(const Point& x) const override { return std::min(most_, least_ + rate_ * distance(x, from_)); }
  double least() const override { return least_; }
  double most() const override { return most_; }

 private:
  Point from_;
  double least_, rate_, most_;
};

// Meshes by lattices, refinement, coarsening and the optimiser.
TriMesh sizedMesh(const Pslg& pslg, const SizeFunction& size) {
  RefineOptions options;
  options.size = &size;
  TriMesh mesh = constrainedDelaunay(pslg);
  VertexNotes notes = noteInput(mesh, boundOf(options));
  LatticeWishes wishes;
  wishes.size = &size;
  wishes.min_angle_deg = options.min_angle_deg;
  wishes.most_places = 1'000'000;
  if (std::vector<LatticePlaces> lattices = layLattices(mesh, wishes); !lattices.empty()) {
    mesh = triangulateWith(pslg, std::move(lattices), false).mesh;
    noteFurther(mesh, notes);
  }
  refine(mesh, pslg, options, std::move(notes));
  coarsen(mesh, pslg, options);
  optimise(mesh, pslg, options, kOptimiseSweeps);
  return mesh;
}

void printSizedMeshes(const std::string& path) {
  const Pslg pslg = readPlain(path);
  Point low = pslg.points.front(), high = low;
  for (const Point& p : pslg.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  print(path, "even", sizedMesh(pslg, ConstantSize(side / 40)));
  print(path, "growing", sizedMesh(pslg, GrowingSize(low, side / 200, 0.1, side / 10)));
}

void printMeshes(const std::string& path) {
  const Pslg pslg = readPlain(path);
  for (const int angle : {20, 30, 33, 34, 35, 36, 38, 40, 41, 42}) {
    RefineOptions options;
    options.min_angle_deg = angle;
    TriMesh mesh = constrainedDelaunay(pslg);
    refine(mesh, pslg, options);
    coarsen(mesh, pslg, options);
    print(path, std::to_string(angle), mesh);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    for (int i = 1; i < argc; ++i) {
      printMeshes(argv[i]);
      printSizedMeshes(argv[i]);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
