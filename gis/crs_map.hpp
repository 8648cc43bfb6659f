#pragma once

#include <ogr_spatialref.h>

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "core/point.hpp"
#include "gis/crs.hpp"

namespace coastmesh {

// PROJ's transformation from one CRS to another, usable from several threads at once (PROJ's own objects are not): a
// thread takes one that lies idle or makes another. Private to gis.
class CrsMap {
 public:
  // Throws InputError where PROJ knows no way.
  CrsMap(const OGRSpatialReference& from, const OGRSpatialReference& to);

  Point forward(const Point& p) const;  // not finite where `p` has no image
  Point inverse(const Point& p) const;

 private:
  using Transformation = std::unique_ptr<OGRCoordinateTransformation>;
  struct Pair {
    Transformation forward, inverse;
  };
  // Threads spread over shelves, so that they seldom meet at a lock.
  struct Shelf {
    std::mutex mutex;
    std::vector<Pair> idle;
  };

  Pair take() const;
  void giveBack(Pair pair) const;
  Shelf& shelfOfThread() const;

  Transformation first_;
  mutable std::mutex first_mutex_;  // cloning is not const inside
  mutable std::array<Shelf, 16> shelves_;
};

// The geographic CRS under a projected one. REQUIRES: !crs.isPlane(). Throws InputError where there is none.
OGRSpatialReference geographicBase(const Crs& crs);

}  // namespace coastmesh
