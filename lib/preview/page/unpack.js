// SPDX-License-Identifier: GPL-3.0-or-later
// From the bytes that pack.cpp writes to arrays: one entry a junction, which is where a move ends. A junction whose kind
// is `jump` is where the way begins anew; all others end a move that begins at the junction before.
'use strict';

const kinds = {jump: 0, travel: 1, bead: 2};
const rowLength = 4096;  // texels in a row of a texture
const lowest = 65536;    // grains below z 0 that a texel can say
const columnNames = ['x', 'y', 'width', 'z', 'height', 'speed', 'feature', 'tool', 'fan', 'nozzle', 'support', 'line',
  'start', 'count', 'event'];

/** Bytes of a block of base64 that holds what zlib has packed. */
async function inflated(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Numbers of seven bits a byte, one after the other. */
class Column {
  constructor(bytes) { this.bytes = bytes; this.at = 0; this.left = 0; this.value = 0; }
  get done() { return this.at >= this.bytes.length; }
  number() {
    let v = 0, unit = 1, b;
    do { b = this.bytes[this.at++]; v += (b & 127) * unit; unit *= 128; } while (b > 127);
    return v;
  }
  step() { const v = this.number(); return v % 2 ? -(v + 1) / 2 : v / 2; }
  /** The next value of a column of runs. */
  next() {
    if (this.left === 0) { this.value += this.step(); this.left = this.number(); }
    --this.left;
    return this.value;
  }
}

function columnsOf(bytes) {
  const head = new Column(bytes), sizes = columnNames.map(() => head.number()), out = {};
  let at = head.at;
  columnNames.forEach((name, i) => { out[name] = new Column(bytes.subarray(at, at + sizes[i])); at += sizes[i]; });
  return out;
}

/** Arrays for `length` junctions, and the rows of texels that hold them. */
function emptyWay(length) {
  const rows = Math.max(1, Math.ceil(length / rowLength));
  return {
    length, rows, texels: new Uint32Array(4 * rows * rowLength), feature: new Uint8Array(length), speed: new Uint16Array(length),
    tool: new Uint8Array(length), fan: new Uint8Array(length), support: new Uint8Array(length), nozzle: new Int16Array(length),
    line: new Uint32Array(length), ends: new Float32Array(length), layers: [], events: [],
  };
}

/** Where the way begins anew: before which move, and by how much off the place before. */
function startsOf(column) {
  const out = [];
  let move = 0;
  while (!column.done) { move += column.number(); out.push({move, dx: column.step(), dy: column.step()}); }
  return out;
}

/**
 * Texels hold x, y as integers, then z above `lowest` and the kind behind it, then width and height; all in grains.
 * @param seconds of each layer: the moves of a layer share them by length and speed
 */
function unpack(bytes, seconds) {
  const c = columnsOf(bytes), counts = [];
  while (!c.count.done) counts.push(c.count.number());
  const starts = startsOf(c.start), moves = counts.reduce((a, b) => a + b, 0), way = emptyWay(moves + starts.length);
  const texels = way.texels, junctionOf = starts.length > 1 ? new Uint32Array(moves + 1) : null;
  let j = 0, move = 0, x = 0, y = 0, z = 0, width = 0, begun = 0, time = 0;
  const put = (kind, w, h) => {
    const t = 4 * j;
    texels[t] = x; texels[t + 1] = y; texels[t + 2] = Math.max(0, Math.min(1048575, z + lowest)) | kind << 20;
    texels[t + 3] = Math.min(w, 65535) | Math.min(h, 65535) << 16;
    ++j;
  };
  counts.forEach((count, index) => {
    const first = j, from = time;
    for (const end = move + count; move < end; ++move) {
      if (begun < starts.length && starts[begun].move === move) {
        x += starts[begun].dx; y += starts[begun].dy; ++begun;
        way.ends[j] = time; way.line[j] = j > 0 ? way.line[j - 1] : 0;
        put(kinds.jump, 0, 0);
      }
      const dx = c.x.step(), dy = c.y.step(), before = z, w = c.width.number();
      x += dx; y += dy; z = c.z.next();
      if (w > 0) width += w % 2 ? (w - 1) / 2 : -w / 2;
      way.speed[j] = c.speed.next(); way.feature[j] = c.feature.next(); way.tool[j] = c.tool.next(); way.fan[j] = c.fan.next();
      way.nozzle[j] = c.nozzle.next(); way.support[j] = c.support.next(); way.line[j] = c.line.next() + (j > 0 ? way.line[j - 1] : 0);
      const length = Math.hypot(dx, dy, z - before);
      if (way.speed[j] > 0) time += length / way.speed[j];
      way.ends[j] = time;
      if (junctionOf) junctionOf[move] = j;
      put(w > 0 ? kinds.bead : kinds.travel, w > 0 ? width : 0, w > 0 ? c.height.next() : 0);
    }
    const share = time > from ? seconds[index] / (time - from) : 0, begin = way.layers.length ? way.layers[index - 1].ends : 0;
    for (let i = first; i < j; ++i) way.ends[i] = begin + (way.ends[i] - from) * share;
    way.layers.push({first, end: j, ends: begin + seconds[index]});
  });
  if (junctionOf) junctionOf[moves] = j;
  way.junctionOf = m => junctionOf ? junctionOf[m] : m + starts.length;
  let at = 0;
  while (!c.event.done) { const kind = c.event.number(); at += c.event.step(); way.events.push({kind, junction: Math.max(0, way.junctionOf(Math.min(at, moves)) - 1)}); }
  return way;
}

/** Corners and triangles of the model, as model_pack.cpp writes them, in mm. */
function unpackModel(bytes, grain) {
  const column = new Column(bytes), corners = new Float32Array(3 * column.number()), triangles = new Uint32Array(3 * column.number());
  const at = [0, 0, 0];
  for (let i = 0; i < corners.length; ++i) { at[i % 3] += column.step(); corners[i] = at[i % 3] * grain; }
  let last = 0;
  for (let i = 0; i < triangles.length; ++i) { last += column.step(); triangles[i] = last; }
  return {corners, triangles};
}
