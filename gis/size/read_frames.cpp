#include "gis/size/read_frames.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "gis/size/rule_of_tiles.hpp"

namespace coastmesh {

namespace {

static_assert(kPartStep % kTile == 0, "a tile lies in one part");

using Frames = std::span<const std::shared_ptr<const RasterFrame>>;

// Below this number of pixels, sending tasks takes as long as reading.
constexpr std::uint64_t kWorthReaders = 1 << 20;

// Tiles of one part of a raster, by their numbers in the frame.
struct PartTiles {
  std::size_t frame = 0;
  std::size_t cell = 0;
  std::vector<std::size_t> tiles;
  std::uint64_t pixels = 0;
  int side = 0, end = 0;  // the largest margins of its tiles
};

// Tiles of a part that are read at once: the unit of work of a reader's threads.
struct Chunk {
  const PartTiles* part = nullptr;
  std::size_t first = 0, last = 0;  // of the part's tiles
};

class FrameReading {
 public:
  FrameReading(Frames frames, double margin_m) : frames_(frames), margin_m_(margin_m) {
    for (const auto& frame : frames_) cuts_.push_back(partsOf(frame->raster));
    for (std::size_t f = 0; f < frames_.size(); ++f) findParts(f);
  }

  std::uint64_t pixels() const {
    return std::accumulate(parts_.begin(), parts_.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const PartTiles& part) { return sum + part.pixels; });
  }

  FrameTiles readAll(std::span<const TileRule> rules, const ItemLoop& loop) const {
    FrameTiles tiles = emptyTiles(rules.size());
    const std::vector<Chunk> chunks = chunksOf();
    const std::vector<std::span<const Chunk>> shares = sharesOf(chunks);
    loop(shares.size(), [&](std::size_t s) {
      const RasterBand band(frames_[shares[s].front().part->frame]->raster.path);
      for (const Chunk& chunk : shares[s]) put(chunk, answerTask(band, taskOf(chunk), rules), tiles);
    });
    return tiles;
  }

  FrameTiles readAll(std::span<const SizeRule> rules, const RasterReaders& readers, const ItemLoop& loop) const {
    const Neighbours neighbours = neighboursOf(readers);
    const std::vector<std::vector<PixelPatch>> patches = exchange(neighbours, readers, loop);
    const std::vector<Chunk> chunks = chunksOf();
    std::vector<TileTask> tasks;
    std::vector<int> who;
    for (const Chunk& chunk : chunks) {
      const auto part = static_cast<std::size_t>(chunk.part - parts_.data());
      TileTask& task = tasks.emplace_back(taskOf(chunk));
      task.rules.assign(rules.begin(), rules.end());
      if (frames_[chunk.part->frame]->raster.is_exact) task.own = neighbours.own[part];
      task.patches = patchesFor(chunk, patches[part]);
      who.push_back(neighbours.owner[part]);
    }
    FrameTiles tiles = emptyTiles(rules.size());
    std::vector<TileAnswer> answers = readers.read(tasks, who, loop);
    for (std::size_t c = 0; c < chunks.size(); ++c) put(chunks[c], std::move(answers[c]), tiles);
    return tiles;
  }

 private:
  // Pixels that another reader has to send.
  struct Strip {
    int owner = 0;
    std::size_t cell = 0;
    PixelRect at;
  };
  // For each part: its reader, the pixels of it and its surroundings that this may read, and the strips from others.
  struct Neighbours {
    std::vector<int> owner;
    std::vector<std::vector<PixelRect>> own;
    std::vector<std::vector<Strip>> strips;
  };

  void findParts(std::size_t f) {
    const RasterFrame& frame = *frames_[f];
    std::map<std::size_t, PartTiles> found;
    for (std::size_t t = 0; t < frame.places.size(); ++t) {
      const TilePlace& place = frame.places[t];
      if (!(place.pixel_m[0] > 0.0)) continue;
      cuts_[f].forEachCell({place.pixels.x, place.pixels.y, 1, 1}, [&](std::size_t cell) {
        PartTiles& part = found.try_emplace(cell, PartTiles{f, cell, {}, 0, 0, 0}).first->second;
        part.tiles.push_back(t);
        part.pixels += static_cast<std::uint64_t>(place.pixels.width) * static_cast<std::uint64_t>(place.pixels.height);
        const auto [side, end] = marginOf(place, margin_m_, frame.raster);
        part.side = std::max(part.side, side);
        part.end = std::max(part.end, end);
      });
    }
    for (auto& each : found) parts_.push_back(std::move(each.second));
  }

  std::vector<Chunk> chunksOf() const {
    constexpr std::size_t kMostChunks = 256, kLeast = 4, kMost = 64;
    std::size_t tiles = 0;
    for (const PartTiles& part : parts_) tiles += part.tiles.size();
    const std::size_t length = std::clamp(tiles / kMostChunks, kLeast, kMost);
    std::vector<Chunk> chunks;
    for (const PartTiles& part : parts_)
      for (std::size_t first = 0; first < part.tiles.size(); first += length)
        chunks.push_back({&part, first, std::min(first + length, part.tiles.size())});
    return chunks;
  }

  // Chunks for which a raster is opened once. That takes long for a raster of many files; a text is read from its
  // beginning whenever it is opened.
  std::vector<std::span<const Chunk>> sharesOf(const std::vector<Chunk>& chunks) const {
    constexpr std::size_t kMostOfFiles = 16;
    std::vector<std::span<const Chunk>> shares;
    for (std::size_t first = 0, end = 0; first < chunks.size(); first = end) {
      while (end < chunks.size() && chunks[end].part->frame == chunks[first].part->frame) ++end;
      const RasterGeometry& raster = frames_[chunks[first].part->frame]->raster;
      const bool is_of_files = raster.mosaic || !raster.is_exact;
      const std::size_t most = raster.in_order ? 1 : is_of_files ? kMostOfFiles : end - first;
      const std::size_t length = (end - first + most - 1) / most;
      for (std::size_t at = first; at < end; at += length)
        shares.push_back(std::span(chunks).subspan(at, std::min(length, end - at)));
    }
    return shares;
  }

  TileTask taskOf(const Chunk& chunk) const {
    const RasterFrame& frame = *frames_[chunk.part->frame];
    TileTask task;
    task.path = frame.raster.path;
    task.columns = frame.raster.columns;
    task.rows = frame.raster.rows;
    for (std::size_t k = chunk.first; k < chunk.last; ++k) task.tiles.push_back(frame.places[chunk.part->tiles[k]]);
    return task;
  }

  // The part's patches that a chunk uses: otherwise all of them would be sent with each chunk.
  std::vector<PixelPatch> patchesFor(const Chunk& chunk, const std::vector<PixelPatch>& patches) const {
    const RasterFrame& frame = *frames_[chunk.part->frame];
    std::vector<PixelPatch> some;
    if (patches.empty()) return some;
    const PixelRect& first = frame.places[chunk.part->tiles[chunk.first]].pixels;
    int left = first.x, right = first.right(), top = first.y, bottom = first.bottom();
    for (std::size_t k = chunk.first; k < chunk.last; ++k) {
      const PixelRect& pixels = frame.places[chunk.part->tiles[k]].pixels;
      left = std::min(left, pixels.x);
      right = std::max(right, pixels.right());
      top = std::min(top, pixels.y);
      bottom = std::max(bottom, pixels.bottom());
    }
    const PixelRect seen = PixelRect{left, top, right - left, bottom - top}.grownBy(chunk.part->side, chunk.part->end);
    for (int turn = frame.raster.wraps ? -1 : 0; turn <= (frame.raster.wraps ? 1 : 0); ++turn) {
      for (const PixelPatch& patch : patches) {
        const PixelRect at = patch.at.in(seen.shifted(turn * frame.raster.columns));
        if (!at.isEmpty()) some.push_back({at, {}});
        for (int row = at.y; !at.isEmpty() && row < at.bottom(); ++row) {
          const auto from = patch.values.begin() + static_cast<std::ptrdiff_t>(row - patch.at.y) * patch.at.width +
                            (at.x - patch.at.x);
          some.back().values.insert(some.back().values.end(), from, from + at.width);
        }
      }
    }
    return some;
  }

  FrameTiles emptyTiles(std::size_t rules) const {
    FrameTiles tiles(rules);
    for (auto& of_rule : tiles)
      for (const auto& frame : frames_) of_rule.emplace_back(frame->places.size(), emptyTile());
    return tiles;
  }

  static void put(const Chunk& chunk, TileAnswer&& answer, FrameTiles& tiles) {
    for (std::size_t r = 0; r < tiles.size(); ++r)
      for (std::size_t k = chunk.first; k < chunk.last; ++k)
        tiles[r][chunk.part->frame][chunk.part->tiles[k]] = std::move(answer.tiles[r][k - chunk.first]);
  }

  // Calls `visit(cell, rectangle)` for the pixels that the tiles of a part use: in its own cell and in those around it.
  template <typename Visit>
  void forEachSeen(const PartTiles& part, const Visit& visit) const {
    const RasterGeometry& raster = frames_[part.frame]->raster;
    const PixelCuts& cuts = cuts_[part.frame];
    const PixelRect all{0, 0, raster.columns, raster.rows};
    // If values depend on the window, each reader reads its margin itself.
    const PixelRect seen =
        cuts.cell(part.cell).grownBy(raster.is_exact ? part.side : 0, raster.is_exact ? part.end : 0);
    for (int turn = raster.wraps ? -1 : 0; turn <= (raster.wraps ? 1 : 0); ++turn) {
      const PixelRect inside = seen.shifted(turn * raster.columns).in(all);
      if (inside.isEmpty()) continue;
      cuts.forEachCell(inside, [&](std::size_t cell) { visit(cell, cuts.cell(cell).in(inside)); });
    }
  }

  std::size_t ownedAs(std::size_t frame, std::size_t cell) const {
    return coastmesh::ownedAs(frames_[frame]->raster, cell);
  }

  Neighbours neighboursOf(const RasterReaders& readers) const {
    std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> pixels;  // of everything with an owner
    for (const PartTiles& part : parts_) {
      pixels[{part.frame, ownedAs(part.frame, part.cell)}] += part.pixels;
      forEachSeen(part, [&](std::size_t cell, const PixelRect&) {
        pixels.try_emplace({part.frame, ownedAs(part.frame, cell)}, 0);
      });
    }
    std::vector<RasterPart> asked;
    for (const auto& [which, count] : pixels) asked.push_back({frames_[which.first]->raster.path, which.second, count});
    const std::vector<int> owners = readers.pixels.ownersOf(asked);
    std::map<std::pair<std::size_t, std::size_t>, int> owner_of;
    std::size_t k = 0;
    for (const auto& each : pixels) owner_of[each.first] = owners[k++];
    Neighbours found;
    for (const PartTiles& part : parts_) {
      const int owner = owner_of.at({part.frame, ownedAs(part.frame, part.cell)});
      found.owner.push_back(owner);
      auto& own = found.own.emplace_back();
      auto& strips = found.strips.emplace_back();
      forEachSeen(part, [&](std::size_t cell, const PixelRect& at) {
        const int other = owner_of.at({part.frame, ownedAs(part.frame, cell)});
        if (other == owner)
          own.push_back(at);
        else
          strips.push_back({other, cell, at});
      });
    }
    return found;
  }

  // Has the owners read the strips that other parts need; returns the patches of each part.
  std::vector<std::vector<PixelPatch>> exchange(const Neighbours& neighbours, const RasterReaders& readers,
                                                const ItemLoop& loop) const {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> task_of;  // frame and cell
    std::vector<TileTask> tasks;
    std::vector<int> who;
    std::vector<std::vector<std::pair<std::size_t, std::size_t>>> where(parts_.size());  // task, and strip in it
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      for (const Strip& strip : neighbours.strips[p]) {
        const auto [entry, is_new] = task_of.try_emplace({parts_[p].frame, strip.cell}, tasks.size());
        if (is_new) {
          tasks.push_back(taskOf({&parts_[p], 0, 0}));
          who.push_back(strip.owner);
        }
        TileTask& task = tasks[entry->second];
        where[p].emplace_back(entry->second, task.strips.size());
        task.strips.push_back(strip.at);
      }
    }
    std::vector<std::vector<PixelPatch>> patches(parts_.size());
    if (tasks.empty()) return patches;
    const std::vector<TileAnswer> answers = readers.read(tasks, who, loop);
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (const auto& [task, strip] : where[p]) patches[p].push_back(answers[task].strips[strip]);
    return patches;
  }

  Frames frames_;
  double margin_m_;
  std::vector<PixelCuts> cuts_;   // of each frame
  std::vector<PartTiles> parts_;  // of all frames, one after another
};

double mostMargin(std::span<const TileRule> rules) {
  double most = 0.0;
  for (const TileRule& rule : rules) most = std::max(most, rule.margin_m);
  return most;
}

}  // namespace

FrameTiles readFrames(Frames frames, std::span<const TileRule> rules, const ItemLoop& loop) {
  return FrameReading(frames, mostMargin(rules)).readAll(rules, loop);
}

FrameTiles readFrames(Frames frames, std::span<const SizeRule> rules, const RasterReaders* readers,
                      const ItemLoop& loop) {
  std::vector<TileRule> tile_rules;
  for (const SizeRule& rule : rules) tile_rules.push_back(tileRuleOf(rule));
  const FrameReading reading(frames, mostMargin(tile_rules));
  if (readers == nullptr || reading.pixels() < kWorthReaders) return reading.readAll(tile_rules, loop);
  return reading.readAll(rules, *readers, loop);
}

}  // namespace coastmesh
