#pragma once

#include <pybind11/numpy.h>

#include <memory>
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

// Points of shape (n, 2), segments of shape (m, 2) of indices into them, holes of shape (k, 2), in numpy arrays or what
// numpy makes one of. Throws InputError for another shape and for what is no number or no index.
std::shared_ptr<const Pslg> pslgOf(const pybind11::object& points, const pybind11::object& segments,
                                   const pybind11::object& holes);

}  // namespace coastmesh
