"""A diffuse floor under lights of every kind and in every awkward place: cases L, E and the closed forms they rest on."""
import math

from stiff.parts import (ESTIMATORS, diffuse, expect, facing_down, facing_up, integrator, look, look_at_point, mean,
                         pixels, scene, turned)

ALBEDO, RADIANCE = 0.6, 3
FULL = {"rho": f"float({ALBEDO})", "L": RADIANCE}
PARALLEL = "(A/sqrt(1+A^2)*atan(B/sqrt(1+A^2))+B/sqrt(1+B^2)*atan(A/sqrt(1+B^2)))/(2*pi)"
PERPENDICULAR = "(atan(1/Y)-Y/sqrt(X^2+Y^2)*atan(1/sqrt(X^2+Y^2)))/(2*pi)"
ABOVE = (0.8, 0.3, 0.1)  # where the camera is, unless the light is in its way


def lit_floor(block, kind, spp, lights, shapes=(), size=2, camera=ABOVE, depth=4, width=128, albedo=ALBEDO, **more):
    """The camera sees the floor's origin."""
    floor = {"type": "rectangle", "size": [size, size], "material": "floor", "transform": facing_up()}
    materials = [diffuse("floor", albedo)] + ([diffuse("black", 0)] if shapes else [])
    return scene(block, look_at_point(list(camera), [0, 0, 0], width), integrator(kind, depth), spp, materials,
                 [floor, *shapes], lights, **more)


def rectangle(size, transform, radiance=RADIANCE, **more):
    return {"type": "rectangle", "size": size, "radiance": radiance, "transform": transform, **more}


def delta_of(kind):
    """Directions find a light only by chance, so its mean is known less well."""
    return None if kind in ("light", "path") else 0.02


def closed_forms():
    far = {"size": 10, "camera": (3, 0.2, 0.1)}
    where = {**FULL, "A": "0.7/0.9", "B": "1.3/0.9", "F": PARALLEL}
    because = "Lambert's rectangle: a x b, parallel to the floor, a corner c above the point; radiance rho L F."
    for kind in ESTIMATORS:
        light = rectangle([0.7, 1.3], facing_down(0.35, 0.9, 0.65))
        yield f"L0-rectangle-{kind}", lit_floor(expect(because, mean("rho*L*F", delta_of(kind)), where), kind, 128, [light], **far)
    where = {**FULL, "H": "0.8/0.9", "r": "0.6/0.9", "Z": "1+H^2+r^2", "F": "(1-(1+H^2-r^2)/sqrt(Z^2-4*r^2))/2"}
    because = "A disk of radius R, h above the floor, its axis d beside the point: form factor F, radiance rho L F."
    for kind in ESTIMATORS:
        light = {"type": "disk", "radius": 0.6, "radiance": RADIANCE, "transform": facing_down(0, 0.8, 0.9)}
        yield f"L0-disk-{kind}", lit_floor(expect(because, mean("rho*L*F", delta_of(kind)), where), kind, 128, [light], **far)
    for theta in (0.7, 1.2):
        sunk = "(c*acos(-q*c/sin(t))-q*sqrt(1-(H*c)^2))/(pi*H^2)+atan(sqrt(1-(H*c)^2)/q)/pi"
        form_factor = "c/H^2" if 1.6 * math.cos(theta) >= 1 else sunk
        where = {**FULL, "H": 1.6, "t": theta, "c": "cos(t)", "q": "sqrt(H^2-1)", "F": form_factor}
        because = "A sphere of radius 1 at distance H, its centre t from the normal: form factor F, radiance rho L F."
        for kind in ESTIMATORS:
            move = {"translate": [0, 1.6 * math.cos(theta), 1.6 * math.sin(theta)]}
            light = {"type": "sphere", "radius": 1, "radiance": RADIANCE, "transform": move}
            block = expect(because, mean("rho*L*F", delta_of(kind)), where)
            yield f"L0-sphere-{theta}-{kind}", lit_floor(block, kind, 128, [light], **far)
            if kind in ("light", "path"):
                by_area = lit_floor(expect(because, mean("rho*L*F", 0.02), where), kind, 256, [light], **far)
                by_area["integrator"].update(sphere_lights="area", **({"heuristic": "balance"} if kind == "path" else {}))
                yield f"L0-sphere-{theta}-{kind}-by-area", by_area
    where = {**FULL, "A": "0.7/0.9", "B": "1.3/0.9", "F": PARALLEL, "S": "float(0.7)"}
    because = "A rectangle of form factor F hides that part of a sky of radiance S: rho (L F + S (1 - F))."
    for kind in ESTIMATORS:
        light = rectangle([0.7, 1.3], facing_down(0.35, 0.9, 0.65))
        yield f"L0-rectangle-and-sky-{kind}", lit_floor(expect(because, mean("rho*(L*F+S*(1-F))", 0.02), where), kind, 64, [light],
                                                        environment={"radiance": 0.7}, **far)


def close_lights():
    for e in (1, 0.1, 0.01, 1e-3, 1e-6):
        where = {**FULL, "e": e, "A": "1/(2*e)", "B": "1/(2*e)", "F": "4*" + PARALLEL}
        light = rectangle([1, 1], facing_down(0, e, 0))
        below = {"size": 1, "camera": (0.3, e / 2, 0.05)}
        because = "A unit square e above the point: four rectangles with a corner overhead."
        yield f"L1-distance-{e:g}", lit_floor(expect(because, mean("rho*L*F", 0.002), where, "stiff"), "path", 256, [light], **below)
        because = "The power heuristic bounds a light sample by rho L/2 and a BSDF sample by rho L, however close the light."
        yield f"L1-bound-{e:g}", lit_floor(expect(because, pixels("1.5*rho*L", 8, "bound"), FULL, "stiff"), "path", 1, [light],
                                           width=256, **below)
    for e in (0.1, 0.03, 0.01):
        because = "Light samples alone, expected to be ill-conditioned: relative variance -> area/(3 pi e^2) as e -> 0."
        fact = {"subject": "relative_variance", "rule": "stat", "value": "1/(3*pi*e^2)", "tolerance": 0.1}
        light = rectangle([1, 1], facing_down(0, e, 0))
        # The fourth moment grows with 1 / e^2, and with it the samples that the second needs.
        is_rare = e < 0.03
        yield f"L1-variance-{e:g}", lit_floor(expect(because, fact, {"e": e}, "stiff", is_rare), "light", 1024 if is_rare else 64, [light],
                                              size=1, camera=(0.3, e / 2, 0.05))


def wall_below_light(block, kind, spp, e, width=128):
    wall = {"type": "rectangle", "size": [2, 2], "material": "wall", "transform": turned([0, 1, 0], 90)}
    return scene(block, look_at_point([0.6, 0.9 - e, 0.2], [0, 1 - e, 0], width), integrator(kind, 4), spp,
                 [diffuse("wall", ALBEDO)], [wall], [rectangle([1, 1], facing_down(0.5, 1, 0))])


def touching_lights():
    for e in (1, 0.1, 0.01, 1e-4):
        where = {**FULL, "X": 2, "Y": f"{e:g}/0.5", "F": "2*" + PERPENDICULAR}
        because = "A unit square that touches the wall, e above the point: two perpendicular rectangles side by side."
        yield f"L2-distance-{e:g}", wall_below_light(expect(because, mean("rho*L*F"), where, "stiff"), "path", 256, e)
        because = "The power heuristic bounds a light sample by rho L/2 and a BSDF sample by rho L, however close the light."
        yield f"L2-bound-{e:g}", wall_below_light(expect(because, pixels("1.5*rho*L", 8, "bound"), FULL, "stiff"), "path", 1, e, 256)
    because = "Light samples alone, expected to be ill-conditioned: second moment -> (rho L)^2 area/(24 pi e^2) as e -> 0."
    fact = {"subject": "second_moment", "rule": "stat", "value": "(rho*L)^2/(24*pi*e^2)", "tolerance": 0.1}
    for e, spp in ((0.1, 64), (0.01, 2048)):
        yield f"L2-second-moment-{e:g}", wall_below_light(expect(because, fact, {**FULL, "e": e}, "stiff", spp > 64), "light", spp, e)


def tiny_bright_light():
    because = "A square of 1e-6 m and radiance 1e12: rho L A cos cos'/(pi d^2), to 1e-12 of what quadrature says."
    where = {"rho": f"float({ALBEDO})", "L": 1e12, "A": 1e-12, "d2": 1, "cosines": 1}
    for kind in ("light", "path"):
        light = rectangle([1e-6, 1e-6], facing_down(0, 1, 0), 1e12)
        yield f"L3-overhead-{kind}", lit_floor(expect(because, mean("rho*L*A*cosines/(pi*d2)", 1e-4), where, "stiff"), kind, 16, [light],
                                               size=1, camera=(0.3, 0.8, 0.4))


def rooms_of_unequal_light():
    """Two closed rooms; each must find its own light, of 1e-16 the other's power."""
    where = {"rho": f"float({ALBEDO})", "A": "0.5/0.99", "B": "0.5/0.99", "F": "4*" + PARALLEL}
    because = "Each room has the form factor of its own light: what chooses lights must not forget the dim one."
    rooms = []
    lights = []
    for x, radiance in ((-2, 1e8), (2, 1e-8)):
        rooms.append({"type": "box", "size": [2, 1, 2], "material": "walls", "flip_normals": True,
                      "transform": {"translate": [x, 0.5, 0]}})
        lights.append(rectangle([1, 1], facing_down(x, 0.99, 0), radiance))
    for name, x, radiance in (("bright", -2, 1e8), ("dim", 2, 1e-8)):
        for kind in ("light", "path"):
            block = expect(because, mean(f"rho*float({radiance:g})*F", 0.02), where, "stiff")
            yield f"L4-{name}-{kind}", scene(block, look_at_point([x + 0.8, 0.3, 0.1], [x, 0, 0]), integrator(kind, 1), 256,
                                             [diffuse("walls", ALBEDO)], rooms, lights)


def occluders():
    where = {**FULL, "A": 0.5, "B": 0.5, "F": "2*" + PARALLEL}
    because = "A black sheet just below the light hides the half of it on one side of the point: two of four rectangles are left."
    for kind in ("bsdf", "light", "path"):
        for gap in (1e-6, 1e-3):
            sheet = {"type": "rectangle", "size": [1, 2], "material": "black", "transform": facing_down(-0.5, 1 - gap, 0)}
            light = rectangle([1, 1], facing_down(0, 1, 0))
            yield f"L5-gap-{gap:g}-{kind}", lit_floor(expect(because, mean("rho*L*F", delta_of(kind)), where, "stiff"), kind, 192, [light], [sheet])


def lights_from_behind():
    because = "A light that emits upwards only, seen from below: nothing."
    shapes = {"rectangle": {"type": "rectangle", "size": [1, 1]}, "disk": {"type": "disk", "radius": 0.5}}
    for kind in ESTIMATORS:
        for name, shape in shapes.items():
            light = {**shape, "radiance": RADIANCE, "transform": facing_up(0, 1, 0)}
            yield f"L6-behind-{name}-{kind}", lit_floor(expect(because, pixels(0, rule="exact"), group="stiff"), kind, 8, [light])
    where = {**FULL, "A": 0.5, "B": 0.5, "F": "4*" + PARALLEL}
    because = "A light that emits from both sides gives as much backwards as forwards."
    for kind in ("bsdf", "path"):
        light = rectangle([1, 1], facing_up(0, 1, 0), two_sided=True)
        yield f"L6-two-sided-{kind}", lit_floor(expect(because, mean("rho*L*F", delta_of(kind)), where, "stiff"), kind, 96, [light])
    because = "Two lights in one place: the one listed first is met by every ray, and the other by none."
    for kind in ("hemisphere", "bsdf"):
        lights = [rectangle([1, 1], facing_down(0, 1, 0)), rectangle([1, 1], facing_down(0, 1, 0), 5)]
        yield f"L6-duplicate-{kind}", lit_floor(expect(because, mean("rho*L*F", 0.02), where, "stiff"), kind, 96, lights)


def cut_light(columns, rows):
    """The unit square cut into columns x rows rectangles of very unequal size, two triangles each."""
    positions = [[(c / columns) ** 2 - 0.5, (r / rows) ** 2 - 0.5, 0] for r in range(rows + 1) for c in range(columns + 1)]
    indices = []
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            b = a + columns + 1
            indices += [[a, a + 1, b + 1], [a, b + 1, b]]
    return {"type": "triangles", "positions": positions, "indices": indices, "radiance": RADIANCE,
            "transform": facing_down(0, 1, 0)}


def cut_lights():
    where = {**FULL, "A": 0.5, "B": 0.5, "F": "4*" + PARALLEL}
    because = "A unit square 1 above the point, cut into triangles of very unequal area: the same light."
    for columns, rows in ((1, 1), (4, 2), (64, 32)):
        for kind in ("light", "path"):
            block = expect(because, mean("rho*L*F"), where)
            yield f"L7-{2 * columns * rows}-triangles-{kind}", lit_floor(block, kind, 32, [cut_light(columns, rows)], size=10,
                                                                         camera=(3, 0.2, 0.1))
    small = {"A": 0.35, "B": 0.05, "F": PARALLEL}
    where = {**FULL, "F1": PARALLEL.replace("A", "0.35").replace("B", "0.05"), "F2": PARALLEL.replace("A", "0.25").replace("B", "0.05"),
             "F3": PARALLEL.replace("A", "(2/1.5)").replace("B", "(1/1.5)"), "small": "2*(F1-F2)", "large": "F3"}
    because = "Two lights of unequal area and radiance add up: rho (80 F_small + 0.5 F_large)."
    for kind in ("light", "path"):
        lights = [rectangle([0.1, 0.1], facing_down(0.3, 1, 0), 80), rectangle([2, 1], facing_down(-1, 1.5, 0.5), 0.5)]
        yield f"L7-unequal-{kind}", lit_floor(expect(because, mean("rho*(80*small+0.5*large)"), where), kind, 128, lights, size=10,
                                              camera=(3, 0.2, 0.1))


def quadrants():
    def part(a, b):
        return PARALLEL.replace("A", f"({a}/0.8)").replace("B", f"({b}/0.8)")

    where = {**FULL, "F": f"{part(1, 1.3)}-{part(0.1, 1.3)}-{part(1, 0.1)}+{part(0.1, 0.1)}"}
    because = "A light from 0.1 to 1 along x and from 0.1 to 1.3 along z, or its mirror image in another quadrant: the same."
    for kind in ESTIMATORS:
        for sign_x in (-1, 1):
            for sign_z in (-1, 1):
                light = rectangle([0.9, 1.2], facing_down(0.55 * sign_x, 0.8, 0.7 * sign_z))
                name = f"L8-{'-+'[sign_x > 0]}x{'-+'[sign_z > 0]}z-{kind}"
                yield name, lit_floor(expect(because, mean("rho*L*F", delta_of(kind)), where), kind, 160, [light],
                                      size=10, camera=(3, 0.2, 0.1))


def horizons():
    where = {**FULL, "X": 1.2, "Y": 1.4, "F": "2*" + PERPENDICULAR}
    because = "An upright light, its lower half below the floor: only what is above the horizon counts, 0.6 of 1.2."
    for kind in ESTIMATORS:
        light = rectangle([1, 1.2], {"translate": [0, 0, -0.7]})
        yield f"L9-half-sunk-{kind}", lit_floor(expect(because, mean("rho*L*F", delta_of(kind)), where), kind, 256, [light])
    because = ("Lights whose plane goes through the point, upright and in the floor's plane: nothing, but that the rounded point "
               "may lie before their plane.")
    for kind in ESTIMATORS:
        lights = [rectangle([0.5, 0.5], {"translate": [0, 0.5, 0]}), rectangle([0.5, 0.5], facing_up(-1.3, 0, 0))]
        fact = {"subject": "mean", "rule": "bound", "value": "16*u*L", "tolerance": 0}
        yield f"L9-edge-on-{kind}", lit_floor(expect(because, fact, FULL), kind, 16, lights, camera=(0.3, 0.8, 0.1))


def ceilings():
    for kind in ("bsdf", "light", "path"):
        ceiling = {"type": "rectangle", "size": [2, 2], "material": "black", "transform": facing_down(0, 1, 0)}
        for gap in (1e-2, 1e-4, 1e-6):
            where = {**FULL, "A": f"0.5/(1-{gap:g})", "B": f"0.5/(1-{gap:g})", "F": "4*" + PARALLEL}
            light = rectangle([1, 1], facing_down(0, 1 - gap, 0))
            block = expect("A light just before a ceiling shines as if there were none.", mean("rho*L*F", delta_of(kind)), where, "stiff")
            yield f"L10-before-{gap:g}-{kind}", lit_floor(block, kind, 96, [light], [ceiling])
            light = rectangle([1, 1], facing_down(0, 1 + gap, 0))
            block = expect("A light just behind a ceiling does not shine.", pixels(0, rule="exact"), group="stiff")
            yield f"L10-behind-{gap:g}-{kind}", lit_floor(block, kind, 8, [light], [ceiling])


def darkness():
    facts = [pixels(0, rule="exact"), {"subject": "warning", "text": "nothing in the scene emits light"}]
    yield "L11-no-light", lit_floor(expect("Without any light the picture is black, and a warning says why.", facts, group="stiff"), "path", 4,
                                    [], width=8)


def light_moments(size, height, n=400):
    """Form factor of a centred square overhead, and the relative second moment of sampling it by area, by the midpoint rule."""
    first = second = 0.0
    for i in range(n):
        for j in range(n):
            x, z = ((i + 0.5) / n - 0.5) * size, ((j + 0.5) / n - 0.5) * size
            g = height**2 / (math.pi * (x * x + z * z + height * height) ** 2) * size**2
            first, second = first + g / n**2, second + g * g / n**2
    return first, second


def combined_variance():
    because = ("Veach's theorem 9.2: one sample of each, combined, has at most half a squared mean more variance than the better one. "
               "F, M are the first moments of area sampling (quadrature); sampling directions has F(1-F).")
    for name, size, height in (("overhead", 1, 1), ("close", 1, 0.1), ("far", 0.2, 2)):
        first, second = light_moments(size, height)
        where = {"F": round(first, 7), "M": round(second, 7)}
        fact = {"subject": "relative_variance", "rule": "bound", "value": "min(F*(1-F),M-F^2)/F^2+1/2", "tolerance": 0.005}
        yield f"L12-combined-{name}", lit_floor(expect(because, fact, where), "path", 32, [rectangle([size, size], facing_down(0, height, 0))],
                                                size=1, camera=(0.3, 0.05, 0.05))


def skies():
    because = "E = pi under a sky of radiance 1, so that the floor sends its albedo, whichever way it is sampled."
    for kind in ESTIMATORS:
        yield f"E3-floor-{kind}", lit_floor(expect(because, mean("rho", 0.01 if kind == "light" else None), {"rho": FULL["rho"]}, "stiff"), kind, 64, [],
                                            environment={"radiance": 1})
    because = "Straight up and down, and along the axes: the sky's radiance."
    for name, at, up in (("up", [0, 1, 0], [0, 0, 1]), ("down", [0, -1, 0], [0, 0, 1]), ("x", [1, 0, 0], [0, 1, 0]), ("-x", [-1, 0, 0], [0, 1, 0])):
        yield f"E3-look-{name}", scene(expect(because, pixels(0.75, rule="exact"), group="stiff"), look([0, 0, 0], at, 1e-7, 8, up=up),
                                       integrator("path", 2), 1, environment={"radiance": 0.75})


def scenes():
    for part in (closed_forms, close_lights, touching_lights, tiny_bright_light, rooms_of_unequal_light, occluders, lights_from_behind,
                 cut_lights, quadrants, horizons, ceilings, darkness, combined_variance, skies):
        yield from part()
