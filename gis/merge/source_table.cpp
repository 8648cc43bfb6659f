#include "gis/merge/source_table.hpp"

#include "gis/file/text_writer.hpp"

namespace coastmesh {

void writeSourceTable(std::span<const MergeSource> nodes, std::span<const MergeSource> triangles,
                      const std::string& path, const ItemLoop& loop) {
  TextWriter out(path);
  out << "item,number,mesh,source\n";
  const auto write = [&](const char* item, std::span<const MergeSource> sources) {
    out.rows(loop, sources.size(), [&](TextBlock& row, std::size_t i) {
      row << item << ',' << i + 1 << ',';
      if (const auto [mesh, number] = sources[i]; mesh != kNone)
        row << std::size_t{mesh} + 1 << ',' << std::size_t{number} + 1;
      else
        row << ',';
      row << '\n';
    });
  };
  write("node", nodes);
  write("triangle", triangles);
  out.close();
}

}  // namespace coastmesh
