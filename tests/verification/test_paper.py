"""The paper: every number is read from a record or a measured page, and what it says of their order is so."""

import re
import shutil
import zipfile
from datetime import date

import pytest

import symgen
from benchmarks import paper
from benchmarks.records import FOLDER

TEXT = paper.SOURCE.read_text(encoding="utf-8")
#: Text without its head and its references.
BODY = TEXT.partition(r"\begin{document}")[2].partition(r"\begin{thebibliography}")[0]


def test_all_numbers_are_known_and_used():
    assert {*re.findall(r"\\n\{([^}]+)\}", BODY)} <= paper.numbers().keys()
    assert {*re.findall(r"\\numbers\{([^}]+)\}", BODY)} == paper.tables().keys()


def test_no_measured_number_is_typed():
    typed = re.sub(r"\\(?:includegraphics|setlength|begin|vspace)[^\n]*", "", BODY)
    # the step of the random mechanisms, gains of a heading, limits of ratios in the text
    assert {*re.findall(r"\d+\.\d+", typed)} == {"0.03", "0.001", "0.01", "0.1", "0.5", "0.9", "1.3"}


@pytest.mark.parametrize(("sentence", "holds"), [*paper.claims()])
def test_sentences_that_compare(sentence, holds):
    assert holds, sentence


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_it_is_set(tmp_path):
    assert shutil.which("pdflatex")
    folder = tmp_path / "paper"
    assert paper.main([str(folder)]) == 0
    with zipfile.ZipFile(tmp_path / "paper.zip") as packed:
        names = {name.removeprefix("paper/") for name in packed.namelist()}
    assert {f"symgen-{symgen.__version__}-py3-none-any.whl", "lock.txt", "CITATION.cff", "paper.pdf"} <= names
    assert {f"records/{path.name}" for path in FOLDER.iterdir()} <= names and "paper.log" not in names
    log = (folder / "paper.log").read_text(encoding="latin-1")
    assert "(6 pages" in log and "undefined" not in log and "Overfull" not in log


def test_the_citation_has_the_version_of_the_package_and_the_title_of_the_paper():
    cited = dict(re.findall(r"^ *([a-z-]+): *(.*)$", paper.CITATION.read_text(encoding="utf-8"), re.MULTILINE))
    assert cited["version"] == symgen.__version__ and date.fromisoformat(cited["date-released"])
    assert {"cff-version", "message", "title", "abstract", "license", "authors", "keywords"} <= cited.keys()
    (title,) = re.findall(r"\\title\{(.*)\}", TEXT)
    assert cited["title"].strip('"') == title.replace(r"\\", " ")  # the last one, of the preferred citation
