// The panel beside the map: colours and their histogram, and the numbers of the picked triangle or node.

const THEMES = {
  light: {
    land: [244, 242, 238], beyond: [255, 255, 255], water: [221, 236, 246], unknown: [204, 204, 204], bad: [224, 26, 26],
    edge: [82, 133, 173], edge_on_color: [41, 69, 92],
    lines: {
      shore: { color: [26, 51, 82], width: 1.1 }, land: { color: [26, 51, 82], width: 1.1 },
      island: { color: [166, 115, 10], width: 1.3 }, open: { color: [214, 38, 143], width: 2.6 },
      river: { color: [0, 120, 190], width: 2.6 }, border: { color: [34, 60, 87], width: 0.9 },
      constraint: { color: [110, 50, 150], width: 1.5 }, weir: { color: [190, 70, 20], width: 2 },
      "region border": { color: [34, 60, 87], width: 1.3 }, other: { color: [26, 51, 82], width: 1.1 },
    },
  },
  dark: {
    land: [34, 38, 43], beyond: [18, 20, 24], water: [44, 78, 107], unknown: [120, 120, 120], bad: [255, 72, 72],
    edge: [122, 162, 194], edge_on_color: [16, 26, 35],
    lines: {
      shore: { color: [222, 230, 238], width: 1.1 }, land: { color: [222, 230, 238], width: 1.1 },
      island: { color: [236, 184, 84], width: 1.3 }, open: { color: [255, 105, 185], width: 2.6 },
      river: { color: [95, 195, 255], width: 2.6 }, border: { color: [200, 210, 220], width: 0.9 },
      constraint: { color: [205, 150, 240], width: 1.5 }, weir: { color: [255, 150, 90], width: 2 },
      "region border": { color: [200, 210, 220], width: 1.3 }, other: { color: [222, 230, 238], width: 1.1 },
    },
  },
};
const LINE_NAMES = {
  shore: "shore", land: "land", island: "island", open: "open boundary", river: "river", border: "border of features",
  constraint: "line", weir: "weir", "region border": "border of regions",
};

// Islands differ from land only if there is an open boundary.
function themeOf(name, facts) {
  const theme = THEMES[name];
  if (facts.lines.some(({ kind }) => kind === "open")) return theme;
  return { ...theme, lines: { ...theme.lines, island: theme.lines.land } };
}

const byId = id => document.getElementById(id);
const counted = count => count.toLocaleString("en");
const cssColor = color => `rgb(${color.join(" ")})`;
function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}
function svgElement(name, attributes) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

function fillPanel(facts) {
  byId("title").textContent = facts.title;
  const crs = facts.coordinates === "plane" ? "in a plane without a place on Earth" : facts.crs;
  byId("about").textContent = `${counted(facts.nodes)} nodes, ${counted(facts.triangles)} triangles\n${facts.file}, ${crs}`;
  byId("written-by").textContent = `Written by coastmesh ${facts.coastmesh}. Triangles and nodes are counted from 1. ` +
    (facts.view.kind === "globe" ? "Seen as on a globe from far off; angles are those of flat triangles through the nodes."
     : facts.view.projection ? `Angles are those in the plane of: ${facts.view.projection}.` : "");
  for (const color of facts.colors) byId("color").append(element("option", { value: color, textContent: COLOR_NAMES[color] }));
}

function showLineKinds(facts, theme) {
  byId("line-kinds").replaceChildren(...facts.lines.map(({ kind }) => {
    const dash = element("i");
    dash.style.borderColor = cssColor((theme.lines[kind] ?? theme.lines.other).color);
    return element("li", {}, dash, LINE_NAMES[kind] ?? kind);
  }));
}

function shadeColor(facts, scale, value) {
  const colors = facts.palettes[scale.palette];
  if (scale.kinds) return colors[value % SHADES];
  return colors[Math.round(Math.min(1, Math.max(0, shareOf(scale, value))) * (SHADES - 1))];
}

function showLegend(mesh, { color, scale }) {
  const shown = scale !== null && !scale.kinds;
  byId("legend").hidden = !shown;
  if (!shown) return;
  const canvas = byId("ramp"), pen = canvas.getContext("2d");
  for (let x = 0; x < canvas.width; ++x) {
    pen.fillStyle = cssColor(mesh.facts.palettes[scale.palette][Math.round(x / (canvas.width - 1) * (SHADES - 1))]);
    pen.fillRect(x, 0, 1, 1);
  }
  byId("low").textContent = valueText(mesh, color, scale.low);
  byId("high").textContent = valueText(mesh, color, scale.high);
}

// `log`: whether the heights of bars are logarithmic.
function showHistogram(mesh, { color, scale, histogram }, log) {
  const svg = byId("histogram"), text = byId("histogram-text"), { facts } = mesh;
  svg.replaceChildren();
  text.textContent = "";
  if (!histogram) return;
  const { bins, unknown } = histogram, width = 288, height = 110;
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.setAttribute("preserveAspectRatio", "none");
  svg.setAttribute("aria-label", "How many triangles there are, by " + COLOR_NAMES[color]);
  const most = Math.max(1, ...bins.map(bin => bin.count)), wide = width / bins.length;
  const tallness = count => log ? Math.log1p(count) : count;
  bins.forEach((bin, i) => {
    const tall = bin.count === 0 ? 0 : Math.max(1.5, (height - 2) * tallness(bin.count) / tallness(most));
    const middle = scale.kinds ? bin.from : scale.log ? Math.sqrt(bin.from * bin.to) : (bin.from + bin.to) / 2;
    const between = !scale.kinds ? `${valueText(mesh, color, bin.from)} to ${valueText(mesh, color, bin.to)}`
      : bin.from === bin.to ? kindName(mesh, color, bin.from)
      : `${kindName(mesh, color, bin.from)} to ${kindName(mesh, color, bin.to)}`;
    svg.append(svgElement("rect", { class: "bin", x: i * wide + 0.3, y: height - tall, width: Math.max(0.5, wide - 0.6), height: tall,
                                    fill: cssColor(shadeColor(facts, scale, middle)), "data-count": bin.count }));
    const whole = svgElement("rect", { class: "whole", x: i * wide, y: 0, width: wide, height });
    whole.append(svgElement("title", {}));
    whole.firstChild.textContent = `${between}: ${counted(bin.count)} triangles`;
    svg.append(whole);
  });
  svg.append(svgElement("line", { x1: 0, x2: width, y1: height - 0.5, y2: height - 0.5 }));
  const parts = [];
  if (scale.kinds) parts.push(`${counted(new Set(bins.filter(bin => bin.count > 0)).size)} bars`);
  else parts.push(`least ${valueText(mesh, color, histogram.least)}`, `mean ${valueText(mesh, color, histogram.mean)}`,
                  `greatest ${valueText(mesh, color, histogram.greatest)}`);
  if (unknown > 0) parts.push(`${counted(unknown)} triangles unknown`);
  text.textContent = parts.join(", ");
}

function tableOf(rows) {
  return element("table", {}, ...rows.map(([name, text]) => element("tr", {}, element("td", { textContent: name }), element("td", { textContent: text }))));
}

// `go`: called by the buttons for a node's or a triangle's number.
async function showPicked(mesh, picked, go) {
  const section = byId("picked");
  if (!picked) return section.replaceChildren();
  const link = (kind, number) => element("button", { type: "button", textContent: `${kind} ${number + 1}`, onclick: () => go({ kind, number }) });
  const heading = element("h2", { textContent: `${picked.kind === "node" ? "Node" : "Triangle"} ${picked.number + 1}` });
  if (picked.kind === "node") {
    const { rows, around } = await numbersOfNode(mesh, picked.number);
    section.replaceChildren(heading, tableOf(rows), element("p", {}, ...around.map(t => link("triangle", t))));
  } else {
    const { rows, nodes } = await numbersOfTriangle(mesh, picked.number);
    section.replaceChildren(heading, tableOf(rows), element("p", {}, ...nodes.map(node => link("node", node))));
  }
}
