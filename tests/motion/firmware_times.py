#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The estimate of time beside simulators of two firmwares' planners, which read the finished G-code.

They are written from the firmwares' documents and know nothing of weft but the settings at the end of the file:
Klipper's docs/Kinematics.md ("Look-ahead", "Smoothed look-ahead", "Junction speed") and Config_Reference.md; Marlin's
page "Configuring Marlin" (jerk, BLOCK_BUFFER_SIZE) and its description of the look-ahead planner.

    firmware_times.py --weft PROGRAM          slices two models of its own, and compares; what ctest runs
    firmware_times.py --read FILE.gcode ...   tells the times of files, each beside the one that its comments tell
"""
import argparse
import json
import math
import re
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

# Shares of the time of a print, each layer from rest to rest, as weft's estimate has them.
KLIPPER_WITHIN, MARLIN_WITHIN = 0.001, 0.01
# … and without that: weft's layers do not look ahead into each other, which costs a hundredth of a second each. The
# layers of these models take six seconds; those of real ones take longer.
WHOLE_WITHIN = 0.005


class Move:
    __slots__ = ("length", "u", "speed", "accel", "asked", "e", "pause")

    def __init__(self, length, u, speed, accel, asked, e):
        self.length, self.u, self.speed, self.accel, self.asked, self.e = length, u, speed, accel, asked, e


def settings_of(text):
    out = {}
    for line in text.splitlines():
        m = re.match(r"; ([a-z_0-9]+) = (.*)$", line)
        if m:
            out[m.group(1)] = m.group(2)
    return out


def number(settings, key, otherwise):
    value = settings.get(key, "auto")
    try:
        return float(value.rstrip("%").split(",")[0])
    except ValueError:
        return otherwise


class Machine:
    def __init__(self, s):
        self.speed = [number(s, "machine_max_speed_" + a, 300) for a in "xyze"]
        self.accel = [number(s, "machine_max_acceleration_" + a, 3000) for a in "xyze"]
        self.jerk = number(s, "machine_max_jerk", 8)
        self.jerk_z = number(s, "machine_max_jerk_z", 0.4)
        self.klipper = s.get("firmware") == "klipper"
        self.jerk_e = number(s, "machine_max_jerk_e", 1 if self.klipper else 5)
        self.ratio = number(s, "machine_minimum_cruise_ratio", 50) / 100
        self.print_accel = number(s, "acceleration_print", 1500)
        self.blocks = int(number(s, "machine_planner_blocks", 16))


def arc_points(machine, at, words, left):
    """The chords that the firmware cuts an arc into."""
    cx, cy = at[0] + words.get("I", 0), at[1] + words.get("J", 0)
    r = math.hypot(at[0] - cx, at[1] - cy)
    a0 = math.atan2(at[1] - cy, at[0] - cx)
    a1 = math.atan2(words["Y"] - cy, words["X"] - cx)
    turn = (a1 - a0) % (2 * math.pi) if left else -((a0 - a1) % (2 * math.pi))
    chord = 1.0 if machine.klipper else min(max(2 * math.pi * r / 72, 0.1), 1.0)
    n = max(1, int(abs(turn) * r / chord))
    return [(cx + r * math.cos(a0 + turn * i / n), cy + r * math.sin(a0 + turn * i / n)) for i in range(1, n)] + [
        (words["X"], words["Y"])]


def moves_of(text, machine, layers_rest):
    """Moves from the first layer to the end G-code. E is relative. None stands for a rest."""
    at, feed, accel, out, begun = [None, None, None], 60.0, machine.print_accel, [], False
    for line in text.splitlines():
        if line.startswith(";LAYER_CHANGE"):
            begun = True
            if layers_rest and out and out[-1]:
                out.append(None)
        if line.startswith(";TYPE:Custom") and begun and len(out) > 10:  # the end G-code
            break
        code = line.split(";")[0].split()
        if not code:
            continue
        if code[0] == "SET_VELOCITY_LIMIT" or code[0] == "M204":
            for word in code[1:]:
                m = re.match(r"(?:ACCEL=|P|S)([0-9.]+)$", word)
                if m:
                    accel = float(m.group(1))
            continue
        if code[0] not in ("G0", "G1", "G2", "G3"):
            continue
        words = {w[0]: float(w[1:]) for w in code[1:]}
        feed = words.get("F", feed * 60) / 60
        places = [(words.get("X", at[0]), words.get("Y", at[1]))]
        if code[0] in ("G2", "G3"):
            words.setdefault("X", at[0]), words.setdefault("Y", at[1])
            places = arc_points(machine, at, words, code[0] == "G3")
        for x, y in places:
            to = [x, y, words.get("Z", at[2])]
            if begun and None not in at and None not in to:
                out += move(machine, at, to, words.get("E", 0) / len(places), feed, accel)
            at = to
    return out


def move(machine, at, to, e, feed, accel):
    d = [b - a for a, b in zip(at, to)]
    length = math.sqrt(sum(v * v for v in d))
    if length < 1e-9:
        if abs(e) < 1e-9:
            return []
        return [Move(0, (0, 0, 0), min(feed, machine.speed[3]), machine.accel[3], machine.accel[3], e)]
    u = [v / length for v in d]
    per_mm = e / length
    speed, bound = feed, accel
    for i in range(3):
        if u[i]:
            speed, bound = min(speed, machine.speed[i] / abs(u[i])), min(bound, machine.accel[i] / abs(u[i]))
    if per_mm and (not machine.klipper or per_mm < 0):
        speed, bound = min(speed, machine.speed[3] / abs(per_mm)), min(bound, machine.accel[3] / abs(per_mm))
    return [Move(length, u, speed, bound, accel, per_mm)]


def ramps_s(length, start2, cruise2, end2, a):
    v, s, e = math.sqrt(cruise2), math.sqrt(start2), math.sqrt(end2)
    flat = length - (2 * cruise2 - start2 - end2) / (2 * a)
    return (2 * v - s - e) / a + (max(flat, 0) / v if v > 0 else 0)


def alone_s(m):
    """A move of the extruder alone, from rest to rest."""
    way = abs(m.e)
    cruise2 = min(m.speed ** 2, m.accel * way)
    return ramps_s(way, 0, cruise2, 0, m.accel)


def klipper_s(machine, moves):
    total, run = 0.0, []
    for m in moves + [None]:
        if m is None or m.length == 0:  # a rest
            total += klipper_run_s(machine, run) + (alone_s(m) if m else 0)
            run = []
        else:
            run.append(m)
    return total


def klipper_run_s(machine, run):
    if not run:
        return 0.0
    most, most_smooth = [0.0], [0.0]
    for a, b in zip(run, run[1:]):
        cos = sum(x * y for x, y in zip(a.u, b.u))  # of the turn
        theta = math.pi - math.acos(max(-1.0, min(1.0, cos)))  # between the legs
        v2 = min(a.speed ** 2, b.speed ** 2)
        if a.e != b.e:
            v2 = min(v2, (machine.jerk_e / (b.e - a.e)) ** 2)
        sin, tan = math.sin(theta / 2), math.tan(theta / 2)
        if 1 - sin > 1e-14 and theta > 1e-9:
            for m in (a, b):
                deviation = machine.jerk ** 2 * (math.sqrt(2) - 1) / m.asked
                v2 = min(v2, m.accel * deviation * sin / (1 - sin), m.length / 2 * tan * m.accel)
        elif theta <= 1e-9:
            v2 = 0.0
        v2 = min(v2, most[-1] + 2 * a.accel * a.length)
        most.append(v2)
        most_smooth.append(min(v2, most_smooth[-1] + smooth2(machine, a)))
    total, waiting, peak2 = 0.0, [], 0.0
    next2 = next_smooth2 = 0.0
    for m, start2, smooth in zip(reversed(run), reversed(most), reversed(most_smooth)):
        reach2, reach_smooth2 = next2 + 2 * m.accel * m.length, next_smooth2 + smooth2(machine, m)
        start2, smooth = min(start2, reach2), min(smooth, reach_smooth2)
        if smooth >= reach_smooth2:
            waiting.append((m, start2, next2))  # it only brakes: from the peak of the move that it follows
        else:
            if waiting or smooth + smooth2(machine, m) > next_smooth2:
                peak2 = min(m.speed ** 2, (smooth + reach_smooth2) / 2)
            top2 = peak2
            for w, begin2, end2 in reversed(waiting):
                top2 = min(top2, begin2)
                total += ramps_s(w.length, min(begin2, top2), top2, min(end2, top2), w.accel)
            waiting = []
            top2 = min((start2 + reach2) / 2, m.speed ** 2, peak2)
            total += ramps_s(m.length, min(start2, top2), top2, min(next2, top2), m.accel)
        next2, next_smooth2 = start2, smooth
    return total


def smooth2(machine, m):
    return min(2 * m.accel * m.length, 2 * m.asked * (1 - machine.ratio) * m.length)


def shares(m):
    return (*m.u, m.e) if m.length else (0, 0, 0, math.copysign(1, m.e))


def way(m):
    return m.length or abs(m.e)


def marlin_s(machine, moves):
    total, run = 0.0, []
    for m in moves + [None]:
        if m is not None:
            run.append(m)
        elif run:
            total += marlin_run_s(machine, run)
            run = []
    return total


def marlin_run_s(machine, moves):
    jerks = (machine.jerk, machine.jerk, machine.jerk_z, machine.jerk_e)

    def at_once(m):  # what a block may begin or end at beside none
        return min([m.speed] + [j / abs(s) for s, j in zip(shares(m), jerks) if s])

    def meet(a, b):
        both, factor = min(a.speed, b.speed), 1.0
        for x, y, j in zip(shares(a), shares(b), jerks):
            x, y = x * both * factor, y * b.speed * factor
            jumps = abs(x - y) if x * y >= 0 else max(abs(x), abs(y))
            if jumps > j:
                factor *= j / jumps
        v = both * factor
        stop, start = at_once(a), at_once(b)
        return min(start, a.speed) if stop > 0.99 * v and start > 0.99 * v else v

    junction2 = [0.0] + [meet(a, b) ** 2 for a, b in zip(moves, moves[1:])]
    total, entry2 = 0.0, at_once(moves[0]) ** 2
    for i, m in enumerate(moves):
        last = min(len(moves), i + machine.blocks) - 1
        exit2 = at_once(moves[last]) ** 2
        for k in range(last, i, -1):
            exit2 = min(junction2[k], exit2 + 2 * moves[k].accel * way(moves[k]))
        gain2 = 2 * m.accel * way(m)
        exit2 = min(exit2, entry2 + gain2, m.speed ** 2)
        cruise2 = max(min(m.speed ** 2, (entry2 + exit2 + gain2) / 2), exit2, min(entry2, m.speed ** 2))
        total += ramps_s(way(m), min(entry2, cruise2), cruise2, exit2, m.accel)
        entry2 = exit2
    return total


def simulated(path, layers_rest=False):
    text = Path(path).read_text()
    machine = Machine(settings_of(text))
    moves = moves_of(text, machine, layers_rest)
    return (klipper_s if machine.klipper else marlin_s)(machine, moves), len(moves)


def cone(path, r0, r1, height, sides):
    def at(r, i, z):
        a = 2 * math.pi * (i % sides) / sides
        return (r * math.cos(a), r * math.sin(a), z)

    triangles = []
    for i in range(sides):
        triangles += [(at(r0, i, 0), at(r0, i + 1, 0), at(r1, i + 1, height)),
                      (at(r0, i, 0), at(r1, i + 1, height), at(r1, i, height)),
                      ((0, 0, 0), at(r0, i + 1, 0), at(r0, i, 0)),
                      ((0, 0, height), at(r1, i, height), at(r1, i + 1, height))]
    data = b"\0" * 80 + struct.pack("<I", len(triangles))
    for t in triangles:
        data += struct.pack("<12fH", 0, 0, 0, *t[0], *t[1], *t[2], 0)
    Path(path).write_bytes(data)


def compare(weft):
    worst = 0
    with tempfile.TemporaryDirectory() as folder:
        cone(f"{folder}/round.stl", 9, 6, 4, 70)
        cone(f"{folder}/square.stl", 12, 8, 4, 4)
        for model in ("round", "square"):
            for firmware, within, more in (("klipper", KLIPPER_WITHIN, ["cool_min_layer_time=0"]),
                                           ("klipper", KLIPPER_WITHIN, ["machine_minimum_cruise_ratio=0"]),
                                           ("klipper", KLIPPER_WITHIN, ["arc_fitting=true"]),
                                           ("marlin2", MARLIN_WITHIN, ["cool_min_layer_time=0"]),
                                           ("marlin2", MARLIN_WITHIN, ["machine_planner_blocks=4"]),
                                           ("marlin2", MARLIN_WITHIN, ["arc_fitting=true"])):
                words = [weft, "slice", f"{folder}/{model}.stl", "-q", "-o", f"{folder}/out.gcode", "--report",
                         f"{folder}/out.json", "--set", f"firmware={firmware}", "--set", "acceleration_enabled=true"]
                for setting in more:
                    words += ["--set", setting]
                subprocess.run(words, check=True)
                told = json.loads(Path(f"{folder}/out.json").read_text())["print_time_s"]
                found, moves = simulated(f"{folder}/out.gcode", layers_rest=True)
                whole, _ = simulated(f"{folder}/out.gcode")
                bad = abs(told / found - 1) > within or abs(told / whole - 1) > WHOLE_WITHIN
                worst = worst or bad
                print(f"{'BAD ' if bad else ''}{model} {firmware} {' '.join(more)}: weft {told:.2f} s, simulated "
                      f"{found:.2f} s over {moves} moves, {100 * (told / found - 1):+.4f} %; "
                      f"with all layers in one {whole:.2f} s")
    return 1 if worst else 0


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--weft")
    words.add_argument("--read", nargs="*", default=[])
    given = words.parse_args()
    for path in given.read:
        print(f"{path}: {simulated(path)[0]:.2f} s")
    return compare(given.weft) if given.weft else 0


if __name__ == "__main__":
    sys.exit(main())
