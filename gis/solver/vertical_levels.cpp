#include "gis/solver/vertical_levels.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "gis/elements/elements.hpp"
#include "gis/error.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/places.hpp"

namespace coastmesh {
namespace {

constexpr std::string_view kFesomEnding = "aux3d.out", kSchismEnding = "vgrid.in";
// FESOM2 has no shallower water.
constexpr double kLeastFesomLayers = 4.0;

// The next number, on this line or a later one.
double nextNumber(TextReader& file) {
  while (!file.hasWord()) file.needLine();
  return file.number();
}

void requireAscending(const std::vector<double>& depths, const TextReader& file) {
  if (std::ranges::adjacent_find(depths, std::greater_equal<>()) != depths.end())
    file.fail("its levels are not in the order of their depths");
}

FesomLevels readFesomLevels(const std::string& path) {
  TextReader file(path);
  file.needLine();
  const std::uint64_t count = file.count();
  if (count < 2 || count > file.size()) file.fail("the number of levels is expected, 2 or more");
  FesomLevels levels;
  for (std::uint64_t k = 0; k < count; ++k) levels.depths_m.push_back(std::abs(nextNumber(file)));
  requireAscending(levels.depths_m, file);
  return levels;
}

// The levels of the line after the numbers of levels in all and of Z levels, and the depth of the S layers.
SzLevels readSzLevels(TextReader& file) {
  file.needLine();
  const std::uint64_t all = file.count(), z_levels = file.count();
  if (z_levels < 1 || z_levels >= all || all > file.size())
    file.fail("the number of levels and that of Z levels are expected, the latter 1 or more and fewer");
  file.needLine();  // a title
  SzLevels levels{all - z_levels, {}};
  for (std::uint64_t k = 0; k < z_levels; ++k) {
    file.needLine();
    file.count();
    levels.depths_m.push_back(0.0 - file.number());
  }
  std::ranges::reverse(levels.depths_m);
  requireAscending(levels.depths_m, file);
  return levels;
}

// The lowest level of a node, which the file has next.
std::uint64_t nextLowest(TextReader& file, std::uint64_t all) {
  const std::uint64_t lowest = file.count();
  if (lowest < 1 || lowest > all) file.fail("there is no level " + std::to_string(lowest));
  return lowest;
}

std::uint64_t layersAbove(std::uint64_t lowest, std::uint64_t all) { return std::max<std::uint64_t>(1, all - lowest); }

// As SCHISM had it before October 2021, from the line of the first node on: each node with its number, its lowest level
// and the places of its levels.
NodeLayers readNodeLines(TextReader& file, std::uint64_t all) {
  NodeLayers read;
  do {
    const std::uint64_t expected = read.layers.size() + 1;
    if (file.count() != expected) file.fail("the levels of node " + std::to_string(expected) + " are expected");
    const std::uint64_t lowest = nextLowest(file, all);
    for (std::uint64_t level = lowest; level <= all; ++level) nextNumber(file);
    read.layers.push_back(layersAbove(lowest, all));
  } while (file.nextLine());
  return read;
}

// The lowest levels of all nodes in a line. A number that is no level tells that it is the older form.
NodeLayers readNodeLayers(TextReader& file) {
  file.needLine();
  const std::uint64_t all = file.count();
  file.needLine();
  if (file.line().find_first_of(".-") != std::string_view::npos) return readNodeLines(file, all);
  NodeLayers read;
  while (file.hasWord()) read.layers.push_back(layersAbove(nextLowest(file, all), all));
  return read;
}

// Depth at each node. A grid without any has depth 0, as it is written.
std::vector<double> depthsOf(const Grid& grid) {
  std::vector<double> depths(grid.nodes.size(), 0.0);
  for (std::size_t n = 0; n < grid.z.size(); ++n) {
    if (std::isnan(grid.z[n]))
      throw InputError("node " + std::to_string(n + 1) + " at " + pointText(grid.nodes[n]) +
                       " has no depth, so that its layers are unknown: give the mesh depths, or balance parts with "
                       "--partition-weight even");
    depths[n] = 0.0 - grid.z[n];
  }
  return depths;
}

std::vector<double> ofElements(const Grid& grid, const Elements& elements, const FesomLevels& levels) {
  std::vector<double> middles;
  for (std::size_t k = 1; k < levels.depths_m.size(); ++k)
    middles.push_back((levels.depths_m[k - 1] + levels.depths_m[k]) / 2.0);
  const std::vector<double> depths = depthsOf(grid);
  std::vector<double> layers;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Elements::Nodes nodes = elements.nodesOf(e);
    double sum = 0.0;
    for (const std::uint32_t node : nodes) sum += depths[node];
    const auto below = std::ranges::upper_bound(middles, sum / static_cast<double>(nodes.count));
    layers.push_back(std::max(static_cast<double>(below - middles.begin()), kLeastFesomLayers));
  }
  return layers;
}

double layersAt(double depth, const SzLevels& levels) {
  if (depth <= 0.0) return 1.0;
  const auto level = std::ranges::lower_bound(levels.depths_m, depth);
  return static_cast<double>(levels.s_layers) + static_cast<double>(level - levels.depths_m.begin());
}

// The shallowest node counts.
std::vector<double> ofElements(const Grid& grid, const Elements& elements, const SzLevels& levels) {
  const std::vector<double> depths = depthsOf(grid);
  std::vector<double> layers;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t node : elements.nodesOf(e)) least = std::min(least, depths[node]);
    layers.push_back(layersAt(least, levels));
  }
  return layers;
}

// The node with the most layers counts.
std::vector<double> ofElements(const Grid&, const Elements& elements, const NodeLayers& levels) {
  std::vector<double> layers;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    std::uint64_t most = 0;
    for (const std::uint32_t node : elements.nodesOf(e)) most = std::max(most, levels.layers[node]);
    layers.push_back(static_cast<double>(most));
  }
  return layers;
}

std::vector<double> ofNodes(const Grid& grid, const Elements& elements, const FesomLevels& levels) {
  std::vector<double> layers(grid.nodes.size(), kLeastFesomLayers);
  const std::vector<double> of_elements = ofElements(grid, elements, levels);
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const std::uint32_t node : elements.nodesOf(e)) layers[node] = std::max(layers[node], of_elements[e]);
  return layers;
}

std::vector<double> ofNodes(const Grid& grid, const Elements&, const SzLevels& levels) {
  std::vector<double> layers;
  for (const double depth : depthsOf(grid)) layers.push_back(layersAt(depth, levels));
  return layers;
}

std::vector<double> ofNodes(const Grid&, const Elements&, const NodeLayers& levels) {
  return {levels.layers.begin(), levels.layers.end()};
}

void requireLevelsOf(const Grid& grid, const VerticalLevels& levels) {
  const auto* const of_nodes = std::get_if<NodeLayers>(&levels.levels);
  if (of_nodes != nullptr && of_nodes->layers.size() != grid.nodes.size())
    throw InputError("'" + levels.file + "' has the levels of " + std::to_string(of_nodes->layers.size()) +
                     " nodes, and the mesh has " + std::to_string(grid.nodes.size()));
}

}  // namespace

bool isLevelFile(const std::string& path) { return path.ends_with(kFesomEnding) || path.ends_with(kSchismEnding); }

VerticalLevels readVerticalLevels(const std::string& path) {
  if (path.ends_with(kFesomEnding)) return {path, readFesomLevels(path)};
  TextReader file(path);
  file.needLine();
  const std::uint64_t ivcor = file.count();
  if (ivcor == 1) return {path, readNodeLayers(file)};
  if (ivcor == 2) return {path, readSzLevels(file)};
  file.fail("ivcor is expected, 1 or 2");
}

std::vector<double> layersOfElements(const Grid& grid, const Elements& elements, const VerticalLevels& levels) {
  requireLevelsOf(grid, levels);
  return std::visit([&](const auto& kind) { return ofElements(grid, elements, kind); }, levels.levels);
}

std::vector<double> layersOfNodes(const Grid& grid, const Elements& elements, const VerticalLevels& levels) {
  requireLevelsOf(grid, levels);
  return std::visit([&](const auto& kind) { return ofNodes(grid, elements, kind); }, levels.levels);
}

}  // namespace coastmesh
