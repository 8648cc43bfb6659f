#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/point.hpp"
#include "gis/crs/lon_lat.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {

// A map of the whole Earth, or of its visible half, in units of its radius: x to the right, y up, the middle at 0.
// Places are unit vectors that `see` has turned to the view; lines and outlines come in short steps.
class GlobeChart {
 public:
  using Triangles = std::vector<std::array<Point, 3>>;
  using Lines = std::vector<std::array<Point, 2>>;

  virtual ~GlobeChart() = default;

  virtual Point half() const = 0;                  // how far the map reaches from its middle
  virtual std::vector<Point> outline() const = 0;  // of everything that it shows
  virtual std::string caption() const = 0;         // for people
  virtual SphereVector see(const SphereVector& place) const = 0;

  // Adds what the map shows of an area within a counter-clockwise outline, as triangles; of a line.
  virtual void addArea(const std::vector<SphereVector>& outline, Triangles& triangles) const = 0;
  virtual void addLine(const std::vector<SphereVector>& line, Lines& lines) const = 0;
  // Drawn length of a short line, and the share of a line's width that is drawn there.
  virtual double lengthOf(const SphereVector& a, const SphereVector& b) const = 0;
  virtual double widthAt(const SphereVector& a, const SphereVector& b) const = 0;
};

// Half of the Earth, seen from far above a place.
std::unique_ptr<GlobeChart> orthographicChart(const LonLat& above);
// The whole Earth: the Natural Earth projection (Šavrič, Patterson and Jenny 2011), cut opposite its middle meridian.
std::unique_ptr<GlobeChart> naturalEarthChart(double middle_longitude);

}  // namespace coastmesh
