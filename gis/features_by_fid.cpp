#include "gis/features_by_fid.hpp"

#include <algorithm>
#include <cmath>

namespace coastmesh {

void addFeatures(const std::vector<double>& fids, Grid& grid) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  if (fids.empty() || !std::ranges::all_of(fids, [](double fid) { return std::abs(fid) <= kExact; })) return;
  std::vector<double> known = fids;
  std::ranges::sort(known);
  const auto repeated = std::ranges::unique(known);
  known.erase(repeated.begin(), repeated.end());
  for (const double fid : known) grid.features.push_back({std::llround(fid), {}, {}});
  for (const double fid : fids)
    grid.feature_of.push_back(static_cast<std::uint32_t>(std::ranges::lower_bound(known, fid) - known.begin()));
}

}  // namespace coastmesh
