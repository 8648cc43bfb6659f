#include "apps/usage/rivers_usage.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "apps/usage/finish_usage.hpp"
#include "apps/usage/grid_usage.hpp"
#include "apps/usage/target_usage.hpp"

namespace coastmesh {

void declareRiversOptions(OptionTable& table, RiversUsage& usage) {
  declareAssumedCrs(table, usage.mesh.crs);
  RiverColumns& columns = usage.job.columns;
  table.text({"--width-column", "Column of widths"}, columns.width, "NAME", "attribute with the width in metres");
  table.text({"--depth-column", "Column of depths"}, columns.depth, "NAME",
             "attribute with the depth of the bed in metres below the zero of depths, if there is one");
  table.text({"--name-column", "Column of names"}, columns.name, "NAME", "attribute with the name, if there is one");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  table.number({"--width", "Usual width"}, usage.width_m, "M", {0.0, kInfinity, true},
               "width of lines that have none in that column");
  table.texts(
      {"--banks", "Banks"}, usage.job.banks, kVectorFile, false,
      "polygons of the rivers' water: where lines run in them, rivers are as wide as these, and in their middle; "
      "elsewhere they have the width of their column, or of --width, or that where they leave the polygons; can "
      "be repeated");
  table.section(Section::Domain);
  RiverOptions& rivers = usage.job.rivers;
  table.choice(
      {"--extent", "Extent of the rows"}, "outside", {"outside", "all"},
      [&rivers](const std::string& chosen) {
        rivers.extent = chosen == "all" ? RiverExtent::All : RiverExtent::Outside;
      },
      "which parts of rivers get rows: outside: where MESH has no water, and one row into it; all: in its water too, "
      "as in a flood plain or for a dredged channel");
  table.number(
      {"--reach", "Reach of ends"}, rivers.reach_m, "M", {0.0, kInfinity},
      "rivers that end this close to the water of MESH are continued to it; default: their width, or three times "
      "that, or an edge of the shore, if they are mouths");
  table.section(Section::Triangles);
  table.integer({"--elements", "Elements across"}, usage.elements, "N", 1, 1000,
                "quadrilaterals across each river, at least");
  table.number({"--max-cell-width", "Maximum width of quadrilaterals"}, rivers.most_cell_width_m, "M",
               {0.0, kInfinity, true}, "wider rivers get more quadrilaterals across");
  table.number({"--aspect", "Length over width"}, rivers.aspect, "A", {0.25, 50.0},
               "length of a quadrilateral along the river over its width; in bends they are shorter");
  MergeOptions& merge = usage.job.merge;
  RefineOptions& refine = merge.mesh.refine;
  table.number({"--min-angle", "Minimum angle"}, refine.min_angle_deg, "DEG", {0.0, 45.0},
               "minimum angle of the new triangles, at junctions and beside rivers");
  table.number({"--max-angle", "Maximum angle"}, refine.max_angle_deg, "DEG", {60.0, 180.0},
               "maximum angle of the new triangles; 180: no limit");
  table.section(Section::Sizes);
  table.number({"--grade", "Gradation of sizes"}, merge.gradation, "G", {0.0, 1.0, true},
               "beside rivers, sizes at two places differ by at most this times their distance: a smaller number "
               "replaces more triangles of MESH");
  declareDepths(table, merge.depth,
                "raster with the depths of new nodes; can be repeated, the first with a value at a node is used; a "
                "river's own depth takes precedence, unless MESH is deeper there. Without either, depths are those of "
                "MESH there, or of the nodes "
                "around");
  declareTargets(table, usage.job.finish.targets,
                 "repair what the model would reject, in all of the mesh, and report each repair; can be repeated");
}

void settle(RiversUsage& usage) {
  if (std::isfinite(usage.width_m)) usage.job.width_m = usage.width_m;
  usage.job.rivers.cells = usage.elements;
}

}  // namespace coastmesh
