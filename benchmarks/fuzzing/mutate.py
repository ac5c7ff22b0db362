"""Files made from good ones by changing their tables, or the letters of their text."""

from __future__ import annotations

import copy
import random
from collections.abc import Iterator
from typing import Any

from benchmarks.fuzzing import texts
from benchmarks.mechanisms.toml import text

Raw = dict[str, Any]
#: A place in nested tables: the table or list, and the key or index in it.
Place = tuple[Any, Any]


def places(value: Any) -> Iterator[Place]:
    """Yield every place below a value."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, item in list(items):
        yield value, key
        yield from places(item)


def changed(rng: random.Random, good: Raw, other: Raw) -> str:
    """Return the text of a file like `good` with a few things wrong, some of them taken from another file."""
    raw = copy.deepcopy(good)
    if rng.random() < 0.35:
        return _letters(rng, text(raw))
    for _ in range(rng.choice([1, 1, 1, 2, 3, 6])):
        _change(rng, raw, other)
    mutant = text(raw)
    return _letters(rng, mutant) if rng.random() < 0.1 else mutant


def _change(rng: random.Random, raw: Raw, other: Raw) -> None:
    positions = list(places(raw))
    if not positions:
        raw[texts.key(rng)] = texts.value(rng)
        return
    holder, key = rng.choice(positions)
    way = rng.randrange(9)
    if way == 0:
        del holder[key]
    elif way in (1, 2, 3):
        holder[key] = texts.value(rng) if way == 1 else texts.text(rng) if way == 2 else texts.number(rng)
    elif way == 4 and isinstance(holder, dict):
        holder[texts.key(rng)] = holder.pop(key)
    elif way == 5 and isinstance(holder, dict):
        holder[texts.key(rng)] = texts.value(rng)
    elif way == 6:
        source, at = rng.choice(list(places(other)))
        holder[key] = copy.deepcopy(source[at])
    elif way == 7 and isinstance(holder, list):
        holder.extend(copy.deepcopy(holder[key : key + 1]) * rng.choice([1, 2, 50]))
    else:
        source, at = rng.choice(positions)
        holder[key], source[at] = source[at], holder[key]
        _untangled(raw)


def _untangled(raw: Raw) -> None:
    """Break circles and shared parts that an exchange of two places may have made."""

    def copied(value: Any, above: tuple[int, ...]) -> Any:
        if id(value) in above:
            return 0
        inside = (*above, id(value))
        if isinstance(value, dict):
            return {k: copied(v, inside) for k, v in value.items()}
        return [copied(v, inside) for v in value] if isinstance(value, list) else value

    clean = copied(raw, ())
    raw.clear()
    raw.update(clean)


def _letters(rng: random.Random, good: str) -> str:
    """Return a text with letters dropped, doubled, exchanged, or put in."""
    letters = list(good)
    for _ in range(rng.choice([1, 1, 2, 5, 20])):
        i = rng.randrange(len(letters) + 1)
        way = rng.randrange(6)
        if way == 0:
            del letters[i : i + rng.choice([1, 1, 5, 100])]
        elif way == 1:
            letters[i:i] = letters[i : i + rng.choice([1, 20, 300])]
        elif way == 2:
            letters.insert(i, rng.choice("[]{}\"'=.,#\n\\ -+eE019_tf\x00\x1b\u2028é"))
        elif way == 3:
            letters[i:i] = list(texts.text(rng))
        elif way == 4:
            letters[i : i + 1] = [chr(rng.randrange(256))]
        else:
            j = rng.randrange(len(letters) + 1)
            letters[i:i] = letters[j : j + rng.randrange(60)]
    return "".join(letters)


def heavy(rng: random.Random) -> str:
    """Return a file that is long or deep: keys, dots, brackets, names, numbers, tables by the thousand."""
    n = int(10 ** rng.uniform(1, 5))
    head = '[mechanism]\nname = "heavy"\n'
    body = '[bodies.b]\ntype = "point"\nmass = 1.0\n'
    ways = (
        lambda: head + "a" + ".a" * n + " = 1\n" + body,
        lambda: head + "[" + ".".join(["a"] * n) + "]\n" + body,
        lambda: head + body + "position = " + "[" * n + "]" * n + "\n",
        lambda: head + body + "position = " + "{ a = " * n + "1" + " }" * n + "\n",
        lambda: head + "".join(f"[bodies.b{i}]\nmass = 1.0\n" for i in range(n)),
        lambda: head + "".join(f'[bodies.b{i}]\ntype = "point"\nmass = 1.0\n' for i in range(min(n, 300))),
        lambda: head + body + "[parameters]\n" + "".join(f"p{i} = {i}\n" for i in range(n)),
        lambda: head + body + f"[tables.f]\nx = [{', '.join(str(i) for i in range(n))}]\ny = [{'0, ' * n}]\n",
        lambda: head + f'title = "{"t" * n}"\n' + body,
        lambda: head + body + "# " + "c" * n + "\n",
        lambda: "\n" * n + head + body,
        lambda: head + body + f"position = [{'1' * n}, 0]\n",
        lambda: head + body + f"position = [{'1.' + '1' * n}, 0]\n",
        lambda: head + body + f'[forces.f]\ntype = "{"x" * n}"\n',
        lambda: head + body + '[forces.f]\ntype = "force"\nbody = "b"\nforce = ["' + "t+" * (n // 2) + 't", 0]\n',
        lambda: (
            head + body + '[forces.f]\ntype = "force"\nbody = "b"\nforce = ["' + "(" * n + "t" + ")" * n + '", 0]\n'
        ),
        lambda: head + body + "[parameters]\n" + f'p = "{"2*" * n}2"\n',
        lambda: (
            head + body + "".join(f'[joints.j{i}]\ntype = "driver"\njoint = "j{i + 1}"\nvalue = 0\n' for i in range(n))
        ),
        lambda: (
            head + body + '[joints.a]\ntype = "driver"\njoint = "b1"\nvalue = 0\n'
            '[joints.b1]\ntype = "driver"\njoint = "a"\nvalue = 0\n'
        ),
        lambda: head + body + f'position = """{"x" * n}"""\n',
        lambda: head + body + '"' + "\\u0041" * n + '" = 1\n',
        lambda: "a = 1\n" * n,
        lambda: "[a]\n" * n,
        lambda: "[[a]]\n" * n + head + body,
        lambda: head + body + "x = " + "-" * n + "1\n",
        lambda: head + body + "x = 1979-05-27T07:32:00Z\n",
    )
    return rng.choice(ways)()[:1_100_000]
