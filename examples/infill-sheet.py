#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws every pattern of sparse infill: slices a small block with each, and writes one page of pictures and figures.

    python3 examples/infill-sheet.py [WEFT] [OUTPUT_FOLDER] [PATTERN...]     # build/release/app/weft, build/infill-sheet

Two layers on each other of patterns that stand upright, four heights of those that change with it. The page needs no
network: pictures are in it. It also lists what the report says of each (the `infill` part of --report).
"""
import base64
import json
import pathlib
import struct
import subprocess
import sys

CHANGING = set('cubic tetrahedral quarter_cubic cubicsubdiv support_cubic honeycomb_3d crosshatch lateral_lattice lateral_honeycomb gyroid diamond fischer_koch '
               'schwarz_p voronoi_3d cross_3d lightning'.split())
WIDE, DEEP, HIGH, HOLE = 36, 28, 12, (22, 9, 31, 18)  # mm; a block with a square hole
MIDDLE = 30  # layer


def block(path):
    """The block as a closed binary STL."""
    def face(a, b, c, d):
        return [(a, b, c), (a, c, d)]
    x0, y0, x1, y1 = HOLE
    triangles = []
    xs, ys = [0, x0, x1, WIDE], [0, y0, y1, DEEP]
    for i in range(3):
        for j in range(3):
            if (i, j) == (1, 1):
                continue
            a, b, c, d = (xs[i], ys[j]), (xs[i + 1], ys[j]), (xs[i + 1], ys[j + 1]), (xs[i], ys[j + 1])
            triangles += face(*[p + (HIGH,) for p in (a, b, c, d)]) + face(*[p + (0,) for p in (d, c, b, a)])

    def walls(points):
        for p, q in zip(points, points[1:] + points[:1]):
            triangles.extend(face(p + (0,), q + (0,), q + (HIGH,), p + (HIGH,)))
    walls([(x, 0) for x in xs[:-1]] + [(WIDE, y) for y in ys[:-1]] + [(x, DEEP) for x in xs[:0:-1]] + [(0, y) for y in ys[:0:-1]])
    walls([(x0, y0), (x0, y1), (x1, y1), (x1, y0)])
    data = b'\0' * 80 + struct.pack('<I', len(triangles))
    for t in triangles:
        data += struct.pack('<12fH', 0, 0, 0, *[float(v) for p in t for v in p], 0)
    path.write_bytes(data)


def main():
    top = pathlib.Path(__file__).resolve().parent.parent
    weft = sys.argv[1] if len(sys.argv) > 1 else str(top / 'build/release/app/weft')
    out = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else top / 'build/infill-sheet')
    out.mkdir(parents=True, exist_ok=True)
    model = out / 'block.stl'
    block(model)
    setting = json.loads(subprocess.run([weft, 'settings', '--format', 'json', 'infill_pattern'], capture_output=True, check=True).stdout)[0]
    names = sys.argv[3:] or setting['choices']
    runs = [(n, []) for n in names] + ([] if sys.argv[3:] else [(n, ['infill_crossings=bend']) for n in ('grid', 'cubic', 'trihexagon')])
    rows, pictures = [], []
    for name, more in runs:
        title = ' '.join([name] + more)
        stem = title.replace(' ', '-').replace('=', '-')
        gcode, report = out / f'{stem}.gcode', out / f'{stem}.json'
        settings = ['infill_pattern=' + name, 'infill_sparse_density=20', 'layer_height=0.2'] + more
        run = subprocess.run([weft, 'slice', str(model), '-p', str(top / 'profiles/printers/marlin-220.ini'), *[w for s in settings for w in ('-s', s)],
                              '--report', str(report), '-o', str(gcode)], capture_output=True, text=True)
        if run.returncode:
            sys.exit(f'{title}: {run.stderr}')
        figures = json.loads(report.read_text()).get('infill', {})
        rows.append((title, figures))
        layers = [MIDDLE, MIDDLE + 4, MIDDLE + 8, MIDDLE + 12] if name in CHANGING else [MIDDLE, MIDDLE + 1]
        images = []
        for layer in layers:
            png = out / f'{stem}-{layer}.png'
            subprocess.run([weft, 'preview', str(gcode), '--layer', str(layer), '--size', '420', '-o', str(png)], check=True, capture_output=True)
            images.append(f'<img alt="layer {layer}" title="layer {layer}" src="data:image/png;base64,{base64.b64encode(png.read_bytes()).decode()}">')
        pictures.append(f'<figure><figcaption>{title}</figcaption>{"".join(images)}</figure>')
        print(title, f'{figures.get("density_percent", 0):.2f} %', flush=True)
    heads = ['density %', 'spread', 'h₂', 'h₄', 'h₆', 'over air %', 'locality', 'boxes', 'E plane %', 'E z %', 'k plane %', 'k z %']

    def cells(f):
        fabric, e, k = f.get('fabric', {}), f.get('stiffness_percent', {}), f.get('conductivity_percent', {})
        values = [f.get('density_percent'), f.get('density_spread_percent'), fabric.get('h2'), fabric.get('h4'), fabric.get('h6'), f.get('over_air_percent'),
                  f.get('locality'), f.get('box_dimension'), e.get('plane'), e.get('z'), k.get('plane'), k.get('z')]
        return ''.join(f'<td>{v:.2f}</td>' if v is not None else '<td>–</td>' for v in values)
    table = ''.join(f'<tr><th>{title}</th>{cells(f)}</tr>' for title, f in rows)
    (out / 'infill.html').write_text(
        '<!doctype html><meta charset="utf-8"><title>Sparse infill at 20 %</title><style>body{font:14px sans-serif}figure{display:inline-block;margin:8px}'
        'img{width:300px}td{text-align:right;padding:0 8px}th{text-align:left}</style><h1>Sparse infill at 20 %</h1>' + ''.join(pictures) +
        '<table><tr><th></th>' + ''.join(f'<th>{h}</th>' for h in heads) + '</tr>' + table + '</table>')
    print(out / 'infill.html')


if __name__ == '__main__':
    main()
