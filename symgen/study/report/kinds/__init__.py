"""Reports of studies, one file each; `symgen.write_report` finds them by the name that a study has for its own.

In: studies of one kind.
Out: a document.
Imports: the study that a file is about; `document` and rooms below.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from symgen.base.registry import Registry
from symgen.study.report.document import ReportDocument

#: Studies of one kind -> their report.
STUDY_REPORTS: Registry[Callable[[Sequence[Any]], ReportDocument]] = Registry(__name__, "report of a study")
