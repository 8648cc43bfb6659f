// Finds the triangle or node at a position of the window, in double precision, and its numbers.

const NODE_REACH = 7;  // CSS pixels within which a node is picked, if the triangle there is over three times as large

// Returns the triangle at a position, null if none, and the nearest node within `reach`, null if none or if the
// triangle is too small.
function pickAt(mesh, view, right, up, reach) {
  const projection = projectionOf(view), { chunks, vertices, order, dims } = mesh.triangles;
  const x = [0, 0, 0], y = [0, 0, 0], z = [0, 0, 0];
  let triangle = null, node = null, nearest = reach * reach, height = -Infinity;
  for (const chunk of chunks) {
    const [cx, cy, towards] = screenOf(projection, chunk.middle.map(share => share * WHOLE));
    if (Math.hypot(cx - right, cy - up) > chunk.radius * view.scale + reach || towards < -chunk.radius) continue;
    const { middle, rows, off } = projection;
    for (let i = chunk.first; i < chunk.last; ++i) {
      for (let c = 0, at = 3 * dims * i; c < 3; ++c, at += dims) {
        const dx = vertices[at] - middle[0], dy = vertices[at + 1] - middle[1], dz = dims === 3 ? vertices[at + 2] - middle[2] : 0;
        x[c] = off[0] + rows[0][0] * dx + rows[0][1] * dy + rows[0][2] * dz - right;
        y[c] = off[1] + rows[1][0] * dx + rows[1][1] * dy + rows[1][2] * dz - up;
        z[c] = off[2] + rows[2][0] * dx + rows[2][1] * dy + rows[2][2] * dz;
      }
      if (Math.min(z[0], z[1], z[2]) <= 0) continue;
      for (let c = 0; c < 3; ++c) {
        const square = x[c] * x[c] + y[c] * y[c];
        if (square >= nearest) continue;
        nearest = square;
        node = mesh.corners[3 * order[i] + c];
      }
      const a = x[1] * y[2] - x[2] * y[1], b = x[2] * y[0] - x[0] * y[2], c = x[0] * y[1] - x[1] * y[0];
      if (!(a >= 0 && b >= 0 && c >= 0) && !(a <= 0 && b <= 0 && c <= 0)) continue;
      const sum = a + b + c;
      if (sum === 0 || z[0] + z[1] + z[2] < height) continue;
      height = z[0] + z[1] + z[2];
      const side = Math.sqrt(Math.abs(sum));
      triangle = { triangle: order[i], shares: [a / sum, b / sum, c / sum], side };
    }
  }
  return { triangle, node: node !== null && (!triangle || triangle.side > 3 * reach) ? node : null };
}

// Returns longitude and latitude, or x and y for a plane, in a triangle at `shares` of its corners.
async function placeIn(mesh, t, shares) {
  const names = mesh.facts.coordinates === "plane" ? ["x", "y"] : ["lon", "lat"];
  const [first, second] = [await mesh.arrays.get(names[0]), await mesh.arrays.get(names[1])];
  const nodes = mesh.corners.subarray(3 * t, 3 * t + 3);
  let x = 0, y = 0;
  for (let c = 0; c < 3; ++c) {
    let value = first[nodes[c]];
    if (names[0] === "lon") value -= 360 * Math.round((value - first[nodes[0]]) / 360);
    x += shares[c] * value;
    y += shares[c] * second[nodes[c]];
  }
  return [names[0] === "lon" ? x - 360 * Math.round(x / 360) : x, y];
}

// Returns rows of a name and a text, and the triangles around the node.
async function numbersOfNode(mesh, node) {
  const { facts, arrays, corners } = mesh, rows = [];
  if (arrays.has("lon")) {
    rows.push(["longitude", String((await arrays.get("lon"))[node])], ["latitude", String((await arrays.get("lat"))[node])]);
  }
  if (arrays.has("x")) rows.push(["x", String((await arrays.get("x"))[node])], ["y", String((await arrays.get("y"))[node])]);
  if (arrays.has("z")) {
    const z = (await arrays.get("z"))[node];
    rows.push(["height (z)", Number.isFinite(z) ? z + " m" : "unknown"]);
    if (z < 0) rows.push(["depth", -z + " m"]);
  }
  const around = [];
  for (let i = 0; i < corners.length; ++i) if (corners[i] === node) around.push(Math.floor(i / 3));
  const lines = new Set();
  for (const { kind, array } of facts.lines) if ((await arrays.get(array)).includes(node)) lines.add(kind);
  if (lines.size > 0) rows.push(["on", [...lines].join(", ")]);
  return { rows, around };
}

async function numbersOfTriangle(mesh, t) {
  const { facts, arrays, corners } = mesh, rows = [];
  await spacePlaces(mesh);
  await loadQuads(mesh);
  const lengths = edgeLengths(mesh, t), angles = anglesOf(mesh, t), of_quad = (mesh.quads?.greatest[t] ?? 0) / 1000;
  if (of_quad > 0) rows.push(["half of", "a quadrilateral: angles and quality are its own"]);
  rows.push(["smallest angle", ((await arrays.get("angle"))[t] / 1000).toFixed(3) + "°"]);
  rows.push(["largest angle", (of_quad > 0 ? of_quad : Math.max(...angles)).toFixed(3) + "°"]);
  rows.push(["edges", [...lengths].sort((a, b) => a - b).map(length => lengthText(mesh, length, 6)).join(", ")]);
  rows.push(["area", areaText(mesh, areaOfEdges(mesh, lengths))]);
  rows.push(["quality", shapeValue(mesh, "quality", t).toFixed(4)]);
  if (arrays.has("z")) {
    const z = await arrays.get("z"), nodes = corners.subarray(3 * t, 3 * t + 3);
    rows.push(["height, mean", valueText(mesh, "depth", (z[nodes[0]] + z[nodes[1]] + z[nodes[2]]) / 3)]);
    if (facts.colors.includes("timestep")) rows.push(["time step (CFL)", valueText(mesh, "timestep", shapeValue(mesh, "timestep", t, z))]);
  }
  for (const kind of KINDS)
    if (facts.colors.includes(kind)) rows.push([COLOR_NAMES[kind], kindName(mesh, kind, (await kindsOf(mesh, kind))[t])]);
  return { rows, nodes: [...corners.subarray(3 * t, 3 * t + 3)] };
}

// Returns the centre of a triangle or a node and the radius of its surroundings, as shares of the unit.
function whereIs(mesh, picked) {
  const nodes = picked.kind === "node" ? [picked.number] : [...mesh.corners.subarray(3 * picked.number, 3 * picked.number + 3)];
  const middle = mesh.places.map(axis => nodes.reduce((sum, node) => sum + axis[node], 0) / nodes.length / WHOLE);
  let radius = 0;
  const around = picked.kind === "node" ? nodesAround(mesh, picked.number) : nodes;
  for (const node of around) radius = Math.max(radius, Math.hypot(...mesh.places.map((axis, k) => axis[node] / WHOLE - middle[k])));
  return { middle, radius };
}
function nodesAround(mesh, node) {
  const { corners } = mesh, around = new Set();
  for (let i = 0; i < corners.length; ++i)
    if (corners[i] === node) for (let c = 0; c < 3; ++c) around.add(corners[i - i % 3 + c]);
  return around;
}
