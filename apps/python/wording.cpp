#include "apps/python/wording.hpp"

#include <cpl_vsi.h>

#include <atomic>
#include <new>
#include <utility>

#include "apps/usage/option_keywords.hpp"

namespace coastmesh {

class MemoryFiles::File {
 public:
  explicit File(std::string text) : text_(std::move(text)) {
    static std::atomic<unsigned> number{0};
    path_ = "/vsimem/coastmesh-" + std::to_string(number++) + "/input.geojson";
    VSILFILE* file = VSIFileFromMemBuffer(path_.c_str(), reinterpret_cast<GByte*>(text_.data()), text_.size(), FALSE);
    if (file == nullptr) throw std::bad_alloc();
    VSIFCloseL(file);
  }
  ~File() { VSIUnlink(path_.c_str()); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string text_;
  std::string path_;
};

MemoryFiles::MemoryFiles() = default;
MemoryFiles::~MemoryFiles() = default;

std::string MemoryFiles::add(std::string text) {
  return files_.emplace_back(std::make_unique<File>(std::move(text)))->path();
}

std::string MemoryFiles::named(std::string text) const {
  for (const auto& file : files_) {
    const std::string& path = file->path();
    for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path, at))
      text.replace(at, path.size(), kName);
  }
  return text;
}

std::string Wording::operator()(const std::string& message) const {
  return inKeywords(files_.named(message), options_);
}

void Wording::apply(std::vector<std::string>& messages) const {
  for (std::string& message : messages) message = (*this)(message);
}

}  // namespace coastmesh
