#include "apps/report/partition_report.hpp"

#include <cstdio>

#include "gis/for_count.hpp"

namespace coastmesh {

namespace {

Json figuresSection(const std::optional<PartitionFigures>& figures) {
  if (!figures) return nullptr;
  return {{"edge_cut", figures->edge_cut},
          {"balance", figures->balance},
          {"connected_parts", figures->connected_parts},
          {"least", figures->least},
          {"most", figures->most}};
}

std::string figuresText(const PartitionReport& report, const std::optional<PartitionFigures>& figures,
                        const char* what) {
  if (!figures) return {};
  const std::uint32_t parts = report.parts;
  char balance[40];
  std::snprintf(balance, sizeof balance, "balance %.4f", figures->balance);
  return grouped(parts) + forCount(parts, " part of ", " parts of ") + grouped(figures->least) + " to " +
         grouped(figures->most) + ' ' + what + ", " + balance +
         (report.weight == "even" ? "" : " by " + report.weight) + "; " + grouped(figures->edge_cut) +
         forCount(figures->edge_cut, " edge cut; ", " edges cut; ") + grouped(figures->connected_parts) +
         forCount(figures->connected_parts, " part hangs", " parts hang") + " together\n";
}

}  // namespace

Json partitionSection(const PartitionReport& report) {
  if (report.parts == 0) return nullptr;
  return {{"parts", report.parts},
          {"weight", report.weight},
          {"elements", figuresSection(report.elements)},
          {"nodes", figuresSection(report.nodes)}};
}

std::string partitionText(const PartitionReport& report) {
  return figuresText(report, report.elements, report.mixed ? "elements" : "triangles") +
         figuresText(report, report.nodes, "nodes");
}

}  // namespace coastmesh
