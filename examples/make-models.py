#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the example models: box.stl, bracket.stl, calibration-tower.stl, beside this script.

Each is one closed surface, outward oriented: the script checks it before it writes. All coordinates are whole microns
until they are written, so the triangulation is exact and the files are the same on every machine.

    python3 examples/make-models.py
"""
import math
import pathlib
import struct


def um(mm):
    return round(mm * 1000)


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def area(ring):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1]))


def meet(a, b, c, d):
    """Whether the segments ab and cd cross or touch anywhere but at a common end."""
    if {a, b} & {c, d}:
        return False
    def between(p, q, r):  # r, on the line pq, lies on the segment
        return min(p[0], q[0]) <= r[0] <= max(p[0], q[0]) and min(p[1], q[1]) <= r[1] <= max(p[1], q[1])
    s = [cross(c, d, a), cross(c, d, b), cross(a, b, c), cross(a, b, d)]
    if s[0] * s[1] < 0 and s[2] * s[3] < 0:
        return True
    return any(k == 0 and between(*e) for k, e in zip(s, [(c, d, a), (c, d, b), (a, b, c), (a, b, d)]))


def opens_to(ring, i, q):
    """Whether q lies in the angle of the ring at its corner i; tells the corners apart that a bridge has doubled."""
    a, b, c = ring[i - 1], ring[i], ring[(i + 1) % len(ring)]
    sides = cross(a, b, q) > 0, cross(b, c, q) > 0
    return all(sides) if cross(a, b, c) > 0 else any(sides)


def triangulate(outer, holes):
    """Triangles of a polygon with holes: the holes are joined to the outline by bridges, then ears are cut off."""
    ring = outer if area(outer) > 0 else outer[::-1]
    holes = sorted((h if area(h) < 0 else h[::-1] for h in holes), key=max, reverse=True)
    for number, hole in enumerate(holes):
        walls = [e for r in [ring] + holes[number:] for e in zip(r, r[1:] + r[:1])]
        bridges = sorted((math.dist(p, q), i, j) for i, p in enumerate(ring) for j, q in enumerate(hole))
        at, start = next((i, j) for _, i, j in bridges
                         if opens_to(ring, i, hole[j]) and not any(meet(ring[i], hole[j], *wall) for wall in walls))
        ring = ring[:at + 1] + hole[start:] + hole[:start + 1] + ring[at:]
    triangles = []
    while len(ring) > 3:
        for i in range(len(ring)):
            a, b, c = ring[i - 1], ring[i], ring[(i + 1) % len(ring)]
            if cross(a, b, c) > 0 and not any(
                    p not in (a, b, c) and cross(a, b, p) >= 0 and cross(b, c, p) >= 0 and cross(c, a, p) >= 0
                    for p in ring):
                triangles.append((a, b, c))
                del ring[i]
                break
        else:
            raise ValueError("not a simple polygon")
    return triangles + [tuple(ring)]


class Solid:
    """A closed surface, face by face. Points are (x, y, z) in microns."""

    def __init__(self):
        self.triangles = []

    def face(self, outer, *holes):
        """A planar face; its outline runs counter-clockwise seen from outside, its holes either way."""
        normal = [0, 0, 0]
        for a, b in zip(outer, outer[1:] + outer[:1]):  # Newell
            for k in range(3):
                normal[k] += (a[(k + 1) % 3] - b[(k + 1) % 3]) * (a[(k + 2) % 3] + b[(k + 2) % 3])
        drop = max(range(3), key=lambda k: abs(normal[k]))
        u, v = ((drop + 1) % 3, (drop + 2) % 3) if normal[drop] > 0 else ((drop + 2) % 3, (drop + 1) % 3)
        solid_point = {(p[u], p[v]): p for ring in (outer, *holes) for p in ring}
        flat = [[(p[u], p[v]) for p in ring] for ring in (outer, *holes)]
        self.triangles += [tuple(solid_point[p] for p in t) for t in triangulate(flat[0], flat[1:])]

    def walls(self, low, high):
        """Quadrangles between two rings; their outside is to the right of the low one when it is seen from high."""
        n = len(low)
        for i in range(n):
            j = (i + 1) % n
            self.face([low[i], low[j], high[j], high[i]])

    def write(self, path, description):
        sides = {}
        for t in self.triangles:
            for a, b in zip(t, t[1:] + t[:1]):
                assert sides.setdefault((a, b), t) is t, f"{path}: side {a} {b} twice"
        assert all((b, a) in sides for a, b in sides), f"{path}: not closed"
        volume = sum(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                     a[2] * (b[0] * c[1] - b[1] * c[0]) for a, b, c in self.triangles) / 6e9
        assert volume > 0, f"{path}: inside out"
        with open(path, "wb") as file:
            file.write(description.encode().ljust(80, b"\0") + struct.pack("<I", len(self.triangles)))
            for t in self.triangles:
                u, v = ([q - p for p, q in zip(t[0], t[k])] for k in (1, 2))
                n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
                length = math.hypot(*n)
                file.write(struct.pack("<12fH", *(k / length for k in n), *(k / 1000 for p in t for k in p), 0))
        print(f"{path.name}: {len(self.triangles)} triangles, {volume:.1f} mm3")


def circle(u, v, diameter, steps=64):
    """Counter-clockwise, in whole microns."""
    turns = [2 * math.pi * i / steps for i in range(steps)]
    return [(um(u + diameter / 2 * math.cos(t)), um(v + diameter / 2 * math.sin(t))) for t in turns]


def rectangle(u0, v0, u1, v1):
    return [(um(u0), um(v0)), (um(u1), um(v0)), (um(u1), um(v1)), (um(u0), um(v1))]


def box(size_mm):
    """A cube, to measure things with."""
    solid = Solid()
    ring = rectangle(0, 0, size_mm, size_mm)
    low, high = [(x, y, 0) for x, y in ring], [(x, y, um(size_mm)) for x, y in ring]
    solid.face(low[::-1])
    solid.face(high)
    solid.walls(low, high)
    return solid


RIBS_MM = (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.2, 1.6, 2.0)


def bracket():
    """An L of 64 x 44 x 50 mm: screw holes both ways, a lip that hangs over, ribs thinner and thicker than a bead."""
    solid = Solid()
    width = 64
    # The profile, (y, z), seen from +x: base, upright, a slope of 45 degrees and a lip of 2 mm over air.
    profile = [(um(y), um(z)) for y, z in ((0, 0), (44, 0), (44, 5), (6, 5), (6, 34), (12, 40), (12, 44), (14, 44),
                                           (14, 50), (0, 50))]
    near = [(0, y, z) for y, z in profile]
    far = [(um(width), y, z) for y, z in profile]
    solid.face(far)
    solid.face(near[::-1])

    upright_holes = [circle(20, 20, 6), circle(44, 20, 6)]  # (x, z)
    base_holes = [circle(12, 16, 5.5), circle(52, 16, 5.5)]  # (x, y)
    ribs, x = [], 6.15
    for thickness in RIBS_MM:
        ribs.append(rectangle(x, 26, x + thickness, 40))
        x += thickness + 4.3

    def in_base(ring, z):
        return [(p, q, um(z)) for p, q in ring]

    def in_upright(ring, y):
        return [(p, um(y), q) for p, q in ring]

    for i in range(len(profile)):
        j = (i + 1) % len(profile)
        holes = []
        if i == 0:
            holes = [in_base(h, 0) for h in base_holes]
        elif i == 2:
            holes = [in_base(h, 5) for h in base_holes + ribs]
        elif i == 3:
            holes = [in_upright(h, 6) for h in upright_holes]
        elif i == 9:
            holes = [in_upright(h, 0) for h in upright_holes]
        solid.face([near[i], near[j], far[j], far[i]], *holes)
    for hole in base_holes:
        solid.walls(in_base(hole, 5), in_base(hole, 0))
    for hole in upright_holes:
        solid.walls(in_upright(hole, 0), in_upright(hole, 6))
    for rib in ribs:
        solid.walls(in_base(rib, 5), in_base(rib, 13))
        solid.face(in_base(rib, 13))
    return solid


OVERHANGS_DEG = (20, 30, 40, 45, 50, 60)


def calibration_tower():
    """Six storeys of 8 mm: in each an overhang of its own angle, a window to bridge, a round hole and a groove."""
    storey, depth = 8, 12
    right, left, holes = [], [], []  # the profile, (x, z)
    for i, angle in enumerate(OVERHANGS_DEG):
        z = i * storey
        out = z + 1.5 + 2 / math.tan(math.radians(angle))  # 2 mm out, at the angle from the vertical
        right += [(20, z + 1.5), (22, out), (22, z + 7.5), (20, z + 7.5)]
        if i > 0:
            left += [(0, z - 0.4), (0.6, z), (0, z + 0.4)]
        holes += [rectangle(2, z + 2, 6 + i, z + 6), circle(15, z + 4, 4, 48)]
    top = len(OVERHANGS_DEG) * storey
    profile = [(um(x), um(z)) for x, z in [(0, 0), (20, 0), *right, (20, top), (0, top), *left[::-1]]]

    def at(ring, y):
        return [(x, um(y), z) for x, z in ring]

    solid = Solid()
    solid.face(at(profile, 0), *(at(h, 0) for h in holes))
    solid.face(at(profile, depth)[::-1], *(at(h, depth) for h in holes))
    solid.walls(at(profile, depth), at(profile, 0))
    for hole in holes:
        solid.walls(at(hole, 0), at(hole, depth))
    return solid


if __name__ == "__main__":
    folder = pathlib.Path(__file__).resolve().parent
    box(20).write(folder / "box.stl", "box, made by examples/make-models.py of weft")
    bracket().write(folder / "bracket.stl", "bracket, made by examples/make-models.py of weft")
    calibration_tower().write(folder / "calibration-tower.stl", "calibration tower, made by examples/make-models.py of weft")
