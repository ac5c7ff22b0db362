"""The search for events printed as JavaScript: every bit is that of its plain Python."""

import json

import pytest
from compile.native import printed, printed_search

from symgen.compile.native import javascript_code as js
from symgen.run.loops import searching
from tests.browser.chromium import Chromium

pytestmark = pytest.mark.browser


def test_events_of_functions_of_time(chromium: Chromium) -> None:
    calls = []

    def record(arguments, result, after):
        calls.append([[printed.packed(a) for a in arguments], result, [printed.packed(a) for a in after]])

    printed_search.compared(record)
    function = searching.decide.read(printed_search.ARGUMENTS)
    assert len(calls) > 100
    for first in range(0, len(calls), 50):
        text = f"""(() => {{
{js.HELPERS}{js.LOOP_HELPERS}
const calls = {json.dumps(calls[first : first + 50])};
{printed.HARNESS}
{js.javascript_functions({"decide": function})}
return calls.filter(([before, result, after]) => {{
  const given = before.map((x) => (typeof x === "string" ? unpacked(x) : x));
  const arrays = given.filter((x) => x instanceof Float64Array);
  if (decide(...given) !== result) return true;
  return after.some((text, i) => !unpacked(text).every((x, k) => Object.is(x, arrays[i][k])));
}}).length;
}})()"""
        assert chromium.run(text) == 0
