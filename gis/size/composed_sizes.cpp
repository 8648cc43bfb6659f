#include "gis/size/composed_sizes.hpp"

#include <algorithm>
#include <cmath>

namespace coastmesh {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
// Sizes at places and in boxes worth a range of their own: each takes about a microsecond.
constexpr std::size_t kLeastRange = 512;

}  // namespace

double ComposedSizes::bounded(double size, double floor) const {
  return std::min(std::max({size, limits_.least_m, floor}), limits_.most_m);
}

void ComposedSizes::limitRate(double rate) {
  for (const auto& field : fields_) field->limitRate(rate);
  for (SizeField* field : {floor_.get(), rim_least_.get(), rim_most_.get()})
    if (field != nullptr) field->limitRate(rate);
}

void ComposedSizes::sample(std::span<const Point> places, std::span<double> sizes) const {
  forStretches(
      loop_, places.size(),
      [&](std::size_t first, std::size_t last) {
        const auto here = places.subspan(first, last - first);
        const auto out = sizes.subspan(first, last - first);
        std::vector<double> own(here.size());
        std::ranges::fill(out, limits_.everywhere_m);
        std::vector<Point> asked;
        std::vector<std::size_t> which;
        for (const auto& field : fields_) {
          asked.clear();
          which.clear();
          for (std::size_t i = 0; i < out.size(); ++i) {
            if (!(out[i] > field->least())) continue;
            asked.push_back(here[i]);
            which.push_back(i);
          }
          field->sample(asked, std::span(own).first(asked.size()));
          for (std::size_t k = 0; k < which.size(); ++k) out[which[k]] = std::min(out[which[k]], own[k]);
        }
        std::ranges::fill(own, 0.0);
        if (floor_) floor_->sample(here, own);
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = bounded(out[i], own[i]);
        if (rim_least_) {
          rim_least_->sample(here, own);
          for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::max(out[i], own[i]);
          rim_most_->sample(here, own);
          for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::min(out[i], own[i]);
        }
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::min(out[i], most_m_) * measure_(here[i]);
      },
      kLeastRange);
}

void ComposedSizes::bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const {
  forStretches(
      loop_, boxes.size(),
      [&](std::size_t first, std::size_t last) {
        const auto here = boxes.subspan(first, last - first);
        const auto out = ranges.subspan(first, last - first);
        std::vector<SizeRange> own(here.size());
        std::ranges::fill(out, SizeRange{limits_.everywhere_m, limits_.everywhere_m, limits_.everywhere_m, true});
        std::vector<SizeBox> asked;
        std::vector<std::size_t> which;
        for (const auto& field : fields_) {
          asked.clear();
          which.clear();
          for (std::size_t i = 0; i < out.size(); ++i) {
            if (!(out[i].high > field->least())) continue;
            asked.push_back(here[i]);
            which.push_back(i);
          }
          field->bound(asked, std::span(own).first(asked.size()));
          for (std::size_t k = 0; k < which.size(); ++k) {
            SizeRange& range = out[which[k]];
            const double a = range.at_centre, b = own[k].at_centre;
            const bool is_graded =
                (range.is_graded || own[k].high <= range.low) && (field->isGraded() || range.high <= own[k].low);
            range = {std::min(range.low, own[k].low), std::min(range.high, own[k].high),
                     std::isnan(a) || std::isnan(b) ? kUnknown : std::min(a, b), is_graded};
          }
        }
        std::ranges::fill(own, SizeRange{0.0, 0.0, 0.0});
        if (floor_) floor_->bound(here, own);
        for (std::size_t i = 0; i < out.size(); ++i) {
          const bool known = !std::isnan(out[i].at_centre) && !std::isnan(own[i].at_centre);
          out[i] = {bounded(out[i].low, own[i].low), bounded(out[i].high, own[i].high),
                    known ? bounded(out[i].at_centre, own[i].at_centre) : kUnknown,
                    out[i].is_graded && own[i].high <= out[i].low};
        }
        if (rim_least_) boundByRim(here, own, out);
        for (std::size_t i = 0; i < out.size(); ++i) {
          const double measure = measure_(here[i].centre);
          SizeRange& range = out[i];
          for (double* size : {&range.low, &range.high, &range.at_centre})
            if (!std::isnan(*size)) *size = std::min(*size, most_m_) * measure;
        }
      },
      kLeastRange);
}

// Bounds of sizes with the rim, from those without it; `own` is memory.
void ComposedSizes::boundByRim(std::span<const SizeBox> boxes, std::vector<SizeRange>& own,
                               std::span<SizeRange> ranges) const {
  const auto combine = [&](const SizeField& field, const auto& of, bool raises) {
    field.bound(boxes, own);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      SizeRange& range = ranges[i];
      const double a = range.at_centre, b = own[i].at_centre;
      // Sizes of the rim grow at most by the gradation.
      const bool is_of_rim = raises ? range.high <= own[i].low : own[i].high <= range.low;
      range = {of(range.low, own[i].low), of(range.high, own[i].high),
               std::isnan(a) || std::isnan(b) ? kUnknown : of(a, b), range.is_graded || is_of_rim};
    }
  };
  combine(
      *rim_least_, [](double a, double b) { return std::max(a, b); }, true);
  combine(
      *rim_most_, [](double a, double b) { return std::min(a, b); }, false);
}

double ComposedSizes::leastWanted() const {
  double least = limits_.everywhere_m;
  for (const auto& field : fields_) least = std::min(least, field->least());
  return std::max(least, limits_.least_m);
}

std::string ComposedSizes::optionAt(const Point& place) const {
  double least = limits_.everywhere_m, own = 0.0;
  std::string option = "--size";
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    fields_[f]->sample(std::span(&place, 1), std::span(&own, 1));
    if (!(own < least)) continue;
    least = own;
    option = asking_[f];
  }
  if (least < limits_.least_m) option = "--size-min";
  if (limits_.most_m <= least) option = "--size-max";
  if (most_m_ < std::min(least, limits_.most_m)) option = "--grade";
  return option;
}

}  // namespace coastmesh
