#include "apps/report/per_feature_report.hpp"

#include <cstdio>

#include "apps/report/mesh_report.hpp"
#include "apps/report/report_sections.hpp"
#include "gis/for_count.hpp"

namespace coastmesh {

namespace {

Json figures(const MeshQuality& quality) {
  const bool any = quality.triangles > 0;
  return {{"vertices", quality.vertices},
          {"triangles", quality.triangles},
          {"min_angle_deg", any ? Json(quality.min_angle_deg) : Json(nullptr)},
          {"max_angle_deg", any ? Json(quality.max_angle_deg) : Json(nullptr)}};
}

}  // namespace

bool isMeshed(const FeatureOutcome& feature) {
  return feature.state == FeatureState::Made || feature.state == FeatureState::Short;
}

std::string_view toString(FeatureState state) {
  switch (state) {
    case FeatureState::Made:
      return "made";
    case FeatureState::Short:
      return "short";
    case FeatureState::Skipped:
      return "skipped";
    case FeatureState::Refused:
      break;
  }
  return "refused";
}

FeatureSums sumsOf(const std::vector<FeatureOutcome>& features) {
  FeatureSums sums;
  for (const FeatureOutcome& feature : features) {
    sums.made += feature.state == FeatureState::Made;
    sums.short_of += feature.state == FeatureState::Short;
    sums.skipped += feature.state == FeatureState::Skipped;
    sums.refused += feature.state == FeatureState::Refused;
    sums.over_budget += feature.over_budget;
    if (isMeshed(feature)) sums.quality.add(feature.quality);
  }
  return sums;
}

std::string perFeatureReport(const std::vector<std::string>& files, const ReadReport& read, const Crs& crs,
                             const std::vector<FeatureOutcome>& features, const std::vector<std::string>& warnings,
                             const PerFeatureTimes& seconds, int threads) {
  const FeatureSums sums = sumsOf(features);
  Json list = Json::array();
  for (const FeatureOutcome& feature : features) {
    const bool meshed = isMeshed(feature);
    list.push_back({{"name", feature.name},
                    {"source", feature.source},
                    {"fid", feature.fid},
                    {"state", toString(feature.state)},
                    {"reason", feature.reason.empty() ? Json(nullptr) : Json(feature.reason)},
                    {"outputs", feature.state == FeatureState::Refused ? Json::array() : Json(feature.outputs)},
                    {"mesh", meshed ? figures(feature.quality) : Json(nullptr)},
                    {"digest", meshed ? Json(digestText(feature.digest)) : Json(nullptr)}});
  }
  const Json report{
      {"coastmesh", COASTMESH_VERSION},
      {"warnings", warnings},
      {"input", readSection(files, read, crs)},
      {"per_feature",
       {{"made", sums.made}, {"short", sums.short_of}, {"skipped", sums.skipped}, {"refused", sums.refused}}},
      {"mesh", figures(sums.quality)},
      {"features", std::move(list)},
      {"time_s", {{"read", seconds.read}, {"total", seconds.total}}},
      {"peak_memory_mib", peakMemoryMib()},
      {"threads", threads}};
  return textOf(report);
}

std::string perFeatureSummary(const std::vector<FeatureOutcome>& features, double seconds) {
  const FeatureSums sums = sumsOf(features);
  std::string text = grouped(sums.meshed()) + " of " + grouped(features.size()) +
                     forCount(features.size(), " feature", " features") + " meshed";
  if (sums.skipped > 0)
    text += ", " + grouped(sums.skipped) + forCount(sums.skipped, " was", " were") + " there already";
  if (sums.refused > 0) text += ", " + grouped(sums.refused) + " left out";
  if (sums.short_of > 0)
    text += "; " + grouped(sums.short_of) + forCount(sums.short_of, " is", " are") + " short of what was asked";
  text += "\n";
  if (sums.meshed() == 0) return text;
  char line[200];
  std::snprintf(line, sizeof line, "smallest angle %.2f, largest %.2f degrees; %.2f s, %.0f MiB\n",
                sums.quality.min_angle_deg, sums.quality.max_angle_deg, seconds, peakMemoryMib());
  return text + grouped(sums.quality.vertices) + " vertices, " + grouped(sums.quality.triangles) +
         " triangles in all\n" + line;
}

}  // namespace coastmesh
