"""Chromium without a window, driven through a pipe in its own protocol: no library is needed for that."""

import base64
import json
import os
import shutil
import subprocess
import tempfile
import time
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any, Self

#: Names under which systems have it; `SYMGEN_BROWSER` says where another one is.
NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
SWITCHES = (
    *(
        "--headless",
        "--no-sandbox",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        "--disable-quic",
        "--no-first-run",
        "--disable-accelerated-2d-canvas",
        "--hide-scrollbars",
    ),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-extensions"),
    *(
        "--remote-debugging-pipe",
        "--allow-file-access-from-files=false",
        "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
    ),
)
#: A page that does not answer within that has failed [s].
PATIENCE = 60.0

#: A script that takes WebGL from a page.
WITHOUT_WEBGL = """(() => {
  const given = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    return kind.startsWith('webgl') ? null : given.call(this, kind, ...rest);
  };
})();"""


def executable() -> str:
    """Return where the browser is."""
    found = os.environ.get("SYMGEN_BROWSER") or next((p for p in map(shutil.which, NAMES) if p), None)
    assert found, "browser tests need Chromium: apt-get install chromium, or SYMGEN_BROWSER=/path/to/it"
    return found


class Chromium:
    """One browser; pages are opened one after the other."""

    def __enter__(self) -> Self:
        self.home = tempfile.mkdtemp(prefix="symgen-browser-")
        (into, self._write), (self._read, out) = os.pipe(), os.pipe()

        def give() -> None:  # the protocol's pipes are numbers 3 and 4
            os.dup2(into, 100)
            os.dup2(out, 101)
            os.dup2(100, 3)
            os.dup2(101, 4)

        self.process = subprocess.Popen(
            [executable(), *SWITCHES, f"--user-data-dir={self.home}", "about:blank"],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            preexec_fn=give,
            close_fds=False,
        )
        os.close(into)
        os.close(out)
        self._left, self._count, self.session = b"", 0, ""
        self.said: list[str] = []
        self.asked = 0  # how often a page asked before it was left
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.process.terminate()
        self.process.wait(20)
        for end in (self._read, self._write):
            os.close(end)
        with suppress(OSError):
            shutil.rmtree(self.home)

    def call(self, method: str, **given: Any) -> Any:
        """Call a method of the protocol; what the page says meanwhile is kept in `said`."""
        self.send(method, **given)
        while True:
            found = self._message()
            if found.get("id") == self._count:
                assert "error" not in found, found["error"]
                return found["result"]

    def send(self, method: str, **given: Any) -> None:
        """Call a method that has no answer, such as one that ends a page."""
        self._count += 1
        message = {"id": self._count, "method": method, "params": given}
        if self.session:
            message["sessionId"] = self.session
        os.write(self._write, json.dumps(message).encode() + b"\0")

    def _message(self) -> Any:
        while b"\0" not in self._left:
            part = os.read(self._read, 1 << 20)
            assert part, "the browser has gone"
            self._left += part
        text, _, self._left = self._left.partition(b"\0")
        found = json.loads(text)
        given = found.get("params", {})
        if found.get("method") == "Runtime.exceptionThrown":
            details = given["exceptionDetails"]
            self.said.append(str(details.get("exception", {}).get("description", details["text"])))
        elif found.get("method") == "Runtime.consoleAPICalled" and given["type"] in ("error", "warning", "assert"):
            self.said.append(" ".join(str(a.get("value", a.get("description"))) for a in given["args"]))
        elif found.get("method") == "Log.entryAdded" and given["entry"]["level"] in ("error", "warning"):
            self.said.append(given["entry"]["text"])
        elif found.get("method") == "Page.javascriptDialogOpening":  # a page that asks before it is left
            self.asked += 1
            accept = {"id": 0, "method": "Page.handleJavaScriptDialog", "params": {"accept": True}}
            os.write(self._write, json.dumps({**accept, "sessionId": self.session}).encode() + b"\0")
        elif found.get("method") == "Network.requestWillBeSent":
            address = given["request"]["url"]
            if not address.startswith(("file:", "data:", "about:")):
                self.said.append(f"the page asks for {address}")
        return found

    def open(
        self, path: Path, width: int = 1280, height: int = 800, scale: float = 1.0, scripts: tuple[str, ...] = ()
    ) -> None:
        """Open a page, which finds scripts there, and wait until it is loaded; `said` begins anew."""
        phone = width < 600
        self.call(
            *("Emulation.setDeviceMetricsOverride",), width=width, height=height, deviceScaleFactor=scale, mobile=phone
        )
        self.said = []
        added = [self.call("Page.addScriptToEvaluateOnNewDocument", source=s)["identifier"] for s in scripts]
        self.call("Page.navigate", url=path.resolve().as_uri())
        ends = time.monotonic() + PATIENCE
        while self.run("document.readyState") != "complete":
            assert time.monotonic() < ends, f"{path.name} does not load"
        for identifier in added:
            self.call("Page.removeScriptToEvaluateOnNewDocument", identifier=identifier)

    def run(self, text: str) -> Any:
        """Return what an expression of the page is; promises are waited for."""
        found = self.call("Runtime.evaluate", expression=text, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in found, found["exceptionDetails"]
        return found["result"].get("value")

    def frame(self) -> None:
        """Wait until the page has been drawn twice."""
        self.run("new Promise((f) => requestAnimationFrame(() => requestAnimationFrame(() => f(0))))")

    def picture(self, path: Path) -> Path:
        """Write what is seen to a PNG file."""
        path.write_bytes(base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"]))
        return path
