#include "gis/write_telemac.hpp"

#include <algorithm>
#include <array>

#include "gis/error.hpp"
#include "gis/fortran_records.hpp"
#include "gis/grid_formats.hpp"
#include "gis/prj_file.hpp"
#include "gis/rim_boundaries.hpp"

namespace coastmesh {
namespace {

bool isLiquid(BoundaryRole role) { return role == BoundaryRole::Open || role == BoundaryRole::River; }

// The rim's nodes in TELEMAC's order, each with what it is.
struct RimNodes {
  std::vector<std::uint32_t> nodes;
  std::vector<BoundaryRole> roles;
};

// Outer loops before islands, each from its south-western node, as TELEMAC numbers them itself.
std::vector<std::vector<std::uint32_t>> orderedLoops(const Grid& grid) {
  std::vector<std::vector<std::uint32_t>> loops = rimOf(grid);
  const auto southWest = [&](std::uint32_t node) { return grid.nodes[node].x + grid.nodes[node].y; };
  for (auto& loop : loops) std::ranges::rotate(loop, std::ranges::min_element(loop, {}, southWest));
  std::ranges::stable_partition(loops,
                                [&](const auto& loop) { return roleOfLoop(grid.nodes, loop) == BoundaryRole::Land; });
  return loops;
}

// A node between two kinds of opening belongs to the one before it, a node at the end of one to that one.
RimNodes rimNodesOf(const Grid& grid, const std::string& path) {
  const EdgeKinds kinds(grid);
  const auto roleOf = [&](std::uint32_t from, std::uint32_t to) {
    const RimKind* const kind = kinds.find(from, to);
    return kind != nullptr ? kind->role : BoundaryRole::Land;
  };
  RimNodes rim;
  std::vector<bool> seen(grid.nodes.size(), false);
  for (const auto& loop : orderedLoops(grid)) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t node = loop[i];
      if (seen[node])
        throw OutputError("cannot write '" + path + "': the mesh touches itself in the node at " +
                          std::to_string(grid.nodes[node].x) + ", " + std::to_string(grid.nodes[node].y) +
                          ", which TELEMAC's files cannot say; mend it with --target telemac");
      seen[node] = true;
      const BoundaryRole before = roleOf(loop[(i + loop.size() - 1) % loop.size()], node);
      const BoundaryRole after = roleOf(node, loop[(i + 1) % loop.size()]);
      rim.nodes.push_back(node);
      rim.roles.push_back(isLiquid(before) ? before : isLiquid(after) ? after : BoundaryRole::Land);
    }
  }
  return rim;
}

std::string padded(std::string_view text, std::size_t width) {
  std::string out(text.substr(0, width));
  out.resize(width, ' ');
  return out;
}

void writeGeometry(const Grid& grid, const RimNodes& rim, const std::string& path) {
  FortranWriter file(path);
  file.text(padded(grid.title, 72) + "SERAFIND");
  file.integers(std::array<std::int32_t, 2>{1, 0});
  file.text(padded("BOTTOM", 16) + padded("M", 16));
  file.integers(std::array<std::int32_t, 10>{1});
  const auto nodes = static_cast<std::int32_t>(grid.nodes.size());
  file.integers(std::array{static_cast<std::int32_t>(grid.triangles.size()), nodes, 3, 1});
  std::vector<std::int32_t> numbers;
  numbers.reserve(3 * grid.triangles.size());
  for (const auto& corners : grid.triangles)
    for (const std::uint32_t node : corners) numbers.push_back(static_cast<std::int32_t>(node) + 1);
  file.integers(numbers);
  numbers.assign(grid.nodes.size(), 0);
  for (std::size_t i = 0; i < rim.nodes.size(); ++i) numbers[rim.nodes[i]] = static_cast<std::int32_t>(i) + 1;
  file.integers(numbers);
  std::vector<double> values(grid.nodes.size());
  std::ranges::transform(grid.nodes, values.begin(), &Point::x);
  file.doubles(values);
  std::ranges::transform(grid.nodes, values.begin(), &Point::y);
  file.doubles(values);
  file.doubles(std::array{0.0});  // the time
  std::ranges::fill(values, 0.0);
  file.doubles(grid.z.empty() ? values : grid.z);
  file.close();
}

void writeConditions(const RimNodes& rim, const std::string& path) {
  TextWriter file(path);
  for (std::size_t i = 0; i < rim.nodes.size(); ++i) {
    const BoundaryRole role = rim.roles[i];
    const bool liquid = isLiquid(role);
    file << (role == BoundaryRole::Open ? "5 4 4"
             : liquid                   ? "4 5 5"
                                        : "2 2 2")
         << " 0.000 0.000 0.000 0.000 " << (liquid ? '4' : '2') << " 0.000 0.000 0.000 " << rim.nodes[i] + 1 << ' '
         << i + 1 << '\n';
  }
  file.close();
}

}  // namespace

void writeTelemac(const Grid& grid, const std::string& path) {
  requireZ(grid, path);
  const RimNodes rim = rimNodesOf(grid, path);
  writeGeometry(grid, rim, path);
  writeConditions(rim, withEnding(path, ".cli"));
  writePrjBeside(path, grid.crs);
}

FormatRecord telemacFormat() {
  const auto files = [](const std::string& path) -> OutputFiles {
    return {{path, withEnding(path, ".cli")}, {}, prjBeside(path)};
  };
  return {{"telemac",
           {".slf"},
           "TELEMAC's SELAFIN and .cli, elevation positive up",
           true,
           true,
           {GridPart::Title, GridPart::Rivers},
           true},
          {writeTelemac, readTelemac, files}};
}

}  // namespace coastmesh
