"""Runs that go on step by step from Python: for controllers, for loops with other programs in them, for trying out."""
