#include "apps/python/arrays.hpp"

#include <cstdint>
#include <cstring>
#include <string>

#include "gis/error.hpp"

namespace py = pybind11;

namespace coastmesh {

namespace {

template <typename T>
using Rows = py::array_t<T, py::array::c_style | py::array::forcecast>;

// Throws InputError for arrays that numpy would convert to something else: masked and complex ones.
void requirePlain(const py::object& object, const std::string& name) {
  if (py::module_::import("numpy.ma").attr("is_masked")(object).cast<bool>())
    throw InputError(name + ": has masked elements; take their rows out, or fill them");
  const py::array given = py::array::ensure(object);
  if (!given) PyErr_Clear();
  if (given && given.dtype().kind() == 'c')
    throw InputError(name + ": is not an array of real numbers but of complex ones");
}

// Rows of two numbers; empty for an empty array of any shape.
template <typename T>
Rows<T> pairs(const py::object& object, const std::string& name) {
  requirePlain(object, name);
  const Rows<T> rows = Rows<T>::ensure(object);
  if (!rows) {
    PyErr_Clear();
    throw InputError(name + ": is not an array of numbers");
  }
  if (rows.size() > 0 && (rows.ndim() != 2 || rows.shape(1) != 2)) {
    std::string shape;
    for (py::ssize_t i = 0; i < rows.ndim(); ++i) shape += (i == 0 ? "" : ", ") + std::to_string(rows.shape(i));
    throw InputError(name + ": has the shape (" + shape + "), should have (n, 2)");
  }
  return rows;
}

std::vector<Point> pointsOf(const py::object& object, const std::string& name) {
  const Rows<double> rows = pairs<double>(object, name);
  std::vector<Point> points(static_cast<std::size_t>(rows.size() / 2));
  static_assert(sizeof(Point) == 2 * sizeof(double));
  if (!points.empty()) std::memcpy(static_cast<void*>(points.data()), rows.data(), points.size() * sizeof(Point));
  return points;
}

// Truncating 0.7 to an index would mesh something else than was asked for.
void requireWhole(const py::object& object) {
  const py::array given = py::array::ensure(object);
  if (!given) {
    PyErr_Clear();
    throw InputError("segments: is not an array of indices");
  }
  if (given.size() > 0 && given.dtype().kind() != 'i' && given.dtype().kind() != 'u') {
    throw InputError("segments: has elements of type " + py::str(given.dtype()).cast<std::string>() +
                     ", should have whole numbers: indices of points");
  }
}

}  // namespace

std::shared_ptr<const Pslg> pslgOf(const py::object& points, const py::object& segments, const py::object& holes) {
  auto pslg = std::make_shared<Pslg>();
  pslg->points = pointsOf(points, "points");
  if (pslg->points.size() < 3) throw InputError("points: three or more are needed");
  if (!holes.is_none()) pslg->holes = pointsOf(holes, "holes");
  if (segments.is_none()) return pslg;

  requireWhole(segments);
  const Rows<std::int64_t> rows = pairs<std::int64_t>(segments, "segments");
  const auto count = static_cast<std::int64_t>(pslg->points.size());
  const std::int64_t* at = rows.data();
  pslg->segments.resize(static_cast<std::size_t>(rows.size() / 2));
  for (std::size_t i = 0; i < pslg->segments.size(); ++i) {
    for (std::int64_t end : {at[2 * i], at[2 * i + 1]}) {
      if (end >= 0 && end < count) continue;
      throw InputError("segments: row " + std::to_string(i) + " names point " + std::to_string(end) +
                       ", but there are " + std::to_string(count) + ", counted from 0");
    }
    pslg->segments[i].a = static_cast<VertexId>(at[2 * i]);
    pslg->segments[i].b = static_cast<VertexId>(at[2 * i + 1]);
  }
  return pslg;
}

}  // namespace coastmesh
