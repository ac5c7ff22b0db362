"""The words every stage shares: expressions, markers and measures. Needs nothing but msgspec."""
