// Shapes of sized meshes, a line per file, in any format that the program can read.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/geometry/box.hpp"
#include "gis/grid/grid.hpp"

namespace {

using namespace coastmesh;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// The requested size: min(most, shore + gradation * distance from the mesh's boundary).
struct SizeRule {
  double shore = 0.0, gradation = 0.0, most = std::numeric_limits<double>::infinity();
};

// The triangles on both sides of each edge; the second is kNone on the boundary.
std::map<Edge, std::array<std::uint32_t, 2>> edgesOf(const Grid& grid) {
  std::map<Edge, std::array<std::uint32_t, 2>> edges;
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = grid.triangles[t][i], b = grid.triangles[t][(i + 1) % 3];
      const auto [at, first] = edges.try_emplace(std::minmax(a, b), std::array{t, kNone});
      if (!first) at->second[1] = t;
    }
  }
  return edges;
}

class SizeAt {
 public:
  SizeAt(const SizeRule& rule, const Grid& grid, const std::map<Edge, std::array<std::uint32_t, 2>>& edges)
      : rule_(rule) {
    if (rule.gradation == 0.0) return;
    double total = 0.0;
    for (const auto& [edge, beside] : edges) {
      if (beside[1] != kNone) continue;
      shores_.push_back({grid.nodes[edge.first], grid.nodes[edge.second]});
      total += distance(shores_.back()[0], shores_.back()[1]);
      for (const Point& p : shores_.back()) box_.add(p);
    }
    cell_ = std::max(4.0 * total / static_cast<double>(shores_.size()),
                     1e-3 * std::max((box_.xmax - box_.xmin), (box_.ymax - box_.ymin)));
    columns_ = static_cast<int>((box_.xmax - box_.xmin) / cell_) + 1;
    rows_ = static_cast<int>((box_.ymax - box_.ymin) / cell_) + 1;
    cells_.resize(static_cast<std::size_t>(columns_) * rows_);
    for (std::uint32_t s = 0; s < shores_.size(); ++s) {
      const auto [a, b] = shores_[s];
      for (int j = row(std::min(a.y, b.y)); j <= row(std::max(a.y, b.y)); ++j)
        for (int i = column(std::min(a.x, b.x)); i <= column(std::max(a.x, b.x)); ++i) cells_[index(i, j)].push_back(s);
    }
  }

  double operator()(const Point& p) const {
    if (rule_.gradation == 0.0) return std::min(rule_.most, rule_.shore);
    double nearest = (rule_.most - rule_.shore) / rule_.gradation;
    const int i0 = column(p.x), j0 = row(p.y);
    for (int reach = 0; (reach - 1) * cell_ < nearest; ++reach) {
      for (int j = std::max(0, j0 - reach); j <= std::min(rows_ - 1, j0 + reach); ++j) {
        const bool whole_row = j == j0 - reach || j == j0 + reach;
        for (int i = i0 - reach; i <= i0 + reach; i += whole_row || reach == 0 ? 1 : 2 * reach) {
          if (i < 0 || i >= columns_) continue;
          for (const std::uint32_t s : cells_[index(i, j)])
            nearest = std::min(nearest, std::sqrt(squaredDistanceToSegment(p, shores_[s][0], shores_[s][1])));
        }
      }
      if (reach > columns_ + rows_) break;
    }
    return std::min(rule_.most, rule_.shore + rule_.gradation * nearest);
  }

 private:
  int column(double x) const { return std::clamp(static_cast<int>((x - box_.xmin) / cell_), 0, columns_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - box_.ymin) / cell_), 0, rows_ - 1); }
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * columns_ + i; }

  SizeRule rule_;
  Box box_;
  double cell_ = 0.0;
  int columns_ = 0, rows_ = 0;
  std::vector<std::array<Point, 2>> shores_;
  std::vector<std::vector<std::uint32_t>> cells_;
};

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

double percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void printRow(const std::string& file, const SizeRule& rule) {
  const Grid grid = readGrid(file);
  const auto edges = edgesOf(grid);
  const SizeAt size(rule, grid, edges);

  constexpr double kEquilateral = 0.43301270189221932;  // area for edges of length 1
  std::vector<double> quality, angles;
  std::vector<Point> centres;
  std::vector<double> areas;
  double ideal = 0.0, sum = 0.0;
  std::vector<std::uint32_t> obtuse;
  for (const auto& corners : grid.triangles) {
    const Point &a = grid.nodes[corners[0]], &b = grid.nodes[corners[1]], &c = grid.nodes[corners[2]];
    const double area = 0.5 * cross(b - a, c - a);
    const double squares = squaredDistance(a, b) + squaredDistance(b, c) + squaredDistance(c, a);
    quality.push_back(16.0 * kEquilateral * area / squares);
    sum += quality.back();
    const std::array at{angleAt(a, b, c), angleAt(b, c, a), angleAt(c, a, b)};
    angles.push_back(toDegrees(std::ranges::min(at)));
    if (std::ranges::max(at) > toRadians(90.0 + 1e-9)) obtuse.push_back(static_cast<std::uint32_t>(quality.size() - 1));
    const double wanted = size(centroid(a, b, c));
    ideal += area / (kEquilateral * wanted * wanted);
    centres.push_back(a + circumcenterOffset(a, b, c));
    areas.push_back(area);
  }

  std::vector<std::uint32_t> degree(grid.nodes.size(), 0);
  std::vector<std::uint8_t> on_boundary(grid.nodes.size(), 0);
  std::vector<double> lengths;
  std::size_t near = 0, links = 0;
  for (const auto& [edge, beside] : edges) {
    const auto [a, b] = edge;
    ++degree[a];
    ++degree[b];
    if (beside[1] == kNone) on_boundary[a] = on_boundary[b] = 1;
    const Point &p = grid.nodes[a], &q = grid.nodes[b];
    lengths.push_back(distance(p, q) / size(midpoint(p, q)));
    near += lengths.back() >= 0.8 && lengths.back() <= 1.25 ? 1 : 0;
    if (beside[1] == kNone) continue;
    // D-Flow FM's definition of a small flow link.
    const double least = 0.1 * 0.5 * (std::sqrt(areas[beside[0]]) + std::sqrt(areas[beside[1]]));
    links += distance(centres[beside[0]], centres[beside[1]]) < least ? 1 : 0;
  }
  std::size_t inner = 0, six = 0, odd = 0;
  for (std::size_t v = 0; v < grid.nodes.size(); ++v) {
    if (on_boundary[v] || degree[v] == 0) continue;
    ++inner;
    six += degree[v] == 6 ? 1 : 0;
    odd += degree[v] < 5 || degree[v] > 7 ? 1 : 0;
  }
  const auto isInner = [&](std::uint32_t t) {
    return std::ranges::none_of(grid.triangles[t], [&](std::uint32_t v) { return on_boundary[v] != 0; });
  };
  const auto inner_obtuse = static_cast<std::size_t>(std::ranges::count_if(obtuse, isInner));
  const double triangles = static_cast<double>(grid.triangles.size());
  std::printf("%s\t%zu\t%.3f\t%.4f\t%.3f\t%.1f\t%.2f\t%zu\t%.1f\t%.2f\t%.3f\t%.1f\t%zu\n", file.c_str(),
              grid.nodes.size(), triangles / ideal, sum / triangles, quantile(quality, 0.01), quantile(angles, 0.01),
              percent(obtuse.size(), grid.triangles.size()), inner_obtuse, percent(six, inner), percent(odd, inner),
              quantile(lengths, 0.5), percent(near, lengths.size()), links);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Shapes of sized meshes, against min(--size-max, --size-shore + --grade times the distance from the mesh's "
      "boundary). Coordinates are taken as they are: give files in a plane.");
  std::vector<std::string> files;
  SizeRule rule;
  app.add_option("MESH", files, "files of meshes")->required();
  app.add_option("--size-shore", rule.shore, "edge length on the boundary")->required();
  app.add_option("--grade", rule.gradation, "growth of it per unit of distance");
  app.add_option("--size-max", rule.most, "most that it is anywhere");
  CLI11_PARSE(app, argc, argv);
  try {
    if (rule.gradation > 0.0 && !std::isfinite(rule.most)) throw std::invalid_argument("--grade needs --size-max");
    std::printf(
        "mesh\tvertices\ttriangles/ideal\tq mean\tq 1 %%\tangle 1 %%\t> 90 %%\tinner > 90\tdegree 6 %%\tnot 5-7 %%\t"
        "edge/h median\t.8-1.25 %%\tsmall links\n");
    for (const std::string& file : files) printRow(file, rule);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
