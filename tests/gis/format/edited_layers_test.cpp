// Layers of a mesh of which some were edited in a GIS, and others not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <functional>
#include <memory>

#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A square of two triangles, from the origin to 100, 100, with depths 1.5, 2.5, …
class LayersEditedApart : public ::testing::TestWithParam<const char*> {
 protected:
  LayersEditedApart() {
    Grid grid;
    grid.nodes = {{0, 0}, {100, 0}, {100, 100}, {0, 100}};
    grid.z = {-1.5, -2.5, -3.5, -4.5};
    grid.triangles = {{0, 1, 2}, {0, 2, 3}};
    grid.min_angle_deg = {45.0, 45.0};
    grid.area_m2 = {5000.0, 5000.0};
    findMissingBoundaries(grid);
    path_ = folder_ / (std::string("m") + GetParam());
    StagedOutput output(path_, gridFormatFor(path_, ""), false);
    output.write(grid);
    output.commit();
  }

  void change(const std::string& name, const std::function<void(OGRLayer&)>& change) const {
    registerDrivers();
    const bool in_one = path_.ends_with(".gpkg");
    const std::string file = in_one || name == "triangles" ? path_ : folder_ / ("m_" + name + GetParam());
    const std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> dataset(
        GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE),
        [](GDALDataset* opened) { GDALClose(opened); });
    ASSERT_TRUE(dataset);
    OGRLayer* const layer = in_one ? dataset->GetLayerByName(name.c_str()) : dataset->GetLayer(0);
    ASSERT_TRUE(layer != nullptr);
    change(*layer);
  }

  // Does `edit` to each feature of a layer, and writes what it returns true for.
  void edit(const std::string& name, const std::function<bool(OGRFeature&)>& edit) const {
    change(name, [&](OGRLayer& layer) {
      std::vector<OGRFeatureUniquePtr> edited;
      for (const auto& feature : layer) {
        OGRFeatureUniquePtr copy(feature->Clone());
        if (edit(*copy)) edited.push_back(std::move(copy));
      }
      ASSERT_FALSE(edited.empty());
      for (const auto& feature : edited) ASSERT_EQ(layer.SetFeature(feature.get()), OGRERR_NONE);
    });
  }

  // Moves the corner at 100, 100 to 120, 130 wherever it is in the geometry of a layer.
  void moveCornerIn(const std::string& name) const {
    edit(name, [](OGRFeature& feature) {
      OGRGeometry& geometry = *feature.GetGeometryRef();
      bool moved = false;
      const auto move = [&](auto& points) {
        for (int i = 0; i < points.getNumPoints(); ++i) {
          if (points.getX(i) != 100.0 || points.getY(i) != 100.0) continue;
          points.setPoint(i, 120.0, 130.0);
          moved = true;
        }
      };
      if (wkbFlatten(geometry.getGeometryType()) == wkbPolygon) {
        move(*geometry.toPolygon()->getExteriorRing());
      } else if (wkbFlatten(geometry.getGeometryType()) == wkbLineString) {
        move(*geometry.toLineString());
      } else if (OGRPoint& point = *geometry.toPoint(); point.getX() == 100.0 && point.getY() == 100.0) {
        point.setX(120.0);
        point.setY(130.0);
        moved = true;
      }
      return moved;
    });
  }

  testing::TemporaryFolder folder_;
  std::string path_;
};

TEST_P(LayersEditedApart, SayNothingAsTheyWereWritten) {
  const Grid grid = readGrid(path_);
  EXPECT_THAT(grid.notes, IsEmpty());
  EXPECT_THAT(grid.z, ElementsAre(-1.5, -2.5, -3.5, -4.5));
}

// As a field calculator does it.
TEST_P(LayersEditedApart, DepthsOfTheColumnCount) {
  edit("nodes", [](OGRFeature& node) {
    const auto id = node.GetFieldAsInteger64("id");
    if (id == 2) node.SetField("z", -7.0);
    if (id == 4) node.SetFieldNull(node.GetFieldIndex("z"));
    return id == 2 || id == 4;
  });
  const Grid grid = readGrid(path_);
  ASSERT_EQ(grid.z.size(), 4u);
  EXPECT_EQ(grid.z[0], -1.5);
  EXPECT_EQ(grid.z[1], -7.0);
  EXPECT_TRUE(std::isnan(grid.z[3]));
  EXPECT_THAT(grid.notes, ElementsAre(HasSubstr("2 nodes have other depths in the column z than their points have, the "
                                                "first node 2 (-7, its point -2.5): the column counts")));
}

TEST_P(LayersEditedApart, DifferencesOfRoundingAreNone) {
  edit("nodes", [](OGRFeature& node) {
    node.SetField("z", static_cast<double>(static_cast<float>(node.GetFieldAsDouble("z") * (1.0 + 1e-8))));
    return true;
  });
  const Grid grid = readGrid(path_);
  EXPECT_THAT(grid.notes, IsEmpty());
  EXPECT_THAT(grid.z, ElementsAre(-1.5, -2.5, -3.5, -4.5));
}

TEST_P(LayersEditedApart, DepthsOfPointsCountWithoutAColumn) {
  edit("nodes", [](OGRFeature& node) {
    node.SetFieldNull(node.GetFieldIndex("z"));
    node.GetGeometryRef()->toPoint()->setZ(-9.0);
    return true;
  });
  const Grid grid = readGrid(path_);
  EXPECT_THAT(grid.notes, IsEmpty());
  EXPECT_THAT(grid.z, ElementsAre(-9.0, -9.0, -9.0, -9.0));
}

TEST_P(LayersEditedApart, ACornerMovedInOneLayerIsNoted) {
  moveCornerIn("nodes");
  const Grid grid = readGrid(path_);
  ASSERT_EQ(grid.nodes.size(), 5u);
  EXPECT_TRUE(std::isnan(grid.z[4]));
  EXPECT_THAT(grid.notes,
              ElementsAre(AllOf(HasSubstr("1 corner of triangles is at no point of the layer of nodes, at 100, 100"),
                                HasSubstr("1 node of that layer is no corner, node 3: "))));
}

// Columns of angles and areas are of the time before the edit.
TEST_P(LayersEditedApart, TrianglesWithACornerMovedAreMeasuredAnew) {
  moveCornerIn("triangles");
  moveCornerIn("boundaries");
  const Grid grid = readGrid(path_);
  ASSERT_EQ(grid.notes.size(), 1u);
  EXPECT_THAT(grid.notes[0], HasSubstr("at 120, 130"));
  ASSERT_EQ(grid.area_m2.size(), 2u);
  EXPECT_NEAR(grid.area_m2[0], 100.0 * 130.0 / 2, 1e-6);
  EXPECT_NEAR(grid.area_m2[1], 100.0 * 120.0 / 2, 1e-6);
  EXPECT_NEAR(grid.min_angle_deg[0], 33.96, 0.01);
  EXPECT_NEAR(grid.min_angle_deg[1], 33.25, 0.01);
}

TEST_P(LayersEditedApart, ACornerMovedInAllLayersIsMoved) {
  for (const char* const layer : {"triangles", "nodes", "boundaries"}) moveCornerIn(layer);
  const Grid grid = readGrid(path_);
  EXPECT_THAT(grid.notes, IsEmpty());
  EXPECT_EQ(grid.nodes[2], (Point{120, 130}));
  EXPECT_EQ(grid.z.size(), 4u);
}

TEST_P(LayersEditedApart, BoundariesOffTheOutlineAreNoted) {
  change("triangles", [](OGRLayer& triangles) {
    GIntBig last = OGRNullFID;
    for (const auto& triangle : triangles) last = triangle->GetFID();
    ASSERT_EQ(triangles.DeleteFeature(last), OGRERR_NONE);
  });
  const Grid grid = readGrid(path_);
  ASSERT_EQ(grid.triangles.size(), 1u);
  ASSERT_EQ(grid.boundaries.size(), 1u);
  EXPECT_THAT(grid.notes, ElementsAre(HasSubstr("2 edges of boundaries are not on the outline of the triangles, the "
                                                "first at 100, 100")));
}

TEST_P(LayersEditedApart, CutTrianglesAreRefusedAsSuch) {
  edit("triangles", [](OGRFeature& triangle) {
    OGRLinearRing& ring = *triangle.GetGeometryRef()->toPolygon()->getExteriorRing();
    if (triangle.GetFieldAsInteger64("id") != 1) return false;
    ring.empty();
    for (const Point& p : {Point{0, 0}, {90, 0}, {90, 90}, {50, 50}, {0, 0}}) ring.addPoint(p.x, p.y);
    return true;
  });
  try {
    readGrid(path_);
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("its outline has 4 points"), HasSubstr("only whole triangles")));
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, LayersEditedApart, ::testing::Values(".gpkg", ".shp"),
                         [](const auto& instance) { return std::string(instance.param).substr(1); });

}  // namespace
}  // namespace coastmesh
