"""Drafts: the text of an editor in, its errors, or what a page draws of it, out."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from symgen.api import Model
from symgen.base.errors import AssemblyError, InputError, SymgenError
from symgen.base.memory import without_garbage_collection
from symgen.cli._editor.editor_page import EMPTY
from symgen.cli._editor.joints import joint_equations
from symgen.cli._editor.made import make_file_for_browser
from symgen.cli._editor.texts import Texts
from symgen.describe.drawing.scene import Array
from symgen.describe.edits.dimensions import dimension_changes, dimensions_of_file
from symgen.describe.edits.handles import movable_points, spans_of_parameters
from symgen.describe.edits.renaming import remove_from_text, rename_in_text
from symgen.describe.edits.snippet_tables import Spot
from symgen.describe.edits.snippets import TURNED, snippet_changes
from symgen.describe.edits.text_changes import apply_changes, utf16_places
from symgen.describe.facts.digest import digest
from symgen.describe.files.load import LARGEST_FILE, parse_toml
from symgen.describe.files.origins import Source
from symgen.describe.files.places import Path as Place
from symgen.describe.files.places import outline_of_document
from symgen.describe.files.problems import Problem, problems_of_text
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.mechanism import Mechanism
from symgen.result.player.motion_page import page_data
from symgen.result.player.recording import Recording
from symgen.result.result import Result
from symgen.result.viewed import view_data
from symgen.run.compiling.kept_code import Kept, keeping_code
from symgen.run.planning.closing_part import closing_part, settings_in_loops
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare
from symgen.run.starts.assembler import close_for_drawing

#: Errors of a text that are sent at most.
MOST_ERRORS = 100
#: What a page says of a file without bodies.
FIRST_BODY = "there is no body yet: take Bar and click two points, or Plate and click three"


class Drafts:
    """What texts of one file mean.

    Parameters
    ----------
    path : Path
        The file, whose folder has the meshes.
    """

    def __init__(self, path: Path) -> None:
        self.path, self.source = path, Source.of_file(path)
        self._running, self._results = threading.Lock(), dict[str, tuple[str, Result]]()
        self._enlivening, self._without_live = threading.Lock(), set[str]()
        self._asked: dict[str, int] = {}
        self._texts = Texts(self.source)
        self._codes: Kept = {}
        self._start: tuple[str, list[float]] | None = None

    @without_garbage_collection()
    def check_text(self, text: str) -> dict[str, Any]:
        """Return the errors of a text, each at its line, or the drawing of its start and what may be moved in it."""
        self._refuse_large(text)
        try:
            draft = self._texts.read(text)
        except InputError:
            wrong = problems_of_text(text, self.source)
            if [(problem.where, problem.got) for problem in wrong] == [("bodies", "none")]:
                return _sheet_without_bodies(parse_toml(text, self.source))
            return {"errors": [_error_entry(problem) for problem in wrong[:MOST_ERRORS]], "count": len(wrong)}
        parts, mechanism = draft.outline, draft.mechanism
        values = parameter_values(mechanism)
        described = Model(mechanism).initial_state(values)[0]
        q, open_joints, errors, warnings = described, tuple[str, ...](), list[dict[str, Any]](), tuple[str, ...]()
        freedoms: dict[str, Any] = {}
        try:
            with close_for_drawing(), keeping_code(self._codes):
                run = prepare(*closing_part(self._texts.for_starts(draft)), Purpose.STATE)
            start = run.start
            q, warnings = start.y[: len(described)], start.warnings
            count = run.compiled.info.nv - start.rank
            freedoms = {"count": count, "redundant": list(start.redundant_rows)}
        except AssemblyError as error:
            q = np.array(error.q) if error.q else described
            open_joints = error.joints
            line = next((line_of_path(text, parts.mentions, ("joints", name)) for name in open_joints), 0)
            errors = [{"line": line, "text": str(error)}]
        except SymgenError as error:  # a start that a formula leaves undefined
            errors = [{"line": 0, "text": str(error)}]
        recording = Recording(mechanism, values, np.zeros(1), np.atleast_2d(q))
        moved = bool(warnings) or bool(open_joints)
        ghost = Recording(mechanism, values, np.zeros(1), np.atleast_2d(described)) if moved else None
        data = page_data(recording, second=ghost, open_joints=open_joints, note="; ".join(warnings))
        wide = utf16_places(text)
        self._start = text, [float(x) for x in q]
        movable = movable_points(mechanism, draft.raw, parts.values, text, self._start[1])
        numbers = spans_of_parameters(draft.raw, parts.values, text)
        return {
            "errors": errors,
            "count": len(errors),
            "data": data,
            "freedoms": freedoms,
            "joints": [joint.name for joint in mechanism.joints],
            "bounded": {row.name: [row.family.off, row.family.in_force] for row in mechanism.bounded if row.one_sided},
            "handles": [
                {**handle._asdict(), "followers": [_follower_in_page(follower, wide) for follower in handle.followers]}
                for handle in movable
            ],
            "numbers": {name: _span_in_page(span, wide) for name, span in numbers.items()},
            "units": {p.name: p.own_unit.text for p in mechanism.parameters if p.name in numbers},
        }

    def run_motion(self, text: str, tab: str, asked: int) -> dict[str, Any]:
        """Return the motion of a text, or that a later one was asked for.

        Parameters
        ----------
        text : str
            The text.
        tab : str
            Who asks; a later question of the same one takes the place of this one.
        asked : int
            Which question it is.
        """
        self._refuse_large(text)
        self._asked[tab] = max(asked, self._asked.get(tab, 0))
        with self._running:
            if self._asked[tab] != asked:
                return {"superseded": True}

            def still_wanted(_: float) -> None:
                if self._asked[tab] != asked:
                    raise KeyboardInterrupt

            draft = self._texts.read(text)
            with keeping_code(self._codes):
                own, settings = self._texts.for_runs(draft), settings_in_loops(draft.mechanism)
                result = Model(own).simulate(settings, progress=still_wanted)
            if self._asked[tab] != asked:
                return {"superseded": True}
            facts = {"status": result.status, "reason": result.reason or ""}
            if not len(result.t):
                return {"data": None, **facts}
            self._results = {tab: (text, result)}
            with without_garbage_collection():
                return {"data": view_data(result, live=False)[0], **facts}

    def live_page_data(self, text: str, tab: str, asked: int) -> dict[str, Any]:
        """Return the data and the script of a page that works out other motions of the last motion's text.

        It is made beside motions, which do not wait for it, and of code with the file's numbers as parameters: another
        number needs no other code. A mechanism whose code is too long for a page has no data.
        """
        with self._enlivening:
            before, result = self._results.get(tab, ("", None))
            if result is None or before != text or self._asked.get(tab) != asked:
                return {"superseded": True}
            own = self._texts.read(text).mechanism.parameters
            moved = result.measured.mechanism
            if digest(moved) in self._without_live:
                return {"data": None}
            fixed = {parameter.name for parameter in moved.parameters} - {parameter.name for parameter in own}
            data, script = view_data(result, fixed=fixed)
            if not script:
                self._without_live.add(digest(moved))
                return {"data": None}
            return {"data": data, "script": script}

    def equations_of_joint(self, text: str, name: str) -> dict[str, Any]:
        """Return the equations of a joint of a text."""
        self._refuse_large(text)
        return joint_equations(self._texts.read(text).mechanism, name)

    def make_file(self, text: str, kind: str) -> dict[str, Any]:
        """Return a file that a command would write for a text."""
        self._refuse_large(text)
        draft = self._texts.read(text)
        with self._running:
            return make_file_for_browser(kind, draft.raw, draft.mechanism, self.path)

    def add_part(self, text: str, part: str, spots: Sequence[Spot]) -> dict[str, Any]:
        """Return a text with a part added at spots, and the path of what was added."""
        self._refuse_large(text)
        raw = parse_toml(text, self.source)
        angles = self._angles_at_start(text) if part in TURNED else {}
        added, path = snippet_changes(part, spots, raw, outline_of_document(text), text, angles)
        return {"text": apply_changes(text, added), "path": path}

    def dimensions(self, text: str, part: str) -> dict[str, Any]:
        """Return the lengths and angles of a part of a text where the page draws it at the start, or of all parts."""
        self._refuse_large(text)
        found = dimensions_of_file(*self._described_start(text), part)
        return {"dimensions": [each._asdict() for each in found]}

    def set_dimension(self, text: str, name: str, value: str) -> dict[str, Any]:
        """Return a text in which a dimension has the value that was typed."""
        self._refuse_large(text)
        return {"text": apply_changes(text, dimension_changes(*self._described_start(text), name, value))}

    def _described_start(
        self, text: str
    ) -> tuple[Mechanism, dict[str, Any], Mapping[Place, tuple[int, int]], str, list[float]]:
        """Return a mechanism with its tables and their places, and coordinates of its bodies at the start."""
        draft = self._texts.read(text)
        if self._start is None or self._start[0] != text:
            self._start = text, [float(x) for x in self._coordinates_at_start(draft.mechanism)]
        return draft.mechanism, draft.raw, draft.outline.values, text, self._start[1]

    def rename_part(self, text: str, path: str, name: str) -> dict[str, Any]:
        """Return a text with another name of a part, wherever it is named."""
        self._refuse_large(text)
        return {"text": rename_in_text(text, path, name, self.source)}

    def remove_part(self, text: str, path: str) -> dict[str, Any]:
        """Return a text without a part, and without what needs it."""
        self._refuse_large(text)
        return {"text": remove_from_text(text, path, self.source)}

    def _angles_at_start(self, text: str) -> dict[str, float]:
        """Return how far bodies are turned where the page draws them at the start."""
        mechanism = self._texts.read(text).mechanism
        q = self._coordinates_at_start(mechanism)
        angles, at = dict[str, float](), 0
        for body in mechanism.bodies:
            if "theta" in body.coordinates:
                angles[body.name] = float(q[at + 2])
            at += len(body.coordinates)
        return angles

    def _coordinates_at_start(self, mechanism: Mechanism) -> Array:
        """Return the coordinates of bodies where assembly ends."""
        try:
            with close_for_drawing():
                return prepare(*closing_part(mechanism), Purpose.STATE).start.y
        except AssemblyError as error:
            return np.array(error.q) if error.q else Model(mechanism).initial_state({})[0]

    def _refuse_large(self, text: str) -> None:
        if len(text) > LARGEST_FILE or len(text.encode(errors="replace")) > LARGEST_FILE:
            raise InputError(self.source, f"a text of at most {LARGEST_FILE} bytes", "a larger one")


def _sheet_without_bodies(raw: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a page draws of a file whose first body is still to come: nothing, and no error."""
    names = raw.get("mechanism", {})
    data = {**EMPTY, "title": str(names.get("title") or names.get("name", "")), "note": FIRST_BODY}
    nothing: dict[str, Any] = {"joints": [], "bounded": {}, "handles": [], "numbers": {}, "units": {}, "freedoms": {}}
    return {"errors": [], "count": 0, "data": data, "empty": True, **nothing}


def line_of_path(text: str, mentions: Iterable[Any], path: tuple[str, ...]) -> int:
    """Return the line of the first key of a path; 0 where there is none, as no line is wrong then."""
    start = next((mention.start for mention in mentions if mention.path == path), None)
    return 0 if start is None else text.count("\n", 0, start) + 1


def _error_entry(problem: Problem) -> dict[str, Any]:
    return {"line": problem.line if problem.has_place else 0, "text": str(problem)}


def _span_in_page(span: tuple[int, int], wide: list[int] | None) -> tuple[int, int]:
    """Return characters as pages count them."""
    return span if wide is None else (wide[span[0]], wide[span[1]])


def _follower_in_page(follower: Any, wide: list[int] | None) -> dict[str, Any]:
    start, end = _span_in_page((follower.start, follower.end), wide)
    return {**follower._asdict(), "start": start, "end": end}
