"""The protocol of docs/own-tracer.md in Python: one loop over all spheres for each ray, in the doubles Python has. On a little-endian machine."""
import math
import struct
import sys
from array import array


def read(count):
    return array("f", sys.stdin.buffer.read(4 * count))


def nearest(spheres, ex, ey, ez, dx, dy, dz):
    best, a = (0xFFFFFFFF, math.inf), dx * dx + dy * dy + dz * dz
    for i, (cx, cy, cz, r) in enumerate(spheres):
        fx, fy, fz = ex - cx, ey - cy, ez - cz
        b = fx * dx + fy * dy + fz * dz
        d = b * b - a * (fx * fx + fy * fy + fz * fz - r * r)
        if a > 0 and d >= 0:
            t = (-b - math.sqrt(d)) / a
            t = t if t > 0 else (-b + math.sqrt(d)) / a
            best = (i, t) if 0 < t < best[1] else best
    return best


out = sys.stdout.buffer
while head := sys.stdin.buffer.read(20):
    magic, version, n, width, height = struct.unpack("<4s4I", head)
    assert (magic, version) == (b"CGTQ", 1)
    camera, rays = read(12), read(6 * width * height)
    out.write(b"r"), out.flush(), sys.stdin.buffer.read(1)
    spheres = read(4 * n)
    spheres = [tuple(spheres[i : i + 4]) for i in range(0, 4 * n, 4)]
    hits = [nearest(spheres, *rays[i : i + 6]) for i in range(0, len(rays), 6)]
    out.write(b"d" + array("I", [id for id, _ in hits]).tobytes() + array("f", [t for _, t in hits]).tobytes())
    out.flush()
