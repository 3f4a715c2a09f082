// SPDX-License-Identifier: GPL-3.0-or-later
// One layer from above, on a canvas of two dimensions: for where there is no WebGL2, and for who wants it.
'use strict';

class Flat {
  constructor(canvas, prints, origin) {
    this.ctx = canvas.getContext('2d');
    if (!this.ctx) throw new Error('no canvas');
    this.canvas = canvas; this.origin = origin;
    this.prints = prints.map(print => ({print, way: print.way, indices: null, colours: []}));
  }
  paint(index, indices, palette) {
    const p = this.prints[index];
    p.indices = indices;
    p.colours = Array.from({length: 256}, (_, i) => palette[4 * i + 3] ? css(palette.slice(4 * i, 4 * i + 3)) : null);
  }
  begin(background) {
    this.ctx.setTransform(1, 0, 0, 1, 0, 0);
    this.ctx.fillStyle = css(background.map(v => 255 * v)); this.ctx.fillRect(0, 0, this.canvas.width, this.canvas.height);
    this.ctx.lineCap = this.ctx.lineJoin = 'round';
  }
  /** @param area in pixels, y from below @param scale pixels a millimetre */
  look(area, camera, scale) {
    const [x, y, w, h] = area, ctx = this.ctx;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.beginPath(); ctx.rect(x, this.canvas.height - y - h, w, h);
    ctx.setTransform(scale, 0, 0, -scale, x + w / 2 - camera.target[0] * scale, this.canvas.height - y - h / 2 + camera.target[1] * scale);
    this.scale = scale;
  }
  x(way, j) { return ((way.texels[4 * j] | 0) - this.origin[0]) * page.grain; }
  y(way, j) { return ((way.texels[4 * j + 1] | 0) - this.origin[1]) * page.grain; }

  /** Calls draw(from, to) for junctions in a row that look alike. */
  chains(way, first, end, same, draw) {
    for (let j = Math.max(1, first); j < end;) {
      let k = j + 1;
      while (k < end && same(j, k)) ++k;
      draw(j, k);
      j = k;
    }
  }
  trace(way, from, to) {
    const ctx = this.ctx;
    ctx.beginPath(); ctx.moveTo(this.x(way, from - 1), this.y(way, from - 1));
    for (let j = from; j < to; ++j) ctx.lineTo(this.x(way, j), this.y(way, j));
    ctx.stroke();
  }
  beads(index, first, end, alpha) {
    const {way, indices, colours} = this.prints[index], ctx = this.ctx;
    const same = (a, b) => kindOf(way, a) === kindOf(way, b) && indices[a] === indices[b] && way.texels[4 * a + 3] === way.texels[4 * b + 3];
    ctx.globalAlpha = alpha;
    for (const edge of [true, false])
      this.chains(way, first, end, same, (from, to) => {
        const colour = colours[indices[from]], width = widthOf(way, from);
        if (kindOf(way, from) !== kinds.bead || !colour) return;
        ctx.strokeStyle = edge ? css(rgb(colour).map(v => v * 0.55)) : colour;
        ctx.lineWidth = edge ? width : Math.max(width - 0.06, width / 2);
        this.trace(way, from, to);
      });
    ctx.globalAlpha = 1;
  }
  travels(index, first, end, colour) {
    const {way} = this.prints[index];
    this.ctx.strokeStyle = colour; this.ctx.lineWidth = 1 / this.scale;
    this.chains(way, first, end, (a, b) => kindOf(way, a) === kindOf(way, b), (from, to) => { if (kindOf(way, from) === kinds.travel) this.trace(way, from, to); });
  }
  /** Places in mm off the origin, three numbers each, as dots of so many pixels. */
  dots(places, colour, pixels) {
    const ctx = this.ctx;
    ctx.fillStyle = colour;
    for (let i = 0; i < places.length; i += 3) { ctx.beginPath(); ctx.arc(places[i], places[i + 1], pixels / 2 / this.scale, 0, 7); ctx.fill(); }
  }
  ring(points, colour, fill) {
    if (!points.length) return;
    const ctx = this.ctx;
    ctx.beginPath();
    for (const [x, y] of points) ctx.lineTo(x - this.origin[0] * page.grain, y - this.origin[1] * page.grain);
    ctx.closePath(); ctx.strokeStyle = colour; ctx.lineWidth = 1.5 / this.scale; ctx.stroke();
    ctx.fillStyle = colour + fill; ctx.fill();
  }
}
