#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures walls of variable width on polygons filled by walls alone, beside PrusaSlicer's Arachne and classic walls.

    shapes.py run --weft BINARY [--shapes FOLDER] [--tools FOLDER] [--work FOLDER] [-o RUN.json] [NAME ...]
    shapes.py table RUN.json            the table again, with the goals
    shapes.py compare A.json B.json     what got better and what worse from A to B
    shapes.py list                      the names of the generated shapes

Polygons: the *.wkt of --shapes (coordinates in microns; or $WEFT_SHAPES, or ../shared/corpus/shapes beside the checkout)
and generated ones: wedges, combs, stars, letters, rings, crossings, sieves. Each becomes a prism of three layers, is sliced
with lines of 0.45 mm, layers of 0.2 mm and walls without end, and is measured by the tool `fidelity`, which lays the G-code
down on a grid. --tools (or $WEFT_TOOLS) holds the programs `fidelity` and `shape2stl`, or their sources. What is absent is
said. Peers are sliced and measured once and kept in --work. --figures takes a table of further peers by shape. Standard library only.
"""
import argparse
import concurrent.futures
import hashlib
import json
import math
import os
import pathlib
import random
import re
import shutil
import statistics
import struct
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAYERS, LAYER_MM = 3, 0.2
WEFT = {
    "machine_width": 1000, "machine_depth": 1000, "nozzle_diameter": 0.4, "layer_height": 0.2, "wall_line_count": 100,
    "wall_line_width_0": 0.45, "wall_line_width_x": 0.45, "top_layers": 0, "bottom_layers": 0, "top_thickness": 0,
    "bottom_thickness": 0, "infill_sparse_density": 0, "infill_solid_below_area": 0, "skirt_line_count": 0, "thumbnails": "",
}
PRUSA = {
    "layer_height": 0.2, "first_layer_height": 0.2, "nozzle_diameter": 0.4, "filament_diameter": 1.75, "extrusion_width": 0.45,
    "external_perimeter_extrusion_width": 0.45, "perimeter_extrusion_width": 0.45, "infill_extrusion_width": 0.45,
    "solid_infill_extrusion_width": 0.45, "top_infill_extrusion_width": 0.45, "first_layer_extrusion_width": 0.45,
    "perimeters": 100, "top_solid_layers": 0, "bottom_solid_layers": 0, "fill_density": "0%", "skirts": 0,
    "ensure_vertical_shell_thickness": 0, "solid_infill_below_area": 0, "bed_shape": "0x0,1000x0,1000x1000,0x1000",
    "max_print_height": 200, "gcode_flavor": "marlin", "temperature": 210, "bed_temperature": 60, "retract_length": 0.8,
    "start_gcode": "G28", "end_gcode": "M84",
}
PEERS = ("arachne", "classic")
LEAST_WIDTH, MOST_WIDTH = 0.2, 0.9  # what a nozzle of 0.4 mm lays down steadily: its half; 225 %


# ---- shapes: lists of polygons, each a list of rings of points in microns ------------------------------------------------

def ring(x, y, r, n=200, phase=0.0, stretch=1.0):
    return [(x + stretch * r * math.cos(phase + 2 * math.pi * i / n), y + r * math.sin(phase + 2 * math.pi * i / n)) for i in range(n)]


def box(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def star(points, outer, inner, phase=0.1):
    return [((outer if i % 2 == 0 else inner) * math.cos(math.pi * i / points + phase),
             (outer if i % 2 == 0 else inner) * math.sin(math.pi * i / points + phase)) for i in range(2 * points)]


def turned(polygons, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [[[(c * x - s * y, s * x + c * y) for x, y in r] for r in p] for p in polygons]


def band(middle, width):
    """A strip along a curve: width(i) at point i."""
    left, right = [], []
    for i, (x, y) in enumerate(middle):
        a, b = middle[max(0, i - 1)], middle[min(len(middle) - 1, i + 1)]
        d = math.hypot(b[0] - a[0], b[1] - a[1])
        n = (-(b[1] - a[1]) / d, (b[0] - a[0]) / d)
        h = width(i) / 2
        left.append((x + h * n[0], y + h * n[1]))
        right.append((x - h * n[0], y - h * n[1]))
    return right + left[::-1]


def sieve(gap):
    pitch = (20000 - gap) / 8
    return [[box(0, 0, 20000, 20000)] + [box(gap + i * pitch, gap + j * pitch, i * pitch + pitch, j * pitch + pitch)
                                         for i in range(8) for j in range(8)]]


LETTERS = {
    "A": [[(0, 0), (900, 0), (1900, 3000), (4600, 3000), (5600, 0), (6500, 0), (3700, 8000), (2800, 8000)],
          [(2200, 3800), (3250, 6900), (4300, 3800)]],
    "E": [[(0, 0), (5000, 0), (5000, 1100), (1200, 1100), (1200, 3600), (4300, 3600), (4300, 4700), (1200, 4700), (1200, 7000),
           (5000, 7000), (5000, 8100), (0, 8100)]],
    "M": [[(0, 0), (700, 0), (700, 6000), (3500, 1500), (4000, 1500), (6800, 6000), (6800, 0), (7500, 0), (7500, 8000),
           (6700, 8000), (3750, 3000), (800, 8000), (0, 8000)]],
    "W": [[(0, 8000), (2000, 0), (2900, 0), (4400, 5600), (5900, 0), (6800, 0), (8800, 8000), (7850, 8000), (6350, 1700),
           (4850, 7200), (3950, 7200), (2450, 1700), (950, 8000)]],
}


def letter_r():
    bowl = [(2800 + 2300 * math.cos(a), 5700 + 2300 * math.sin(a)) for a in (math.pi * (i / 40 - 0.5) for i in range(41))]
    eye = [(2700 + 1300 * math.cos(a), 5700 + 1300 * math.sin(a)) for a in (math.pi * (i / 30 - 0.5) for i in range(31))]
    return [[[(0, 0), (1100, 0), (1100, 3400), (2300, 3400), (4200, 0), (5400, 0), (3400, 3480)] + bowl[1:] + [(0, 8000)],
             eye + [(1000, 7000), (1000, 4400)]]]


def letter_s():
    top = [(3000 + 2000 * math.cos(a), 6000 + 2000 * math.sin(a)) for a in (0.4 + i * (1.5 * math.pi - 0.4) / 50 for i in range(51))]
    low = [(3000 + 2000 * math.cos(a), 2000 + 2000 * math.sin(a)) for a in (math.pi / 2 - i * (1.5 * math.pi - 0.4) / 50 for i in range(1, 51))]
    middle = top + low
    return [[band(middle, lambda i: 1250 - 650 * abs(2 * i / (len(middle) - 1) - 1))]]


def spiral():
    turns = [i / 600 * 6 * math.pi for i in range(600)]
    middle = [((1000 + t * 500) * math.cos(t), (1000 + t * 500) * math.sin(t)) for t in turns]
    return [[band(middle, lambda i: 300 + 500 * i / 600)]]


def gear(teeth=24):
    out = []
    for i in range(teeth):
        a = 2 * math.pi * i / teeth
        out += [(r * math.cos(a + d), r * math.sin(a + d)) for r, d in ((8000, -.07), (10000, -.04), (10000, .04), (8000, .07))]
    return [[out, ring(0, 0, 6500, 100)]]


def crossing(degrees, width, length, phase):
    """Arms of one width from one middle: `degrees` from each to the next."""
    half, a, out = width / 2, phase, []
    for turn in map(math.radians, degrees):
        for along, aside in ((length, -half), (length, half), (half / math.tan(turn / 2), half)):
            out.append((along * math.cos(a) - aside * math.sin(a), along * math.sin(a) + aside * math.cos(a)))
        a += turn
    return [[out]]


def holes(radius, count, gap, seed):
    """A disc with round holes thrown in at random, at least `gap` apart: necks of every width."""
    rng, placed = random.Random(seed), []
    for _ in range(count * 50):
        r = rng.uniform(500, 1800)
        a, d = rng.uniform(0, 2 * math.pi), math.sqrt(rng.random()) * (radius - r - gap)
        x, y = d * math.cos(a), d * math.sin(a)
        if all(math.hypot(x - p, y - q) > r + s + gap for p, q, s in placed):
            placed.append((x, y, r))
        if len(placed) == count:
            break
    return [[ring(0, 0, radius, 200)] + [ring(x, y, r, 48, r) for x, y, r in placed]]


def generated():
    ribs = (50, 100, 200, 300, 400, 600, 800, 1000, 1300)
    comb, at = [], 1000
    for width in ribs:
        comb += [(at, 3000), (at, 11000), (at + width, 11000), (at + width, 3000)]
        at += width + 1500
    rng = random.Random(5)
    blob = [((5000 + 1500 * math.sin(3 * t) + 900 * math.sin(7 * t + 1) + 400 * rng.uniform(-1, 1)) * math.cos(t),
             (5000 + 1500 * math.sin(3 * t) + 900 * math.sin(7 * t + 1) + 400 * rng.uniform(-1, 1)) * math.sin(t))
            for t in (2 * math.pi * i / 120 for i in range(120))]
    out = {
        "wedge60": [[[(0, 0), (60000, 1500), (0, 3000)]]],
        "wedge20": [[[(0, 0), (20000, 1500), (0, 3000)]]],
        "wedge5deg": [[[(0, -1310), (30000, 0), (0, 1310)]]],
        "wedge53deg": [[[(0, 0), (3000, 1500), (0, 3000)]]],
        "comb": [[[(0, 0), (at, 0), (at, 3000)] + comb[::-1] + [(0, 3000)]]],
        "ribs": [[box(i * 3000, 0, i * 3000 + w, 10000)] for i, w in enumerate(ribs)],
        "torus5": [[ring(0, 0, 3000, 200, 0, 5), ring(0, 0, 2000, 200, 0, 5)]],
        "starfat": [[star(8, 10000, 6500)]],
        "R": letter_r(), "S": letter_s(), "gear": gear(), "spiral": spiral(),
        "ring230": [[ring(0, 0, 8000, 300), ring(0, 0, 7770, 300)]],
        "ring800": [[ring(0, 0, 8000, 300), ring(0, 0, 7200, 300, .01)]],
        "crescent": [[ring(0, 0, 6000, 200), ring(700, 0, 5250, 200, .01)]],
        "circles": [[ring(0, 0, 3000, 100, .01)], [ring(6020, 0, 3000, 100, .01)]],
        "twoholes": [[ring(0, 0, 6000), ring(-1700, 0, 1680, 100), ring(1700, 0, 1680, 100, .02)]],
        "sieve300": sieve(300), "sieve500": sieve(500), "sieve900": sieve(900),
        "sieveround": [[ring(0, 0, 12000)] + [ring(i * 2900 + j % 2 * 700, j * 2700, 1150, 40) for i in range(-3, 4) for j in range(-3, 4)
                                              if math.hypot(i, j) < 3.6]],
        "holes": holes(9000, 30, 150, 3), "holesfine": holes(7000, 26, 60, 8),
        "T": [[[(0, 0), (8000, 0), (8000, 900), (4450, 900), (4450, 8000), (3550, 8000), (3550, 900), (0, 900)]]],
        "taperedT": [[[(0, 0), (9000, 0), (9000, 350), (4900, 1100), (4550, 8000), (4350, 8000), (3800, 1100), (0, 700)]]],
        "X": turned(crossing([90] * 4, 600, 5000, 0), 45), "X1000": crossing([90] * 4, 1000, 5000, .3), "X1800": crossing([90] * 4, 1800, 5000, .3),
        "X1000_50": crossing([50, 130] * 2, 1000, 5000, .3), "X1000_70": crossing([70, 110] * 2, 1000, 5000, .3), "star5x1000": crossing([72] * 5, 1000, 5000, .3),
        **{f"star{n}x{w}": crossing([360 / n] * n, w, 5000, .3) for n, w in ((5, 1800), (6, 1000), (8, 1800))},
        "Y": crossing([120] * 3, 600, 5000, .2), "Y1100": crossing([120] * 3, 1100, 5000, 1),
        "blob": [[blob]], "disc": [[ring(0, 0, 5000)]], "square20": [[box(0, 0, 20000, 20000)]],
        "square17": turned([[box(0, 0, 3700, 3700)]], 17), "rect": turned([[box(0, 0, 9000, 2050)]], 31),
        "hexagon": [[ring(0, 0, 700, 6)]], "pillar": [[ring(0, 0, 300, 40)]],
        "ell": turned([[[(0, 0), (7000, 0), (7000, 1500), (2300, 1500), (2300, 8000), (0, 8000)]]], 11),
        "dumbbell": [[[(side * (4000 - 1500 * math.cos(a)), -side * 1500 * math.sin(a)) for side in (1, -1)
                       for a in (0.25 + i * (2 * math.pi - 0.5) / 60 for i in range(61))]]],
    }
    for name, rings in LETTERS.items():
        out[name] = [rings]
    for points in range(3, 13):
        out[f"star{points:02d}"] = [[star(points, 10000, 2500)]]
    return out


def wkt(polygons):
    ring_text = lambda r: "(" + ", ".join(f"{round(x)} {round(y)}" for x, y in r + r[:1]) + ")"
    return "MULTIPOLYGON (" + ", ".join("(" + ", ".join(map(ring_text, p)) + ")" for p in polygons) + ")"


# ---- tools and slicers ------------------------------------------------------------------------------------------------

def say(text):
    print(f"shapes: {text}", file=sys.stderr, flush=True)


def find_tools(args):
    places = [args.tools, os.environ.get("WEFT_TOOLS"), ROOT.parent / "shared/tools", ROOT.parent / "shared/tools/fidelity"]
    places = [pathlib.Path(p) for p in places if p]
    libraries = {"fidelity": [], "shape2stl": ["-lpolyclipping", "-lgmp", "-lmpfr"]}
    out = {}
    for name in libraries:
        built = args.work / "bin" / name
        for place in places:
            if os.access(place / name, os.X_OK) and (place / name).is_file():
                out[name] = place / name
                break
            if (place / f"{name}.cpp").exists():
                if not built.exists():
                    built.parent.mkdir(parents=True, exist_ok=True)
                    subprocess.run(["g++", "-O2", "-std=c++17", "-o", str(built), str(place / f"{name}.cpp"), *libraries[name]], check=True)
                out[name] = built
                break
        else:
            sys.exit(f"shapes: ABSENT: neither {name} nor {name}.cpp in {', '.join(map(str, places)) or 'any folder'}; name their folder with --tools")
    return out


def bounds(stl):
    data = stl.read_bytes()
    count = struct.unpack_from("<I", data, 80)[0]
    xs, ys = [], []
    for i in range(count):
        f = struct.unpack_from("<9f", data, 84 + 50 * i + 12)
        xs += f[0::3]
        ys += f[1::3]
    return max(xs) - min(xs), max(ys) - min(ys)


def slice_weft(binary, stl, out):
    report = out.with_suffix(".report.json")
    settings = [w for k, v in WEFT.items() for w in ("-s", f"{k}={v}")]
    begin = time.monotonic()
    done = subprocess.run([str(binary), "slice", str(stl), "-o", str(out), "-q", "-j", "1", "--center", "500,500", *settings, "--report", str(report)],
                          capture_output=True, text=True, timeout=300, check=False)
    seconds = time.monotonic() - begin
    if done.returncode:
        raise RuntimeError(f"status {done.returncode}: {done.stderr.strip().splitlines()[-1:] or ''}")
    told = json.loads(report.read_text())
    return {"seconds": seconds, "walls_s": told.get("timings_ms", {}).get("walls", 0) / 1000}


def slice_prusa(generator, stl, out, work):
    ini = work / "prusa.ini"
    if not ini.exists():
        ini.write_text("".join(f"{k} = {v}\n" for k, v in PRUSA.items()))
    begin = time.monotonic()
    done = subprocess.run(["prusa-slicer", "-g", "--load", str(ini), "--perimeter-generator", generator, "--dont-arrange", "--center", "500,500",
                           "-o", str(out), str(stl)], capture_output=True, text=True, timeout=600, check=False)
    if done.returncode or not out.exists():
        raise RuntimeError((done.stderr or done.stdout).strip()[-200:])
    return {"seconds": time.monotonic() - begin}


def stated_widths(gcode):
    """Share of the length, %, whose stated width (;WIDTH:) is below or above what a nozzle lays down; the extremes."""
    width, x, y, least, most, total, odd = None, 0.0, 0.0, 1e9, 0.0, 0.0, 0.0
    number = re.compile(r"([XYE])(-?[\d.]+)")
    layers = 0
    with open(gcode, errors="replace") as lines:
        for line in lines:
            if line.startswith(";WIDTH:"):
                width = float(line[7:])
            elif line.startswith(";LAYER_CHANGE"):
                layers += 1
                if layers == 3:  # two layers tell it
                    break
            elif line.startswith(("G1 ", "G0 ")):
                told = dict(number.findall(line))
                u, v = float(told.get("X", x)), float(told.get("Y", y))
                d = math.hypot(u - x, v - y)
                x, y = u, v
                if d > 0 and width and float(told.get("E", 0)) > 0:
                    total += d
                    least, most = min(least, width), max(most, width)
                    odd += d if width < LEAST_WIDTH - 0.0015 or width > MOST_WIDTH + 0.0015 else 0
    return {"stated_odd_pct": 100 * odd / total, "stated_least": least, "stated_most": most} if total else {}


def measure(tools, stl, gcode, res, every=2):
    told = subprocess.run([str(tools["fidelity"]), str(stl), str(gcode), "--center", "500,500", "--mode", "solid", "--sample-every", str(every), "--res", f"{res:g}", "--json"],
                          capture_output=True, text=True, timeout=600, check=False)
    if told.returncode:
        raise RuntimeError("fidelity: " + told.stderr.strip()[:150])
    f = json.loads(told.stdout)
    out = {k: f[k] for k in ("underfill_pct", "overlap_pct", "outside_pct", "voids", "void_area_mm2", "surface_mean_mm", "surface_rms_mm", "surface_p95_mm",
                             "surface_missing_pct", "volume_ratio", "odd_width_pct", "least_width_mm", "most_width_mm", "travel_mm", "seconds_planned")}
    out["misfill_pct"] = f["underfill_pct"] + f["overlap_pct"] + f["outside_pct"]
    out["spread_mm"] = math.sqrt(max(0.0, f["surface_rms_mm"] ** 2 - f["surface_mean_mm"] ** 2))
    out["paths_per_mm"] = f["paths"] / max(1e-9, f["extrusion_mm"])
    out["layers"] = f["layers"]
    out.update(stated_widths(gcode))
    return out


def grid_of(stl):
    """Finer for small shapes: about 4 million cells, between 5 and 20 microns."""
    w, h = bounds(stl)
    return round(min(0.02, max(0.005, math.sqrt((w + 3) * (h + 3) / 4e6))), 4)


def one(name, source, args, tools, tag):
    """Slices and measures one shape with weft, and with the peers unless they are kept from before."""
    folder = args.work / "shapes"
    stl = folder / f"{name}.stl"
    text = source if isinstance(source, str) else source.read_text()
    key = hashlib.sha256(text.encode()).hexdigest()[:16]
    stamp = folder / f"{name}.key"
    if not stl.exists() or not stamp.exists() or stamp.read_text() != key:
        shape = folder / f"{name}.wkt"
        shape.write_text(text)
        done = subprocess.run([str(tools["shape2stl"]), str(shape), str(stl), f"{LAYERS * LAYER_MM:g}"], capture_output=True, text=True, check=False)
        if done.returncode:
            return name, {"weft": {"error": "no prism: " + done.stderr.strip()}}
        stamp.write_text(key)
    res = grid_of(stl)
    out = {}
    makers = {} if args.peers_only else {"weft": lambda g: slice_weft(args.weft, stl, g)}
    for peer in PEERS:
        makers[peer] = lambda g, peer=peer: slice_prusa(peer, stl, g, args.work)
    for tool, make in makers.items():
        kept = folder / f"{name}.{tool}.json"
        if tool != "weft" and kept.exists():
            saved = json.loads(kept.read_text())
            if saved.get("key") == [key, res]:
                out[tool] = saved
                continue
        if tool != "weft" and (args.no_peers or not args.have_prusa):
            continue
        gcode = args.work / (tag if tool == "weft" else "shapes") / f"{name}.{tool}.gcode"
        gcode.unlink(missing_ok=True)
        try:
            times = make(gcode)
            out[tool] = {**measure(tools, stl, gcode, res, LAYERS if args.quick else 2), **times, "key": [key, res]}
            out[tool]["seconds_per_layer"] = times["seconds"] / max(1, out[tool]["layers"])
        except (RuntimeError, subprocess.TimeoutExpired, OSError, ValueError) as problem:
            out[tool] = {"error": str(problem)[:200], "key": [key, res]}
        if tool != "weft":
            kept.write_text(json.dumps(out[tool]))
    return name, out


def further_figures(path):
    """Misfill of peers measured elsewhere, from a table whose rows begin `| NNN |` and whose cells begin `misfill (…)`."""
    out = {}
    if path and pathlib.Path(path).exists():
        for line in pathlib.Path(path).read_text().splitlines():
            row = re.match(r"\| (\d{3}) \|(.*)\|", line)
            if row:
                cells = [re.match(r"\s*([\d.]+) \(", c) for c in row.group(2).split("|")]
                out[row.group(1)] = [float(c.group(1)) for c in cells if c]
    return out


# ---- tables ---------------------------------------------------------------------------------------------------------------

COLUMNS = (("misfill", "misfill_pct", 2), ("under", "underfill_pct", 2), ("over", "overlap_pct", 2), ("out", "outside_pct", 2),
           ("missing", "surface_missing_pct", 1), ("rms", "surface_rms_mm", 3), ("p95", "surface_p95_mm", 3), ("spread", "spread_mm", 3),
           ("volume", "volume_ratio", 3), ("voids", "voids", 0), ("odd%", "odd_width_pct", 1), ("stated odd%", "stated_odd_pct", 1),
           ("paths/mm", "paths_per_mm", 3), ("s/layer", "seconds_per_layer", 3))
WORST = {"volume_ratio": lambda v: max(v, key=lambda x: abs(x - 1))}


def best_peer(run, name):
    found = [m["misfill_pct"] for t, m in run["shapes"][name].items() if t != "weft" and "misfill_pct" in m]
    found += run.get("further", {}).get(name, [])
    return min(found) if found else None


def row(cells):
    return "| " + " | ".join(cells) + " |"


def print_table(run):
    shapes = run["shapes"]
    tools = [t for t in ("weft",) + PEERS if any(t in s for s in shapes.values())]
    print(row(["shape", "slicer"] + [c[0] for c in COLUMNS]))
    print("|---" * (2 + len(COLUMNS)) + "|")
    cell = lambda m, k, d: f"{m[k]:.{d}f}" if m.get(k) is not None else "–"
    for name in sorted(shapes):
        for tool in tools:
            m = shapes[name].get(tool)
            if m is None:
                continue
            print(row([name, tool] + ([cell(m, k, d) for _, k, d in COLUMNS] if "error" not in m else [m["error"][:60]] + [""] * (len(COLUMNS) - 1))))
    print("\nMedian / worst over the shapes that every slicer answered:")
    common = [n for n in shapes if all("misfill_pct" in shapes[n].get(t, {}) for t in tools)]
    groups = [("corpus", [n for n in common if n.isdigit()]), ("generated", [n for n in common if not n.isdigit()]), ("all", common)]
    print(row(["shapes", "slicer"] + [c[0] for c in COLUMNS]))
    print("|---" * (2 + len(COLUMNS)) + "|")
    for group, names in groups:
        for tool in tools:
            cells = []
            for _, k, d in COLUMNS:
                values = [shapes[n][tool][k] for n in names if shapes[n][tool].get(k) is not None]
                cells.append(f"{statistics.median(values):.{d}f} / {WORST.get(k, max)(values):.{d}f}" if values else "–")
            print(row([f"{group} ({len(names)})", tool] + cells))
    check_goals(run)


def check_goals(run):
    """misfill no worse than the best peer on every shape, half of it in the median; volume within 1 %; spread of the edge 0.015 mm."""
    shapes = run["shapes"]
    weft = {n: s["weft"] for n, s in shapes.items() if "misfill_pct" in s.get("weft", {})}
    print("\nGoals")
    for n, s in sorted(shapes.items()):
        if "error" in s.get("weft", {}):
            print(f"  FAILED  {n}: {s['weft']['error']}")
    pairs = {n: (m["misfill_pct"], best_peer(run, n)) for n, m in weft.items() if best_peer(run, n) is not None}
    for group, names in (("corpus", [n for n in pairs if n.isdigit()]), ("generated", [n for n in pairs if not n.isdigit()]), ("all", list(pairs))):
        if names:
            mine, best = statistics.median(pairs[n][0] for n in names), statistics.median(pairs[n][1] for n in names)
            print(f"  misfill, {group} ({len(names)}): median {mine:.3f}, best peer of each shape {best:.3f}: ratio {mine / best:.2f} (goal 0.50); "
                  f"worst {max(pairs[n][0] for n in names):.2f} against {max(pairs[n][1] for n in names):.2f}")
    verdict = lambda bad: "met" if not bad else f"NOT MET on {len(bad)}"
    worse = sorted((n for n in pairs if pairs[n][0] > pairs[n][1] + 0.005), key=lambda n: pairs[n][1] - pairs[n][0])
    print(f"  misfill no worse than the best peer: {verdict(worse)}" + "".join(f"\n      {n}: {pairs[n][0]:.2f} against {pairs[n][1]:.2f}" for n in worse))
    half = sorted((n for n in pairs if n not in worse and pairs[n][0] > pairs[n][1] / 2), key=lambda n: -pairs[n][0] / max(1e-9, pairs[n][1]))
    print("  more than half of the best peer: " + ", ".join(f"{n} {pairs[n][0]:.2f}/{pairs[n][1]:.2f}" for n in half))
    volume = sorted((n for n in weft if abs(weft[n]["volume_ratio"] - 1) > 0.01), key=lambda n: -abs(weft[n]["volume_ratio"] - 1))
    print(f"  volume within 1 %: {verdict(volume)} " + ", ".join(f"{n} {weft[n]['volume_ratio']:.3f}" for n in volume))
    spread = sorted((n for n in weft if weft[n]["spread_mm"] > 0.015), key=lambda n: -weft[n]["spread_mm"])
    peers = lambda n: min((m["spread_mm"] for t, m in shapes[n].items() if t != "weft" and "spread_mm" in m), default=float("nan"))
    print(f"  spread of the edge at most 0.015 mm: {verdict(spread)} " + ", ".join(f"{n} {weft[n]['spread_mm']:.3f} (peer {peers(n):.3f})" for n in spread))
    slow = sorted((n for n in weft if weft[n]["seconds_per_layer"] > 1), key=lambda n: -weft[n]["seconds_per_layer"])
    print(f"  a layer below 1 s: {verdict(slow)} " + ", ".join(f"{n} {weft[n]['seconds_per_layer']:.1f}" for n in slow))
    wide = sorted((n for n in weft if weft[n].get("stated_odd_pct", 0) > 0), key=lambda n: -weft[n]["stated_odd_pct"])
    print(f"  stated widths within {LEAST_WIDTH} … {MOST_WIDTH} mm: {verdict(wide)} "
          + ", ".join(f"{n} {weft[n]['stated_odd_pct']:.1f} % ({weft[n]['stated_least']:.2f}…{weft[n]['stated_most']:.2f})" for n in wide))


def compare(first, second):
    a, b = json.loads(first.read_text()), json.loads(second.read_text())
    names = [n for n in a["shapes"] if "weft" in a["shapes"][n] and "weft" in b["shapes"].get(n, {})]
    limits = {"misfill_pct": 0.05, "surface_missing_pct": 0.2, "spread_mm": 0.002, "voids": 0, "volume_error": 0.002, "most_width_mm": 0.02, "seconds_per_layer": 0.3}
    for n in names:
        x, y = a["shapes"][n]["weft"], b["shapes"][n]["weft"]
        if "error" in x or "error" in y:
            if ("error" in x) != ("error" in y):
                print(f"{n}: {x.get('error', 'ok')} -> {y.get('error', 'ok')}")
            continue
        for m in (x, y):
            m["volume_error"] = abs(m["volume_ratio"] - 1)
    names = [n for n in names if "error" not in a["shapes"][n]["weft"] and "error" not in b["shapes"][n]["weft"]]
    if not names:
        sys.exit("shapes: no shape is measured in both")
    for key, least in limits.items():
        moved = sorted(((b["shapes"][n]["weft"][key] - a["shapes"][n]["weft"][key], n) for n in names), key=lambda m: m[0])
        for word, some in (("better", [m for m in moved if m[0] < -least]), ("WORSE", [m for m in reversed(moved) if m[0] > least])):
            if some:
                print(f"{key} {word}: " + ", ".join(f"{n} {a['shapes'][n]['weft'][key]:.3g}->{b['shapes'][n]['weft'][key]:.3g}" for _, n in some))
    for key in ("misfill_pct", "underfill_pct", "overlap_pct", "outside_pct", "spread_mm", "surface_missing_pct"):
        x, y = ([r["shapes"][n]["weft"][key] for n in names] for r in (a, b))
        print(f"{key} over {len(names)}: median {statistics.median(x):.4f} -> {statistics.median(y):.4f}, mean {statistics.mean(x):.4f} -> {statistics.mean(y):.4f}, worst {max(x):.3f} -> {max(y):.3f}")


def run(args):
    args.work.mkdir(parents=True, exist_ok=True)
    args.weft = args.weft.resolve()
    if not args.peers_only and not os.access(args.weft, os.X_OK):
        sys.exit(f"shapes: ABSENT: {args.weft}; name the program with --weft")
    tag = f"weft-{os.getpid()}"
    for folder in ("shapes", tag):
        (args.work / folder).mkdir(exist_ok=True)
    tools = find_tools(args)
    args.have_prusa = shutil.which("prusa-slicer") is not None
    if not args.have_prusa and not args.no_peers:
        say("ABSENT: prusa-slicer; only peers kept from before are shown")
    sources = {n: wkt(p) for n, p in generated().items()}
    shapes = next((pathlib.Path(p) for p in (args.shapes, os.environ.get("WEFT_SHAPES"), ROOT.parent / "shared/corpus/shapes") if p and pathlib.Path(p).is_dir()), None)
    if shapes:
        sources.update({p.stem: p for p in sorted(shapes.glob("*.wkt"))})
    else:
        say("ABSENT: a folder of *.wkt shapes (--shapes); only the generated shapes are measured")
    if args.names:
        unknown = [n for n in args.names if n not in sources]
        if unknown:
            sys.exit(f"shapes: no such shape: {', '.join(unknown)}")
        sources = {n: sources[n] for n in args.names}
    if args.quick and not args.names:  # near copies of 011, 013, 003 and 007, and the largest
        sources = {n: s for n, s in sources.items() if n not in ("015", "033", "037", "017", "019", "039", "011", "025", "059")}
    size = lambda n: -len(sources[n]) if isinstance(sources[n], str) else -sources[n].stat().st_size
    result = {"weft": str(args.weft), "further": further_figures(args.figures), "shapes": {}}
    if args.figures and not result["further"]:
        say(f"ABSENT: figures in {args.figures}")
    begin = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for name, out in pool.map(lambda n: one(n, sources[n], args, tools, tag), sorted(sources, key=size)):
            result["shapes"][name] = out
            if args.verbose:
                say(f"{name}: " + ", ".join(f"{t} {m['misfill_pct']:.2f}" if "misfill_pct" in m else f"{t} {m['error'][:60]}" for t, m in out.items()))
    if not args.keep:
        shutil.rmtree(args.work / tag, ignore_errors=True)
    else:
        say(f"G-code is kept in {args.work / tag}")
    if args.output:
        args.output.write_text(json.dumps(result, indent=1))
    if not args.peers_only:
        print_table(result) if args.table else check_goals(result)
    say(f"{len(result['shapes'])} shapes in {time.monotonic() - begin:.0f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    r = verbs.add_parser("run")
    r.add_argument("names", nargs="*")
    r.add_argument("--weft", type=pathlib.Path, default=ROOT / "build/release/app/weft")
    r.add_argument("--shapes")
    r.add_argument("--tools", type=pathlib.Path)
    r.add_argument("--work", type=pathlib.Path, default=pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "weft-shapes")
    r.add_argument("--figures", default=ROOT.parent / "shared/tools/peers-on-shapes.md", help="a table of misfill of further peers")
    r.add_argument("-o", "--output", type=pathlib.Path)
    r.add_argument("--jobs", type=int, default=2)
    r.add_argument("--no-peers", action="store_true", help="only peers that were kept from before")
    r.add_argument("--peers-only", action="store_true")
    r.add_argument("--quick", action="store_true", help="without shapes that are nearly others or very large; one layer of each is measured")
    r.add_argument("--keep", action="store_true", help="keep weft's G-code")
    r.add_argument("--no-table", dest="table", action="store_false", help="only the goals")
    r.add_argument("-v", "--verbose", action="store_true")
    verbs.add_parser("list")
    t = verbs.add_parser("table")
    t.add_argument("run", type=pathlib.Path)
    c = verbs.add_parser("compare")
    c.add_argument("first", type=pathlib.Path)
    c.add_argument("second", type=pathlib.Path)
    args = parser.parse_args()
    if args.verb == "run":
        run(args)
    elif args.verb == "list":
        print("\n".join(generated()))
    elif args.verb == "table":
        print_table(json.loads(args.run.read_text()))
    else:
        compare(args.first, args.second)


if __name__ == "__main__":
    main()
