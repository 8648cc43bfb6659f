#include "parallel/round_keeper.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "core/size_function.hpp"
#include "parallel/byte_hash.hpp"
#include "parallel/mesh_regions.hpp"
#include "parallel/workers.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

// Keeps the checkpoint in memory and ends the run after `most` checkpoints.
struct Shelf {
  struct Ended {};

  RegionCheckpoint checkpoint() {
    return {[this](const std::function<void(const RegionCheckpoint::Put&)>& write) {
              std::string bytes;
              write([&bytes](std::string_view next) { bytes += next; });
              kept = std::move(bytes);
              if (++times == most) throw Ended();
            },
            [this](const RegionCheckpoint::Read& read) {
              if (!kept.empty()) read(kept);
            }};
  }

  std::string kept;
  int times = 0, most = -1;
};

struct Case {
  const char* name;
  Pslg pslg;
  MeshOptions options;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::vector<Case> cases() {
  static const ConstantSize one(0.009);
  std::vector<Case> all(5);
  // Corners that excuse small angles; an angle bound only.
  all[0].name = "Coast", all[0].pslg = fractalCoast(1, 6, 8);
  // Size steps, lattices, and repairs beside the lattices.
  all[1].name = "CoastWithSize", all[1].pslg = fractalCoast(2, 3, 3), all[1].options.refine.size_max = 0.01;
  // Segments split beforehand; all three stages.
  all[2].name = "OneLength", all[2].pslg = fractalCoast(1, 6, 3), all[2].options.refine.size = &one;
  all[3].name = "Budget", all[3].pslg = twoRegions(), all[3].options.refine.size_max = 0.005;
  all[3].options.refine.max_vertices = 20000;
  // Pieces use up their shares in several rounds of a step.
  all[4].name = "BudgetInRounds", all[4].pslg = all[0].pslg, all[4].options.refine.max_vertices = 126000;
  for (Case& c : all) {
    c.options.refine.min_angle_deg = 28.0;
    c.options.mark_pieces = true;
  }
#ifdef COASTMESH_SANITIZED
  all = {all[1]};  // the quickest; all five took a sixth of the time of all tests
#endif
  return all;
}

MeshedRegion meshed(const Case& c, int threads, const RegionCheckpoint* checkpoint) {
  MeshedRegion region;
  withThreads({.threads = threads}, [&] {
    MeshOptions options = c.options;
    options.checkpoint = checkpoint;
    region = meshRegion(c.pslg, options);
  });
  return region;
}

void expectSame(const MeshedRegion& region, const MeshedRegion& expected) {
  EXPECT_EQ(digestOf(region.mesh), digestOf(expected.mesh));
  EXPECT_EQ(region.mesh.regions, expected.mesh.regions);
  EXPECT_EQ(region.pieces, expected.pieces);
  EXPECT_EQ(region.piece_of, expected.piece_of);
  const RefineStats &a = region.stats, &b = expected.stats;
  EXPECT_EQ(std::tie(a.steiner_points, a.by_type, a.segment_splits, a.relocations, a.removals, a.merges, a.unmended,
                     a.budget_reached),
            std::tie(b.steiner_points, b.by_type, b.segment_splits, b.relocations, b.removals, b.merges, b.unmended,
                     b.budget_reached));
  EXPECT_EQ(a.unresolved.size(), b.unresolved.size());
}

class Kept : public ::testing::TestWithParam<Case> {};

// Ends the run after each of its rounds and resumes it with another number of threads: the result is that of an
// unbroken run.
TEST_P(Kept, GoesOnAfterEveryRound) {
  const Case& c = GetParam();
  const MeshedRegion whole = meshed(c, 2, nullptr);
  ASSERT_GT(whole.pieces, 1u) << "nothing was cut";
  Shelf unbroken;
  const RegionCheckpoint all = unbroken.checkpoint();
  expectSame(meshed(c, 2, &all), whole);
  ASSERT_GT(unbroken.times, 3);
  for (int most = 1; most <= unbroken.times; ++most) {
    SCOPED_TRACE(most);
    Shelf shelf;
    shelf.most = most;
    const RegionCheckpoint checkpoint = shelf.checkpoint();
    EXPECT_THROW(meshed(c, 2, &checkpoint), Shelf::Ended);
    expectSame(meshed(c, 3, &checkpoint), whole);
    EXPECT_EQ(shelf.times, unbroken.times) << "rounds were done again";
  }
}

// A run that ends after every round it completes.
TEST_P(Kept, GoesOnAsOftenAsItEnds) {
  const Case& c = GetParam();
  const MeshedRegion whole = meshed(c, 2, nullptr);
  Shelf shelf;
  const RegionCheckpoint checkpoint = shelf.checkpoint();
  constexpr int kEnough = 200;
  for (int runs = 0;; ++runs) {
    ASSERT_LT(runs, kEnough);
    shelf.most = shelf.times + 1;
    try {
      expectSame(meshed(c, 2, &checkpoint), whole);
      break;
    } catch (const Shelf::Ended&) {
    }
  }
}

TEST_P(Kept, IsOfThatInputAndThoseOptionsAlone) {
  const Case& c = GetParam();
  Shelf shelf;
  shelf.most = 2;
  const RegionCheckpoint checkpoint = shelf.checkpoint();
  EXPECT_THROW(meshed(c, 2, &checkpoint), Shelf::Ended);
  Case other = c;
  other.options.refine.min_angle_deg += 0.5;
  EXPECT_THROW(meshed(other, 2, &checkpoint), BadCheckpoint);
  other = c;
  other.options.coarsen = false;
  EXPECT_THROW(meshed(other, 2, &checkpoint), BadCheckpoint);
  other = c;
  other.pslg.points.front().x += 1e-9;
  EXPECT_THROW(meshed(other, 2, &checkpoint), BadCheckpoint);
  // Available memory may differ in the resumed run.
  other = c;
  other.options.refine.most_in_memory = 1u << 30;
  EXPECT_NO_THROW(meshed(other, 2, &checkpoint));
}

TEST_P(Kept, TellsWhatIsTooShortOrTooLong) {
  const Case& c = GetParam();
  Shelf shelf;
  shelf.most = 2;
  const RegionCheckpoint checkpoint = shelf.checkpoint();
  EXPECT_THROW(meshed(c, 2, &checkpoint), Shelf::Ended);
  const std::string whole = shelf.kept;
  for (const std::size_t size : {std::size_t{4}, whole.size() / 2, whole.size() - 1}) {
    shelf.kept = whole.substr(0, size);
    EXPECT_THROW(meshed(c, 2, &checkpoint), BadCheckpoint) << size;
  }
  shelf.kept = whole + '\0';
  EXPECT_THROW(meshed(c, 2, &checkpoint), BadCheckpoint);
}

INSTANTIATE_TEST_SUITE_P(All, Kept, ::testing::ValuesIn(cases()),
                         [](const auto& param_info) { return param_info.param.name; });

TEST(ByteHash, HangsOnAllBytesAndNotOnTheirParts) {
  std::string bytes;
  for (int i = 0; i < 100; ++i) bytes.push_back(static_cast<char>(i * 37));
  ByteHash whole;
  whole.add(bytes);
  for (const std::size_t part : {1u, 3u, 7u, 8u, 9u, 31u}) {
    ByteHash parts;
    for (std::size_t at = 0; at < bytes.size(); at += part) parts.add(std::string_view(bytes).substr(at, part));
    EXPECT_EQ(parts.value(), whole.value()) << part;
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string other = bytes;
    other[i] ^= 1;
    ByteHash hash;
    hash.add(other);
    EXPECT_NE(hash.value(), whole.value()) << i;
  }
  ByteHash longer;
  longer.add(bytes + '\0');
  EXPECT_NE(longer.value(), whole.value());
}

}  // namespace
}  // namespace coastmesh
