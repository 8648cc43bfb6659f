// The page: events, frames, and messages about missing features.

const KEY_STEP = 80;  // CSS pixels per press of an arrow key

class Page {
  async open() {
    this.facts = readFacts();
    fillPanel(this.facts);
    this.canvas = byId("picture");
    this.requireBrowser();
    this.arrays = new PageArrays(this.facts);
    this.view = new View(this.facts);
    this.theme_name = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
    this.edges = this.facts.edges;
    this.lines = true;
    this.picked = null;
    this.motion = [0, 0];  // pixels still to move, right and up
    this.pointers = new Map();
    this.mesh = await loadMesh(this.facts, this.arrays);
    await loadLines(this.mesh);
    this.angles = await this.arrays.get("angle");
    this.least_angle = this.facts.min_angle > 0 ? this.facts.min_angle - this.facts.angle_slack : 0;
    this.coloring = await colorBy(this.mesh, this.facts.color);
    this.startDrawing();
    this.listen();
    byId("message").textContent = "";
    this.wake();
  }

  requireBrowser() {
    const picture = "\n\nWithout it, have a picture made: coastmesh plot MESH -o mesh.png";
    if (typeof DecompressionStream === "undefined")
      throw new Error("This browser is too old to unpack the mesh (it has no DecompressionStream). " +
                      "Firefox 113, Chrome 80 and Safari 16.4 have it." + picture);
    this.gl = this.canvas.getContext("webgl2", { alpha: false, depth: false, antialias: false, powerPreference: "high-performance" });
    if (!this.gl)
      throw new Error("This browser cannot draw the mesh: it offers no WebGL 2.\n\nIt may be switched off, or the graphics driver refused: " +
                      "about:support (Firefox) or chrome://gpu says why. Other browsers, or a restart of this one, may do better." + picture);
  }

  startDrawing() {
    this.drawing = new Drawing(this.gl, this.mesh);
    for (const items of this.mesh.lines) this.drawing.addLines(items);
    if (this.least_angle > 0) this.ringBad();
    this.applyTheme();
    this.showColoring();
  }

  ringBad() {
    const { corners, places } = this.mesh, middles = [], extents = [];
    for (let t = 0; t < this.angles.length; ++t) {
      if (this.angles[t] / 1000 >= this.least_angle) continue;
      const nodes = corners.subarray(3 * t, 3 * t + 3);
      let extent = 0;
      for (const axis of places) {
        const values = [axis[nodes[0]], axis[nodes[1]], axis[nodes[2]]];
        middles.push(Math.round((values[0] + values[1] + values[2]) / 3));
        extent = Math.max(extent, Math.max(...values) - Math.min(...values));
      }
      extents.push(extent / WHOLE);
    }
    this.drawing.setRings(new Int32Array(middles), new Float32Array(extents));
  }

  applyTheme() {
    document.documentElement.dataset.theme = this.theme_name;
    this.theme = themeOf(this.theme_name, this.facts);
    showLineKinds(this.facts, this.theme);
    this.drawing.setPalette(paletteOf(this.facts, this.coloring.scale, this.theme));
    this.applyLooks();
  }
  applyLooks() {
    byId("edges").checked = this.edges;
    byId("lines").checked = this.lines;
    byId("line-kinds").hidden = !this.lines;
    this.drawing.setLooks({ theme: this.theme, edges: this.edges, lines: this.lines, colored: this.coloring.color !== "none",
                            ratio: devicePixelRatio });
    this.changed();
  }
  showColoring() {
    byId("color").value = this.coloring.color;
    this.drawing.setShades(shadesOf(this.mesh, this.coloring, this.least_angle, this.angles));
    this.drawing.setPalette(paletteOf(this.facts, this.coloring.scale, this.theme));
    showLegend(this.mesh, this.coloring);
    showHistogram(this.mesh, this.coloring, byId("log").checked);
    this.worst = null;
    this.applyLooks();
  }
  async setColor(color) {
    byId("color").value = this.wanted_color = color;
    const coloring = await colorBy(this.mesh, color);
    if (this.wanted_color !== color) return;
    this.coloring = coloring;
    this.showColoring();
  }

  changed() {
    this.moved = true;
    this.wake();
  }
  wake() { this.frame ??= requestAnimationFrame(now => this.paint(now)); }

  paint(now) {
    this.frame = null;
    if (this.gl.isContextLost()) return;
    const ratio = devicePixelRatio, { canvas, view } = this;
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) {
      [canvas.width, canvas.height] = [width, height];
      view.resize(width, height);
      if (this.drawing.looks.ratio !== ratio) this.applyLooks();
      this.moved = true;
    }
    if (this.motion[0] !== 0 || this.motion[1] !== 0) {
      const step = this.motion.map(left => Math.abs(left) < 3 ? left : Math.round(left * 0.3));
      this.motion = this.motion.map((left, k) => left - step[k]);
      view.panPixels(...step);
      this.moved = true;
    }
    const before = this.drawing.front, more = this.drawing.step(view, now);
    const fresh = this.drawing.front !== before;
    if (this.moved || fresh) {
      this.drawing.compose(view);
      this.placeMarks();
      this.placeScale();
    }
    this.moved = false;
    if (fresh && !this.shown) {
      this.shown = true;
      requestAnimationFrame(() => { document.documentElement.dataset.firstPicture = Math.round(performance.now()); });
    }
    if (more || this.motion[0] !== 0 || this.motion[1] !== 0) this.wake();
    else document.documentElement.dataset.drawn = this.drawing.style;
  }

  // Returns CSS pixels from the top left, and the height towards the eye, of a place in integers.
  pagePlace(projection, place) {
    const [x, y, towards] = screenOf(projection, place), ratio = devicePixelRatio;
    return [(x + this.view.width / 2) / ratio, (this.view.height / 2 - y) / ratio, towards];
  }
  fromPage(x, y) {
    const ratio = devicePixelRatio;
    return [x * ratio - this.view.width / 2, this.view.height / 2 - y * ratio];
  }

  placeMarks() {
    const svg = byId("marks"), { picked, mesh } = this;
    svg.replaceChildren();
    if (!picked) return;
    const projection = projectionOf(this.view);
    const places = (picked.kind === "node" ? [picked.number] : [...mesh.corners.subarray(3 * picked.number, 3 * picked.number + 3)])
      .map(node => this.pagePlace(projection, mesh.places.map(axis => axis[node])));
    if (places.some(place => place[2] <= 0)) return;
    const spread = Math.max(...[0, 1].map(k => Math.max(...places.map(p => p[k])) - Math.min(...places.map(p => p[k]))));
    if (picked.kind === "triangle") svg.append(svgElement("polygon", { points: places.map(p => p.slice(0, 2).map(v => v.toFixed(2)).join(",")).join(" ") }));
    if (spread < 14) {
      const [x, y] = [0, 1].map(k => places.reduce((sum, p) => sum + p[k], 0) / places.length);
      svg.append(svgElement("circle", { cx: x.toFixed(2), cy: y.toFixed(2), r: picked.kind === "node" ? 6 : 12 }));
    }
  }

  placeScale() {
    const { facts, view } = this;
    let pixels;  // per metre: of the device, then CSS pixels
    if (view.onGlobe) {
      pixels = view.scale / facts.ellipsoid[0];
    } else {
      pixels = view.scale / (facts.view.unit * WHOLE) * this.planeScale();
    }
    pixels /= devicePixelRatio;
    const wanted = 130 / pixels, power = 10 ** Math.floor(Math.log10(wanted));
    const length = [5, 2, 1].map(digit => digit * power).find(length => length <= wanted) ?? power;
    byId("scale-bar").style.width = `${(length * pixels).toFixed(1)}px`;
    byId("scale-text").textContent = lengthText(this.mesh, length);
  }
  // Returns the ratio of plane length to true length at the window's centre.
  planeScale() {
    const { scales, half } = this.facts.view;
    if (!scales) return 1;
    const across = Math.sqrt(scales.length), [x, y] = this.view.middle.map((share, k) => {
      return half[k] > 0 ? Math.min(1, Math.max(0, share / half[k] / 2 + 0.5)) * (across - 1) : 0;
    });
    const column = Math.min(across - 2, Math.floor(x)), row = Math.min(across - 2, Math.floor(y));
    const at = (i, k) => scales[(row + i) * across + column + k], u = x - column, v = y - row;
    return (at(0, 0) * (1 - u) + at(0, 1) * u) * (1 - v) + (at(1, 0) * (1 - u) + at(1, 1) * u) * v;
  }

  pick(x, y) {
    const found = pickAt(this.mesh, this.view, ...this.fromPage(x, y), NODE_REACH * devicePixelRatio);
    if (found.node !== null) return this.setPicked({ kind: "node", number: found.node });
    return this.setPicked(found.triangle ? { kind: "triangle", number: found.triangle.triangle } : null);
  }
  async setPicked(picked) {
    this.picked = picked;
    this.changed();
    await showPicked(this.mesh, picked, next => this.setPicked(next));
  }
  showPlace(picked) {
    const { middle, radius } = whereIs(this.mesh, picked);
    this.view.show(middle, 6 * radius);
    this.motion = [0, 0];
    this.changed();
  }
  goTo(picked) {
    this.setPicked(picked);
    this.showPlace(picked);
  }

  // Goes to the next of the hundred triangles with the smallest values of the present colouring (for depth, the
  // shallowest), or with the smallest angles if they are coloured by nothing or by kinds.
  async nextWorst() {
    if (!this.worst) {
      const { color, scale } = this.coloring, shape = !scale || scale.kinds;
      const values = shape ? await valuesOf(this.mesh, "angle") : this.coloring.values;
      const sign = !shape && color === "depth" ? -1 : 1;
      const known = values.filter(Number.isFinite).map(value => sign * value).sort();
      const most = known[Math.min(99, known.length - 1)], found = [], equal = [];  // equal: to the last of the hundred
      for (let t = 0; t < values.length; ++t) {
        if (sign * values[t] < most) found.push(t);
        else if (sign * values[t] === most && equal.length < 100) equal.push(t);
      }
      found.sort((a, b) => sign * (values[a] - values[b]) || a - b);
      this.worst = { found: [...found, ...equal].slice(0, 100), next: 0 };
    }
    const { found, next } = this.worst;
    if (found.length === 0) return;
    this.worst.next = (next + 1) % found.length;
    this.goTo({ kind: "triangle", number: found[next] });
  }

  find(text) {
    const match = /^\s*(t|triangle|n|node)?\s*([0-9][0-9,]*)\s*$/i.exec(text);
    const kind = match?.[1]?.[0].toLowerCase() === "n" ? "node" : "triangle";
    const number = match ? Number(match[2].replaceAll(",", "")) : 0, most = kind === "node" ? this.facts.nodes : this.facts.triangles;
    byId("find-error").textContent = !match ? "Write a number, with “triangle” or “node” before it."
      : number < 1 || number > most ? `There are ${kind}s 1 to ${counted(most)}.` : "";
    if (byId("find-error").textContent === "") this.goTo({ kind, number: number - 1 });
  }

  zoomAt(factor, x, y) {
    const middle = [this.canvas.clientWidth / 2, this.canvas.clientHeight / 2];
    this.view.zoom(factor, ...this.fromPage(x ?? middle[0], y ?? middle[1]));
    this.motion = [0, 0];
    this.changed();
  }
  fit() {
    this.view.fit();
    this.motion = [0, 0];
    this.changed();
  }
  setTheme(name) {
    this.theme_name = name;
    this.applyTheme();
  }
  togglePanel() { byId("panel").hidden = !byId("panel").hidden; }
  toggleHelp() {
    const help = byId("help");
    if (help.open) help.close();
    else help.showModal();
  }

  keyDown(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target.closest("input, select, textarea") && event.key !== "Escape") return;
    if (byId("help").open && event.key !== "?") return;
    if (event.key === "Enter" && event.target.closest("button")) return;
    const colors = this.facts.colors, step = KEY_STEP * devicePixelRatio * (event.shiftKey ? 4 : 1);
    const move = (right, up) => { this.motion = this.motion.map((left, k) => Math.max(-2 * step, Math.min(2 * step, left + [right, up][k] * step))); this.wake(); };
    const turn = by => this.setColor(colors[(colors.indexOf(this.wanted_color ?? this.coloring.color) + by + colors.length) % colors.length]);
    const actions = {
      ArrowLeft: () => move(-1, 0), ArrowRight: () => move(1, 0), ArrowUp: () => move(0, 1), ArrowDown: () => move(0, -1),
      "+": () => this.zoomAt(1.5), "=": () => this.zoomAt(1.5), "-": () => this.zoomAt(1 / 1.5), _: () => this.zoomAt(1 / 1.5),
      0: () => this.fit(), Home: () => this.fit(),
      Enter: () => this.pick(this.canvas.clientWidth / 2, this.canvas.clientHeight / 2),
      f: () => this.picked && this.showPlace(this.picked), w: () => this.nextWorst(), g: () => this.openFind(),
      c: () => turn(event.shiftKey ? -1 : 1),
      e: () => { this.edges = !this.edges; this.applyLooks(); }, b: () => { this.lines = !this.lines; this.applyLooks(); },
      l: () => byId("log").click(),
      t: () => this.setTheme(this.theme_name === "dark" ? "light" : "dark"), p: () => this.togglePanel(),
      Escape: () => { this.canvas.focus(); this.setPicked(null); }, "?": () => this.toggleHelp(), h: () => this.toggleHelp(),
    };
    const action = actions[event.key] ?? actions[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    action();
  }
  openFind() {
    byId("panel").hidden = false;
    byId("find-text").focus();
    byId("find-text").select();
  }

  placeOf(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }
  pointerDown(event) {
    if (event.button !== 0) return;
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, this.placeOf(event));
    this.pressed = this.pointers.size === 1 ? this.placeOf(event) : null;
    this.motion = [0, 0];
  }
  pointerMove(event) {
    const before = this.pointers.get(event.pointerId), at = this.placeOf(event);
    if (!before) return this.showPointer(at);
    const others = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    if (this.pressed && Math.hypot(at[0] - this.pressed[0], at[1] - this.pressed[1]) < 4) return;
    this.pressed = null;
    this.canvas.classList.add("moving");
    this.pointers.set(event.pointerId, at);
    const ratio = devicePixelRatio, [other] = others;
    const share = other ? 0.5 : 1;  // each of two fingers moves it by half
    this.view.panPixels((before[0] - at[0]) * ratio * share, (at[1] - before[1]) * ratio * share);
    if (other) {
      const far = place => Math.max(10, Math.hypot(place[0] - other[0], place[1] - other[1]));
      this.view.zoom(far(at) / far(before), ...this.fromPage((at[0] + other[0]) / 2, (at[1] + other[1]) / 2));
    }
    this.changed();
  }
  pointerUp(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    this.canvas.classList.remove("moving");
    if (this.pressed && event.type === "pointerup") this.pick(...this.pressed);
    this.pressed = null;
  }
  async showPointer([x, y]) {
    this.pointer = [x, y];
    const { mesh, view } = this, [right, up] = this.fromPage(x, y), found = pickAt(mesh, view, right, up, 0).triangle;
    let place = found ? await placeIn(mesh, found.triangle, found.shares) : null;
    if (!place && view.onGlobe) {
      const on = globePlace(view, right, up);
      if (on) place = [Math.atan2(on[1], on[0]) * 180 / Math.PI, Math.asin(on[2]) * 180 / Math.PI];
    }
    if (this.pointer[0] !== x || this.pointer[1] !== y) return;
    const text = mesh.facts.coordinates === "plane" ? value => digits(value, 7) : value => value.toFixed(5);
    byId("pointer").textContent = place ? place.map(text).join(", ") : "";
  }

  listen() {
    const { canvas } = this;
    new ResizeObserver(() => this.changed()).observe(canvas);
    addEventListener("keydown", event => this.keyDown(event));
    canvas.addEventListener("pointerdown", event => this.pointerDown(event));
    canvas.addEventListener("pointermove", event => this.pointerMove(event));
    canvas.addEventListener("pointerup", event => this.pointerUp(event));
    canvas.addEventListener("pointercancel", event => this.pointerUp(event));
    canvas.addEventListener("pointerleave", () => { this.pointer = [NaN, NaN]; byId("pointer").textContent = ""; });
    canvas.addEventListener("dblclick", event => this.zoomAt(2, ...this.placeOf(event)));
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 30 : event.deltaMode === 2 ? 300 : 1;
      const turned = Math.max(-400, Math.min(400, event.deltaY * lines)) * (event.ctrlKey ? 5 : 1);
      this.zoomAt(Math.exp(-turned * 0.002), ...this.placeOf(event));
    }, { passive: false });
    canvas.addEventListener("webglcontextlost", event => {
      event.preventDefault();
      byId("message").textContent = "The graphics driver dropped the picture. It comes back by itself, or when the page is reloaded.";
    });
    canvas.addEventListener("webglcontextrestored", () => {
      byId("message").textContent = "";
      this.startDrawing();
    });
    const buttons = {
      closer: () => this.zoomAt(1.5), further: () => this.zoomAt(1 / 1.5), whole: () => this.fit(),
      theme: () => this.setTheme(this.theme_name === "dark" ? "light" : "dark"), "help-button": () => this.toggleHelp(),
      "panel-button": () => this.togglePanel(),
    };
    for (const [id, action] of Object.entries(buttons)) byId(id).addEventListener("click", action);
    byId("color").addEventListener("change", () => this.setColor(byId("color").value));
    byId("edges").addEventListener("change", () => { this.edges = byId("edges").checked; this.applyLooks(); });
    byId("lines").addEventListener("change", () => { this.lines = byId("lines").checked; this.applyLooks(); });
    byId("log").addEventListener("change", () => showHistogram(this.mesh, this.coloring, byId("log").checked));
    byId("find").addEventListener("submit", event => {
      event.preventDefault();
      this.find(byId("find-text").value);
    });
    canvas.focus();
  }
}

const page = new Page();
page.open().catch(error => {
  byId("message").textContent = error.message;
  document.documentElement.dataset.failed = "";
  console.error(error);
});
