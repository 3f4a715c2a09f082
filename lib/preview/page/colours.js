// SPDX-License-Identifier: GPL-3.0-or-later
// What colours tell: a number for each junction, which a palette of 256 colours gives a colour.
'use strict';

const hiddenIndex = 255, plainIndex = 254, steps = 64;

/** Cross-section of a bead of that line width and height, mm² (model/flow.h). */
function areaOf(width, height, round) {
  if (width < height) return width * height;
  if (round) return Math.PI / 4 * width * width;
  return height * (width - height) + Math.PI / 4 * height * height;
}

const mm = grains => grains * page.grain;
const widthOf = (way, j) => mm(way.texels[4 * j + 3] & 65535);
const heightOf = (way, j) => mm(way.texels[4 * j + 3] >>> 16);
const kindOf = (way, j) => way.texels[4 * j + 2] >>> 20;

/** What can be coloured by: the value of a junction, its unit, and how many digits it is shown with. */
const measures = {
  feature: null,
  width: {unit: 'mm', digits: 2, of: print => j => widthOf(print.way, j)},
  height: {unit: 'mm', digits: 2, of: print => j => heightOf(print.way, j)},
  speed: {unit: 'mm/s', digits: 0, of: print => j => print.way.speed[j] / 10},
  flow: {
    unit: 'mm³/s', digits: 1, of: print => {
      const round = print.features.map(f => f.key === 'bridge'), way = print.way;
      return j => areaOf(widthOf(way, j), heightOf(way, j), round[way.feature[j] >> 1]) * way.speed[j] / 10;
    },
  },
  'layer time': {
    unit: 's', digits: 0, of: print => {
      const seconds = new Float32Array(print.way.length);
      print.way.layers.forEach((layer, i) => seconds.fill(print.layers[i][2], layer.first, layer.end));
      return j => seconds[j];
    },
  },
  support: {unit: '% of the width over plastic', digits: 0, of: print => j => 10 * print.way.support[j]},
  fan: {unit: '%', digits: 0, of: print => j => print.way.fan[j]},
  temperature: {unit: '°C', digits: 0, of: print => j => print.way.nozzle[j]},
  tool: null,
};

const rgb = css => [1, 3, 5].map(i => parseInt(css.slice(i, i + 2), 16));
const css = ([r, g, b]) => '#' + [r, g, b].map(v => Math.round(v).toString(16).padStart(2, '0')).join('');

/** Least and greatest of a measure over the beads of all prints, without custom G-code. */
function rangeOf(prints, measure) {
  let least = Infinity, most = -Infinity;
  for (const print of prints) {
    const value = measure.of(print), custom = print.features.map(f => f.key === 'custom'), way = print.way;
    for (let j = 0; j < way.length; ++j) {
      if (kindOf(way, j) !== kinds.bead || custom[way.feature[j] >> 1]) continue;
      const v = value(j);
      if (v < least) least = v;
      if (v > most) most = v;
    }
  }
  return least <= most ? [least, most] : [0, 0];
}

/** The index of each junction: what `key` says of it; hidden features have one of their own. */
function indicesOf(print, key, range, hidden) {
  const way = print.way, out = new Uint8Array(way.rows * rowLength), custom = print.features.map(f => f.key === 'custom');
  const gone = print.features.map(f => hidden.has(f.key)), measure = measures[key], value = measure && measure.of(print);
  const unit = measure && range[1] > range[0] ? (steps - 1) / (range[1] - range[0]) : 0;
  for (let j = 0; j < way.length; ++j) {
    const feature = way.feature[j] >> 1;
    if (gone[feature] && kindOf(way, j) === kinds.bead) out[j] = hiddenIndex;
    else if (key === 'feature') out[j] = feature;
    else if (key === 'tool') out[j] = way.tool[j] % page.tools.length;
    else if (custom[feature]) out[j] = plainIndex;
    else out[j] = Math.round(unit ? (value(j) - range[0]) * unit : (steps - 1) / 2);
  }
  return out;
}

/** 256 colours, four bytes each; transparent: not drawn. */
function paletteOf(print, key) {
  const out = new Uint8Array(4 * 256).fill(255), set = (i, colour) => out.set(rgb(colour), 4 * i);
  if (key === 'feature') print.features.forEach((f, i) => { if (i < plainIndex) set(i, f.colour); });
  else if (key === 'tool') page.tools.forEach((colour, i) => set(i, colour));
  else for (let i = 0; i < steps; ++i) set(i, page.ramp[Math.round(i * (page.ramp.length - 1) / (steps - 1))]);
  set(plainIndex, page.colours.custom);
  out[4 * hiddenIndex + 3] = 0;
  return out;
}
