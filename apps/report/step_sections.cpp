#include "apps/report/step_sections.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace coastmesh {

namespace {

constexpr std::size_t kPlacesListed = 1000;

template <typename Short>
Json placesJson(const std::vector<Short>& found, const char* key, double Short::*value) {
  Json places = Json::array();
  for (std::size_t i = 0; i < std::min(kPlacesListed, found.size()); ++i)
    places.push_back({{"x", found[i].place.x},
                      {"y", found[i].place.y},
                      {key, found[i].*value},
                      {"cause", toString(found[i].cause)}});
  return places;
}

}  // namespace

Json stepSection(const StepReport& step) {
  const bool any = step.has_depths && std::isfinite(step.step_s);
  const auto placeJson = [](const Point& place) { return Json{{"x", place.x}, {"y", place.y}}; };
  return {{"shortest_edge_m", step.shortest_edge_m},
          {"shortest_edge", placeJson(step.shortest_edge)},
          {"with_depths", step.has_depths},
          {"time_step_s", any ? Json(step.step_s) : Json(nullptr)},
          {"time_step", any ? placeJson(step.step_place) : Json(nullptr)},
          {"flooded", step.flood_m == 0.0 ? Json(nullptr)
                                          : Json{{"height_m", step.flood_m},
                                                 {"time_step_s", step.flooded_step_s},
                                                 {"time_step", placeJson(step.flooded_place)}}}};
}

Json outcomeSection(const StepOutcome& outcome, const SizeOptions& sizes) {
  Json section = stepSection(outcome.step);
  section["asked"] = nullptr;
  section["size_min"] = nullptr;
  if (sizes.time_step_s > 0.0)
    section["asked"] = {{"time_step_s", sizes.time_step_s},
                        {"courant", sizes.courant},
                        {"courant_min", sizes.least_courant},
                        {"missed", outcome.below_step.size()},
                        {"missed_min", outcome.above_step.size()},
                        {"places", placesJson(outcome.below_step, "time_step_s", &ShortStep::step_s)}};
  if (sizes.least_m > 0.0 && sizes.any())
    section["size_min"] = {{"size_min_m", sizes.least_m},
                           {"shorter", outcome.below_least.size()},
                           {"missed", outcome.least_missed},
                           {"places", placesJson(outcome.below_least, "length_m", &ShortEdge::length_m)}};
  return section;
}

}  // namespace coastmesh
