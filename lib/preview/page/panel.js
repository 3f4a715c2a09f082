// SPDX-License-Identifier: GPL-3.0-or-later
// What stands beside the picture: legend, findings, differences.
'use strict';

function showLegend(box, prints, state, range, changed) {
  box.replaceChildren();
  const patch = colour => { const i = make('i'); i.style.background = colour; return i; };
  if (state.colour === 'feature') {
    const rows = new Map();
    for (const p of prints) for (const f of p.features) {
      if (!(f.mm > 0)) continue;
      const row = rows.get(f.key) || {f, seconds: 0, all: 0};
      row.seconds += f.seconds; row.all += p.figures.seconds;
      rows.set(f.key, row);
    }
    for (const [key, {f, seconds, all}] of rows) {
      const label = make('label'), tick = make('input', {type: 'checkbox'});
      tick.checked = !state.hidden.has(key);
      tick.onchange = () => { if (tick.checked) state.hidden.delete(key); else state.hidden.add(key); changed(); };
      label.append(tick, patch(f.colour), make('span', {}, f.name), make('span', {}, all > 0 ? `${(100 * seconds / all).toFixed(1)} %` : ''));
      box.append(label);
    }
    return;
  }
  const row = (colour, text) => { const line = make('div'); line.append(patch(colour), make('span', {}, text)); box.append(line); };
  if (state.colour === 'tool') return void [...new Set(prints.flatMap(p => [...new Set(p.way.tool)]))].sort((a, b) => a - b).forEach(t => row(page.tools[t % page.tools.length], `tool ${t}`));
  const measure = measures[state.colour], [least, most] = range, count = most > least ? 6 : 1;
  for (let i = count - 1; i >= 0; --i) {
    const share = count > 1 ? i / (count - 1) : 0.5;
    row(page.ramp[Math.round(share * (page.ramp.length - 1))], `${(least + share * (most - least)).toFixed(measure.digits)} ${measure.unit}`);
  }
}

function showFindings(box, prints, fly) {
  const list = prints.flatMap((print, k) => print.findings.map(f => ({...f, print: k})));
  $('findings-count').textContent = list.length;
  $('findings-box').hidden = !page.audited;
  list.forEach((f, i) => {
    const item = make('li'), button = make('button', {type: 'button'}, f.text);
    button.onclick = () => fly(i);
    item.append(button); box.append(item);
  });
  return list;
}

/** What compare.cpp has found. */
function showDifferences(box) {
  const c = page.comparison;
  $('differences-box').hidden = !c;
  if (!c) return;
  box.append(make('p', {}, c.verdict));
  const number = v => Math.abs(v) >= 1000 ? v.toFixed(0) : String(+v.toPrecision(4));
  const t = table('Figures', ['', 'first', 'second', '%'], c.figures.map(f => [f.unit ? `${f.name}, ${f.unit.replace(/([23])$/, d => ' ²³'[d - 1])}` : f.name, number(f.a), number(f.b), f.percent.toFixed(2)]));
  c.figures.forEach((f, i) => { if (f.beyond) t.rows[i + 1].className = 'differs'; });
  box.append(t, curves('Area that only one covers', 'mm²', [c.layers.map(l => [l[0], l[1]]), c.layers.map(l => [l[0], l[2]])]));
  if (c.settings.length) {
    const settings = table(`Settings (${c.settings.length})`, ['', 'first', 'second'], c.settings.map(s => [s.key, s.a, s.b]));
    settings.className = 'words';
    box.append(settings);
  }
  else box.append(make('p', {}, c.settingsNote));
}
