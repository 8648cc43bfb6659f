#pragma once

#include <optional>
#include <string>

#include "core/point.hpp"
#include "core/space_point.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// What stands behind a Projection.
struct ProjectionMap {
  virtual ~ProjectionMap() = default;
  virtual Point forward(const Point& input) const = 0;
  virtual Point inverse(const Point& plane) const = 0;
  virtual double scaleAt(const Point& plane) const = 0;
  virtual std::optional<Point> infinity() const { return std::nullopt; }
  virtual Surface surface() const { return {}; }
  virtual SpacePoint spaceAt(const Point& plane) const { return {plane.x, plane.y, 0.0}; }
  virtual bool isIdentity() const { return false; }
  virtual bool mayTear() const { return false; }
  std::string description, reason;
};

}  // namespace coastmesh
