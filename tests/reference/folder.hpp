#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace coastmesh::reference {

// A temporary current folder; the destructor removes it and restores the previous one.
class WorkFolder {
 public:
  WorkFolder() : before_(std::filesystem::current_path()) {
    std::string name = (std::filesystem::temp_directory_path() / "coastmesh-example-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for the examples");
    folder_ = name;
    std::filesystem::current_path(folder_);
  }
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::current_path(before_, ignored);
    std::filesystem::remove_all(folder_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  static void write(const std::string& name, const std::string& text) { std::ofstream(name) << text; }

 private:
  std::filesystem::path before_, folder_;
};

// A lake of some ten kilometres, in degrees, with an island.
inline constexpr const char* kLake =
    R"({"type": "Feature", "properties": {"name": "a lake"}, "geometry": {"type": "Polygon", "coordinates": [
    [[25.0, 62.0], [25.2, 62.0], [25.25, 62.05], [25.2, 62.1], [25.1, 62.07], [25.0, 62.1], [25.0, 62.0]],
    [[25.1, 62.03], [25.1, 62.04], [25.12, 62.04], [25.1, 62.03]]]}})";

}  // namespace coastmesh::reference
