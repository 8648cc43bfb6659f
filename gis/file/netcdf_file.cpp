#include "gis/file/netcdf_file.hpp"

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "gis/error.hpp"
#include "gis/file/netcdf_header.hpp"
#include "gis/file/single_precision.hpp"
#include "gis/quiet_hdf5.hpp"

namespace coastmesh {

NetcdfWriter::NetcdfWriter(std::string path, bool large) : path_(std::move(path)) {
  check(nc_create(path_.c_str(), NC_NOCLOBBER | (large ? NC_64BIT_DATA : NC_64BIT_OFFSET), &id_));
  int before = 0;
  check(nc_set_fill(id_, NC_NOFILL, &before));
}

NetcdfWriter::~NetcdfWriter() {
  if (id_ >= 0) nc_abort(id_);
}

void NetcdfWriter::check(int status) const {
  if (status != NC_NOERR) throw OutputError("cannot write '" + path_ + "': " + nc_strerror(status));
}

int NetcdfWriter::dimension(const std::string& name, std::size_t length) {
  int id = 0;
  check(nc_def_dim(id_, name.c_str(), length, &id));
  return id;
}

int NetcdfWriter::variable(const std::string& name, int type, const std::vector<int>& dimensions) {
  int id = 0;
  check(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &id));
  return id;
}

void NetcdfWriter::attribute(int variable, const std::string& name, const std::string& text) {
  check(nc_put_att_text(id_, variable, name.c_str(), text.size(), text.data()));
}

void NetcdfWriter::attribute(int variable, const std::string& name, int value) {
  check(nc_put_att_int(id_, variable, name.c_str(), NC_INT, 1, &value));
}

void NetcdfWriter::attribute(int variable, const std::string& name, double value) {
  check(nc_put_att_double(id_, variable, name.c_str(), NC_DOUBLE, 1, &value));
}

void NetcdfWriter::attribute(int variable, const std::string& name, const std::vector<signed char>& values) {
  check(nc_put_att_schar(id_, variable, name.c_str(), NC_BYTE, values.size(), values.data()));
}

void NetcdfWriter::attribute(int variable, const std::string& name, const std::vector<int>& values) {
  check(nc_put_att_int(id_, variable, name.c_str(), NC_INT, values.size(), values.data()));
}

void NetcdfWriter::endDefinitions() { check(nc_enddef(id_)); }
void NetcdfWriter::put(int variable, const int* values) { check(nc_put_var_int(id_, variable, values)); }
void NetcdfWriter::put(int variable, const double* values) { check(nc_put_var_double(id_, variable, values)); }
void NetcdfWriter::put(int variable, const signed char* values) { check(nc_put_var_schar(id_, variable, values)); }

void NetcdfWriter::put(int variable, const char* values) { check(nc_put_var_text(id_, variable, values)); }

void NetcdfWriter::close(const ItemLoop& loop) {
  const int id = id_;
  id_ = -1;
  check(nc_close(id));
  if (later_.empty()) return;
  const std::vector<std::uint64_t> begins = beginningsOfVariables(path_);
  std::vector<FilePart> parts;
  for (auto& [variable, part] : later_) {
    if (static_cast<std::size_t>(variable) >= begins.size())
      throw OutputError("cannot write '" + path_ + "': the header that was written cannot be read back");
    part.begin = begins[static_cast<std::size_t>(variable)];
    parts.push_back(std::move(part));
  }
  writeParts(path_, std::move(parts), loop);
}

NetcdfReader::NetcdfReader(std::string path) : path_(std::move(path)) {
  if (!headerFitsFile(path_)) fail("the file is damaged or cut off: its header claims more than there is");
  quietHdf5();
  check(nc_open(path_.c_str(), NC_NOWRITE, &id_));
}

NetcdfReader::~NetcdfReader() {
  if (id_ >= 0) nc_close(id_);
}

void NetcdfReader::check(int status) const {
  if (status != NC_NOERR) throw InputError("cannot read '" + path_ + "': " + nc_strerror(status));
}

void NetcdfReader::fail(const std::string& what) const { throw InputError("'" + path_ + "': " + what); }

int NetcdfReader::variableId(const std::string& name) const {
  int id = 0;
  if (nc_inq_varid(id_, name.c_str(), &id) != NC_NOERR) fail("there is no variable \"" + name + "\"");
  return id;
}

bool NetcdfReader::hasVariable(const std::string& name) const {
  int id = 0;
  return !name.empty() && nc_inq_varid(id_, name.c_str(), &id) == NC_NOERR;
}

std::vector<std::string> NetcdfReader::variables() const {
  int count = 0;
  check(nc_inq_nvars(id_, &count));
  std::vector<std::string> names;
  for (int v = 0; v < count; ++v) {
    char name[NC_MAX_NAME + 1] = {};
    check(nc_inq_varname(id_, v, name));
    names.emplace_back(name);
  }
  return names;
}

std::vector<std::size_t> NetcdfReader::shape(const std::string& variable) const {
  const int id = variableId(variable);
  int rank = 0;
  check(nc_inq_varndims(id_, id, &rank));
  std::vector<int> dimensions(static_cast<std::size_t>(rank));
  check(nc_inq_vardimid(id_, id, dimensions.data()));
  std::vector<std::size_t> lengths;
  for (const int dimension : dimensions) check(nc_inq_dimlen(id_, dimension, &lengths.emplace_back()));
  return lengths;
}

std::vector<std::string> NetcdfReader::dimensionsOf(const std::string& variable) const {
  const int id = variableId(variable);
  int rank = 0;
  check(nc_inq_varndims(id_, id, &rank));
  std::vector<int> dimensions(static_cast<std::size_t>(rank));
  check(nc_inq_vardimid(id_, id, dimensions.data()));
  std::vector<std::string> names;
  for (const int dimension : dimensions) {
    char name[NC_MAX_NAME + 1] = {};
    check(nc_inq_dimname(id_, dimension, name));
    names.emplace_back(name);
  }
  return names;
}

std::string NetcdfReader::textOf(int variable, const std::string& attribute) const {
  nc_type type = 0;
  std::size_t length = 0;
  if (nc_inq_att(id_, variable, attribute.c_str(), &type, &length) != NC_NOERR) return {};
  if (type == NC_CHAR) {
    std::string text(length, '\0');
    check(nc_get_att_text(id_, variable, attribute.c_str(), text.data()));
    return text.substr(0, text.find('\0'));
  }
  if (type != NC_STRING || length != 1) return {};
  char* string = nullptr;
  check(nc_get_att_string(id_, variable, attribute.c_str(), &string));
  std::string text = string ? string : "";
  nc_free_string(1, &string);
  return text;
}

std::string NetcdfReader::text(const std::string& variable, const std::string& attribute) const {
  return textOf(variableId(variable), attribute);
}

std::string NetcdfReader::globalText(const std::string& attribute) const { return textOf(NC_GLOBAL, attribute); }

std::optional<double> NetcdfReader::number(const std::string& variable, const std::string& attribute) const {
  const int id = variableId(variable);
  nc_type type = 0;
  std::size_t length = 0;
  if (nc_inq_att(id_, id, attribute.c_str(), &type, &length) != NC_NOERR) return std::nullopt;
  if (type == NC_CHAR || type == NC_STRING || length != 1) return std::nullopt;
  double value = 0.0;
  check(nc_get_att_double(id_, id, attribute.c_str(), &value));
  return value;
}

std::size_t NetcdfReader::sizeOf(const std::string& variable) const {
  std::size_t size = 1;
  // A damaged header may claim any length. A byte of the file encodes at most one value, or some thousand if deflated.
  int format = 0;
  check(nc_inq_format(id_, &format));
  const bool deflated = format == NC_FORMAT_NETCDF4 || format == NC_FORMAT_NETCDF4_CLASSIC;
  const std::size_t most = std::filesystem::file_size(path_) * (deflated ? 1100 : 1);
  for (const std::size_t length : shape(variable)) {
    if (length > 0 && size > most / length) fail("the variable \"" + variable + "\" is larger than the file");
    size *= length;
  }
  return size;
}

std::vector<double> NetcdfReader::packedDoubles(const std::string& variable, std::optional<std::size_t> row) const {
  std::vector<std::size_t> start(row ? shape(variable).size() : 0, 0), lengths = shape(variable);
  std::size_t size = sizeOf(variable);
  if (row && size > 0) {
    size /= lengths[0];
    start[0] = *row;
    lengths[0] = 1;
  }
  std::vector<double> values(size);
  if (size == 0) return values;
  check(row ? nc_get_vara_double(id_, variableId(variable), start.data(), lengths.data(), values.data())
            : nc_get_var_double(id_, variableId(variable), values.data()));
  return values;
}

void NetcdfReader::unpack(const std::string& variable, std::vector<double>& values) const {
  nc_type type = 0;
  check(nc_inq_vartype(id_, variableId(variable), &type));
  if (type == NC_FLOAT)
    for (double& value : values) value = shortestDecimal(static_cast<float>(value));
  const double factor = number(variable, "scale_factor").value_or(1.0);
  const double offset = number(variable, "add_offset").value_or(0.0);
  if (factor == 1.0 && offset == 0.0) return;
  for (double& value : values) value = value * factor + offset;
}

std::vector<double> NetcdfReader::doubles(const std::string& variable) const {
  std::vector<double> values = packedDoubles(variable);
  unpack(variable, values);
  return values;
}

std::vector<double> NetcdfReader::knownDoubles(const std::string& variable, std::optional<std::size_t> row) const {
  std::vector<double> values = packedDoubles(variable, row), missing;
  for (const char* attribute : {"_FillValue", "missing_value"})
    if (const auto value = number(variable, attribute)) missing.push_back(*value);
  nc_type type = 0;
  check(nc_inq_vartype(id_, variableId(variable), &type));
  if (missing.empty() && type == NC_FLOAT) missing.push_back(NC_FILL_FLOAT);
  if (missing.empty() && type == NC_DOUBLE) missing.push_back(NC_FILL_DOUBLE);
  for (double& value : values)
    if (!std::isfinite(value) || std::ranges::count(missing, value) > 0)
      value = std::numeric_limits<double>::quiet_NaN();
  unpack(variable, values);
  return values;
}

std::vector<std::int64_t> NetcdfReader::integers(const std::string& variable) const {
  static_assert(sizeof(long long) == sizeof(std::int64_t));
  std::vector<long long> values(sizeOf(variable));
  check(nc_get_var_longlong(id_, variableId(variable), values.data()));
  return {values.begin(), values.end()};
}

std::vector<std::int64_t> NetcdfReader::indices(const std::string& variable) const {
  nc_type type = 0;
  check(nc_inq_vartype(id_, variableId(variable), &type));
  if (type == NC_FLOAT || type == NC_DOUBLE) {
    constexpr double kExact = 9e15;  // integers up to here are exact
    std::vector<std::int64_t> indices;
    for (const double value : knownDoubles(variable)) {
      const bool whole = std::abs(value) < kExact && value == std::floor(value);
      if (!whole && !std::isnan(value)) fail("\"" + variable + "\" holds a number that is not whole");
      indices.push_back(whole ? static_cast<std::int64_t>(value) : kMissing);
    }
    return indices;
  }
  const std::optional<double> said = number(variable, "_FillValue");
  const double fill = said               ? *said
                      : type == NC_INT   ? NC_FILL_INT
                      : type == NC_UINT  ? NC_FILL_UINT
                      : type == NC_INT64 ? static_cast<double>(NC_FILL_INT64)
                      : type == NC_SHORT ? NC_FILL_SHORT
                                         : static_cast<double>(kMissing);
  std::vector<std::int64_t> values = integers(variable);
  for (std::int64_t& value : values)
    if (static_cast<double>(value) == fill) value = kMissing;
  return values;
}

std::vector<std::string> NetcdfReader::texts(const std::string& variable) const {
  const std::vector<std::size_t> lengths = shape(variable);
  const int id = variableId(variable);
  nc_type type = 0;
  check(nc_inq_vartype(id_, id, &type));
  if (lengths.size() != 2 || type != NC_CHAR) fail("\"" + variable + "\" holds no texts");
  std::string all(sizeOf(variable), '\0');
  check(nc_get_var_text(id_, id, all.data()));
  std::vector<std::string> rows;
  for (std::size_t row = 0; row < lengths[0]; ++row) {
    const std::string text = all.substr(row * lengths[1], lengths[1]);
    rows.push_back(text.substr(0, text.find('\0')));
  }
  return rows;
}

}  // namespace coastmesh
