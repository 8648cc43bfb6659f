#include "apps/plot/plot_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/job/grid_pieces.hpp"
#include "apps/plot/mesh_shape.hpp"
#include "apps/plot/page_arrays.hpp"
#include "apps/plot/page_parts.hpp"
#include "apps/plot/plot_lines.hpp"
#include "apps/plot/plot_style.hpp"
#include "core/quality.hpp"
#include "gis/crs/crs.hpp"
#include "gis/error.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/geographic_nodes.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/grid/on_sphere.hpp"
#include "gis/long_wave.hpp"

namespace coastmesh {
namespace {

using Json = nlohmann::ordered_json;

// Integer for half the longer side of the plane, or for the globe's radius. Differences of places fit into 32 bits.
constexpr double kWhole = (1 << 30) - 1;

struct NamedArray {
  std::string name;
  PackedArray packed;
};

// The data in the page.
struct PageData {
  Json facts;
  std::vector<NamedArray> arrays;

  void add(const std::string& name, PackedArray packed) {
    facts["arrays"].push_back({{"name", name}, {"form", packed.form}, {"count", packed.count}});
    arrays.push_back({name, std::move(packed)});
  }
  void addIndices(const std::string& name, std::span<const std::uint32_t> values) {
    add(name, packIntegers(std::vector<std::int32_t>(values.begin(), values.end())));
  }
};

std::int32_t quantised(double share) {
  // Nodes without a triangle may be anywhere, and may have no finite place.
  return std::isfinite(share) ? static_cast<std::int32_t>(std::lround(std::clamp(share, -1.0, 1.0) * kWhole)) : 0;
}

// One axis after another: nodes with consecutive numbers are mostly near each other, so that differences are small.
void addAxis(PageData& data, const std::string& name, std::size_t count,
             const std::function<double(std::size_t)>& share) {
  std::vector<std::int32_t> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = quantised(share(i));
  data.add(name, packIntegers(values));
}

// The smallest angle of each triangle, or of the quadrilateral that it is a half of, in thousandths of a degree; of the
// latter also the greatest, 0 for a triangle.
void addAngles(PageData& data, const Grid& grid, const std::function<std::array<double, 3>(std::size_t)>& angles_deg) {
  const auto thousandths = [](double angle) {
    return std::isfinite(angle) ? static_cast<std::int32_t>(std::lround(angle * 1000.0)) : 0;
  };
  const QuadAngles quads = quadAnglesOf(grid);
  std::vector<std::int32_t> smallest(grid.triangles.size()), greatest(quads.greatest_deg.size());
  for (std::size_t t = 0; t < smallest.size(); ++t)
    smallest[t] = thousandths(quads.has(t) ? quads.least_deg[t] : std::ranges::min(angles_deg(t)));
  std::ranges::transform(quads.greatest_deg, greatest.begin(), thousandths);
  data.add("angle", packIntegers(smallest));
  if (!greatest.empty()) data.add("greatest_of_quad", packIntegers(greatest));
}

// Plane length over true length on a lattice over the area shown, rows from south to north; for a plane on Earth.
void addScales(PageData& data, const GridPiece& piece, const Point& low, const Point& high) {
  constexpr int kAcross = 17;
  std::vector<double> scales;
  for (int row = 0; row < kAcross; ++row) {
    for (int column = 0; column < kAcross; ++column) {
      const Point place{low.x + (high.x - low.x) * column / (kAcross - 1),
                        low.y + (high.y - low.y) * row / (kAcross - 1)};
      const double scale = piece.projection.scaleAt(place);
      scales.push_back(std::isfinite(scale) && scale > 0.0 ? scale : 1.0);
    }
  }
  data.facts["view"]["scales"] = scales;
}

void addGlobe(PageData& data, const std::vector<Point>& geographic, const std::optional<GlobeView>& view,
              const Grid& grid) {
  std::vector<SphereVector> places;
  for (const Point& place : geographic) places.push_back(onSphere(asLonLat(place)));
  const LonLat above = view && view->above ? *view->above : middleOnGlobe(grid, places);
  data.facts["view"] = {{"kind", "globe"}, {"above", {above.lon, above.lat}}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    addAxis(data, std::string("place_") + "xyz"[axis], places.size(), [&](std::size_t i) { return places[i][axis]; });
  addAngles(data, grid, [&](std::size_t t) {
    const auto& [a, b, c] = grid.triangles[t];
    return flatAnglesDeg(places[a], places[b], places[c]);
  });
}

void addPlane(PageData& data, const Grid& grid, const GridPiece& piece) {
  // Nodes without a triangle are not shown, and may be anywhere.
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-low.x, -low.y};
  for (const Point& p : piece.mesh.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Point middle{low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2};
  const double half = std::max({(high.x - low.x) / 2, (high.y - low.y) / 2, std::numeric_limits<double>::min()});
  data.facts["view"] = {{"kind", "plane"},
                        {"unit", half / kWhole},
                        {"half", {(high.x - low.x) / 2 / half, (high.y - low.y) / 2 / half}},
                        {"projection", grid.crs.isPlane() ? "" : piece.projection.description()}};
  std::vector<Point> shares(grid.nodes.size());
  for (std::size_t i = 0; i < piece.nodes.size(); ++i) {
    const Point& p = piece.mesh.points[i];
    shares[piece.nodes[i]] = {(p.x - middle.x) / half, (p.y - middle.y) / half};
  }
  addAxis(data, "place_x", shares.size(), [&](std::size_t i) { return shares[i].x; });
  addAxis(data, "place_y", shares.size(), [&](std::size_t i) { return shares[i].y; });
  if (!grid.crs.isPlane()) addScales(data, piece, low, high);
  addAngles(data, grid, [&](std::size_t t) {
    const auto& [a, b, c] = piece.mesh.triangles[t].v;
    return anglesDeg(piece.mesh.points[a], piece.mesh.points[b], piece.mesh.points[c]);
  });
}

// Edges as pairs of nodes, by kind.
void addLines(PageData& data, const Grid& grid, const TriMesh& linked) {
  std::vector<std::pair<std::string, std::vector<std::uint32_t>>> kinds;
  const auto put = [&](const std::string& kind, std::uint32_t a, std::uint32_t b) {
    auto at = std::ranges::find(kinds, kind, &std::pair<std::string, std::vector<std::uint32_t>>::first);
    if (at == kinds.end()) at = kinds.insert(kinds.end(), {kind, {}});
    at->second.insert(at->second.end(), {a, b});
  };
  std::vector<NodePair> named;
  for (const Boundary& boundary : grid.boundaries)
    for (const auto& [a, b] : edgesOf(boundary)) named.push_back({std::min(a, b), std::max(a, b)});
  std::ranges::sort(named);
  for (TriId t = 0; t < linked.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i), twin = linked.triangles[t].adj[i];
      const std::uint32_t a = linked.origin(e), b = linked.target(e);
      if (twin != kNone) {
        if (e < twin && linked.regions[t] != linked.regions[triOf(twin)]) put("border", a, b);
      } else if (!std::ranges::binary_search(named, NodePair{std::min(a, b), std::max(a, b)})) {
        put("shore", a, b);  // the file has no type for it
      }
    }
  }
  for (const GridLine& line : grid.lines)
    for (const auto& [a, b] : edgesOf(line)) put(std::string(toString(line.kind)), a, b);
  for (const BoundaryRole role : {BoundaryRole::Land, BoundaryRole::Island, BoundaryRole::River, BoundaryRole::Open})
    for (const Boundary& boundary : grid.boundaries)
      if (boundary.role == role)
        for (const auto& [a, b] : edgesOf(boundary)) put(isWeir(boundary) ? "weir" : std::string(toString(role)), a, b);
  data.facts["lines"] = Json::array();
  for (const auto& [kind, nodes] : kinds) {
    const std::string name = "line_" + std::to_string(data.facts["lines"].size());
    data.facts["lines"].push_back({{"kind", kind}, {"array", name}});
    data.addIndices(name, nodes);
  }
}

std::vector<std::array<int, 3>> bytesOf(const std::function<Color(std::size_t)>& color, std::size_t count) {
  const auto byte = [](double share) { return static_cast<int>(std::lround(share * 255.0)); };
  std::vector<std::array<int, 3>> bytes;
  for (std::size_t i = 0; i < count; ++i) {
    const Color c = color(i);
    bytes.push_back({byte(c.red), byte(c.green), byte(c.blue)});
  }
  return bytes;
}

// The colours of pictures: 251 shares of each ramp, and as many kinds.
void addPalettes(PageData& data) {
  constexpr std::size_t kShares = 251;
  const auto along = [](Color (*ramp)(double)) {
    return bytesOf([ramp](std::size_t i) { return ramp(static_cast<double>(i) / (kShares - 1)); }, kShares);
  };
  data.facts["palettes"] = {
      {"ramp", along(rampColor)}, {"depth", along(depthColor)}, {"kinds", bytesOf(featureColor, kShares)}};
  data.facts["least_quality"] = kLeastQuality;
}

// Adds the values by which triangles may be coloured, besides their shape, and names of these values.
void addMarks(PageData& data, const Grid& grid, const TriMesh& linked) {
  Json colors = {"none", "angle", "quality", "size"};
  if (std::ranges::any_of(grid.z, [](double z) { return std::isfinite(z); })) {
    data.add("z", packNumbers(grid.z));
    colors.push_back("depth");
    if (std::ranges::any_of(grid.z, [](double z) { return z < 0.0; })) colors.push_back("timestep");
  }
  if (!grid.feature_of.empty()) {
    data.addIndices("feature", grid.feature_of);
    data.facts["features"] = featureLabels(grid);
    colors.push_back("feature");
    if (const std::vector<std::string> names = regionNames(grid); !names.empty()) {
      data.facts["regions"] = names;
      data.facts["region_of_feature"] = regionNumbers(grid, names);
    }
  }
  if (!data.facts.contains("regions")) data.addIndices("region", partsOf(linked));
  colors.push_back("region");
  if (!grid.piece_of.empty()) {
    data.addIndices("piece", grid.piece_of);
    colors.push_back("piece");
  }
  if (!grid.part_of.empty()) {
    data.addIndices("part", grid.part_of);
    colors.push_back("part");
  }
  data.facts["colors"] = colors;
}

Json factsOf(const Grid& grid, const PageOptions& options) {
  return {{"coastmesh", COASTMESH_VERSION},
          {"title", grid.title.empty() ? options.name : grid.title},
          {"file", options.name},
          {"crs", nameOf(grid.crs)},
          {"coordinates", grid.crs.isPlane()    ? "plane"
                          : grid.crs.geographic ? "degrees"
                                                : "projected"},
          {"ellipsoid", {grid.crs.semi_major_m, grid.crs.flattening}},
          {"gravity", kGravity},
          {"nodes", grid.nodes.size()},
          {"triangles", grid.triangles.size()},
          {"color", plotColorNames()[static_cast<std::size_t>(options.color)]},
          {"edges", options.edges},
          {"min_angle", options.min_angle_deg},
          {"angle_slack", kAngleSlackDeg},
          {"arrays", Json::array()}};
}

void addCoordinates(PageData& data, const Grid& grid, const std::vector<Point>& geographic) {
  const auto add = [&data](const std::string& x, const std::string& y, std::span<const Point> points) {
    std::vector<double> values(points.size());
    std::ranges::transform(points, values.begin(), &Point::x);
    data.add(x, packNumbers(values));
    std::ranges::transform(points, values.begin(), &Point::y);
    data.add(y, packNumbers(values));
  };
  if (!geographic.empty()) add("lon", "lat", geographic);
  if (!grid.crs.geographic) add("x", "y", grid.nodes);
}

PageData dataOf(const Grid& grid, const PageOptions& options) {
  PageData data{factsOf(grid, options), {}};
  std::vector<std::uint32_t> all(grid.triangles.size()), corners;
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  for (const auto& triangle : grid.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  const std::vector<Point> geographic = grid.crs.isPlane() ? std::vector<Point>{} : geographicNodes(grid);
  const auto piece = [&] { return makePiece(grid, all, fitProjection(grid, all), LineEdges(grid)); };
  if (options.view) {
    addGlobe(data, geographic, options.view, grid);
  } else if (const GridPiece whole = piece(); whole.places.empty()) {
    addPlane(data, grid, whole);
  } else {
    addGlobe(data, geographic, {}, grid);
  }
  data.addIndices("corners", corners);
  addCoordinates(data, grid, geographic);
  TriMesh linked = linkGrid(grid).mesh;
  linked.regions.assign(grid.triangles.size(), 0);
  if (!grid.feature_of.empty()) linked.regions.assign(grid.feature_of.begin(), grid.feature_of.end());
  addMarks(data, grid, linked);
  addLines(data, grid, linked);
  addPalettes(data);
  return data;
}

// Text of a page, within an element or an attribute.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

// JSON within a script element, escaped so that nothing in it can end the element.
std::string scriptJson(const Json& value) {
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  for (const char c : text) out += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return out;
}

void writePage(const PageData& data, const std::string& path) {
  TextWriter file(path);
  std::string_view rest = kPageFrame;
  const auto upTo = [&](std::string_view mark) {
    const std::size_t at = rest.find(mark);
    if (at == std::string_view::npos) throw std::logic_error("page.html has no " + std::string(mark));
    file << rest.substr(0, at);
    rest.remove_prefix(at + mark.size());
  };
  const std::string title = scriptJson(data.facts["title"]);
  upTo("{{title}}");
  file << escaped(Json::parse(title).get<std::string>());
  upTo("{{style}}");
  file << kPageStyle;
  upTo("{{data}}");
  file << "<script type=\"application/json\" id=\"facts\">" << scriptJson(data.facts) << "</script>\n";
  for (const NamedArray& array : data.arrays)
    file << "<script type=\"application/octet-stream\" id=\"array-" << array.name << "\">" << array.packed.text
         << "</script>\n";
  upTo("{{script}}");
  file << kPageScript << rest;
  file.close();
}

}  // namespace

bool isPagePath(const std::string& path) { return std::filesystem::path(path).extension() == ".html"; }

void plotPage(const Grid& grid, const PageOptions& options, const std::string& path) {
  if (options.view && options.view->all)
    throw OptionError("--view: a page shows a plane or a globe; natural-earth is for .svg and .png");
  if (options.view && grid.crs.isPlane())
    throw InputError("the mesh lies in a plane, and has no place on a globe; say its CRS");
  if (grid.triangles.empty()) throw InputError("the mesh has no triangle to show");
  if (grid.triangles.size() > kMostPageTriangles)
    throw InputError("a page of " + std::to_string(grid.triangles.size()) + " triangles is more than browsers take, " +
                     std::to_string(kMostPageTriangles) + "; draw a picture, .svg or .png, with --bbox");
  PlotOptions colors;
  colors.color = options.color;
  requireColors(grid, colors);
  const PageData data = dataOf(grid, options);
  const std::string& color = plotColorNames()[static_cast<std::size_t>(options.color)];
  const Json& known = data.facts["colors"];
  if (std::ranges::find(known, Json(color)) == known.end())
    throw InputError(color == "feature" ? "the mesh does not say its features, to be coloured by"
                                        : "the mesh has no depth" +
                                              std::string(color == "depth" ? "" : " below water") + " to colour it by");
  writePage(data, path);
}

}  // namespace coastmesh
