// The compiled half of the Python module: coastmesh/__init__.py is what users import.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <string>
#include <vector>

#include "apps/plot/plot_globe.hpp"
#include "apps/plot/plot_page.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/edit.hpp"
#include "apps/python/from_arrays.hpp"
#include "apps/python/pickle.hpp"
#include "apps/python/run.hpp"
#include "core/bulk_list.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/file/staged_files.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/format/grid_losses.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace py = pybind11;

namespace coastmesh {

namespace {

// For arrays whose elements are structs: `columns` consecutive numbers of type T.
template <typename T, typename Row>
py::array rowsOf(const BulkList<Row>& rows, py::ssize_t columns, const py::object& owner) {
  static_assert(sizeof(Row) % sizeof(T) == 0);
  return viewOf(reinterpret_cast<const T*>(rows.data()), {static_cast<py::ssize_t>(rows.size()), columns}, owner);
}

template <typename T, typename Allocator>
py::object columnOf(const std::vector<T, Allocator>& values, const py::object& owner) {
  if (values.empty()) return py::none();
  return viewOf(values.data(), {static_cast<py::ssize_t>(values.size())}, owner);
}

const MeshResult& meshOf(const py::object& mesh) { return mesh.cast<const MeshResult&>(); }
const Grid& gridOf(const py::object& mesh) { return meshOf(mesh).grid; }

py::list featuresOf(const Grid& grid) {
  py::list list;
  for (const GridFeature& feature : grid.features) {
    py::dict attributes;
    for (const auto& [name, value] : feature.attributes) attributes[textOf(name)] = textOf(value);
    py::dict entry;
    entry["fid"] = feature.fid;
    entry["source"] = textOf(feature.source);
    entry["attributes"] = attributes;
    list.append(entry);
  }
  return list;
}

py::array_t<std::uint32_t> quadsAsArray(const Grid& grid) {
  const std::vector<Quad> quads = quadsOf(grid);
  py::array_t<std::uint32_t> rows({static_cast<py::ssize_t>(quads.size()), py::ssize_t{4}});
  auto at = rows.mutable_unchecked<2>();
  for (py::ssize_t q = 0; q < rows.shape(0); ++q)
    for (py::ssize_t i = 0; i < 4; ++i)
      at(q, i) = quads[static_cast<std::size_t>(q)].nodes[static_cast<std::size_t>(i)];
  return rows;
}

py::list boundariesOf(const Grid& grid) {
  py::list list;
  for (const Boundary& boundary : grid.boundaries) {
    py::dict entry;
    entry["role"] = std::string(toString(boundary.role));
    entry["name"] = boundary.name;
    entry["closed"] = boundary.closed;
    entry["nodes"] = py::array_t<std::uint32_t>(static_cast<py::ssize_t>(boundary.nodes.size()), boundary.nodes.data());
    list.append(entry);
  }
  return list;
}

// Returns warnings of what the file cannot hold, and of numbers that models would misread.
py::list writeFile(const MeshResult& mesh, const std::string& path, const std::string& format, bool overwrite) {
  std::vector<std::string> warnings;
  {
    const py::gil_scoped_release release;
    const GridFormat& known = gridFormatFor(path, format);
    StagedOutput output(path, known, overwrite);
    withThreads({}, [&] { output.write(mesh.grid, Recorder().loop("write")); });
    output.commit();
    if (const std::string losses = lossesIn(mesh.grid, known, LossesOf::Input); !losses.empty())
      warnings.push_back("'" + path + "' cannot hold " + losses);
    if (known.says_depth) warnings.push_back(depthWarning(mesh.grid, path));
    if (known.lengths_in_metres) warnings.push_back(metreWarning(mesh.grid, path));
    std::erase(warnings, std::string());
  }
  py::list texts;
  for (const std::string& text : warnings) texts.append(textOf(inKeywordsOfMesh(text)));
  return texts;
}

// Returns a note if the picture is another than the one requested; otherwise an empty text.
std::string plotFile(const MeshResult& mesh, const std::string& path, const std::string& color, std::int64_t size,
                     bool edges, bool overwrite) {
  PlotOptions options;
  options.color = plotColorNamed(color);
  constexpr auto kLeast = static_cast<std::int64_t>(PlotOptions::kLeastSize),
                 kMost = static_cast<std::int64_t>(PlotOptions::kMostSize);
  if (size < kLeast || size > kMost) {
    throw OptionError("size: " + std::to_string(size) + " is not from " + std::to_string(kLeast) + " to " +
                      std::to_string(kMost) + " pixels");
  }
  options.size_px = static_cast<std::uint64_t>(size);
  options.edges = edges;
  const PageOptions in_page{
      .name = std::filesystem::path(path).stem().string(), .color = options.color, .edges = edges};
  const bool page = isPagePath(path);
  if (!page) requirePlotFormat(path);
  const py::gil_scoped_release release;
  StagedFiles picture(path, overwrite);
  std::string note;
  picture.make([&](const std::string& aside) {
    if (page)
      plotPage(mesh.grid, in_page, aside);
    else
      note = plotMeshOrGlobe(mesh.grid, options, aside);
  });
  picture.commit();
  return note;
}

}  // namespace

}  // namespace coastmesh

PYBIND11_MODULE(_coastmesh, m) {
  using namespace coastmesh;
  m.doc() = "The compiled half of coastmesh; import coastmesh instead.";
  m.attr("version") = COASTMESH_VERSION;

  // coastmesh/__init__.py turns these into its own classes.
  static PyObject* usage_error = PyErr_NewException("coastmesh._coastmesh.UsageError", nullptr, nullptr);
  static PyObject* input_error = PyErr_NewException("coastmesh._coastmesh.InputError", nullptr, nullptr);
  static PyObject* output_error = PyErr_NewException("coastmesh._coastmesh.OutputError", nullptr, nullptr);
  m.attr("UsageError") = py::reinterpret_borrow<py::object>(usage_error);
  m.attr("InputError") = py::reinterpret_borrow<py::object>(input_error);
  m.attr("OutputError") = py::reinterpret_borrow<py::object>(output_error);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const OptionError& error) {
      PyErr_SetObject(usage_error, textOf(oneLine(error.what())).ptr());
    } catch (const InputError& error) {
      PyErr_SetObject(input_error, textOf(oneLine(error.what())).ptr());
    } catch (const OutputError& error) {
      PyErr_SetObject(output_error, textOf(oneLine(error.what())).ptr());
    }
  });

  py::class_<MeshResult>(m, "Mesh")
      .def_property_readonly("points", [](const py::object& o) { return rowsOf<double>(gridOf(o).nodes, 2, o); })
      .def_property_readonly("triangles",
                             [](const py::object& o) { return rowsOf<std::uint32_t>(gridOf(o).triangles, 3, o); })
      .def_property_readonly("quadrilaterals", [](const py::object& o) { return quadsAsArray(gridOf(o)); })
      .def_property_readonly("z", [](const py::object& o) { return columnOf(gridOf(o).z, o); })
      .def_property_readonly("attributes",
                             [](const py::object& o) {
                               py::dict attributes;
                               for (const NodeField& field : gridOf(o).node_fields)
                                 attributes[py::str(titleOf(field))] = columnOf(field.values, o);
                               return attributes;
                             })
      .def_property_readonly("min_angle", [](const py::object& o) { return columnOf(gridOf(o).min_angle_deg, o); })
      .def_property_readonly("area", [](const py::object& o) { return columnOf(gridOf(o).area_m2, o); })
      .def_property_readonly("feature", [](const py::object& o) { return columnOf(gridOf(o).feature_of, o); })
      .def_property_readonly("features", [](const py::object& o) { return featuresOf(gridOf(o)); })
      .def_property_readonly("boundaries", [](const py::object& o) { return boundariesOf(gridOf(o)); })
      .def_property_readonly("crs",
                             [](const py::object& o) {
                               const Crs& crs = gridOf(o).crs;
                               return crs.authority.empty() ? crs.wkt : crs.authority;
                             })
      .def_property_readonly("node_source", [](const py::object& o) { return columnOf(meshOf(o).node_source, o); })
      .def_property_readonly("triangle_source",
                             [](const py::object& o) { return columnOf(meshOf(o).triangle_source, o); })
      .def_property_readonly("node_mesh", [](const py::object& o) { return columnOf(meshOf(o).node_mesh, o); })
      .def_property_readonly("triangle_mesh", [](const py::object& o) { return columnOf(meshOf(o).triangle_mesh, o); })
      .def_property_readonly("summary", [](const MeshResult& mesh) { return textOf(mesh.summary); })
      .def_property_readonly("_report", [](const MeshResult& mesh) { return mesh.report; })
      .def_property_readonly("_warnings",
                             [](const MeshResult& mesh) {
                               py::list list;
                               for (const std::string& warning : mesh.warnings) list.append(textOf(warning));
                               return list;
                             })
      .def_property_readonly("_refusals", [](const MeshResult& mesh) { return refusalsOf(mesh); })
      .def_property_readonly("_complete", [](const MeshResult& mesh) { return mesh.complete; })
      .def("_write", &writeFile)
      .def("_plot", &plotFile)
      .def(py::pickle([](const MeshResult& mesh) { return py::bytes(bytesOf(mesh)); },
                      [](const py::bytes& bytes) { return resultOf(bytes); }))
      // As pickle's protocol 2 makes it: for older ones Python would call the constructor of pybind11's base class,
      // which ends the process.
      .def("__reduce__", [](const py::object& mesh) {
        return py::make_tuple(py::module_::import("copyreg").attr("__newobj__"), py::make_tuple(py::type::of(mesh)),
                              mesh.attr("__getstate__")());
      });

  py::class_<MemoryFiles>(m, "MemoryFiles").def(py::init<>()).def("add", &MemoryFiles::add);
  m.def("run", &runFromPython);
  m.def("cut",
        [](const py::dict& keywords, const MemoryFiles& texts, const py::object& mesh, const py::object& progress) {
          return cutFromPython({keywords, texts, mesh, progress});
        });
  m.def("remesh",
        [](const py::dict& keywords, const MemoryFiles& texts, const py::object& mesh, const py::object& progress) {
          return remeshFromPython({keywords, texts, mesh, progress});
        });
  m.def("merge", [](const py::dict& keywords, const MemoryFiles& texts, const py::object& mesh,
                    const py::object& progress, const py::list& inserted) {
    return mergeFromPython({keywords, texts, mesh, progress}, inserted);
  });
  m.def("rivers", [](const py::dict& keywords, const MemoryFiles& texts, const py::object& mesh,
                     const py::object& progress, const std::vector<std::string>& lines) {
    return riversFromPython({keywords, texts, mesh, progress}, lines);
  });
  m.def("from_arrays", &meshFromArrays);
  m.def("with_z", &meshWithDepths);
  m.def("read", &readFromPython);
  m.def("usage", [](const std::string& function) {
    return function == "mesh"     ? usageOfMesh()
           : function == "cut"    ? usageOfCut()
           : function == "remesh" ? usageOfRemesh()
           : function == "merge"  ? usageOfMerge()
                                  : usageOfRivers();
  });
}
