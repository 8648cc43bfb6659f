#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace coastmesh {

// A NetCDF file that is open as long as this lives. Writing throws OutputError with the path and the reason, reading
// InputError.
class NetcdfWriter {
 public:
  // `large`: arrays past 4 GiB, in a format that fewer programs read.
  NetcdfWriter(std::string path, bool large);
  ~NetcdfWriter();
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;

  int dimension(const std::string& name, std::size_t length);
  int variable(const std::string& name, int type, const std::vector<int>& dimensions);
  void attribute(int variable, const std::string& name, const std::string& text);
  void attribute(int variable, const std::string& name, int value);
  void attribute(int variable, const std::string& name, double value);
  void attribute(int variable, const std::string& name, const std::vector<signed char>& values);
  void attribute(int variable, const std::string& name, const std::vector<int>& values);

  void endDefinitions();
  void put(int variable, const int* values);
  void put(int variable, const double* values);
  void put(int variable, const signed char* values);
  void put(int variable, const char* values);
  void close();

 private:
  void check(int status) const;

  std::string path_;
  int id_ = -1;
};

class NetcdfReader {
 public:
  explicit NetcdfReader(std::string path);
  ~NetcdfReader();
  NetcdfReader(const NetcdfReader&) = delete;
  NetcdfReader& operator=(const NetcdfReader&) = delete;

  std::vector<std::string> variables() const;
  bool hasVariable(const std::string& name) const;
  std::vector<std::size_t> shape(const std::string& variable) const;
  std::vector<std::string> dimensionsOf(const std::string& variable) const;
  // Empty where there is none, or it is not text.
  std::string text(const std::string& variable, const std::string& attribute) const;
  std::string globalText(const std::string& attribute) const;
  std::optional<double> number(const std::string& variable, const std::string& attribute) const;
  std::vector<double> doubles(const std::string& variable) const;
  std::vector<std::int64_t> integers(const std::string& variable) const;
  std::vector<std::string> texts(const std::string& variable) const;  // rows of characters, filled up with zeros

  [[noreturn]] void fail(const std::string& what) const;

 private:
  void check(int status) const;
  int variableId(const std::string& name) const;
  std::string textOf(int variable, const std::string& attribute) const;
  std::size_t sizeOf(const std::string& variable) const;

  std::string path_;
  int id_ = -1;
};

}  // namespace coastmesh
