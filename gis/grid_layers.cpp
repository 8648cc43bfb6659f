#include "gis/grid_layers.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <utility>

#include "gis/geodesy.hpp"

namespace coastmesh {
namespace {

std::string lowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// The value of the attribute "name", else of the first that has "name" in its own.
std::string_view nameOf(const GridFeature& feature) {
  for (const bool exactly : {true, false}) {
    for (const auto& [key, value] : feature.attributes) {
      const std::string lower = lowerCase(key);
      if (exactly ? lower == "name" : lower.find("name") != std::string::npos) return value;
    }
  }
  return {};
}

LayerColumn idColumn() {
  return {"id", LayerColumn::Whole([](std::size_t row) { return static_cast<std::int64_t>(row) + 1; })};
}

// A text of the triangle's feature; left out where no feature has it.
void addFeatureText(const Grid& grid, const std::string& name, std::vector<std::string_view> texts,
                    std::vector<LayerColumn>& columns) {
  std::size_t longest = 0;
  for (const std::string_view text : texts) longest = std::max(longest, text.size());
  if (longest == 0) return;
  columns.push_back({name, LayerColumn::Text([&grid, texts = std::move(texts)](std::size_t row) {
                       return texts[grid.feature_of[row]];
                     }),
                     longest});
}

GridLayer triangleLayer(const Grid& grid) {
  GridLayer layer{std::string(kTriangleLayer), GridLayer::Shape::Polygon, grid.triangles.size(), {idColumn()}, {}};
  layer.shapeOf = [&grid](std::size_t row, std::vector<std::uint32_t>& nodes) {
    const auto& [a, b, c] = grid.triangles[row];
    nodes.assign({a, b, c, a});
  };
  if (!grid.min_angle_deg.empty())
    layer.columns.push_back(
        {"min_angle", LayerColumn::Real([&grid](std::size_t row) { return grid.min_angle_deg[row]; })});
  if (!grid.area_m2.empty())
    layer.columns.push_back({"area_m2", LayerColumn::Real([&grid](std::size_t row) { return grid.area_m2[row]; })});
  if (grid.feature_of.empty()) return layer;
  layer.columns.push_back(
      {"src_fid", LayerColumn::Whole([&grid](std::size_t row) { return grid.features[grid.feature_of[row]].fid; })});
  std::vector<std::string_view> sources, names;
  for (const GridFeature& feature : grid.features) {
    sources.push_back(feature.source);
    names.push_back(nameOf(feature));
  }
  addFeatureText(grid, "source", std::move(sources), layer.columns);
  addFeatureText(grid, "name", std::move(names), layer.columns);
  const auto inRegion = [](const GridFeature& feature) { return !feature.region.empty(); };
  if (std::ranges::any_of(grid.features, inRegion)) {
    std::vector<std::string_view> regions;
    for (const GridFeature& feature : grid.features) regions.push_back(feature.region);
    addFeatureText(grid, "region", std::move(regions), layer.columns);
  }
  return layer;
}

GridLayer nodeLayer(const Grid& grid) {
  GridLayer layer{std::string(kNodeLayer), GridLayer::Shape::Point, grid.nodes.size(), {idColumn()}, {}};
  layer.shapeOf = [](std::size_t row, std::vector<std::uint32_t>& nodes) {
    nodes.assign({static_cast<std::uint32_t>(row)});
  };
  if (!grid.z.empty())
    layer.columns.push_back({"z", LayerColumn::Real([&grid](std::size_t row) { return grid.z[row]; })});
  if (!grid.size_m.empty())
    layer.columns.push_back({"size", LayerColumn::Real([&grid](std::size_t row) { return grid.size_m[row]; })});
  return layer;
}

std::vector<double> boundaryLengths(const Grid& grid) {
  std::vector<std::vector<Point>> chains;
  for (const Boundary& boundary : grid.boundaries) {
    std::vector<Point>& chain = chains.emplace_back();
    for (std::uint32_t node : boundary.nodes) chain.push_back(grid.nodes[node]);
    if (boundary.closed && !chain.empty()) chain.push_back(chain.front());
  }
  return chainLengths(chains, grid.crs);
}

GridLayer boundaryLayer(const Grid& grid) {
  GridLayer layer{std::string(kBoundaryLayer), GridLayer::Shape::Line, grid.boundaries.size(), {idColumn()}, {}};
  layer.shapeOf = [&grid](std::size_t row, std::vector<std::uint32_t>& nodes) {
    nodes = grid.boundaries[row].nodes;
    if (grid.boundaries[row].closed && !nodes.empty()) nodes.push_back(nodes.front());
  };
  constexpr std::size_t kLongestRole = std::string_view("island").size();
  layer.columns.push_back({"role",
                           LayerColumn::Text([&grid](std::size_t row) { return toString(grid.boundaries[row].role); }),
                           kLongestRole});
  layer.columns.push_back(
      {"closed", LayerColumn::Flag([&grid](std::size_t row) { return grid.boundaries[row].closed; })});
  layer.columns.push_back(
      {"length_m", LayerColumn::Real([lengths = boundaryLengths(grid)](std::size_t row) { return lengths[row]; })});
  return layer;
}

}  // namespace

std::vector<GridLayer> layersOf(const Grid& grid) {
  return {triangleLayer(grid), nodeLayer(grid), boundaryLayer(grid)};
}

std::string pathOfLayer(const std::string& path, std::string_view layer) {
  if (layer == kTriangleLayer) return path;
  const std::filesystem::path whole(path);
  std::string name = whole.stem().string() + "_";
  name += layer;
  return (whole.parent_path() / (name + whole.extension().string())).string();
}

}  // namespace coastmesh
