#pragma once

namespace coastmesh {

// The limits of models: `checkTarget` checks them, `repairForTargets` repairs violations.

// SWAN, SwanCheckGrid: it stops at an angle with a cosine of -0.8 or less (143.13 degrees; it computes in single
// precision, hence a slightly lower limit here), and at an interior node with fewer or more triangles.
inline constexpr double kSwanLargestAngleDeg = 143.0;
inline constexpr int kSwanFewestCells = 4, kSwanMostCells = 10;

// FESOM2, its mesh partitioner: it stops at a triangle with fewer neighbours, and at a node with more triangles.
inline constexpr int kFesomFewestNeighbours = 2, kFesomMostCells = 32;

// MPAS: the line between the centres of two cells must cross the edge between them, which is so if no triangle is
// obtuse. Its mesh converter counts those that are.
inline constexpr double kMpasLargestAngleDeg = 90.0;

// D-Flow FM, user manual, "orthogonality": the cosine of the angle between an edge and the line between the centres
// beside it.
inline constexpr double kDflowfmLargestCosine = 0.5;

// D-Flow FM, "removesmalllinkstrsh": a link shorter than this share of half the sum of the square roots of the areas of
// its triangles is removed, and no water flows there. D-Flow FM uses 0.1 on its own sphere, hence a slightly higher
// limit here.
inline constexpr double kDflowfmSmallestLink = 0.1005;

// Courant numbers (`timeSteps`). ADCIRC and FVCOM become unstable above 1. TELEMAC-2D and SCHISM are implicit, and MIKE
// and D-Flow FM shorten their steps: their limits are advice, SCHISM's from below, from its manual ("grid generation").
inline constexpr double kLargestCourant = 1.0;
inline constexpr double kSchismLeastCourant = 0.4;

}  // namespace coastmesh
