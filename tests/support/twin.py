"""Planar descriptions written down as spatial ones: the same bodies in the plane z = 0, joints with axes along z."""

import copy


def spatial_twin(raw: dict, kinds: dict[str, str]) -> dict:
    """The same mechanism in space.

    `kinds` says for each planar revolute joint which spatial one stands in for it (``revolute`` unless given): with a
    revolute joint at every pin a closed linkage has redundant rows.
    """
    twin = copy.deepcopy(raw)
    twin["mechanism"] |= {"space": "spatial", "gravity": [*raw["mechanism"].get("gravity", [0.0, 0.0]), 0.0]}
    for body in twin["bodies"].values():
        body["inertia"] = [1e-2, 2e-2, body["inertia"]]  # the first two must not matter
        body["points"] = {name: [*point, 0.0] for name, point in body.get("points", {}).items()}
        body["position"] = [*body["position"], 0.0]
        body["orientation"] = {"rotation_vector": [0.0, 0.0, body.pop("angle", 0.0)]}
        if "angular_velocity" in body:
            body["angular_velocity"] = [0.0, 0.0, body["angular_velocity"]]
    for name, joint in twin["joints"].items():
        joint["at"] = [point if isinstance(point, str) else [*point, 0.0] for point in joint["at"]]
        if joint["type"] == "translational":
            joint["axis"] = [*joint["axis"], 0.0]
            continue
        joint["type"] = kinds.get(name, "revolute")
        if joint["type"] != "spherical":
            joint["axis"] = [[0.0, 0.0, 1.0]] * 2
    for force in twin.get("forces", {}).values():
        force["at"] = [point if isinstance(point, str) else [*point, 0.0] for point in force["at"]]
    return twin
