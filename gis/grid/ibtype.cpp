#include "gis/grid/ibtype.hpp"

#include <algorithm>

namespace coastmesh {
namespace {

constexpr auto kLand = BoundaryRole::Land, kIsland = BoundaryRole::Island, kRiver = BoundaryRole::River;

// The tens are the condition: 0 no normal flow as an essential condition, 1 no slip either, 2 no normal flow as a
// natural condition. 100 more is a river of a baroclinic run.
constexpr Ibtype kIbtypes[] = {
    {0, kLand},           {1, kIsland},         {2, kRiver},   {3, kLand, 2, false},  // a weir on the outer shore
    {4, kLand, 3, true},                                                              // between two shores
    {5, kLand, 6, true},                                                              // with pipes
    {10, kLand},          {11, kIsland},        {12, kRiver},  {13, kLand, 2, false},
    {20, kLand},          {21, kIsland},        {22, kRiver},  {23, kLand, 2, false},
    {24, kLand, 3, true}, {25, kLand, 6, true}, {30, kLand},  // waves radiate
    {32, kRiver},                                             // a discharge, and waves radiate
    {40, kLand},          {41, kLand},                        // outer, without a normal gradient of the velocity
    {52, kRiver},                                             // a periodic discharge, and waves radiate
    {64, kLand, 3, true},                                     // a wall that elements stand on
    {102, kRiver},        {112, kRiver},        {122, kRiver},
};

constexpr int kOwnLand = 20, kOwnIsland = 21, kOwnRiver = 22;

}  // namespace

const Ibtype* findIbtype(int number) {
  const auto* const found = std::ranges::find(kIbtypes, number, &Ibtype::number);
  return found == std::end(kIbtypes) ? nullptr : found;
}

int ibtypeOf(BoundaryRole role, bool closed) {
  if (role == BoundaryRole::River) return kOwnRiver;
  return role == BoundaryRole::Island && closed ? kOwnIsland : kOwnLand;
}

bool isRolesOwn(int number) { return number == kOwnLand || number == kOwnIsland || number == kOwnRiver; }

bool isBareWeir(const Boundary& boundary) {
  const Ibtype* const type = findIbtype(boundary.ibtype);
  return type != nullptr && type->isWeir() && boundary.weir.empty();
}

bool isPartOfIsland(const Boundary& boundary) {
  const Ibtype* const type = findIbtype(boundary.ibtype);
  return type != nullptr && type->closesItself() && !boundary.closed;
}

int mainlandType(int island) { return island - 1; }

std::string givableIbtypes() {
  std::string list;
  for (const Ibtype& type : kIbtypes) {
    if (type.isWeir()) continue;
    if (!list.empty()) list += ", ";
    list += std::to_string(type.number);
  }
  return list;
}

}  // namespace coastmesh
