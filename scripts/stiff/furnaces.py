"""Rooms whose walls all glow alike, bodies under a uniform sky, roulette, depth, accumulation: cases F, P, A, I."""
from stiff.parts import (Numbers, box_triangles, diffuse, expect, facing_up, integrator, look, look_at_point, mean,
                         octasphere, pixels, scene)

INSIDE = ([0.1, 0.2, -0.3], [0.5, -0.1, 0.4])
GLOW = {"radiance": 1}
SUM = "Every wall emits 1 and reflects a, so every path of D scatterings brings 1 + a + ... + a^D"


def room(expectation, view, integrator_, spp, albedo, walls=None):
    shape = {**(walls or {"type": "box", "size": [2, 2, 2]}), "material": "walls", "flip_normals": True, "emission": GLOW}
    return scene(expectation, view, integrator_, spp, [diffuse("walls", albedo)], [shape])


def view(width):
    return look(*INSIDE, 100, width)


def geometric(a):
    return f"(1-{a}^(D+1))/(1-{a})"


def exact_room(albedos, depth, width, spp, walls=None, camera=None):
    """A room whose every path is the geometric sum, for one albedo or three."""
    names = ["a"] if isinstance(albedos, (int, float)) else ["a", "b", "c"]
    values = [albedos] if names == ["a"] else albedos
    where = {"D": depth, **{n: f"float({v})" for n, v in zip(names, values)}}
    value = [geometric(n) for n in names]
    because = SUM + "; each of the 2 D operations rounds once."
    block = expect(because, pixels(value[0] if len(value) == 1 else value, "2*D+4"), where)
    return room(block, camera or view(width), integrator("bsdf", depth), spp, albedos, walls)


def exact_furnaces():
    yield "F1-albedo-0.8-depth-8", exact_room(0.8, 8, 64, 16)
    for depth in (0, 1, 2, 8, 64, 1000, 10000):
        yield f"F1-albedos-depth-{depth}", exact_room([0.5, 0.8, 0.99], depth, 16 if depth < 1000 else 8, 4 if depth < 10000 else 1)
    for depth in (0, 1, 2, 8, 64, 1000, 10000):
        yield f"F1-albedo-0.9999-depth-{depth}", exact_room(0.9999, depth, 16 if depth < 1000 else 8, 1)
    walls = box_triangles([-1, -1, -1], [1, 1, 1])
    yield "F1-triangles-depth-64", exact_room(0.8, 64, 16, 4, walls)
    yield "P1-albedo-0.999999", exact_room(0.999999, 10000, 8, 1)
    yield "P1-albedo-0.9999999", exact_room(0.9999999, 10000, 8, 1)
    for albedo, depth in ((0.9, 65), (0.999, 1000), (0.999, 6904)):
        yield f"P3-albedo-{albedo}-depth-{depth}", exact_room(albedo, depth, 8, 1)
    for depth in (3, 4, 5, 63, 65):
        yield f"P3-albedo-0.8-depth-{depth}", exact_room(0.8, depth, 16, 4)


def white_furnaces():
    because = "White walls that emit 1: every one of the D + 1 vertices adds exactly 1."
    for depth in (0, 1, 2, 8, 64, 1000, 10000):
        block = expect(because, pixels("D+1", rule="exact"), {"D": depth})
        yield f"F5-depth-{depth}", room(block, view(8), integrator("bsdf", depth), 1, 1)
    because = "Roulette by throughput never ends a path of throughput 1, so that only the depth does."
    block = expect(because, pixels("D+1", rule="exact"), {"D": 100})
    yield "F5-roulette", room(block, view(32), integrator("bsdf", 100, {"type": "throughput", "start": 0}), 1, 1)


def moved_furnaces():
    bodies = {"sphere": {"type": "sphere", "radius": 1}, "mesh": octasphere(4)}
    for kind, body in bodies.items():
        for radius in (1e-4, 1, 1e4):
            for sizes in (0, 1e5):
                offset = [sizes * radius, -sizes * radius, sizes * radius]
                walls = {**body, "transform": [{"scale": radius}, {"translate": offset}]}
                camera = look(*([radius * p + o for p, o in zip(point, offset)] for point in INSIDE), 100, 16)
                name = f"F11-{kind}-radius-{radius:g}" + (f"-offset-{sizes:g}" if sizes else "")
                result = exact_room([0.5, 0.9, 0.99], 64, 16, 4, walls, camera)
                result["expect"]["group"] = "stiff"
                yield name, result


def roulette():
    because = ("X = 1 + (a/q) X' with probability q, else 1; so E X = 1/(1-a) and E X^2 = (1+a)/((1-a)(1-a^2/q)). "
               "The fourth moment is finite: a^4 < q^3.")
    for albedo, q in ((0.5, 0.8), (0.5, 0.5), (0.8, 0.9)):
        facts = [mean("1/(1-a)"), {"subject": "relative_variance", "rule": "stat", "tolerance": 0.05,
                                   "value": "((1+a)/((1-a)*(1-a^2/q))-1/(1-a)^2)*(1-a)^2"}]
        rule = {"type": "constant", "probability": q, "start": 0}
        block = expect(because, facts, {"a": f"float({albedo})", "q": q})
        yield f"F2-albedo-{albedo}-survival-{q}", room(block, view(128), integrator("bsdf", "unlimited", rule), 96, albedo)
    rule = {"type": "throughput", "start": 0}
    because = "A path that survives has throughput 1 again: the number of its vertices is geometric, with mean 1/(1-a)."
    for albedo, spp, delta in ((0.5, 96, None), (0.98, 16, 0.02)):
        facts = [mean("1/(1-a)", delta), {"subject": "relative_variance", "rule": "stat", "value": "a", "tolerance": 0.05}]
        block = expect(because, facts, {"a": f"float({albedo})"})
        yield f"F3-albedo-{albedo}", room(block, view(128), integrator("bsdf", "unlimited", rule), spp, albedo)
    block = expect(because + " Cut off at D it is the sum up to a^D.", mean(geometric("a"), 0.05),
                   {"a": "float(0.9999)", "D": 60000}, long=True)
    yield "F3-albedo-0.9999", room(block, view(128), integrator("bsdf", 60000, rule), 2, 0.9999)
    for start in (0, 3):
        for name, albedo in (("colours", [0.9, 0.5, 0.2]), ("dark", [0.01, 0.005, 0])):
            where = {n: f"float({v})" for n, v in zip("abc", albedo)}
            block = expect("Whatever ends a path, the mean of each channel is 1/(1-a).",
                           mean([f"1/(1-{n})" for n in "abc"]), where)
            rule = {"type": "throughput", "start": start}
            yield f"F3-{name}-start-{start}", room(block, view(128), integrator("bsdf", "unlimited", rule), 192, albedo)


def dark_surfaces():
    """A floor that reflects hardly anything: roulette kills nearly every path."""
    rule = {"type": "throughput", "start": 0}
    sky = {"radiance": 1}

    def floor(expectation, albedo, spp):
        shape = {"type": "rectangle", "size": [2, 2], "material": "floor", "transform": facing_up()}
        return scene(expectation, look_at_point([0.3, 1, 0.2], [0, 0, 0]), integrator("bsdf", 8, rule), spp,
                     [diffuse("floor", albedo)], [shape], environment=sky)

    because = "A floor of albedo a under a sky of radiance 1 has radiance a; the least probability of survival is 1/64."
    yield "P2-albedo-1e-6", floor(expect(because, mean("float(1e-6)", 0.02), group="stiff"), 1e-6, 1024)
    yield "P2-albedo-0", floor(expect("A black floor sends nothing.", pixels(0, rule="exact"), group="stiff"), 0, 4)


def aimed_furnaces():
    albedo = [0.8, 0.5, 0.2]
    where = {n: f"float({v})" for n, v in zip("abc", albedo)}
    view_of_point = look_at_point(INSIDE[0], [1, 0.2, 0.1])
    block = expect(SUM + ", light samples too; further vertices come so close to edges that their variance is infinite.",
                   mean([f"1+{n}" for n in "abc"]), where)
    yield "F4-light", room(block, view_of_point, integrator("light", 1), 32, albedo)
    facts = [mean([geometric(n) for n in "abc"]),
             pixels([f"1+1.5*{n}*(1-{n}^D)/(1-{n})" for n in "abc"], 16, "bound")]
    because = (SUM + ". By the power heuristic a light sample brings at most f cos/(2 p_bsdf) = a/2, a BSDF sample a: no "
               "path exceeds 1 + 3/2 (a + ... + a^D).")
    block = expect(because, facts, {"D": 8, **where})
    yield "F4-path", room(block, view(256), integrator("path", 8), 1, albedo)
    block = expect(SUM + "; between two points of a sphere cos cos'/r^2 is constant, so light samples have no variance.",
                   pixels([geometric(n) for n in "abc"], "1e-4/u"), {"D": 3, **where})
    yield "F4-light-sphere", room(block, view(16), integrator("light", 3), 4, albedo, {"type": "sphere", "radius": 1})


def convex_bodies():
    bodies = {"box": {"type": "box", "size": [1.2, 1.2, 1.2]}, "sphere": {"type": "sphere", "radius": 0.9},
              "mesh": octasphere(6), "disk": {"type": "disk", "radius": 0.9}}
    because = "A convex body of albedo a under a sky of radiance 1 has radiance a, everything else 1: every sample."
    for kind, body in bodies.items():
        block = expect(because, pixels("float(0.8)", 4, **{"or": 1, "or_share": [0.5, 0.9]}))
        yield f"F6-{kind}", scene(block, look([2, 1.5, 3], [0, 0, 0], 45, 64), integrator("bsdf", 4), 1,
                                  [diffuse("body", 0.8)], [{**body, "material": "body"}], environment={"radiance": 1})


def bumpy_floor(n, seed):
    """A flat mesh whose shading normals lie up to 60 degrees off."""
    import math
    numbers = Numbers(seed)
    positions, normals, indices = [], [], []
    for row in range(n + 1):
        for column in range(n + 1):
            positions.append([2 * column / n - 1, 0, 2 * row / n - 1])
            tilt, turn = math.radians(60) * numbers(), 2 * math.pi * numbers()
            normals.append([round(math.sin(tilt) * math.cos(turn), 6), round(math.cos(tilt), 6),
                            round(math.sin(tilt) * math.sin(turn), 6)])
    for row in range(n):
        for column in range(n):
            a = row * (n + 1) + column
            b = a + n + 1
            indices += [[a, b, a + 1], [a + 1, b, b + 1]]
    return {"type": "triangles", "positions": positions, "normals": normals, "indices": indices, "material": "white"}


def shading_normals():
    limits = {"bsdf": (1, "no scattering brings more than the albedo, so no sample more than 1."),
              "path": (1.5, "a sampled direction brings at most 1 and, by the power heuristic, a light sample half of that.")}
    for kind, (limit, because) in limits.items():
        because = "Shading normals make no light: " + because
        facts = [pixels(limit, 16, "bound"), {"subject": "rays", "value": 1.5},
                 {"subject": "mean", "rule": "bound", "value": 1, "tolerance": 16}]
        yield f"F10-{kind}", scene(expect(because, facts, group="stiff"), look([0.5, 1.5, 1], [0, 0, 0], 50, 128),
                                   integrator(kind, 8), 1, [diffuse("white", 1)], [bumpy_floor(8, 10)],
                                   environment={"radiance": 1})


def bumpy_darkness():
    """How dark shading normals make a white floor: told, not judged."""
    because = "Shading normals make no light. How much they lose where a sampled direction is below the surface, the least pixel tells."
    fact = pixels(1, 1024, "bound")
    yield "F10-least", scene(expect(because, fact, group="stiff"), look([0.5, 1.5, 1], [0, 0, 0], 30, 32), integrator("bsdf", 8), 1024,
                             [diffuse("white", 1)], [bumpy_floor(8, 10)], environment={"radiance": 1})


def accumulation():
    because = "A constant sky: however many samples are summed, their mean is that constant."
    for radiance in (0.1, 1e-8, 1e8):
        for log2_spp in (0, 6, 10, 16, 24):
            block = expect(because, pixels(f"float({radiance:g})", 2), group="stiff", long=log2_spp > 10)
            yield f"A1-radiance-{radiance:g}-spp-2-to-{log2_spp}", scene(
                block, look([0, 0, 1], [0, 0, 0], 20, 1), integrator("path", 2), 2**log2_spp,
                environment={"radiance": radiance})
    for width, height in ((1, 1), (1, 4096), (4096, 1), (3, 5)):
        result = exact_room(0.8, 8, 1, 2)
        result["expect"]["group"] = "stiff"
        result["film"]["size"] = [width, height]
        yield f"I1-film-{width}x{height}", result


def scenes():
    for part in (exact_furnaces, white_furnaces, moved_furnaces, roulette, dark_surfaces, aimed_furnaces, convex_bodies,
                 shading_normals, bumpy_darkness, accumulation):
        yield from part()
