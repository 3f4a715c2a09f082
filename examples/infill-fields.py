#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Three parts whose infill follows a field: wear seen from above, the stress of a cantilever, a density that a small
topology optimisation finds. Makes the fields and a plate, slices, draws, and says how near the plastic comes to them.

    python3 examples/infill-fields.py [WEFT] [OUTPUT_FOLDER]     # build/release/app/weft, build/infill-fields
"""
import json
import math
import pathlib
import re
import struct
import subprocess
import sys

WIDE, DEEP, HIGH = 80.0, 40.0, 8.0  # mm, of the plate
X0, Y0 = 70.0, 90.0                 # its corner on the bed, which is 220 mm wide
LAYER, CELL = 0.2, 8.0              # mm; cells that densities are compared in


def plate(path):
    corners = [(x, y, z) for z in (0, HIGH) for y in (0, DEEP) for x in (0, WIDE)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    data = b'\0' * 80 + struct.pack('<I', len(triangles))
    for t in triangles:
        data += struct.pack('<12fH', 0, 0, 0, *[v for k in t for v in corners[k]], 0)
    path.write_bytes(data)


def wear(x, y):
    """0 … 1: worn around a place on the right."""
    return math.exp(-((x - 60) ** 2 + (y - 20) ** 2) / 400)


def write_wear(path):
    columns, rows = 160, 80
    lines = [' '.join(str(round(255 * (1 - wear(WIDE * (i + .5) / columns, DEEP * (1 - (j + .5) / rows))))) for i in range(columns)) for j in range(rows)]
    path.write_text(f'P2\n{columns} {rows}\n255\n' + '\n'.join(lines) + '\n')


def write_stress(path):
    """A beam held at its left end with a load at its right one: Timoshenko & Goodier, Theory of elasticity, § 21."""
    c, force = DEEP / 2, 1.0
    inertia = 2 * c ** 3 / 3
    lines = ['x,y,z,sxx,syy,szz,sxy,syz,szx']
    for j in range(21):
        for i in range(41):
            x, y = WIDE * i / 40, DEEP * j / 20
            bending, shear = force * (WIDE - x) * (y - c) / inertia, -force / (2 * inertia) * (c * c - (y - c) ** 2)
            lines.append(f'{X0 + x:g},{Y0 + y:g},0,{bending:.6g},0,0,{shear:.6g},0,0')
    path.write_text('\n'.join(lines) + '\n')


def stiffness_of_cell(nu=0.3):
    """Of a square of one, in plane stress: Sigmund 2001, A 99 line topology optimization code."""
    k = [1 / 2 - nu / 6, 1 / 8 + nu / 8, -1 / 4 - nu / 12, -1 / 8 + 3 * nu / 8, -1 / 4 + nu / 12, -1 / 8 - nu / 8, nu / 6, 1 / 8 - 3 * nu / 8]
    order = ['01234567', '10765432', '27056341', '36507214', '45670123', '54321076', '63412705', '72143650']
    return [[k[int(d)] / (1 - nu * nu) for d in row] for row in order]


def optimise(columns, rows, share, penal=3.0, rounds=25):
    """Densities of cells, by row from above, of the stiffest cantilever with that share of plastic."""
    ke = stiffness_of_cell()
    node = lambda i, j: i * (rows + 1) + j
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))  # from above left, as the rows of the matrix go
    dofs = [[2 * node(i + a, j + b) + k for a, b in corners for k in (0, 1)] for j in range(rows) for i in range(columns)]
    count = 2 * (columns + 1) * (rows + 1)
    fixed = set(range(2 * (rows + 1)))
    load = [0.0] * count
    load[2 * node(columns, rows // 2) + 1] = -1.0
    density, u = [share] * (columns * rows), [0.0] * count

    def product(v, weights):
        out = [0.0] * count
        for d, w in zip(dofs, weights):
            part = [v[k] for k in d]
            for a, row in zip(d, ke):
                out[a] += w * sum(p * q for p, q in zip(row, part))
        for k in fixed:
            out[k] = 0.0
        return out
    for _ in range(rounds):
        weights = [1e-3 + (1 - 1e-3) * d ** penal for d in density]
        diagonal = [1e-9] * count
        for d, w in zip(dofs, weights):
            for a, row in zip(range(8), ke):
                diagonal[d[a]] += w * row[a]
        r = [b - a for a, b in zip(product(u, weights), load)]
        for k in fixed:
            r[k] = 0.0
        z = [a / b for a, b in zip(r, diagonal)]
        p, rz = list(z), sum(a * b for a, b in zip(r, z))
        for _ in range(120):  # conjugate gradients, from the last round's answer
            ap = product(p, weights)
            alpha = rz / max(sum(a * b for a, b in zip(p, ap)), 1e-30)
            u = [a + alpha * b for a, b in zip(u, p)]
            r = [a - alpha * b for a, b in zip(r, ap)]
            if max(map(abs, r)) < 1e-4:
                break
            z = [a / b for a, b in zip(r, diagonal)]
            last, rz = rz, sum(a * b for a, b in zip(r, z))
            p = [a + rz / last * b for a, b in zip(z, p)]
        gain = []
        for d, x in zip(dofs, density):
            part = [u[k] for k in d]
            energy = sum(a * sum(q * v for q, v in zip(row, part)) for a, row in zip(part, ke))
            gain.append(penal * x ** (penal - 1) * energy * x)
        smooth = []
        for j in range(rows):
            for i in range(columns):
                total = weight = 0.0
                for b in range(max(0, j - 1), min(rows, j + 2)):
                    for a in range(max(0, i - 1), min(columns, i + 2)):
                        w = max(0.0, 1.5 - math.hypot(a - i, b - j))
                        total, weight = total + w * gain[b * columns + a], weight + w
                smooth.append(total / weight / max(density[j * columns + i], 1e-3))
        low, high = 1e-9, 1e9
        while high / low > 1.0001:
            middle = math.sqrt(low * high)
            new = [min(1.0, max(0.02, min(x + 0.2, max(x - 0.2, x * math.sqrt(g / middle))))) for x, g in zip(density, smooth)]
            low, high = (middle, high) if sum(new) > share * len(new) else (low, middle)
        density = new
    return density


def write_topology(path):
    columns, rows = 32, 16
    density = optimise(columns, rows, 0.35)
    lines = ['x,y,z,density']
    for j in range(rows):
        for i in range(columns):
            lines.append(f'{X0 + WIDE * (i + .5) / columns:g},{Y0 + DEEP * (1 - (j + .5) / rows):g},0,{density[j * columns + i]:.4f}')
    path.write_text('\n'.join(lines) + '\n')

    def between(x, y):
        """Linear between the middles of cells, constant beyond."""
        u, v = min(max(x / WIDE * columns - .5, 0), columns - 1), min(max((1 - y / DEEP) * rows - .5, 0), rows - 1)
        i, j = min(int(u), columns - 2), min(int(v), rows - 2)
        a, b = u - i, v - j
        row = lambda n: density[n * columns + i] * (1 - a) + density[n * columns + i + 1] * a
        return row(j) * (1 - b) + row(j + 1) * b
    return between


def laid(gcode, first, last):
    """mm³ of sparse infill by cell, of layers from first to last."""
    area = math.pi * 1.75 ** 2 / 4
    cells, kind, x, y, e, layer, relative = {}, '', 0.0, 0.0, 0.0, -1, False
    for line in gcode.read_text().splitlines():
        if line.startswith(';LAYER_CHANGE'):
            layer += 1
        elif line.startswith(';TYPE:'):
            kind = line[6:]
        elif line.startswith('M83'):
            relative = True
        elif line.startswith('G92 E'):
            e = float(line.split('E')[1].split()[0])
        elif re.match(r'G[01] ', line):
            words = {w[0]: float(w[1:]) for w in line.split(';')[0].split()[1:] if len(w) > 1}
            nx, ny, push = words.get('X', x), words.get('Y', y), 0.0
            if 'E' in words:
                push, e = (words['E'], e) if relative else (words['E'] - e, words['E'])
            if push > 0 and (nx, ny) != (x, y) and kind == 'Internal infill' and first <= layer <= last:
                pieces = max(1, math.ceil(math.hypot(nx - x, ny - y) / 0.2))
                for k in range(pieces):
                    t = (k + .5) / pieces
                    cell = (int((x + t * (nx - x) - X0) // CELL), int((y + t * (ny - y) - Y0) // CELL))
                    cells[cell] = cells.get(cell, 0.0) + push * area / pieces
            x, y = nx, ny
    return cells


def compare(gcode, report, wanted):
    """Mean error in % of all that is inside of the walls, where joints along walls are; RMS in points of cells that no wall is in."""
    first, last = 10, 29
    cells = laid(gcode, first, last)
    squares, count = 0.0, 0
    inset, count_x, count_y = 1.55, 160, 80  # mm, of three walls; places between
    places = [(inset + (x + .5) / count_x * (WIDE - 2 * inset), inset + (y + .5) / count_y * (DEEP - 2 * inset)) for x in range(count_x) for y in range(count_y)]
    mean = sum(wanted(x, y) for x, y in places) / len(places)
    for j in range(1, int(DEEP / CELL) - 1):
        for i in range(1, int(WIDE / CELL) - 1):
            have = cells.get((i, j), 0.0) / (CELL * CELL * LAYER * (last - first + 1))
            steps = [(k + .5) / 8 * CELL for k in range(8)]
            want = sum(wanted(i * CELL + a, j * CELL + b) for a in steps for b in steps) / 64
            squares, count = squares + (have - want) ** 2, count + 1
    return report['infill']['density_percent'] / mean - 100, 100 * math.sqrt(squares / count)


def main():
    top = pathlib.Path(__file__).resolve().parent.parent
    weft = sys.argv[1] if len(sys.argv) > 1 else str(top / 'build/release/app/weft')
    out = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else top / 'build/infill-fields')
    out.mkdir(parents=True, exist_ok=True)
    plate(out / 'plate.stl')
    write_wear(out / 'wear.pgm')
    write_stress(out / 'stress.csv')
    topology = write_topology(out / 'topology.csv')
    clamp = lambda v, low, high: min(max(v, low), high)
    worn = lambda x, y: 0.08 + (0.6 - 0.08) * wear(x, y)
    best = lambda x, y: clamp(topology(x, y), 0.05, 0.8)
    jobs = [('wear', 'infill_density_image = wear.pgm\ninfill_density_min = 8\ninfill_density_max = 60\ninfill_pattern = {}\n', worn),
            ('topology', 'infill_density_field = topology.csv\ninfill_density_max = 80\ninfill_pattern = {}\n', best)]
    runs = [(f'{name}-{pattern}', text.format(pattern), wanted) for name, text, wanted in jobs for pattern in ('grid', 'gyroid', 'concentric')]
    runs += [(f'wear-grid-{d}', jobs[0][1].format('grid') + f'infill_density_dither = {d}\n', worn) for d in ('floyd_steinberg', 'blue_noise')]
    runs.append(('wear-patterns', jobs[0][1].format('grid') + 'infill_pattern_by_density = 0:honeycomb, 20:grid, 45:concentric\n', worn))
    runs.append(('stress', 'infill_direction_field = stress.csv\ninfill_pattern = streamlines\n', lambda x, y: 0.2))
    for name, text, wanted in runs:
        (out / f'{name}.ini').write_text(f'infill_sparse_density = 20\nlayer_height = {LAYER}\n' + text)
        gcode = out / f'{name}.gcode'
        run = subprocess.run([weft, 'slice', str(out / 'plate.stl'), '-p', str(top / 'profiles/printers/marlin-220.ini'), '-p', str(out / f'{name}.ini'),
                              '--center', f'{X0 + WIDE / 2:g},{Y0 + DEEP / 2:g}', '--report', str(out / f'{name}.json'), '-o', str(gcode)], capture_output=True, text=True)
        if run.returncode:
            sys.exit(f'{name}: {run.stderr}')
        for layer in (20, 21):
            subprocess.run([weft, 'preview', str(gcode), '--layer', str(layer), '--size', '900', '-o', str(out / f'{name}-{layer}.png')], check=True, capture_output=True)
        mean, rms = compare(gcode, json.loads((out / f'{name}.json').read_text()), wanted)
        print(f'{name:28} mean {mean:+6.2f} %   RMS {rms:5.2f} points', flush=True)


if __name__ == '__main__':
    main()
