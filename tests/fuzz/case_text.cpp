#include "tests/fuzz/case_text.hpp"

#include <array>
#include <charconv>
#include <limits>
#include <sstream>

namespace coastmesh {

namespace {

// The shortest text that reads back as the same double.
std::string toText(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

}  // namespace

std::string caseText(const RefineCase& refine_case, const std::string& note) {
  const auto& [pslg, options, coarsen] = refine_case;
  std::ostringstream text;
  std::istringstream lines(note);
  for (std::string line; std::getline(lines, line);) text << "# note: " << line << '\n';
  text << "# algorithm " << nameOf(options.algorithm) << "\n# min_angle " << toText(options.min_angle_deg)
       << "\n# max_angle " << toText(options.max_angle_deg) << "\n# size " << toText(options.size_max) << '\n';
  if (options.max_vertices != std::numeric_limits<std::uint64_t>::max())
    text << "# max_vertices " << options.max_vertices << '\n';
  text << "# coarsen " << coarsen << '\n';
  text << pslg.points.size() << " 2 0 0\n";
  for (std::size_t i = 0; i < pslg.points.size(); ++i)
    text << i + 1 << ' ' << toText(pslg.points[i].x) << ' ' << toText(pslg.points[i].y) << '\n';
  bool labelled = false;
  for (const Segment& s : pslg.segments) labelled |= s.left != kUnlabelled || s.right != kUnlabelled;
  text << pslg.segments.size() << " 1\n";
  for (std::size_t i = 0; i < pslg.segments.size(); ++i) {
    const Segment& s = pslg.segments[i];
    text << i + 1 << ' ' << s.a + 1 << ' ' << s.b + 1 << ' ' << s.tag;
    if (labelled) text << " # " << s.left << ' ' << s.right;
    text << '\n';
  }
  text << pslg.holes.size() << '\n';
  for (std::size_t i = 0; i < pslg.holes.size(); ++i)
    text << i + 1 << ' ' << toText(pslg.holes[i].x) << ' ' << toText(pslg.holes[i].y) << '\n';
  return text.str();
}

}  // namespace coastmesh
