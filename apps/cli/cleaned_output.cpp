#include "apps/cli/cleaned_output.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "gis/coast/feature_names.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/read/cleaned_layers.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kNoFeature = static_cast<std::size_t>(-1);

const char* kindOf(const Segment& segment, const Domain& domain) {
  if (segment.tag == kOpenTag) return "open";
  if (isLineTag(segment.tag) && lineOfTag(segment.tag) < domain.lines.size()) {
    switch (domain.lines[lineOfTag(segment.tag)].use) {
      case FeatureUse::Weir:
        return "weir";
      case FeatureUse::Region:
        return "region";
      default:
        return "constraint";
    }
  }
  return segment.left < 0 || segment.right < 0 ? "shore" : "border";
}

std::size_t lineFeatureOf(const Segment& segment, const Domain& domain) {
  if (!isLineTag(segment.tag) || lineOfTag(segment.tag) >= domain.lines.size()) return kNoFeature;
  return domain.lines[lineOfTag(segment.tag)].feature;
}

bool lexLessPair(const Point& a, const Point& b, const Point& c, const Point& d) {
  return a == c ? lexLess(b, d) : lexLess(a, c);
}

// An edge of the graph, from its lexicographically smaller end.
struct PslgEdge {
  Point a, b;
  VertexId first, last;
  const char* kind;
  std::size_t domain;
  RegionId left, right;
  std::size_t line;  // feature, or kNoFeature
  BoundaryType boundary{};
};

std::vector<PslgEdge> sortedEdges(const std::vector<Domain>& domains, const BoundaryTypes& types) {
  std::vector<PslgEdge> edges;
  for (std::size_t d = 0; d < domains.size(); ++d) {
    const Domain& domain = domains[d];
    for (std::size_t i = 0; i < domain.pslg.segments.size(); ++i) {
      const Segment& s = domain.pslg.segments[i];
      PslgEdge edge{domain.input_points[s.a], domain.input_points[s.b], s.a, s.b, kindOf(s, domain), d, s.left, s.right,
                    lineFeatureOf(s, domain)};
      if (!types.empty()) edge.boundary = types[d][i];
      if (lexLess(edge.b, edge.a)) {
        std::swap(edge.a, edge.b);
        std::swap(edge.first, edge.last);
        std::swap(edge.left, edge.right);
      }
      edges.push_back(edge);
    }
  }
  std::ranges::sort(edges, [](const PslgEdge& e, const PslgEdge& f) { return lexLessPair(e.a, e.b, f.a, f.b); });
  return edges;
}

// Numbers of features: areas once per domain, in the order of domains, then lines, then regions.
class Numbers {
 public:
  Numbers(const std::vector<PslgEdge>& edges, const Coastline& coastline) {
    std::set<std::pair<std::size_t, std::size_t>> areas;
    std::set<std::size_t> lines;
    for (const PslgEdge& edge : edges) {
      for (const RegionId side : {edge.left, edge.right})
        if (side >= 0) areas.emplace(edge.domain, static_cast<std::size_t>(side));
      if (edge.line != kNoFeature && coastline.features[edge.line].use != FeatureUse::Region) lines.insert(edge.line);
    }
    for (const auto& key : areas) area_[key] = add(key.second);
    for (const std::size_t feature : lines) line_[feature] = add(feature);
    for (std::size_t f = 0; f < coastline.features.size(); ++f)
      if (coastline.features[f].use == FeatureUse::Region) line_[f] = add(f);
  }

  std::int64_t area(std::size_t domain, RegionId side) const {
    return side < 0 ? 0 : area_.at({domain, static_cast<std::size_t>(side)});
  }
  std::int64_t line(std::size_t feature) const { return feature == kNoFeature ? 0 : line_.at(feature); }
  const std::vector<std::size_t>& features() const { return features_; }  // one a number, from 1

 private:
  std::int64_t add(std::size_t feature) {
    features_.push_back(feature);
    return static_cast<std::int64_t>(features_.size());
  }

  std::map<std::pair<std::size_t, std::size_t>, std::int64_t> area_;
  std::map<std::size_t, std::int64_t> line_;
  std::vector<std::size_t> features_;
};

// -1 outside, or if the feature has no number.
std::int64_t fidOf(RegionId region, const Coastline& coastline) {
  return region < 0 ? -1 : coastline.features[static_cast<std::size_t>(region)].fid;
}

VectorLayer pslgLayer(const std::vector<PslgEdge>& edges, const Numbers& numbers, const Coastline& coastline,
                      bool with_types) {
  VectorLayer layer{kPslgLayer, VectorLayer::Kind::Lines, {{"kind", std::string()}}, {}};
  for (const char* name : {"region", "left_fid", "right_fid", "left_id", "right_id", "line_id", "first", "last"})
    layer.fields.emplace_back(name, std::int64_t{});
  const bool with_names = std::ranges::any_of(edges, [](const PslgEdge& edge) { return !edge.boundary.name.empty(); });
  if (with_types) layer.fields.emplace_back(kBoundaryField, std::string());
  if (with_names) layer.fields.emplace_back(kBoundaryNameField, std::string());
  for (const PslgEdge& edge : edges) {
    layer.shapes.push_back(
        {{edge.a, edge.b},
         {std::string(edge.kind), static_cast<std::int64_t>(edge.domain), fidOf(edge.left, coastline),
          fidOf(edge.right, coastline), numbers.area(edge.domain, edge.left), numbers.area(edge.domain, edge.right),
          numbers.line(edge.line), std::int64_t{edge.first}, std::int64_t{edge.last}}});
    if (with_types) layer.shapes.back().values.emplace_back(edge.boundary.text);
    if (with_names) layer.shapes.back().values.emplace_back(edge.boundary.name);
  }
  return layer;
}

VectorLayer featureLayer(const Numbers& numbers, const Coastline& coastline) {
  VectorLayer layer{kFeatureLayer,
                    VectorLayer::Kind::Table,
                    {{"id", std::int64_t{}}, {"fid_of_feature", std::int64_t{}}, {"source", std::string()}},
                    {}};
  std::int64_t id = 0;
  for (const std::size_t f : numbers.features()) {
    const Feature& feature = coastline.features[f];
    layer.shapes.push_back({{}, {++id, feature.fid, feature.source}});
  }
  return layer;
}

VectorLayer attributeLayer(const Numbers& numbers, const Coastline& coastline) {
  VectorLayer layer{kAttributeLayer,
                    VectorLayer::Kind::Table,
                    {{"feature_id", std::int64_t{}}, {"name", std::string()}, {"value", std::string()}},
                    {}};
  std::int64_t id = 0;
  for (const std::size_t f : numbers.features()) {
    ++id;
    const Feature& feature = coastline.features[f];
    for (const auto& [name, value] : feature.attributes) {
      // A ring joined from several lines has the attributes of the first; only its name is kept.
      if (feature.from_lines && !isNameAttribute(name)) continue;
      layer.shapes.push_back({{}, {id, name, value}});
    }
  }
  return layer;
}

// Regions as given; their borders inside the domains are edges of the graph.
VectorLayer regionLayer(const Numbers& numbers, const Coastline& coastline) {
  VectorLayer layer{kRegionLayer, VectorLayer::Kind::Polygons, {{"feature_id", std::int64_t{}}}, {}};
  for (std::size_t i = 0; i < numbers.features().size(); ++i) {
    const Feature& feature = coastline.features[numbers.features()[i]];
    if (feature.use != FeatureUse::Region) continue;
    for (const Polygon& polygon : feature.polygons)
      layer.shapes.push_back({polygon.outer, {static_cast<std::int64_t>(i) + 1}, polygon.holes});
  }
  return layer;
}

// Requested vertices that are on no edge.
VectorLayer vertexLayer(const std::vector<Domain>& domains) {
  VectorLayer layer{
      kVertexLayer, VectorLayer::Kind::Points, {{"region", std::int64_t{}}, {"number", std::int64_t{}}}, {}};
  for (std::size_t d = 0; d < domains.size(); ++d) {
    const Domain& domain = domains[d];
    std::vector<char> used(domain.pslg.points.size(), 0);
    for (const Segment& s : domain.pslg.segments) used[s.a] = used[s.b] = 1;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (!used[v])
        layer.shapes.push_back(
            {{domain.input_points[v]}, {static_cast<std::int64_t>(d), static_cast<std::int64_t>(v)}});
    }
  }
  std::ranges::sort(layer.shapes, [](const VectorShape& a, const VectorShape& b) {
    return lexLess(a.points.front(), b.points.front());
  });
  return layer;
}

}  // namespace

VectorLayer editLayer(std::span<const Edit> edits, const std::function<std::string(std::uint32_t)>& source_of,
                      const ReadReport& read) {
  const auto less = [](const EarlierEdit& a, const EarlierEdit& b) {
    return std::tie(a.kind, a.place.x, a.place.y, a.fid, a.source) <
           std::tie(b.kind, b.place.x, b.place.y, b.fid, b.source);
  };
  std::vector<EarlierEdit> before = read.edits, now, all;
  for (const Edit& edit : edits) {
    // These change nothing; those in a cleaned file were reported when it was cleaned.
    if (read.cleaned && (edit.kind == EditKind::TouchingRing || edit.kind == EditKind::MisplacedRing)) continue;
    now.push_back({std::string(toString(edit.kind)), edit.place, edit.fid, source_of(edit.feature)});
  }
  std::ranges::sort(before, less);
  std::ranges::sort(now, less);
  std::ranges::set_union(before, now, std::back_inserter(all), less);
  VectorLayer layer{kEditLayer,
                    VectorLayer::Kind::Points,
                    {{"kind", std::string()}, {"fid_of_feature", std::int64_t{}}, {"source", std::string()}},
                    {}};
  for (const EarlierEdit& edit : all) layer.shapes.push_back({{edit.place}, {edit.kind, edit.fid, edit.source}});
  return layer;
}

std::vector<VectorLayer> cleanedLayers(const std::vector<Domain>& domains, const CleanReport& report,
                                       const Coastline& coastline, const ReadReport& read, const BoundaryTypes& types) {
  const std::vector<PslgEdge> edges = sortedEdges(domains, types);
  const Numbers numbers(edges, coastline);
  const auto source_of = [&coastline](std::uint32_t f) { return coastline.features[f].source; };
  std::vector<VectorLayer> layers{pslgLayer(edges, numbers, coastline, !types.empty()),
                                  editLayer(report.edits, source_of, read), featureLayer(numbers, coastline),
                                  attributeLayer(numbers, coastline)};
  for (VectorLayer& layer : std::vector{vertexLayer(domains), regionLayer(numbers, coastline)})
    if (!layer.shapes.empty()) layers.push_back(std::move(layer));
  return layers;
}

}  // namespace coastmesh
