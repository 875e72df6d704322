"""Numbers as text: a fixed count of decimals, without trailing zeros and without a negative zero."""
import json


def number(value, decimals):
    """12.5, 3, -0.0625: at most `decimals` digits behind the point."""
    text = f"{value:.{decimals}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def rounded(value, decimals=9):
    """For JSON: nested lists of rounded numbers, whole ones as integers."""
    if isinstance(value, (list, tuple)):
        return [rounded(each, decimals) for each in value]
    near = round(float(value), decimals)
    return int(near) if near == int(near) else near


def job(name, reference, contour, axes, cycle_time):
    """A job document of kind contour. `contour` is JSON text, indented by four blanks but for its first line."""
    limits = ",\n".join(
        f'        "{axis}": {{"velocity": {velocity}, "acceleration": {acceleration}, "jerk": null}}'
        for axis, (velocity, acceleration) in axes.items()
    )
    return (
        "{\n"
        f'  "kind": "contour",\n  "name": {json.dumps(name)},\n  "reference": {json.dumps(reference)},\n'
        f'  "spec": {{\n    "contour": {contour},\n'
        f'    "machine": {{\n      "kinematics": "cartesian",\n      "axes": {{\n{limits}\n      }},\n'
        f'      "cycle_time": {cycle_time}\n    }},\n'
        '    "planning": {"method": "time_optimal", "corner": {"mode": "stop"}}\n  }\n}\n'
    )


def blocks(start, sequence):
    """Contour of blocks (mode, feed or None, segments as dictionaries): one line per segment."""
    lines = ["{", f'      "start": {json.dumps(rounded(start))},', '      "blocks": [']
    for i, (mode, feed, segments) in enumerate(sequence):
        head = f'        {{"mode": "{mode}", ' + (f'"feed": {json.dumps(feed)}, ' if mode == "cut" else "")
        body = ",\n".join("          " + json.dumps(segment) for segment in segments)
        lines.append(f'{head}"segments": [\n{body}\n        ]}}' + ("," if i + 1 < len(sequence) else ""))
    return "\n".join(lines + ["      ]", "    }"])
