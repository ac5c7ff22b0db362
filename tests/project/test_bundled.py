"""What is bundled of others is what `make codemirror` has made, and its licence stands beside it."""

import hashlib
import json
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "symgen" / "cli" / "_editor" / "web" / "codemirror"
DIGEST = "40b04a3b157939b264c08c31ebf4a004d1636ad4472106634a2181ab6b4bb3b9"


def test_codemirror_is_the_bundle_of_pinned_versions() -> None:
    assert hashlib.sha256((FOLDER / "codemirror.js").read_bytes()).hexdigest() == DIGEST
    versions = json.loads((FOLDER / "package.json").read_text(encoding="utf-8"))["dependencies"]
    assert all(version[0].isdigit() for version in versions.values()), versions  # none that may become another one
    assert "MIT License" in (FOLDER / "LICENSE.txt").read_text(encoding="utf-8")
