"""Scale, translation, awkward triangles, trees, grazing rays: cases S, G, B, R, P4."""
import math

from stiff.parts import (box_triangles, diffuse, expect, facing_down, facing_up, integrator, look, look_at_point, mean, octasphere,
                         pixels, same, scene)

SKY = {"radiance": 1}
UNDER_SKY = "Bodies without hollows, albedo a, under a sky of radiance 1: a where a body is, else 1"


def turned_box(centre, size, cosine, sine):
    """A box turned about y whose corners are multiples of 2^-10."""
    mesh = box_triangles([-0.5, -0.5, -0.5], [0.5, 0.5, 0.5])
    points = []
    for x, y, z in mesh["positions"]:
        x, y, z = x * size[0], y * size[1], z * size[2]
        p = (centre[0] + x * cosine + z * sine, centre[1] + y, centre[2] - x * sine + z * cosine)
        points.append([round(c * 1024) / 1024 for c in p])
    return {**mesh, "positions": points}


def box_room(block, scale=1, offset=(0, 0, 0), integrator_=None, spp=64, size=32):
    """The course's room, with corners that are exact in binary; the lamp itself is not seen."""
    room = box_triangles([-1, 0, -1], [1, 2, 1])
    # Open towards the viewer: without the face at z = 1.
    room["indices"] = [t for t in room["indices"] if any(room["positions"][i][2] < 0 for i in t)]
    steps = [{"scale": scale}, {"translate": list(offset)}]

    def place(p):
        return [c * scale + o for c, o in zip(p, offset)]

    shapes = [{**room, "material": "white", "flip_normals": True, "transform": steps},
              {**turned_box([0.33, 0.3, -0.37], [0.6, 0.6, 0.6], 0.9576, 0.2881), "material": "red", "transform": steps},
              {**turned_box([-0.34, 0.6, 0.29], [0.6, 1.2, 0.6], 0.9397, -0.342), "material": "green", "transform": steps}]
    lamp = {"type": "triangles", "positions": [[-0.25, 1.984375, -0.25], [0.25, 1.984375, -0.25], [0.25, 1.984375, 0.25], [-0.25, 1.984375, 0.25]],
            "indices": [[0, 1, 2], [0, 2, 3]], "radiance": [17, 12, 4], "transform": steps}
    view = look(place([0, 1, 6.75]), place([0, 1, 0]), 16, size)
    materials = [diffuse("white", 0.75), diffuse("red", [0.6, 0.1, 0.1]), diffuse("green", [0.1, 0.5, 0.1])]
    return scene(block, view, integrator_ or integrator("path", 12, {"type": "throughput", "start": 3}), spp, materials, shapes, [lamp])


def scaled_rooms():
    yield "S1-base", box_room(expect("The room that the others are compared with; its kernel for nothing else gives the same bits.",
                                     [same(specialized=True), same(overrides=["accelerator=none"])], group="stiff"))
    because = "Radiance does not change with size, and scaling by a power of two rounds nothing: the same bits."
    for power in (-40, -20, -1, 1, 20, 40):
        block = expect(because, same(scene="S1-base.json"), group="stiff")
        yield f"S1-scale-2-to-{power}", box_room(block, 2.0**power)
    because = "Moved by what is exact in binary, the scene is the same bits."
    for distance in (2e5, 2e6, 2e7):
        block = expect(because, same(scene="S1-base.json"), group="stiff")
        yield f"S3-offset-{distance:g}", box_room(block, 1, [distance, -distance, distance])
    because = "Scaled by what is no power of two: the same but for rounding."
    for scale in (1e-6, 1e-3, 1e3, 1e6):
        facts = [same(rule="count", scene="S1-base.json", tolerance=1e-4, share=0.999), same(rule="stat", scene="S1-base.json", delta=0.04)]
        yield f"S2-scale-{scale:g}", box_room(expect(because, facts, group="stiff"), scale)


def roulette_sweep():
    because = "Roulette changes the noise, never the mean."
    for name, rule in (("off", "off"), ("throughput-0", {"type": "throughput", "start": 0}), ("throughput-5", {"type": "throughput", "start": 5}),
                       ("constant-0.9", {"type": "constant", "probability": 0.9, "start": 0}),
                       ("constant-0.8", {"type": "constant", "probability": 0.8, "start": 3})):
        reference = integrator("path", 40, rule)
        facts = same(rule="stat", overrides=["integrator.roulette=off", "sampler.seed=1"], delta=0.02)
        yield f"P4-{name}", box_room(expect(because, facts), integrator_=reference, spp=64, size=64)


def under_sky(block, bodies, camera=([2, 1.5, 3], [0, 0, 0]), width=64, albedo=0.8, fov=45, spp=1, **more):
    materials = [diffuse("body", albedo)] if bodies else []
    return scene(block, look(*camera, fov, width), integrator("bsdf", 8), spp, materials, [{"material": "body", **body} for body in bodies],
                 environment=SKY, **more)


def body_pixels(tolerance=4, low=0.0, high=1.0):
    return pixels("float(0.8)", tolerance, **{"or": 1, "or_share": [low, high]})


def sizes():
    small = {**octasphere(8), "transform": [{"scale": 0.05}, {"translate": [0, 0.05, 0]}]}
    stadium = {"type": "rectangle", "size": [1000, 1000], "transform": facing_up()}
    facts = [same(overrides=["accelerator=none"]), same(overrides=["accelerator.build=device"])]
    yield "S4-body-in-stadium", under_sky(expect("A body of 0.1 in a plain of 1000: the tree finds what testing everything finds.", facts, group="stiff"),
                                          [stadium, small], ([0.2, 0.15, 0.3], [0, 0.05, 0]), accelerator="lbvh")
    for size in (1e-20, 1e-10, 1e14):
        body = {**octasphere(6), "transform": [{"scale": size}]}
        camera = ([c * size for c in (2, 1.5, 3)], [0, 0, 0])
        yield f"S5-size-{size:g}", under_sky(expect(UNDER_SKY + ", at any size.", body_pixels(8, 0.5, 0.9), group="stiff"), [body], camera)
    fact = {"subject": "load_error", "text": "between -1e+15 and 1e+15", "overrides": ["shapes.0.transform.0.scale=1e18"]}
    yield "S5-size-1e+18", under_sky(expect("A body whose squares and products floats could not hold is an error.", fact, group="stiff"),
                                     [{**octasphere(6), "transform": [{"scale": 1}]}])


def triangles(positions, indices, **more):
    return {"type": "triangles", "positions": positions, "indices": indices, **more}


def awkward_triangles():
    none = same(overrides=["accelerator=none"])
    because = UNDER_SKY + "; the tree finds what testing everything finds."
    positions, indices = [], []
    for k in range(64):
        y, z = (k % 8) / 8 - 0.5, (k // 8) / 8 - 0.5
        positions += [[-0.5, y, z], [0.5, y, z], [0, y + 1e-6, z]]
        indices.append([3 * k, 3 * k + 1, 3 * k + 2])
    yield "G1-needles", under_sky(expect(because, [body_pixels(), none], group="stiff"), [triangles(positions, indices)], accelerator="lbvh")
    positions, indices = [[0, 0, 0]], []
    for k in range(65):
        angle = 1e-7 * k + 0.3
        positions.append([math.cos(angle), math.sin(angle), 0])
    indices = [[0, k, k + 1] for k in range(1, 65)]
    yield "G1-slivers", under_sky(expect(because, [body_pixels(), none], group="stiff"), [triangles(positions, indices)], accelerator="lbvh")
    n = 512
    positions = [[0, 0, 0]] + [[math.cos(2 * math.pi * k / n), 0, math.sin(2 * math.pi * k / n)] for k in range(n)]
    indices = [[0, 1 + (k + 1) % n, 1 + k] for k in range(n)]
    yield "G1-fan", under_sky(expect(because, [body_pixels(4, 0.4, 0.95), none], group="stiff"), [triangles(positions, indices)], ([0.1, 3, 0.2], [0, 0, 0]),
                              accelerator="lbvh", width=96)


def bad_triangles():
    shape = triangles([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])

    def fails(text, *overrides):
        return {"subject": "load_error", "text": text, "overrides": list(overrides)}

    facts = [fails("has no area", "shapes.0.positions.2=[2,0,0]"), fails("two corners in the same place", "shapes.0.indices.0=[0,1,1]"),
             fails("must be between -1e+15 and 1e+15", "shapes.0.positions.1.0=1e39"), fails("must be a number", "shapes.0.positions.1.0=\"nan\""),
             fails("1e400", "shapes.0.positions.1.0=1e400"), fails("must be less than the number of positions, 3", "shapes.0.indices.0=[0,1,3]"),
             fails("must be a list of 3 integers", "shapes.0.indices.0=[0,1]"), fails("must be between 0", "shapes.0.indices.0.0=-1")]
    yield "G2-errors", under_sky(expect("What is no triangle is an error that says where, and never a black picture.", facts, group="stiff"), [shape])
    yield "G2-clean", under_sky(expect(UNDER_SKY + ".", body_pixels(), group="stiff"), [shape], ([0.3, 0.3, 2], [0.3, 0.3, 0]))
    bad = triangles(shape["positions"] + [[0.5, 0, 0], [1, 0, 0]], [[0, 3, 4], [0, 1, 2], [2, 2, 1]])
    facts = [same(scene="G2-clean.json"), {"subject": "warning", "text": "2 triangles without area"}]
    yield "G2-lenient", under_sky(expect("Leniently, triangles without area are dropped and counted; the picture is that without them.", facts, group="stiff",
                                         lenient=True), [bad], ([0.3, 0.3, 2], [0.3, 0.3, 0]))


def coincident():
    square = {"type": "rectangle", "size": [2, 2], "transform": facing_up()}
    view = look([0.1, 2, 0.3], [0, 0, 0], 20, 32)
    materials = [diffuse("light", 0.8), diffuse("dark", 0.3)]
    because = "Of surfaces in one plane the one listed first is seen, by every ray."
    for name, order in (("light-first", ("light", "dark")), ("dark-first", ("dark", "light"))):
        for accelerator in ("none", "lbvh"):
            value = 0.8 if name == "light-first" else 0.3
            yield f"G3-{name}-{accelerator}", scene(expect(because, pixels(f"float({value})", 4), group="stiff"), view, integrator("bsdf", 4), 1, materials,
                                                    [{**square, "material": m} for m in order], accelerator=accelerator, environment=SKY)
    stack = triangles([[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]], [[0, 1, 2], [0, 2, 3]] * 128)
    facts = [pixels("float(0.8)", 4), same(overrides=["accelerator=none"])]
    yield "G3-256-identical-triangles", under_sky(expect("Triangles in one place are one.", facts, group="stiff"), [stack], ([0.1, 2, 0.3], [0, 0, 0]), 32,
                                                  fov=20, accelerator="lbvh")


def trees():
    facts = [same(overrides=["accelerator=none"])]
    nested = [[s * (1 + k / 256) * c for c in p] for k in range(256) for s, p in
              ((1, (-1, -0.5, 0)), (1, (1, -0.5, 0)), (1, (0, 1, 0)))]
    yield "B2-equal-centroids", under_sky(expect("Nested triangles have one centroid: the tree is split all the same.", facts, group="stiff"),
                                          [triangles(nested, [[3 * k, 3 * k + 1, 3 * k + 2] for k in range(256)])], ([0, 0, 4], [0, 0, 0]), accelerator="lbvh")
    positions = []
    # With their mirror images the origin is the centre of the scene, about which floats are finest.
    for k in range(50):
        for x in (2.0**-k, -(2.0**-k)):
            positions += [[x, 0, 0], [x * 1.25, 0, 0], [x, x / 4, 0]]
    facts = [same(overrides=["accelerator=none"])]
    yield "B3-one-split-per-level", under_sky(expect("Centroids at 2^-k: one triangle leaves the tree at each level.", facts, group="stiff"),
                                              [triangles(positions, [[3 * k, 3 * k + 1, 3 * k + 2] for k in range(100)])], ([0.4, 0.3, 2], [0, 0, 0]),
                                              accelerator="lbvh")
    yield "B4-no-primitives", under_sky(expect("Without surfaces every pixel is the sky.", pixels(1, rule="exact"), group="stiff"), [])
    for count in (1, 2, 3):
        mesh = triangles([[-1, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]], [[0, 1, 2], [0, 3, 1], [0, 4, 3]][:count])
        facts = [same(overrides=["accelerator=none"]), {"subject": "rays", "value": 1.01}]
        yield f"B4-{count}-triangles", under_sky(expect("So few triangles make a tree of one leaf.", facts, group="stiff"), [mesh], ([0.2, 0.3, 4], [0, 0, 0]),
                                                 accelerator="lbvh")


def difficult_rays():
    square = triangles([[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0]], [[0, 1, 2], [0, 2, 3]])
    at = [0.30458447, 0.30458447, 10 - 0.9024725]
    for accelerator in ("none", "lbvh"):
        block = expect("Rays that meet the diagonal of a square meet one of its triangles.", pixels("float(0.8)", 4), group="stiff")
        yield f"R2-diagonal-{accelerator}", scene(block, look_at_point([0, 0, 10], at, 8), integrator("bsdf", 2), 4, [diffuse("body", 0.8)],
                                                  [{**square, "material": "body"}], accelerator=accelerator, environment=SKY)
    for gap in (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6):
        floor = {"type": "rectangle", "size": [1, 1], "transform": facing_up(), "material": "floor"}
        sheet = {"type": "rectangle", "size": [1, 1], "transform": facing_down(0, gap, 0), "radiance": 1}
        # Directions within a cone of tan = 1/2 / gap about the normal meet the sheet for certain.
        missed = gap**2 / (gap**2 + 0.25)
        fact = pixels("float(0.8)", 4, **{"or": 0, "or_share": [0, round(missed + 5 * math.sqrt(missed / 16384), 7)]})
        block = expect(f"A sheet that glows {gap:g} above a floor is met by all but a share of g^2/(g^2+1/4) of its rays at most.", fact, group="stiff")
        yield f"R4-gap-{gap:g}", scene(block, look_at_point([0.1, gap / 2, 0.05], [0, 0, 0]), integrator("bsdf", 2), 1, [diffuse("floor", 0.8)],
                                       [floor], [sheet])


def scenes():
    for part in (scaled_rooms, roulette_sweep, sizes, awkward_triangles, bad_triangles, coincident, trees, difficult_rays):
        yield from part()
