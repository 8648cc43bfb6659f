#include "gis/format/grid_layers.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "gis/coast/feature_names.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/elements/quads.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/grid/grid_lines.hpp"

namespace coastmesh {
namespace {

LayerColumn idColumn() { return {"id", LayerColumn::Whole()}; }

// Adds a column with a text of the triangle's feature, unless all texts are empty.
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

// Adds a column with the same number in both halves of a quadrilateral, from 1, unless there are none.
void addQuads(const Grid& grid, std::vector<LayerColumn>& columns) {
  const std::vector<Quad> quads = quadsOf(grid);
  if (quads.empty()) return;
  std::vector<std::uint32_t> number(grid.triangles.size(), 0);
  for (std::uint32_t q = 0; q < quads.size(); ++q)
    for (const std::uint32_t t : quads[q].halves) number[t] = q + 1;
  const auto numbers = std::make_shared<const std::vector<std::uint32_t>>(std::move(number));
  columns.push_back({std::string(kQuadColumn),
                     LayerColumn::Whole([numbers](std::size_t row) { return std::int64_t{(*numbers)[row]}; },
                                        [numbers](std::size_t row) { return (*numbers)[row] == 0; })});
}

GridLayer triangleLayer(const Grid& grid) {
  GridLayer layer{std::string(kTriangleLayer), GridLayer::Shape::Polygon, grid.triangles.size(), {idColumn()}, {}};
  layer.shapeOf = [&grid](std::size_t row, std::vector<std::uint32_t>& nodes) {
    const auto& [a, b, c] = grid.triangles[row];
    nodes.assign({a, b, c, a});
  };
  for (unsigned i = 0; i < 3; ++i)
    layer.columns.push_back({std::string(kCornerColumns[i]), LayerColumn::Whole(grid.triangles, i)});
  addQuads(grid, layer.columns);
  if (!grid.min_angle_deg.empty()) layer.columns.push_back({"min_angle", LayerColumn::Real(grid.min_angle_deg)});
  if (!grid.area_m2.empty()) layer.columns.push_back({"area_m2", LayerColumn::Real(grid.area_m2)});
  if (grid.feature_of.empty()) return layer;
  layer.columns.push_back(
      {"src_fid", LayerColumn::Whole([&grid](std::size_t row) { return grid.features[grid.feature_of[row]].fid; })});
  std::vector<std::string_view> sources, names;
  for (const GridFeature& feature : grid.features) {
    sources.push_back(feature.source);
    names.push_back(nameOf(feature.attributes));
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
  if (!grid.z.empty()) layer.columns.push_back({"z", LayerColumn::Real(grid.z)});
  if (!grid.size_m.empty()) layer.columns.push_back({"size", LayerColumn::Real(grid.size_m)});
  for (const NodeField& field : grid.node_fields)
    layer.columns.push_back({wordOf(field), LayerColumn::Real(field.values)});
  return layer;
}

// Lengths of boundaries or lines in metres.
template <typename Chain>
std::vector<double> lengthsOf(const std::vector<Chain>& chains, const Grid& grid, const ItemLoop& loop) {
  std::vector<std::vector<Point>> places;
  for (const Chain& chain : chains) {
    std::vector<Point>& made = places.emplace_back();
    for (const std::uint32_t node : chain.nodes) made.push_back(grid.nodes[node]);
    if (chain.closed && !made.empty()) made.push_back(made.front());
  }
  return chainLengths(places, grid.crs, loop);
}

// A layer of boundaries or lines, with the id as its column. REQUIRES: `chains` outlive it.
template <typename Chain>
GridLayer chainLayer(std::string_view name, const std::vector<Chain>& chains) {
  GridLayer layer{std::string(name), GridLayer::Shape::Line, chains.size(), {idColumn()}, {}};
  layer.shapeOf = [&chains](std::size_t row, std::vector<std::uint32_t>& nodes) {
    nodes = chains[row].nodes;
    if (chains[row].closed && !nodes.empty()) nodes.push_back(nodes.front());
  };
  return layer;
}

template <typename Chain>
void addClosedAndLength(const std::vector<Chain>& chains, const Grid& grid, const ItemLoop& loop, GridLayer& layer) {
  layer.columns.push_back({"closed", LayerColumn::Flag([&chains](std::size_t row) { return chains[row].closed; })});
  layer.columns.push_back({"length_m", LayerColumn::Real(lengthsOf(chains, grid, loop))});
}

// Adds a column with their names, unless none has one.
template <typename Chain>
void addNames(const std::vector<Chain>& chains, GridLayer& layer) {
  std::size_t longest = 0;
  for (const Chain& chain : chains) longest = std::max(longest, chain.name.size());
  if (longest == 0) return;
  layer.columns.push_back(
      {"name", LayerColumn::Text([&chains](std::size_t row) { return std::string_view(chains[row].name); }), longest});
}

GridLayer boundaryLayer(const Grid& grid, const ItemLoop& loop) {
  GridLayer layer = chainLayer(kBoundaryLayer, grid.boundaries);
  constexpr std::size_t kLongestRole = std::string_view("island").size();
  layer.columns.push_back({"role",
                           LayerColumn::Text([&grid](std::size_t row) { return toString(grid.boundaries[row].role); }),
                           kLongestRole});
  if (std::ranges::any_of(grid.boundaries, [](const Boundary& boundary) { return boundary.ibtype >= 0; }))
    layer.columns.push_back(
        {"ibtype", LayerColumn::Whole([&grid](std::size_t row) { return grid.boundaries[row].ibtype; },
                                      [&grid](std::size_t row) { return grid.boundaries[row].ibtype < 0; })});
  addNames(grid.boundaries, layer);
  addClosedAndLength(grid.boundaries, grid, loop, layer);
  return layer;
}

GridLayer lineLayer(const Grid& grid, const ItemLoop& loop) {
  GridLayer layer = chainLayer(kLineLayer, grid.lines);
  constexpr std::size_t kLongestKind = std::string_view("region border").size();
  layer.columns.push_back(
      {"kind", LayerColumn::Text([&grid](std::size_t row) { return toString(grid.lines[row].kind); }), kLongestKind});
  addNames(grid.lines, layer);
  addClosedAndLength(grid.lines, grid, loop, layer);
  return layer;
}

}  // namespace

std::vector<GridLayer> layersOf(const Grid& grid, const ItemLoop& loop) {
  std::vector<GridLayer> layers{triangleLayer(grid), nodeLayer(grid), boundaryLayer(grid, loop)};
  if (!grid.lines.empty()) layers.push_back(lineLayer(grid, loop));
  return layers;
}

std::string pathOfLayer(const std::string& path, std::string_view layer) {
  if (layer == kTriangleLayer) return path;
  const std::filesystem::path whole(path);
  std::string name = whole.stem().string() + "_";
  name += layer;
  return (whole.parent_path() / (name + whole.extension().string())).string();
}

}  // namespace coastmesh
