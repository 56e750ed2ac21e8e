"""What the scenes of scenes/stiff are made of, and how they are written."""
import math

# Integrators that find lights by chance, and those that aim at them.
ESTIMATORS = ("hemisphere", "bsdf", "light", "path")


def expect(because, facts, where=None, group="analytic", long=False, **more):
    block = {"group": group}
    if long:
        block["tier"] = "long"
    block["because"] = because
    if where:
        block["where"] = where
    block.update(more)
    block["facts"] = facts if isinstance(facts, list) else [facts]
    return block


def pixels(value, tolerance=0, rule="round", **more):
    fact = {"subject": "pixels", "rule": rule, "value": value}
    if rule != "exact":
        fact["tolerance"] = tolerance
    return {**fact, **more}


def mean(value, delta=None, **more):
    fact = {"subject": "mean", "rule": "stat", "value": value}
    if delta:
        fact["delta"] = delta
    return {**fact, **more}


def same(**more):
    return {"subject": "same", "rule": "exact", **more}


def diffuse(name, albedo):
    return {"name": name, "type": "diffuse", "albedo": albedo}


def glass(name, ior, **more):
    return {"name": name, "type": "dielectric", "ior": ior, **more}


def integrator(kind, depth, roulette="off", **more):
    return {"type": kind, "max_depth": depth, "roulette": roulette, **more}


def look(position, at, fov, width, height=None, **more):
    """Camera and film."""
    camera = {"position": position, "look_at": at, "vertical_fov": fov, **more}
    return {"camera": camera, "film": {"size": [width, height or width]}}


def look_at_point(position, at, width=128):
    """Every pixel is the same ray, so that every sample of the picture is one of the same random variable."""
    return look(position, at, 1e-7, width)


def turned(axis, angle):
    return {"rotate": {"axis": axis, "angle": angle}}


def facing_down(x, y, z):
    """Where the normal +z of rectangles and disks points to -y."""
    return [turned([1, 0, 0], 90), {"translate": [x, y, z]}]


def facing_up(x=0, y=0, z=0):
    return [turned([1, 0, 0], -90), {"translate": [x, y, z]}]


def scene(name_expectation, view, integrator_, spp, materials=(), shapes=(), lights=(), **more):
    """The objects of a scene in the order in which they are read best."""
    result = {"expect": name_expectation, **view, "integrator": integrator_, "sampler": {"type": "independent", "spp": spp}}
    for key, value in (("materials", materials), ("shapes", shapes), ("lights", lights)):
        if value:
            result[key] = list(value)
    result.update(more)
    return result


class Numbers:
    """Reproducible numbers in [0, 1) (the linear congruence of Knuth's MMIX)."""

    def __init__(self, seed):
        self.state = seed

    def __call__(self):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return (self.state >> 40) / 2**24


def octasphere(n):
    """A polyhedron of 8 n^2 triangles inscribed in the unit sphere, normals outward: corners (i, j, n - i - j) / n of each
    octant, pushed onto the sphere."""
    positions, indices, known = [], [], {}

    def corner(signs, i, j):
        p = [s * c for s, c in zip(signs, (i, j, n - i - j))]
        length = math.sqrt(sum(c * c for c in p))
        q = tuple(c / length + 0.0 for c in p)
        if q not in known:
            known[q] = len(positions)
            positions.append(list(q))
        return known[q]

    def add(a, b, c):
        p, q, r = (positions[k] for k in (a, b, c))
        e, f = [q[k] - p[k] for k in range(3)], [r[k] - p[k] for k in range(3)]
        volume = (p[0] * (e[1] * f[2] - e[2] * f[1]) + p[1] * (e[2] * f[0] - e[0] * f[2])
                  + p[2] * (e[0] * f[1] - e[1] * f[0]))
        indices.append([a, b, c] if volume > 0 else [a, c, b])

    for octant in range(8):
        signs = [-1 if octant >> k & 1 else 1 for k in range(3)]
        for i in range(n):
            for j in range(n - i):
                add(corner(signs, i, j), corner(signs, i + 1, j), corner(signs, i, j + 1))
                if i + j + 1 < n:
                    add(corner(signs, i + 1, j), corner(signs, i + 1, j + 1), corner(signs, i, j + 1))
    return {"type": "triangles", "positions": positions, "indices": indices}


def box_triangles(low, high):
    """Twelve triangles, normals outward."""
    p = [[(low, high)[i >> k & 1][k] for k in range(3)] for i in range(8)]
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return {"type": "triangles", "positions": p,
            "indices": [t for a, b, c, d in quads for t in ([a, b, c], [a, c, d])]}


def number_text(x):
    """As short as it can be read back; whole numbers without a fraction."""
    if isinstance(x, float) and x == int(x) and abs(x) < 1e15:
        return str(int(x))
    return repr(x)


def json_text(value, indent=0, width=110):
    """JSON with one line for whatever fits."""
    import json
    if isinstance(value, dict):
        items = [f"{json.dumps(k)}: " for k in value]
        parts = [json_text(v, indent + 2, width) for v in value.values()]
        brackets = "{}"
    elif isinstance(value, (list, tuple)):
        items = [""] * len(value)
        parts = [json_text(v, indent + 2, width) for v in value]
        brackets = "[]"
    elif isinstance(value, (bool, str)):
        return json.dumps(value, ensure_ascii=False)
    else:
        return number_text(value)
    line = brackets[0] + ", ".join(k + p for k, p in zip(items, parts)) + brackets[1]
    if indent and "\n" not in line and len(line) + indent <= width:
        return line
    pad = " " * (indent + 2)
    if brackets == "[]" and all("\n" not in p for p in parts) and all(len(p) < 70 for p in parts):
        # Long lists of short things: as many in a line as fit.
        lines, current = [], ""
        for part in parts:
            if current and len(pad) + len(current) + len(part) + 2 > width:
                lines.append(current)
                current = ""
            current += (", " if current else "") + part
        return "[\n" + ",\n".join(pad + text for text in lines + [current]) + "\n" + " " * indent + "]"
    body = ",\n".join(pad + k + p for k, p in zip(items, parts))
    return f"{brackets[0]}\n{body}\n{' ' * indent}{brackets[1]}"
