"""Places of a document's keys and values: all paths that tomllib finds, and texts that are read as its values."""

import tomllib

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from symgen.describe.files.places import places_in_document

WORDS = ("a", "b-1", "3", "true", "x_y")
QUOTED = ('"a.b"', "'c d'", '"q\\"#"', '"\\u00e9"', "''", '"[d]"', "'='")
NUMBERS = ("1", "-2.5e3", "inf", "0xff", "1_000", "true")
DATES = ("1979-05-27", "1979-05-27 07:32:00Z", "1979-05-27T07:32:00", "07:32:00")
TEXTS = ('"text"', '"a # b, ] }"', '"\\"\\\\"', "'C:\\'", '""', "''", "'é🙂'")
LONG_TEXTS = (
    '"""\nfirst\n"two" \\\n  "" third"""',
    "'''\nit's\n''two''\n'''",
    '""""quoted""""',
    '"""\\""""',
    "''''a''''",
)
BLANKS = st.sampled_from(("", "\n", "  # a = [1]\n", "\n\t# \"'''\n\n"))

keys = st.sampled_from(WORDS + QUOTED)
dotted = st.lists(keys, min_size=1, max_size=3).map(" . ".join) | st.lists(keys, min_size=1, max_size=3).map(".".join)


@st.composite
def arrays(draw, items):
    parts = [draw(BLANKS) + item + draw(BLANKS) for item in draw(st.lists(items, max_size=3))]
    last = draw(st.sampled_from(("", ","))) if parts else ""
    return f"[{','.join(parts)}{last}{draw(BLANKS)}]"


def inline_tables(items):
    pairs = st.tuples(dotted, items).map(" = ".join)
    return st.lists(pairs, max_size=3).map(lambda parts: "{ " + ", ".join(parts) + "}")


values = st.recursive(
    st.sampled_from(NUMBERS + DATES + TEXTS + LONG_TEXTS),
    lambda items: arrays(items) | inline_tables(items),
    max_leaves=6,
)
lines = st.one_of(
    st.tuples(dotted, st.sampled_from((" = ", "=", "\t=  ")), values).map("".join),
    dotted.map("[{}]".format),
    dotted.map("[ {} ]".format),
    dotted.map("[[{}]]".format),
    st.sampled_from(("", "# comment [a]", "   ")),
)


@st.composite
def documents(draw):
    """Draw a document line by line, leaving out what may not stand behind the lines before."""
    text, end = "", draw(st.sampled_from(("\n", "\r\n", "  # end\n")))
    for line in draw(st.lists(lines, max_size=12)):
        longer = text + draw(st.sampled_from(("", "  "))) + line + end
        try:
            tomllib.loads(longer)
        except tomllib.TOMLDecodeError:
            continue
        text = longer
    return text.rstrip("\r\n") if draw(st.booleans()) else text


def paths_of(value, path=()):
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, item in items:
        yield (*path, key), item
        yield from paths_of(item, (*path, key))


def text_at(text, span):
    start = sum(len(line) for line in text.split("\n")[: span.line - 1]) + span.line - 1 + span.column - 1
    return text[start : start + span.length]


def check(text):
    found, read = places_in_document(text), dict(paths_of(tomllib.loads(text)))
    assert set(found) == set(read)
    for path, place in found.items():
        if place.key is not None:
            (key,) = tomllib.loads(f"{text_at(text, place.key)} = 0")
            assert key == next(part for part in path[::-1] if isinstance(part, str))
        if place.value is not None:
            assert tomllib.loads(f"value = {text_at(text, place.value)}") == {"value": read[path]}
        else:
            assert isinstance(read[path], dict | list)


@given(documents())
def test_places_of_random_documents(text):
    assume(text)
    check(text)


DOCUMENT = """\
# of a mechanism
bodies.crank = { mass = 1.0, points.tip = [
  0.5, # half
  0.0] }

[joints.A]
friction.sliding = 0.2

[[rows]]
position = '''
x'''
[[rows]]
[rows.more]
"""


@pytest.mark.parametrize(
    ("path", "key", "value"),
    [
        (("bodies",), (2, 1, 6), None),
        (("bodies", "crank"), (2, 8, 5), (2, 16, 51)),
        (("bodies", "crank", "mass"), (2, 18, 4), (2, 25, 3)),
        (("bodies", "crank", "points", "tip", 1), None, (4, 3, 3)),
        (("joints", "A"), (6, 9, 1), None),
        (("joints", "A", "friction", "sliding"), (7, 10, 7), (7, 20, 3)),
        (("rows", 0, "position"), (10, 1, 8), (10, 12, 8)),
        (("rows", 1), (12, 3, 4), None),
        (("rows", 1, "more"), (13, 7, 4), None),
    ],
)
def test_places_in_a_mechanism_file(path, key, value):
    assert tuple(places_in_document(DOCUMENT)[path]) == (key, value)
    check(DOCUMENT)
