#include "gis/model/boundary_edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"

namespace coastmesh {
namespace {

// Consecutive edges of a loop, of one kind.
struct Run {
  std::size_t first = 0;  // edge of the loop
  std::size_t count = 0;
  BoundaryKind kind;
  double length = 0.0;
};

std::vector<Run> runsOf(const std::vector<BoundaryKind>& kinds, const std::vector<double>& lengths, std::size_t begin,
                        std::size_t n) {
  std::vector<Run> runs;
  std::size_t start = 0;
  while (start < n && kinds[begin + start] == kinds[begin + (start + n - 1) % n]) ++start;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (start + k) % n;
    if (runs.empty() || kinds[begin + i] != runs.back().kind) runs.push_back({i, 0, kinds[begin + i]});
    ++runs.back().count;
    runs.back().length += lengths[begin + i];
  }
  return runs;
}

// Merges runs shorter than `least`, the shortest first, into the longer of their neighbours; returns their number. Each
// round leaves at least one run less.
std::size_t mergeShortRuns(std::vector<Run>& runs, double least) {
  std::size_t merged = 0;
  while (runs.size() > 1) {
    const auto shortest = std::ranges::min_element(runs, {}, &Run::length);
    if (!(shortest->length < least)) break;
    const std::size_t r = static_cast<std::size_t>(shortest - runs.begin()), n = runs.size();
    const std::size_t before = (r + n - 1) % n, after = (r + 1) % n;
    runs[r].kind = runs[runs[before].length >= runs[after].length ? before : after].kind;
    ++merged;
    // Adjacent runs of one kind become one.
    std::vector<Run> joined;
    for (const Run& run : runs) {
      if (!joined.empty() && joined.back().kind == run.kind) {
        joined.back().count += run.count;
        joined.back().length += run.length;
      } else {
        joined.push_back(run);
      }
    }
    if (joined.size() > 1 && joined.front().kind == joined.back().kind) {
      joined.front().first = joined.back().first;
      joined.front().count += joined.back().count;
      joined.front().length += joined.back().length;
      joined.pop_back();
    }
    runs = std::move(joined);
  }
  return merged;
}

}  // namespace

std::vector<BoundaryRules> readBoundaryFiles(const BoundaryOptions& options) {
  std::vector<BoundaryRules> rules;
  for (const std::string& file : options.files) rules.push_back(BoundaryRules::ofFile(file, options.column));
  return rules;
}

BoundaryReport defineKinds(const BoundaryPlaces& at, const BoundaryOptions& options, BoundaryEdges& boundary) {
  BoundaryReport report;
  std::vector<bool> said(boundary.edges.size(), false);
  const auto apply = [&](const BoundaryRules& rules) {
    const auto kinds = rules.kindsOf(at.crs, at.places, boundary.edges, boundary.outer, boundary.share);
    bool any = false;
    for (std::size_t e = 0; e < kinds.size(); ++e) {
      if (!kinds[e]) continue;
      boundary.kinds[e] = *kinds[e];
      said[e] = any = true;
    }
    return any;
  };
  apply(options.of_input);
  const std::vector<BoundaryRules> of_files = options.of_files ? *options.of_files : readBoundaryFiles(options);
  for (std::size_t file = 0; file < of_files.size(); ++file)
    if (!apply(of_files[file])) {
      report.idle_files.push_back(file);
      report.warnings.push_back(options.files[file] +
                                ": says nothing of the mesh's boundary: no edge of it has its middle in one of the "
                                "polygons, or runs along one of the lines within a fifth of its length (polygons "
                                "open no islands)");
    }
  report.edges_by_file = static_cast<std::size_t>(std::ranges::count(said, true));
  if (options.opensByDepth()) {
    double deepest = -std::numeric_limits<double>::infinity();
    if (at.z.empty()) throw InputError("to open boundaries by their depth takes depths; give --bathymetry");
    for (std::size_t e = 0; e < boundary.edges.size(); ++e) {
      const auto isDeep = [&](std::uint32_t place) { return 0.0 - at.z[place] > options.open_deeper_m; };
      if (!said[e] && boundary.outer[e])
        deepest = std::max(deepest, std::min(0.0 - at.z[boundary.edges[e][0]], 0.0 - at.z[boundary.edges[e][1]]));
      if (said[e] || !boundary.outer[e] || !isDeep(boundary.edges[e][0]) || !isDeep(boundary.edges[e][1])) continue;
      boundary.kinds[e] = {BoundaryRole::Open};
      ++report.edges_by_depth;
    }
    if (report.edges_by_depth == 0) {
      char text[120];
      const int length =
          std::snprintf(text, sizeof text, "--open-deeper %.6g opens no boundary", options.open_deeper_m);
      if (std::isfinite(deepest))
        std::snprintf(text + length, sizeof text - static_cast<std::size_t>(length), ": its deepest edge is at %.6g m",
                      deepest);
      report.warnings.emplace_back(text);
    }
  }
  return report;
}

std::size_t mergeShort(const BoundaryPlaces& at, double least_m, BoundaryEdges& boundary) {
  if (!(least_m > 0.0)) return 0;
  std::vector<std::vector<Point>> edges;
  for (const auto& [from, to] : boundary.edges) edges.push_back({at.places[from], at.places[to]});
  const std::vector<double> lengths = chainLengths(edges, at.crs);
  std::size_t merged = 0, begin = 0;
  for (const std::size_t end : boundary.loop_ends) {
    const std::size_t n = end - begin;
    std::vector<Run> runs = runsOf(boundary.kinds, lengths, begin, n);
    merged += mergeShortRuns(runs, least_m);
    for (const Run& run : runs)
      for (std::size_t k = 0; k < run.count; ++k) boundary.kinds[begin + (run.first + k) % n] = run.kind;
    begin = end;
  }
  return merged;
}

}  // namespace coastmesh
