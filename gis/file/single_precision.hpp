#pragma once

namespace coastmesh {

// The shortest decimal number that means a number of single precision: 12.1, not the 12.100000381469727 that it is in
// double precision. Rounded to single precision it is `value` again.
double shortestDecimal(float value);

}  // namespace coastmesh
