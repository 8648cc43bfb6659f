// Times of our stages and of CGAL's on the same input, in one run on one thread, and their ratios.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/format/poly_io.hpp"
#include "tests/bench/cgal_peers.hpp"
#include "tests/bench/cpu_clock.hpp"
#include "tests/bench/peak_memory.hpp"

namespace {

using namespace coastmesh;

// Seconds of one round.
struct Round {
  double triangulate = 0.0, refine = 0.0, coarsen = 0.0;
  double mesh2_triangulate = 0.0, mesh2_refine = 0.0;
  double bare_refined = 0.0, bare_final = 0.0;

  double refined() const { return triangulate + refine; }
  double all() const { return refined() + coarsen; }
  double mesh2() const { return mesh2_triangulate + mesh2_refine; }
};

// Counts, the same in every round.
struct Counts {
  std::size_t refined_vertices = 0, refined_triangles = 0, refined_violations = 0;
  std::size_t final_vertices = 0, final_triangles = 0, final_violations = 0;
  std::size_t mesh2_vertices = 0, mesh2_triangles = 0;
};

Round runRound(const Pslg& pslg, const RefineOptions& options, double mesh2_angle, Counts& counts) {
  Round round;
  TriMesh mesh;
  RefineStats stats;
  round.triangulate = cpuSecondsOf([&] { mesh = constrainedDelaunay(pslg); });
  round.refine = cpuSecondsOf([&] { stats = refine(mesh, pslg, options); });
  counts.refined_vertices = mesh.points.size();
  counts.refined_triangles = mesh.triangles.size();
  counts.refined_violations = stats.unresolved.size();
  const BulkList<Point> refined_points = mesh.points;
  round.coarsen = cpuSecondsOf([&] { stats = coarsen(mesh, pslg, options); });
  counts.final_vertices = mesh.points.size();
  counts.final_triangles = mesh.triangles.size();
  counts.final_violations = stats.unresolved.size();

  const Mesh2Result mesh2 = runMesh2(pslg, mesh2_angle);
  round.mesh2_triangulate = mesh2.triangulate_s;
  round.mesh2_refine = mesh2.refine_s;
  counts.mesh2_vertices = mesh2.vertices;
  counts.mesh2_triangles = mesh2.triangles;

  std::size_t faces = 0;
  round.bare_refined = cpuSecondsOf([&] { faces += runBareDelaunay(refined_points); });
  round.bare_final = cpuSecondsOf([&] { faces += runBareDelaunay(mesh.points); });
  if (faces == 0) throw std::logic_error("the bare triangulation has no triangles");
  return round;
}

template <typename Figure>
double median(const std::vector<Round>& rounds, const Figure& figure) {
  std::vector<double> values;
  for (const Round& r : rounds) values.push_back(figure(r));
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

struct Memory {
  std::uint64_t refine = 0, all = 0, mesh2 = 0;
};

Memory measureMemory(const Pslg& pslg, const RefineOptions& options, double mesh2_angle) {
  const auto ours = [&](bool to_the_end) {
    TriMesh mesh = constrainedDelaunay(pslg);
    refine(mesh, pslg, options);
    if (to_the_end) coarsen(mesh, pslg, options);
  };
  return {peakGrowth([&] { ours(false); }), peakGrowth([&] { ours(true); }),
          peakGrowth([&] { runMesh2(pslg, mesh2_angle); })};
}

void printMesh(const char* name, std::size_t vertices, std::size_t input, std::size_t triangles, double seconds,
               std::uint64_t bytes, const std::string& remark) {
  const double steiner = static_cast<double>(vertices - input);
  std::printf("  %-22s %9zu %9zu %10zu %9.4f %10.2f %9.1f %10.0f  %s\n", name, vertices, vertices - input, triangles,
              seconds, 1e6 * seconds / std::max(1.0, steiner), static_cast<double>(bytes) / (1 << 20),
              static_cast<double>(bytes) / static_cast<double>(triangles), remark.c_str());
}

std::string remarkAt(double angle_deg) {
  std::string text = std::to_string(angle_deg);
  text.erase(text.find_last_not_of("0.") + 1);
  return "at " + text + " degrees";
}

void printReport(const Pslg& pslg, const std::vector<Round>& rounds, const Counts& counts, const Memory& memory,
                 double mesh2_angle) {
  const auto at = [&](auto figure) { return median(rounds, figure); };
  std::printf("  %-22s %9s\n", "stage", "seconds");
  const auto stage = [&](const char* name, auto figure) { std::printf("  %-22s %9.4f\n", name, at(figure)); };
  stage("triangulate", [](const Round& r) { return r.triangulate; });
  stage("refine", [](const Round& r) { return r.refine; });
  stage("coarsen", [](const Round& r) { return r.coarsen; });
  stage("Mesh_2: triangulate", [](const Round& r) { return r.mesh2_triangulate; });
  stage("Mesh_2: refine", [](const Round& r) { return r.mesh2_refine; });
  stage("bare, as refined", [](const Round& r) { return r.bare_refined; });
  stage("bare, as coarsened", [](const Round& r) { return r.bare_final; });

  std::printf("  %-22s %9s %9s %10s %9s %10s %9s %10s\n", "mesh", "vertices", "Steiner", "triangles", "seconds",
              "us/Steiner", "peak MiB", "B/triangle");
  const std::size_t input = pslg.points.size();
  printMesh("triangulate + refine", counts.refined_vertices, input, counts.refined_triangles,
            at([](const Round& r) { return r.refined(); }), memory.refine,
            std::to_string(counts.refined_violations) + " short");
  printMesh("all, with coarsen", counts.final_vertices, input, counts.final_triangles,
            at([](const Round& r) { return r.all(); }), memory.all, std::to_string(counts.final_violations) + " short");
  printMesh("Mesh_2", counts.mesh2_vertices, input, counts.mesh2_triangles,
            at([](const Round& r) { return r.mesh2(); }), memory.mesh2, remarkAt(mesh2_angle));

  const auto ratio = [&](const char* name, auto figure) { std::printf("  %-46s %8.3f\n", name, at(figure)); };
  std::printf("  ratios\n");
  ratio("(triangulate + refine) / Mesh_2", [](const Round& r) { return r.refined() / r.mesh2(); });
  ratio("all / Mesh_2", [](const Round& r) { return r.all() / r.mesh2(); });
  ratio("(triangulate + refine) / bare, as refined", [](const Round& r) { return r.refined() / r.bare_refined; });
  ratio("all / bare, as coarsened", [](const Round& r) { return r.all() / r.bare_final; });
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  RefineOptions options{.min_angle_deg = 30.0};
  double mesh2_angle = 28.0;
  int repeat = 5;
  std::string algorithm = "relocate";
  const std::map<std::string, Algorithm> algorithms{{"circumcenter", Algorithm::Circumcenter},
                                                    {"offcenter", Algorithm::Offcenter},
                                                    {"optimal", Algorithm::Optimal},
                                                    {"relocate", Algorithm::Relocate}};
  CLI::App app("Compares our stages with CGAL's Mesh_2 and with a bare triangulation of our vertices.");
  app.add_option("FILE", files, "Triangle's .poly")->required()->check(CLI::ExistingFile);
  app.add_option("--min-angle", options.min_angle_deg, "ours, degrees")
      ->check(CLI::Range(0.0, 45.0))
      ->capture_default_str();
  app.add_option("--mesh2-angle", mesh2_angle, "Mesh_2's, degrees; it need not end far above 30")
      ->check(CLI::Range(0.0, 33.0))
      ->capture_default_str();
  app.add_option("--algorithm", algorithm, "ours")->check(CLI::IsMember(algorithms))->capture_default_str();
  app.add_option("--repeat", repeat, "rounds, each with all of it")->check(CLI::Range(1, 1000))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  options.algorithm = algorithms.at(algorithm);
  try {
    for (const std::string& file : files) {
      const Pslg pslg = readPoly(file);
      if (pslg.segments.empty())
        throw std::runtime_error("'" + file + "' has no segments: Mesh_2 finds no domain in it");
      std::printf("%s: %zu vertices, %zu segments; %s at %g degrees, median of %d rounds\n", file.c_str(),
                  pslg.points.size(), pslg.segments.size(), algorithm.c_str(), options.min_angle_deg, repeat);
      std::fflush(stdout);
      const Memory memory = measureMemory(pslg, options, mesh2_angle);
      Counts counts;
      std::vector<Round> rounds;
      for (int i = 0; i < repeat; ++i) rounds.push_back(runRound(pslg, options, mesh2_angle, counts));
      printReport(pslg, rounds, counts, memory, mesh2_angle);
    }
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
}
