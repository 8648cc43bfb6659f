#include "gis/model/boundary_edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>

#include "gis/coast/feature_names.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"
#include "gis/places.hpp"

namespace coastmesh {
namespace {

// Consecutive edges of a loop, of one kind.
struct Run {
  std::size_t first = 0;  // edge of the loop
  std::size_t count = 0;
  BoundaryKind kind;
  double length = 0.0;
  bool held = false;  // not merged into others
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

// Merges runs shorter than `least` that are not held, the shortest first, into the longer of their neighbours; returns
// their number. Each round leaves at least one run less.
std::size_t mergeShortRuns(std::vector<Run>& runs, double least) {
  std::size_t merged = 0;
  while (runs.size() > 1) {
    const auto shortest =
        std::ranges::min_element(runs, {}, [](const Run& run) { return std::pair(run.held, run.length); });
    if (shortest->held || !(shortest->length < least)) break;
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
        joined.back().held = joined.back().held || run.held;
      } else {
        joined.push_back(run);
      }
    }
    if (joined.size() > 1 && joined.front().kind == joined.back().kind) {
      joined.front().first = joined.back().first;
      joined.front().count += joined.back().count;
      joined.front().length += joined.back().length;
      joined.front().held = joined.front().held || joined.back().held;
      joined.pop_back();
    }
    runs = std::move(joined);
  }
  return merged;
}

// Holds the longest run of each rule that asks for an opening or river: others of it may be mere scraps, as where a
// polygon reaches over a headland.
void holdAsked(const std::vector<std::uint32_t>& asked, const std::vector<std::size_t>& begins,
               const std::vector<std::size_t>& ends, std::vector<std::vector<Run>>& runs) {
  std::map<std::uint32_t, Run*> longest;  // by rule
  for (std::size_t loop = 0; loop < runs.size(); ++loop) {
    const std::size_t n = ends[loop] - begins[loop];
    for (Run& run : runs[loop]) {
      for (std::size_t k = 0; k < run.count; ++k) {
        const std::uint32_t rule = asked[begins[loop] + (run.first + k) % n];
        if (rule == kNone) continue;
        Run*& of_rule = longest.try_emplace(rule, &run).first->second;
        if (run.length > of_rule->length) of_rule = &run;
      }
    }
  }
  for (const auto& [rule, run] : longest) run->held = true;
}

// Longitudes and latitudes of a frame may be in different turns.
bool isInFrame(const Box& frame, const Point& place, bool geographic) {
  if (place.y < frame.ymin || place.y > frame.ymax) return false;
  if (!geographic) return place.x >= frame.xmin && place.x <= frame.xmax;
  constexpr double kTurn = 360.0;
  const double width = frame.xmax - frame.xmin + (frame.xmax < frame.xmin ? kTurn : 0.0);
  const double east = std::fmod(place.x - frame.xmin, kTurn);
  return (east < 0.0 ? east + kTurn : east) <= width;
}

// "feature 3 'Meghna' at (1.5, 50); and 2 more": what is missed as a whole or in part, within the mesh or its frame.
std::string listOf(const std::vector<MissedRule>& missed, bool whole) {
  constexpr std::size_t kShown = 5;
  std::string text;
  std::size_t count = 0;
  for (const MissedRule& each : missed) {
    if (!each.inside || each.whole != whole || ++count > kShown) continue;
    text += std::string(count == 1 ? "" : "; ") + "feature " + std::to_string(each.fid) +
            (each.name.empty() ? "" : " '" + each.name + "'") + " at (" + roughPlaceInWords(each.place) + ")" +
            (each.parts > 1 ? ", the longest of " + std::to_string(each.parts) + " parts" : "");
  }
  return count > kShown ? text + "; and " + std::to_string(count - kShown) + " more" : text;
}

}  // namespace

std::vector<std::string> missedWarnings(const MissedOfFile& file) {
  std::vector<std::string> warnings;
  if (file.idle) return warnings;
  if (const std::string list = listOf(file.missed, true); !list.empty())
    warnings.push_back(sourceInWords(file.file) +
                       ": these openings or rivers are not in the mesh, since no edge of its boundary runs along them "
                       "or has its middle in them: " +
                       list);
  if (const std::string list = listOf(file.missed, false); !list.empty())
    warnings.push_back(sourceInWords(file.file) +
                       ": lines of openings or rivers are farther from the mesh's boundary than half an edge, so that "
                       "it is land there: " +
                       list);
  return warnings;
}

std::vector<BoundaryRules> readBoundaryFiles(const BoundaryOptions& options) {
  std::vector<BoundaryRules> rules;
  for (const std::string& file : options.files) rules.push_back(BoundaryRules::ofFile(file, options.column));
  return rules;
}

BoundaryReport defineKinds(const BoundaryPlaces& at, const BoundaryOptions& options, BoundaryEdges& boundary,
                           const ItemLoop& loop) {
  BoundaryReport report;
  std::vector<bool> said(boundary.edges.size(), false);
  boundary.asked.assign(boundary.edges.size(), kNone);
  std::uint32_t first = 0;  // number of the first rule
  const auto apply = [&](const BoundaryRules& rules, const std::string& file) {
    if (rules.empty()) return false;
    RuledEdges ruled =
        rules.roughKindsOf(at.crs, at.places, boundary.edges, boundary.outer, boundary.share, boundary.kinds, loop);
    bool any = false;
    for (std::size_t e = 0; e < said.size(); ++e) {
      if (!ruled.kinds[e]) continue;
      boundary.kinds[e] = *ruled.kinds[e];
      boundary.asked[e] = isOpening(boundary.kinds[e]) ? first + ruled.rules[e] : kNone;
      said[e] = any = true;
    }
    first += static_cast<std::uint32_t>(rules.size());
    for (MissedRule& missed : ruled.missed) {
      const auto isIn = [&](const Point& p) {
        return options.frame && isInFrame(*options.frame, p, at.crs.geographic);
      };
      missed.inside = missed.inside || isIn(missed.place) || std::ranges::any_of(missed.corners, isIn);
    }
    if (!ruled.missed.empty()) report.missed.push_back({file, false, std::move(ruled.missed)});
    return any;
  };
  apply(options.of_input, "the input");
  const std::vector<BoundaryRules> of_files = options.of_files ? *options.of_files : readBoundaryFiles(options);
  for (std::size_t file = 0; file < of_files.size(); ++file)
    if (!apply(of_files[file], options.files[file])) {
      report.idle_files.push_back(file);
      if (!report.missed.empty() && report.missed.back().file == options.files[file]) report.missed.back().idle = true;
      report.warnings.push_back(sourceInWords(options.files[file]) +
                                ": says nothing of the mesh's boundary: no edge of it has its middle in one of the "
                                "polygons, or runs along one of the lines within half of its length (polygons "
                                "open no islands)");
    }
  report.edges_by_file = static_cast<std::size_t>(std::ranges::count(said, true));
  if (options.opensByDepth()) {
    double deepest = -std::numeric_limits<double>::infinity();
    if (at.z.empty()) throw OptionError("--open-deeper needs depths: give a raster with --bathymetry");
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
  std::vector<std::vector<Run>> runs;  // of each loop
  std::vector<std::size_t> begins;
  for (const std::size_t end : boundary.loop_ends) {
    begins.push_back(runs.empty() ? 0 : boundary.loop_ends[runs.size() - 1]);
    runs.push_back(runsOf(boundary.kinds, lengths, begins.back(), end - begins.back()));
  }
  if (!boundary.asked.empty()) holdAsked(boundary.asked, begins, boundary.loop_ends, runs);
  std::size_t merged = 0;
  for (std::size_t loop = 0; loop < runs.size(); ++loop) {
    const std::size_t begin = begins[loop], n = boundary.loop_ends[loop] - begin;
    merged += mergeShortRuns(runs[loop], least_m);
    for (const Run& run : runs[loop])
      for (std::size_t k = 0; k < run.count; ++k) boundary.kinds[begin + (run.first + k) % n] = run.kind;
  }
  return merged;
}

}  // namespace coastmesh
