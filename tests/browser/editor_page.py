"""A page of ``symgen edit`` in a browser, with a hand that clicks, drags and types."""

import json
import os
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Self

from symgen.cli._editor.edited_file import Document
from symgen.cli._editor.server import Editor
from tests.browser.chromium import PATIENCE, Chromium

#: Where pictures of a run of these tests are kept; nowhere unless it is set.
KEPT = os.environ.get("SYMGEN_BROWSER_PICTURES")


class Page:
    """A page of the editor in a browser."""

    def __init__(self, chromium: Chromium, editor: Editor) -> None:
        self.chromium, self.editor, self.run = chromium, editor, chromium.run

    @classmethod
    @contextmanager
    def of(cls, chromium: Chromium, file: Path) -> Iterator[Self]:
        """Serve a file; its page is opened by `open`."""
        with Editor(Document(file)) as server:
            threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True).start()
            opened = cls(chromium, server)
            yield opened
            chromium.call("Page.navigate", url="about:blank")
            opened.until("location.href === 'about:blank'")
            server.shutdown()

    def open(self, width: int = 1280, height: int = 800) -> None:
        """Open the page and wait until its mechanism moves."""
        self.chromium.call(
            "Emulation.setDeviceMetricsOverride",
            **{"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600},
        )
        self.chromium.said = []
        self.chromium.call("Page.navigate", url=self.editor.address)
        self.until("Boolean(window.symgen && window.symgen.editor)")

    def until(self, words: str) -> None:
        """Wait until an expression of the page is true."""
        ends = time.monotonic() + PATIENCE
        while not self.run(words):
            assert time.monotonic() < ends, f"never: {words}; {self.said()} {self.text('status')} {self.text('errors')}"
            time.sleep(0.02)

    def rested(self) -> None:
        """Wait until the text that stands there has been checked and moves."""
        self.until("window.symgen.editor.rest()")

    def said(self) -> list[str]:
        """Return what the console says, and who is asked other than the server."""
        own = [f"the page asks for {scheme}{self.editor.origin}" for scheme in ("", "blob:")]
        return [line for line in self.chromium.said if not line.startswith(tuple(own))]

    def text(self, of: str) -> str:
        """Return the text of an element, of a field what is in it."""
        return str(self.run(f"((e) => e.value || e.textContent)(document.getElementById('{of}'))"))

    def type(self, at: int, text: str, erased: int = 0) -> None:
        """Type at a character of the text, after having erased some behind it."""
        selected = f"document.getElementById('text').setSelectionRange({at}, {at + erased})"
        self.run(f"document.getElementById('text').focus(); {selected}")
        parts = f"v.slice(0, {at}) + {json.dumps(text)} + v.slice({at + (erased or not text)})"
        self.run(f"((v) => (window.typed = {parts}))(document.getElementById('text').value); 0")
        if text:
            self.chromium.call("Input.insertText", text=text)
        else:
            self.key("Delete")
        self.until("document.getElementById('text').value === window.typed")

    def key(self, key: str, modifiers: int = 0) -> None:
        """Press a key; modifiers are 2 for control and 8 for shift."""
        code = {"Enter": 13, "Delete": 46, "Escape": 27, "Tab": 9, "F2": 113, "ArrowDown": 40}.get(
            key, ord(key.upper()[0])
        )
        for kind in ("rawKeyDown", "char", "keyUp") if key == "Enter" else ("rawKeyDown", "keyUp"):
            text = {"text": "\r"} if kind == "char" else {}
            self.chromium.call(
                "Input.dispatchKeyEvent",
                **{"type": kind, "key": key, "windowsVirtualKeyCode": code, "modifiers": modifiers, **text},
            )

    def where(self, name: str) -> tuple[float, float]:
        """Return the middle of a handle on the screen."""
        found = self.run(
            "(() => { const all = [...document.querySelectorAll('.handle')];"
            f" const b = all.find((e) => e.title === {json.dumps(name)});"
            " const r = b.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]; })()"
        )
        return float(found[0]), float(found[1])

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Return where a place of the mechanism is on the screen."""
        corner = "(({ x, y }) => [x, y])(document.getElementById('picture').getBoundingClientRect())"
        (left, top), (right, down) = self.run(corner), self.run(f"window.symgen.editor.place({x}, {y})")
        return left + right + 1.0, top + down + 1.0  # inside its border

    def mouse(self, kind: str, x: float, y: float) -> None:
        held = {"button": "left", "clickCount": 1, "buttons": int(kind != "mouseReleased")}
        self.chromium.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **held)

    def click(self, x: float, y: float) -> None:
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y)

    def press(self, of: str) -> None:
        self.run(f"document.querySelector({json.dumps(of)}).click()")

    def drag(self, name: str, dx: float, dy: float, steps: int = 8) -> None:
        """Drag a handle by pixels."""
        x, y = self.where(name)
        self.mouse("mousePressed", x, y)
        for k in range(1, steps + 1):
            self.mouse("mouseMoved", x + dx * k / steps, y + dy * k / steps)
        self.mouse("mouseReleased", x + dx, y + dy)

    def picture(self, name: str) -> None:
        if KEPT:
            self.chromium.frame()
            self.chromium.picture(Path(KEPT) / f"edit-{name}.png")
