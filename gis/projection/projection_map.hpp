#pragma once

#include <optional>
#include <string>

#include "core/point.hpp"

namespace coastmesh {

// What stands behind a Projection.
struct ProjectionMap {
  virtual ~ProjectionMap() = default;
  virtual Point forward(const Point& input) const = 0;
  virtual Point inverse(const Point& plane) const = 0;
  virtual double scaleAt(const Point& plane) const = 0;
  virtual std::optional<Point> infinity() const { return std::nullopt; }
  virtual bool isIdentity() const { return false; }
  virtual bool mayTear() const { return false; }
  std::string description, reason;
};

}  // namespace coastmesh
