// The view: the position at the window's centre, and the scale in device pixels per unit, which is half the longer side
// of the plane or the globe's radius. Screen coordinates: right and up from the window's centre.

const CLOSEST = 2 ** 28, FURTHEST = 0.25;  // limits of the scale: pixels per unit, and relative to the fitting scale

class View {
  constructor(facts) {
    this.onGlobe = facts.view.kind === "globe";
    this.home = this.onGlobe ? facts.view.above : [0, 0];
    this.half = this.onGlobe ? [1, 1] : facts.view.half;
    this.width = this.height = 1;  // pixels
    this.fit();
  }
  // Shows the whole mesh. `middle`: x and y as shares of the unit, or longitude and latitude in degrees.
  fit() {
    this.middle = [...this.home];
    this.scale = this.fittingScale();
    this.fitted = true;
  }
  fittingScale() {
    const [x, y] = this.half.map(share => Math.max(share, 1e-3));
    return 0.95 * Math.min(this.width / 2 / x, this.height / 2 / y);
  }
  resize(width, height) {
    this.width = width;
    this.height = height;
    if (this.fitted) this.fit();
  }
  copy() {
    return { onGlobe: this.onGlobe, middle: [...this.middle], scale: this.scale, width: this.width, height: this.height };
  }

  panPixels(right, up) {
    this.fitted = false;
    if (!this.onGlobe) {
      this.setMiddle([this.middle[0] + right / this.scale, this.middle[1] + up / this.scale]);
    } else {
      const [lon, lat] = this.middle, degree = 180 / Math.PI / this.scale;
      this.setMiddle([lon + right * degree / Math.max(0.05, Math.cos(lat * Math.PI / 180)), lat + up * degree]);
    }
  }
  setMiddle([x, y]) {
    const within = (value, most) => Math.min(most, Math.max(-most, value));
    this.middle = this.onGlobe ? [x - 360 * Math.round(x / 360), within(y, 90)]
                               : [within(x, this.half[0]), within(y, this.half[1])];
  }
  // Zooms about the screen position `right`, `up`.
  zoom(factor, right = 0, up = 0) {
    const least = FURTHEST * this.fittingScale();
    const scale = Math.min(CLOSEST, Math.max(least, this.scale * factor));
    if (this.onGlobe) {
      const at = globePlace(this, right, up);
      this.scale = scale;
      for (let i = 0; i < 3 && at; ++i) {
        const now = globeScreen(this, at);
        if (now[2] <= 0) break;
        this.panPixels(now[0] - right, now[1] - up);
      }
    } else {
      const moved = 1 / this.scale - 1 / scale;
      this.scale = scale;
      this.setMiddle([this.middle[0] + right * moved, this.middle[1] + up * moved]);
    }
    this.fitted = false;
  }
  // Shows `place` with `radius` around it, in shares of the unit.
  show(place, radius) {
    if (this.onGlobe) {
      const [x, y, z] = place;
      this.setMiddle([Math.atan2(y, x) * 180 / Math.PI, Math.atan2(z, Math.hypot(x, y)) * 180 / Math.PI]);
    } else {
      this.setMiddle(place);
    }
    const scale = Math.min(this.width, this.height) / 2 / Math.max(radius, 1e-9);
    this.scale = Math.min(CLOSEST, Math.max(FURTHEST * this.fittingScale(), scale));
    this.fitted = false;
  }
}

// Unit vectors to the right, up and towards the eye.
function globeBasis({ middle: [lon, lat] }) {
  const l = lon * Math.PI / 180, p = lat * Math.PI / 180;
  const toEye = [Math.cos(p) * Math.cos(l), Math.cos(p) * Math.sin(l), Math.sin(p)];
  return [[-Math.sin(l), Math.cos(l), 0], [-Math.sin(p) * Math.cos(l), -Math.sin(p) * Math.sin(l), Math.cos(p)], toEye];
}
function dotOf(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Returns screen coordinates and the height towards the eye, which is negative behind the horizon.
function globeScreen(view, place) {
  const [right, up, eye] = globeBasis(view);
  return [dotOf(place, right) * view.scale, dotOf(place, up) * view.scale, dotOf(place, eye)];
}
// Returns the unit vector at a screen position, null outside the globe.
function globePlace(view, right, up) {
  const x = right / view.scale, y = up / view.scale, square = x * x + y * y;
  if (square >= 1) return null;
  const z = Math.sqrt(1 - square), basis = globeBasis(view);
  return [0, 1, 2].map(k => x * basis[0][k] + y * basis[1][k] + z * basis[2][k]);
}

// Returns the map from places, as integers less `middle`, to pixels. The third row gives the height towards the eye: 0
// at the horizon of the globe, 1 in a plane. The differences are integers too, so nothing is lost at any zoom.
function projectionOf(view) {
  const scale = view.scale / WHOLE;
  if (!view.onGlobe) {
    const middle = view.middle.map(share => Math.round(share * WHOLE));
    const off = view.middle.map((share, k) => (middle[k] / WHOLE - share) * view.scale);
    return { middle: [...middle, 0], rows: [[scale, 0, 0], [0, scale, 0], [0, 0, 0]], off: [...off, 1] };
  }
  const [right, up, eye] = globeBasis(view), middle = eye.map(value => Math.round(value * WHOLE));
  const exact = middle.map((value, k) => value / WHOLE - eye[k]);
  return {
    middle,
    rows: [right.map(value => value * scale), up.map(value => value * scale), eye.map(value => value / WHOLE)],
    off: [dotOf(exact, right) * view.scale, dotOf(exact, up) * view.scale, 1],
  };
}

// Returns the pixels of a place in integers, and its height towards the eye.
function screenOf({ middle, rows, off }, place) {
  return rows.map((row, i) => off[i] + place.reduce((sum, value, k) => sum + row[k] * (value - middle[k]), 0));
}

// Returns whether a chunk may be visible in a window of `width` by `height` pixels about the view's centre.
function seesChunk(projection, view, chunk, width, height) {
  const [x, y, towards] = screenOf(projection, chunk.middle.map(share => share * WHOLE));
  const radius = chunk.radius * view.scale + 4;
  return Math.abs(x) <= width / 2 + radius && Math.abs(y) <= height / 2 + radius && towards > -chunk.radius;
}
