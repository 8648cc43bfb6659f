// Colours of triangles: a value per triangle, its position on a scale, and a histogram of the values.

const SHADES = 251;  // per scale; the palette's last entries belong to none
const WATER = 251, UNKNOWN = 252, BAD = 253;
const BINS = 60;

const COLOR_NAMES = {
  none: "nothing", angle: "smallest angle", quality: "quality", size: "size (edge)", depth: "depth",
  timestep: "time step (CFL)", feature: "feature", region: "region", piece: "piece", part: "part of the solver",
};
const KINDS = ["feature", "region", "piece", "part"];

function digits(value, count) {
  return value === 0 ? "0" : Math.abs(value) >= 10 ** count ? String(Math.round(value)) : String(Number(value.toPrecision(count)));
}
function lengthText(mesh, metres, count = 4) {
  if (mesh.facts.coordinates === "plane") return digits(metres, count);
  return metres >= 1000 ? digits(metres / 1000, count) + " km" : digits(metres, count) + " m";
}
function areaText(mesh, square) {
  if (mesh.facts.coordinates === "plane") return digits(square, 6);
  return square >= 1e6 ? digits(square / 1e6, 6) + " km²" : digits(square, 6) + " m²";
}
function valueText(mesh, color, value) {
  if (!Number.isFinite(value)) return "unknown";
  switch (color) {
    case "angle": return digits(value, 5) + "°";
    case "size": return lengthText(mesh, value);
    case "depth": return digits(value, 5) + " m up";
    case "timestep": return digits(value, 4) + " s";
    default: return digits(value, 4);
  }
}

async function kindsOf(mesh, color) {
  const { facts, arrays } = mesh, kinds = await arrays.get(color === "region" && facts.regions ? "feature" : color);
  return color === "region" && facts.regions ? kinds.map(feature => facts.region_of_feature[feature]) : kinds;
}
function kindName(mesh, color, kind) {
  const { facts } = mesh;
  if (color === "feature") return facts.features[kind] ?? String(kind);
  if (color === "region" && facts.regions) return kind === 0 ? "none" : facts.regions[kind - 1];
  if (color === "region" || color === "piece") return `${color} ${kind + 1}`;  // files count pieces from 1
  return color + " " + kind;
}

// Returns a value per triangle, NaN if unknown: degrees, metres, seconds, or the number of a kind.
async function valuesOf(mesh, color) {
  const { corners, arrays } = mesh, count = corners.length / 3;
  if (KINDS.includes(color)) return kindsOf(mesh, color);
  const values = new Float64Array(count);
  if (color === "angle") {
    const angles = await arrays.get("angle");
    for (let t = 0; t < count; ++t) values[t] = angles[t] / 1000;
    return values;
  }
  if (color === "depth") {
    const z = await arrays.get("z");
    for (let t = 0; t < count; ++t) values[t] = (z[corners[3 * t]] + z[corners[3 * t + 1]] + z[corners[3 * t + 2]]) / 3;
    return values;
  }
  await spacePlaces(mesh);
  await loadQuads(mesh);
  const z = color === "timestep" ? await arrays.get("z") : null;
  for (let t = 0; t < count; ++t) values[t] = shapeValue(mesh, color, t, z);
  return values;
}

function shapeValue(mesh, color, t, z) {
  const lengths = edgeLengths(mesh, t);
  if (color === "timestep") {
    let deepest = NaN;
    for (let c = 0; c < 3; ++c) {
      const depth = -z[mesh.corners[3 * t + c]];
      if (!(deepest >= depth) && !Number.isNaN(depth)) deepest = depth;
    }
    return deepest > 0 ? Math.min(...lengths) / Math.sqrt(mesh.facts.gravity * deepest) : NaN;
  }
  if (color === "quality" && mesh.quads?.greatest[t] > 0) return quadQuality(mesh, t);
  const area = areaOfEdges(mesh, lengths);
  // The edge of an equilateral triangle of the same area.
  if (color === "size") return Math.sqrt(area * 4 / Math.sqrt(3));
  const squares = lengths[0] ** 2 + lengths[1] ** 2 + lengths[2] ** 2;
  return squares > 0 ? 4 * Math.sqrt(3) * area / squares : 0;
}

// The smallest sine of the angles of the quadrilateral that the triangle is a half of: one of the extreme angles has it.
function quadQuality({ quads: { least, greatest } }, t) {
  const sine = angle => Math.sin(angle / 1000 * Math.PI / 180);
  return Math.max(0, Math.min(sine(least[t]), greatest[t] < 180000 ? sine(greatest[t]) : 0));
}

// Returns the scale of values, from 0 at `low` to 1 at `high`, logarithmic if `log`; for kinds only the palette.
function scaleOf(mesh, color, values) {
  if (KINDS.includes(color)) return { kinds: true, palette: "kinds" };
  if (color === "angle") return { low: 0, high: 60, log: false, palette: "ramp" };
  if (color === "quality") return { low: mesh.facts.least_quality, high: 1, log: false, palette: "ramp" };
  const log = color !== "depth";
  // A triangle without an area has no place on a logarithmic scale; it gets the colour of the lower end.
  const known = values.filter(value => Number.isFinite(value) && (!log || value > 0)).sort();
  // The smallest 2 % are clipped, because they would take up half of the scale.
  const low = known[color === "size" ? Math.floor(known.length / 50) : 0], high = known[known.length - 1];
  return { low, high, log, palette: color === "depth" ? "depth" : "ramp" };
}

function shareOf(scale, value) {
  const at = scale.log ? Math.log : Number;
  return (at(value) - at(scale.low)) / Math.max(1e-12, at(scale.high) - at(scale.low));
}

// Returns a palette index for each triangle, one byte each, in drawing order.
function shadesOf(mesh, coloring, least_angle, angles) {
  const { order, count } = mesh.triangles, shades = new Uint8Array(count), { values, scale } = coloring;
  for (let i = 0; i < count; ++i) {
    const t = order[i];
    if (least_angle > 0 && angles[t] / 1000 < least_angle) shades[i] = BAD;
    else if (!values) shades[i] = WATER;
    else if (scale.kinds) shades[i] = values[t] % SHADES;
    else {
      const share = shareOf(scale, values[t]);
      shades[i] = Number.isNaN(share) ? UNKNOWN : Math.round(Math.min(1, Math.max(0, share)) * (SHADES - 1));
    }
  }
  return shades;
}

// Returns the number of triangles per bin of values; `unknown` counts triangles without a value.
function histogramOf(mesh, color, values, scale) {
  if (!values) return { bins: [], unknown: mesh.corners.length / 3 };
  if (scale.kinds) {
    let most = 0;
    for (const kind of values) most = Math.max(most, kind);
    const each = Math.ceil((most + 1) / BINS), bins = [];
    for (let first = 0; first <= most; first += each) bins.push({ from: first, to: Math.min(most, first + each - 1), count: 0 });
    for (const kind of values) ++bins[Math.floor(kind / each)].count;
    return { bins, unknown: 0 };
  }
  let least = Infinity, lowest = Infinity, greatest = -Infinity, sum = 0, known = 0;  // lowest: of the scale
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < least) least = value;
    if (value < lowest && (!scale.log || value > 0)) lowest = value;
    if (value > greatest) greatest = value;
    sum += value;
    ++known;
  }
  const unknown = values.length - known;
  if (lowest === Infinity) return { bins: [], unknown, least, greatest, mean: sum / known };
  const whole = color === "angle" ? [0, Math.max(60, greatest)] : [lowest, greatest];
  const at = scale.log ? Math.log : Number, back = scale.log ? Math.exp : Number;
  const low = at(whole[0]), step = (at(whole[1]) - low) / BINS;
  const count = step > 0 ? BINS : 1, bins = [];
  for (let i = 0; i < count; ++i) bins.push({ from: back(low + i * step), to: back(low + (i + 1) * step), count: 0 });
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    const bin = step > 0 ? Math.floor((at(value) - low) / step) : 0;
    ++bins[Math.min(count - 1, Math.max(0, bin))].count;
  }
  return { bins, unknown, least, greatest, mean: sum / known };
}

async function colorBy(mesh, color) {
  if (color === "none") return { color, values: null, scale: null, histogram: null };
  const values = await valuesOf(mesh, color), scale = scaleOf(mesh, color, values);
  return { color, values, scale, histogram: histogramOf(mesh, color, values, scale) };
}

// Returns 256 colours of four bytes (RGBA).
function paletteOf(facts, scale, theme) {
  const bytes = new Uint8Array(1024).fill(255);
  const put = (at, color) => bytes.set(color, 4 * at);
  (scale ? facts.palettes[scale.palette] : []).forEach((color, i) => put(i, color));
  put(WATER, theme.water);
  put(UNKNOWN, theme.unknown);
  put(BAD, theme.bad);
  return bytes;
}
