#include "gis/geometry/crossing.hpp"

#include <algorithm>
#include <cmath>

namespace coastmesh {

namespace {

// The unevaluated sum of two doubles, the low one at most half a unit in the last place of the high one: 106 bits or
// more (Dekker 1971).
struct Wide {
  double high, low;
};

// Exact if |a| >= |b|.
Wide quickSum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// Exact (Knuth).
Wide sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

Wide operator-(const Wide& a) { return {-a.high, -a.low}; }

Wide operator+(const Wide& a, const Wide& b) {
  Wide high = sum(a.high, b.high);
  const Wide low = sum(a.low, b.low);
  high = quickSum(high.high, high.low + low.high);
  return quickSum(high.high, high.low + low.low);
}

Wide operator-(const Wide& a, const Wide& b) { return a + -b; }

Wide operator*(const Wide& a, const Wide& b) {
  const double high = a.high * b.high;
  return quickSum(high, std::fma(a.high, b.high, -high) + (a.high * b.low + a.low * b.high));
}

Wide operator/(const Wide& a, const Wide& b) {
  // Long division: each digit has the 53 bits of a double.
  Wide left = a;
  double digits[3];
  for (double& digit : digits) {
    digit = left.high / b.high;
    left = left - Wide{digit, 0.0} * b;
  }
  return quickSum(digits[0], digits[1]) + Wide{digits[2], 0.0};
}

}  // namespace

Point crossingPoint(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Wide ux = sum(b.x, -a.x), uy = sum(b.y, -a.y), vx = sum(d.x, -c.x), vy = sum(d.y, -c.y);
  const Wide wx = sum(c.x, -a.x), wy = sum(c.y, -a.y);
  const Wide determinant = ux * vy - uy * vx;
  if (determinant.high == 0.0) return b;
  const Wide share = (wx * vy - wy * vx) / determinant;
  const auto within = [](double value, double p, double q, double r, double s) {
    return std::clamp(value, std::max(std::min(p, q), std::min(r, s)), std::min(std::max(p, q), std::max(r, s)));
  };
  return {within((Wide{a.x, 0.0} + share * ux).high, a.x, b.x, c.x, d.x),
          within((Wide{a.y, 0.0} + share * uy).high, a.y, b.y, c.y, d.y)};
}

}  // namespace coastmesh
