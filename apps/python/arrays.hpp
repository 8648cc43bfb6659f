#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/pslg.hpp"

namespace coastmesh {

// A read-only numpy array over memory that `owner` keeps alive: others see the same bytes.
template <typename T>
pybind11::array viewOf(const T* data, std::vector<pybind11::ssize_t> shape, const pybind11::object& owner) {
  pybind11::array_t<T> array(std::move(shape), data, owner);
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

// A text from a file or the system as a str; bytes that are not UTF-8 are decoded as by os.fsdecode.
inline pybind11::str textOf(const std::string& text) {
  PyObject* made = PyUnicode_DecodeFSDefaultAndSize(text.data(), static_cast<Py_ssize_t>(text.size()));
  if (made == nullptr) throw pybind11::error_already_set();
  return pybind11::reinterpret_steal<pybind11::str>(made);
}

// Numpy arrays, or anything that numpy converts, as numbers. `name`: in messages. An empty array may have any shape.
// They throw InputError for other shapes, and elements that are not plain numbers.
std::vector<Point> pointsOf(const pybind11::object& object, const std::string& name);    // of shape (n, 2)
std::vector<double> numbersOf(const pybind11::object& object, const std::string& name);  // of shape (n,)
// Of shape (n, columns), row after row: indices of `count` points. Throws InputError for others as well.
std::vector<std::uint32_t> indicesOf(const pybind11::object& object, const std::string& name, std::size_t columns,
                                     std::size_t count);

// Points of shape (n, 2), segments of shape (m, 2) with indices of points, holes of shape (k, 2), as numpy arrays or
// anything that numpy converts; segments and holes may be None. Throws InputError for other shapes, elements that are
// not numbers, and invalid indices.
std::shared_ptr<const Pslg> pslgOf(const pybind11::object& points, const pybind11::object& segments,
                                   const pybind11::object& holes);

}  // namespace coastmesh
