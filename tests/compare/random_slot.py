"""Random specs of kind fill_factor: slots of every shape, standard wires and others, every algorithm."""
import math

ALGORITHMS = ["orthocyclic_base", "orthocyclic_flank", "raabe", "potential", "needle"]


def stator(r):
    width = r.uniform(4, 8)
    liner = r.choice([0, 0.2, r.uniform(0.1, 0.3)])
    height = r.uniform(8, 18)
    tip = r.uniform(88, 92)
    mouth = width - 2 * height * math.tan(math.radians(tip - 90))  # the flanks' distance at the tooth tips
    opening = r.uniform(0.5, 0.9) * min(width, mouth)
    return {"type": "stator", "base_width": width, "opening_width": opening, "height": height,
            "tip_angle": tip, "base_radius": r.uniform(50, 120), "base_corner_radius": r.uniform(0, 0.5),
            "tip_corner_radius": r.uniform(0, 0.4), "liner": liner, "wedge_thickness": r.choice([0, 0.4]),
            "wedge_width": opening}


def rotor(r, outer):
    grooves = r.randint(6, 12)
    base = grooves * outer * 1.005
    return {"type": "rotor", "grooves": grooves, "groove_radius": 0.53 * outer, "groove_pitch": 1.005 * outer,
            "shoe_radius": 0.53 * outer, "shoe_angle": r.uniform(105, 130), "root_angle": r.uniform(105, 130),
            "base_width": base, "root_flank": r.uniform(3, 6), "shoe_flank": r.uniform(2, 4), "height": base + 1}


def polygon(r):
    if r.random() < 0.5:
        wide, height, narrow = r.uniform(4, 9), r.uniform(7, 15), r.uniform(0, 1.5)
        points = [[0, 0], [wide, 0], [wide - narrow, height], [narrow, height]]
        ends = [points[3], points[2]]
    else:  # star-shaped, so that it does not touch itself
        corners = r.randint(5, 9)
        points = [[r.uniform(3.5, 6) * f(2 * math.pi * k / corners) for f in (math.cos, math.sin)] for k in range(corners)]
        ends = [points[1], points[2]]
    slot = {"type": "polygon", "points": points, "liner": r.choice([0, 0.2])}
    pick = r.random()
    if pick < 0.3:
        slot["corner_radius"] = 0.3
    elif pick < 0.8:
        slot["opening"] = ends
    return slot


def wire(r):
    if r.random() < 0.5:
        return r.choice([0.8, 0.9, 1.0, 1.12, 1.25, 1.4])
    copper = r.uniform(0.8, 1.5)
    own = {"copper": copper, "outer": copper + r.uniform(0.04, 0.1)}
    if r.random() < 0.5:
        own["tolerance"] = r.uniform(0, 0.05)
    return own


def spec(r):
    wires = [wire(r) for _ in range(r.choice([1, 1, 2]))]
    shape = r.choice(["stator", "rotor", "polygon", "polygon"])
    slot = {"stator": stator, "polygon": polygon}[shape](r) if shape != "rotor" else rotor(r, 1.3)
    document = {"slot": slot, "wires": wires, "grade": r.randint(1, 3), "seed": r.randint(0, 1000), "effort": 0.2,
                "algorithms": sorted(r.sample(ALGORITHMS, r.randint(1, 3)), key=ALGORITHMS.index),
                "turns": r.choice([{}, {"serial": 10}, {"parallel": 3}, {"serial": 5, "parallel": 2}])}
    if r.random() < 0.1:
        document.update(wires="standard", wire_range={"least": 1.0, "most": 1.4, "series": r.choice(["R20", "R40"])})
    if r.random() < 0.3:
        document["overlap_tolerance"] = r.choice([0, r.uniform(0, 0.05)])
    if r.random() < 0.3 and shape != "rotor":
        document["coil_sides"] = 2
    if r.random() < 0.3 and (shape != "polygon" or "opening" in slot):
        document["needle_width"] = r.uniform(1, 3)
    if r.random() < 0.2:
        document["robustness"] = {"samples": 3, "slot_tolerance": r.choice([0, 0.03])}
    if r.random() < 0.3:
        document["producible"] = {"friction": r.uniform(0, 0.6)}
    return document
