// The mesh in drawing order: triangles that are close in space are close in memory, in chunks that are skipped if out
// of view. Places are integers; WHOLE is half the longer side of the plane, or the globe's radius.

const WHOLE = 2 ** 30 - 1;
const CHUNK = 4096;

// Returns the order along a Z-order curve and its chunks, each with the centre and radius of a bounding circle or
// sphere and the mean radius of its items. `middles`: Float32Array, `dims` shares from -1 to 1 per item.
function inChunks(count, dims, middles, radiusOf) {
  const codes = new Uint32Array(count), steps = dims === 2 ? 65535 : 1023;
  const spread = dims === 2 ? spreadTwo : spreadThree;
  for (let i = 0; i < count; ++i) {
    let code = 0;
    for (let k = 0; k < dims; ++k) {
      const share = Math.min(1, Math.max(0, middles[dims * i + k] / 2 + 0.5));
      code |= spread(share * steps) << k;
    }
    codes[i] = code;
  }
  const order = sortedByCode(codes), chunks = [];
  for (let first = 0; first < count; first += CHUNK) {
    const last = Math.min(count, first + CHUNK);
    const low = new Array(dims).fill(Infinity), high = new Array(dims).fill(-Infinity);
    for (let i = first; i < last; ++i) {
      for (let k = 0; k < dims; ++k) {
        const value = middles[dims * order[i] + k];
        if (value < low[k]) low[k] = value;
        if (value > high[k]) high[k] = value;
      }
    }
    const middle = low.map((value, k) => (value + high[k]) / 2);
    let radius = 0, sum = 0;
    for (let i = first; i < last; ++i) {
      let square = 0;
      sum += radiusOf(order[i]);
      for (let k = 0; k < dims; ++k) square += (middles[dims * order[i] + k] - middle[k]) ** 2;
      radius = Math.max(radius, Math.sqrt(square) + radiusOf(order[i]));
    }
    chunks.push({ first, last, middle, radius: radius * (1 + 1e-6) + 1e-7, item_radius: sum / (last - first) });
  }
  return { order, chunks };
}

function spreadTwo(value) {
  let bits = value & 0xffff;
  bits = (bits | bits << 8) & 0x00ff00ff;
  bits = (bits | bits << 4) & 0x0f0f0f0f;
  bits = (bits | bits << 2) & 0x33333333;
  return (bits | bits << 1) & 0x55555555;
}

function spreadThree(value) {
  let bits = value & 0x3ff;
  bits = (bits | bits << 16) & 0x030000ff;
  bits = (bits | bits << 8) & 0x0300f00f;
  bits = (bits | bits << 4) & 0x030c30c3;
  return (bits | bits << 2) & 0x09249249;
}

// Radix sort, 16 bits at a time.
function sortedByCode(codes) {
  let order = new Uint32Array(codes.length), next = new Uint32Array(codes.length);
  for (let i = 0; i < order.length; ++i) order[i] = i;
  for (const shift of [0, 16]) {
    const starts = new Uint32Array(65537);
    for (let i = 0; i < codes.length; ++i) ++starts[(codes[i] >>> shift & 65535) + 1];
    for (let i = 1; i < starts.length; ++i) starts[i] += starts[i - 1];
    for (let i = 0; i < order.length; ++i) next[starts[codes[order[i]] >>> shift & 65535]++] = order[i];
    [order, next] = [next, order];
  }
  return order;
}

// Prepares items of `corners` nodes each for drawing; `vertices` has `dims` integers per corner, in the chunks' order.
function drawnItems(nodes, corners, places) {
  const dims = places.length, count = nodes.length / corners;
  const middles = new Float32Array(dims * count), radii = new Float32Array(count);
  for (let i = 0; i < count; ++i) {
    let square = 0;
    for (let k = 0; k < dims; ++k) {
      let low = Infinity, high = -Infinity;
      for (let c = 0; c < corners; ++c) {
        const value = places[k][nodes[corners * i + c]];
        if (value < low) low = value;
        if (value > high) high = value;
      }
      middles[dims * i + k] = (low + high) / 2 / WHOLE;
      square += ((high - low) / 2 / WHOLE) ** 2;
    }
    radii[i] = Math.sqrt(square);
  }
  const { order, chunks } = inChunks(count, dims, middles, i => radii[i]);
  const vertices = new Int32Array(count * corners * dims);
  for (let i = 0, at = 0; i < count; ++i)
    for (let c = 0; c < corners; ++c) {
      const node = nodes[corners * order[i] + c];
      for (let k = 0; k < dims; ++k) vertices[at++] = places[k][node];
    }
  return { count, dims, order, chunks, vertices };
}

// Returns the extent of the shore that each edge belongs to, as a share: islands of a few pixels get thin lines.
function extentsOf(nodes, places) {
  const parent = new Map();
  const rootOf = node => {
    let root = node;
    while (parent.get(root) !== root) root = parent.get(root);
    while (parent.get(node) !== root) [node] = [parent.get(node), parent.set(node, root)];
    return root;
  };
  for (const node of nodes) parent.set(node, node);
  for (let i = 0; i < nodes.length; i += 2) parent.set(rootOf(nodes[i]), rootOf(nodes[i + 1]));
  const boxes = new Map();
  for (const node of parent.keys()) {
    const root = rootOf(node), box = boxes.get(root) ?? places.map(() => [Infinity, -Infinity]);
    boxes.set(root, box);
    places.forEach((axis, k) => {
      box[k][0] = Math.min(box[k][0], axis[node]);
      box[k][1] = Math.max(box[k][1], axis[node]);
    });
  }
  const extents = new Float32Array(nodes.length / 2);
  for (let i = 0; i < extents.length; ++i)
    extents[i] = Math.max(...boxes.get(rootOf(nodes[2 * i])).map(([low, high]) => high - low)) / WHOLE;
  return extents;
}

async function loadMesh(facts, arrays) {
  const onGlobe = facts.view.kind === "globe";
  const axes = onGlobe ? ["place_x", "place_y", "place_z"] : ["place_x", "place_y"];
  const places = [];
  for (const axis of axes) places.push(await arrays.get(axis));
  const corners = await arrays.get("corners");
  return { facts, arrays, onGlobe, places, corners, triangles: drawnItems(corners, 3, places), lines: [] };
}

async function loadLines(mesh) {
  for (const { kind, array } of mesh.facts.lines) {
    const nodes = await mesh.arrays.get(array);
    const items = drawnItems(nodes, 2, mesh.places), extents = extentsOf(nodes, mesh.places);
    items.extents = items.order.reduce((drawn, i, at) => (drawn[at] = extents[i], drawn), new Float32Array(items.count));
    mesh.lines.push({ kind, ...items });
  }
}

// Returns geocentric coordinates in metres, three per node; for a plane without a place on Earth its coordinates and 0.
async function spacePlaces(mesh) {
  if (mesh.space) return mesh.space;
  const { facts, arrays } = mesh, count = facts.nodes, space = new Float64Array(3 * count);
  if (facts.coordinates === "plane") {
    const x = await arrays.get("x"), y = await arrays.get("y");
    for (let i = 0; i < count; ++i) [space[3 * i], space[3 * i + 1]] = [x[i], y[i]];
  } else {
    const lon = await arrays.get("lon"), lat = await arrays.get("lat"), [radius, flattening] = facts.ellipsoid;
    const squared = flattening * (2 - flattening), degree = Math.PI / 180;
    for (let i = 0; i < count; ++i) {
      const sine = Math.sin(lat[i] * degree), cosine = Math.cos(lat[i] * degree);
      const across = radius / Math.sqrt(1 - squared * sine * sine);
      space[3 * i] = across * cosine * Math.cos(lon[i] * degree);
      space[3 * i + 1] = across * cosine * Math.sin(lon[i] * degree);
      space[3 * i + 2] = across * (1 - squared) * sine;
    }
  }
  return mesh.space = space;
}

// Returns the length of an edge along the ground in metres: the arc over the chord between its nodes.
function edgeLength(mesh, a, b) {
  const space = mesh.space;
  const chord = Math.hypot(space[3 * a] - space[3 * b], space[3 * a + 1] - space[3 * b + 1],
                           space[3 * a + 2] - space[3 * b + 2]);
  if (mesh.facts.coordinates === "plane") return chord;
  const radius = mesh.facts.ellipsoid[0];
  return 2 * radius * Math.asin(Math.min(1, chord / 2 / radius));
}

// Returns square metres, from edge lengths along the ground: Kahan's form of Heron's formula, and the first correction
// term for the sphere.
function areaOfEdges(mesh, lengths) {
  const [c, b, a] = [...lengths].sort((x, y) => x - y);
  const flat = Math.sqrt(Math.max(0, (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)))) / 4;
  if (mesh.facts.coordinates === "plane") return flat;
  return flat * (1 + (a * a + b * b + c * c) / 24 / mesh.facts.ellipsoid[0] ** 2);
}

// Edge i lies opposite corner i.
function edgeLengths(mesh, t) {
  const [a, b, c] = mesh.corners.subarray(3 * t, 3 * t + 3);
  return [edgeLength(mesh, b, c), edgeLength(mesh, c, a), edgeLength(mesh, a, b)];
}

// The smallest and greatest angles of quadrilaterals, in thousandths of a degree, for both halves of each; the greatest
// is 0 for a triangle that is no half.
async function loadQuads(mesh) {
  const { arrays } = mesh;
  if (mesh.quads || !arrays.has("greatest_of_quad")) return;
  mesh.quads = { least: await arrays.get("angle"), greatest: await arrays.get("greatest_of_quad") };
}

// Returns degrees at the three corners: in the plane, or on the globe of the flat triangle through them.
function anglesOf(mesh, t) {
  const corners = [0, 1, 2].map(c => mesh.places.map(axis => axis[mesh.corners[3 * t + c]]));
  return corners.map((at, c) => {
    const u = corners[(c + 1) % 3].map((value, k) => value - at[k]), v = corners[(c + 2) % 3].map((value, k) => value - at[k]);
    const dot = u.reduce((sum, value, k) => sum + value * v[k], 0);
    const across = u.length === 2 ? u[0] * v[1] - u[1] * v[0]
                                  : Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    return Math.atan2(Math.abs(across), dot) * 180 / Math.PI;
  });
}
