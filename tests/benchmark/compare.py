#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Times weft beside the slicers that Debian packages, on the same models at comparable settings.

    python3 tests/benchmark/compare.py --weft build/release/app/weft [--runs 5] [--peers prusa,cura,slic3r] [MODEL.stl ...]

Without models the generated ones are used: a plate of parts, a lattice of many islands, a fine mesh, a tall part.
Peers that are missing are installed with apt-get (as root), or left out with a word. Commands run in turn, A B C A B C,
so that a machine that slows down slows all of them; the table shows medians and ratios to weft. Standard library only.
"""
import argparse
import os
import pathlib
import resource
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent

# One set of settings, in three spellings: layer 0.2, three walls of 0.45, four solid layers, 20 % grid, one skirt loop.
PRUSA = {
    "layer_height": "0.2", "first_layer_height": "0.2", "nozzle_diameter": "0.4", "filament_diameter": "1.75",
    "extrusion_width": "0.45", "external_perimeter_extrusion_width": "0.45", "perimeter_extrusion_width": "0.45",
    "infill_extrusion_width": "0.45", "solid_infill_extrusion_width": "0.45", "top_infill_extrusion_width": "0.45",
    "first_layer_extrusion_width": "0.45", "perimeters": "3", "top_solid_layers": "4", "bottom_solid_layers": "4",
    "fill_density": "20%", "fill_pattern": "grid", "skirts": "1",
    "bed_shape": "-500x-500,500x-500,500x500,-500x500", "max_print_height": "1000", "gcode_flavor": "marlin",
    "temperature": "210", "bed_temperature": "60", "retract_length": "0.8", "start_gcode": "G28", "end_gcode": "M84",
}
WEFT = {
    "layer_height": "0.2", "nozzle_diameter": "0.4", "wall_line_width_0": "0.45", "wall_line_width_x": "0.45",
    "infill_line_width": "0.45", "skin_line_width": "0.45", "top_skin_line_width": "0.45", "wall_line_count": "3",
    "top_layers": "4", "bottom_layers": "4", "infill_sparse_density": "20", "infill_pattern": "grid", "skirt_line_count": "1",
    "machine_width": "1000", "machine_depth": "1000", "machine_height": "1000", "machine_center_is_zero": "true",
    "retraction_amount": "0.8",
}
CURA = {
    "machine_width": "1000", "machine_depth": "1000", "machine_height": "1000", "center_object": "true",
    "machine_nozzle_size": "0.4", "layer_height": "0.2", "layer_height_0": "0.2", "wall_line_count": "3",
    "line_width": "0.45", "wall_line_width": "0.45", "wall_line_width_0": "0.45", "wall_line_width_x": "0.45",
    "infill_line_width": "0.45", "skin_line_width": "0.45", "infill_line_distance": "4.5", "infill_pattern": "grid",
    "top_layers": "4", "bottom_layers": "4", "initial_bottom_layers": "4", "roofing_layer_count": "0",
    "adhesion_type": "skirt", "retraction_combing": "all", "speed_print": "60", "speed_travel": "130",
    "material_print_temperature": "210", "material_print_temperature_layer_0": "215", "retraction_amount": "0.8",
    "retraction_speed": "40", "min_skin_width_for_expansion": "0",
}


# ---- models ---------------------------------------------------------------------------------------------------------

def write_stl(path, triangles):
    with open(path, "wb") as out:
        out.write(b"\0" * 80 + struct.pack("<I", len(triangles)))
        for t in triangles:
            out.write(struct.pack("<12fH", 0, 0, 0, *t[0], *t[1], *t[2], 0))


def write_model(path, make):
    """Writes a generated model in a process of its own: what a child may have held counts as its peak memory, and a child
    begins as a copy of its parent."""
    pid = os.fork()
    if pid == 0:
        write_stl(path, make())
        os._exit(0)
    os.waitpid(pid, 0)


def prism(ring, z0, z1):
    """A prism over a convex ring, counter-clockwise."""
    out, n = [], len(ring)
    for i in range(n):
        a, b = ring[i], ring[(i + 1) % n]
        out.append(((*a, z0), (*b, z0), (*b, z1)))
        out.append(((*a, z0), (*b, z1), (*a, z1)))
    for i in range(1, n - 1):
        out.append(((*ring[0], z1), (*ring[i], z1), (*ring[i + 1], z1)))
        out.append(((*ring[0], z0), (*ring[i + 1], z0), (*ring[i], z0)))
    return out


def circle(x, y, r, n):
    import math
    return [(x + r * math.cos(2 * math.pi * i / n), y + r * math.sin(2 * math.pi * i / n)) for i in range(n)]


def sphere(r, n):
    import math
    ring = [[(r * math.sin(math.pi * i / n) * math.cos(math.pi * j / n), r * math.sin(math.pi * i / n) * math.sin(math.pi * j / n),
              r - r * math.cos(math.pi * i / n)) for j in range(2 * n)] for i in range(n + 1)]
    out = []
    for i in range(n):
        for j in range(2 * n):
            a, b, c, d = ring[i][j], ring[i][(j + 1) % (2 * n)], ring[i + 1][j], ring[i + 1][(j + 1) % (2 * n)]
            if i > 0:
                out.append((a, b, d))
            if i < n - 1:
                out.append((a, d, c))
    return out


def generated(folder, size):
    models = {
        "plate of 50 parts": lambda: [t for i in range(50) for t in prism(circle(30 * (i % 10), 30 * (i // 10), 12, 60), 0, 10)],
        "5,000 islands a layer": lambda: [t for i in range(5000) for t in prism(circle(3 * (i % 100), 3 * (i // 100), 1.2, 8), 0, 2)],
        "fine mesh": lambda: sphere(30, 1119 if size == "full" else 350),
        "2,000 layers": lambda: prism(circle(0, 0, 15, 40), 0, 400),
    }
    out = []
    for name, make in models.items():
        path = folder / (name.replace(" ", "-").replace(",", "") + ".stl")
        write_model(path, make)
        out.append(path)
    return out


# ---- commands -------------------------------------------------------------------------------------------------------

def install(package):
    return subprocess.run(["apt-get", "install", "-y", "-qq", "--no-install-recommends", package], stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL, check=False).returncode == 0


def cura_definitions():
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "weft-peers" / "cura"
    resources = cache / "usr/share/cura/resources"
    if not (resources / "definitions/fdmprinter.def.json").exists():
        cache.mkdir(parents=True, exist_ok=True)
        subprocess.run("apt-get download -qq cura && dpkg -x cura_*.deb . && rm cura_*.deb", shell=True, cwd=cache, check=True)
    return resources


def commands(args, folder):
    """name -> function of (model, output) that gives (argv, environment)."""
    def pairs(table, sep="="):
        return [f"{k}{sep}{v}" for k, v in table.items()]
    out = {"weft": lambda m, o: ([args.weft, "slice", str(m), "-o", str(o), "-q", "--center", "0,0"] + [w for p in pairs(WEFT) for w in ("-s", p)], {})}
    ini = folder / "peer.ini"
    ini.write_text("".join(f"{k} = {v}\n" for k, v in PRUSA.items()))
    for peer in filter(None, args.peers.split(",")):
        binary, package = {"prusa": ("prusa-slicer", "prusa-slicer"), "slic3r": ("slic3r", "slic3r"), "cura": ("CuraEngine", "cura-engine")}[peer]
        if not shutil.which(binary) and not install(package):
            print(f"compare: {peer} is left out: {package} cannot be installed", file=sys.stderr)
            continue
        if peer == "prusa":
            out["PrusaSlicer"] = lambda m, o: (["prusa-slicer", "-g", "--load", str(ini), "--dont-arrange", "--center", "0,0", "-o", str(o), str(m)], {})
        elif peer == "slic3r":
            out["Slic3r"] = lambda m, o: (["slic3r", "--load", str(ini), "--print-center", "0,0", "-o", str(o), str(m)], {})
        else:
            r = cura_definitions()
            env = {"CURA_ENGINE_SEARCH_PATH": f"{r}/definitions:{r}/extruders"}
            settings = [w for p in pairs(CURA) for w in ("-s", p)]
            out["CuraEngine"] = lambda m, o: (["CuraEngine", "slice", "-j", f"{r}/definitions/fdmprinter.def.json", *settings, "-e0", "-s", "extruder_nr=0",
                                               "-s", "material_diameter=1.75", "-l", str(m), "-o", str(o)], env)
    return out


def measured(argv, env, timeout):
    """Wall s, CPU s, peak MB of one run; in words why there are none, when it failed or took too long."""
    import time
    begin = time.monotonic()
    process = subprocess.Popen(argv, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, **env})
    try:
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() - begin > timeout:
                process.kill()
                _, _, usage = os.wait4(process.pid, 0)
                return f"stopped after {timeout:g} s of wall time, {usage.ru_utime + usage.ru_stime:.0f} s of CPU time, {usage.ru_maxrss / 1024:.0f} MB"
            time.sleep(0.002)
    finally:
        process.returncode = 0
    wall = time.monotonic() - begin
    if status != 0:
        return f"failed with signal {status & 127}" if status & 127 else f"failed with status {status >> 8}"
    return wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*")
    parser.add_argument("--weft", default="build/release/app/weft")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--peers", default="prusa,cura,slic3r", help="comma separated; empty: weft alone")
    parser.add_argument("--timeout", type=float, default=300, help="seconds a run may take")
    parser.add_argument("--size", choices=["small", "full"], default="small", help="of the generated fine mesh: 0.5 or 5 million triangles")
    args = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with tempfile.TemporaryDirectory(prefix="weft-compare-") as name:
        folder = pathlib.Path(name)
        models = [pathlib.Path(m) for m in args.models] or generated(folder, args.size)
        tools = commands(args, folder)
        print(f"{args.runs} runs in turn, medians; {os.cpu_count()} cores\n")
        print("| model | slicer | wall s | × weft | CPU s | × weft | peak MB | G-code MB |\n|---|---|---|---|---|---|---|---|")
        for model in models:
            samples = {tool: [] for tool in tools}
            sizes, why = {}, {}
            for _ in range(args.runs):
                for tool, command in tools.items():
                    out = folder / f"{tool}.gcode"
                    out.unlink(missing_ok=True)
                    sample = measured(*command(model, out), args.timeout)
                    if isinstance(sample, str) or not out.exists():
                        why[tool] = sample if isinstance(sample, str) else "wrote nothing"
                    else:
                        samples[tool].append(sample)
                        sizes[tool] = out.stat().st_size / 1e6
            median = {t: [statistics.median(x) for x in zip(*s)] for t, s in samples.items() if s}
            base = median.get("weft")
            for tool in tools:
                if tool not in median:
                    print(f"| {model.stem} | {tool} | {why[tool]} | | | | | |", flush=True)
                    continue
                wall, cpu, memory = median[tool]
                ratio = (lambda v, i: f"{v / base[i]:.2f}") if base else (lambda v, i: "")
                print(f"| {model.stem} | {tool} | {wall:.2f} | {ratio(wall, 0)} | {cpu:.2f} | {ratio(cpu, 1)} | {memory:.1f} | {sizes[tool]:.1f} |", flush=True)


if __name__ == "__main__":
    main()
