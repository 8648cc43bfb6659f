#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <string>
#include <vector>

#include "core/pslg.hpp"

namespace coastmesh {

// A numpy array over memory that `owner` keeps; not to be written to, since others see the same bytes.
template <typename T>
pybind11::array viewOf(const T* data, std::vector<pybind11::ssize_t> shape, const pybind11::object& owner) {
  pybind11::array_t<T> array(std::move(shape), data, owner);
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

// What came from a file or the system, not of Python's own making, as a str: bytes that are no UTF-8 as os.fsdecode has
// them.
inline pybind11::str textOf(const std::string& text) {
  PyObject* made = PyUnicode_DecodeFSDefaultAndSize(text.data(), static_cast<Py_ssize_t>(text.size()));
  if (made == nullptr) throw pybind11::error_already_set();
  return pybind11::reinterpret_steal<pybind11::str>(made);
}

// Points of shape (n, 2), segments of shape (m, 2) of indices into them, holes of shape (k, 2), in numpy arrays or what
// numpy makes one of. Throws InputError for another shape and for what is no number or no index.
std::shared_ptr<const Pslg> pslgOf(const pybind11::object& points, const pybind11::object& segments,
                                   const pybind11::object& holes);

}  // namespace coastmesh
