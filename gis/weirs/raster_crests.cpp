#include "gis/weirs/raster_crests.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/places.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/rounded_depth.hpp"
#include "gis/sample/sample_raster.hpp"
#include "gis/weirs/crest_transects.hpp"

namespace coastmesh {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Terrain across a line.
struct Transect {
  std::size_t edge = 0;
  unsigned half = 0;  // of the edge, from its first node
  std::array<Point, 2> ends{};
};

// The crest along half of an edge.
struct HalfCrest {
  std::size_t known = 0, unknown = 0;  // transects
  std::size_t rising = 0;              // of those known: the highest terrain is at one of their ends
  double lowest = std::numeric_limits<double>::infinity(), sum = 0.0;
  Point lowest_at, unknown_at;  // the first of them

  double drop() const { return known > 0 ? sum / static_cast<double>(known) - lowest : 0.0; }
};

class CrestSearch {
 public:
  CrestSearch(const Grid& grid, const std::vector<WeirSource>& sources, const CrestRasters& options,
              const RunControl& control, const ItemLoop& loop)
      : grid_(grid), options_(options), control_(control), loop_(loop) {
    for (const GridLine& line : grid.lines) {
      const WeirSource* const source = line.kind == LineKind::Weir ? sourceOf(grid, line, sources) : nullptr;
      if (source == nullptr) continue;
      if (source->crest.height_m) {
        ++of_their_own_;
        continue;
      }
      for (const NodePair& edge : edgesOf(line)) pairs_.emplace_back(edge, source);
      lines_.push_back({&line, pairs_.size()});
    }
  }

  RasterCrests run() {
    RasterCrests crests;
    crests.searched = true;
    if (pairs_.empty()) {
      if (of_their_own_ > 0)
        crests.warnings.emplace_back("--weir-heights has no effect: every weir in the mesh has a height of its own");
      return crests;
    }
    openRasters(crests.warnings);
    edges_ = crestEdges(grid_, pairs_, rasters_, options_.search_m, loop_);
    halves_.resize(2 * edges_.size());
    std::vector<Transect> batch;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto all = transectsOf(grid_, edges_[e], options_.search_m);
      for (std::size_t k = 0; k < all.size(); ++k) {
        batch.push_back({e, 2 * k < all.size() ? 0u : 1u, all[k]});
        places_ += edges_[e].places(options_.search_m);
        if (places_ >= kBatch) takeBatch(batch);
      }
    }
    takeBatch(batch);
    collect(crests);
    return crests;
  }

 private:
  static constexpr std::size_t kBatch = 1 << 19;  // places of transects that are read at a time

  void openRasters(std::vector<std::string>& warnings) {
    for (const std::string& file : options_.files) {
      const RasterBand& raster = rasters_.emplace_back(file);
      raster.requireEvenFiles();
      if (raster.crs().isPlane() && !grid_.crs.isPlane())
        warnings.push_back("'" + raster.path() + "' has no CRS; taken to be in that of the mesh, " + nameOf(grid_.crs));
    }
  }

  // Reads the terrain along transects, which are then done with.
  void takeBatch(std::vector<Transect>& batch) {
    if (control_.cancelled && control_.cancelled()) throw Cancelled();
    std::vector<Point> places;
    std::vector<std::size_t> edge_of;
    for (const Transect& transect : batch) {
      const std::uint32_t count = edges_[transect.edge].places(options_.search_m);
      for (std::uint32_t k = 0; k < count; ++k) {
        const double share = count > 1 ? static_cast<double>(k) / (count - 1) : 0.5;
        places.push_back(placeBetween(grid_.crs, transect.ends[0], transect.ends[1], share));
        edge_of.push_back(transect.edge);
      }
    }
    const std::vector<double> heights = heightsAt(places, edge_of);
    std::size_t at = 0;
    for (const Transect& transect : batch) {
      const std::uint32_t count = edges_[transect.edge].places(options_.search_m);
      addTo(halves_[2 * transect.edge + transect.half], transect, std::span(heights).subspan(at, count));
      at += count;
    }
    batch.clear();
    places_ = 0;
  }

  // Of the first raster with a value at each place, NaN if there is none.
  std::vector<double> heightsAt(const std::vector<Point>& places, const std::vector<std::size_t>& edge_of) const {
    std::vector<double> heights(places.size(), kUnknown);
    for (std::size_t r = 0; r < rasters_.size(); ++r) {
      std::vector<std::uint32_t> which;
      std::vector<Point> open;
      for (std::uint32_t i = 0; i < places.size(); ++i) {
        if (!std::isnan(heights[i]) || !edges_[edge_of[i]].rasters[r]) continue;
        which.push_back(i);
        open.push_back(places[i]);
      }
      if (which.empty()) continue;
      const std::vector<Point> pixels = pixelsOf(grid_.crs, open, rasters_[r], loop_);
      std::vector<std::uint32_t> all(open.size());
      std::iota(all.begin(), all.end(), 0u);
      const std::vector<RasterSample> samples = sampleHighest(rasters_[r], pixels, all, loop_, control_);
      for (std::size_t k = 0; k < which.size(); ++k) {
        if (!(samples[k].share > 0.0)) continue;
        requireTerrain(samples[k].value, rasters_[r], open[k]);
        heights[which[k]] = samples[k].value - options_.zero_m;
      }
    }
    return heights;
  }

  // A number that means no value would be the highest terrain, or a gap.
  static void requireTerrain(double height, const RasterBand& raster, const Point& place) {
    constexpr double kHighest = 9000.0;  // metres: higher than any mountain
    if (std::abs(height) <= kHighest) return;
    throw InputError("'" + raster.path() + "' has a height of " + amount("%g", height) + " m at a weir, near " +
                     pointText(place) + ": if it means no value, the raster has to say so (gdal_translate -a_nodata " +
                     amount("%.10g", height) + ")");
  }

  void addTo(HalfCrest& half, const Transect& transect, std::span<const double> heights) const {
    const Point middle = placeBetween(grid_.crs, transect.ends[0], transect.ends[1], 0.5);
    const auto highestOf = [](std::span<const double> some) {
      double highest = -std::numeric_limits<double>::infinity();
      for (const double height : some)
        if (height > highest) highest = height;
      return highest;
    };
    const double crest = highestOf(heights);
    if (std::isinf(crest)) {
      if (half.unknown++ == 0) half.unknown_at = middle;
      return;
    }
    ++half.known;
    half.sum += crest;
    if (crest < half.lowest) {
      half.lowest = crest;
      half.lowest_at = middle;
    }
    constexpr std::size_t kEnd = 2;  // places: pixels around neighbours are partly the same
    if (heights.size() > 2 * kEnd + 2)
      half.rising += crest > highestOf(heights.subspan(kEnd, heights.size() - 2 * kEnd)) ? 1 : 0;
  }

  void collect(RasterCrests& crests) const {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const HalfCrest &first = halves_[2 * e], &second = halves_[2 * e + 1];
      if (first.known == 0 || second.known == 0) continue;
      const auto [a, b] = edges_[e].nodes;
      std::array<double, 2> lowest{roundedDepth(first.lowest), roundedDepth(second.lowest)};
      if (b < a) std::swap(lowest[0], lowest[1]);
      crests.of_edges[edgeKey(a, b)] = lowest;
    }
    warnOfUnknown(crests);
    warnOfDrops(crests.warnings);
    warnOfRising(crests.warnings);
    addNote(crests);
  }

  std::string withinSearch() const { return amount(" within %g m", options_.search_m); }

  void warnOfUnknown(RasterCrests& crests) const {
    std::size_t partly = 0;
    Point place;
    std::string of;
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      std::size_t lost = 0;
      std::optional<Point> first;
      for (std::size_t e = beginOf(l); e < lines_[l].end; ++e) {
        const bool is_known = crests.of_edges.contains(edgeKey(edges_[e].nodes[0], edges_[e].nodes[1]));
        for (const HalfCrest& half : {halves_[2 * e], halves_[2 * e + 1]}) {
          if (half.unknown == 0) continue;
          if (!is_known && !first) first = half.unknown_at;
          if (is_known && partly == 0) std::tie(place, of) = std::pair(half.unknown_at, edges_[e].source->feature);
          partly += is_known ? half.unknown : 0;
        }
        lost += is_known ? 0 : 1;
      }
      if (lost == 0) continue;
      const std::size_t edges = lines_[l].end - beginOf(l);
      crests.warnings.push_back(
          lineInWords(grid_, *lines_[l].line, edges_[beginOf(l)].source) + " stays edges of the mesh" +
          (lost == edges ? "" : " along " + std::to_string(lost) + " of its " + std::to_string(edges)) + ", at " +
          pointText(*first) + ": no raster of --weir-heights has a value" + withinSearch() +
          " of it there; give another raster that covers it, or heights as an attribute '" + kWeirHeight + "'");
    }
    if (partly > 0)
      crests.warnings.push_back("no raster of --weir-heights has a value" + withinSearch() + " of weirs at " +
                                std::to_string(partly) + forCount(partly, " place", " places") +
                                " along them, the first of " + of + " at " + pointText(place) +
                                ": pairs of nodes there have the crest beside");
  }

  // Places that are far lower than the crest around: gaps in a levee, or in its raster.
  void warnOfDrops(std::vector<std::string>& warnings) const {
    constexpr double kFar = 1.0;  // metres
    std::size_t count = 0, deepest = 0;
    for (std::size_t h = 0; h < halves_.size(); ++h) {
      if (halves_[h].drop() <= kFar) continue;
      if (count++ == 0 || halves_[h].drop() > halves_[deepest].drop()) deepest = h;
    }
    if (count == 0) return;
    const HalfCrest& half = halves_[deepest];
    warnings.push_back(
        "crests of weirs drop by more than " + amount("%g", kFar) + " m below their mean along half an edge, " +
        std::to_string(count) + forCount(count, " time", " times") + ", the most to " + amount("%.3g", half.lowest) +
        amount(" m where the mean is %.3g m, in ", half.lowest + half.drop()) + edges_[deepest / 2].source->feature +
        " at " + pointText(half.lowest_at) +
        ": water passes there. If it is a gate, or a bridge that the raster lacks, give the height as an "
        "attribute '" +
        kWeirHeight + "', or correct the raster");
  }

  // Lines beside their levees.
  void warnOfRising(std::vector<std::string>& warnings) const {
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      std::size_t known = 0, rising = 0;
      for (std::size_t h = 2 * beginOf(l); h < 2 * lines_[l].end; ++h) {
        known += halves_[h].known;
        rising += halves_[h].rising;
      }
      if (2 * rising <= known) continue;
      warnings.push_back(lineInWords(grid_, *lines_[l].line, edges_[beginOf(l)].source) +
                         ": along most of it the terrain is highest " + amount("%g m", options_.search_m) +
                         " away, where the search ends: is the line on the levee? Else give a longer --weir-search");
    }
  }

  void addNote(RasterCrests& crests) const {
    if (crests.of_edges.empty()) return;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const auto& [edge, halves] : crests.of_edges) {
      least = std::min({least, halves[0], halves[1]});
      most = std::max({most, halves[0], halves[1]});
    }
    crests.notes.push_back("crests of weirs from rasters: " + amount("%.3g", least) +
                           amount(" to %.3g m above the still water, the highest terrain", most) + withinSearch() +
                           " of their lines");
    for (const RasterBand& raster : rasters_)
      crests.notes.insert(crests.notes.end(), raster.geometry().notes.begin(), raster.geometry().notes.end());
  }

  std::size_t beginOf(std::size_t line) const { return line == 0 ? 0 : lines_[line - 1].end; }

  // A line of the grid, and the end of its edges.
  struct Line {
    const GridLine* line = nullptr;
    std::size_t end = 0;
  };

  const Grid& grid_;
  const CrestRasters& options_;
  const RunControl& control_;
  const ItemLoop& loop_;
  std::size_t of_their_own_ = 0;  // lines with a height
  std::vector<std::pair<NodePair, const WeirSource*>> pairs_;
  std::vector<Line> lines_;
  std::vector<RasterBand> rasters_;
  std::vector<CrestEdge> edges_;
  std::vector<HalfCrest> halves_;  // two for each edge
  std::size_t places_ = 0;         // of the present batch
};

}  // namespace

RasterCrests findRasterCrests(const Grid& grid, const std::vector<WeirSource>& sources, const CrestRasters& rasters,
                              const RunControl& control, const ItemLoop& loop) {
  if (rasters.files.empty() || sources.empty()) return {};
  return CrestSearch(grid, sources, rasters, control, loop).run();
}

}  // namespace coastmesh
