#include "gis/fields/field_source.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "gis/fields/field_names.hpp"
#include "gis/finite_number.hpp"
#include "gis/lower_case.hpp"

namespace coastmesh {

namespace {

// The raster and the table, which may be empty.
std::pair<std::string, std::string> filesIn(const std::string& text) {
  const std::size_t comma = text.rfind(',');
  if (comma == std::string::npos || !lowerCase(text).ends_with(".csv")) return {text, {}};
  return {text.substr(0, comma), text.substr(comma + 1)};
}

}  // namespace

std::string addFieldSource(const std::string& text, std::vector<FieldSource>& sources) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    return "is not NAME=FILE, NAME=FILE,TABLE.csv or NAME=NUMBER";
  const std::string name = text.substr(0, equals), rest = text.substr(equals + 1);
  if (const std::string wrong = wrongFieldName(name); !wrong.empty())
    return "names an attribute, '" + name + "', that " + wrong;
  FieldSource source{fullFieldName(name), finiteNumber(rest)};
  if (!source.number) std::tie(source.file, source.table) = filesIn(rest);
  if (!source.number && source.file.empty()) return "names a table, but no raster of classes";
  const auto hasNumber = [&](const FieldSource& other) { return other.name == source.name && other.number; };
  if (source.number && std::ranges::any_of(sources, hasNumber)) return "gives " + name + " a second number";
  sources.push_back(std::move(source));
  return {};
}

std::vector<std::string> filesOfFieldSource(const std::string& text) {
  std::vector<FieldSource> sources;
  if (!addFieldSource(text, sources).empty() || sources.front().number) return {};
  std::vector<std::string> files{sources.front().file};
  if (!sources.front().table.empty()) files.push_back(sources.front().table);
  return files;
}

}  // namespace coastmesh
