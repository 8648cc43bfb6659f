#include "apps/python/wording.hpp"

#include <cpl_vsi.h>

#include <atomic>
#include <new>
#include <utility>

#include "apps/usage/option_keywords.hpp"

namespace coastmesh {

class MemoryFiles::File {
 public:
  File(std::string text, std::string name) : text_(std::move(text)), name_(std::move(name)) {
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
  const std::string& name() const { return name_; }

 private:
  std::string text_;
  std::string name_;
  std::string path_;
};

MemoryFiles::MemoryFiles() = default;
MemoryFiles::~MemoryFiles() = default;

std::string MemoryFiles::add(std::string text, std::string name) {
  return files_.emplace_back(std::make_unique<File>(std::move(text), std::move(name)))->path();
}

std::string MemoryFiles::named(std::string text) const {
  for (const auto& file : files_) {
    const std::string& path = file->path();
    const std::string keyword = file->name().substr(0, file->name().find('[')) + ' ';
    for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path, at)) {
      const bool follows = at >= keyword.size() && text.compare(at - keyword.size(), keyword.size(), keyword) == 0;
      if (follows) at -= keyword.size();
      text.replace(at, (follows ? keyword.size() : 0) + path.size(), file->name());
      at += file->name().size();
    }
  }
  return text;
}

std::string Wording::operator()(const std::string& message) const {
  return files_.named(inKeywords(message, options_));
}

void Wording::apply(std::vector<std::string>& messages) const {
  for (std::string& message : messages) message = (*this)(message);
}

}  // namespace coastmesh
