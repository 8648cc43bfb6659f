#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"
#include "gis/error.hpp"

namespace coastmesh {

// GeoJSON texts as files in memory, for GDAL. In messages they have names.
class MemoryFiles {
 public:
  MemoryFiles();
  ~MemoryFiles();
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;

  // Returns its path. `name`: a keyword, perhaps with the part of its value, "weirs[1]", or another name.
  std::string add(std::string text, std::string name);
  // `text` with names in place of the files' paths. A path that follows its keyword is left out with that:
  // "weirs PATH: no line" is "weirs[1]: no line".
  std::string named(std::string text) const;

 private:
  class File;
  std::vector<std::unique_ptr<File>> files_;
};

// Rewords messages of the library for Python: options as keywords, files in memory by their name. Both must outlive it.
class Wording {
 public:
  Wording(const OptionTable& options, const MemoryFiles& files) : options_(options), files_(files) {}

  std::string operator()(const std::string& message) const;
  void apply(std::vector<std::string>& messages) const;

  // Calls `work`; rewords the OptionError or InputError that it throws.
  template <typename Work>
  auto around(const Work& work) const {
    try {
      return work();
    } catch (const OptionError& error) {
      throw OptionError((*this)(error.what()));
    } catch (const InputError& error) {
      throw InputError((*this)(error.what()));
    }
  }

 private:
  const OptionTable& options_;
  const MemoryFiles& files_;
};

}  // namespace coastmesh
