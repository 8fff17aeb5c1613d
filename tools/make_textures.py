#!/usr/bin/env python3
"""Makes the textures of models/textures/: grey, periodic, the same bytes on every machine.

usage: tools/make_textures.py [OUTPUT_DIR]

Each is a "dead leaves" image: shapes of constant reflectance thrown on top of each other, with
sizes from a few centimetres to 1 m distributed as 1/size^3. Such images have the statistics of natural ones:
sharp edges at every scale (Lee, Mumford and Huang, "Occlusion models for natural images", IJCV
2001). Reflectances are linear (value/255), uniform in the logarithm, so that contrast is real for
a sensor that sees log intensity. Python's standard library is all it needs.
"""
import math
import pathlib
import random
import struct
import sys
import zlib

TEXEL_M = 0.008
SAMPLES = 4  # per texel and direction: edges are averaged over 4 x 4 samples


def spans(shape):
    """Rows (y, x0, x1) that a shape covers, in samples; not yet wrapped around."""
    kind, cx, cy, a, b, angle = shape
    if kind == "disc":
        for y in range(math.ceil(cy - a), math.floor(cy + a) + 1):
            half = math.sqrt(max(0.0, a * a - (y - cy) ** 2))
            yield y, math.ceil(cx - half), math.floor(cx + half) + 1
        return
    c, s = math.cos(angle), math.sin(angle)
    corners = [(cx + i * a * c - j * b * s, cy + i * a * s + j * b * c)
               for i, j in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    top, bottom = min(y for _, y in corners), max(y for _, y in corners)
    for y in range(math.ceil(top), math.floor(bottom) + 1):
        xs = []
        for k in range(4):
            (x0, y0), (x1, y1) = corners[k], corners[k - 1]
            if min(y0, y1) <= y <= max(y0, y1) and y0 != y1:
                xs.append(x0 + (x1 - x0) * (y - y0) / (y1 - y0))
        if xs:
            yield y, math.ceil(min(xs)), math.floor(max(xs)) + 1


def dead_leaves(seed, low, high, smallest_m, upright, leaves, texels=512):
    """Reflectance in [low, high] as `texels` rows of as many bytes."""
    rng = random.Random(seed)
    side = texels * SAMPLES
    per_m = SAMPLES / TEXEL_M
    largest_m = min(1.0, 0.5 * texels * TEXEL_M)
    grey = lambda: round(255 * math.exp(rng.uniform(math.log(low), math.log(high))))
    background = grey()
    image = [bytearray([background]) * side for _ in range(side)]
    for _ in range(leaves):
        # Inverse of the distribution function of 1/size^3 between the limits.
        u = rng.random()
        size_m = 1 / math.sqrt(u / smallest_m ** 2 + (1 - u) / largest_m ** 2)
        a = 0.5 * size_m * per_m
        kind = "disc" if rng.random() < 0.35 else "box"
        angle = 0.0 if rng.random() < upright else rng.uniform(0, math.pi)
        shape = (kind, rng.uniform(0, side), rng.uniform(0, side), a, a * rng.uniform(0.3, 1), angle)
        value = grey()
        for y, x0, x1 in spans(shape):
            row = image[y % side]
            start, length = x0 % side, min(x1 - x0, side)
            if length <= 0:
                continue
            end = min(start + length, side)
            row[start:end] = bytes([value]) * (end - start)
            rest = length - (end - start)  # wraps around: the tile is periodic
            row[0:rest] = bytes([value]) * rest
    rows = []
    for y in range(0, side, SAMPLES):
        sums = [sum(column) for column in zip(*image[y:y + SAMPLES])]
        row = [sum(sums[x:x + SAMPLES]) for x in range(0, side, SAMPLES)]
        rows.append(bytes((v + SAMPLES * SAMPLES // 2) // (SAMPLES * SAMPLES) for v in row))
    return rows


def write_png(path, rows):
    """8-bit grey-scale PNG."""
    def chunk(name, data):
        return (struct.pack(">I", len(data)) + name + data +
                struct.pack(">I", zlib.crc32(name + data)))
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    raw = b"".join(b"\0" + row for row in rows)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def main():
    if len(sys.argv) > 2 or sys.argv[-1].startswith("-"):
        sys.exit(__doc__)
    root = pathlib.Path(__file__).resolve().parent.parent
    out = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else root / "models" / "textures"
    out.mkdir(parents=True, exist_ok=True)
    # Painted walls, floor and ceiling differ little from place to place; prints (books, pictures,
    # boxes) carry the strong edges, as in a real room.
    write_png(out / "wall.png", dead_leaves(1, 0.50, 0.75, 0.10, upright=0.9, leaves=2500))
    write_png(out / "panel.png", dead_leaves(2, 0.40, 0.65, 0.12, upright=1.0, leaves=2000))
    write_png(out / "floor.png", dead_leaves(3, 0.25, 0.40, 0.08, upright=0.3, leaves=4000))
    write_png(out / "ceiling.png", dead_leaves(4, 0.70, 0.88, 0.15, upright=1.0, leaves=1500))
    write_png(out / "print.png", dead_leaves(5, 0.15, 0.75, 0.30, upright=0.6, leaves=60, texels=128))
    write_png(out / "ground.png", dead_leaves(6, 0.12, 0.30, 0.05, upright=0.0, leaves=12000))


if __name__ == "__main__":
    main()
