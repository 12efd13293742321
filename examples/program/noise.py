#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
#
# A noise as a program: cmd:./noise.py {seed}. The sum of eight random plane waves below 1 cycle
# per unit. Points come as little-endian doubles in blocks, values go back in the same way.
import math
import random
import struct
import sys

draw = random.Random(int(sys.argv[1]) if len(sys.argv) > 1 else 0)
waves = []
for _ in range(8):
    direction = [draw.gauss(0, 1) for _ in range(4)]
    scale = draw.random() / math.hypot(*direction)
    waves.append(([2 * math.pi * scale * c for c in direction], 2 * math.pi * draw.random()))


def noise(point):
    return sum(math.cos(phase + sum(w * x for w, x in zip(wave, point)))
               for wave, phase in waves) / len(waves)


while head := sys.stdin.buffer.read(16):
    count, dims = struct.unpack("<QQ", head)
    numbers = struct.unpack(f"<{count * dims}d", sys.stdin.buffer.read(8 * count * dims))
    values = [noise(numbers[i:i + dims]) for i in range(0, len(numbers), dims)]
    sys.stdout.buffer.write(struct.pack(f"<{count}d", *values))
    sys.stdout.buffer.flush()
