// SPDX-License-Identifier: GPL-3.0-or-later
// Where the eye is: parallel rays, two angles, a place that is looked at, and pixels a millimetre. And how pointers and
// keys move it.
'use strict';

const looks = {iso: [30, 30], top: [0, 90], front: [0, 0], right: [90, 0], back: [180, 0], left: [-90, 0]};
const radians = degrees => degrees * Math.PI / 180;

class Camera {
  constructor() { this.yaw = 30; this.pitch = 30; this.target = [0, 0, 0]; this.zoom = 1; this.depth = 100; }

  /** Unit vectors: to the right, up, towards the eye. */
  frame() {
    const [y, p] = [radians(this.yaw), radians(this.pitch)];
    return {
      right: [Math.cos(y), Math.sin(y), 0],
      up: [-Math.sin(p) * Math.sin(y), Math.sin(p) * Math.cos(y), Math.cos(p)],
      eye: [Math.cos(p) * Math.sin(y), -Math.cos(p) * Math.cos(y), Math.sin(p)],
    };
  }
  /** As shaders want it, for a part of the canvas of that size in CSS pixels. */
  forShaders(width, height) {
    const {right, up, eye} = this.frame(), axes = [];
    for (let i = 0; i < 3; ++i) axes.push(right[i], up[i], eye[i]);
    const light = [0, 1, 2].map(i => -0.35 * right[i] + 0.65 * up[i] + 0.68 * eye[i]);
    return {eye, light, axes, target: this.target, scale: [2 * this.zoom / width, 2 * this.zoom / height, 1 / this.depth]};
  }
  /** Shows all of a box, [x, y, z] of both corners. */
  fit(box, width, height) {
    const {right, up} = this.frame();
    this.target = [0, 1, 2].map(i => (box[0][i] + box[1][i]) / 2);
    const half = axis => [0, 1, 2].reduce((sum, i) => sum + Math.abs(axis[i]) * (box[1][i] - box[0][i]) / 2, 0);
    this.depth = Math.max(10, 1.1 * Math.hypot(...[0, 1, 2].map(i => box[1][i] - box[0][i])) + Math.hypot(...this.target));
    this.zoom = 0.9 * Math.min(width / (2 * half(right) + 1), height / (2 * half(up) + 1));
  }
  turn(dx, dy) { this.yaw -= dx; this.pitch = Math.max(-90, Math.min(90, this.pitch + dy)); }
  pan(dx, dy) {
    const {right, up} = this.frame();
    this.target = this.target.map((v, i) => v - (right[i] * dx - up[i] * dy) / this.zoom);
  }
  /** @param x, y off the middle of the picture, CSS pixels: what lies there stays there */
  magnify(factor, x = 0, y = 0) { this.pan(x * (1 / factor - 1) * factor, y * (1 / factor - 1) * factor); this.zoom *= factor; }
}

/** Pointers and wheel on a canvas; `changed(still)` after each step, still when all are let go. */
function followPointers(canvas, camera, middleOf, changed) {
  const held = new Map();
  let resting = 0;
  const off = event => { const [x, y] = middleOf(event); return [event.offsetX - x, event.offsetY - y]; };
  const soon = () => { clearTimeout(resting); resting = setTimeout(() => changed(true), 180); };
  canvas.addEventListener('pointerdown', event => { canvas.setPointerCapture(event.pointerId); held.set(event.pointerId, event); });
  canvas.addEventListener('pointermove', event => {
    const before = held.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before.clientX, dy = event.clientY - before.clientY;
    held.set(event.pointerId, event);
    if (held.size === 2) {
      const [a, b] = [...held.values()], other = event.pointerId === a.pointerId ? b : a;
      const gap = (p, q) => Math.hypot(p.clientX - q.clientX, p.clientY - q.clientY);
      camera.pan(dx / 2, dy / 2);
      camera.magnify(Math.max(0.5, Math.min(2, gap(event, other) / Math.max(1, gap(before, other)))), ...off(event));
    } else if (event.shiftKey || event.ctrlKey || before.button === 1 || before.button === 2 || (event.buttons & 6)) camera.pan(dx, dy);
    else camera.turn(dx * 0.4, dy * 0.4);
    changed(false);
  });
  for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, event => { held.delete(event.pointerId); if (!held.size) changed(true); });
  canvas.addEventListener('wheel', event => { event.preventDefault(); camera.magnify(Math.exp(-event.deltaY / 500), ...off(event)); changed(false); soon(); }, {passive: false});
  canvas.addEventListener('contextmenu', event => event.preventDefault());
}

/** Steps of the camera by key, on the canvas. */
const cameraKeys = {
  ArrowLeft: (c, shift) => shift ? c.pan(40, 0) : c.turn(10, 0), ArrowRight: (c, shift) => shift ? c.pan(-40, 0) : c.turn(-10, 0),
  ArrowUp: (c, shift) => shift ? c.pan(0, 40) : c.turn(0, 10), ArrowDown: (c, shift) => shift ? c.pan(0, -40) : c.turn(0, -10),
  '+': c => c.magnify(1.25), '=': c => c.magnify(1.25), '-': c => c.magnify(0.8),
};
