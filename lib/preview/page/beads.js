// SPDX-License-Identifier: GPL-3.0-or-later
// Draws beads in WebGL2. A bead is what a spheroid as wide and as high as the bead sweeps along its move: scaled along z
// it is a capsule, and a rectangle that faces the eye covers it. Vertices are pulled from a texture of junctions by
// gl_VertexID, so that a range of moves is a range of drawArrays, and nothing is uploaded when it changes. Where the
// picture stands still each pixel finds where its ray meets the capsule: shape, crossings and cuts are true.
'use strict';

const beadVertex = `#version 300 es
precision highp float; precision highp int; precision highp usampler2D;
uniform usampler2D junctions, indices; uniform sampler2D palette;
uniform ivec3 origin; uniform float grain, onlyTravels; uniform vec3 eye, target; uniform mat3 camera; uniform vec3 scale; uniform vec4 tint;
out vec2 at; out vec3 base; flat out vec4 shape; flat out vec3 along, across, first, colour;
flat out float stretch;
const ivec2 row = ivec2(4095, 12);
uvec4 junction(int i) { return texelFetch(junctions, ivec2(i & row.x, i >> row.y), 0); }
vec3 place(uvec4 t) { return vec3(ivec3(int(t.x), int(t.y), int(t.z & 1048575u) - 65536) - origin) * grain; }
void main() {
  int i = gl_VertexID / 6, corner = gl_VertexID % 6;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  uvec4 b = junction(i);
  if (i == 0 || b.z >> 20 != 2u) return;
  uint index = texelFetch(indices, ivec2(i & row.x, i >> row.y), 0).r;
  vec4 paint = texelFetch(palette, ivec2(int(index), 0), 0);
  if (paint.a == 0.0) return;
  colour = mix(paint.rgb, tint.rgb, tint.a);
  float width = float(b.w & 65535u) * grain, height = max(float(b.w >> 16) * grain, grain);
  stretch = width / height;
  float r = width * 0.5;
  vec3 from = place(junction(i - 1)), to = place(b);
  from.z -= height * 0.5; to.z -= height * 0.5;
  vec3 up = vec3(1.0, 1.0, stretch), d = normalize(eye * up), axis = (to - from) * up;
  float depth = dot(axis, d), reach;
  vec3 p = axis - d * depth;
  reach = length(p);
  along = reach > 1e-5 ? p / reach : normalize(cross(d, vec3(0.31, 0.95, 0.05)));
  across = cross(d, along);
  first = from;
  shape = vec4(reach, depth, r, 0.0);
  float u = (corner == 1 || corner == 2 || corner == 4) ? r : -r, v = (corner == 2 || corner == 4 || corner == 5) ? reach + r : -r;
  at = vec2(v, u);
  base = from + (along * v + across * u) / up;
  vec3 middle = base + eye * (reach > 1e-5 ? depth * clamp(v / reach, 0.0, 1.0) : max(depth, 0.0)) / length(eye * up);
  vec3 seen = camera * (middle - target) * scale;
  gl_Position = vec4(seen.xy, -seen.z, 1.0);
}`;

const beadFragment = (round, cut) => `#version 300 es
precision highp float;
uniform vec3 eye, target, light, plane, scale; uniform float offset, dots;
in vec2 at; in vec3 base; flat in vec4 shape; flat in vec3 along, across, first, colour; flat in float stretch;
out vec4 pixel;
// Where a bead is but a few pixels wide, its sides are less dark: else they would make patterns of their own.
vec3 shade(vec3 n) {
  float l = max(dot(n, light), 0.0), rim = max(dot(n, eye), 0.0), fine = smoothstep(4.0, 1.0, shape.z * dots);
  return colour * mix(0.30 + 0.25 * rim + 0.55 * l, 0.55 + 0.35 * l, fine);
}
void main() {
  float reach = shape.x, depth = shape.y, r = shape.z, v = at.x, u = at.y;
  vec2 q = vec2(v - clamp(v, 0.0, reach), u);
  if (dot(q, q) > r * r) discard;
  vec3 up = vec3(1.0, 1.0, stretch), d = cross(along, across), n;
  float far = length(eye * up), whole = sqrt(reach * reach + depth * depth), c = sqrt(max(r * r - u * u, 0.0)), toEye;
  float t = reach > 1e-4 ? (v + c * depth / max(whole, 1e-6)) * whole / reach : (depth > 0.0 ? whole + 1.0 : -1.0);
  if (t >= 0.0 && t <= whole) {
    toEye = (t * depth + c * reach) / max(whole, 1e-6);
    n = across * u + (d * reach - along * depth) / max(whole, 1e-6) * c;
  } else {
    vec2 e = t < 0.0 ? vec2(v, u) : vec2(v - reach, u);
    if (dot(e, e) > r * r) e *= r / length(e);
    float h = sqrt(max(r * r - dot(e, e), 0.0));
    toEye = (t < 0.0 ? 0.0 : depth) + h;
    n = along * e.x + across * e.y + d * h;
  }
  float distance = toEye / far;
  vec3 lit = shade(normalize(n * up));
${cut ? `
  if (dot(plane, base + eye * distance) > offset) {
    float facing = dot(plane, eye);
    if (facing < 1e-4) discard;
    float behind = (offset - dot(plane, base)) / facing;
    vec3 inside = (base + eye * behind - first) * up, axis = along * reach + d * depth;
    float s = clamp(dot(inside, axis) / max(dot(axis, axis), 1e-9), 0.0, 1.0);
    vec3 off = inside - axis * s;
    if (behind > distance || dot(off, off) > r * r) discard;
    distance = behind;
    lit = colour * (dot(off, off) > 0.72 * r * r ? 0.55 : 1.0);
  }` : ''}
${round ? `
  float seen = dot(eye, base + eye * distance - target) * scale.z;
  gl_FragDepth = clamp(0.5 - 0.5 * seen, 0.0, 1.0);` : ''}
  pixel = vec4(lit, 1.0);
}`;

const lineVertex = `#version 300 es
precision highp float;
uniform vec3 target; uniform mat3 camera; uniform vec3 scale; uniform float size, nearer;
in vec3 place;
void main() { vec3 seen = camera * (place - target) * scale; gl_Position = vec4(seen.xy, -seen.z - nearer, 1.0); gl_PointSize = size; }`;

const lineFragment = `#version 300 es
precision highp float;
uniform vec4 paint; uniform float dots; out vec4 pixel;
void main() { if (dots > 0.5 && length(gl_PointCoord - 0.5) > 0.5) discard; pixel = paint; }`;

const travelVertex = `#version 300 es
precision highp float; precision highp int; precision highp usampler2D;
uniform usampler2D junctions; uniform ivec3 origin; uniform float grain; uniform vec3 target; uniform mat3 camera; uniform vec3 scale;
uvec4 junction(int i) { return texelFetch(junctions, ivec2(i & 4095, i >> 12), 0); }
void main() {
  int i = gl_VertexID / 2;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if (i == 0 || junction(i).z >> 20 != 1u) return;
  uvec4 t = junction(i - 1 + gl_VertexID % 2);
  vec3 place = vec3(ivec3(int(t.x), int(t.y), int(t.z & 1048575u) - 65536) - origin) * grain, seen = camera * (place - target) * scale;
  gl_Position = vec4(seen.xy, -seen.z, 1.0);
}`;

/** A program of the card with its uniforms by name. */
class Program {
  constructor(gl, vertex, fragment) {
    this.gl = gl;
    this.handle = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text); gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(this.handle, shader);
    }
    gl.bindAttribLocation(this.handle, 0, 'place');
    gl.linkProgram(this.handle);
    if (!gl.getProgramParameter(this.handle, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(this.handle));
    this.places = {};
  }
  use() { this.gl.useProgram(this.handle); return this; }
  at(name) { return name in this.places ? this.places[name] : this.places[name] = this.gl.getUniformLocation(this.handle, name); }
  set(values) {
    const gl = this.gl;
    for (const [name, v] of Object.entries(values)) {
      const at = this.at(name);
      if (typeof v === 'number') gl.uniform1f(at, v);
      else if (v instanceof Int32Array) gl.uniform3iv(at, v);
      else if (v.length === 9) gl.uniformMatrix3fv(at, false, v);
      else gl[`uniform${v.length}fv`](at, v);
    }
    return this;
  }
  texture(name, unit) { this.gl.uniform1i(this.at(name), unit); return this; }
}

/** All prints of the page on one canvas. @throws Error where there is no WebGL2 */
class Beads {
  constructor(canvas, prints, origin) {
    const gl = this.gl = canvas.getContext('webgl2', {antialias: false, alpha: false, powerPreference: 'high-performance'});
    if (!gl) throw new Error('no WebGL2');
    this.canvas = canvas; this.origin = origin; this.programs = {}; this.buffers = {};
    this.lines = new Program(gl, lineVertex, lineFragment);
    this.prints = prints.map(print => ({print, way: print.way, junctions: this.upload(print.way), indices: gl.createTexture(), palette: gl.createTexture(), coarse: null}));
    gl.enable(gl.DEPTH_TEST); gl.depthFunc(gl.LEQUAL); gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  }

  upload(way) {
    const gl = this.gl, texture = gl.createTexture();
    this.bind(0, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32UI, rowLength, way.rows, 0, gl.RGBA_INTEGER, gl.UNSIGNED_INT, way.texels);
    return texture;
  }
  bind(unit, texture) {
    const gl = this.gl;
    gl.activeTexture(gl.TEXTURE0 + unit); gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.NEAREST);
  }

  paint(index, indices, palette) {
    const gl = this.gl, p = this.prints[index];
    p.coarse = null;
    this.bind(0, p.indices);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8UI, rowLength, p.way.rows, 0, gl.RED_INTEGER, gl.UNSIGNED_BYTE, indices);
    this.bind(0, p.palette);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, palette);
  }

  program(round, cut) {
    const name = `${round} ${cut}`;
    return this.programs[name] ||= new Program(this.gl, beadVertex, beadFragment(round, cut));
  }
  /** Corners of the beads that are seen from outside, for while the camera moves over very long files. */
  coarse(p) {
    if (p.coarse) return p.coarse;
    const seen = p.print.features.map(f => ['outer_wall', 'top_skin', 'bridge', 'overhang_wall', 'overhang_skin', 'support'].includes(f.key)), way = p.way, list = [];
    for (let j = 1; j < way.length; ++j) if (kindOf(way, j) === kinds.bead && seen[way.feature[j] >> 1]) list.push(j);
    const corners = new Uint32Array(6 * list.length), gl = this.gl, buffer = gl.createBuffer();
    list.forEach((j, i) => { for (let k = 0; k < 6; ++k) corners[6 * i + k] = 6 * j + k; });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer); gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, corners, gl.STATIC_DRAW);
    return p.coarse = {buffer, list};
  }

  begin(background) {
    const gl = this.gl;
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(...background, 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }
  /** What follows is drawn in that part of the canvas, in pixels from below, as the camera sees it. */
  look(area, camera) {
    const gl = this.gl;
    gl.viewport(...area); gl.enable(gl.SCISSOR_TEST); gl.scissor(...area);
    this.camera = camera;
    this.common = {target: camera.target, camera: camera.axes, scale: camera.scale};
  }

  /** Moves whose junctions are in [first, end). @param style {round, coarse, tint, plane, offset, depth} */
  beads(index, first, end, style) {
    const gl = this.gl, p = this.prints[index], program = this.program(style.round, !!style.plane).use();
    program.set({...this.common, eye: this.camera.eye, light: this.camera.light, origin: this.origin, grain: page.grain, dots: this.camera.dots, tint: style.tint || [0, 0, 0, 0]});
    if (style.plane) program.set({plane: style.plane, offset: style.offset});
    this.bind(0, p.junctions); this.bind(1, p.indices); this.bind(2, p.palette);
    program.texture('junctions', 0).texture('indices', 1).texture('palette', 2);
    gl.depthFunc(style.depth || gl.LEQUAL);
    if (style.coarse) this.drawCoarse(p, first, end);
    else if (end > first) gl.drawArrays(gl.TRIANGLES, 6 * first, 6 * (end - first));
    gl.depthFunc(gl.LEQUAL);
  }
  drawCoarse(p, first, end) {
    const gl = this.gl;
    const {buffer, list} = this.coarse(p), from = lowerBound(list, first), to = lowerBound(list, end);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
    if (to > from) gl.drawElements(gl.TRIANGLES, 6 * (to - from), gl.UNSIGNED_INT, 24 * from);
  }
  travels(index, first, end, paint) {
    const gl = this.gl, program = (this.travelling ||= new Program(gl, travelVertex, lineFragment)).use();
    program.set({...this.common, origin: this.origin, grain: page.grain, paint, dots: 0});
    this.bind(0, this.prints[index].junctions);
    program.texture('junctions', 0);
    if (end > first) gl.drawArrays(gl.LINES, 2 * first, 2 * (end - first));
  }

  /** Points, lines or triangles of one colour: places in mm off the origin. @param name of the buffer, whose places stay until others are given */
  plain(name, mode, places, paint, {size = 1, nearer = 0, over = false, through = false} = {}) {
    const gl = this.gl;
    let b = this.buffers[name];
    if (!b) b = this.buffers[name] = {handle: gl.createBuffer(), places: null};
    gl.bindBuffer(gl.ARRAY_BUFFER, b.handle);
    if (b.places !== places) { gl.bufferData(gl.ARRAY_BUFFER, places, gl.STATIC_DRAW); b.places = places; }
    this.lines.use().set({...this.common, paint, size, nearer, dots: mode === gl.POINTS ? 1 : 0});
    gl.enableVertexAttribArray(0); gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    if (over) gl.disable(gl.DEPTH_TEST);
    if (through) { gl.enable(gl.BLEND); gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA); gl.depthMask(false); }
    gl.drawArrays(mode, 0, places.length / 3);
    gl.enable(gl.DEPTH_TEST); gl.disable(gl.BLEND); gl.depthMask(true);
    gl.disableVertexAttribArray(0);
  }
}

/** The first place in an ascending list whose value is not below v. */
function lowerBound(list, v) {
  let from = 0, to = list.length;
  while (from < to) { const middle = from + to >> 1; if (list[middle] < v) from = middle + 1; else to = middle; }
  return from;
}
