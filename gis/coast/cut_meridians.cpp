#include "gis/coast/cut_meridians.hpp"

#include <algorithm>

namespace coastmesh {

namespace {

constexpr double kTurn = 360;    // degrees
constexpr double kSame = 1e-12;  // degrees: rounding of a longitude plus a turn

}  // namespace

CutMeridians::CutMeridians(std::vector<double> longitudes) {
  std::ranges::sort(longitudes);
  longitudes.erase(std::ranges::unique(longitudes).begin(), longitudes.end());
  for (const double longitude : longitudes) {
    const std::optional<std::size_t> known = at(longitude);
    meridians_.push_back({longitude, known ? *known : count_++});
  }
}

std::optional<std::size_t> CutMeridians::at(double longitude) const {
  for (const double turn : {0.0, -kTurn, kTurn}) {
    const auto found = std::ranges::lower_bound(meridians_, longitude + turn - kSame, {}, &Meridian::longitude);
    if (found != meridians_.end() && found->longitude <= longitude + turn + kSame) return found->cut;
  }
  return std::nullopt;
}

}  // namespace coastmesh
