#include "tests/support/framed_coasts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/group_features.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/error.hpp"
#include "tests/support/pslg_check.hpp"

namespace coastmesh {

double Framed::area() const {
  double sum = 0;
  for (const Domain& domain : domains) sum += geodesicArea(domain, coastline.crs);
  return sum;
}

double Framed::openLength() const {
  double sum = 0;
  for (const Domain& domain : domains) {
    for (const Segment& s : domain.pslg.segments) {
      const Point &a = domain.pslg.points[s.a], &b = domain.pslg.points[s.b];
      if (s.tag == kOpenTag) sum += std::hypot(b.x - a.x, b.y - a.y);
    }
  }
  return sum;
}

Framed frame(Coastline coastline, const FrameOptions& options, const CleanOptions& cleaning) {
  Framed result;
  result.frame = frameCoastline(coastline, options);
  result.coastline = std::move(coastline);
  for (const auto& members : groupFeatures(result.coastline)) {
    const Projection projection = Projection::fitted(result.coastline, members);
    try {
      result.domains.push_back(cleanFeatures(result.coastline, members, projection, cleaning, result.report));
      EXPECT_EQ(defectOfLabelled(result.domains.back().pslg), "");
    } catch (const NothingWanted&) {
    }
  }
  return result;
}

std::string refusalOf(Coastline coastline, const FrameOptions& options) {
  try {
    frame(std::move(coastline), options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

FrameOptions boxOf(double west, double south, double east, double north, DomainSide side) {
  FrameOptions options;
  options.side = side;
  options.box = Box{west, south, east, north};
  return options;
}

Feature frameFeature(std::int64_t fid, Ring ring) {
  Feature feature = polygonFeature(fid, std::move(ring));
  feature.use = FeatureUse::Frame;
  return feature;
}

}  // namespace coastmesh
