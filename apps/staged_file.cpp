#include "apps/staged_file.hpp"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "gis/error.hpp"

namespace coastmesh {

namespace fs = std::filesystem;

StagedFile::StagedFile(std::string target, bool overwrite, Interrupt& interrupt)
    : target_(std::move(target)), overwrite_(overwrite), interrupt_(interrupt) {
  std::error_code error;
  if (!target_.has_filename() || fs::is_directory(target_, error)) {
    throw OutputError("cannot write '" + target_.string() + "': it is a folder; name a file");
  }
  if (!overwrite_ && fs::exists(fs::symlink_status(target_, error))) {
    throw OutputError("'" + target_.string() + "' exists already; give --overwrite to replace it");
  }
  const fs::path parent = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  if (!fs::is_directory(parent, error)) {
    throw OutputError("cannot write '" + target_.string() + "': there is no folder '" + parent.string() + "'");
  }
  std::string name = (parent / ".coastmesh-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw OutputError("cannot write '" + target_.string() + "': " + std::strerror(errno));
  }
  folder_ = name;
  interrupt_.guard(folder_);
}

StagedFile::~StagedFile() {
  std::error_code error;
  fs::remove_all(folder_, error);
  interrupt_.release(folder_);
}

void StagedFile::write(const std::string& content) {
  std::ofstream file(path(), std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) throw OutputError("cannot write '" + target_.string() + "': " + std::strerror(errno));
}

void StagedFile::make(const std::function<void(const std::string& path)>& writer) {
  try {
    writer(path());
  } catch (const OutputError& error) {
    std::string text = error.what();
    const std::string staged = path();
    for (std::size_t at = text.find(staged); at != std::string::npos; at = text.find(staged)) {
      text.replace(at, staged.size(), target_.string());
    }
    throw OutputError(text);
  }
}

void StagedFile::commit() {
  std::error_code error;
  if (!overwrite_ && fs::exists(fs::symlink_status(target_, error))) {
    throw OutputError("'" + target_.string() + "' came to exist meanwhile; give --overwrite to replace it");
  }
  fs::rename(path(), target_, error);
  if (error) throw OutputError("cannot write '" + target_.string() + "': " + error.message());
}

}  // namespace coastmesh
