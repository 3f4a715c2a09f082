#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Slices one model with PrusaSlicer and with weft from the same ini, once a key, and puts what each key did side by side.

usage: keys_beside_prusaslicer.py --weft PROGRAM [--only KEY...]
Needs prusa-slicer (Debian: prusa-slicer). A row: key = value, then for both programs how the print differs from the same
print without the key. `=` is "nothing changed".
"""
import argparse, math, os, re, struct, subprocess, sys, tempfile

BASE = """layer_height = 0.2
first_layer_height = 0.2
nozzle_diameter = 0.4
filament_diameter = 1.75
extrusion_width = 0.45
first_layer_extrusion_width = 0.45
perimeter_extrusion_width = 0.45
external_perimeter_extrusion_width = 0.45
infill_extrusion_width = 0.45
solid_infill_extrusion_width = 0.45
top_infill_extrusion_width = 0.45
perimeters = 2
top_solid_layers = 3
bottom_solid_layers = 3
fill_density = 20%
fill_pattern = rectilinear
skirts = 1
bed_shape = 0x0,250x0,250x210,0x210
max_print_height = 210
gcode_flavor = marlin2
use_relative_e_distances = 1
before_layer_gcode = G92 E0
retract_length = 1
retract_before_travel = 1
retract_lift = 0
wipe = 0
perimeter_speed = 50
external_perimeter_speed = 40
infill_speed = 60
solid_infill_speed = 55
top_solid_infill_speed = 35
travel_speed = 120
first_layer_speed = 100%
cooling = 0
only_retract_when_crossing_perimeters = 0
solid_infill_below_area = 0
retract_layer_change = 0
slowdown_below_layer_time = 0
elefant_foot_compensation = 0
temperature = 210
first_layer_temperature = 210
start_gcode = G28
end_gcode = M84
"""

# key, value, and what else must be said for it to matter
KEYS = [
    ("z_offset", "0.15", ""),
    ("xy_size_compensation", "0.1", ""),
    ("xy_size_compensation", "-0.1", ""),
    ("elefant_foot_compensation", "0.2", ""),
    ("use_volumetric_e", "1", ""),
    ("extra_perimeters", "0", ""),
    ("overhangs", "0", ""),
    ("thin_walls", "0", "perimeter_generator = classic"),
    ("top_fill_pattern", "rectilinear", ""),
    ("top_fill_pattern", "monotoniclines", ""),
    ("top_fill_pattern", "alignedrectilinear", ""),
    ("bottom_fill_pattern", "alignedrectilinear", ""),
    ("solid_infill_every_layers", "5", ""),
    ("infill_only_where_needed", "1", ""),
    ("slicing_mode", "even_odd", ""),
    ("slice_closing_radius", "0", ""),
    ("infill_first", "1", ""),
    ("infill_every_layers", "2", ""),
    ("skirt_height", "0", ""),
    ("skirt_height", "3", ""),
    ("retract_layer_change", "1", ""),
    ("only_retract_when_crossing_perimeters", "1", ""),
    ("use_firmware_retraction", "1", "retract_length = 0"),
    ("infill_speed", "0", "max_print_speed = 90"),
    ("perimeter_speed", "0", "max_print_speed = 70"),
    ("infill_speed", "0", "max_print_speed = 90\nmax_volumetric_speed = 4"),
    ("slowdown_below_layer_time", "20", "cooling = 1"),
    ("default_acceleration", "900", ""),
    ("first_layer_acceleration", "300", "default_acceleration = 900"),
    ("perimeter_acceleration", "600", "default_acceleration = 900"),
    ("infill_acceleration", "1200", "default_acceleration = 900"),
    ("bridge_acceleration", "500", "default_acceleration = 900"),
    ("gcode_flavor", "no-extrusion", "use_relative_e_distances = 0\nbefore_layer_gcode = "),
    ("seam_position", "nearest", ""),
    ("seam_position", "rear", ""),
    ("perimeters", "4", ""),
    ("fill_density", "40%", ""),
    ("extrusion_multiplier", "0.95", ""),
    ("external_perimeters_first", "1", ""),
    ("brim_width", "3", ""),
    ("retract_length", "2.5", ""),
    ("retract_lift", "0.3", ""),
    ("top_solid_layers", "6", ""),
    ("bridge_speed", "25", ""),
    ("bridge_flow_ratio", "0.8", ""),
    ("first_layer_speed", "15", ""),
    ("small_perimeter_speed", "12", ""),
    ("first_layer_extrusion_width", "0.6", ""),
]


def triangles_of_box(a, b):
    x0, y0, z0 = a
    x1, y1, z1 = b
    p = [(x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0), (x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)]
    for q in ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):
        yield p[q[0]], p[q[1]], p[q[2]]
        yield p[q[0]], p[q[2]], p[q[3]]


def triangles_of_roof(a, b, height):
    """A pyramid on the bed."""
    p = [(a[0], a[1], 0), (b[0], a[1], 0), (b[0], b[1], 0), (a[0], b[1], 0)]
    top = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2, height)
    yield p[0], p[3], p[2]
    yield p[0], p[2], p[1]
    for i in range(4):
        yield p[i], p[(i + 1) % 4], top


def write_model(path):
    """A block of 30 x 20 x 6 mm with a pin of 3 mm on it, a rib of 0.3 mm, and a beam over a gap of 10 mm; a roof of 45°,
    and one of 11°."""
    boxes = [((0, 0, 0), (30, 20, 6)), ((4, 4, 6), (7, 7, 9)), ((12, 2, 6), (12.3, 18, 8)),
             ((34, 0, 0), (38, 20, 8)), ((48, 0, 0), (52, 20, 8)), ((34, 0, 8), (52, 20, 10))]
    faces = [t for b in boxes for t in triangles_of_box(*b)]
    faces += [t for roof in (((0, 24), (24, 48), 12), ((30, 24), (60, 54), 3)) for t in triangles_of_roof(*roof)]
    with open(path, "wb") as f:
        f.write(b"\0" * 80 + struct.pack("<I", len(faces)))
        for t in faces:
            f.write(struct.pack("<12fH", 0, 0, 0, *[c for p in t for c in p], 0))


def facts_of(path):
    """What a print is, by its G-code."""
    at = dict(X=0.0, Y=0.0, Z=0.0, E=0.0)
    relative, kind, speed, volume = True, "", 0.0, 0.0
    layer, seen = -1, {}
    outer = []  # of each layer: the lines of outer walls
    facts = {"retractions": 0, "unretractions": 0, "firmware": 0, "accelerations": set(), "order": []}
    e_sum, top_z, lines, lengths, speeds = 0.0, 0.0, {}, {}, {}
    layers = {}
    unretracted = 0
    for line in open(path, errors="replace"):
        if line.startswith(";TYPE:"):
            kind = line[6:].strip()
            if layer >= 0 and (not facts["order"] or facts["order"][-1] != (layer, kind)):
                facts["order"].append((layer, kind))
        elif line.startswith(";LAYER_CHANGE"):
            layer += 1
            outer.append([])
        word = line.split(";")[0].split()
        if not word:
            continue
        if word[0] == "M83":
            relative = True
        if word[0] == "M82":
            relative = False
        if word[0] in ("G10", "G11"):
            facts["firmware"] += 1
        if word[0] == "M204":
            facts["accelerations"].update(w for w in word[1:] if w[0] in "SP")
        if word[0] == "G92":
            for w in word[1:]:
                at[w[0]] = float(w[1:])
        if word[0] not in ("G0", "G1"):
            continue
        new = {w[0]: float(w[1:]) for w in word[1:] if len(w) > 1 and w[0] in "XYZEF"}
        speed = new.get("F", speed * 60) / 60
        de = 0.0
        if "E" in new:
            de = new["E"] if relative else new["E"] - at["E"]
            at["E"] = 0 if relative else new["E"]
        x, y = new.get("X", at["X"]), new.get("Y", at["Y"])
        length = math.hypot(x - at["X"], y - at["Y"])
        if "Z" in new:
            at["Z"] = new["Z"]
        if length > 0 and (de > 0 or facts.get("none")) and layer >= 0:
            e_sum += de
            top_z = max(top_z, at["Z"])
            lines[kind] = lines.get(kind, 0) + 1
            lengths[kind] = lengths.get(kind, 0) + length
            layers.setdefault(kind, set()).add(layer)
            s = speeds.setdefault(kind, {})
            s[round(speed, 1)] = s.get(round(speed, 1), 0) + length
            if kind == "External perimeter":
                outer[layer].append((at["X"], at["Y"], x, y))
        elif de < 0 and length == 0:
            facts["retractions"] += 1
        at["X"], at["Y"] = x, y
    facts["E"] = e_sum
    facts["top z"] = top_z
    facts["first z"] = None
    for l in (0, 1):
        straight = [s for s in (outer[l] if l < len(outer) else []) if abs(s[0] - s[2]) < 2.5e-3 and abs(s[1] - s[3]) > 8]
        if straight:
            facts[f"left wall, layer {l}"] = min(s[0] for s in straight)
    for k, l in lengths.items():
        facts[f"mm {k}"] = l
    for k, s in speeds.items():
        facts[f"mm/s {k}"] = max(s.items(), key=lambda i: i[1])[0]
    for k, l in layers.items():
        facts[f"layers {k}"] = len(l)
    first = [k for l, k in facts["order"] if l == 8]
    facts["order of layer 8"] = " ".join("".join(w[0] for w in k.split()) for k in first[:6])
    facts["accelerations"] = " ".join(sorted(facts["accelerations"])) or "none"
    del facts["order"]
    return facts


def difference(base, now):
    out = []
    for key in list(base) + [k for k in now if k not in base]:
        a, b = base.get(key), now.get(key)
        if a == b:
            continue
        if isinstance(a, (int, float)) and isinstance(b, (int, float)):
            if key.startswith(("left", "top z")):
                if abs(a - b) > 0.002:
                    out.append(f"{key} {b - a:+.3f}")
            elif a == 0 or abs(b / a - 1) > 0.01:
                out.append(f"{key} {a:.5g} -> {b:.5g}")
        else:
            out.append(f"{key} {a} -> {b}")
    return "; ".join(out) or "="


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--weft", required=True)
    options.add_argument("--only", nargs="*")
    o = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        model = os.path.join(folder, "model.stl")
        write_model(model)

        def sliced(program, text):
            ini, out = os.path.join(folder, "now.ini"), os.path.join(folder, "now.gcode")
            lines = {}
            for l in text.splitlines():  # a key twice is an error
                if "=" in l:
                    lines[l.split("=")[0].strip()] = l
            with open(ini, "w") as f:
                f.write("# generated by PrusaSlicer 2.5.0 on 2022-01-01\n" + "\n".join(lines.values()) + "\n")
            if os.path.exists(out):
                os.remove(out)
            if program == "weft":
                words = [o.weft, "slice", model, "-p", ini, "--center", "125,105", "-o", out]
            else:
                words = ["prusa-slicer", "-g", "--load", ini, "--dont-arrange", "--center", "125,105", "-o", out, model]
            done = subprocess.run(words, capture_output=True, text=True)
            if not os.path.exists(out):
                return "refused: " + (done.stderr.strip().splitlines() or ["?"])[-1][-120:]
            return facts_of(out)

        bases = {}
        for key, value, also in KEYS:
            if o.only and key not in o.only:
                continue
            print(f"{key} = {value}" + (f"  ({also.strip()})".replace("\n", ", ") if also else ""))
            for program in ("PrusaSlicer", "weft"):
                base = BASE + also
                if (program, also) not in bases:
                    bases[program, also] = sliced(program, base)
                was, now = bases[program, also], sliced(program, base + f"\n{key} = {value}\n")
                told = now if isinstance(now, str) else was if isinstance(was, str) else difference(was, now)
                print(f"  {program:<12} {told}")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
