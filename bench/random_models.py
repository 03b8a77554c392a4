#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random models, each made into nets with default options, and each result checked.

  random_models.py PROGRAM [--first N] [--count N] [--seconds S] [--keep FOLDER] [--check CHECKER]

A model is a union of boxes, prisms, turned bodies and sheets, with walls from 0.1 to 5 mm at 150 mm, some of them open,
doubled, turned inside out or moved by a hair. Model N is the same each time. A run fails if it ends with exit code 1 or by
a signal, takes longer than S seconds of CPU time (60), or if `verify`, or a CHECKER that takes a .fold file, finds a fault.
Failing models are kept in FOLDER. Exit code 1 if a run failed.
"""
import argparse, math, os, random, resource, shutil, subprocess, sys, tempfile, collections

WALLS = (0.1, 0.3, 0.8, 1.5, 3.0, 5.0)


class Shape:
    def __init__(self):
        self.points, self.faces = [], []

    def add(self, points, faces):
        base = len(self.points)
        self.points += points
        self.faces += [[base + v for v in f] for f in faces]


def prism(outline, low, high):
    n = len(outline)
    points = [(x, y, z) for z in (low, high) for x, y in outline]
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return points, [list(range(n))[::-1], [n + i for i in range(n)]] + sides


def box(a, b, c):
    return prism([(0, 0), (a, 0), (a, b), (0, b)], 0, c)


def turned(profile, n):
    points = [(r * math.cos(2 * math.pi * k / n), r * math.sin(2 * math.pi * k / n), z) for r, z in profile for k in range(n)]
    m = len(profile)
    faces = [[i * n + k, i * n + (k + 1) % n, (i + 1) * n + (k + 1) % n, (i + 1) * n + k] for i in range(m - 1) for k in range(n)]
    return points, faces + [list(range(n))[::-1], [(m - 1) * n + k for k in range(n)]]


def polygon(rng, r):
    n = rng.randint(3, 14)
    star = rng.random() < 0.3
    return [((0.5 if star and k % 2 else 1) * r * math.cos(2 * math.pi * k / n), (0.5 if star and k % 2 else 1) * r * math.sin(2 * math.pi * k / n)) for k in range(n)]


def length(rng):
    return rng.choice(WALLS) if rng.random() < 0.3 else rng.uniform(5, 80)


def body(rng):
    kind = rng.randrange(5)
    if kind == 0:
        return box(length(rng), length(rng), length(rng))
    if kind == 1:
        return prism(polygon(rng, rng.uniform(3, 40)), 0, length(rng))
    if kind == 2:
        m = rng.randint(2, 9)
        return turned([(rng.uniform(0.3, 40), 60.0 * i / m + rng.uniform(0, 3)) for i in range(m)], rng.choice((3, 4, 6, 8, 12, 24, 48)))
    if kind == 3:
        a, b = length(rng), length(rng)
        return [(0, 0, 0), (a, 0, 0), (a, b, rng.uniform(-5, 5)), (0, b, 0)], [[0, 1, 2, 3]]
    # A cup: its wall is as thin as walls are.
    n, r, wall = rng.choice((4, 6, 12, 24)), rng.uniform(8, 40), rng.choice(WALLS)
    h = rng.uniform(10, 80)
    return turned([(r, 0), (r, h), (r - wall, h), (r - wall, wall)], n)


def placed(rng, points):
    shift = [rng.choice((0, 0, 5, 10, rng.uniform(-60, 60))) for _ in range(3)]
    if rng.random() < 0.5:
        axes = rng.sample(range(3), 3)
        return [tuple(p[axes[k]] + shift[k] for k in range(3)) for p in points]
    a, b = rng.uniform(0, 6.3), rng.uniform(0, 6.3)
    out = []
    for x, y, z in points:
        x, y = math.cos(a) * x - math.sin(a) * y, math.sin(a) * x + math.cos(a) * y
        y, z = math.cos(b) * y - math.sin(b) * z, math.sin(b) * y + math.cos(b) * z
        out.append((x + shift[0], y + shift[1], z + shift[2]))
    return out


def broken(rng, shape):
    kind = rng.randrange(6)
    faces = shape.faces
    if kind == 0:  # open
        rng.shuffle(faces)
        del faces[: 1 + len(faces) // rng.choice((5, 20))]
    elif kind == 1:  # doubled
        faces += [list(f) for f in faces if rng.random() < 0.5]
    elif kind == 2:  # inside out in part
        shape.faces = [f[::-1] if rng.random() < 0.3 else f for f in faces]
    elif kind == 3:  # corners moved by a hair
        hair = rng.choice((1e-7, 1e-4, 1e-2, 0.3))
        shape.points = [tuple(c + rng.uniform(-hair, hair) for c in p) for p in shape.points]
    elif kind == 4:  # the whole once more, moved by a hair
        hair = rng.choice((0.0, 1e-5, 0.05))
        shape.add([(x + hair, y, z) for x, y, z in shape.points], faces[:])
    else:  # faces without area
        shape.faces += [[f[0], f[1], f[0]] for f in faces[:3]] + [[f[0], f[1], f[1], f[2]] for f in faces[:3]]


def model(number):
    rng = random.Random(number)
    shape = Shape()
    for _ in range(rng.choice((1, 1, 2, 2, 3, 3, 5, 8, 14))):
        points, faces = body(rng)
        shape.add(placed(rng, points), faces)
    if rng.random() < 0.3:
        broken(rng, shape)
    return shape


def write(shape, path):
    with open(path, "w", encoding="ascii") as f:
        for p in shape.points:
            f.write("v %.9g %.9g %.9g\n" % p)
        for face in shape.faces:
            f.write("f " + " ".join(str(v + 1) for v in face) + "\n")


def run(command, seconds):
    """Exit code, last line of what was said, CPU seconds. -1000 where it took too long."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
    done = subprocess.run(command, capture_output=True, text=True, preexec_fn=limit)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = (done.stderr + done.stdout).strip().splitlines()
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    code = -1000 if done.returncode in (-9, -24) else done.returncode
    return code, said[-1] if said else "", used


def failure(args, number, folder):
    """Why the model of this number fails, or none; and its CPU seconds, and its exit code."""
    source, nets = folder + "/m.obj", folder + "/m.fold"
    if os.path.exists(nets):
        os.remove(nets)
    write(model(number), source)
    code, said, used = run([args.program, source, "-o", nets, "--threads", "1"], args.seconds)
    if code == 1 or code < 0:
        return ("took too long" if code == -1000 else "exit %d: %s" % (code, said)), used, code
    if code == 0:
        for check in [[args.program, "verify", nets]] + ([[sys.executable, args.check, nets]] if args.check else []):
            wrong, said, _ = run(check, 600)
            if wrong:
                return "%s finds: %s" % (os.path.basename(check[1]), said), used, code
    return None, used, code


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--keep")
    parser.add_argument("--check")
    args = parser.parse_args()
    codes, times, failed = collections.Counter(), [], 0
    with tempfile.TemporaryDirectory() as folder:
        for number in range(args.first, args.first + args.count):
            why, used, code = failure(args, number, folder)
            codes[code] += 1
            times.append(used)
            if why:
                failed += 1
                print("%d: %s (%.1f s)" % (number, why, used), flush=True)
                if args.keep:
                    shutil.copy(folder + "/m.obj", "%s/%d.obj" % (args.keep, number))
    times.sort()
    print("%d models, %d failed; exit codes %s; CPU seconds: median %.2f, 95 %% %.2f, most %.2f" % (
        len(times), failed, dict(sorted(codes.items())), times[len(times) // 2], times[int(0.95 * (len(times) - 1))], times[-1]))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
