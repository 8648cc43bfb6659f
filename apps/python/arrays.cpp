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

std::string shapeOf(const py::array& rows) {
  std::string shape;
  for (py::ssize_t i = 0; i < rows.ndim(); ++i) shape += (i == 0 ? "" : ", ") + std::to_string(rows.shape(i));
  return "(" + shape + ")";
}

// Numbers of the shape (n, `columns`), or (n,) for none; empty for an empty array of any shape.
template <typename T>
Rows<T> rowsOf(const py::object& object, const std::string& name, py::ssize_t columns) {
  requirePlain(object, name);
  const Rows<T> rows = Rows<T>::ensure(object);
  if (!rows) {
    PyErr_Clear();
    throw InputError(name + ": is not an array of numbers");
  }
  const bool fits = columns == 0 ? rows.ndim() == 1 : rows.ndim() == 2 && rows.shape(1) == columns;
  if (rows.size() > 0 && !fits) {
    throw InputError(name + ": has the shape " + shapeOf(rows) + ", should have (n," +
                     (columns == 0 ? "" : " " + std::to_string(columns)) + ")");
  }
  return rows;
}

// Truncating 0.7 to an index would mesh something else than was asked for.
void requireWhole(const py::object& object, const std::string& name) {
  const py::array given = py::array::ensure(object);
  if (!given) {
    PyErr_Clear();
    throw InputError(name + ": is not an array of indices");
  }
  if (given.size() > 0 && given.dtype().kind() != 'i' && given.dtype().kind() != 'u') {
    throw InputError(name + ": has elements of type " + py::str(given.dtype()).cast<std::string>() +
                     ", should have whole numbers: indices of points");
  }
}

}  // namespace

std::vector<Point> pointsOf(const py::object& object, const std::string& name) {
  const Rows<double> rows = rowsOf<double>(object, name, 2);
  std::vector<Point> points(static_cast<std::size_t>(rows.size() / 2));
  static_assert(sizeof(Point) == 2 * sizeof(double));
  if (!points.empty()) std::memcpy(static_cast<void*>(points.data()), rows.data(), points.size() * sizeof(Point));
  return points;
}

std::vector<double> numbersOf(const py::object& object, const std::string& name) {
  const Rows<double> rows = rowsOf<double>(object, name, 0);
  return {rows.data(), rows.data() + rows.size()};
}

std::vector<std::uint32_t> indicesOf(const py::object& object, const std::string& name, std::size_t columns,
                                     std::size_t count) {
  requireWhole(object, name);
  const Rows<std::int64_t> rows = rowsOf<std::int64_t>(object, name, static_cast<py::ssize_t>(columns));
  std::vector<std::uint32_t> indices(static_cast<std::size_t>(rows.size()));
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::int64_t index = rows.data()[i];
    if (index < 0 || index >= static_cast<std::int64_t>(count)) {
      throw InputError(name + ": row " + std::to_string(i / columns) + " names point " + std::to_string(index) +
                       ", but there are " + std::to_string(count) + ", counted from 0");
    }
    indices[i] = static_cast<std::uint32_t>(index);
  }
  return indices;
}

std::shared_ptr<const Pslg> pslgOf(const py::object& points, const py::object& segments, const py::object& holes) {
  auto pslg = std::make_shared<Pslg>();
  pslg->points = pointsOf(points, "points");
  if (pslg->points.size() < 3) throw InputError("points: three or more are needed");
  if (!holes.is_none()) pslg->holes = pointsOf(holes, "holes");
  if (segments.is_none()) return pslg;

  const std::vector<std::uint32_t> ends = indicesOf(segments, "segments", 2, pslg->points.size());
  pslg->segments.resize(ends.size() / 2);
  for (std::size_t i = 0; i < pslg->segments.size(); ++i) {
    pslg->segments[i].a = ends[2 * i];
    pslg->segments[i].b = ends[2 * i + 1];
  }
  return pslg;
}

}  // namespace coastmesh
