// Draws with WebGL 2. The mesh is drawn into a picture larger than the window, a few chunks per frame if that takes
// long, and meanwhile the last picture is moved, so that motion is smooth however long drawing takes.

const PICTURE_MARGIN = 0.25;  // share of the window, on each side
const SHADES_WIDTH = 4096;    // of the texture with one byte per triangle
const DOT_SIZE = 8;           // CSS pixels; `DotPicture` draws chunks of smaller triangles
const DOTS_MS = 10;           // per frame, for `DotPicture`
const OVERVIEW = 1024;        // pixels, longer side of the picture of the whole mesh

const PLACED = `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
uniform ivec3 middle;
uniform mat3 rows;
uniform vec3 off;
uniform vec2 half_window;
uniform float ratio;
vec3 screenOf(ivec3 place) { return vec3(place - middle) * rows + off; }
vec4 clipOf(vec3 screen) { return vec4(screen.xy / half_window, 1.0 - 1.9 * screen.z, 1.0); }
`;

const TRIANGLE_VERTEX = PLACED + `
layout(location = 0) in ivec3 place;
uniform usampler2D shades;
uniform sampler2D palette;
out vec3 share;
flat out vec3 color;
void main() {
  gl_Position = clipOf(screenOf(place));
  int corner = gl_VertexID % 3, triangle = gl_VertexID / 3;
  share = vec3(corner == 0, corner == 1, corner == 2);
  uint shade = texelFetch(shades, ivec2(triangle & ${SHADES_WIDTH - 1}, triangle / ${SHADES_WIDTH}), 0).r;
  color = texelFetch(palette, ivec2(int(shade), 0), 0).rgb;
}`;

// Edges are as wide as in image files; triangles of a few pixels get a tint instead.
const TRIANGLE_PIXEL = `#version 300 es
precision highp float;
in vec3 share;
flat in vec3 color;
uniform vec4 edge;
uniform float ratio;
out vec4 pixel;
void main() {
  pixel = vec4(color, 1.0);
  if (edge.a == 0.0) return;
  vec3 dx = dFdx(share), dy = dFdy(share);
  vec3 height = inversesqrt(max(dx * dx + dy * dy, vec3(1e-12)));
  float least = min(height.x, min(height.y, height.z)), most = max(height.x, max(height.y, height.z));
  float half_width = min(0.4 * ratio, 0.0433 * least);
  vec3 away = max(share, 0.0) * height;
  vec3 cover = clamp(min(away + 0.5, half_width) - max(away - 0.5, -half_width), 0.0, 1.0);
  float lines = 1.0 - (1.0 - cover.x) * (1.0 - cover.y) * (1.0 - cover.z);
  float ink = mix(0.26, lines, smoothstep(3.0, 7.0, most / ratio));
  pixel.rgb = mix(color, edge.rgb, ink * edge.a);
}`;

const LINE_VERTEX = PLACED + `
layout(location = 0) in ivec3 from;
layout(location = 1) in ivec3 to;
layout(location = 2) in float extent;
uniform float width;
uniform float scale;
out float across;
flat out float half_width;
void main() {
  vec3 a = screenOf(from), b = screenOf(to);
  half_width = width * clamp(extent * scale / ratio / 2.0, 1.0, 8.0) / 16.0;
  vec2 along = b.xy - a.xy;
  float length_px = length(along);
  along = length_px > 1e-6 ? along / length_px : vec2(1.0, 0.0);
  int corner = min(gl_VertexID % 6, 5 - gl_VertexID % 6) + (gl_VertexID % 6 > 2 ? 1 : 0);
  bool end = (corner & 1) != 0;
  across = (corner & 2) != 0 ? half_width + 1.0 : -half_width - 1.0;
  vec3 at = end ? b : a;
  at.xy += (end ? along : -along) * half_width + vec2(-along.y, along.x) * across;
  gl_Position = clipOf(at);
}`;

const LINE_PIXEL = `#version 300 es
precision highp float;
in float across;
flat in float half_width;
uniform vec3 color;
out vec4 pixel;
void main() {
  float away = abs(across);
  float cover = clamp(min(away + 0.5, half_width) - max(away - 0.5, -half_width), 0.0, 1.0);
  pixel = vec4(color, 1.0) * cover;
}`;

// Draws a `DotPicture`: shades, and the coverage of edges.
const DOTS_PIXEL = `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
uniform usampler2D dots;
uniform sampler2D palette;
uniform vec4 edge;
out vec4 pixel;
void main() {
  uvec2 dot = texelFetch(dots, ivec2(gl_FragCoord.xy), 0).rg;
  if (dot.r == ${NO_DOT}u) discard;
  float ink = float(dot.g) / 255.0;
  pixel = vec4(mix(texelFetch(palette, ivec2(int(dot.r), 0), 0).rgb, edge.rgb, ink * edge.a), 1.0);
}`;

const RING_VERTEX = PLACED + `
layout(location = 0) in ivec3 place;
layout(location = 1) in float extent;
uniform float scale;
void main() {
  // Larger triangles are visible without a ring.
  gl_Position = extent * scale > 8.0 * ratio ? vec4(2.0, 2.0, 2.0, 1.0) : clipOf(screenOf(place));
  gl_PointSize = 12.0 * ratio;
}`;

const RING_PIXEL = `#version 300 es
precision highp float;
uniform vec3 color;
uniform float ratio;
out vec4 pixel;
void main() {
  float away = abs(length(gl_PointCoord - 0.5) * 12.0 * ratio - 5.0 * ratio);
  pixel = vec4(color, 1.0) * clamp(0.6 * ratio + 0.5 - away, 0.0, 1.0);
}`;

const WINDOW_VERTEX = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;

// Transforms a picture to the current view: turned with the globe, shifted and scaled.
const WINDOW_PIXEL = `#version 300 es
precision highp float;
precision highp int;
uniform vec2 window;
uniform float flatness;  // 1 over the globe's radius in pixels, 0 for a plane
uniform vec3 ground;
uniform vec3 beyond;
uniform sampler2D picture[2];
uniform mat2 turn[2];
uniform vec2 shift[2];
uniform vec3 towards[2];
uniform int pictures;
uniform bool smooth_picture;
out vec4 pixel;
vec4 at(sampler2D from, mat2 turned, vec2 shifted, vec3 eye, vec2 p, float z, bool smoothly, out bool within) {
  vec2 size = vec2(textureSize(from, 0)), q = turned * p + shifted * z + size / 2.0;
  within = all(greaterThanEqual(q, vec2(0.0))) && all(lessThan(q, size)) && dot(eye, vec3(p * flatness, z)) > 0.0;
  if (!within) return vec4(0.0);
  return smoothly ? texture(from, q / size) : texelFetch(from, ivec2(q), 0);
}
void main() {
  vec2 p = gl_FragCoord.xy - window / 2.0;
  float square = dot(p, p) * flatness * flatness;
  float inside = flatness == 0.0 ? 1.0 : clamp((1.0 - sqrt(square)) / flatness + 0.5, 0.0, 1.0);
  vec3 color = ground;
  if (inside > 0.0) {
    float z = sqrt(max(0.0, 1.0 - square));
    bool within = false;
    vec4 seen = vec4(0.0);
    if (pictures > 0) seen = at(picture[0], turn[0], shift[0], towards[0], p, z, smooth_picture, within);
    if (!within && pictures > 1) seen = at(picture[1], turn[1], shift[1], towards[1], p, z, true, within);
    color = seen.rgb + ground * (1.0 - seen.a);
  }
  pixel = vec4(mix(beyond, color, inside), 1.0);
}`;

// The same for the usual case, at a third of the cost: the picture is only shifted, and covers the window.
const SHIFTED_PIXEL = `#version 300 es
precision highp float;
precision highp int;
uniform sampler2D picture;
uniform ivec2 shift;
out vec4 pixel;
void main() { pixel = texelFetch(picture, ivec2(gl_FragCoord.xy) + shift, 0); }`;

function programOf(gl, vertex, pixel) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, pixel]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    const logs = gl.getAttachedShaders(program).map(shader => gl.getShaderInfoLog(shader));
    throw new Error("The graphics driver refuses the page's shaders: " + [...logs, gl.getProgramInfoLog(program)].join(" "));
  }
  const places = new Map();
  const place = name => places.get(name) ?? (places.set(name, gl.getUniformLocation(program, name)), places.get(name));
  return { program, place };
}

class Drawing {
  constructor(gl, mesh) {
    this.gl = gl;
    this.mesh = mesh;
    this.triangles = programOf(gl, TRIANGLE_VERTEX, TRIANGLE_PIXEL);
    this.line = programOf(gl, LINE_VERTEX, LINE_PIXEL);
    this.dots = programOf(gl, WINDOW_VERTEX, DOTS_PIXEL);
    this.ring = programOf(gl, RING_VERTEX, RING_PIXEL);
    this.window = programOf(gl, WINDOW_VERTEX, WINDOW_PIXEL);
    this.shifted = programOf(gl, WINDOW_VERTEX, SHIFTED_PIXEL);
    this.empty = gl.createVertexArray();
    this.triangle_array = this.arrayOf(mesh.triangles.vertices);
    this.shades = this.texture(gl.R8UI, 1, 1);
    this.palette = this.texture(gl.RGBA8, 256, 1);
    this.dots_texture = null;
    this.line_arrays = [];
    this.bad = { count: 0 };
    this.front = this.back = this.overview = this.job = null;
    this.style = 0;        // version of the appearance: pictures of older versions are redrawn
    this.batch = Infinity; // chunks per frame
  }

  texture(format, width, height) {
    const { gl } = this, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    const filter = format === gl.RGBA8 && height > 1 ? gl.LINEAR : gl.NEAREST;
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return texture;
  }
  arrayOf(vertices) {
    const { gl } = this, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    this.bufferOf(vertices);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribIPointer(0, this.mesh.places.length, gl.INT, 0, 0);
    return array;
  }
  bufferOf(values) {
    const { gl } = this, buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    return buffer;
  }

  addLines(items) {
    const { gl } = this, array = gl.createVertexArray(), dims = this.mesh.places.length;
    gl.bindVertexArray(array);
    // Each of the six vertices of the two triangles that draw an edge stores the whole edge, because instancing is slow
    // in software.
    const whole = new Int32Array(12 * dims * items.count), extents = new Float32Array(6 * items.count);
    for (let i = 0; i < 6 * items.count; ++i) {
      const edge = Math.floor(i / 6);
      for (let k = 0; k < 2 * dims; ++k) whole[2 * dims * i + k] = items.vertices[2 * dims * edge + k];
      extents[i] = items.extents[edge];
    }
    for (const at of [0, 1, 2]) gl.enableVertexAttribArray(at);
    this.bufferOf(whole);
    gl.vertexAttribIPointer(0, dims, gl.INT, 8 * dims, 0);
    gl.vertexAttribIPointer(1, dims, gl.INT, 8 * dims, 4 * dims);
    this.bufferOf(extents);
    gl.vertexAttribPointer(2, 1, gl.FLOAT, false, 4, 0);
    this.line_arrays.push({ array, items });
  }

  setShades(shades) {
    this.shade_bytes = shades;
    const { gl } = this, rows = Math.max(1, Math.ceil(shades.length / SHADES_WIDTH));
    if (rows > gl.getParameter(gl.MAX_TEXTURE_SIZE)) throw new Error("This graphics hardware has no room for so large a mesh.");
    const bytes = new Uint8Array(rows * SHADES_WIDTH);
    bytes.set(shades);
    gl.deleteTexture(this.shades);
    this.shades = this.texture(gl.R8UI, SHADES_WIDTH, rows);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, SHADES_WIDTH, rows, gl.RED_INTEGER, gl.UNSIGNED_BYTE, bytes);
    ++this.style;
  }
  setPalette(palette) {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.palette);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 256, 1, gl.RGBA, gl.UNSIGNED_BYTE, palette);
    ++this.style;
  }
  // Rings around `places` (integers), drawn only while the triangles, of size `extents`, are small on screen.
  setRings(places, extents) {
    const { gl } = this;
    this.bad = { count: extents.length, array: this.arrayOf(places) };
    this.bufferOf(extents);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 1, gl.FLOAT, false, 0, 0);
    ++this.style;
  }
  // theme: colours as bytes; edges, lines: whether they are drawn.
  setLooks(looks) {
    this.looks = looks;
    ++this.style;
  }

  target(width, height) {
    const { gl } = this, texture = this.texture(gl.RGBA8, width, height), frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    return { texture, frame, width, height };
  }
  drop(target) {
    if (!target) return;
    this.gl.deleteFramebuffer(target.frame);
    this.gl.deleteTexture(target.texture);
  }

  usePlaces(used, view, target) {
    const { gl } = this, { middle, rows, off } = projectionOf(view);
    gl.useProgram(used.program);
    gl.uniform3iv(used.place("middle"), middle);
    gl.uniformMatrix3fv(used.place("rows"), false, rows.flat());
    gl.uniform3fv(used.place("off"), off);
    gl.uniform2f(used.place("half_window"), target.width / 2, target.height / 2);
    gl.uniform1f(used.place("ratio"), this.looks.ratio);
  }

  begin(view) {
    const { gl } = this;
    const most = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    const size = pixels => Math.min(pixels + 2 * Math.round(PICTURE_MARGIN * pixels), most - (most - pixels) % 2);
    const width = size(view.width), height = size(view.height);
    if (this.job) gl.deleteSync(this.job.fence);
    if (this.back && (this.back.width !== width || this.back.height !== height)) {
      this.drop(this.back);
      this.back = null;
    }
    this.back ??= this.target(width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.back.frame);
    // On the globe, `compose` draws the ground, which ends at the horizon.
    gl.clearColor(...(view.onGlobe ? [0, 0, 0, 0] : [...this.looks.theme.land.map(byte => byte / 255), 1]));
    gl.clear(gl.COLOR_BUFFER_BIT);
    const drawn = view.copy(), projection = projectionOf(drawn);
    const seen = this.mesh.triangles.chunks.filter(chunk => seesChunk(projection, drawn, chunk, width, height));
    const small = chunk => chunk.item_radius * 2 * drawn.scale < DOT_SIZE * this.looks.ratio;
    this.job = {
      view: drawn, style: this.style, chunks: seen.filter(chunk => !small(chunk)), next: 0, fence: null, began: 0,
      dots: new DotPicture(this.mesh.triangles, this.shade_bytes, projection, seen.filter(small), width, height, this.looks.ratio),
    };
  }

  // Returns whether the job's picture would still be useful.
  serves(job, view) {
    if (job.style !== this.style || job.view.width !== view.width || job.view.height !== view.height) return false;
    const ratio = view.scale / job.view.scale;
    const [x, y] = this.shiftOf(job.view, view);
    return ratio > 0.5 && ratio < 2 && Math.abs(x) < view.width && Math.abs(y) < view.height;
  }
  // Returns the position of the centre of `view` in a picture of `drawn`, in pixels from the picture's centre.
  shiftOf(drawn, view) {
    if (view.onGlobe) return globeScreen(drawn, globeBasis(view)[2]);
    return drawn.middle.map((share, k) => (view.middle[k] - share) * drawn.scale);
  }
  fits(picture, view) {
    if (!picture || picture.style !== this.style || picture.view.scale !== view.scale) return false;
    if (picture.view.width !== view.width || picture.view.height !== view.height) return false;
    const [x, y] = this.shiftOf(picture.view, view);
    if (view.onGlobe) return Math.abs(x) < 0.01 && Math.abs(y) < 0.01;
    return Math.abs(x) <= view.width / 8 && Math.abs(y) <= view.height / 8;
  }

  // Continues drawing. Returns true if a new picture is ready or drawing is not finished.
  step(view, now) {
    if (this.job && !this.serves(this.job, view)) {
      this.gl.deleteSync(this.job.fence);
      this.job = null;
    }
    if (!this.job) {
      if (this.fits(this.front, view)) return false;
      this.begin(view);
    }
    const { gl, job } = this;
    if (job.fence) {
      const state = gl.clientWaitSync(job.fence, 0, 0);
      if (state === gl.TIMEOUT_EXPIRED) return true;
      gl.deleteSync(job.fence);
      job.fence = null;
      const took = now - job.began;
      if (took > 34) this.batch = Math.max(4, Math.floor(job.last * 20 / took));
      else if (took < 20 && job.last >= this.batch) this.batch *= 2;
      if (job.next === job.chunks.length && job.lined) {
        this.finish();
        return true;
      }
    }
    if (!job.dots.draw(this.front ? DOTS_MS : Infinity)) return true;
    job.began = now;
    this.drawBatch();
    job.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    return true;
  }

  drawBatch() {
    const { gl, job, back } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, back.frame);
    gl.viewport(0, 0, back.width, back.height);
    const last = Math.min(job.chunks.length, job.next + this.batch);
    job.last = last - job.next;
    if (job.next === 0) this.drawDots();
    if (job.next < last) this.drawTriangles(job.chunks.slice(job.next, last));
    job.next = last;
    if (last === job.chunks.length) {
      this.drawLines();
      job.lined = true;
    }
  }

  edgeUniform() {
    const { theme, edges, colored } = this.looks;
    return [...(colored ? theme.edge_on_color : theme.edge).map(byte => byte / 255), edges ? 1 : 0];
  }

  drawDots() {
    const { gl, job: { dots }, dots: used } = this;
    if (dots.chunks.length === 0) return;
    gl.activeTexture(gl.TEXTURE0);
    if (this.dots_texture?.width !== dots.width || this.dots_texture.height !== dots.height) {
      if (this.dots_texture) gl.deleteTexture(this.dots_texture.texture);
      this.dots_texture = { texture: this.texture(gl.RG8UI, dots.width, dots.height), width: dots.width, height: dots.height };
    }
    gl.bindTexture(gl.TEXTURE_2D, this.dots_texture.texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, dots.width, dots.height, gl.RG_INTEGER, gl.UNSIGNED_BYTE, dots.pixels);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.palette);
    gl.activeTexture(gl.TEXTURE0);
    gl.useProgram(used.program);
    gl.uniform1i(used.place("dots"), 0);
    gl.uniform1i(used.place("palette"), 1);
    gl.uniform4fv(used.place("edge"), this.edgeUniform());
    gl.bindVertexArray(this.empty);
    gl.disable(gl.BLEND);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  drawTriangles(chunks) {
    const { gl, job, back, triangles: used } = this;
    this.usePlaces(used, job.view, back);
    gl.disable(gl.BLEND);
    gl.uniform4fv(used.place("edge"), this.edgeUniform());
    gl.uniform1i(used.place("shades"), 0);
    gl.uniform1i(used.place("palette"), 1);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.palette);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.shades);
    gl.bindVertexArray(this.triangle_array);
    for (let i = 0, end; i < chunks.length; i = end) {
      for (end = i + 1; end < chunks.length && chunks[end].first === chunks[end - 1].last;) ++end;
      gl.drawArrays(gl.TRIANGLES, 3 * chunks[i].first, 3 * (chunks[end - 1].last - chunks[i].first));
    }
  }

  drawLines() {
    const { gl, job, back, line: used } = this, { theme, lines, ratio } = this.looks;
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    if (lines) {
      this.usePlaces(used, job.view, back);
      gl.uniform1f(used.place("scale"), job.view.scale);
      const projection = projectionOf(job.view);
      for (const { array, items } of this.line_arrays) {
        const { color, width } = theme.lines[items.kind] ?? theme.lines.other;
        gl.uniform3fv(used.place("color"), color.map(byte => byte / 255));
        gl.uniform1f(used.place("width"), width * ratio);
        gl.bindVertexArray(array);
        for (const chunk of items.chunks) {
          if (!seesChunk(projection, job.view, chunk, back.width, back.height)) continue;
          gl.drawArrays(gl.TRIANGLES, 6 * chunk.first, 6 * (chunk.last - chunk.first));
        }
      }
    }
    if (this.bad.count > 0) {
      this.usePlaces(this.ring, job.view, back);
      gl.uniform1f(this.ring.place("scale"), job.view.scale);
      gl.uniform3fv(this.ring.place("color"), theme.bad.map(byte => byte / 255));
      gl.bindVertexArray(this.bad.array);
      gl.drawArrays(gl.POINTS, 0, this.bad.count);
    }
    gl.disable(gl.BLEND);
  }

  finish() {
    const { job } = this;
    this.job = null;
    [this.front, this.back] = [{ ...this.back, view: job.view, style: job.style }, this.front];
    this.takeOverview();
  }

  // Keeps a small picture of the whole mesh for parts of the window that the large one does not cover.
  takeOverview() {
    const { gl, front, mesh } = this, { view } = front;
    const reach = view.onGlobe ? [1, 1] : mesh.facts.view.half;
    if (reach[0] * view.scale > front.width / 2 || reach[1] * view.scale > front.height / 2) return;
    if (!view.onGlobe && (Math.abs(view.middle[0]) > 1e-9 || Math.abs(view.middle[1]) > 1e-9)) return;
    const share = Math.min(1, OVERVIEW / Math.max(front.width, front.height));
    const width = Math.round(front.width * share), height = Math.round(front.height * share);
    this.drop(this.overview);
    this.overview = { ...this.target(width, height), style: front.style, view: { ...view, scale: view.scale * share } };
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, front.frame);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.overview.frame);
    gl.blitFramebuffer(0, 0, front.width, front.height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.LINEAR);
  }

  // Composes the window by a mere shift of the picture; returns false if that is impossible.
  composeShifted(view) {
    const { gl, front, shifted: used } = this;
    if (view.onGlobe || front?.view.scale !== view.scale) return false;
    const shift = this.shiftOf(front.view, view).map(Math.round);
    const low = [(front.width - view.width) / 2 + shift[0], (front.height - view.height) / 2 + shift[1]];
    if (!low.every(Number.isInteger) || low[0] < 0 || low[1] < 0) return false;
    if (low[0] + view.width > front.width || low[1] + view.height > front.height) return false;
    gl.useProgram(used.program);
    gl.uniform1i(used.place("picture"), 0);
    gl.uniform2iv(used.place("shift"), low);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, front.texture);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    return true;
  }

  // Returns the transformation from pixels of `view` to pixels of a picture of `drawn`.
  moveOf(drawn, view) {
    const ratio = drawn.scale / view.scale;
    const shift = this.shiftOf(drawn, view).slice(0, 2);
    if (!view.onGlobe) return { turn: [ratio, 0, 0, ratio], shift, towards: [0, 0, 1] };
    const now = globeBasis(view), then = globeBasis(drawn);
    return {
      turn: [dotOf(then[0], now[0]), dotOf(then[1], now[0]), dotOf(then[0], now[1]), dotOf(then[1], now[1])].map(v => v * ratio),
      shift,
      towards: now.map(axis => dotOf(then[2], axis)),
    };
  }

  // Composes the window from the available pictures.
  compose(view) {
    const { gl, window: used } = this, { theme } = this.looks;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, view.width, view.height);
    gl.disable(gl.BLEND);
    gl.bindVertexArray(this.empty);
    if (this.composeShifted(view)) return;
    gl.useProgram(used.program);
    gl.uniform2f(used.place("window"), view.width, view.height);
    gl.uniform1f(used.place("flatness"), view.onGlobe ? 1 / view.scale : 0);
    gl.uniform3fv(used.place("ground"), theme.land.map(byte => byte / 255));
    gl.uniform3fv(used.place("beyond"), theme.beyond.map(byte => byte / 255));
    const pictures = [this.front, this.overview].filter(picture => picture);
    for (const i of [0, 1]) {
      const picture = pictures[i] ?? pictures[0];
      gl.uniform1i(used.place(`picture[${i}]`), i);
      gl.activeTexture(gl.TEXTURE0 + i);
      gl.bindTexture(gl.TEXTURE_2D, picture ? picture.texture : this.palette);
      const { turn, shift, towards } = picture ? this.moveOf(picture.view, view) : { turn: [1, 0, 0, 1], shift: [0, 0], towards: [0, 0, 1] };
      const exact = i === 0 && !view.onGlobe && picture?.view.scale === view.scale;
      gl.uniformMatrix2fv(used.place(`turn[${i}]`), false, turn);
      gl.uniform2fv(used.place(`shift[${i}]`), exact ? shift.map(Math.round) : shift);
      gl.uniform3fv(used.place(`towards[${i}]`), towards);
      if (i === 0) gl.uniform1i(used.place("smooth_picture"), exact || this.fits(picture, view) ? 0 : 1);
    }
    gl.activeTexture(gl.TEXTURE0);
    gl.uniform1i(used.place("pictures"), pictures.length);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}
