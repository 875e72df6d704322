"""Random specs of kind winding: stators and rotors of many sizes, spans and turns, on the three machines."""
import json
import math
import pathlib

MACHINES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "machines"


def stator(r):
    slots = r.choice([12, 18, 24, 27, 36, 48, 54, 72])
    height = r.uniform(8, 20)
    bore = max(height, slots * r.uniform(5, 9) / (2 * math.pi))  # so that slot and tooth share the pitch
    base_radius = bore + height
    tip = r.uniform(89, 93)
    width = r.uniform(0.35, 0.6) * 2 * math.pi * bore / slots
    mouth = width - 2 * height * math.tan(math.radians(tip - 90))
    opening = r.uniform(0.6, 0.9) * min(width, mouth)
    liner = r.choice([0, r.uniform(0.1, 0.3)])
    slot = {"base_width": width, "opening_width": opening, "height": height, "tip_angle": tip,
            "base_radius": base_radius, "base_corner_radius": r.uniform(0, 0.3), "tip_corner_radius": r.uniform(0, 0.3),
            "liner": liner, "wedge_thickness": r.choice([0, 0.4]), "wedge_width": opening}
    part = {"type": "stator", "slot": slot, "slots": slots, "stack": r.uniform(20, 250),
            "tool_shift": r.uniform(0, 0.4) * width, "tool_height": r.uniform(6, 20)}
    span = r.randint(1, slots // 2)
    first = r.randrange(slots)
    ends = [first, (first + span) % slots]
    if r.random() < 0.5:
        ends.reverse()
    step = r.choice([span, span + 1, max(1, slots // 4)])
    return part, ends, step, opening, min(60, bore)


def rotor(r, outer):
    poles = r.choice([4, 6, 8, 10, 12])
    grooves = r.randint(4, 14)
    base = grooves * outer * 1.005 + 0.5
    half, flank = r.uniform(3, 12), r.uniform(3, 6)
    root = (half + flank) / math.tan(math.pi / poles) + r.uniform(2, 12)  # coils do not meet at the root
    slot = {"grooves": grooves, "groove_radius": 0.53 * outer, "groove_pitch": 1.005 * outer, "shoe_radius": 0.53 * outer,
            "shoe_angle": r.uniform(105, 130), "root_angle": r.uniform(105, 130), "base_width": base,
            "root_flank": flank, "shoe_flank": r.uniform(2, 4), "height": base + 1}
    part = {"type": "rotor", "slot": slot, "poles": poles, "stack": r.uniform(20, 220), "cap_base": r.uniform(4, 12),
            "tooth_half_width": half, "tooth_radius": root}
    part["cap_height"] = part["cap_base"] + r.uniform(5, 18)
    first = r.randrange(poles)
    ends = [first, (first + 1) % poles]
    if r.random() < 0.5:
        ends.reverse()
    return part, ends, r.choice([1, 2]), 4.0, 60


def machine(r, of_rotor):
    kind = r.choice(["horizontal", "vertical", "robot"])
    document = json.loads((MACHINES / f"{kind}.json").read_text())
    quick = 10 ** r.uniform(-0.7, 0.5)
    for axis in document["axes"].values():
        for limit in ("velocity", "acceleration", "jerk"):
            axis[limit] *= quick * r.uniform(0.7, 1.4)
    document["cycle_time"] = r.choice([0.001, 0.002, 0.004])
    return document


def spec(r):
    """Most can be wound; some collide, do not fit or lie out of reach, which has to be said by name."""
    of_rotor = r.random() < 0.5
    wire = r.choice([0.5, 0.63, 0.71, 0.8, 0.9, 1.0, 1.12])
    part, ends, step, opening, room = rotor(r, 1.1 * wire) if of_rotor else stator(r)
    document = {"part": part, "wire": wire, "grade": r.randint(1, 3), "coil": {"slots": ends, "turns": r.choice([1, 2, 3])},
                "machine": machine(r, of_rotor),
                "path": {"continuity": r.choice([2, 3, 3, 3, 4]), "objective": r.choice(["curvature", "control_distance"])},
                "pull": {"force": r.uniform(5, 40), "bend_radius": r.uniform(2, 6), "free_length": r.uniform(0.5, 4)},
                "needle": {"length": room, "width": max(r.uniform(0.35, 0.6) * opening, 1.3 * wire), "pivot_limit": r.choice([None, 10]),
                           "clearance": r.choice([-1, -1, 0])}}
    if r.random() < 0.3:
        document["coil"]["repeat"] = {"step": step, "count": 2, "alternate": r.random() < 0.5}
        document["needle"].update(change_radius=r.uniform(0, 10), change_height=r.uniform(0, 10))
    feed = {"method": "optimised"}
    if r.random() < 0.5:
        feed.update(velocity=10 ** r.uniform(1.5, 3.2), acceleration=10 ** r.uniform(2.5, 4.5), jerk=10 ** r.uniform(3.5, 5.8))
    document["feed"] = feed
    return document
