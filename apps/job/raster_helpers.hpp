#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/run_control.hpp"
#include "gis/size/read_frames.hpp"
#include "parallel/deal.hpp"

namespace coastmesh {

// Rasters that this process and its helpers read: each part is read by only one of them while this object lives.
class RasterHelpers {
 public:
  // `helpers` may be null: then this process reads everything.
  RasterHelpers(const Helpers* helpers, const RunControl& control);
  RasterHelpers(const RasterHelpers&) = delete;
  RasterHelpers& operator=(const RasterHelpers&) = delete;

  // Null without helpers.
  const RasterReaders* readers() const { return helpers_ != nullptr ? &readers_ : nullptr; }
  const PixelReaders* pixelReaders() const { return helpers_ != nullptr ? &readers_.pixels : nullptr; }
  // What each has read so far.
  std::vector<RasterUse> use() const;

 private:
  std::vector<int> ownersOf(std::span<const RasterPart> parts);
  template <typename Task>
  auto read(std::span<const Task> tasks, std::span<const int> who, const ItemLoop& loop);
  void note(int reader, const RasterUse& use);

  const Helpers* helpers_;
  RunControl control_;
  RasterReaders readers_;
  mutable std::mutex mutex_;
  std::map<std::pair<std::string, std::size_t>, int> owners_;  // of a raster's parts
  std::vector<RasterUse> use_;                                 // of each reader
};

// A helper's answer to a request to read.
Reply answerRasterTask(std::string_view request);

}  // namespace coastmesh
