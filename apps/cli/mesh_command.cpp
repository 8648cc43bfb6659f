#include <algorithm>
#include <memory>
#include <string>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_run.hpp"
#include "apps/cli/per_feature_run.hpp"
#include "apps/cli/shard_file.hpp"
#include "gis/error.hpp"
#include "gis/fields/field_source.hpp"
#include "gis/fields/sponge_fields.hpp"
#include "gis/format/grid_io.hpp"

namespace coastmesh {

namespace {

OptionTable declareOptions(MeshRunUsage& usage) {
  OptionTable table = commandOptions("mesh", "Mesh the polygons and closed lines of vector files, or a .poly");
  table.arguments(kInputs, usage.mesh.job.input.files,
                  "vector files that GDAL reads ('-': standard input), or one .poly; optional with --domain globe",
                  [usage = &usage.mesh.job.input] { return usage->frame.side == DomainSide::Globe; });
  declareMeshes(table, usage, true);
  declareMeshOptions(table, usage.mesh);
  table.option("--mark-pieces")
      .needs(
          [&usage] {
            return std::ranges::any_of(withoutShardFiles(usage.outputs), [&usage](const std::string& path) {
              return gridFormatFor(path, usage.format).name == "ugrid";
            });
          },
          "without an output that is UGRID (.nc)");
  table.section(Section::Output);
  table.text({"--shard", "Share of the features"}, usage.shard, "I/N",
             "mesh only the I-th of N shares of about equal work; features that touch stay together, and every run has "
             "the same shares. gather combines .shard outputs");
  declarePerFeature(table, usage);
  declareRunOutputs(table, usage);
  table.section(Section::Run);
  table.text({"--checkpoint", "Checkpoint"}, usage.checkpoint, "DIR",
             "save finished work in this folder, after each round; if the run is killed, the same command resumes from "
             "there and makes the same bytes; the folder is removed when the run is complete");
  table.example("coastmesh mesh lake.geojson -o lake.gpkg -o lake.nc", "a lake as GIS layers and as a UGRID grid");
  table.example("coastmesh mesh sea.shp -o fort.14 --min-angle 35 --size-max 5000",
                "a sea for ADCIRC: angles of 35 degrees and more, no edge longer than 5 km");
  table.example("coastmesh mesh lakes.gpkg -o lakes.msh --min-island-area 10000 --report lakes.json",
                "many lakes for programs that read Gmsh, islands below a hectare filled, with a JSON report");
  table.example("coastmesh mesh --domain globe --size 200000 -o globe.nc", "the whole Earth, closed");
  table.example("coastmesh mesh lakes.gpkg --shard 3/7 -o lakes-3.shard --skip-existing",
                "the third of seven shares of many lakes, for coastmesh gather");
  table.example("coastmesh mesh sea.shp -o sea.nc --size-max 500 --checkpoint sea.kept",
                "a mesh that takes hours; after a kill the same command resumes");
  table.example("coastmesh mesh lakes.gpkg --per-feature -o lake-{}.nc --skip-existing",
                "a file for each lake; the same command again makes what is missing");
  return table;
}

// Throws OptionError for one attribute of a sponge without the other, which the files of FVCOM need.
void requireWholeSponge(const MeshRunUsage& usage) {
  const auto isGiven = [&](const char* name) {
    return std::ranges::find(usage.mesh.job.finish.fields, name, &FieldSource::name) !=
           usage.mesh.job.finish.fields.end();
  };
  const auto given = std::ranges::find_if(kSpongeFields, isGiven),
             missing = std::ranges::find_if_not(kSpongeFields, isGiven);
  if (given == kSpongeFields.end() || missing == kSpongeFields.end()) return;
  for (const std::string& path : withoutShardFiles(usage.outputs))
    if (gridFormatFor(path, usage.format).name == "fvcom")
      throw OptionError(std::string("--attribute ") + *given + ": the sponge in '" + path + "' needs " + *missing +
                        " too; give --attribute " + *missing + "=VALUE");
}

}  // namespace

Command declareMesh(CLI::App& root) {
  auto usage = std::make_shared<MeshRunUsage>();
  return {{root, declareOptions(*usage)}, [usage](Run& run) {
            settle(usage->mesh);
            requireWholeSponge(*usage);
            requireShardOfThisRank(usage->shard, run);
            return usage->per_feature ? runPerFeature(*usage, run) : runMesh(*usage, run);
          }};
}

}  // namespace coastmesh
