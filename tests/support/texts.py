"""Random texts for hypothesis: everything that UTF-8 can write.

The alphabet of ``st.text()`` is the same, but found by trying a million code points, for seconds in every process.
"""

from hypothesis import strategies as st

CHARACTERS = st.characters(exclude_categories=("Cs",))


def texts(longest: int) -> st.SearchStrategy[str]:
    """Return texts of at most so many characters."""
    return st.text(CHARACTERS, max_size=longest)
