#include "gis/geometry/membrane.hpp"

#include <algorithm>
#include <cmath>

namespace coastmesh {

namespace {

void apply(const Membrane& m, const std::vector<double>& values, std::vector<double>& to, const ItemLoop& loop) {
  forEachByStretches(loop, values.size(), [&](std::size_t i) {
    double sum = m.degree[i] * values[i];
    for (std::size_t k = m.begin[i]; k < m.begin[i + 1]; ++k) sum -= m.weight[k] * values[m.neighbour[k]];
    to[i] = sum;
  });
}

// The same for any number of threads.
template <typename Term>
double sumOf(std::size_t count, const Term& term, const ItemLoop& loop) {
  double all = 0.0;
  for (const double part : overStretches(loop, count, [&](std::size_t first, std::size_t last) {
         double sum = 0.0;
         for (std::size_t i = first; i < last; ++i) sum += term(i);
         return sum;
       }))
    all += part;
  return all;
}

double farthest(const Membrane& m, const std::vector<double>& rest) {
  double most = 0.0;
  for (std::size_t i = 0; i < rest.size(); ++i) most = std::max(most, std::abs(rest[i]) / m.degree[i]);
  return most;
}

}  // namespace

void settle(const Membrane& m, std::vector<double>& values, const ItemLoop& loop) {
  constexpr int kMostSteps = 1000;
  constexpr double kClose = 1e-5, kRounding = 1e-12;  // error bounds, relative to the fixed values' range and size
  const double close = kClose * (m.high - m.low) + kRounding * std::max(std::abs(m.low), std::abs(m.high));
  const std::size_t count = values.size();
  std::vector<double> rest(count), way(count), image(count);
  apply(m, values, image, loop);
  forEachByStretches(loop, count, [&](std::size_t i) {
    rest[i] = m.fixed[i] - image[i];
    way[i] = rest[i] / m.degree[i];
  });
  double size = sumOf(
      count, [&](std::size_t i) { return rest[i] * rest[i] / m.degree[i]; }, loop);
  for (int step = 0; step < kMostSteps && farthest(m, rest) > close; ++step) {
    apply(m, way, image, loop);
    const double length = size / sumOf(
                                     count, [&](std::size_t i) { return way[i] * image[i]; }, loop);
    forEachByStretches(loop, count, [&](std::size_t i) {
      values[i] += length * way[i];
      rest[i] -= length * image[i];
    });
    const double left = sumOf(
        count, [&](std::size_t i) { return rest[i] * rest[i] / m.degree[i]; }, loop);
    forEachByStretches(loop, count, [&](std::size_t i) { way[i] = rest[i] / m.degree[i] + left / size * way[i]; });
    size = left;
  }
  for (double& value : values) value = std::clamp(value, m.low, m.high);
}

}  // namespace coastmesh
