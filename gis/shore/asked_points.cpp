#include "gis/shore/asked_points.hpp"

#include <algorithm>
#include <unordered_set>

namespace coastmesh {

AskedPoints::AskedPoints(const std::vector<VertexId>& asked, const std::vector<Point>& points) : sources_(asked) {
  std::ranges::sort(sources_);
  const auto repeated = std::ranges::unique(sources_);
  sources_.erase(repeated.begin(), repeated.end());
  for (const VertexId v : sources_) at_.push_back(points[v]);
}

std::vector<AskedPoint> AskedPoints::missingFrom(const std::vector<VertexId>& sources) const {
  std::vector<AskedPoint> missing;
  if (sources_.empty()) return missing;
  const std::unordered_set<VertexId> present(sources.begin(), sources.end());
  for (std::size_t i = 0; i < sources_.size(); ++i)
    if (!present.contains(sources_[i])) missing.push_back({sources_[i], at_[i]});
  return missing;
}

}  // namespace coastmesh
