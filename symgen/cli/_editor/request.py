"""What a page of the editor asks for."""

from __future__ import annotations

import msgspec

from symgen.base.errors import InputError
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.edits.snippet_tables import Spot


class RequestedPlace(msgspec.Struct, frozen=True):
    """A point that was pointed at: see `symgen.describe.edits.snippet_tables.Spot`."""

    x: float
    y: float
    body: str | None = None
    point: str | None = None
    joint: str | None = None
    at: tuple[float, float] = (0.0, 0.0)

    @property
    def spot(self) -> Spot:
        """The spot, with the ground as no body."""
        body = "" if self.body == GROUND else self.body or ""
        return Spot(self.x, self.y, body, self.point or "", self.at, self.joint or "")


class EditorRequest(msgspec.Struct, frozen=True):
    """A request; each job reads some of its fields.

    Attributes
    ----------
    text : str
        The text of the file, as the page has it.
    digest, force : str, bool
        Of the file when it was read, and whether changes of others are written over.
    tab, asked : str, int
        Which page asks, and the number of its question.
    path, name : str, str
        What is renamed, taken out or has dimensions, such as ``bodies.rod``; a new name, or that of a joint or of a
        dimension.
    value : str
        What was typed for a dimension.
    kind, part, spots : str, str, list of RequestedPlace
        Kind of the file that is made; what is added or searched for, and where.
    starts : int
        How many searches.
    """

    text: str | msgspec.UnsetType = msgspec.UNSET
    digest: str = ""
    force: bool = False
    tab: str = ""
    asked: int = 0
    path: str = ""
    name: str = ""
    value: str = ""
    kind: str = ""
    part: str = ""
    spots: list[RequestedPlace] = []
    starts: int = 1

    @property
    def draft(self) -> str:
        """The text, which has to be there.

        Raises
        ------
        InputError
            If there is none.
        """
        if self.text is msgspec.UNSET:
            raise InputError("text", "a text", "none")
        return self.text


def read_request(body: bytes) -> EditorRequest:
    """Return the request in the body of a message.

    Raises
    ------
    InputError
        If it is JSON of another kind.
    msgspec.DecodeError
        If it is no JSON.
    """
    try:
        return msgspec.json.decode(body, type=EditorRequest)
    except msgspec.ValidationError as error:
        raise InputError("request", "what the page of this editor sends", f"something else ({error})") from None
