#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "gis/clean/clean.hpp"
#include "tests/support/gis_shapes.hpp"
#include "tests/support/pslg_check.hpp"

namespace coastmesh {

struct Cleaned {
  Domain domain;
  CleanReport report;

  std::uint64_t count(EditKind kind) const { return report.counts[static_cast<std::size_t>(kind)]; }
  std::uint64_t edits() const { return report.edits.size(); }
  double area(RegionId region) const { return labelledArea(domain.pslg, region); }
  std::size_t points() const { return domain.pslg.points.size(); }
  std::size_t segments() const { return domain.pslg.segments.size(); }
};

inline Cleaned cleanInPlane(const std::vector<Feature>& features, CleanOptions options = {.snap_m = 0}) {
  const Coastline coastline = coastlineOf(features);
  Cleaned cleaned;
  cleaned.domain = cleanFeatures(coastline, allMembers(coastline), Projection::plane(), options, cleaned.report);
  EXPECT_EQ(defectOfLabelled(cleaned.domain.pslg), "");
  EXPECT_EQ(cleaned.domain.pslg.points.size(), cleaned.domain.input_points.size());
  return cleaned;
}

}  // namespace coastmesh
