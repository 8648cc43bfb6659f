#include "apps/job/step_outcome.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "apps/job/places.hpp"

namespace coastmesh {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kPlacesListed = 1000;

std::string amount(const char* format, double number) {
  char text[60];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

// How many there are of each cause, and what helps.
template <typename Short>
std::string causesText(const std::vector<Short>& found, const SizeOptions& sizes) {
  std::array<std::size_t, kShortCauses> counts{};
  for (const Short& one : found) ++counts[static_cast<std::size_t>(one.cause)];
  const bool follows = sizes.coast == CoastDetail::Follow;
  const std::array<std::string, kShortCauses> texts{
      follows ? "at edges of the shore, which larger sizes there make longer"
              : "at edges of the shore, which --coast follow makes as long as the sizes",
      follows ? "where water is narrow, which a larger --channel-min closes"
              : "where water is narrow, which --coast follow closes",
      "elsewhere, where larger sizes, a larger --size-max or a smaller --min-angle help"};
  std::string text;
  for (std::size_t cause = 0; cause < kShortCauses; ++cause)
    if (counts[cause] > 0) text += (text.empty() ? "" : "; ") + std::to_string(counts[cause]) + " " + texts[cause];
  return text;
}

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

std::vector<std::string> warningsOf(const StepOutcome& outcome, const SizeOptions& sizes) {
  const std::vector<ShortStep>& below_step = outcome.below_step;
  const std::vector<ShortEdge>& below_least = outcome.below_least;
  std::vector<std::string> all;
  if (!below_step.empty()) {
    const ShortStep& worst = below_step.front();
    all.push_back("--time-step " + amount("%g", sizes.time_step_s) + " at --courant " + amount("%g", sizes.courant) +
                  " does not hold in " + std::to_string(below_step.size()) + " triangles, the worst at " +
                  pointText(worst.place) + amount(" with %.3g s: ", worst.step_s * sizes.courant) +
                  causesText(below_step, sizes));
  }
  if (!below_least.empty()) {
    all.push_back("edges shorter than --size-min " + amount("%g", sizes.least_m) + ": " +
                  std::to_string(below_least.size()) + ", the shortest of " +
                  amount("%.4g m at ", below_least.front().length_m) + pointText(below_least.front().place) + ": " +
                  causesText(below_least, sizes));
  }
  return all;
}

}  // namespace

StepOutcome measureOutcome(const Grid& grid, const SizeOptions& sizes, const ItemLoop& loop) {
  StepOutcome outcome;
  outcome.step = measureStep(grid, loop);
  if (sizes.time_step_s > 0.0) outcome.below_step = stepsBelow(grid, sizes.time_step_s, sizes.courant);
  if (sizes.least_m > 0.0 && sizes.any()) outcome.below_least = edgesBelow(grid, sizes.least_m);
  outcome.least_missed = sizes.coast == CoastDetail::Follow && !outcome.below_least.empty() &&
                         outcome.below_least.front().length_m < StepOutcome::kShareOfLeast * sizes.least_m;
  outcome.warnings = warningsOf(outcome, sizes);
  return outcome;
}

std::string stepText(const StepReport& step, bool plane) {
  std::string text =
      amount("shortest edge %.4g", step.shortest_edge_m) + (plane ? " at " : " m at ") + pointText(step.shortest_edge);
  if (!step.has_depths) return text + "; without depths there is no time step";
  if (!std::isfinite(step.step_s)) return text + "; nothing is under water, so there is no time step";
  return text + amount("; time step by CFL %.3g s at ", step.step_s) + pointText(step.step_place);
}

nlohmann::ordered_json stepJson(const StepReport& step) {
  const bool any = step.has_depths && std::isfinite(step.step_s);
  const auto placeJson = [](const Point& place) { return Json{{"x", place.x}, {"y", place.y}}; };
  return {{"shortest_edge_m", step.shortest_edge_m},
          {"shortest_edge", placeJson(step.shortest_edge)},
          {"with_depths", step.has_depths},
          {"time_step_s", any ? Json(step.step_s) : Json(nullptr)},
          {"time_step", any ? placeJson(step.step_place) : Json(nullptr)}};
}

nlohmann::ordered_json outcomeJson(const StepOutcome& outcome, const SizeOptions& sizes) {
  Json section = stepJson(outcome.step);
  section["asked"] = nullptr;
  section["size_min"] = nullptr;
  if (sizes.time_step_s > 0.0)
    section["asked"] = {{"time_step_s", sizes.time_step_s},
                        {"courant", sizes.courant},
                        {"missed", outcome.below_step.size()},
                        {"places", placesJson(outcome.below_step, "time_step_s", &ShortStep::step_s)}};
  if (sizes.least_m > 0.0 && sizes.any())
    section["size_min"] = {{"size_min_m", sizes.least_m},
                           {"shorter", outcome.below_least.size()},
                           {"missed", outcome.least_missed},
                           {"places", placesJson(outcome.below_least, "length_m", &ShortEdge::length_m)}};
  return section;
}

}  // namespace coastmesh
