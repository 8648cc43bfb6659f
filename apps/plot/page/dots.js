// Rasterises triangles of a few pixels, which graphics hardware draws slowly and software renderers much more slowly:
// two bytes per pixel, the shade of the triangle that contains the pixel's centre, and the share that edges cover, as
// in TRIANGLE_PIXEL.

const NO_DOT = 255;
const DOT_REACH = 0.1;  // pixels beyond its edges: hardware rounds corners, which would leave cracks beside them

class DotPicture {
  constructor(triangles, shades, projection, chunks, width, height, ratio) {
    Object.assign(this, { triangles, shades, projection, chunks, width, height, ratio });
    this.next = 0;
    if (chunks.length > 0) this.pixels = new Uint8Array(2 * width * height).fill(NO_DOT);
  }

  // Draws for about that time. Returns true once all chunks are drawn.
  draw(milliseconds) {
    for (const end = performance.now() + milliseconds; this.next < this.chunks.length && performance.now() < end;)
      this.drawChunk(this.chunks[this.next++]);
    return this.next === this.chunks.length;
  }

  drawChunk({ first, last }) {
    const { triangles: { vertices, dims }, shades, projection: { middle, rows, off }, pixels, width, height, ratio } = this;
    const [mx, my, mz] = middle, [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = rows;
    // Pixel indices refer to centres, half a pixel from the window's edge for the first.
    const [ox, oy, oz] = [off[0] + width / 2 - 0.5, off[1] + height / 2 - 0.5, off[2]];
    const x = [0, 0, 0], y = [0, 0, 0];
    for (let i = first, at = 3 * dims * first; i < last; ++i) {
      let seen = true;
      for (let c = 0; c < 3; ++c, at += dims) {
        const dx = vertices[at] - mx, dy = vertices[at + 1] - my, dz = dims === 3 ? vertices[at + 2] - mz : 0;
        x[c] = ox + xx * dx + xy * dy + xz * dz;
        y[c] = oy + yx * dx + yy * dy + yz * dz;
        if (dims === 3 && oz + zx * dx + zy * dy + zz * dz <= 0) seen = false;
      }
      if (!seen) continue;
      const [ax, bx, cx] = x, [ay, by, cy] = y;
      const left = Math.max(0, Math.ceil(Math.min(ax, bx, cx))), right = Math.min(width - 1, Math.floor(Math.max(ax, bx, cx)));
      const low = Math.max(0, Math.ceil(Math.min(ay, by, cy))), high = Math.min(height - 1, Math.floor(Math.max(ay, by, cy)));
      // Per edge, named after the opposite corner: its length, and how a pixel's distance from it grows along u and v.
      const la = Math.hypot(cx - bx, cy - by), lb = Math.hypot(ax - cx, ay - cy), lc = Math.hypot(bx - ax, by - ay);
      const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
      if (area === 0) continue;
      const sign = area < 0 ? -1 : 1;
      const au = -sign * (cy - by) / la, av = sign * (cx - bx) / la, bu = -sign * (ay - cy) / lb, bv = sign * (ax - cx) / lb;
      const cu = -sign * (by - ay) / lc, cv = sign * (bx - ax) / lc;
      const tall = sign * area / ratio, least = tall / Math.max(la, lb, lc), most = tall / Math.min(la, lb, lc);
      const half = Math.min(0.4, 0.0433 * least) * ratio, drawn = Math.min(1, Math.max(0, (most - 3) / 4));
      const share = drawn * drawn * (3 - 2 * drawn), shade = shades[i];
      for (let v = low; v <= high; ++v) {
        for (let u = left; u <= right; ++u) {
          const a = au * (u - bx) + av * (v - by), b = bu * (u - cx) + bv * (v - cy), c = cu * (u - ax) + cv * (v - ay);
          if (!(a >= -DOT_REACH && b >= -DOT_REACH && c >= -DOT_REACH)) continue;
          const to = 2 * (v * width + u);
          let ink = 0.26;
          if (share > 0) {
            const free = (1 - inkAt(Math.max(0, a), half)) * (1 - inkAt(Math.max(0, b), half)) * (1 - inkAt(Math.max(0, c), half));
            ink += share * (1 - free - ink);
          }
          pixels[to] = shade;
          pixels[to + 1] = 255 * ink;
        }
      }
    }
  }
}

// Returns the share of a pixel covered by a line `away` pixels from its centre and twice `half` wide.
function inkAt(away, half) {
  return Math.max(0, Math.min(1, Math.min(away + 0.5, half) - Math.max(away - 0.5, -half)));
}
