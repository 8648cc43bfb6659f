#include "apps/cli/feature_file_names.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>

#include "gis/error.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kLongestName = 100;  // bytes; most systems allow 255, to which hidden names and endings add

bool isPartOfLetter(char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; }

std::string lowerCase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string attributeOf(const Feature& feature, const std::string& field) {
  for (const auto& [name, value] : feature.attributes)
    if (name == field) return value;
  return {};
}

// "folder/lakes.gpkg|large" as "lakes-large".
std::string sourceName(const std::string& source) {
  const std::size_t bar = source.find('|');
  const std::string stem = std::filesystem::path(source.substr(0, bar)).stem().string();
  return safeFileName(bar == std::string::npos ? stem : stem + "-" + source.substr(bar + 1));
}

std::string shown(const Feature& feature) {
  return "feature " + std::to_string(feature.fid) + " of '" + feature.source + "'";
}

void requireField(const std::vector<const Feature*>& features, const std::string& field) {
  std::set<std::string> fields;
  for (const Feature* feature : features)
    for (const auto& [name, value] : feature->attributes) fields.insert(name);
  if (fields.contains(field)) return;
  std::string known;
  for (const std::string& name : fields) known += (known.empty() ? "" : ", ") + name;
  throw OptionError("--name-field " + field + ": no feature has such an attribute; there " +
                    (known.empty() ? "are none at all" : "are " + known));
}

}  // namespace

std::string safeFileName(const std::string& name) {
  constexpr std::string_view kNotTaken = "/\\<>:\"|?*{}";
  std::string safe;
  for (const char c : name) {
    const bool unseen = static_cast<unsigned char>(c) < 0x20u || c == 0x7F;
    safe += unseen || kNotTaken.find(c) != std::string_view::npos ? '_' : c;
  }
  if (safe.size() > kLongestName) {
    std::size_t end = kLongestName;
    while (end > 0 && isPartOfLetter(safe[end])) --end;
    safe.resize(end);
  }
  const std::size_t begin = safe.find_first_not_of(" .");
  if (begin == std::string::npos) return {};
  return safe.substr(begin, safe.find_last_not_of(" .") - begin + 1);
}

std::vector<std::string> namesOfFeatures(const std::vector<const Feature*>& features, const std::string& field) {
  if (!field.empty()) requireField(features, field);
  std::set<std::string> sources;
  for (const Feature* feature : features) sources.insert(feature->source);
  std::map<std::string, const Feature*> taken;
  std::vector<std::string> names;
  for (const Feature* feature : features) {
    std::string name = field.empty() ? "" : safeFileName(attributeOf(*feature, field));
    if (name.empty()) {
      name = std::to_string(feature->fid);
      if (sources.size() > 1) name = sourceName(feature->source) + "-" + name;
    }
    const auto [other, is_new] = taken.try_emplace(lowerCase(name), feature);
    if (!is_new)
      throw InputError(
          "--per-feature: " + shown(*other->second) + " and " + shown(*feature) + " would both be called '" + name +
          "' in the names of files: " +
          (field.empty() ? "give --name-field" : "name them by another --name-field, or by their numbers without it"));
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace coastmesh
