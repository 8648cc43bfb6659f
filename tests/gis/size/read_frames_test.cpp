// Rasters read by several readers: the result is that of one reader, and each reads only its own parts.
#include "gis/size/read_frames.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "gis/crs/crs.hpp"
#include "gis/model/depth.hpp"
#include "gis/raster/raster_mosaic.hpp"
#include "gis/raster/raster_parts.hpp"
#include "gis/size/rule_of_tiles.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/rasters.hpp"

namespace coastmesh {
namespace {

using testing::TemporaryFolder;

constexpr int kColumns = 2048, kRows = 1024;

struct Piece {
  PixelRect from, to;
};

// A VRT of pieces of one file, around the whole Earth.
std::string mosaicFile(const TemporaryFolder& folder, const std::vector<Piece>& pieces) {
  const std::string path = folder / "whole.tif", vrt = folder / "pieces.vrt";
  testing::writeRaster(path, "EPSG:4326", {kColumns, kRows, -180.0, 90.0, 360.0 / kColumns}, [](double x, double y) {
    return x > 100.0 && y > 80.0 ? testing::kNoValue
                                 : -300.0 - 200.0 * std::sin(0.1 * x) * std::cos(0.2 * y) - 10.0 * std::sin(3.0 * x);
  });
  std::ofstream text(vrt);
  text << "<VRTDataset rasterXSize=\"" << kColumns << "\" rasterYSize=\"" << kRows
       << "\"><SRS>EPSG:4326</SRS><GeoTransform>-180, " << 360.0 / kColumns << ", 0, 90, 0, " << -360.0 / kColumns
       << "</GeoTransform><VRTRasterBand dataType=\"Float64\" band=\"1\"><NoDataValue>" << testing::kNoValue
       << "</NoDataValue>";
  const auto put = [&](const char* name, const PixelRect& rect) {
    text << "<" << name << " xOff=\"" << rect.x << "\" yOff=\"" << rect.y << "\" xSize=\"" << rect.width
         << "\" ySize=\"" << rect.height << "\"/>";
  };
  for (const Piece& piece : pieces) {
    text << "<ComplexSource><SourceFilename>" << path << "</SourceFilename><SourceBand>1</SourceBand>";
    put("SrcRect", piece.from);
    put("DstRect", piece.to);
    text << "<NODATA>" << testing::kNoValue << "</NODATA></ComplexSource>";
  }
  text << "</VRTRasterBand></VRTDataset>";
  return vrt;
}

std::vector<Piece> eightPieces() {
  std::vector<Piece> pieces;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 4; ++i) {
      const PixelRect rect{i * 500, j * 500, i < 3 ? 500 : kColumns - 1500, j < 1 ? 500 : kRows - 500};
      pieces.push_back({rect, rect});
    }
  }
  return pieces;
}

bool holds(const PixelRect& all, const PixelRect& part) {
  const PixelRect both = all.in(part);
  return std::tuple(both.x, both.y, both.width, both.height) == std::tuple(part.x, part.y, part.width, part.height);
}

// Three readers in this process, which own the parts in turn; checks that each reads only its own.
struct ThreeReaders {
  explicit ThreeReaders(const RasterGeometry& raster) : geometry(raster), cuts(partsOf(raster)) {
    readers.pixels.ownersOf = [](std::span<const RasterPart> parts) {
      std::vector<int> owners;
      for (const RasterPart& part : parts) owners.push_back(ownerOf(part.number));
      return owners;
    };
    readers.pixels.read = [this](std::span<const PixelTask> tasks, std::span<const int> who, const ItemLoop&) {
      std::vector<PixelAnswer> answers;
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        for (const PixelRect& window : tasks[i].windows) look(window, who[i]);
        answers.push_back(answerTask(tasks[i]));
      }
      return answers;
    };
    readers.read = [this](std::span<const TileTask> tasks, std::span<const int> who, const ItemLoop&) {
      std::vector<TileAnswer> answers;
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        EXPECT_EQ(tasks[i].own.empty(), tasks[i].tiles.empty());
        for (const PixelRect& own : tasks[i].own) look(own, who[i]);
        for (const PixelRect& strip : tasks[i].strips) look(strip, who[i]);
        strips += tasks[i].strips.size();
        answers.push_back(answerTask(tasks[i]));
      }
      return answers;
    };
  }

  static int ownerOf(std::size_t number) { return static_cast<int>(number % 3); }
  void look(const PixelRect& rect, int reader) {
    EXPECT_TRUE(holds({0, 0, geometry.columns, geometry.rows}, rect));
    cuts.forEachCell(rect, [&](std::size_t cell) { EXPECT_EQ(ownerOf(ownedAs(geometry, cell)), reader); });
    asked.insert(reader);
  }

  RasterGeometry geometry;
  PixelCuts cuts;
  RasterReaders readers;
  std::set<int> asked;
  std::size_t strips = 0;
};

void expectSame(const FrameTiles& some, const FrameTiles& others) {
  ASSERT_EQ(some.size(), others.size());
  for (std::size_t rule = 0; rule < some.size(); ++rule) {
    ASSERT_EQ(some[rule].size(), others[rule].size());
    for (std::size_t frame = 0; frame < some[rule].size(); ++frame) {
      ASSERT_EQ(some[rule][frame].size(), others[rule][frame].size());
      for (std::size_t t = 0; t < some[rule][frame].size(); ++t) {
        const SizeTile &a = some[rule][frame][t], &b = others[rule][frame][t];
        ASSERT_EQ(a.size(), b.size()) << "tile " << t;
        ASSERT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(SizeNode)), 0) << "tile " << t;
      }
    }
  }
}

TEST(ReadFrames, SeveralReadersGiveWhatOneDoes) {
  const TemporaryFolder folder;
  const Crs wgs84 = parseCrs("EPSG:4326");
  for (const std::string& path : {mosaicFile(folder, eightPieces()), folder / "whole.tif"}) {
    const RasterGeometry raster = readRasterGeometry(path);
    EXPECT_TRUE(raster.wraps);
    const auto frame = std::make_shared<const RasterFrame>(raster, wgs84, Projection::plane(),
                                                           Box::of({-180.0, -90.0}, {180.0, 90.0}), inOrder);
    SizeRule depths{SizeRule::Kind::Depths, {}, 0.0, 0.0};
    depths.depths.wave_elements = 60.0;
    depths.depths.slope_elements = 20.0;
    const SizeRule step{SizeRule::Kind::Step, depths.depths, 10.0, 0.6};
    for (const double filter_m : {0.0, 3.0}) {  // in a plane whose unit is a degree
      depths.depths.slope_filter_m = filter_m;
      const std::vector<SizeRule> rules{depths, step};
      ThreeReaders three(raster);
      const FrameTiles by_three = readFrames(std::span(&frame, 1), rules, &three.readers, inOrder);
      expectSame(by_three, readFrames(std::span(&frame, 1), rules, nullptr, inOrder));
      EXPECT_EQ(three.asked.size() == 3, raster.mosaic != nullptr);
      EXPECT_EQ(three.strips > 0, raster.mosaic != nullptr);
    }
  }
}

// Each item of the loop opens the raster once.
TEST(ReadFrames, RastersOfManyFilesAndTextsAreOpenedAFewTimes) {
  const TemporaryFolder folder;
  std::vector<Piece> pieces;
  for (int y = 0; y < kRows; y += 128) {
    for (int x = 0; x < kColumns; x += 128) pieces.push_back({{x, y, 128, 128}, {x, y, 128, 128}});
  }
  const std::string text = folder / "text.asc";
  std::ofstream out(text);
  out << "ncols 1500\nnrows 1000\nxllcorner -180\nyllcorner -90\ncellsize 0.2\n";
  for (int row = 0; row < 1000; ++row)
    for (int column = 0; column < 1500; ++column) out << 100 + column << (column < 1499 ? ' ' : '\n');
  out.close();
  for (const auto& [path, most] : {std::pair{mosaicFile(folder, pieces), 16u}, {text, 1u}}) {
    const auto frame = std::make_shared<const RasterFrame>(readRasterGeometry(path), Crs{}, Projection::plane(),
                                                           Box{-180.0, -90.0, 180.0, 90.0}, inOrder);
    const TileRule rule = tileRuleOf({SizeRule::Kind::Known, {}, 0.0, 0.0});
    std::size_t opened = 0;
    const ItemLoop counting = [&](std::size_t count, const std::function<void(std::size_t)>& work) {
      opened += count;
      inOrder(count, work);
    };
    const FrameTiles tiles = readFrames(std::span(&frame, 1), std::span(&rule, 1), counting);
    EXPECT_GT(tiles.front().front().size(), 20u);
    EXPECT_LE(opened, most) << path;
  }
}

TEST(ReadFrames, DepthsOfNodesAreTheSame) {
  const TemporaryFolder folder;
  const std::string path = mosaicFile(folder, eightPieces());
  Grid grid;
  grid.crs = parseCrs("EPSG:4326");
  for (int k = 0; k < 20000; ++k)
    grid.nodes.push_back({-181.0 + 362.0 * std::fmod(k * 0.6180339887, 1.0), -90.0 + 180.0 * k / 20000.0});
  // Between the pieces, and at both ends of the raster.
  for (const double column : {0.0, 0.2, 500.0, 999.7, 1500.2, kColumns - 0.3})
    for (const double row : {0.1, 499.9, 500.3, kRows - 0.2})
      grid.nodes.push_back({-180.0 + column * 360.0 / kColumns, 90.0 - row * 360.0 / kColumns});
  DepthOptions options{{path}, DepthMethod::Bilinear};
  options.fill = DepthFill::None;
  Grid others = grid;
  setDepths(grid, options);
  ThreeReaders three(readRasterGeometry(path));
  options.readers = &three.readers.pixels;
  setDepths(others, options);
  EXPECT_EQ(three.asked.size(), 3u);
  ASSERT_EQ(grid.z.size(), others.z.size());
  EXPECT_EQ(std::memcmp(grid.z.data(), others.z.data(), grid.z.size() * sizeof(double)), 0);
  EXPECT_GT(std::count_if(grid.z.begin(), grid.z.end(), [](double z) { return !std::isnan(z); }), 15000);
}

TEST(RasterMosaic, IsOfFilesSideBySideOnly) {
  const TemporaryFolder folder;
  const auto mosaicOfPieces = [&](const std::vector<Piece>& pieces) {
    return readRasterGeometry(mosaicFile(folder, pieces)).mosaic;
  };
  const std::vector<Piece> pieces = eightPieces();
  const auto whole = mosaicOfPieces(pieces);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->cuts.columns, (std::vector<int>{0, 500, 1000, 1500, kColumns}));
  EXPECT_EQ(whole->cuts.rows, (std::vector<int>{0, 500, kRows}));
  EXPECT_EQ(whole->file_of, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));

  std::vector<Piece> with_hole = pieces;
  with_hole.erase(with_hole.begin() + 5);
  ASSERT_TRUE(mosaicOfPieces(with_hole));
  EXPECT_EQ(mosaicOfPieces(with_hole)->file_of[5], -1);

  std::vector<Piece> overlapping = pieces;
  ++overlapping[0].from.width;
  ++overlapping[0].to.width;
  EXPECT_FALSE(mosaicOfPieces(overlapping));
  std::vector<Piece> scaled = pieces;
  scaled[3].from.width /= 2;
  EXPECT_FALSE(mosaicOfPieces(scaled));
  EXPECT_FALSE(readRasterGeometry(folder / "whole.tif").mosaic);
}

}  // namespace
}  // namespace coastmesh
