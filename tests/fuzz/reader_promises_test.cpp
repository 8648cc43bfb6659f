// Files of a few kilobytes with headers that claim a thousand million nodes are refused before memory for these is
// allocated.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <new>
#include <string>
#include <string_view>

#include "gis/format/grid_io.hpp"
#include "tests/fuzz/reader_cases.hpp"
#include "tests/fuzz/reader_folder.hpp"

namespace {

std::atomic<std::size_t> g_largest = 0;  // bytes of the largest allocation requested

}  // namespace

#ifdef COASTMESH_SANITIZED
// The sanitizer has its own operators and reports allocations to hooks. GCC does not come with the header for these.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*allocated)(const volatile void*, std::size_t),
                                                         void (*freed)(const volatile void*));
namespace {

void noteSize(const volatile void*, std::size_t size) {
  if (size > g_largest) g_largest = size;
}
void ignore(const volatile void*) {}
[[maybe_unused]] const int g_installed = __sanitizer_install_malloc_and_free_hooks(noteSize, ignore);

}  // namespace
#else
// Not inlined: the compiler would warn of memory from new that is released by free.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (size > g_largest) g_largest = size;
  if (void* const memory = std::malloc(std::max<std::size_t>(size, 1))) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif

namespace coastmesh {
namespace {

struct Promise {
  std::string_view reader;
  std::string bytes;
};

void PrintTo(const Promise& promise, std::ostream* out) { *out << promise.reader; }

std::string bigEndian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(value >> shift));
  return bytes;
}

std::string fortranRecord(const std::string& content) {
  const std::string length = bigEndian(static_cast<std::uint32_t>(content.size()));
  return length + content + length;
}

std::string integers(std::initializer_list<std::uint32_t> values) {
  std::string bytes;
  for (const std::uint32_t value : values) bytes += bigEndian(value);
  return bytes;
}

constexpr std::uint32_t kMany = 1'000'000'000;

// A SELAFIN file up to its counts, followed by a record of triangles whose marker claims `claimed` bytes.
std::string selafin(std::uint32_t elements, std::uint32_t nodes, std::uint32_t claimed) {
  std::string title(80, ' ');
  title.replace(72, 8, "SERAFIND");
  return fortranRecord(title) + fortranRecord(integers({0, 0})) +
         fortranRecord(integers({1, 0, 0, 0, 0, 0, 0, 0, 0, 0})) + fortranRecord(integers({elements, nodes, 3, 1})) +
         bigEndian(claimed) + integers({1, 2, 3});
}

std::string netcdfName(const std::string& name) {
  return bigEndian(static_cast<std::uint32_t>(name.size())) + name + std::string((4 - name.size() % 4) % 4, '\0');
}

// A classic NetCDF file with one dimension, and doubles along it that begin where the header ends.
std::string netcdf(const std::string& dimension, const std::string& variable) {
  std::string bytes = "CDF\x01" + bigEndian(0);
  bytes += bigEndian(10) + bigEndian(1) + netcdfName(dimension) + bigEndian(kMany);
  bytes += bigEndian(0) + bigEndian(0);
  bytes += bigEndian(11) + bigEndian(1) + netcdfName(variable) + bigEndian(1) + bigEndian(0) + bigEndian(0) +
           bigEndian(0) + bigEndian(6) + bigEndian(0xffffffff);
  return bytes + bigEndian(static_cast<std::uint32_t>(bytes.size()) + 4);
}

// A triangle as the program writes it, with `many` in place of the bytes after `before`.
std::string ownFile(const std::string& ending, const std::string& before, const std::string& many) {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{0, 0}, {1, 0}, {0, 1}};
  grid.triangles = {{0, 1, 2}};
  const std::string path = ::testing::TempDir() + "/promise_" + std::to_string(::getpid()) + ending;
  StagedOutput output(path, gridFormatFor(path), true);
  output.write(grid);
  output.commit();
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  const std::size_t at = bytes.find(before);
  if (at == std::string::npos) throw std::logic_error("not found in " + ending);
  return bytes.replace(at + before.size(), many.size(), many);
}

std::string ownUgrid(const std::string& dimension) { return ownFile(".nc", netcdfName(dimension), bigEndian(kMany)); }

template <typename T>
std::string native(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

// A GeoPackage whose polygon claims a thousand million rings, or as many points in its ring.
std::string ownGeoPackage(bool rings) {
  const std::string polygon = '\x01' + native<std::uint32_t>(3);
  return ownFile(".gpkg", rings ? polygon : polygon + native<std::uint32_t>(1), native(kMany));
}

// A shard up to its first group.
std::string shard(std::uint32_t shards, std::uint64_t groups, std::uint64_t here, std::uint64_t options) {
  const std::string version = COASTMESH_VERSION;
  return "coastmesh shard\n" + native<std::uint64_t>(version.size()) + version +  // and again in the header
         native<std::uint64_t>(version.size()) + version + native(options) + native<std::uint32_t>(0) + native(shards) +
         native<std::int32_t>(0) + native<std::uint64_t>(0) + native(groups) + native(here);
}

std::vector<Promise> promises() {
  const std::string many = std::to_string(kMany), next(kNextFile);
  return {
      {"adcirc", "a\n" + many + " " + many + "\n1 0 0 1\n2 1 0 1\n"},
      {"adcirc", "a\n1 3\n1 0 0 1\n2 1 0 1\n3 0 1 1\n1 3 1 2 3\n" + many + "\n" + many + "\n" + many + " 0\n1\n"},
      {"schism", "a\n" + many + " " + many + "\n1 0 0 1\n2 1 0 1\n"},
      {"telemac", selafin(kMany / 4, kMany, 3 * kMany)},
      {"telemac", selafin(1, kMany, 12)},
      {"telemac", selafin(0x7fffffff, 0x7fffffff, 0xffffffff)},
      {"2dm", "MESH2D\nND " + many + " 0 0 0\nE3T " + many + " 1 2 3 1\n"},
      {"mike", "100079 1000 " + many + " LONG/LAT\n1 0 0 0 1\n"},
      {"mike", "3 NON-UTM\n1 0 0 0 1\n2 1 0 0 1\n3 0 1 0 1\n" + many + " 3 21\n1 1 2 3\n"},
      {"gmsh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + many + "\n1 0 0 0\n"},
      {"gmsh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 " + many + " 1 " + many + "\n2 1 0 " + many + "\n1\n"},
      {"gmsh",
       "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Elements\n" + many + " " + many + " 1 1\n2 1 2 " + many + "\n1 1\n"},
      {"gmsh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PartitionedEntities\n" + many + "\n" + many + "\n1 1\n"},
      {"ugrid", netcdf("mesh_nNodes", "mesh_node_lon")},
      {"ugrid", ownUgrid("mesh2d_nNodes")},
      {"ugrid", ownUgrid("mesh2d_nFaces")},
      {"mpas", netcdf("nCells", "xCell")},
      {"gpkg_mesh", ownGeoPackage(true)},
      {"gpkg_mesh", ownGeoPackage(false)},
      {"cleaned_gpkg", ownGeoPackage(true)},
      {"cleaned_gpkg", ownGeoPackage(false)},
      {"vtu",
       "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid><Piece NumberOfPoints=\"" +
           many + "\" NumberOfCells=\"" + many +
           "\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray>"
           "</Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0</DataArray>"
           "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray><DataArray type=\"UInt8\" "
           "Name=\"types\" format=\"ascii\">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>"},
      {"vtu",
       "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" "
       "NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"binary\">"
       "AMqaO////w==</DataArray></Points></Piece></UnstructuredGrid></VTKFile>"},
      {"triangle",
       many + " 3 0\n1 1 2 3\n" + next + many + " 2 0 0\n1 0 0\n" + next + "0 2 0 0\n" + many + " 0\n1 1 2\n"},
      {"poly", many + " 2 0 0\n1 0 0\n2 1 0\n"},
      {"poly", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n" + many + " 0\n1 1 2\n"},
      {"fvcom", "Node Number = " + many + "\nCell Number = " + many + "\n1 1 2 3 1\n1 0 0 0\n" + next +
                    "Node Number = " + many + "\n0 0 0\n" + next + "OBC Node Number = " + many + "\n1 1 1\n" + next +
                    "Node Number = " + many + "\n0 0 0\n"},
      {"fesom", many + "\n1 0 0 0\n" + next + many + "\n1 2 3\n" + next + many + "\n0\n"},
      {"jigsaw", "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=" + many + "\n0;0;0\n"},
      {"jigsaw", "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=1\n0;0;0\nTRIA3=" + many + "\n0;0;0;0\n"},
      {"shard", shard(kMany, 0, 0, 0)},
      {"shard", shard(1, kMany, kMany, 0)},
      {"shard", shard(1, 0xffffffffffffffff, 0, 0)},
      {"shard", shard(1, 1, 1, kMany)},
      {"raster", "ncols " + many + "\nnrows " + many + "\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n"},
  };
}

class ReaderPromises : public ::testing::TestWithParam<Promise> {};

TEST_P(ReaderPromises, AreNotBelieved) {
  constexpr std::size_t kEnough = 8 << 20;
  // A GeoPackage has at least one page for each table. JSON and TOML formats contain no counts.
  ASSERT_LT(GetParam().bytes.size(), GetParam().reader.find("gpkg") != GetParam().reader.npos ? 200'000u : 8000u);
  const ReaderFolder folder;
  const std::vector<std::uint8_t> bytes(GetParam().bytes.begin(), GetParam().bytes.end());
  g_largest = 0;
  const ReadOutcome outcome = runReader(readerCase(GetParam().reader), bytes, folder.path());
  EXPECT_FALSE(outcome.read);
  EXPECT_NE(outcome.refusal, "");
  EXPECT_GT(g_largest.load(), 0u);  // otherwise allocations are not observed
  EXPECT_LT(g_largest.load(), kEnough) << outcome.refusal;
  std::printf("%s\n", outcome.refusal.c_str());
}

INSTANTIATE_TEST_SUITE_P(All, ReaderPromises, ::testing::ValuesIn(promises()), [](const auto& param_info) {
  return std::to_string(param_info.index) + "_" + std::string(param_info.param.reader);
});

}  // namespace
}  // namespace coastmesh
