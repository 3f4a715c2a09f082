// SPDX-License-Identifier: GPL-3.0-or-later
// The page: what is shown, and what changes it.
'use strict';

const $ = id => document.getElementById(id);
onerror = message => { document.body.dataset.error = message; };
onunhandledrejection = event => { document.body.dataset.error = String(event.reason); };
const page = JSON.parse($('facts').textContent), began = performance.now();
const prints = page.prints, camera = new Camera(), still = matchMedia('(prefers-reduced-motion:reduce)'), dark = matchMedia('(prefers-color-scheme:dark)');
const state = {colour: page.colour, hidden: new Set(), finding: -1, playing: false, layout: page.comparison ? 'side' : 'a', moving: false, range: [0, 0]};
const keyOfEvent = {retractions: 0, changes: 2};
const manyBeads = 2e6;  // above them only what is seen from outside is drawn while the camera moves
let painter = null, origin = null, box = null, waiting = false, findings = [], slow = false;

const checked = id => $(id).checked;
const inMm = (way, j) => [(way.texels[4 * j] | 0) * page.grain, (way.texels[4 * j + 1] | 0) * page.grain, ((way.texels[4 * j + 2] & 1048575) - lowest) * page.grain];
const offOrigin = at => at.map((v, i) => v - origin[i] * page.grain);

/** Layers and moves of a print that are shown: those of the first print, and of another as high as they are. */
function shownOf(index) {
  const top = +$('top').value, bottom = +$('bottom').value, print = prints[index], way = print.way;
  let last = top, first = bottom;
  if (index > 0) {
    const z = i => prints[0].layers[i][0] + 0.01, upTo = v => print.layers.reduce((n, l, i) => l[0] <= v ? i : n, 0);
    last = top === prints[0].layers.length - 1 ? print.layers.length - 1 : upTo(z(top));
    first = bottom === 0 ? 0 : Math.min(last, upTo(z(bottom)));
  }
  const layer = way.layers[last], whole = +$('moves').value === +$('moves').max;
  const end = whole ? layer.end : index === 0 ? layer.first + +$('moves').value : layer.first + Math.round((layer.end - layer.first) * $('moves').value / Math.max(1, $('moves').max));
  return {first: way.layers[first].first, end, layer: last, layerFirst: layer.first};
}
const lastSeconds = () => { const {end} = shownOf(0); return end > 0 ? prints[0].way.ends[end - 1] : 0; };

/** Box of what is printed, without custom G-code, in mm off the origin. */
function boxOf() {
  const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  for (const any of [false, true]) {
    for (const {way, features} of prints) {
      const custom = features.map(f => f.key === 'custom');
      for (let j = 1; j < way.length; ++j) {
        if (!any && (kindOf(way, j) !== kinds.bead || custom[way.feature[j] >> 1])) continue;
        const x = way.texels[4 * j] | 0, y = way.texels[4 * j + 1] | 0, z = (way.texels[4 * j + 2] & 1048575) - lowest;
        if (x < least[0]) least[0] = x; if (x > most[0]) most[0] = x;
        if (y < least[1]) least[1] = y; if (y > most[1]) most[1] = y;
        if (z < least[2]) least[2] = z; if (z > most[2]) most[2] = z;
      }
    }
    if (least[0] <= most[0]) break;
  }
  if (!(least[0] <= most[0])) { least.fill(0); most.fill(1); }
  least[2] = Math.min(0, least[2]);
  origin = new Int32Array([0, 1].map(i => Math.round((least[i] + most[i]) / 2)).concat(0));
  return [offOrigin(least.map(v => v * page.grain)), offOrigin(most.map(v => v * page.grain))];
}

function repaint() {
  const measure = measures[state.colour];
  state.range = measure ? rangeOf(prints, measure) : [0, 0];
  prints.forEach((print, i) => painter.paint(i, indicesOf(print, state.colour, state.range, state.hidden), paletteOf(print, state.colour)));
  showLegend($('legend'), prints, state, state.range, () => { repaint(); change(); });
  document.body.dataset.colour = state.colour;
  document.body.dataset.range = state.range.join(' ');
}

/** Points of interest of a print, in mm off the origin, with the junction of each; found when first asked for. */
function points(print, what) {
  const known = print.points ||= {};
  if (known[what]) return known[what];
  const {way} = print, at = [];
  if (what === 'seams') {
    const wall = print.features.map(f => f.key === 'outer_wall' || f.key === 'overhang_wall');
    for (let j = 1; j < way.length; ++j) if (kindOf(way, j) === kinds.bead && wall[way.feature[j] >> 1] && kindOf(way, j - 1) !== kinds.bead) at.push(j - 1);
  } else for (const e of way.events) if (e.kind === keyOfEvent[what]) at.push(e.junction);
  const places = new Float32Array(3 * at.length);
  at.forEach((j, i) => places.set(offOrigin(inMm(way, j)), 3 * i));
  return known[what] = {at, places};
}
const slice = ({at, places}, first, end) => places.slice(3 * lowerBound(at, first), 3 * lowerBound(at, end));

const areas = {over: (w, h) => [[0, 0, w, h]], a: (w, h) => [[0, 0, w, h]], b: (w, h) => [[0, 0, w, h]], side: (w, h) => w >= h ? [[0, 0, w >> 1, h], [w >> 1, 0, w - (w >> 1), h]] : [[0, h >> 1, w, h - (h >> 1)], [0, 0, w, h >> 1]]};
/** Which prints are drawn where: [indices, area in pixels]. */
function scenes(w, h) {
  const at = areas[state.layout](w, h);
  if (state.layout === 'side' && prints.length > 1) return at.map((area, i) => [[i], area]);
  return [[state.layout === 'over' ? prints.map((_, i) => i) : [state.layout === 'b' && prints.length > 1 ? 1 : 0], at[0]]];
}

function cutting() {
  const axis = $('cut').value;
  if (!axis) return {};
  const i = 'xyz'.indexOf(axis), plane = [0, 0, 0], share = $('cut-at').value / 1000, at = box[0][i] + (box[1][i] - box[0][i]) * share;
  const sign = camera.frame().eye[i] < 0 ? -1 : 1;  // what stands between the eye and the plane is taken away
  plane[i] = sign;
  return {plane, offset: sign * at};
}

const grey = v => [v, v, v];
function render() {
  waiting = false;
  const canvas = $('picture'), ratio = Math.min(2, devicePixelRatio || 1), w = Math.max(1, Math.round(canvas.clientWidth * ratio)), h = Math.max(1, Math.round(canvas.clientHeight * ratio));
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  const from = performance.now();
  painter.begin(dark.matches ? [0.086, 0.094, 0.114] : grey(1));
  for (const [indices, area] of scenes(w, h)) (painter instanceof Flat ? renderFlat : renderSolid)(indices, area, ratio);
  // Frames of a moving camera that come slowly: the card, or what stands in for it, is busy.
  if (state.moving && state.last && from - state.last > 200 && from - state.last < 2000) slow = true;
  state.last = state.moving ? from : 0;
  if (!document.body.dataset.first) requestAnimationFrame(() => { document.body.dataset.first ||= Math.round(performance.now() - began); });  // when it is shown
  document.body.dataset.frames = 1 + +(document.body.dataset.frames || 0);
}

function renderSolid(indices, area, ratio) {
  const gl = painter.gl, cut = cutting(), total = indices.reduce((n, i) => n + prints[i].way.length, 0);
  painter.look(area, {...camera.forShaders(area[2] / ratio, area[3] / ratio), dots: camera.zoom * ratio});
  drawBed();
  for (const i of indices) {
    const s = shownOf(i), style = {round: !state.moving, coarse: state.moving && (total > manyBeads || slow), ...cut};
    if (state.layout !== 'over') painter.beads(i, s.first, s.end, style);
    else for (const pass of passes(gl)[i]) painter.beads(i, s.first, s.end, {...style, ...pass});
    if (checked('travels')) painter.travels(i, s.first, s.end, [...rgb(page.colours.travel).map(v => v / 255), 1]);
    for (const what of ['retractions', 'seams'])
      if (checked(what)) painter.plain(what, gl.POINTS, slice(points(prints[i], what), s.first, s.end), [...rgb(page.colours[what]).map(v => v / 255), 1], {size: 5 * ratio, nearer: 0.002});
    if (checked('model') && prints[i].solid) painter.plain('model' + i, gl.TRIANGLES, prints[i].solid, [0.35, 0.55, 0.85, 0.22], {through: true});
  }
  drawFindings(indices, ratio);
}
/** Two prints over each other: what only one has is in its colour, what stands in the same place in both is grey. */
function passes(gl) {
  const tint = (colour, share) => [...rgb(colour).map(v => v / 255), share];
  return [[{tint: tint(page.colours.a, 0.85)}], [{tint: tint('#b4b4b4', 0.9), depth: gl.EQUAL}, {tint: tint(page.colours.b, 0.85), depth: gl.LESS}]];
}
function drawBed() {
  if (!page.overlay) return;
  const gl = painter.gl, z = -0.02, loop = ring => ring.flatMap(([x, y], i) => { const [nx, ny] = ring[(i + 1) % ring.length]; return [...offOrigin([x, y, z]), ...offOrigin([nx, ny, z])]; });
  state.bed ||= [['bed', new Float32Array(loop(page.overlay.bed))], ['reach', new Float32Array(loop(page.overlay.reach))], ['noGo', new Float32Array(page.overlay.noGo.flatMap(loop))]];
  for (const [name, places] of state.bed) if (places.length) painter.plain(name, gl.LINES, places, [...rgb(page.colours[name]).map(v => v / 255), 1]);
}
function drawFindings(indices, ratio) {
  const gl = painter.gl, mine = findings.filter(f => indices.includes(f.print)), red = [...rgb(page.colours.outside).map(v => v / 255), 1];
  if (!mine.length) return;
  const ways = mine.flatMap(f => f.move < 0 ? [] : [f.junction - 1, f.junction].flatMap(j => offOrigin(inMm(prints[f.print].way, j))));
  painter.plain('ways', gl.LINES, state.ways ||= new Float32Array(ways), red, {over: true});
  painter.plain('places', gl.POINTS, state.places ||= new Float32Array(mine.flatMap(f => offOrigin(f.at))), red, {size: 9 * ratio, over: true});
  const now = findings[state.finding];
  if (now && indices.includes(now.print)) painter.plain('now', gl.POINTS, new Float32Array(offOrigin(now.at)), [1, 1, 0.2, 1], {size: 16 * ratio, over: true});
}
function renderFlat(indices, area, ratio) {
  painter.look(area, camera, camera.zoom * ratio);
  if (page.overlay) {
    painter.ring(page.overlay.reach, page.colours.reach, '18'); painter.ring(page.overlay.bed, page.colours.bed, '1a');
    page.overlay.noGo.forEach(ring => painter.ring(ring, page.colours.noGo, '40'));
  }
  for (const i of indices) {
    const s = shownOf(i), way = prints[i].way;
    if (checked('below') && s.layer > 0) painter.beads(i, way.layers[s.layer - 1].first, way.layers[s.layer - 1].end, 0.25);
    painter.beads(i, s.layerFirst, s.end, state.layout === 'over' && i ? 0.5 : 1);
    if (checked('travels')) painter.travels(i, s.layerFirst, s.end, page.colours.travel);
    for (const what of ['retractions', 'seams']) if (checked(what)) painter.dots(slice(points(prints[i], what), s.layerFirst, s.end), page.colours[what], 5 * ratio);
    painter.dots(findings.filter(f => f.print === i && f.junction >= s.layerFirst && f.junction < s.end).flatMap(f => offOrigin(f.at)), page.colours.outside, 9 * ratio);
  }
}

function tell() {
  const print = prints[0], {end, layer} = shownOf(0), way = print.way, j = end - 1, first = way.layers[layer].first;
  const [z, height] = print.layers[layer], bottom = +$('bottom').value;
  $('top-says').textContent = `${layer + 1} of ${print.layers.length}, z ${z.toFixed(2)} mm, ${height.toFixed(2)} high`;
  $('bottom-says').textContent = `${bottom + 1}, z ${print.layers[bottom][0].toFixed(2)} mm`;
  $('moves-says').textContent = `${end - first} of ${way.layers[layer].end - first}`;
  $('time').value = Math.round(10000 * lastSeconds() / Math.max(1e-9, print.figures.seconds));
  $('time-says').textContent = `${clock(lastSeconds())} of ${clock(print.figures.seconds)}`;
  for (const [id, says] of [['top', 'top-says'], ['bottom', 'bottom-says'], ['moves', 'moves-says'], ['time', 'time-says']]) $(id).setAttribute('aria-valuetext', $(says).textContent);
  if (j < first) return void ($('readout').textContent = '');
  const feature = print.features[way.feature[j] >> 1], bead = kindOf(way, j) === kinds.bead;
  $('readout').textContent = `line ${way.line[j]}: ${bead ? `${feature ? feature.name : ''}, ${widthOf(way, j).toFixed(2)} × ${heightOf(way, j).toFixed(2)} mm` : 'travel'}, ${(way.speed[j] / 10).toFixed(0)} mm/s`
    + (bead ? `, ${measures.flow.of(print)(j).toFixed(1)} mm³/s` : '') + (way.fan[j] ? `, fan ${way.fan[j]} %` : '') + (way.nozzle[j] ? `, ${way.nozzle[j]} °C` : '');
}

/** Draws soon. @param moving the camera is on its way: quicker and coarser */
function change(moving = false) {
  state.moving = moving;
  tell();
  if (!waiting) { waiting = true; requestAnimationFrame(render); }
}
function chooseLayer() {
  if (+$('bottom').value > +$('top').value) $('bottom').value = $('top').value;
  const layer = prints[0].way.layers[+$('top').value];
  $('moves').max = layer.end - layer.first; $('moves').value = $('moves').max;
  change();
}
function chooseTime(seconds) {
  const way = prints[0].way;
  let layer = way.layers.findIndex(l => l.ends >= seconds);
  if (layer < 0) layer = way.layers.length - 1;
  $('top').value = layer;
  const {first, end} = way.layers[layer];
  if (+$('bottom').value > layer) $('bottom').value = layer;
  $('moves').max = end - first;
  $('moves').value = lowerBound(way.ends.subarray(first, end), seconds) + 1;
  change();
}
function look(name) {
  if (looks[name]) [camera.yaw, camera.pitch] = looks[name];
  $('look').value = looks[name] ? name : '';
  fit();
}
function areaSize() {
  const canvas = $('picture'), [, , w, h] = areas[state.layout](canvas.clientWidth, canvas.clientHeight)[0];
  return [Math.max(1, w), Math.max(1, h)];
}
function fit() { camera.fit(box, ...areaSize()); change(); }

/** Flies to a finding: its layer on top, the place in the middle. */
function fly(i) {
  const f = findings[i];
  if (!f) return;
  state.finding = i;
  [...$('findings').querySelectorAll('button')].forEach((b, k) => { if (k === i) { b.setAttribute('aria-current', 'true'); b.scrollIntoView({block: 'nearest'}); } else b.removeAttribute('aria-current'); });
  if (f.print === 0 && f.move >= 0) {
    const layer = prints[0].way.layers.findIndex(l => f.junction < l.end);
    $('top').value = layer;
    const {first, end} = prints[0].way.layers[layer];
    $('moves').max = end - first; $('moves').value = f.junction + 1 - first;
    if (+$('bottom').value > layer) $('bottom').value = 0;
  }
  const to = offOrigin(f.at), from = camera.target, zoom = camera.zoom, near = Math.max(zoom, Math.min(...areaSize()) / 30), start = performance.now(), duration = still.matches ? 0 : 500;
  document.body.dataset.finding = i;
  const step = now => {
    const t = duration ? Math.min(1, (now - start) / duration) : 1, s = t * t * (3 - 2 * t);
    camera.target = from.map((v, k) => v + (to[k] - v) * s); camera.zoom = zoom * (near / zoom) ** s;
    camera.depth = Math.max(camera.depth, 2 * Math.hypot(...to));
    change(t < 1);
    if (t < 1) requestAnimationFrame(step);
  };
  step(start);
}

function play() {
  state.playing = !state.playing;
  $('play').setAttribute('aria-pressed', state.playing); $('play').textContent = state.playing ? 'stop' : 'play';
  const layers = prints[0].layers.length;
  if (state.playing && +$('top').value === layers - 1) $('top').value = 0;
  const step = () => {
    if (!state.playing) return;
    $('top').value = +$('top').value + 1;
    chooseLayer();
    if (+$('top').value >= layers - 1) return play();
    setTimeout(step, still.matches ? 1000 : Math.max(60, 10000 / layers));
  };
  if (state.playing) step();
}

function pressed(event) {
  const typing = ['SELECT', 'BUTTON', 'SUMMARY'].includes(event.target.tagName) || (event.target.type === 'range' && /^(Arrow|Page|Home|End)/.test(event.key));
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const toggle = id => { if (!$(id + '-label') || !$(id + '-label').hidden) { $(id).checked = !$(id).checked; $(id).onchange(); } };
  const nudge = (id, by, then) => { $(id).value = +$(id).value + by; then(); };
  const anywhere = {
    PageUp: () => nudge('top', 1, chooseLayer), PageDown: () => nudge('top', -1, chooseLayer), ',': () => nudge('moves', -1, change), '.': () => nudge('moves', 1, change),
    c: () => { $('colour').selectedIndex = ($('colour').selectedIndex + 1) % $('colour').length; $('colour').onchange(); },
    t: () => toggle('travels'), r: () => toggle('retractions'), s: () => toggle('seams'), m: () => toggle('model'), f: () => fly((state.finding + 1) % Math.max(1, findings.length)), ' ': play,
  };
  const onPicture = {Home: fit, ...Object.fromEntries(Object.keys(looks).map((name, i) => [String(i + 1), () => look(name)]))};
  const turn = event.target === $('picture') && cameraKeys[event.key];
  if (turn) { turn(camera, event.shiftKey); $('look').value = ''; change(true); clearTimeout(state.rest); state.rest = setTimeout(() => change(), 180); }
  else if (event.target === $('picture') && onPicture[event.key]) onPicture[event.key]();
  else if (!typing && anywhere[event.key]) anywhere[event.key]();
  else return;
  event.preventDefault();
}

/** The painter for what is asked for: a canvas keeps the kind of its first context, so another kind takes another one. */
function choosePainter() {
  const flat = checked('flat');
  if (painter) { const old = $('picture'), fresh = old.cloneNode(); old.replaceWith(fresh); if (painter.gl) painter.gl.getExtension('WEBGL_lose_context')?.loseContext(); follow(); }
  try {
    if (flat || page.flat) throw new Error('flat');
    painter = new Beads($('picture'), prints, origin);
  } catch (error) {
    if (error.message !== 'flat') { $('note').textContent = `One layer from above: ${error.message === 'no WebGL2' ? 'this browser shows no WebGL2' : error.message}.`; $('flat').checked = true; $('flat').disabled = true; const old = $('picture'), fresh = old.cloneNode(); old.replaceWith(fresh); follow(); }
    painter = new Flat($('picture'), prints, origin);
  }
  document.body.dataset.painter = painter instanceof Flat ? 'flat' : 'solid';
  for (const id of ['cut', 'cut-at', 'look', 'bottom']) $(id).disabled = painter instanceof Flat;
  $('below').disabled = !(painter instanceof Flat);
  state.bed = state.ways = state.places = undefined;
  repaint();
  if (painter instanceof Flat) [camera.yaw, camera.pitch] = looks.top;
  fit();
}
function follow() {
  const middle = () => { const [w, h] = areaSize(); return [w / 2, h / 2]; };
  camera.turn = function (dx, dy) { if (painter instanceof Flat) this.pan(dx / 0.4, dy / 0.4); else { Camera.prototype.turn.call(this, dx, dy); $('look').value = ''; } };
  followPointers($('picture'), camera, middle, atRest => change(!atRest));
  $('picture').ondblclick = fit;
  $('picture').setAttribute('aria-label', `toolpaths of ${prints.map(p => p.name).join(' and ')}`);
}

/** What the address says behind #, as in #colour=speed&top=40&cut=x,0.5&look=top. */
function obeyAddress() {
  const asked = new URLSearchParams(location.hash.slice(1)), number = name => asked.has(name) && isFinite(asked.get(name)) ? +asked.get(name) : null;
  if (measures[asked.get('colour')] !== undefined) { $('colour').value = state.colour = asked.get('colour'); }
  for (const id of ['travels', 'retractions', 'seams', 'model', 'flat']) if (asked.get(id) === '1') $(id).checked = true;
  if (asked.has('cut')) { const [axis, share] = asked.get('cut').split(','); if ('xyz'.includes(axis)) { $('cut').value = axis; $('cut-at').value = 1000 * share; } }
  if (areas[asked.get('layout')] && prints.length > 1) $('layout').value = state.layout = asked.get('layout');
  for (const key of (asked.get('hide') || '').split(',')) if (key) state.hidden.add(key);
  if (number('top') !== null) $('top').value = number('top');
  if (number('bottom') !== null) $('bottom').value = number('bottom');
  return {look: asked.get('look'), zoom: number('zoom'), finding: number('finding'), moves: number('moves'), open: asked.get('open')};
}

function connect() {
  $('top').oninput = $('bottom').oninput = chooseLayer;
  $('moves').oninput = () => change();
  $('time').oninput = () => chooseTime($('time').value / 10000 * prints[0].figures.seconds);
  for (const id of ['travels', 'retractions', 'seams', 'below', 'model']) $(id).onchange = () => change();
  $('flat').onchange = choosePainter;
  $('cut').onchange = $('cut-at').oninput = () => change();
  $('look').onchange = () => { if (looks[$('look').value]) look($('look').value); };
  $('fit').onclick = fit; $('play').onclick = play;
  $('layout').onchange = () => { state.layout = $('layout').value; state.ways = state.places = undefined; fit(); };
  $('colour').onchange = () => { state.colour = $('colour').value; repaint(); change(); };
  addEventListener('resize', () => change()); addEventListener('keydown', pressed); dark.addEventListener('change', () => change());
}

async function open() {
  document.title = `${page.title} - weft`; $('title').textContent = page.title;
  $('note').textContent = 'unpacking';
  for (const [i, print] of prints.entries()) {
    print.way = unpack(await inflated($(`pack-${i}`).textContent), print.layers.map(l => l[2]));
    $(`pack-${i}`).remove();
    const model = $(`model-${i}`);
    if (model) {
      const {corners, triangles} = unpackModel(await inflated(model.textContent), page.grain);
      print.model = {corners, triangles}; model.remove();
    }
  }
  box = boxOf();
  for (const print of prints) if (print.model) {
    const {corners, triangles} = print.model;
    print.solid = Float32Array.from({length: 3 * triangles.length}, (_, i) => corners[3 * triangles[Math.floor(i / 3)] + i % 3] - (i % 3 < 2 ? origin[i % 3] * page.grain : 0));
    $('model-label').hidden = false;
  }
  $('colour').replaceChildren(...Object.keys(measures).filter(m => m !== 'tool' || prints.some(p => p.way.tool.some(t => t !== p.way.tool[0]))).map(m => new Option(m, m)));
  $('colour').value = state.colour;
  const layers = prints[0].layers.length - 1;
  $('top').max = $('bottom').max = layers; $('top').value = page.layer ?? layers; $('travels').checked = page.travels;
  $('layout-row').hidden = prints.length < 2;
  $('summary').textContent = prints.map(p => `${clock(p.figures.seconds)}, ${(p.figures.filamentMm / 1000).toFixed(2)} m of filament, ${p.layers.length} layers, ${p.figures.moves} moves`).join(' | ');
  findings = showFindings($('findings'), prints, fly);
  findings.forEach(f => { f.junction = f.move < 0 ? -1 : prints[f.print].way.junctionOf(f.move); });
  showDifferences($('differences')); showPlots($('plots'), prints);
  $('note').textContent = '';
  const asked = obeyAddress();
  connect(); follow(); choosePainter(); chooseLayer();
  if (asked.look) look(asked.look);
  if (asked.zoom) { camera.zoom *= asked.zoom; change(); }
  if (asked.moves !== null) { $('moves').value = asked.moves; change(); }
  if (asked.open && $(asked.open)) { document.querySelectorAll('details').forEach(d => { d.open = d.id === asked.open; }); $(asked.open).scrollIntoView(); }
  if (asked.finding !== null) fly(asked.finding);
  const count = kind => prints.map(p => { let n = 0; for (let j = 1; j < p.way.length; ++j) n += kindOf(p.way, j) === kind; return n; });
  document.body.dataset.counts = JSON.stringify({beads: count(kinds.bead), travels: count(kinds.travel), seconds: prints.map(p => p.way.layers.at(-1).ends), retractions: prints.map(p => p.way.events.filter(e => e.kind === 0).length), findings: findings.length, layers: prints.map(p => p.way.layers.length)});
  document.body.dataset.unpacked = Math.round(performance.now() - began);
  document.body.dataset.ready = '1';
}
if (typeof DecompressionStream === 'undefined') $('note').textContent = 'This browser is too old to unpack the page: it has no DecompressionStream.';
else open();
