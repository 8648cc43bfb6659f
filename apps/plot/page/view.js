// What is seen: where the middle of the window lies, and how many pixels (of the screen's own) the unit takes, which is
// half the longer side of the plane, or the globe's radius. Screen coordinates: right and up from the window's middle.

const CLOSEST = 2 ** 28, FURTHEST = 0.25;  // zoom: pixels a unit, and of the whole in the window

class View {
  constructor(facts) {
    this.onGlobe = facts.view.kind === "globe";
    this.home = this.onGlobe ? facts.view.above : [0, 0];
    this.half = this.onGlobe ? [1, 1] : facts.view.half;
    this.width = this.height = 1;  // pixels
    this.fit();
  }
  // Plane: x and y as shares of the unit; globe: longitude and latitude.
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
  // Zooms so that what is at `right`, `up` stays there.
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
  // Shows a place of `radius` around it.
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

// On screen, and the height towards the eye: none is seen below 0.
function globeScreen(view, place) {
  const [right, up, eye] = globeBasis(view);
  return [dotOf(place, right) * view.scale, dotOf(place, up) * view.scale, dotOf(place, eye)];
}
// The unit vector at a place on screen, null beside the globe.
function globePlace(view, right, up) {
  const x = right / view.scale, y = up / view.scale, square = x * x + y * y;
  if (square >= 1) return null;
  const z = Math.sqrt(1 - square), basis = globeBasis(view);
  return [0, 1, 2].map(k => x * basis[0][k] + y * basis[1][k] + z * basis[2][k]);
}

// What turns places, whole numbers less `middle`, into pixels: two rows, or three on the globe, the third of which
// tells from the horizon on how far towards the eye. The differences are whole too, so nothing is lost far zoomed in.
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

// Pixels of a place given in whole numbers.
function screenOf({ middle, rows, off }, place) {
  return rows.map((row, i) => off[i] + place.reduce((sum, value, k) => sum + row[k] * (value - middle[k]), 0));
}

// Whether a chunk may be seen in a window of `width` by `height` pixels about the view's middle.
function seesChunk(projection, view, chunk, width, height) {
  const [x, y, towards] = screenOf(projection, chunk.middle.map(share => share * WHOLE));
  const radius = chunk.radius * view.scale + 4;
  return Math.abs(x) <= width / 2 + radius && Math.abs(y) <= height / 2 + radius && towards > -chunk.radius;
}
