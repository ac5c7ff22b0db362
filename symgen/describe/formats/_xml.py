"""Safe reading of XML: elements with their attributes, without document types, entities and files elsewhere."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path
from xml.parsers import expat

from symgen.base.errors import InputError, quote
from symgen.base.files import system_message
from symgen.describe.formats._poses import Pose, Vector, rotation_from_quaternion, rotation_from_rpy

#: Bounds of a file: bytes, elements, and depth.
LARGEST, MOST_ELEMENTS, DEEPEST = 50_000_000, 500_000, 200


def read_tree(path: Path, root: str | None = None) -> ET.Element:
    """Return the outermost element of an XML file, which must be `root` where that is named.

    Raises
    ------
    InputError
        If the file cannot be read, is too large or deep, declares a document type, or has another root.
    """
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
    except OSError as error:
        raise InputError(path.name, "a file that can be read", system_message(error)) from None
    if len(content) > LARGEST:
        raise InputError(path.name, f"a file of at most {LARGEST} bytes", "a larger one")
    tree = _Parser(path.name).parse(content)
    if root is not None and tree.tag != root:
        raise InputError(path.name, f"an XML file whose outermost element is '{root}'", quote(tree.tag))
    return tree


def outermost_tag(path: Path) -> str:
    """Return the tag of the outermost element of a file; empty where there is none."""
    tags = list[str]()
    parser = expat.ParserCreate()
    parser.StartElementHandler = lambda tag, _: tags.append(tag)
    try:
        with path.open("rb") as file:
            while not tags and (block := file.read(65536)):
                parser.Parse(block, False)
    except (OSError, expat.ExpatError):
        return tags[0] if tags else ""
    return tags[0] if tags else ""


class _Parser:
    """Builds a tree of elements and refuses what needs more than the file itself."""

    def __init__(self, source: str) -> None:
        self._source, self._depth, self._count = source, 0, 0
        self._builder = ET.TreeBuilder()

    def parse(self, content: bytes) -> ET.Element:
        parser = expat.ParserCreate()
        parser.StartElementHandler, parser.EndElementHandler = self._start_element, self._end_element
        parser.CharacterDataHandler = self._builder.data
        parser.StartDoctypeDeclHandler = self._refuse_doctype
        try:
            parser.Parse(content, True)
        except expat.ExpatError as error:
            slip = expat.ErrorString(error.code) or "an error"
            raise InputError(f"{self._source}, line {error.lineno}", "XML", f"a syntax error: {slip}") from None
        return self._builder.close()

    def _start_element(self, tag: str, attributes: dict[str, str]) -> None:
        self._depth, self._count = self._depth + 1, self._count + 1
        if self._depth > DEEPEST or self._count > MOST_ELEMENTS:
            bound = f"at most {MOST_ELEMENTS} elements, {DEEPEST} deep"
            raise InputError(self._source, bound, "more")
        if tag.startswith("xacro:"):
            hint = "expand the macros first: xacro FILE > robot.urdf"
            raise InputError(self._source, "an expanded file", f"the macro {quote(tag)}", hint)
        self._builder.start(tag, attributes)

    def _end_element(self, tag: str) -> None:
        self._depth -= 1
        self._builder.end(tag)

    def _refuse_doctype(self, name: str, *_: object) -> None:
        raise InputError(self._source, "XML without a document type, which may define entities", f"DOCTYPE {name}")


def read_decimals(where: str, text: str, count: int) -> tuple[float, ...]:
    """Return `count` finite numbers of a text."""
    try:
        values = tuple(float(part) for part in text.split())
    except ValueError:
        values = ()
    if len(values) != count or not all(map(math.isfinite, values)):
        raise InputError(where, "a finite number" if count == 1 else f"{count} finite numbers", quote(text))
    return values


def read_decimal(where: str, attributes: Mapping[str, str], key: str, default: float = 0.0) -> float:
    """Return a number of an attribute, or `default` without it."""
    return read_decimals(f"{where}, {key}", attributes[key], 1)[0] if key in attributes else default


def read_triple(where: str, text: str) -> Vector:
    """Return three numbers of a text."""
    x, y, z = read_decimals(where, text, 3)
    return x, y, z


def read_colour(where: str, text: str) -> str:
    """Return red, green, blue and opacity as ``#rrggbb``."""
    shares = read_decimals(where, text, 4)[:3]
    return "#" + "".join(f"{round(255 * min(max(x, 0.0), 1.0)):02x}" for x in shares)


def frame_of_origin(where: str, element: ET.Element | None) -> Pose:
    """Return the frame of attributes ``xyz`` and ``rpy``; the outer frame itself without an element."""
    if element is None:
        return Pose()
    xyz = read_triple(f"{where}, xyz", element.get("xyz", "0 0 0"))
    return Pose(xyz, rotation_from_rpy(read_triple(f"{where}, rpy", element.get("rpy", "0 0 0"))))


def pose_of_text(where: str, element: ET.Element) -> Pose:
    """Return the pose that the text of an element of SDF says, by angles or a quaternion; none without a text."""
    text, factor = element.text or "", 1.0
    if not text.strip():
        return Pose()
    if element.get("rotation_format", "euler_rpy") == "quat_xyzw":
        x, y, z, *e = read_decimals(where, text, 7)
        if not any(e):
            raise InputError(where, "a quaternion other than 0 0 0 0", "0 0 0 0")
        return Pose((x, y, z), rotation_from_quaternion((e[3], *e[:3])))
    if element.get("degrees", "false") in ("true", "1"):
        factor = 0.017453292519943295
    x, y, z, *angles = read_decimals(where, text, 6)
    return Pose((x, y, z), rotation_from_rpy([factor * angle for angle in angles]))


def read_inner_text(element: ET.Element, path: str) -> str:
    """Return the text of an inner element; empty without it."""
    return (element.findtext(path) or "").strip()


def read_inner_flag(element: ET.Element, path: str) -> bool:
    """Return whether an inner element says yes."""
    return read_inner_text(element, path) in ("true", "1")


def read_inner_number(where: str, element: ET.Element | None, key: str, default: float = 0.0) -> float:
    """Return the number of an inner element, or `default` without it."""
    text = "" if element is None else read_inner_text(element, key)
    if text.lower() in ("inf", "+inf", "-inf"):  # of limits
        return -1e16 if text[0] == "-" else 1e16
    return read_decimals(f"{where}, {key}", text, 1)[0] if text else default


def read_positive(where: str, element: ET.Element, key: str) -> float:
    """Return the number of an inner element, which must be above 0."""
    return read_sizes(where, " ".join([read_inner_text(element, key)] * 3))[0]


def read_sizes(where: str, text: str) -> Vector:
    """Return three numbers above 0."""
    sizes = read_triple(where, text)
    if min(sizes) <= 0.0:
        raise InputError(where, "sizes above 0", quote(text))
    return sizes
