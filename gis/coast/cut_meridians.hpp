#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace coastmesh {

// Meridians along which data in degrees may be cut. Longitudes a full turn apart are one cut, as is -180 with 180.
class CutMeridians {
 public:
  CutMeridians() = default;
  // REQUIRES: the longitudes are finite.
  explicit CutMeridians(std::vector<double> longitudes);

  std::size_t count() const { return count_; }
  // Number of the cut at `longitude`, or a full turn from it.
  std::optional<std::size_t> at(double longitude) const;

 private:
  struct Meridian {
    double longitude;
    std::size_t cut;
  };

  std::vector<Meridian> meridians_;  // by longitude
  std::size_t count_ = 0;
};

}  // namespace coastmesh
