#pragma once

#include <optional>
#include <string>

#include "core/point.hpp"
#include "core/space_point.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// One item of `GroundPlaces`.
struct GroundPlace {
  Point input;
  SpacePoint space;
  double measure;
};

// The implementation of a Projection.
struct ProjectionMap {
  virtual ~ProjectionMap() = default;
  virtual Point forward(const Point& input) const = 0;
  virtual Point inverse(const Point& plane) const = 0;
  virtual double scaleAt(const Point& plane) const = 0;
  virtual std::optional<Point> infinity() const { return std::nullopt; }
  virtual Surface surface() const { return {}; }
  virtual GroundPlace groundAt(const Point& plane) const {
    return {inverse(plane), {plane.x, plane.y, 0.0}, scaleAt(plane)};
  }
  virtual double smoothOver() const { return 0.0; }
  virtual bool isIdentity() const { return false; }
  virtual bool mayTear() const { return false; }
  std::string description, reason;
};

}  // namespace coastmesh
