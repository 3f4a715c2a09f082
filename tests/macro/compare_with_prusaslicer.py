#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The macro language against PrusaSlicer itself: the expressions of tests/data/macro in the start G-code of one profile,
sliced by both programs; the text must be the same. Without prusa-slicer the test is skipped, loudly (status 77).

usage: compare_with_prusaslicer.py --weft PROGRAM [--update]     --update: what PrusaSlicer says becomes the golden file
"""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

DATA = pathlib.Path(__file__).resolve().parent.parent / "data" / "macro"


def cube(path):
    """10 x 10 x 2 mm."""
    corners = [(x, y, z) for x in (0, 10) for y in (0, 10) for z in (0, 2)]
    faces = [(0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3), (0, 4, 5), (0, 5, 1),
             (2, 3, 7), (2, 7, 6), (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5)]
    text = "solid cube\n"
    for face in faces:
        text += "facet normal 0 0 0\nouter loop\n"
        text += "".join("vertex %g %g %g\n" % corners[i] for i in face) + "endloop\nendfacet\n"
    path.write_text(text + "endsolid cube\n")


def profile(path, codes):
    code = "\n".join(f"; <{i}>{c}</{i}>" for i, c in enumerate(codes)) + "\nG28\n"
    escaped = code.replace("\\", "\\\\").replace("\n", "\\n")
    path.write_text((DATA / "printer.ini").read_text() + f"start_gcode = {escaped}\n")


def results(gcode, count):
    out = []
    for i in range(count):
        after = gcode.split(f"; <{i}>", 1)
        out.append(after[1].split(f"</{i}>", 1)[0] if len(after) > 1 else None)
    return out


def run(command, gcode):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if not gcode.exists():
        sys.exit(f"{command[0]} wrote nothing:\n{done.stdout}{done.stderr}")
    return gcode.read_text()


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--weft", required=True)
    options.add_argument("--update", action="store_true")
    options = options.parse_args()
    theirs = shutil.which("prusa-slicer")
    if not theirs:
        print("SKIPPED: prusa-slicer is not installed, nothing was compared", file=sys.stderr)
        return 77
    golden = [line.split("\t", 1) for line in (DATA / "expressions.txt").read_text().splitlines()]
    codes = [g[0] for g in golden]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        model, ini = folder / "cube.stl", folder / "printer.ini"
        cube(model)
        profile(ini, codes)
        prusa = results(run([theirs, "--export-gcode", "--load", ini, "--output", folder / "p.gcode", model], folder / "p.gcode"), len(codes))
        weft = results(run([options.weft, "slice", model, "-p", ini, "-o", folder / "w.gcode", "-q"], folder / "w.gcode"), len(codes))
    if options.update:
        (DATA / "expressions.txt").write_text("".join(f"{c}\t{p}\n" for c, p in zip(codes, prusa)))
    different = 0
    for code, expected, p, w in zip(codes, (g[1] for g in golden), prusa, weft):
        if p != w or p != expected:
            different += 1
            print(f"{code}\n  PrusaSlicer {p!r}\n  weft        {w!r}\n  golden      {expected!r}")
    print(f"{len(codes)} expressions, {different} different")
    return 1 if different else 0


sys.exit(main())
