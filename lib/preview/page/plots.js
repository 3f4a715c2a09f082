// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of prints as small pictures, each with a table's worth of words for who does not see it.
'use strict';

const svgSpace = 'http://www.w3.org/2000/svg';
function make(name, attributes = {}, text) {
  const e = document.createElement(name);
  for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
  if (text !== undefined) e.textContent = text;
  return e;
}
function draw(name, attributes, text) {
  const e = document.createElementNS(svgSpace, name);
  for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
  if (text !== undefined) e.textContent = text;
  return e;
}
const clock = s => s >= 3600 ? `${Math.floor(s / 3600)} h ${String(Math.floor(s / 60) % 60).padStart(2, '0')} min`
  : s >= 60 ? `${Math.floor(s / 60)} min ${String(Math.floor(s) % 60).padStart(2, '0')} s` : `${s.toFixed(1)} s`;

function frame(title, spoken) {
  const figure = make('figure'), svg = draw('svg', {viewBox: '0 0 280 110', role: 'img', 'aria-label': `${title}: ${spoken}`});
  figure.append(make('figcaption', {}, title), svg);
  return {figure, svg};
}
function axes(svg, least, most, unit, high, highUnit) {
  svg.append(draw('line', {x1: 4, x2: 276, y1: 92, y2: 92, class: 'axis'}), draw('text', {x: 4, y: 104}, `${least}`),
    draw('text', {x: 276, y: 104, 'text-anchor': 'end'}, `${most} ${unit}`), draw('text', {x: 4, y: 10}, `${high} ${highUnit}`));
}

/** Bars of one or two histograms with the same step. */
function histogram(title, unit, amountUnit, list) {
  const count = Math.max(1, ...list.map(h => h.amount.length)), high = Math.max(1e-9, ...list.flatMap(h => h.amount)), step = list[0].step;
  const total = list[0].amount.reduce((a, b) => a + b, 0), most = list[0].amount.indexOf(Math.max(...list[0].amount));
  const {figure, svg} = frame(title, total > 0 ? `most at ${(most * step).toFixed(2)} to ${((most + 1) * step).toFixed(2)} ${unit}` : 'none');
  list.forEach((h, k) => h.amount.forEach((v, i) => {
    const w = 272 / count, width = Math.max(0.7, w * (k ? 0.45 : 0.9));
    svg.append(draw('rect', {x: 4 + i * w + (k ? w * 0.225 : 0), y: 92 - 78 * v / high, width, height: 78 * v / high, class: k ? 'other' : 'bar'}));
  }));
  axes(svg, 0, (count * step).toFixed(step < 1 ? 1 : 0), unit, high >= 100 ? high.toFixed(0) : high.toFixed(1), amountUnit);
  return figure;
}

/** One or two rows of numbers over height, each [z, v]. */
function curves(title, unit, rows) {
  const all = rows.flat(), top = Math.max(1e-9, ...rows.map(row => row.reduce((m, p) => Math.max(m, p[0]), 0))), high = all.reduce((m, p) => Math.max(m, p[1]), 1e-9);
  const {figure, svg} = frame(title, `at most ${high.toFixed(1)} ${unit}`);
  rows.forEach((row, k) => svg.append(draw('polyline', {class: k ? 'curve other' : 'curve', points: row.map(([z, v]) => `${(4 + 272 * z / top).toFixed(1)},${(92 - 78 * v / high).toFixed(1)}`).join(' ')})));
  axes(svg, 0, top.toFixed(1), 'mm', high.toFixed(1), unit);
  return figure;
}

function table(caption, heads, rows) {
  const t = make('table'), line = (cells, kind) => { const r = make('tr'); r.append(...cells.map(c => make(kind, {}, c))); return r; };
  t.append(make('caption', {}, caption), line(heads, 'th'), ...rows.map(cells => line(cells, 'td')));
  return t;
}

/** Figures of all prints; those of two stand in one another. */
function showPlots(box, prints) {
  const share = (v, all) => all > 0 ? `${(100 * v / all).toFixed(1)} %` : '';
  for (const p of prints) {
    const f = p.figures, rows = p.features.filter(x => x.mm > 0).map(x => [x.name, clock(x.seconds), share(x.seconds, f.seconds), (x.mm3 / 1000).toFixed(2)]);
    rows.push(['travel', clock(f.travelSeconds), share(f.travelSeconds, f.seconds), '']);
    box.append(table(prints.length > 1 ? p.name : 'Time and filament by feature', ['', 'time', '', 'cm³'], rows));
    box.append(table('In all', ['', ''], [['time', clock(f.seconds)], ['filament', `${(f.filamentMm / 1000).toFixed(2)} m, ${(f.mm3 / 1000).toFixed(2)} cm³`], ['moves', f.moves], ['travels', `${f.travels}, ${(f.travelMm / 1000).toFixed(1)} m`],
      ['retractions', f.retractions], ['tool changes', f.toolChanges], ['pauses', f.pauses]]));
  }
  box.append(curves('Time of each layer', 's', prints.map(p => p.layers.map(l => [l[0], l[2]]))), curves('Plastic of each layer', 'mm³', prints.map(p => p.layers.map(l => [l[0], l[3]]))));
  for (const [name, title, unit, amount] of [['flow', 'Time by flow', 'mm³/s', 's'], ['speed', 'Length by speed', 'mm/s', 'mm'], ['width', 'Length by width', 'mm', 'mm']])
    box.append(histogram(title, unit, amount, prints.map(p => p.histograms[name])));
}
