#include "tests/fuzz/case_file.hpp"

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "gis/error.hpp"
#include "gis/format/poly_io.hpp"
#include "tests/fuzz/case_text.hpp"

namespace coastmesh {

namespace {

constexpr std::array kAlgorithms{Algorithm::Circumcenter, Algorithm::Offcenter, Algorithm::Optimal,
                                 Algorithm::Relocate};

void setOption(RefineCase& c, const std::string& name, const std::string& value) {
  if (name == "algorithm") {
    for (const Algorithm a : kAlgorithms)
      if (value == nameOf(a)) c.options.algorithm = a;
  } else if (name == "min_angle") {
    c.options.min_angle_deg = std::stod(value);
  } else if (name == "max_angle") {
    c.options.max_angle_deg = std::stod(value);
  } else if (name == "size") {
    c.options.size_max = std::stod(value);
  } else if (name == "max_vertices") {
    c.options.max_vertices = std::stoull(value);
  } else if (name == "coarsen") {
    c.coarsen = value == "1";
  }
}

}  // namespace

RefineCase readCase(const std::string& path) {
  RefineCase c;
  c.pslg = readPoly(path);
  std::ifstream file(path);
  std::size_t labelled = 0;
  for (std::string line; std::getline(file, line);) {
    const std::size_t mark = line.find('#');
    if (mark == std::string::npos) continue;
    std::istringstream comment(line.substr(mark + 1));
    if (line.find_first_not_of(" \t") == mark) {
      std::string name, value;
      if (comment >> name >> value) setOption(c, name, value);
      continue;
    }
    if (labelled == c.pslg.segments.size()) throw InputError("'" + path + "' has more labels than segments");
    Segment& s = c.pslg.segments[labelled++];
    if (!(comment >> s.left >> s.right)) throw InputError("'" + path + "': two labels are expected in: " + line);
  }
  if (labelled != 0 && labelled != c.pslg.segments.size())
    throw InputError("'" + path + "' has labels behind some segments only");
  return c;
}

void writeCase(const RefineCase& refine_case, const std::string& note, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file << caseText(refine_case, note);
  file.close();
  if (!file) throw std::runtime_error("cannot write '" + path + "'");
}

}  // namespace coastmesh
