// Table 1 of Erten & Üngör (2007) for any .poly files and angles. Checks every mesh; exit code 1 if the checker finds a
// defect.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/format/poly_io.hpp"
#include "tests/bench/cpu_clock.hpp"
#include "tests/fuzz/refine_case.hpp"
#include "tests/fuzz/unexpected_defects.hpp"

namespace {

using namespace coastmesh;

void printHeader() {
  std::printf("%7s  %-16s %8s %8s %8s %8s %9s %8s %8s %8s %9s %9s %7s %9s\n", "angle", "algorithm", "I", "II", "III",
              "IV", "moved", "merged", "removed", "splits", "vertices", "Steiner", "short", "seconds");
}

// Returns the number of defects.
std::size_t printRow(const std::string& name, double angle, const Pslg& pslg, const RefineOptions& options,
                     const TriMesh& mesh, const RefineStats& stats, double seconds) {
  const auto count = [](auto n) { return static_cast<unsigned long long>(n); };
  std::printf("%7.4g  %-16s %8llu %8llu %8llu %8llu %9llu %8llu %8llu %8llu %9llu %9llu %7llu %9.4f%s\n", angle,
              name.c_str(), count(stats.by_type[0]), count(stats.by_type[1]), count(stats.by_type[2]),
              count(stats.by_type[3]), count(stats.relocations), count(stats.merges), count(stats.removals),
              count(stats.segment_splits), count(mesh.points.size()), count(mesh.points.size() - pslg.points.size()),
              count(stats.unresolved.size()), seconds, stats.budget_reached ? "  budget reached" : "");
  const std::vector<MeshDefect> defects = unexpectedDefects(mesh, pslg, options, stats.unresolved);
  for (const MeshDefect& d : defects) std::printf("         DEFECT %s\n", describe(d).c_str());
  std::fflush(stdout);
  return defects.size();
}

std::size_t runAlgorithm(const Pslg& pslg, const RefineOptions& options) {
  const std::string name(nameOf(options.algorithm));
  RefineStats stats;
  TriMesh mesh;
  double seconds = cpuSecondsOf([&] {
    mesh = constrainedDelaunay(pslg);
    stats = refine(mesh, pslg, options);
  });
  std::size_t defects = printRow(name, options.min_angle_deg, pslg, options, mesh, stats, seconds);
  if (options.algorithm != Algorithm::Relocate) return defects;
  seconds += cpuSecondsOf([&] {
    RefineStats coarsened = coarsen(mesh, pslg, options);
    stats.unresolved.clear();  // replaced by those of coarsen
    stats.add(coarsened);
  });
  return defects + printRow(name + " + coarsen", options.min_angle_deg, pslg, options, mesh, stats, seconds);
}

Algorithm algorithmNamed(const std::string& name) {
  for (const Algorithm a : {Algorithm::Circumcenter, Algorithm::Offcenter, Algorithm::Optimal, Algorithm::Relocate})
    if (name == nameOf(a)) return a;
  throw std::invalid_argument("there is no algorithm '" + name + "'");
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files, algorithms{"circumcenter", "offcenter", "optimal", "relocate"};
  std::vector<double> angles{20, 30, 33, 34, 35, 36, 38, 40, 41, 42};
  RefineOptions options;
  CLI::App app("Counts Steiner points by type for .poly files, algorithms and angles.");
  app.add_option("FILE", files, "Triangle's .poly")->required()->check(CLI::ExistingFile);
  app.add_option("--angles", angles, "smallest angles, degrees")->delimiter(',')->check(CLI::Range(0.0, 45.0));
  app.add_option("--algorithms", algorithms, "circumcenter, offcenter, optimal, relocate")->delimiter(',');
  app.add_option("--max-vertices", options.max_vertices, "stop a run there; default no bound");
  CLI11_PARSE(app, argc, argv);
  try {
    std::size_t defects = 0;
    for (const std::string& file : files) {
      const Pslg pslg = readPoly(file);
      std::printf("%s: %zu vertices, %zu segments, %zu holes\n", file.c_str(), pslg.points.size(), pslg.segments.size(),
                  pslg.holes.size());
      printHeader();
      for (const double angle : angles) {
        for (const std::string& name : algorithms) {
          options.min_angle_deg = angle;
          options.algorithm = algorithmNamed(name);
          defects += runAlgorithm(pslg, options);
        }
      }
      std::printf("\n");
    }
    return defects == 0 ? 0 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
}
