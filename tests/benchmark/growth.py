#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How weft's time and memory grow with its input, on generated series: triangles, islands, layers, vertices of an outline.

    python3 tests/benchmark/growth.py --weft build/release/app/weft [--runs 3] [--plot growth.svg]

Prints CPU seconds (least of the runs), peak memory, and the exponent between neighbours: 1 is linear growth, 2 square.
The plot has both axes logarithmic, with a dashed line of linear growth for each series. Standard library only.
"""
import argparse
import math
import pathlib
import tempfile

import compare


def star(n):
    """A toothed outline of n corners, 60 mm across."""
    return [((30 - 2 * (i % 2)) * math.cos(2 * math.pi * i / n), (30 - 2 * (i % 2)) * math.sin(2 * math.pi * i / n)) for i in range(n)]


def fan_prism(ring, z0, z1):
    """A prism over a ring that its centre sees whole."""
    out, n = [], len(ring)
    for i in range(n):
        a, b = ring[i], ring[(i + 1) % n]
        out += [((*a, z0), (*b, z0), (*b, z1)), ((*a, z0), (*b, z1), (*a, z1)), ((0, 0, z1), (*a, z1), (*b, z1)), ((0, 0, z0), (*b, z0), (*a, z0))]
    return out


def islands(n):
    return [t for i in range(n) for t in compare.prism(compare.circle(3 * (i % 80), 3 * (i // 80), 1.2, 8), 0, 2)]


SERIES = {
    "triangles": [(2 * n * 2 * n, lambda n=n: compare.sphere(20, n), []) for n in (100, 200, 400, 800)],
    "islands a layer": [(n, lambda n=n: islands(n), []) for n in (400, 800, 1600, 3200, 6400)],
    "layers": [(round(20 / h), lambda: compare.prism(compare.circle(0, 0, 12, 60), 0, 20), ["-s", f"layer_height={h}", "-s", f"initial_layer_height={h}"])
               for h in (0.4, 0.2, 0.1, 0.05, 0.025)],
    "corners of an outline": [(n, lambda n=n: fan_prism(star(n), 0, 2), []) for n in (100, 200, 400, 800, 1600)],
}
COLOURS = ["#d1495b", "#00798c", "#edae49", "#30638e"]


def plot(path, table):
    points = [(x, y) for rows in table.values() for x, y, _ in rows]
    lx, ly = [math.log10(p[0]) for p in points], [math.log10(max(p[1], 1e-3)) for p in points]
    place = lambda x, y: (80 + 640 * (math.log10(x) - min(lx)) / (max(lx) - min(lx)), 430 - 380 * (math.log10(max(y, 1e-3)) - min(ly)) / (max(ly) - min(ly)))
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 960 480" font-family="sans-serif" font-size="14"><rect width="960" height="480" fill="white"/>']
    for e in range(math.floor(min(lx)), math.ceil(max(lx)) + 1):
        if min(lx) <= e <= max(lx):
            x = place(10**e, 1)[0]
            out.append(f'<path d="M{x:.0f} 50V430" stroke="#ddd"/><text x="{x:.0f}" y="450" text-anchor="middle">{10**e:,}</text>')
    for e in range(math.floor(min(ly)), math.ceil(max(ly)) + 1):
        if min(ly) <= e <= max(ly):
            y = place(points[0][0], 10**e)[1]
            out.append(f'<path d="M80 {y:.0f}H720" stroke="#ddd"/><text x="72" y="{y + 5:.0f}" text-anchor="end">{10.0**e:g} s</text>')
    for (name, rows), colour in zip(table.items(), COLOURS):
        line = " ".join("{:.1f},{:.1f}".format(*place(x, y)) for x, y, _ in rows)
        x0, y0, x1 = rows[0][0], rows[0][1], rows[-1][0]
        linear = " ".join("{:.1f},{:.1f}".format(*place(x, y)) for x, y in ((x0, y0), (x1, y0 * x1 / x0)))
        out.append(f'<polyline points="{linear}" fill="none" stroke="{colour}" stroke-dasharray="3 5"/><polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2.5"/>')
        out += ['<circle cx="{:.1f}" cy="{:.1f}" r="4" fill="{}"/>'.format(*place(x, y), colour) for x, y, _ in rows]
    for i, (name, colour) in enumerate(zip(table, COLOURS)):
        out.append(f'<rect x="745" y="{60 + 28 * i}" width="18" height="10" fill="{colour}"/><text x="770" y="{70 + 28 * i}">{name}</text>')
    out.append('<text x="80" y="30">CPU seconds of weft slice; dashed: linear growth</text></svg>')
    pathlib.Path(path).write_text("\n".join(out))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--weft", default="build/release/app/weft")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--plot", help="also draw the curves to this SVG file")
    args = parser.parse_args()
    table = {}
    with tempfile.TemporaryDirectory(prefix="weft-growth-") as name:
        folder = pathlib.Path(name)
        print("| series | n | CPU s | exponent | peak MB |\n|---|---|---|---|---|")
        for series, cases in SERIES.items():
            before = None
            for n, make, more in cases:
                model = folder / "model.stl"
                compare.write_model(model, make)
                settings = [w for k, v in compare.WEFT.items() for w in ("-s", f"{k}={v}")]
                runs = [compare.measured([args.weft, "slice", str(model), "-o", str(folder / "o.gcode"), "-q", "-j", "1", *settings, *more], {}, 600) for _ in range(args.runs)]
                if None in runs:
                    print(f"| {series} | {n:,} | failed | | |")
                    continue
                cpu, memory = min(r[1] for r in runs), max(r[2] for r in runs)
                exponent = f"{math.log(cpu / before[1]) / math.log(n / before[0]):.2f}" if before else ""
                print(f"| {series} | {n:,} | {cpu:.3f} | {exponent} | {memory:.0f} |", flush=True)
                table.setdefault(series, []).append((n, cpu, memory))
                before = (n, cpu)
    if args.plot:
        plot(args.plot, table)


if __name__ == "__main__":
    main()
