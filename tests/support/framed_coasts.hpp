#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gis/clean/clean.hpp"
#include "gis/coast/frame.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {

// For tests of frames: coasts cut off by a frame, and then cleaned group by group.
struct Framed {
  Coastline coastline;
  std::vector<Domain> domains;
  CleanReport report;
  FrameReport frame;

  double area() const;
  double openLength() const;  // in the plane
};
Framed frame(Coastline coastline, const FrameOptions& options, const CleanOptions& cleaning = {.snap_m = 0.0});
// The message of `frame`, or "not refused".
std::string refusalOf(Coastline coastline, const FrameOptions& options);

FrameOptions boxOf(double west, double south, double east, double north, DomainSide side = DomainSide::Auto);

// A polygon as a frame.
Feature frameFeature(std::int64_t fid, Ring ring);

}  // namespace coastmesh
