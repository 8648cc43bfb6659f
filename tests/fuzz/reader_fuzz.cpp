// libFuzzer target: bytes become the files of the reader named by `--reader=NAME`; see reader_cases.hpp.
#include <gdal_priv.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>

#include "gis/crs/ogr_support.hpp"
#include "tests/fuzz/reader_cases.hpp"

namespace {

const coastmesh::ReaderCase* g_reader = nullptr;

// GDAL probes a file with each of its two hundred drivers. Drivers of formats that the program does not use are not
// tested here.
void keepDrivers() {
  constexpr std::string_view kOurs[] = {"GPKG",           "GeoJSON", "GeoJSONSeq", "ESRIJSON", "TopoJSON",
                                        "ESRI Shapefile", "AAIGrid", "GTiff",      "MEM",      "Memory"};
  coastmesh::registerDrivers();
  GDALDriverManager& drivers = *GetGDALDriverManager();
  for (int i = drivers.GetDriverCount() - 1; i >= 0; --i) {
    GDALDriver* const driver = drivers.GetDriver(i);
    if (std::ranges::find(kOurs, std::string_view(driver->GetDescription())) == std::end(kOurs)) {
      drivers.DeregisterDriver(driver);
      GDALDestroyDriver(driver);
    }
  }
}

// A folder in memory for this process, removed at its end.
class Folder {
 public:
  Folder() : path_("/dev/shm/coastmesh_fuzz_" + std::to_string(getpid())) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr const char* kOption = "--reader=";
  for (int i = 1; i < *argc; ++i) {
    if (std::strncmp((*argv)[i], kOption, std::strlen(kOption)) != 0) continue;
    g_reader = &coastmesh::readerCase((*argv)[i] + std::strlen(kOption));
  }
  if (g_reader == nullptr) {
    std::fprintf(stderr, "--reader=NAME is missing, one of");
    for (const auto& reader : coastmesh::readerCases()) std::fprintf(stderr, " %s", std::string(reader.name).c_str());
    std::fprintf(stderr, "\n");
    std::exit(2);
  }
  keepDrivers();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  try {
    coastmesh::runReader(*g_reader, {data, size}, folder.path());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::abort();
  }
  return 0;
}
