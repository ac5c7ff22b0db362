"""The server of the editor: this computer's browser alone, one secret address, one file.

Everything that a page sends is JSON, after the secret in the address; nothing in it names a file. A request of another
page has another `Origin`, or a `Host` that is not this address, and is refused before it is read.
"""

from __future__ import annotations

import gc
import json
import secrets
import sys
import threading
import traceback
from collections.abc import Callable, Mapping
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import msgspec

from symgen.base.errors import InputError, SymgenError
from symgen.cli._editor.drafts import Drafts
from symgen.cli._editor.edited_file import Document
from symgen.cli._editor.editor_page import editor_page
from symgen.cli._editor.linkages import DrawnTasks
from symgen.cli._editor.request import EditorRequest, read_request
from symgen.cli._editor.unsaved import Unsaved
from symgen.describe.files.load import LARGEST_FILE
from symgen.describe.files.problems import sentence_with_line

HOST = "127.0.0.1"
#: Bytes of a request at most: a text of the largest size in JSON, where characters may be escaped.
LARGEST_REQUEST = 6 * LARGEST_FILE + 10_000
JSON = "application/json"
_HEADERS = {
    "Cache-Control": "no-store",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
}

Job = Callable[[EditorRequest], Mapping[str, Any]]


class Editor(ThreadingHTTPServer):
    """The server of one file; `serve_forever` serves it.

    Parameters
    ----------
    document : Document
        The file.
    port : int
        Port of this computer; 0 for a free one.
    """

    daemon_threads = True
    allow_reuse_address = False

    def __init__(self, document: Document, port: int = 0) -> None:
        super().__init__((HOST, port), _Handler)
        self.secret = secrets.token_urlsafe(32)
        self.document, drafts, self._unsaved = document, Drafts(document.path), Unsaved(document.path)
        tasks = DrawnTasks()
        self.origin = f"http://{HOST}:{self.server_port}"
        self.jobs: dict[str, Job] = {
            "load": lambda _: self._load_file(),
            "state": lambda _: {"digest": document.file_digest()},
            "keep": lambda asked: self._keep_text(asked.draft, asked.tab),
            "forget": lambda asked: self._forget_page(asked.tab),
            "save": lambda asked: document.save(asked.draft, asked.digest, asked.force),
            "check": lambda asked: drafts.check_text(asked.draft),
            "motion": lambda asked: drafts.run_motion(asked.draft, asked.tab, asked.asked),
            "live": lambda asked: drafts.live_page_data(asked.draft, asked.tab, asked.asked),
            "joint": lambda asked: drafts.equations_of_joint(asked.draft, asked.name),
            "make": lambda asked: drafts.make_file(asked.draft, asked.kind),
            "add": lambda asked: drafts.add_part(asked.draft, asked.part, [place.spot for place in asked.spots]),
            "synthesize": lambda asked: tasks.find(
                asked.part, [place.spot for place in asked.spots], asked.tab, asked.starts
            ),
            "linkage": lambda asked: tasks.add(asked.draft, asked.asked, asked.tab),
            "dimensions": lambda asked: drafts.dimensions(asked.draft, asked.path),
            "dimension": lambda asked: drafts.set_dimension(asked.draft, asked.name, asked.value),
            "rename": lambda asked: drafts.rename_part(asked.draft, asked.path, asked.name),
            "remove": lambda asked: drafts.remove_part(asked.draft, asked.path),
        }

    def _load_file(self) -> Mapping[str, Any]:
        """Return the file, and texts of it that were never saved."""
        loaded = self.document.read()
        return {**loaded, "unsaved": self._unsaved.texts_but(loaded["text"])}

    def _keep_text(self, text: str, tab: str) -> Mapping[str, Any]:
        """Keep a text that is not saved until it is; return whether it could be kept."""
        if len(text) > LARGEST_FILE:
            return {"kept": False}
        with suppress(InputError):  # a file that went away, or is no text any more, has another text
            if self.document.read()["text"] == text:
                return self._forget_page(tab)
        return {"kept": self._unsaved.keep_text(tab, text)}

    def _forget_page(self, tab: str) -> Mapping[str, Any]:
        self._unsaved.forget_page(tab)
        return {"kept": True}

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing of pages that went away before their answer."""
        if not isinstance(sys.exception(), ConnectionError | TimeoutError):
            super().handle_error(request, client_address)

    def prepare(self) -> None:
        """Read what the first answer needs, code and words, while the browser opens."""

        def read() -> None:
            with suppress(SymgenError):
                self.jobs["check"](EditorRequest(self.document.read()["text"]))
            gc.collect()
            gc.freeze()  # what is loaded now stays: looking through it again and again took a fifth of each answer

        threading.Thread(target=read, name="symgen-edit", daemon=True).start()

    @property
    def address(self) -> str:
        """The address of the page, with its secret."""
        return f"{self.origin}/{self.secret}/"


class _Handler(BaseHTTPRequestHandler):
    """One connection."""

    server: Editor
    protocol_version = "HTTP/1.1"
    server_version, sys_version = "symgen", ""
    timeout = 60.0

    def log_message(self, format: str, *args: object) -> None:
        """Log nothing: the address has a secret."""

    def do_GET(self) -> None:
        """Send the page; nothing else is there."""
        if not self._is_allowed("GET"):
            return self._refuse_request(403)
        if self._word_after_secret() != "":
            return self._refuse_request(404)
        nonce = secrets.token_urlsafe(16)
        text, policy = editor_page(self.server.document.path.name, nonce)
        self._send_answer(200, text, "text/html", {"Content-Security-Policy": policy})

    def do_POST(self) -> None:
        """Do a job of the page."""
        if not self._is_allowed("POST"):
            return self._refuse_request(403)
        job = self.server.jobs.get(self._word_after_secret() or "")
        if job is None:
            return self._refuse_request(404)
        if self.headers.get_content_type() != JSON:
            return self._refuse_request(415)
        length = self.headers.get("Content-Length", "")
        if not length.isdecimal() or "Transfer-Encoding" in self.headers:
            return self._refuse_request(411)
        if int(length) > LARGEST_REQUEST:
            return self._refuse_request(413)
        try:
            answer = self._answer_job(job, self.rfile.read(int(length)))
        except msgspec.DecodeError:
            return self._refuse_request(400)
        self._send_answer(200, json.dumps(answer), JSON)

    def _answer_job(self, job: Job, body: bytes) -> Mapping[str, Any]:
        """Return the answer of a job, or the sentence of its error."""
        try:
            return job(read_request(body))
        except InputError as error:
            return {"error": sentence_with_line(error) if error.file is None else str(error)}
        except SymgenError as error:
            return {"error": str(error)}
        except MemoryError:
            return {"error": "there is not enough memory for that"}
        except (msgspec.DecodeError, RecursionError):
            raise msgspec.DecodeError from None
        except Exception:
            traceback.print_exc()
            return {"error": "symgen edit met an error of its own, which its terminal shows; the text is as it was"}

    def _is_allowed(self, method: str) -> bool:
        """Whether the request comes from the page itself, or from who has its address."""
        origin, site = self.headers.get("Origin"), self.headers.get("Sec-Fetch-Site", "none")
        own = self.headers.get_all("Host") == [self.server.origin.removeprefix("http://")]
        first = [*self.path.split("/"), ""][1]
        known = secrets.compare_digest(first.encode(), self.server.secret.encode())
        if method == "POST":
            return own and known and origin == self.server.origin
        return own and known and origin in (None, self.server.origin) and site in ("none", "same-origin")

    def _word_after_secret(self) -> str | None:
        """Return what follows the secret in the address; None for anything with further parts."""
        parts = self.path.split("/")
        return parts[2] if len(parts) == 3 else None

    def _refuse_request(self, status: int) -> None:
        self.close_connection = True
        self._send_answer(status, "", "text/plain")

    def _send_answer(self, status: int, text: str, kind: str, headers: Mapping[str, str] | None = None) -> None:
        body = text.encode()
        self.send_response(status)
        for name, value in {**_HEADERS, **(headers or {})}.items():
            self.send_header(name, value)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        self.send_header("Content-Length", str(len(body)))
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        self.wfile.write(body)
