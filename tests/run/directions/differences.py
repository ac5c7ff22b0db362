"""Derivatives by differences of whole runs."""


def differences(model, name: str, value: float, width: float, quantity: str, **settings) -> float:
    """Return a derivative at the end of a run by differences of fourth order of whole runs."""
    ends = {}
    for k in (-2, -1, 1, 2):
        changed = {name: value + k * width}
        kind = "start" if "." in name else "parameters"
        ends[k] = model.simulate(**settings, **{kind: changed}, verify=False)[quantity][-1]
    return (8.0 * (ends[1] - ends[-1]) - (ends[2] - ends[-2])) / (12.0 * width)
