#include "gis/coast/feature_names.hpp"

#include <algorithm>

#include "gis/lower_case.hpp"

namespace coastmesh {

std::string_view nameOf(const std::vector<std::pair<std::string, std::string>>& attributes) {
  for (const bool exactly : {true, false}) {
    for (const auto& [key, value] : attributes) {
      if (exactly ? lowerCase(key) == "name" : isNameAttribute(key)) return value;
    }
  }
  return {};
}

bool isNameAttribute(std::string_view attribute) {
  return lowerCase(std::string(attribute)).find("name") != std::string::npos;
}

std::string sourceInWords(const std::string& source) { return "'" + source + "'"; }

std::string featureInWords(const std::string& source, std::int64_t fid) {
  return sourceInWords(source) + (fid < 0 ? "" : ", feature " + std::to_string(fid));
}

std::string featureInWords(const Feature& feature) { return featureInWords(feature.source, feature.fid); }

std::string featuresInWords(const Coastline& coastline, const std::vector<std::size_t>& members) {
  if (members.empty()) return "the input";
  std::string names = featureInWords(coastline.features[members.front()]);
  if (members.size() > 1) names += " and " + std::to_string(members.size() - 1) + " meshed with it";
  return names;
}

std::string regionNameOf(const Feature& feature) {
  for (const std::string_view wanted : {"tag", "region", "name"}) {
    for (const auto& [key, value] : feature.attributes) {
      if (lowerCase(key) == wanted) return value;
    }
  }
  return std::to_string(feature.fid);
}

std::string lineNameOf(const Feature& feature) {
  return feature.use == FeatureUse::Region ? regionNameOf(feature) : std::string(nameOf(feature.attributes));
}

}  // namespace coastmesh
