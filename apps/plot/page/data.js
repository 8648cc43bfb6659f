"use strict";
// Unpacks the page's data; apps/plot/page_arrays.hpp describes the format.

function readFacts() {
  const element = document.getElementById("facts");
  if (!element) throw new Error("This page is cut short: it ends before its mesh. Write or copy it again.");
  return JSON.parse(element.textContent);
}

function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const digits = atob(text), bytes = new Uint8Array(digits.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = digits.charCodeAt(i);
  return bytes;
}

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Sums up differences, zigzag-coded (0, -1, 1, -2, ... as 0, 1, 2, 3, ...), each in the bytes of four planes.
function integersOf(planes, count) {
  const values = new Int32Array(count);
  let value = 0;
  for (let i = 0, b = count, c = 2 * count, d = 3 * count; i < count; ++i, ++b, ++c, ++d) {
    const word = planes[i] | planes[b] << 8 | planes[c] << 16 | planes[d] << 24;
    value = value + (word >>> 1 ^ -(word & 1)) | 0;
    values[i] = value;
  }
  return values;
}

function numbersOf(planes, count, Numbers) {
  const size = Numbers.BYTES_PER_ELEMENT, bytes = new Uint8Array(count * size), view = new DataView(bytes.buffer);
  for (let k = 0; k < size; ++k)
    for (let i = 0, from = k * count, to = k; i < count; ++i, ++from, to += size) bytes[to] = planes[from];
  if (new Uint8Array(new Uint32Array([1]).buffer)[0] === 1) return new Numbers(bytes.buffer);
  const values = new Numbers(count);
  for (let i = 0; i < count; ++i)
    values[i] = size === 4 ? view.getFloat32(i * size, true) : view.getFloat64(i * size, true);
  return values;
}

// Arrays by name, unpacked on first use; their text is then removed from the page.
class PageArrays {
  constructor(facts) {
    this.described = new Map(facts.arrays.map(array => [array.name, array]));
    this.unpacked = new Map();
  }
  has(name) { return this.described.has(name); }
  get(name) {
    if (!this.unpacked.has(name)) this.unpacked.set(name, this.unpack(name));
    return this.unpacked.get(name);
  }
  async unpack(name) {
    const { form, count } = this.described.get(name);
    const broken = new Error(`This page is cut short or changed: "${name}" cannot be read. Write or copy it again.`);
    const element = document.getElementById("array-" + name);
    if (!element) throw broken;
    let planes;
    try {
      const text = element.textContent;
      element.remove();
      planes = text === "" ? new Uint8Array(0) : await inflated(bytesOfBase64(text));
    } catch {
      throw broken;
    }
    if (planes.length !== count * (form === "doubles" ? 8 : 4)) throw broken;
    if (form === "integers") return integersOf(planes, count);
    return numbersOf(planes, count, form === "doubles" ? Float64Array : Float32Array);
  }
}
