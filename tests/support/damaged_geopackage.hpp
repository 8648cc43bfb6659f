#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace coastmesh::testing {

// Overwrites one of the pages of a GeoPackage with rows that contain the text `mark`. OGR then ends the layer there and
// only emits a message. REQUIRES: the file is closed and has more than four such pages.
inline void damageRowsWith(std::string_view mark, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  constexpr std::size_t kPage = 4096;   // GDAL's
  constexpr char kLeafOfATable = 0x0d;  // in SQLite's format
  std::vector<std::size_t> pages;
  for (std::size_t at = 0; at + kPage <= bytes.size(); at += kPage) {
    const std::string_view page = std::string_view(bytes).substr(at, kPage);
    if (page[0] == kLeafOfATable && page.find(mark) != page.npos) pages.push_back(at);
  }
  ASSERT_GT(pages.size(), 4u);
  bytes.replace(pages[pages.size() / 2], kPage, std::string(kPage, '\xff'));
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace coastmesh::testing
