#include "gis/size/rule_of_tiles.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "gis/coast/feature_names.hpp"
#include "gis/error.hpp"
#include "gis/size/size_depth.hpp"

namespace coastmesh {

namespace {

TileRule rawRule() {
  return {
      0.0,
      [](const RasterTile& tile, std::span<float> sizes) {
        for (int y = 0; y < tile.height; ++y) {
          for (int x = 0; x < tile.width; ++x) {
            const float size = tile.at(x, y);
            if (std::isnan(size)) continue;
            if (!(size > 0.0F)) {
              throw InputError(sourceInWords(tile.file) + ": holds the size " + std::to_string(size) +
                               ", but sizes are lengths in metres, above 0; mark pixels without one as no data");
            }
            sizes[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width) + static_cast<std::size_t>(x)] =
                size;
          }
        }
      },
      true};
}

// The smallest size wherever the raster has a value: smaller than any pixel, so that a tile keeps them apart.
TileRule knownRule() {
  constexpr float kLeast = std::numeric_limits<float>::min();
  return {
      0.0, [](const RasterTile& tile, std::span<float> sizes) {
        for (int y = 0; y < tile.height; ++y)
          for (int x = 0; x < tile.width; ++x)
            if (!std::isnan(tile.at(x, y)))
              sizes[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width) + static_cast<std::size_t>(x)] =
                  kLeast;
      }};
}

}  // namespace

TileRule tileRuleOf(const SizeRule& rule) {
  switch (rule.kind) {
    case SizeRule::Kind::Depths:
      return depthRule(rule.depths);
    case SizeRule::Kind::Step:
      return courantRule(rule.time_step_s, rule.courant, rule.depths);
    case SizeRule::Kind::Known:
      return knownRule();
    default:
      return rawRule();
  }
}

}  // namespace coastmesh
