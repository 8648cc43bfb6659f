#include "apps/python/keywords.hpp"

#include <optional>

#include "apps/python/arrays.hpp"
#include "apps/usage/option_keywords.hpp"
#include "apps/usage/option_value.hpp"

namespace py = pybind11;

namespace coastmesh {

namespace {

bool isText(const py::object& value) { return py::isinstance<py::str>(value) || py::isinstance<py::bytes>(value); }
bool isList(const py::object& value) { return py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value); }

// numpy's numbers as Python's, arrays as lists, paths and CRSs as text; any other value unchanged.
py::object plain(const py::object& value) {
  if (py::hasattr(value, "__fspath__")) return py::module_::import("os").attr("fsencode")(value);
  if (py::hasattr(value, "to_wkt")) return value.attr("to_wkt")();
  if (py::hasattr(value, "tolist")) return value.attr("tolist")();
  return value;
}

std::string encoded(const py::object& text) {
  return py::module_::import("os").attr("fsencode")(text).cast<std::string>();
}

std::string shown(const py::object& value) {
  return isText(value) ? encoded(value) : encoded(py::str(py::repr(value)));
}

std::optional<double> numberOf(const py::object& value) {
  if (py::isinstance<py::bool_>(value)) return std::nullopt;
  if (!py::isinstance<py::float_>(value) && !py::isinstance<py::int_>(value)) return std::nullopt;
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();  // an integer beyond the range of double
  return std::numeric_limits<double>::infinity();
}

std::optional<std::vector<double>> numbersOf(const py::object& value) {
  if (!isList(value)) return std::nullopt;
  std::vector<double> numbers;
  for (const py::handle item : value) {
    const std::optional<double> number = numberOf(plain(py::reinterpret_borrow<py::object>(item)));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

bool isCrs(const OptionTable::Entry& entry) { return entry.kind == OptionKind::Text && entry.shown_unit == "CRS"; }

// The value as one of the option's kind; nullopt if it is of another kind.
std::optional<OptionValue> valueFor(const OptionTable::Entry& entry, const py::object& value) {
  if (entry.kind == OptionKind::Flag) {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
    return std::nullopt;
  }
  if (isText(value)) return valueOf(encoded(value), entry.kind);
  // Integers are EPSG's codes, as for pyproj and geopandas.
  if (isCrs(entry) && py::isinstance<py::int_>(value) && !py::isinstance<py::bool_>(value))
    return OptionValue("EPSG:" + shown(value));
  if (entry.kind == OptionKind::Numbers) return numbersOf(value);
  const std::optional<double> number = numberOf(value);
  if (!number) return std::nullopt;
  if (entry.kind == OptionKind::Number) return *number;
  if (entry.kind != OptionKind::Integer) return std::nullopt;
  // Negative and fractional numbers are passed on as text: the option rejects them with its range.
  const unsigned long long whole = py::isinstance<py::int_>(value) ? PyLong_AsUnsignedLongLong(value.ptr()) : 0;
  if (PyErr_Occurred() == nullptr && py::isinstance<py::int_>(value)) return static_cast<std::uint64_t>(whole);
  PyErr_Clear();
  return OptionValue(shown(value));
}

const char* wantedOf(const OptionTable::Entry& entry) {
  if (isCrs(entry)) return "is neither a text nor a code of EPSG";
  switch (entry.kind) {
    case OptionKind::Flag:
      return "is neither True nor False";
    case OptionKind::Number:
      return "is not a number";
    case OptionKind::Integer:
      return "is not an integer";
    case OptionKind::Numbers:
      return "is not a list of numbers";
    case OptionKind::File:
      return "is not the path of a file";
    case OptionKind::Text:
    case OptionKind::Choice:
      break;
  }
  return "is not a text";
}

void setOne(OptionTable& table, const OptionTable::Entry& entry, const std::string& keyword, const py::object& given) {
  const py::object value = plain(given);
  try {
    const std::optional<OptionValue> typed = valueFor(entry, value);
    if (!typed) throw OptionError(shown(given) + " " + wantedOf(entry));
    table.set(entry.name, *typed, shown(value));
  } catch (const OptionError& error) {
    throw OptionError(keyword + ": " + error.what());
  }
}

}  // namespace

void setFromKeywords(OptionTable& table, const py::dict& keywords, std::vector<std::string>& warnings) {
  for (const auto& [name, given] : keywords) {
    if (given.is_none()) continue;
    const auto keyword = name.cast<std::string>();
    const std::optional<KeywordOption> option = optionOf(keyword, table);
    if (!option) throw OptionError(keyword + " is not an option");
    const OptionTable::Entry& entry = *option->entry;
    if (option->former)
      warnings.push_back(keyword + " is called " + keywordOf(entry.name) +
                         " now; the next version will not accept the former name");
    const py::object value = plain(py::reinterpret_borrow<py::object>(given));
    // A single group of numbers is a list, as several groups are.
    const bool one = !entry.multiple || !isList(value) || (entry.kind == OptionKind::Numbers && numbersOf(value));
    if (one) {
      setOne(table, entry, keyword, value);
      continue;
    }
    for (const py::handle item : value) setOne(table, entry, keyword, py::reinterpret_borrow<py::object>(item));
  }
}

}  // namespace coastmesh
