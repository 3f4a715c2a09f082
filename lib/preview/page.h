// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

/// The page that html.cpp fills with data: its frame and its script. No network, no libraries.
namespace weft::preview {

inline constexpr std::string_view page_head = R"page(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1">
<title>weft preview</title>
<style>
html,body{margin:0;height:100%;font:14px system-ui,sans-serif;color:#222;background:#fff}
body{display:grid;grid-template-rows:1fr auto;overflow:hidden}
#stage{position:relative;min-height:0}canvas{position:absolute;inset:0;width:100%;height:100%;cursor:grab;touch-action:none}
#legend{position:absolute;left:12px;top:12px;background:#fffd;border:1px solid #ccd;border-radius:6px;padding:8px 12px;line-height:1.6}
#legend b{display:block;margin-bottom:4px}#legend i{display:inline-block;width:20px;height:12px;margin-right:8px;border:1px solid #777;vertical-align:-1px}
#bar{display:grid;grid-template-columns:auto 1fr auto;gap:6px 12px;align-items:center;padding:10px 14px;background:#f4f5f8;border-top:1px solid #ccd}
#bar input[type=range]{width:100%}#options{grid-column:1/4;display:flex;gap:20px;flex-wrap:wrap}
output{min-width:17em;font-variant-numeric:tabular-nums}
</style></head><body>
<div id="stage"><canvas></canvas><div id="legend"></div></div>
<div id="bar">
<label for="layer">Layer</label><input id="layer" type="range" min="0" value="0"><output id="where"></output>
<label for="shown">Moves</label><input id="shown" type="range" min="0" value="0"><output id="move"></output>
<div id="options"><label>Colour <select id="colour"><option>feature<option>width<option>speed<option>flow</select></label>
<label><input id="travels" type="checkbox"> travels</label><label><input id="below" type="checkbox"> layer below</label>
<span>wheel: zoom, drag: move, double click: all, arrow keys: layers</span></div></div>
<script>
)page";

inline constexpr std::string_view page_script = R"page(
'use strict';
const $ = id => document.getElementById(id), canvas = document.querySelector('canvas'), ctx = canvas.getContext('2d');
const units = {width: 'mm', speed: 'mm/s', flow: 'mm³/s'};

// The numbers behind `data`: per layer z, height, runs; a run has kind, width, speed, flow, steps, and its points as steps.
const layers = (() => {
  const text = atob(page.data), out = [];
  let i = 0, x = 0, y = 0;
  const number = () => { let v = 0, unit = 1, b; do { b = text.charCodeAt(i++); v += (b & 127) * unit; unit *= 128; } while (b > 127); return v; };
  const step = () => { const v = number(); return v % 2 ? -(v + 1) / 2 : v / 2; };
  for (let n = 0; n < page.layers; ++n) {
    const layer = {z: number() / 1000, height: number() / 1000, runs: []};
    for (let runs = number(); runs > 0; --runs) {
      const kind = number(), run = {feature: kind >> 2, compensated: kind & 2, outside: kind & 1};
      run.width = number() * page.grain; run.speed = number(); run.flow = number() / 100;
      const points = new Float32Array(2 * number() + 2);
      for (let p = 0; p < points.length; p += 2) { x += step(); y += step(); points[p] = x * page.grain; points[p + 1] = y * page.grain; }
      run.points = points;
      layer.runs.push(run);
    }
    out.push(layer);
  }
  return out;
})();
const custom = run => page.features[run.feature][0] === 'custom';

const ranges = {};
for (const key of Object.keys(units)) {
  let least = Infinity, most = -Infinity;
  for (const layer of layers) for (const run of layer.runs) if (run.width > 0 && !custom(run)) { least = Math.min(least, run[key]); most = Math.max(most, run[key]); }
  ranges[key] = least <= most ? [least, most] : [0, 0];
}
const colourOf = run => {
  const key = $('colour').value;
  if (key === 'feature' || custom(run)) return page.features[run.feature][1];
  const [least, most] = ranges[key];
  return page.ramp[Math.round(32 * (most > least ? (run[key] - least) / (most - least) : 0.5))];
};
const dark = colour => '#' + [1, 3, 5].map(i => Math.round(parseInt(colour.slice(i, i + 2), 16) * 0.55).toString(16).padStart(2, '0')).join('');

// View: pixel = (mm - centre) * scale + half the canvas, y up.
const view = {x: 0, y: 0, scale: 1};
function fit() {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const add = (x, y) => { box[0] = Math.min(box[0], x); box[1] = Math.min(box[1], y); box[2] = Math.max(box[2], x); box[3] = Math.max(box[3], y); };
  for (const layer of layers) for (const run of layer.runs) if (run.outside || run.width > 0 && !custom(run)) for (let p = 0; p < run.points.length; p += 2) add(run.points[p], run.points[p + 1]);
  if (page.overlay) for (const ring of [page.overlay.bed, page.overlay.reach]) for (const [x, y] of ring) add(x, y);
  if (!(box[0] <= box[2])) add(0, 0);
  view.x = (box[0] + box[2]) / 2; view.y = (box[1] + box[3]) / 2;
  view.scale = 0.92 * Math.min(canvas.clientWidth / (box[2] - box[0] + 1), canvas.clientHeight / (box[3] - box[1] + 1));
}

function trace(run) {
  const p = run.points;
  ctx.beginPath(); ctx.moveTo(p[0], p[1]);
  for (let i = 2; i < p.length; i += 2) ctx.lineTo(p[i], p[i + 1]);
  if (p.length === 4 && p[0] === p[2] && p[1] === p[3]) ctx.lineTo(p[0] + 1e-4, p[1]);
}
function outline(ring, colour, fill) {
  if (!ring.length) return;
  ctx.beginPath(); for (const [x, y] of ring) ctx.lineTo(x, y); ctx.closePath();
  ctx.fillStyle = colour + fill; ctx.fill(); ctx.strokeStyle = colour; ctx.lineWidth = 1.5 / view.scale; ctx.stroke();
}
function beads(runs, alpha) {
  ctx.globalAlpha = alpha;
  for (const run of runs) if (run.width > 0) { trace(run); ctx.strokeStyle = dark(colourOf(run)); ctx.lineWidth = run.width; ctx.stroke(); }
  for (const run of runs) if (run.width > 0) { trace(run); ctx.strokeStyle = colourOf(run); ctx.lineWidth = Math.max(run.width - 0.06, run.width / 2); ctx.stroke(); }
  ctx.globalAlpha = 1;
}
function hairlines(runs, colour, pixels) {
  ctx.strokeStyle = colour; ctx.lineWidth = pixels / view.scale;
  for (const run of runs) { trace(run); ctx.stroke(); }
}
let waiting = false;
function draw() { if (!waiting) { waiting = true; requestAnimationFrame(() => { waiting = false; paint(); }); } }
function paint() {
  const ratio = devicePixelRatio || 1, width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
  if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
  ctx.setTransform(1, 0, 0, 1, 0, 0); ctx.clearRect(0, 0, width, height);
  const s = view.scale * ratio;
  ctx.setTransform(s, 0, 0, -s, width / 2 - view.x * s, height / 2 + view.y * s);
  ctx.lineCap = ctx.lineJoin = 'round';
  if (page.overlay) {
    outline(page.overlay.reach, page.colours.reach, '18'); outline(page.overlay.bed, page.colours.bed, '1a');
    for (const ring of page.overlay.noGo) outline(ring, page.colours.noGo, '40');
  }
  const index = +$('layer').value, layer = layers[index], runs = layer.runs.slice(0, +$('shown').value);
  if ($('below').checked && index > 0) beads(layers[index - 1].runs, 0.25);
  beads(runs, 1);
  if (!page.overlay) hairlines(runs.filter(run => run.compensated), page.colours.reduced, 1);
  if ($('travels').checked) hairlines(runs.filter(run => run.width === 0), page.colours.travel, 1);
  hairlines(runs.filter(run => run.outside), page.colours.outside, 3);
  $('where').textContent = `${index} of ${layers.length}, z ${layer.z.toFixed(2)}, height ${layer.height.toFixed(2)} mm`;
  const last = runs[runs.length - 1];
  $('move').textContent = last ? (last.width > 0 ? `${page.features[last.feature][0]}, ${last.width.toFixed(2)} mm, ` : 'travel, ') + `${last.speed} mm/s` : '';
}
function legend() {
  const key = $('colour').value, rows = [], row = (colour, text) => rows.push([colour, text]);
  if (key === 'feature') page.features.forEach(([name, colour], i) => { if (layers.some(layer => layer.runs.some(run => run.width > 0 && run.feature === i))) row(colour, name); });
  else { const [least, most] = ranges[key]; for (let i = 5; i >= 0; --i) row(page.ramp[Math.round(i * 32 / 5)], `${(least + (most - least) * i / 5).toFixed(key === 'speed' ? 0 : 2)} ${units[key]}`); }
  if (!page.overlay && layers.some(layer => layer.runs.some(run => run.compensated))) row(page.colours.reduced, 'flow reduced');
  if (layers.some(layer => layer.runs.some(run => run.outside))) row(page.colours.outside, 'outside');
  if (page.overlay && page.overlay.noGo.length) row(page.colours.noGo, 'no-go area');
  const box = $('legend'); box.textContent = '';
  const title = document.createElement('b'); title.textContent = page.title; box.append(title);
  for (const [colour, text] of rows) { const line = document.createElement('div'), patch = document.createElement('i'); patch.style.background = colour; line.append(patch, text); box.append(line); }
}
function chooseLayer() { $('shown').max = layers[+$('layer').value].runs.length; $('shown').value = $('shown').max; draw(); }

document.title = page.title + ' - weft preview';
$('layer').max = layers.length - 1; $('layer').value = page.layer;
$('colour').value = page.colour; $('travels').checked = page.travels;
$('layer').oninput = chooseLayer; $('shown').oninput = $('travels').onchange = $('below').onchange = draw;
$('colour').onchange = () => { legend(); draw(); };
canvas.onwheel = event => {
  event.preventDefault();
  const factor = Math.exp(-event.deltaY / 400), dx = (event.offsetX - canvas.clientWidth / 2) / view.scale, dy = (canvas.clientHeight / 2 - event.offsetY) / view.scale;
  view.x += dx * (1 - 1 / factor); view.y += dy * (1 - 1 / factor); view.scale *= factor; draw();
};
canvas.onpointerdown = event => canvas.setPointerCapture(event.pointerId);
canvas.onpointermove = event => { if (event.buttons & 1) { view.x -= event.movementX / view.scale; view.y += event.movementY / view.scale; draw(); } };
canvas.ondblclick = () => { fit(); draw(); };
addEventListener('resize', draw);
addEventListener('keydown', event => {
  if (event.target.tagName === 'SELECT' || event.target.type === 'range') return;
  const move = {ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 10, PageDown: -10}[event.key];
  if (move) { $('layer').value = +$('layer').value + move; chooseLayer(); event.preventDefault(); }
});
legend(); chooseLayer(); fit(); draw();
</script></body></html>
)page";

}  // namespace weft::preview
