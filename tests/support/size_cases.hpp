#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/pslg.hpp"
#include "tests/support/size_figures.hpp"

namespace coastmesh {

// A polygon with a few long sides, so that the input does not force edges shorter than requested.
inline Pslg wideLake() {
  Pslg pslg;
  pslg.points = {{0.0, 0.0}, {2.03, 0.1}, {2.4, 1.3}, {1.1, 2.01}, {-0.2, 1.2}};
  for (VertexId i = 0; i < 5; ++i) pslg.segments.push_back({i, (i + 1) % 5});
  return pslg;
}

// A long band between two saws: many segments.
inline Pslg sawBand(std::uint32_t teeth) {
  Pslg pslg;
  for (std::uint32_t i = 0; i <= teeth; ++i) pslg.points.push_back({1.0 * i, i % 2 == 0 ? 0.0 : 0.3});
  for (std::uint32_t i = teeth + 1; i-- > 0;) pslg.points.push_back({1.0 * i, i % 2 == 0 ? 3.0 : 3.3});
  const auto count = static_cast<std::uint32_t>(pslg.points.size());
  for (std::uint32_t i = 0; i < count; ++i) pslg.segments.push_back({i, (i + 1) % count});
  return pslg;
}

struct Wanted {
  std::string name;
  SizeOf size;
};

inline std::vector<Wanted> smoothSizes() {
  return {
      {"Constant", SizeOf(0.03, 0.03, [](const Point&) { return 0.03; })},
      {"Linear", SizeOf(0.01, 0.2, [](const Point& p) { return 0.02 + 0.05 * (p.x + 0.2); })},
      {"Steep", SizeOf(0.005, 0.5, [](const Point& p) { return 0.006 + 0.12 * (p.x + 0.2); })},
      {"RoundAPlace", SizeOf(0.008, 0.5, [](const Point& p) { return 0.01 + 0.1 * std::hypot(p.x - 1.0, p.y - 1.0); })},
      {"Wavy",
       SizeOf(0.01, 0.1, [](const Point& p) { return 0.03 + 0.015 * std::sin(4.0 * p.x) * std::cos(3.0 * p.y); })},
  };
}

}  // namespace coastmesh
