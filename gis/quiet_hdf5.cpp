#include "gis/quiet_hdf5.hpp"

#include <dlfcn.h>

#include <cstdint>

namespace coastmesh {

namespace {

// HDF5 comes with netCDF, so that no headers of it need to be installed. It may be missing, or hidden in netCDF.
template <typename Function>
Function* hdf5Function(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

bool turnOffPrinting() {
  // If the library is not made for threads, there is one setting for all of them, which is netCDF's to change.
  auto* const ask = hdf5Function<int(unsigned*)>("H5is_library_threadsafe");
  unsigned is_threadsafe = 0;  // HDF5's type for it has one byte or four
  if (ask == nullptr || ask(&is_threadsafe) < 0 || is_threadsafe == 0) return false;
  auto* const set = hdf5Function<int(std::int64_t stack, void* print, void* data)>("H5Eset_auto2");
  constexpr std::int64_t kOfThisThread = 0;
  return set != nullptr && set(kOfThisThread, nullptr, nullptr) >= 0;
}

}  // namespace

void quietHdf5() { [[maybe_unused]] static thread_local const bool is_quiet = turnOffPrinting(); }

}  // namespace coastmesh
