"""Results as recordings for pages: of this process, or read back from a NetCDF file."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.digits import clean
from symgen.base.errors import AssemblyError, InputError
from symgen.base.vocabulary.measures import GROUND
from symgen.derive.methods import METHODS
from symgen.describe.coordinate_names import ACCELERATIONS
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.parts.input_data import are_words_of_data
from symgen.result.export import SAVED
from symgen.result.labelled import Array, Labelled, columns_at, least_scale, unit_scales
from symgen.result.live_run import LIVE_INTEGRATOR, is_live, live_of_run
from symgen.result.part_limits import remarks_without_limits
from symgen.result.player.live import NONE, Live
from symgen.result.player.motion_page import Page, live_script, motion_page, page_data
from symgen.result.player.recording import PlottedGroup, RecordedEvent, Recording, groups_by_unit, position_groups
from symgen.result.plots import panels_of_table
from symgen.result.saved import check_names, dataset_of, read_result_file
from symgen.result.signals import TABLES

if TYPE_CHECKING:
    import xarray as xr

    from symgen.describe.mechanism import Mechanism
    from symgen.result.motion_tables import MotionTables


def view_motion(result: MotionTables, beside: MotionTables | None = None, live: bool | str = True) -> Page:
    """Return the page of a motion.

    Parameters
    ----------
    result : MotionTables
        Of this process.
    beside : MotionTables, optional
        Another motion of the same mechanism, drawn faintly behind.
    live : bool or str
        Whether the page shall be able to work out other motions; the method of these, whose gains have sliders.

    Raises
    ------
    InputError
        If the motions are of different mechanisms, or have no outputs, or pages do not run the method.
    """
    first, second = playable_motion(result), None if beside is None else playable_motion(beside)
    if beside is not None and second is not None and beside.q.names != result.q.names:
        raise InputError("view", f"another motion of {first.mechanism.name}", f"one of {second.mechanism.name}")
    method = METHODS.resolve_alias(live, "live") if isinstance(live, str) else ""
    if method and not is_live(method):
        expected = f"a method that '{LIVE_INTEGRATOR}' solves, as pages run no other scheme"
        raise InputError("live", expected, f"'{live}'")
    return motion_page(
        first, *(live_of_run(first.mechanism, result.run_facts(), method) if live else (None, "")), second
    )


def view_data(result: MotionTables, live: bool = True, fixed: Collection[str] = ()) -> tuple[dict[str, Any], str]:
    """Return what a page draws of a motion, for JSON, and the body of a function with its live part, empty for none.

    Parameters
    ----------
    result : MotionTables
        Of this process.
    live : bool
        Whether the page shall be able to work out other motions, and know the gaps of pins; without both it is there
        sooner.
    fixed : collection of str
        Parameters that have no sliders there.

    Raises
    ------
    InputError
        If the motion has no outputs.
    """
    shown = playable_motion(result)
    part, note = live_of_run(shown.mechanism, result.run_facts(), fixed=fixed) if live else (None, "")
    return page_data(shown, part, note, gaps=live), "" if part is None else live_script(part)


def playable_motion(result: MotionTables) -> Recording:
    """Return a motion as a page plays it.

    Raises
    ------
    InputError
        If it has no outputs.
    """
    if not len(result.t):
        raise InputError("view", "a result with outputs", f"one of {result.mechanism} without")
    mechanism, run = result.measured.mechanism, result.run_facts()
    values = parameter_values(mechanism) | dict(result.parameters)
    return _recording_of_result(mechanism, values, result.t, result.q.values, lambda table: result.whole((table,)), run)


def _recording_of_result(
    mechanism: Mechanism,
    values: Mapping[str, float],
    t: Array,
    q: Array,
    read: Callable[[str], Labelled],
    run: Mapping[str, Any],
) -> Recording:
    """Return a motion as a page plays it, with facts of its run by the names of JSON."""
    facts = [("", run["method"]), ("", run["integrator"]), ("status", run["status"])]
    facts += [("", run["reason"])] if run["reason"] else []
    facts += [("remark", sentence) for sentence in remarks_without_limits(mechanism)]
    moments = [
        RecordedEvent(e["t_in"], e["t_out"], "rank", f"rank {e['rank']}, smallest pivot {e['smallest_pivot']:.1e}")
        for e in run.get("rank_events", [])
    ]
    moments += [RecordedEvent(e["t"], e["t"], "event", e["name"]) for e in run.get("events", [])]
    reactions, pushed = _reaction_groups(mechanism, read("reactions"))
    elements = read("elements")
    pulls = [name for name in elements.names if name.endswith(".force")]
    pulling = tuple(name.removesuffix(".force") for name in pulls)
    return Recording(
        mechanism,
        dict(values),
        *(t, q),
        facts=tuple(facts),
        status=run["status"],
        groups=tuple(_groups_of_columns(mechanism, q, read)),
        reactions=reactions,
        pushed=pushed,
        pulls=np.stack([elements[name] for name in pulls], axis=1) if pulls else None,
        pulling=pulling,
        moments=tuple(moments),
    )


def _reaction_groups(mechanism: Mechanism, table: Labelled) -> tuple[Array | None, tuple[str, ...]]:
    labels = ("Fx", "Fy", "Fz") if mechanism.space == "spatial" else ("Fx", "Fy")
    names = dict.fromkeys(name.rpartition(".")[0] for name in table.names)
    owners = tuple(name for name in names if all(f"{name}.{label}" in table.names for label in labels))
    if not owners:
        return None, ()
    return np.stack([[table[f"{name}.{label}"] for label in labels] for name in owners]).transpose(2, 0, 1), owners


#: Tables that a page plots, each with the section of its groups and the words before the meaning of their units.
_PLOTTED = {
    "outputs": ("outputs", "outputs"),
    "elements": ("forces and drivers", "elements"),
    "q": ("bodies", ""),
    "magnitudes": ("joints", "joints"),
    "reactions": ("joints", ""),
    "joint_coordinates": ("joints", "joints"),
    **{"points": ("bodies", "points"), "v": ("bodies", ""), "a": ("bodies", "")},
    **{"energy": ("energy and errors", ""), "violations": ("energy and errors", "")},
    "lam": ("multipliers", "multipliers"),
    "body_reactions": ("joints, in axes of bodies", ""),
}
#: Those that a page has in any case, those with a group for each joint, and those without groups that are 0.
_ALWAYS = ("outputs", "q", "energy", "violations")
_BY_JOINT = {"reactions": "", "body_reactions": " in axes of its body"}
_NONZERO = ("magnitudes", "reactions", "body_reactions")
#: Digits that the equations of multipliers lose, as a factor of scales: what is less in a reaction is rounding.
_LOST = 1e3


def _groups_of_columns(mechanism: Mechanism, q: Array, read: Callable[[str], Labelled]) -> Iterator[PlottedGroup]:
    """Yield the quantities that a page plots, the most important ones first."""
    tables = {table: read(table) for table in _PLOTTED}
    scales = dict[str, float]()
    for part in tables.values():
        scales |= {unit: max(x, scales.get(unit, 0.0)) for unit, x in unit_scales(part).items()}
    grounded = {joint.name for joint in mechanism.joints if joint.bodies[0] == GROUND}
    for table, (section, head) in _PLOTTED.items():
        if table == "q":
            yield from position_groups(mechanism, q)
            continue
        for title, unit, logarithmic, part in _title_of_motion(table, head, tables[table]):
            scale = 0.0 if logarithmic else max(scales[unit], least_scale(scales, unit)) if unit in scales else 0.0
            if table in _NONZERO:
                scale *= _LOST
                if not clean(part.values, scale).any():
                    continue
            if table == "body_reactions" and title.partition(":")[0] in grounded:
                continue  # they are those in ground axes
            for whole, some in groups_by_unit(title, part.names):
                names, values, further = part.names[some], part.values[:, some], table not in _ALWAYS
                options: dict[str, Any] = {"further": further, "section": section, "scale": scale}
                yield PlottedGroup(whole, unit, names, values, logarithmic, **options)


def _title_of_motion(table: str, head: str, columns: Labelled) -> Iterator[tuple[str, str, bool, Labelled]]:
    """Yield the groups of a table: title, unit, whether sizes are drawn as logarithms, and columns."""
    for meaning, unit, logarithmic, part in panels_of_table(columns):
        owners = [name.partition(".")[0] for name in part.names]
        if table in _BY_JOINT:
            by_joint: dict[str, list[int]] = {}
            for i, joint in enumerate(owners):
                by_joint.setdefault(joint, []).append(i)
            for joint, places in by_joint.items():
                yield f"{joint}: {meaning}{_BY_JOINT[table]}", unit, logarithmic, columns_at(part, places)
        else:
            one = len(set(owners)) == 1 and head and table != "outputs"
            before = owners[0] if one else head
            alone = table == "outputs" and len(part.names) == 1  # an output says more than its unit: `lost`, no energy
            what = part.names[0] if alone else meaning
            yield ": ".join(filter(None, (before, what))), unit, logarithmic, part


def view_file(option: str, path: Path, mechanism: Mechanism, beside: Path | None = None, live: bool = True) -> Page:
    """Return the page of a result in a NetCDF file.

    Parameters
    ----------
    option : str
        Who asks, for messages.
    path, beside : Path
        The file, and that of another motion, drawn faintly behind.
    mechanism : Mechanism
        Of which it is a result.
    live : bool
        Whether the page shall be able to work out other motions.

    Raises
    ------
    InputError
        If the file is none of a result of the mechanism.
    """
    first = recorded_file(option, path, mechanism)
    second = None if beside is None else recorded_file(option, beside, mechanism)
    return motion_page(first, *(_live_of_file(option, path, mechanism) if live else (None, "")), second)


def _live_of_file(option: str, path: Path, mechanism: Mechanism) -> tuple[Live | None, str]:
    """Return the live part of a page of a file: of the mechanism by its name, with the facts of the run in the file."""
    from symgen.base.settings import Settings
    from symgen.run.planning.inputs import put_inputs

    run: dict[str, Any] = json.loads(_read_dataset(option, path).attrs["run"])
    own = {p.name for p in mechanism.parameters} - set(mechanism.inputs)
    run["parameters"] = {k: float(v) for k, v in run["parameters"].items() if k in own}
    run["inputs"] = {k: v for k, v in run["inputs"].items() if k in mechanism.inputs}
    run["watched"] = [(event["name"], event["action"]) for event in run["watched"]]
    formulas = {name: x for name, x in run["inputs"].items() if isinstance(x, str)}
    if any(map(are_words_of_data, formulas.values())):
        return None, f"{NONE}: what the run gave its inputs over time is not in the file"
    try:
        if formulas:
            numbers = {name: float(x) for name, x in run["inputs"].items() if name not in formulas}
            settings = Settings(parameters=run["parameters"] | numbers, inputs=formulas, until=run["until"])
            mechanism = put_inputs(mechanism, settings).mechanism
        return live_of_run(mechanism, run)
    except (AssemblyError, InputError) as error:
        return None, f"{NONE}: {' '.join(str(error).split())}"


def mechanism_name(option: str, path: Path) -> str:
    """Return the mechanism of the result in a NetCDF file."""
    return str(_read_dataset(option, path).attrs["mechanism"])


def _read_dataset(option: str, path: Path) -> xr.Dataset:
    def read_result_dataset(path: Path) -> xr.Dataset:
        dataset = dataset_of(path)
        if not {"q", "energy", "violations", "reactions"} <= set(dataset.data_vars) or "mechanism" not in dataset.attrs:
            raise ValueError("it has not the tables of a result")
        if not {"parameters", "inputs", "start", "watched", "until"} <= set(json.loads(dataset.attrs["run"])):
            raise ValueError("it is of an older version")
        check_names(dataset["kind_of_energy"].values.tolist())
        return dataset

    return read_result_file(option, path, read_result_dataset, SAVED[".nc"])


def recorded_file(option: str, path: Path, mechanism: Mechanism) -> Recording:
    """Return the result in a NetCDF file as a page plays it.

    Raises
    ------
    InputError
        If the file is none of a result of the mechanism.
    """
    data = _read_dataset(option, path)
    names = {
        "coordinate": [f"{b.name}.{c}" for b in mechanism.bodies for c in b.coordinates],
        "velocity": [f"{b.name}.{s}" for b in mechanism.bodies for s in b.speeds],
        "acceleration": [f"{b.name}.{ACCELERATIONS[s]}" for b in mechanism.bodies for s in b.speeds],
    }
    for dimension, expected in names.items():
        if expected and [str(n) for n in data[dimension].values] != expected:
            got = f"'{path}', which is one of {data.attrs['mechanism']} and has others as {dimension}"
            raise InputError(option, f"a result of {mechanism.name}", got)
    tables = dict[str, Labelled]()
    for name, of in TABLES.items():
        columns, units = (
            tuple(map(str, data[label].values)) if of in data.coords else () for label in (of, f"{of}_unit")
        )
        values = np.asarray(data[name].values, dtype=np.float64) if columns else np.zeros((data.sizes["time"], 0))
        tables[name] = Labelled(values, columns, units)
    run: dict[str, Any] = json.loads(data.attrs["run"])
    own = {p.name for p in mechanism.parameters}
    numbers = parameter_values(mechanism, {k: float(v) for k, v in run["parameters"].items() if k in own})
    return _recording_of_result(mechanism, numbers, data["time"].values, data["q"].values, tables.__getitem__, run)
