#include "gis/rivers/river_rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/metric.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// In a bend a row is at most this share of its radius long, about 29 degrees.
constexpr double kOfBend = 0.5;
// The shortest row, as a share of the width of its cells.
constexpr double kShortest = 0.25;
// Rows differ in length by at most this share of the distance between them.
constexpr double kGrowth = 0.5;
constexpr double kMostRows = 50e6;

// Places of sections: where the integral of rows over length is whole.
std::vector<double> sectionPlaces(const RiverCourse& course, double from, double to, std::size_t cells, double aspect) {
  const auto lengthAt = [&](double along) {
    const RiverSection section = course.sectionAt(along);
    const double cell = section.width / static_cast<double>(cells);
    const double beside_water = std::max(section.room, cell);
    return std::min({aspect * cell, beside_water, std::max(kOfBend * section.bend, kShortest * cell)});
  };
  const double step_wanted = 0.25 * course.meanWidth();
  const auto steps = static_cast<std::size_t>(std::clamp(std::ceil((to - from) / step_wanted), 8.0, kMostRows));
  const double step = (to - from) / static_cast<double>(steps);
  std::vector<double> lengths;  // in the middle of each step
  for (std::size_t i = 0; i < steps; ++i) lengths.push_back(lengthAt(from + (static_cast<double>(i) + 0.5) * step));
  for (std::size_t i = 1; i < steps; ++i) lengths[i] = std::min(lengths[i], lengths[i - 1] + kGrowth * step);
  for (std::size_t i = steps - 1; i > 0; --i) lengths[i - 1] = std::min(lengths[i - 1], lengths[i] + kGrowth * step);
  std::vector<double> rows_before(1, 0.0);  // at each step
  for (const double length : lengths) rows_before.push_back(rows_before.back() + step / length);
  const double rows = std::max(1.0, std::round(std::min(rows_before.back(), kMostRows)));
  std::vector<double> places(1, from);
  std::size_t i = 0;
  for (double row = 1.0; row < rows; ++row) {
    const double wanted = row / rows * rows_before.back();
    while (rows_before[i + 1] < wanted) ++i;
    const double share = (wanted - rows_before[i]) / (rows_before[i + 1] - rows_before[i]);
    places.push_back(from + (static_cast<double>(i) + share) * step);
  }
  places.push_back(to);
  return places;
}

bool foldsBetween(const RiverSection& a, const RiverSection& b) {
  const Point right = a.at(0.0), left = a.at(1.0), next_right = b.at(0.0), next_left = b.at(1.0);
  return orient2d(right, next_right, next_left) <= 0 || orient2d(next_right, next_left, left) <= 0 ||
         orient2d(next_left, left, right) <= 0 || orient2d(left, right, next_right) <= 0;
}

// Leaves out sections until no two that follow one another meet. The first and the last stay.
void unfold(std::vector<RiverSection>& sections) {
  std::vector<RiverSection> kept;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const bool is_last = i + 1 == sections.size();
    while (is_last && kept.size() > 1 && foldsBetween(kept.back(), sections[i])) kept.pop_back();
    if (!kept.empty() && !is_last && foldsBetween(kept.back(), sections[i])) continue;
    kept.push_back(sections[i]);
  }
  if (kept.size() == 2 && foldsBetween(kept[0], kept[1])) kept.clear();
  sections = std::move(kept);
}

}  // namespace

RiverRows riverRows(const RiverCourse& course, double from, double to, std::size_t cells, double aspect) {
  RiverRows rows;
  rows.cells = cells;
  for (const double place : sectionPlaces(course, from, to, cells, aspect))
    rows.sections.push_back(course.sectionAt(place));
  unfold(rows.sections);
  for (const RiverSection& section : rows.sections)
    for (std::size_t i = 0; i <= cells; ++i)
      rows.nodes.push_back(section.at(static_cast<double>(i) / static_cast<double>(cells)));
  return rows;
}

}  // namespace coastmesh
