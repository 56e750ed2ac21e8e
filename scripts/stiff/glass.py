"""Glass and mirrors: cases F8, F9, M."""
from stiff.parts import (diffuse, expect, facing_down, facing_up, glass, integrator, look, look_at_point, mean, pixels, same,
                         scene, turned)

DEPTH = 1000
SKY = {"radiance": 1}
VIEW = ([0.3, 0.5, 4], [0, 0, 0])
TILTED = turned([1, 2, 3], 23)
# No path of a body of glass may be lost for long; what has not found its way out is nothing.
WAY_OUT = {"or": 0, "or_share": [0, 0.01]}


def invisible(value=1, **more):
    return pixels(value, "2*D", **{**WAY_OUT, **more})


def before_sky(block, materials, shapes, camera=VIEW, kind="path"):
    return scene(block, look(*camera, 35, 64), integrator(kind, DEPTH), 1, materials, shapes, environment=SKY)


def bodies():
    shapes = {"sphere": {"type": "sphere", "radius": 1}, "cube": {"type": "box", "size": [1.3, 1.3, 1.3], "transform": TILTED}}
    because = "Glass loses nothing: R + T = 1, and a path that leaves has gained as much as it lost at each surface."
    for ior in ("1", "1.0000001", "1.33", "1.5", "2.4", "0.6666666666666666", "100"):
        for name, shape in shapes.items():
            facts = [invisible(), {"subject": "rays", "value": 1.5}]
            yield f"F8-{name}-ior-{ior[:9]}", before_sky(expect(because, facts, {"D": DEPTH}), [glass("glass", float(ior))],
                                                         [{**shape, "material": "glass"}])
    for inner in (0.6666666666666666, 1.7):
        facts = [invisible(), {"subject": "rays", "value": 1.5}]
        yield f"F8-shells-{inner:.3g}", before_sky(expect(because, facts, {"D": DEPTH}), [glass("outer", 1.5), glass("inner", inner)],
                                                   [{"type": "sphere", "radius": 1, "material": "outer"},
                                                    {"type": "sphere", "radius": 0.8, "material": "inner"}])


def slabs():
    slab = {"type": "box", "size": [4, 4, 1], "material": "glass"}
    disk = {"type": "disk", "radius": 1, "radiance": 1}
    where = {"n": 1.5, "R": "((n-1)/(n+1))^2"}
    for name, value, move, spp, delta in (
            ("transmits", "(1-R)/(1+R)", {"translate": [0, 0, -2]}, 32, None),
            ("reflects", "2*R/(1+R)", [turned([0, 1, 0], 180), {"translate": [0, 0, 6]}], 192, 0.02)):
        because = "A slab at normal incidence with all its inner reflections: T = (1-R)/(1+R) = 12/13, the rest returns, 1/13."
        yield f"F9-{name}", scene(expect(because, mean(value, delta), where), look_at_point([0, 0, 5], [0, 0, 0]), integrator("path", 64), spp,
                                  [glass("glass", 1.5)], [slab], [{**disk, "transform": move}])
    because = "Light inside glass has n^2 times the radiance that it has outside: (1-R)/n^2 of it is seen."
    yield "F9-light-inside", scene(expect(because, mean("(1-R)/n^2"), where), look_at_point([0, 0, 5], [0, 0, 0]), integrator("path", 1), 32,
                                   [glass("glass", 1.5)], [slab], [disk])


def index_of_one():
    """A row of glowing tiles, seen through what must be nothing."""
    tiles = [{"type": "rectangle", "size": [0.2, 1.6], "radiance": 1 + k, "transform": {"translate": [0.4 * k - 0.8, 0, -2]}} for k in range(5)]

    def seen_through(block, shapes, ior):
        return scene(block, look([0.1, 0.2, 3], [0, 0, 0], 30, 64), integrator("path", 16), 1, [glass("glass", ior)] if shapes else [], shapes,
                     tiles)

    body = [{"type": "sphere", "radius": 0.8, "material": "glass"}]
    yield "M3-removed", seen_through(expect("Glowing tiles, to compare with; nothing else is seen or seen brighter.", pixels(5, 0, "bound"),
                                            group="stiff"), [], 1)
    for ior, share in (("1", 1), ("1.0000001", 0.999), ("0.9999999", 0.999)):
        because = "Glass of index 1 reflects nothing and bends nothing: as if it were not there; within 1e-7 of 1 edges move by no more."
        fact = same(rule="count", scene="M3-removed.json", tolerance=1e-5, share=share)
        yield f"M3-ior-{ior}", seen_through(expect(because, fact, group="stiff"), body, float(ior))


def nested():
    because = "Bodies of glass in each other and overlapping hide nothing of a uniform sky, in whatever order they are listed."
    materials = [glass("a", 1.5), glass("b", 1.33)]
    arrangements = {
        "nested": [{"type": "sphere", "radius": 1, "material": "a"}, {"type": "sphere", "radius": 0.5, "material": "b"}],
        "overlapping": [{"type": "sphere", "radius": 0.8, "material": "a", "transform": {"translate": [-0.3, 0, 0]}},
                        {"type": "sphere", "radius": 0.7, "material": "b", "transform": {"translate": [0.4, 0, 0]}}]}
    for name, shapes in arrangements.items():
        facts = [invisible(), {"subject": "rays", "value": 1.5}]
        yield f"M5-{name}", before_sky(expect(because, facts, {"D": DEPTH}, "stiff"), materials, shapes)
        facts = [same(scene=f"M5-{name}.json"), invisible()]
        yield f"M5-{name}-permuted", before_sky(expect(because, facts, {"D": DEPTH}, "stiff"), materials, shapes[::-1])
    because = "From inside glass of index n a uniform sky has n^2 times its radiance; some directions are reflected for ever."
    fact = pixels("n^2", "2*D", **{"or": 0, "or_share": [0, 0.6]})
    yield "M5-camera-inside", before_sky(expect(because, fact, {"D": DEPTH, "n": 1.5}, "stiff"), materials[:1],
                                         [{"type": "sphere", "radius": 1, "material": "a"}], ([0.3, 0.2, 0.5], [0, 0, 0]))


def mirrors():
    because = "A light met after a mirror counts once, whichever way lights are sampled: r L."
    for kind in ("hemisphere", "bsdf", "light", "path"):
        block = expect(because, pixels("float(0.9)*2", 4), group="analytic")
        yield f"M0-mirror-{kind}", scene(block, look_at_point([3, 2, 0], [0, 0, 0], 8), integrator(kind, 5), 4,
                                         [{"name": "mirror", "type": "mirror", "reflectance": 0.9}],
                                         [{"type": "rectangle", "size": [10, 10], "material": "mirror", "transform": facing_up()}],
                                         [{"type": "rectangle", "size": [1, 1], "radiance": 2, "transform": facing_down(-3, 2, 0)}])


def scenes():
    for part in (bodies, slabs, index_of_one, nested, mirrors):
        yield from part()
